// Keys of the whole page, and text pasted outside of fields.
import type { Store } from "../store.js";
import type { Intake } from "./intake.js";
import { letterOf } from "./keys.js";
import type { Tool } from "./tools.js";

/** The page that the keys control. */
interface Page {
  store: Store;
  intake: Intake;
  host: HTMLElement;
  /** Whether the page is Touchpath's own. */
  links: boolean;
  tool(): Tool;
  ask(what: string): unknown;
  /** Returns to the job. */
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

  /** Undo and redo belong to the page, also in its fields; only the field for pasted text keeps its own. */
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
    // The host page has its own undo.
    if ("yz".includes(key) && !this.page.store.keepsHistory) return;
    event.preventDefault();
    if (key === "k") {
      if (!this.app.querySelector("dialog[open]")) this.page.ask("commands");
      return;
    }
    if (key === "s") {
      this.page.ask("save");
      return;
    }
    // Keys in other fields do not change the job, nor do keys while the job is hidden. Left to the browser, the key would undo the last input in any field of
    // the page.
    const seen =
      this.page.tool() === "cycles" && !this.app.querySelector("dialog[open]");
    const other =
      at.matches("input[type=text], input[type=search]") &&
      !at.closest("tp-form");
    if (!seen || other) return;
    if (key === "y" || event.shiftKey) this.page.store.redo();
    else this.page.store.undo();
  };

  /** Opens text that is pasted outside of fields, like a file. */
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

  /** Target of the key listeners: the whole window on Touchpath's own page, so that a click on empty space does not disable them. */
  private get heard(): EventTarget {
    return this.page.links ? document : this.app;
  }

  /** Whether keys pressed here belong to the job: elements in a slot belong to the host page. */
  private owns(at: Element): boolean {
    return (
      this.app.contains(at) || (this.page.links && at.contains(this.page.host))
    );
  }

  /** Escape returns to the job; fields, dialogs and the menu handle it themselves. */
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
