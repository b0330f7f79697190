import { html, nothing, type TemplateResult } from "lit";
import { live } from "lit/directives/live.js";
import {
  type Finding,
  type Job,
  JobError,
  type Measurement,
  measure,
  type ResultRow,
  type ResultTolerance,
  type Said,
  svg,
  type Wear,
} from "../core/browser.js";
import { isBad, isWritten } from "../core/results.js";
import { moveInWords, ofRunout, resultInWords } from "../sentences.js";
import { w } from "../words.js";
import { copied, copy, download } from "./download.js";
import { Part } from "./part.js";

/** A thousandth of a millimetre or of a degree, a ten thousandth of an inch: what a control shows. */
const places = (unit: string) => (unit === "inch" ? 4 : 3);
const number = (value: number | null, digits: number) =>
  value === null ? "–" : value.toFixed(digits).replace(/^-(0\.?0*)$/, "$1");

/** What was made of the measured text: what follows from it, or what is wrong with it; neither if no text was entered. */
interface Evaluated {
  /** That of the last part. */
  found?: Measurement;
  errors?: Finding[];
  /** Those of all parts of a series, or of the one. */
  parts?: Measurement[];
}

/** What the control will have measured on the virtual part, and the same from what a machine measured. */
class ResultsPart extends Part {
  protected override follows = ["change"];
  /** Whether the moves are listed: no list is made before. */
  private open = false;
  /** Whether the measured points are seen: from when there are any, and as the user leaves it. */
  private points = false;
  /** The measured points as they were. */
  private known = "";
  /** What is said of the block that was copied; of another one nothing. */
  private told: { block: string; text: string } | null = null;

  private readonly toggle = (event: Event) => {
    this.open = (event.target as HTMLDetailsElement).open;
    this.requestUpdate();
  };

  protected override willUpdate(): void {
    const { measured } = this.store;
    if (this.known === "" && measured !== "") this.points = true;
    this.known = measured;
  }

  override render(): TemplateResult {
    const { plan, stale, units } = this.store;
    const { found, errors, parts } = this.evaluated();
    const rows = found
      ? new Map(
          found.results.map((row) => [
            this.store.ofCycle(row.cycle, row.code),
            row,
          ]),
        )
      : null;
    const stored = this.store.bare
      ? w("What the touches will give")
      : w("What the control will have stored");
    const caption = rows
      ? this.t("{stored}, and what the measured points give", [stored])
      : this.t(stored);
    return html`
      <div class=${stale ? "stale" : ""}>${this.tables(caption, rows)}
      ${this.tolerances()}
      <details class="triggers">
        <summary>${this.t("Trigger points of the ball centre")}</summary>
        <table>
          <thead><tr><th>${this.t("Touch no.")}</th><th class="n">X</th><th class="n">Y</th><th class="n">Z</th></tr></thead>
          <tbody>${plan.triggers.map((t, k) => html`<tr><td>${this.touch(k)}</td>${t ? t.map((x) => html`<td class="n">${this.number(x, places(units))}</td>`) : html`<td colspan="3">${this.t("no contact")}</td>`}</tr>`)}</tbody>
        </table>
      </details>
      <details class="moves" @toggle=${this.toggle}>
        <summary>${this.t("All moves in words")}</summary>
        ${this.open ? html`<ol>${plan.moves.map((_, i) => html`<li>${moveInWords(this.store, i, false)}</li>`)}</ol>` : nothing}
      </details></div>
      <details class="measured" ?open=${live(this.points)} @toggle=${(
        e: Event,
      ) => {
        this.points = (e.target as HTMLDetailsElement).open;
      }}>
        <summary>${this.t("Points that a machine measured")}</summary>
        <label for="measured">${this.t("What the machine printed: ball centres in {units}, one per line, in touch order (X, Y, Z, or LinuxCNC's PROBEOPEN log); results such as center.x=1.2345; or the sender's log with grbl's [PRB:…] lines, the answer to $# and the work offset (G54) as the first line", units)}</label>
        <textarea id="measured" rows="5" spellcheck="false" placeholder=${this.example()} .value=${this.store.measured} @blur=${() => this.store.settle()}
          @input=${(e: Event) => {
            this.store.measured = (e.target as HTMLTextAreaElement).value;
          }}></textarea>
        <button type="button" ?disabled=${stale} @click=${this.fill}>${this.t("Fill in the points shown")}</button>
        <div role="status">${[...(errors ?? []), ...(found?.findings ?? [])].map((f) => html`<p class="problem ${f.level}">${this.message(f)}</p>`)}</div>
        ${found?.block ? this.block(found.block) : nothing}
        ${parts && this.reports ? this.report(parts) : nothing}
      </details>
    `;
  }

