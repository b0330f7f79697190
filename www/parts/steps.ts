// The moves of an opened program, one by one: a slider with its touches marked, and buttons to the next.
import { html, type TemplateResult } from "lit";
import type { Store } from "../store.js";

/** More marks than this would be a bar. */
const MOST_MARKS = 200;

/** The width of the slider's thumb, pixels; the style sheet knows the same width. */
const THUMB = 16;

export class Steps {
  private count = 0;
  /** The touches among the moves, counted from 1. */
  private touches: number[] = [];
  private marks = "";

  constructor(
    private readonly store: () => Store,
    private readonly to: (move: number | null) => void,
  ) {}

  /** Another run: how many moves, and which of them touch. */
  take(count: number, touches: number[]): void {
    this.count = count;
    this.touches = touches;
    const mark = (t: number) =>
      `var(--tick) calc(${THUMB / 2}px + (100% - ${THUMB}px) * ${t / count}) 50% / 2px 12px`;
    this.marks =
      touches.length <= MOST_MARKS ? touches.map(mark).join(", ") : "";
  }

  /** `at` is the move that is pointed at, from 0; null is none. */
  render(at: number | null): TemplateResult {
    const t = this.store().t.bind(this.store());
    const now = at === null ? 0 : at + 1;
    const button = (name: string, key: string, sign: string, move: number) =>
      html`<button type="button" class="icon" aria-label=${name} title=${`${name} (${key})`} ?disabled=${this.count === 0} @click=${() => this.step(move)}>${sign}</button>`;
    const before = this.touches.findLast((touch) => touch < now) ?? 0;
    const next = this.touches.find((touch) => touch > now) ?? this.count;
    const key = (event: KeyboardEvent) => {
      const way = { ArrowRight: next, ArrowLeft: before }[event.key];
      if (event.key === "Escape") this.step(0);
      else if (way !== undefined && event.ctrlKey) this.step(way);
      else return;
      event.preventDefault();
    };
    return html`<div class="scrub" role="group" aria-label=${t("Timeline")} @keydown=${key}>
      ${button(t("Touch before"), "Ctrl+←", "|◀", before)}
      ${button(t("Move before"), "←", "◀", now - 1)}
      ${button(t("Next move"), "→", "▶", now + 1)}
      ${button(t("Next touch"), "Ctrl+→", "▶|", next)}
      <span class="track" .style=${this.marks ? `background: ${this.marks}` : ""}>
        <input type="range" min="0" max=${this.count} .value=${String(now)} aria-label=${t("Move")} @input=${(event: Event) => this.step(Number((event.target as HTMLInputElement).value))} />
      </span>
      <output>${now} / ${this.count}</output>
    </div>`;
  }

  /** To a move, counted from 1; 0 is none. */
  private step(move: number): void {
    const bounded = Math.max(0, Math.min(this.count, move));
    this.to(bounded === 0 ? null : bounded - 1);
  }
}
