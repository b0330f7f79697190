import { html, LitElement, nothing, type TemplateResult } from "lit";
import { repeat } from "lit/directives/repeat.js";
import { type Job, type Said, svg, version } from "../core/browser.js";
import type { PanelName, TouchPath } from "../element.js";
import { keepLanguage, keepTheme, keptLanguage, keptTheme } from "../keep.js";
import { toFragment } from "../share.js";
import { Store } from "../store.js";
import css from "../style.css?inline";
import { LANGUAGES, type Lang, languageOf, w, wordsOf } from "../words.js";
import { letterOf } from "./keys.js";
import "./bar.js";
import "./checks.js";
import "./findings.js";
import "./form.js";
import { copy, download } from "./hand.js";
import "./help.js";
import { Intake, type Unread, type Viewed } from "./intake.js";
import { Part } from "./part.js";
import type { PicturePart } from "./picture.js";
import "./picture.js";
import type { ProgramPart } from "./program.js";
import "./program.js";
import "./results.js";
import "./table.js";

export { Store };

/** The styles of everything inside the element. */
export const styles = new CSSStyleSheet();
styles.replaceSync(css);

const PANELS = {
  setup: w("Setup"),
  program: w("Program"),
  table: w("Parameters"),
  results: w("Results"),
  checks: w("Checks"),
} as const;
type Panel = keyof typeof PANELS;
const NAME_OF: Record<Panel, PanelName> = {
  setup: "form",
  program: "program",
  table: "table",
  results: "results",
  checks: "checks",
};

/** From this width on the form has a column of its own; the style sheet knows the same width. */
const WIDE = 1080;
/** Below this width picture and panel stand on each other; the style sheet knows the same width. */
const NARROW = 600;

/** What takes the place of the job's picture and panels: pictures to choose from, LENTOAX, a program that says no job, a page to print. */
type Tool = "gallery" | "cycles" | "lengths" | "viewer" | "sheet";

/** What is loaded when the job is on the screen, or when it is asked for before. */
const LATER: Record<string, () => Promise<unknown>> = {
  gallery: () => import("./gallery.js"),
  lengths: () => import("./lentoax.js"),
  viewer: () => import("./viewer.js"),
  sheet: () => import("./sheet.js"),
  presets: () => import("./presets.js"),
};

const THEMES = ["auto", "light", "dark"] as const;
type Theme = (typeof THEMES)[number];
const THEME_NAMES = { auto: w("as the system"), light: w("light"), dark: w("dark") };
const system = matchMedia("(prefers-color-scheme: dark)");

/** What can be done by the keyboard beyond Tab, Enter and the arrows of a control. */
const KEYS: [string, string][] = [
  [w("Ctrl+Z, Ctrl+Y"), w("undo, redo: fields, choices, drags, files, Reset")],
  [w("Ctrl+S"), w("save the program")],
  [w("↑ ↓ in a number"), w("one step more or less; with Shift a tenth of it")],
  [w("Enter in a number"), w("work out a sum, and to the next field")],
  [w("Escape in a number"), w("back to what the field held")],
  [w("← → in the timeline"), w("move before, next move")],
  [w("Ctrl+← Ctrl+→ there"), w("touch before, next touch")],
  [w("Space there"), w("play, pause")],
  [w("↑ ↓ in the program"), w("line by line through the moves")],
  [w("Ctrl+F in an opened program"), w("find words in it")],
  [w("Enter, Shift+Enter in Find"), w("the next line with the words, the one before")],
  [w("Arrows, +, −, 0 on the picture"), w("shift, zoom, fit")],
  [w("Escape on picture, program, timeline"), w("no move is lit")],
  [w("Escape elsewhere"), w("back to the job")],
];

/** What changes the job, or hands it out: not while something else is shown. */
const OF_THE_JOB = new Set(["redo", "save", "save-job", "save-picture", "share", "sheet", "presets", "reset"]);

/** What the element is in. */
interface Around {
  host: TouchPath;
  /** Whether presets and theme are kept in this browser. */
  local: boolean;
  /** Whether links are followed and handed out. */
  links: boolean;
}

