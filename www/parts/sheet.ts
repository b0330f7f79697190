import { html, nothing, type TemplateResult } from "lit";
import type { FieldEntry, PageView, ResultRow } from "../core/browser.js";
import { isWritten } from "../core/results.js";
import { deviations, ofRunout, resultInWords } from "../sentences.js";
import { checked } from "./checks.js";
import { Drawing, label } from "./drawing.js";
import { StorePart } from "./part.js";

/** Header lines of a program before its blocks, from the units on: preconditions and effects. */
function conditions(text: string): string[] {
  const said = [];
  for (const line of text.split("\n")) {
    const comment = /^(?:\d+ )?[;(] ?(.*?)\)?$/.exec(line)?.[1];
    if (
      /^Made by /i.test(comment ?? "") ||
      (comment === undefined && said.length > 0)
    )
      break;
    if (comment !== undefined && (said.length > 0 || /^Units /i.test(comment)))
      said.push(comment);
  }
  return said;
}

/** Views of the pictures. */
const SEEN = ["top", "front"] as const;

/** Programs with longer comments do not wrap them. */
const WRAPS = 80;

/** Joins wrapped comments: a line continues the sentence if its first word did not fit on the line before. */
function unwrapped(lines: string[]): string[] {
  const most = Math.max(...lines.map((line) => line.length));
  if (most > WRAPS) return lines;
  const whole: string[] = [];
  let before = "";
  for (const line of lines) {
    const [word = ""] = line.split(" ", 1);
    const continues =
      before.length > 40 && before.length + 1 + word.length > most;
    if (continues) whole.push(`${whole.pop()} ${line}`);
    else whole.push(line);
    before = line;
  }
  return whole;
}

/** A sheet with more results or touches is printed smaller, so that it fits on one page. */
const MANY_RESULTS = 12;
const MANY_TOUCHES = 8;

/** One page to print and take to the machine: picture, dimensions, expected results, checks, and boxes for the measured values. */
class SheetPart extends StorePart {
  protected override storeEvents = ["change"];
  /** The pictures: from the top, and from the front with every height. */
  private readonly drawings = new Map<(typeof SEEN)[number], Drawing>();
  /** The canvas and the form that were drawn. */
  private drawn: { canvas?: Element; form: string } = { form: "" };

