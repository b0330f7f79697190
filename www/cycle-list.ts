// The cycles of a set-up. The active one is in the form, like a job of one cycle; the others are kept here.

import type { Catalog, Relation } from "./core/browser.js";
import { jobName } from "./core/browser.js";
import {
  type CycleParts,
  complete,
  convertCycleParts,
  type Draft,
  isObject,
} from "./job.js";

/** A cycle of a set-up. */
export interface Feature extends CycleParts {
  name: string;
  /** Whether the user has named it; otherwise its name depends on the cycle type. */
  named: boolean;
  /** Left out of the program. */
  off: boolean;
}

/** A relation: a result computed from results of cycles. */
export interface Related {
  name: string;
  type: Relation["type"];
  of: string[];
  tolerances: Draft;
}

/** State of a set-up besides its cycles. */
export interface SetUpState {
  all: Feature[];
  hand: number;
  clear: number | null;
  datum: Draft;
  relations?: Related[];
}

/** Tolerances by their result codes in the spelling of the plan. A job may spell codes in upper or lower case. */
export const byCode = (tolerances: Draft): Draft =>
  Object.fromEntries(
    Object.entries(tolerances).map(([code, x]) => [
      /^Q\d/i.test(code) ? code : code.toLowerCase(),
      x,
    ]),
  );

/** Entries with a name as a prefix of their keys, and entries that have it, without the prefix. */
const prefixed = (name: string, of: Draft = {}) =>
  Object.entries(of).map(([key, x]) => [`${name}.${key}`, x] as const);
const ofName = (name: string, all: Draft): Draft => {
  const mine = Object.entries(all).filter(([key]) =>
    key.toLowerCase().startsWith(`${name.toLowerCase()}.`),
  );
  return Object.fromEntries(
    mine.map(([key, x]) => [key.slice(name.length + 1), x]),
  );
};
const same = (one: string, other: string) =>
  one.toLowerCase() === other.toLowerCase();
/** Name of the cycle or relation in a path: `BORE` for `BORE.diameter`. */
export const head = (of: string) => of.split(".")[0] ?? of;

/** A cycle whose position, rotation and sizes may follow results of another one, with the new name of that one. */
function following(cycle: Draft, from: string, to: string): Draft {
  const renamed = (x: unknown): unknown => {
    if (Array.isArray(x))
      return x.some((one) => typeof one === "string") ? x.map(renamed) : x;
    const [, equals = "", name, rest] =
      (typeof x === "string" && /^(\s*=\s*)(\w+)(\..*)$/.exec(x)) || [];
    return name !== undefined && same(name, from) ? `${equals}${to}${rest}` : x;
  };
  return Object.fromEntries(
    Object.entries(cycle).map(([key, x]) => [key, renamed(x)]),
  );
}

/** Reads a relation from any value. The check reports its errors. */
function asRelation(given: unknown): Related {
  const { name, type, of, tolerances } = isObject(given) ? given : {};
  const listed = Array.isArray(of) ? of.map(String) : [];
  const own = isObject(tolerances) ? tolerances : {};
  return {
    name: String(name ?? ""),
    type: String(type ?? "") as Related["type"],
    of: listed,
    tolerances: own,
  };
}

const AXES = ["x", "y", "z", "rotation"] as const;
const MOST_NAME = 12;

export class CycleList {
  /** All cycles in their order; empty for a job of one cycle. */
  all: Feature[] = [];
  /** Index of the active cycle. */
  hand = 0;
  /** Height of the clearance plane between the cycles; null is the highest start or end of a cycle. */
  clear: number | null = null;
  /** Source of each axis of the work offset, where the job specifies one. */
  datum: Draft = {};
  /** Relations between results. */
  relations: Related[] = [];

  get several(): boolean {
    return this.all.length > 0;
  }

  /** The job of a form: the form itself if the job has one cycle. */
  compose(form: Draft): Draft {
    if (!this.several) return form;
    const { cycle, part, format: _, tolerances: __, ...rest } = form;
    const listed = this.inOrder(form).filter(({ off }) => !off);
    const sizes = listed.flatMap(({ name, sizes }) => prefixed(name, sizes));
    const cycles = listed.map(({ name, cycle }) => ({ name, ...cycle }));
    const whole: Draft = {
      format: 2,
      ...rest,
      part: { ...(part as Draft), sizes: Object.fromEntries(sizes) },
    };
    const related = this.inProgram();
    const tolerances = [...listed, ...related].flatMap(({ name, tolerances }) =>
      prefixed(name, tolerances),
    );
    return {
      ...whole,
      clear: this.clear,
      datum: this.datum,
      cycles,
      ...(related.length > 0
        ? {
            relations: related.map(({ name, type, of }) => ({
              name,
              type,
              of,
            })),
          }
        : {}),
      ...(tolerances.length > 0
        ? { tolerances: Object.fromEntries(tolerances) }
        : {}),
    };
  }

