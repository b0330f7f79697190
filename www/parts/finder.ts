import { html, type TemplateResult } from "lit";
import type { Store } from "../store.js";
import type { Found } from "./shown.js";

/** Searches a text line by line: a field with its matches. */
export class Finder {
  /** The text in the field. */
  private typed = "";
  /** Search text in lower case. */
  private words = "";
  private lines: number[] = [];
  /** Text whose matches were given from outside; null after a search. */
  private givenFor: string | null = null;
  /** Index of the current match. */
  private at = -1;

  /** `show` scrolls to the current match; the part is rendered again. */
  constructor(
    private readonly store: () => Store,
    private readonly text: () => string,
    private readonly show: () => void,
  ) {}

  render(hidden = false): TemplateResult {
    const store = this.store();
    return html`<input class="filter" ?hidden=${hidden} type="search" .value=${this.typed} placeholder=${store.t("Find")} aria-label=${store.t("Find in the program")}
        @input=${(e: Event) => this.look((e.target as HTMLInputElement).value)}
        @keydown=${(e: KeyboardEvent) => {
          if (e.key === "Enter") this.step(e.shiftKey ? -1 : 1);
        }} />
      <span role="status" class="status-text found">${hidden ? "" : this.said()}</span>`;
  }

  /** Searches again after the text may have changed; the current match stays. Matches from outside end with their text. */
  again(): void {
    if (this.givenFor !== null && this.givenFor !== this.text()) this.look("");
    if (this.words === "") return;
    this.find();
    this.at = Math.min(Math.max(this.at, 0), this.lines.length - 1);
  }

  get found(): Found {
    return { matches: new Set(this.lines), here: this.lines[this.at] ?? -1 };
  }

  /** Marks these lines as matches. */
  give(lines: number[]): void {
    this.look("");
    this.givenFor = this.text();
    this.lines = lines;
    this.step(1);
  }

  private look(words: string): void {
    this.typed = words;
    this.words = words.trim().toLowerCase();
    this.givenFor = null;
    this.at = -1;
    this.find();
    this.step(1);
  }

  private find(): void {
    const holds = (text: string) =>
      this.words !== "" && text.toLowerCase().includes(this.words);
    this.lines = this.text()
      .split(/\r\n?|\n/)
      .flatMap((text, line) => (holds(text) ? [line] : []));
  }

  /** Goes to the next or previous match, and past the end to the first. */
  private step(way: 1 | -1): void {
    const { length } = this.lines;
    if (length > 0)
      this.at = (Math.max(this.at, way < 0 ? 0 : -1) + way + length) % length;
    this.show();
  }

  /** Number of matches and the current one. */
  private said(): string {
    const store = this.store();
    const { length } = this.lines;
    if (this.words === "" && length === 0) return "";
    return length
      ? store.t("{count} of {all}", this.at + 1, length)
      : store.t("not found");
  }
}
