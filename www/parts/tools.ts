// What takes the place of the job on the page: loaded when it is asked for, and left by the browser's Back.
import type { LitElement } from "lit";
import { awaited, type Message, whole } from "../core/browser.js";
import { isObject } from "../job.js";
import { w } from "../words.js";

/** What takes the place of the job's picture and panels: pictures to choose from, LENTOAX, a page of the manual, a program that says no job, a page to print. */
export type Tool =
  | "gallery"
  | "cycles"
  | "lengths"
  | "manual"
  | "viewer"
  | "sheet";

/** What is loaded when the job is on the screen, or when it is asked for before. */
const LAZY_PARTS: Record<string, () => Promise<unknown>> = {
  gallery: () => import("./gallery.js"),
  commands: () => import("./commands.js"),
  manual: () => import("./manual.js"),
  lengths: () => import("./lentoax.js"),
  viewer: () => import("./viewer.js"),
  sheet: () => import("./sheet.js"),
  presets: () => import("./presets.js"),
};

/** What needs the rest of the module. */
const WHOLE = new Set(["lengths", "viewer"]);

/** Milliseconds after which the user sees that something is being loaded. */
const SOON = 300;
const LOADING: Message = [w("This part of the page is being loaded …")];
export const MISSING: Message = [
  w("This part of the page could not be loaded: is there a network?"),
];

/** What the page does for it. */
interface Around {
  /** Whether the page is Touchpath's own: then what is shown is an entry of the browser's history. */
  links: boolean;
  tell(text: Message | null): void;
  /** What is being told. */
  said(): Message | null;
}

/** Which of them is shown, and which are loaded. */
export class Tools {
  now: Tool = "cycles";
  /** Loaded parts: an element that is put into the page before its class is known would lose its properties. */
  readonly there = new Set<string>();

  constructor(
    private readonly app: LitElement,
    private readonly around: Around,
  ) {}

  /** Loads everything once the page is idle. */
  preload(): void {
    const later = () => {
      if (this.app.isConnected)
        for (const load of Object.values(LAZY_PARTS))
          load().catch(() => undefined);
    };
    // Not while the module is still to come: they would share its line.
    const there = awaited() ?? Promise.resolve();
    there.then(() => setTimeout(later, 500)).catch(() => undefined);
  }

  /** What had the focus when the job was left. */
  private opener: HTMLElement | null = null;
  /** Counts what was asked for: what was asked for last is shown, whatever is loaded first. */
  private turns = 0;

  /** How often the browser was sent back by the page itself. */
  private backs = 0;

  /** Back in the browser is back to the job: what takes its place is an entry of the history, on Touchpath's own page. */
  private enter(tool: Tool): void {
    if (!this.around.links || tool === this.now) return;
    const entered = isObject(history.state) && "touchpath" in history.state;
    const state = { touchpath: tool };
    if (tool === "cycles") {
      if (!entered) return;
      this.backs++;
      history.back();
    } else if (entered) history.replaceState(state, "");
    else history.pushState(state, "");
  }

  /** The browser went back or forward. */
  readonly went = (event: PopStateEvent): void => {
    if (this.backs > 0) this.backs--;
    else if (!isObject(event.state) || !("touchpath" in event.state))
      this.use("cycles");
  };

  /** Shows the job or what takes its place. */
  async use(tool: Tool): Promise<void> {
    const turn = ++this.turns;
    if ((await this.loads(tool)) && turn === this.turns) {
      const leaves = this.now === "cycles" && tool !== "cycles";
      if (leaves) this.opener = this.app.querySelector<HTMLElement>(":focus");
      // What is said of an opened program belongs to its picture.
      if (this.now === "viewer" && tool !== "viewer") this.around.tell(null);
      this.enter(tool);
      this.now = tool;
      this.app.requestUpdate();
      if (tool !== "cycles") return;
      await this.app.updateComplete;
      // Back where it came from, where nothing else has the focus.
      if (!this.app.querySelector(":focus") && this.opener?.checkVisibility())
        this.opener.focus({ preventScroll: true });
      this.opener = null;
    }
  }

  /** Loads the rest of the module, and says so where that takes a while. */
  async whole(): Promise<void> {
    const late = setTimeout(() => this.around.tell(LOADING), SOON);
    try {
      await whole();
    } finally {
      clearTimeout(late);
    }
    if (this.around.said() === LOADING) this.around.tell(null);
  }

  /** Loads what was not needed until now; false where it cannot be had. */
  async loads(what: string): Promise<boolean> {
    try {
      await Promise.all([
        LAZY_PARTS[what]?.(),
        WHOLE.has(what) ? this.whole() : null,
      ]);
      this.there.add(what);
      this.app.requestUpdate();
      await this.app.updateComplete;
      return true;
    } catch {
      this.around.tell(MISSING);
      return false;
    }
  }
}