  /** Relations in the program. A relation of an excluded cycle is excluded too. */
  inProgram(): Related[] {
    const out = new Set(
      this.all.filter(({ off }) => off).map(({ name }) => name.toLowerCase()),
    );
    return this.relations.filter(({ name, of }) => {
      const without = of.some((one) => out.has(head(one).toLowerCase()));
      if (without) out.add(name.toLowerCase());
      return !without;
    });
  }

  /** Lower-case names of these cycles and of the relations that can be computed from them. */
  knownBefore(cycles: string[]): Set<string> {
    const known = new Set(cycles.map((name) => name.toLowerCase()));
    for (const { name, of } of this.relations)
      if (of.every((one) => known.has(head(one).toLowerCase())))
        known.add(name.toLowerCase());
    return known;
  }

  /** All cycles; the active one as the form has it. */
  inOrder({ cycle, part, tolerances }: Draft): Feature[] {
    const sizes = ((part as Draft | undefined)?.sizes ?? {}) as Draft;
    const own = {
      cycle: cycle as Draft,
      sizes,
      tolerances: (tolerances ?? {}) as Draft,
    };
    return this.all.map((one, i) =>
      i === this.hand ? { ...one, ...own } : one,
    );
  }

  /** The last cycle of a type in the job. */
  lastOf(form: Draft, type: unknown): Draft | undefined {
    const all = this.several
      ? this.inOrder(form).map(({ cycle }) => cycle)
      : [form.cycle as Draft];
    return all.findLast((cycle) => cycle.type === type);
  }

  /** Loads a job with several cycles and returns the form of the first one. */
  take(job: Draft, catalog: Catalog): Draft {
    const { cycles, clear, datum, part, relations, tolerances, ...rest } = job;
    const given = isObject(part) && isObject(part.sizes) ? part.sizes : {};
    const limits = isObject(tolerances) ? tolerances : {};
    this.all = [];
    const names = (cycles as Draft[]).flatMap(({ name }) =>
      typeof name === "string" ? [name] : [],
    );
    for (const cycle of cycles as Draft[]) {
      const { name, ...own } = cycle;
      const called =
        typeof name === "string" ? name : this.free(own, -1, names);
      const sizes = ofName(called, given);
      const named = typeof name === "string";
      // A job may omit the name of its only cycle.
      const bare = Object.entries(limits).filter(
        ([key]) => !same(key.slice(0, called.length + 1), `${called}.`),
      );
      const alone =
        (cycles as Draft[]).length === 1 ? Object.fromEntries(bare) : {};
      const limited = byCode({ ...alone, ...ofName(called, limits) });
      const whole = complete(
        { format: 1, units: rest.units, cycle: own },
        catalog,
      ).cycle as Draft;
      this.all.push({
        name: called,
        named,
        cycle: whole,
        sizes,
        tolerances: limited,
        off: false,
      });
    }
    this.relations = Array.isArray(relations)
      ? relations.map(asRelation).map((one) => ({
          ...one,
          tolerances: byCode(ofName(one.name, limits)),
        }))
      : [];
    this.hand = 0;
    this.clear = typeof clear === "number" ? clear : null;
    this.datum = isObject(datum) ? datum : {};
    const first = this.all[0] as Feature;
    const form = {
      ...rest,
      format: 1,
      cycle: first.cycle,
      part: { ...(isObject(part) ? part : {}), sizes: first.sizes },
      tolerances: first.tolerances,
    };
    if (this.all.length < 2) this.alone();
    return form;
  }

  /** A unique name for a cycle. */
  free(cycle: Draft, but = -1, names: string[] = []): string {
    const stem =
      (jobName({ cycle: { type: cycle.type } }).split("-")[0] ?? "").replace(
        /[^A-Za-z0-9]/g,
        "",
      ) || "CYCLE";
    const others = [
      ...this.all.filter((_, i) => i !== but),
      ...this.relations,
    ].map(({ name }) => name);
    const taken = new Set(
      [...others, ...names].map((name) => name.toLowerCase()),
    );
    for (let n = 1; ; n++) {
      const name = `${stem.slice(0, MOST_NAME - 3)}${n === 1 ? "" : n}`;
      if (!taken.has(name.toLowerCase())) return name;
    }
  }

