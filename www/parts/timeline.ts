import { html, nothing, type TemplateResult } from "lit";
import type { PageView } from "../core/browser.js";
import { clockOf } from "../sentences.js";
import type { Store } from "../store.js";

/** How many times as fast as the machine the run is played. */
const SPEEDS = [1, 4, 16] as const;

/** A move whose feed or position is not known is played in this many seconds. */
const UNKNOWN_TIME = 0.5;

/** More marks than this would be a bar. */
const MOST_MARKS = 200;

/** The width of the slider's thumb, pixels; the style sheet knows the same width. */
const THUMB = 16;

/** The moves that a timeline runs over: those of a plan, or of an opened program. */
export interface Run {
  /** Number of moves; 0 if there is a picture but nothing to step through. */
  readonly count: number;
  /** The move that is pointed at, from 0; null if none. */
  readonly at: number | null;
  /** The touches among the moves, counted from 1. */
  readonly touches: number[];
  /** Numbers of moves after which another cycle begins. */
  readonly chapters: number[];
  /** Points at a move, or at none. */
  point(move: number | null): void;
  /** A move in words, or the whole run; `short` is what has room under the rail. */
  words(move: number | null, short: boolean): string;
}

/** The run under the picture: played by its feeds, stepped through by moves and touches, and put into words. */
export class Timeline {
  /** The seconds that each move takes, NaN if not known, and their sum. */
  private times: Float64Array = new Float64Array();
  private whole = 0;
  /** The seconds of the run that are over; null where nothing plays. */
  private clock: number | null = null;
  private speed: (typeof SPEEDS)[number] = 1;
  private frameAsked = 0;
  /** The marks of the touches on the rail. */
  private marks = "";

  /** In the part `box`, which renders it and is rendered again when it has `changed`; `use` draws. `id` names the slider. */
  constructor(
    private readonly box: HTMLElement,
    private readonly id: string,
    private readonly store: () => Store,
    private readonly run: Run,
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
    const { count } = this.run;
    const faster = (event: Event) => {
      event.preventDefault();
      this.faster();
    };
    return html`<div class="timeline" role="group" aria-label=${this.t("Timeline")} @keydown=${this.key}>
        <button type="button" class="play" aria-label=${this.plays ? this.t("Pause") : this.t("Play")} title=${this.t("Play, pause (Space). Speed: S, or a right click")} ?disabled=${count === 0} @click=${this.toggle} @contextmenu=${faster}>${this.plays ? "❚❚" : "▶"}</button>
        <span class="track">
          <input id=${this.id} type="range" min="0" max=${count} aria-label=${this.t("Move")} @input=${(e: Event) => this.step(Number((e.target as HTMLInputElement).value))} />
        </span>
        <output for=${this.id}></output><span class="clock" aria-hidden="true"></span>${this.speed === 1 ? nothing : html`<span class="speed" aria-hidden="true">${this.speed}×</span>`}
      </div>`;
  }

  /** Marks the touches on the rail at the positions of the thumb, and in a set-up the start of each cycle. */
  mark(): void {
    const { count, chapters, touches } = this.run;
    const track = this.box.querySelector<HTMLElement>(".track");
    const mark = (t: number) =>
      `var(--tick) calc(${THUMB / 2}px + (100% - ${THUMB}px) * ${t / count}) 50% / 2px 12px`;
    const chapter = (t: number) =>
      `var(--chapter) calc(${THUMB / 2}px + (100% - ${THUMB}px) * ${t / count}) 50% / 1px 100%`;
    const marks =
      count === 0
        ? ""
        : [
            ...chapters.map(chapter),
            ...(touches.length > MOST_MARKS ? [] : touches.map(mark)),
          ].join(", ");
    if (!track || marks === this.marks) return;
    this.marks = marks;
    track.style.background = marks;
  }

  /** Says the move that is pointed at. */
  light(): void {
    const slider = this.box.querySelector<HTMLInputElement>(`#${this.id}`);
    const words = this.box.querySelector("output");
    if (!slider || !words) return;
    const { at } = this.run;
    slider.value = String(this.at);
    slider.setAttribute("aria-valuetext", this.run.words(at, false));
    words.classList.toggle("rest", at === null);
    words.textContent = this.run.words(at, true);
    this.tell();
  }

  pause(): void {
    if (!this.plays) return;
    cancelAnimationFrame(this.frameAsked);
    this.clock = null;
    this.changed();
  }

  /** The move that is pointed at, counted from 1; 0 is none. */
  private get at(): number {
    return (this.run.at ?? -1) + 1;
  }

  /** The seconds of the first so many moves. */
  private until(moves: number): number {
    return this.times
      .subarray(0, moves)
      .reduce((sum, seconds) => sum + seconds, 0);
  }

  /** The seconds in which a move is played. */
  private secondsOf(move: number): number {
    const seconds = this.times[move] as number;
    return Number.isNaN(seconds) ? UNKNOWN_TIME : seconds;
  }

  /** Tells the seconds of the run that are over, while it plays or up to the move that is pointed at. */
  private tell(): void {
    const clock = this.box.querySelector(".clock");
    if (!clock) return;
    const over = this.clock ?? this.until(this.at);
    clock.textContent =
      this.run.count === 0 || Number.isNaN(this.whole)
        ? ""
        : `${clockOf(over)} / ${clockOf(this.whole)}`;
  }

  /** To a move, counted from 1; 0 is none. */
  private step(count: number): void {
    this.pause();
    this.run.point(count === 0 ? null : count - 1);
  }

  /** To the next touch, or the one before; from the last one to the end. */
  private toTouch(way: 1 | -1): void {
    const { at } = this;
    const { touches, count } = this.run;
    const next =
      way > 0 ? touches.find((t) => t > at) : touches.findLast((t) => t < at);
    this.step(next ?? (way > 0 ? count : 0));
  }

  private readonly key = (event: KeyboardEvent): void => {
    const target = event.target as HTMLElement;
    if (event.key === "Escape") this.run.point(null);
    else if (event.key === " " && target.id === this.id) this.toggle();
    else if (/^s$/i.test(event.key) && !event.ctrlKey && !event.metaKey)
      this.faster();
    else if (event.ctrlKey && event.key === "ArrowRight" && this.run.count > 0)
      this.toTouch(1);
    else if (event.ctrlKey && event.key === "ArrowLeft" && this.run.count > 0)
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
    const { count } = this.run;
    if (count === 0) return;
    // The move that is played, and how much of it is over, seconds.
    let move = this.at >= count ? 0 : this.at;
    let over = 0;
    this.clock = this.until(move);
    let before = performance.now();
    const still = matchMedia("(prefers-reduced-motion: reduce)").matches;
    const tick = (now: number) => {
      if (this.clock === null) return;
      // Nothing plays that is not seen.
      if (this.box.closest("[hidden]")) {
        this.pause();
        return;
      }
      const passed = ((now - before) / 1000) * this.speed;
      this.clock += passed;
      over += passed;
      before = now;
      while (move < count && over >= this.secondsOf(move))
        over -= this.secondsOf(move++);
      if (move >= count) {
        this.pause();
        this.run.point(count - 1);
        return;
      }
      this.run.point(move);
      this.tell();
      // Where motion is not wanted the ball is shown at the ends of the moves only.
      const part = still ? 1 : over / this.secondsOf(move);
      this.use((view) => view.play(move, part));
      this.frameAsked = requestAnimationFrame(tick);
    };
    this.frameAsked = requestAnimationFrame(tick);
    this.changed();
  };

  private t(template: string, ...values: (string | number)[]): string {
    return this.store().t(template, ...values);
  }
}