  /** What could stand there: a point, or of the control's own cycles a variable with its value. */
  private example(): string {
    const kept = this.store.plan.results.find(({ stored }) => stored !== null);
    return kept ? `${kept.stored} = ${kept.nominal ?? 0}` : "37.012, 0, -10";
  }

  /** What follows from the measured text. */
  private evaluated(): Evaluated {
    const { measured, plan, stale } = this.store;
    if (measured.trim() === "") return {};
    this.load();
    const runs =
      stale || !this.reports ? [measured] : this.reports.runsOf(measured, plan);
    try {
      const parts = runs.map((text) =>
        measure(this.store.job as unknown as Job, text),
      );
      return { found: parts.at(-1) as Measurement, parts };
    } catch (thrown) {
      if (!(thrown instanceof JobError)) throw thrown;
      return { errors: thrown.findings.filter((f) => f.level === "error") };
    }
  }

  /** What makes reports: fetched when something was measured. */
  private reports: typeof import("../core/report.js") | null = null;

  private load(): void {
    if (this.reports) return;
    import("../core/report.js").then(
      (reports) => {
        this.reports = reports;
        this.requestUpdate();
      },
      () => {},
    );
  }

  /** Who measured and where: as typed last. */
  private by = "";
  private machine = "";

  /** The way to an inspection report. */
  private report(parts: Measurement[]): TemplateResult {
    const box = (label: string, value: string, take: (text: string) => void) =>
      html`<label>${this.t(label)} <input type="text" maxlength="80" spellcheck="false" .value=${value} @change=${(e: Event) => take((e.target as HTMLInputElement).value)} /></label>`;
    return html`<div class="report"><b>${this.t("Inspection report")}</b>${parts.length > 1 ? html` <span>${this.t("{count} parts", parts.length)}</span>` : nothing}
      ${box(w("Name"), this.by, (text) => {
        this.by = text;
      })}
      ${box(w("Machine"), this.machine, (text) => {
        this.machine = text;
      })}
      <button type="button" @click=${() => this.save(parts, "html")}>${this.t("Save to print")}</button>
      <button type="button" @click=${() => this.save(parts, "csv")}>CSV</button>
      <button type="button" @click=${() => this.save(parts, "json")}>JSON</button></div>`;
  }

  private save(parts: Measurement[], format: "html" | "csv" | "json"): void {
    const { reports, store } = this;
    if (!reports || store.stale) return;
    const of = reports.report({
      plan: store.plan,
      parts,
      name: String(store.shown.name ?? ""),
      by: this.by,
      machine: this.machine,
      when: reports.clock(new Date()),
    });
    const t = (template: string, ...values: string[]) =>
      this.t(template, ...values);
    const [text, type] =
      format === "html"
        ? [
            reports.reportHtml(
              of,
              svg(store.shown as unknown as Job, "top"),
              t,
              store.lang,
            ),
            "text/html",
          ]
        : format === "csv"
          ? [reports.reportCsv(of), "text/csv"]
          : [`${JSON.stringify(of, null, 2)}\n`, "application/json"];
    download(
      text as string,
      store.otherName(`-report.${format}`),
      type as string,
    );
  }

