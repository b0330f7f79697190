// Attributes of the elements, as the types of frameworks need them.

import type { AnyJob, Config, Cycle, PostId } from "touchpath";
import type { TouchPath, TouchPathEvents } from "./element/element.js";

/** The properties of `<touch-path>`. */
export interface TouchPathAttributes {
  config?: Config | string | null;
  job?: AnyJob | string | null;
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
  history?: "session" | "none";
  links?: boolean;
  disabled?: boolean;
  name?: string;
}

/** The properties of `<touch-form>`, `<touch-picture>` and `<touch-program>`. */
export interface TouchPartAttributes {
  for?: string;
  session?: TouchPath | null;
  panels?: string | null;
}

/** `job-change` as `JobChange`. */
type Camel<S extends string> = S extends `${infer A}-${infer B}`
  ? `${Capitalize<A>}${Camel<B>}`
  : Capitalize<S>;

/** The listeners of `<touch-path>` as components have them: `onChange`, `onJobChange`. */
export type TouchPathHandlers = {
  [K in keyof TouchPathEvents as `on${Camel<K>}`]?: (
    event: TouchPathEvents[K],
  ) => void;
};

/** The listeners of `<touch-path>`, as React and Svelte have them: `onjob-change`. */
export type TouchPathListeners = {
  [K in keyof TouchPathEvents as `on${K}`]?: (
    event: TouchPathEvents[K],
  ) => void;
};
