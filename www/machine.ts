// The machine of the job: control, work offset, probe, and presets of them.
import { convertUnits } from "./core/browser.js";
import { Document, LOOK_ONLY } from "./document.js";
import type { Form } from "./entries.js";
import { complete, type Draft, isObject } from "./job.js";
import { type Preset, SECTIONS } from "./presets.js";
import { w } from "./words.js";

/** Changes the machine of the job. */
export abstract class Machine extends Document {
  /** Applies a stylus of the host page to the job. */
  useStylus(stylus: Draft): void {
    this.put("stylus", { ...(this.draft.stylus as Draft), ...stylus });
  }

  /** Changes the control. Reports a work offset that it does not have. */
  chooseControl(post: unknown, form?: Form): void {
    const old = this.draft.control as Draft;
    if (post !== old.post) this.beforeControl = old;
    this.put("control", {
      ...this.controlOf(post, form),
      workOffset: this.offsetFor(post),
    });
    this.tellLost(old);
  }

  /** Work offset on another control: that of the job, or else one that the current control does not have. */
  protected offsetFor(post: unknown): unknown {
    const old = this.draft.control as Draft;
    if (old.workOffset === null && this.controlWithOffset)
      return this.offsetOn(post, this.controlWithOffset);
    const offset = this.offsetOn(post, old);
    if (offset === null && old.workOffset !== null)
      this.controlWithOffset = old;
    return offset;
  }

  /** Announces that a work offset is no longer written because this control has no offset of that name. */
  protected tellLost({ post, workOffset }: Draft): void {
    if (
      typeof workOffset !== "number" ||
      (this.draft.control as Draft).workOffset !== null
    )
      return;
    const word = this.offsetWord(post, workOffset) ?? String(workOffset);
    this.announce([
      w("This control has no {offset}: the program now writes no work offset"),
      word,
    ]);
  }

  /**
   * Chooses the control for another cycle: that of the job if it supports the cycle, else the previous one, else the cycle's default. A control that the host
   * page requests stays; if it does not support the cycle, the job has an error.
   */
  protected takeControl(type: string, usual: Draft): void {
    const old = this.draft.control as Draft;
    const takes =
      [old, this.beforeControl, usual].find(
        (one) => one && this.serves(one.post, type),
      ) ?? usual;
    const forms = this.formsOf(takes.post, type);
    const form = forms.includes(takes.form as Form)
      ? takes.form
      : (forms[0] ?? takes.form);
    if (takes.post === old.post) {
      const workOffset = this.ownPreset(old.post, type) ? null : old.workOffset;
      this.draft.control = { ...old, form, workOffset };
    } else {
      const workOffset = this.offsetFor(takes.post);
      this.beforeControl = old;
      this.draft.control = { ...old, post: takes.post, form, workOffset };
    }
  }

  /** Whether a control supports a cycle or the host page requests it. */
  protected serves(post: unknown, type: string): boolean {
    return post === this.outside.post || this.formsOf(post, type).length > 0;
  }

  /** A preset from the machine of the job. The work offset belongs to the job, not to the preset. */
  preset(name: string): Preset {
    const sections = structuredClone(
      Object.fromEntries(
        SECTIONS.map((section) => [section, this.draft[section]]),
      ),
    );
    delete (sections.control as Draft).workOffset;
    return {
      name,
      units: this.units,
      overtravel: this.draft.overtravel,
      sections,
    };
  }

  /**
   * Applies these sections of a preset in the job's units. The work offset stays if the control has it. Throws `JobError` and changes nothing if the preset
   * does not fit.
   */
  usePreset(
    preset: Preset,
    parts: readonly string[] = [...Object.keys(preset.sections), "overtravel"],
  ): void {
    if (this.refuses) throw this.refusal(LOOK_ONLY);
    const { units: held, draft } = this;
    const old = draft.control as Draft;
    const all: Draft = { ...preset.sections, overtravel: preset.overtravel };
    const taken = Object.fromEntries(
      Object.entries(all).filter(
        ([key, x]) => parts.includes(key) && x !== undefined,
      ),
    );
    if (isObject(taken.control)) {
      const { post } = taken.control;
      const forms = this.formsOf(post, this.cycle.type);
      const form = forms.includes(taken.control.form as Form)
        ? taken.control.form
        : (forms[0] ?? taken.control.form);
      taken.control = {
        ...taken.control,
        form,
        workOffset: this.offsetOn(post),
      };
    }
    const job = {
      ...structuredClone(draft),
      ...structuredClone(taken),
      units: preset.units,
    };
    const problem = this.unusable(job);
    if (problem)
      throw this.refusal([
        w("Nothing was changed: this machine cannot be used: {problem}"),
        problem,
      ]);
    const whole = complete(this.outside.filled(job) as Draft, this.catalog);
    const fitted = (preset.units === held
      ? whole
      : convertUnits(whole, held)) as unknown as Draft;
    this.mark(null);
    const fixed = this.fixed();
    for (const key of Object.keys(taken)) {
      draft[key] = structuredClone(fitted[key]);
      this.editedPaths?.add(key);
      this.forget(key);
    }
    fixed.keep(draft);
    this.changed();
    this.tellLost(old);
  }
}
