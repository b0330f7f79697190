// Rules of the portal: what the page offers, which fields the form shows, and which values are fixed.
import {
  type Config,
  configured,
  convertUnits,
  type Finding,
  judged,
} from "./core/browser.js";
import { type Draft, isObject } from "./job.js";
import type { Preset } from "./presets.js";

type Units = "mm" | "inch";
type Form = "moves" | "cycle";

export class Rules {
  constructor(readonly config: Config | null = null) {}

  /** Whether a cycle or a control is offered. */
  offers(what: "cycles" | "controls", key: string): boolean {
    const { allow, hide } = this.config ?? {};
    return (
      this.allows(allow?.[what], key) &&
      !(hide?.[what] as readonly string[] | undefined)?.includes(key)
    );
  }

  allowsUnits(units: Units): boolean {
    return this.allows(this.config?.allow?.units, units);
  }

  allowsOffset(offset: number | null): boolean {
    return this.allows(this.config?.allow?.workOffsets, offset);
  }

  /** The work offset of a job without one: measuring only, or the first that is allowed. */
  get offset(): number | null {
    const { workOffsets = [null] } = this.config?.allow ?? {};
    return workOffsets.includes(null) ? null : (workOffsets[0] ?? null);
  }

  allowsForm(form: Form): boolean {
    return this.allows(this.config?.allow?.forms, form);
  }

  get allowsSetUps(): boolean {
    return this.config?.allow?.setUps !== false;
  }

  shows(panel: string): boolean {
    return !(
      this.config?.hide?.panels as readonly string[] | undefined
    )?.includes(panel);
  }

  /** Whether the form shows a field. */
  showsField(path: string): boolean {
    return this.of(path)?.hidden !== true;
  }

  /** Whether the user cannot change a field while it has its required value. */
  locks(path: string): boolean {
    return this.of(path)?.locked === true;
  }

  /** The reason in the portal's words; may be empty. */
  reason(path: string): string {
    return this.of(path)?.reason ?? "";
  }

  private of(path: string) {
    return this.config?.fields?.[path.replace(/\[\d\]$/, "")];
  }

  private allows<T>(list: readonly T[] | undefined, one: T): boolean {
    return list === undefined || list.includes(one);
  }

  /** A job with the values that the rules fill in. */
  filled(job: Draft): Draft {
    return this.config ? configured(job, this.config) : job;
  }

  /** Units of a new job: these, unless the rules do not allow them. */
  units(units: Units): Units {
    return this.allowsUnits(units)
      ? units
      : (this.config?.allow?.units?.[0] ?? units);
  }

  /** A new job filled in by the rules for its cycle and sections. A requested control stays. */
  laid(job: Draft, asked = false): Draft {
    if (!this.config) return job;
    const { type } = job.cycle as Draft;
    const { post, form, ...rest } = job.control as Draft;
    const { allow, fields } = this.config;
    const said = ["post", "form"].some(
      (key) => fields?.[`control.${key}`]?.value !== undefined,
    );
    const stays =
      asked ||
      (!said &&
        this.allows(allow?.controls as unknown[], post) &&
        this.allowsForm(form as Form));
    const bare = {
      format: 1,
      units: job.units,
      cycle: { type },
      ...(stays ? { control: { post, form } } : {}),
    };
    const filled = this.filled(bare);
    // The chosen control may not have the form of the default one.
    const control = stays ? job.control : { ...rest, form: "moves" };
    return over({ ...job, control }, filled) as Draft;
  }

  /** Type of a first job: the first that is allowed and offered. */
  firstOf(types: string[]): string | undefined {
    const { cycles } = this.config?.allow ?? {};
    return (cycles ?? types).find((type) => this.offers("cycles", type));
  }

  /** Fields that the user cannot change. `bare`: only those without their required value. */
  locked(bare = false): string[] {
    const all = Object.entries(this.config?.fields ?? {});
    return all.flatMap(([path, rule]) =>
      rule.locked && !(bare && rule.value !== undefined) ? [path] : [],
    );
  }

  /** Errors and remarks of the portal's rules about a job. */
  judged(job: Draft): Finding[] {
    return this.config ? judged(job, this.config) : [];
  }

  /** The offered machines. */
  get machines(): Preset[] {
    return (this.config?.machines ?? []).map(
      ({ name, overtravel, ...sections }) => ({
        name,
        units: this.config?.units ?? "mm",
        ...(overtravel === undefined ? {} : { overtravel }),
        sections,
      }),
    );
  }

  /** The offered styli, in the units of a job. */
  styli(units: Units): { name: string; stylus: Draft }[] {
    const own = this.config?.units ?? "mm";
    return (this.config?.styli ?? []).map(({ name, ...stylus }) => {
      const job = convertUnits(
        { format: 1, units: own, stylus },
        units,
      ) as unknown as { stylus: Draft };
      return { name, stylus: job.stylus };
    });
  }
}

/** Values of one object over those of another. */
function over(under: unknown, said: unknown): unknown {
  if (!isObject(under) || !isObject(said)) return said;
  const entries = Object.entries(said).map(([key, value]) => [
    key,
    key in under ? over(under[key], value) : value,
  ]);
  return { ...under, ...Object.fromEntries(entries) };
}
