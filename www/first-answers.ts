// Answers of the module for the first job in mm and in inch. The build of the page asks the module for them.
import baked from "virtual:first-answers";
import { coded, same } from "./core/coded.js";
import type { Raw, Sink } from "./core/instance.js";
import type { Packed } from "./core/unpacked.js";

/** Answers for one job. */
export interface Known {
  job: unknown;
  name: string;
  misfit: unknown;
  findings: unknown;
  plan: Packed;
  table: Packed;
  meanings: Packed;
}

/** Answers that exist before the module is loaded. */
export interface Answers {
  type: string;
  version: string;
  limits: Uint32Array;
  catalog: unknown;
  mm: Known;
  inch: Known;
}

/** Stands in for the module until it is loaded. Throws for any other job; the page plans no other job before then. */
export function answers(): Raw {
  const jobs = [baked.mm, baked.inch].map((known) => ({
    known,
    own: coded(known.job),
  }));
  const of = (codes: Float64Array, text: string): Known => {
    const found = jobs.find(({ own }) => same(own, { codes, text }));
    return found ? found.known : early();
  };
  const hands =
    (which: "plan" | "table" | "meanings") =>
    (codes: Float64Array, text: string, sink: Sink): void => {
      const { numbers, text: texts } = of(codes, text)[which];
      sink.take(numbers, texts);
    };
  return {
    catalog: () => baked.catalog,
    defaultJob: (type, units) =>
      type === baked.type
        ? structuredClone(baked[units === "inch" ? "inch" : "mm"].job)
        : early(),
    jobName: (codes, text) => of(codes, text).name,
    misfit: (codes, text) => of(codes, text).misfit,
    check: (codes, text) => of(codes, text).findings,
    plan: hands("plan"),
    table: hands("table"),
    meanings: hands("meanings"),
    limits: () => baked.limits,
    version: () => baked.version,
    configFaults: early,
    filled: early,
    judged: early,
    measure: early,
    importJob: early,
    readProgram: early,
    insertProgram: early,
    runProgram: early,
    jobSchema: early,
    exportTable: early,
    svg: early,
    convertUnits: early,
    proposedStock: () => undefined,
    lentoax: early,
    lentoaxWords: early,
  };
}

function early(): never {
  throw new Error("The module is not there yet");
}
