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
  convertUnits(job: unknown, units: unknown): unknown;
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
  /** The same job in other units: every length and feed is converted, also in texts with tolerances (`10H7`, `10+0.01-0.015`, `?10`, `10@10.02`). What is neither a number nor such a text stays as it is. */
  convertUnits(job: unknown, units: "mm" | "inch"): Job;
  /** SINUMERIK's LENTOAX: which tool length acts on which axis. Throws `JobError` where the query itself is wrong. */
  lentoax(query?: LentoaxQuery): Lentoax;
  /** The same in words, and NC lines that ask the control itself. */
  lentoaxWords(query?: LentoaxQuery): { meaning: string; sentence: string; program: string };
  /** The crate's version. */
  version(): string;
}

/**
 * The module's instance. An exception that passes through it (a caller's own stack overflow, a getter's) leaves it broken for
 * good, so a fresh one takes its place before the next call.
 */
export class Instance {
  /** Counts the instances: what was made by an earlier one is of no use to this one. */
  number = 0;
  private broken = false;
  /** Calls under way: a getter of a job may itself call in. */
  private depth = 0;

  constructor(private readonly renew: () => void) {}

  /** Makes sure that the instance is a sound one. */
  ready(): void {
    if (!this.broken) return;
    if (this.depth > 0) throw new Error("The call that this one is part of has failed");
    this.renew();
    this.broken = false;
    this.number++;
  }

  call<T>(run: () => unknown): T {
    this.ready();
    this.depth++;
    try {
      return run() as T;
    } catch (thrown) {
      this.broken = true;
      const { message, findings } = (thrown ?? {}) as { message?: string; findings?: Finding[] };
      if (!findings) throw thrown;
      this.broken = false;
      throw new JobError(message ?? "", findings);
    } finally {
      this.depth--;
    }
  }
}

/** Dresses the WebAssembly module's functions. */
export function dress(raw: Raw, instance: Instance): Api {
  return {
    catalog: () => instance.call(() => raw.catalog()),
    defaultJob: (type) => instance.call(() => raw.defaultJob(type)),
    check: (job) => {
      try {
        return instance.call(() => raw.check(job));
      } catch {
        return [{ level: "error", code: "unreadable", path: "", message: "This value cannot be read" }];
      }
    },
    plan: (job) => instance.call(() => raw.plan(job)),
    evaluate: (job, measured) => instance.call(() => raw.evaluate(job, measured)),
    moveColumns: (job) => instance.call(() => raw.moveColumns(job)),
    importJob: (text) => instance.call(() => raw.importJob(text)),
    jobSchema: () => instance.call(() => raw.jobSchema()),
    exportTable: (job, format) => instance.call(() => raw.exportTable(job, format)),
    convertUnits: (job, units) => instance.call(() => raw.convertUnits(job, units)),
    lentoax: (query) => instance.call(() => raw.lentoax(query)),
    lentoaxWords: (query) => instance.call(() => raw.lentoaxWords(query)),
    version: () => instance.call(() => raw.version()),
  };
}
