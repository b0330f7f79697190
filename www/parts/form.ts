import { html, nothing, type TemplateResult } from "lit";
import type { FieldEntry, Finding } from "../core/browser.js";
import { parseNumber } from "../store.js";
import { Part } from "./part.js";

/** A field and where its value stands in the job. */
interface Placed {
  field: FieldEntry;
  path: string;
}

/** A number of a picked touch. */
const TOUCH: FieldEntry = {
  key: "",
  label: "",
  help: "",
  kind: "number",
  unit: "length",
  range: null,
  above: false,
  usual: null,
  default: 0,
  null: null,
  choices: [],
  code: null,
  group: "",
  size: false,
};

/** The form, drawn from the catalog. */
class FormPart extends Part {
  /** Forms inside the form that may be left out, by heading. */
  private readonly optional = new Map<string, { path: string; fields: FieldEntry[] }>();
  protected override follows = ["change"];

  override render(): TemplateResult {
    const cycle = this.store.cycle;
    return html`
      <form @submit=${(event: Event) => event.preventDefault()} autocomplete="off">
        <fieldset>
          <legend>Cycle</legend>
          <div class="field wide">
            <label for="f-cycle.type">Cycle</label>
            <select id="f-cycle.type" @change=${(e: Event) => this.store.choose((e.target as HTMLSelectElement).value as typeof cycle.type)}>
              ${this.store.catalog.cycles.map((c) => html`<option value=${c.type} ?selected=${c.type === cycle.type}>${c.title} (${c.source})</option>`)}
            </select>
            ${this.problems("cycle.type")}
          </div>
        </fieldset>
        ${this.groups().map(
          ([name, fields]) =>
            html`<fieldset><legend>${name}</legend>${this.switch(name)}${fields.map((placed) => this.field(placed))}
              ${fields.some((placed) => placed.path === "tool.type") ? this.frame() : nothing}</fieldset>`,
        )}
        ${cycle.touches ? this.touches() : nothing}
      </form>
    `;
  }

  /** Fields under their headings: the cycle's own first, then what stands around it, the virtual part last. */
  private groups(): [string, Placed[]][] {
    this.optional.clear();
    const own = this.store.cycle.ownFeeds;
    const post = this.store.catalog.posts.find((p) => p.id === this.store.get("control.post"));
    const groups = new Map<string, Placed[]>();
    const add = (path: string, field: FieldEntry, group = field.group) => {
      const list = groups.get(group) ?? [];
      list.push({ field, path });
      groups.set(group, list);
    };
    const { sections } = this.store.catalog;
    for (const field of this.store.cycle.fields) add(`cycle.${field.key}`, field);
    for (const { key, optional, fields } of this.store.cycle.sections) {
      if (optional) this.optional.set(fields[0]?.group ?? key, { path: `cycle.${key}`, fields });
      if (optional && this.store.get(`cycle.${key}`) === null) groups.set(fields[0]?.group ?? key, []);
      else for (const field of fields) add(`cycle.${key}.${field.key}`, field);
    }
    for (const { path, fields } of sections) {
      // A cycle with a touch probe table of its own has its own feeds and search length.
      if (own && path === "feeds") continue;
      if (path === "tool" && !post?.firstLength) continue;
      for (const field of fields) {
        if (!(own && field.key === "overtravel")) add(path ? `${path}.${field.key}` : field.key, field);
      }
    }
    for (const field of this.store.cycle.fields.filter((f) => f.size)) {
      const label = `${field.label} differs by`;
      const help = `How much the real ${field.label.toLowerCase()} is larger (or, negative, smaller) than it should be.`;
      add(`part.sizes.${field.key}`, { ...field, label, help, default: 0, code: null }, "Virtual part");
    }
    // The postprocessor's own fields are rarely touched.
    const order = (name: string) => (name.startsWith("Postprocessor") ? 1 : name === "Virtual part" ? 2 : 0);
    return [...groups].sort((a, b) => order(a[0]) - order(b[0]));
  }

  /** The box that puts a form inside the form in or out. */
  private switch(group: string): TemplateResult | typeof nothing {
    const section = this.optional.get(group);
    if (!section) return nothing;
    const values = () => Object.fromEntries(section.fields.map((f) => [f.key, this.store.standIn(f) ?? null]));
    return html`<div class="field wide"><label class="check"><input type="checkbox" .checked=${this.store.get(section.path) !== null}
      @change=${(e: Event) => this.store.set(section.path, (e.target as HTMLInputElement).checked ? values() : null)} /> Use it</label></div>`;
  }

