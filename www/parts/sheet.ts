import { html, nothing, type TemplateResult } from "lit";
import type { FieldEntry, PageView } from "../core/browser.js";
import { deviations, ofRunout, resultInWords } from "../sentences.js";
import { checked } from "./checks.js";
import { Drawing, label } from "./drawing.js";
import { Part } from "./part.js";

/** What a program says before its blocks, from the units on: what must be so before the start, and what it does. */
function conditions(text: string): string[] {
  const said = [];
  for (const line of text.split("\n")) {
    const comment = /^(?:\d+ )?[;(] ?(.*?)\)?$/.exec(line)?.[1];
    if (/^Made by /i.test(comment ?? "") || (comment === undefined && said.length > 0)) break;
    if (comment !== undefined && (said.length > 0 || /^Units /i.test(comment))) said.push(comment);
  }
  return said;
}

/** Of a sheet with more results than these the print is smaller: it is one page. */
const MANY_RESULTS = 12;

/** One page to print and to take to the machine: picture, dimensions, what will be measured, checks, and boxes for what was. */
class SheetPart extends Part {
  protected override follows = ["change"];
  private drawing?: Drawing;
  /** What was drawn on, and the form that was drawn. */
  private drawn: { canvas?: HTMLCanvasElement; form: string } = { form: "" };
  /** The hash of the program that is on the sheet. */
  private hash = { of: "", hex: "" };

  override render(): TemplateResult {
    const { withheld } = this.store;
    if (withheld !== null) {
      return html`<p class="problem error"><b>${this.t("No setup sheet while the form has an error:")}</b> ${withheld}</p>`;
    }
    const { plan, units, shown: job, cycle } = this.store;
    const { program } = plan;
    const post = this.store.postOf(program.post);
    const computes = !this.store.bare;
    const head = conditions(program.text);
    const shown = (x: unknown) => (typeof x === "number" ? this.store.number(String(x)) : String(x));
    const number = (x: number | null) =>
      x === null ? "–" : this.store.number(x.toFixed(units === "inch" ? 4 : 3).replace(/^-(0\.0*)$/, "$1"));
    const off = deviations(this.store);
    const sigmas = (x: number | null) => this.store.number((2 * (x ?? 0)).toFixed(4));
    const eccentric = ofRunout(plan.results, (r) => `${r.code} ${sigmas(r.uncertaintyRunout)}`);
    const feeds = job.feeds as Record<string, number | null>;
    const stylus = job.stylus as Record<string, unknown>;
    return html`
      <div class="tools screen">
        <button type="button" class="primary" @click=${() => print()}>${this.t("Print")}</button>
      </div>
      <article aria-label=${this.t("Setup sheet")}>
        <h2>${String(job.name || "PROBE")}: ${cycle.title}</h2>
        <p>${cycle.source} · ${post?.title ?? program.post}, ${this.store.does} · ${this.t("all lengths in {units} · file {file}", units, this.store.fileName(program.extension))}</p>
        ${off.length > 0 ? html`<p class="warning"><b>${this.t("What is expected is that of the virtual part, not of the drawing:")}</b> ${off.join(", ")}</p>` : nothing}
        <div class=${plan.results.length > MANY_RESULTS ? "columns dense" : "columns"}>
          <div>
            <canvas role="img" aria-label=${this.t("Path of the probe from the top")}></canvas>
            <table>
              <caption>${computes ? this.t("What the control is expected to report, and what it reported") : this.t("What the touches are expected to give: this control computes no results")}</caption>
              <thead><tr><th>${this.t("Result")}</th><th class="n">${this.t("Nominal")}</th><th class="n">${this.t("Expected")}</th><th class="n">± 2σ</th><th>${computes ? this.t("Reported") : this.t("Worked out")}</th></tr></thead>
              <tbody>${plan.results.map(
                (
                  r,
                ) => html`<tr><td>${resultInWords(this.store, r)} <code>${r.code}</code></td><td class="n">${number(r.nominal)}${r.limits ? html`<br /><small>${this.t("{min} to {max}", number(r.limits[0]), number(r.limits[1]))}</small>` : nothing}</td><td class="n">${r.unit === "" ? r.value : number(r.value)}</td>
                  <td class="n">${r.uncertainty === null ? "–" : sigmas(r.uncertainty)}</td><td class="box"></td></tr>`,
              )}</tbody>
            </table>
            ${eccentric ? html`<p>${this.t("The ball's eccentricity accounts for this much of ± 2σ: {list}", eccentric)}</p>` : nothing}
          </div>
          <div>
            <table>
              <caption>${this.t("Dimensions and probe")}</caption>
              <tbody>
                ${cycle.fields.map((f) => this.row(`cycle.${f.key}`, f))}
                ${cycle.sections.map(({ key, fields }) => (this.store.get(`cycle.${key}`) === null ? nothing : fields.map((f) => this.row(`cycle.${key}.${f.key}`, f))))}
                <tr><td>${this.t("Ball diameter")}</td><td class="n">${shown(stylus.diameter)}</td><td></td></tr>
                ${
                  cycle.ownFeeds
                    ? nothing
                    : html`<tr><td>${this.t("Overtravel")}</td><td class="n">${shown(job.overtravel)}</td><td></td></tr>
                  <tr><td>${this.store.fieldAt("feeds.work")?.label}</td><td class="n">${shown(feeds.work)} ${units}/min</td><td></td></tr>`
                }
              </tbody>
            </table>
            <table>
              <caption>${this.t("Touches: contact on the surface")}</caption>
              <thead><tr><th>${this.t("Touch no.")}</th><th class="n">X</th><th class="n">Y</th><th class="n">Z</th><th>${this.t("Checked")}</th></tr></thead>
              <tbody>${plan.touches.map((t, k) => html`<tr><td>${k + 1}</td>${t.point.map((x) => html`<td class="n">${number(x)}</td>`)}<td class="box"></td></tr>`)}</tbody>
            </table>
            ${head.length ? html`<div class="head"><b>${this.t("The program says:")}</b>\n${head.join("\n")}</div>` : nothing}
          </div>
        </div>
        <p>${checked(this.store)}.${this.reasons().map((why) => ` ${why}.`)}</p>
        ${plan.findings.filter((f) => f.level === "warning").map((f) => html`<p class="warning"><b>${this.t("Warning:")}</b> ${this.message(f)}</p>`)}
        <p class="hash">${this.t("SHA-256 of the program:")} <code>${this.hash.of === program.text ? this.hash.hex : "…"}</code></p>
        <p class="sign">${this.t("Machine")} <span></span> ${this.t("Date")} <span></span> ${this.t("Name")} <span></span></p>
      </article>
    `;
  }

