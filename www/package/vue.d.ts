// Types of the elements in Vue templates: `import type {} from "touchpath-element/vue"` in any file of a project.
import type { HTMLAttributes, PublicProps } from "vue";
import type {
  TouchPartAttributes,
  TouchPathAttributes,
  TouchPathHandlers,
} from "./attributes.js";

/** Properties that a template can set. A listener for `job-change` is `@job-change` there, which Vue types as `onJobChange`. */
export type TouchPathProps = TouchPathAttributes &
  TouchPathHandlers &
  Omit<HTMLAttributes, keyof TouchPathHandlers>;

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