  /** The block that states the work offset, to be typed. */
  private block(block: string): TemplateResult {
    const told = this.told?.block === block ? this.told.text : "";
    return html`<div class="block"><b>${this.t("Type this before anything moves:")}</b>
      <pre class="code" lang="en" translate="no" tabindex="0">${block}</pre>
      <button type="button" @click=${() => this.copy(block)}>${this.t("Copy")}</button> <span role="status" class="told">${told}</span></div>`;
  }

  private async copy(block: string): Promise<void> {
    this.told = { block, text: this.t(copied(await copy(block))) };
    this.requestUpdate();
  }

  /** The predicted triggers as text to start from. */
  private fill(): void {
    this.store.measured = this.store.plan.triggers
      .map((t) => (t ?? []).map((x) => number(x, 4)).join(", "))
      .join("\n");
    this.requestUpdate();
  }

  /** A number as the language writes it. */
  private number(value: number | null, digits: number): string {
    return this.store.number(number(value, digits));
  }

  private signed(value: number | null, digits: number): string {
    const text = this.number(value, digits);
    return value !== null && Number(number(value, digits)) > 0
      ? `+${text}`
      : text;
  }

  /** A value within its limits: the middle half of the bar is good, the whisker is ± 2σ. What lies far out stands at the edge. */
  private bar(r: ResultRow): TemplateResult | typeof nothing {
    const { limits, value, uncertainty, said } = r;
    if (!limits || value === null) return nothing;
    const [low, high] = limits;
    const digits = places(r.unit);
    const at = (x: number) =>
      Math.max(
        3,
        Math.min(97, 25 + (50 * (x - low)) / Math.max(high - low, 1e-9)),
      );
    const spread = 2 * (uncertainty ?? 0);
    const bounds = [
      this.number(low, digits),
      this.number(high, digits),
    ] as const;
    const verdict: Said = said.verdict ?? ["–"];
    const says = this.t(
      "{value}, limits {min} and {max}: {verdict}",
      this.number(value, digits),
      ...bounds,
      verdict,
    );
    const bad = isBad(r.verdict);
    return html`<tr class="bar"><td colspan="6"><svg class=${bad ? "band bad" : "band"} viewBox="0 0 100 12" role="img" aria-label=${says}>
      <title>${says}</title><rect x="25" y="3" width="50" height="6"></rect>
      <line x1=${at(value - spread)} x2=${at(value + spread)} y1="6" y2="6"></line><circle cx=${at(value)} cy="6" r="3"></circle></svg></td></tr>`;
  }

  /** As the form names it, where that has the same: the rotation of a result is against the nominal one. */
  private nameOf(r: ResultRow): string {
    const relation =
      this.store.plan.relations[r.cycle - this.store.plan.cycles.length];
    if (relation !== undefined && this.store.plan.cycles.length > 1)
      return `${relation}: ${resultInWords(this.store, r)}`;
    const own =
      this.store.plan.cycles.length < 2 ||
      r.cycle === this.store.features.inJob;
    const field =
      r.code === "rotation" || !own
        ? undefined
        : this.store.cycle.fields.find((f) => f.key === r.code);
    return field?.label ?? resultInWords(this.store, r);
  }

  /** The nominal value; with the middle of the tolerance, where deviations are from there. */
  private nominal({ nominal, limits, unit }: ResultRow): TemplateResult {
    const digits = places(unit);
    const middle = limits && (limits[0] + limits[1]) / 2;
    const off =
      middle !== null && nominal !== null && Math.abs(middle - nominal) > 1e-9;
    return html`${this.number(nominal, digits)}${off ? html`<small class="middle">${this.t("middle {value}", this.number(middle, digits + 1))}</small>` : nothing}`;
  }

