import { html, nothing, type TemplateResult } from "lit";
import {
  type Finding,
  type Job,
  type Plan,
  type Programmed,
  programs,
} from "../core/browser.js";
import type { Store } from "../store.js";
import { w } from "../words.js";
import { LEVELS, NAMES, remedy } from "./findings.js";
import { StorePart } from "./part.js";

type Row = Plan["safety"][number];

/** Result of a rule: a sign that does not depend on colour, and a word for screen readers. */
function sign(row: Row, own: boolean): { mark: string; word: string } {
  if (row.holds === null)
    return {
      mark: "–",
      word: own ? w("the native cycle does it") : w("this control cannot"),
    };
  return row.holds
    ? { mark: "✓", word: w("holds") }
    : { mark: "!", word: w("does not hold") };
}

/** Summary of the safety rules and the proof, in one line. */
export function checked(store: Store): string {
  const { plan } = store;
  const count = (holds: boolean | null) =>
    plan.safety.filter((row) => row.holds === holds).length;
  const [good, bad, unable] = [count(true), count(false), count(null)];
  const { proof } = plan.program;
  return [
    proof?.arithmetic
      ? store.t(
          "Read back: {moves} moves match the path, and the arithmetic is right",
          proof.moves,
        )
      : proof
        ? store.t("Read back: {moves} moves match the path", proof.moves)
        : "",
    good ? store.t("{count} safety rules hold", good) : "",
    bad === 1
      ? store.t("1 does not")
      : bad
        ? store.t("{count} do not", bad)
        : "",
    unable ? unheld(store, unable) : "",
  ]
    .filter(Boolean)
    .join("; ");
}

/** Number of rules left to the native cycle or not guaranteed by the control. */
function unheld(store: Store, count: number): string {
  return store.ownCycle
    ? store.t("{count} left to the native cycles", count)
    : store.t("{count} this control cannot guarantee", count);
}

/** All findings with links to their fields, and the result of each safety rule. */
class ChecksPart extends StorePart {
  static override properties = { linked: { attribute: false } };
  protected override storeEvents = ["change"];
  /** Whether the program is on the page, so that its lines can be shown. */
  declare linked: boolean;
  /** Whether the list of controls is open; nothing is planned for it before. */
  private open = false;

  override render(): TemplateResult {
    const { plan, stale, jobFindings: findings, post } = this.store;
    const always = this.store.ofControl;
    const sorted = LEVELS.flatMap((level) =>
      findings.filter((f) => f.level === level),
    );
    const bad = plan.safety.some((row) => row.holds === false);
    // A reason that all rules share is shown once.
    const [first, ...others] = plan.safety;
    const same =
      first?.holds === null &&
      others.every(
        (row) => row.holds === null && row.message === first.message,
      );
    const shared = same ? first.said : null;
    return html`
      <h2>${this.t("Findings")}</h2>
      ${sorted.length === 0 ? html`<p class="no-problems">✓ ${this.t("No problems found")}</p>` : html`<ul class="found">${sorted.map((f) => this.finding(f))}</ul>`}
      ${
        stale
          ? nothing
          : html`<h2>${this.t("Safety rules of this program")}</h2><p class=${bad ? "proof warning" : "proof"}>${checked(this.store)}</p>
            ${shared ? html`<p class="proof">${this.store.say(shared)}</p>` : nothing}
            <ul class="checks">${plan.safety.map((row) => this.row(row, shared === null))}</ul>`
      }
      ${always.length ? html`<h2>${this.t("Always, on {control}", post?.title ?? "")} <button type="button" class="quiet" @click=${() => this.about()}>${this.t("About it")}</button></h2><ul class="found">${always.map((f) => this.finding(f))}</ul>` : nothing}
      <details class="controls" @toggle=${this.toggle}>
        <summary>${this.t("This job on every control")}</summary>
        ${this.open ? this.controls() : nothing}
      </details>
    `;
  }

  private readonly toggle = (event: Event) => {
    this.open = (event.target as HTMLDetailsElement).open;
    this.requestUpdate();
  };

