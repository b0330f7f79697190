// The cycles of a set-up. The one in hand stands in the form, as a job of one cycle does; the others wait here.

import type { Catalog } from "./core/browser.js";
import { jobName } from "./core/browser.js";
import { complete, type Draft, formIn, isObject } from "./job.js";

/** A cycle of a set-up. */
export interface Feature {
  name: string;
  /** Whether somebody has named it; else it is called by what it measures. */
  named: boolean;
  cycle: Draft;
  /** How much larger the sizes of the virtual part are. */
  sizes: Draft;
  /** Left out of the program. */
  off: boolean;
}

/** What a set-up has beside its cycles. */
export interface SetUpState {
  all: Feature[];
  hand: number;
  clear: number | null;
  datum: Draft;
}

const AXES = ["x", "y", "z", "rotation"] as const;
const MOST_NAME = 12;

export class Features {
  /** All cycles in their order; empty for a job of one cycle. */
  all: Feature[] = [];
  /** Which of them stands in the form. */
  hand = 0;
  /** Height between the cycles; null is as high as the highest begins and ends. */
  clear: number | null = null;
  /** What is written into which axis, where the job says it. */
  datum: Draft = {};

  get several(): boolean {
    return this.all.length > 0;
  }

  /** The job of a form: of one cycle the form itself. */
  compose(form: Draft): Draft {
    if (!this.several) return form;
    const { cycle, part, format: _, ...rest } = form;
    const listed = this.inOrder(form).filter(({ off }) => !off);
    const sizes = listed.flatMap(({ name, sizes }) => Object.entries(sizes).map(([key, x]) => [`${name}.${key}`, x]));
    const cycles = listed.map(({ name, cycle }) => ({ name, ...cycle }));
    const whole: Draft = { format: 2, ...rest, part: { ...(part as Draft), sizes: Object.fromEntries(sizes) } };
    return { ...whole, clear: this.clear, datum: this.datum, cycles };
  }

  /** All of them, the one in hand as the form has it. */
  inOrder({ cycle, part }: Draft): Feature[] {
    const sizes = ((part as Draft | undefined)?.sizes ?? {}) as Draft;
    return this.all.map((one, i) => (i === this.hand ? { ...one, cycle: cycle as Draft, sizes } : one));
  }

  /** Takes a job of several cycles, and gives the form of the first of them. */
  take(job: Draft, catalog: Catalog): Draft {
    const { cycles, clear, datum, part, ...rest } = job;
    const given = isObject(part) && isObject(part.sizes) ? part.sizes : {};
    this.all = [];
    const names = (cycles as Draft[]).flatMap(({ name }) => (typeof name === "string" ? [name] : []));
    for (const cycle of cycles as Draft[]) {
      const { name, ...own } = cycle;
      const called = typeof name === "string" ? name : this.free(own, -1, names);
      const mine = Object.entries(given).filter(([key]) => key.toLowerCase().startsWith(`${called.toLowerCase()}.`));
      const sizes = Object.fromEntries(mine.map(([key, x]) => [key.slice(called.length + 1), x]));
      const whole = complete({ format: 1, units: rest.units, cycle: own }, catalog).cycle as Draft;
      this.all.push({ name: called, named: typeof name === "string", cycle: whole, sizes, off: false });
    }
    this.hand = 0;
    this.clear = typeof clear === "number" ? clear : null;
    this.datum = isObject(datum) ? datum : {};
    const first = this.all[0] as Feature;
    const form = {
      ...rest,
      format: 1,
      cycle: first.cycle,
      part: { ...(isObject(part) ? part : {}), sizes: first.sizes },
    };
    if (this.all.length < 2) this.alone();
    return form;
  }

  /** A name for a cycle that no other has. */
  free(cycle: Draft, but = -1, names: string[] = []): string {
    const stem = (jobName({ cycle: { type: cycle.type } }).split("-")[0] ?? "").replace(/[^A-Za-z0-9]/g, "") || "CYCLE";
    const others = this.all.filter((_, i) => i !== but).map(({ name }) => name);
    const taken = new Set([...others, ...names].map((name) => name.toLowerCase()));
    for (let n = 1; ; n++) {
      const name = `${stem.slice(0, MOST_NAME - 3)}${n === 1 ? "" : n}`;
      if (!taken.has(name.toLowerCase())) return name;
    }
  }

  /** Adds a cycle behind the one in hand. */
  add(form: Draft, cycle: Draft, sizes: Draft = {}): void {
    if (!this.several) {
      const first = form.cycle as Draft;
      this.all = [{ name: this.free(first), named: false, cycle: first, sizes: {}, off: false }];
      this.hand = 0;
    }
    this.stow(form);
    this.all.splice(this.hand + 1, 0, { name: this.free(cycle), named: false, cycle, sizes, off: false });
  }

  /** Keeps what the form has of the one in hand. */
  stow(form: Draft): void {
    this.all = this.inOrder(form);
  }

