// The picture on a canvas, for the parts of the page that have one.
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

/** The dimensions of the next job are called as the form calls its fields, in the language of the page. */
export function label(view: PageView, store: Store): void {
  const fields = store.lang === "en" ? [] : store.cycle.fields;
  view.setLabels(
    fields.map(({ key }) => `cycle.${key}`),
    fields.map((field) => field.label),
    store.comma,
  );
}

/** Where a picture is looked at from. */
export const VIEWS = ["top", "front", "side", "isometric"] as const;

/** A View that is there as long as its part is, and made anew where the module's instance is another one. */
export class Drawing {
  private view?: PageView;
  /** The frame in which the picture is drawn next. */
  private frame = 0;

  /**
   * `show` puts into a new View what the canvas must show; what is pointed at is drawn on the canvas `over` it, where there is one. Such a picture, which
   * changes under a hand, is drawn once a frame at most; any other at once.
   */
  constructor(
    private readonly canvas: HTMLCanvasElement,
    private readonly show: (view: PageView) => void,
    private readonly over?: HTMLCanvasElement,
  ) {
    // The browser may lose what a canvas shows, and the state it was drawn with.
    canvas.addEventListener("contextrestored", this.restored);
    awaited()?.then(this.restored, () => undefined);
  }

  private freed = false;
  private readonly restored = () => {
    if (!this.freed) this.restyle();
  };

  /** Works with the View; not before the module is there. One that fails belongs to an earlier instance of the module: the work is done with a new one. */
  use<T>(work: (view: PageView) => T): T | undefined {
    if (this.over) this.frame ||= requestAnimationFrame(() => this.paint());
    return this.with(work);
  }

  /** The canvas' size and the page's colours, as the style sheet has them now. A canvas of another size is empty: it is drawn at once. */
  restyle(): void {
    this.with((view) => this.fit(view));
    this.paint();
  }

  /** Zooms about the middle. */
  zoom(factor: number): void {
    const { clientWidth, clientHeight } = this.canvas;
    this.use((view) => view.zoom(factor, clientWidth / 2, clientHeight / 2));
  }

  /** Zooms about the pointer as the wheel turns. */
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

  /** Looks from elsewhere. */
  look(from: string): void {
    this.use((view) => view.look(from));
  }

  free(): void {
    this.freed = true;
    // The canvas may have another drawing later.
    this.canvas.removeEventListener("contextrestored", this.restored);
    this.rest();
    this.drop();
  }

  private drop(): void {
    this.view?.free();
    this.view = undefined;
  }

  /** Draws what has changed since the last frame. */
  private paint(): void {
    this.rest();
    if (this.view) this.with((view) => view.render());
  }

  /** No frame is waited for. */
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
