import type { Finding } from "./types.js";
import type { Packed } from "./unpacked.js";

/** Thrown if no plan can be made; `findings` lists all reasons. */
export class JobError extends Error {
  readonly findings: Finding[];

  constructor(message: string, findings: Finding[]) {
    super(message);
    this.name = "JobError";
    this.findings = findings;
  }
}

/** Copies the module's output: views of its memory become invalid. */
export class Sink implements Packed {
  numbers = new Float64Array();
  text = "";

  take(numbers: Float64Array, text: string): void {
    this.numbers = numbers.slice();
    this.text = text;
  }
}

/** Functions of the WebAssembly module. Values are passed coded, as `codes` and `text`. */
export interface Raw {
  catalog(): unknown;
  defaultJob(type: unknown, units: unknown): unknown;
  jobName(codes: Float64Array, text: string): unknown;
  proposedStock(codes: Float64Array, text: string): unknown;
  misfit(codes: Float64Array, text: string): unknown;
  check(codes: Float64Array, text: string): unknown;
  plan(codes: Float64Array, text: string, sink: Sink): void;
  configFaults(codes: Float64Array, text: string): unknown;
  filled(
    codes: Float64Array,
    text: string,
    config: Float64Array,
    configText: string,
  ): unknown;
  judged(
    codes: Float64Array,
    text: string,
    config: Float64Array,
    configText: string,
  ): unknown;
  table(codes: Float64Array, text: string, sink: Sink): void;
  meanings(codes: Float64Array, text: string, sink: Sink): void;
  measure(
    codes: Float64Array,
    text: string,
    measured: Float64Array,
    measuredText: string,
  ): unknown;
  importJob(text: unknown, codes: Float64Array, json: string): unknown;
  readProgram(text: Uint8Array, length: number, dialect: unknown): unknown;
  insertProgram(
    codes: Float64Array,
    text: string,
    other: Uint8Array,
    length: number,
    line?: number,
  ): unknown;
  runProgram(
    text: Uint8Array,
    length: number,
    codes: Float64Array,
    known: string,
  ): unknown;
  limits(): Uint32Array;
  jobSchema(): unknown;
  exportTable(codes: Float64Array, text: string, format: unknown): unknown;
  svg(codes: Float64Array, text: string, view: unknown): unknown;
  convertUnits(codes: Float64Array, text: string, units: unknown): unknown;
  lentoax(codes: Float64Array, text: string): unknown;
  lentoaxWords(codes: Float64Array, text: string): unknown;
  version(): string;
}

/**
 * Instance of the module. `complete` loads missing parts and returns whether any were missing. An exception that passes through the instance (a stack overflow
 * of the caller, a throwing getter) leaves it broken, so a fresh one replaces it before the next call.
 */
export class Instance {
  /** Number of the instance. Objects of an earlier instance are invalid. */
  number = 0;
  private broken = false;
  /** Nested calls: a getter of a job may itself call a function. */
  private depth = 0;

  constructor(
    private readonly renew: () => void,
    private readonly complete: () => boolean = () => false,
  ) {}

  /** Replaces a broken instance. */
  ready(): void {
    if (!this.broken) return;
    if (this.depth > 0)
      throw new Error("The call that this one is part of has failed");
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
      // A missing function traps.
      if (thrown instanceof WebAssembly.RuntimeError && this.complete()) {
        this.depth--;
        try {
          return this.call(run);
        } finally {
          this.depth++;
        }
      }
      const { message, findings } = (thrown ?? {}) as {
        message?: string;
        findings?: Finding[];
      };
      if (!findings) throw thrown;
      this.broken = false;
      throw new JobError(message ?? "", findings);
    } finally {
      this.depth--;
    }
  }
}

/** The module of this entry and its instance. */
export let raw: Raw;
export let instance: Instance;

/** Sets the module that the functions call. The page calls it again when its module replaces the prebuilt answers. */
export function attach(
  module: Raw,
  renew: () => void,
  complete?: () => boolean,
): void {
  raw = module;
  instance = new Instance(renew, complete);
}
