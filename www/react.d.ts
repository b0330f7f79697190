// What React's TSX knows of <touch-path>: `import type {} from "touchpath/react"` in any file of a project.
import type { DetailedHTMLProps, HTMLAttributes } from "react";
import type { TouchPath, TouchPathEvents } from "./element/element.js";
import type { Cycle, Job, PostId } from "./types.js";

/** The properties of `<touch-path>` in React 19, which sets properties and listens to events by itself. */
export type TouchPathProps = DetailedHTMLProps<HTMLAttributes<TouchPath>, TouchPath> & {
  job?: Job | string | null;
  cycle?: Cycle["type"] | null;
  post?: PostId | null;
  units?: "mm" | "inch" | null;
  theme?: "light" | "dark" | "auto";
  readonly?: boolean;
  panels?: string;
  mode?: "setter" | "cam";
  storage?: "none" | "local";
  links?: boolean;
  name?: string;
} & { [K in keyof TouchPathEvents as `on${K}`]?: (event: TouchPathEvents[K]) => void };

declare module "react" {
  namespace JSX {
    interface IntrinsicElements {
      "touch-path": TouchPathProps;
    }
  }
}
