/** Lengths are in the job's units, feeds in units a minute, angles in degrees, counter-clockwise positive. */

import type { FrameStep, Job, SetUp, Vec3 } from "./job-types.js";
import type { Finding, Integer, ProgramText, TraceRow } from "./plan-types.js";
import type { PROGRAM_POSTS } from "./program-posts.js";

export type * from "./config-types.js";
export type * from "./job-types.js";
export type * from "./plan-types.js";

import type { Message } from "./said.js";

export type { Message, Words } from "./said.js";

/** A job of one cycle (format 1), or a set-up of several (format 2). */
export type AnyJob = Job | SetUp;

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

/** Dialect of a program. */
export type Dialect = "iso" | "sinumerik" | "klartext";

/** The moves of any program as columns, in the units that it states first. Nothing about them is proven. */
export interface ProgramMoves {
  /** Dialect in which it was read. */
  dialect: Dialect;
  /** Control for which it was read: the given one, or the one recognised from its words; `null` for any control with G codes. */
  post: ProgramPost | null;
  /** `null` if the program does not state its units. */
  units: "mm" | "inch" | null;
  plane: "G17" | "G18" | "G19";
  /** Three numbers per move; `NaN` along an axis with an unknown position. */
  to: Float64Array;
  /** Index into `kinds`. */
  kind: Uint8Array;
  /** Units per minute; `NaN` for a rapid or an unknown feed. */
  feed: Float64Array;
  /** 0-based line of each move. */
  line: Uint32Array;
  /** Six numbers per arc: index of its move, centre X, Y, Z, degrees (counter-clockwise positive), and its plane: 17, 18 or 19. */
  arcs: Float64Array;
  /** `rapid`, `feed`, `probe`. */
  kinds: string[];
  /** Notes about ignored lines and unknown values. */
  findings: Finding[];
}

/** A program with the program of a job in it. */
export interface Insertion {
  /** The whole text. */
  text: string;
  /** The 0-based line of the given text after which the program is inserted. */
  line: Integer;
  /** The 0-based line of the first inserted line in the whole text. */
  first: Integer;
  /** Number of inserted lines, without the declarations at the start of a SINUMERIK program. */
  count: Integer;
  /** Tool changes of the given text, in order. */
  places: ToolPlace[];
  /** Warnings and notes. */
  findings: Finding[];
}

/** A place in a program: after a tool change and the activation of the tool's length. */
export interface ToolPlace {
  /** The 0-based line after which a program can be inserted. */
  line: Integer;
  /** The tool as the program names it: `24`, `PROBE`; `null` if it does not. */
  tool: string | null;
  /** Whether a name or a comment says that the tool is a probe. */
  probe: boolean;
}

/** A part to probe. Its cycle's feature, virtual part, stylus and units determine the contacts of probing moves. */
export type ProgramPart = Partial<Omit<Job, "cycle">> & { cycle: Job["cycle"] };

/** A control for which programs can be read. */
export type ProgramPost = (typeof PROGRAM_POSTS)[number];

/** Inputs of a program that its text does not contain. */
export interface ProgramKnown {
  /** Dialect; recognised from the text if omitted. */
  dialect?: Dialect;
  /** Control of the program: it determines the dialect and the codes that move the coordinate system. Recognised from the text if omitted. */
  post?: ProgramPost;
  /** `0`: every work offset, shift and tool length that nothing sets is 0. Omitted: they are unknown, except those whose variables are in `set`. */
  offsets?: 0;
  /** Values of variables, by their names in the text: `{ "#3014": 5, "#<_name>": 1 }`. An assignment in the text replaces them from there on. */
  set?: Record<string, number>;
  /**
   * Position of the stylus before the first block, in the first units of the program and in the coordinate system of the first move; `null` along an axis with
   * an unknown position.
   */
  start?: [number | null, number | null, number | null];
  /** Trigger points: the fraction of its way at which a touch or a watched positioning move makes contact; `null`: never; omitted: unknown. */
  part?: { at?: number | null; positioning?: number | null } | ProgramPart;
  /** Texts with subprograms, by name. */
  files?: Record<string, string>;
}

