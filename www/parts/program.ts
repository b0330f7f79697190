import { html, type TemplateResult } from "lit";
import { Part } from "./part.js";

/** The program, line by line; a line that makes a move lights up with it. */
class ProgramPart extends Part {
  private told = "";

  override render(): TemplateResult {
    const { program } = this.store.plan;
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
        <button type="button" @click=${this.copy}>Copy</button>
        <button type="button" @click=${this.save}>Save .${program.extension}</button>
        <span role="status" class="told">${this.told}</span>
      </div>
      <div class=${this.store.stale ? "code stale" : "code"} role="listbox" tabindex="0" aria-label="Program" @keydown=${this.key}
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
    try {
      await navigator.clipboard.writeText(this.store.plan.program.text);
      this.tell("Copied");
    } catch {
      this.tell("The browser did not allow it");
    }
  }

  private save(): void {
    const { text, extension } = this.store.plan.program;
    const name = String(this.store.shown.name ?? "").replace(/[^A-Za-z0-9_-]+/g, "_") || "PROBE";
    const link = document.createElement("a");
    link.href = URL.createObjectURL(new Blob([text], { type: "text/plain" }));
    link.download = `${name}.${extension}`;
    link.click();
    URL.revokeObjectURL(link.href);
    this.tell(`Saved ${link.download}`);
  }

  private tell(text: string): void {
    this.told = text;
    this.requestUpdate();
  }
}

customElements.define("tp-program", ProgramPart);
