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
  Catalog,
  Config,
  Cycle,
  Dialect,
  Finding,
  Imported,
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

// The functions of the package. They accept any value: one that is not a job is refused with findings.

/** Everything a form needs: cycles, their fields, the controls. */
export function catalog(): Catalog {
  return instance.call(() => raw.catalog());
}

/**
 * A complete, valid job of a type, in mm or in inch: in inch with numbers that people type (0.6), not with converted millimetres. Throws `JobError` for an
 * unknown type, and for units that are neither.
 */
export function defaultJob<T extends Cycle["type"]>(
  type: T,
  units: "mm" | "inch" = "mm",
): Required<Job> & { cycle: Extract<Cycle, { type: T }> } {
  return instance.call(() => raw.defaultJob(type, units));
}

/** The default name of a job: what it measures, and its main sizes (`BORE-D25`, `POCKET-80X50`). */
export function jobName(job: unknown): string {
  return on(job, raw.jobName);
}

/**
 * A stock that fits the features of a job, in its units: flush with the walls that are touched from outside, with a margin of 10 mm around the other features,
 * its top at the highest top side. Null where the job has errors, where nothing is touched, and where the path would hit that block.
 */
export function proposedStock(job: unknown): Job["stock"] {
  return on(job, raw.proposedStock);
}

/** Why the form cannot show a job, as a sentence that names the path; null where it can. A single value may still be wrong. @internal */
export function misfit(job: unknown): Message | null {
  return on(job, (codes, text) => raw.misfit(codes, text));
}

/** Everything that is wrong, unusual or worth knowing; with a config also what it refuses, and its own faults. Never throws. */
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

/** The whole plan; with a config, of the job that `configured` gives. Throws `JobError` if any finding is an error. */
export function plan(job: Job | SetUp, config?: Config): Plan {
  const { own, packed, said } = under(job, config);
  const plan = planOf(packed, () => tableOf(handed(own, raw.table)));
  if (said.length > 0) plan.findings = [...plan.findings, ...said];
  return plan;
}

/** The program alone, exactly that of the plan. Throws `JobError` where a plan would. */
export function program(job: Job | SetUp, config?: Config): ProgramText {
  return programOf(under(job, config).packed);
}

/**
 * The programs of many jobs, one by one as they are asked for: memory stays flat over any number. A job without a plan does not end the series: its
 * `program` is `null`, and its findings say why.
 */
export function* programs(
  jobs: Iterable<Job | SetUp>,
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

/** The faults of a config; their paths begin with `config.`. Empty for a good one. Never throws. */
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
 * The job with everything that it leaves out and a config fills in: the values of fields, and the first choice that is allowed where the default is not.
 * Throws `JobError` for a config with faults.
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
    // Of a value whose getters throw, what came over.
    return filled;
  }
}

/** The given value with what was filled in. What is no data of a job stays as it is: the check refuses it by its own name. */
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

/** What a config refuses of a job that it has filled in. @internal */
export function judged(job: unknown, config: Config): Finding[] {
  return judgedBy(coded(job), coded(config));
}

function judgedBy({ codes, text }: Coded, rules: Coded): Finding[] {
  return instance.call<Finding[]>(() =>
    raw.judged(codes, text, rules.codes, rules.text),
  );
}

/** A job under a config, coded and planned, and what the config says of it. Throws `JobError` with what is wrong with the job and what the config refuses. */
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

/** The results from what a machine really measured: those of `measure`. Throws `JobError`. */
export function evaluate(job: Job | SetUp, measured: Measured): ResultRow[] {
  return measure(job, measured).results;
}

/**
 * What follows from what a machine really measured: results, points in the work coordinate system, how they were read, and for grbl the block to type, which states the work offset.
 * It reads what machines print: points, results (`center.x=1.2345`), and logs of senders with grbl's `[PRB:…]`. Throws `JobError`; the findings say line by line what is missing or unclear.
 */
export function measure(job: Job | SetUp, measured: Measured): Measurement {
  const values = coded(measured);
  return on(job, (codes, text) =>
    raw.measure(codes, text, values.codes, values.text),
  );
}