/** The whole page. What fits beside the picture has a place of its own; the rest is behind tabs. */
export class App extends LitElement {
  private panel: Panel | null = null;
  private tool: Tool = "cycles";
  private viewed: Viewed | null = null;
  /** Whether a text can be pasted in, and what is there of it. */
  private pasting = false;
  /** What is said above the job, and the document that the job was then. */
  private told: Said | null;
  private toldAt = 0;
  private passing = false;
  /** Looks whether the focus was lost. */
  private refocusing = 0;
  /** The language that was chosen here. */
  private chosen = keptLanguage();
  /** Takes a newer version of the page, where there is one. */
  private newer: (() => void) | null = null;
  private width = WIDE;
  private wanted: PanelName[] = [];
  private theme: Theme = "auto";
  private readonly observer = new ResizeObserver(() => this.measure());
  /** Where the element has no language of its own, that of the page around may change. */
  private readonly languages = new MutationObserver(() => this.reword());
  private readonly intake: Intake;
  /** What has been loaded: what stands in the page before its class is known would lose what it was given. */
  private readonly there = new Set<string>();

  constructor(
    private readonly store: Store,
    private readonly around: Around,
  ) {
    super();
    this.told = store.notice;
    this.intake = new Intake(store, {
      tell: (text) => this.tell(text === "" ? null : [text]),
      showJob: () => this.use("cycles"),
      showMoves: (viewed) => {
        this.viewed = viewed;
        this.use("viewer");
        // The page keeps the editor for when there is no network.
        this.around.host.dispatchEvent(new CustomEvent("wanted", { detail: "editor" }));
      },
      beside: (text, signal) => {
        const detail: Unread = { text, signal, reading: null };
        this.around.host.dispatchEvent(new CustomEvent("read", { detail }));
        return detail.reading;
      },
    });
    const theme = around.local && !around.host.hasAttribute("theme") ? keptTheme() : null;
    if (theme) around.host.setAttribute("theme", theme);
  }

  /** The parts share the styles of the element around. */
  protected override createRenderRoot(): HTMLElement {
    return this;
  }

  /** What is shown, and in which colours. */
  dress(theme: Theme, panels: PanelName[]): void {
    this.theme = theme;
    this.wanted = panels;
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
    const all = places.flatMap((place) => [...this.querySelectorAll<HTMLElement>(place)]);
    all.find((one) => one.checkVisibility())?.focus(options);
  }

  private get panels(): Panel[] {
    const fits = (panel: Panel) =>
      this.wanted.includes(NAME_OF[panel]) && (panel !== "setup" || this.width < WIDE || !this.wanted.includes("form"));
    return (Object.keys(PANELS) as Panel[]).filter(fits);
  }

  override connectedCallback(): void {
    super.connectedCallback();
    // What is around it now may have another language.
    if (this.hasUpdated) this.reword();
    this.measure();
    this.observer.observe(this);
    for (
      let root: Node | null = this.around.host.getRootNode();
      root;
      root = root instanceof ShadowRoot ? root.host.getRootNode() : null
    )
      this.languages.observe(root, { subtree: true, attributeFilter: ["lang"] });
    const { intake } = this;
    this.addEventListener("paste", intake.refuse);
    this.addEventListener("drop", intake.refuse);
    this.addEventListener("dragover", intake.welcome);
    this.addEventListener("keydown", this.shortcut);
    this.addEventListener("focusin", this.unhelp);
    // Before what is clicked does anything: it may be gone afterwards.
    this.addEventListener("click", this.refocus, true);
    this.addEventListener("keydown", this.refocus, true);
    this.addEventListener("pointerdown", this.refocus, true);
    this.store.addEventListener("change", this.forget);
    this.around.host.addEventListener("update-ready", this.offer);
    system.addEventListener("change", this.recolour);
    if (!this.around.links) return;
    addEventListener("hashchange", intake.link);
    intake.link();
  }

  override disconnectedCallback(): void {
    super.disconnectedCallback();
    this.observer.disconnect();
    this.languages.disconnect();
    const { intake } = this;
    this.removeEventListener("paste", intake.refuse);
    this.removeEventListener("drop", intake.refuse);
    this.removeEventListener("dragover", intake.welcome);
    this.removeEventListener("keydown", this.shortcut);
    this.removeEventListener("focusin", this.unhelp);
    this.removeEventListener("click", this.refocus, true);
    this.removeEventListener("keydown", this.refocus, true);
    this.removeEventListener("pointerdown", this.refocus, true);
    this.store.removeEventListener("change", this.forget);
    this.around.host.removeEventListener("update-ready", this.offer);
    system.removeEventListener("change", this.recolour);
    removeEventListener("hashchange", intake.link);
  }

