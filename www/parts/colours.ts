// Syntax colours of a program without an element per word: ranges in the browser's highlight registry, made when the page is idle.

/** Kinds of words in all dialects: word addresses, Klartext, O-words, R and Q parameters. The first match counts. */
const KINDS: [name: string, words: RegExp][] = [
  ["comment", /\([^)]*\)|;.*$/],
  ["text", /"[^"]*"/],
  ["variable", /#<[^>]*>|#\d+|\$[A-Z]\w*|\b_[A-Z]+\b|\bR\d+\b|\bQS?\d+\b/],
  [
    "code",
    /\b[GM]\d+(?:\.\d)?\b|\bo(?:<[^>]*>|\d+)|\b(?:call|sub|endsub|if|else|endif|IF|THEN|GOTO[FB]?|DEF|MSG|SETAL|STOPRE|MEAS|TCH PROBE|CYCL DEF|TOOL CALL|BEGIN PGM|END PGM|CYCLE\d+|POPEN|PCLOS|DPRNT)\b/,
  ],
];
const WORDS = new RegExp(
  KINDS.map(([name, { source }]) => `(?<${name}>${source})`).join("|"),
  "gm",
);

/** Words of a line by kind, with start and end. */
export function words(
  line: string,
): { kind: string; from: number; to: number }[] {
  return [...line.matchAll(WORDS)].flatMap((match) => {
    const kind = Object.entries(match.groups ?? {}).find(
      ([, text]) => text !== undefined,
    )?.[0];
    return kind
      ? [{ kind, from: match.index, to: match.index + match[0].length }]
      : [];
  });
}

/** The browser's highlight registry; older browsers show programs in one colour. */
const registry = (globalThis as { CSS?: { highlights?: HighlightRegistry } })
  .CSS?.highlights;

/**
 * Syntax colours of one program, only for visible lines, because every coloured line is repainted at each keystroke. Several programs on a page share the
 * registry.
 */
export class Colours {
  private ranges: [Highlight, StaticRange][] = [];
  private asked = 0;
  private box: HTMLElement | null = null;
  private readonly again = () => this.show(0);
  /** A box with another size shows other lines; so does one that becomes visible. */
  private readonly sizes = new ResizeObserver(this.again);

  /** Colours the visible lines of a box and follows its scrolling. */
  follow(box: HTMLElement): void {
    if (!registry || box === this.box) return;
    this.leave();
    this.box = box;
    box.addEventListener("scroll", this.again, { passive: true });
    this.sizes.observe(box);
  }

  /** Ends the colouring. */
  leave(): void {
    this.clear();
    this.sizes.disconnect();
    this.box?.removeEventListener("scroll", this.again);
    this.box = null;
  }

  /** Colours the visible lines after this many milliseconds without another call. */
  show(wait: number): void {
    if (!this.box) return;
    clearTimeout(this.asked);
    this.asked = setTimeout(() => this.colour(), wait) as unknown as number;
  }

  private colour(): void {
    this.clear();
    // With forced colours the system shows every highlight as a selection.
    if (matchMedia("(forced-colors: active)").matches) return;
    const sight = this.box?.getBoundingClientRect();
    if (!this.box || !sight) return;
    for (const text of this.box.querySelectorAll(".line:not(.touch) .text")) {
      const { top, bottom } = text.getBoundingClientRect();
      if (bottom > Math.max(top, sight.top) && top < sight.bottom)
        this.line(text);
    }
  }

  private clear(): void {
    clearTimeout(this.asked);
    for (const [highlight, range] of this.ranges) highlight.delete(range);
    this.ranges = [];
  }

  private line(element: Element): void {
    const node = [...element.childNodes].find(
      (child) => child.nodeType === Node.TEXT_NODE && child.nodeValue,
    );
    if (!node) return;
    for (const { kind, from, to } of words(node.nodeValue ?? "")) {
      const highlight = this.of(kind);
      const range = new StaticRange({
        startContainer: node,
        startOffset: from,
        endContainer: node,
        endOffset: to,
      });
      highlight.add(range);
      this.ranges.push([highlight, range]);
    }
  }

  private of(kind: string): Highlight {
    const name = `touchpath-${kind}`;
    const known = registry?.get(name);
    if (known) return known;
    const made = new Highlight();
    registry?.set(name, made);
    return made;
  }
}
