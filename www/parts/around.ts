// Surroundings of the page.
import type { Theme } from "./menu.js";

/** The element that contains the page. */
export interface Host extends HTMLElement {
  theme: Theme;
  /** Dispatches an event; returns false if a listener cancels it. */
  tell(
    name: "program-save",
    detail: { name: string; text: string; post: string; extension: string },
  ): boolean;
}

/** Surroundings of the element. */
export interface AppContext {
  host: Host;
  /** Whether presets, theme and language are stored in this browser. */
  local: boolean;
  /** Whether the page follows and offers links. */
  links: boolean;
  /** Whether it shows panels of another element's job: without bar and footer, in the language of that element. */
  isRemotePanel?: boolean;
}
