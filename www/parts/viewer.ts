// Viewer of an opened program: its moves, faults, inputs and assumptions. Nothing about it is proven.
import { html, nothing, type PropertyValues, type TemplateResult } from "lit";
import type {
  Finding,
  Message,
  PageView,
  ProgramKnown,
  ProgramMoves,
} from "../core/browser.js";
import { keepKnown, knownOf } from "../known.js";
import { type Ran, runText } from "../run-text.js";
import { readAs } from "../sentences.js";
import { askFor } from "../tasks.js";
import { w } from "../words.js";
import { DrawnPart } from "./canvas-part.js";
import { Drawing } from "./drawing.js";
import { Finder } from "./finder.js";
import { type Into, insertPanel, into } from "./insert-panel.js";
import { letterOf } from "./keys.js";
import { kind } from "./legend.js";
import { ProgramList } from "./program-list.js";
import { brokenOf, letter, noteList, RunPanel } from "./run-panel.js";
import type { Mark } from "./shown.js";
import { type Run, Timeline } from "./timeline.js";

export { into };

/** A longer text, or one with more moves, runs in a worker while the page stays usable. */
const LONG_TEXT = 20_000;
const MANY_MOVES = 2000;

/** A longer text is read but not run. */
const LONGEST_RUN = 5_000_000;

/** Names of the kinds of moves. */
const KINDS = { rapid: w("rapid"), feed: w("feed"), probe: w("probing") };

class ViewerPart extends DrawnPart {
  declare viewed: {
    text: string;
    moves: ProgramMoves;
    why: Finding[];
    name: string | null;
    into?: Into;
  };
  protected override storeEvents: string[] = [];
  private drawn?: object;
  private pointed: number | null = null;
  private grip: { x: number; y: number } | null = null;
  private listing?: ProgramList;
  private readonly finder = new Finder(
    () => this.store,
    () => this.viewed.text,
    () => {
      this.listing?.mark(this.finder.found);
      this.requestUpdate();
    },
  );
  /** The last move of every line that makes one. */
  private moveAt = new Map<number, number>();
  /** The user's inputs; if empty, the program is read as it is. */
  private own: ProgramKnown = {};
  /** Its run; `null` until it has run, and if the text is too long. */
  private ran: Ran | null = null;
  /** Aborts the run in a worker when another one starts. */
  private running: AbortController | null = null;
  private readonly panel = new RunPanel(
    () => this.store,
    (known) => {
      keepKnown(this.viewed.name, known);
      this.runs(known);
      this.drawn = undefined;
      this.requestUpdate();
    },
    (line) => {
      const move = this.moveAt.get(line);
      if (move === undefined) this.listing?.light(line, true);
      else this.point(move);
    },
    (job) =>
      this.dispatchEvent(
        new CustomEvent("adopt", { detail: job, bubbles: true }),
      ),
  );

  /** Moves that touch, counted from 1. */
  private touches: number[] = [];
  private readonly timeline = new Timeline(
    this,
    "timeline-program",
    () => this.store,
    this.timelineRun(),
    (act) => this.drawing?.use(act),
    () => this.requestUpdate(),
  );
  /** Notes about lines: findings, and rules that they break. */
  private notes = new Map<number, string[]>();
  /** Letters and numbers in the margin, by line. */
  private marks = new Map<number, Mark>();
  /** Notes about the current line. */
  private noted: string[] = [];

  private timelineRun(): Run {
    const self = this;
    return {
      get count() {
        return self.moves.kind.length;
      },
      get at() {
        return self.pointed;
      },
      get touches() {
        return self.touches;
      },
      chapters: [],
      point: (move) => self.point(move),
      words: (move) => (move === null ? self.says() : self.one(move)),
    };
  }

  /** The moves that are shown. */
  private get moves(): ProgramMoves {
    return this.shown && this.ran ? this.ran.run : this.viewed.moves;
  }

  /** Whether the run is shown: if it knows more than the text, or makes more moves, such as those of macros. */
  private get shown(): boolean {
    return (
      this.knows ||
      (this.ran?.run.kind.length ?? 0) > this.viewed.moves.kind.length
    );
  }

