// Saves files and copies to the clipboard.
import { html, nothing, type TemplateResult } from "lit";
import type { Store } from "../store.js";
import { w } from "../words.js";

/** Saves a text or bytes as a file. */
export function download(content: BlobPart, name: string, type: string): void {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([content], { type }));
  link.download = name;
  link.click();
  URL.revokeObjectURL(link.href);
}

/** Copies a text; returns false if the browser does not allow it. */
export async function copy(text: string): Promise<boolean> {
  try {
    await navigator.clipboard.writeText(text);
    return true;
  } catch {
    return false;
  }
}

/** Message about a copy. */
export const copied = (done: boolean): string =>
  done ? w("Copied") : w("The browser did not allow it");

/** Reason why nothing can be saved, beside the buttons for it; they refer to it by `aria-describedby`. */
export function withheld(
  store: Store,
  id: string,
): TemplateResult | typeof nothing {
  const why = store.withheld;
  return why === null
    ? nothing
    : html`<p class="problem error withheld" id=${id}><b>${store.t("Nothing to save or copy while the form has an error:")}</b> ${why}</p>`;
}