  /** Puts another one into the form. */
  bring(form: Draft, index: number): void {
    this.stow(form);
    const next = this.all[index];
    if (!next) return;
    this.hand = index;
    form.cycle = next.cycle;
    (form.part as Draft).sizes = next.sizes;
  }

  /** Takes one out. What was written from it is proposed anew. */
  remove(form: Draft, index: number): void {
    const gone = this.all[index];
    if (!gone) return;
    const next = index === this.hand ? (index > 0 ? index - 1 : 1) : this.hand;
    this.bring(form, next);
    this.all.splice(index, 1);
    if (index < this.hand) this.hand--;
    this.refer(gone.name, null);
    // One stays in the program.
    const left = this.all[this.hand];
    if (left && this.all.every(({ off }) => off)) this.all[this.hand] = { ...left, off: false };
    if (this.all.length < 2) this.alone();
  }

  /** Moves one to another place in the order. */
  move(form: Draft, from: number, to: number): void {
    this.stow(form);
    const inHand = this.all[this.hand];
    const [moved] = this.all.splice(from, 1);
    if (moved) this.all.splice(to, 0, moved);
    this.hand = this.all.indexOf(inHand as Feature);
  }

  /** Another name, and whatever is written from it. */
  rename(index: number, name: string, named: boolean): void {
    const one = this.all[index];
    if (!one) return;
    this.all[index] = { ...one, name, named };
    this.refer(one.name, name);
  }

  /** The one in hand measures something else now: it is called so, where nobody has named it. */
  called(cycle: Draft): void {
    const one = this.all[this.hand];
    if (one && !one.named) this.rename(this.hand, this.free(cycle, this.hand), false);
  }

  /** What is written from a cycle is written from it by its new name, or from none. A name that another one has, too, is that one's. */
  private refer(from: string, to: string | null): void {
    if (this.all.some(({ name }) => name.toLowerCase() === from.toLowerCase())) return;
    for (const axis of AXES) {
      const said = this.datum[axis];
      if (typeof said !== "string" || !said.toLowerCase().startsWith(`${from.toLowerCase()}.`)) continue;
      const rest = { ...this.datum };
      if (to === null) delete rest[axis];
      else rest[axis] = `${to}${said.slice(from.length)}`;
      this.datum = rest;
    }
  }

  /** All of them in other units; the one in hand is converted with the form. */
  convert(from: "mm" | "inch", to: "mm" | "inch"): void {
    this.all = this.all.map((one, i) => {
      if (i === this.hand) return one;
      const [cycle, sizes] = formIn(to, one.cycle, one.sizes, from);
      return { ...one, cycle, sizes };
    });
    if (this.clear !== null) this.clear = Math.round((to === "mm" ? this.clear * 25.4 : this.clear / 25.4) * 1e6) / 1e6;
  }

  /** The place among all of a cycle of the job, which has none that is left out. */
  placeOf(cycle: number): number {
    let left = cycle;
    return this.all.findIndex(({ off }) => !off && left-- === 0);
  }

  /** The place in the job of the one in hand; behind all of them where it is left out. */
  get inJob(): number {
    if (this.all[this.hand]?.off) return this.all.length;
    return this.all.slice(0, this.hand).filter(({ off }) => !off).length;
  }

  /** A path of the job as the form has it: of the one in hand that of a job of one cycle. */
  inForm(path: string): string {
    const [, index, rest] = /^cycles\[(\d+)\](.*)$/.exec(path) ?? [];
    if (index !== undefined) return this.placeOf(Number(index)) === this.hand ? `cycle${rest}` : path;
    const name = this.all[this.hand]?.name;
    return name && path.startsWith(`part.sizes.${name}.`) ? `part.sizes.${path.slice(12 + name.length)}` : path;
  }

  /** One cycle is left: a job of one cycle. */
  alone(): void {
    this.become({ all: [], hand: 0, clear: null, datum: {} });
  }

  state(): SetUpState {
    const { all, hand, clear, datum } = this;
    return structuredClone({ all, hand, clear, datum });
  }

  become({ all, hand, clear, datum }: SetUpState): void {
    Object.assign(this, { all, hand, clear, datum });
  }

  /** Whether something kept is a list of cycles; the job that they make is checked beside. */
  static fits(state: unknown): state is SetUpState {
    if (!isObject(state) || !Array.isArray(state.all) || !isObject(state.datum)) return false;
    const { all, hand, clear } = state;
    const good = (one: unknown) =>
      isObject(one) &&
      typeof one.name === "string" &&
      isObject(one.cycle) &&
      isObject(one.sizes) &&
      typeof one.off === "boolean";
    const numbers = Number.isInteger(hand) && (clear === null || typeof clear === "number");
    return (
      numbers &&
      all.every(good) &&
      (hand as number) >= 0 &&
      (hand as number) < Math.max(all.length, 1) &&
      all.length !== 1
    );
  }
}
