import { html, nothing, type TemplateResult } from "lit";
import type { CycleEntry } from "../core/browser.js";
import { FieldPart } from "./field.js";
import { saveButton } from "./save.js";

/** Where a cycle of the control itself says what it sets. */
const SETS = "cycle.confirmRotation";

/** The head of the page: the job in one sentence, and what is handed out. */
class BarPart extends FieldPart {
  /** Whether links to the job are handed out. */
  links = false;
  /** What is shown instead of the job, in words: then nothing of the job is changed or handed out. Empty where the job is shown. */
  declare away: string;
  /** Whether the program is saved here. */
  declare saves: boolean;

  static override properties = { away: { attribute: false }, saves: { attribute: false } };

  override render(): TemplateResult {
    const { store } = this;
    const away = this.away !== "";
    const withheld = this.away || store.withheld;
    return html`
      <fieldset aria-label=${this.t("Job")} ?disabled=${store.readonly || away}>
      ${this.select("cycle.type", this.cycles(), (type) => store.choose(type as CycleEntry["type"]), this.t("Cycle"))}
      <button type="button" class="gallery" aria-label=${this.t("Gallery")} title=${this.t("Choose the cycle from pictures")} @click=${() => this.ask("gallery")}>▦</button>
      <span class="joined">${this.select("control.post", this.posts(), (id) => store.chooseControl(id), this.t("Control"))}${this.offset()}</span>
      ${this.radios("units", ["mm", "inch"], (units) => store.setUnits(units as "mm" | "inch"), this.t("Units"))}
      ${["cycle.type", "control.post", "control.workOffset", "units"].map((path) => this.problems(path))}
      </fieldset>
      <span class="gap"></span>
      <button type="button" class="icon" aria-label=${this.t("Undo")} title=${`${this.t("Undo")} (Ctrl+Z)`} ?disabled=${!store.canUndo || away} @click=${() => store.undo()}>↶</button>
      <button type="button" class="icon redo" aria-label=${this.t("Redo")} title=${`${this.t("Redo")} (Ctrl+Y)`} ?disabled=${!store.canRedo || away} @click=${() => store.redo()}>↷</button>
      <button type="button" class="wide" ?disabled=${store.readonly} @click=${() => this.ask("open")}>${this.t("Open")}</button>
      ${this.links ? html`<button type="button" class="wide" ?disabled=${away} @click=${() => this.ask("share")}>${this.t("Share")}</button>` : nothing}
      <button type="button" class="wide" ?disabled=${withheld !== null} aria-describedby=${withheld === null ? nothing : "withheld"} @click=${() => this.ask("sheet")}>${this.t("Setup sheet")}</button>
      <button type="button" class="icon" aria-label=${this.t("More")} title=${this.t("More")} popovertarget="menu">⋯</button>
      ${this.saves ? saveButton(store, withheld, () => this.ask("save")) : nothing}
      ${withheld === null ? nothing : html`<span class="unseen" id="withheld">${away ? nothing : this.t("Nothing to save or copy while the form has an error:")} ${withheld}</span>`}
    `;
  }

  /** Under their source, whose name would leave no room for theirs: `ENCY/SprutCAM type 7` says the source and the number in it. */
  private cycles() {
    const last = Number.POSITIVE_INFINITY;
    const sorted = [...this.store.catalog.cycles].sort((a, b) => (a.number ?? last) - (b.number ?? last));
    return sorted.map(({ type, title, source }) => {
      const [under = "", ...number] = source.split(" ");
      return { value: type, under, label: `${title} · ${number.join(" ")}` };
    });
  }

  /** Controls that do not take this cycle are shown, with the reason, and cannot be chosen. */
  private posts() {
    const { type } = this.store.cycle;
    return this.store.catalog.posts.map((post) => {
      const forms = post.cycles.filter((c) => c.type === type);
      const takes = forms.some((c) => c.supported);
      const reason = forms.find((c) => !c.supported)?.reason ?? this.t("It has no program for this cycle");
      return { value: post.id, label: post.title, ...(takes ? {} : { not: reason }) };
    });
  }

  /** The work offset; where the control has none, what the program does: a cycle of the control has fields for that. */
  private offset(): TemplateResult {
    const { store } = this;
    const none = store.post?.workOffsets === 0 || store.ownPreset(store.get("control.post"), store.cycle.type);
    if (none && (store.get("control.workOffset") ?? null) === null) {
      const does = store.stale ? this.t("no program") : store.does;
      const go = () => this.dispatchEvent(new CustomEvent("go", { detail: SETS, bubbles: true }));
      return store.fieldAt(SETS)
        ? html`<button type="button" class="does" title=${this.t("Choose what it sets")} @click=${go}>${does}</button>`
        : html`<span class="does" role="note">${does}</span>`;
    }
    const choose = (n: string) => store.put("control.workOffset", n === "" ? null : Number(n));
    return this.select("control.workOffset", this.offsets(), choose, this.t("Work offset"));
  }

  private offsets() {
    const { store } = this;
    const { post } = store;
    const value = store.get("control.workOffset") ?? null;
    const most = Math.max(post?.workOffsets ?? 0, typeof value === "number" ? Math.min(value, 99) : 0);
    // `G154 P1` and its kin under one heading.
    const under = (i: number) => /^(\S+) P\d+$/.exec(post?.workOffsetWords[i] ?? "")?.[1] ?? "";
    const numbers = Array.from({ length: most }, (_, i) => ({
      value: i + 1,
      label: store.writes(i + 1),
      under: under(i),
    }));
    const none = value === null && !store.stale ? store.does : this.t("measures only");
    return [{ value: null, label: none }, ...numbers];
  }

  private ask(what: string): void {
    this.dispatchEvent(new CustomEvent("ask", { bubbles: true, detail: what }));
  }
}

customElements.define("tp-bar", BarPart);
