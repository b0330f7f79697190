import { html, type TemplateResult } from "lit";
import { w } from "../words.js";
import { type Drawing, VIEWS } from "./drawing.js";
import { StorePart } from "./part.js";

/** A part with a canvas. */
export abstract class CanvasPart extends StorePart {
  protected drawing?: Drawing;
  protected readonly observer = new ResizeObserver(() => this.restyle());

  /** Called after the size of the canvas or the colours of the page have changed. */
  protected restyle = (): void => {
    this.drawing?.restyle();
  };

  override connectedCallback(): void {
    super.connectedCallback();
    this.store.addEventListener("recolour", this.restyle);
    // After a move to another position of the page the drawing is lost.
    this.requestUpdate();
  }

  override disconnectedCallback(): void {
    super.disconnectedCallback();
    this.observer.disconnect();
    this.store.removeEventListener("recolour", this.restyle);
    this.drawing?.free();
    this.drawing = undefined;
  }
}

/** Names of the views. */
const VIEW_NAMES = {
  top: w("top"),
  front: w("front"),
  side: w("side"),
  isometric: w("isometric"),
};

/** A part with a large picture: its views and zoom. */
export abstract class DrawnPart extends CanvasPart {
  protected look: (typeof VIEWS)[number] = "top";

  protected override firstUpdated(): void {
    this.canvas().addEventListener("wheel", (event) => this.wheel(event), {
      passive: false,
    });
  }

  protected wheel(event: WheelEvent): void {
    this.drawing?.wheel(event);
  }

  protected canvas(): HTMLCanvasElement {
    return this.querySelector("canvas") as HTMLCanvasElement;
  }

  /** Canvas for highlights, on top of the picture, which need not be redrawn. */
  protected over(): HTMLCanvasElement {
    return this.querySelector("canvas.over") as HTMLCanvasElement;
  }

  /** View cube: a button for each face, and one at the corner for the isometric view. */
  protected tools(label: string): TemplateResult {
    return html`<div class="cube" role="toolbar" aria-label=${label}>
        ${VIEWS.map((name) => html`<button type="button" class=${name} title=${this.t(VIEW_NAMES[name])} aria-pressed=${this.look === name ? "true" : "false"} @click=${() => this.turn(name)}><span class="visually-hidden">${this.t(VIEW_NAMES[name])}</span></button>`)}
        <svg viewBox="0 0 64 64" aria-hidden="true"><path d="M32 4 60 18v30L32 62 4 48V18zM4 18l28 14 28-14M32 32v30"></path></svg>
      </div>`;
  }

  protected turn(name: (typeof VIEWS)[number]): void {
    this.look = name;
    this.drawing?.look(name);
    this.requestUpdate();
  }
}
