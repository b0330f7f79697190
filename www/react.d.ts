// <touch-path> as a component, and what React's TSX knows of the bare tag: `import type {} from "touchpath/react"` in any file of a project.
import type { DetailedHTMLProps, HTMLAttributes, ReactElement } from "react";
import type { TouchPath as TouchPathElement, TouchPathEvents } from "./element/element.js";
import type { Config, Cycle, Job, PostId } from "./types.js";

/** The properties of `<touch-path>`. */
export type TouchPathProps = DetailedHTMLProps<HTMLAttributes<TouchPathElement>, TouchPathElement> & {
  config?: Config | string | null;
  job?: Job | string | null;
  cycle?: Cycle["type"] | null;
  post?: PostId | null;
  units?: "mm" | "inch" | null;
  theme?: "light" | "dark" | "auto";
  readonly?: boolean;
  panels?: string;
  mode?: "setter" | "cam";
  view?: "top" | "front" | "side" | "isometric";
  measured?: string | null;
  storage?: "none" | "local";
  links?: boolean;
  disabled?: boolean;
  name?: string;
} & { [K in keyof TouchPathEvents as `on${K}`]?: (event: TouchPathEvents[K]) => void };

/**
 * `<touch-path>` as a component, for React 19. In a tree that a server rendered React sets neither the properties nor the listeners of a custom element; this
 * sets them, and loads the element in the browser.
 */
export function TouchPath(props: TouchPathProps): ReactElement;

declare module "react" {
  namespace JSX {
    interface IntrinsicElements {
      "touch-path": TouchPathProps;
    }
  }
}
