import { html, nothing, type TemplateResult } from "lit";
import type { FieldEntry } from "../core/browser.js";
import { isMetric } from "../entries.js";
import { remedy } from "./findings.js";
import { StorePart } from "./part.js";

/** Help box of the form, with a fixed height: the focused field and its findings. */
class HelpPart extends StorePart {
  protected override storeEvents = ["change", "focus"];

  override render(): TemplateResult {
    const { focused } = this.store;
    const entry = focused === null ? undefined : this.store.fieldAt(focused);
    this.classList.toggle("idle", focused === null || !entry);
    if (focused === null || !entry) {
      const { title, says, type } = this.store.cycle;
      return html`<p><b>${title}</b></p><p class="help">${says} <button type="button" class="quiet" @click=${() => this.about(`cycle:${type}`)}>${this.t("About this cycle")}</button></p>`;
    }
    const found = this.store.at(focused);
    const { label, help, code, usual, range } = entry;
    const stand = this.store.initialValue(entry);
    const standing = Array.isArray(stand)
      ? stand[Number(/\[(\d)\]/.exec(focused)?.[1] ?? 0)]
      : stand;
    const value = this.store.get(focused);
    const choice = entry.choices.find((c) => c.value === standing)?.label;
    const flag = standing === true ? this.t("on") : this.t("off");
    const shown =
      choice ??
      (typeof standing === "boolean"
        ? flag
        : this.store.number(String(standing)));
    const other =
      standing !== null &&
      standing !== undefined &&
      value !== standing &&
      !this.store.isUsual(focused, entry) &&
      entry.kind !== "text";
    const span = (ends: unknown, digits: number) =>
      Array.isArray(ends)
        ? this.t(
            "{min} to {max}",
            this.scaled(entry.unit, ends[0], digits),
            this.scaled(entry.unit, ends[1], digits),
          )
        : "";
    // The usual range needs fewer digits than the allowed one.
    const usually = usual
      ? ` ${this.t("Usual {range}.", span(usual, 2))}`
      : range
        ? ` ${this.t("{range}.", span(range, 12))}`
        : "";
    return html`
      <p><b>${label}</b>${code ? html` <code>${code}</code>` : nothing}</p>
      ${
        found.length > 0
          ? found.map(
              (f) =>
                html`<p class=${`problem ${f.level}`}>${this.message(f)} ${remedy(this.store, f) ?? nothing}</p>`,
            )
          : html`<p class="help">${help}${usually}${
              other
                ? html` ${this.t("Default {value}", shown)} <button type="button" class="quiet" aria-label=${this.t("{label}: back to its default, {value}", label, shown)}
                    @click=${() => this.store.put(focused, standing)}>↺</button>`
                : nothing
            }</p>`
      }
    `;
  }

  private about(topic: string): void {
    this.dispatchEvent(
      new CustomEvent("open-manual", { bubbles: true, detail: topic }),
    );
  }

  /** A bound of a range in the job's units; a converted one has at most this many digits. */
  private scaled(unit: FieldEntry["unit"], x: unknown, digits: number): string {
    if (typeof x !== "number") return "∞";
    const inch = isMetric(unit) && this.store.units === "inch";
    return this.store.number(
      String(
        inch ? Number(Number((x / 25.4).toPrecision(digits)).toFixed(4)) : x,
      ),
    );
  }
}

customElements.define("tp-help", HelpPart);
