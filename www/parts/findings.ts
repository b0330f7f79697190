import { html, nothing, type TemplateResult } from "lit";
import type { Finding, Message } from "../core/browser.js";
import { clockOf, runInWords } from "../sentences.js";
import type { Store } from "../store.js";
import { w } from "../words.js";
import { STYLUS_UNKNOWN } from "./bar.js";
import { StorePart } from "./part.js";
import { replaced, saveButton } from "./save.js";

export const LEVELS = ["error", "warning", "info"] as const;
export const NAMES = {
  error: w("error"),
  warning: w("warning"),
  info: w("note"),
} as const;
const ONE = {
  error: w("1 error"),
  warning: w("1 warning"),
  info: w("1 note"),
} as const;
const MANY = {
  error: w("{count} errors"),
  warning: w("{count} warnings"),
  info: w("{count} notes"),
} as const;

/** Notes that always apply to a control, most severe first. */
const ALWAYS: Record<string, string> = {
  "positioning-not-watched": w("Positioning is not watched."),
  "approach-not-watched": w("The approach is not watched."),
  "units-not-stated": w("The program states no units."),
  "not-verified": w("Not yet run on this control."),
  "no-results-in-program": w("The program computes nothing."),
};

/** The button that corrects a finding: it removes a key that no job has, or ends a trial of the virtual part. Undo restores both. */
export function remedy(
  store: Store,
  { code, path }: Finding,
): TemplateResult | null {
  if (code === "collision" && path === "part") return nominal(store);
  if (code === "order-of-cycles") {
    const index = /^cycles\[(\d+)\]/.exec(path)?.[1];
    const { features } = store;
    const place =
      index === undefined ? features.hand : features.placeOf(Number(index));
    return html`<button type="button" class="quiet" ?disabled=${store.readonly} @click=${() => store.moveFeature(place, 0)}>${store.t("Probe it first")}</button>`;
  }
  if (code !== "unknown-key" || store.get(path) === undefined) return null;
  return html`<button type="button" class="quiet" ?disabled=${store.readonly} @click=${() => store.drop(path)}>${store.t("Remove it")}</button>`;
}

/** Ends a trial of the virtual part. */
export function nominal(store: Store): TemplateResult {
  return html`<button type="button" class="quiet nominal" ?disabled=${store.readonly} @click=${() => store.putNominal()}>${store.t("Back to nominal")}</button>`;
}

/** State of the job: ready to save, or the most severe finding, and a summary of the run. One line in the footer, several lines above the results. */
class FindingsPart extends StorePart {
  protected override storeEvents = ["change"];
  /** Visible panels: the part links to no other. */
  declare panels: string[];
  /** Whether the page is Touchpath's own; a host page receives every job itself. */
  alone = true;
  /** Message about the last action on the current state of the job. */
  declare said: Message | null;
  /** Whether the page saves programs itself. */
  declare saves: boolean;
  /** Whether it is shown above the results, with several lines. */
  declare tall: boolean;

  static override properties = {
    said: { attribute: false },
    saves: { attribute: false },
    tall: { attribute: false },
    panels: {
      attribute: false,
      hasChanged: (now: string[], before?: string[]) =>
        now.join() !== before?.join(),
    },
  };

