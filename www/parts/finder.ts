import { html, type TemplateResult } from "lit";
import type { Store } from "../store.js";
import type { Found } from "./listing.js";

/** Looks for words in a text, line by line: a field, and what it found. */
export class Finder {
  /** What is looked for, in small letters. */
  private words = "";
  private lines: number[] = [];
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
    return html`<input class="filter" ?hidden=${hidden} type="search" placeholder=${store.t("Find")} aria-label=${store.t("Find in the program")}
        @input=${(e: Event) => this.look((e.target as HTMLInputElement).value)}
        @keydown=${(e: KeyboardEvent) => {
          if (e.key === "Enter") this.step(e.shiftKey ? -1 : 1);
        }} />
      <span role="status" class="told found">${hidden ? "" : this.said()}</span>`;
  }

  /** The text is another one: the words are looked for again, and the lines stay where they are. */
  again(): void {
    if (this.words === "") return;
    this.find();
    this.at = Math.min(Math.max(this.at, 0), this.lines.length - 1);
  }

  get found(): Found {
    return { matches: new Set(this.lines), here: this.lines[this.at] ?? -1 };
  }

  private look(words: string): void {
    this.words = words.trim().toLowerCase();
    this.at = -1;
    this.find();
    this.step(1);
  }

  private find(): void {
    const holds = (text: string) => this.words !== "" && text.toLowerCase().includes(this.words);
    this.lines = this.text()
      .split("\n")
      .flatMap((text, line) => (holds(text) ? [line] : []));
  }

  /** To the next line that was found, or the one before; past the end from the start again. */
  private step(way: 1 | -1): void {
    const { length } = this.lines;
    if (length > 0) this.at = (Math.max(this.at, way < 0 ? 0 : -1) + way + length) % length;
    this.show();
  }

  /** How many lines were found, and which of them is shown. */
  private said(): string {
    if (this.words === "") return "";
    const store = this.store();
    const { length } = this.lines;
    return length ? store.t("{count} of {all}", this.at + 1, length) : store.t("not found");
  }
}
