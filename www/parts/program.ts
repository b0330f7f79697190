import { html, nothing, type TemplateResult } from "lit";
import { copy, download, withheld } from "./hand.js";
import "./checks.js";
import { Part } from "./part.js";

/** The program, line by line; a line that makes a move lights up with it. */
class ProgramPart extends Part {
  private told = "";
  /** The program that was saved or copied: what is said of it holds for no other. */
  private toldOf = "";

  override render(): TemplateResult {
    const { stale, catalog } = this.store;
    const { program } = this.store.plan;
    // The extension is the chosen control's, also while there is no program for it.
    const chosen = catalog.posts.find((p) => p.id === this.store.get("control.post"));
    const extension = chosen?.extension ?? program.extension;
    const why = stale ? "withheld-program" : nothing;
    const lines = program.text.replace(/\n$/, "").split("\n");
    const moves = new Map(program.moveLines.map((line, move) => [line, move]));
    const lit = this.store.highlight === null ? -1 : program.moveLines[this.store.highlight];
    const step = this.store.highlight === null ? 0 : (this.store.plan.moves[this.store.highlight]?.step ?? 0);
    const { steps } = this.store.cycle;
    return html`
      ${
        steps.length
          ? html`<details class="documented" open><summary>Documented steps</summary>
        <ol>${steps.map(
          (text, i) => html`<li class=${i + 1 === step ? "lit" : ""} aria-current=${i + 1 === step ? "step" : "false"}
          @mouseenter=${() => this.first(i + 1)} @mouseleave=${() => this.store.point(null)}>${text}</li>`,
        )}</ol></details>`
          : ""
      }
      <div class="tools">
        <button type="button" ?disabled=${stale} aria-describedby=${why} @click=${this.copy}>Copy</button>
        <button type="button" ?disabled=${stale} aria-describedby=${why} @click=${this.save}>Save .${extension}</button>
        <span role="status" class="told">${stale || this.toldOf !== program.text ? "" : this.told}</span>
      </div>
      ${withheld(this.store, "withheld-program")}
      <tp-checks .store=${this.store}></tp-checks>
      <div class=${stale ? "code stale" : "code"} role="listbox" tabindex="0" aria-label="Program" @keydown=${this.key}
        @mouseleave=${() => this.store.point(null)}>
        ${lines.map((text, line) => {
          const move = moves.get(line);
          return html`<div role="option" class=${move === undefined ? "line plain" : "line"} data-line=${line} aria-selected=${line === lit ? "true" : "false"}
            @mouseenter=${() => this.store.point(move ?? null)} @click=${() => this.store.point(move ?? null)}><span class="no">${line + 1}</span><span class="text">${text}</span></div>`;
        })}
      </div>
    `;
  }

  protected override updated(): void {
    if (this.matches(":hover")) return;
    this.querySelector<HTMLElement>(".documented .lit")?.scrollIntoView({ block: "nearest" });
    const lit = this.querySelector<HTMLElement>("[aria-selected=true]");
    const box = this.querySelector<HTMLElement>(".code");
    if (!lit || !box) return;
    const above = lit.offsetTop;
    if (above < box.scrollTop || above + lit.offsetHeight > box.scrollTop + box.clientHeight) {
      box.scrollTop = above - box.clientHeight / 2;
    }
  }

  /** Points at the first move of a step. */
  private first(step: number): void {
    const move = this.store.plan.moves.findIndex((m) => m.step === step);
    this.store.point(move < 0 ? null : move);
  }

  private key(event: KeyboardEvent): void {
    const step = { ArrowDown: 1, ArrowUp: -1 }[event.key];
    if (!step) return;
    event.preventDefault();
    const last = this.store.plan.moves.length - 1;
    const now = this.store.highlight ?? (step > 0 ? -1 : last + 1);
    this.store.point(Math.max(0, Math.min(last, now + step)));
  }

  private async copy(): Promise<void> {
    if (!this.store.stale) this.tell(await copy(this.store.plan.program.text));
  }

  private save(): void {
    if (this.store.stale) return;
    const { text, extension } = this.store.plan.program;
    const name = String(this.store.shown.name ?? "").replace(/[^A-Za-z0-9_-]+/g, "_") || "PROBE";
    download(text, `${name}.${extension}`, "text/plain");
    this.tell(`Saved ${name}.${extension}`);
  }

  private tell(text: string): void {
    this.told = text;
    this.toldOf = this.store.plan.program.text;
    this.requestUpdate();
  }
}

customElements.define("tp-program", ProgramPart);
