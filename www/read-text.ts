// What a text from outside is: a job, or a program whose moves can be drawn. It knows no page: long texts are read beside it (beside.ts).
import {
  type Finding,
  type Imported,
  importJob,
  JobError,
  type ProgramMoves,
  readProgram,
} from "./core/browser.js";

/** What was made of a text. */
export interface Reading {
  imported: Imported | null;
  /** Why no job could be made of it. */
  findings: Finding[];
  /** Its moves, where it is a program that says no job. */
  moves: ProgramMoves | null;
  /** How many measured points it holds, where it is LinuxCNC's PROBEOPEN log and nothing else, or a sender's log with grbl's reports of touches. */
  points: number;
}

/** How many numbers a line of that log has. */
const LOGGED = 9;

/** Findings of texts that may be programs all the same. */
const PROGRAM = [
  "no-job-in-program",
  "not-understood",
  "nothing-to-import",
  "text-too-long",
];

/** How a line of a program begins, on one control or another: a code, a variable, an O word, a block of Klartext. */
const BLOCK =
  /^[ \t]*(?:\/\d?[ \t]*)?(?:N?\d+[ \t]*)?(?:[GMT]\d|O(?:\d|<)|#[\d<]|BEGIN PGM|TCH PROBE)/im;

/** Reads a text. What is wrong with the text is in the findings; what is thrown has other causes. */
export function read(text: string): Reading {
  const points = logged(text);
  if (points > 0) return { imported: null, findings: [], moves: null, points };
  const { imported, findings } = job(text);
  const moves = findings.some(({ code }) => PROGRAM.includes(code))
    ? programOf(text)
    : null;
  // One move from nowhere is nothing to see, but a program is shown as its text.
  return {
    imported,
    findings,
    moves: moves && (moves.kind.length > 1 || BLOCK.test(text)) ? moves : null,
    points: 0,
  };
}

/** grbl's report of a touch, and the answer to `$#`, which repeats the last one. */
const REPORT = /\[PRB:[-+.,\d]{5,200}:[01]\]/g;
const REPEATED =
  /\[TLO:[^\]]{0,200}\]\s{0,9}(?:\[TLR:[^\]]{0,200}\]\s{0,9})?\[PRB:[^\]]{0,200}\]/g;

/** The points of a text that is such a log. */
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

/** The moves of a text; null where it is too long for a program, too. */
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
