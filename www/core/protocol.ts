/**
 * The messages between a portal and the frame with `embed.html`. The portal sends one `hello` to the frame's window, with a port; everything
 * after it passes through that port. A later version keeps what this one names.
 */
import type { Config, Cycle, Finding, Job, Plan } from "./types.js";

/** The version of the protocol. */
export const PROTOCOL = 1;

/** What a portal can set; what is left out stays. */
export interface FrameState {
  /** What may be chosen, which fields are fixed, hidden or filled in. */
  config?: Config | string;
  job?: Job | string;
  cycle?: Cycle["type"];
  post?: string;
  units?: "mm" | "inch";
  theme?: "light" | "dark" | "auto";
  /** A BCP 47 tag. */
  lang?: string;
  readonly?: boolean;
  panels?: string;
  /** `cam` shows what only the author of a postprocessor needs. */
  mode?: "setter" | "cam";
  /** The view of the picture. */
  view?: "top" | "front" | "side" | "isometric";
  /** Measured points, results or a log, as text. */
  measured?: string;
  /** Colours and font: the values of the element's custom properties, which do not cross a frame. */
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

/** What the frame holds. */
export interface FrameView {
  /** The job in the form, including its errors. */
  job: Job;
  /** Its plan; `null` where it has errors. */
  plan: Plan | null;
  findings: Finding[];
  /** The measured points, as entered. */
  measured: string;
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

/** From the frame's window, where it does not take the hello. */
export interface Refused {
  touchpath: number;
  type: "refused";
  reason: string;
}

/** Through the port, to the frame. Each is answered, but `end`: the portal disconnects, and the frame saves programs as files again. */
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
  | { type: "job-change"; detail: { job: Job } }
  | { type: "plan-change"; detail: { plan: Plan } }
  | {
      type: "selection-change";
      detail: {
        move: number | null;
        line: number | null;
        touch: number | null;
        field: string | null;
      };
    }
  | { type: "measured-change"; detail: { measured: string } }
  | {
      type: "program-save";
      detail: { name: string; text: string; post: string; extension: string };
    }
  | { type: "finding"; detail: { findings: Finding[]; refused: boolean } };
