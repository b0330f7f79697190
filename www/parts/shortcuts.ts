// The keys of the whole page, and what is pasted beside every field.
import type { Store } from "../store.js";
import type { Intake } from "./intake.js";
import { letterOf } from "./keys.js";
import type { Tool } from "./tools.js";

/** The page that they belong to. */
interface Page {
  store: Store;
  intake: Intake;
  host: HTMLElement;
  /** Whether the page is Touchpath's own. */
  links: boolean;
  tool(): Tool;
  ask(what: string): unknown;
  /** Back to the job. */
  leave(): void;
}

export class Shortcuts {
  constructor(
    private readonly app: HTMLElement,
    private readonly page: Page,
  ) {}

  follow(): void {
    this.heard.addEventListener("paste", this.pasted);
    this.heard.addEventListener("keydown", this.shortcut);
  }

  leave(): void {
    this.heard.removeEventListener("paste", this.pasted);
    this.heard.removeEventListener("keydown", this.shortcut);
  }

  /** Undo and redo are the page's, in its fields too: only a text that is pasted in keeps its own. */
  private readonly shortcut = (event: Event): void => {
    if (!(event instanceof KeyboardEvent)) return;
    if (event.key === "Escape") this.escape(event);
    if (!(event.ctrlKey || event.metaKey) || event.altKey) return;
    const key = letterOf(event);
    const at = event.composedPath()[0] as Element;
    if (!this.owns(at)) return;
    if (
      !["k", "s", "y", "z"].includes(key) ||
      (key !== "s" && at.id === "paste")
    )
      return;
    event.preventDefault();
    if (key === "k") {
      if (!this.app.querySelector("dialog[open]")) this.page.ask("commands");
      return;
    }
    if (key === "s") {
      this.page.ask("save");
      return;
    }
    // A field that is not the job's changes none, and no job is changed that is not seen. Left to the browser, the key would take
    // back the last letter of any field of the page.
    const seen =
      this.page.tool() === "cycles" && !this.app.querySelector("dialog[open]");
    const other =
      at.matches("input[type=text], input[type=search]") &&
      !at.closest("tp-form");
    if (!seen || other) return;
    if (key === "y" || event.shiftKey) this.page.store.redo();
    else this.page.store.undo();
  };

  /** What is pasted beside every field is opened, as a file would be. */
  private readonly pasted = (event: Event): void => {
    if (!(event instanceof ClipboardEvent)) return;
    const at = event.composedPath()[0] as Element;
    if (!this.owns(at)) return;
    const typed =
      at.matches("input, textarea, [contenteditable]") ||
      this.app.querySelector("dialog[open]");
    if (typed || this.page.store.readonly) this.page.intake.refuse(event);
    else this.page.intake.paste(event);
  };

  /** Where keys are heard: on Touchpath's own page everywhere, so that a click beside everything does not make them dead. */
  private get heard(): EventTarget {
    return this.page.links ? document : this.app;
  }

  /** Whether keys that are pressed here are the job's: what the host page has put into a slot is its own. */
  private owns(at: Element): boolean {
    return (
      this.app.contains(at) || (this.page.links && at.contains(this.page.host))
    );
  }

  /** From anything else back to the job; a field, a dialog and the menu have Escape for themselves. */
  private escape(event: KeyboardEvent): void {
    const at = event.composedPath()[0] as Element;
    if (
      this.page.tool() === "cycles" ||
      event.defaultPrevented ||
      !this.owns(at)
    )
      return;
    const empty =
      at instanceof HTMLInputElement && at.type === "search" && at.value === "";
    if (
      (at.matches("input, select, textarea") && !empty) ||
      this.app.querySelector("dialog[open], :popover-open")
    )
      return;
    event.preventDefault();
    this.page.leave();
  }
}
