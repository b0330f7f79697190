import { html, LitElement, nothing, type TemplateResult } from "lit";
import { repeat } from "lit/directives/repeat.js";
import {
  awaited,
  type Job,
  JobError,
  type ProgramMoves,
  type Said,
  whole,
} from "../core/browser.js";
import { hold } from "../hold.js";
import { isObject } from "../job.js";
import { keepTheme, kept, keptTheme } from "../persistence.js";
import type { Preset } from "../presets.js";
import { readAs } from "../sentences.js";
import { Store } from "../store.js";
import { css } from "../styles.js";
import { askFor } from "../tasks.js";
import { w } from "../words.js";
import { letterOf } from "./keys.js";
import "./bar.js";
import "./checks.js";
import "./features.js";
import "./amount.js";
import "./findings.js";
import "./form.js";
import "./help.js";
import "./measured.js";
import type { CommandsPart } from "./commands.js";
import { Export } from "./export.js";
import { Intake, type Viewed } from "./intake.js";
import { Language } from "./language.js";
import {
  actions,
  dialogs,
  type Frame,
  menu,
  OF_THE_JOB,
  type Theme,
} from "./menu.js";
import { Part } from "./part.js";
import type { PastePart } from "./paste.js";
import "./paste.js";
import type { PicturePart } from "./picture.js";
import "./picture.js";
import type { ProgramPart } from "./program-panel.js";
import "./program-panel.js";
import { Refocus } from "./refocus.js";
import "./results.js";
import { isShort } from "./shown.js";
import "./table.js";

export { awaited, hold, kept, Store };

/** The styles of everything inside the element. */
export const styles = new CSSStyleSheet();
styles.replaceSync(css);

/** What panels elsewhere on the page have otherwise: they may be as low as the page around likes. */
export const partStyles = new CSSStyleSheet();
partStyles.replaceSync(":host { min-height: 8rem; }");

const PANELS = {
  setup: w("Setup"),
  results: w("Results"),
  program: w("Program"),
  table: w("Parameters"),
  measured: w("Measured values, report"),
  checks: w("Checks"),
} as const;
/** Short label for a narrow tab. */
const MEASURED = w("Measured");
type Panel = keyof typeof PANELS;
const NAME_OF = {
  setup: "form",
  results: "results",
  program: "program",
  table: "table",
  measured: "results",
  checks: "checks",
} as const satisfies Record<Panel, string>;
/** What the element may leave out. */
type PanelName = "stage" | (typeof NAME_OF)[Panel];

/** From this width on the form has a column of its own; the style sheet knows the same width. */
const WIDE = 1080;
/** Below this width picture and panel stand on each other; the style sheet knows the same width. */
const NARROW = 600;

/** What takes the place of the job's picture and panels: pictures to choose from, LENTOAX, a page of the manual, a program that says no job, a page to print. */
type Tool = "gallery" | "cycles" | "lengths" | "manual" | "viewer" | "sheet";

