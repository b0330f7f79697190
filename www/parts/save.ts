import { html, nothing, type TemplateResult } from "lit";
import type { Store } from "../store.js";

/** What is said of a program whose file held another one when it was saved before: that may be at the machine. Empty where it did not. */
export function replaced(store: Store): string {
  const file = store.fileName(store.plan.program.extension);
  return !store.stale && store.replaces(file)
    ? store.t("{file} was saved before with other content", file)
    : "";
}

/** The one button that hands out the program: at the end of the bar, or of the foot where the page is narrow. It says why it cannot. */
export function saveButton(
  store: Store,
  withheld: string | null,
  save: () => void,
): TemplateResult {
  const file = store.fileName(store.post?.extension ?? "txt");
  const other = withheld === null ? replaced(store) : "";
  return html`<button type="button" class="primary" ?disabled=${withheld !== null} aria-describedby=${withheld === null ? nothing : "withheld"}
        aria-label=${store.t("Save {file}", file)} title=${withheld ?? (other || nothing)} @click=${save}><span class="verb">${store.t("Save")} </span><span class="file">${file}</span></button>`;
}
