// What the page is in.
import type { Theme } from "./menu.js";

/** The element around the page. */
export interface Host extends HTMLElement {
  theme: Theme;
  /** Dispatches an event; false where a listener has cancelled it. */
  tell(
    name: "program-save",
    detail: { name: string; text: string; post: string; extension: string },
  ): boolean;
}

/** What the element is in. */
export interface AppContext {
  host: Host;
  /** Whether presets, theme and language are kept in this browser. */
  local: boolean;
  /** Whether links are followed and handed out. */
  links: boolean;
  /** Whether it shows panels of the job of another element: without bar and foot, and in the language of that element. */
  isRemotePanel?: boolean;
}