  override render(): TemplateResult {
    const { store, wanted } = this;
    const panels = this.panels;
    const active = this.panel && panels.includes(this.panel) ? this.panel : panels[0];
    const hidden = (panel: Panel) => panels.includes(panel) && panel !== active;
    const shows = (name: PanelName) => wanted.includes(name);
    const none = (name: string, is: boolean) => (is ? name : "");
    const shape = [none("no-form", !shows("form")), none("no-stage", !shows("stage")), none("no-tabs", !panels.length)];
    return html`
      <div class="frame" @ask=${(e: CustomEvent<string>) => this.ask(e.detail)} @go=${(e: CustomEvent<string>) => this.go(e.detail)}>
      <header part="bar">
        <slot name="header"><h1 role=${this.around.links ? nothing : "presentation"}>Touchpath</h1></slot>
        <tp-bar .store=${store} .links=${this.around.links} .away=${this.away}></tp-bar>
        <input id="file" class="unseen" type="file" tabindex="-1" aria-label=${this.t("Open a file")} accept=${this.intake.readable} @change=${this.intake.chosen} />
        ${this.menu()}
      </header>
      <div class="notes">
      ${this.newer ? html`<p class="note" role="status">${this.t("A newer version of this page is here.")} <button type="button" @click=${this.newer}>${this.t("Take it")}</button> ${this.t("The job stays.")}</p>` : nothing}
      ${this.told ? html`<p class="note" role="status">${this.store.say(this.told)} <button type="button" @click=${() => this.tell(null)}>OK</button></p>` : nothing}
      ${
        this.pasting
          ? html`<section class="paste" aria-label=${this.t("Paste")}>
        <label for="paste">${this.t("A dump of CmdPrm codes, a program with cycle 1411, any program that was written here, or a job")}</label>
        <textarea id="paste" rows="6" spellcheck="false"></textarea>
        <div class="tools"><button type="button" @click=${this.readPasted}>${this.t("Read it")}</button><button type="button" @click=${() => this.paste(false)}>${this.t("Cancel")}</button></div>
      </section>`
          : nothing
      }
      ${
        this.tool === "cycles"
          ? nothing
          : html`<p class="back"><button type="button" @click=${() => this.use("cycles")}><span aria-hidden="true">←</span> ${this.t("Back to the job")}</button></p>`
      }
      </div>
      <main role=${this.around.links ? nothing : "group"} aria-label=${this.around.links ? nothing : this.t("Job")} class=${shape.join(" ").trim()} ?hidden=${this.tool !== "cycles"}>
        ${repeat(
          // One order for eye and Tab: on a narrow page the picture stands above the form.
          (this.width < NARROW ? (["stage", "form"] as const) : (["form", "stage"] as const)).filter(shows),
          (name) => name,
          (name) =>
            name === "stage"
              ? html`<section class="picture" part="stage" aria-label=${this.t("Picture")}><tp-picture .store=${store}></tp-picture></section>`
              : html`<section class="setup" part="form" id="panel-setup" aria-label=${this.t("Setup")} ?hidden=${hidden("setup")}>
          <tp-form .store=${store}></tp-form>
          <tp-help .store=${store}></tp-help>
        </section>`,
        )}
        <div class="tabs" part="tabs" role="tablist" aria-label=${this.t("Panels")} ?hidden=${panels.length < 2}>
          ${panels.map(
            (
              panel,
            ) => html`<button type="button" role="tab" id=${`tab-${panel}`} aria-controls=${`panel-${panel}`} tabindex=${panel === active ? 0 : -1}
            aria-selected=${panel === active ? "true" : "false"} @click=${() => this.show(panel)} @keydown=${(e: KeyboardEvent) => this.key(e, panels, panel)}>${this.t(PANELS[panel])}</button>`,
          )}
        </div>
        ${shows("program") ? html`<section class="panel" part="panel program" id="panel-program" aria-label=${this.t("Program")} ?hidden=${hidden("program")}><tp-program .store=${store}></tp-program></section>` : nothing}
        ${shows("table") ? html`<section class="panel" part="panel table" id="panel-table" aria-label=${this.t("Parameters")} ?hidden=${hidden("table")}><tp-table .store=${store}></tp-table></section>` : nothing}
        ${shows("results") ? html`<section class="panel scrolls" part="panel results" id="panel-results" aria-label=${this.t("Results")} ?hidden=${hidden("results")}><tp-results .store=${store}></tp-results></section>` : nothing}
        ${shows("checks") ? html`<section class="panel scrolls" part="panel checks" id="panel-checks" aria-label=${this.t("Checks")} ?hidden=${hidden("checks")}><tp-checks .store=${store}></tp-checks></section>` : nothing}
      </main>
      ${this.tool === "gallery" ? html`<tp-gallery role="main" .store=${store} @chosen=${() => this.use("cycles")}></tp-gallery>` : nothing}
      ${this.tool === "viewer" && this.viewed ? html`<tp-viewer role="main" .store=${store} .viewed=${this.viewed}></tp-viewer>` : nothing}
      ${this.tool === "lengths" ? html`<tp-lentoax role="main" .store=${store} @taken=${() => this.use("cycles")}></tp-lentoax>` : nothing}
      ${this.tool === "sheet" ? html`<tp-sheet role="main" .store=${store}></tp-sheet>` : nothing}
      <footer part="footer" aria-label=${this.t("State of the job")}>${this.away ? html`<div class="foot"><p class="verdict warning">${this.t("Nothing of it is checked or proven: it is what its words say.")}</p></div>` : html`<tp-findings .store=${store} .panels=${wanted} .alone=${this.around.links}></tp-findings>`}<slot name="footer"></slot></footer>
      ${this.dialogs()}
      </div>
    `;
  }

