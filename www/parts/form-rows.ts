// Rows of the form: a field with its label, input and findings.
import { html, nothing, type TemplateResult } from "lit";
import { live } from "lit/directives/live.js";
import type { FieldEntry, ResultTolerance } from "../core/browser.js";
import { ACTIONS } from "../measured.js";
import { w } from "../words.js";
import { FieldPart, type Placed } from "./field.js";

/** Draws the rows of the form. */
export abstract class FormRows extends FieldPart {
  /** Menu of the action when a size is out of tolerance. */
  protected outOf(fields: Placed[]): TemplateResult | typeof nothing {
    const { store } = this;
    const cycle = store.features.several ? store.features.inJob : 0;
    const keys = fields
      .map(({ path }) => /^cycle\.(\w+)$/.exec(path)?.[1] ?? "")
      .filter((key) => store.sizeWithTolerance(cycle, key) !== null);
    const native = store.get("control.form") === "cycle";
    const { computes, computesBetween } = store.post ?? {};
    const acts = native ? store.features.several && computesBetween : computes;
    const actions = keys.map(
      (key) => store.tolerance(cycle, key)?.action ?? "go",
    );
    // Sizes with different actions are set in the list of tolerances.
    if (new Set(actions).size !== 1 || !acts) return nothing;
    // A program of native cycles only stops.
    const possible = ACTIONS.filter(([value]) => !native || value !== "mark");
    const take = (e: Event) => {
      const action = (e.target as HTMLSelectElement)
        .value as ResultTolerance["action"];
      const changed = (key: string) => {
        const { action: _, ...own } = store.tolerance(cycle, key) ?? {};
        return action === "go" ? own : { ...own, action };
      };
      store.tolerate(
        cycle,
        Object.fromEntries(keys.map((key) => [key, changed(key)])),
      );
      store.settle();
    };
    return html`<div class="row"><label for="f-out">${this.t("Out of tolerance")}</label><span class="choice"><select id="f-out" @change=${take}>${possible.map(([value, words]) => html`<option value=${value} .selected=${live(value === actions[0])}>${this.t(words)}</option>`)}</select></span></div>`;
  }

  /** Units of the job. */
  protected units(): TemplateResult | typeof nothing {
    const { store } = this;
    const words = (["mm", "inch"] as const).filter(
      (units) => units === store.units || store.rules.allowsUnits(units),
    );
    if (!store.rules.showsField("units") && !this.isBad("units"))
      return nothing;
    return html`<div class="row"><span class="label">${this.t("Units")}</span>${this.radios(
      "units",
      words,
      (units) => store.setUnits(units as "mm" | "inch"),
      this.t("Units"),
    )}${this.problems("units")}</div>`;
  }

  /** Choices of a field. Marks those that the control does not support. */
  protected choices({ field, path }: Placed): FieldEntry["choices"] {
    const { rules } = this.store;
    if (path === "control.form")
      return field.choices.filter(
        ({ value }) =>
          value === this.store.get(path) ||
          rules.allowsForm(value as "moves" | "cycle"),
      );
    if (path !== "control.protection" || this.store.post?.watches !== false)
      return field.choices;
    const label = (own: string) => this.t("{choice}: not on this control", own);
    return field.choices.map((c) =>
      c.value === "checked" ? { ...c, label: label(c.label) } : c,
    );
  }

  /** Styli that the host page offers. */
  protected styli(): TemplateResult | typeof nothing {
    const { store } = this;
    const styli = store.rules.styli(store.units);
    if (styli.length === 0) return nothing;
    const now = store.get("stylus") as Record<string, unknown>;
    const used = styli.findIndex(({ stylus }) =>
      Object.entries(stylus).every(([key, value]) => now[key] === value),
    );
    const take = (e: Event) => {
      const chosen = styli[Number((e.target as HTMLSelectElement).value)];
      if (chosen) store.useStylus(chosen.stylus);
    };
    return html`<div class="row"><label for="f-styli">${this.t("Stylus")}</label><span class="choice"><select id="f-styli" @change=${take}>
      ${used < 0 ? html`<option value="" .selected=${live(true)} disabled>${this.t("another one")}</option>` : nothing}
      ${styli.map(({ name }, i) => html`<option value=${i} .selected=${live(i === used)}>${name}</option>`)}</select></span></div>`;
  }

