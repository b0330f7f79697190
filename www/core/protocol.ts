/**
 * Messages between a portal and a frame with `embed.html`. The portal sends one `hello` with a port to the frame's window; everything else passes through that
 * port. Later versions keep these messages.
 */
import type { EventDetails } from "./events.js";
import type { AnyJob, Config, Cycle, Finding, Plan } from "./types.js";

/** Version of the protocol. */
export const PROTOCOL = 1;

/** State that a portal can set; omitted values stay as they are. */
export interface FrameState {
  /** Rules of the portal: allowed choices, and fields that are fixed, hidden or filled in. */
  config?: Config | string;
  job?: AnyJob | string;
  cycle?: Cycle["type"];
  post?: string;
  units?: "mm" | "inch";
  theme?: "light" | "dark" | "auto";
  /** BCP 47 language tag. */
  lang?: string;
  readonly?: boolean;
  panels?: string;
  /** `cam` also shows what only authors of postprocessors need. */
  mode?: "setter" | "cam";
  /** The view of the picture. */
  view?: "top" | "front" | "side" | "isometric";
  /** `none` leaves undo to the portal. */
  history?: "session" | "none";
  /** Measured points, results or a log, as text. */
  measured?: string;
  /** Colours and font: values of the element's custom properties, which are not inherited into a frame. */
  appearance?: Partial<Record<Token, string>>;
}

/** The custom properties of the element without `--touchpath-`. */
export type Token =
  | "background"
  | "panel"
  | "text"
  | "accent"
  | "on-accent"
  | "font";

/** Content of the frame. */
export interface FrameView {
  /** The job in the form, including its errors. */
  job: AnyJob;
  /** Its plan; `null` if the job has errors. */
  plan: Plan | null;
  findings: Finding[];
  /** The measured points, as entered. */
  measured: string;
  /** Whether there is a step to undo, or to redo. */
  canUndo: boolean;
  canRedo: boolean;
}

/** An action that a portal can ask for. */
export type Deed =
  | { do: "save" }
  | { do: "undo" }
  | { do: "redo" }
  | { do: "highlight"; move: number | null };

/** To the frame's window, with a port. `saves`: the portal saves programs itself. */
export interface Hello {
  touchpath: number;
  type: "hello";
  saves: boolean;
}

/** From the frame's window if it refuses the hello. */
export interface Refused {
  touchpath: number;
  type: "refused";
  reason: string;
}

/** Through the port, to the frame. Each gets an answer except `end`, which disconnects: the frame saves programs as files again. */
export type Request =
  | { type: "set"; id: number; state: FrameState }
  | { type: "get"; id: number }
  | { type: "picture"; id: number }
  | { type: "do"; id: number; deed: Deed }
  | { type: "end" };

/** Through the port, from the frame. `ended`: another connection has replaced this one. */
export type Answer =
  | { type: "welcome"; version: string }
  | { type: "ended" }
  | { type: "done"; id: number }
  | { type: "state"; id: number; state: FrameView }
  | { type: "picture"; id: number; picture: string | null }
  | { type: "error"; id: number | null; message: string; findings: Finding[] }
  | {
      [K in keyof EventDetails]: { type: K; detail: EventDetails[K] };
    }[keyof EventDetails];
