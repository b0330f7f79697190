// What a portal asks of jobs; read by src/config.
import type { Cycle, Job, PostId, Vec3 } from "./job-types.js";
import type { Finding } from "./plan-types.js";

/** What the element can show: the form, the picture with its timeline (`stage`), and the panels beside it. */
export type PanelName =
  | "form"
  | "stage"
  | "program"
  | "table"
  | "results"
  | "checks";

/**
 * The rules of a portal: what its users may choose, which fields are fixed, hidden or filled in, where its machine can travel. Every part is optional.
 * A config fills in what a job leaves out, and refuses what it does not allow, with a finding that gives the reason. Schema: `touchpath/config.schema.json`.
 */
export interface Config {
  format: 1;
  /** The name of the portal in findings: `Hall 3 does not allow …`. Up to 60 characters. */
  title?: string;
  /** Units of the lengths and feeds in the config, `mm` by default. Jobs may be in others. */
  units?: "mm" | "inch";
  /** What may be chosen. A job that leaves a choice out gets the first entry, unless its default is allowed. */
  allow?: {
    cycles?: Cycle["type"][];
    /** By the `id` of a post in the catalog. */
    controls?: PostId[];
    forms?: ("moves" | "cycle")[];
    units?: ("mm" | "inch")[];
    /** The work offsets that a program may write: 1 is the first (G54), `null` is measuring only. */
    workOffsets?: (number | null)[];
    /** Whether a job may have several cycles; `true` by default. */
    setUps?: boolean;
  };
  /** What the element does not offer. Jobs that have it are not refused. */
  hide?: {
    cycles?: Cycle["type"][];
    controls?: PostId[];
    panels?: PanelName[];
  };
  /** Rules of single fields, by path: `feeds.work`, `control.tool`, `cycle.depth`, `cycle.probe.dist`. In a set-up, `cycle.` means each of its cycles. */
  fields?: Record<string, FieldRule>;
  /** Machines that the element offers by name: the sections of a job that belong to each. */
  machines?: ConfigMachine[];
  /** Styli that the element offers by name, in the group of the probe. */
  styli?: ({ name: string } & NonNullable<Job["stylus"]>)[];
  /** Where the machine can travel. */
  space?: Space;
  /** The portal's own findings, shown with those of the check; their code is `portal`. With an error there is no program. */
  findings?: { level?: Finding["level"]; path?: string; message: string }[];
}

/** The rule of one field. */
export interface FieldRule {
  /** The value of a job that leaves the field out. */
  value?: unknown;
  /** The field must have `value`. Without a `value`, only the user cannot change it. */
  locked?: boolean;
  /** The element does not show it. */
  hidden?: boolean;
  /** The smallest and the largest number, in the config's units; both are allowed, `null` is not. */
  min?: number;
  max?: number;
  /** The reason, in the portal's words. Up to 200 characters. */
  reason?: string;
}

/** A machine: the sections of a job that belong to it. */
export type ConfigMachine = { name: string } & Partial<
  Pick<
    Job,
    | "overtravel"
    | "stylus"
    | "feeds"
    | "limits"
    | "machine"
    | "control"
    | "tool"
  >
>;

/**
 * Boxes along the axes of the machine. `zero` is the origin of the job's work coordinate system in their coordinates, `[0, 0, 0]` by default. Z is that
 * of the ball centre: subtract the probe's length from the travel of the spindle.
 */
export interface Space {
  zero?: Vec3;
  /** Where the ball centre can go: on its path, and in the searches past the touches. */
  travel?: { min: Vec3; max: Vec3 };
  /** Zones that the probe must not enter: the ball, and the stylus and probe body if the job gives their sizes. */
  keepOut?: { name: string; min: Vec3; max: Vec3 }[];
}
