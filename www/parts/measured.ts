import { html, nothing, type TemplateResult } from "lit";
import { live } from "lit/directives/live.js";
import {
  type Job,
  type Measurement,
  type ResultRow,
  type ResultTolerance,
  svg,
  type Wear,
} from "../core/browser.js";
import {
  ACTIONS,
  evaluated,
  number,
  places,
  Reports,
  shown,
} from "../measured.js";
import { moveInWords } from "../sentences.js";
import { w } from "../words.js";
import { copied, copy, download } from "./download.js";
import { StorePart } from "./part.js";

/** Measured values, tolerances and the inspection report. */
class MeasuredPart extends StorePart {
  protected override storeEvents = ["change"];
  /** Module for reports and series, loaded when there are measurements. */
  private readonly reports = new Reports(() => this.requestUpdate());
  /** Whether the list of moves is open; it is not built before. */
  private open = false;
  /** Whether the measured points are shown: once there are any, then as the user chooses. */
  private points = true;
  /** Previous measured points. */
  private known = "";
  /** Message about the block that was copied; it holds for no other block. */
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
    const { found, errors, parts } = evaluated(this.store, this.reports);
    const reports = parts && this.reports.get();
    return html`
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
        ${parts && reports ? this.report(parts) : nothing}
      </details>
      ${this.closest("#panel-measured") && this.store.measured.trim() !== "" ? html`<tp-results .store=${this.store}></tp-results>` : nothing}
      ${this.tolerances()}
      <details class="triggers">
        <summary>${this.t("Trigger points of the ball centre")}</summary>
        <table>
          <thead><tr><th>${this.t("Touch no.")}</th><th class="n">X</th><th class="n">Y</th><th class="n">Z</th></tr></thead>
          <tbody>${plan.triggers.map((t, k) => html`<tr><td>${this.touch(k)}</td>${t ? t.map((x) => html`<td class="n">${shown(this.store, x, places(units))}</td>`) : html`<td colspan="3">${this.t("no contact")}</td>`}</tr>`)}</tbody>
        </table>
      </details>
      <details class="moves" @toggle=${this.toggle}>
        <summary>${this.t("All moves in words")}</summary>
        ${this.open ? html`<ol>${plan.moves.map((_, i) => html`<li>${moveInWords(this.store, i, false)}</li>`)}</ol>` : nothing}
      </details>
    `;
  }

  /** An example of an entry: a point, or for native cycles a variable with its value. */
  private example(): string {
    const kept = this.store.plan.results.find(({ stored }) => stored !== null);
    return kept ? `${kept.stored} = ${kept.nominal ?? 0}` : "37.012, 0, -10";
  }

  /** Inspector and place, as typed last. */
  private by = "";
  private machine = "";

  /** Button for the inspection report. */
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
    const { store } = this;
    const reports = this.reports.get();
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

  /** The block that sets the work offset, to type at the machine. */
  private block(block: string): TemplateResult {
    const told = this.told?.block === block ? this.told.text : "";
    return html`<div class="block"><b>${this.t("Type this before anything moves:")}</b>
      <pre class="code" lang="en" translate="no" tabindex="0">${block}</pre>
      <button type="button" @click=${() => this.copy(block)}>${this.t("Copy")}</button> <span role="status" class="status-text">${told}</span></div>`;
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

  /** Number of a touch; in a set-up with its cycle. */
  private touch(k: number): string {
    const { plan } = this.store;
    return this.store
      .ofCycle(plan.touches[k]?.cycle ?? 0, String(this.store.touchNumber(k)))
      .replace(".", " ");
  }

  /** Whether the tolerances are listed: once there are any, then as the user chooses. */
  private tolerated: boolean | null = null;

  /** Tolerance of each result, and the action of the program when it is exceeded. */
  private tolerances(): TemplateResult | typeof nothing {
    const { store } = this;
    const found = store.findings.filter(
      ({ path, level }) => path.startsWith("tolerances") && level !== "info",
    );
    // 1411 has its tolerances in its form.
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
    const inSize = store.sizeWithTolerance(cycle, code);
    const name = store.ofCycle(cycle, code);
    const digits = places(unit) + 1;
    const label = `${name}: ${store.say(said.meaning)}`;
    const text = (e: Event) => {
      const tolerance = (e.target as HTMLInputElement).value;
      // Removes an entry without text. The tool is kept while a new text is typed.
      const empty = tolerance.trim() === "";
      const none = empty && (inSize !== null || !own?.wear);
      const { tolerance: _, ...rest } = own ?? {};
      store.tolerate(cycle, {
        [code]: !none ? { ...own, tolerance } : inSize ? rest : undefined,
      });
    };
    const act = (e: Event) => {
      if (own || inSize)
        store.tolerate(cycle, {
          [code]: {
            ...own,
            action: (e.target as HTMLSelectElement)
              .value as ResultTolerance["action"],
          },
        });
      store.settle();
    };
    return html`<li><code title=${label}>${name}</code>
      <input id=${`f-tolerances.${name}`} type="text" maxlength="64" spellcheck="false" autocomplete="off" aria-label=${this.t("Tolerance of {result}", label)} .value=${live(own?.tolerance ?? inSize ?? "")} title=${inSize ? this.t("The size contains it") : nothing} ?disabled=${store.readonly || (inSize !== null && own?.tolerance === undefined)} @input=${text} @blur=${() => store.settle()} />
      ${own || inSize ? html`<select aria-label=${this.t("Action when {result} is out of tolerance", name)} ?disabled=${store.readonly} @change=${act}>${ACTIONS.map(([value, words]) => html`<option value=${value} ?selected=${(own?.action ?? "go") === value}>${this.t(words)}</option>`)}</select>` : nothing}
      ${(own || inSize) && limits && !store.stale ? html`<small>${shown(store, limits[0], digits)} … ${shown(store, limits[1], digits)}</small>` : nothing}
      ${own && (own.wear || this.corrects(code)) ? this.wear(cycle, code, name, own) : nothing}</li>`;
  }

  /** Whether the control corrects a tool from this result: by a size, moves also by a height. */
  private corrects(code: string): boolean {
    const { program } = this.store.plan;
    const post = this.store.catalog.posts.find(({ id }) => id === program.post);
    return program.own
      ? !!post?.correctsTools && /^(diameter|width)/.test(code)
      : !!post?.correctsByMoves && /^(diameter|width)|(^|\.)z$/.test(code);
  }

  /** Text in the boxes of a tool until they are left: `0.` may become a number. */
  private typed = new Map<string, string>();

  /** The tool that is corrected from this result. Text that is no number is kept and reported. */
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
      ["store", w("Stored in")],
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
      store.tolerate(cycle, {
        [code]: none ? bare : { ...bare, wear: wear as unknown as Wear },
      });
    };
    const left = (key: string) => () => {
      this.typed.delete(`${name} ${key}`);
      this.requestUpdate();
      store.settle();
    };
    // Without a tool number the other fields are hidden; some cycles correct by the whole error only.
    const { program } = store.plan;
    const post = store.catalog.posts.find(({ id }) => id === program.post);
    const whole = program.own && !post?.correctsByShare;
    const asked = fields.filter(
      ([key]) =>
        key === "tool" || (own.wear && (!whole || given[key] !== undefined)),
    );
    return html`<span class="wear">${asked.map(
      ([key, label]) =>
        html`<label>${this.t(label)} <input type="text" inputmode="decimal" maxlength="12" autocomplete="off" aria-label=${`${name}: ${this.t(label)}`} .value=${live(this.typed.get(`${name} ${key}`) ?? String(given[key] ?? ""))} ?disabled=${store.readonly} @input=${put(key)} @blur=${left(key)} /></label>`,
    )}</span>`;
  }
}

customElements.define("tp-measured", MeasuredPart);
