// A plan out of the module's numbers and text: the other half of src/wasm/output.rs. Each section is made when it is read for the first time.
import { type Said, say } from "./said.js";
import type {
  Finding,
  FindingCode,
  Level,
  Move,
  ParameterRow,
  Plan,
  ProgramText,
  ResultCode,
  ResultRow,
  RuleName,
  SafetyRow,
  TouchPoint,
  Vec3,
  Verdict,
} from "./types.js";

/** What the module hands out. */
export interface Packed {
  numbers: Float64Array;
  text: string;
}

/** Words that come as their places in these lists, as in src/wasm/output.rs. */
export const FEEDS: readonly Move["feed"][] = ["approach", "longLink", "work", "retract", "return", "rapid"];
export const KINDS: readonly Move["kind"][] = ["position", "touch", "back"];
const UNITS: readonly ResultRow["unit"][] = ["mm", "inch", "deg", ""];
const LEVELS: readonly Level[] = ["error", "warning", "info"];

const [TOUCHES, MOVES, PROGRAM, RESULTS, TRIGGERS, FINDINGS, SAFETY, SECTIONS] = [0, 1, 2, 3, 4, 5, 6, 7] as const;

/** Reads numbers and texts in their order. */
class Reader {
  constructor(
    private readonly packed: Packed,
    private at = 0,
    private textAt = 0,
  ) {}

  /** The beginning of a section. */
  static section(packed: Packed, section: number): Reader {
    return new Reader(packed, packed.numbers[2 * section], packed.numbers[2 * section + 1]);
  }

  number(): number {
    return this.packed.numbers[this.at++] ?? Number.NaN;
  }

  /** What is not there is NaN. */
  optional(): number | null {
    const x = this.number();
    return Number.isNaN(x) ? null : x;
  }

  flag(): boolean | null {
    const x = this.optional();
    return x === null ? null : x === 1;
  }

