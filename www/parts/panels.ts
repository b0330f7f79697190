// Panels of the page: their names, and the width from which they are side by side.
import { w } from "../words.js";

export const PANELS = {
  setup: w("Setup"),
  results: w("Results"),
  program: w("Program"),
  table: w("Parameters"),
  measured: w("Measured values, report"),
  checks: w("Checks"),
} as const;
/** Short label for a narrow tab. */
export const MEASURED = w("Measured");
export type Panel = keyof typeof PANELS;
export const NAME_OF = {
  setup: "form",
  results: "results",
  program: "program",
  table: "table",
  measured: "results",
  checks: "checks",
} as const satisfies Record<Panel, string>;
/** Panels that the element can omit. */
export type PanelName = "stage" | (typeof NAME_OF)[Panel];

/** From this width on the form has its own column; the style sheet uses the same width. */
export const WIDE = 1080;
/** Below this width the picture is above the panel; the style sheet uses the same width. */
export const NARROW = 600;