  private row(
    r: ResultRow,
    measured: Map<string, ResultRow> | null,
  ): TemplateResult {
    const digits = places(r.unit);
    const own = measured?.get(this.store.ofCycle(r.cycle, r.code));
    const name = html`<td role="cell" class="name" title=${this.store.say(r.said.meaning)}>${this.nameOf(r)} <small><code>${r.code}</code>${r.stored ? html` <code title=${this.t("Where the control has it")}>${r.stored}</code>` : nothing} <span class="unit">${r.unit === "deg" ? "°" : r.unit}</span></small></td>`;
    const verdict = (row: ResultRow | undefined) =>
      row?.said.verdict
        ? html` <span class=${isBad(row.verdict) ? "bad" : ""}>${this.store.say(row.said.verdict)}</span>`
        : nothing;
    if (r.unit === "") {
      return measured
        ? html`<tr role="row">${name}<td role="cell"></td><td role="cell" data-label=${this.t("Value")} class="n"><b>${r.value}</b>${verdict(r)}</td><td role="cell"></td>
        <td role="cell" data-label=${this.t("Measured")} class="n own"><b>${own?.value ?? "–"}</b>${verdict(own)}</td></tr>`
        : html`<tr role="row">${name}<td role="cell"></td><td role="cell" data-label=${this.t("Value")} class="n"><b>${r.value}</b></td><td role="cell" colspan="3">${verdict(r)}</td></tr>`;
    }
    // Two sigma: 95 of 100 measurements lie within.
    const spread = r.uncertainty === null ? null : 2 * r.uncertainty;
    const of = (row: ResultRow | undefined) =>
      html`<b>${this.number(row?.value ?? null, digits)}</b> <small>${this.signed(row?.deviation ?? null, digits)}</small>${verdict(row)}`;
    if (measured)
      return html`<tr role="row">${name}
      <td role="cell" data-label=${this.t("Nominal")} class="n">${this.nominal(r)}</td>
      <td role="cell" data-label=${this.t("Value")} class="n both">${of(r)}</td>
      <td role="cell" data-label="± 2σ" class="n">${this.number(spread, digits + 1)}</td>
      <td role="cell" data-label=${this.t("Measured")} class="n both own">${of(own)}</td></tr>${this.bar(own ?? r)}`;
    return html`<tr role="row">${name}
      <td role="cell" data-label=${this.t("Nominal")} class="n">${this.nominal(r)}</td>
      <td role="cell" data-label=${this.t("Value")} class="n"><b>${this.number(r.value, digits)}</b></td>
      <td role="cell" data-label=${this.t("Deviation")} class="n">${this.signed(r.deviation, digits)}${verdict(r)}</td>
      <td role="cell" data-label="± 2σ" class="n">${this.number(spread, digits + 1)}</td>
      <td role="cell" data-label=${this.t("True")} class="n">${this.number(r.truth, digits)}</td></tr>${this.bar(r)}`;
  }

  /** The number of a touch, of a set-up with its cycle. */
  private touch(k: number): string {
    const { plan } = this.store;
    return this.store
      .ofCycle(plan.touches[k]?.cycle ?? 0, String(this.store.touchNumber(k)))
      .replace(".", " ");
  }

  /** Whether the tolerances are listed: from when there are any, and as the user leaves it. */
  private tolerated: boolean | null = null;

  /** The tolerance of each result, and what the program does with a value out of it. */
  private tolerances(): TemplateResult | typeof nothing {
    const { store } = this;
    const found = store.findings.filter(
      ({ path, level }) => path.startsWith("tolerances") && level !== "info",
    );
    // 1411 has tolerances of its own, in its form.
    const rows = store.plan.results.filter(
      ({ code, cycle, value, unit, limits }) =>
        (value !== null ||
          limits !== null ||
          store.tolerance(cycle, code) !== undefined) &&
        unit !== "" &&
        !/^(offset\.|Q\d|form|preset|table)/.test(code),
    );
    if (rows.length === 0 && found.length === 0) return nothing;
    const any = rows.some(
      ({ cycle, code }) => store.tolerance(cycle, code) !== undefined,
    );
    const open = this.tolerated ?? (any || found.length > 0);
    return html`<details class="tolerances" ?open=${live(open)} @toggle=${(
      e: Event,
    ) => {
      const now = (e.target as HTMLDetailsElement).open;
      if (now !== open) this.tolerated = now;
    }}>
      <summary>${this.t("Tolerances")}</summary>
      <p class="help">${this.t("As on the drawing: H7, ±0.02, +0.021/0, 25H7 or 24.98..25.02. Out of tolerance the program continues, marks the result, or stops.")}</p>
      <ul>${rows.map((row) => this.tolerance(row))}</ul>
      ${found.map((f) => html`<p class=${`problem ${f.level}`}>${this.message(f)}</p>`)}
    </details>`;
  }

