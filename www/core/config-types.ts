// What a portal asks of jobs; read by src/config.
import type { Cycle, Job, PostId, Vec3 } from "./job-types.js";
import type { Finding } from "./plan-types.js";

/** What the element can show: the form, the picture with its timeline (`stage`), and the panels beside it. */
export type PanelName = "form" | "stage" | "program" | "table" | "results" | "checks";

/**
 * The rules of a portal: what its users may choose, which fields are fixed, hidden or filled in, where its machine can travel. Every part may be left out.
 * A rule fills in what a job leaves out, and refuses what it does not allow: as a finding, with its reason. Schema: `touchpath/config.schema.json`.
 */
export interface Config {
  format: 1;
  /** Who asks, as findings call it: `Hall 3 does not allow …`. Up to 60 characters. */
  title?: string;
  /** Units of the lengths and feeds in the config, `mm` by default. Jobs may be in others. */
  units?: "mm" | "inch";
  /** What may be chosen. A job that says nothing gets the first entry where its default is not among them. */
  allow?: {
    cycles?: Cycle["type"][];
    /** By the `id` of a post in the catalog. */
    controls?: PostId[];
    forms?: ("moves" | "cycle")[];
    units?: ("mm" | "inch")[];
    /** The work offsets that a program may write, 1 for the first (G54); `null` is none. */
    workOffsets?: (number | null)[];
    /** Whether a job may have several cycles; `true` by default. */
    setUps?: boolean;
  };
  /** What the element does not offer. A job that has it is not refused. */
  hide?: { cycles?: Cycle["type"][]; controls?: PostId[]; panels?: PanelName[] };
  /** What is asked of single fields, by their path: `feeds.work`, `control.tool`, `cycle.depth`, `cycle.probe.dist`. Of a set-up, `cycle.` is each of its cycles. */
  fields?: Record<string, FieldRule>;
  /** Machines that the element offers by name: what of a job belongs to one. */
  machines?: ConfigMachine[];
  /** Styli that the element offers by name, in the group of the probe. */
  styli?: ({ name: string } & NonNullable<Job["stylus"]>)[];
  /** Where the machine can travel. */
  space?: Space;
  /** What the portal itself has to say of the job, beside the findings of the check; their code is `portal`. An error withholds the program. */
  findings?: { level?: Finding["level"]; path?: string; message: string }[];
}

/** What is asked of one field. */
export interface FieldRule {
  /** What it holds where the job says nothing. */
  value?: unknown;
  /** It must have that value; without a value, the user cannot change it. */
  locked?: boolean;
  /** The element does not show it. */
  hidden?: boolean;
  /** What a number must lie between, in the config's units; the ends are allowed. */
  min?: number;
  max?: number;
  /** Why, in the portal's words. Up to 200 characters. */
  reason?: string;
}

/** What of a job belongs to a machine. */
export type ConfigMachine = { name: string } & Partial<
  Pick<Job, "overtravel" | "stylus" | "feeds" | "limits" | "machine" | "control" | "tool">
>;

/**
 * Boxes along the axes of the machine. Places of a job are in its work coordinate system: `zero` is where its origin lies in the machine, `[0, 0, 0]` by
 * default. Z is of the ball's centre: take the probe's length off the travel of the spindle.
 */
export interface Space {
  zero?: Vec3;
  /** Where the ball's centre can go. Counted are the path and the searches past its touches, to where the control gives up. */
  travel?: { min: Vec3; max: Vec3 };
  /** Where the probe must not go: its ball, and of the stylus above it what the job knows. */
  keepOut?: { name: string; min: Vec3; max: Vec3 }[];
}
