// Lines of a short opened program, with an element per line.
import { Colours } from "./colours.js";
import { attributesOf, MARGIN, type Shown } from "./shown.js";

/** A text in its box, line by line. */
export class LineList {
  private readonly list = document.createElement("div");
  private readonly colours = new Colours();
  private text: string | null = null;
  private lines: HTMLElement[] = [];
  /** Lines that were highlighted, found and annotated last. */
  private marked: HTMLElement[] = [];

  constructor(
    box: HTMLElement,
    private readonly label: () => string,
    point: (line: number | null) => void,
  ) {
    const { list } = this;
    list.className = "lines";
    list.tabIndex = 0;
    list.role = "textbox";
    list.ariaReadOnly = "true";
    list.ariaMultiLine = "true";
    list.lang = "en";
    list.translate = false;
    const pointed = (event: Event) => {
      const line = (event.target as Element).closest<HTMLElement>("[data-line]")
        ?.dataset.line;
      if (line !== undefined) point(Number(line));
    };
    list.addEventListener("mouseover", pointed);
    list.addEventListener("click", pointed);
    list.addEventListener("mouseleave", () => point(null));
    box.append(list);
    this.colours.follow(list);
  }

  free(): void {
    this.colours.leave();
    this.list.remove();
  }

  show({ text, kind, notes, marks, lit, found, sight }: Shown): void {
    this.list.ariaLabel = this.label();
    if (text !== this.text) {
      this.text = text;
      this.lines = text.split(/\r\n?|\n/).map((line, k) => {
        const row = document.createElement("div");
        row.dataset.line = String(k);
        row.dataset.number = String(k + 1);
        const words = document.createElement("span");
        words.className = "text";
        words.textContent = line;
        row.append(words);
        return row;
      });
      this.marked = [];
      this.list.replaceChildren(...this.lines);
    }
    for (const row of this.marked)
      for (const name of ["title", "data-faults", "data-touch"])
        row.removeAttribute(name);
    const rows = (numbers: Iterable<number>) =>
      [...numbers].flatMap((k) => this.lines[k] ?? []);
    this.lines.forEach((row, k) => {
      const is = `line ${kind(k)}`.trim();
      if (row.className !== is) row.className = is;
    });
    for (const row of rows(found.matches)) row.classList.add("match");
    for (const row of rows([found.here])) row.classList.add("here");
    for (const row of rows([lit])) row.classList.add("lit");
    this.marked = rows(new Set([...notes.keys(), ...marks.keys()]));
    for (const row of this.marked) {
      const line = Number(row.dataset.line);
      const noted = notes.get(line);
      if (noted) {
        row.classList.add("noted");
        row.title = noted.join("\n");
      }
      for (const [name, value] of Object.entries(attributesOf(marks.get(line))))
        row.setAttribute(name, value);
    }
    this.reveal(this.lines[sight]);
    this.colours.show(0);
  }

  /** Scrolls to a line if it is not visible. */
  private reveal(row: HTMLElement | undefined): void {
    if (!row) return;
    const [{ top, bottom }, box] = [
      row.getBoundingClientRect(),
      this.list.getBoundingClientRect(),
    ];
    if (top < box.top) this.list.scrollTop -= box.top - top + MARGIN;
    else if (bottom > box.bottom)
      this.list.scrollTop += bottom - box.bottom + MARGIN;
  }
}
