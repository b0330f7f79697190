import { html, nothing, type TemplateResult } from "lit";
import type { PageView } from "../core/browser.js";
import {
  clockOf,
  moveInShort,
  moveInWords,
  pathInWords,
  runInWords,
} from "../sentences.js";
import type { Store } from "../store.js";

/** How many times as fast as the machine the run is played. */
const SPEEDS = [1, 4, 16] as const;

/** The width of the slider's thumb, pixels; the style sheet knows the same width. */
const THUMB = 16;

/** The run under the picture: played by its feeds, gone through move by move and touch by touch, and said in words. */
export class Timeline {
  /** The seconds that each move takes, and their sum. */
  private times: Float64Array = new Float64Array();
  private whole = 0;
  /** The seconds of the run that are over; null where nothing plays. */
  private clock: number | null = null;
  private speed: (typeof SPEEDS)[number] = 1;
  private frameAsked = 0;
  /** The marks of the touches on the rail. */
  private marks = "";

  /** In the part `box`, which renders it and is rendered again when it has `changed`; `use` draws. */
  constructor(
    private readonly box: HTMLElement,
    private readonly store: () => Store,
    private readonly use: (act: (view: PageView) => void) => void,
    private readonly changed: () => void,
  ) {}

  /** Whether the run is played now. */
  get plays(): boolean {
    return this.clock !== null;
  }

  /** Takes how long the moves of another run take. */
  take(times: Float64Array): void {
    this.times = times;
    this.whole = this.until(times.length);
  }

  render(): TemplateResult {
    const { count } = this;
    const faster = (event: Event) => {
      event.preventDefault();
      this.faster();
    };
    return html`<div class="scrub" role="group" aria-label=${this.t("Timeline")} @keydown=${this.key}>
        <button type="button" class="play" aria-label=${this.plays ? this.t("Pause") : this.t("Play")} title=${this.t("Play, pause (Space). Speed: S, or a right click")} ?disabled=${count === 0} @click=${this.toggle} @contextmenu=${faster}>${this.plays ? "❚❚" : "▶"}</button>
        <span class="track">
          <input id="scrub" type="range" min="0" max=${count} aria-label=${this.t("Move")} @input=${(e: Event) => this.step(Number((e.target as HTMLInputElement).value))} />
        </span>
        <output for="scrub"></output><span class="clock" aria-hidden="true"></span>${this.speed === 1 ? nothing : html`<span class="speed" aria-hidden="true">${this.speed}×</span>`}
      </div>`;
  }

  /** Marks the touches on the rail at the positions of the thumb, and in a set-up the start of each cycle. */
  mark(): void {
    const { count } = this;
    const track = this.box.querySelector<HTMLElement>(".track");
    const mark = (t: number) =>
      `var(--tick) calc(${THUMB / 2}px + (100% - ${THUMB}px) * ${t / count}) 50% / 2px 12px`;
    const chapter = (t: number) =>
      `var(--chapter) calc(${THUMB / 2}px + (100% - ${THUMB}px) * ${t / count}) 50% / 1px 100%`;
    const marks =
      count === 0
        ? ""
        : [...this.chapters.map(chapter), ...this.touches.map(mark)].join(", ");
    if (!track || marks === this.marks) return;
    this.marks = marks;
    track.style.background = marks;
  }

  /** Says the move that is pointed at. */
  light(): void {
    const scrub = this.box.querySelector<HTMLInputElement>("#scrub");
    const words = this.box.querySelector("output");
    if (!scrub || !words) return;
    scrub.value = String(this.at);
    scrub.setAttribute("aria-valuetext", this.says(moveInWords));
    words.classList.toggle("rest", this.at === 0);
    words.textContent =
      this.at === 0 && !this.store().stale
        ? this.rest(pathInWords)
        : this.says(moveInShort);
    this.tell();
  }

  pause(): void {
    if (!this.plays) return;
    cancelAnimationFrame(this.frameAsked);
    this.clock = null;
    this.changed();
  }

  /** How many moves there are: of a form with errors the last good plan is there to be seen, and not to be stepped through. */
  private get count(): number {
    const { stale, plan } = this.store();
    return stale ? 0 : plan.moves.length;
  }

  /** The move that is pointed at, counted from 1; 0 is none. */
  private get at(): number {
    const { highlight } = this.store();
    return highlight === null || this.count === 0 ? 0 : highlight + 1;
  }

