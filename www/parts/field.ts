import { html, nothing, type TemplateResult } from "lit";
import { live } from "lit/directives/live.js";
import type { FieldEntry, Finding } from "../core/browser.js";
import { head } from "../cycle-list.js";
import { isWorkedOut, readNumber, tidy } from "../number.js";
import { StorePart } from "./part.js";

/** A field and the path of its value in the job. */
export interface Placed {
  field: FieldEntry;
  path: string;
}

interface Choice {
  value: string | number | null;
  label: string;
  /** Reason why it cannot be chosen here, shown when it is chosen. */
  not?: string;
  /** Its heading; choices under the same heading follow each other. */
  under?: string;
}

/** Nominal size before a tolerance. */
const NOMINAL = /^(\s*[Øø⌀]?\s*)(\d+(?:[.,]\d+)?)/;

/** Choices by their headings, in order. */
function headed(choices: Choice[]): [string, Choice[]][] {
  const runs: [string, Choice[]][] = [];
  for (const choice of choices) {
    const { under = "" } = choice;
    if (runs.at(-1)?.[0] !== under) runs.push([under, []]);
    runs.at(-1)?.[1].push(choice);
  }
  return runs;
}

/** The codes of results that are sizes. */
const SIZES = /^(diameter|width\d?|distance|difference|mean)$/;

/** A part with fields of the job: their values, messages and input. */
export abstract class FieldPart extends StorePart {
  protected override storeEvents = ["change"];

  /** A field's value as text, with its unit in the box. */
  protected number(
    field: FieldEntry,
    path: string,
    name?: string,
    proposed: string[] = [],
  ): TemplateResult {
    const value = this.store.get(path);
    const stand = this.store.defaultValue(field);
    const index = /\[(\d)\]$/.exec(path)?.[1];
    const missing =
      Array.isArray(stand) && index
        ? stand[Number(index)]
        : (this.middle(path) ?? stand);
    const held = (value === undefined ? missing : value) ?? "";
    const text =
      this.store.typed.get(path) ??
      (typeof held === "number"
        ? this.store.number(String(held))
        : String(held));
    const words = field.kind === "nominal" || field.kind === "nominalPoint";
    const unit = this.unit(field);
    // A checkbox for null leaves less room.
    const crowded =
      unit !== "" &&
      text.length + unit.length > (field.null === null ? 14 : 12);
    return html`<span class=${`number ${this.level(path)} ${crowded ? "crowded" : ""}`}><input id=${`f-${path}`} type="text" inputmode=${words || (typeof held === "string" && held !== "") ? "text" : field.unit === "none" ? "numeric" : "decimal"} spellcheck="false"
        aria-describedby=${`h-${path} u-${path} e-${path}`} aria-label=${name ?? nothing} aria-invalid=${this.isBad(path) ? "true" : "false"} .value=${text}
        @focus=${(e: Event) => {
          (e.target as HTMLInputElement).select();
          this.entry = (e.target as HTMLInputElement).value;
          this.store.focus(path);
        }}
        @blur=${() => this.accept(path)}
        @keydown=${(e: KeyboardEvent) => this.key(e, field, path)}
        @input=${(e: Event) => this.typed(field, path, (e.target as HTMLInputElement).value)} />${
          unit
            ? html`<span class=${unit.length > 4 ? "unit long" : "unit"} id=${`u-${path}`}>${unit}</span>`
            : nothing
        }${proposed.length > 0 ? this.equals(path, name ?? field.label, proposed) : nothing}</span>`;
  }

  /** Deviation of a size of the virtual part that the job does not state: the middle of its tolerance zone. */
  private middle(path: string): number | undefined {
    const { store } = this;
    const [, code = ""] = /^part\.sizes\.(\w+)$/.exec(path) ?? [];
    const cycle = store.features.several ? store.features.inJob : 0;
    const row = store.plan.results.find(
      (one) => one.code === code && one.cycle === cycle,
    );
    return code === "" ||
      store.stale ||
      store.sizeWithTolerance(cycle, code) === null ||
      !row
      ? undefined
      : tidy((row.truth ?? 0) - (row.nominal ?? 0));
  }

  /** Menu of the results that a field can follow. */
  private equals(
    path: string,
    label: string,
    results: string[],
  ): TemplateResult {
    const take = (e: Event) => {
      const list = e.target as HTMLSelectElement;
      if (list.value) this.store.follow(path, list.value);
      list.value = "";
    };
    return html`<select class="equals" aria-label=${this.t("{label} follows a result", label)} title=${this.t("{label} follows a result", label)} @change=${take}><option value="">=</option>${results.map((one) => html`<option value=${one}>${one.slice(1)}</option>`)}</select>`;
  }

