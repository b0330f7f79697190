// What was measured on a machine: its text, and what follows from it.
import {
  type Finding,
  type Job,
  JobError,
  type Measurement,
  measure,
} from "./core/browser.js";
import type { Store } from "./store.js";
import { w } from "./words.js";

/** A thousandth of a millimetre or of a degree, a ten thousandth of an inch: what a control shows. */
export const places = (unit: string) => (unit === "inch" ? 4 : 3);
export const number = (value: number | null, digits: number) =>
  value === null ? "–" : value.toFixed(digits).replace(/^-(0\.?0*)$/, "$1");

/** The same as the language of the page writes it. */
export const shown = (store: Store, value: number | null, digits: number) =>
  store.number(number(value, digits));

/** What a program does with a result out of its tolerance. */
export const ACTIONS = [
  ["go", w("continue")],
  ["mark", w("mark it")],
  ["stop", w("stop")],
] as const;

/** What was made of the measured text: what follows from it, or what is wrong with it; neither if no text was entered. */
export interface Evaluated {
  /** That of the last part. */
  found?: Measurement;
  errors?: Finding[];
  /** Those of all parts of a series, or of the one. */
  parts?: Measurement[];
}

/** What makes reports: fetched when something was measured. */
export class Reports {
  private module: typeof import("./core/report.js") | null = null;

  constructor(private readonly loaded: () => void) {}

  /** The module, once it is there. */
  get(): typeof import("./core/report.js") | null {
    if (!this.module)
      import("./core/report.js").then(
        (module) => {
          this.module = module;
          this.loaded();
        },
        () => {},
      );
    return this.module;
  }
}

/** What was asked for last: several parts show the same of one text. */
let last: { asked: unknown[]; answer: Evaluated } | null = null;

/** What follows from the measured text. */
export function evaluated(store: Store, reports: Reports): Evaluated {
  const { measured, plan, stale } = store;
  if (measured.trim() === "") return {};
  const module = reports.get();
  // With errors in the form the plan is an older one, and says nothing of the job.
  if (stale) return answered(store, null);
  const asked = [store, plan, measured, module];
  if (!last || asked.some((one, i) => one !== last?.asked[i]))
    last = { asked, answer: answered(store, module) };
  return last.answer;
}

function answered(
  { measured, plan, job }: Store,
  module: typeof import("./core/report.js") | null,
): Evaluated {
  const runs = module ? module.runsOf(measured, plan) : [measured];
  try {
    const parts = runs.map((text) => measure(job as unknown as Job, text));
    return { found: parts.at(-1) as Measurement, parts };
  } catch (thrown) {
    if (!(thrown instanceof JobError)) throw thrown;
    return { errors: thrown.findings.filter((f) => f.level === "error") };
  }
}
