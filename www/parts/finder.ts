import { html, type TemplateResult } from "lit";
import type { Store } from "../store.js";
import type { Found } from "./shown.js";

/** Looks for words in a text, line by line: a field, and what it found. */
export class Finder {
  /** The text in the field. */
  private typed = "";
  /** What is looked for, in small letters. */
  private words = "";
  private lines: number[] = [];
  /** The text that lines were given for; null where they were looked for. */
  private givenFor: string | null = null;
  /** Which of the lines is shown. */
  private at = -1;

  /** `show` brings the line that is shown into sight; the part is rendered again. */
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

  /** The text may be another one: the words are looked for again, and the lines stay where they are. Lines that were given go with their text. */
  again(): void {
    if (this.givenFor !== null && this.givenFor !== this.text()) this.look("");
    if (this.words === "") return;
    this.find();
    this.at = Math.min(Math.max(this.at, 0), this.lines.length - 1);
  }

  get found(): Found {
    return { matches: new Set(this.lines), here: this.lines[this.at] ?? -1 };
  }

  /** Marks these lines as found. */
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

  /** To the next line that was found, or the one before; past the end from the start again. */
  private step(way: 1 | -1): void {
    const { length } = this.lines;
    if (length > 0)
      this.at = (Math.max(this.at, way < 0 ? 0 : -1) + way + length) % length;
    this.show();
  }

  /** How many lines were found, and which of them is shown. */
  private said(): string {
    const store = this.store();
    const { length } = this.lines;
    if (this.words === "" && length === 0) return "";
    return length
      ? store.t("{count} of {all}", this.at + 1, length)
      : store.t("not found");
  }
}