  /** Results that a field of a cycle can follow: those of earlier cycles and of relations between them. `axis`: the field is a coordinate along this axis. */
  protected followed(field: FieldEntry, path: string, axis?: number): string[] {
    const { features, plan } = this.store;
    const control = this.store.catalog.posts.find(
      ({ id }) => id === plan.program.post,
    );
    const { own } = plan.program;
    // Without computed results there is nothing to follow.
    const computes = own ? control?.computesBetween : control?.computes;
    if (!features.several || !path.startsWith("cycle.") || !computes) return [];
    // Abscissa, ordinate and tool axis in each plane.
    const axes = { G17: [0, 1, 2], G18: [2, 0, 1], G19: [1, 2, 0] }[
      String(this.store.get("plane"))
    ] ?? [0, 1, 2];
    const written = (key: string | undefined) =>
      plan.datum.find((row) => row.axis === key)?.choices ?? [];
    const names = [...plan.cycles, ...plan.relations];
    const sizes = () =>
      plan.results
        .filter(
          ({ code, nominal, unit }) =>
            SIZES.test(code) && unit !== "deg" && (nominal ?? 0) > 0,
        )
        .map((row) => `${names[row.cycle]}.${row.code}`)
        .filter((name) => !written("z").includes(name));
    const before = features.knownBefore(plan.cycles.slice(0, features.inJob));
    const from = (choices: string[]) =>
      choices
        .filter((one) => before.has(head(one).toLowerCase()))
        .map((one) => `=${one}`);
    if (path === "cycle.origin")
      return axis === undefined
        ? []
        : from(written(["x", "y", "z"][axes.indexOf(axis)]));
    // Native cycles probe along the axes.
    if (path === "cycle.rotation") return own ? [] : from(written("rotation"));
    return field.kind === "number" && field.size && field.unit === "length"
      ? from(sizes())
      : [];
  }

  /** Value of the focused field when it got the focus. */
  private entry: string | undefined;

