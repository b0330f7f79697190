// Types of the elements in Vue templates: `import type {} from "touchpath/vue"` in any file of a project.
import type { HTMLAttributes, PublicProps } from "vue";
import type { TouchPartAttributes, TouchPathAttributes } from "./attributes.js";
import type { TouchPathEvents } from "./element/element.js";

/** A listener for `job-change` is `@job-change` in a template, which Vue types as `onJobChange`. */
type Camel<S extends string> = S extends `${infer A}-${infer B}`
  ? `${A}${Capitalize<Camel<B>>}`
  : S;

/** Properties that a template can set. */
export type TouchPathProps = TouchPathAttributes &
  HTMLAttributes & {
    [K in keyof TouchPathEvents as `on${Capitalize<Camel<K & string>>}`]?: (
      event: TouchPathEvents[K],
    ) => void;
  };

type Part = new () => {
  $props: TouchPartAttributes & HTMLAttributes & PublicProps;
  $slots: object;
};

declare module "vue" {
  interface GlobalComponents {
    "touch-path": new () => {
      $props: TouchPathProps & PublicProps;
      $slots: object;
    };
    "touch-form": Part;
    "touch-picture": Part;
    "touch-program": Part;
  }
}
