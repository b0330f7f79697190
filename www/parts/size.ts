// Size of the page, which decides whether panels are side by side or tabs.
import type { LitElement } from "lit";
import { WIDE } from "./panels.js";

/** Observes the size of the page and redraws it if its panels change. */
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

  /** Renders again. The form may move to another place but keeps its scroll position and focus. */
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