  /** The frame that the tool lengths are seen in: made in the other tool, taken from there. */
  private frame(): TemplateResult {
    const frame = (this.store.get("tool.frame") ?? []) as ({ rot: string; angle: number } | { mirror: string })[];
    const words = frame.map((s) => ("rot" in s ? `ROT ${s.rot}${s.angle}` : `MIRROR ${s.mirror}`)).join(", ");
    return html`<div class="field wide"><p class="help">Frame: ${words || "none"}. Tool lengths, above, has a button that takes its question
      into the job.</p>${frame.length ? html`<button type="button" @click=${() => this.store.set("tool.frame", [])}>No frame</button>` : nothing}
      ${this.problems("tool")}${this.problems("tool.frame")}</div>`;
  }

  /** The touches, picked one by one; else they follow from the dimensions. */
  private touches(): TemplateResult {
    const picks = this.store.get("cycle.touches") as { point: unknown[]; vector: unknown[] }[] | null | undefined;
    const take = () => {
      const touches = this.store.plan.touches.map(({ point, vector }) => ({ point: [...point], vector: [...vector] }));
      this.store.set("cycle.touches", touches);
    };
    const point: FieldEntry = { ...TOUCH, unit: "length", label: "Point" };
    const vector: FieldEntry = { ...TOUCH, unit: "none", label: "Vector" };
    return html`<fieldset><legend>Picked touches</legend>
      <div class="field wide">
        <p class="help">The Job Assignment's own picks: points on the surface and outward normals. They replace the points that the dimensions give.</p>
        ${
          picks
            ? html`<button type="button" @click=${() => this.store.drop("cycle.touches")}>Back to the dimensions</button>`
            : html`<button type="button" ?disabled=${this.store.stale} @click=${take}>Pick touches one by one</button>`
        }
        ${this.problems("cycle.touches")}
        <ol class="picks">${(picks ?? []).map((_, k) => {
          const at = `cycle.touches[${k}]`;
          const row = (field: FieldEntry, key: string) =>
            html`<div class="point" role="group" aria-label=${`${field.label} of touch ${k + 1}`}>${["X", "Y", "Z"].map(
              (axis, i) => this.number(field, `${at}.${key}[${i}]`, `${field.label} of touch ${k + 1}, ${axis}`),
            )}</div>`;
          return html`<li>${row(point, "point")}${row(vector, "vector")}${this.problems(at)}${this.problems(`${at}.vector`)}</li>`;
        })}</ol>
      </div></fieldset>`;
  }

  private field(placed: Placed): TemplateResult {
    const { field, path } = placed;
    if (path === "control.workOffset") return this.workOffset(placed);
    const held = this.store.get(path);
    const value = held === undefined ? field.default : held;
    switch (field.kind) {
      case "flag":
        return html`<div class="field">
          <label class="check"><input id=${`f-${path}`} type="checkbox" .checked=${this.store.get(path) === true} aria-describedby=${`h-${path}`}
            @change=${(e: Event) => this.store.set(path, (e.target as HTMLInputElement).checked)} /> ${field.label}</label>
          ${this.foot(placed)}
        </div>`;
      case "choice":
        return html`<div class="field">
          <label for=${`f-${path}`}>${field.label}</label>
          <select id=${`f-${path}`} aria-describedby=${`h-${path}`} @change=${(e: Event) => this.choose(path, (e.target as HTMLSelectElement).value)}>
            ${this.options(field.choices, value)}
          </select>
          ${this.foot(placed)}
        </div>`;
      case "code":
        return html`<div class="field">
          <label for=${`f-${path}`}>${field.label}</label>
          <select id=${`f-${path}`} aria-describedby=${`h-${path}`} @change=${(e: Event) => this.store.set(path, Number((e.target as HTMLSelectElement).value))}>
            ${this.options(
              field.choices.map((c) => ({ value: c.value, label: `${c.value}: ${c.label}` })),
              value,
            )}
          </select>
          ${this.foot(placed)}
        </div>`;
      case "text":
        return html`<div class="field">
          <label for=${`f-${path}`}>${field.label}</label>
          <input id=${`f-${path}`} type="text" spellcheck="false" aria-describedby=${`h-${path}`} .value=${String(this.store.get(path) ?? "")}
            @input=${(e: Event) => this.store.set(path, (e.target as HTMLInputElement).value)} />
          ${this.foot(placed)}
        </div>`;
      case "nominalPoint":
      case "point":
        return html`<div class="field wide" role="group" aria-label=${field.label}>
          <span class="label">${field.label}</span>
          <div class="point">
            ${["X", "Y", "Z"].map((axis, i) => html`<span class="axis"><label for=${`f-${path}[${i}]`}>${axis}</label>${this.number(field, `${path}[${i}]`, `${field.label} ${axis}`)}</span>`)}
          </div>
          ${[0, 1, 2].map((i) => this.problems(`${path}[${i}]`))} ${this.foot(placed)}
        </div>`;
      case "nominal":
      case "number":
      case "count":
        return html`<div class="field">
          <label for=${`f-${path}`}>${field.label}</label>
          <div class="line">${field.null ? this.nullable(placed) : this.number(field, path)}</div>
          ${this.foot(placed)}
        </div>`;
    }
  }

