import { html, nothing, type TemplateResult } from "lit";
import { type CycleEntry, defaultJob, plan } from "../core/browser.js";
import { w } from "../words.js";
import { Drawing } from "./drawing.js";
import { Part } from "./part.js";

/** The groups by what is probed, and the word in a cycle's name that says it; the last takes what no other does. */
const GROUPS: [string, string][] = [
  [w("Surface"), "surface"],
  [w("Round"), "round"],
  [w("Rectangle"), "rectangle"],
  [w("Web and groove"), "web"],
  [w("Corner"), "corner"],
  [w("No motion"), "still"],
  [w("Others"), "others"],
];

const WORDS: [RegExp, string][] = [
  [/surface/, "surface"],
  [/hole|boss|circles/, "round"],
  [/rectangle/, "rectangle"],
  [/web|groove/, "web"],
  [/corner/, "corner"],
];

function groupOf(cycle: CycleEntry): string {
  if (cycle.steps.length === 0) return "still";
  return WORDS.find(([word]) => word.test(cycle.type))?.[1] ?? "others";
}

/** What else people call what a cycle probes, by a part of its type. */
const ALSO: [RegExp, string][] = [
  [/internal-rectangle/, w("pocket")],
  [/external-rectangle/, w("island block outside")],
  [/hole/, w("bore inside diameter")],
  [/boss/, w("stud pin shaft outside diameter")],
  [/groove/, w("slot inside width")],
  [/web/, w("rib ridge bar outside width")],
  [/internal-corner/, w("inside corner")],
  [/external-corner/, w("outside corner")],
  [/circles/, w("two holes bores studs bolt circle alignment")],
  [/surface/, w("face plane single point height")],
];

/** The touches of each cycle's default job. */
const COUNTS = new Map<string, number>();

/** Every cycle with a small drawing of its default job, made by the same code as the large picture. */
class GalleryPart extends Part {
  protected override follows = ["change"];
  private query = "";
  private readonly drawings = new Map<string, Drawing>();

  override connectedCallback(): void {
    super.connectedCallback();
    this.store.addEventListener("recolour", this.paint);
  }

  override disconnectedCallback(): void {
    super.disconnectedCallback();
    this.store.removeEventListener("recolour", this.paint);
    for (const drawing of this.drawings.values()) drawing.free();
    this.drawings.clear();
  }

  override render(): TemplateResult {
    const last = Number.POSITIVE_INFINITY;
    const all = [...this.store.catalog.cycles].sort((a, b) => (a.number ?? last) - (b.number ?? last));
    const found = all.filter((cycle) => this.finds(cycle));
    return html`
      <div class="tools">
        <input class="filter" type="search" placeholder=${this.t("Search: name or type number")} aria-label=${this.t("Search the cycles")} .value=${this.query}
          @input=${(e: Event) => {
            this.query = (e.target as HTMLInputElement).value;
            this.requestUpdate();
          }}
          @keydown=${(e: KeyboardEvent) => this.key(e, found[0])} />
        <span role="status" class="told">${this.t("{count} of {all} cycles", found.length, this.store.catalog.cycles.length)}</span>
      </div>
      ${found.length === 0 ? html`<p>${this.t("No cycle is called so.")} <button type="button" @click=${this.showAll}>${this.t("Show all")}</button></p>` : nothing}
      <div class="groups">${GROUPS.map(([name, of]) => {
        const cycles = all.filter((cycle) => groupOf(cycle) === of);
        const shown = cycles.filter((cycle) => found.includes(cycle)).length;
        return html`<section ?hidden=${shown === 0} aria-label=${this.t(name)}><h2>${this.t(name)}</h2>
        <ul class="cards">${cycles.map(
          (cycle) => html`<li ?hidden=${!found.includes(cycle)}>
          <button type="button" data-type=${cycle.type} aria-current=${cycle.type === this.store.cycle.type ? "true" : "false"} @click=${() => this.choose(cycle)}>
            ${cycle.steps.length ? html`<canvas aria-hidden="true"></canvas>` : html`<span class="still">${this.t("rows of the table, no motion")}</span>`}
            <b>${cycle.title}</b>
            ${[cycle.source, this.touches(cycle), this.own(cycle)].map((words) => (words ? html`<small>${words}</small>` : nothing))}
          </button></li>`,
        )}</ul></section>`;
      })}</div>
    `;
  }

  protected override firstUpdated(): void {
    this.paint();
    // Where fingers point, a focus would bring the keyboard up over the pictures.
    if (matchMedia("(pointer: fine)").matches) this.querySelector<HTMLInputElement>("input")?.focus();
  }

  /** How many touches a cycle makes as it is chosen. */
  private touches({ type, steps }: CycleEntry): string {
    if (steps.length === 0) return "";
    const known = COUNTS.get(type) ?? plan(defaultJob(type)).touches.length;
    COUNTS.set(type, known);
    return known === 1 ? this.t("1 touch") : this.t("{count} touches", known);
  }

  /** The controls that have it as a cycle of their own; as plain moves most controls take every cycle. */
  private own({ type }: CycleEntry): string {
    const calls = this.store.catalog.posts.filter((post) =>
      post.cycles.some((c) => c.type === type && c.form === "cycle" && c.supported),
    );
    return calls.length === 0 ? "" : this.t("own cycle of {control}", calls.map((post) => post.title).join(", "));
  }

  /** Enter takes the first that is found. The key is used up: it must not press the button that gets the focus. */
  private key(event: KeyboardEvent, first: CycleEntry | undefined): void {
    if (event.key !== "Enter" || !first || this.query.trim() === "") return;
    event.preventDefault();
    this.choose(first);
  }

  private readonly showAll = (): void => {
    this.query = "";
    this.requestUpdate();
    this.querySelector<HTMLInputElement>("input")?.focus();
  };

  /** A number is a type's; words must all be in the name, the source, or what else it is called. */
  private finds(cycle: CycleEntry): boolean {
    const also = ALSO.filter(([of]) => of.test(cycle.type)).flatMap(([, words]) => [words, this.t(words)]);
    const text = [cycle.title, cycle.source, cycle.type, ...also].join(" ").toLowerCase();
    const words = this.query.toLowerCase().split(/\s+/).filter(Boolean);
    return words.every((word) => (/^\d+$/.test(word) ? new RegExp(`\\b${word}\\b`).test(text) : text.includes(word)));
  }

  private choose(cycle: CycleEntry): void {
    this.store.choose(cycle.type);
    this.dispatchEvent(new CustomEvent("chosen", { bubbles: true }));
  }

  private readonly paint = (): void => {
    for (const button of this.querySelectorAll<HTMLElement>("button[data-type]")) {
      const type = button.dataset.type as CycleEntry["type"];
      const canvas = button.querySelector("canvas");
      if (!canvas) continue;
      const drawing = this.drawings.get(type) ?? new Drawing(canvas, (view) => view.showSmall(defaultJob(type)));
      this.drawings.set(type, drawing);
      drawing.restyle();
    }
  };
}

customElements.define("tp-gallery", GalleryPart);
