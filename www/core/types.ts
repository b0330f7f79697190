/** Lengths are in the job's units, feeds in units a minute, angles in degrees, counter-clockwise positive. */

/** X, Y, Z of the work coordinate system. */
export type Vec3 = [number, number, number];

/** A problem or a note. An error means that no plan is made. */
export interface Finding {
  level: "error" | "warning" | "info";
  /** Stable, kebab-case. */
  code: string;
  /** The place in the job: `cycle.sideClearance1`; empty for the job as a whole. */
  path: string;
  message: string;
}

/** A feed; `null` is rapid. */
export type FeedRate = number | null;

/** A picked touch: a point on the surface, and its outward normal, a unit vector. */
export interface PickedTouch {
  point: Vec3;
  vector: Vec3;
}

/** What every cycle of the ENCY / SprutCAM family may carry besides its dimensions. */
export interface Family {
  /** The Job Assignment's own picks: they replace the points that the dimensions give. Not for types 0 and 1. */
  touches?: PickedTouch[] | null;
  /** Custom properties, codes -10 to -25; what is null is not in the table. Not for type 0. */
  properties?: Record<string, number | null> | null;
  /** The user's own codes: they go through as they are. */
  custom?: { code: number; type: "Int" | "Flt" | "Bol"; value: number | boolean }[];
  subCode?: number;
  feedDistance?: number;
}

/** A feature that is centred on its top side. */
export interface Centred extends Family {
  /** Centre on the top side. */
  origin?: Vec3;
  rotation?: number;
  depth?: number;
}

/** Holes and bosses. */
export interface Round extends Centred {
  diameter?: number;
  /** 0 rectangular, 1 angular. */
  variant?: 0 | 1;
  startAngle?: number;
  angularStep?: number;
  stepCount?: number;
}

/** Type 2. */
export interface SurfaceProbing extends Family {
  type: "surface";
  /** The touch point. */
  origin?: Vec3;
  rotation?: number;
  /** Of the target vector over the plane: 90 is a top side, 0 a wall. */
  elevation?: number;
  clearance?: number;
  compensateDimensions?: boolean;
}

/** Type 3; `topClearance: null` is not checked. */
export interface Hole extends Round {
  type: "hole";
  topClearance?: number | null;
}

/** Types 4 and 5. */
export interface RoundProtected extends Round {
  type: "hole-protected" | "boss";
  topClearance?: number;
  sideClearance?: number;
  compensateDimensions?: boolean;
}

/** Type 6; `topClearance: null` is not checked. */
export interface InternalRectangle extends Centred {
  type: "internal-rectangle";
  width1?: number;
  width2?: number;
  topClearance?: number | null;
}

/** Types 7 and 8. */
export interface RectangleProtected extends Centred {
  type: "internal-rectangle-protected" | "external-rectangle";
  /** Along the first direction, touch points 1 and 2. */
  width1?: number;
  /** Along the second direction, touch points 3 and 4. */
  width2?: number;
  topClearance?: number;
  sideClearance1?: number;
  sideClearance2?: number;
  compensateDimensions?: boolean;
}

/** Types 9 and 12. */
export interface PairProtected extends Centred {
  type: "web" | "groove-protected";
  width?: number;
  topClearance?: number;
  sideClearance?: number;
  compensateDimensions?: boolean;
}

/** Type 10. */
export interface WebThreePoints extends Centred {
  type: "web-three-points";
  width?: number;
  sideClearance?: number;
  middleClearance?: number;
  compensateDimensions?: boolean;
}

/** Type 11; `topClearance: null` is not checked. */
export interface Groove extends Centred {
  type: "groove";
  width?: number;
  topClearance?: number | null;
}

/** Type 14. */
export interface DoubleWallExternalCorner extends Family {
  type: "double-wall-external-corner";
  /** The corner, at the level of the touches. */
  origin?: Vec3;
  rotation?: number;
  /** Between the walls, in the material, 20 to 160. */
  angle?: number;
  clearance1?: number;
  clearance2?: number;
  /** From the corner along each wall to its first touch. */
  distance1?: number;
  distance2?: number;
  count1?: number;
  count2?: number;
  step1?: number;
  step2?: number;
  compensateDimensions?: boolean;
}

/** Type 15. */
export interface TripleWallInternalCorner extends Family {
  type: "triple-wall-internal-corner";
  /** The corner, on the floor. */
  origin?: Vec3;
  rotation?: number;
  angle?: number;
  clearance1?: number;
  clearance2?: number;
  clearance3?: number;
}

