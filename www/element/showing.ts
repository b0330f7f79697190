// Display of a <touch-path>: its keywords, and its panels in other elements of the page.
import type { TouchPathEvents } from "../core/events.js";
import type { Finding } from "../core/types.js";
import type { App } from "../parts/app.js";
import type { Store } from "../store.js";
import {
  type Input,
  isKnown,
  isWordy,
  PANEL_NAMES,
  type Theme,
  type View,
  WORDS,
  type Wordy,
} from "./attributes.js";
import { Base } from "./loading.js";

/** An element that shows panels of this job elsewhere on the page. */
interface Borrower {
  readonly panels: string;
}

/** The element as its parts see it: state, panels, events. */
export abstract class Showing extends Base {
  /** State of the page once it is loaded. Not part of the public interface. @internal */
  store?: Store;
  /** Content of the element. Not part of the public interface. @internal */
  app?: App;
  /** Elements that show panels of this job elsewhere on the page. @internal */
  protected readonly lent = new Map<Borrower, App>();
  /** Values of the keyword attributes, or their last valid values. @internal */
  protected readonly words = new Map<Wordy, string>();

  /** @internal */
  abstract get ready(): Promise<void>;
  /** @internal */
  abstract get panels(): string;
  /** @internal */
  abstract get theme(): Theme;
  /** @internal */
  abstract get readonly(): boolean;
  /** @internal */
  abstract get mode(): "setter" | "cam";
  /** @internal */
  abstract get view(): View;

  /** Dispatches an event; returns false if a listener cancels it. @internal */
  tell<K extends keyof TouchPathEvents>(
    name: K,
    detail: TouchPathEvents[K]["detail"],
  ): boolean {
    return this.dispatchEvent(
      new CustomEvent(name, {
        detail,
        bubbles: true,
        composed: true,
        cancelable: name === "program-save",
      }),
    );
  }

  /** Sets an attribute, or removes it. @internal */
  protected say(name: string, value: string | null | undefined): void {
    if (value === null || value === undefined) this.removeAttribute(name);
    else this.setAttribute(name, value);
  }

  /** Reasons why any of the given inputs cannot be applied; changes nothing. @internal */
  refusals(state: Record<string, unknown>): Finding[] {
    const { store } = this;
    if (!store) return [];
    const found: Finding[] = [];
    for (const [name, value] of Object.entries(state)) {
      if (value === undefined) continue;
      if (!isWordy(name)) {
        found.push(
          ...store.outside.refusals(
            name as Input | "lang" | "readonly",
            value,
            state,
          ),
        );
      } else if (!isKnown(name, value))
        found.push(store.outside.unknown(name, WORDS[name], name === "panels"));
    }
    return found;
  }

  /** Applies a keyword attribute, or reports why it is invalid, once the element can report. @internal */
  protected word(name: Wordy, value: string | null): void {
    if (value === null) this.words.delete(name);
    else if (isKnown(name, value)) {
      this.words.set(name, value);
      if (name === "view")
        for (const app of [this.app, ...this.lent.values()])
          if (app) app.view = value as View;
    } else {
      const refused = this.refusals({ [name]: value });
      if (refused.length > 0)
        this.tell("finding", { findings: refused, refused: true });
    }
  }

  /** Applies the display options. @internal */
  applyOptions(): void {
    const { app, store } = this;
    if (!app || !store) return;
    store.readonly = this.readonly || this.matches(":disabled");
    store.keepsHistory = this.words.get("history") !== "none";
    store.askCam(this.words.has("mode") ? this.mode === "cam" : null);
    const show = (app: App, panels: string, asked: boolean) => {
      const words = panels.split(/\s+/);
      app.applyOptions(
        this.theme,
        PANEL_NAMES.filter(
          (name) => words.includes(name) && store.rules.shows(name),
        ),
        asked,
      );
    };
    show(app, this.panels, this.words.has("panels"));
    for (const [part, app] of this.lent) show(app, part.panels, true);
  }

  /** Shows panels of the job in another element; returns their content. @internal */
  async attachPanel(
    part: Borrower,
    again?: App,
  ): Promise<{ app: App; styles: CSSStyleSheet[] }> {
    await this.ready;
    const { App, partStyles, styles } = await import("../parts/app.js");
    const app =
      again ??
      new App(this.store as Store, {
        host: this,
        local: false,
        links: false,
        isRemotePanel: true,
      });
    if (!again) {
      if (this.words.has("view")) app.view = this.view;
      this.closes(app);
    }
    this.lent.set(part, app);
    this.applyOptions();
    return { app, styles: [styles, partStyles] };
  }

  /** Ends the panels in another element. @internal */
  detachPanel(part: Borrower): void {
    this.lent.delete(part);
  }

  /** The app that shows the job's picture: in this element or another one. @internal */
  protected get pictured(): App | undefined {
    return (
      [this.app, ...this.lent.values()].find((app) => app?.hasPicture) ??
      this.app
    );
  }

  /** The element fires its own `input` event; inputs in its slots belong to the host page. @internal */
  protected closes(app: App): void {
    app.addEventListener("input", (event) => {
      const [box] = event.composedPath() as Node[];
      if (box?.getRootNode() === app.getRootNode()) event.stopPropagation();
    });
  }

  /** Redraws the picture after custom properties have changed. @internal */
  recolour(): void {
    this.store?.dispatchEvent(new Event("recolour"));
  }
}
