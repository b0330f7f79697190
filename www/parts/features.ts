import { html, nothing, type TemplateResult } from "lit";
import { live } from "lit/directives/live.js";
import type { Plan } from "../core/browser.js";
import type { Related } from "../cycle-list.js";
import { readNumber } from "../number.js";
import { w } from "../words.js";
import { StorePart } from "./part.js";

/** Names of the axes of the datum in its sentence. */
const AXES = { x: "X", y: "Y", z: "Z", rotation: w("rotation") } as const;

/** Possible operands of a relation: cycles that measure a position in the plane, and single results. */
interface Operands {
  places: string[];
  results: string[];
}

/** Below the list: the button that adds a feature, the relations, and the sources of the written datum. */
class FeaturesPart extends StorePart {
  protected override storeEvents = ["change"];

  override render(): TemplateResult {
    const { several } = this.store.features;
    return html`${this.adding(several)}${several ? html`${this.relations()}${this.around()}` : nothing}`;
  }

  /** Sources of the datum, and the clearance plane between the cycles. */
  private around(): TemplateResult {
    const { store } = this;
    const { clear } = store.features;
    const found = store.findings.filter(
      ({ path }) =>
        path.startsWith("datum") || path === "clear" || path === "cycles",
    );
    return html`<div class="datum">
      ${store.get("control.workOffset") == null ? nothing : html`<h3>${this.t("Written at the end, once")}</h3>`}
      <details ?open=${live(this.open || found.length > 0)} @toggle=${(
        e: Event,
      ) => {
        this.open = (e.target as HTMLDetailsElement).open;
      }}><summary>${store.get("control.workOffset") == null ? this.t("Height between cycles") : this.sentence()}</summary>
      ${store.get("control.workOffset") == null ? nothing : html`<div class="choices">${store.plan.datum.map((row) => this.from(row))}</div>`}
      <label class="line"><span>${this.t("Height between cycles")}</span> <input type="text" inputmode="decimal" placeholder=${this.t("as high as the highest")} .value=${clear === null ? "" : store.number(String(clear))} ?disabled=${store.readonly}
        @change=${(e: Event) => this.clear(e.target as HTMLInputElement)} /></label></details>
      ${found.map((f) => html`<p class=${`problem ${f.level}`}>${this.message(f)}</p>`)}
    </div>`;
  }

  /** Whether the sources of the datum are unfolded. */
  private open = false;

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
      // An axis is usually written from the only suitable result of a cycle: then its name is enough.
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

  /** Relations between results of these cycles. */
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

  /** Possible operands of a relation. */
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

  /** Button that opens the gallery to add a feature. */
  private adding(several: boolean): TemplateResult | typeof nothing {
    const { store } = this;
    if (store.readonly || (!several && store.cycle.touches === false))
      return nothing;
    if (!store.rules.allowsSetUps) return nothing;
    return html`<p class="adding"><button type="button" class="quiet" @click=${() => this.dispatchEvent(new CustomEvent("run-action", { bubbles: true, detail: "add" }))}>${this.t("+ Add a feature")}</button></p>`;
  }
}

customElements.define("tp-features", FeaturesPart);
