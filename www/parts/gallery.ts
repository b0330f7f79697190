import { html, nothing, type TemplateResult } from "lit";
import { type CycleEntry, catalog, defaultJob, plan } from "../core/browser.js";
import { found, LENGTHS, textOf } from "../search.js";
import type { SetUpEntry } from "../set-ups.js";
import { w } from "../words.js";
import { Drawing } from "./drawing.js";
import { StorePart } from "./part.js";

/** Groups by the probed feature, with a word of the cycle's name; the last one takes the rest. */
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

/** Number of touches in each cycle's default job. */
const COUNTS = new Map<string, number>();

/** The gallery: every cycle with a sentence and a small drawing of its default job, made by the same code as the large picture. */
class GalleryPart extends StorePart {
  protected override storeEvents = ["change"];
  /** Whether a click adds a feature instead of replacing the cycle. */
  declare adds: boolean;

  static override properties = { adds: { attribute: false } };

  private query = "";
  private readonly english = catalog().cycles;
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
    const { store } = this;
    const last = Number.POSITIVE_INFINITY;
    // Cycles without motion are for authors of postprocessors.
    const all = store.catalog.cycles
      .filter(
        (cycle) =>
          (this.adds
            ? cycle.maxTouches > 0
            : store.cam || cycle.steps.length > 0) &&
          store.rules.offers("cycles", cycle.type),
      )
      .sort((a, b) => (a.number ?? last) - (b.number ?? last));
    const ready = this.adds ? [] : store.readySetUps.map(({ entry }) => entry);
    const things: (CycleEntry | SetUpEntry | null)[] = [
      ...all,
      ...ready,
      ...(this.adds ? [] : [null]),
    ];
    const search = found(things, this.query, (one) =>
      !one ? this.lengths() : "type" in one ? this.text(one) : this.setUp(one),
    );
    const cycles = search.things.filter((one) => one !== null && "type" in one);
    const setUps = search.things.filter((one) => one !== null && "job" in one);
    const tool = search.things.includes(null);
    return html`
      <h2>${this.t(this.adds ? "Add a feature" : "What do you measure?")}</h2>
      <div class="tools">
        <input class="filter" type="search" placeholder=${this.t("Search: island, edge, rotation, vise, G54 …")} aria-label=${this.t("Search the cycles")} .value=${this.query}
          @input=${(e: Event) => {
            this.query = (e.target as HTMLInputElement).value;
            this.requestUpdate();
          }}
          @keydown=${(e: KeyboardEvent) => this.key(e, cycles[0], tool)} />
        <span role="status" class="status-text">${search.all || search.things.length === 0 ? this.t("{count} of {all} cycles", cycles.length, all.length) : this.t("No entry has all of these words; these have some of them")}</span>
      </div>
      ${search.things.length === 0 ? html`<p>${this.t("No cycle is found by these words.")} <button type="button" @click=${this.showAll}>${this.t("Show all")}</button></p>` : nothing}
      <div class="groups"><section ?hidden=${setUps.length === 0} aria-label=${this.t("Ready set-ups")}><h3>${this.t("Ready set-ups")}</h3>
        <ul class="cards">${ready.map((one) => html`<li ?hidden=${!setUps.includes(one)}><button type="button" data-set-up=${one.key} @click=${() => this.begin(one)}><canvas aria-hidden="true"></canvas><b>${this.t(one.name)}</b><small>${this.t(one.says)}</small></button></li>`)}</ul></section>${GROUPS.map(
          ([name, of]) => {
            const members = all.filter((cycle) => groupOf(cycle) === of);
            const shown = members.filter((cycle) =>
              cycles.includes(cycle),
            ).length;
            return html`<section ?hidden=${shown === 0} aria-label=${this.t(name)}><h3>${this.t(name)}</h3>
        <ul class="cards">${members.map((cycle) => this.card(cycle, cycles.includes(cycle)))}</ul></section>`;
          },
        )}
      <section ?hidden=${!tool} aria-label=${this.t("Another tool")}><h3>${this.t("Another tool")}</h3>
        <ul class="cards"><li><button type="button" @click=${this.toLengths}>
          <span class="still" aria-hidden="true">L1 L2 L3</span><b>${this.t("Tool lengths")}</b><small>${this.t("SINUMERIK: which tool length acts on which axis (LENTOAX), with a frame and a plane.")}</small></button></li></ul></section></div>
    `;
  }

  private card(cycle: CycleEntry, shown: boolean): TemplateResult {
    const own = this.own(cycle);
    return html`<li ?hidden=${!shown}>
          <button type="button" data-type=${cycle.type} aria-current=${cycle.type === this.store.cycle.type ? "true" : "false"} @click=${() => this.choose(cycle)}>
            ${cycle.steps.length ? html`<canvas aria-hidden="true"></canvas>` : html`<span class="still">${this.t("rows of the table, no motion")}</span>`}
            <b>${cycle.title}</b>
            <small>${cycle.says}</small>
            <small class="source">${[cycle.source, this.touches(cycle), own].filter(Boolean).join(" · ")}</small>
          </button>
          <button type="button" class="icon about" aria-label=${this.t("About {cycle}", cycle.title)} title=${this.t("About {cycle}", cycle.title)} @click=${() => this.about(cycle)}><span class="i" aria-hidden="true">i</span></button></li>`;
  }

  protected override firstUpdated(): void {
    this.paint();
    // On touch screens a focus would open the keyboard over the pictures.
    if (matchMedia("(pointer: fine)").matches)
      this.querySelector<HTMLInputElement>("input")?.focus();
  }

  /** Number of touches of a cycle with its default settings. */
  private touches({ type, steps }: CycleEntry): string {
    if (steps.length === 0) return "";
    const known = COUNTS.get(type) ?? plan(defaultJob(type)).touches.length;
    COUNTS.set(type, known);
    return known === 1 ? this.t("1 touch") : this.t("{count} touches", known);
  }

  /** Whether the job's control has a native cycle for it. */
  private own({ type }: CycleEntry): string {
    const { post } = this.store;
    return post && this.store.formsOf(post.id, type).includes("cycle")
      ? this.t("native cycle of {control}", post.title)
      : "";
  }

  /** Enter chooses the first match. The key must not also press the button that gets the focus. */
  private key(
    event: KeyboardEvent,
    first: CycleEntry | undefined,
    tool: boolean,
  ): void {
    if (event.key !== "Enter" || event.isComposing || this.query.trim() === "")
      return;
    if (first) this.choose(first);
    else if (tool) this.toLengths();
    else return;
    event.preventDefault();
  }

  private readonly showAll = (): void => {
    this.query = "";
    this.requestUpdate();
    this.querySelector<HTMLInputElement>("input")?.focus();
  };

  private text(cycle: CycleEntry): string {
    const english =
      this.english.find(({ type }) => type === cycle.type) ?? cycle;
    return textOf(cycle, english, (text) => this.t(text));
  }

  private setUp({ name, says }: SetUpEntry): string {
    return [name, says, this.t(name), this.t(says)].join(" ").toLowerCase();
  }

  private begin(one: SetUpEntry): void {
    this.store.beginSetUp(one.key);
    this.dispatchEvent(new CustomEvent("chosen", { bubbles: true }));
  }

  private lengths(): string {
    return [this.t("Tool lengths"), LENGTHS, this.t(LENGTHS)]
      .join(" ")
      .toLowerCase();
  }

  private choose(cycle: CycleEntry): void {
    if (this.adds) this.store.addFeature(cycle.type);
    else this.store.choose(cycle.type);
    this.dispatchEvent(new CustomEvent("chosen", { bubbles: true }));
  }

  private about(cycle: CycleEntry): void {
    this.dispatchEvent(
      new CustomEvent("open-manual", {
        bubbles: true,
        detail: `cycle:${cycle.type}`,
      }),
    );
  }

  private readonly toLengths = (): void => {
    this.dispatchEvent(
      new CustomEvent("run-action", { bubbles: true, detail: "lengths" }),
    );
  };

  private readonly paint = (): void => {
    const ready = this.store.readySetUps;
    for (const button of this.querySelectorAll<HTMLElement>(
      "button:is([data-type], [data-set-up])",
    )) {
      const { type, setUp } = button.dataset;
      const key = type ?? setUp ?? "";
      const canvas = button.querySelector("canvas");
      if (!canvas) continue;
      const job = () =>
        type
          ? defaultJob(type as CycleEntry["type"])
          : ready.find(({ entry }) => entry.key === setUp)?.job;
      const drawing =
        this.drawings.get(key) ??
        new Drawing(canvas, (view) => view.showSmall(job()));
      this.drawings.set(key, drawing);
      drawing.restyle();
    }
  };
}

customElements.define("tp-gallery", GalleryPart);