  /** Whether there are any inputs. */
  private get knows(): boolean {
    const { set = {}, start, part = {} } = this.ran?.known ?? {};
    return (
      Object.keys(set).length > 0 ||
      start !== undefined ||
      Object.keys(part).length > 0
    );
  }

  /** Runs the program with the inputs, a long one in a worker. The previous state stays until the run has finished. */
  private runs(own: ProgramKnown): void {
    this.own = own;
    this.running?.abort();
    this.running = null;
    const { text, moves } = this.viewed;
    const isLong =
      text.length > LONG_TEXT ||
      (this.ran?.run ?? moves).kind.length > MANY_MOVES;
    if (text.length > LONGEST_RUN) this.takes(null);
    else if (!isLong) this.takes(runText(text, own));
    else this.runsBeside(text, own);
  }

  private runsBeside(text: string, own: ProgramKnown): void {
    const running = new AbortController();
    const task = { run: text, known: own };
    const answer = askFor(this, task, running.signal);
    this.running = running;
    this.takes(this.ran);
    const take = (ran: Ran) => {
      if (running.signal.aborted) return;
      this.running = null;
      this.takes(ran);
      this.drawn = undefined;
      this.requestUpdate();
    };
    (answer ?? Promise.reject()).then(take, () => {
      if (!running.signal.aborted) take(runText(text, own));
    });
  }

  /** Shows a run, or only the moves that were read. */
  private takes(ran: Ran | null): void {
    this.timeline.pause();
    this.ran = ran;
    this.pointed = null;
    const { line, kind, kinds } = this.moves;
    const ownFile = (move: number) =>
      !this.ran?.run.file.length || this.ran.run.file[move] === 0;
    this.moveAt = new Map(
      Array.from(line, (at, move): [number, number] => [
        ownFile(move) ? at : -1,
        move,
      ]),
    );
    const touches: number[] = [];
    const numbers = new Map<number, [first: number, last: number]>();
    kind.forEach((is, move) => {
      if (kinds[is] !== "probe") return;
      touches.push(move + 1);
      if (!ownFile(move)) return;
      const at = line[move] as number;
      const number = touches.length;
      numbers.set(at, [numbers.get(at)?.[0] ?? number, number]);
    });
    this.touches = touches;
    this.notes = this.said();
    this.marks = this.marked(numbers);
    this.dispatchEvent(new CustomEvent("shown", { detail: this.moves }));
    this.noted = [];
  }

  /** Notes about each line. */
  private said(): Map<number, string[]> {
    const notes = new Map<number, string[]>();
    const { findings = [] } = this.ran?.run ?? {};
    const say = (lines: number[], text: string) => {
      for (const line of lines)
        notes.set(line, [...(notes.get(line) ?? []), text]);
    };
    for (const finding of findings) say(finding.lines, this.message(finding));
    for (const { holds, said, lines } of this.ran?.plain.rules ?? [])
      if (holds === false) say(lines, this.store.say(said));
    return notes;
  }

  /** Marks for the margin: letters of faults and numbers of touches, as in list and picture. `numbers`: first and last touch of each line. */
  private marked(numbers: Map<number, [number, number]>): Map<number, Mark> {
    const marks = new Map<number, Mark>();
    const faults = brokenOf(this.ran?.plain.rules);
    faults.forEach(({ lines }, k) => {
      for (const line of lines) {
        const before = marks.get(line)?.faults;
        const letters = before ? `${before} ${letter(k)}` : letter(k);
        marks.set(line, { faults: letters, touch: "" });
      }
    });
    for (const [line, [first, last]] of numbers)
      marks.set(line, {
        faults: marks.get(line)?.faults ?? "",
        touch: first === last ? `${first}` : `${first}…${last}`,
      });
    return marks;
  }

  /** Notes about a line, and its move. */
  private pointLine(line: number | null): void {
    const noted = line === null ? [] : (this.notes.get(line) ?? []);
    if (noted.length > 0 || this.noted.length > 0) {
      this.noted = noted;
      this.requestUpdate();
    }
    this.point(line === null ? null : (this.moveAt.get(line) ?? null));
  }