  override render(): TemplateResult {
    // Findings about the control are shown at its name.
    const { stale } = this.store;
    // The bar marks an unknown probe with a dot.
    const findings = this.store.jobFindings.filter(
      ({ code }) => code !== STYLUS_UNKNOWN,
    );
    const of = (level: Finding["level"]) =>
      findings.filter((f) => f.level === level);
    const words = LEVELS.flatMap((level) => {
      const n = of(level).length;
      return n === 0
        ? []
        : [n === 1 ? this.t(ONE[level]) : this.t(MANY[level], n)];
    });
    const worst = LEVELS.flatMap(of)[0];
    const { said } = this;
    const other =
      this.panels.includes("program") || this.saves ? replaced(this.store) : "";
    return html`
      ${
        worst && this.tall && worst.level === "info"
          ? html`<p class="verdict no-problems" role="status">✓ ${this.t("Ready to save")}</p><p class="verdict info"><b>${words.join(", ")}:</b> ${this.message(worst)}
            ${worst.path && this.panels.includes("form") ? html`<button type="button" class="quiet" @click=${() => this.go(this.store.fieldOf(worst))}>${this.t("Go to it")}</button>` : nothing}
            ${findings.length > 1 && this.panels.includes("checks") ? html`<button type="button" class="quiet" @click=${() => this.ask("checks")}>${this.t("All")}</button>` : nothing}</p>`
          : worst
            ? html`<p class=${`verdict ${worst.level}`} role="status"><b>${words.join(", ")}:</b> ${this.message(worst)}</p>
            ${worst.path && this.panels.includes("form") ? (remedy(this.store, worst) ?? html`<button type="button" class="quiet" @click=${() => this.go(this.store.fieldOf(worst))}>${this.t("Go to it")}</button>`) : nothing}
            ${findings.length > 1 && this.panels.includes("checks") ? html`<button type="button" class="quiet" @click=${() => this.ask("checks")}>${this.t("All")}</button>` : nothing}`
            : html`<p class="verdict no-problems" role="status">✓ ${this.t("Ready to save")}</p>`
      }
      ${this.tall && !stale ? html`<p class="sum">${this.sum()}</p>` : nothing}
      ${said ? html`<p class="note" role="status" title=${this.store.say(said)}>${this.store.say(said)}</p>` : other ? html`<p class="note" title=${other}>${other}</p>` : html`<span class="gap"></span>`}
      ${stale || this.tall || this.panels.includes("stage") ? nothing : html`<span class="run">${runInWords(this.store)}</span>`}
      ${this.alone ? html`<span class="run private">${this.t("Nothing leaves this browser")}</span>` : nothing}
      ${this.saves ? saveButton(this.store, this.store.withheld, () => this.ask("save")) : nothing}
    `;
  }

  /** Touches, time, number of rules met, and the note on the control. */
  private sum(): TemplateResult {
    const { store } = this;
    const { touches, time, safety } = store.plan;
    const held = safety.filter(({ holds }) => holds === true).length;
    const run = this.t(
      touches.length === 1
        ? w("1 touch, {time}.")
        : w("{count} touches, {time}."),
      ...(touches.length === 1 ? [] : [touches.length]),
      clockOf(time * 60),
    );
    const rules =
      held === safety.length
        ? w("All {count} rules hold.")
        : w("{count} rules hold.");
    return html`${run} ${held > 0 ? this.t(rules, held) : nothing} ${this.always()}`;
  }

  /** Note that always applies to this control, as a link to its manual page. */
  private always(): TemplateResult | typeof nothing {
    const { store } = this;
    const { title = "", id = "" } = store.post ?? {};
    const standing = store.ofControl;
    const [code, says] =
      Object.entries(ALWAYS).find(([code]) =>
        standing.some((f) => f.code === code),
      ) ?? [];
    if (!says) return nothing;
    const grave = standing.some(
      (f) => f.code === code && f.level === "warning",
    );
    return html`<button type="button" class=${`control-notes quiet ${grave ? "warning" : ""}`} title=${this.t("About {control}", title)} @click=${() => this.dispatchEvent(new CustomEvent("open-manual", { bubbles: true, detail: `control:${id}` }))}>${this.t(says)}</button>`;
  }

  private go(path: string): void {
    this.dispatchEvent(
      new CustomEvent("go-to-field", { detail: path, bubbles: true }),
    );
  }

  private ask(what: string): void {
    this.dispatchEvent(
      new CustomEvent("run-action", { detail: what, bubbles: true }),
    );
  }
}

/** Number of errors, or else warnings, beside the name of the Checks. */
class BadgePart extends StorePart {
  protected override storeEvents = ["change"];

  override render(): TemplateResult | typeof nothing {
    const count = (level: Finding["level"]) =>
      this.store.jobFindings.filter((f) => f.level === level).length;
    const level = (["error", "warning"] as const).find(
      (level) => count(level) > 0,
    );
    return level
      ? html`<span class=${`badge ${level}`}>${count(level)}</span>`
      : nothing;
  }
}

customElements.define("tp-findings", FindingsPart);
customElements.define("tp-badge", BadgePart);
