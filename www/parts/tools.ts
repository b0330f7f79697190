// Tools that replace the job on the page: loaded on demand, left with the browser's Back.
import type { LitElement } from "lit";
import { awaited, type Message, whole } from "../core/browser.js";
import { isObject } from "../job.js";
import { w } from "../words.js";

/** Tools that replace the job's picture and panels: gallery, LENTOAX, manual page, opened program, set-up sheet. */
export type Tool =
  | "gallery"
  | "cycles"
  | "lengths"
  | "manual"
  | "viewer"
  | "sheet";

/** Parts that are loaded once the job is shown, or on demand. */
const LAZY_PARTS: Record<string, () => Promise<unknown>> = {
  gallery: () => import("./gallery.js"),
  commands: () => import("./commands.js"),
  manual: () => import("./manual.js"),
  lengths: () => import("./lentoax.js"),
  viewer: () => import("./viewer.js"),
  sheet: () => import("./sheet.js"),
  presets: () => import("./presets.js"),
};

/** Tools that need the second part of the module. */
const WHOLE = new Set(["lengths", "viewer"]);

/** Milliseconds after which a loading message appears. */
const SOON = 300;
const LOADING: Message = [w("This part of the page is being loaded …")];
export const MISSING: Message = [
  w("This part of the page could not be loaded. Check the network connection"),
];

/** The page's part in showing a tool. */
interface Around {
  /** Whether the page is Touchpath's own: then a tool is an entry of the browser's history. */
  links: boolean;
  tell(text: Message | null): void;
  /** The current message. */
  said(): Message | null;
}

/** The current tool, and the loaded parts. */
export class Tools {
  now: Tool = "cycles";
  /** Loaded parts. An element that is added before its class is defined would lose its properties. */
  readonly there = new Set<string>();

  constructor(
    private readonly app: LitElement,
    private readonly around: Around,
  ) {}

  /** Loads all parts once the page is idle. */
  preload(): void {
    const later = () => {
      if (this.app.isConnected)
        for (const load of Object.values(LAZY_PARTS))
          load().catch(() => undefined);
    };
    // Not while the module is loading: they would share the connection.
    const there = awaited() ?? Promise.resolve();
    there.then(() => setTimeout(later, 500)).catch(() => undefined);
  }

  /** Element that had the focus when the job was left. */
  private opener: HTMLElement | null = null;
  /** Number of requests: the last one is shown, whichever part loads first. */
  private turns = 0;

  /** Number of times that the page itself went back in the history. */
  private backs = 0;

  /** The browser's Back returns to the job: on Touchpath's own page a tool is an entry of the history. */
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

  /** Shows the job or a tool. */
  async use(tool: Tool): Promise<void> {
    const turn = ++this.turns;
    if ((await this.loads(tool)) && turn === this.turns) {
      const leaves = this.now === "cycles" && tool !== "cycles";
      if (leaves) this.opener = this.app.querySelector<HTMLElement>(":focus");
      // Messages about an opened program belong to its picture.
      if (this.now === "viewer" && tool !== "viewer") this.around.tell(null);
      this.enter(tool);
      this.now = tool;
      this.app.requestUpdate();
      if (tool !== "cycles") return;
      await this.app.updateComplete;
      // Returns the focus to the element that opened the tool, if nothing else has it.
      if (!this.app.querySelector(":focus") && this.opener?.checkVisibility())
        this.opener.focus({ preventScroll: true });
      this.opener = null;
    }
  }

  /** Loads the second part of the module, with a message if it takes a while. */
  async whole(): Promise<void> {
    const late = setTimeout(() => this.around.tell(LOADING), SOON);
    try {
      await whole();
    } finally {
      clearTimeout(late);
    }
    if (this.around.said() === LOADING) this.around.tell(null);
  }

  /** Loads a part; returns false if that fails. */
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
