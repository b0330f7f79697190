// Tasks that a worker does for the page.
import type { ProgramKnown } from "./core/browser.js";
import type { Reading } from "./read-text.js";
import type { Ran } from "./run-text.js";

/** A text to read, or a program to run with inputs. */
export type Task = { read: string } | { run: string; known: ProgramKnown };

/** Result of a task. */
export type Answer<T extends Task> = T extends { read: string } ? Reading : Ran;

/** A request to the host page. The page sets `answer` if it has a worker. */
export interface Asked<T extends Task> {
  task: T;
  signal: AbortSignal;
  answer: Promise<Answer<T>> | null;
}

/** Asks the page around an element for a worker. `null` without a worker. */
export function askFor<T extends Task>(
  host: EventTarget,
  task: T,
  signal: AbortSignal,
): Promise<Answer<T>> | null {
  const detail: Asked<T> = { task, signal, answer: null };
  host.dispatchEvent(
    new CustomEvent("beside", { detail, bubbles: true, composed: true }),
  );
  return detail.answer;
}