  /** Whether something else than the job is shown: then nothing of it is changed or handed out. */
  private get away(): boolean {
    return this.tool === "viewer";
  }

  /** What is rarely used. */
  private menu(): TemplateResult {
    const { readonly } = this.store;
    const item = (what: string, name: string, offered = true, only = "", disabled = false) =>
      offered
        ? html`<button type="button" class=${only || nothing} ?disabled=${disabled || (this.away && OF_THE_JOB.has(what))} @click=${() => this.choose(what)}>${name}</button>`
        : nothing;
    // Whether there is something to redo is looked at whenever it opens.
    return html`<div class="menu" id="menu" popover role="group" aria-label=${this.t("More")} @beforetoggle=${() => this.requestUpdate()}>
      ${item("redo", this.t("Redo"), !readonly, "on-phone", !this.store.canRedo)} ${item("gallery", this.t("Choose the cycle from pictures"), !readonly, "on-tablet")}
      ${item("open", this.t("Open a file"), !readonly)} ${item("paste", this.t("Paste"), !readonly)} ${item("save-job", this.t("Save job"))} ${item("save-picture", this.t("Save the picture (SVG)"))}
      ${item("share", this.t("Copy a link to this job"), this.around.links)} ${item("sheet", this.t("Setup sheet to print"))} ${item("presets", this.t("Presets"), this.around.local && !readonly)}
      ${item("lengths", this.t("Tool lengths"))} ${item("viewer", this.t("Moves of the opened program"), this.viewed !== null)} ${item("keys", this.t("Keys"))} ${item("reset", this.t("Reset"), !readonly)}
      <label>${this.t("Language")} <select id="lang" @change=${this.chooseLanguage}>${Object.entries(LANGUAGES).map(([lang, name]) => html`<option value=${lang} lang=${lang} ?selected=${lang === this.store.lang}>${name}</option>`)}</select></label>
      <label>${this.t("Colours")} <select id="theme" @change=${this.chooseTheme}>${THEMES.map((theme) => html`<option value=${theme} ?selected=${theme === this.theme}>${this.t(THEME_NAMES[theme])}</option>`)}</select></label>
      <small>Touchpath ${version()} · <a href=${new URL("./licences.txt", document.baseURI).href} ?hidden=${!this.around.links}>${this.t("Licences")}</a></small>
    </div>`;
  }

  private dialogs(): TemplateResult {
    const close = html`<form method="dialog" class="tools"><button>${this.t("Close")}</button></form>`;
    return html`<dialog id="presets" aria-label=${this.t("Presets")} aria-describedby="presets-help">
      ${this.there.has("presets") ? html`<tp-presets .store=${this.store}></tp-presets>` : nothing}
      ${close}
    </dialog>
    <dialog id="keys" aria-labelledby="keys-title">
      <h2 id="keys-title" tabindex="-1" autofocus>${this.t("Keys")}</h2>
      <dl class="keys">${KEYS.map(([keys, what]) => html`<dt>${this.t(keys)}</dt><dd>${this.t(what)}</dd>`)}</dl>
      ${close}
    </dialog>
    <dialog id="ask-reset" aria-labelledby="ask-reset-text">
      <p id="ask-reset-text">${this.t("Put the whole form back to the defaults of “{cycle}”? Undo brings back what is there now.", this.store.cycle.title)}</p>
      <form method="dialog" class="tools"><button @click=${() => this.store.reset()}>${this.t("Put back")}</button><button>${this.t("Keep")}</button></form>
    </dialog>`;
  }