/** Type 16. */
export interface TripleWallExternalCorner extends Family {
  type: "triple-wall-external-corner";
  /** The corner, on the top side. */
  origin?: Vec3;
  rotation?: number;
  angle?: number;
  depth?: number;
  clearance1?: number;
  clearance2?: number;
  topClearance?: number;
  distance1?: number;
  distance2?: number;
  topDistance1?: number;
  topDistance2?: number;
}

/** Type 0: rows without motion. */
export interface ProbeOnOff {
  type: "probe-on-off";
  on?: boolean;
  custom?: Family["custom"];
}

/** Type 1: rows without motion. */
export interface NcAction {
  type: "nc-action";
  subCode?: number;
  properties?: Family["properties"];
  custom?: Family["custom"];
}

/** Type 13. */
export interface DoubleWallInternalCorner extends Family {
  type: "double-wall-internal-corner";
  /** The corner, at the level of the touches. */
  origin?: Vec3;
  rotation?: number;
  /** Between the walls, inside the corner, 20 to 160. */
  angle?: number;
  clearance1?: number;
  clearance2?: number;
  count1?: number;
  count2?: number;
  step1?: number;
  step2?: number;
}

/** A number, or text: `10H7`, `10m`, `10+0.01-0.015`, `?`, `?10`, `10@10.02`. */
export type Nominal = number | string;

/** HEIDENHAIN 1411; points are (main, minor, tool axis) of the plane. */
export interface ProbingTwoCircles {
  type: "probing-two-circles";
  point1?: [Nominal, Nominal, Nominal];
  diameter1?: Nominal;
  point2?: [Nominal, Nominal, Nominal];
  diameter2?: Nominal;
  geometryType?: 0 | 1 | 2 | 3;
  probePoints?: number;
  startingAngle?: number;
  angularLength?: number;
  setUpClearance?: number;
  clearanceHeight?: number;
  /** PREDEF in the program: the control takes it from GLOBAL DEF. The number is then only what the moves show. */
  setUpClearancePredef?: boolean;
  clearanceHeightPredef?: boolean;
  clearanceHeightMode?: -1 | 0 | 1 | 2;
  errorReaction?: 0 | 1 | 2;
  alignRotaryAxis?: 0 | 1 | 2;
  transferPosition?: 0 | 1 | 2 | 3;
  confirmRotation?: 0 | 1 | 2;
  /** The touch probe table; `rapid: null` is the control's own. */
  probe?: { setUp?: number; dist?: number; feed?: number; rapid?: FeedRate };
  /** Where the stylus is before the cycle. */
  start?: Vec3;
  /** Cycle 1493 in front of it. */
  extrusion?: { direction?: 1 | 2 | 3; points?: number; length?: number; modal?: 0 | 1 } | null;
}

export type Cycle =
  | RectangleProtected
  | DoubleWallInternalCorner
  | ProbingTwoCircles
  | SurfaceProbing
  | Hole
  | RoundProtected
  | InternalRectangle
  | PairProtected
  | WebThreePoints
  | Groove
  | DoubleWallExternalCorner
  | TripleWallInternalCorner
  | TripleWallExternalCorner
  | ProbeOnOff
  | NcAction;

/** A probing job. What is left out takes the catalog's default. */
export interface Job {
  format: 1;
  name?: string;
  units?: "mm" | "inch";
  plane?: "G17" | "G18" | "G19";
  stylus?: { diameter?: number; repeatability?: number };
  feeds?: { approach?: FeedRate; longLink?: FeedRate; work?: number; retract?: FeedRate; return?: FeedRate };
  overtravel?: number;
  cycle: Cycle;
  control?: {
    post?: "linuxcnc" | "grbl" | "sinumerik" | "heidenhain";
    form?: "moves" | "cycle";
    workOffset?: number | null;
    /** Whether positioning is watched too (LinuxCNC); `none` where the way is known to be free. */
    protection?: "checked" | "none";
    /** The tool that the program calls; null calls none. */
    tool?: number | null;
  };
  /** Which of the probe's lengths acts where: only a SINUMERIK asks. The default is a milling probe (type 710). */
  tool?: Pick<LentoaxQuery, "frame" | "sd42900" | "sd42940" | "sd42950"> & { type?: number };
  part?: { offset?: Vec3; rotation?: number; sizes?: Record<string, number> };
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
  /** The longest text that is read, in characters. */
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
  frame?: ({ rot: "X" | "Y" | "Z"; angle: number } | { mirror: "X" | "Y" | "Z" })[];
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
