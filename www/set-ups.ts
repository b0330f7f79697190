// Ready set-ups to begin a job with: several features that belong together, and what is written from them.
import type { Draft } from "./job.js";
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
      "The top for Z, two walls for X and Y, and for the rotation where the control takes one.",
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
      "The origin in the middle of the bores, and the rotation from the line through two of them where the control takes one.",
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
      "A bore, a stud and a pocket with their tolerances: nothing is written, a report is made.",
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
];
