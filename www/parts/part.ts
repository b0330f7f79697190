import { LitElement, type PropertyValues } from "lit";
import type { Finding, Message } from "../core/browser.js";
import type { Store } from "../store.js";

/** A part of the page: draws itself from the store whenever the store says so. Parts share the styles around them. */
export abstract class StorePart extends LitElement {
  store!: Store;
  /** Which of the store's events this part follows. */
  protected storeEvents: string[] = ["change", "highlight"];

  /** Whether it lights up what belongs to the move that is pointed at, without being drawn again. */
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

  /** A part that is not seen does nothing until it is. */
  protected override shouldUpdate(): boolean {
    this.isOutdated = this.hasUpdated && this.closest("[hidden]") !== null;
    return !this.isOutdated;
  }

  /** Lights up what belongs to the move that is pointed at. */
  protected light(): void {}

  protected override updated(_changed: PropertyValues): void {
    if (this.lights) this.light();
  }

  /** The part is seen again. */
  catchUp(): void {
    if (this.isOutdated) this.requestUpdate();
  }

  override connectedCallback(): void {
    super.connectedCallback();
    for (const name of [...this.storeEvents, "language"])
      this.store.addEventListener(name, this.redraw);
    if (this.lights) this.store.addEventListener("highlight", this.relight);
    // While it was out of the page, nothing told it of changes.
    if (this.hasUpdated) this.requestUpdate();
  }

  override disconnectedCallback(): void {
    super.disconnectedCallback();
    for (const name of [...this.storeEvents, "language"])
      this.store.removeEventListener(name, this.redraw);
    this.store.removeEventListener("highlight", this.relight);
  }
}