/** The moves of the plan as typed arrays. Throws `JobError`. */
export function moveColumns(job: Job | SetUp): MoveColumns {
  const own = coded(job);
  // Who asks for the columns of the plan that was made last needs no second one.
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

/** A job from text: job JSON, a dump of CmdPrm codes (text, CSV, JSON), a program that was written here, or a Klartext or ISO program with cycle 1411. Of a program of moves that holds no job, `kind` is `moves`, and its moves are in `trace`. Throws `JobError` where neither can be made of it. */
export function importJob(text: string): Imported {
  const json =
    typeof text === "string" && fits(text.length, 0) ? parsed(text) : undefined;
  const { codes, text: texts } =
    json === undefined ? { codes: new Float64Array(), text: "" } : coded(json);
  const imported = instance.call<Imported>(() =>
    raw.importJob(text, codes, texts),
  );
  // A job as JSON is taken with all its content: then the module gives none.
  return imported.kind === "job"
    ? { ...imported, job: imported.job ?? (json as Job) }
    : imported;
}

/**
 * The moves of any program (G0 to G3, `G38.n`, `G31`, `MEAS=1`), up to `catalog().longestProgram` characters. Macros of LinuxCNC (O words) and Fanuc are run with
 * what they set themselves; what the control alone knows, and codes that are not known here, are not followed: `findings` say so. Without a dialect, the text decides. Throws `JobError` for a text that is too long.
 */
export function readProgram(text: string, dialect?: Dialect): ProgramMoves {
  const bytes = bytesOf(text);
  const moves = instance.call<ProgramMoves>(() =>
    raw.readProgram(bytes, text.length, dialect),
  );
  return { ...moves, kinds: [...MOVE_KINDS] };
}

/**
 * Runs any program with what is known beside its text: values of variables, the start position, where touches trigger, the files of its subprograms. What
 * stays unknown is `NaN`, never a guess: after a touch of which `part` says nothing, the place along its way. Throws `JobError` for a text that is too long, and for
 * what is known where that is wrong.
 */
export function runProgram(text: string, known: ProgramKnown = {}): ProgramRun {
  const bytes = bytesOf(text);
  const { codes, text: texts } = coded(known);
  const run = instance.call<ProgramRun>(() =>
    raw.runProgram(bytes, text.length, codes, texts),
  );
  return { ...run, kinds: [...MOVE_KINDS] };
}

const MOVE_KINDS = ["rapid", "feed", "probe"];

/** A program as UTF-8; of one that is too long nothing. */
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

/** JSON Schema (2020-12) of a job: its structure and every range, in either units. What depends on several fields together, or on what a text means, only `check` knows. */
export function jobSchema(): Record<string, unknown> {
  return instance.call(() => raw.jobSchema());
}

/** The parameter table as text, in the documented order; `text` is a line `CmdPrm.Flt[-50] = 50` a row. `importJob` reads a table of CmdPrm codes back, and not the Q table of 1411: read its program. Throws `JobError`. */
export function exportTable(
  job: Job | SetUp,
  format: "csv" | "json" | "text",
): string {
  return on(job, (codes, text) => raw.exportTable(codes, text, format));
}

/** What the rows of the plan's table mean, in their order, for `say`; none for a job whose form has errors. */
export function meanings(job: Job | SetUp): Message[] {
  return meaningsOf(handed(coded(job), raw.meanings));
}

/** The picture of a job as the text of an SVG: path, touches and, where they are seen in true size, dimensions and angles. Throws `JobError`. */
export function svg(
  job: Job | SetUp,
  view: "top" | "front" | "side" | "isometric" = "isometric",
): string {
  return on(job, (codes, text) => raw.svg(codes, text, view));
}

/** The same job in other units: every length and feed is converted, also in texts with tolerances (`10H7`, `10+0.01-0.015`, `?10`, `10@10.02`). They keep 4 decimals in mm and 6 in inch; a number below 0.001 keeps three more. What is neither a number nor such a text stays as it is; what JSON cannot hold becomes null. */
export function convertUnits(job: unknown, units: "mm" | "inch"): Job {
  return on(job, (codes, text) => raw.convertUnits(codes, text, units));
}

/** SINUMERIK's LENTOAX: which tool length acts on which axis. Throws `JobError` where the query itself is wrong. */
export function lentoax(query?: LentoaxQuery): Lentoax {
  return on(query, raw.lentoax);
}

/** The same in words, and NC lines that ask the control itself; `said` is the sentence for other languages. */
export function lentoaxWords(query?: LentoaxQuery): {
  meaning: string;
  sentence: string;
  said: Message;
  program: string;
} {
  return on(query, raw.lentoaxWords);
}

/** The crate's version. */
export function version(): string {
  return instance.call(() => raw.version());
}

const UNREADABLE = "This value cannot be read";
const NO_TEXT = "A program is text";

/** Codes a value, and calls with it. */
function on<T>(
  value: unknown,
  call: (codes: Float64Array, text: string) => unknown,
): T {
  const { codes, text } = coded(value);
  return instance.call(() => call(codes, text));
}

/** The job that was planned last, and its plan. */
let last: { job: Coded; plan: Packed } | null = null;

function packed(job: Coded): Packed {
  return instance.call(() => {
    const plan = new Sink();
    raw.plan(job.codes, job.text, plan);
    last = { job, plan };
    return plan;
  });
}

/** What a function of the module hands out of a job. The job is what it was when it was coded, whatever has become of the object since. */
function handed({ codes, text }: Coded, give: Raw["table"]): Packed {
  return instance.call<Packed>(() => {
    const sink = new Sink();
    give(codes, text, sink);
    return sink;
  });
}

/** The longest text that a job is made of, and the longest program, in UTF-16 units: no more is handed over. */
let most: Uint32Array | null = null;

function fits(length: number, which: 0 | 1): boolean {
  most ??= instance.call<Uint32Array>(() => raw.limits());
  return length <= (most[which] as number);
}

/** The deepest JSON that is read as a job, in levels: what lies deeper can be neither copied nor written as JSON again. A job has six. */
const DEEPEST_JSON = 100;

const TOO_DEEP = "This JSON has more than {most} levels: no job has so many";

/** What a text says as JSON; undefined where it is none. Throws `JobError` where it is nested too deeply. */
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

/** How many lists and objects of a JSON text lie in each other. */
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
