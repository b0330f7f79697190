import { type Coded, coded, same } from "./coded.js";
import { instance, JobError, type Raw, raw, Sink } from "./instance.js";
import { FEEDS, KINDS } from "./layout.js";
import {
  columns,
  findingsOf,
  meaningsOf,
  planOf,
  programOf,
  tableOf,
} from "./plan.js";
import { say } from "./said.js";
import type {
  AnyJob,
  Catalog,
  Config,
  Cycle,
  Dialect,
  Finding,
  Imported,
  Insertion,
  Job,
  Lentoax,
  LentoaxQuery,
  Measured,
  Measurement,
  Message,
  MoveColumns,
  Plan,
  ProgramKnown,
  ProgramMoves,
  Programmed,
  ProgramRun,
  ProgramText,
  ResultRow,
  SetUp,
} from "./types.js";
import type { Packed } from "./unpacked.js";

export { JobError };

// Functions of the package. They accept any value: a value that is not a job is refused with findings.

/** Everything a form needs: cycles with their fields, and controls. */
export function catalog(): Catalog {
  return instance.call(() => raw.catalog());
}

/**
 * A complete, valid job of a type, in mm or in inch. Values in inch are round (0.6), not converted millimetres. Throws `JobError` for an unknown type or unit.
 */
export function defaultJob<T extends Cycle["type"]>(
  type: T,
  units: "mm" | "inch" = "mm",
): Required<Job> & { cycle: Extract<Cycle, { type: T }> } {
  return instance.call(() => raw.defaultJob(type, units));
}

/** The default name of a job, from its cycle and its main sizes: `BORE-D25`, `POCKET-80X50`. */
export function jobName(job: unknown): string {
  return on(job, raw.jobName);
}

/**
 * Stock that fits the features of a job, in its units: flush with the walls that are touched from outside, 10 mm around the other features, its top at the
 * highest top side. Null if the job has errors, touches nothing, or its path would collide with that stock.
 */
export function proposedStock(job: unknown): Job["stock"] {
  return on(job, raw.proposedStock);
}

/** Reason why the form cannot show a job, with the path; null if it can. Single values may still be invalid. @internal */
export function misfit(job: unknown): Message | null {
  return on(job, (codes, text) => raw.misfit(codes, text));
}

/** All errors, warnings and notes of a job; with a config also the values that it refuses, and its own errors. Never throws. */
export function check(job: unknown, config?: Config): Finding[] {
  try {
    if (config === undefined) return on(job, raw.check);
    const rules = coded(config);
    const own = coded(filled(job, rules));
    return [
      ...instance.call<Finding[]>(() => raw.check(own.codes, own.text)),
      ...judgedBy(own, rules),
    ];
  } catch (error) {
    if (error instanceof JobError) return error.findings;
    return [
      {
        level: "error",
        code: "unreadable",
        path: "",
        message: UNREADABLE,
        said: [UNREADABLE],
      },
    ];
  }
}

/** The whole plan; with a config, that of the job that `configured` returns. Throws `JobError` if any finding is an error. */
export function plan(job: AnyJob, config?: Config): Plan {
  const { own, packed, said } = under(job, config);
  const plan = planOf(packed, () => tableOf(handed(own, raw.table)));
  if (said.length > 0) plan.findings = [...plan.findings, ...said];
  return plan;
}

/** The program alone, identical to that of the plan. Throws `JobError` in the same cases as `plan`. */
export function program(job: AnyJob, config?: Config): ProgramText {
  return programOf(under(job, config).packed);
}

/**
 * Programs of many jobs, each planned when it is requested, so memory stays constant. A job without a plan does not end the series: its `program` is `null`,
 * and its findings give the reasons.
 */
export function* programs(
  jobs: Iterable<AnyJob>,
  config?: Config,
): IterableIterator<Programmed> {
  for (const job of jobs) {
    try {
      const { packed, said } = under(job, config);
      yield {
        program: programOf(packed),
        findings: [...findingsOf(packed), ...said],
      };
    } catch (error) {
      if (!(error instanceof JobError)) throw error;
      yield { program: null, findings: error.findings };
    }
  }
}

