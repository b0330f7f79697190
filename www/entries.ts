// What the catalog knows of the job in the form: its cycle, its control, its fields.
import {
  type CycleEntry,
  type FieldEntry,
  type PostEntry,
  say,
  type Words,
} from "./core/browser.js";
import { alike, type Draft, valueAt } from "./job.js";
import { tidy } from "./number.js";
import { Phrases } from "./phrases.js";
import type { Rules } from "./rules.js";
import { w } from "./words.js";

export type Units = "mm" | "inch";
/** Whether a program moves itself, or calls a cycle of the control. */
export type Form = PostEntry["cycles"][number]["form"];

/** Looks up the job's own entries of the catalog. */
export abstract class CatalogView extends Phrases {
  /** The job in the form. */
  abstract draft: Draft;

  /** The rules of the host page. */
  abstract readonly rules: Rules;

  /** The entry of the job's cycle. */
  get cycle(): CycleEntry {
    const type = (this.draft.cycle as Draft).type;
    return (
      this.catalog.cycles.find((c) => c.type === type) ??
      (this.catalog.cycles[0] as CycleEntry)
    );
  }

  /** The units of the job. */
  get units(): Units {
    return this.draft.units === "inch" ? "inch" : "mm";
  }

  /** The value at a path such as `cycle.origin[1]`. */
  get(path: string): unknown {
    return valueAt(this.draft, path);
  }

  /** The entry of the control that the form has. */
  get post(): PostEntry | undefined {
    return this.postOf(this.get("control.post"));
  }

  /** The entry of a control; undefined if the catalog has no such control. */
  postOf(id: unknown): PostEntry | undefined {
    return this.catalog.posts.find((post) => post.id === id);
  }

  /** The forms in which a control takes a cycle; none if it does not. */
  formsOf(post: unknown, type: string): Form[] {
    const takes =
      this.postOf(post)?.cycles.filter((c) => c.type === type && c.supported) ??
      [];
    return takes
      .map((c) => c.form)
      .filter((form) => this.rules.allowsForm(form));
  }

  /** Whether the native cycle corrects the active preset, so that no work offset is chosen. */
  ownPreset(post: unknown, type: string): boolean {
    const forms =
      this.postOf(post)?.cycles.filter((c) => c.type === type && c.supported) ??
      [];
    return forms.some((c) => c.ownPreset);
  }

  /** What a control calls the work offset of a number. */
  protected offsetWord(post: unknown, number: unknown): string | undefined {
    return typeof number === "number"
      ? this.postOf(post)?.workOffsetWords[number - 1]
      : undefined;
  }

  /** What the job's control becomes with another one: that has its form for this cycle, and a work offset only if it calls it by the same word. */
  controlOf(post: unknown, form?: Form, from = this.draft): Draft {
    const control = { ...(from.control as Draft) };
    const forms = this.formsOf(post, this.cycle.type);
    // A form that was the only one of its control was not chosen: cycles of another control's own may not be there.
    const chosen = this.formsOf(control.post, this.cycle.type).length > 1;
    if (form) control.form = form;
    else if (
      forms.length > 0 &&
      !(chosen && forms.includes(control.form as Form))
    )
      control.form = forms[0];
    return { ...control, workOffset: this.offsetOn(post, control), post };
  }

  /** The work offset that a job for one control has on another: the one of the same name, else none. */
  protected offsetOn(
    post: unknown,
    control = this.draft.control as Draft,
  ): unknown {
    if (this.ownPreset(post, this.cycle.type)) return null;
    const { workOffset } = control;
    const word = this.offsetWord(control.post, workOffset);
    const words = this.postOf(post)?.workOffsetWords;
    // A number that no word is known for is the user's to put right.
    if (!words || word === undefined || control.post === post)
      return workOffset;
    return words.indexOf(word) + 1 || this.rules.offset;
  }

  /** The entry of a field by its path in the job; undefined if the catalog has no such field. */
  fieldAt(path: string): FieldEntry | undefined {
    const plain = path.replace(/\[\d\]$/, "");
    const keys = plain.split(".");
    const key = keys.pop();
    const place = keys.join(".");
    const { cycle, catalog } = this;
    if (plain === "cycle.type") return undefined;
    if (place === "part.sizes")
      return sizeField(
        cycle.fields.find((f) => f.key === key),
        this.words,
      );
    const section =
      place === "cycle"
        ? cycle
        : (cycle.sections.find((s) => `cycle.${s.key}` === place) ??
          catalog.sections.find((s) => s.path === place));
    return section?.fields.find((f) => f.key === key);
  }

  /** Whether a field changes anything in this job: its variant of the cycle and its control use it. */
  counts(path: string, field: FieldEntry): boolean {
    const key = /^control\.(\w+)$/.exec(path)?.[1];
    if (key !== undefined && this.post?.unused.includes(key)) return false;
    const { when } = field;
    return (
      when === null || this.get(path.replace(/\w+$/, when.key)) === when.value
    );
  }

  /** What a field of a new job begins with, in the job's units: in inch a number that people type. */
  initialValue(field: FieldEntry, units = this.units): unknown {
    return units === "inch" ? field.defaultInch : field.default;
  }

  /** Whether a field holds what a job has without it, be it a new one or one whose units were converted. */
  isUsual(path: string, field: FieldEntry): boolean {
    const value = this.get(path) ?? null;
    return (
      alike(value, this.initialValue(field) ?? null) ||
      alike(value, this.defaultValue(field) ?? null)
    );
  }

  /** Why the job's cycle has no program on a control; null where it has one. */
  whyNot(post: unknown): string | null {
    const forms =
      this.postOf(post)?.cycles.filter((c) => c.type === this.cycle.type) ?? [];
    if (forms.some((c) => c.supported)) return null;
    return (
      forms.find((c) => !c.supported)?.reason ??
      this.t("It has no program for this cycle")
    );
  }

  /** Every field of the job's form that is converted with its units, by its path. */
  protected *metric(): Generator<[string, FieldEntry]> {
    const { cycle, catalog } = this;
    const sections = [
      { path: "cycle", fields: cycle.fields },
      ...cycle.sections.map(({ key, fields }) => ({
        path: `cycle.${key}`,
        fields,
      })),
      ...catalog.sections,
    ];
    for (const { path, fields } of sections)
      for (const field of fields)
        if (isMetric(field.unit))
          yield [path === "" ? field.key : `${path}.${field.key}`, field];
  }

  /** What a field holds where the job says nothing, in the job's units. */
  defaultValue(field: FieldEntry): unknown {
    const metric = isMetric(field.unit);
    const scaled = (x: number) =>
      metric && this.units === "inch" ? tidy(x / 25.4) : x;
    if (typeof field.default === "number") return scaled(field.default);
    return Array.isArray(field.default)
      ? field.default.map(scaled)
      : field.default;
  }
}

/** Whether values of this unit are converted with the units of the job. */
export const isMetric = (unit: FieldEntry["unit"]) =>
  unit === "length" || unit === "feed" || unit === "acceleration";

/** How much a size of the virtual part differs. */
export function sizeField(
  field: FieldEntry | undefined,
  words: Words,
): FieldEntry | undefined {
  if (!field) return undefined;
  const label = say([w("{label} differs by"), field.label], words);
  const help = say(
    [
      w(
        "How much larger this is on the real part than in the form; negative is smaller.",
      ),
    ],
    words,
  );
  return {
    ...field,
    label,
    help,
    default: 0,
    defaultInch: 0,
    code: null,
    usual: null,
    range: null,
  };
}
