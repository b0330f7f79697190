import { LitElement, type PropertyValues } from "lit";
import type { Finding, Message } from "../core/browser.js";
import type { Store } from "../store.js";

/** A part of the page that redraws itself after events of the store. Parts share the styles of the element. */
export abstract class StorePart extends LitElement {
  store!: Store;
  /** Which of the store's events this part follows. */
  protected storeEvents: string[] = ["change", "highlight"];

  /** Whether it highlights the current move without a new rendering. */
  protected lights = false;

  /** A text in the language of the page. */
  protected t(
    template: string,
    ...values: (string | number | Message)[]
  ): string {
    return this.store.t(template, ...values);
  }

  /** The message of a finding, in the language of the page. */
  protected message(finding: Finding): string {
    return this.store.say(finding.said);
  }

  private readonly redraw = () => this.requestUpdate();
  private readonly relight = () => {
    if (this.closest("[hidden]")) this.isOutdated = true;
    else this.light();
  };
  /** Whether something changed while the part was not seen. */
  private isOutdated = false;

  protected override createRenderRoot(): HTMLElement {
    return this;
  }

  /** A hidden part does not redraw. */
  protected override shouldUpdate(): boolean {
    this.isOutdated = this.hasUpdated && this.closest("[hidden]") !== null;
    return !this.isOutdated;
  }

  /** Highlights what belongs to the current move. */
  protected light(): void {}

  protected override updated(_changed: PropertyValues): void {
    if (this.lights) this.light();
  }

  /** The part has become visible. */
  catchUp(): void {
    if (this.isOutdated) this.requestUpdate();
  }

  override connectedCallback(): void {
    super.connectedCallback();
    for (const name of [...this.storeEvents, "language"])
      this.store.addEventListener(name, this.redraw);
    if (this.lights) this.store.addEventListener("highlight", this.relight);
    // Outside of the page it receives no events.
    if (this.hasUpdated) this.requestUpdate();
  }

  override disconnectedCallback(): void {
    super.disconnectedCallback();
    for (const name of [...this.storeEvents, "language"])
      this.store.removeEventListener(name, this.redraw);
    this.store.removeEventListener("highlight", this.relight);
  }
}
