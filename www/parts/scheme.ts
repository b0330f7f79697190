import type { LitElement, ReactiveController } from "lit";

const dark = matchMedia("(prefers-color-scheme: dark)");

/** Tells a part that the page has become light or dark, as long as the part is there. */
export class Scheme implements ReactiveController {
  constructor(
    host: LitElement,
    private readonly recolour: () => void,
  ) {
    host.addController(this);
  }

  hostConnected(): void {
    dark.addEventListener("change", this.recolour);
  }

  hostDisconnected(): void {
    dark.removeEventListener("change", this.recolour);
  }
}
