// Fields of a job that the host page has locked.
import { type Draft, isObject, putAt, valueAt } from "./job.js";

const typeOf = (job: Draft) => (job.cycle as Draft | undefined)?.type;

export class LockedFields {
  private readonly lockedValues: Map<string, unknown>;
  private readonly type: unknown;

  /** Stores the values at these paths of a job. */
  constructor(job: Draft, paths: string[]) {
    this.type = typeOf(job);
    const there = paths.filter((path) => valueAt(job, path) !== undefined);
    this.lockedValues = new Map(
      there.map((path) => [path, structuredClone(valueAt(job, path))]),
    );
  }

  /** Whether a field is locked; for a point, also each of its coordinates. */
  has(path: string): boolean {
    return this.lockedValues.has(path.replace(/\[\d\]$/, ""));
  }

  /** Restores the locked values in a job that was changed. A field of another cycle is not the same field. */
  keep(job: Draft): void {
    for (const [path, value] of this.lockedValues) {
      const section = path.slice(0, Math.max(path.lastIndexOf("."), 0));
      const isThere = isObject(section === "" ? job : valueAt(job, section));
      if (isThere && (!path.startsWith("cycle.") || typeOf(job) === this.type))
        putAt(job, path, value);
    }
  }
}
