import { html, nothing, type PropertyValues, type TemplateResult } from "lit";
import {
  awaited,
  type PageView,
  type Plan,
  type Vec3,
} from "../core/browser.js";
import { tidy } from "../number.js";
import { deviations, rateOf } from "../sentences.js";
import { DrawnPart } from "./canvas-part.js";
import { Drawing, label, type VIEWS } from "./drawing.js";
import { nominal } from "./findings.js";
import { kind } from "./legend.js";
import { PlanRun } from "./plan-run.js";
import { Timeline } from "./timeline.js";

/** A position on the canvas, CSS pixels. */
type Spot = { x: number; y: number };
/** A dimension line: path of its field, and its ends in pixels. */
type Line = [string, number, number, number, number];
/** Magnifications of deviations. */
const MAGNIFIED = [1, 10, 100] as const;

/** An end of a dimension line, with its field. */
interface End {
  field: string;
  index: 0 | 1;
}

/** Grip distance of handles and ends, pixels. For a finger they are targets of 44 pixels. */
const REACH = { handle: 14, end: 12, finger: 22 } as const;

/** Upper bound of a magnified rotation, degrees: a larger one would look like another part. */
const MOST_TURNED = 20;

/** The picture with its tools: views, zoom, editable dimensions and the timeline. */
class PicturePart extends DrawnPart {
  protected override storeEvents = ["change", "focus"];
  protected override lights = true;
  /** Form in the picture, as revision and language. A highlight redraws the picture but does not plan it again. */
  private drawn = "";
  /** Whether the picture shows a form with an error: a run that ends in a collision. */
  private live = false;
  private pointers = new Map<number, Spot>();
  /** The dragged handle, and the grip position relative to its middle. */
  private grip: { handle: string; x: number; y: number } | null = null;
  /** The dragged end of a dimension, and the grip position. */
  private end: (End & { at: Spot }) | null = null;
  private dragged = false;
  /** End of the frame in which a drag was planned last, and the pointer position since then. */
  private planned = 0;
  private pulled: Spot | null = null;
  private readonly timeline = new Timeline(
    this,
    "timeline",
    () => this.store,
    new PlanRun(() => this.store),
    (act) => this.drawing?.use(act),
    () => this.requestUpdate(),
  );
  private magnified: (typeof MAGNIFIED)[number] = 1;
  /** Whether the picture must be fitted after a change of the magnification. */
  private refit = false;

  /**
   * The field whose dimension is highlighted: the dragged one, else the focused one. None while the form has errors, because the last valid plan has other
   * dimensions.
   */
  private get lit(): string | undefined {
    if (this.store.stale && !this.live) return undefined;
    return this.end?.field ?? this.store.focused ?? undefined;
  }

  /** Whether handles are shown: those of the virtual part while its group is open or the part is displaced. Angle handles appear with them. */
  private get grips(): boolean {
    const { store } = this;
    const asked = /^part\.|Angle$|Length$/.test(store.focused ?? "");
    return (
      this.grip !== null ||
      store.partOpen ||
      asked ||
      deviations(store).length > 0
    );
  }

  /** The view of the picture. */
  get from(): (typeof VIEWS)[number] {
    return this.look;
  }

  set from(view: (typeof VIEWS)[number]) {
    if (view !== this.look) this.turn(view);
  }

  /** The picture as an SVG file in the language of the page. */
  svg(title: string): string | undefined {
    return this.drawing?.use((view) => {
      // The view may have changed without a redraw.
      view.look(this.look);
      return view.svg(title);
    });
  }

