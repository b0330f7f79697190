// Size of the page, which decides whether its panels are shown side by side or as tabs.
import type { LitElement } from "lit";
import { WIDE } from "./panels.js";

/** Follows the size of the page, and draws it again where that changes its panels. */
export class Size {
  width = WIDE;
  height = 0;
  private readonly observer = new ResizeObserver(() => this.measure());

  constructor(private readonly app: LitElement) {}

  follow(): void {
    this.measure();
    this.observer.observe(this.app);
  }

  leave(): void {
    this.observer.disconnect();
  }

  private measure(): void {
    const { width: wide, height } = this.app.getBoundingClientRect();
    const width = wide || WIDE;
    const turned = height > width !== this.height > this.width;
    if (width === this.width && !turned) return;
    this.width = width;
    this.height = height;
    this.keepPlace();
  }

  /** Renders again; the form, which may be put elsewhere, keeps its place and the focus. */
  private async keepPlace(): Promise<void> {
    const at = this.app.querySelector<HTMLElement>("tp-form :focus");
    const top = this.app.querySelector("tp-form")?.scrollTop ?? 0;
    this.app.requestUpdate();
    await this.app.updateComplete;
    if (!at?.checkVisibility()) return;
    if (!at.matches(":focus")) {
      at.focus({ preventScroll: true });
      this.app.querySelector("tp-form")?.scrollTo({ top, behavior: "instant" });
    }
    at.scrollIntoView({ block: "nearest" });
  }
}
