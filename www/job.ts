// Completes a job from outside: a file, a pasted text, the browser's storage.
import {
  type Catalog,
  type Cycle,
  convertUnits,
  defaultJob,
  type Job,
  jobName,
} from "./core/browser.js";

/** A job while it is edited. Any field may hold an invalid value. */
export type Draft = Record<string, unknown>;

export const isObject = (value: unknown): value is Draft =>
  typeof value === "object" && value !== null && !Array.isArray(value);
/** Whether a value is omitted or null: the default applies. */
export const isOut = (value: unknown) => value === undefined || value === null;

/** A valid job with the catalog's default for every key that it omits, in its own units. */
export function complete(job: Draft, catalog: Catalog): Draft {
  const units = job.units === "inch" ? "inch" : "mm";
  const cycle = job.cycle as Draft;
  const sections = catalog.sections.filter(
    ({ path, optional }) => path !== "" && (!optional || isObject(job[path])),
  );
  const base: Draft = { ...defaultJob(cycle.type as Cycle["type"]) };
  for (const { path, fields } of sections)
    base[path] ??= Object.fromEntries(fields.map((f) => [f.key, f.default]));
  const fresh = convertUnits(base, units) as unknown as Draft;
  // A new 1411 is for its own control. A job without a control is for the first one of the catalog.
  const control =
    catalog.sections.find((s) => s.path === "control")?.fields ?? [];
  fresh.control = Object.fromEntries(
    control.map((field) => [field.key, field.default]),
  );
  const whole = over(fresh, job);
  for (const { path } of sections) whole[path] = over(fresh[path], job[path]);
  whole.cycle = over(fresh.cycle, cycle);
  for (const { key, optional } of catalog.cycles.find(
    (c) => c.type === cycle.type,
  )?.sections ?? [])
    if (!optional)
      (whole.cycle as Draft)[key] = over(
        (fresh.cycle as Draft)[key],
        cycle[key],
      );
  const part = whole.part as Draft;
  part.sizes ??= {};
  if (job.name === undefined) whole.name = jobName(whole);
  return structuredClone(whole);
}

/** `undefined` means omitted: the base applies. */
function over(base: unknown, given: unknown): Draft {
  const said = isObject(given)
    ? Object.entries(given).filter(([, value]) => value !== undefined)
    : [];
  return { ...(base as Draft), ...Object.fromEntries(said) };
}

/** Whether two jobs have the same values, in any order of keys. */
export function alike(a: unknown, b: unknown): boolean {
  if (
    typeof a !== "object" ||
    typeof b !== "object" ||
    a === null ||
    b === null
  )
    return Object.is(a, b);
  const [one, two] = [Object.entries(a), new Map(Object.entries(b))];
  return (
    one.length === two.size &&
    one.every(([key, value]) => two.has(key) && alike(value, two.get(key)))
  );
}

/** The parts of a job that belong to one of its cycles. */
export interface CycleParts {
  cycle: Draft;
  /** Size deviations of the virtual part. */
  sizes: Draft;
  /** Tolerances of its results, by result code. */
  tolerances: Draft;
}

/** Converts the parts of a job that belong to a cycle to other units. */
export function convertCycleParts(
  units: "mm" | "inch",
  { cycle, sizes, tolerances }: CycleParts,
  from: "mm" | "inch",
): CycleParts {
  const job = {
    format: 1,
    units: from,
    cycle,
    part: { sizes },
    tolerances,
  } as unknown as Job;
  const converted = convertUnits(job, units) as unknown as {
    cycle: Draft;
    part: { sizes: Draft };
    tolerances: Draft;
  };
  return {
    cycle: converted.cycle,
    sizes: converted.part.sizes,
    tolerances: converted.tolerances,
  };
}

/** The keys of a path such as `cycle.origin[1]`. */
const keysOf = (path: string) => path.split(/[.[\]]+/).filter(Boolean);

/** The value at a path in a job. */
export function valueAt(job: Draft, path: string): unknown {
  return keysOf(path).reduce<unknown>(
    (value, key) => (value as Draft | undefined)?.[key],
    job,
  );
}

/** Sets the value at a path in a job and creates the objects on the way. */
export function putAt(job: Draft, path: string, value: unknown): void {
  const keys = keysOf(path);
  const last = keys.pop() as string;
  let place = job;
  for (const key of keys) {
    place[key] ??= {};
    place = place[key] as Draft;
  }
  place[last] = value;
}

/** Removes the key at a path from a job. */
export function dropAt(job: Draft, path: string): void {
  const keys = keysOf(path);
  const last = keys.pop() as string;
  const place = keys.reduce<unknown>(
    (value, key) => (value as Draft | undefined)?.[key],
    job,
  );
  if (place) delete (place as Draft)[last];
}