  override render(): TemplateResult {
    const { stale, blank } = this.store;
    const moves = this.store.plan.moves.length;
    const still = moves === 0 && !stale;
    return html`
      ${this.tools(this.t("Picture"))}
      <div class=${!stale || this.live ? "canvas" : blank ? "canvas blank" : "canvas stale"}>
        <canvas tabindex="0" role="img" aria-label=${this.describe()}
          @pointerdown=${this.down} @pointermove=${this.move} @pointerup=${this.up} @pointercancel=${this.cancel} @pointerleave=${this.leave} @click=${this.clicked}
          @dblclick=${() => this.drawing?.use((view) => view.fit())}
          @keydown=${(e: KeyboardEvent) => (e.key === "Escape" ? this.store.pin(null) : this.grip || this.end ? undefined : this.drawing?.key(e))}></canvas>
        <canvas class="over" aria-hidden="true"></canvas>
        ${awaited() ? html`<slot name="picture"></slot>` : nothing}
        <div class="stamps">
        ${stale ? html`<p class="banner" role="status">${this.live || blank ? this.t("No program: {why}", this.store.withheld ?? "") : this.t("The form has errors: showing the last valid plan")}</p>` : nothing}
        ${still ? html`<p class="banner idle">${this.t("This cycle has no motion: it only adds rows to the parameter table")}</p>` : this.deviates()}
        </div>
      </div>
      ${moves === 0 ? nothing : html`<ul class="key" aria-label=${this.t("Kinds of lines")}>${this.kinds()}</ul>`}
      ${still ? nothing : this.timeline.render()}
    `;
  }

  /** Kinds of lines in the picture. */
  private kinds(): TemplateResult[] {
    const { store } = this;
    const { moves } = store.plan;
    const has = (is: (move: Plan["moves"][number]) => boolean) =>
      moves.some(is);
    const isRapid = (move: Plan["moves"][number]) =>
      move.kind !== "touch" && rateOf(store, move.feed) === null;
    const links = ({ feed }: Plan["moves"][number]) =>
      feed === "longLink" || feed === "work";
    const goes = (as: (move: Plan["moves"][number]) => boolean) =>
      has((m) => m.kind !== "touch" && !isRapid(m) && as(m));
    const touches = moves.some((m) => m.kind === "touch");
    const kinds: [boolean, TemplateResult][] = [
      [touches, kind("touch", this.t("touch"))],
      [goes(links), kind("link", this.t("link, back"))],
      [goes((m) => !links(m)), kind("position", this.t("positioning"))],
      [has(isRapid), kind("rapid", this.t("rapid"))],
      [touches, kind("ghost", this.t("overtravel"))],
      [deviations(store).length > 0, kind("actual", this.t("virtual part"))],
      [
        store.measured.trim() !== "",
        html`<li class="points">${this.t("measured")}</li>`,
      ],
    ];
    return kinds.flatMap(([is, line]) => (is ? [line] : []));
  }

  override disconnectedCallback(): void {
    super.disconnectedCallback();
    this.timeline.pause();
    this.pointers.clear();
    this.release();
    this.drawn = "";
  }

  protected override updated(_changed: PropertyValues): void {
    const { shown, focused, revision, stale, job, features } = this.store;
    if (!this.drawing && this.isConnected) {
      const canvas = this.canvas();
      this.drawing = new Drawing(
        canvas,
        (view) => {
          view.look(this.look);
          label(view, this.store);
          view.setHand(this.store.features.inJob);
          view.magnify(this.magnified);
          if (!this.live || !view.show(this.store.job))
            view.show(this.store.shown);
          view.focus(this.lit);
          view.grips(this.grips);
          view.highlight(this.store.highlight ?? undefined);
          view.measure(this.store.measured);
        },
        this.over(),
      );
      this.observer.observe(canvas);
    }
    // A nominal part has nothing to magnify, and its handle returns.
    if (
      !this.grip &&
      (deviations(this.store).length === 0 ||
        !this.offered.includes(this.magnified))
    ) {
      this.refit ||= this.magnified !== 1;
      this.magnified = 1;
    }
    const now = `${revision} ${this.store.lang}`;
    const anew = this.drawn !== now;
    const before = this.live;
    if (anew) this.timeline.pause();
    this.drawing?.use((view) => {
      // Before fitting: magnified deviations take more room.
      view.magnify(this.magnified);
      if (anew) {
        label(view, this.store);
        // A job that collides, or that the control does not support, has a path but no program.
        view.setHand(features.inJob);
        this.live = stale && view.show(job);
        if (!this.live) view.show(shown);
        this.timeline.take(view.times());
      }
      view.focus(this.lit);
      view.grips(this.grips);
      view.measure(this.store.measured);
      if (this.refit) view.fit();
    });
    this.refit = false;
    if (!awaited()) this.drawn = now;
    this.timeline.mark();
    this.light();
    if (before !== this.live) this.requestUpdate();
    if (focused !== this.turnedFor) this.face(focused);
  }