  private tolerance({
    cycle,
    code,
    unit,
    limits,
    said,
  }: ResultRow): TemplateResult {
    const { store } = this;
    const own = store.tolerance(cycle, code);
    const name = store.ofCycle(cycle, code);
    const digits = places(unit) + 1;
    const label = `${name}: ${store.say(said.meaning)}`;
    const text = (e: Event) => {
      const tolerance = (e.target as HTMLInputElement).value;
      // With the text alone its tool would go, too.
      const none = tolerance.trim() === "" && !own?.wear;
      store.tolerate(cycle, code, none ? undefined : { ...own, tolerance });
    };
    const act = (e: Event) => {
      if (own)
        store.tolerate(cycle, code, {
          ...own,
          action: (e.target as HTMLSelectElement)
            .value as ResultTolerance["action"],
        });
      store.settle();
    };
    const choices = [
      ["go", w("continue")],
      ["mark", w("mark it")],
      ["stop", w("stop")],
    ] as const;
    return html`<li><code title=${label}>${name}</code>
      <input type="text" maxlength="64" spellcheck="false" autocomplete="off" aria-label=${this.t("Tolerance of {result}", label)} .value=${live(own?.tolerance ?? "")} ?disabled=${store.readonly} @input=${text} @blur=${() => store.settle()} />
      ${own ? html`<select aria-label=${this.t("What follows from {result} out of its tolerance", name)} ?disabled=${store.readonly} @change=${act}>${choices.map(([value, words]) => html`<option value=${value} ?selected=${(own.action ?? "go") === value}>${this.t(words)}</option>`)}</select>` : nothing}
      ${own && limits && !store.stale ? html`<small>${this.number(limits[0], digits)} … ${this.number(limits[1], digits)}</small>` : nothing}
      ${own && (own.wear || this.corrects(code)) ? this.wear(cycle, code, name, own) : nothing}</li>`;
  }

  /** Whether the control corrects a tool by this result. */
  private corrects(code: string): boolean {
    const { program } = this.store.plan;
    const post = this.store.catalog.posts.find(({ id }) => id === program.post);
    return (
      program.own && !!post?.correctsTools && /^(diameter|width)/.test(code)
    );
  }

  /** What is typed in the boxes of a tool, until they are left: `0.` is on its way to a number. */
  private typed = new Map<string, string>();

  /** The tool that the macro corrects by this result. What is typed and no number is kept, and reported. */
  private wear(
    cycle: number,
    code: string,
    name: string,
    own: ResultTolerance,
  ): TemplateResult {
    const { store } = this;
    const fields = [
      ["tool", w("Tool offset")],
      ["percent", w("Percent of the error")],
      ["deadBand", w("Dead band")],
      ["parts", w("Mean of parts")],
      ["store", w("Kept in offset")],
    ] as const;
    const given: Record<string, unknown> = { ...own.wear };
    const put = (key: string) => (e: Event) => {
      this.typed.set(`${name} ${key}`, (e.target as HTMLInputElement).value);
      const typed = (e.target as HTMLInputElement).value.trim();
      const number = Number(typed.replace(",", "."));
      const { [key]: _, ...rest } = given;
      const wear =
        typed === ""
          ? rest
          : { ...rest, [key]: Number.isNaN(number) ? typed : number };
      const { wear: __, ...bare } = own;
      const none = Object.keys(wear).length === 0;
      store.tolerate(
        cycle,
        code,
        none ? bare : { ...bare, wear: wear as unknown as Wear },
      );
    };
    const left = (key: string) => () => {
      this.typed.delete(`${name} ${key}`);
      this.requestUpdate();
      store.settle();
    };
    // Before a tool is named nothing else is asked.
    const asked = own.wear ? fields : fields.slice(0, 1);
    return html`<span class="wear">${asked.map(
      ([key, label]) =>
        html`<label>${this.t(label)} <input type="text" inputmode="decimal" maxlength="12" autocomplete="off" aria-label=${`${name}: ${this.t(label)}`} .value=${live(this.typed.get(`${name} ${key}`) ?? String(given[key] ?? ""))} ?disabled=${store.readonly} @input=${put(key)} @blur=${left(key)} /></label>`,
    )}</span>`;
  }

