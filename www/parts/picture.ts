import { html, nothing, type PropertyValues, type TemplateResult } from "lit";
import type { Vec3 } from "../core/browser.js";
import { Drawing } from "./drawing.js";
import { DrawnPart } from "./drawn.js";

/** The picture with its tools: views, zoom, and a slider over the moves. */
class PicturePart extends DrawnPart {
  /** The job in the picture; a hover draws it again but does not plan it again. */
  private drawn?: object;
  private pointers = new Map<number, { x: number; y: number }>();
  /** The handle that is dragged, and how far beside its middle it was gripped. */
  private grip: { handle: string; x: number; y: number } | null = null;
  private dragged = false;

  override render(): TemplateResult {
    const { plan, highlight, stale } = this.store;
    const count = plan.moves.length;
    return html`
      ${this.tools("Picture")}
      <div class=${stale ? "canvas stale" : "canvas"}>
        <canvas tabindex="0" role="img" aria-label=${this.describe()}
          @pointerdown=${this.down} @pointermove=${this.move} @pointerup=${this.up} @pointercancel=${this.up} @pointerleave=${this.leave}
          @keydown=${(e: KeyboardEvent) => this.drawing?.key(e)}></canvas>
        ${stale ? html`<p class="stamp" role="status">The form has errors: this is the last good plan</p>` : nothing}
      </div>
      <div class="scrub">
        <label for="scrub">Move</label>
        <input id="scrub" type="range" min="0" max=${count} .value=${String(highlight === null ? 0 : highlight + 1)}
          aria-valuetext=${this.says()}
          @input=${(e: Event) => {
            const n = Number((e.target as HTMLInputElement).value);
            this.store.point(n === 0 ? null : n - 1);
          }} />
        <output for="scrub">${this.says()}</output>
      </div>
      <ul class="key" aria-label="Colours">
        <li class="position">positioning</li><li class="link">link, back</li><li class="touch">touch</li><li class="ghost">overtravel</li><li class="rapid">rapid</li><li class="actual">virtual part</li>
      </ul>
    `;
  }

  protected override updated(_changed: PropertyValues): void {
    const { shown, highlight } = this.store;
    if (!this.drawing && this.isConnected) {
      const canvas = this.canvas();
      this.drawing = new Drawing(canvas, (view) => {
        view.look(this.look);
        view.show(this.store.shown);
        view.highlight(this.store.highlight ?? undefined);
      });
      this.observer.observe(canvas);
    }
    this.drawing?.use((view) => {
      if (this.drawn !== shown) view.show(shown);
      view.highlight(highlight ?? undefined);
    });
    this.drawn = shown;
  }

  private frame(): HTMLElement {
    return this.querySelector(".canvas") as HTMLElement;
  }

  private describe(): string {
    const { plan } = this.store;
    return `Path of the probe, ${this.look} view: ${plan.moves.length} moves, ${plan.touches.length} touches. Arrow keys move the picture, plus and minus zoom, 0 fits.`;
  }

  /** The move that is pointed at, in words. */
  private says(): string {
    const { plan, highlight } = this.store;
    const move = highlight === null ? undefined : plan.moves[highlight];
    if (!move || highlight === null) {
      const minutes = Math.floor(plan.time);
      const seconds = Math.round((plan.time - minutes) * 60);
      return `${plan.moves.length} moves, ${plan.length.toFixed(0)} ${this.store.units}, ${minutes} min ${seconds} s`;
    }
    const kind = { position: "positioning", touch: `touch ${(move.touch ?? 0) + 1}`, back: "back" }[move.kind];
    return `${highlight + 1} of ${plan.moves.length}: step ${move.step}, ${kind}, ${move.feed === "longLink" ? "long link" : move.feed}`;
  }

  private at(event: PointerEvent | WheelEvent): { x: number; y: number } {
    const box = this.canvas().getBoundingClientRect();
    return { x: event.clientX - box.left, y: event.clientY - box.top };
  }

  private down(event: PointerEvent): void {
    const at = this.at(event);
    this.canvas().setPointerCapture(event.pointerId);
    this.pointers.set(event.pointerId, at);
    this.dragged = false;
    if (this.pointers.size > 1) {
      this.release();
      return;
    }
    this.drawing?.use((view) => {
      const handle = view.handleAt(at.x, at.y);
      const [x, y] = (handle && view.handleSpot(handle)) || [];
      if (!handle || x === undefined || y === undefined) return;
      this.grip = { handle, x: at.x - x, y: at.y - y };
      view.hold(true);
    });
    // Messages that come and go must not move the canvas under the pointer.
    if (this.grip) this.frame().style.cssText = `flex: none; height: ${this.frame().getBoundingClientRect().height}px`;
  }

  /** The handle is let go. */
  private release(): void {
    if (!this.grip) return;
    this.grip = null;
    this.frame().style.cssText = "";
    this.drawing?.use((view) => view.hold(false));
  }

  private move(event: PointerEvent): void {
    const at = this.at(event);
    const before = this.pointers.get(event.pointerId);
    if (!before) {
      this.drawing?.use((view) => {
        this.canvas().style.cursor = view.handleAt(at.x, at.y) ? "grab" : "";
        this.store.point(view.pick(at.x, at.y) ?? null);
      });
      return;
    }
    this.dragged ||= Math.hypot(at.x - before.x, at.y - before.y) > 2;
    if (this.pointers.size === 2) {
      const other = [...this.pointers].find(([id]) => id !== event.pointerId)?.[1];
      if (other) {
        const reach = (p: { x: number; y: number }) => Math.hypot(p.x - other.x, p.y - other.y);
        this.drawing?.use((view) => {
          view.zoom(reach(at) / Math.max(reach(before), 1), (at.x + other.x) / 2, (at.y + other.y) / 2);
          view.pan((at.x - before.x) / 2, (at.y - before.y) / 2);
        });
      }
    } else if (this.grip) {
      this.drag(this.grip.handle, { x: at.x - this.grip.x, y: at.y - this.grip.y });
    } else if (this.dragged) {
      this.drawing?.use((view) => view.pan(at.x - before.x, at.y - before.y));
    } else {
      return;
    }
    this.pointers.set(event.pointerId, at);
  }

  /** A handle is dragged: the form follows. */
  private drag(handle: string, at: { x: number; y: number }): void {
    const { store } = this;
    const field = this.drawing?.use((view) => view.handleField(handle));
    if (field) {
      const degrees = this.drawing?.use((view) => view.dragAngle(handle, at.x, at.y));
      if (degrees !== undefined) store.set(field, degrees);
      return;
    }
    const lie = this.drawing?.use((view) => view.dragPart(handle, at.x, at.y)) as {
      offset: Vec3;
      rotation: number;
    } | null;
    if (!lie) return;
    for (const i of [0, 1, 2]) store.typed.delete(`part.offset[${i}]`);
    store.typed.delete("part.rotation");
    store.set("part", { ...(store.get("part") as object), ...lie });
  }

  private up(event: PointerEvent): void {
    const at = this.pointers.get(event.pointerId);
    this.pointers.delete(event.pointerId);
    if (at && !this.dragged && !this.grip) {
      this.store.point(this.drawing?.use((view) => view.pick(at.x, at.y)) ?? null);
    }
    this.release();
  }

  private leave(event: PointerEvent): void {
    if (!this.pointers.has(event.pointerId) && event.pointerType === "mouse") this.store.point(null);
  }

  protected override wheel(event: WheelEvent): void {
    if (this.grip) event.preventDefault();
    else super.wheel(event);
  }
}

customElements.define("tp-picture", PicturePart);
