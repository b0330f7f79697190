import { html, nothing, type TemplateResult } from "lit";
import type { Finding } from "../core/browser.js";
import { Part } from "./part.js";

const LEVELS = ["error", "warning", "info"] as const;
const NAMES = { error: "error", warning: "warning", info: "note" } as const;

/** Every finding in one place: how many, and what the gravest says, in a line of steady height; the list on request. */
class FindingsPart extends Part {
  protected override follows = ["change"];

  override render(): TemplateResult {
    const { findings } = this.store;
    const of = (level: Finding["level"]) => findings.filter((f) => f.level === level);
    const words = LEVELS.flatMap((level) => {
      const n = of(level).length;
      return n === 0 ? [] : [`${n} ${NAMES[level]}${n === 1 ? "" : "s"}`];
    });
    const worst = LEVELS.flatMap(of)[0];
    if (!worst) return html`<p class="fine" role="status">No problems found</p>`;
    return html`
      <details>
        <summary class=${worst.level}><span role="status"><b>${words.join(", ")}:</b> ${worst.message}</span></summary>
        <ul>
          ${LEVELS.flatMap(of).map(
            (f) => html`<li class=${f.level}><span class="level">${NAMES[f.level]}</span> ${f.message}
              ${f.path ? html`<a href="#" @click=${(e: Event) => this.go(e, f.path)}>${f.path}</a>` : nothing}</li>`,
          )}
        </ul>
      </details>
    `;
  }

  private go(event: Event, path: string): void {
    event.preventDefault();
    this.dispatchEvent(new CustomEvent("go", { detail: path, bubbles: true }));
  }
}

customElements.define("tp-findings", FindingsPart);
