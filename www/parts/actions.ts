// Actions of buttons, menus and lists.
import type { LitElement } from "lit";
import { type Job, JobError, type Message } from "../core/browser.js";
import type { Preset } from "../presets.js";
import type { Store } from "../store.js";
import { w } from "../words.js";
import type { CommandsPart } from "./commands.js";
import type { Export } from "./export.js";
import { OF_THE_JOB } from "./menu.js";
import type { Panel } from "./panels.js";
import type { PastePart } from "./paste.js";
import type { ProgramPart } from "./program-panel.js";
import type { Tools } from "./tools.js";

/** The page on which the actions work. */
interface Page {
  readonly store: Store;
  readonly tools: Tools;
  readonly outlet: Export;
  /** Whether the page is Touchpath's own. */
  readonly links: boolean;
  /** Title of what is shown instead of the job; empty if the job is shown. */
  away(): string;
  isWide(): boolean;
  hasTab(panel: Panel): boolean;
  show(panel: Panel): void;
  /** Shows a panel, in this element or elsewhere on the page. */
  open(panel: Exclude<Panel, "setup">): Promise<void>;
  tell(said: Message | null, passing?: boolean): void;
}

export class Actions {
  /** Whether the gallery adds a feature instead of replacing the cycle. */
  adds = false;
  /** Topic of the manual page that is shown. */
  topic = "";

  constructor(
    private readonly app: LitElement,
    private readonly page: Page,
  ) {}

  /** Runs the action of a button in the bar or the menu. */
  async ask(what: string): Promise<void> {
    const { store } = this.page;
    if (this.page.away() && OF_THE_JOB.has(what)) return;
    const open = (id: string) => {
      const dialog = this.app.querySelector<HTMLDialogElement>(`#${id}`);
      dialog?.showModal();
      // Not by `autofocus`: in a frame of another origin a browser logs a warning.
      dialog?.querySelector<HTMLElement>("h2[tabindex]")?.focus();
    };
    const actions: Record<string, () => unknown> = {
      redo: () => store.redo(),
      gallery: () => {
        this.adds = false;
        return this.page.tools.use(
          this.page.tools.now === "gallery" ? "cycles" : "gallery",
        );
      },
      add: () => {
        this.adds = true;
        return this.page.tools.use("gallery");
      },
      open: () => this.app.querySelector<HTMLInputElement>("#file")?.click(),
      into: () =>
        store.withheld === null &&
        this.app.querySelector<HTMLInputElement>("#into")?.click(),
      paste: () => {
        // From here on, messages are about the pasted text.
        this.page.tell(null);
        this.app.querySelector<PastePart>("tp-paste")?.open();
      },
      reset: async () => {
        await this.page.tools.use("cycles");
        store.reset();
        this.page.tell(
          [
            w(
              "The form is reset to its defaults. Undo restores the previous values",
            ),
          ],
          true,
        );
      },
      undo: () => store.undo(),
      cam: () => {
        store.cam = !store.cam;
        this.app.requestUpdate();
      },
      commands: async () => {
        if (!(await this.page.tools.loads("commands"))) return;
        await this.app.querySelector<CommandsPart>("tp-commands")?.open();
      },
      save: () => this.page.outlet.program(),
      sheet: () => store.withheld === null && this.page.tools.use("sheet"),
      lengths: () => this.page.tools.use("lengths"),
      presets: () =>
        this.page.tools
          .loads("presets")
          .then((there) => there && open("presets")),
      keys: () => open("keys"),
      viewer: () => this.page.tools.use("viewer"),
      program: () => this.page.open("program"),
      table: () => this.page.open("table"),
      measured: () => this.page.open("measured"),
      checks: () => this.page.open("checks"),
      share: () => this.page.links && this.page.outlet.link(),
      "save-job": () => this.page.outlet.job(),
      "save-picture": () => this.page.outlet.picture(),
    };
    await actions[what]?.();
  }

