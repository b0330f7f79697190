import { html, nothing, type TemplateResult } from "lit";
import type { Message, ResultRow } from "../core/browser.js";
import { isBad, isWritten } from "../core/results.js";
import { evaluated, number, places, Reports, shown } from "../measured.js";
import { ofRunout, resultInWords } from "../sentences.js";
import { w } from "../words.js";
import { StorePart } from "./part.js";

/** Middle of an uneven tolerance of 1411, from which its deviations count; null for any other result. */
function middleOf({ code, limits, nominal }: ResultRow): number | null {
  if (!limits || nominal === null || !/^Q\d/.test(code)) return null;
  const middle = (limits[0] + limits[1]) / 2;
  return Math.abs(middle - nominal) > 1e-9 ? middle : null;
}

/** Results that the control will store for the virtual part, and results from a machine's measurements. */
class ResultsPart extends StorePart {
  protected override storeEvents = ["change"];
  /** Module for reports and series, loaded when there are measurements. */
  private readonly reports = new Reports(() => this.requestUpdate());

  override render(): TemplateResult {
    const { stale } = this.store;
    const { found } = evaluated(this.store, this.reports);
    const rows = found
      ? new Map(
          found.results.map((row) => [
            this.store.ofCycle(row.cycle, row.code),
            row,
          ]),
        )
      : null;
    const stored = this.store.computesNothing
      ? w("Results expected from the touches")
      : w("Results the control will store");
    const caption = rows
      ? this.t("{stored}, and the results of the measured points", [stored])
      : this.t(stored);
    return html`<div class=${stale ? "stale" : ""}>${this.tables(caption, rows)}</div>`;
  }

  /** A number in the notation of the language. */
  private number(value: number | null, digits: number): string {
    return shown(this.store, value, digits);
  }

  private signed(value: number | null, digits: number): string {
    const text = this.number(value, digits);
    return value !== null && Number(number(value, digits)) > 0
      ? `+${text}`
      : text;
  }

  /** Bar of a value within its limits: the middle half is good, the whisker is ± 2σ. A value far outside is drawn at the edge. */
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
    const verdict: Message = said.verdict ?? ["–"];
    const says = this.t(
      "{value}, limits {min} and {max}: {verdict}",
      this.number(value, digits),
      ...bounds,
      verdict,
    );
    const x = (of: number) => `${at(of)}%`;
    return html`<tr class="bar"><td colspan="6"><svg class=${isBad(r.verdict) ? "band bad" : "band"} width="100%" height="8" role="img" aria-label=${says}>
      <title>${says}</title><rect width="100%" height="8" rx="4"></rect><rect class="in" x="25%" width="50%" height="8"></rect>
      <line x1=${x(value - spread)} x2=${x(value + spread)} y1="4" y2="4"></line><circle cx=${x(value)} cy="4" r="4"></circle></svg><span aria-hidden="true">${bounds.map((bound) => html`<small>${bound}</small>`)}</span></td></tr>`;
  }

  /** The form's name of a size, if it means the same: a rotation result is relative to the nominal one. */
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

  /** The nominal value, with the middle of the tolerance if deviations count from there. */
  private nominal(row: ResultRow): TemplateResult {
    const digits = places(row.unit);
    const middle = middleOf(row);
    return html`${this.number(row.nominal, digits)}${middle !== null ? html`<small class="middle">${this.t("middle {value}", this.number(middle, digits + 1))}</small>` : nothing}`;
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
    // A value that no touch of the cycle determines was not measured.
    const told = r.code === "deviation" && this.store.plan.cycles.length > 1;
    const kind = (!r.uncertainty || told) && !r.limits ? "still" : nothing;
    if (measured)
      return html`<tr role="row" class=${kind}>${name}
      <td role="cell" data-label=${this.t("Nominal")} class="n nominal">${this.nominal(r)}</td>
      <td role="cell" data-label=${this.t("Value")} class="n both">${of(r)}</td>
      <td role="cell" data-label="± 2σ" class="n sure">${this.number(spread, digits + 1)}</td>
      <td role="cell" data-label=${this.t("Measured")} class="n both own">${of(own)}</td></tr>${this.bar(own ?? r)}`;
    return html`<tr role="row" class=${kind}>${name}
      <td role="cell" data-label=${this.t("Nominal")} class="n nominal">${this.nominal(r)}</td>
      <td role="cell" data-label=${this.t("Value")} class="n"><b>${this.number(r.value, digits)}</b></td>
      <td role="cell" data-label=${this.t("Deviation")} class=${Number(number(r.deviation, digits)) === 0 ? "n nothing" : "n"}><span class="off">${this.signed(r.deviation, digits)}</span>${verdict(r)}</td>
      <td role="cell" data-label="± 2σ" class="n sure">${this.number(spread, digits + 1)}</td>
      <td role="cell" data-label=${this.t("True")} class="n true">${this.number(r.truth, digits)}</td></tr>${this.bar(r)}`;
  }

  /** A table of the results; in a set-up one per cycle and one for the written values. */
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
      name: this.t("Values that the program writes"),
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
    // One note for all results with the same cause of error, if the error exceeds the digits shown.
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
    const uneven = rows.some((row) => middleOf(row) !== null);
    const eccentric = ofRunout(
      rows,
      (row) =>
        `${this.nameOf(row)} ${this.number(2 * (row.uncertaintyRunout ?? 0), places(row.unit) + 1)}`,
    );
    return html`
      <table role="table" class=${rows.every(isWritten) ? "cards-when-narrow written" : "cards-when-narrow"}>
        <caption>${caption}${this.store.stale ? html`<strong>${this.store.blank ? this.t("No plan can be made of this form") : this.t("The form has errors: showing the last valid plan")}</strong>` : nothing}</caption>
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