  /** A table of the results; of a set-up one of each cycle, and one of what is written. */
  private tables(
    caption: string,
    measured: Map<string, ResultRow> | null,
  ): TemplateResult[] {
    const { results, cycles, relations } = this.store.plan;
    if (cycles.length < 2) return [this.table(results, caption, measured)];
    const own = cycles.map((name, i) => ({
      name: i === 0 ? `${caption}: ${name}` : name,
      rows: results.filter((row) => row.cycle === i && !isWritten(row)),
    }));
    const between = {
      name: this.t("Relations"),
      rows: results.filter(
        (row) => row.cycle >= cycles.length && !isWritten(row),
      ),
    };
    const last = {
      name: this.t("What the program writes"),
      rows: results.filter(isWritten),
    };
    const shown = [
      ...own,
      ...(relations.length > 0 ? [between] : []),
      last,
    ].filter(({ rows }) => rows.length > 0);
    return shown.map(({ name, rows }) => this.table(rows, name, measured));
  }

  private table(
    rows: ResultRow[],
    caption: string,
    measured: Map<string, ResultRow> | null,
  ): TemplateResult {
    // One sentence for all results that are off for one reason, by more than the table shows.
    const notes = new Map<string, string[]>();
    for (const row of rows) {
      const [, , reason] = row.said.note ?? [];
      const off = number((row.value ?? 0) - (row.truth ?? 0), places(row.unit));
      if (reason === undefined || Number(off) === 0) continue;
      const words = this.store.say(
        typeof reason === "string" ? [reason] : reason,
      );
      notes.set(words, [
        ...(notes.get(words) ?? []),
        `${this.nameOf(row)} ${this.signed(Number(off), places(row.unit))}`,
      ]);
    }
    const middle = ({ limits, nominal }: ResultRow) =>
      limits && Math.abs((limits[0] + limits[1]) / 2 - (nominal ?? 0)) > 1e-9;
    const uneven = rows.some(middle);
    const eccentric = ofRunout(
      rows,
      (row) =>
        `${this.nameOf(row)} ${this.number(2 * (row.uncertaintyRunout ?? 0), places(row.unit) + 1)}`,
    );
    return html`
      <table role="table" class="cards-when-narrow">
        <caption>${caption}${this.store.stale ? html`<strong>${this.store.blank ? this.t("No plan can be made of this form") : this.t("The form has errors: this is the last good plan")}</strong>` : nothing}</caption>
        <thead><tr><th>${this.t("Result")}</th><th class="n">${this.t("Nominal")}</th><th class="n">${this.t("Value")}</th>${measured ? nothing : html`<th class="n">${this.t("Deviation")}</th>`}<th class="n">± 2σ</th><th class="n">${measured ? this.t("Measured") : this.t("True")}</th></tr></thead>
        <tbody>
          ${rows.map((r) => this.row(r, measured))}
        </tbody>
      </table>
      ${uneven ? html`<p class="help">${this.t("Deviations are from the middle of the tolerance zone.")}</p>` : nothing}
      ${eccentric ? html`<p class="help">${this.t("The ball's eccentricity accounts for this much of ± 2σ: {list}", eccentric)}</p>` : nothing}
      ${notes.size ? html`<ul class="notes">${[...notes].map(([words, offs]) => html`<li>${this.t("{off} from the truth: {reason}", offs.join(", "), words)}</li>`)}</ul>` : nothing}
    `;
  }
}

customElements.define("tp-results", ResultsPart);
