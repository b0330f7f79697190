// Generated from src/border: `UPDATE=1 cargo test --lib generated` writes it. How jobs and plans cross to the module and back.
import type { Unpacked } from "./unpacked.js";

/** Maximum number of values in a job, their maximum depth, and the maximum length of all its texts together in UTF-16 units. */
export const MOST_VALUES = 20000;
export const DEEPEST = 16;
export const MOST_TEXT = 2000000;

/** Tags of values. */
export const NULL = 0;
export const FALSE = 1;
export const TRUE = 2;
export const NUMBER = 3;
export const TEXT = 4;
export const LIST = 5;
export const MAP = 6;
export const OTHER = 7;

/** Kinds of values that a job cannot have. */
export const UNDEFINED = 0;
export const NO_DATA = 1;
export const UNREADABLE = 2;
export const TOO_DEEP = 3;
export const TOO_MANY = 4;
export const TOO_MUCH_TEXT = 5;
export const TOO_LONG = 6;
export const TOO_MANY_KEYS = 7;

/** Sections of a plan. */
export const TOUCHES = 0;
export const MOVES = 1;
export const PROGRAM = 2;
export const RESULTS = 3;
export const TRIGGERS = 4;
export const FINDINGS = 5;
export const SAFETY = 6;
export const SECTIONS = 7;

/** Words that are passed as their index in these lists. */
export const FEEDS = ["approach", "longLink", "work", "retract", "return", "rapid"] as const;
export const KINDS = ["position", "touch", "back"] as const;
export const UNITS = ["mm", "inch", "deg", ""] as const;
export const LEVELS = ["error", "warning", "info"] as const;

/** Rows of a plan, field by field. */
export const touch = (r: Unpacked) => ({ point: r.triple(), vector: r.triple(), group: r.count(), cycle: r.count() });
export const program = (r: Unpacked) => ({
  post: r.text(),
  extension: r.text(),
  text: r.text(),
  moveLines: r.numbers(),
  writes: r.texts(),
  said: r.said(),
  own: r.yes(),
});
export const proof = (r: Unpacked) => ({ moves: r.count(), touches: r.count(), arithmetic: r.yes() });
export const datum = (r: Unpacked) => ({ axis: r.text(), from: r.textOrNone(), choices: r.texts() });
export const result = (r: Unpacked) => ({
  code: r.text(),
  meaning: r.said(),
  unit: r.word(UNITS),
  nominal: r.optional(),
  value: r.optional(),
  deviation: r.optional(),
  uncertainty: r.optional(),
  uncertaintyRunout: r.optional(),
  limits: r.pair(),
  verdict: r.saidOrNone(),
  truth: r.optional(),
  note: r.saidOrNone(),
  stored: r.textOrNone(),
  cycle: r.count(),
});
export const finding = (r: Unpacked) => ({ level: r.word(LEVELS), code: r.text(), path: r.text(), said: r.said() });
export const safety = (r: Unpacked) => ({
  rule: r.text(),
  holds: r.flag(),
  said: r.said(),
  lines: r.counts(),
  about: r.counts(),
});
