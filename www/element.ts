// The elements. This file is small and loads the rest, with the WebAssembly module beside it, when the first element is put into a document.
import type { TouchPathEvents } from "./element/events.js";
import { TouchForm, TouchPicture, TouchProgram } from "./element/touch-part.js";
import { TouchPath } from "./element/touch-path.js";

export type { PanelName } from "./core/types.js";
export type { Selection, TouchPathEvents } from "./element/events.js";
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
  interface HTMLElementEventMap extends TouchPathEvents {}
}

// Where another version of this file was first, its elements stay: this one can be had by another name.
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
 * Gives the whole element of this version a name of its own, for a page that holds another version as `touch-path`. Its panels elsewhere on the page are those
 * of `<touch-form>`, `<touch-picture>` and `<touch-program>`, whichever version these are of. Throws where the name is taken or not valid for an element; does
 * nothing where there is no document.
 */
export function define(name: string): void {
  if (!globalThis.customElements) return;
  // A second copy of one version shares what the first has defined inside.
  const known = customElements.get("touch-path") as
    | typeof TouchPath
    | undefined;
  const version = known?.version === TouchPath.version ? known : TouchPath;
  customElements.define(name, class extends version {});
}