  override render(): TemplateResult {
    const { withheld } = this.store;
    if (withheld !== null) {
      return html`<p class="problem error"><b>${this.t("No setup sheet while the form has an error:")}</b> ${withheld}</p>`;
    }
    const { plan, units, shown: job, cycle } = this.store;
    const { program } = plan;
    const post = this.store.postOf(program.post);
    // Several features: one large picture and a table for each.
    const several = plan.cycles.length > 1;
    const dense =
      plan.results.length > MANY_RESULTS || plan.touches.length > MANY_TOUCHES;
    const head = conditions(program.text);
    const shown = (x: unknown) =>
      typeof x === "number" ? this.store.number(String(x)) : String(x);
    const number = (x: number | null) =>
      x === null
        ? "–"
        : this.store.number(
            x.toFixed(units === "inch" ? 4 : 3).replace(/^-(0\.0*)$/, "$1"),
          );
    const off = deviations(this.store);
    const sigmas = (x: number | null) =>
      this.store.number((2 * (x ?? 0)).toFixed(4));
    const eccentric = ofRunout(
      plan.results,
      (r) => `${r.code} ${sigmas(r.uncertaintyRunout)}`,
    );
    const feeds = job.feeds as Record<string, number | null>;
    const stylus = job.stylus as Record<string, unknown>;
    return html`
      <div class="tools screen">
        <button type="button" class="primary" @click=${() => print()}>${this.t("Print")}</button>
      </div>
      <article aria-label=${this.t("Setup sheet")}>
        <h2>${String(job.name || "PROBE")}: ${plan.cycles.length > 1 ? plan.cycles.join(", ") : cycle.title}</h2>
        <p>${plan.cycles.length > 1 ? this.t("{count} cycles in one program", plan.cycles.length) : cycle.source} · ${post?.title ?? program.post}, ${this.store.does} · ${this.t("all lengths in {units} · file {file}", units, this.store.fileName(program.extension))}</p>
        ${off.length > 0 ? html`<p class="warning"><b>${this.t("Expected values are for the virtual part, not the drawing:")}</b> ${off.join(", ")}</p>` : nothing}
        <div class=${several ? "views one" : dense ? "views dense" : "views"}><canvas data-view="top" role="img" aria-label=${this.t("Path of the probe from the top")}></canvas>${several ? nothing : html`<canvas data-view="front" role="img" aria-label=${this.t("Path of the probe from the front, with its heights")}></canvas>`}</div>
        <div class=${dense && !several ? "columns dense" : "columns"}>
          <div>
            ${this.expected(number, sigmas)}
            ${eccentric ? html`<p>${this.t("The ball's eccentricity accounts for this much of ± 2σ: {list}", eccentric)}</p>` : nothing}
          </div>
          <div>
            <table>
              <caption>${this.t("Dimensions and probe")}</caption>
              <tbody>
                ${this.dimensions()}
                <tr><td>${this.t("Ball diameter")}</td><td class="n">${shown(stylus.diameter)}</td>${this.code()}</tr>
                ${
                  cycle.ownFeeds
                    ? nothing
                    : html`<tr><td>${this.t("Overtravel")}</td><td class="n">${shown(job.overtravel)}</td>${this.code()}</tr>
                  <tr><td>${this.store.fieldAt("feeds.work")?.label}</td><td class="n">${shown(feeds.work)} ${units}/min</td>${this.code()}</tr>`
                }
              </tbody>
            </table>
            ${
              several
                ? nothing
                : html`<table>
              <caption>${this.t("Touches: contact on the surface")}</caption>
              <thead><tr><th>${this.t("Touch no.")}</th><th class="n">X</th><th class="n">Y</th><th class="n">Z</th><th>${this.t("Checked")}</th></tr></thead>
              <tbody>${plan.touches.map((t, k) => html`<tr><td>${this.store.ofCycle(t.cycle, String(this.store.touchNumber(k))).replace(".", " ")}</td>${t.point.map((x) => html`<td class="n">${number(x)}</td>`)}<td class="box"></td></tr>`)}</tbody>
            </table>`
            }
            ${head.length ? html`<div class="head"><b>${this.t("The program states:")}</b>\n${unwrapped(head).join("\n")}</div>` : nothing}
          </div>
        </div>
        <p>${checked(this.store)}. ${this.hash ? this.t("Hash of the blocks: {hash}.", this.hash) : nothing}${this.reasons().map((why) => ` ${why}.`)}</p>
        ${plan.findings.filter((f) => f.level === "warning").map((f) => html`<p class="warning"><b>${this.t("Warning:")}</b> ${this.message(f)}</p>`)}
        <p class="sign">${this.t("Machine")} <span></span> ${this.t("Date")} <span></span> ${this.t("Name")} <span></span></p>
      </article>
    `;
  }

  /** Expected results with boxes for the reported ones: a table for each feature and one for the written values. */
  private expected(
    number: (x: number | null) => string,
    sigmas: (x: number | null) => string,
  ): TemplateResult[] {
    const { plan } = this.store;
    const computes = !this.store.computesNothing;
    const table = (caption: string, rows: ResultRow[], first: boolean) =>
      html`<table>
              <caption>${caption}</caption>
              ${
                first
                  ? html`<thead><tr><th>${this.t("Result")}</th><th class="n">${this.t("Nominal")}</th><th class="n">${this.t("Expected")}</th><th class="n">± 2σ</th><th>${computes ? this.t("Reported") : this.t("Worked out")}</th></tr></thead>`
                  : nothing
              }
              <tbody>${rows.map(
                (
                  r,
                ) => html`<tr><td>${resultInWords(this.store, r)} <code>${this.store.ofCycle(r.cycle, r.code)}</code></td><td class="n">${number(r.nominal)}${r.limits ? html`<br /><small>${this.t("{min} to {max}", number(r.limits[0]), number(r.limits[1]))}</small>` : nothing}</td><td class="n">${r.unit === "" ? r.value : number(r.value)}</td>
                  <td class="n">${r.uncertainty === null ? "–" : sigmas(r.uncertainty)}</td><td class="box"></td></tr>`,
              )}</tbody>
            </table>`;
    const says = computes
      ? this.t("Expected and reported values of the control")
      : this.t(
          "Results expected from the touches (this control computes none)",
        );
    if (plan.cycles.length < 2) return [table(says, plan.results, true)];
    const measured = plan.results.filter((row) => !isWritten(row));
    const names = [...plan.cycles, ...plan.relations];
    const tables = names.map((name, i) =>
      table(
        name,
        measured.filter(({ cycle }) => cycle === i),
        i === 0,
      ),
    );
    const written = plan.results.filter(isWritten);
    return [
      html`<p><b>${says}</b></p>`,
      ...tables,
      ...(written.length > 0
        ? [table(this.t("Values that the program writes"), written, false)]
        : []),
    ];
  }

