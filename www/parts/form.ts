import { html, nothing, type PropertyValues, type TemplateResult } from "lit";
import { repeat } from "lit/directives/repeat.js";
import {
  type FieldEntry,
  type Finding,
  proposedStock,
} from "../core/browser.js";
import { isOut } from "../job.js";
import { deviations, inside } from "../sentences.js";
import { sizeField } from "../store.js";
import { w } from "../words.js";
import { featureRow, rowsOf } from "./feature-row.js";
import type { Placed } from "./field.js";
import { FormRows } from "./form-rows.js";

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
  defaultInch: 0,
  null: null,
  choices: [],
  code: null,
  group: "",
  size: false,
  when: null,
};

/** Fields in the sentence of the bar; the form does not repeat them. */
const IN_BAR = new Set(["control.post", "control.workOffset", "units"]);
/** Values that the summary of a folded group always shows. */
const FIRST = new Set(["stylus.diameter", "name"]);
const VIRTUAL = "Virtual part";
const PICKED = w("Picked touches");
/** Groups that only cycles with touches need. */
const OF_TOUCHES =
  /^(stylus|feeds|limits|machine|part|stock|overtravel|control\.(protection|orient|report))\b/;
/** Maximum number of touches listed; no cycle has more. */
const MOST_ROWS = 50;
const idOf = (group: string) => `group-${group.replaceAll(/\W+/g, "-")}`;
/** Groups that only authors of postprocessors need. */
const FOR_CAM = /^Postprocessor/;
const USUAL = w("Clearances, touches, feeds");
const MACHINE = w("Machine and probe");
const STOCK = "Stock";
const PART = w("Stock and virtual part");
/** Folded sections for groups that are rarely changed, in order. */
const DOORS: [door: string, groups: RegExp][] = [
  [
    USUAL,
    /^(Touches|Probing|Clearances|Heights|Repeated touches|Extrusion probing|Touch probe table|Feeds and limits|After probing|Postprocessor)/,
  ],
  [
    MACHINE,
    /^(Program and machine|Probe|Tool length \(SINUMERIK\)|Shop's lines)$/,
  ],
  [PART, /^(Stock|Virtual part)$/],
];
/** Groups of a cycle without a heading. */
const PLAIN = /^(Position|Size|Circle [12]|Both circles)$/;

/** A heading with its fields. */
type Group = [name: string, fields: Placed[]];
interface Door {
  name: string;
  groups: Group[];
}

/** The form, built from the catalog. Its groups fold to a line with their values. */
class FormPart extends FormRows {
  /** Optional groups of the form, by heading. */
  private readonly optional = new Map<
    string,
    { path: string; fields: FieldEntry[] }
  >();

  /** Groups that the user has folded or opened. */
  private readonly opened = new Map<string, boolean>();

  /** Whether all other groups are open. */
  private all = false;

  override render(): TemplateResult {
    const { own, doors } = this.parted();
    const rows = rowsOf(this.store);
    const chips = [
      ...own.filter(([name]) => !PLAIN.test(name)),
      ...doors
        .filter(({ groups }) => groups.length > 0)
        .map(
          ({ name, groups }): Group => [
            name,
            groups.flatMap(([, fields]) => fields),
          ],
        ),
    ];
    const [usual, ...around] = doors.map((door) => this.door(door));
    const { store } = this;
    return html`
      <nav class="chips" aria-label=${this.t("Parts of the form")}>${
        store.features.several
          ? html`${rows.map(({ one, place, now }) => html`<button type="button" class="chip" aria-current=${now ? "true" : nothing} @click=${() => store.bringFeature(place)}>${one.name}</button>`)}<button type="button" class="add" ?disabled=${store.readonly} @click=${() => this.dispatchEvent(new CustomEvent("run-action", { bubbles: true, detail: "add" }))}>${this.t("+ Add")}</button>`
          : nothing
      }${chips.map(
        ([
          name,
          fields,
        ]) => html`<button type="button" class=${this.gravest(fields) ?? nothing} data-group=${idOf(name)} @click=${() => this.show(name)}
          @focus=${(e: Event) => (e.target as HTMLElement).scrollIntoView({ block: "nearest", inline: "nearest" })}>${this.t(name)}</button>`,
      )}</nav>
      <form @submit=${(event: Event) => event.preventDefault()} @entered=${(e: CustomEvent<HTMLElement>) => this.next(e.detail)} autocomplete="off">
        <ol class="features" aria-label=${this.t("Features")}>${repeat(
          rows,
          ({ one }) => one.name,
          (row) =>
            html`<li class=${`${row.now ? "now" : ""} ${row.one.off ? "off" : ""}`}>${featureRow(store, row)}${
              row.now
                ? html`<div class="open">${own.map(([name, fields]) => this.group(name, fields))}${usual}
              ${store.cycle.touches && (store.cam || this.isPicked) ? this.touches() : nothing}</div>`
                : nothing
            }</li>`,
        )}</ol>
        <tp-features .store=${store}></tp-features>
        <div class="around">${around}</div>
      </form>
    `;
  }

  /** Groups of the form: those of the cycle, and those in folded sections. */
  private parted(): { own: Group[]; doors: Door[] } {
    const all = this.groups();
    const doorOf = (name: string) =>
      DOORS.find(([, groups]) => groups.test(name))?.[0];
    const doors = DOORS.map(([name]) => ({
      name,
      groups: all.filter(([group]) => doorOf(group) === name),
    }));
    return { own: all.filter(([name]) => !doorOf(name)), doors };
  }

  /** Folded section. Its summary lists the values that differ from a new job. */
  private door({ name, groups }: Door): TemplateResult | typeof nothing {
    if (groups.length === 0) return nothing;
    const open = this.opened.get(name) ?? this.all;
    const fields = groups.flatMap(([, fields]) => fields);
    const said = open
      ? ""
      : groups
          .map(([group, fields]) => this.summary(group, fields))
          .filter(Boolean)
          .join(" · ");
    const usual = name === PART ? "" : this.t("as usual");
    const alone = groups.length === 1;
    const body = (open ? groups : []).map(([group, fields]) =>
      alone
        ? this.body(group, fields)
        : html`<section class="within" id=${idOf(group)} aria-label=${this.t(group)}><h3>${this.t(group)}</h3>${this.body(group, fields)}</section>`,
    );
    return this.folding(
      name,
      open,
      this.gravest(fields),
      open ? "" : said || usual,
      html`${body}`,
    );
  }

  /** The cycle whose form is shown. */
  private shown = "";

  /** The form of another cycle starts at its top. */
  protected override updated(changed: PropertyValues): void {
    super.updated(changed);
    const { type } = this.store.cycle;
    if (this.shown !== "" && this.shown !== type) this.scrollTop = 0;
    this.shown = type;
    this.store.partOpen = this.opened.get(PART) ?? this.all;
    this.mark();
  }

  /** Unfolds the group of a path; all groups without a path. */
  unfold(path?: string): Promise<boolean> {
    this.all ||= path === undefined;
    if (path?.startsWith("cycle.touches")) this.opened.set(PICKED, true);
    for (const [name, fields] of this.groups()) {
      const holds = (placed: Placed) =>
        path?.startsWith(placed.path) || placed.path.startsWith(`${path}.`);
      const door = DOORS.find(([, groups]) => groups.test(name))?.[0] ?? name;
      const within = this.optional.get(name);
      if (
        path !== undefined &&
        (fields.some(holds) || (within && path.startsWith(within.path)))
      )
        this.opened.set(door, true);
    }
    this.requestUpdate();
    return this.updateComplete;
  }

  /** Fields by heading: those of the cycle first, then those of the sections. */
  private groups(): [string, Placed[]][] {
    this.optional.clear();
    const { ownFeeds: own, maxTouches } = this.store.cycle;
    const { post } = this.store;
    const groups = new Map<string, Placed[]>();
    const add = (path: string, field: FieldEntry, group = field.group) => {
      if (IN_BAR.has(path)) return;
      // A hidden field is shown if it must be corrected.
      if (
        !this.store.rules.showsField(path) &&
        !this.levels(path).includes("error")
      )
        return;
      // A cycle without touches needs none of these, and some depend on the variant or the control. A field with an error is shown until it is left.
      const mended =
        this.levels(path).length > 0 || this.store.focused?.startsWith(path);
      const idle =
        (maxTouches === 0 && OF_TOUCHES.test(path)) ||
        !this.store.counts(path, field);
      if (idle && !mended) return;
      const asked =
        this.store.cam ||
        !FOR_CAM.test(group) ||
        !this.store.isUsual(path, field);
      if (!asked && !mended) return;
      const list = groups.get(group) ?? [];
      list.push({ field, path });
      groups.set(group, list);
    };
    const { sections } = this.store.catalog;
    for (const field of this.store.cycle.fields)
      add(`cycle.${field.key}`, field);
    for (const { key, optional, fields } of this.store.cycle.sections)
      if (!optional || this.offers(`cycle.${key}`, fields, groups))
        for (const field of fields) add(`cycle.${key}.${field.key}`, field);
    for (const { path, optional, fields } of sections) {
      if (optional) {
        const hidden = maxTouches === 0 || !this.store.rules.showsField(path);
        if (hidden || !this.offers(path, fields, groups)) continue;
      }
      // A cycle with a touch probe table has its own feeds and search distance.
      if (own && path === "feeds") continue;
      if (path === "tool" && !post?.firstLength) continue;
      for (const field of fields) {
        if (!(own && field.key === "overtravel"))
          add(path ? `${path}.${field.key}` : field.key, field);
      }
    }
    for (const field of this.store.cycle.fields.filter((f) => f.size))
      add(
        `part.sizes.${field.key}`,
        sizeField(field, this.store.words) as FieldEntry,
        VIRTUAL,
      );
    // The size comes first.
    const order = (name: string) =>
      name === "Size" ? -1 : FOR_CAM.test(name) ? 1 : 0;
    return [...groups].sort((a, b) => order(a[0]) - order(b[0]));
  }

  /** Adds the switch of an optional section. Returns whether the job has that section. */
  private offers(
    path: string,
    fields: FieldEntry[],
    groups: Map<string, Placed[]>,
  ): boolean {
    const group = fields[0]?.group ?? path;
    this.optional.set(group, { path, fields });
    const used = !isOut(this.store.get(path));
    if (!used && (this.store.cam || !FOR_CAM.test(group)))
      groups.set(group, []);
    return used;
  }

  private get isPicked(): boolean {
    return (
      Boolean(this.store.get("cycle.touches")) ||
      this.levels("cycle.touches").length > 0
    );
  }

  /** The fields of a group. */
  private body(name: string, fields: Placed[]): TemplateResult {
    const units = fields.some(({ path }) => path === "stylus.diameter")
      ? html`${this.units()}${this.styli()}`
      : nothing;
    return html`${this.switch(name)}${units}${fields.map((placed) => this.field(placed))}${this.outOf(fields)}
            ${fields.some((placed) => placed.path === "tool.type") ? this.frame() : nothing}`;
  }

  private group(name: string, fields: Placed[]): TemplateResult {
    const body = this.body(name, fields);
    if (PLAIN.test(name))
      return html`<fieldset class="fields plain" id=${idOf(name)} aria-label=${this.t(name)} ?disabled=${this.store.readonly}>${body}</fieldset>`;
    const open = this.isOpen(name);
    return this.folding(
      name,
      open,
      this.gravest(fields),
      open ? "" : this.summary(name, fields),
      body,
    );
  }

  /** Most severe level of the findings about some fields. */
  private gravest(fields: Placed[]): string | undefined {
    return ["error", "warning"].find((level) =>
      fields.some(({ path }) => this.levels(path).includes(level)),
    );
  }

  /** A group with its heading, which lists the values when folded. */
  private folding(
    name: string,
    open: boolean,
    level: string | undefined,
    summary: string,
    body: TemplateResult,
  ): TemplateResult {
    return html`<section class="group" id=${idOf(name)} aria-label=${this.t(name)}>
      <h2><button type="button" class=${`fold ${level ?? ""}`} aria-expanded=${open ? "true" : "false"} @click=${() => this.fold(name, open)}>
        <span class="sign" aria-hidden="true">${open ? "▾" : "▸"}</span> <b>${this.t(name)}</b>
        <span class="summary">${open ? nothing : summary}</span></button></h2>
      ${open ? html`<fieldset class="fields" aria-label=${this.t(name)} ?disabled=${this.store.readonly}>${body}</fieldset>` : nothing}
    </section>`;
  }

  /** Levels of the findings at a path or inside it. */
  private levels(path: string): string[] {
    const of = (f: Finding) =>
      f.path === path ||
      f.path.startsWith(`${path}[`) ||
      f.path.startsWith(`${path}.`) ||
      (["part", "stock"].includes(f.path) && path.startsWith(`${f.path}.`));
    return this.store.findings.filter(of).map((f) => f.level);
  }

  /** Groups with values from a drawing are open at first. */
  private isOpen(name: string): boolean {
    const own = this.store.cycle.fields.some((f) => f.group === name);
    return this.opened.get(name) ?? (this.all || own);
  }

  private fold(name: string, open: boolean): void {
    this.opened.set(name, !open);
    this.requestUpdate();
  }

  /** The group that the user visited last, by its chip or a field in it. */
  private near = "";

  /** Whether chips are shown: only in a narrow form. Reading this from the page would force a layout at every keystroke. */
  private chipped = false;

  private readonly chips = new ResizeObserver(([entry]) => {
    this.chipped = (entry?.contentRect.width ?? 0) > 0;
    this.mark();
  });

  private marking = 0;

  override connectedCallback(): void {
    super.connectedCallback();
    this.addEventListener("scroll", this.mark, { passive: true });
    this.addEventListener("focusin", this.goes);
    if (this.hasUpdated) this.watchChips();
  }

  protected override firstUpdated(): void {
    this.watchChips();
  }

  private watchChips(): void {
    this.chips.observe(this.querySelector(".chips") as HTMLElement);
  }

  override disconnectedCallback(): void {
    super.disconnectedCallback();
    this.removeEventListener("scroll", this.mark);
    this.removeEventListener("focusin", this.goes);
    this.chips.disconnect();
    cancelAnimationFrame(this.marking);
  }

  private readonly goes = ({ target }: Event): void => {
    this.near = (target as HTMLElement).closest(".group")?.id ?? this.near;
    this.mark();
  };

  /** Marks the chip of the current group in the next frame, which lays out the page in any case. */
  private readonly mark = (): void => {
    if (!this.chipped) return;
    cancelAnimationFrame(this.marking);
    this.marking = requestAnimationFrame(this.markNow);
  };

  /** Marks the chip of the group that was visited last while it is visible, else of the first one below the chips. */
  private readonly markNow = (): void => {
    const chips = this.querySelector<HTMLElement>(".chips");
    if (!chips) return;
    const groups = [...this.querySelectorAll<HTMLElement>(".group")];
    const top = chips.getBoundingClientRect().bottom;
    const end = this.getBoundingClientRect().bottom;
    const seen = groups.filter((group) => {
      const box = group.getBoundingClientRect();
      return box.bottom > top + 8 && box.top < end - 8;
    });
    const now = seen.find((group) => group.id === this.near) ?? seen[0];
    for (const chip of chips.querySelectorAll<HTMLElement>("[data-group]")) {
      const is = chip.dataset.group === now?.id;
      if (is === chip.hasAttribute("aria-current")) continue;
      if (!is) chip.removeAttribute("aria-current");
      else chip.setAttribute("aria-current", "true");
      // The chips of the features come before the first group.
      const left = now === groups[0] ? 0 : chip.offsetLeft - 40;
      if (is) chips.scrollTo({ left, behavior: "instant" });
    }
  };

  /** Goes to a group from its chip. */
  private async show(name: string): Promise<void> {
    this.opened.set(name, true);
    this.near = idOf(name);
    this.requestUpdate();
    await this.updateComplete;
    this.querySelector(`#${idOf(name)}`)?.scrollIntoView({ block: "start" });
  }

  /** Values of a folded group in one line. */
  private summary(name: string, fields: Placed[]): string {
    if (name === STOCK) {
      const { size } = (this.store.get("stock") ?? {}) as { size?: unknown[] };
      return size?.map((x) => this.store.number(String(x))).join(" × ") ?? "";
    }
    if (name === VIRTUAL)
      return deviations(this.store).join(" · ") || this.t("nominal");
    // Values with errors come first, then the feed of the touch and the ball.
    const faulty = (path: string) =>
      this.levels(path).some((level) => level !== "info");
    const rank = ({ path }: Placed) =>
      faulty(path) ? 0 : FIRST.has(path) ? 1 : 2;
    const sorted = [...fields].sort((a, b) => rank(a) - rank(b));
    const inner = (label: string) => inside(this.store, label);
    const shown = (x: unknown) =>
      typeof x === "number" ? this.store.number(String(x)) : String(x);
    const behind = DOORS.some(([, groups]) => groups.test(name));
    // Initial values are not listed.
    const said = sorted.filter(({ field, path }) => {
      // The save button already shows the name.
      if (path === "name") return faulty(path);
      return (
        FIRST.has(path) ||
        (!behind && this.store.cycle.fields.includes(field)) ||
        !this.store.isUsual(path, field) ||
        faulty(path)
      );
    });
    const words = said.flatMap(({ field, path }) => {
      const value =
        this.store.typed.get(path) ??
        this.store.get(path) ??
        (field.null ? null : this.store.defaultValue(field));
      if (value === undefined || value === "" || field.kind === "flag")
        return value === true ? [field.label] : [];
      if (value === null)
        return field.null ? [`${inner(field.label)} ${field.null}`] : [];
      const choice = this.choices({ field, path }).find(
        (c) => c.value === value,
      );
      if (choice) return [choice.label];
      if (field.kind === "text") return [String(value)];
      if (field.kind === "lines") return [field.label];
      return [
        `${inner(field.label)} ${Array.isArray(value) ? value.map(shown).join(" ") : shown(value)}`,
      ];
    });
    return (
      words.join(" · ") ||
      (!behind && this.optional.has(name) ? this.t("not used") : "")
    );
  }

  /** Checkbox of an optional section; nothing for a required group. */
  private switch(group: string): TemplateResult | typeof nothing {
    const section = this.optional.get(group);
    if (!section) return nothing;
    if (section.path === "stock") return this.stock();
    const values = () =>
      Object.fromEntries(
        section.fields.map((f) => [f.key, this.store.initialValue(f) ?? null]),
      );
    return this.use(section.path, this.t("Use it"), values);
  }

  /** Checkbox that adds a section with these values to the job, or removes it. Disabled without values. */
  private use(
    path: string,
    label: string,
    values: (() => unknown) | null,
  ): TemplateResult {
    const used = !isOut(this.store.get(path));
    const take = (e: Event) =>
      this.store.put(
        path,
        (e.target as HTMLInputElement).checked ? values?.() : null,
      );
    return html`<div class="row"><label class="check"><input type="checkbox" .checked=${used} ?disabled=${!used && !values} @change=${take} /> ${label}</label></div>`;
  }

  /** The checkbox of the stock, and the button that fits it to the features. */
  private stock(): TemplateResult {
    const { store } = this;
    // Undefined until the module is loaded.
    const fitted = proposedStock(store.job);
    const label = this.t("One block that the features are cut into");
    return html`${this.use("stock", label, fitted ? () => fitted : null)}${
      isOut(store.get("stock"))
        ? nothing
        : html`<button type="button" ?disabled=${!fitted} @click=${() => store.put("stock", fitted)}>${this.t("Fit it to the features")}</button>`
    }${fitted === null ? html`<p class="help">${this.t("No block parallel to the axes fits these features.")}</p>` : nothing}`;
  }

  /** The picked touches; without any they follow from the dimensions. */
  private touches(): TemplateResult {
    const picks = this.store.get("cycle.touches") as
      | { point: unknown[]; vector: unknown[] }[]
      | null
      | undefined;
    const take = () => {
      const touches = this.store.plan.touches.map(({ point, vector }) => ({
        point: [...point],
        vector: [...vector],
      }));
      this.store.put("cycle.touches", touches);
    };
    const point: FieldEntry = {
      ...TOUCH,
      unit: "length",
      label: this.t("Point"),
    };
    const vector: FieldEntry = {
      ...TOUCH,
      unit: "none",
      label: this.t("Vector"),
    };
    const open = this.opened.get(PICKED) ?? (this.all || Boolean(picks));
    return this.folding(
      PICKED,
      open,
      this.levels("cycle.touches")[0],
      picks
        ? this.t("{count} touches", picks.length)
        : this.t("from the dimensions"),
      html`
        <p class="help">${this.t("Points on the surface and outward normals, picked in the part. They replace the points that the dimensions give.")}</p>
        ${
          picks
            ? html`<button type="button" @click=${() => this.store.drop("cycle.touches")}>${this.t("Back to the dimensions")}</button>`
            : html`<button type="button" ?disabled=${this.store.stale} @click=${take}>${this.t("Pick touches one by one")}</button>`
        }
        ${this.problems("cycle.touches")}
        ${picks && picks.length > MOST_ROWS ? html`<p class="help">${this.t("Only the first {count} are listed", MOST_ROWS)}</p>` : nothing}
        <ol class="picks">${(picks ?? []).slice(0, MOST_ROWS).map((_, k) => {
          const at = `cycle.touches[${k}]`;
          const row = (field: FieldEntry, key: string) =>
            html`<div class="point" role="group" aria-label=${this.t("{label} of touch {touch}", field.label, k + 1)}>${[
              "X",
              "Y",
              "Z",
            ].map((axis, i) =>
              this.number(
                field,
                `${at}.${key}[${i}]`,
                `${this.t("{label} of touch {touch}", field.label, k + 1)}, ${axis}`,
              ),
            )}</div>`;
          const found = this.store.findings.filter((f) =>
            f.path.startsWith(at),
          );
          return html`<li>${row(point, "point")}${row(vector, "vector")}${found.map((f) => html`<p class=${`problem ${f.level}`}>${this.message(f)}</p>`)}</li>`;
        })}</ol>`,
    );
  }

  /** Enter moves on to the next number. */
  private next(box: HTMLElement): void {
    const boxes = [
      ...this.querySelectorAll<HTMLElement>("input[type=text]:not(:disabled)"),
    ];
    boxes[boxes.indexOf(box) + 1]?.focus();
  }
}

customElements.define("tp-form", FormPart);
