// Runs an opened program with the user's inputs and with assumptions for the rest. Does not depend on the page: long programs run in a worker.
import {
  type Finding,
  JobError,
  type ProgramKnown,
  type ProgramMoves,
  type ProgramRun,
  runProgram,
} from "./core/browser.js";

/** Result of running an opened program. */
export interface Ran {
  /** The user's inputs and the assumptions. */
  known: ProgramKnown;
  assumes: boolean;
  run: ProgramRun;
  /** The run without assumptions: rules and calls are reported from it. */
  plain: ProgramRun;
  /** Errors of the part that was given; the program runs without it. */
  wrong: Finding[];
}

/** Findings of a run that ends early. A touch at its target is a miss for programs that check for one. */
const ENDS = new Set(["macro-stops", "program-stops", "no-moves"]);
/** Fractions of their way at which touches are assumed to trigger, in the order of the attempts. `undefined`: unknown. */
const TRIALS = [1, 0.5, undefined];

/** Runs a program with what the user knows, or with the assumptions that leave the fewest positions unknown. */
export function runText(text: string, own: ProgramKnown): Ran {
  const { run: plain, wrong } = tried(text, own);
  const best = assume(text, own, plain);
  const chosen = best ?? { known: own, run: plain };
  return { ...chosen, assumes: best !== null, plain, wrong };
}

/** Runs the program; without the part if the part has errors. */
function tried(
  text: string,
  known: ProgramKnown,
): { run: ProgramRun; wrong: Finding[] } {
  try {
    return { run: runProgram(text, known), wrong: [] };
  } catch (thrown) {
    if (!(thrown instanceof JobError)) throw thrown;
    // Its errors are reported, and the fields stay for correction.
    const { part: _, ...rest } = known;
    return { run: runProgram(text, rest), wrong: thrown.findings };
  }
}

const unknowns = ({ to }: ProgramMoves | ProgramRun): number =>
  to.reduce((sum, x) => sum + Number(Number.isNaN(x)), 0);

const endings = ({ findings }: ProgramRun): number =>
  findings.filter(({ code }) => ENDS.has(code)).length;

/** Adds assumptions: unknown axes of the start and unknown offsets are 0, and touches trigger at a fraction of their way. */
function assumed(known: ProgramKnown, at: number | undefined): ProgramKnown {
  const { start, part } = known;
  const axis = (i: 0 | 1 | 2) => start?.[i] ?? 0;
  return {
    ...known,
    offsets: 0,
    start: [axis(0), axis(1), axis(2)],
    ...(at === undefined ? {} : { part: { ...part, at } }),
  };
}

/** The assumption with the fewest unknown positions, and its run. `null` if none has fewer than the plain run without ending earlier. */
function assume(
  text: string,
  own: ProgramKnown,
  plain: ProgramRun,
): { known: ProgramKnown; run: ProgramRun } | null {
  const { part } = own;
  const isKnown = part && ("cycle" in part || "at" in part);
  let least = unknowns(plain);
  let best: { known: ProgramKnown; run: ProgramRun } | null = null;
  for (const at of isKnown ? [undefined] : TRIALS) {
    if (least === 0) break;
    const known = assumed(own, at);
    const { run } = tried(text, known);
    const ends =
      run.kind.length < plain.kind.length || endings(run) > endings(plain);
    if (!ends && unknowns(run) < least) {
      least = unknowns(run);
      best = { known, run };
    }
  }
  return best;
}