  /** Adds a cycle after the active one. */
  add(
    form: Draft,
    cycle: Draft,
    { sizes = {}, tolerances = {} }: Partial<CycleParts> = {},
  ): void {
    if (!this.several) {
      const first = form.cycle as Draft;
      this.all = [
        {
          name: this.free(first),
          named: false,
          cycle: first,
          sizes: {},
          tolerances: {},
          off: false,
        },
      ];
      this.hand = 0;
    }
    this.storeActive(form);
    this.all.splice(this.hand + 1, 0, {
      name: this.free(cycle),
      named: false,
      cycle,
      sizes,
      tolerances,
      off: false,
    });
  }

  /** Saves the active cycle from the form. */
  storeActive(form: Draft): void {
    this.all = this.inOrder(form);
  }

  /** Makes another cycle active. */
  activate(form: Draft, index: number): void {
    this.storeActive(form);
    const next = this.all[index];
    if (!next) return;
    this.hand = index;
    form.cycle = next.cycle;
    (form.part as Draft).sizes = next.sizes;
    form.tolerances = next.tolerances;
  }

  /** Removes a cycle. An axis that was written from it returns to the proposed source. */
  remove(form: Draft, index: number): void {
    const gone = this.all[index];
    if (!gone) return;
    const next = index === this.hand ? (index > 0 ? index - 1 : 1) : this.hand;
    this.activate(form, next);
    this.all.splice(index, 1);
    if (index < this.hand) this.hand--;
    this.refer(gone.name, null);
    // At least one cycle stays in the program.
    const left = this.all[this.hand];
    if (left && this.all.every(({ off }) => off))
      this.all[this.hand] = { ...left, off: false };
    if (this.all.length < 2) this.alone();
  }

  /** Moves a cycle to another position in the order. */
  move(form: Draft, from: number, to: number): void {
    this.storeActive(form);
    const inHand = this.all[this.hand];
    const [moved] = this.all.splice(from, 1);
    if (moved) this.all.splice(to, 0, moved);
    this.hand = this.all.indexOf(inHand as Feature);
  }

  /** Renames a cycle with every reference to it. */
  rename(form: Draft, index: number, name: string, named: boolean): void {
    this.storeActive(form);
    const one = this.all[index];
    if (!one) return;
    this.all[index] = { ...one, name, named };
    this.refer(one.name, name);
    form.cycle = this.all[this.hand]?.cycle ?? form.cycle;
  }

  /** Updates the name of the active cycle after its type has changed, unless the user has named it. */
  called(form: Draft): void {
    const one = this.all[this.hand];
    if (one && !one.named)
      this.rename(
        form,
        this.hand,
        this.free(form.cycle as Draft, this.hand),
        false,
      );
  }

  /** Adds a relation between these results. */
  relate(type: Related["type"], of: string[]): void {
    const taken = [...this.all, ...this.relations].map(({ name }) =>
      name.toLowerCase(),
    );
    let n = 1;
    while (taken.includes(`rel${n}`)) n++;
    this.relations = [
      ...this.relations,
      { name: `REL${n}`, type, of, tolerances: {} },
    ];
  }

  /** Changes a relation. References to its name change with it. */
  changeRelation(index: number, change: Partial<Related>): void {
    const one = this.relations[index];
    if (!one) return;
    this.relations = this.relations.map((other, i) =>
      i === index ? { ...one, ...change } : other,
    );
    if (change.name !== undefined) this.refer(one.name, change.name);
  }

  /** Removes a relation and the relations that use it. */
  unrelate(index: number): void {
    const gone = this.relations[index];
    this.relations = this.relations.filter((_, i) => i !== index);
    if (gone) this.refer(gone.name, null);
  }

