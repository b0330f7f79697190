// Defines the elements. This file is small: it loads the rest and the WebAssembly module when the first element enters a document.
import type { TouchPathEvents } from "./core/events.js";
import { TouchForm, TouchPicture, TouchProgram } from "./element/touch-part.js";
import { TouchPath } from "./element/touch-path.js";

export type {
  ChangeReason,
  EventDetails,
  Selection,
  TouchPathEvents,
} from "./core/events.js";
export type { AnyJob, PanelName } from "./core/types.js";
export {
  TouchForm,
  TouchPart,
  TouchPicture,
  TouchProgram,
} from "./element/touch-part.js";
export { TouchPath } from "./element/touch-path.js";

declare global {
  interface HTMLElementTagNameMap {
    "touch-path": TouchPath;
    "touch-form": TouchForm;
    "touch-picture": TouchPicture;
    "touch-program": TouchProgram;
  }
  // Every element has a `change` event; that of `<touch-path>` is typed by its own `addEventListener`.
  interface HTMLElementEventMap extends Omit<TouchPathEvents, "change"> {}
}

// If another version has defined the elements, they stay. This version can be defined under another name.
if (globalThis.customElements) {
  if (!customElements.get("touch-path"))
    customElements.define("touch-path", TouchPath);
  if (!customElements.get("touch-form"))
    customElements.define("touch-form", TouchForm);
  if (!customElements.get("touch-picture"))
    customElements.define("touch-picture", TouchPicture);
  if (!customElements.get("touch-program"))
    customElements.define("touch-program", TouchProgram);
}

/**
 * Defines the element of this version under another name, for a page that holds another version as `touch-path`. Panels elsewhere on the page are elements
 * `<touch-form>`, `<touch-picture>` and `<touch-program>` of either version. Throws if the name is taken or is no valid element name. Does nothing without a
 * document.
 */
export function define(name: string): void {
  if (!globalThis.customElements) return;
  // A second copy of the same version uses the classes that the first has defined.
  const known = customElements.get("touch-path") as
    | typeof TouchPath
    | undefined;
  const version = known?.version === TouchPath.version ? known : TouchPath;
  customElements.define(name, class extends version {});
}
