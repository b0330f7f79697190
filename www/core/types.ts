/** Lengths are in the job's units, feeds in units a minute, angles in degrees, counter-clockwise positive. */

import type { FrameStep, Job, SetUp, Vec3 } from "./job-types.js";
import type { Finding, ProgramText, TraceRow } from "./plan-types.js";
import type { PROGRAM_POSTS } from "./program-posts.js";

export type * from "./config-types.js";
export type * from "./job-types.js";
export type * from "./plan-types.js";

import type { Message } from "./said.js";

export type { Message, Words } from "./said.js";
/** Former name of {@link Message}. @deprecated Use `Message`. */
export type Said = Message;

/** The moves as typed arrays: three numbers of `to` a move; `feed` and `kind` index into `feeds` and `kinds`; no touch is −1. */
export interface MoveColumns {
  to: Float64Array;
  feed: Uint8Array;
  kind: Uint8Array;
  step: Uint8Array;
  touch: Int32Array;
  /** Index of the cycle of a set-up, 0 for a job of one cycle. */
  cycle: Uint8Array;
  /** Five numbers an arc: index of its move, centre X, Y, Z, and degrees about the tool axis, counter-clockwise positive. */
  arcs: Float64Array;
  feeds: string[];
  kinds: string[];
}

/** How a program is written. */
export type Dialect = "iso" | "sinumerik" | "klartext";

/** The moves of any program, column by column, in the units that it states first. Nothing is proven of what is read so. */
export interface ProgramMoves {
  /** What it was read as. */
  dialect: Dialect;
  /** The control that it was read for: the one that was told, or the one that its words show; `null` is any with G codes. */
  post: ProgramPost | null;
  /** `null` where the program does not say. */
  units: "mm" | "inch" | null;
  plane: "G17" | "G18" | "G19";
  /** Three numbers a move; `NaN` along an axis whose place is not known. */
  to: Float64Array;
  /** Index into `kinds`. */
  kind: Uint8Array;
  /** Units a minute; `NaN` for a rapid, or where none was stated. */
  feed: Float64Array;
  /** The 0-based line of each move. */
  line: Uint32Array;
  /** Six numbers an arc: index of its move, centre X, Y, Z, degrees, counter-clockwise positive, and its plane: 17, 18 or 19. */
  arcs: Float64Array;
  /** `rapid`, `feed`, `probe`. */
  kinds: string[];
  /** What was ignored, and what could not be known. */
  findings: Finding[];
}

/** A part to probe: a job, of which its cycle's feature, its virtual part, its stylus and its units count. What probing moves meet of it is computed. */
export type ProgramPart = Partial<Omit<Job, "cycle">> & { cycle: Job["cycle"] };

/** A control that a program can be read for. */
export type ProgramPost = (typeof PROGRAM_POSTS)[number];

/** What is known of a program beside its text. */
export interface ProgramKnown {
  /** Without it, the text decides. */
  dialect?: Dialect;
  /** The control that the program is for: it decides what moves the coordinate system, and the dialect. Without it, the text decides. */
  post?: ProgramPost;
  /** `0`: every work offset, shift and tool length that nothing sets is 0. Left out: they are not known, but for those that `set` names by their variables. */
  offsets?: 0;
  /** Values of variables, by their names in the text: `{ "#3014": 5, "#<_name>": 1 }`. What the text itself sets counts from there on. */
  set?: Record<string, number>;
  /** The position of the stylus before the first block, in the units that the program states first and in the coordinate system of the first move; `null` along an axis where that is not known. */
  start?: [number | null, number | null, number | null];
  /** Where probing moves trigger: the fraction of its way at which a touch, and a positioning move that is watched, makes contact; `null`: never; left out: not known. */
  part?: { at?: number | null; positioning?: number | null } | ProgramPart;
  /** Texts with subprograms, by their names. */
  files?: Record<string, string>;
}

