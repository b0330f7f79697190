// The text of an opened program, line by line. A long one has an editor, which puts only what is seen into the document; it is plain text until
// that is loaded.
import { LineList } from "./line-list.js";
import type { Editor } from "./program-editor.js";
import { type Found, isShort, MARGIN, type Shown } from "./shown.js";

const NONE: Found = { matches: new Set(), here: -1 };

/** The text in its box. What changes within a frame is shown at once, in that frame. */
export class ProgramList {
  private editor?: Editor | LineList;
  /** Plain text until the editor is loaded. */
  private readonly plain = document.createElement("pre");
  private readonly shown: Shown = {
    text: "",
    kind: () => "",
    notes: new Map(),
    marks: new Map(),
    found: NONE,
    lit: -1,
    sight: -1,
  };
  private frame = 0;
  private freed = false;

  /** `point` gets the line under the pointer; null is none. */
  constructor(
    private readonly box: HTMLElement,
    private readonly name: () => string,
    private readonly point: (line: number | null) => void,
  ) {
    this.plain.tabIndex = 0;
    this.plain.role = "region";
    this.plain.lang = "en";
    this.plain.translate = false;
    box.replaceChildren(this.plain);
  }

  /** Another text, with what is said of its lines. Nothing of it is lit or found yet. */
  show(program: Pick<Shown, "text" | "kind" | "notes" | "marks">): void {
    Object.assign(this.shown, program, {
      found: NONE,
      lit: -1,
      sight: 0,
    });
    const { text } = program;
    const short = isShort(text);
    if (this.editor && this.editor instanceof LineList !== short) {
      this.editor.free();
      this.editor = undefined;
      this.box.replaceChildren(this.plain);
    }
    if (!this.editor && short) {
      this.plain.remove();
      this.editor = new LineList(this.box, this.name, this.point);
    } else if (!this.editor) {
      this.plain.textContent = text;
      this.load();
    }
    this.later();
  }

  /** Whether its editor is there: until then the browser finds words in the whole text. */
  get edits(): boolean {
    return this.editor !== undefined;
  }

  /** Names it in the language that is the page's now. */
  label(): void {
    if (this.plain.ariaLabel === this.name()) return;
    this.plain.ariaLabel = this.name();
    this.later();
  }

  /** Lights a line, or none; `reveal` brings it into sight. */
  light(line: number, reveal: boolean): void {
    if (line === this.shown.lit) return;
    this.shown.lit = line;
    if (reveal) this.shown.sight = line;
    this.later();
  }

  /** Marks what was found, and brings the line that is shown into sight. */
  mark(found: Found): void {
    this.shown.found = found;
    this.shown.sight = found.here;
    this.later();
  }

  free(): void {
    this.freed = true;
    cancelAnimationFrame(this.frame);
    this.editor?.free();
    this.box.replaceChildren();
  }

  private later(): void {
    this.frame ||= requestAnimationFrame(() => this.draw());
  }

  private draw(): void {
    this.frame = 0;
    if (this.editor) this.editor.show(this.shown);
    else this.reveal(this.shown.sight);
    this.shown.sight = -1;
  }

  /** Brings a line of the plain text into sight, where it is not. */
  private reveal(line: number): void {
    if (line < 0) return;
    const [{ top, bottom }, box] = [
      this.placeOf(this.starts()[line] ?? 0),
      this.plain.getBoundingClientRect(),
    ];
    if (top < box.top || bottom > box.bottom)
      this.plain.scrollTop += top - box.top - MARGIN;
  }

  /** The first line of the plain text that is seen from its beginning. */
  private first(): number {
    const starts = this.starts();
    const { top } = this.plain.getBoundingClientRect();
    let [least, most] = [0, starts.length - 1];
    while (least < most) {
      const middle = Math.floor((least + most) / 2);
      if (this.placeOf(starts[middle] ?? 0).top < top) least = middle + 1;
      else most = middle;
    }
    return least;
  }

  /** Where the lines of the text begin. */
  private starts(): number[] {
    const starts = [0];
    const { text } = this.shown;
    for (let at = text.indexOf("\n"); at >= 0; at = text.indexOf("\n", at + 1))
      starts.push(at + 1);
    return starts;
  }

  /** Where a character of the plain text is on the screen. */
  private placeOf(at: number): DOMRect {
    const range = document.createRange();
    const text = this.plain.firstChild as Text | null;
    if (text) {
      range.setStart(text, at);
      range.setEnd(text, Math.min(at + 1, text.length));
    }
    return range.getBoundingClientRect();
  }

  /** Where the editor cannot be loaded, the text stays as it is. */
  private async load(): Promise<void> {
    const { Editor } = await import("./program-editor.js").catch(() => ({
      Editor: null,
    }));
    if (
      !Editor ||
      this.editor ||
      this.freed ||
      !this.box.isConnected ||
      isShort(this.shown.text)
    )
      return;
    const focused = this.plain.matches(":focus");
    const first =
      this.plain.scrollTop > 0 && this.shown.sight < 0 ? this.first() : -1;
    this.plain.remove();
    this.editor = new Editor(this.box, this.name, this.point);
    this.draw();
    // What was seen before is seen still.
    if (first >= 0) this.editor.begin(first);
    if (focused) this.editor.focus();
  }
}