  /** Why this control cannot hold some of the rules, each reason once. */
  private reasons(): string[] {
    const unable = this.store.plan.safety.filter((rule) => rule.holds === null);
    return [...new Set(unable.map((rule) => this.store.say(rule.said)))];
  }

  /** What a field says; the postprocessor's own are no part of a set-up. */
  private row(path: string, field: FieldEntry): TemplateResult | typeof nothing {
    const held = this.store.get(path);
    const value = held === undefined ? this.store.standIn(field) : (held ?? field.null);
    const idle = field.group.startsWith("Postprocessor") || !this.store.counts(path, field);
    if (value === null || value === undefined || idle) return nothing;
    const words = (x: unknown) => {
      if (typeof x === "boolean") return x ? this.t("on") : this.t("off");
      const choice = field.choices.find((c) => c.value === x)?.label;
      return choice ?? (typeof x === "number" ? this.store.number(String(x)) : String(x));
    };
    return html`<tr><td>${field.label}</td><td class="n">${(Array.isArray(value) ? value : [value]).map(words).join(" ")}${field.unit === "angle" ? "°" : ""}</td><td><code>${field.code ?? ""}</code></td></tr>`;
  }

  override disconnectedCallback(): void {
    super.disconnectedCallback();
    this.store.removeEventListener("recolour", this.restyle);
    this.drawing?.free();
    this.drawing = undefined;
    this.drawn = { form: "" };
  }

  override connectedCallback(): void {
    super.connectedCallback();
    this.store.addEventListener("recolour", this.restyle);
    // Moved to another place of the page, it has lost its drawing.
    this.requestUpdate();
  }

  private show(view: PageView): void {
    label(view, this.store);
    view.hideHandles();
    view.show(this.store.shown);
  }

  private readonly restyle = () => this.drawing?.restyle();

  protected override updated(): void {
    const canvas = this.querySelector("canvas");
    if (!canvas) return;
    const form = `${this.store.revision} ${this.store.lang}`;
    // With an error in the form the canvas goes, and with it what drew on it.
    if (this.drawn.canvas !== canvas) {
      this.drawing?.free();
      this.drawing = new Drawing(canvas, (view) => this.show(view));
    } else if (this.drawn.form !== form) this.drawing?.use((view) => this.show(view));
    this.drawn = { canvas, form };
    this.drawing?.restyle();
    const { text } = this.store.plan.program;
    if (this.hash.of !== text) this.sum(text);
  }

  /** A page that is not served securely has no hash to give. */
  private async sum(text: string): Promise<void> {
    this.hash = { of: text, hex: "…" };
    const bytes = await crypto.subtle?.digest("SHA-256", new TextEncoder().encode(text));
    if (this.hash.of !== text) return;
    const hex = bytes && Array.from(new Uint8Array(bytes), (b) => b.toString(16).padStart(2, "0")).join("");
    this.hash = { of: text, hex: hex ?? this.t("not available on this page") };
    this.requestUpdate();
  }
}

customElements.define("tp-sheet", SheetPart);
