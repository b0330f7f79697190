// What a user knows of an opened program beside its text, kept with the name of its file.
import type { ProgramKnown } from "./core/browser.js";

const KEY = "touchpath.programs.1";

/** So many programs are remembered. */
const MOST = 50;

type Entry = [string, ProgramKnown];

function entries(): Entry[] {
  try {
    const kept: unknown = JSON.parse(localStorage.getItem(KEY) ?? "[]");
    return Array.isArray(kept)
      ? (kept as Entry[]).filter(
          (entry) => Array.isArray(entry) && entry.length === 2,
        )
      : [];
  } catch {
    // No storage, or nothing that can be read.
    return [];
  }
}

/** What was said of the program of a file; nothing of one without a name. */
export function knownOf(name: string | null): ProgramKnown {
  return (name !== null && entries().find(([of]) => of === name)?.[1]) || {};
}

/** Keeps it. */
export function keepKnown(name: string | null, known: ProgramKnown): void {
  if (name === null) return;
  const rest = entries().filter(([of]) => of !== name);
  try {
    localStorage.setItem(
      KEY,
      JSON.stringify([[name, known], ...rest].slice(0, MOST)),
    );
  } catch {
    // No storage, or a full one: the program runs all the same.
  }
}
