// Colours for the words of a program, without an element a word: ranges of text in the browser's registry of highlights, made when there is time.

/** The kinds of words, and what they look like in any dialect: word addresses, Klartext, O-words, R and Q parameters. The first that fits a place counts. */
const KINDS: [name: string, words: RegExp][] = [
  ["comment", /\([^)]*\)|;.*$/],
  ["text", /"[^"]*"/],
  ["variable", /#<[^>]*>|#\d+|\$[A-Z]\w*|\b_[A-Z]+\b|\bR\d+\b|\bQS?\d+\b/],
  [
    "code",
    /\b[GM]\d+(?:\.\d)?\b|\bo(?:<[^>]*>|\d+)|\b(?:call|sub|endsub|if|else|endif|IF|THEN|GOTO[FB]?|DEF|MSG|SETAL|STOPRE|MEAS|TCH PROBE|CYCL DEF|TOOL CALL|BEGIN PGM|END PGM|CYCLE\d+|POPEN|PCLOS|DPRNT)\b/,
  ],
];
const WORDS = new RegExp(KINDS.map(([name, { source }]) => `(?<${name}>${source})`).join("|"), "gm");

/** Words of a line by kind, from and to. */
export function words(line: string): { kind: string; from: number; to: number }[] {
  return [...line.matchAll(WORDS)].flatMap((match) => {
    const kind = Object.entries(match.groups ?? {}).find(([, text]) => text !== undefined)?.[0];
    return kind ? [{ kind, from: match.index, to: match.index + match[0].length }] : [];
  });
}

/** The browser's registry; an old browser has none, and shows programs in one colour. */
const registry = (globalThis as { CSS?: { highlights?: HighlightRegistry } }).CSS?.highlights;

/** The colours of one program that is shown. Several on a page share the registry. */
export class Colours {
  private ranges: [Highlight, StaticRange][] = [];
  private asked = 0;

  /** Colours the texts of these elements as soon as nothing else is to be done. */
  show(texts: () => Iterable<Element>): void {
    if (!registry) return;
    clearTimeout(this.asked);
    this.asked = setTimeout(() => {
      this.clear();
      for (const element of texts()) this.line(element);
    }, 120) as unknown as number;
  }

  clear(): void {
    clearTimeout(this.asked);
    for (const [highlight, range] of this.ranges) highlight.delete(range);
    this.ranges = [];
  }

  private line(element: Element): void {
    const node = [...element.childNodes].find((child) => child.nodeType === Node.TEXT_NODE && child.nodeValue);
    if (!node) return;
    for (const { kind, from, to } of words(node.nodeValue ?? "")) {
      const highlight = this.of(kind);
      const range = new StaticRange({ startContainer: node, startOffset: from, endContainer: node, endOffset: to });
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
