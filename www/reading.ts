// What a text from outside is: a job, or a program whose moves can be drawn. It knows no page: long texts are read beside it (beside.ts).
import { type Finding, type Imported, importJob, JobError, type ProgramMoves, readProgram } from "./core/browser.js";

/** What was made of a text. */
export interface Reading {
  imported: Imported | null;
  /** Why no job could be made of it. */
  findings: Finding[];
  /** Its moves, where it is a program that says no job. */
  moves: ProgramMoves | null;
}

/** Findings of texts that may be programs all the same. */
const PROGRAM = ["no-job-in-program", "not-understood", "nothing-to-import"];

/** Reads a text. What is wrong with the text is in the findings; what is thrown has other causes. */
export function read(text: string): Reading {
  const { imported, findings } = job(text);
  const moves = findings.some(({ code }) => PROGRAM.includes(code)) ? readProgram(text) : null;
  // One move from nowhere is nothing to see.
  return { imported, findings, moves: moves && moves.kind.length > 1 ? moves : null };
}

function job(text: string): Omit<Reading, "moves"> {
  try {
    const imported = importJob(text);
    return { imported, findings: imported.findings };
  } catch (thrown) {
    if (!(thrown instanceof JobError)) throw thrown;
    return { imported: null, findings: thrown.findings };
  }
}
