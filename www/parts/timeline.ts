import { html, nothing, type TemplateResult } from "lit";
import type { PageView } from "../core/browser.js";
import { clockOf } from "../sentences.js";
import type { Store } from "../store.js";

/** Playback speeds, relative to the machine. */
const SPEEDS = [1, 4, 16] as const;

/** Playback time of a move with an unknown feed or position, seconds. */
const UNKNOWN_TIME = 0.5;

/** Maximum number of marks; more would merge into a bar. */
const MOST_MARKS = 200;

/** Width of the slider's thumb, pixels; the style sheet uses the same width. */
const THUMB = 16;

/** Moves of a timeline: those of a plan or of an opened program. */
export interface Run {
  /** Number of moves; 0 if there is a picture but nothing to step through. */
  readonly count: number;
  /** The current move, from 0; null without one. */
  readonly at: number | null;
  /** Moves that touch, counted from 1. */
  readonly touches: number[];
  /** Numbers of moves after which another cycle begins. */
  readonly chapters: number[];
  /** Sets the current move. Without an argument no move is current. */
  point(move: number | null): void;
  /** A move in words, or the whole run; `short` fits under the slider. */
  words(move: number | null, short: boolean): string;
}

/** Timeline of a run: plays it by its feeds, steps through moves and touches, and describes them. */
export class Timeline {
  /** Duration of each move in seconds, NaN if unknown, and their sum. */
  private times: Float64Array = new Float64Array();
  private whole = 0;
  /** Elapsed seconds of the run; null while nothing plays. */
  private clock: number | null = null;
  private speed: (typeof SPEEDS)[number] = 1;
  private frameAsked = 0;
  /** Marks of the touches on the slider. */
  private marks = "";

  /** `box` is the part that renders the timeline, and renders again after `changed`; `use` gives access to the drawing. `id` is the id of the slider. */
  constructor(
    private readonly box: HTMLElement,
    private readonly id: string,
    private readonly store: () => Store,
    private readonly run: Run,
    private readonly use: (act: (view: PageView) => void) => void,
    private readonly changed: () => void,
  ) {}

  /** Whether the run is playing. */
  get plays(): boolean {
    return this.clock !== null;
  }

  /** Sets the durations of another run's moves. */
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

  /** Marks the touches on the slider at the positions of the thumb, and in a set-up the start of each cycle. */
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

  /** Describes the current move. */
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

  /** The current move, from 1; 0 without one. */
  private get at(): number {
    return (this.run.at ?? -1) + 1;
  }

  /** Duration of the first moves, seconds. */
  private until(moves: number): number {
    return this.times
      .subarray(0, moves)
      .reduce((sum, seconds) => sum + seconds, 0);
  }

  /** Playback time of a move, seconds. */
  private secondsOf(move: number): number {
    const seconds = this.times[move] as number;
    return Number.isNaN(seconds) ? UNKNOWN_TIME : seconds;
  }

  /** Shows the elapsed time while the run plays or up to the current move. */
  private tell(): void {
    const clock = this.box.querySelector(".clock");
    if (!clock) return;
    const over = this.clock ?? this.until(this.at);
    clock.textContent =
      this.run.count === 0 || Number.isNaN(this.whole)
        ? ""
        : `${clockOf(over)} / ${clockOf(this.whole)}`;
  }

  /** Goes to a move, counted from 1; 0 is the start. */
  private step(count: number): void {
    this.pause();
    this.run.point(count === 0 ? null : count - 1);
  }

  /** Goes to the next or previous touch; from the last one to the end. */
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
    // The playing move and its elapsed seconds.
    let move = this.at >= count ? 0 : this.at;
    let over = 0;
    this.clock = this.until(move);
    let before = performance.now();
    const still = matchMedia("(prefers-reduced-motion: reduce)").matches;
    const tick = (now: number) => {
      if (this.clock === null) return;
      // A hidden timeline stops.
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
      // With reduced motion the ball is only shown at the ends of the moves.
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
