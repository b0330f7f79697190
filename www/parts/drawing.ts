// The picture on a canvas, for the parts of the page that have one.
import { View } from "../core/browser.js";

const COLOURS = ["background", "text", "wall", "actual", "position", "link", "touch", "ball", "highlight"];

/** A View that is there as long as its part is, and made anew where the module's instance is another one. */
export class Drawing {
  private view?: View;

  /** `show` puts into a new View what the canvas must show. */
  constructor(
    private readonly canvas: HTMLCanvasElement,
    private readonly show: (view: View) => void,
  ) {}

  /** Works with the View. One that fails belongs to an earlier instance of the module: the work is done with a new one. */
  use<T>(work: (view: View) => T): T {
    try {
      return work(this.view ?? this.make());
    } catch {
      this.free();
      return work(this.make());
    }
  }

  /** The canvas' size and the page's colours, as the style sheet has them now. */
  dress(): void {
    this.use((view) => this.fit(view));
  }

  free(): void {
    this.view?.free();
    this.view = undefined;
  }

  private make(): View {
    this.view = new View(this.canvas);
    this.fit(this.view);
    this.show(this.view);
    return this.view;
  }

  private fit(view: View): void {
    const style = getComputedStyle(this.canvas);
    view.setTheme(Object.fromEntries(COLOURS.map((name) => [name, style.getPropertyValue(`--c-${name}`).trim()])));
    view.resize(this.canvas.clientWidth, this.canvas.clientHeight, devicePixelRatio || 1);
  }
}