/** Errors of a config; their paths start with `config.`. Empty for a valid one. Never throws. */
export function checkConfig(config: unknown): Finding[] {
  try {
    return on(config, raw.configFaults);
  } catch {
    return [
      {
        level: "error",
        code: "unreadable",
        path: "config",
        message: UNREADABLE,
        said: [UNREADABLE],
      },
    ];
  }
}

/**
 * The job with the values that it omits and a config fills in: field values, and the first allowed choice where the default is not allowed. Throws `JobError`
 * for a config with errors.
 */
export function configured<T>(job: T, config: Config): T {
  return filled(job, coded(config));
}

function filled<T>(job: T, rules: Coded): T {
  const { codes, text } = coded(job);
  const filled = instance.call<T>(() =>
    raw.filled(codes, text, rules.codes, rules.text),
  );
  try {
    return merged(job, filled) as T;
  } catch {
    // For a value whose getters throw, the part that could be read.
    return filled;
  }
}

/** The given value plus the filled-in values. Data that no job has stays as it is, so that the check refuses it by name. */
function merged(given: unknown, filled: unknown): unknown {
  if (
    typeof given !== "object" ||
    typeof filled !== "object" ||
    given === null ||
    filled === null
  )
    return given;
  if (Array.isArray(given))
    return given.map((one, i) => merged(one, (filled as unknown[])[i]));
  const whole: Record<string, unknown> = { ...given };
  for (const [key, value] of Object.entries(filled))
    whole[key] = whole[key] === undefined ? value : merged(whole[key], value);
  return whole;
}

/** Values of a filled-in job that a config refuses. @internal */
export function judged(job: unknown, config: Config): Finding[] {
  return judgedBy(coded(job), coded(config));
}

function judgedBy({ codes, text }: Coded, rules: Coded): Finding[] {
  return instance.call<Finding[]>(() =>
    raw.judged(codes, text, rules.codes, rules.text),
  );
}

/** Codes and plans a job under a config, with the findings of the config. Throws `JobError` with the errors of the job and the refusals of the config. */
function under(
  job: unknown,
  config: Config | undefined,
): { own: Coded; packed: Packed; said: Finding[] } {
  if (config === undefined) {
    const own = coded(job);
    return { own, packed: packed(own), said: [] };
  }
  const rules = coded(config);
  const own = coded(filled(job, rules));
  let made: Packed;
  try {
    made = packed(own);
  } catch (error) {
    if (!(error instanceof JobError)) throw error;
    throw new JobError(error.message, [
      ...error.findings,
      ...judgedBy(own, rules),
    ]);
  }
  const said = judgedBy(own, rules);
  const refused = said.find(({ level }) => level === "error");
  if (refused)
    throw new JobError(refused.message, [...findingsOf(made), ...said]);
  return { own, packed: made, said };
}

/** Results from real measurements: the `results` of `measure`. Throws `JobError`. */
export function evaluate(job: AnyJob, measured: Measured): ResultRow[] {
  return measure(job, measured).results;
}

/**
 * Evaluates real measurements: results, points in the work coordinate system, how the text was read, and for grbl the block to type, which sets the work
 * offset. Reads print-outs of machines: points, results (`center.x=1.2345`), and sender logs with grbl's `[PRB:…]`. Throws `JobError`; its findings list line
 * by line what is missing or ambiguous.
 */
export function measure(job: AnyJob, measured: Measured): Measurement {
  const values = coded(measured);
  return on(job, (codes, text) =>
    raw.measure(codes, text, values.codes, values.text),
  );
}

/** The moves of the plan as typed arrays. Throws `JobError`. */
export function moveColumns(job: AnyJob): MoveColumns {
  const own = coded(job);
  // The columns of the last plan need no second plan.
  const { to, feed, kind, step, touch, cycle, arcs } = columns(
    last && same(last.job, own) ? last.plan : packed(own),
  );
  return {
    to: to.slice(),
    feed: Uint8Array.from(feed),
    kind: Uint8Array.from(kind),
    step: Uint8Array.from(step),
    touch: Int32Array.from(touch),
    cycle: Uint8Array.from(cycle),
    arcs: arcs.fives().slice(),
    feeds: [...FEEDS],
    kinds: [...KINDS],
  };
}