  /** The touches among the moves, counted from 1. */
  private get touches(): number[] {
    return this.store().plan.moves.flatMap((move, i) =>
      move.kind === "touch" ? [i + 1] : [],
    );
  }

  /** Of a set-up, after how many moves each cycle but the first begins. */
  private get chapters(): number[] {
    const { moves } = this.store().plan;
    return moves.flatMap(({ cycle }, i) =>
      i > 0 && cycle !== moves[i - 1]?.cycle ? [i] : [],
    );
  }

  /** The seconds of the first so many moves. */
  private until(moves: number): number {
    return this.times
      .subarray(0, moves)
      .reduce((sum, seconds) => sum + seconds, 0);
  }

  /** The move that is pointed at in words, or else what the run comes to. */
  private says(inWords: typeof moveInShort): string {
    const store = this.store();
    if (store.stale)
      return this.collides ? this.t("The run ends in the part") : "";
    return this.at > 0 ? inWords(store, this.at - 1) : this.rest(runInWords);
  }

  /** What the run comes to, and that it ends before on the virtual part. */
  private rest(inWords: typeof runInWords): string {
    const words = inWords(this.store());
    return this.collides
      ? `${words} · ${this.t("The run ends in the part")}`
      : words;
  }

  private get collides(): boolean {
    return this.store().findings.some(({ code }) => code === "collision");
  }

  /** Tells the seconds of the run that are over, while it plays or up to the move that is pointed at. */
  private tell(): void {
    const clock = this.box.querySelector(".clock");
    if (!clock) return;
    const over = this.clock ?? this.until(this.at);
    clock.textContent =
      this.count === 0 ? "" : `${clockOf(over)} / ${clockOf(this.whole)}`;
  }

  /** To a move, counted from 1; 0 is none. */
  private step(count: number): void {
    this.pause();
    this.store().pin(count === 0 ? null : count - 1);
  }

  /** To the next touch, or the one before; from the last one to the end. */
  private toTouch(way: 1 | -1): void {
    const { at, touches } = this;
    const next =
      way > 0 ? touches.find((t) => t > at) : touches.findLast((t) => t < at);
    this.step(next ?? (way > 0 ? this.count : 0));
  }

  private readonly key = (event: KeyboardEvent): void => {
    const target = event.target as HTMLElement;
    if (event.key === "Escape") this.store().pin(null);
    else if (event.key === " " && target.id === "scrub") this.toggle();
    else if (/^s$/i.test(event.key) && !event.ctrlKey && !event.metaKey)
      this.faster();
    else if (event.ctrlKey && event.key === "ArrowRight" && this.count > 0)
      this.toTouch(1);
    else if (event.ctrlKey && event.key === "ArrowLeft" && this.count > 0)
      this.toTouch(-1);
    else return;
    event.preventDefault();
  };

  private readonly faster = (): void => {
    this.speed = SPEEDS[
      (SPEEDS.indexOf(this.speed) + 1) % SPEEDS.length
    ] as (typeof SPEEDS)[number];
    this.changed();
  };

  private readonly toggle = (): void => {
    if (this.plays) {
      this.pause();
      return;
    }
    if (this.count === 0) return;
    this.clock = this.until(this.at >= this.count ? 0 : this.at);
    let before = performance.now();
    const still = matchMedia("(prefers-reduced-motion: reduce)").matches;
    const tick = (now: number) => {
      if (this.clock === null) return;
      // Nothing plays that is not seen.
      if (this.box.closest("[hidden]")) {
        this.pause();
        return;
      }
      this.clock += ((now - before) / 1000) * this.speed;
      before = now;
      let left = this.clock;
      let move = 0;
      while (move < this.times.length && left >= (this.times[move] as number))
        left -= this.times[move++] as number;
      if (move >= this.times.length) {
        this.pause();
        this.store().pin(this.times.length - 1);
        return;
      }
      this.store().pin(move);
      this.tell();
      // Where motion is not wanted the ball is shown at the ends of the moves only.
      this.use((view) =>
        view.play(move, still ? 1 : left / (this.times[move] as number)),
      );
      this.frameAsked = requestAnimationFrame(tick);
    };
    this.frameAsked = requestAnimationFrame(tick);
    this.changed();
  };

  private t(template: string, ...values: (string | number)[]): string {
    return this.store().t(template, ...values);
  }
}
