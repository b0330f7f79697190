// The one state of the page: the job as it stands in the form, and what follows from it.
import {
  type Catalog,
  type Cycle,
  type CycleEntry,
  catalog,
  check,
  convertUnits,
  defaultJob,
  type FieldEntry,
  type Finding,
  importJob,
  type Job,
  JobError,
  type Plan,
  plan,
} from "./core/browser.js";
import { complete, cycleIn, type Draft, isObject, misfit } from "./job.js";
import { keep, kept } from "./keep.js";

export type { Draft } from "./job.js";

/** What is kept of a cycle whose form was left. */
interface Left {
  units: Units;
  cycle: Draft;
  points: Points;
}

type Units = "mm" | "inch";
/** Measured points as text, by the units they were typed in: read in other units they would be other points. */
type Points = Record<Units, string>;
const noPoints = (): Points => ({ mm: "", inch: "" });

/** What outlives a reload. */
interface State {
  draft: Draft;
  typed: [string, string][];
  points?: Points;
}

export class Store extends EventTarget {
  readonly catalog: Catalog = catalog();
  draft: Draft;
  /** The text of number fields as it was typed, by path: `1,5` stays `1,5`. */
  typed = new Map<string, string>();
  findings: Finding[] = [];
  /** The last good plan. */
  plan!: Plan;
  /** Whether `plan` is of an earlier form, since the present one has errors. */
  stale = false;
  /** The job that `plan` is of. */
  shown!: Draft;
  /** The move that is pointed at. */
  highlight: number | null = null;
  /** What the page must say about what it found in the browser's storage. */
  notice = "";
  /** The points that a machine measured for this job. */
  private points = noPoints();
  /** Cycles that were left, so that coming back finds their forms and their measured points. */
  private left = new Map<string, Left>();

  constructor() {
    super();
    const first = this.catalog.cycles[0];
    if (!first) throw new Error("the catalog has a cycle");
    this.draft = structuredClone(defaultJob(first.type)) as unknown as Draft;
    this.compute();
    this.restore();
  }

  /** The longest text that is read, in characters. */
  get longest(): number {
    return this.catalog.longestText;
  }

  /** Why nothing of the plan is handed out: the form's first error. Null where the plan is the form's. */
  get withheld(): string | null {
    if (!this.stale) return null;
    return this.findings.find((f) => f.level === "error")?.message ?? "No plan can be made of this form";
  }

  get measured(): string {
    return this.points[this.units];
  }

  set measured(text: string) {
    this.points[this.units] = text;
    this.keep();
  }

  get cycle(): CycleEntry {
    const type = (this.draft.cycle as Draft).type;
    return this.catalog.cycles.find((c) => c.type === type) ?? (this.catalog.cycles[0] as CycleEntry);
  }

  get units(): Units {
    return this.draft.units === "inch" ? "inch" : "mm";
  }

  /** The value at a path such as `cycle.origin[1]`. */
  get(path: string): unknown {
    return steps(path).reduce<unknown>((value, key) => (value as Draft | undefined)?.[key], this.draft);
  }

  /** Sets a value; every keystroke comes through here. */
  set(path: string, value: unknown, typed?: string): void {
    if (typed === undefined) this.typed.delete(path);
    else this.typed.set(path, typed);
    const keys = steps(path);
    const last = keys.pop() as string;
    let place = this.draft;
    for (const key of keys) {
      place[key] ??= {};
      place = place[key] as Draft;
    }
    // A choice of another control takes the form with it that the control has for this cycle.
    if (path === "control.post") {
      const support = this.catalog.posts
        .find((p) => p.id === value)
        ?.cycles.filter((c) => c.type === this.cycle.type && c.supported);
      if (support?.length && !support.some((s) => s.form === place.form)) place.form = support[0]?.form;
    }
    place[last] = value;
    this.changed();
  }

  /** Takes a key out of the job. */
  drop(path: string): void {
    const keys = steps(path);
    const last = keys.pop() as string;
    const place = keys.reduce<unknown>((value, key) => (value as Draft | undefined)?.[key], this.draft);
    if (place) delete (place as Draft)[last];
    this.forget(path);
    this.changed();
  }

  /** Another cycle; the rest of the job stays, and what was left is kept. */
  choose(type: Cycle["type"]): void {
    const old = this.draft.cycle as Draft;
    if (type === old.type) return;
    const { units } = this;
    this.left.set(String(old.type), { units, cycle: old, points: this.points });
    const back = this.left.get(type);
    const fresh = defaultJob(type) as unknown as Draft;
    const home = (fresh.control as Draft).post;
    const control = this.draft.control as Draft;
    const support = this.catalog.posts
      .find((p) => p.id === control.post)
      ?.cycles.filter((c) => c.type === type && c.supported);
    // The control stays if it takes the new cycle; its form follows.
    this.draft.control = support?.length
      ? { ...control, form: support.some((s) => s.form === control.form) ? control.form : support[0]?.form }
      : {
          ...control,
          post: home,
          form: (fresh.control as Draft).form,
          workOffset: this.catalog.posts.find((p) => p.id === home)?.workOffsets ? control.workOffset : null,
        };
    this.draft.cycle = cycleIn(units, back?.cycle ?? (fresh.cycle as Draft), back?.units ?? "mm");
    this.points = back?.points ?? noPoints();
    (this.draft.part as Draft).sizes = {};
    this.forget("cycle");
    this.forget("part.sizes");
    this.highlight = null;
    this.changed();
  }

