import { html, LitElement, nothing, type TemplateResult } from "lit";
import { repeat } from "lit/directives/repeat.js";
import {
  type AnyJob,
  awaited,
  type Message,
  type ProgramMoves,
} from "../core/browser.js";
import { bufferInput } from "../input-buffer.js";
import { keepTheme, kept, keptTheme } from "../persistence.js";
import type { Preset } from "../presets.js";
import { readAs } from "../sentences.js";
import { Store } from "../store.js";
import { partStyles, styles } from "../styles.js";
import { askFor } from "../tasks.js";
import { w } from "../words.js";
import "./bar.js";
import "./checks.js";
import "./features.js";
import "./amount.js";
import "./findings.js";
import "./form.js";
import "./help.js";
import "./measured.js";
import { Actions } from "./actions.js";
import type { AppContext } from "./around.js";
import { Export } from "./export.js";
import type { Into } from "./insert-panel.js";
import { Intake, type Viewed } from "./intake.js";
import { Language } from "./language.js";
import { actions, dialogs, type Frame, menu, type Theme } from "./menu.js";
import { StorePart } from "./part.js";
import "./paste.js";
import type { PicturePart } from "./picture.js";
import "./picture.js";
import type { ProgramPart } from "./program-panel.js";
import "./program-panel.js";
import { Refocus } from "./refocus.js";
import "./results.js";
import {
  MEASURED,
  NAME_OF,
  NARROW,
  PANELS,
  type Panel,
  type PanelName,
  WIDE,
} from "./panels.js";
import { Shortcuts } from "./shortcuts.js";
import { isShort } from "./shown.js";
import { Size } from "./size.js";
import "./table.js";
import { MISSING, Tools } from "./tools.js";

export { awaited, bufferInput, kept, partStyles, Store, styles };

const system = matchMedia("(prefers-color-scheme: dark)");
/** Colours that the user has chosen for every page. */
const forced = matchMedia("(forced-colors: active)");

type View = PicturePart["from"];

/** Apps that show a job: in its element, and in elements with its panels elsewhere on the page. */
const showing = new WeakMap<Store, Set<App>>();
function shown(store: Store): Set<App> {
  const all = showing.get(store) ?? new Set<App>();
  showing.set(store, all);
  return all;
}
/** Redraws the links to panels after the set of visible panels has changed. */
function redrawn(store: Store): void {
  for (const app of shown(store)) app.requestUpdate();
}

/** The whole page. Panels that fit beside the picture have their own place; the others are behind tabs. */
export class App extends LitElement {
  private panel: Panel | null = null;
  private viewed: Viewed | null = null;
  /** Moves of the opened program, once it has run. */
  private shownMoves: ProgramMoves | null = null;
  /** Message about the job. A message about the whole document is above it; one about the current state is in the footer, where nothing moves when it goes. */
  private said: {
    text: Message;
    passing: boolean;
    at: number;
    foot: boolean;
  } | null = null;
  /** Switches to a newer version of the page, if there is one. */
  private newer: (() => void) | null = null;
  private readonly size = new Size(this);
  private wanted: PanelName[] = [];
  private theme: Theme = "auto";
  private readonly language: Language | null;
  private readonly intake: Intake;
  private readonly outlet: Export;
  private readonly tools: Tools;
  private readonly shortcuts: Shortcuts;
  readonly actions: Actions;