  /** Goes to the field of a path or the first field inside it. Without such a field it opens Checks. */
  async go(wanted: string): Promise<void> {
    await this.page.tools.use("cycles");
    // A field of a cycle that is not active.
    const [, index, rest] = /^cycles\[(\d+)\](.*)$/.exec(wanted) ?? [];
    if (index !== undefined)
      this.page.store.bringFeature(
        this.page.store.features.placeOf(Number(index)),
      );
    const path = index === undefined ? wanted : `cycle${rest}`;
    // The list of tolerances is outside the form.
    const [, listed] =
      /^(tolerances\..+?)(\.(tolerance|action|wear).*)?$/.exec(wanted) ?? [];
    if (listed) {
      await this.page.open("measured");
      await this.app.updateComplete;
      const box = this.app.querySelector<HTMLElement>(`[id="f-${listed}"]`);
      box?.scrollIntoView({ block: "center" });
      box?.focus();
      if (box) return;
    }
    if (this.page.hasTab("setup")) this.page.show("setup");
    await this.app.updateComplete;
    await this.app
      .querySelector<Element & { unfold(path: string): Promise<boolean> }>(
        "tp-form",
      )
      ?.unfold(path);
    const fields = [...this.app.querySelectorAll<HTMLElement>("[id^=f-]")];
    const inside = [`f-${path}.`, `f-${path}[`];
    const field =
      fields.find((one) => one.id === `f-${path}`) ??
      // A line of a text with several lines.
      fields.find((one) => `f-${path}`.startsWith(`${one.id}[`)) ??
      fields.find(
        (one) =>
          one.closest("tp-form") &&
          inside.some((start) => one.id.startsWith(start)),
      );
    if (!field) this.page.show("checks");
    field?.scrollIntoView({ block: "center" });
    // A number that may be null has a checkbox before it.
    const box =
      field?.matches(":disabled") &&
      field.closest(".line")?.querySelector<HTMLElement>(".check input");
    (box || field)?.focus();
  }

  /** Shows these lines of the program. */
  async showLines(lines: number[]): Promise<void> {
    this.page.show("program");
    await this.app.updateComplete;
    // The button that was pressed is no longer visible.
    this.app.querySelector<HTMLElement>("#tab-program")?.focus();
    this.app.querySelector<ProgramPart>("tp-program")?.find(lines);
  }

  /** Opens a page of the manual. */
  async about(topic: string): Promise<void> {
    this.topic = topic;
    await this.page.tools.use("manual");
  }

  /** Focuses the first size of a chosen cycle. On touch screens a focus would open the keyboard over the picture. */
  readonly chosen = async (): Promise<void> => {
    await this.page.tools.use("cycles");
    const size = this.page.store.cycle.fields.find((field) => field.size);
    if (!size || !matchMedia("(pointer: fine)").matches || !this.page.isWide())
      return;
    await this.app.updateComplete;
    this.app.querySelector<HTMLElement>(`[id="f-cycle.${size.key}"]`)?.focus({
      preventScroll: true,
    });
  };

  /** Chooses a cycle or control by its path and name. */
  async choose(what: string): Promise<void> {
    const [path, name = ""] = what.split(":");
    await this.page.tools.use("cycles");
    const { store } = this.page;
    if (path === "cycle.type") store.choose(name as Job["cycle"]["type"]);
    else if (path === "set-up") store.beginSetUp(name);
    else if (path === "units") store.setUnits(name as "mm" | "inch");
    else if (path === "control.form") store.put(path, name);
    else if (!this.refused(name)) store.chooseControl(name);
  }

  /** Reports why a control has no program for the job's cycle; returns false if it has one. */
  private refused(post: unknown): boolean {
    const { store } = this.page;
    const why = store.whyNot(post);
    const title = store.postOf(post)?.title ?? String(post);
    if (why)
      this.page.tell(
        [w("{control} has no program for this cycle: {why}"), title, why],
        true,
      );
    return why !== null;
  }

  /** Applies a stored machine to the job. */
  machine(preset: Preset): void {
    const { post } = (preset.sections.control ?? {}) as { post?: unknown };
    if (this.page.store.postOf(post) && this.refused(post)) return;
    try {
      this.page.store.usePreset(preset);
      this.page.tell([w("The job is now for {machine}"), preset.name], true);
    } catch (thrown) {
      if (!(thrown instanceof JobError)) throw thrown;
      this.page.tell([w("{reason}"), this.page.store.why(thrown)], true);
    }
  }
}
