import { html, nothing, type TemplateResult } from "lit";
import type { Plan } from "../core/browser.js";
import { Part } from "./part.js";

type Row = Plan["safety"][number];

/** What a rule came to: a sign that is no colour alone, and a word for who hears it. */
function sign(row: Row): { mark: string; word: string } {
  if (row.holds === null) return { mark: "–", word: "this control cannot" };
  return row.holds ? { mark: "✓", word: "holds" } : { mark: "!", word: "does not hold" };
}

/** The safety rules for the program, each with what it came to; in one line what was proven of it. */
class ChecksPart extends Part {
  protected override follows = ["change"];

  override render(): TemplateResult | typeof nothing {
    const { plan, stale } = this.store;
    if (stale) return nothing;
    const count = (holds: boolean | null) => plan.safety.filter((row) => row.holds === holds).length;
    const [good, bad, unable] = [count(true), count(false), count(null)];
    const { proof } = plan.program;
    const parts = [
      proof
        ? `Read back: ${proof.moves} moves are the path${proof.arithmetic ? ", and its arithmetic is right" : ""}`
        : "",
      good ? `${good} safety rules hold` : "",
      bad ? `${bad} ${bad === 1 ? "does" : "do"} not` : "",
      unable ? `${unable} this control cannot hold` : "",
    ];
    return html`<details class="checks"><summary class=${bad ? "warning" : ""}>${parts.filter(Boolean).join("; ")}</summary>
      <ul>${plan.safety.map((row) => this.row(row))}</ul></details>`;
  }

  private row(row: Row): TemplateResult {
    const { mark, word } = sign(row);
    const why = this.store.catalog.rules.find((rule) => rule.name === row.rule)?.why;
    const at = row.lines.length ? html` <small>Line ${row.lines.map((line) => line + 1).join(", ")}</small>` : nothing;
    return html`<li class=${row.holds === false ? "warning" : ""} title=${why ?? nothing}><span class="mark" role="img" aria-label=${word}>${mark}</span>
      ${row.message}${row.holds === null ? html` <small>(${row.rule})</small>` : nothing}${at}</li>`;
  }
}

customElements.define("tp-checks", ChecksPart);
