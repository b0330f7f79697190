import { html, nothing, type TemplateResult } from "lit";
import type { Store } from "../store.js";

/** The one button that hands out the program: at the end of the bar, or of the foot where the page is narrow. It says why it cannot. */
export function saveButton(store: Store, withheld: string | null, save: () => void): TemplateResult {
  const file = store.fileName(store.post?.extension ?? "txt");
  // A program of this name is at the machine, perhaps: it is said before another one takes its place.
  const other =
    withheld === null && store.replaces(file)
      ? store.t("Other content than the {file} that was saved before", file)
      : "";
  return html`<button type="button" class="primary" ?disabled=${withheld !== null} aria-describedby=${withheld === null ? nothing : "withheld"}
        aria-label=${store.t("Save {file}", file)} title=${withheld ?? (other || nothing)} @click=${save}><span class="verb">${store.t("Save")} </span><span class="file">${file}</span>${other ? html`<span class="other" role="img" aria-label=${other}> ≠</span>` : nothing}</button>`;
}
