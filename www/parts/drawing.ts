// The picture on a canvas, for the parts that have one.
import { awaited, PageView } from "../core/browser.js";
import type { Store } from "../store.js";

const COLOURS = [
  "background",
  "text",
  "wall",
  "actual",
  "position",
  "link",
  "touch",
  "ball",
  "highlight",
];

/** Names the dimensions of the next job like the fields of the form, in the language of the page. */
export function label(view: PageView, store: Store): void {
  const fields = store.lang === "en" ? [] : store.cycle.fields;
  view.setLabels(
    fields.map(({ key }) => `cycle.${key}`),
    fields.map((field) => field.label),
    store.comma,
  );
}

/** Views of the picture. */
export const VIEWS = ["top", "front", "side", "isometric"] as const;

/** A View for the lifetime of its part. It is made again if the instance of the module changes. */
export class Drawing {
  private view?: PageView;
  /** Request for the next animation frame. */
  private frame = 0;

  /**
   * `show` loads the canvas content into a new View. Highlights are drawn on the canvas `over` it, if there is one. A picture with highlights changes
   * interactively and is drawn at most once per frame; any other immediately.
   */
  constructor(
    private readonly canvas: HTMLCanvasElement,
    private readonly show: (view: PageView) => void,
    private readonly over?: HTMLCanvasElement,
  ) {
    // The browser may lose the canvas content and its drawing state.
    canvas.addEventListener("contextrestored", this.restored);
    awaited()?.then(this.restored, () => undefined);
  }

  private freed = false;
  private readonly restored = () => {
    if (!this.freed) this.restyle();
  };

  /** Uses the View, not before the module is loaded. A View of an earlier instance of the module fails: the work is repeated with a new one. */
  use<T>(work: (view: PageView) => T): T | undefined {
    if (this.over) this.frame ||= requestAnimationFrame(() => this.paint());
    return this.with(work);
  }

  /** Applies the size of the canvas and the colours of the style sheet. A resized canvas is empty, so it is redrawn immediately. */
  restyle(): void {
    this.with((view) => this.fit(view));
    this.paint();
  }

  /** Zooms about the middle. */
  zoom(factor: number): void {
    const { clientWidth, clientHeight } = this.canvas;
    this.use((view) => view.zoom(factor, clientWidth / 2, clientHeight / 2));
  }

  /** Zooms about the pointer with the wheel. */
  wheel(event: WheelEvent): void {
    event.preventDefault();
    const box = this.canvas.getBoundingClientRect();
    const factor = Math.exp(
      -Math.max(-100, Math.min(100, event.deltaY)) * 0.004,
    );
    this.use((view) =>
      view.zoom(factor, event.clientX - box.left, event.clientY - box.top),
    );
  }

  /** Arrow keys pan, plus and minus zoom, 0 fits. */
  key(event: KeyboardEvent): void {
    const pans: Record<string, [number, number]> = {
      ArrowLeft: [24, 0],
      ArrowRight: [-24, 0],
      ArrowUp: [0, 24],
      ArrowDown: [0, -24],
    };
    const pan = pans[event.key];
    if (pan) this.use((view) => view.pan(...pan));
    else if (event.key === "+") this.zoom(1.4);
    else if (event.key === "-") this.zoom(1 / 1.4);
    else if (event.key === "0") this.use((view) => view.fit());
    else return;
    event.preventDefault();
  }

  /** Changes the view. */
  look(from: string): void {
    this.use((view) => view.look(from));
  }

  free(): void {
    this.freed = true;
    // The canvas may get another drawing later.
    this.canvas.removeEventListener("contextrestored", this.restored);
    this.rest();
    this.drop();
  }

  private drop(): void {
    this.view?.free();
    this.view = undefined;
  }

  /** Draws the changes since the last frame. */
  private paint(): void {
    this.rest();
    if (this.view) this.with((view) => view.render());
  }

  /** Cancels the pending frame. */
  private rest(): void {
    cancelAnimationFrame(this.frame);
    this.frame = 0;
  }

  private with<T>(work: (view: PageView) => T): T | undefined {
    if (awaited()) return undefined;
    try {
      return work(this.view ?? this.make());
    } catch {
      this.drop();
      return work(this.make());
    }
  }

  private make(): PageView {
    this.view = new PageView(this.canvas);
    if (this.over) {
      this.view.setOverlay(this.over);
      this.view.defer();
    }
    this.fit(this.view);
    this.show(this.view);
    return this.view;
  }

  private fit(view: PageView): void {
    const style = getComputedStyle(this.canvas);
    view.setTheme(
      Object.fromEntries(
        COLOURS.map((name) => [
          name,
          style.getPropertyValue(`--c-${name}`).trim(),
        ]),
      ),
    );
    view.resize(
      this.canvas.clientWidth,
      this.canvas.clientHeight,
      devicePixelRatio || 1,
    );
  }
}
