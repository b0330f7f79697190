/** Lengths are in the job's units, feeds in units a minute, angles in degrees, counter-clockwise positive. */

import type { Cycle, FrameStep, Job, Vec3 } from "./job-types.js";

export type * from "./job-types.js";

/** A problem or a note. An error means that no plan is made. */
export interface Finding {
  level: "error" | "warning" | "info";
  /** Stable, kebab-case. */
  code: string;
  /** The place in the job: `cycle.sideClearance1`; empty for the job as a whole. */
  path: string;
  message: string;
}

/** A nominal touch: a point on the surface and its outward normal. */
export interface TouchPoint {
  point: Vec3;
  vector: Vec3;
  /** Wall or circle, from 0. */
  group: number;
}

/** A move of the ball centre. A touch ends at the nominal contact; the search past it belongs to the program. */
export interface Move {
  to: Vec3;
  feed: "approach" | "longLink" | "work" | "retract" | "return" | "rapid";
  kind: "position" | "touch" | "back";
  /** Number of the step in the cycle's documented list. */
  step: number;
  touch: number | null;
  arc: { center: Vec3; sweep: number } | null;
}

/** A row of the source's parameter table. */
export interface ParameterRow {
  /** `CmdPrm.Flt[-53]`. */
  code: string;
  type: string;
  value: number | string | boolean;
  meaning: string;
  /** Path of the job's field it comes from. */
  field: string | null;
  /** The touch it comes from. */
  touch: number | null;
}

/** What the control stores. */
export interface ResultRow {
  code: string;
  meaning: string;
  /** `mm`, `inch` or `deg`. */
  unit: string;
  nominal: number | null;
  value: number | null;
  /** Value less nominal. */
  deviation: number | null;
  /** One sigma. */
  uncertainty: number | null;
  verdict: string | null;
  /** What is true of the virtual part; null for measured points. */
  truth: number | null;
  /** Why the value is not the truth, where it is not. */
  note: string | null;
}

export interface Plan {
  touches: TouchPoint[];
  moves: Move[];
  /** Length of the path from the end of its first move. */
  length: number;
  /** Minutes, rapids at the catalog's `rapidRate`. */
  time: number;
  program: { post: string; extension: string; text: string; moveLines: number[] };
  table: ParameterRow[];
  results: ResultRow[];
  /** Ball centre at the trigger of each touch on the virtual part; null where there is no contact before its end. */
  triggers: (Vec3 | null)[];
  findings: Finding[];
}

/** The moves as typed arrays: three numbers of `to` a move; `feed` and `kind` index into `feeds` and `kinds`; no touch is −1. */
export interface MoveColumns {
  to: Float64Array;
  feed: Uint8Array;
  kind: Uint8Array;
  step: Uint8Array;
  touch: Int32Array;
  feeds: string[];
  kinds: string[];
}

/** One field of a form. Numbers are in mm, mm/min and degrees, whatever the job's units. */
export interface FieldEntry {
  key: string;
  label: string;
  help: string;
  kind: "number" | "count" | "flag" | "choice" | "code" | "text" | "point" | "nominal" | "nominalPoint";
  unit: "length" | "feed" | "angle" | "none";
  range: [number, number] | null;
  /** Whether the smallest number itself is excluded. */
  above: boolean;
  usual: [number, number] | null;
  default: number | boolean | string | Vec3 | null;
  /** What `null` means, where it is allowed. */
  null: string | null;
  choices: { value: string | number; label: string }[];
  /** Parameter code of the source. */
  code: string | null;
  /** The heading it stands under. */
  group: string;
  /** Whether `part.sizes` may change it. */
  size: boolean;
}

export interface CycleEntry {
  type: Cycle["type"];
  title: string;
  source: string;
  /** Type number in the source's parameter table (code -1), where it has one. */
  number: number | null;
  /** Whether its touches may be picked one by one (`cycle.touches`). */
  touches: boolean;
  doc: string;
  fields: FieldEntry[];
  /** Forms inside its form. */
  sections: { key: string; optional: boolean; fields: FieldEntry[] }[];
  /** The documented steps, in our words; index 0 is step 1. */
  steps: string[];
  /** The most touches that a job of it can have. */
  maxTouches: number;
}

export interface PostEntry {
  id: string;
  title: string;
  extension: string;
  /** Highest number of a work offset that a program can write; 0 is none. */
  workOffsets: number;
  /** How they are called, from number 1. */
  workOffsetWords: string[];
  cycles: { type: string; form: "moves" | "cycle"; supported: boolean; reason: string | null }[];
}

export interface Catalog {
  format: 1;
  cycles: CycleEntry[];
  /** The sections of a job around the cycle; an empty path is the job itself. */
  sections: { path: string; fields: FieldEntry[] }[];
  posts: PostEntry[];
  rapidRate: number;
  /** The most touches that a CmdPrm table holds; `cycles[].maxTouches` is each cycle's own. */
  maxTouches: number;
  /** The longest text that is read, in bytes. */
  longestText: number;
}

/** A job made of text. */
export interface Imported {
  job: Job;
  findings: Finding[];
}

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

/** Points that a machine measured: ball centres, one a touch, in order; or text, one point a line (CSV or LinuxCNC's PROBEOPEN log). */
export type Measured = string | (Vec3 | { x: number; y: number; z: number })[];