  /** The field for which the view was changed last; a later choice of the user stays. */
  private turnedFor: string | null = null;

  /** Switches to a view in which the dimension of a field is visible. */
  private face(path: string | null): void {
    this.turnedFor = path;
    const look =
      path === null
        ? undefined
        : this.drawing?.use((view) => view.viewOf(path));
    if (look && look !== this.look && this.look !== "isometric")
      this.turn(look as (typeof VIEWS)[number]);
  }

  /** Shows the displacement without opening its group. */
  private deviates(): TemplateResult | typeof nothing {
    const off = deviations(this.store);
    if (off.length === 0) return nothing;
    const implausible = this.store.findings.find(
      ({ code }) => code === "implausible",
    );
    return html`<p class="part-note"><span title=${off.join(", ")}>${this.t("Virtual part")}: ${off.join(", ")}</span>
      ${implausible ? html`<b title=${this.store.say(implausible.said)}>${this.t("implausible")}</b>` : nothing}
      ${this.offered.length > 1 ? html`<button type="button" class="quiet" aria-label=${this.t("Deviations are drawn {times} times as large", this.magnified)} title=${this.t("Draw the deviations larger")} @click=${this.magnify}>${this.magnified === 1 ? "×1" : this.t("drawn ×{times}", this.magnified)}</button>` : nothing}
      ${nominal(this.store)}</p>`;
  }

  /** Highlights the current move in the picture, on the timeline and in words. */
  protected override light(): void {
    const { highlight, stale } = this.store;
    if (!this.timeline.plays)
      this.drawing?.use((view) =>
        view.highlight(
          stale && this.live ? undefined : (highlight ?? undefined),
        ),
      );
    this.timeline.light();
  }

  /** Magnifications that make sense for this part. */
  private get offered(): readonly (typeof MAGNIFIED)[number][] {
    const turn = Math.abs(Number(this.store.get("part.rotation") ?? 0));
    const offset =
      (this.store.get("part.offset") as unknown[] | undefined)?.map((x) =>
        Math.abs(Number(x)),
      ) ?? [];
    const { touches } = this.store.plan;
    // Span of the touches along the axis where it is largest.
    const spans = [0, 1, 2].map((i) => {
      const along = touches.map(({ point }) => point[i] as number);
      return Math.max(...along) - Math.min(...along);
    });
    const room = Math.max(...spans, 0) / 3 || Number.POSITIVE_INFINITY;
    const fits = (times: number) =>
      turn * times <= MOST_TURNED && Math.max(...offset, 0) * times <= room;
    return MAGNIFIED.filter((times) => times === 1 || fits(times));
  }

  private readonly magnify = (): void => {
    const { offered } = this;
    const next =
      offered[(offered.indexOf(this.magnified) + 1) % offered.length];
    this.magnified = next as (typeof MAGNIFIED)[number];
    this.refit = true;
    this.requestUpdate();
  };

  private frame(): HTMLElement {
    return this.querySelector(".canvas") as HTMLElement;
  }

  private describe(): string {
    const { plan } = this.store;
    return this.t(
      "Path of the probe, view: {view}. {moves} moves, {touches} touches. Arrow keys move the picture, plus and minus zoom, 0 fits.",
      [this.look],
      plan.moves.length,
      plan.touches.length,
    );
  }

  private at(event: PointerEvent | WheelEvent): Spot {
    const box = this.canvas().getBoundingClientRect();
    return { x: event.clientX - box.left, y: event.clientY - box.top };
  }

  private down(event: PointerEvent): void {
    const at = this.at(event);
    this.canvas().setPointerCapture(event.pointerId);
    this.pointers.set(event.pointerId, at);
    this.dragged = false;
    this.tapped = null;
    this.store.settle();
    if (this.pointers.size > 1) {
      this.release();
      return;
    }
    this.finger = event.pointerType === "touch";
    this.drawing?.use((view) => {
      const handle = this.store.readonly ? undefined : this.handleAt(view, at);
      const [x, y] = (handle && view.handleSpot(handle)) || [];
      if (handle && x !== undefined && y !== undefined)
        this.grip = { handle, x: at.x - x, y: at.y - y };
      else this.end = this.store.readonly ? null : this.gripped(view, at);
      if (this.grip || this.end) view.pin(true);
      view.focus(this.lit);
    });
    // Messages that come and go must not move the canvas under the pointer.
    if (this.grip || this.end)
      this.frame().style.cssText = `flex: none; height: ${this.frame().getBoundingClientRect().height}px`;
  }

