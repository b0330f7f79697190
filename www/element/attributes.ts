// Attributes and properties of the elements: inputs and keywords.
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

/** Attributes that are inputs. */
export const INPUTS = ["config", "job", "cycle", "post", "units"] as const;
/** Properties that are inputs. */
export type Input = (typeof INPUTS)[number] | "measured";
/** Text of an object that a server has written into an attribute. The property with the object follows. */
export const OBJECT_AS_TEXT = "[object Object]";
/** Inputs that are set together: the others complete values that the job omits. */
export type Inputs = Partial<Record<Input, unknown>>;

/** Keyword attributes with their values. An unknown value changes nothing. */
export const WORDS = {
  theme: ["light", "dark", "auto"],
  panels: [...PANEL_NAMES, "none"],
  mode: ["setter", "cam"],
  view: ["top", "front", "side", "isometric"],
  storage: ["none", "local"],
  history: ["session", "none"],
} as const;
export type Wordy = keyof typeof WORDS;
export const isWordy = (name: string): name is Wordy =>
  Object.hasOwn(WORDS, name);

/** Whether a value is one of the keywords; for panels, a list of them. */
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
