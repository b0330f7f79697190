import { html, nothing, type TemplateResult } from "lit";
import type { Store } from "../store.js";

/** Warning about a file name under which another program was saved before, which may be at the machine. Empty without one. */
export function replaced(store: Store): string {
  const file = store.fileName(store.plan.program.extension);
  return !store.stale && store.replaces(file)
    ? store.t("{file} was saved before with other content", file)
    : "";
}

/** The save button: at the end of the bar, or of the footer on a narrow page. It gives the reason if the program cannot be saved. */
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