  static override properties = { viewed: { attribute: false } };

  override render(): TemplateResult {
    // The reason why there is no job comes last: users open a program for its faults and positions. What the run understands is not reported as unknown.
    const runs = this.moves.kind.length > 0;
    const why = this.viewed.why.filter(
      ({ code }) => !runs || code !== "not-understood",
    );
    const notes = [...this.moves.findings, ...why];
    const said = notes.map((finding) => this.message(finding));
    return html`
      <div class="see">
      ${this.tools(this.t("Picture of the program"))}
        <div class="canvas">
          <canvas tabindex="0" role="img" aria-label=${this.says()} @pointerdown=${this.down} @pointermove=${this.move}
            @pointerup=${this.up} @pointercancel=${this.up} @dblclick=${() => this.drawing?.use((view) => view.fit())} @keydown=${(e: KeyboardEvent) => this.drawing?.key(e)}></canvas>
          <canvas class="over" aria-hidden="true"></canvas>
        </div>
        <ul class="key" aria-label=${this.t("Kinds of lines")}>
          ${kind("touch", this.t("probing"))}${kind("link", this.t("feed"))}${kind("rapid", this.t("rapid"))}
        </ul>
        ${this.timeline.render()}
      </div>
      <div class="said">${this.viewed.into ? this.insertion(this.viewed.into) : nothing}${
        this.running
          ? html`<p class="running" aria-live="polite">${this.t("The program is being run …")}</p>`
          : nothing
      }${
        this.ran ? this.panel.render(this.own, this.ran, said) : noteList(said)
      }</div>
      <div class="read" @keydown=${this.key}>
        <div class="tools">${this.finder.render()}${this.headings()}</div>
        <div class="code listing"></div>
        ${this.noted.length > 0 ? html`<ul class="notes" role="status">${this.noted.map((note) => html`<li>${note}</li>`)}</ul>` : nothing}
      </div>
    `;
  }

  /** Where the program of the job is in this one. */
  private insertion(now: Into): TemplateResult {
    const file = { text: now.other, isUtf8: now.isUtf8 };
    const put = (line: number) =>
      this.tell("put", into(this.store, file, now.name, line));
    return insertPanel(this.store, now, put, () => this.tell("save", now));
  }

  private tell(event: string, detail: Into): void {
    this.dispatchEvent(new CustomEvent(event, { detail }));
  }

  /** Headings of the program to jump to. */
  private headings(): TemplateResult | typeof nothing {
    const outline = this.ran?.run.outline ?? [];
    if (outline.length < 2) return nothing;
    const go = (event: Event) => {
      const select = event.target as HTMLSelectElement;
      if (select.value !== "") this.listing?.light(Number(select.value), true);
      select.value = "";
    };
    return html`<select class="headings" aria-label=${this.t("Go to")} @change=${go}><option value="">${this.t("Go to")}</option>${outline.map(({ line, name }) => html`<option value=${line}>${line + 1}: ${name}</option>`)}</select>`;
  }

  override disconnectedCallback(): void {
    super.disconnectedCallback();
    this.timeline.pause();
    this.running?.abort();
    this.drawn = undefined;
    this.listing?.free();
    this.listing = undefined;
  }

  protected override willUpdate(changed: PropertyValues): void {
    if (!changed.has("viewed")) return;
    this.panel.begin();
    this.ran = null;
    this.runs(knownOf(this.viewed.name));
    this.finder.again();
  }

  /** The program by lines; the line of the current move is highlighted. */
  private list(): void {
    const { text } = this.viewed;
    const { moves } = this;
    if (!this.listing) {
      const box = this.querySelector<HTMLElement>(".listing") as HTMLElement;
      const point = (line: number | null) => this.pointLine(line);
      this.listing = new ProgramList(box, () => this.t("The program"), point);
    }
    if (this.drawn !== this.viewed) {
      const kind = (line: number) => {
        const move = this.moveAt.get(line);
        if (move === undefined) return "plain";
        return moves.kinds[moves.kind[move] as number] === "probe"
          ? "touch"
          : "";
      };
      const { notes, marks } = this;
      this.listing.show({ text, kind, notes, marks });
      this.listing.mark(this.finder.found);
    }
    const line =
      this.pointed === null ? -1 : (moves.line[this.pointed] as number);
    this.listing.label();
    this.listing.light(line, !this.querySelector(".listing:hover"));
    const inserted = this.viewed.into?.made?.first;
    if (this.drawn !== this.viewed && inserted !== undefined)
      this.listing.light(inserted, true);
  }

