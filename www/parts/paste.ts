import { html, nothing, type TemplateResult } from "lit";
import { StorePart } from "./part.js";

/** Dialog for pasted text. The text stays until it could be read; errors appear beside it. */
class PastePart extends StorePart {
  protected override storeEvents: string[] = [];
  /** Reads a text; returns false if nothing can be made of it. */
  declare take: (text: string) => Promise<boolean>;
  /** Aborts the reading. */
  declare stop: () => void;
  /** Message about the text that was read. */
  declare said: string;
  private shown = false;
  /** Whether the text could not be read. */
  private failed = false;

  static override properties = {
    take: { attribute: false },
    stop: { attribute: false },
    said: { attribute: false },
  };

  override render(): TemplateResult {
    return html`<dialog class="paste" aria-label=${this.t("Paste")} @close=${this.closed}>${
      this.shown
        ? html`<label for="paste">${this.t("A dump of CmdPrm codes, a program with cycle 1411, any program that was written here, or a job")}</label>
        <textarea id="paste" rows="8" spellcheck="false"></textarea>
        <p class=${this.failed ? "problem error" : ""} role="status">${this.said}</p>
        <div class="tools"><button type="button" class="primary" @click=${this.read}>${this.t("Read it")}</button>
          <button type="button" @click=${() => this.dialog?.close()}>${this.t("Cancel")}</button></div>`
        : nothing
    }</dialog>`;
  }

  /** Opens the dialog with an empty, focused field. */
  async open(): Promise<void> {
    this.shown = true;
    this.requestUpdate();
    await this.updateComplete;
    this.dialog?.showModal();
    this.querySelector<HTMLElement>("#paste")?.focus();
  }

  private get dialog(): HTMLDialogElement | null {
    return this.querySelector("dialog");
  }

  private readonly closed = (): void => {
    this.shown = false;
    this.failed = false;
    this.stop();
    this.requestUpdate();
  };

  private readonly read = async (): Promise<void> => {
    const held = () =>
      this.querySelector<HTMLTextAreaElement>("#paste")?.value ?? "";
    const text = held();
    const taken = await this.take(text);
    this.failed = !taken;
    if (taken && held() === text) this.dialog?.close();
    else this.requestUpdate();
  };
}

export type { PastePart };

customElements.define("tp-paste", PastePart);
