// Evaluation of the text that a machine printed.
import {
  type Finding,
  type Job,
  JobError,
  type Measurement,
  measure,
} from "./core/browser.js";
import type { Store } from "./store.js";
import { w } from "./words.js";

/** Decimals that a control displays: a thousandth of a millimetre or degree, a ten-thousandth of an inch. */
export const places = (unit: string) => (unit === "inch" ? 4 : 3);
export const number = (value: number | null, digits: number) =>
  value === null ? "–" : value.toFixed(digits).replace(/^-(0\.?0*)$/, "$1");

/** A number in the notation of the page's language. */
export const shown = (store: Store, value: number | null, digits: number) =>
  store.number(number(value, digits));

/** Actions of a program when a result is out of tolerance. */
export const ACTIONS = [
  ["go", w("continue")],
  ["mark", w("mark it")],
  ["stop", w("stop")],
] as const;

/** Results of the measured text, or its errors; neither if no text was entered. */
export interface Evaluated {
  /** The last part. */
  found?: Measurement;
  errors?: Finding[];
  /** All parts of a series. */
  parts?: Measurement[];
}

/** Loads the module for reports on first use. */
export class Reports {
  private module: typeof import("./core/report.js") | null = null;

  constructor(private readonly loaded: () => void) {}

  /** The module once it is loaded, else null. */
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

/** The last evaluation: several parts of the page show the same text. */
let last: { asked: unknown[]; answer: Evaluated } | null = null;

/** Evaluates the measured text. */
export function evaluated(store: Store, reports: Reports): Evaluated {
  const { measured, plan, stale } = store;
  if (measured.trim() === "") return {};
  const module = reports.get();
  // If the form has errors, the plan belongs to an earlier job.
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
