// Reads the module's numbers and texts in the order in which src/border/packed.rs writes them.
import type { Message } from "./said.js";
import type { Vec3 } from "./types.js";

/** Output of the module. */
export interface Packed {
  numbers: Float64Array;
  text: string;
}

/** Reads numbers and texts in their order. */
export class Unpacked {
  constructor(
    private readonly packed: Packed,
    private at = 0,
    private textAt = 0,
  ) {}

  /** Start of a section. */
  static section(packed: Packed, section: number): Unpacked {
    return new Unpacked(
      packed,
      packed.numbers[2 * section],
      packed.numbers[2 * section + 1],
    );
  }

  number(): number {
    return this.packed.numbers[this.at++] ?? Number.NaN;
  }

  /** NaN means absent. */
  optional(): number | null {
    const x = this.number();
    return Number.isNaN(x) ? null : x;
  }

  flag(): boolean | null {
    const x = this.optional();
    return x === null ? null : x === 1;
  }

  yes(): boolean {
    return this.number() === 1;
  }

  /** An index; −1 is none. */
  index(): number | null {
    const n = this.number();
    return n < 0 ? null : n;
  }

  /** Skips a −1, which means absent, and returns whether it was there. */
  isNone(): boolean {
    const none = this.packed.numbers[this.at] === -1;
    if (none) this.at++;
    return none;
  }

  textOrNone(): string | null {
    const length = this.index();
    if (length === null) return null;
    this.textAt += length;
    return this.packed.text.slice(this.textAt - length, this.textAt);
  }

  text(): string {
    return this.textOrNone() ?? "";
  }

  /** A message: number of values, template, values. */
  said(): Message {
    return this.saidOrNone() ?? [""];
  }

  saidOrNone(): Message | null {
    const count = this.index();
    if (count === null) return null;
    const said: Message = [this.text()];
    for (let left = count; left > 0; left--)
      said.push(this.saidOrNone() ?? this.text());
    return said;
  }

  word<Word>(words: readonly Word[]): Word {
    return words[this.number()] as Word;
  }

  triple(): Vec3 {
    return [this.number(), this.number(), this.number()];
  }

  count(): number {
    return this.number();
  }

  pair(): [number, number] | null {
    const [low, high] = [this.number(), this.number()];
    return Number.isNaN(low) ? null : [low, high];
  }

  counts(): number[] {
    return this.list(() => this.number());
  }

  numbers(): number[] {
    return this.counts();
  }

  texts(): string[] {
    return this.list(() => this.text());
  }

  list<Item>(item: () => Item): Item[] {
    const items: Item[] = [];
    for (let left = this.number(); left > 0; left--) items.push(item());
    return items;
  }

  /** Groups of five numbers, up to a −1. */
  fives(): Float64Array {
    const from = this.at;
    while (this.index() !== null) this.at += 4;
    return this.packed.numbers.subarray(from, this.at - 1);
  }

  /** A number of values in a row. */
  column(count: number): Float64Array {
    this.at += count;
    return this.packed.numbers.subarray(this.at - count, this.at);
  }
}