  protected override firstUpdated(): void {
    setTimeout(() => {
      if (this.isConnected) for (const load of Object.values(LATER)) load().catch(() => undefined);
    }, 500);
  }

  protected override updated(): void {
    for (const part of this.renderRoot.querySelectorAll("main:not([hidden]) > section:not([hidden]) > *"))
      if (part instanceof Part) part.catchUp();
  }

  private measure(): void {
    const width = this.getBoundingClientRect().width || WIDE;
    if (width === this.width) return;
    this.width = width;
    this.requestUpdate();
  }

  private show(panel: Panel): void {
    this.panel = panel;
    this.requestUpdate();
  }

  private key(event: KeyboardEvent, panels: Panel[], panel: Panel): void {
    const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
    if (!step) return;
    const next = panels[(panels.indexOf(panel) + step + panels.length) % panels.length] as Panel;
    this.show(next);
    this.updateComplete.then(() => this.renderRoot.querySelector<HTMLElement>(`#tab-${next}`)?.focus());
  }

  /** Undo and redo are the page's, in its fields too: only a text that is pasted in keeps its own. */
  private readonly shortcut = (event: KeyboardEvent): void => {
    if (event.key === "Escape") this.escape(event);
    if (!(event.ctrlKey || event.metaKey) || event.altKey) return;
    const key = letterOf(event);
    const at = event.composedPath()[0] as Element;
    // What the page around has put into a slot is its own.
    if (!this.contains(at)) return;
    if (!["s", "y", "z"].includes(key) || (key !== "s" && at.id === "paste")) return;
    event.preventDefault();
    if (key === "s") {
      this.ask("save");
      return;
    }
    // A field that is not the job's changes none, and no job is changed that is not seen. Left to the browser, the key would take
    // back the last letter of any field of the page.
    const seen = this.tool === "cycles" && !this.renderRoot.querySelector("dialog[open]");
    const other = at.matches("input[type=text], input[type=search]") && !at.closest("tp-form");
    if (!seen || other) return;
    if (key === "y" || event.shiftKey) this.store.redo();
    else this.store.undo();
  };

  /** From anything else back to the job; a field, a dialog and the menu have Escape for themselves. */
  private escape(event: KeyboardEvent): void {
    const at = event.composedPath()[0] as Element;
    if (this.tool === "cycles" || event.defaultPrevented || !this.contains(at)) return;
    if (at.matches("input, select, textarea") || this.renderRoot.querySelector("dialog[open], :popover-open")) return;
    event.preventDefault();
    this.use("cycles");
  }

  /** The help is of the field that has the focus: elsewhere there is none. */
  private readonly unhelp = (event: Event): void => {
    const inside = (event.composedPath()[0] as Element).closest?.("tp-form, tp-bar, tp-help");
    if (!inside) this.store.focus(null);
  };

  /** What is said of one job is not said of another; what is passing, of no later one. */
  private readonly forget = (): void => {
    const { document, revision } = this.store;
    if (this.told !== null && this.toldAt !== (this.passing ? revision : document)) this.tell(null);
  };

  /** Where the button or field that had the focus is removed, the focus moves to one near it, not to the start of the page. */
  private readonly refocus = (event: Event): void => {
    clearTimeout(this.refocusing);
    const root = this.getRootNode() as ShadowRoot;
    const at = root.activeElement;
    const acts = event.type === "click" || (event instanceof KeyboardEvent && event.key === "Escape");
    if (!at || !acts) return;
    const group = at.closest(".group, dialog");
    const there = (place: Element) => place.isConnected && place.checkVisibility() && !place.matches(":disabled");
    const lost = () => {
      const now = root.activeElement;
      const outside = ![document.body, root.host].includes(document.activeElement as HTMLElement);
      if (there(at) || (now && there(now)) || outside || !this.isConnected) return;
      const places = [
        ...(group?.querySelectorAll<HTMLElement>("input, select, button") ?? []),
        ...[".back button", "tp-bar [popovertarget]"].flatMap((place) => [
          ...this.querySelectorAll<HTMLElement>(place),
        ]),
      ];
      places.find(there)?.focus({ preventScroll: true });
    };
    // Some are removed only when the page is drawn, or a part of it is loaded. The user's next click or key cancels this.
    const look = ([ms, ...later]: number[]) => {
      if (ms === undefined) return;
      this.refocusing = window.setTimeout(() => {
        lost();
        look(later);
      }, ms);
    };
    look([40, 360]);
  };