/** A run of a program with inputs. A touch ends at its programmed target; `contacts` has its trigger point, and the next move starts there. */
export interface ProgramRun extends Omit<ProgramMoves, "findings"> {
  /** The text of each move, to which its `line` belongs: 0 is the program, others are `files` in order, from 1. Empty without files. */
  file: Uint32Array;
  /** Four numbers per contact: index of its move, and X, Y, Z. */
  contacts: Float64Array;
  /**
   * Four numbers per move that does not start at the end of the previous one: its index and its start; NaN is unknown. Both branches of an unknown condition
   * start from the same position.
   */
  resumes: Float64Array;
  /**
   * Five numbers per change of the coordinate system: index of the first move in it, its origin X, Y, Z in the system of the first move, and its rotation in
   * degrees. NaN is unknown. Positions are those of the active system.
   */
  systems: Float64Array;
  /** Lasting changes by the program, in order. */
  writes: ProgramWrite[];
  /** Notes about ignored lines and unknown values, each with its 0-based lines. */
  findings: (Finding & { lines: Integer[] })[];
  /** Variables that the program reads before anything sets them, with the lines that read them. Pass their values in `set`. */
  asks: { name: string; lines: Integer[] }[];
  /** Calls of native cycles, in the order in which they run. */
  calls: NativeCall[];
  /** Results of the safety rules for a program that probes; `holds` is `null` if an unknown value decides. `lines` (0-based) break the rule or are unknown. */
  rules: {
    rule: string;
    holds: boolean | null;
    message: string;
    said: Message;
    lines: Integer[];
  }[];
  /** Lines that name the section below them, 0-based: programs, subroutines, labels. */
  outline: { line: Integer; name: string }[];
}

/** A lasting change by a program: of a work offset, the G92 shift or the tool table. */
export interface ProgramWrite {
  /** 0-based line in its own text: `file` 0 is the program, others are `files` in order, from 1. */
  line: Integer;
  file: Integer;
  kind: "offset" | "shift" | "length" | "radius" | "wear" | "table";
  /** Target of the write in the control's words: `G54`, `G92`, `tool 5`, `#2605`. */
  register: string;
  /** `R` is a rotation; `null` if the measured feature determines the axis. */
  axis: "X" | "Y" | "Z" | "R" | null;
  /** In the program's first units, degrees for a rotation; `null` if unknown. For `G10 L20` and G92 it is the new value of the current position. */
  value: number | null;
  /** Whether the write depends on a condition after the last touch. `false`: there is no condition. `null`: the condition compares unknown values. */
  guarded: boolean | null;
}

/** A call of a native cycle. */
export interface NativeCall {
  /** 0-based line in its own text: `file` 0 is the program, others are `files` in order, from 1. */
  line: Integer;
  file: Integer;
  /** Name as in programs: `G65 P9814`, `TCH PROBE 412`, `CYCLE977`. */
  name: string;
  /** What it measures or does, with the mark and the source of this knowledge; `null` for an unknown call. */
  title: string | null;
  mark: "sourced" | "recalled" | null;
  source: string | null;
  /** Arguments by letter, Q number or position between the commas; `value` is `null` if it is no known number. */
  arguments: {
    name: string;
    value: number | null;
    meaning: string | null;
    unit: "length" | "angle" | "feed" | "none" | null;
    /** Accepted range, if known: `0 to 1`. */
    range: string | null;
  }[];
  /** Contradictions between its arguments: the control refuses such a call. */
  contradictions: string[];
  /** The call as a job, if it is a documented cycle and specifies enough. Fields that it does not specify have their defaults. */
  job: Job | null;
}

/** Outcome of one job among many. */
export interface Programmed {
  /** Its program; `null` without one. */
  program: ProgramText | null;
  /** All findings; errors among them if there is no program. */
  findings: Finding[];
}

/** Content of a text: a job, or the moves of a program without a job. `findings` lists ignored lines and unknown values. */
export type Imported =
  | { kind: "job"; job: AnyJob; findings: Finding[] }
  | { kind: "moves"; job: null; trace: TraceRow; findings: Finding[] };

/** Query for LENTOAX; omitted values are the standard case. */
export interface LentoaxQuery {
  plane?: "G17" | "G18" | "G19";
  /** 400 to 599 are turning and grinding tools; the default 710 is a probe. */
  toolType?: number;
  /** Steps of the active frame, in order. */
  frame?: FrameStep[];
  /** WCS, BCS, MCS, KCS, TCS or their first letter, any case. */
  coord?: string;
  toolActive?: boolean;
  sd42900?: boolean;
  sd42940?: number;
  sd42950?: 0 | 1 | 2;
}

export interface Lentoax {
  /** 0: `axind` is the full answer; 1: `matrix` must be read; -1: unknown coordinate system; -2: no active tool. */
  status: Integer;
  /** For abscissa, ordinate and applicate: the number of the length that acts there, negative if it points the other way. */
  axind: Vec3;
  /** Rows abscissa, ordinate, applicate; columns L1, L2, L3. */
  matrix: [Vec3, Vec3, Vec3];
}

/**
 * Measurements of a machine: ball centres, one per touch, in order; or a text with points, one per line (CSV, `X1 Y2 Z3`, LinuxCNC's PROBEOPEN log), with
 * results (`center.x=1.2345`), or a sender log with grbl's `[PRB:…]` and its work offset.
 */
export type Measured = string | (Vec3 | { x: number; y: number; z: number })[];
