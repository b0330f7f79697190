// The text of an opened program, line by line. A long text has an editor, which keeps only the visible lines in the document; until it is loaded the text is
// plain.
import { LineList } from "./line-list.js";
import type { Editor } from "./program-editor.js";
import { type Found, isShort, MARGIN, type Shown } from "./shown.js";

const NONE: Found = { matches: new Set(), here: -1 };

/** The text in its box. Changes within a frame appear together in that frame. */
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

  /** `point` receives the line under the pointer; null without one. */
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

  /** Shows another text with notes about its lines, without highlights and matches. */
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

  /** Whether the editor is loaded; until then the browser searches the whole text. */
  get edits(): boolean {
    return this.editor !== undefined;
  }

  /** Labels it in the current language of the page. */
  label(): void {
    if (this.plain.ariaLabel === this.name()) return;
    this.plain.ariaLabel = this.name();
    this.later();
  }

  /** Highlights a line, or removes the highlight; `reveal` scrolls to it. */
  light(line: number, reveal: boolean): void {
    if (line === this.shown.lit) return;
    this.shown.lit = line;
    if (reveal) this.shown.sight = line;
    this.later();
  }

  /** Marks the matches and scrolls to the current one. */
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

  /** Scrolls to a line of the plain text if it is not visible. */
  private reveal(line: number): void {
    if (line < 0) return;
    const [{ top, bottom }, box] = [
      this.placeOf(this.starts()[line] ?? 0),
      this.plain.getBoundingClientRect(),
    ];
    if (top < box.top || bottom > box.bottom)
      this.plain.scrollTop += top - box.top - MARGIN;
  }

  /** First fully visible line of the plain text. */
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

  /** Offsets of the lines in the text. */
  private starts(): number[] {
    const starts = [0];
    const { text } = this.shown;
    for (let at = text.indexOf("\n"); at >= 0; at = text.indexOf("\n", at + 1))
      starts.push(at + 1);
    return starts;
  }

  /** Position of a character of the plain text on the screen. */
  private placeOf(at: number): DOMRect {
    const range = document.createRange();
    const text = this.plain.firstChild as Text | null;
    if (text) {
      range.setStart(text, at);
      range.setEnd(text, Math.min(at + 1, text.length));
    }
    return range.getBoundingClientRect();
  }

  /** If the editor cannot be loaded, the text stays plain. */
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
    // The visible part stays the same.
    if (first >= 0) this.editor.begin(first);
    if (focused) this.editor.focus();
  }
}
