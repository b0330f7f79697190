// The sizes that were taken with a tolerance: which limit they are judged by, and which name a job has by one of them.
import type { Entries, Units } from "./entries.js";
import { tidy } from "./number.js";

/** A size and its limit, in the units that it was typed in. */
interface Judgement {
  type: string;
  units: Units;
  size: number;
  limit: number;
  /** The job's name, where it says the class. */
  name: string | null;
}

/** Sizes so near are one size, mm: a conversion to inch keeps six decimals. */
const NEAR = 2e-5;

const mm = (value: number, units: Units) =>
  units === "inch" ? value * 25.4 : value;

export class Judged {
  /** By the paths of the sizes. */
  private readonly all = new Map<string, Judgement>();

  constructor(private readonly job: Entries) {}

  add(path: string, size: number, limit: number, name: string | null): void {
    this.all.set(path, {
      type: this.job.cycle.type,
      units: this.job.units,
      size,
      limit,
      name,
    });
  }

  /** Of another job nothing was judged. */
  clear(): void {
    this.all.clear();
  }

  /** There is one limit for all sizes: of this one and those that are still as they were judged the narrowest, in the job's units. */
  narrowest(path: string, limit: number): number {
    const others = [...this.all]
      .filter(([at, one]) => at !== path && this.stays(at, one))
      .map(([, one]) => this.limit(one));
    return Math.min(limit, ...others);
  }

  /** Whether a name is one that says the class of a size; `"true"` as long as that is the size. */
  names(name: unknown): "true" | "outdated" | null {
    const [path, one] =
      [...this.all].find(([, { name: own }]) => own !== null && own === name) ??
      [];
    if (!path || !one) return null;
    return one.units === this.job.units && this.stays(path, one)
      ? "true"
      : "outdated";
  }

  private stays(path: string, one: Judgement): boolean {
    const size = this.job.get(path);
    return (
      one.type === this.job.cycle.type &&
      typeof size === "number" &&
      Math.abs(mm(size, this.job.units) - mm(one.size, one.units)) < NEAR
    );
  }

  private limit({ limit, units }: Judgement): number {
    return tidy(mm(limit, units) / mm(1, this.job.units));
  }
}

/** The name of a job with the class of a hole in it, as a drawing has it: `BORE-D25H7`. A name has no small letters, which would tell a shaft's class from it. */
export function withClass(name: string, text: string): string | null {
  const [, nominal, fit] =
    /^[Øø⌀]?\s*(\d+(?:[.,]\d+)?)\s*([A-Z]{1,2}\d{1,2})$/.exec(text.trim()) ??
    [];
  const stem = /^([A-Z]+-D)\d+(?:_\d+)?$/.exec(name)?.[1];
  return stem && nominal && fit
    ? `${stem}${nominal.replace(/[.,]/, "_")}${fit}`
    : null;
}