  constructor(
    private readonly store: Store,
    private readonly around: AppContext,
  ) {
    super();
    if (store.notice && !around.isRemotePanel) this.tell(store.notice);
    new Refocus(this);
    this.tools = new Tools(this, {
      links: around.links,
      tell: (text) => this.tell(text),
      said: () => this.said?.text ?? null,
    });
    this.language = around.isRemotePanel
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
        await this.tools.use("cycles");
        this.show(this.panels.includes("measured") ? "measured" : "results");
      },
      showJob: () => this.tools.use("cycles"),
      forCam: () => {
        this.store.cam = true;
      },
      showMoves: (viewed) => {
        this.viewed = viewed;
        this.shownMoves = null;
        this.tools.use("viewer");
        // Stores the editor of long programs for use without a network.
        if (!isShort(viewed.text))
          this.around.host.dispatchEvent(
            new CustomEvent("load-editor", { detail: "editor" }),
          );
      },
      whole: () => this.tools.whole(),
      beside: (text, signal) =>
        askFor(this.around.host, { read: text }, signal),
    });
    this.shortcuts = new Shortcuts(this, {
      store,
      intake: this.intake,
      host: around.host,
      links: around.links,
      tool: () => this.tools.now,
      ask: (what) => this.actions.ask(what),
      leave: () => this.tools.use("cycles"),
    });
    this.outlet = new Export(store, {
      tell: (said) => this.tell(said, true),
      show: (link) => this.tell([link], true, false),
      saved: (name, other) => {
        const program =
          this.renderRoot.querySelector<ProgramPart>("tp-program");
        const said: Message = other
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
    this.actions = new Actions(this, {
      store,
      tools: this.tools,
      outlet: this.outlet,
      links: around.links,
      away: () => this.replacedBy,
      isWide: () => this.size.width >= WIDE,
      hasTab: (panel) => this.panels.includes(panel),
      show: (panel) => this.show(panel),
      open: (panel) => this.open(panel),
      tell: (said, passing) => this.tell(said, passing),
    });
    const theme =
      around.local && !around.host.hasAttribute("theme") ? keptTheme() : null;
    if (theme) around.host.setAttribute("theme", theme);
  }

  /** The parts share the styles of the element. */
  protected override createRenderRoot(): HTMLElement {
    return this;
  }

  /** Whether the host page has requested the parameters by name. */
  private asked = false;

  /** Sets the visible panels and the colours. `asked`: the parameters were requested by name. */
  applyOptions(theme: Theme, panels: PanelName[], asked: boolean): void {
    this.theme = theme;
    this.asked = asked;
    this.wanted = panels;
    redrawn(this.store);
    this.recolour();
    this.requestUpdate();
  }

  /** Focuses the first field, or else the picture. */
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

  /** The view of the picture; without a picture, the view that it will have. */
  get view(): View {
    return this.picture?.from ?? this.sight;
  }

  set view(view: View) {
    this.sight = view;
    if (this.picture) this.picture.from = view;
  }

  /** View that the host page requests, and the picture that has applied it. */
  private sight: View = "top";
  private turned: PicturePart | null = null;

  private get picture(): PicturePart | null {
    return this.renderRoot.querySelector<PicturePart>("tp-picture");
  }

  /** Whether the job's picture is visible. */
  get hasPicture(): boolean {
    return this.picture !== null;
  }

  /** The picture as SVG; null without a plan. */
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
      (panel !== "measured" || this.size.width >= WIDE) &&
      (panel !== "setup" ||
        this.size.width < WIDE ||
        !this.wanted.includes("form"));
    return (Object.keys(PANELS) as Panel[]).filter(fits);
  }

  /** Whether to show the parameters. A host page that shows single panels has to request them. */
  private get hasTable(): boolean {
    return this.asked || this.store.cam || this.around.links;
  }

  override connectedCallback(): void {
    super.connectedCallback();
    this.size.follow();
    const { intake } = this;
    this.shortcuts.follow();
    this.addEventListener("drop", intake.refuse);
    this.addEventListener("dragover", intake.welcome);
    this.addEventListener("focusin", this.unhelp);
    this.store.addEventListener("change", this.forget);
    this.store.addEventListener("announcement", this.pass);
    this.store.addEventListener("cam-mode", this.redraw);
    this.store.addEventListener("language", this.reworded);
    this.reworded();
    shown(this.store).add(this);
    redrawn(this.store);
    this.around.host.addEventListener("update-ready", this.offer);
    for (const query of [system, forced])
      query.addEventListener("change", this.recolour);
    if (!this.around.links) return;
    addEventListener("hashchange", intake.link);
    addEventListener("popstate", this.tools.went);
    intake.link();
  }

  override disconnectedCallback(): void {
    super.disconnectedCallback();
    this.size.leave();
    const { intake } = this;
    intake.stop();
    this.shortcuts.leave();
    this.removeEventListener("drop", intake.refuse);
    this.removeEventListener("dragover", intake.welcome);
    this.removeEventListener("focusin", this.unhelp);
    this.store.removeEventListener("change", this.forget);
    this.store.removeEventListener("announcement", this.pass);
    this.store.removeEventListener("cam-mode", this.redraw);
    this.store.removeEventListener("language", this.reworded);
    shown(this.store).delete(this);
    redrawn(this.store);
    this.around.host.removeEventListener("update-ready", this.offer);
    for (const query of [system, forced])
      query.removeEventListener("change", this.recolour);
    removeEventListener("hashchange", intake.link);
    removeEventListener("popstate", this.tools.went);
  }

  override render(): TemplateResult {
    const { store, wanted, frame, said, replacedBy: away } = this;
    const narrow = this.size.width < NARROW;
    const stacked =
      narrow || (this.size.width < WIDE && this.size.height > this.size.width);
    const panels = this.panels;
    const active =
      this.panel && panels.includes(this.panel) ? this.panel : panels[0];
    const hidden = (panel: Panel) => panels.includes(panel) && panel !== active;
    const shows = (name: PanelName) => wanted.includes(name);
    const none = (name: string, is: boolean) => (is ? name : "");
    const role = panels.length < 2 ? nothing : "tabpanel";
    // A wide page shows the state of the job above the results.
    const beside =
      this.size.width >= WIDE &&
      panels.length > 0 &&
      !this.around.isRemotePanel;
    const first =
      this.size.width >= WIDE && active === "results" && panels.length > 1;
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
      <div class="frame" @run-action=${(e: CustomEvent<string>) => this.actions.ask(e.detail)} @open-manual=${(e: CustomEvent<string>) => this.actions.about(e.detail)} @choose=${(e: CustomEvent<string>) => this.actions.choose(e.detail)}
        @machine=${(e: CustomEvent<Preset>) => this.actions.machine(e.detail)} @announce=${(e: CustomEvent<Message>) => this.tell(e.detail, true)} @go-to-field=${(e: CustomEvent<string>) => this.find(e.detail)} @lines=${(e: CustomEvent<number[]>) => this.with("program").actions.showLines(e.detail)}>
      <header part="bar" ?hidden=${this.around.isRemotePanel}>
        <slot name="header"><h1 role=${this.around.links ? nothing : "presentation"}>Touchpath</h1></slot>
        <tp-bar .store=${store} .links=${this.around.links} .local=${this.around.local} .away=${away} .opened=${this.opened} .saves=${!narrow}></tp-bar>
        <input id="file" class="visually-hidden" type="file" tabindex="-1" aria-label=${this.t("Open a file")} accept=${this.intake.readable} @change=${this.intake.chosen} />
        <input id="into" class="visually-hidden" type="file" tabindex="-1" aria-label=${this.t("Insert into a program")} accept=${this.intake.readable} @change=${this.intake.insert} />
        ${menu(frame)}
      </header>
      <div class="notes">
      ${this.newer ? html`<p class="note" role="status">${this.t("A newer version of this page is here.")} <button type="button" @click=${this.newer}>${this.t("Load it")}</button> ${this.t("The job stays as it is.")}</p>` : nothing}
      ${said && !said.foot ? html`<p class="note" role="status"><span>${store.say(said.text)}</span> <button type="button" class="ok" @click=${() => this.tell(null)}>OK</button></p>` : nothing}
      ${
        this.tools.now === "cycles"
          ? nothing
          : html`<p class="back"><button type="button" @click=${() => this.tools.use("cycles")}><span aria-hidden="true">←</span> ${this.t("Back to the job")}</button></p>`
      }
      </div>
      <main role=${this.around.links ? nothing : "group"} aria-label=${this.around.links ? nothing : this.t("Job")} class=${shape.join(" ").trim()} ?hidden=${this.tools.now !== "cycles"}>
        ${repeat(
          // Visual order and tab order agree: on a narrow page and on a portrait one the picture is above the form.
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
      ${this.tools.now === "gallery" ? html`<tp-gallery role="main" .store=${store} .adds=${this.actions.adds} @chosen=${this.actions.chosen}></tp-gallery>` : nothing}
      ${this.tools.now === "manual" ? html`<tp-manual role="main" tabindex="0" .store=${store} .topic=${this.actions.topic} @chosen=${this.actions.chosen}></tp-manual>` : nothing}
      ${this.tools.now === "viewer" && this.viewed ? html`<tp-viewer role="main" .store=${store} .viewed=${this.viewed} @adopt=${(e: CustomEvent<AnyJob>) => this.intake.adopt(e.detail)} @put=${(e: CustomEvent<Into>) => this.intake.put(e.detail)} @save=${(e: CustomEvent<Into>) => this.outlet.whole(e.detail)} @shown=${(e: CustomEvent<ProgramMoves>) => this.showsMoves(e.detail)}></tp-viewer>` : nothing}
      ${this.tools.now === "lengths" ? html`<tp-lentoax role="main" .store=${store} @taken=${() => this.tools.use("cycles")}></tp-lentoax>` : nothing}
      ${this.tools.now === "sheet" ? html`<tp-sheet role="main" .store=${store}></tp-sheet>` : nothing}
      <footer part="footer" ?hidden=${this.around.isRemotePanel || (beside && away === "" && !this.around.host.querySelector("[slot=footer]"))} aria-label=${this.t("State of the job")}>${away ? html`<div class="foot">${this.tools.now === "viewer" ? html`<p class="verdict warning">${this.t("Not checked, not proven: this only follows the program's words.")}</p>` : html`<p class="verdict">${away}</p>`}</div>` : beside ? nothing : findings}<slot name="footer"></slot></footer>
      ${dialogs(frame)}
      ${this.tools.there.has("commands") ? html`<tp-commands .store=${store} .actions=${actions(frame)}></tp-commands>` : nothing}
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
    if (this.tools.now !== "viewer" || !this.viewed) return "";
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

  /** Title of what is shown instead of the job. Meanwhile nothing of the job can be changed or saved. Empty if the job is shown. */
  private get replacedBy(): string {
    if (this.tools.now === "viewer")
      return this.t("An opened program is shown, not the job");
    return this.tools.now === "lengths"
      ? this.t("Tool lengths are shown, not the job")
      : "";
  }

  /** Data and actions for the menu and the dialogs. */
  private get frame(): Frame {
    const { store, around, theme, replacedBy: away } = this;
    return {
      store,
      local: around.local,
      links: around.links,
      away: away !== "",
      viewed: this.viewed !== null,
      theme,
      presets: this.tools.there.has("presets"),
      look: () => this.requestUpdate(),
      choose: (what) => {
        this.renderRoot.querySelector<HTMLElement>("#menu")?.hidePopover();
        // The menu item is gone: the focus returns to the menu button, however long the action takes.
        this.renderRoot
          .querySelector<HTMLElement>("tp-bar [popovertarget]")
          ?.focus({ preventScroll: true });
        this.actions.ask(what);
      },
      chooseLanguage: (lang) => this.language?.choose(lang),
      chooseTheme: (theme) => {
        around.host.theme = theme;
        if (around.local) keepTheme(theme);
      },
    };
  }

  /** Shows everything in the chosen language once its words are loaded. */
  async reword(): Promise<void> {
    await this.language?.follow();
  }

  protected override firstUpdated(): void {
    this.tools.preload();
  }

  /** Waits for the module, then draws what needs it. */
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
      if (part instanceof StorePart) part.catchUp();
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

  /** The help belongs to the focused field; without focus no help is shown. */
  private readonly unhelp = (event: Event): void => {
    const inside = (event.composedPath()[0] as Element).closest?.(
      "tp-form, tp-bar, tp-help",
    );
    if (!inside) this.store.focus(null);
  };

  /** Clears a message when another job is loaded; a transient one on any change. */
  private readonly forget = (): void => {
    const { document, revision } = this.store;
    if (this.said && this.said.at !== (this.said.passing ? revision : document))
      this.tell(null);
  };

  private readonly redraw = () => this.requestUpdate();

  /** The language of the job has changed: elements with its panels follow. */
  private readonly reworded = (): void => {
    if (!this.around.isRemotePanel) return;
    this.lang = this.store.lang;
    this.requestUpdate();
  };

  /** Whether a panel is visible here. */
  private sees(panel: PanelName): boolean {
    return this.wanted.includes(panel) && this.checkVisibility();
  }

  /** The app that shows a panel of the job: this one if it has the panel, else another one on the page that has it, else this one. */
  private with(panel: PanelName): App {
    if (this.sees(panel)) return this;
    return [...shown(this.store)].find((app) => app.sees(panel)) ?? this;
  }

  /** Goes to a field in the element that shows the form. */
  find(path: string): void {
    this.with("form").actions.go(path);
  }

  /** All visible panels, here or elsewhere. */
  private get everywhere(): PanelName[] {
    return [...new Set([...shown(this.store)].flatMap((app) => app.wanted))];
  }

  /** Announces a side effect of the store. */
  private readonly pass = (event: Event): void => {
    // Announces it once: in the element itself if visible, else in the element that shows the form.
    const all = [...shown(this.store)];
    const one =
      all.find((app) => !app.around.isRemotePanel && app.checkVisibility()) ??
      all.find((app) => app.sees("form"));
    if ((one ?? all[0]) === this)
      this.tell((event as CustomEvent<Message>).detail, true);
  };

  /** Shows a panel, in this element or elsewhere on the page. */
  private async open(panel: Exclude<Panel, "setup">): Promise<void> {
    const app = this.with(NAME_OF[panel]);
    await app.tools.use("cycles");
    const there = panel !== "measured" || app.panels.includes(panel);
    app.show(there ? panel : "results");
  }

  /** Applies light or dark colours, as the host page or the system requests. */
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

  /** `passing`: the message only holds for the current state of the job. */
  private tell(text: Message | null, passing = false, foot = passing): void {
    const { revision, document } = this.store;
    this.said = text && {
      text,
      passing,
      at: passing ? revision : document,
      foot: foot && !this.around.isRemotePanel,
    };
    this.requestUpdate();
  }
}

customElements.define("tp-app", App);
