// A job that comes from outside (a file, a pasted text, the browser's storage): whether the form can show it, and what it leaves out.
import {
  type Catalog,
  type Cycle,
  convertUnits,
  defaultJob,
  type FieldEntry,
  type Job,
  jobName,
  type Said,
} from "./core/browser.js";
import { w } from "./words.js";

/** A job while it is typed: any field may hold what is not (yet) a value. */
export type Draft = Record<string, unknown>;

export const isObject = (value: unknown): value is Draft =>
  typeof value === "object" && value !== null && !Array.isArray(value);
const isScalar = (value: unknown) => value === null || typeof value !== "object";
const isPoint = (value: unknown) => Array.isArray(value) && value.length === 3 && value.every(isScalar);
/** Left out, or null: the default stands in. */
export const isOut = (value: unknown) => value === undefined || value === null;

/** Why the form cannot show a job, as a sentence that names the path; null where it can. A leaf may hold any wrong scalar. */
export function misfit(job: unknown, catalog: Catalog): Said | null {
  if (!isObject(job)) return [w("The job must be an object")];
  const { cycle } = job;
  if (!isObject(cycle)) return [w("cycle must be an object")];
  const entry = catalog.cycles.find((c) => c.type === cycle.type);
  if (!entry) return [w("cycle.type must name a cycle that is known here")];
  const problems: Said[] = [];
  const need = (holds: boolean, path: string, what: string) => {
    if (!holds) problems.push([w("{path} must be {what}"), path, [what]]);
  };
  const leaves = (place: Draft, prefix: string, fields: FieldEntry[]) => {
    for (const { key, kind } of fields) {
      const value = place[key];
      if (value === undefined) continue;
      if (kind === "point" || kind === "nominalPoint") need(isPoint(value), prefix + key, w("a list of three numbers"));
      else need(isScalar(value), prefix + key, w("a single value"));
    }
  };
  const section = (place: Draft, path: string, key: string, fields: FieldEntry[]) => {
    const value = place[key];
    if (isObject(value)) leaves(value, `${path}.`, fields);
    else need(isOut(value), path, w("an object"));
  };
  const list = (value: unknown, path: string, what: string, fits: (item: unknown) => boolean) => {
    if (!isOut(value)) need(Array.isArray(value) && value.every(fits), path, what);
  };

  for (const { path, fields } of catalog.sections) {
    if (path === "") leaves(job, "", fields);
    else section(job, path, path, fields);
  }
  leaves(cycle, "cycle.", entry.fields);
  for (const { key, fields } of entry.sections) section(cycle, `cycle.${key}`, key, fields);
  const isTouch = (t: unknown) => isObject(t) && isPoint(t.point) && isPoint(t.vector);
  list(
    cycle.touches,
    "cycle.touches",
    w("a list of touches, each with a point and a vector of three numbers"),
    isTouch,
  );
  list(cycle.custom, "cycle.custom", w("a list of custom codes"), isObject);
  if (isObject(job.tool)) list(job.tool.frame, "tool.frame", w("a list of steps, each a turn or a mirror"), isObject);
  const sizes = isObject(job.part) ? job.part.sizes : undefined;
  if (!isOut(sizes))
    need(isObject(sizes) && Object.values(sizes).every(isScalar), "part.sizes", w("an object of numbers"));
  return problems[0] ?? null;
}

/** A job that fits, with every key that it leaves out at the catalog's default in its own units. */
export function complete(job: Draft, catalog: Catalog): Draft {
  const units = job.units === "inch" ? "inch" : "mm";
  const cycle = job.cycle as Draft;
  const fresh = convertUnits(defaultJob(cycle.type as Cycle["type"]), units) as unknown as Draft;
  // A fresh 1411 is for its own control; a job that names no control is for the catalog's first.
  const control = catalog.sections.find((s) => s.path === "control")?.fields ?? [];
  fresh.control = Object.fromEntries(control.map((field) => [field.key, field.default]));
  const whole = over(fresh, job);
  for (const { path } of catalog.sections) if (path !== "") whole[path] = over(fresh[path], job[path]);
  whole.cycle = over(fresh.cycle, cycle);
  for (const { key, optional } of catalog.cycles.find((c) => c.type === cycle.type)?.sections ?? [])
    if (!optional) (whole.cycle as Draft)[key] = over((fresh.cycle as Draft)[key], cycle[key]);
  const part = whole.part as Draft;
  part.sizes ??= {};
  if (job.name === undefined) whole.name = jobName(whole);
  return structuredClone(whole);
}

/** `undefined` is "not there": the base stands in. */
function over(base: unknown, given: unknown): Draft {
  const said = isObject(given) ? Object.entries(given).filter(([, value]) => value !== undefined) : [];
  return { ...(base as Draft), ...Object.fromEntries(said) };
}

/** Whether two jobs say the same, in whatever order. */
export function alike(a: unknown, b: unknown): boolean {
  if (typeof a !== "object" || typeof b !== "object" || a === null || b === null) return Object.is(a, b);
  const [one, two] = [Object.entries(a), new Map(Object.entries(b))];
  return one.length === two.size && one.every(([key, value]) => two.has(key) && alike(value, two.get(key)));
}

/** A cycle's own form, and the sizes of the virtual part that go with it, in other units. */
export function formIn(units: "mm" | "inch", cycle: Draft, sizes: Draft, from: "mm" | "inch"): [Draft, Draft] {
  const job = { format: 1, units: from, cycle, part: { sizes } } as unknown as Job;
  const converted = convertUnits(job, units) as unknown as { cycle: Draft; part: { sizes: Draft } };
  return [converted.cycle, converted.part.sizes];
}