  /** Whether the pointer is a finger. */
  private finger = false;

  private handleAt(view: PageView, at: Spot): string | undefined {
    return view.handleAt(at.x, at.y, this.finger ? REACH.finger : REACH.handle);
  }

  /** Releases the handle. */
  private release(): void {
    if (!this.grip && !this.end) return;
    this.caughtUp();
    this.grip = null;
    this.end = null;
    this.store.settle();
    this.frame().style.cssText = "";
    this.drawing?.use((view) => {
      view.pin(false);
      view.focus(this.lit);
    });
  }

  /** Effect of a handle, in words. */
  private handleInWords(view: PageView, handle: string | undefined): string {
    const part = { shift: "part.offset", turn: "part.rotation" }[handle ?? ""];
    const label =
      this.store.fieldAt(part ?? (handle && view.handleField(handle)) ?? "")
        ?.label ?? "";
    return part ? `${this.t("Virtual part")}: ${label}` : label;
  }

  private move(event: PointerEvent): void {
    const at = this.at(event);
    const before = this.pointers.get(event.pointerId);
    if (!before) {
      this.drawing?.use((view) => {
        const over = view.axisAt(at.x, at.y)
          ? "pointer"
          : view.dimensionAt(at.x, at.y)
            ? "text"
            : "";
        const handle = this.handleAt(view, at);
        const grips =
          handle || (!this.store.readonly && this.grippable(view, at));
        this.canvas().style.cursor = grips ? "grab" : over;
        this.canvas().title = this.handleInWords(view, handle);
        this.store.point(view.pick(at.x, at.y) ?? null);
      });
      return;
    }
    this.dragged ||= Math.hypot(at.x - before.x, at.y - before.y) > 2;
    if (this.pointers.size === 2) {
      const other = [...this.pointers].find(
        ([id]) => id !== event.pointerId,
      )?.[1];
      if (other) {
        const reach = (p: Spot) => Math.hypot(p.x - other.x, p.y - other.y);
        this.drawing?.use((view) => {
          view.zoom(
            reach(at) / Math.max(reach(before), 1),
            (at.x + other.x) / 2,
            (at.y + other.y) / 2,
          );
          view.pan((at.x - before.x) / 2, (at.y - before.y) / 2);
        });
      }
    } else if (this.end) {
      // Measured from the grip position, so that a slow drag counts too.
      this.dragged ||=
        Math.hypot(at.x - this.end.at.x, at.y - this.end.at.y) > 2;
      if (this.dragged) this.pull(at);
    } else if (this.grip) {
      this.pull(at);
    } else if (this.dragged) {
      this.drawing?.use((view) => view.pan(at.x - before.x, at.y - before.y));
    } else {
      return;
    }
    this.pointers.set(event.pointerId, at);
  }

  /** Moves the gripped handle to the pointer. Each step makes a plan, so there is at most one per frame, with the last position. */
  private pull(at: Spot): void {
    if (this.planned) {
      this.pulled = at;
      return;
    }
    this.planned = requestAnimationFrame(() => this.caughtUp());
    if (this.end) this.stretch(this.end.field, at);
    else if (this.grip)
      this.drag(this.grip.handle, {
        x: at.x - this.grip.x,
        y: at.y - this.grip.y,
      });
  }

  /** The drag has reached the pointer. */
  private caughtUp(): void {
    cancelAnimationFrame(this.planned);
    this.planned = 0;
    const at = this.pulled;
    this.pulled = null;
    if (at) this.pull(at);
  }

