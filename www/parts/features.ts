import { html, nothing, type TemplateResult } from "lit";
import { repeat } from "lit/directives/repeat.js";
import type { Cycle, Plan } from "../core/browser.js";
import type { Feature, Related } from "../features.js";
import { readNumber } from "../number.js";
import { w } from "../words.js";
import { Part } from "./part.js";

/** What each axis of the datum is called in its sentence. */
const AXES = { x: "X", y: "Y", z: "Z", rotation: w("rotation") } as const;

/** What a relation can be of: cycles that measure a place in the plane, and single results. */
interface Operands {
  places: string[];
  results: string[];
}

/** The list of the cycles of one program, above the form of the one in hand; of a single cycle no more than the way to another one. */
class FeaturesPart extends Part {
  protected override follows = ["change"];

  override render(): TemplateResult {
    const { store } = this;
    const { several } = store.features;
    return html`${several ? html`<ol class="features" aria-label=${this.t("Cycles of this program")}>${this.rows()}</ol>${this.around()}${this.relations()}` : nothing}${this.adding(several)}`;
  }

  private rows() {
    const { features, draft } = this.store;
    const all = features.inOrder(draft);
    return repeat(
      all,
      ({ name }) => name,
      (one, i) => this.row(one, i, all.length),
    );
  }

  private row(one: Feature, i: number, count: number): TemplateResult {
    const { store } = this;
    const now = i === store.features.hand;
    const title =
      store.catalog.cycles.find((c) => c.type === one.cycle.type)?.title ?? "";
    const level = this.level(i, now);
    const act = (event: Event, what: () => void) => {
      event.stopPropagation();
      what();
    };
    const button = (
      sign: string,
      label: string,
      does: () => void,
      off = false,
    ) =>
      html`<button type="button" class="icon" aria-label=${this.t(label, one.name)} title=${this.t(label, one.name)} ?disabled=${off || store.readonly} @click=${(e: Event) => act(e, does)}>${sign}</button>`;
    return html`<li class=${`${now ? "now" : ""} ${one.off ? "off" : ""}`} draggable=${store.readonly ? "false" : "true"}
      @dragstart=${(e: DragEvent) => e.dataTransfer?.setData("text/x-touchpath-cycle", String(i))}
      @dragover=${(e: DragEvent) => e.dataTransfer?.types.includes("text/x-touchpath-cycle") && e.preventDefault()}
      @drop=${(e: DragEvent) => this.dropped(e, i)}>
      <button type="button" class=${`feature ${level ?? ""}`} aria-current=${now ? "true" : nothing} @click=${() => store.bringFeature(i)}><b>${one.name}</b> <span class="soft">${title}${one.off ? html` · ${this.t("left out")}` : nothing}</span></button>
      ${
        now
          ? html`<span class="acts"><input type="text" maxlength="12" spellcheck="false" aria-label=${this.t("Name of this cycle")} .value=${one.name} ?disabled=${store.readonly} @change=${(e: Event) => this.rename(e.target as HTMLInputElement, i)} />
        ${button("↑", w("{cycle} earlier"), () => store.moveFeature(i, i - 1), i === 0)}
        ${button("↓", w("{cycle} later"), () => store.moveFeature(i, i + 1), i + 1 === count)}
        ${button("×2", w("Duplicate {cycle}"), () => store.duplicateFeature(i))}
        ${button(one.off ? "○" : "●", one.off ? w("Take {cycle} in again") : w("Leave {cycle} out of the program"), () => store.switchFeature(i))}
        ${button("✕", w("Remove {cycle}"), () => store.removeFeature(i))}</span>`
          : nothing
      }</li>`;
  }

  /** The gravest level of what is said of a cycle. */
  private level(place: number, now: boolean): string | undefined {
    const { store } = this;
    const is = (path: string) => {
      const index = /^cycles\[(\d+)\]/.exec(path)?.[1];
      return index === undefined
        ? now && /^cycle\b/.test(path)
        : store.features.placeOf(Number(index)) === place;
    };
    return ["error", "warning"].find((level) =>
      store.findings.some((f) => f.level === level && is(f.path)),
    );
  }

  private rename(box: HTMLInputElement, i: number): void {
    const name = box.value.trim();
    if (name !== "") this.store.renameFeature(i, name);
    else box.value = this.store.features.all[i]?.name ?? "";
  }

  private dropped(event: DragEvent, to: number): void {
    const from = Number(
      event.dataTransfer?.getData("text/x-touchpath-cycle") || Number.NaN,
    );
    event.preventDefault();
    event.stopPropagation();
    if (Number.isInteger(from) && from !== to) this.store.moveFeature(from, to);
  }

