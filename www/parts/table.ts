import { html, type TemplateResult } from "lit";
import { exportTable, type Job } from "../core/browser.js";
import { Part } from "./part.js";

/** The parameter table of the source. Rows of a touch light up with it. */
class TablePart extends Part {
  private told = "";

  override render(): TemplateResult {
    const { plan, highlight, stale } = this.store;
    const lit = highlight === null ? null : (plan.moves[highlight]?.touch ?? null);
    const moveOf = (touch: number) => plan.moves.findIndex((m) => m.kind === "touch" && m.touch === touch);
    return html`
      <div class="tools">
        <button type="button" @click=${this.copy}>Copy as text</button>
        <button type="button" @click=${this.save}>Save .csv</button>
        <span role="status" class="told">${this.told}</span>
      </div>
      <div class=${stale ? "scroll stale" : "scroll"} tabindex="0" role="region" aria-label="Parameter table">
        <table>
          <thead><tr><th>Code</th><th>Type</th><th class="n">Value</th><th>Meaning</th></tr></thead>
          <tbody @mouseleave=${() => this.store.point(null)}>
            ${plan.table.map((row) => {
              const touch = row.touch;
              return html`<tr class=${touch !== null && touch === lit ? "lit" : ""} @mouseenter=${() => this.store.point(touch === null ? null : moveOf(touch))}>
                <td><code>${row.code}</code></td><td>${row.type}</td><td class="n">${row.value}</td>
                <td>${row.field ? html`<a href="#" @click=${(e: Event) => this.go(e, row.field as string)}>${row.meaning}</a>` : row.meaning}</td>
              </tr>`;
            })}
          </tbody>
        </table>
      </div>
    `;
  }

  private async copy(): Promise<void> {
    try {
      await navigator.clipboard.writeText(exportTable(this.store.shown as unknown as Job, "text"));
      this.told = "Copied";
    } catch {
      this.told = "The browser did not allow it";
    }
    this.requestUpdate();
  }

  private save(): void {
    const link = document.createElement("a");
    const text = exportTable(this.store.shown as unknown as Job, "csv");
    link.href = URL.createObjectURL(new Blob([text], { type: "text/csv" }));
    link.download = "parameters.csv";
    link.click();
    URL.revokeObjectURL(link.href);
  }

  private go(event: Event, path: string): void {
    event.preventDefault();
    this.dispatchEvent(new CustomEvent("go", { detail: path, bubbles: true }));
  }
}

customElements.define("tp-table", TablePart);