/**
 * Reads a job from text: job JSON, a dump of CmdPrm codes (text, CSV, JSON), a program written by Touchpath, or a Klartext or ISO program with cycle 1411. For
 * a program of moves without a job, `kind` is `moves` and `trace` holds its moves. Throws `JobError` if the text is neither.
 */
export function importJob(text: string): Imported {
  const json =
    typeof text === "string" && fits(text.length, 0) ? parsed(text) : undefined;
  const { codes, text: texts } =
    json === undefined ? { codes: new Float64Array(), text: "" } : coded(json);
  const imported = instance.call<Imported>(() =>
    raw.importJob(text, codes, texts),
  );
  // A job as JSON is returned with all its content. The module then returns no job.
  return imported.kind === "job"
    ? { ...imported, job: imported.job ?? (json as AnyJob) }
    : imported;
}

/**
 * Reads the moves of any program (G0 to G3, `G38.n`, `G31`, `MEAS=1`), up to `catalog().longestProgram` characters. Macros of LinuxCNC (O words) and Fanuc run
 * with the values that the text sets. Values that only the control knows and unknown codes are not followed and become `findings`. Without a dialect, it is
 * recognised from the text. Throws `JobError` for a text that is too long.
 */
export function readProgram(text: string, dialect?: Dialect): ProgramMoves {
  const bytes = bytesOf(text);
  const moves = instance.call<ProgramMoves>(() =>
    raw.readProgram(bytes, text.length, dialect),
  );
  return { ...moves, kinds: [...MOVE_KINDS] };
}

/**
 * Runs any program with inputs that its text does not contain: variable values, start position, trigger points, files of its subprograms. Unknown values are
 * `NaN`, never a guess; so is a position after a touch that `part` does not determine. Throws `JobError` for a text that is too long and for invalid inputs.
 */
export function runProgram(text: string, known: ProgramKnown = {}): ProgramRun {
  const bytes = bytesOf(text);
  const { codes, text: texts } = coded(known);
  const run = instance.call<ProgramRun>(() =>
    raw.runProgram(bytes, text.length, codes, texts),
  );
  return { ...run, kinds: [...MOVE_KINDS] };
}

/**
 * Inserts the program of a job into another program after `line` (0-based), or after the tool change of the probe. The other lines stay as they are. An earlier
 * inserted program of the same name is replaced. The result is read back: the inserted lines must be the job's program and make its touches. Throws
 * `JobError` if no place is found, or if something would go wrong there.
 */
export function insertProgram(
  job: AnyJob,
  into: string,
  { line, config }: { line?: number; config?: Config } = {},
): Insertion {
  const bytes = bytesOf(into);
  const { own, said } = under(job, config);
  const made = instance.call<Insertion>(() =>
    raw.insertProgram(own.codes, own.text, bytes, into.length, line),
  );
  return { ...made, findings: [...said, ...made.findings] };
}

const MOVE_KINDS = ["rapid", "feed", "probe"];

/** A program as UTF-8; empty for one that is too long. */
function bytesOf(text: string): Uint8Array {
  if (typeof text !== "string") {
    throw new JobError(NO_TEXT, [
      {
        level: "error",
        code: "wrong-type",
        path: "",
        message: NO_TEXT,
        said: [NO_TEXT],
      },
    ]);
  }
  return new TextEncoder().encode(
    text.length > 0 && fits(text.length, 1) ? text : "",
  );
}

/**
 * JSON Schema (2020-12) of a job: its structure and every range, in both units. Rules about several fields and about the meaning of texts are only in `check`.
 */
export function jobSchema(): Record<string, unknown> {
  return instance.call(() => raw.jobSchema());
}

/**
 * The parameter table as text, in the documented order; `text` has a line `CmdPrm.Flt[-50] = 50` per row. `importJob` reads a table of CmdPrm codes back; for
 * 1411 it reads the program, not the Q table. Throws `JobError`.
 */
export function exportTable(
  job: AnyJob,
  format: "csv" | "json" | "text",
): string {
  return on(job, (codes, text) => raw.exportTable(codes, text, format));
}

/** Meanings of the rows of the plan's table, in their order, for `say`; empty for a job with errors. */
export function meanings(job: AnyJob): Message[] {
  return meaningsOf(handed(coded(job), raw.meanings));
}