  /** What is written from which cycle, and the height between them. */
  private around(): TemplateResult {
    const { store } = this;
    const { clear } = store.features;
    const found = store.findings.filter(
      ({ path }) =>
        path.startsWith("datum") || path === "clear" || path === "cycles",
    );
    return html`<div class="datum">
      ${store.get("control.workOffset") == null ? nothing : html`<p>${this.sentence()}</p><div class="choices">${store.plan.datum.map((row) => this.from(row))}</div>`}
      <label class="line"><span>${this.t("Height between cycles")}</span> <input type="text" inputmode="decimal" placeholder=${this.t("as high as the highest")} .value=${clear === null ? "" : store.number(String(clear))} ?disabled=${store.readonly}
        @change=${(e: Event) => this.clear(e.target as HTMLInputElement)} /></label>
      ${found.map((f) => html`<p class=${`problem ${f.level}`}>${this.message(f)}</p>`)}
    </div>`;
  }

  private clear(box: HTMLInputElement): void {
    const { store } = this;
    const height =
      box.value.trim() === ""
        ? null
        : readNumber(box.value, "length", store.units, store.comma);
    if (typeof height === "string")
      box.value =
        store.features.clear === null
          ? ""
          : store.number(String(store.features.clear));
    else store.clearAt(height);
  }

  /** `X Y from BORE, Z from TOP → G54`. */
  private sentence(): string {
    const { store } = this;
    const word =
      store.post?.workOffsetWords[
        Number(store.get("control.workOffset")) - 1
      ] ?? "";
    const by = new Map<string, string[]>();
    for (const { axis, from } of store.plan.datum) {
      const cycle = from?.split(".")[0];
      if (cycle) by.set(cycle, [...(by.get(cycle) ?? []), this.t(AXES[axis])]);
    }
    const parts = [...by].map(([cycle, axes]) =>
      this.t("{axes} from {cycle}", axes.join(" "), cycle),
    );
    return parts.length > 0
      ? `${parts.join(", ")} → ${word}`
      : this.t("Nothing is written into {offset}", word);
  }

  private from({
    axis,
    from,
    choices,
  }: Plan["datum"][number]): TemplateResult | typeof nothing {
    if (choices.length === 0) return nothing;
    const { store } = this;
    const said = store.features.datum[axis];
    const value =
      said === undefined ? "proposed" : said === null ? "none" : String(said);
    const known =
      choices.some((one) => one.toLowerCase() === value.toLowerCase()) ||
      ["proposed", "none"].includes(value);
    const proposed =
      axis === "rotation"
        ? []
        : [
            {
              value: "proposed",
              label:
                said === undefined && from
                  ? this.t("proposed: {result}", from)
                  : this.t("proposed"),
            },
          ];
    const options = [
      ...proposed,
      { value: "none", label: this.t("not written") },
      // What an axis is written from is mostly one result of a cycle: then its name says enough.
      ...choices.map((one) => {
        const [name = one] = one.split(".");
        const alone =
          choices.filter((other) => other.startsWith(`${name}.`)).length === 1;
        return { value: one, label: alone ? name : one };
      }),
    ];
    if (!known) options.push({ value, label: value });
    const now = axis === "rotation" && said === undefined ? "none" : value;
    const take = (e: Event) => {
      const chosen = (e.target as HTMLSelectElement).value;
      store.writeFrom(
        axis,
        chosen === "proposed" ? undefined : chosen === "none" ? null : chosen,
      );
    };
    return html`<label><span>${this.t(AXES[axis])}</span> <select aria-label=${this.t("{axis} is written from", this.t(AXES[axis]))} ?disabled=${store.readonly} @change=${take}>${options.map((o) => html`<option value=${o.value} ?selected=${o.value.toLowerCase() === now.toLowerCase()}>${o.label}</option>`)}</select></label>`;
  }

  /** What is computed of the results of these cycles. */
  private relations(): TemplateResult | typeof nothing {
    const { store } = this;
    const { relations } = store.features;
    const choices = this.operands();
    const possible = store.catalog.relations.filter(
      ({ places, least }) =>
        choices[places ? "places" : "results"].length >= least,
    );
    if (relations.length === 0 && (possible.length === 0 || store.readonly))
      return nothing;
    const found = store.findings.filter(({ path }) =>
      path.startsWith("relations"),
    );
    const add = (e: Event) => {
      const list = e.target as HTMLSelectElement;
      const kind = possible.find(({ type }) => type === list.value);
      list.value = "";
      if (!kind) return;
      const all = choices[kind.places ? "places" : "results"];
      store.relate((features) =>
        features.relate(kind.type, all.slice(0, kind.most ?? all.length)),
      );
    };
    return html`<div class="relations">
      ${relations.length > 0 ? html`<ol aria-label=${this.t("Relations")}>${relations.map((one, i) => this.relation(one, i, choices))}</ol>` : nothing}
      ${found.map((f) => html`<p class=${`problem ${f.level}`}>${this.message(f)}</p>`)}
      ${store.readonly || possible.length === 0 ? nothing : html`<p class="adding"><select aria-label=${this.t("Add a relation between cycles")} @change=${add}><option value="">${this.t("+ Add a relation between cycles")}</option>${possible.map(({ type, label }) => html`<option value=${type}>${this.t(label)}</option>`)}</select></p>`}
    </div>`;
  }

