import { html, type TemplateResult } from "lit";
import { Part } from "./part.js";

/** Every finding in one place; a click goes to its field. */
class FindingsPart extends Part {
  protected override follows = ["change"];

  override render(): TemplateResult {
    const { findings } = this.store;
    const count = (level: string) => findings.filter((f) => f.level === level).length;
    const plural = (n: number, word: string) => (n === 0 ? [] : [`${n} ${word}${n === 1 ? "" : "s"}`]);
    const words = [
      ...plural(count("error"), "error"),
      ...plural(count("warning"), "warning"),
      ...plural(count("info"), "note"),
    ];
    if (findings.length === 0) return html`<p class="fine" role="status">No problems found</p>`;
    return html`
      <details ?open=${count("error") > 0}>
        <summary><span role="status" class=${count("error") ? "bad" : ""}>${words.join(", ")}</span></summary>
        <ul>
          ${findings.map(
            (f) => html`<li class=${f.level}><span class="level">${f.level}</span> ${f.message}
              ${f.path ? html`<a href="#" @click=${(e: Event) => this.go(e, f.path)}>${f.path}</a>` : ""}</li>`,
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