/** A program's moves as it runs with what is known. A touch ends where its block says; `contacts` is where it triggered, and the next move begins there. */
export interface ProgramRun extends Omit<ProgramMoves, "findings"> {
  /** The text of each move, whose `line` counts in it: 0 is the program, others are `files` in their order, from 1. Empty where there are none. */
  file: Uint32Array;
  /** Four numbers a contact: the index of its move, and the place X, Y, Z. */
  contacts: Float64Array;
  /** Four numbers a move that does not begin where the one before ended: its index, and the place where it begins; NaN is not known. A condition that is not known has two ways: both begin where they part. */
  resumes: Float64Array;
  /** Five numbers where the coordinate system moves: the index of the first move in it, its origin X, Y, Z in the system of the first move, and its rotation in degrees. NaN is not known. Positions are those of the active system. */
  systems: Float64Array;
  /** What the program writes that lasts, in its order. */
  writes: ProgramWrite[];
  /** What was ignored and what could not be known, each with all its 0-based lines. */
  findings: (Finding & { lines: number[] })[];
  /** What the program reads before anything sets it, with the lines that read it: what `set` is for. */
  asks: { name: string; lines: number[] }[];
  /** Calls of the control's own probing cycles, in the order in which they run. */
  calls: NativeCall[];
  /** What the safety rules say of a program that probes; `holds` is `null` where an unknown decides. `lines`, 0-based, break it, or are not known. */
  rules: {
    rule: string;
    holds: boolean | null;
    message: string;
    said: Message;
    lines: number[];
  }[];
  /** The lines that name the lines below them, 0-based: programs, subroutines, labels. */
  outline: { line: number; name: string }[];
}

/** A lasting change that a program makes: to a work offset, to the shift of G92, to the tool table. */
export interface ProgramWrite {
  /** Its 0-based line in its own text: `file` 0 is the program, others are `files` in their order, from 1. */
  line: number;
  file: number;
  kind: "offset" | "shift" | "length" | "radius" | "wear" | "table";
  /** What is written, as the control calls it: `G54`, `G92`, `tool 5`, `#2605`. */
  register: string;
  /** `R` is a rotation; `null` where the feature that is measured decides it. */
  axis: "X" | "Y" | "Z" | "R" | null;
  /** In the program's first units, degrees of a rotation; `null` where it is not known. By `G10 L20` and G92 it is what the present position is called. */
  value: number | null;
  /** Whether the write depends on a condition after the last touch. `false`: there is no condition. `null`: what the condition compares is unknown. */
  guarded: boolean | null;
}

/** A call of one of the control's own probing cycles. */
export interface NativeCall {
  /** Its 0-based line in its own text: `file` 0 is the program, others are `files` in their order, from 1. */
  line: number;
  file: number;
  /** As programs write it: `G65 P9814`, `TCH PROBE 412`, `CYCLE977`. */
  name: string;
  /** What it measures or does, how well that is known and where it was read; `null` for a call that is not known here. */
  title: string | null;
  mark: "sourced" | "recalled" | null;
  source: string | null;
  /** By letter, Q number, or place between the commas; `value` is `null` where it is no known number. */
  arguments: {
    name: string;
    value: number | null;
    meaning: string | null;
    unit: "length" | "angle" | "feed" | "none" | null;
    /** What the control takes, where that is known: `0 to 1`. */
    range: string | null;
  }[];
  /** What contradicts in its arguments: the control refuses such a call. */
  contradictions: string[];
  /** The same as a job, where it is one of the documented cycles and says enough: what it does not say has the form's default. */
  job: Job | null;
}

/** The outcome of one job among many. */
export interface Programmed {
  /** Its program; `null` where it has none. */
  program: ProgramText | null;
  /** All findings; where there is no program, errors among them. */
  findings: Finding[];
}

/** What was made of a text: a job, or the moves of a program that holds no job. `findings` says what was ignored, and what could not be known. */
export type Imported =
  | { kind: "job"; job: Job | SetUp; findings: Finding[] }
  | { kind: "moves"; job: null; trace: TraceRow; findings: Finding[] };

/** What is asked of LENTOAX; what is left out is the standard case. */
export interface LentoaxQuery {
  plane?: "G17" | "G18" | "G19";
  /** 400 to 599 are turning and grinding tools; the default 710 is a probe. */
  toolType?: number;
  /** The active frame's steps, in order. */
  frame?: FrameStep[];
  /** WCS, BCS, MCS, KCS, TCS or their first letter, any case. */
  coord?: string;
  toolActive?: boolean;
  sd42900?: boolean;
  sd42940?: number;
  sd42950?: 0 | 1 | 2;
}

export interface Lentoax {
  /** 0: `axind` says it all; 1: `matrix` must be read; -1: coordinate system not known; -2: no tool active. */
  status: number;
  /** For abscissa, ordinate, applicate: the number of the length that acts there, negative if it points the other way. */
  axind: Vec3;
  /** Rows abscissa, ordinate, applicate; columns L1, L2, L3. */
  matrix: [Vec3, Vec3, Vec3];
}

/**
 * What a machine measured: ball centres, one a touch, in order; or a text: points, one a line (CSV, `X1 Y2 Z3`, LinuxCNC's PROBEOPEN log), results (`center.x=1.2345`), or the log of a
 * sender with grbl's `[PRB:…]` and what says the work offset.
 */
export type Measured = string | (Vec3 | { x: number; y: number; z: number })[];