  /** Code of a field, for authors of postprocessors. */
  private code(code: string | null = null): TemplateResult | typeof nothing {
    return this.store.cam ? html`<td><code>${code ?? ""}</code></td>` : nothing;
  }

  /** Hash in the program's header, which identifies it at the machine; empty without one. */
  private get hash(): string {
    return /Blocks below: (\w+)/i.exec(this.store.plan.program.text)?.[1] ?? "";
  }

  /** Reasons why this control cannot guarantee some of the rules, each once. */
  private reasons(): string[] {
    const unable = this.store.plan.safety.filter((rule) => rule.holds === null);
    return [...new Set(unable.map((rule) => this.store.say(rule.said)))];
  }

  /** Dimensions of the cycle, or of each cycle. */
  private dimensions() {
    const { features, draft, catalog, cycle } = this.store;
    const of = (entry: typeof cycle, form: Record<string, unknown>) => [
      ...entry.fields.map((f) => this.row(f, form[f.key], form)),
      ...entry.sections.flatMap(({ key, fields }) => {
        const inner = form[key] as Record<string, unknown> | null | undefined;
        return inner ? fields.map((f) => this.row(f, inner[f.key], inner)) : [];
      }),
    ];
    if (!features.several)
      return of(cycle, draft.cycle as Record<string, unknown>);
    return features.inOrder(draft).flatMap(({ name, cycle: form, off }) => {
      const entry = catalog.cycles.find((c) => c.type === form.type);
      return off || !entry
        ? []
        : [
            html`<tr><th colspan="3">${name}: ${entry.title}</th></tr>`,
            ...entry.fields
              .filter(({ group }) => /^(Position|Size)$/.test(group))
              .map((f) => this.row(f, form[f.key], form)),
          ];
    });
  }

  /** Value of a field. Fields of the postprocessor are not part of a set-up sheet. */
  private row(
    field: FieldEntry,
    held: unknown,
    form: Record<string, unknown>,
  ): TemplateResult | typeof nothing {
    const value =
      held === undefined
        ? this.store.defaultValue(field)
        : (held ?? field.null);
    const { when } = field;
    const idle =
      field.group.startsWith("Postprocessor") ||
      (when !== null && form[when.key] !== when.value);
    if (value === null || value === undefined || idle) return nothing;
    const words = (x: unknown) => {
      if (typeof x === "boolean") return x ? this.t("on") : this.t("off");
      const choice = field.choices.find((c) => c.value === x)?.label;
      return (
        choice ??
        (typeof x === "number" ? this.store.number(String(x)) : String(x))
      );
    };
    return html`<tr><td>${field.label}</td><td class="n">${(Array.isArray(value) ? value : [value]).map(words).join(" ")}${field.unit === "angle" ? "°" : ""}</td>${this.code(field.code)}</tr>`;
  }

  override disconnectedCallback(): void {
    super.disconnectedCallback();
    this.store.removeEventListener("recolour", this.restyle);
    this.free();
    this.drawn = { form: "" };
  }

  override connectedCallback(): void {
    super.connectedCallback();
    this.store.addEventListener("recolour", this.restyle);
    // After a move to another position of the page the drawings are lost.
    this.requestUpdate();
  }

  private free(): void {
    for (const drawing of this.drawings.values()) drawing.free();
    this.drawings.clear();
  }

  private show(view: PageView, from: (typeof SEEN)[number]): void {
    label(view, this.store);
    view.grips(false);
    view.show(this.store.shown);
    view.look(from);
    view.focus(from === "front" ? "*" : undefined);
  }

  private readonly restyle = () => {
    for (const drawing of this.drawings.values()) drawing.restyle();
  };

  protected override updated(): void {
    const canvas = this.querySelector("canvas");
    if (!canvas) return;
    const form = `${this.store.revision} ${this.store.lang}`;
    // With an error in the form the canvases and their drawings are removed.
    if (this.drawn.canvas !== canvas) {
      this.free();
      for (const from of SEEN) {
        const own = this.querySelector<HTMLCanvasElement>(
          `[data-view=${from}]`,
        );
        if (!own) continue;
        this.drawings.set(
          from,
          new Drawing(own, (view) => this.show(view, from)),
        );
      }
    } else if (this.drawn.form !== form)
      for (const [from, drawing] of this.drawings)
        drawing.use((view) => this.show(view, from));
    this.drawn = { canvas, form };
    this.restyle();
  }
}

customElements.define("tp-sheet", SheetPart);