  /** The frame for tool lengths, taken from the other tool. */
  protected frame(): TemplateResult {
    const frame = (this.store.get("tool.frame") ?? []) as (
      | { rot: string; angle: number }
      | { mirror: string }
    )[];
    const words = frame
      .map((s) =>
        "rot" in s ? `ROT ${s.rot}${s.angle}` : `MIRROR ${s.mirror}`,
      )
      .join(", ");
    return html`<div class="row"><p class="help">${this.t("Frame: {frame}. To change it: Tool lengths, under ⋯, then Apply to the job.", words || [w("none")])}</p>${frame.length ? html`<button type="button" @click=${() => this.store.put("tool.frame", [])}>${this.t("No frame")}</button>` : nothing}
      ${this.problems("tool")}${this.problems("tool.frame")}</div>`;
  }

  /** A field of the form. A field that the host page has locked cannot be changed while it has the required value. */
  protected field(placed: Placed): TemplateResult {
    const { rules } = this.store;
    const { path } = placed;
    if (
      !rules.locks(path) ||
      this.store.at(path).some(({ code }) => code === "locked")
    )
      return this.box(placed);
    const why = rules.reason(path);
    const fixed = rules.config?.title
      ? this.t("Fixed by {portal}", rules.config.title)
      : this.t("Fixed by this portal");
    const says = why ? `${fixed}: ${why}` : fixed;
    // A disabled box gets no focus, and a touch screen shows no title.
    return html`<fieldset class="locked" disabled title=${says}>${this.box(placed)}</fieldset>${why ? html`<p class="why">${says}</p>` : nothing}`;
  }

  protected box(placed: Placed): TemplateResult {
    const { field, path } = placed;
    const held = this.store.get(path);
    const follows =
      field.kind === "number" && typeof held === "string" && /^\s*=/.test(held);
    const row = (body: TemplateResult) =>
      html`<div class=${follows ? "row follows" : "row"}><label for=${`f-${path}`} title=${field.help}>${field.label}</label>${body}${this.said(placed)}</div>`;
    switch (field.kind) {
      case "flag":
        return html`<div class="row"><label class="check" title=${field.help}><input id=${`f-${path}`} type="checkbox" .checked=${this.store.get(path) === true}
          aria-describedby=${`h-${path} e-${path}`} @focus=${() => this.store.focus(path)}
          @change=${(e: Event) => this.store.put(path, (e.target as HTMLInputElement).checked)} /> ${field.label}</label>${this.said(placed)}</div>`;
      case "choice":
        return row(
          this.select(path, this.choices(placed), (value) =>
            this.store.put(path, value),
          ),
        );
      case "code":
        return row(
          this.select(
            path,
            field.choices.map((c) => ({
              value: c.value,
              label: `${c.value}: ${c.label}`,
            })),
            (value) => this.store.put(path, Number(value)),
          ),
        );
      case "text":
        return row(html`<span class="number"><input id=${`f-${path}`} type="text" spellcheck="false" aria-describedby=${`h-${path} e-${path}`}
          .value=${String(this.store.get(path) ?? "")} @focus=${() => this.store.focus(path)} @blur=${() => this.store.settle()}
          @input=${(e: Event) => this.store.set(path, (e.target as HTMLInputElement).value)} /></span>`);
      case "lines":
        return this.lines(placed);
      case "nominalPoint":
      case "point":
        return html`<div class="row whole" role="group" aria-label=${field.label}>
          <span class="label" title=${field.help}>${field.label}</span>
          <div class="point">
            ${["X", "Y", "Z"].map((axis, i) => html`<span class=${typeof this.store.get(`${path}[${i}]`) === "string" ? "axis long" : "axis"}><label for=${`f-${path}[${i}]`}>${axis}</label>${this.number(field, `${path}[${i}]`, `${field.label} ${axis}`, this.followed(field, path, i))}<span class="visually-hidden" id=${`h-${path}[${i}]`}>${field.help}</span></span>`)}
          </div>
          ${this.said(placed, [path, ...[0, 1, 2].map((i) => `${path}[${i}]`)])}
        </div>`;
      case "nominal":
      case "number":
      case "count":
        return row(
          field.null
            ? this.nullable(placed)
            : this.number(field, path, undefined, this.followed(field, path)),
        );
    }
  }