  /** An index; −1 is none. */
  index(): number | null {
    const n = this.number();
    return n < 0 ? null : n;
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

  /** What is said: a count of values, the template, the values. */
  said(): Said {
    return this.saidOrNone() ?? [""];
  }

  saidOrNone(): Said | null {
    const count = this.index();
    if (count === null) return null;
    const said: Said = [this.text()];
    for (let left = count; left > 0; left--) said.push(this.saidOrNone() ?? this.text());
    return said;
  }

  word<Word>(words: readonly Word[]): Word {
    return words[this.number()] as Word;
  }

  triple(): Vec3 {
    return [this.number(), this.number(), this.number()];
  }

  list<Item>(item: () => Item): Item[] {
    const items: Item[] = [];
    for (let left = this.number(); left > 0; left--) items.push(item());
    return items;
  }

  /** Numbers five by five, as they lie there, up to a −1. */
  fives(): Float64Array {
    const from = this.at;
    while (this.index() !== null) this.at += 4;
    return this.packed.numbers.subarray(from, this.at - 1);
  }

  /** So many numbers as they lie there. */
  column(count: number): Float64Array {
    this.at += count;
    return this.packed.numbers.subarray(this.at - count, this.at);
  }
}

const touch = (r: Reader): TouchPoint => ({ point: r.triple(), vector: r.triple(), group: r.number() });

/** The moves, column by column as they come. */
export function columns(packed: Packed) {
  const r = Reader.section(packed, MOVES);
  const count = r.number();
  return {
    to: r.column(3 * count),
    feed: r.column(count),
    kind: r.column(count),
    step: r.column(count),
    touch: r.column(count),
    arcs: r,
  };
}

function moves(packed: Packed): Move[] {
  const { to, feed, kind, step, touch, arcs } = columns(packed);
  const made: Move[] = [];
  for (let i = 0; i < step.length; i++) {
    const own = touch[i] as number;
    made.push({
      to: [to[3 * i], to[3 * i + 1], to[3 * i + 2]] as Vec3,
      feed: FEEDS[feed[i] as number] as Move["feed"],
      kind: KINDS[kind[i] as number] as Move["kind"],
      step: step[i] as number,
      touch: own < 0 ? null : own,
      arc: null,
    });
  }
  for (let i = arcs.index(); i !== null; i = arcs.index()) {
    (made[i] as Move).arc = { center: arcs.triple(), sweep: arcs.number() };
  }
  return made;
}

function program(r: Reader): ProgramText {
  const [post, extension, text] = [r.text(), r.text(), r.text()];
  const moveLines = r.list(() => r.number());
  const writes = r.list(() => r.text() as ProgramText["writes"][number]);
  const said = r.said();
  const moves = r.index();
  const proof = moves === null ? null : { moves, touches: r.number(), arithmetic: r.flag() === true };
  return { post, extension, text, moveLines, writes, does: say(said), said, proof };
}

function result(r: Reader): ResultRow {
  const code = r.text();
  const meaning = r.said();
  const unit = r.word(UNITS);
  const [nominal, value, deviation] = [r.optional(), r.optional(), r.optional()];
  const [uncertainty, uncertaintyRunout] = [r.optional(), r.optional()];
  const [low, high] = [r.optional(), r.optional()];
  const verdict = r.saidOrNone();
  const truth = r.optional();
  const note = r.saidOrNone();
  return {
    code: code as ResultCode,
    meaning: say(meaning),
    unit,
    nominal,
    value,
    deviation,
    uncertainty,
    uncertaintyRunout,
    limits: low === null || high === null ? null : [low, high],
    verdict: verdict && (say(verdict) as Verdict),
    truth,
    note: note && say(note),
    said: { meaning, verdict, note },
  };
}

function trigger(r: Reader): Vec3 | null {
  const place = r.triple();
  return Number.isNaN(place[0]) ? null : place;
}

function finding(r: Reader): Finding {
  const [level, code, path, said] = [r.word(LEVELS), r.text() as FindingCode, r.text(), r.said()];
  return { level, code, path, message: say(said), said };
}

function safety(r: Reader): SafetyRow {
  const [rule, holds, said] = [r.text() as RuleName, r.flag(), r.said()];
  const [lines, about] = [r.list(() => r.number()), r.list(() => r.number())];
  return { rule, holds, message: say(said), said, lines, about };
}

/** The rows of a parameter table. */
export function tableOf(packed: Packed): ParameterRow[] {
  const r = new Reader(packed);
  return r.list(() => {
    const [code, type] = [r.text(), r.text()];
    const kind = r.number();
    const value = kind === 0 ? r.number() : kind === 1 ? r.flag() === true : r.text();
    return { code, type, value, meaning: r.text(), field: r.textOrNone(), touch: r.index() };
  });
}

/** What its rows mean, in their order. */
export function meaningsOf(packed: Packed): Said[] {
  const r = new Reader(packed);
  return r.list(() => r.said());
}

/** The program alone. */
export const programOf = (packed: Packed): ProgramText => program(Reader.section(packed, PROGRAM));

/** The findings alone. */
export function findingsOf(packed: Packed): Finding[] {
  const r = Reader.section(packed, FINDINGS);
  return r.list(() => finding(r));
}

/** What is made once, when it is first read; whoever writes to it has their own. */
class Part<T> {
  private made: { value: T } | undefined;
  constructor(private readonly make: () => T) {}
  get(): T {
    this.made ??= { value: this.make() };
    return this.made.value;
  }
  set(value: T): void {
    this.made = { value };
  }
}

/**
 * The plan. To every reader it is a plain object, whose sections are properties like any other; only their making waits. The table is not in
 * what the module handed out: `table` fetches it.
 */
export function planOf(packed: Packed, table: () => ParameterRow[]): Plan {
  const list = <Item>(section: number, item: (r: Reader) => Item) =>
    new Part(() => {
      const r = Reader.section(packed, section);
      return r.list(() => item(r));
    });
  const touches = list(TOUCHES, touch);
  const allMoves = new Part(() => moves(packed));
  const text = new Part(() => programOf(packed));
  const rows = new Part(table);
  const results = list(RESULTS, result);
  const triggers = list(TRIGGERS, trigger);
  const findings = list(FINDINGS, finding);
  const rules = list(SAFETY, safety);
  const r = new Reader(packed, 2 * SECTIONS);
  const plan: Plan = {
    get touches() {
      return touches.get();
    },
    set touches(value) {
      touches.set(value);
    },
    get moves() {
      return allMoves.get();
    },
    set moves(value) {
      allMoves.set(value);
    },
    length: r.number(),
    time: r.number(),
    get program() {
      return text.get();
    },
    set program(value) {
      text.set(value);
    },
    get table() {
      return rows.get();
    },
    set table(value) {
      rows.set(value);
    },
    get results() {
      return results.get();
    },
    set results(value) {
      results.set(value);
    },
    get triggers() {
      return triggers.get();
    },
    set triggers(value) {
      triggers.set(value);
    },
    get findings() {
      return findings.get();
    },
    set findings(value) {
      findings.set(value);
    },
    get safety() {
      return rules.get();
    },
    set safety(value) {
      rules.set(value);
    },
  };
  // What a console shows of it, in Node: the sections, not that they are getters.
  return Object.defineProperty(plan, INSPECT, { value: () => ({ ...plan }) });
}

const INSPECT = Symbol.for("nodejs.util.inspect.custom");
