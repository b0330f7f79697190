// Unpacks a plan from the module's numbers and text: counterpart of src/border/packed.rs. Each section is unpacked on first access.
import * as layout from "./layout.js";
import {
  FEEDS,
  FINDINGS,
  KINDS,
  MOVES,
  PROGRAM,
  RESULTS,
  SAFETY,
  SECTIONS,
  TOUCHES,
  TRIGGERS,
} from "./layout.js";
import { type Message, say } from "./said.js";
import type {
  DatumRow,
  Finding,
  FindingCode,
  Move,
  ParameterRow,
  Plan,
  ProgramText,
  ResultCode,
  ResultRow,
  RuleName,
  SafetyRow,
  Vec3,
  Verdict,
} from "./types.js";
import { type Packed, Unpacked } from "./unpacked.js";

/** Columns of the moves. */
export function columns(packed: Packed) {
  const r = Unpacked.section(packed, MOVES);
  const count = r.number();
  return {
    to: r.column(3 * count),
    feed: r.column(count),
    kind: r.column(count),
    step: r.column(count),
    touch: r.column(count),
    cycle: r.column(count),
    arcs: r,
  };
}

function moves(packed: Packed): Move[] {
  const { to, feed, kind, step, touch, cycle, arcs } = columns(packed);
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
      cycle: cycle[i] as number,
    });
  }
  for (let i = arcs.index(); i !== null; i = arcs.index()) {
    (made[i] as Move).arc = { center: arcs.triple(), sweep: arcs.number() };
  }
  return made;
}

function programAt(r: Unpacked): ProgramText {
  const { writes, ...rest } = layout.program(r);
  const proof = r.isNone() ? null : layout.proof(r);
  return {
    ...rest,
    writes: writes as ProgramText["writes"],
    does: say(rest.said),
    proof,
  };
}

function result(r: Unpacked): ResultRow {
  const { meaning, verdict, note, code, ...numbers } = layout.result(r);
  return {
    ...numbers,
    code: code as ResultCode,
    meaning: say(meaning),
    verdict: verdict && (say(verdict) as Verdict),
    note: note && say(note),
    said: { meaning, verdict, note },
  };
}

function datum(r: Unpacked): DatumRow {
  const { axis, ...row } = layout.datum(r);
  return { ...row, axis: axis as DatumRow["axis"] };
}

function trigger(r: Unpacked): Vec3 | null {
  const place = r.triple();
  return Number.isNaN(place[0]) ? null : place;
}

function finding(r: Unpacked): Finding {
  const { code, ...row } = layout.finding(r);
  return { ...row, code: code as FindingCode, message: say(row.said) };
}

function safety(r: Unpacked): SafetyRow {
  const { rule, ...row } = layout.safety(r);
  return { ...row, rule: rule as RuleName, message: say(row.said) };
}

/** Rows of a parameter table. */
export function tableOf(packed: Packed): ParameterRow[] {
  const r = new Unpacked(packed);
  return r.list(() => {
    const [code, type] = [r.text(), r.text()];
    const kind = r.number();
    const value =
      kind === 0 ? r.number() : kind === 1 ? r.flag() === true : r.text();
    return {
      code,
      type,
      value,
      meaning: r.text(),
      field: r.textOrNone(),
      touch: r.index(),
      cycle: r.number(),
    };
  });
}

/** Meanings of its rows, in order. */
export function meaningsOf(packed: Packed): Message[] {
  const r = new Unpacked(packed);
  return r.list(() => r.said());
}

/** The program alone. */
export const programOf = (packed: Packed): ProgramText =>
  programAt(Unpacked.section(packed, PROGRAM));

/** The findings alone. */
export function findingsOf(packed: Packed): Finding[] {
  const r = Unpacked.section(packed, FINDINGS);
  return r.list(() => finding(r));
}

/** A value that is computed on first access. A caller that changes it changes only its copy. */
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

/** The plan. Readers see a plain object with its sections as properties; each is unpacked on first access. `table` is requested from the module separately. */
export function planOf(packed: Packed, table: () => ParameterRow[]): Plan {
  const list = <Item>(section: number, item: (r: Unpacked) => Item) =>
    new Part(() => {
      const r = Unpacked.section(packed, section);
      return r.list(() => item(r));
    });
  const touches = list(TOUCHES, layout.touch);
  const allMoves = new Part(() => moves(packed));
  const text = new Part(() => programOf(packed));
  const rows = new Part(table);
  const results = list(RESULTS, result);
  const triggers = list(TRIGGERS, trigger);
  const findings = list(FINDINGS, finding);
  const rules = list(SAFETY, safety);
  const r = new Unpacked(packed, 2 * SECTIONS);
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
    cycles: r.texts(),
    relations: r.texts(),
    datum: r.list(() => datum(r)),
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
  // Output of Node's console: the sections instead of getters.
  return Object.defineProperty(plan, INSPECT, { value: () => ({ ...plan }) });
}

const INSPECT = Symbol.for("nodejs.util.inspect.custom");
