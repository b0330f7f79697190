import { html, nothing, type TemplateResult } from "lit";
import {
  type CycleEntry,
  defaultJob,
  type FieldEntry,
  type PostEntry,
  plan,
} from "../core/browser.js";
import { resultInWords } from "../sentences.js";
import { CanvasPart } from "./canvas-part.js";
import { Drawing } from "./drawing.js";

/** A manual page about a cycle or a control, from the catalog. */
class ManualPart extends CanvasPart {
  protected override storeEvents = ["change"];
  /** Its topic: `cycle:hole`, `control:haas`. */
  declare topic: string;
  private drawn = "";

  static override properties = { topic: { attribute: false } };

  override render(): TemplateResult {
    const [kind, id] = this.topic.split(":");
    const { catalog } = this.store;
    const cycle = catalog.cycles.find(({ type }) => type === id);
    const post = catalog.posts.find((one) => one.id === id);
    return html`<article>${kind === "control" && post ? this.control(post) : cycle ? this.cycle(cycle) : nothing}</article>`;
  }

  private cycle(cycle: CycleEntry): TemplateResult {
    const { store } = this;
    const job = defaultJob(cycle.type);
    const results = cycle.steps.length > 0 ? plan(job).results : [];
    const fields = [
      ...cycle.fields,
      ...cycle.sections.flatMap((section) => section.fields),
    ].filter(({ group }) => store.cam || !group.startsWith("Postprocessor"));
    const used = store.cycle.type === cycle.type;
    return html`
      <h2 tabindex="-1">${cycle.title}</h2>
      <p class="lead">${cycle.says}</p>
      <p class="status-text">${cycle.source}</p>
      ${used ? nothing : html`<p><button type="button" class="primary" ?disabled=${store.readonly} @click=${() => this.use(cycle)}>${this.t("Measure this")}</button></p>`}
      ${cycle.steps.length > 0 ? html`<canvas role="img" aria-label=${this.t("Path of the probe, isometric")}></canvas>` : nothing}
      ${cycle.steps.length > 0 ? html`<h3>${this.t("Moves of the probe")}</h3><ol>${cycle.steps.map((step) => html`<li>${step}</li>`)}</ol>` : nothing}
      ${results.length > 0 ? html`<h3>${this.t("Measured features")}</h3><ul>${results.map((row) => html`<li>${resultInWords(store, row)}</li>`)}</ul>` : nothing}
      <h3>${this.t("Fields of the form")}</h3>
      <dl class="definitions">${fields.map((field) => this.field(field))}</dl>
      <h3>${this.t("On which controls")}</h3>
      ${this.takes(store.catalog.posts.map((post) => [post.title, post, cycle.type]))}`;
  }

  private field({ label, help, code }: FieldEntry): TemplateResult {
    return html`<dt>${label}${this.store.cam && code ? html` <code>${code}</code>` : nothing}</dt><dd>${help}</dd>`;
  }

  private control(post: PostEntry): TemplateResult {
    const { store } = this;
    const now = !store.stale && store.post?.id === post.id;
    const always = now ? store.ofControl : [];
    const unable =
      now && !store.ownCycle
        ? store.plan.safety.filter((row) => row.holds === null)
        : [];
    const rule = (name: string) =>
      store.catalog.rules.find((one) => one.name === name)?.says ?? name;
    const cycles = store.catalog.cycles.filter(
      (cycle) => cycle.steps.length > 0,
    );
    return html`
      <h2 tabindex="-1">${post.title}</h2>
      ${always.length > 0 ? html`<h3>${this.t("General notes")}</h3><ul>${always.map((f) => html`<li class=${f.level}>${this.message(f)}</li>`)}</ul>` : nothing}
      ${unable.length > 0 ? html`<h3>${this.t("Rules it cannot guarantee")}</h3><dl class="definitions">${unable.map((row) => html`<dt>${rule(row.rule)}</dt><dd>${store.say(row.said)}</dd>`)}</dl>` : nothing}
      <h3>${this.t("Capabilities")}</h3>
      <ul>
        <li>${post.computes ? this.t("Its program computes the results.") : this.t("The program computes nothing: the results come from the reported points.")}</li>
        <li>${post.watches ? this.t("Positioning moves are watched by the probe.") : this.t("Positioning moves are not watched by its program.")}</li>
        <li>${post.workOffsets > 0 ? this.t("Work offsets: {first} to {last}.", post.workOffsetWords[0] ?? "", post.workOffsetWords.at(-1) ?? "") : this.t("Its program writes no work offset.")}</li>
      </ul>
      <h3>${this.t("Which cycles")}</h3>
      ${this.takes(cycles.map((cycle) => [cycle.title, post, cycle.type]))}`;
  }

  /** Support of cycles by controls: as moves, as a native cycle, or the reason why not. */
  private takes(rows: [string, PostEntry, string][]): TemplateResult {
    return html`<table><thead><tr><th>${this.t("Name")}</th><th>${this.t("moves")}</th><th>${this.t("native cycle")}</th><th>${this.t("Why not")}</th></tr></thead><tbody>${rows.map(
      ([name, post, type]) => {
        const forms = post.cycles.filter((one) => one.type === type);
        const of = (form: string) => forms.find((one) => one.form === form);
        const mark = (form: string) => {
          const is = of(form)?.supported === true;
          return html`<td><span role="img" aria-label=${is ? this.t("yes") : this.t("no")}>${is ? "✓" : "–"}</span></td>`;
        };
        const why = ["moves", "cycle"]
          .map((form) => of(form)?.reason)
          .find(Boolean);
        return html`<tr><th scope="row">${name}</th>${mark("moves")}${mark("cycle")}<td>${why ?? ""}</td></tr>`;
      },
    )}</tbody></table>`;
  }

  private use(cycle: CycleEntry): void {
    this.store.choose(cycle.type);
    this.dispatchEvent(new CustomEvent("chosen", { bubbles: true }));
  }

  protected override updated(): void {
    const canvas = this.querySelector("canvas");
    const type = this.topic.split(":")[1] as CycleEntry["type"];
    if (this.drawn !== this.topic) {
      this.drawing?.free();
      this.drawing = undefined;
      this.querySelector<HTMLElement>("h2")?.focus({ preventScroll: true });
      this.scrollTop = 0;
    }
    this.drawn = this.topic;
    if (!canvas) return;
    this.drawing ??= new Drawing(canvas, (view) =>
      view.showSmall(defaultJob(type)),
    );
    this.drawing.restyle();
  }

  override disconnectedCallback(): void {
    super.disconnectedCallback();
    this.drawn = "";
  }
}

customElements.define("tp-manual", ManualPart);
