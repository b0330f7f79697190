// Types of the elements in Svelte markup: `import type {} from "touchpath-element/svelte"` in any file of a project.
import type { HTMLAttributes } from "svelte/elements";
import type {
  TouchPartAttributes,
  TouchPathAttributes,
  TouchPathListeners,
} from "./attributes.js";
import type { TouchPart, TouchPath } from "./element/element.js";

/** Properties that markup can set. */
export type TouchPathProps = Omit<
  HTMLAttributes<TouchPath>,
  keyof TouchPathListeners | keyof TouchPathAttributes
> &
  TouchPathAttributes &
  TouchPathListeners;

type Part = HTMLAttributes<TouchPart> & TouchPartAttributes;

declare module "svelte/elements" {
  interface SvelteHTMLElements {
    "touch-path": TouchPathProps;
    "touch-form": Part;
    "touch-picture": Part;
    "touch-program": Part;
  }
}
