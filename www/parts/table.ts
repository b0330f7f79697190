import { html, nothing, type TemplateResult } from "lit";
import {
  type CodeGroup,
  exportTable,
  type Job,
  type Message,
  meanings,
  type ParameterRow,
  type Plan,
  type TouchPoint,
} from "../core/browser.js";
import { alike } from "../job.js";
import { w } from "../words.js";
import { copied, copy, download, withheld } from "./download.js";
import { StorePart } from "./part.js";

/** Group of rows without a table code: those of a native cycle. */
const OTHERS = w("Cycle");

/** Group of a row, by its code. */
function groupOf(row: ParameterRow, groups: CodeGroup[]): string {
  const code = Number(/\[(-?\d+)\]/.exec(row.code)?.[1] ?? Number.NaN);
  return (
    groups.find(({ lowest, highest }) => code >= lowest && code <= highest)
      ?.title ?? OTHERS
  );
}

/** Parameter table of the source, by groups. Rows of the current touch are highlighted. */
class TablePart extends StorePart {
  protected override storeEvents = ["change"];
  protected override lights = true;
  private told = "";
  /** The plan that was saved or copied; its message holds for no other. */
  private toldOf?: Plan;
  /** Meanings of the rows in languages other than English. */
  private said = new Map<ParameterRow, Message>();
  private filter = "";
  private readonly closed = new Set<string>();

  override render(): TemplateResult {
    const { plan, stale, lang, shown } = this.store;
    // An English row contains its meaning.
    const said = lang === "en" ? [] : meanings(shown as unknown as Job);
    this.said = new Map(
      plan.table.flatMap((row, i) => (said[i] ? [[row, said[i]]] : [])),
    );
    const why = stale ? "withheld-table" : nothing;
    const told = stale || this.toldOf !== plan ? "" : this.told;
    const wanted = this.filter.trim().toLowerCase();
    const { inJob, several } = this.store.features;
    const rows = plan.table.filter(
      (row) =>
        (!several || row.cycle === inJob) &&
        `${row.code} ${this.meaning(row)}`.toLowerCase().includes(wanted),
    );
    const { codeGroups } = this.store.catalog;
    const names = [
      ...new Set([...codeGroups.map(({ title }) => title), OTHERS]),
    ];
    const groups = names.map((name) => ({
      name,
      rows: rows.filter((row) => groupOf(row, codeGroups) === name),
    }));
    return html`
      <div class="tools">
        <button type="button" ?disabled=${stale} aria-describedby=${why} @click=${this.copy}>${this.t("Copy as text")}</button>
        <button type="button" ?disabled=${stale} aria-describedby=${why} @click=${this.save}>${this.t("Save .csv")}</button>
        <input class="filter" type="search" placeholder=${this.t("Filter: code or word")} aria-label=${this.t("Filter the parameters")} .value=${this.filter}
          @input=${(e: Event) => {
            this.filter = (e.target as HTMLInputElement).value;
            this.requestUpdate();
          }} />
        <span role="status" class="status-text">${told || (wanted ? this.t("{count} of {all}", rows.length, plan.table.length) : "")}</span>
      </div>
      ${withheld(this.store, "withheld-table")}
      <div class=${stale ? "scroll stale" : "scroll"} tabindex="0" role="region" aria-label=${this.t("Parameter table")}>
        <table>
          <thead><tr><th>${this.t("Code")} · ${this.t("Type")}</th><th class="n">${this.t("Value")}</th><th>${this.t("Meaning")}</th></tr></thead>
          ${groups
            .filter((group) => group.rows.length > 0)
            .map(({ name, rows }) => {
              const open = wanted !== "" || !this.closed.has(name);
              return html`<tbody @mouseleave=${() => this.store.point(null)}>
                <tr class="group"><th colspan="3" scope="rowgroup"><button type="button" aria-expanded=${open ? "true" : "false"} @click=${() => this.fold(name)}
                  >${open ? "▾" : "▸"} ${this.t(name)} <small>${rows.length}</small></button></th></tr>
                ${open ? rows.map((row) => this.row(row)) : nothing}
              </tbody>`;
            })}
        </table>
      </div>
    `;
  }

  /** Rows of the current touch. */
  protected override light(): void {
    const { highlight, plan } = this.store;
    const touched =
      highlight === null ? null : (plan.moves[highlight]?.touch ?? null);
    // A row belongs to the first touch of its point.
    const one = touched === null ? undefined : plan.touches[touched];
    const same = (other: TouchPoint) =>
      other.cycle === one?.cycle &&
      alike(other.point, one.point) &&
      alike(other.vector, one.vector);
    const touch = one ? plan.touches.findIndex(same) : null;
    let first = null as HTMLElement | null;
    for (const row of this.querySelectorAll<HTMLElement>("tr[data-touch]")) {
      const is = touch !== null && row.dataset.touch === String(touch);
      row.classList.toggle("lit", is);
      if (is) first ??= row;
    }
    const box = this.querySelector<HTMLElement>(".scroll");
    if (first && box && touch !== this.seen && !this.matches(":hover")) {
      // Scrolls only the table, not the elements around it.
      const [row, seen] = [
        first.getBoundingClientRect(),
        box.getBoundingClientRect(),
      ];
      if (row.top < seen.top || row.bottom > seen.bottom)
        box.scrollTop += row.top - (seen.top + seen.bottom) / 2;
    }
    this.seen = touch;
  }

  /** The touch whose rows were scrolled to last. */
  private seen: number | null = null;

  /** Meaning of a parameter; in other languages the words of its field. */
  private meaning(row: ParameterRow): string {
    const said = this.said.get(row);
    if (!said) return row.meaning;
    const field =
      row.field === null ? undefined : this.store.fieldAt(row.field);
    return field?.code === row.code
      ? `${field.label}: ${field.help}`
      : this.store.say(said);
  }

  private row(row: ParameterRow): TemplateResult {
    const touch = row.touch;
    const move =
      touch === null
        ? null
        : this.store.plan.moves.findIndex(
            (m) => m.kind === "touch" && m.touch === touch,
          );
    return html`<tr data-touch=${touch ?? nothing} @mouseenter=${() => this.store.point(move)}>
      <td><code>${row.code}</code> <small>${row.type}</small></td><td class="n">${String(row.value)}</td>
      <td>${row.field ? html`<a href="#" @click=${(e: Event) => this.go(e, row.field as string)}>${this.meaning(row)}</a>` : this.meaning(row)}</td>
    </tr>`;
  }

  private fold(name: string): void {
    if (!this.closed.delete(name)) this.closed.add(name);
    this.requestUpdate();
  }

  private async copy(): Promise<void> {
    if (this.store.stale) return;
    const { plan } = this.store;
    this.told = this.t(
      copied(
        await copy(exportTable(this.store.shown as unknown as Job, "text")),
      ),
    );
    this.toldOf = plan;
    this.requestUpdate();
  }

  private save(): void {
    if (this.store.stale) return;
    const name = this.store.otherName("-parameters.csv");
    download(
      exportTable(this.store.shown as unknown as Job, "csv"),
      name,
      "text/csv",
    );
    this.told = this.t("Saved {file}", name);
    this.toldOf = this.store.plan;
    this.requestUpdate();
  }

  private go(event: Event, path: string): void {
    event.preventDefault();
    this.dispatchEvent(
      new CustomEvent("go-to-field", { detail: path, bubbles: true }),
    );
  }
}

customElements.define("tp-table", TablePart);