  /** A nominal value may include a tolerance (`20+0.1-0.1`), which is no sum. */
  private typed(field: FieldEntry, path: string, text: string): void {
    const words = field.kind === "nominal" || field.kind === "nominalPoint";
    const plain =
      words &&
      isWorkedOut(
        text.replaceAll("−", "-").replace(/\s*(mm|inch|in|"|″)$/i, ""),
      );
    // A size deviation of the virtual part is no size.
    const size = field.size && !path.startsWith("part.");
    this.store.set(
      path,
      plain
        ? text
        : readNumber(
            text,
            field.unit,
            this.store.units,
            this.store.comma,
            size,
          ),
      text,
    );
  }

  /** Replaces a sum by its value; other text stays as it was typed. */
  private accept(path: string): void {
    this.store.settle();
    const text = this.store.typed.get(path);
    const value = this.store.get(path);
    // The other decimal sign may be a group separator: the field shows the number that was read.
    const other = this.store.comma ? "." : ",";
    if (
      text !== undefined &&
      typeof value === "number" &&
      (isWorkedOut(text) || text.includes(other))
    )
      this.store.tidy(path);
  }

  private key(event: KeyboardEvent, field: FieldEntry, path: string): void {
    if (event.isComposing) return;
    const box = event.target as HTMLInputElement;
    const step = { ArrowUp: 1, ArrowDown: -1 }[event.key];
    const value = this.store.get(path);
    if (event.key === "Enter") {
      this.accept(path);
      box.select();
      box.dispatchEvent(
        new CustomEvent("entered", { bubbles: true, detail: box }),
      );
    } else if (
      event.key === "Escape" &&
      this.entry !== undefined &&
      this.entry !== box.value
    ) {
      event.stopPropagation();
      this.typed(field, path, this.entry);
      this.accept(path);
      this.updateComplete.then(() => box.select());
    } else if (
      step &&
      typeof value === "number" &&
      !event.ctrlKey &&
      !event.altKey &&
      !event.metaKey
    ) {
      const next = value + step * this.step(field, event.shiftKey);
      this.store.set(path, tidy(next));
      this.updateComplete.then(() => box.select());
    } else if (
      step &&
      field.size &&
      typeof value === "string" &&
      NOMINAL.test(value) &&
      !event.ctrlKey &&
      !event.altKey &&
      !event.metaKey
    ) {
      // Changes only the nominal size.
      const next = value.replace(NOMINAL, (_, sign: string, size: string) => {
        const stepped =
          Number(size.replace(",", ".")) +
          step * this.step(field, event.shiftKey);
        // A size is greater than 0.
        const text = stepped > 0 ? String(tidy(stepped)) : size;
        return sign + (size.includes(",") ? text.replace(".", ",") : text);
      });
      this.store.set(path, next);
      this.updateComplete.then(() => box.select());
    } else return;
    event.preventDefault();
  }

  /** Step of an arrow key; with Shift a tenth of it. */
  private step(field: FieldEntry, fine: boolean): number {
    if (field.kind === "count") return 1;
    const coarse = {
      length: this.store.units === "inch" ? 0.1 : 1,
      feed: this.store.units === "inch" ? 1 : 10,
      acceleration: this.store.units === "inch" ? 1 : 50,
      time: 1,
      angle: 1,
      none: 1,
    };
    return coarse[field.unit] * (fine ? 0.1 : 1);
  }

  /** A menu. A value that is not in its list is shown as it is. */
  protected select(
    path: string,
    choices: Choice[],
    take: (value: string) => void,
    name?: string,
    shown: { title?: string; value?: unknown; id?: string } = {},
  ): TemplateResult {
    const held = this.store.get(path);
    const value =
      shown.value !== undefined
        ? shown.value
        : held === undefined
          ? this.fallback(path)
          : held;
    const known = choices.some((c) => c.value === value);
    return html`<span class=${`choice ${this.level(path)}`}><select id=${shown.id ?? `f-${path}`} aria-label=${name ?? nothing} title=${shown.title ?? nothing} aria-describedby=${`h-${path} e-${path}`}
        aria-invalid=${this.isBad(path) ? "true" : "false"} @focus=${() => this.store.focus(path)}
        @change=${(e: Event) => take((e.target as HTMLSelectElement).value)}>
        ${known ? nothing : html`<option value=${String(value)} .selected=${live(true)} disabled>${String(value)}</option>`}
        ${headed(choices).map(([under, those]) => {
          const options = those.map(
            (c) =>
              html`<option value=${c.value ?? ""} title=${c.not ?? nothing} class=${c.not === undefined ? nothing : "not"} .selected=${live(c.value === value)}>${c.label}</option>`,
          );
          return under.trim()
            ? html`<optgroup label=${under}>${options}</optgroup>`
            : options;
        })}
      </select></span>`;
  }

  /** Radio buttons for a few short choices. Any other value is shown beside them. */
  protected radios(
    path: string,
    words: string[],
    take: (word: string) => void,
    name: string,
  ): TemplateResult {
    const value = String(this.store.get(path) ?? this.fallback(path));
    const shown = words.includes(value) ? words : [...words, value];
    return html`<span class=${`switch ${this.level(path)}`} role="radiogroup" aria-label=${name}>${shown.map(
      (
        word,
      ) => html`<label><input type="radio" id=${word === value ? `f-${path}` : nothing} name=${path} value=${word} .checked=${live(word === value)}
        aria-describedby=${`e-${path}`} aria-invalid=${word === value && this.isBad(path) ? "true" : "false"}
        @focus=${() => this.store.focus(path)} @change=${() => take(word)} /><span>${word}</span></label>`,
    )}</span>`;
  }

  private fallback(path: string): unknown {
    const [section, key] = path.split(".");
    const fields = this.store.catalog.sections.find(
      (s) => s.path === (key ? section : ""),
    )?.fields;
    return fields?.find((f) => f.key === (key ?? section))?.default ?? null;
  }

  /** Help and messages of a field for screen readers; the help box of the form shows them. */
  protected said(
    { field, path }: Placed,
    parts: string[] = [path],
  ): TemplateResult {
    return html`<span class="visually-hidden" id=${`h-${path}`}>${field.help}</span>${parts.map((part) => this.problems(part))}`;
  }

  protected problems(path: string): TemplateResult | typeof nothing {
    const found = this.store.at(path);
    if (found.length === 0) return nothing;
    return html`<span class="visually-hidden" id=${`e-${path}`}>${found.map((f: Finding) => html`<span class=${f.level}>${this.message(f)} </span>`)}</span>`;
  }

  protected isBad(path: string): boolean {
    return this.store.at(path).some((f) => f.level === "error");
  }

  /** Most severe level of a field's findings. */
  protected level(path: string): string {
    const found = this.store.at(path);
    return found.some((f) => f.level === "error")
      ? "error"
      : found.some((f) => f.level === "warning")
        ? "warning"
        : "";
  }

  protected unit(field: FieldEntry): string {
    const unit = this.store.units;
    return {
      length: unit,
      feed: `${unit}/min`,
      acceleration: `${unit}/s²`,
      time: "ms",
      angle: "°",
      none: "",
    }[field.unit];
  }
}
