// The events of the element, of a frame and of the components for frameworks: one list for all of them.
import type { AnyJob, Finding, Plan } from "./types.js";

/**
 * Cause of a change. `edit`: the user changed the job. `undo`, `redo`: a step of the user was undone or redone. `open`: the user opened another job, or reset the
 * form. `host`: the host page set it.
 */
export type ChangeReason = "edit" | "undo" | "redo" | "open" | "host";

/** The user's selection: a move, its program line and its touch, all counted from 0, and the path of the focused field. `null` without a selection. */
export interface Selection {
  move: number | null;
  line: number | null;
  touch: number | null;
  field: string | null;
}

/** Details of the events, by event name. */
export interface EventDetails {
  /** The job, its plan or its findings have changed. `plan` is `null` while the job has errors. */
  change: {
    job: AnyJob;
    plan: Plan | null;
    findings: Finding[];
    reason: ChangeReason;
  };
  /** The user has changed the job. A portal that cannot use set-ups excludes them by `"setUps": false` in its config. */
  "job-change": { job: AnyJob };
  /** The plan has changed; `null` as soon as the job has an error. */
  "plan-change": { plan: Plan | null };
  /** The user has selected another move, line or field, or the selected move is gone. */
  "selection-change": Selection;
  /** The user has changed the measured points. */
  "measured-change": { measured: string };
  /** A program is to be saved. */
  "program-save": {
    name: string;
    text: string;
    post: string;
    extension: string;
  };
  /** The findings have changed; or (`refused`) an input could not be used and changed nothing. */
  finding: { findings: Finding[]; refused: boolean };
}

/** The events, by name. */
export type TouchPathEvents = {
  [K in keyof EventDetails]: CustomEvent<EventDetails[K]>;
};

const NAMES: Record<keyof EventDetails, true> = {
  change: true,
  "job-change": true,
  "plan-change": true,
  "selection-change": true,
  "measured-change": true,
  "program-save": true,
  finding: true,
};

/** Names of the events. */
export const EVENTS = Object.keys(NAMES) as (keyof EventDetails)[];
