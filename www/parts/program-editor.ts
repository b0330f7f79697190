// Viewer of long programs: CodeMirror, read-only, which keeps only the visible lines in the document.
import {
  EditorState,
  type Range,
  StateEffect,
  StateField,
} from "@codemirror/state";
import {
  Decoration,
  type DecorationSet,
  EditorView,
  ViewPlugin,
  type ViewUpdate,
} from "@codemirror/view";
import { words } from "./colours.js";
import { letterOf } from "./keys.js";
import { attributesOf, MARGIN, type Shown } from "./shown.js";

/** Decorations of lines. */
type Look = Pick<Shown, "kind" | "notes" | "marks" | "lit" | "found">;

const change = StateEffect.define<Look>();

const look = StateField.define<Look>({
  create: () => ({
    kind: () => "",
    notes: new Map(),
    marks: new Map(),
    lit: -1,
    found: { matches: new Set(), here: -1 },
  }),
  update: (before, { effects }) =>
    effects.reduce(
      (now, effect) => (effect.is(change) ? effect.value : now),
      before,
    ),
});

/** Numbers, kinds and words of the visible lines. */
function decorated({ state, visibleRanges }: EditorView): DecorationSet {
  const { kind, notes, marks, lit, found } = state.field(look);
  const all: Range<Decoration>[] = [];
  let last = -1;
  for (const seen of visibleRanges) {
    for (let at = seen.from; at <= seen.to; ) {
      const { from, to, number } = state.doc.lineAt(at);
      const line = number - 1;
      const is = kind(line);
      const names = ["line", is];
      if (line === lit) names.push("lit");
      if (found.matches.has(line)) names.push("match");
      if (line === found.here) names.push("here");
      const noted = notes.get(line);
      if (noted) names.push("noted");
      const title: Record<string, string> = noted
        ? { title: noted.join("\n") }
        : {};
      const attributes = {
        "data-line": String(line),
        "data-number": String(number),
        ...attributesOf(marks.get(line)),
        ...title,
      };
      // A long line may be visible in several parts; it is decorated once.
      if (line !== last)
        all.push(
          Decoration.line({
            class: names.filter(Boolean).join(" "),
            attributes,
          }).range(from),
        );
      last = line;
      // A line may be as long as the text: only its visible part is searched.
      const start = Math.max(from, seen.from);
      const text =
        is === "touch" ? "" : state.sliceDoc(start, Math.min(to, seen.to));
      for (const word of words(text)) {
        const colour = Decoration.mark({ class: `word-${word.kind}` });
        all.push(colour.range(start + word.from, start + word.to));
      }
      at = to + 1;
    }
  }
  return Decoration.set(all);
}

const decorations = ViewPlugin.fromClass(
  class {
    lines: DecorationSet;

    constructor(view: EditorView) {
      this.lines = decorated(view);
    }

    update({
      view,
      docChanged,
      viewportChanged,
      startState,
      state,
    }: ViewUpdate): void {
      if (
        docChanged ||
        viewportChanged ||
        startState.field(look) !== state.field(look)
      )
        this.lines = decorated(view);
    }
  },
  { decorations: ({ lines }) => lines },
);

/** A text in its box. */
export class Editor {
  private readonly view: EditorView;
  /** The text that was shown last. */
  private text = "";

  constructor(
    box: HTMLElement,
    label: () => string,
    point: (line: number | null) => void,
  ) {
    const pointed = (event: Event) => {
      const line = (event.target as Element).closest<HTMLElement>("[data-line]")
        ?.dataset.line;
      if (line !== undefined) point(Number(line));
    };
    const all = (event: KeyboardEvent, view: EditorView) => {
      if (
        !(event.ctrlKey || event.metaKey) ||
        event.altKey ||
        letterOf(event) !== "a"
      )
        return false;
      view.dispatch({ selection: { anchor: 0, head: view.state.doc.length } });
      return true;
    };
    const extensions = [
      look,
      decorations,
      EditorState.readOnly.of(true),
      // Not editable, so no keyboard opens on a phone; selected text can be copied.
      EditorView.editable.of(false),
      EditorView.lineWrapping,
      EditorView.contentAttributes.of(() => ({
        tabindex: "0",
        "aria-readonly": "true",
        "aria-label": label(),
        lang: "en",
        translate: "no",
      })),
      EditorView.domEventHandlers({
        mouseover: pointed,
        click: pointed,
        mouseleave: () => point(null),
        keydown: all,
      }),
    ];
    const root = box.getRootNode() as ShadowRoot;
    this.view = new EditorView({
      parent: box,
      root,
      state: EditorState.create({ extensions }),
    });
  }

  focus(): void {
    this.view.focus();
  }

  free(): void {
    this.view.destroy();
  }

  /** Scrolls until this line is the first visible one. */
  begin(line: number): void {
    const { doc } = this.view.state;
    const { from } = doc.line(Math.min(line, doc.lines - 1) + 1);
    this.view.dispatch({
      effects: EditorView.scrollIntoView(from, { y: "start", yMargin: 0 }),
    });
  }

  show({ text, sight, ...beside }: Shown): void {
    const { state } = this.view;
    const whole = { from: 0, to: state.doc.length, insert: text };
    const changes = state.changes(text === this.text ? [] : whole);
    this.text = text;
    const effects: StateEffect<unknown>[] = [change.of(beside)];
    const doc = changes.apply(state.doc);
    if (sight >= 0 && sight < doc.lines)
      effects.push(
        EditorView.scrollIntoView(doc.line(sight + 1).from, {
          y: "nearest",
          yMargin: MARGIN,
        }),
      );
    this.view.dispatch({ changes, effects });
  }
}