  /** Other units: the values shown are converted, the geometry stays. */
  setUnits(units: Units): void {
    if (units === this.draft.units) return;
    // Numbers in units that are none cannot be converted: they stay, and now have units.
    const known = this.draft.units === "mm" || this.draft.units === "inch";
    this.draft = known ? (convertUnits(this.draft, units) as unknown as Draft) : { ...this.draft, units };
    this.typed.clear();
    this.changed();
  }

  /** Takes a whole job, one that fits the form. */
  load(job: Draft): void {
    this.draft = complete(job, this.catalog);
    this.points = noPoints();
    for (const left of this.left.values()) left.points = noPoints();
    this.typed.clear();
    this.highlight = null;
    this.changed();
  }

  /** Takes a job from text: a job file or a program. Throws `JobError`, and changes nothing, where it cannot be shown. */
  open(text: string): Finding[] {
    if (text.length > this.longest) throw new JobError(this.tooLong(text.length), []);
    const { job, findings, trace } = importJob(text);
    const problem = trace ? "this program says no job" : this.unusable(job);
    if (problem) throw new JobError(`Nothing was changed: ${problem}`, findings);
    this.load(job as unknown as Draft);
    return findings;
  }

  /** What is said of a text that is too long to be read. */
  tooLong(length: number, what: "text" | "file" = "text"): string {
    const count = (n: number) => n.toLocaleString("en");
    const unit = what === "file" ? "bytes" : "characters";
    return `Nothing was read: this ${what} has ${count(length)} ${unit}, and at most ${count(this.longest)} are read`;
  }

  /** Back to the defaults of the present cycle. */
  reset(): void {
    this.load(structuredClone(defaultJob(this.cycle.type)) as unknown as Draft);
  }

  point(index: number | null): void {
    if (index === this.highlight) return;
    this.highlight = index;
    this.dispatchEvent(new Event("highlight"));
  }

  /** What a field holds where the job says nothing, in the job's units. */
  standIn(field: FieldEntry): unknown {
    const metric = field.unit === "length" || field.unit === "feed";
    const scaled = (x: number) => (metric && this.units === "inch" ? Number((x / 25.4).toFixed(6)) : x);
    if (typeof field.default === "number") return scaled(field.default);
    return Array.isArray(field.default) ? field.default.map(scaled) : field.default;
  }

  /** Findings at a path, or at something inside it. */
  at(path: string): Finding[] {
    return this.findings.filter((f) => f.path === path);
  }

  private changed(): void {
    this.compute();
    this.keep();
    this.dispatchEvent(new Event("change"));
  }

  private keep(): void {
    const state: State = { draft: this.draft, typed: [...this.typed], points: this.points };
    keep(state);
  }

  private compute(): void {
    try {
      this.plan = plan(this.draft as unknown as Job);
      this.findings = this.plan.findings;
      this.shown = structuredClone(this.draft);
      this.stale = false;
      if (this.highlight !== null && this.highlight >= this.plan.moves.length) this.highlight = null;
    } catch (thrown) {
      this.findings = thrown instanceof JobError ? thrown.findings : check(this.draft);
      this.stale = true;
    }
  }

  /** Why a job cannot be shown; null where it can. */
  private unusable(job: unknown): string | null {
    const format = check(job).find((f) => f.level === "error" && f.path === "format");
    return misfit(job, this.catalog) ?? format?.message ?? null;
  }

  /** Takes up what was kept. What cannot be used is left alone, and the page says so. */
  private restore(): void {
    for (const state of kept()) {
      const { draft, typed, points } = (isObject(state) ? state : {}) as Partial<State>;
      const problem = this.unusable(draft);
      if (problem) {
        this.notice = `What was kept in this browser cannot be used: ${problem}`;
        continue;
      }
      const isText = (pair: unknown) =>
        Array.isArray(pair) && pair.length === 2 && pair.every((x) => typeof x === "string");
      this.draft = complete(draft as Draft, this.catalog);
      this.typed = new Map(Array.isArray(typed) ? typed.filter(isText) : []);
      for (const units of ["mm", "inch"] as const)
        if (typeof points?.[units] === "string") this.points[units] = points[units];
      this.compute();
      return;
    }
  }

  private forget(prefix: string): void {
    for (const path of [...this.typed.keys()]) if (path.startsWith(prefix)) this.typed.delete(path);
  }
}

function steps(path: string): string[] {
  return path.split(/[.[\]]+/).filter(Boolean);
}

/** A number as a user types it, with point or comma; what is none stays text, and the check will say so. */
export function parseNumber(text: string): number | string {
  const plain = text.trim().replace(",", ".");
  return /^[+-]?(\d+\.?\d*|\.\d+)$/.test(plain) ? Number(plain) : text;
}
