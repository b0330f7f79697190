// Looks up the cycle, control and fields of the job in the catalog.
import {
  type CycleEntry,
  type FieldEntry,
  type PostEntry,
  type ResultTolerance,
  say,
  type Words,
} from "./core/browser.js";
import { alike, type Draft, valueAt } from "./job.js";
import { tidy } from "./number.js";
import { Phrases } from "./phrases.js";
import type { Rules } from "./rules.js";
import { w } from "./words.js";

export type Units = "mm" | "inch";
/** Program form: moves, or calls of a native cycle. */
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

  /** The catalog entry of the control in the form. */
  get post(): PostEntry | undefined {
    return this.postOf(this.get("control.post"));
  }

  /** The entry of a control; undefined if the catalog has no such control. */
  postOf(id: unknown): PostEntry | undefined {
    return this.catalog.posts.find((post) => post.id === id);
  }

  /** Forms in which a control supports a cycle; empty if it does not. */
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

  /** A control's word for the work offset with this number. */
  protected offsetWord(post: unknown, number: unknown): string | undefined {
    return typeof number === "number"
      ? this.postOf(post)?.workOffsetWords[number - 1]
      : undefined;
  }

  /** Control settings of the job for another control. They keep a form that it supports, and a work offset that has the same word there. */
  controlOf(post: unknown, form?: Form, from = this.draft): Draft {
    const control = { ...(from.control as Draft) };
    const forms = this.formsOf(post, this.cycle.type);
    // A form that was the only one of its control was not a choice. It does not select native cycles on another control.
    const chosen = this.formsOf(control.post, this.cycle.type).length > 1;
    if (form) control.form = form;
    else if (
      forms.length > 0 &&
      !(chosen && forms.includes(control.form as Form))
    )
      control.form = forms[0];
    return { ...control, workOffset: this.offsetOn(post, control), post };
  }

  /** Work offset on another control: the one with the same word. Without such an offset the program only measures. */
  protected offsetOn(
    post: unknown,
    control = this.draft.control as Draft,
  ): unknown {
    if (this.ownPreset(post, this.cycle.type)) return null;
    const { workOffset } = control;
    const word = this.offsetWord(control.post, workOffset);
    const words = this.postOf(post)?.workOffsetWords;
    // A number without a word is left for the user to correct.
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

  /** Whether a field has an effect in this job: the variant of its cycle and its control use it. */
  counts(path: string, field: FieldEntry): boolean {
    const key = /^(?:control|machine)\.(\w+)$/.exec(path)?.[1];
    if (key !== undefined && this.post?.unused.includes(key)) return false;
    if (key === "toolOffsets" && !this.correctsByMoves) return false;
    if (key === "edition" && this.get("control.form") !== "cycle") return false;
    const { when } = field;
    return (
      when === null || this.get(path.replace(/\w+$/, when.key)) === when.value
    );
  }

  /** Whether a program of moves corrects a tool by one of its results. */
  private get correctsByMoves(): boolean {
    const tolerances = Object.values(this.get("tolerances") ?? {});
    return (
      this.get("control.form") !== "cycle" &&
      tolerances.some((one) => Boolean((one as ResultTolerance)?.wear))
    );
  }

  /** Initial value of a field in a new job, in the job's units. In inch it is a round number. */
  initialValue(field: FieldEntry, units = this.units): unknown {
    return units === "inch" ? field.defaultInch : field.default;
  }

  /** Whether a field has its initial value, also after a conversion of units. */
  isUsual(path: string, field: FieldEntry): boolean {
    const value = this.get(path) ?? null;
    return (
      alike(value, this.initialValue(field) ?? null) ||
      alike(value, this.defaultValue(field) ?? null)
    );
  }

  /** Reason why the control has no program for the job's cycle; null if it has one. */
  whyNot(post: unknown): string | null {
    const forms =
      this.postOf(post)?.cycles.filter((c) => c.type === this.cycle.type) ?? [];
    if (forms.some((c) => c.supported)) return null;
    return (
      forms.find((c) => !c.supported)?.reason ??
      this.t("It has no program for this cycle")
    );
  }

  /** Every field of the form that is converted with the units, with its path. */
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

  /** Value of a field that the job omits, in the job's units. */
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

/** Whether values with this unit are converted with the units of the job. */
export const isMetric = (unit: FieldEntry["unit"]) =>
  unit === "length" || unit === "feed" || unit === "acceleration";

/** The field for the deviation of a size of the virtual part. */
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
