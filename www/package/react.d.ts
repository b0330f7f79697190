// `<touch-path>` as a component, and the types of the plain tags in TSX: `import type {} from "touchpath-element/react"` in any file of a project.
import type { DetailedHTMLProps, HTMLAttributes, ReactElement } from "react";
import type {
  TouchPartAttributes,
  TouchPathAttributes,
  TouchPathHandlers,
  TouchPathListeners,
} from "./attributes.js";
import type {
  TouchPart,
  TouchPath as TouchPathElement,
} from "./element/element.js";

/** The properties of the bare tag `<touch-path>`. */
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

/** The properties of the component `TouchPath`. */
export type TouchPathComponentProps = Omit<
  TouchPathProps,
  keyof TouchPathHandlers | "onLoad" | "onError"
> &
  TouchPathHandlers & {
    /** The element is loaded and shown. */
    onLoad?: (event: Event) => void;
    /** The element could not be loaded. */
    onError?: (event: ErrorEvent) => void;
  };

/**
 * `<touch-path>` as a component for React 19. In a tree that was rendered on a server, React sets neither properties nor listeners of a custom element. The
 * component sets them and loads the element in the browser.
 */
export function TouchPath(props: TouchPathComponentProps): ReactElement;

/** `<touch-form>` as a component: the form of a `<touch-path>` elsewhere on the page. */
export function TouchForm(props: TouchPartProps): ReactElement;

/** `<touch-picture>` as a component. */
export function TouchPicture(props: TouchPartProps): ReactElement;

/** `<touch-program>` as a component. */
export function TouchProgram(props: TouchPartProps): ReactElement;

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