  private number(field: FieldEntry, path: string, name?: string): TemplateResult {
    const value = this.store.get(path);
    const stand = this.store.standIn(field);
    const index = /\[(\d)\]$/.exec(path)?.[1];
    const missing = Array.isArray(stand) && index ? stand[Number(index)] : stand;
    const text = this.store.typed.get(path) ?? String((value === undefined ? missing : value) ?? "");
    const words = field.kind === "nominal" || field.kind === "nominalPoint";
    const bad = this.store.at(path).some((f) => f.level === "error");
    return html`<span class="number"><input id=${`f-${path}`} type="text" inputmode=${words ? "text" : field.unit === "none" ? "numeric" : "decimal"} spellcheck="false"
        aria-describedby=${`h-${path} e-${path}`} aria-label=${name ?? nothing} aria-invalid=${bad ? "true" : "false"} .value=${text}
        @focus=${(e: Event) => (e.target as HTMLInputElement).select()}
        @input=${(e: Event) => {
          const typed = (e.target as HTMLInputElement).value;
          this.store.set(path, parseNumber(typed), typed);
        }} /><span class="unit">${this.unit(field)}</span></span>`;
  }

  /** A number that may be null: null has a box of its own, so that an empty field never means rapid. */
  private nullable({ field, path }: Placed): TemplateResult {
    const off = this.store.get(path) === null;
    return html`${off ? html`<span class="number"><input id=${`f-${path}`} type="text" value=${field.null ?? ""} disabled /></span>` : this.number(field, path)}
      <label class="check"><input type="checkbox" .checked=${off} aria-label=${`${field.label}: ${field.null}`}
        @change=${(e: Event) => this.store.set(path, (e.target as HTMLInputElement).checked ? null : this.rate(field))} /> ${field.null}</label>`;
  }

  /** A rate to start from where one was not wanted before. */
  private rate(field: FieldEntry): number {
    const stand = this.store.standIn(field);
    return typeof stand === "number" ? stand : this.store.units === "inch" ? 80 : 2000;
  }

  private workOffset(placed: Placed): TemplateResult {
    const { field, path } = placed;
    const value = this.store.get(path) ?? null;
    const post = this.store.catalog.posts.find((p) => p.id === this.store.get("control.post"));
    const most = Math.max(post?.workOffsets ?? 0, typeof value === "number" ? Math.min(value, 99) : 0);
    const word = (n: number) => post?.workOffsetWords[n - 1] ?? "?";
    const numbers = Array.from({ length: most }, (_, i) => ({ value: i + 1, label: `${word(i + 1)} (${i + 1})` }));
    const options = [{ value: null, label: "none, measure only" }, ...numbers];
    return html`<div class="field">
      <label for=${`f-${path}`}>${field.label}</label>
      <select id=${`f-${path}`} aria-describedby=${`h-${path}`}
        @change=${(e: Event) => {
          const chosen = (e.target as HTMLSelectElement).value;
          this.store.set(path, chosen ? Number(chosen) : null);
        }}>
        ${this.options(options, value)}
      </select>
      ${this.foot(placed)}
    </div>`;
  }

  /** The choices, and before them a value that is none of them: the form shows what the job says. */
  private options(choices: { value: string | number | null; label: string }[], value: unknown): TemplateResult {
    const known = choices.some((c) => c.value === value);
    return html`${known ? nothing : html`<option value=${String(value)} selected disabled>${String(value)}</option>`}
      ${choices.map((c) => html`<option value=${c.value ?? ""} ?selected=${c.value === value}>${c.label}</option>`)}`;
  }

  private choose(path: string, value: string): void {
    if (path === "units") this.store.setUnits(value as "mm" | "inch");
    else this.store.set(path, value);
  }

  private unit(field: FieldEntry): string {
    const unit = this.store.units;
    return { length: unit, feed: `${unit}/min`, angle: "°", none: "" }[field.unit];
  }

  /** Problems and help under a field. */
  private foot({ field, path }: Placed): TemplateResult {
    const code = field.code ? html` <code>${field.code}</code>` : nothing;
    return html`${this.problems(path)}<p class="help" id=${`h-${path}`}>${field.help}${code}</p>`;
  }

  private problems(path: string): TemplateResult | typeof nothing {
    const found = this.store.at(path);
    if (found.length === 0) return nothing;
    return html`<div id=${`e-${path}`}>${found.map((f: Finding) => html`<p class=${`problem ${f.level}`}>${f.message}</p>`)}</div>`;
  }
}

customElements.define("tp-form", FormPart);
