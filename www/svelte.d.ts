// What Svelte's markup knows of <touch-path>: `import type {} from "touchpath/svelte"` in any file of a project.
import type { HTMLAttributes } from "svelte/elements";
import type { TouchPathAttributes, TouchPathListeners } from "./attributes.js";
import type { TouchPath } from "./element/element.js";

/** What the markup gives the element. */
export type TouchPathProps = Omit<HTMLAttributes<TouchPath>, keyof TouchPathListeners | keyof TouchPathAttributes> &
  TouchPathAttributes &
  TouchPathListeners;

declare module "svelte/elements" {
  interface SvelteHTMLElements {
    "touch-path": TouchPathProps;
  }
}
