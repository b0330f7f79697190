// Ready set-ups to start a job from: features that belong together, and the datum written from them.
import {
  type Cycle,
  convertUnits,
  type Job,
  JobError,
  plan,
  proposedStock,
} from "./core/browser.js";
import { isWritten } from "./core/results.js";
import type { CatalogView, Form } from "./entries.js";
import { alike, type Draft, valueAt } from "./job.js";
import { w } from "./words.js";

/** A set-up in mm, for any control. */
export interface SetUpEntry {
  key: string;
  name: string;
  says: string;
  /** Whether a work offset is written. */
  writes: boolean;
  job: Draft;
}

/** A set-up as a job for one machine. */
export interface ReadySetUp {
  entry: SetUpEntry;
  job: Draft;
}

const hole = (name: string, x: number, y: number): Draft => ({
  name,
  type: "hole",
  diameter: 12,
  origin: [x, y, 0],
});

export const SET_UPS: SetUpEntry[] = [
  {
    key: "vise",
    name: w("Vise corner"),
    says: w(
      "The top for Z, two walls for X and Y, and for the rotation if the control supports it.",
    ),
    writes: true,
    job: {
      cycles: [
        { name: "TOP", type: "surface", origin: [20, 20, 0] },
        {
          name: "CORNER",
          type: "double-wall-external-corner",
          origin: [0, 0, "=TOP.z-5"],
          count1: 2,
          count2: 2,
        },
      ],
      datum: {
        x: "CORNER.corner.x",
        y: "CORNER.corner.y",
        z: "TOP.point.z",
        rotation: "CORNER.rotation",
      },
      limits: { position: 2 },
    },
  },
  {
    key: "bore-and-top",
    name: w("Bore and top"),
    says: w("The top for Z, a bore below it for X and Y."),
    writes: true,
    job: {
      cycles: [
        { name: "TOP", type: "surface", origin: [30, 0, 0] },
        {
          name: "BORE",
          type: "hole",
          diameter: 25,
          origin: [0, 0, "=TOP.z"],
        },
      ],
      datum: { x: "BORE.center.x", y: "BORE.center.y", z: "TOP.point.z" },
      limits: { position: 2 },
    },
  },
  {
    key: "plate",
    name: w("Plate with four bores"),
    says: w(
      "The origin in the middle of the bores, and the rotation from the line through two of them if the control supports it.",
    ),
    writes: true,
    job: {
      cycles: [
        hole("BORE1", -40, -25),
        hole("BORE2", 40, -25),
        hole("BORE3", 40, 25),
        hole("BORE4", -40, 25),
      ],
      relations: [
        { name: "LINE", type: "line", of: ["BORE1", "BORE2"] },
        {
          name: "MIDDLE",
          type: "center",
          of: ["BORE1", "BORE2", "BORE3", "BORE4"],
        },
      ],
      datum: {
        x: "MIDDLE.center.x",
        y: "MIDDLE.center.y",
        rotation: "LINE.rotation",
      },
    },
  },
  {
    key: "first-article",
    name: w("First article"),
    says: w(
      "A bore, a stud and a pocket with their tolerances: writes nothing and makes a report.",
    ),
    writes: false,
    job: {
      cycles: [
        { name: "BORE", type: "hole", diameter: "25 H7", origin: [0, 0, 0] },
        { name: "STUD", type: "boss", diameter: "20 h6", origin: [80, 0, 0] },
        {
          name: "POCKET",
          type: "internal-rectangle",
          width1: "60 ±0.05",
          width2: "40 ±0.05",
          origin: [0, 80, 0],
        },
      ],
    },
  },
  {
    key: "drift",
    name: w("Drift check"),
    says: w(
      "A bore before and after the other features: the program stops if it has moved. Writes nothing.",
    ),
    writes: false,
    job: {
      cycles: [
        hole("BEFORE", 0, 0),
        { name: "STUD", type: "boss", diameter: 20, origin: [80, 0, 0] },
        hole("AFTER", 0, 0),
      ],
      relations: ["x", "y"].map((axis) => ({
        name: `DRIFT${axis.toUpperCase()}`,
        type: "difference",
        of: [`AFTER.center.${axis}`, `BEFORE.center.${axis}`],
      })),
      tolerances: {
        "DRIFTX.difference": { tolerance: "±0.02", action: "stop" },
        "DRIFTY.difference": { tolerance: "±0.02", action: "stop" },
      },
    },
  },
];

/** The set-ups that the control of the job can write as their cards promise, in the form of the job or else in moves, and that the host page allows. */
export function readySetUps(present: CatalogView): ReadySetUp[] {
  if (!present.rules.allowsSetUps) return [];
  return SET_UPS.flatMap((entry) => {
    const job = suitable(present, entry);
    return job ? [{ entry, job }] : [];
  });
}

function suitable(present: CatalogView, entry: SetUpEntry): Draft | undefined {
  const { post, form } = present.draft.control as Draft;
  const types = (entry.job.cycles as { type: Cycle["type"] }[]).map(
    ({ type }) => type,
  );
  if (!types.every((type) => present.rules.offers("cycles", type)))
    return undefined;
  return [...new Set([form, "moves"] as Form[])]
    .filter(
      (one) =>
        present.rules.allowsForm(one) &&
        types.every((type) => present.formsOf(post, type).includes(one)),
    )
    .map((one) => jobOf(present, entry, one))
    .find((job) => keepsPromise(present, entry, job));
}

/** A set-up with the machine, feeds and units of the job in the form. */
function jobOf(
  present: CatalogView,
  { key, job, writes }: SetUpEntry,
  form: Form,
) {
  const { cycle: _, part, tolerances: __, ...rest } = present.draft;
  const mm = { format: 2, units: "mm", part: {}, ...job } as unknown as Job;
  const { limits, ...whole } = convertUnits(
    mm,
    present.units,
  ) as unknown as Draft;
  const control = rest.control as Draft;
  const { workOffsets = [1] } = present.rules.config?.allow ?? {};
  const first = workOffsets.find((one) => one !== null) ?? null;
  const made = {
    ...rest,
    ...whole,
    control: {
      ...control,
      form,
      workOffset: writes ? (control.workOffset ?? first) : null,
    },
    limits: { ...(rest.limits as Draft), ...(limits as Draft) },
    part: { ...(part as Draft), sizes: {} },
    name: key.toUpperCase(),
  };
  return { ...made, stock: proposedStock(made) } as Draft;
}

/** Whether a job writes every axis of its set-up and keeps every locked field. Not every control can write a rotation: the cards say so. */
function keepsPromise(
  { rules, draft }: CatalogView,
  { job, writes }: SetUpEntry,
  whole: Draft,
): boolean {
  const locked = rules.locked().filter((path) => !path.startsWith("cycle."));
  if (
    locked.some((path) => !alike(valueAt(whole, path), valueAt(draft, path))) ||
    rules.judged(whole).some(({ level }) => level === "error")
  )
    return false;
  try {
    const { results } = plan(whole as unknown as Job);
    const written: string[] = results.filter(isWritten).map(({ code }) => code);
    const { rotation: _, ...axes } = (job.datum ?? {}) as Draft;
    return writes
      ? Object.keys(axes).every((axis) => written.includes(`offset.${axis}`))
      : written.length === 0;
  } catch (thrown) {
    if (!(thrown instanceof JobError)) throw thrown;
    return false;
  }
}