  /** To the field of a path, or to the nearest one around it. */
  private async go(path: string): Promise<void> {
    await this.use("cycles");
    if (this.panels.includes("setup")) this.show("setup");
    await this.updateComplete;
    await this.renderRoot.querySelector<Element & { unfold(path: string): Promise<boolean> }>("tp-form")?.unfold(path);
    const find = (p: string) => this.renderRoot.querySelector<HTMLElement>(`[id="f-${p}"]`);
    const field = find(path) ?? find(`${path}[0]`) ?? find(`${path}.offset[0]`);
    field?.scrollIntoView({ block: "center" });
    field?.focus();
  }

  private async use(tool: Tool): Promise<void> {
    if (await this.loads(tool)) {
      // What is said of an opened program belongs to its picture.
      if (this.tool === "viewer" && tool !== "viewer") this.tell(null);
      this.tool = tool;
      this.requestUpdate();
    }
  }

  /** Loads what was not needed until now; false where it cannot be had. */
  private async loads(what: string): Promise<boolean> {
    try {
      await LATER[what]?.();
      this.there.add(what);
      this.requestUpdate();
      await this.updateComplete;
      return true;
    } catch {
      this.tell([w("This part of the page could not be loaded: is there a network?")]);
      return false;
    }
  }

  private choose(what: string): void {
    this.renderRoot.querySelector<HTMLElement>("#menu")?.hidePopover();
    this.ask(what);
  }

  /** Does what a button of the bar or the menu asks for. */
  async ask(what: string): Promise<void> {
    const { store } = this;
    if (this.away && OF_THE_JOB.has(what)) return;
    const open = (id: string) => this.renderRoot.querySelector<HTMLDialogElement>(`#${id}`)?.showModal();
    const actions: Record<string, () => unknown> = {
      redo: () => store.redo(),
      gallery: () => this.use(this.tool === "gallery" ? "cycles" : "gallery"),
      open: () => this.renderRoot.querySelector<HTMLInputElement>("#file")?.click(),
      paste: () => this.paste(!this.pasting),
      reset: () => {
        // The question names the cycle; nothing else of the frame follows the job, so a keystroke does not render it.
        this.requestUpdate();
        open("ask-reset");
      },
      save: () => this.save(),
      sheet: () => store.withheld === null && this.use("sheet"),
      lengths: () => this.use("lengths"),
      presets: () => this.loads("presets").then((there) => there && open("presets")),
      keys: () => open("keys"),
      viewer: () => this.use("viewer"),
      checks: async () => {
        await this.use("cycles");
        this.show("checks");
      },
      share: () => this.share(),
      "save-job": () => this.saveJob(),
      "save-picture": () => this.savePicture(),
    };
    await actions[what]?.();
  }

  /** Saves the program; only ever that of the form as it stands. The page around may want to do it itself. */
  private save(): void {
    const { store } = this;
    if (store.stale) return;
    const { text, post, extension } = store.plan.program;
    const name = store.fileName(extension);
    store.saved = text;
    if (!this.around.host.tell("program-save", { name, text, post, extension })) return;
    download(text, name, "text/plain");
    const program = this.renderRoot.querySelector<ProgramPart>("tp-program");
    if (program?.checkVisibility()) program.tell(this.t("Saved {file}", name));
    else this.tell([w("Saved {file}"), name], true);
  }

  /** The form as it stands, also with errors: it is the user's work. */
  private saveJob(): void {
    download(`${JSON.stringify(this.store.draft, null, 2)}\n`, this.store.otherName(".json"), "application/json");
  }

