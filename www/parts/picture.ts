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

/** A place on the canvas, pixels of the page. */
type Spot = { x: number; y: number };
/** A dimension's line: the path of its field, and the pixels of its ends. */
type Line = [string, number, number, number, number];
/** How many times as large as they are deviations can be drawn. */
const MAGNIFIED = [1, 10, 100] as const;

/** An end of the line of a field's dimension. */
interface End {
  field: string;
  index: 0 | 1;
}

/** How near a handle and the end of a dimension's line are gripped, pixels: by a finger they are targets of 44. */
const REACH = { handle: 14, end: 12, finger: 22 } as const;

/** A turn that is drawn larger stays below this, degrees: more would look like another part. */
const MOST_TURNED = 20;

/** The picture with its tools: views, zoom, dimensions to type into, and a timeline over the moves. */
class PicturePart extends DrawnPart {
  protected override storeEvents = ["change", "focus"];
  protected override lights = true;
  /** The form in the picture, by its revision and language; a hover draws it again but does not plan it again. */
  private drawn = "";
  /** Whether the picture shows the present form although it has an error: it shows where the run ends. */
  private live = false;
  private pointers = new Map<number, Spot>();
  /** The handle that is dragged, and how far beside its middle it was gripped. */
  private grip: { handle: string; x: number; y: number } | null = null;
  /** The end of a dimension that is dragged, and where the pointer gripped it. */
  private end: (End & { at: Spot }) | null = null;
  private dragged = false;
  /** The frame until which a drag has made its plan, and where the pointer has been moved to since. */
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
  /** Whether the picture is to be fitted: deviations are drawn larger, or smaller, than before. */
  private refit = false;

  /**
   * The field whose dimension is lit: that which is dragged, though the picture has the focus then. The last good plan has other dimensions than
   * a form with errors: of it none is lit.
   */
  private get lit(): string | undefined {
    if (this.store.stale && !this.live) return undefined;
    return this.end?.field ?? this.store.focused ?? undefined;
  }

  /** Whether there are handles: those of the virtual part come with its group, and while it lies other than the drawing says; with them those of angles. */
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

  /** Where it is looked at from. */
  get from(): (typeof VIEWS)[number] {
    return this.look;
  }

  set from(view: (typeof VIEWS)[number]) {
    if (view !== this.look) this.turn(view);
  }

  /** The picture as a file of its own, in the language of the page. */
  svg(title: string): string | undefined {
    return this.drawing?.use((view) => {
      // It may have been turned and not drawn yet.
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

  /** The kinds of lines that are in the picture. */
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
    // A nominal part has nothing to draw larger, and its handle is there again.
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
      // Before the fit: what is drawn larger takes more room.
      view.magnify(this.magnified);
      if (anew) {
        label(view, this.store);
        // A job that ends in a collision, or that the control cannot do, has a path to show, though it has no program.
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

  /** The field that the picture was last turned for: a view that the user chooses after it stays. */
  private turnedFor: string | null = null;

  /** Turns to where the dimension of a field is seen. */
  private face(path: string | null): void {
    this.turnedFor = path;
    const look =
      path === null
        ? undefined
        : this.drawing?.use((view) => view.viewOf(path));
    if (look && look !== this.look && this.look !== "isometric")
      this.turn(look as (typeof VIEWS)[number]);
  }

  /** What lies other than the drawing says is seen without opening anything. */
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

  /** The move that is pointed at: in the picture, on the timeline and in words. */
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

  /** How many times as large deviations can be drawn here. */
  private get offered(): readonly (typeof MAGNIFIED)[number][] {
    const turn = Math.abs(Number(this.store.get("part.rotation") ?? 0));
    const offset =
      (this.store.get("part.offset") as unknown[] | undefined)?.map((x) =>
        Math.abs(Number(x)),
      ) ?? [];
    const { touches } = this.store.plan;
    // How far apart the touches lie, along the axis where that is most.
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

  /** Whether a finger points, not a mouse. */
  private finger = false;

  private handleAt(view: PageView, at: Spot): string | undefined {
    return view.handleAt(at.x, at.y, this.finger ? REACH.finger : REACH.handle);
  }

  /** The handle is let go. */
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

  /** What a handle changes. */
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
      // Measured from where it was gripped: a slow drag is one, too.
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

  /** What is gripped follows the pointer. Each step makes a plan, so there is one a frame at most, whatever the browser sends; the last one counts. */
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

  /** What is gripped is where the pointer is. */
  private caughtUp(): void {
    cancelAnimationFrame(this.planned);
    this.planned = 0;
    const at = this.pulled;
    this.pulled = null;
    if (at) this.pull(at);
  }

  /** The end of a dimension's line at a pixel: its field, and which end it is. */
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

  /** The end that was under the pointer last, and whether a drag would move it: of some dimensions only one end moves. */
  private tried = { end: "", moves: false };

  /** Whether an end that can be dragged is at a pixel; tried once for each end of a form. */
  private grippable(view: PageView, at: Spot): boolean {
    const under = this.endAt(view, at);
    if (!under) return false;
    const end = `${this.store.revision} ${this.look} ${under.field} ${under.index}`;
    if (end !== this.tried.end)
      this.tried = { end, moves: this.gripped(view, at) !== null };
    return this.tried.moves;
  }

  /** Grips the end of a dimension's line; null where none is there, or where no number of the form moves it. */
  private gripped(view: PageView, at: Spot): (End & { at: Spot }) | null {
    const end = this.endAt(view, at);
    return end && view.gripEnd(this.store.job, end.field, end.index, at.x, at.y)
      ? { ...end, at }
      : null;
  }

  /** The end of a dimension is dragged: it stays under the pointer. */
  private stretch(field: string, at: Spot): void {
    const value = this.drawing?.use((view) => view.dragEnd(at.x, at.y));
    if (value !== undefined) this.store.set(field, value);
  }

  /** A handle is dragged: the form follows. */
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

  /** The browser has taken the gesture over: nothing was tapped. */
  private cancel(event: PointerEvent): void {
    this.pointers.delete(event.pointerId);
    this.release();
  }

  /** The field of the dimension that is tapped. */
  private tapped: string | null = null;

  /** To the field of a dimension: only now, since the browser moves the focus to the canvas, after a touch as the last. */
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
