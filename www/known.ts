// User inputs for an opened program, stored under its file name.
import type { ProgramKnown } from "./core/browser.js";

const KEY = "touchpath.programs.1";

/** Maximum number of programs remembered. */
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
    // No storage, or its content cannot be read.
    return [];
  }
}

/** Stored inputs for the program of a file; empty without a file name. */
export function knownOf(name: string | null): ProgramKnown {
  return (name !== null && entries().find(([of]) => of === name)?.[1]) || {};
}

/** Stores them. */
export function keepKnown(name: string | null, known: ProgramKnown): void {
  if (name === null) return;
  const rest = entries().filter(([of]) => of !== name);
  try {
    localStorage.setItem(
      KEY,
      JSON.stringify([[name, known], ...rest].slice(0, MOST)),
    );
  } catch {
    // No storage, or it is full: the program still runs.
  }
}
