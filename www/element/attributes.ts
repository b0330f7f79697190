// The attributes and properties of the elements: which are inputs, and which are words.
import type { PanelName } from "../core/types.js";

export type Theme = "light" | "dark" | "auto";
export type View = "top" | "front" | "side" | "isometric";

export const PANEL_NAMES: PanelName[] = [
  "form",
  "stage",
  "program",
  "table",
  "results",
  "checks",
];

/** The attributes that are inputs. */
export const INPUTS = ["config", "job", "cycle", "post", "units"] as const;
/** The properties that are inputs. */
export type Input = (typeof INPUTS)[number] | "measured";
/** What is set at one time: what a job leaves out, the others say. */
export type Inputs = Partial<Record<Input, unknown>>;

/** The attributes that are words, and which there are. One that is not known changes nothing. */
export const WORDS = {
  theme: ["light", "dark", "auto"],
  panels: [...PANEL_NAMES, "none"],
  mode: ["setter", "cam"],
  view: ["top", "front", "side", "isometric"],
  storage: ["none", "local"],
} as const;
export type Wordy = keyof typeof WORDS;
export const isWordy = (name: string): name is Wordy =>
  Object.hasOwn(WORDS, name);

/** Whether a value is one of the words; of panels, some of them. */
export function isKnown(name: Wordy, value: unknown): boolean {
  const words =
    name === "panels" && typeof value === "string"
      ? value.split(/\s+/).filter(Boolean)
      : [value];
  return (
    words.length > 0 &&
    words.every((word) => (WORDS[name] as readonly unknown[]).includes(word))
  );
}
