import type {
  Catalog,
  Cycle,
  Finding,
  Imported,
  Job,
  Lentoax,
  LentoaxQuery,
  Measured,
  MoveColumns,
  Plan,
  ResultRow,
} from "./types.js";

export type * from "./types.js";

/** Thrown where no plan can be made; `findings` says everything that was found. */
export class JobError extends Error {
  readonly findings: Finding[];

  constructor(message: string, findings: Finding[]) {
    super(message);
    this.name = "JobError";
    this.findings = findings;
  }
}

/** What the WebAssembly module gives. */
export interface Raw {
  catalog(): unknown;
  defaultJob(type: unknown): unknown;
  check(job: unknown): unknown;
  plan(job: unknown): unknown;
  evaluate(job: unknown, measured: unknown): unknown;
  moveColumns(job: unknown): unknown;
  importJob(text: unknown): unknown;
  jobSchema(): unknown;
  exportTable(job: unknown, format: unknown): unknown;
  lentoax(query: unknown): unknown;
  lentoaxWords(query: unknown): unknown;
  version(): string;
}

/** The functions of the package. They take anything: what is no job is refused with findings. */
export interface Api {
  /** Everything a form needs: cycles, their fields, the controls. */
  catalog(): Catalog;
  /** A complete, valid job of a type. Throws `JobError` for an unknown type. */
  defaultJob(type: Cycle["type"]): Required<Job>;
  /** Everything that is wrong, unusual or worth knowing. Never throws. */
  check(job: unknown): Finding[];
  /** The whole plan. Throws `JobError` if any finding is an error. */
  plan(job: Job): Plan;
  /** The results from points that a machine really measured. Throws `JobError`. */
  evaluate(job: Job, measured: Measured): ResultRow[];
  /** The moves of the plan as typed arrays. Throws `JobError`. */
  moveColumns(job: Job): MoveColumns;
  /** A job from text: job JSON, a dump of CmdPrm codes (text, CSV, JSON), a program for SINUMERIK that was written here, or a Klartext program with cycle 1411. Throws `JobError` where no job can be made of it. */
  importJob(text: string): Imported;
  /** JSON Schema (2020-12) of a job: what it looks like. What depends on units, or on several fields together, only `check` knows. */
  jobSchema(): Record<string, unknown>;
  /** The parameter table as text, in the documented order; `text` is a line `CmdPrm.Flt[-50] = 50` a row. Throws `JobError`. */
  exportTable(job: Job, format: "csv" | "json" | "text"): string;
  /** SINUMERIK's LENTOAX: which tool length acts on which axis. Throws `JobError` where the query itself is wrong. */
  lentoax(query?: LentoaxQuery): Lentoax;
  /** The same in words, and NC lines that ask the control itself. */
  lentoaxWords(query?: LentoaxQuery): { meaning: string; sentence: string; program: string };
  /** The crate's version. */
  version(): string;
}

function orJobError<T>(run: () => unknown): T {
  try {
    return run() as T;
  } catch (thrown) {
    const { message, findings } = thrown as { message?: string; findings?: Finding[] };
    throw findings ? new JobError(message ?? "", findings) : thrown;
  }
}

/** Dresses the WebAssembly module's functions. */
export function dress(raw: Raw): Api {
  return {
    catalog: () => raw.catalog() as Catalog,
    defaultJob: (type) => orJobError(() => raw.defaultJob(type)),
    check: (job) => {
      try {
        return raw.check(job) as Finding[];
      } catch {
        return [{ level: "error", code: "unreadable", path: "", message: "This value cannot be read" }];
      }
    },
    plan: (job) => orJobError(() => raw.plan(job)),
    evaluate: (job, measured) => orJobError(() => raw.evaluate(job, measured)),
    moveColumns: (job) => orJobError(() => raw.moveColumns(job)),
    importJob: (text) => orJobError(() => raw.importJob(text)),
    jobSchema: () => raw.jobSchema() as Record<string, unknown>,
    exportTable: (job, format) => orJobError(() => raw.exportTable(job, format)),
    lentoax: (query) => orJobError(() => raw.lentoax(query)),
    lentoaxWords: (query) => orJobError(() => raw.lentoaxWords(query)),
    version: () => raw.version(),
  };
}
