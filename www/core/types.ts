/** Lengths are in the job's units, feeds in units a minute, angles in degrees, counter-clockwise positive. */

import type { FrameStep, Job, Vec3 } from "./job-types.js";
import type { Finding, ProgramText, TraceRow } from "./plan-types.js";

export type * from "./job-types.js";
export type * from "./plan-types.js";
export type { Said, Words } from "./said.js";

/** The moves as typed arrays: three numbers of `to` a move; `feed` and `kind` index into `feeds` and `kinds`; no touch is −1. */
export interface MoveColumns {
  to: Float64Array;
  feed: Uint8Array;
  kind: Uint8Array;
  step: Uint8Array;
  touch: Int32Array;
  /** Five numbers an arc: index of its move, centre X, Y, Z, and degrees about the tool axis, counter-clockwise positive. */
  arcs: Float64Array;
  feeds: string[];
  kinds: string[];
}

/** The moves of any program, column by column, in the units that it states first. Nothing is proven of what is read so. */
export interface ProgramMoves {
  /** What it was read as. */
  dialect: "iso" | "sinumerik";
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

/** The outcome of one job among many. */
export interface Programmed {
  /** Its program; `null` where it has none. */
  program: ProgramText | null;
  /** All findings; where there is no program, errors among them. */
  findings: Finding[];
}

/** What was made of a text: a job, or the moves of a program that holds no job. `findings` says what was ignored, and what could not be known. */
export type Imported =
  | { kind: "job"; job: Job; findings: Finding[] }
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