  /** The result of each control for the present form: the number of program lines, or the reason for no program. */
  private controls(): TemplateResult {
    const { store } = this;
    const now = store.draft.control as { post: string; form: string };
    const rows = store.catalog.posts.flatMap((post) => {
      const forms = post.cycles
        .filter((c) => c.type === store.cycle.type && c.supported)
        .map((c) => c.form);
      return (forms.length ? forms : ["moves"]).map((form) => ({
        post,
        form: form as "moves" | "cycle",
      }));
    });
    const made = (post: string, form: string) => {
      const job = {
        ...store.job,
        control: store.controlOf(post, form as "moves" | "cycle"),
      } as unknown as Job;
      const { program, findings } = programs([job]).next().value as Programmed;
      const first = LEVELS.map((level) =>
        findings.find((f) => f.level === level),
      ).find(Boolean);
      return {
        lines: program ? program.text.split("\n").length - 1 : null,
        says: !first || first.level === "info" ? "" : this.message(first),
      };
    };
    return html`<table>
      <thead><tr><th>${this.t("Control")}</th><th>${this.t("Form")}</th><th class="n">${this.t("Lines")}</th><th></th></tr></thead>
      <tbody>${rows.map(({ post, form }) => {
        const { lines, says } = made(post.id, form);
        const way = form === "moves" ? this.t("moves") : this.t("native cycle");
        const chosen = post.id === now.post && form === now.form;
        return html`<tr class=${lines === null ? "none" : ""}><td>${post.title}</td><td>${way}</td>
          <td class="n">${lines ?? html`<span role="img" aria-label=${this.t("no program")}>–</span>`}</td>
          <td>${chosen ? html`<b>${this.t("chosen")}</b>` : lines === null ? nothing : html`<button type="button" class="quiet" aria-label=${this.t("Choose {control}", `${post.title}, ${way}`)} ?disabled=${store.readonly} @click=${() => store.chooseControl(post.id, form)}>${this.t("choose")}</button>`}</td></tr>
          ${says ? html`<tr class=${lines === null ? "why none" : "why"}><td colspan="4"><small>${says}</small></td></tr>` : nothing}`;
      })}</tbody>
    </table>`;
  }

  private finding(f: Finding): TemplateResult {
    return html`<li class=${f.level}><span class="level">${this.t(NAMES[f.level])}</span> ${this.message(f)}
      ${remedy(this.store, f) ?? nothing}
      ${f.path ? html`<a href="#" @click=${(e: Event) => this.go(e, f.path)}>${this.named(f.path)}</a>` : nothing}</li>`;
  }

  /** Name of a path: the label of a field, the heading of a section, the title of the cycle. */
  private named(path: string): string {
    if (path === "cycle") return this.store.cycle.title;
    const group = this.store.catalog.sections.find(
      (section) => section.path === path,
    )?.fields[0]?.group;
    return this.store.fieldAt(path)?.label ?? (group ? this.t(group) : path);
  }

  /** A rule. `reason`: with the reason why this control cannot guarantee it. */
  private row(row: Row, reason: boolean): TemplateResult {
    const { mark, word } = sign(row, this.store.ownCycle);
    const rule = this.store.catalog.rules.find(
      (rule) => rule.name === row.rule,
    );
    const unable = row.holds === null;
    return html`<li class=${row.holds === false ? "warning" : ""} title=${rule ? `${rule.why} (${rule.name})` : nothing}><span class="mark" role="img" aria-label=${this.t(word)}>${mark}</span>
      ${unable ? rule?.says : this.store.say(row.said)}${unable && reason ? html`: <small>${this.store.say(row.said)}</small>` : nothing}${this.lines(row)}</li>`;
  }

  /** Lines that break a rule, else those that it checks. A click shows them in the program. */
  private lines({ lines, about }: Row): TemplateResult | typeof nothing {
    const shown = lines.length ? lines : about;
    if (shown.length === 0) return nothing;
    const few = lines.length > 0 || about.length < 4;
    const says = few
      ? this.t("Line {lines}", shown.map((line) => line + 1).join(", "))
      : this.t("{count} lines", about.length);
    if (!this.linked) return html` <small>${says}</small>`;
    const show = () =>
      this.dispatchEvent(
        new CustomEvent("lines", { detail: shown, bubbles: true }),
      );
    return html` <button type="button" class="quiet" title=${this.t("Show in the program")} @click=${show}>${says}</button>`;
  }

  private about(): void {
    this.dispatchEvent(
      new CustomEvent("open-manual", {
        bubbles: true,
        detail: `control:${this.store.post?.id}`,
      }),
    );
  }

  private go(event: Event, path: string): void {
    event.preventDefault();
    this.dispatchEvent(
      new CustomEvent("go-to-field", { detail: path, bubbles: true }),
    );
  }
}

customElements.define("tp-checks", ChecksPart);