  /** Lines of the program by their places, and the usual ones of the control. */
  protected lines({ field, path }: Placed): TemplateResult {
    const { store } = this;
    const held = (store.get(path) ?? {}) as Record<string, unknown>;
    const linesOf = (place: unknown) => {
      const lines = held[String(place)];
      return Array.isArray(lines) ? lines.map(String) : [];
    };
    const put = (place: unknown, text: string) => {
      const all = { ...held, [String(place)]: text ? text.split("\n") : [] };
      const used = Object.entries(all).filter(
        ([, lines]) => !Array.isArray(lines) || lines.length > 0,
      );
      store.set(path, used.length > 0 ? Object.fromEntries(used) : null);
    };
    const usual = store.post?.usualLines ?? [];
    const useUsual = () =>
      store.put(
        path,
        Object.fromEntries(usual.map(({ place, lines }) => [place, lines])),
      );
    return html`<p class="help" id=${`h-${path}`}>${field.help}</p>
      ${
        Object.keys(held).length === 0 && usual.length > 0
          ? html`<div class="row"><button type="button" id=${`f-${path}`} @click=${useUsual}>${this.t("Enter the usual lines for {control}", store.post?.title ?? "")}</button></div>`
          : nothing
      }
      ${field.choices.map(({ value: place, label }) => {
        const at = `${path}.${place}`;
        const lines = linesOf(place);
        const found = store.findings.filter(
          (one) => one.path === at || one.path.startsWith(`${at}[`),
        );
        const bad = found.some(({ level }) => level === "error");
        return html`<div class="lines"><label for=${`f-${at}`}>${label}</label>
          <textarea id=${`f-${at}`} rows=${Math.max(1, lines.length)} spellcheck="false" aria-describedby=${`h-${path} e-${at}`} aria-invalid=${bad ? "true" : "false"} .value=${live(lines.join("\n"))}
            @focus=${() => store.focus(path)} @blur=${() => store.settle()}
            @input=${(e: Event) => put(place, (e.target as HTMLTextAreaElement).value)}></textarea>
          <div id=${`e-${at}`}>${found.map((one) => html`<p class=${one.level}>${this.message(one)}</p>`)}</div></div>`;
      })}${this.problems(path)}`;
  }

  /** A number that may be null. Null has its own checkbox: an empty field never means rapid. */
  protected nullable({ field, path }: Placed): TemplateResult {
    const off = this.store.get(path) === null;
    return html`<span class="line"><label class="check"><input type="checkbox" .checked=${off} aria-label=${`${field.label}: ${field.null}`} @focus=${() => this.store.focus(path)}
        @change=${(e: Event) => this.store.put(path, (e.target as HTMLInputElement).checked ? null : this.rate(field))} /> ${field.null}</label>
      ${off ? html`<span class="number"><input id=${`f-${path}`} type="text" .value=${this.standing(path)} disabled /></span>` : this.number(field, path, undefined, this.followed(field, path))}</span>`;
  }

  /** Text shown for null: the number that the program takes from its name. */
  protected standing(path: string): string {
    const { stale, plan } = this.store;
    return (
      (path === "control.number" &&
        !stale &&
        /^O(\d+)/m.exec(plan.program.text)?.[1]) ||
      "–"
    );
  }

  /** Initial value of a rate that was null. */
  protected rate(field: FieldEntry): number {
    const stand = this.store.initialValue(field);
    return typeof stand === "number"
      ? stand
      : this.store.units === "inch"
        ? 80
        : 2000;
  }
}