/** The picture of a job as SVG text: path, touches and, where the view shows true size, dimensions and angles. Throws `JobError`. */
export function svg(
  job: AnyJob,
  view: "top" | "front" | "side" | "isometric" = "isometric",
): string {
  return on(job, (codes, text) => raw.svg(codes, text, view));
}

/**
 * The job in other units. Every length and feed is converted, also in texts with tolerances (`10H7`, `10+0.01-0.015`, `?10`, `10@10.02`). Values keep 4
 * decimals in mm and 6 in inch, below 0.001 three more. Other values stay as they are; a value without JSON becomes null.
 */
export function convertUnits(job: Job, units: "mm" | "inch"): Job;
export function convertUnits(job: SetUp, units: "mm" | "inch"): SetUp;
export function convertUnits(job: unknown, units: "mm" | "inch"): AnyJob;
export function convertUnits(job: unknown, units: "mm" | "inch"): AnyJob {
  return on(job, (codes, text) => raw.convertUnits(codes, text, units));
}

/** SINUMERIK's LENTOAX: which tool length acts on which axis. Throws `JobError` for an invalid query. */
export function lentoax(query?: LentoaxQuery): Lentoax {
  return on(query, raw.lentoax);
}

/** The answer of LENTOAX in words, and NC lines that ask the control itself. `said` is the sentence for other languages. */
export function lentoaxWords(query?: LentoaxQuery): {
  meaning: string;
  sentence: string;
  said: Message;
  program: string;
} {
  return on(query, raw.lentoaxWords);
}

/** Version of the crate. */
export function version(): string {
  return instance.call(() => raw.version());
}

const UNREADABLE = "This value cannot be read";
const NO_TEXT = "A program is text";

/** Codes a value and calls a function with it. */
function on<T>(
  value: unknown,
  call: (codes: Float64Array, text: string) => unknown,
): T {
  const { codes, text } = coded(value);
  return instance.call(() => call(codes, text));
}

/** The job that was planned last, with its plan. */
let last: { job: Coded; plan: Packed } | null = null;

function packed(job: Coded): Packed {
  return instance.call(() => {
    const plan = new Sink();
    raw.plan(job.codes, job.text, plan);
    last = { job, plan };
    return plan;
  });
}

/** Output of a module function for a job that was coded earlier. Later changes of the object do not matter. */
function handed({ codes, text }: Coded, give: Raw["table"]): Packed {
  return instance.call<Packed>(() => {
    const sink = new Sink();
    give(codes, text, sink);
    return sink;
  });
}

/** Maximum length of a text with a job, and of a program, in UTF-16 units. Longer texts are not passed to the module. */
let most: Uint32Array | null = null;

function fits(length: number, which: 0 | 1): boolean {
  most ??= instance.call<Uint32Array>(() => raw.limits());
  return length <= (most[which] as number);
}

/** Maximum depth of JSON that is read as a job, in levels: deeper values can be neither copied nor serialised. A job has six levels. */
const DEEPEST_JSON = 100;

const TOO_DEEP = "This JSON has more than {most} levels: no job has so many";

/** Value of a JSON text; undefined if it is not JSON. Throws `JobError` if it is nested too deeply. */
function parsed(text: string): unknown {
  let json: unknown;
  try {
    json = JSON.parse(text.replace(/^\ufeff/, ""));
  } catch {
    return undefined;
  }
  if (levels(text) > DEEPEST_JSON) {
    const said: Message = [TOO_DEEP, String(DEEPEST_JSON)];
    throw new JobError(say(said), [
      {
        level: "error",
        code: "nested-too-deeply",
        path: "",
        message: say(said),
        said,
      },
    ]);
  }
  return json;
}

/** Nesting depth of the lists and objects in a JSON text. */
function levels(json: string): number {
  let depth = 0;
  let most = 0;
  let quoted = false;
  for (let i = 0; i < json.length; i++) {
    const sign = json[i];
    if (quoted) {
      if (sign === "\\") i++;
      else quoted = sign !== '"';
    } else if (sign === '"') quoted = true;
    else if (sign === "{" || sign === "[") most = Math.max(most, ++depth);
    else if (sign === "}" || sign === "]") depth--;
  }
  return most;
}