  /** The picture as it is looked at, of the form as it stands. */
  private savePicture(): void {
    const { store } = this;
    if (store.withheld !== null) {
      this.tell([w("No picture to save while the form has an error: {why}"), store.withheld]);
      return;
    }
    const picture = this.renderRoot.querySelector<PicturePart>("tp-picture");
    const from = picture?.from ?? "top";
    const job = store.shown as unknown as Job;
    const text = picture?.svg(`${job.name}: ${store.cycle.title}`) ?? svg(job, from);
    download(text, store.otherName(`-${from}.svg`), "image/svg+xml");
  }

  private async share(): Promise<void> {
    if (!this.around.links) return;
    const fragment = await toFragment({ job: this.store.draft, measured: this.store.measured });
    if (fragment === null) {
      this.tell([w("This job is too long for a link: save it as a file instead")], true);
      return;
    }
    const link = new URL(fragment, location.href).href;
    const done = await copy(link);
    this.tell(
      done ? [w("A link to this job was copied. The job is in the link itself: no server keeps it.")] : [link],
      true,
    );
  }

  /** Light or dark: what the page around wants, or the system. */
  private readonly recolour = (): void => {
    const dark = this.theme === "dark" || (this.theme === "auto" && system.matches);
    this.classList.toggle("dark", dark);
    this.store.dispatchEvent(new Event("recolour"));
  };

  private readonly chooseTheme = (event: Event): void => {
    const theme = (event.target as HTMLSelectElement).value as Theme;
    this.around.host.theme = theme;
    if (this.around.local) keepTheme(theme);
  };

  /** The language of the page around, the one that was chosen here, or the browser's; each where it has words. */
  private get language(): Lang {
    const { host, local } = this.around;
    const own = languageOf([host.lang].filter(Boolean));
    if (own) return own;
    if (local) return languageOf([this.chosen ?? "", ...navigator.languages]) ?? "en";
    let around: Element | null = host;
    while (around && !(around as HTMLElement).lang) {
      const root: Node = around.getRootNode();
      around = around.parentElement ?? (root instanceof ShadowRoot ? root.host : null);
    }
    return languageOf([(around as HTMLElement | null)?.lang ?? ""]) ?? "en";
  }

  /** Shows everything in the language that is wanted; its words are loaded first. Where they cannot be had, the language before stays. */
  async reword(): Promise<void> {
    const lang = this.language;
    this.lang = this.store.lang;
    if (lang === this.store.lang) return;
    try {
      const words = await wordsOf(lang);
      // Another one was asked for meanwhile.
      if (lang !== this.language) return this.reword();
      this.store.translate(lang, words);
      this.lang = lang;
      // The page keeps the words for when there is no network.
      this.around.host.dispatchEvent(new CustomEvent("language", { detail: lang }));
      this.requestUpdate();
    } catch {
      if (lang !== this.language) return this.reword();
      this.tell([w("This part of the page could not be loaded: is there a network?")]);
      const choice = this.renderRoot?.querySelector<HTMLSelectElement>("#lang");
      if (choice) choice.value = this.store.lang;
      this.chosen = this.store.lang;
    }
  }

  private readonly chooseLanguage = async (event: Event): Promise<void> => {
    const lang = (event.target as HTMLSelectElement).value;
    this.chosen = lang;
    if (this.around.host.lang || !this.around.local) this.around.host.lang = lang;
    await this.reword();
    if (this.around.local && this.store.lang === lang) keepLanguage(lang);
  };

  private t(template: string, ...values: (string | number)[]): string {
    return this.store.t(template, ...values);
  }

  private readonly offer = (event: Event): void => {
    this.newer = (event as CustomEvent<() => void>).detail;
    this.requestUpdate();
  };

  private paste(open: boolean): void {
    this.pasting = open;
    this.requestUpdate();
    if (open) this.updateComplete.then(() => this.renderRoot.querySelector<HTMLElement>("#paste")?.focus());
  }

  /** What was pasted stays where it is until it could be read. */
  private async readPasted(): Promise<void> {
    const held = () => this.renderRoot.querySelector<HTMLTextAreaElement>("#paste")?.value ?? "";
    const text = held();
    if ((await this.intake.text(text)) && held() === text) this.paste(false);
  }

  /** `passing`: it is true of the job as it is now, and of no later one. */
  private tell(said: Said | null, passing = false): void {
    this.told = said;
    this.passing = passing;
    this.toldAt = passing ? this.store.revision : this.store.document;
    this.requestUpdate();
  }
}

customElements.define("tp-app", App);