  /** Ctrl+F: the browser would search only the visible lines. */
  private key(event: KeyboardEvent): void {
    if (
      !this.listing?.edits ||
      !(event.ctrlKey || event.metaKey) ||
      event.altKey ||
      letterOf(event) !== "f"
    )
      return;
    event.preventDefault();
    this.querySelector<HTMLInputElement>("input.filter")?.focus();
  }

  protected override updated(_changed: PropertyValues): void {
    // An element outside of the page is drawn when it is added again.
    if (!this.isConnected) return;
    const fresh = !this.drawing;
    if (!this.drawing) {
      const canvas = this.canvas();
      this.drawing = new Drawing(
        canvas,
        (view) => {
          view.look(this.look);
          view.setLabels([], [], this.store.comma);
          this.show(view);
        },
        this.over(),
      );
      this.observer.observe(canvas);
    }
    this.drawing?.use((view) => {
      view.setLabels([], [], this.store.comma);
      if (this.drawn !== this.viewed && !fresh) this.show(view);
      if (this.drawn !== this.viewed) this.timeline.take(view.times());
      if (!this.timeline.plays) view.highlight(this.pointed ?? undefined);
      this.querySelector(".key")?.classList.toggle("solid", view.isLong());
    });
    this.timeline.mark();
    this.timeline.light();
    this.list();
    this.drawn = this.viewed;
  }

  private show(view: PageView): void {
    if (this.shown && this.ran) {
      const { run, known, wrong } = this.ran;
      const { part: _, ...rest } = known;
      view.showRun(run, wrong.length > 0 ? rest : known);
    } else view.showProgram(this.viewed.text);
  }

  private says(): string {
    const { kind, kinds, units } = this.moves;
    const probing = kind.filter((k) => kinds[k] === "probe").length;
    const said: Message[] = [units ? [units] : [w("units not stated")]];
    return this.t(
      "{count} moves, {probing} of them probing; {units}; read as {dialect}",
      kind.length,
      probing,
      ...said,
      readAs(this.moves),
    );
  }

  private one(index: number): string {
    const { to, kind, kinds, feed, line } = this.moves;
    const place = ["X", "Y", "Z"].flatMap((axis, i) => {
      const x = to[3 * index + i] as number;
      return Number.isNaN(x) ? [] : [`${axis}${Number(x.toFixed(4))}`];
    });
    const rate = feed[index] as number;
    const what: Message = [
      KINDS[kinds[kind[index] as number] as keyof typeof KINDS],
    ];
    const row = (line[index] as number) + 1;
    return Number.isNaN(rate)
      ? this.t("Line {line}: {what} to {place}", row, what, place.join(" "))
      : this.t(
          "Line {line}: {what} to {place} at {feed}",
          row,
          what,
          place.join(" "),
          rate,
        );
  }

  private down(event: PointerEvent): void {
    this.canvas().setPointerCapture(event.pointerId);
    this.grip = { x: event.offsetX, y: event.offsetY };
  }

  private move(event: PointerEvent): void {
    const { offsetX: x, offsetY: y } = event;
    if (this.grip) {
      const [dx, dy] = [x - this.grip.x, y - this.grip.y];
      this.drawing?.use((view) => view.pan(dx, dy));
      this.grip = { x, y };
      return;
    }
    this.point(this.drawing?.use((view) => view.pick(x, y)) ?? null);
  }

  private point(pointed: number | null): void {
    if (pointed === this.pointed) return;
    this.pointed = pointed;
    this.requestUpdate();
  }

  private up(): void {
    this.grip = null;
  }
}

customElements.define("tp-viewer", ViewerPart);
