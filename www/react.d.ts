// `<touch-path>` as a component, and the types of the plain tags in TSX: `import type {} from "touchpath/react"` in any file of a project.
import type { DetailedHTMLProps, HTMLAttributes, ReactElement } from "react";
import type {
  TouchPartAttributes,
  TouchPathAttributes,
  TouchPathListeners,
} from "./attributes.js";
import type {
  TouchPart,
  TouchPath as TouchPathElement,
} from "./element/element.js";

/** The properties of `<touch-path>`. */
export type TouchPathProps = DetailedHTMLProps<
  HTMLAttributes<TouchPathElement>,
  TouchPathElement
> &
  TouchPathAttributes &
  TouchPathListeners;

/** Properties of the elements that show panels of another element's job. */
export type TouchPartProps = DetailedHTMLProps<
  HTMLAttributes<TouchPart>,
  TouchPart
> &
  TouchPartAttributes;

/**
 * `<touch-path>` as a component for React 19. In a tree that was rendered on a server, React sets neither properties nor listeners of a custom element. The
 * component sets them and loads the element in the browser.
 */
export function TouchPath(props: TouchPathProps): ReactElement;

declare module "react" {
  namespace JSX {
    interface IntrinsicElements {
      "touch-path": TouchPathProps;
      "touch-form": TouchPartProps;
      "touch-picture": TouchPartProps;
      "touch-program": TouchPartProps;
    }
  }
}
