// The one state of the page: the job as it stands in the form, and what follows from it.
import {
  type Catalog,
  type Cycle,
  type CycleEntry,
  catalog,
  check,
  defaultJob,
  type FieldEntry,
  type Finding,
  importJob,
  type Job,
  JobError,
  type Plan,
  plan,
} from "./core/browser.js";

/** A job while it is typed: any field may hold what is not (yet) a value. */
export type Draft = Record<string, unknown>;

const STORAGE = "touchpath.job.1";

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
  measured = "";
  /** Forms of cycles that were left, so that coming back finds them. */
  private left = new Map<string, unknown>();

  constructor() {
    super();
    const first = this.catalog.cycles[0];
    if (!first) throw new Error("the catalog has a cycle");
    this.draft = structuredClone(defaultJob(first.type)) as unknown as Draft;
    this.compute();
    this.restore();
  }

  get cycle(): CycleEntry {
    const type = (this.draft.cycle as Draft).type;
    return this.catalog.cycles.find((c) => c.type === type) ?? (this.catalog.cycles[0] as CycleEntry);
  }

  get units(): "mm" | "inch" {
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

  /** Another cycle; the rest of the job stays, and the form that was left is kept. */
  choose(type: Cycle["type"]): void {
    const old = this.draft.cycle as Draft;
    this.left.set(`${old.type} ${this.units}`, old);
    const kept = this.left.get(`${type} ${this.units}`);
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
          workOffset: home === "heidenhain" ? null : control.workOffset,
        };
    this.draft.cycle = kept ?? (this.units === "inch" ? this.converted(fresh, 1 / 25.4).cycle : fresh.cycle);
    (this.draft.part as Draft).sizes = {};
    this.forget("cycle");
    this.forget("part.sizes");
    this.highlight = null;
    this.changed();
  }

  /** Other units: the values shown are converted, the geometry stays. */
  setUnits(units: "mm" | "inch"): void {
    if (units === this.units) return;
    this.draft = this.converted(this.draft, units === "inch" ? 1 / 25.4 : 25.4);
    this.draft.units = units;
    this.typed.clear();
    this.changed();
  }

  /** Takes a whole job. */
  load(job: Draft): void {
    this.draft = job;
    this.typed.clear();
    this.highlight = null;
    this.changed();
  }

  /** Takes a job from text: a job file or a program. Throws `JobError` where no job can be made of it. */
  open(text: string): Finding[] {
    const { job, findings } = importJob(text);
    if (!this.catalog.cycles.some((c) => c.type === job.cycle?.type))
      throw new JobError("This file has no cycle that is known here", findings);
    this.load(job as unknown as Draft);
    return findings;
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
    try {
      localStorage.setItem(STORAGE, JSON.stringify({ draft: this.draft, typed: [...this.typed] }));
    } catch {
      // No storage: the page works without.
    }
    this.dispatchEvent(new Event("change"));
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

  private restore(): void {
    try {
      const kept = JSON.parse(localStorage.getItem(STORAGE) ?? "null");
      if (!kept?.draft?.cycle || !this.catalog.cycles.some((c) => c.type === kept.draft.cycle.type)) return;
      this.draft = kept.draft;
      this.typed = new Map(kept.typed);
      this.compute();
    } catch {
      // What cannot be read is left alone: the defaults are shown.
    }
  }

  private forget(prefix: string): void {
    for (const path of [...this.typed.keys()]) if (path.startsWith(prefix)) this.typed.delete(path);
  }

  /** The same job with every length and feed multiplied. */
  private converted(draft: Draft, factor: number): Draft {
    const copy = structuredClone(draft);
    const digits = factor < 1 ? 6 : 4;
    const convert = (value: unknown): unknown => {
      if (typeof value === "number") return Number((value * factor).toFixed(digits));
      return Array.isArray(value) ? value.map(convert) : value;
    };
    const each = (place: Draft | undefined, fields: FieldEntry[]) => {
      if (!place) return;
      for (const field of fields) {
        const metric = field.unit === "length" || field.unit === "feed";
        if (metric && field.key in place) place[field.key] = convert(place[field.key]);
      }
    };
    for (const section of this.catalog.sections) {
      each(section.path ? (copy[section.path] as Draft) : copy, section.fields);
    }
    const type = (copy.cycle as Draft).type;
    const entry = this.catalog.cycles.find((c) => c.type === type);
    const fields = entry?.fields ?? [];
    each(copy.cycle as Draft, fields);
    for (const section of entry?.sections ?? [])
      each((copy.cycle as Draft)[section.key] as Draft | undefined, section.fields);
    each((copy.part as Draft | undefined)?.sizes as Draft | undefined, fields);
    const touches = (copy.cycle as Draft).touches;
    if (Array.isArray(touches)) for (const touch of touches as Draft[]) touch.point = convert(touch.point);
    return copy;
  }
}

function steps(path: string): string[] {
  return path.split(/[.[\]]+/).filter(Boolean);
}

/** A number as somebody types it, with point or comma; what is none stays text, and the check will say so. */
export function parseNumber(text: string): number | string {
  const plain = text.trim().replace(",", ".");
  return /^[+-]?(\d+\.?\d*|\.\d+)$/.test(plain) ? Number(plain) : text;
}