  /** The end of a dimension line at a pixel. */
  private endAt(view: PageView, at: Spot): End | null {
    if (this.look === "isometric" || (this.store.stale && !this.live))
      return null;
    const ends = (view.dimensionLines() as Line[]).flatMap(([field, ...line]) =>
      ([0, 1] as const).map((index) => {
        const [x, y] = line.slice(2 * index) as [number, number];
        return { field, index, far: Math.hypot(x - at.x, y - at.y) };
      }),
    );
    const near = ends.filter(
      ({ field, far }) =>
        far <= (this.finger ? REACH.finger : REACH.end) &&
        typeof this.store.get(field) === "number",
    );
    return near.sort((a, b) => a.far - b.far)[0] ?? null;
  }

  /** The end under the pointer last, and whether it can be dragged: some dimensions have only one movable end. */
  private tried = { end: "", moves: false };

  /** Whether a movable end is at a pixel; tried once per end of a form. */
  private grippable(view: PageView, at: Spot): boolean {
    const under = this.endAt(view, at);
    if (!under) return false;
    const end = `${this.store.revision} ${this.look} ${under.field} ${under.index}`;
    if (end !== this.tried.end)
      this.tried = { end, moves: this.gripped(view, at) !== null };
    return this.tried.moves;
  }

  /** Grips the end of a dimension line. Null if no line ends there, or if no number of the form moves it. */
  private gripped(view: PageView, at: Spot): (End & { at: Spot }) | null {
    const end = this.endAt(view, at);
    return end && view.gripEnd(this.store.job, end.field, end.index, at.x, at.y)
      ? { ...end, at }
      : null;
  }

  /** Drags the end of a dimension to the pointer. */
  private stretch(field: string, at: Spot): void {
    const value = this.drawing?.use((view) => view.dragEnd(at.x, at.y));
    if (value !== undefined) this.store.set(field, value);
  }

  /** Drags a handle and updates the form. */
  private drag(handle: string, at: Spot): void {
    const { store } = this;
    const field = this.drawing?.use((view) => view.handleField(handle));
    if (field) {
      const degrees = this.drawing?.use((view) =>
        view.dragAngle(handle, at.x, at.y),
      );
      if (degrees !== undefined) store.set(field, degrees);
      return;
    }
    const lie = this.drawing?.use((view) =>
      view.dragPart(handle, at.x, at.y),
    ) as {
      offset: Vec3;
      rotation: number;
    } | null;
    if (!lie) return;
    for (const i of [0, 1, 2]) store.typed.delete(`part.offset[${i}]`);
    store.typed.delete("part.rotation");
    store.set("part", {
      ...(store.get("part") as object),
      ...lie,
      rotation: tidy(lie.rotation),
    });
  }

  private up(event: PointerEvent): void {
    const at = this.pointers.get(event.pointerId);
    this.pointers.delete(event.pointerId);
    const axis =
      at && !this.dragged && !this.grip && !this.end
        ? this.drawing?.use((view) => view.axisAt(at.x, at.y))
        : undefined;
    if (axis) this.turn(axis as (typeof VIEWS)[number]);
    else if (at && !this.dragged && !this.grip) {
      const field = this.drawing?.use((view) => view.dimensionAt(at.x, at.y));
      if (field) this.tapped = field;
      else
        this.store.pin(
          this.drawing?.use((view) => view.pick(at.x, at.y)) ?? null,
        );
    }
    this.release();
  }

  /** The browser has taken over the gesture, so this is no tap. */
  private cancel(event: PointerEvent): void {
    this.pointers.delete(event.pointerId);
    this.release();
  }

  /** Field of the tapped dimension. */
  private tapped: string | null = null;

  /** Goes to the field of a dimension. Only on click: after a touch the browser moves the focus to the canvas last. */
  private clicked(): void {
    const field = this.tapped;
    this.tapped = null;
    if (field)
      this.dispatchEvent(
        new CustomEvent("go-to-field", { detail: field, bubbles: true }),
      );
  }

  private leave(event: PointerEvent): void {
    this.canvas().title = "";
    if (!this.pointers.has(event.pointerId) && event.pointerType === "mouse")
      this.store.point(null);
  }

  protected override wheel(event: WheelEvent): void {
    if (this.grip || this.end) event.preventDefault();
    else super.wheel(event);
  }
}

export type { PicturePart };

customElements.define("tp-picture", PicturePart);
