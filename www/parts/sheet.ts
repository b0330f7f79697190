import { html, nothing, type TemplateResult } from "lit";
import type { FieldEntry } from "../core/browser.js";
import { checked } from "./checks.js";
import { Drawing } from "./drawing.js";
import { Part } from "./part.js";

/** One page to print and to take to the machine: picture, dimensions, what will be measured, checks, and boxes for what was. */
class SheetPart extends Part {
  protected override follows = ["change"];
  private drawing?: Drawing;
  /** What was drawn on, and the form that was drawn. */
  private drawn: { canvas?: HTMLCanvasElement; revision: number } = { revision: -1 };
  /** The hash of the program that is on the sheet. */
  private hash = { of: "", hex: "" };

  override render(): TemplateResult {
    const { withheld } = this.store;
    const back = html`<button type="button" @click=${() => this.dispatchEvent(new CustomEvent("closed", { bubbles: true }))}>Back to the job</button>`;
    if (withheld !== null) {
      return html`<div class="tools">${back}</div><p class="problem error"><b>No setup sheet while the form has an error:</b> ${withheld}</p>`;
    }
    const { plan, units, catalog, shown, cycle } = this.store;
    const { program } = plan;
    const post = catalog.posts.find((p) => p.id === program.post);
    const offset = this.store.get("control.workOffset");
    const writes =
      typeof offset === "number"
        ? `writes ${post?.workOffsetWords[offset - 1] ?? offset}`
        : "measures only, writes no offset";
    const number = (x: number | null) => (x === null ? "–" : x.toFixed(units === "inch" ? 4 : 3));
    const feeds = shown.feeds as Record<string, number | null>;
    const stylus = shown.stylus as Record<string, unknown>;
    return html`
      <div class="tools screen">
        <button type="button" class="primary" @click=${() => print()}>Print</button>
        ${back}
      </div>
      <article aria-label="Setup sheet">
        <h2>${String(shown.name || "PROBE")}: ${cycle.title}</h2>
        <p>${cycle.source} · ${post?.title ?? program.post}, ${writes} · all lengths in ${units} · file ${this.store.fileName(program.extension)}</p>
        <div class="upper">
          <canvas role="img" aria-label="Path of the probe from the top"></canvas>
          <table>
            <caption>Dimensions and probe</caption>
            <tbody>
              ${cycle.fields.map((f) => this.row(`cycle.${f.key}`, f))}
              ${cycle.sections.map(({ key, fields }) => (this.store.get(`cycle.${key}`) === null ? nothing : fields.map((f) => this.row(`cycle.${key}.${f.key}`, f))))}
              <tr><td>Ball diameter</td><td class="n">${String(stylus.diameter)}</td><td></td></tr>
              ${
                cycle.ownFeeds
                  ? nothing
                  : html`<tr><td>Overtravel</td><td class="n">${String(shown.overtravel)}</td><td></td></tr>
                <tr><td>Touch feed</td><td class="n">${feeds.work}</td><td></td></tr>`
              }
            </tbody>
          </table>
        </div>
        <table>
          <caption>What the control is expected to report, and what it reported</caption>
          <thead><tr><th>Result</th><th class="n">Nominal</th><th class="n">Expected</th><th class="n">± 2σ</th><th>Reported</th></tr></thead>
          <tbody>${plan.results.map(
            (
              r,
            ) => html`<tr><td>${r.meaning} <code>${r.code}</code></td><td class="n">${number(r.nominal)}</td><td class="n">${number(r.value)}</td>
              <td class="n">${r.uncertainty === null ? "–" : (2 * r.uncertainty).toFixed(4)}</td><td class="box"></td></tr>`,
          )}</tbody>
        </table>
        <table>
          <caption>Touches: contact on the surface</caption>
          <thead><tr><th>Touch</th><th class="n">X</th><th class="n">Y</th><th class="n">Z</th><th>Checked</th></tr></thead>
          <tbody>${plan.touches.map((t, k) => html`<tr><td>${k + 1}</td>${t.point.map((x) => html`<td class="n">${number(x)}</td>`)}<td class="box"></td></tr>`)}</tbody>
        </table>
        <p>${checked(plan)}.</p>
        ${plan.findings.filter((f) => f.level === "warning").map((f) => html`<p class="warning"><b>Warning:</b> ${f.message}</p>`)}
        <p class="hash">SHA-256 of the program: <code>${this.hash.of === program.text ? this.hash.hex : "…"}</code></p>
        <p class="sign">Machine <span></span> Date <span></span> Name <span></span></p>
      </article>
    `;
  }

  /** What a field says; the postprocessor's own are no part of a set-up. */
  private row(path: string, field: FieldEntry): TemplateResult | typeof nothing {
    const held = this.store.get(path);
    const value = held === undefined ? this.store.standIn(field) : (held ?? field.null);
    if (value === null || value === undefined || field.group.startsWith("Postprocessor")) return nothing;
    return html`<tr><td>${field.label}</td><td class="n">${Array.isArray(value) ? value.join(" ") : String(value)}</td><td><code>${field.code ?? ""}</code></td></tr>`;
  }

  override disconnectedCallback(): void {
    super.disconnectedCallback();
    this.store.removeEventListener("recolour", this.dress);
    this.drawing?.free();
    this.drawing = undefined;
    this.drawn = { revision: -1 };
  }

  override connectedCallback(): void {
    super.connectedCallback();
    this.store.addEventListener("recolour", this.dress);
    // Moved to another place of the page, it has lost its drawing.
    this.requestUpdate();
  }

  private readonly dress = () => this.drawing?.dress();

  protected override updated(): void {
    const canvas = this.querySelector("canvas");
    if (!canvas) return;
    // With an error in the form the canvas goes, and with it what drew on it.
    if (this.drawn.canvas !== canvas) {
      this.drawing?.free();
      this.drawing = new Drawing(canvas, (view) => view.show(this.store.shown));
    } else if (this.drawn.revision !== this.store.revision) this.drawing?.use((view) => view.show(this.store.shown));
    this.drawn = { canvas, revision: this.store.revision };
    this.drawing?.dress();
    const { text } = this.store.plan.program;
    if (this.hash.of !== text) this.sum(text);
  }

  /** A page that is not served securely has no hash to give. */
  private async sum(text: string): Promise<void> {
    this.hash = { of: text, hex: "…" };
    const bytes = await crypto.subtle?.digest("SHA-256", new TextEncoder().encode(text));
    if (this.hash.of !== text) return;
    const hex = bytes && Array.from(new Uint8Array(bytes), (b) => b.toString(16).padStart(2, "0")).join("");
    this.hash = { of: text, hex: hex ?? "not to be had on this page" };
    this.requestUpdate();
  }
}

customElements.define("tp-sheet", SheetPart);