  /**
   * Renames or drops every reference to a cycle or relation. If another entry has the same name, references stay with that one.
   */
  private refer(from: string, to: string | null): void {
    const named = (name: string) =>
      [...this.all, ...this.relations].filter((one) => same(one.name, name))
        .length;
    if (named(from) > 0 || (to !== null && named(to) > 1)) return;
    const is = (one: string) => same(head(one), from);
    const dropped =
      to === null ? this.relations.filter(({ of }) => of.some(is)) : [];
    this.relations = this.relations
      .filter((one) => !dropped.includes(one))
      .map((one) => ({
        ...one,
        of: one.of.map((of) => (is(of) ? `${to}${of.slice(from.length)}` : of)),
      }));
    for (const { name } of dropped) this.refer(name, null);
    // A field that follows a removed cycle is left to the check: only the user knows its value.
    if (to !== null)
      this.all = this.all.map((one) => ({
        ...one,
        cycle: following(one.cycle, from, to),
      }));
    for (const axis of AXES) {
      const said = this.datum[axis];
      if (
        typeof said !== "string" ||
        !said.toLowerCase().startsWith(`${from.toLowerCase()}.`)
      )
        continue;
      const rest = { ...this.datum };
      if (to === null) delete rest[axis];
      else rest[axis] = `${to}${said.slice(from.length)}`;
      this.datum = rest;
    }
  }

  /** Converts all cycles to other units. The active one is converted with the form. */
  convert(from: "mm" | "inch", to: "mm" | "inch"): void {
    this.all = this.all.map((one, i) => {
      if (i === this.hand) return one;
      return { ...one, ...convertCycleParts(to, one, from) };
    });
    const cycle = this.all[0]?.cycle ?? {};
    this.relations = this.relations.map((one) => {
      const { tolerances } = convertCycleParts(
        to,
        { cycle, sizes: {}, tolerances: one.tolerances },
        from,
      );
      return { ...one, tolerances };
    });
    if (this.clear !== null)
      this.clear =
        Math.round(
          (to === "mm" ? this.clear * 25.4 : this.clear / 25.4) * 1e6,
        ) / 1e6;
  }

  /** Index among all cycles of a cycle of the job, which omits excluded ones. */
  placeOf(cycle: number): number {
    let left = cycle;
    return this.all.findIndex(({ off }) => !off && left-- === 0);
  }

  /** Index of the active cycle in the job; after all cycles if it is excluded. */
  get inJob(): number {
    if (this.all[this.hand]?.off) return this.all.length;
    return this.all.slice(0, this.hand).filter(({ off }) => !off).length;
  }

  /** A path of the job as a path of the form. For the active cycle it is the path in a job of one cycle. */
  toFormPath(path: string): string {
    const [, index, rest] = /^cycles\[(\d+)\](.*)$/.exec(path) ?? [];
    if (index !== undefined)
      return this.placeOf(Number(index)) === this.hand ? `cycle${rest}` : path;
    const name = this.all[this.hand]?.name;
    for (const list of ["part.sizes.", "tolerances."])
      if (
        name &&
        path.toLowerCase().startsWith(`${list}${name}.`.toLowerCase())
      )
        return `${list}${path.slice(list.length + name.length + 1)}`;
    return path;
  }

  /** Turns the set-up into a job with one cycle when only one is left. */
  alone(): void {
    this.restoreSnapshot({
      all: [],
      hand: 0,
      clear: null,
      datum: {},
      relations: [],
    });
  }

  state(): SetUpState {
    const { all, hand, clear, datum, relations } = this;
    return structuredClone({ all, hand, clear, datum, relations });
  }

  restoreSnapshot({
    all,
    hand,
    clear,
    datum,
    relations = [],
  }: SetUpState): void {
    // A state that was stored by an earlier version has no tolerances.
    const whole = all.map((one) => ({
      ...one,
      tolerances: one.tolerances ?? {},
    }));
    Object.assign(this, {
      all: whole,
      hand,
      clear,
      datum,
      relations: relations.map(asRelation),
    });
  }

  /** Whether a stored value is a list of cycles. The job that they form is checked separately. */
  static fits(state: unknown): state is SetUpState {
    if (!isObject(state) || !Array.isArray(state.all) || !isObject(state.datum))
      return false;
    const { all, hand, clear, relations } = state;
    if (relations !== undefined && !Array.isArray(relations)) return false;
    const good = (one: unknown) =>
      isObject(one) &&
      typeof one.name === "string" &&
      isObject(one.cycle) &&
      isObject(one.sizes) &&
      typeof one.off === "boolean";
    const numbers =
      Number.isInteger(hand) && (clear === null || typeof clear === "number");
    return (
      numbers &&
      all.every(good) &&
      (hand as number) >= 0 &&
      (hand as number) < Math.max(all.length, 1) &&
      all.length !== 1
    );
  }
}
