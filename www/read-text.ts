// Recognises a text from outside: a job, or a program whose moves can be drawn. Does not depend on the page: long texts are read in a worker (in-worker.ts).
import {
  type Finding,
  type Imported,
  importJob,
  JobError,
  type ProgramMoves,
  readProgram,
} from "./core/browser.js";

/** Result of reading a text. */
export interface Reading {
  imported: Imported | null;
  /** Reasons why the text yields no job. */
  findings: Finding[];
  /** Moves of a program that contains no job. */
  moves: ProgramMoves | null;
  /** Number of measured points, if the text is only a LinuxCNC PROBEOPEN log or a sender's log with grbl's touch reports. */
  points: number;
}

/** Number of values in a line of that log. */
const LOGGED = 9;

/** Findings of texts that may still be programs. */
const PROGRAM = [
  "no-job-in-program",
  "not-understood",
  "nothing-to-import",
  "text-too-long",
];

/** Start of a program line on any control: a code, a variable, an O word, a block of Klartext. */
const BLOCK =
  /^[ \t]*(?:\/\d?[ \t]*)?(?:N?\d+[ \t]*)?(?:[GMT]\d|O(?:\d|<)|#[\d<]|BEGIN PGM|TCH PROBE)/im;

/** Reads a text. Its errors are findings; exceptions have other causes. */
export function read(text: string): Reading {
  const points = logged(text);
  if (points > 0) return { imported: null, findings: [], moves: null, points };
  const { imported, findings } = job(text);
  const moves = findings.some(({ code }) => PROGRAM.includes(code))
    ? programOf(text)
    : null;
  // A single move from an unknown position shows nothing, so the program is shown as text.
  return {
    imported,
    findings,
    moves: moves && (moves.kind.length > 1 || BLOCK.test(text)) ? moves : null,
    points: 0,
  };
}

/** grbl's report of a touch. The answer to `$#` repeats the last one. */
const REPORT = /\[PRB:[-+.,\d]{5,200}:[01]\]/g;
const REPEATED =
  /\[TLO:[^\]]{0,200}\]\s{0,9}(?:\[TLR:[^\]]{0,200}\]\s{0,9})?\[PRB:[^\]]{0,200}\]/g;

/** Points of such a log. */
function logged(text: string): number {
  if (text.includes("[PRB:"))
    return text.replace(REPEATED, "").match(REPORT)?.length ?? 0;
  const lines = text.split("\n").filter((line) => line.trim() !== "");
  const holds = (line: string) => {
    const numbers = line.trim().split(/\s+/);
    return (
      numbers.length === LOGGED &&
      numbers.every(
        (text) => /^[-+.\d]/.test(text) && Number.isFinite(Number(text)),
      )
    );
  };
  return lines.every(holds) ? lines.length : 0;
}

/** Moves of a text; null if it is too long even for a program. */
function programOf(text: string): ProgramMoves | null {
  try {
    return readProgram(text);
  } catch (thrown) {
    if (!(thrown instanceof JobError)) throw thrown;
    return null;
  }
}

function job(text: string): Omit<Reading, "moves" | "points"> {
  try {
    const imported = importJob(text);
    return { imported, findings: imported.findings };
  } catch (thrown) {
    if (!(thrown instanceof JobError)) throw thrown;
    return { imported: null, findings: thrown.findings };
  }
}