/** What is loaded when the job is on the screen, or when it is asked for before. */
const LATER: Record<string, () => Promise<unknown>> = {
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
const LOADING: Said = [w("This part of the page is being loaded …")];
const MISSING: Said = [
  w("This part of the page could not be loaded: is there a network?"),
];

const system = matchMedia("(prefers-color-scheme: dark)");
/** Colours that the user has chosen for every page. */
const forced = matchMedia("(forced-colors: active)");

type View = PicturePart["from"];

/** The element around the page. */
interface Host extends HTMLElement {
  theme: Theme;
  /** Dispatches an event; false where a listener has cancelled it. */
  tell(
    name: "program-save",
    detail: { name: string; text: string; post: string; extension: string },
  ): boolean;
}

/** What the element is in. */
interface Around {
  host: Host;
  /** Whether presets, theme and language are kept in this browser. */
  local: boolean;
  /** Whether links are followed and handed out. */
  links: boolean;
  /** Whether it shows panels of the job of another element: without bar and foot, and in the language of that element. */
  lent?: boolean;
}

/** What shows a job: its element, and what shows panels of it elsewhere on the page. */
const showing = new WeakMap<Store, Set<App>>();
function shown(store: Store): Set<App> {
  const all = showing.get(store) ?? new Set<App>();
  showing.set(store, all);
  return all;
}
/** Other panels are shown than before: what leads to them is drawn anew. */
function redrawn(store: Store): void {
  for (const app of shown(store)) app.requestUpdate();
}

/** The whole page. What fits beside the picture has a place of its own; the rest is behind tabs. */
export class App extends LitElement {
  private panel: Panel | null = null;
  private tool: Tool = "cycles";
  /** Whether the gallery adds a feature instead of replacing the cycle. */
  private adds = false;
  /** The page of the manual that is shown. */
  private topic = "";
  private viewed: Viewed | null = null;
  /** The moves that are shown of it, once it has run. */
  private shownMoves: ProgramMoves | null = null;
  /** What is said of the job: of the whole document above it, of the job as it is now in the foot, where nothing moves when it goes. */
  private said: {
    text: Said;
    passing: boolean;
    at: number;
    foot: boolean;
  } | null = null;
  /** Takes a newer version of the page, where there is one. */
  private newer: (() => void) | null = null;
  private width = WIDE;
  private height = 0;
  private wanted: PanelName[] = [];
  private theme: Theme = "auto";
  private readonly observer = new ResizeObserver(() => this.measure());
  private readonly language: Language | null;
  private readonly intake: Intake;
  private readonly outlet: Export;
  /** What has been loaded: what stands in the page before its class is known would lose what it was given. */
  private readonly there = new Set<string>();

  constructor(
    private readonly store: Store,
    private readonly around: Around,
  ) {
    super();
    if (store.notice && !around.lent) this.tell(store.notice);
    new Refocus(this);
    this.language = around.lent
      ? null
      : new Language(this, store, around, () => {
          this.tell(MISSING);
          const choice =
            this.renderRoot?.querySelector<HTMLSelectElement>("#lang");
          if (choice) choice.value = store.lang;
        });
    this.intake = new Intake(store, {
      tell: (text) => this.tell(text === "" ? null : [text]),
      showsResults: () => this.panels.includes("results"),
      showResults: async () => {
        await this.use("cycles");
        this.show(this.panels.includes("measured") ? "measured" : "results");
      },
      showJob: () => this.use("cycles"),
      forCam: () => {
        this.store.cam = true;
      },
      showMoves: (viewed) => {
        this.viewed = viewed;
        this.shownMoves = null;
        this.use("viewer");
        // The page keeps the editor of long programs for when there is no network.
        if (!isShort(viewed.text))
          this.around.host.dispatchEvent(
            new CustomEvent("wanted", { detail: "editor" }),
          );
      },
      whole: () => this.whole(),
      beside: (text, signal) =>
        askFor(this.around.host, { read: text }, signal),
    });
    this.outlet = new Export(store, {
      tell: (said) => this.tell(said, true),
      show: (link) => this.tell([link], true, false),
      saved: (name, other) => {
        const program =
          this.renderRoot.querySelector<ProgramPart>("tp-program");
        const said: Said = other
          ? [
              w("Saved {file}, with other content than the one saved before"),
              name,
            ]
          : [w("Saved {file}"), name];
        if (program?.checkVisibility()) program.tell(store.say(said));
        else this.tell(said, true);
      },
      offer: (saving) => around.host.tell("program-save", saving),
      picture: () => this.picture,
      view: () => this.view,
    });
    const theme =
      around.local && !around.host.hasAttribute("theme") ? keptTheme() : null;
    if (theme) around.host.setAttribute("theme", theme);
  }

  /** The parts share the styles of the element around. */
  protected override createRenderRoot(): HTMLElement {
    return this;
  }

  /** Whether the page around has asked for the parameters by name. */
  private asked = false;

  /** What is shown, and in which colours; `asked`: the parameters were asked for by name. */
  applyOptions(theme: Theme, panels: PanelName[], asked: boolean): void {
    this.theme = theme;
    this.asked = asked;
    this.wanted = panels;
    redrawn(this.store);
    this.recolour();
    this.requestUpdate();
  }

  /** To the first field, or else to the picture. */
  focusFirst(options?: FocusOptions): void {
    const places = [
      "tp-form :is(input, select):enabled",
      "tp-bar select:enabled",
      "canvas[tabindex]",
      ".code [tabindex]",
    ];
    const all = places.flatMap((place) => [
      ...this.querySelectorAll<HTMLElement>(place),
    ]);
    all.find((one) => one.checkVisibility())?.focus(options);
  }

  /** The view of the picture; without one, the view that it will have. */
  get view(): View {
    return this.picture?.from ?? this.sight;
  }

  set view(view: View) {
    this.sight = view;
    if (this.picture) this.picture.from = view;
  }

  /** What the page around asks for, and the picture that has it already. */
  private sight: View = "top";
  private turned: PicturePart | null = null;

  private get picture(): PicturePart | null {
    return this.renderRoot.querySelector<PicturePart>("tp-picture");
  }

  /** Whether the picture of the job is among what is shown. */
  get hasPicture(): boolean {
    return this.picture !== null;
  }

  /** The picture as an SVG; null without a plan. */
  svg(): string | null {
    return this.store.blank ? null : this.outlet.svg();
  }

  /** Saves the program; false if the job has errors. */
  save(): boolean {
    return this.outlet.program();
  }

  private get panels(): Panel[] {
    const fits = (panel: Panel) =>
      this.wanted.includes(NAME_OF[panel]) &&
      (panel !== "table" || this.hasTable) &&
      (panel !== "measured" || this.width >= WIDE) &&
      (panel !== "setup" || this.width < WIDE || !this.wanted.includes("form"));
    return (Object.keys(PANELS) as Panel[]).filter(fits);
  }

  /** Whether to show the parameters. A host page that shows single panels has to request them. */
  private get hasTable(): boolean {
    return this.asked || this.store.cam || this.around.links;
  }

  override connectedCallback(): void {
    super.connectedCallback();
    this.measure();
    this.observer.observe(this);
    const { intake } = this;
    this.keys.addEventListener("paste", this.pasted);
    this.addEventListener("drop", intake.refuse);
    this.addEventListener("dragover", intake.welcome);
    this.keys.addEventListener("keydown", this.shortcut);
    this.addEventListener("focusin", this.unhelp);
    this.store.addEventListener("change", this.forget);
    this.store.addEventListener("told", this.pass);
    this.store.addEventListener("cam", this.redraw);
    this.store.addEventListener("language", this.reworded);
    this.reworded();
    shown(this.store).add(this);
    redrawn(this.store);
    this.around.host.addEventListener("update-ready", this.offer);
    for (const query of [system, forced])
      query.addEventListener("change", this.recolour);
    if (!this.around.links) return;
    addEventListener("hashchange", intake.link);
    addEventListener("popstate", this.went);
    intake.link();
  }

  override disconnectedCallback(): void {
    super.disconnectedCallback();
    this.observer.disconnect();
    const { intake } = this;
    intake.stop();
    this.keys.removeEventListener("paste", this.pasted);
    this.removeEventListener("drop", intake.refuse);
    this.removeEventListener("dragover", intake.welcome);
    this.keys.removeEventListener("keydown", this.shortcut);
    this.removeEventListener("focusin", this.unhelp);
    this.store.removeEventListener("change", this.forget);
    this.store.removeEventListener("told", this.pass);
    this.store.removeEventListener("cam", this.redraw);
    this.store.removeEventListener("language", this.reworded);
    shown(this.store).delete(this);
    redrawn(this.store);
    this.around.host.removeEventListener("update-ready", this.offer);
    for (const query of [system, forced])
      query.removeEventListener("change", this.recolour);
    removeEventListener("hashchange", intake.link);
    removeEventListener("popstate", this.went);
  }

  override render(): TemplateResult {
    const { store, wanted, frame, said, away } = this;
    const narrow = this.width < NARROW;
    const stacked = narrow || (this.width < WIDE && this.height > this.width);
    const panels = this.panels;
    const active =
      this.panel && panels.includes(this.panel) ? this.panel : panels[0];
    const hidden = (panel: Panel) => panels.includes(panel) && panel !== active;
    const shows = (name: PanelName) => wanted.includes(name);
    const none = (name: string, is: boolean) => (is ? name : "");
    const role = panels.length < 2 ? nothing : "tabpanel";
    // A wide page shows the state of the job above the results.
    const beside = this.width >= WIDE && panels.length > 0 && !this.around.lent;
    const first =
      this.width >= WIDE && active === "results" && panels.length > 1;
    const findings = html`<tp-findings .store=${store} .panels=${this.everywhere} .alone=${this.around.links} .said=${said?.foot ? said.text : null} .saves=${narrow} .tall=${beside}></tp-findings>`;
    const shape = [
      none("with-state", beside),
      none("results-first", first),
      none("wide-panel", active === "program" || active === "table"),
      none("stacked", stacked && !narrow),
      none("no-form", !shows("form")),
      none("no-stage", !shows("stage")),
      none("no-tabs", !panels.length),
    ];
    return html`
      <div class="frame" @ask=${(e: CustomEvent<string>) => this.ask(e.detail)} @about=${(e: CustomEvent<string>) => this.about(e.detail)} @choose=${(e: CustomEvent<string>) => this.choose(e.detail)}
        @machine=${(e: CustomEvent<Preset>) => this.machine(e.detail)} @say=${(e: CustomEvent<Said>) => this.tell(e.detail, true)} @go=${(e: CustomEvent<string>) => this.find(e.detail)} @lines=${(e: CustomEvent<number[]>) => this.with("program").showLines(e.detail)}>
      <header part="bar" ?hidden=${this.around.lent}>
        <slot name="header"><h1 role=${this.around.links ? nothing : "presentation"}>Touchpath</h1></slot>
        <tp-bar .store=${store} .links=${this.around.links} .local=${this.around.local} .away=${away} .opened=${this.opened} .saves=${!narrow}></tp-bar>
        <input id="file" class="unseen" type="file" tabindex="-1" aria-label=${this.t("Open a file")} accept=${this.intake.readable} @change=${this.intake.chosen} />
        ${menu(frame)}
      </header>
      <div class="notes">
      ${this.newer ? html`<p class="note" role="status">${this.t("A newer version of this page is here.")} <button type="button" @click=${this.newer}>${this.t("Load it")}</button> ${this.t("The job is kept.")}</p>` : nothing}
      ${said && !said.foot ? html`<p class="note" role="status"><span>${store.say(said.text)}</span> <button type="button" class="ok" @click=${() => this.tell(null)}>OK</button></p>` : nothing}
      ${
        this.tool === "cycles"
          ? nothing
          : html`<p class="back"><button type="button" @click=${() => this.use("cycles")}><span aria-hidden="true">←</span> ${this.t("Back to the job")}</button></p>`
      }
      </div>
      <main role=${this.around.links ? nothing : "group"} aria-label=${this.around.links ? nothing : this.t("Job")} class=${shape.join(" ").trim()} ?hidden=${this.tool !== "cycles"}>
        ${repeat(
          // One order for eye and Tab: on a narrow page, and on one that is higher than wide, the picture stands above the form.
          (stacked
            ? (["stage", "form"] as const)
            : (["form", "stage"] as const)
          ).filter(shows),
          (name) => name,
          (name) =>
            name === "stage"
              ? html`<section class="picture" part="stage" aria-label=${this.t("Picture")}><tp-picture .store=${store}></tp-picture></section>`
              : html`<section class="setup" part="form" id="panel-setup" role=${panels.includes("setup") ? role : nothing} aria-label=${this.t("Setup")} ?hidden=${hidden("setup")}>
          <tp-form .store=${store}></tp-form>
          <tp-help .store=${store}></tp-help>
        </section>`,
        )}
        ${beside ? html`<section class="state" part="verdict" aria-label=${this.t("State of the job")}>${findings}</section>` : nothing}
        <div class="tabs" part="tabs" role="tablist" aria-label=${this.t("Panels")} aria-orientation=${first ? "vertical" : "horizontal"} ?hidden=${panels.length < 2}>
          ${panels.map(
            (
              panel,
            ) => html`<button type="button" role="tab" id=${`tab-${panel}`} aria-controls=${`panel-${panel}`} tabindex=${panel === active ? 0 : -1}
            aria-selected=${panel === active ? "true" : "false"} @click=${() => this.show(panel)} @keydown=${(e: KeyboardEvent) => this.key(e, panels, panel)}><span>${this.t(panel === "measured" && !first ? MEASURED : PANELS[panel])}</span>${panel === "checks" ? html`<tp-badge aria-hidden="true" .store=${store}></tp-badge>` : nothing}${first ? html`<tp-amount aria-hidden="true" .store=${store} .of=${panel}></tp-amount>` : nothing}</button>`,
          )}
        </div>
        ${panels.includes("results") ? html`<section class="panel scrolls" part="panel results" id="panel-results" role=${role} aria-label=${this.t("Results")} ?hidden=${hidden("results")}><tp-results .store=${store}></tp-results>${panels.includes("measured") ? nothing : html`<tp-measured .store=${store}></tp-measured>`}</section>` : nothing}
        ${panels.includes("program") ? html`<section class="panel" part="panel program" id="panel-program" role=${role} aria-label=${this.t("Program")} ?hidden=${hidden("program")}><tp-program .store=${store}></tp-program></section>` : nothing}
        ${panels.includes("table") ? html`<section class="panel" part="panel table" id="panel-table" role=${role} aria-label=${this.t("Parameters")} ?hidden=${hidden("table")}><tp-table .store=${store}></tp-table></section>` : nothing}
        ${panels.includes("measured") ? html`<section class="panel scrolls" part="panel measured" id="panel-measured" role=${role} aria-label=${this.t(PANELS.measured)} ?hidden=${hidden("measured")}><tp-measured .store=${store}></tp-measured></section>` : nothing}
        ${panels.includes("checks") ? html`<section class="panel scrolls" part="panel checks" id="panel-checks" role=${role} aria-label=${this.t("Checks")} ?hidden=${hidden("checks")}><tp-checks .store=${store} .linked=${this.everywhere.includes("program")}></tp-checks></section>` : nothing}
      </main>
      ${this.tool === "gallery" ? html`<tp-gallery role="main" .store=${store} .adds=${this.adds} @chosen=${this.chosen}></tp-gallery>` : nothing}
      ${this.tool === "manual" ? html`<tp-manual role="main" tabindex="0" .store=${store} .topic=${this.topic} @chosen=${this.chosen}></tp-manual>` : nothing}
      ${this.tool === "viewer" && this.viewed ? html`<tp-viewer role="main" .store=${store} .viewed=${this.viewed} @adopt=${(e: CustomEvent<Job>) => this.intake.adopt(e.detail)} @shown=${(e: CustomEvent<ProgramMoves>) => this.showsMoves(e.detail)}></tp-viewer>` : nothing}
      ${this.tool === "lengths" ? html`<tp-lentoax role="main" .store=${store} @taken=${() => this.use("cycles")}></tp-lentoax>` : nothing}
      ${this.tool === "sheet" ? html`<tp-sheet role="main" .store=${store}></tp-sheet>` : nothing}
      <footer part="footer" ?hidden=${this.around.lent || (beside && away === "" && !this.around.host.querySelector("[slot=footer]"))} aria-label=${this.t("State of the job")}>${away ? html`<div class="foot">${this.tool === "viewer" ? html`<p class="verdict warning">${this.t("Not checked, not proven: this only follows the program's words.")}</p>` : html`<p class="verdict">${away}</p>`}</div>` : beside ? nothing : findings}<slot name="footer"></slot></footer>
      ${dialogs(frame)}
      ${this.there.has("commands") ? html`<tp-commands .store=${store} .actions=${actions(frame)}></tp-commands>` : nothing}
      <tp-paste .store=${store} .take=${this.intake.pasted} .stop=${() => this.intake.stop()} .said=${said && !said.foot ? store.say(said.text) : ""}></tp-paste>
      </div>
    `;
  }

  private showsMoves(moves: ProgramMoves): void {
    this.shownMoves = moves;
    this.requestUpdate();
  }

  /** Sentence of the opened program; empty while the job is shown. */
  private get opened(): string {
    if (this.tool !== "viewer" || !this.viewed) return "";
    const { name } = this.viewed;
    const moves = this.shownMoves ?? this.viewed.moves;
    const touches = moves.kind.filter((k) => moves.kinds[k] === "probe").length;
    return this.t(
      "Read {file} as {dialect}: {count} moves, {touches} of them touches",
      name ?? this.t("the text"),
      readAs(moves),
      moves.kind.length,
      touches,
    );
  }

  /** What is shown instead of the job, in words: then nothing of the job is changed or handed out. Empty where the job is shown. */
  private get away(): string {
    if (this.tool === "viewer")
      return this.t("An opened program is shown, not the job");
    return this.tool === "lengths"
      ? this.t("Tool lengths are shown, not the job")
      : "";
  }

  /** What menu and dialogs show, and what they do. */
  private get frame(): Frame {
    const { store, around, theme, away } = this;
    return {
      store,
      local: around.local,
      links: around.links,
      away: away !== "",
      viewed: this.viewed !== null,
      theme,
      presets: this.there.has("presets"),
      look: () => this.requestUpdate(),
      choose: (what) => {
        this.renderRoot.querySelector<HTMLElement>("#menu")?.hidePopover();
        // The item is gone: what follows comes back to the menu's button, however long it takes.
        this.renderRoot
          .querySelector<HTMLElement>("tp-bar [popovertarget]")
          ?.focus({ preventScroll: true });
        this.ask(what);
      },
      chooseLanguage: (lang) => this.language?.choose(lang),
      chooseTheme: (theme) => {
        around.host.theme = theme;
        if (around.local) keepTheme(theme);
      },
    };
  }

  /** Shows everything in the language that is wanted, once its words are there. */
  async reword(): Promise<void> {
    await this.language?.follow();
  }

  protected override firstUpdated(): void {
    const later = () => {
      if (this.isConnected)
        for (const load of Object.values(LATER)) load().catch(() => undefined);
    };
    // Not while the module is still to come: they would share its line.
    const there = awaited() ?? Promise.resolve();
    there.then(() => setTimeout(later, 500)).catch(() => undefined);
  }

  /** Waits for the module, and draws what is shown without it. */
  async arrived(): Promise<void> {
    await awaited();
    this.picture?.requestUpdate();
    await this.picture?.updateComplete;
  }

  protected override updated(): void {
    const { picture } = this;
    if (picture && picture !== this.turned) picture.from = this.sight;
    this.turned = picture;
    for (const part of this.renderRoot.querySelectorAll(
      "main:not([hidden]) > section:not([hidden]) > *",
    ))
      if (part instanceof Part) part.catchUp();
  }

  private measure(): void {
    const { width: wide, height } = this.getBoundingClientRect();
    const width = wide || WIDE;
    const turned = height > width !== this.height > this.width;
    if (width === this.width && !turned) return;
    this.width = width;
    this.height = height;
    this.keepPlace();
  }

  /** Renders again; the form, which may be put elsewhere, keeps its place and the focus. */
  private async keepPlace(): Promise<void> {
    const at = this.querySelector<HTMLElement>("tp-form :focus");
    const top = this.querySelector("tp-form")?.scrollTop ?? 0;
    this.requestUpdate();
    await this.updateComplete;
    if (!at?.checkVisibility()) return;
    if (!at.matches(":focus")) {
      at.focus({ preventScroll: true });
      this.querySelector("tp-form")?.scrollTo({ top, behavior: "instant" });
    }
    at.scrollIntoView({ block: "nearest" });
  }

  private show(panel: Panel): void {
    this.panel = panel;
    this.requestUpdate();
  }

  private key(event: KeyboardEvent, panels: Panel[], panel: Panel): void {
    const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
    if (!step) return;
    const next = panels[
      (panels.indexOf(panel) + step + panels.length) % panels.length
    ] as Panel;
    this.show(next);
    this.updateComplete.then(() =>
      this.renderRoot.querySelector<HTMLElement>(`#tab-${next}`)?.focus(),
    );
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
      if (!this.renderRoot.querySelector("dialog[open]")) this.ask("commands");
      return;
    }
    if (key === "s") {
      this.ask("save");
      return;
    }
    // A field that is not the job's changes none, and no job is changed that is not seen. Left to the browser, the key would take
    // back the last letter of any field of the page.
    const seen =
      this.tool === "cycles" && !this.renderRoot.querySelector("dialog[open]");
    const other =
      at.matches("input[type=text], input[type=search]") &&
      !at.closest("tp-form");
    if (!seen || other) return;
    if (key === "y" || event.shiftKey) this.store.redo();
    else this.store.undo();
  };

  /** What is pasted beside every field is opened, as a file would be. */
  private readonly pasted = (event: Event): void => {
    if (!(event instanceof ClipboardEvent)) return;
    const at = event.composedPath()[0] as Element;
    if (!this.owns(at)) return;
    const typed =
      at.matches("input, textarea, [contenteditable]") ||
      this.renderRoot.querySelector("dialog[open]");
    if (typed || this.store.readonly) this.intake.refuse(event);
    else this.intake.paste(event);
  };

  /** Where keys are heard: on Touchpath's own page everywhere, so that a click beside everything does not make them dead. */
  private get keys(): EventTarget {
    return this.around.links ? document : this;
  }

  /** Whether keys that are pressed here are the job's: what the page around has put into a slot is its own. */
  private owns(at: Element): boolean {
    return (
      this.contains(at) || (this.around.links && at.contains(this.around.host))
    );
  }

  /** From anything else back to the job; a field, a dialog and the menu have Escape for themselves. */
  private escape(event: KeyboardEvent): void {
    const at = event.composedPath()[0] as Element;
    if (this.tool === "cycles" || event.defaultPrevented || !this.owns(at))
      return;
    const empty =
      at instanceof HTMLInputElement && at.type === "search" && at.value === "";
    if (
      (at.matches("input, select, textarea") && !empty) ||
      this.renderRoot.querySelector("dialog[open], :popover-open")
    )
      return;
    event.preventDefault();
    this.use("cycles");
  }

  /** The help belongs to the field in focus; without one, no help is shown. */
  private readonly unhelp = (event: Event): void => {
    const inside = (event.composedPath()[0] as Element).closest?.(
      "tp-form, tp-bar, tp-help",
    );
    if (!inside) this.store.focus(null);
  };

  /** What is said of one job is not said of another; what is passing, of no later one. */
  private readonly forget = (): void => {
    const { document, revision } = this.store;
    if (this.said && this.said.at !== (this.said.passing ? revision : document))
      this.tell(null);
  };

  private readonly redraw = () => this.requestUpdate();

  /** The job is shown in another language: what shows its panels elsewhere follows. */
  private readonly reworded = (): void => {
    if (!this.around.lent) return;
    this.lang = this.store.lang;
    this.requestUpdate();
  };

  /** Whether a panel can be seen here. */
  private sees(panel: PanelName): boolean {
    return this.wanted.includes(panel) && this.checkVisibility();
  }

  /** What shows a panel of the job: this, or else what shows its panels elsewhere on the page; this where nothing does. */
  private with(panel: PanelName): App {
    if (this.sees(panel)) return this;
    return [...shown(this.store)].find((app) => app.sees(panel)) ?? this;
  }

  /** To a field, wherever the form is shown. */
  find(path: string): void {
    this.with("form").go(path);
  }

  /** All panels that are shown, here or elsewhere. */
  private get everywhere(): PanelName[] {
    return [...new Set([...shown(this.store)].flatMap((app) => app.wanted))];
  }

  /** Says what the store has done beside what it was asked for. */
  private readonly pass = (event: Event): void => {
    // Once: in the element itself where that is seen, or else where what it is about is typed.
    const all = [...shown(this.store)];
    const one =
      all.find((app) => !app.around.lent && app.checkVisibility()) ??
      all.find((app) => app.sees("form"));
    if ((one ?? all[0]) === this)
      this.tell((event as CustomEvent<Said>).detail, true);
  };

  /** To the field of a path, or to the first one inside it; to Checks if no field is found. */
  private async go(wanted: string): Promise<void> {
    await this.use("cycles");
    // A field of a cycle that is not in the form.
    const [, index, rest] = /^cycles\[(\d+)\](.*)$/.exec(wanted) ?? [];
    if (index !== undefined)
      this.store.bringFeature(this.store.features.placeOf(Number(index)));
    const path = index === undefined ? wanted : `cycle${rest}`;
    // The list of tolerances is outside the form.
    const [, listed] =
      /^(tolerances\..+?)(\.(tolerance|action|wear).*)?$/.exec(wanted) ?? [];
    if (listed) {
      await this.open("measured");
      await this.updateComplete;
      const box = this.querySelector<HTMLElement>(`[id="f-${listed}"]`);
      box?.scrollIntoView({ block: "center" });
      box?.focus();
      if (box) return;
    }
    if (this.panels.includes("setup")) this.show("setup");
    await this.updateComplete;
    await this.renderRoot
      .querySelector<Element & { unfold(path: string): Promise<boolean> }>(
        "tp-form",
      )
      ?.unfold(path);
    const fields = [...this.querySelectorAll<HTMLElement>("[id^=f-]")];
    const inside = [`f-${path}.`, `f-${path}[`];
    const field =
      fields.find((one) => one.id === `f-${path}`) ??
      fields.find(
        (one) =>
          one.closest("tp-form") &&
          inside.some((start) => one.id.startsWith(start)),
      );
    if (!field) this.show("checks");
    field?.scrollIntoView({ block: "center" });
    // A number that is left out has its box in front of it.
    const box =
      field?.matches(":disabled") &&
      field.closest(".line")?.querySelector<HTMLElement>(".check input");
    (box || field)?.focus();
  }

  /** To these lines of the program. */
  private async showLines(lines: number[]): Promise<void> {
    this.show("program");
    await this.updateComplete;
    // The button that was pressed is no longer seen.
    this.querySelector<HTMLElement>("#tab-program")?.focus();
    this.querySelector<ProgramPart>("tp-program")?.find(lines);
  }

  /** What had the focus when the job was left. */
  private opener: HTMLElement | null = null;
  /** Counts what was asked for: what was asked for last is shown, whatever is loaded first. */
  private turns = 0;

  /** How often the browser was sent back by the page itself. */
  private backs = 0;

  /** Back in the browser is back to the job: what takes its place is an entry of the history, on Touchpath's own page. */
  private enter(tool: Tool): void {
    if (!this.around.links || tool === this.tool) return;
    const entered = isObject(history.state) && "touchpath" in history.state;
    const state = { touchpath: tool };
    if (tool === "cycles") {
      if (!entered) return;
      this.backs++;
      history.back();
    } else if (entered) history.replaceState(state, "");
    else history.pushState(state, "");
  }

  private readonly went = (event: PopStateEvent): void => {
    if (this.backs > 0) this.backs--;
    else if (!isObject(event.state) || !("touchpath" in event.state))
      this.use("cycles");
  };

  private async use(tool: Tool): Promise<void> {
    const turn = ++this.turns;
    if ((await this.loads(tool)) && turn === this.turns) {
      const leaves = this.tool === "cycles" && tool !== "cycles";
      if (leaves) this.opener = this.querySelector<HTMLElement>(":focus");
      // What is said of an opened program belongs to its picture.
      if (this.tool === "viewer" && tool !== "viewer") this.tell(null);
      this.enter(tool);
      this.tool = tool;
      this.requestUpdate();
      if (tool !== "cycles") return;
      await this.updateComplete;
      // Back where it came from, where nothing else has the focus.
      if (!this.querySelector(":focus") && this.opener?.checkVisibility())
        this.opener.focus({ preventScroll: true });
      this.opener = null;
    }
  }

  /** Loads the rest of the module, and says so where that takes a while. */
  private async whole(): Promise<void> {
    const late = setTimeout(() => this.tell(LOADING), SOON);
    try {
      await whole();
    } finally {
      clearTimeout(late);
    }
    if (this.said?.text === LOADING) this.tell(null);
  }

  /** Loads what was not needed until now; false where it cannot be had. */
  private async loads(what: string): Promise<boolean> {
    try {
      await Promise.all([
        LATER[what]?.(),
        WHOLE.has(what) ? this.whole() : null,
      ]);
      this.there.add(what);
      this.requestUpdate();
      await this.updateComplete;
      return true;
    } catch {
      this.tell(MISSING);
      return false;
    }
  }

  /** Does what a button of the bar or the menu asks for. */
  async ask(what: string): Promise<void> {
    const { store } = this;
    if (this.away && OF_THE_JOB.has(what)) return;
    const open = (id: string) => {
      const dialog = this.renderRoot.querySelector<HTMLDialogElement>(`#${id}`);
      dialog?.showModal();
      // Not by `autofocus`: a browser complains of it in a frame of another origin.
      dialog?.querySelector<HTMLElement>("h2[tabindex]")?.focus();
    };
    const actions: Record<string, () => unknown> = {
      redo: () => store.redo(),
      gallery: () => {
        this.adds = false;
        return this.use(this.tool === "gallery" ? "cycles" : "gallery");
      },
      add: () => {
        this.adds = true;
        return this.use("gallery");
      },
      open: () =>
        this.renderRoot.querySelector<HTMLInputElement>("#file")?.click(),
      paste: () => {
        // What is said from here on is of what is pasted.
        this.tell(null);
        this.renderRoot.querySelector<PastePart>("tp-paste")?.open();
      },
      reset: async () => {
        await this.use("cycles");
        store.reset();
        this.tell(
          [
            w(
              "The form is put back to its defaults. Undo brings back what was there",
            ),
          ],
          true,
        );
      },
      undo: () => store.undo(),
      cam: () => {
        store.cam = !store.cam;
        this.requestUpdate();
      },
      commands: async () => {
        if (!(await this.loads("commands"))) return;
        await this.renderRoot
          .querySelector<CommandsPart>("tp-commands")
          ?.open();
      },
      save: () => this.outlet.program(),
      sheet: () => store.withheld === null && this.use("sheet"),
      lengths: () => this.use("lengths"),
      presets: () =>
        this.loads("presets").then((there) => there && open("presets")),
      keys: () => open("keys"),
      viewer: () => this.use("viewer"),
      program: () => this.open("program"),
      table: () => this.open("table"),
      measured: () => this.open("measured"),
      checks: () => this.open("checks"),
      share: () => this.around.links && this.outlet.link(),
      "save-job": () => this.outlet.job(),
      "save-picture": () => this.outlet.picture(),
    };
    await actions[what]?.();
  }

  /** Shows a panel, wherever it is. */
  private async open(panel: Exclude<Panel, "setup">): Promise<void> {
    const app = this.with(NAME_OF[panel]);
    await app.use("cycles");
    const there = panel !== "measured" || app.panels.includes(panel);
    app.show(there ? panel : "results");
  }

  /** To a page of the manual. */
  private async about(topic: string): Promise<void> {
    this.topic = topic;
    await this.use("manual");
  }

  /** A cycle was chosen: its first size is what is typed next. Where fingers point, a focus would bring the keyboard up over the picture. */
  private readonly chosen = async (): Promise<void> => {
    await this.use("cycles");
    const size = this.store.cycle.fields.find((field) => field.size);
    if (!size || !matchMedia("(pointer: fine)").matches || this.width < WIDE)
      return;
    await this.updateComplete;
    this.querySelector<HTMLElement>(`[id="f-cycle.${size.key}"]`)?.focus({
      preventScroll: true,
    });
  };

  /** Chooses a cycle or a control by its path and its name. */
  private async choose(what: string): Promise<void> {
    const [path, name = ""] = what.split(":");
    await this.use("cycles");
    const { store } = this;
    if (path === "cycle.type") store.choose(name as Job["cycle"]["type"]);
    else if (path === "set-up") store.beginSetUp(name);
    else if (path === "units") store.setUnits(name as "mm" | "inch");
    else if (path === "control.form") store.put(path, name);
    else if (!this.refused(name)) store.chooseControl(name);
  }

  /** Says why a control has no program for the job's cycle; false where it has one. */
  private refused(post: unknown): boolean {
    const { store } = this;
    const why = store.whyNot(post);
    const title = store.postOf(post)?.title ?? String(post);
    if (why)
      this.tell(
        [w("{control} has no program for this cycle: {why}"), title, why],
        true,
      );
    return why !== null;
  }

  /** The job for a machine that was kept. */
  private machine(preset: Preset): void {
    const { post } = (preset.sections.control ?? {}) as { post?: unknown };
    if (this.store.postOf(post) && this.refused(post)) return;
    try {
      this.store.usePreset(preset);
      this.tell([w("The job is now for {machine}"), preset.name], true);
    } catch (thrown) {
      if (!(thrown instanceof JobError)) throw thrown;
      this.tell([w("{reason}"), this.store.why(thrown)], true);
    }
  }

  /** Light or dark: what the page around wants, or the system. */
  private readonly recolour = (): void => {
    const dark =
      this.theme === "dark" || (this.theme === "auto" && system.matches);
    this.classList.toggle("dark", dark);
    this.store.dispatchEvent(new Event("recolour"));
  };

  private t(template: string, ...values: (string | number)[]): string {
    return this.store.t(template, ...values);
  }

  private readonly offer = (event: Event): void => {
    this.newer = (event as CustomEvent<() => void>).detail;
    this.requestUpdate();
  };

  /** `passing`: it is true of the job as it is now, and of no later one. */
  private tell(text: Said | null, passing = false, foot = passing): void {
    const { revision, document } = this.store;
    this.said = text && {
      text,
      passing,
      at: passing ? revision : document,
      foot: foot && !this.around.lent,
    };
    this.requestUpdate();
  }
}

customElements.define("tp-app", App);