  private relation(
    { name, type, of }: Related,
    i: number,
    choices: Operands,
  ): TemplateResult {
    const { store } = this;
    const kind = store.catalog.relations.find((one) => one.type === type);
    const known = choices[kind?.places ? "places" : "results"].filter(
      (one) => one.split(".")[0] !== name,
    );
    const change = (of: string[]) =>
      store.relate((features) => features.changeRelation(i, { of }));
    const select = (
      one: string,
      k: number,
    ) => html`<select aria-label=${this.t("{relation}, item {number}", name, k + 1)} ?disabled=${store.readonly}
      @change=${(e: Event) => change(of.map((other, at) => (at === k ? (e.target as HTMLSelectElement).value : other)))}>${[...new Set([one, ...known])].map((value) => html`<option value=${value} ?selected=${value === one}>${value}</option>`)}</select>`;
    const rest = known.filter((one) => !of.includes(one));
    const least = kind?.least ?? 2;
    const several = kind?.most === null && !store.readonly;
    return html`<li><b>${this.t(kind?.label ?? type)}</b>
      <input type="text" maxlength="12" spellcheck="false" aria-label=${this.t("Name of this relation")} .value=${name} ?disabled=${store.readonly} @change=${(e: Event) => this.renameRelation(e.target as HTMLInputElement, i)} />
      <button type="button" class="icon" aria-label=${this.t("Remove {cycle}", name)} title=${this.t("Remove {cycle}", name)} ?disabled=${store.readonly} @click=${() => store.relate((features) => features.unrelate(i))}>✕</button>
      <span class="of">${of.map(select)}${several && rest.length > 0 ? html`<button type="button" class="icon" aria-label=${this.t("One more in {relation}", name)} title=${this.t("One more in {relation}", name)} @click=${() => change([...of, rest[0] as string])}>+</button>` : nothing}${several && of.length > least ? html`<button type="button" class="icon" aria-label=${this.t("One fewer in {relation}", name)} title=${this.t("One fewer in {relation}", name)} @click=${() => change(of.slice(0, -1))}>−</button>` : nothing}</span></li>`;
  }

  private renameRelation(box: HTMLInputElement, i: number): void {
    const name = box.value.trim();
    if (name !== "")
      this.store.relate((features) => features.changeRelation(i, { name }));
    else box.value = this.store.features.relations[i]?.name ?? "";
  }

  /** What a relation can be of. */
  private operands(): Operands {
    const { plan } = this.store;
    const names = [...plan.cycles, ...plan.relations];
    const axis = (key: string) =>
      plan.datum
        .find((row) => row.axis === key)
        ?.choices.map((one) => one.split(".")[0] ?? one) ?? [];
    const y = axis("y");
    const measured = plan.results.filter(
      ({ value, unit, code }) =>
        value !== null && unit !== "" && !code.startsWith("offset."),
    );
    return {
      places: axis("x").filter((one) => y.includes(one)),
      results: measured.map(({ cycle, code }) => `${names[cycle]}.${code}`),
    };
  }

  /** Another cycle for this program. */
  private adding(several: boolean): TemplateResult | typeof nothing {
    const { store } = this;
    if (store.readonly || (!several && store.cycle.touches === false))
      return nothing;
    const take = (e: Event) => {
      const list = e.target as HTMLSelectElement;
      const type = list.value as Cycle["type"];
      list.value = "";
      if (type) store.addFeature(type);
    };
    if (!store.rules.allowsSetUps) return nothing;
    const cycles = store.catalog.cycles.filter(
      (c) => c.maxTouches > 0 && store.rules.offers("cycles", c.type),
    );
    return html`<p class="adding"><select aria-label=${this.t("Add a cycle to this program")} @change=${take}><option value="">${this.t("+ Add a cycle to this program")}</option>${cycles.map((c) => html`<option value=${c.type}>${c.title}</option>`)}</select></p>`;
  }
}

customElements.define("tp-features", FeaturesPart);
