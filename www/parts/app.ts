import { css, html, LitElement, nothing, type TemplateResult, unsafeCSS } from "lit";
import { JobError, type ProgramMoves, readProgram, version } from "../core/browser.js";
import { fromFragment, isFragment, toFragment } from "../share.js";
import { Store } from "../store.js";
import styles from "../style.css?inline";
import "./bar.js";
import "./checks.js";
import "./findings.js";
import "./form.js";
import "./gallery.js";
import { copy, download } from "./hand.js";
import "./help.js";
import "./lentoax.js";
import { Part } from "./part.js";
import "./picture.js";
import "./presets.js";
import type { ProgramPart } from "./program.js";
import "./program.js";
import "./results.js";
import "./sheet.js";
import "./table.js";
import "./viewer.js";

const PANELS = {
  setup: "Setup",
  program: "Program",
  table: "Parameters",
  results: "Results",
  checks: "Checks",
} as const;
type Panel = keyof typeof PANELS;

/** From this width on the form has a column of its own; the style sheet knows the same width. */
const WIDE = 1080;
/** Below this width picture and panel stand on each other; the style sheet knows the same width. */
const NARROW = 600;

/** What takes the place of the job's picture and panels: pictures to choose from, LENTOAX, a program that says no job, a page to print. */
type Tool = "gallery" | "cycles" | "lengths" | "viewer" | "sheet";

/** The whole page as one element. What fits beside the picture has a place of its own; the rest is behind tabs. */
class App extends LitElement {
  static override styles = css`${unsafeCSS(styles)}`;
  private readonly store = new Store();
  private panel: Panel | null = null;
  private tool: Tool = "cycles";
  private viewed: { text: string; moves: ProgramMoves } | null = null;
  /** Whether a text can be pasted in, and what is there of it. */
  private pasting = false;
  private told = this.store.notice;
  /** Takes a newer version of the page, where there is one. */
  private newer: (() => void) | null = null;
  private width = WIDE;
  private readonly observer = new ResizeObserver(() => this.measure());

  /** The kinds of files that may hold a job. */
  private get readable(): string {
    const programs = this.store.catalog.posts.flatMap(({ extension }) => [
      `.${extension}`,
      `.${extension.toUpperCase()}`,
    ]);
    return [...new Set([".json", ".txt", ".csv", ".i", ...programs, "application/json", "text/plain"])].join(",");
  }

  private get panels(): Panel[] {
    return (Object.keys(PANELS) as Panel[]).filter((panel) => panel !== "setup" || this.width < WIDE);
  }

  override connectedCallback(): void {
    super.connectedCallback();
    this.measure();
    this.observer.observe(this);
    this.addEventListener("paste", this.refuse);
    this.addEventListener("drop", this.refuse);
    this.addEventListener("dragover", this.welcome);
    this.addEventListener("keydown", this.shortcut);
    this.addEventListener("focusin", this.unhelp);
    this.addEventListener("update-ready", this.offer);
    addEventListener("hashchange", this.follow);
    this.follow();
  }

  override disconnectedCallback(): void {
    super.disconnectedCallback();
    this.observer.disconnect();
    this.removeEventListener("paste", this.refuse);
    this.removeEventListener("drop", this.refuse);
    this.removeEventListener("dragover", this.welcome);
    this.removeEventListener("keydown", this.shortcut);
    this.removeEventListener("focusin", this.unhelp);
    this.removeEventListener("update-ready", this.offer);
    removeEventListener("hashchange", this.follow);
  }

  override render(): TemplateResult {
    const panels = this.panels;
    const active = this.panel && panels.includes(this.panel) ? this.panel : (panels[0] as Panel);
    const hidden = (panel: Panel) => panels.includes(panel) && panel !== active;
    return html`
      <div class="frame" @ask=${(e: CustomEvent<string>) => this.ask(e.detail)} @go=${(e: CustomEvent<string>) => this.go(e.detail)}>
      <header>
        <h1>Touchpath</h1>
        <tp-bar .store=${this.store}></tp-bar>
        <input id="file" class="unseen" type="file" tabindex="-1" aria-label="Open a file" accept=${this.readable} @change=${this.openJob} />
        ${this.menu()}
      </header>
      <div class="notes">
      ${this.newer ? html`<p class="note" role="status">A newer version of this page is here. <button type="button" @click=${this.newer}>Take it</button> The job stays.</p>` : nothing}
      ${this.told ? html`<p class="note" role="status">${this.told} <button type="button" @click=${() => this.tell("")}>OK</button></p>` : nothing}
      ${
        this.pasting
          ? html`<section class="paste" aria-label="Paste">
        <label for="paste">A dump of CmdPrm codes, a program with cycle 1411, any program that was written here, or a job</label>
        <textarea id="paste" rows="6" spellcheck="false"></textarea>
        <div class="tools"><button type="button" @click=${this.readPasted}>Read it</button><button type="button" @click=${() => this.paste(false)}>Cancel</button></div>
      </section>`
          : nothing
      }
      ${
        this.tool === "cycles"
          ? nothing
          : html`<p class="back"><button type="button" @click=${() => this.use("cycles")}>Cycles</button> ${this.tool === "sheet" ? nothing : "back to the job"}</p>`
      }
      </div>
      <main ?hidden=${this.tool !== "cycles"}>
        <section class="setup" id="panel-setup" aria-label="Setup" ?hidden=${hidden("setup")}>
          <tp-form .store=${this.store}></tp-form>
          <tp-help .store=${this.store}></tp-help>
        </section>
        <section class="picture" aria-label="Picture"><tp-picture .store=${this.store}></tp-picture></section>
        <div class="tabs" role="tablist" aria-label="Panels">
          ${panels.map(
            (
              panel,
            ) => html`<button type="button" role="tab" id=${`tab-${panel}`} aria-controls=${`panel-${panel}`} tabindex=${panel === active ? 0 : -1}
            aria-selected=${panel === active ? "true" : "false"} @click=${() => this.show(panel)} @keydown=${(e: KeyboardEvent) => this.key(e, panels, panel)}>${PANELS[panel]}</button>`,
          )}
        </div>
        <section class="panel" id="panel-program" aria-label="Program" ?hidden=${hidden("program")}><tp-program .store=${this.store}></tp-program></section>
        <section class="panel" id="panel-table" aria-label="Parameters" ?hidden=${hidden("table")}><tp-table .store=${this.store}></tp-table></section>
        <section class="panel scrolls" id="panel-results" aria-label="Results" ?hidden=${hidden("results")}><tp-results .store=${this.store}></tp-results></section>
        <section class="panel scrolls" id="panel-checks" aria-label="Checks" ?hidden=${hidden("checks")}><tp-checks .store=${this.store}></tp-checks></section>
      </main>
      ${this.tool === "gallery" ? html`<tp-gallery role="main" .store=${this.store} @chosen=${() => this.use("cycles")}></tp-gallery>` : nothing}
      ${this.tool === "viewer" && this.viewed ? html`<tp-viewer role="main" .store=${this.store} .viewed=${this.viewed}></tp-viewer>` : nothing}
      ${this.tool === "lengths" ? html`<tp-lentoax role="main" .store=${this.store} @taken=${() => this.use("cycles")}></tp-lentoax>` : nothing}
      ${this.tool === "sheet" ? html`<tp-sheet role="main" .store=${this.store} @closed=${() => this.use("cycles")}></tp-sheet>` : nothing}
      <footer aria-label="State of the job"><tp-findings .store=${this.store}></tp-findings></footer>
      ${this.question()}
      </div>
    `;
  }

  /** What is rarely used. */
  private menu(): TemplateResult {
    const item = (what: string, name: string) =>
      html`<button type="button" @click=${() => this.choose(what)}>${name}</button>`;
    return html`<div class="menu" id="menu" popover role="group" aria-label="More">
      ${item("open", "Open a file")} ${item("paste", "Paste")} ${item("save-job", "Save job")} ${item("share", "Copy a link to this job")}
      ${item("sheet", "Setup sheet to print")} ${item("presets", "Presets")} ${item("lengths", "Tool lengths")} ${this.viewed ? item("viewer", "Moves of the opened program") : nothing}
      ${item("reset", "Reset")}
      <small>Touchpath ${version()} · <a href="./licences.txt">Licences</a></small>
    </div>`;
  }

  private question(): TemplateResult {
    return html`<dialog id="presets" aria-label="Presets" aria-describedby="presets-help">
      <tp-presets .store=${this.store}></tp-presets>
      <form method="dialog" class="tools"><button>Close</button></form>
    </dialog>
    <dialog id="ask-reset" aria-labelledby="ask-reset-text">
      <p id="ask-reset-text">Put the whole form back to the defaults of “${this.store.cycle.title}”? Undo brings back what is there now.</p>
      <form method="dialog" class="tools"><button @click=${() => this.store.reset()}>Put back</button><button>Keep</button></form>
    </dialog>`;
  }

  protected override updated(): void {
    for (const part of this.renderRoot.querySelectorAll("main:not([hidden]) > section:not([hidden]) > *"))
      if (part instanceof Part) part.catchUp();
    // One order for eye and Tab: on a narrow page the picture stands above the form.
    const main = this.renderRoot.querySelector("main");
    const [setup, picture] = [".setup", ".picture"].map((name) => this.renderRoot.querySelector(name));
    if (!main || !setup || !picture) return;
    const above = picture.compareDocumentPosition(setup) & Node.DOCUMENT_POSITION_FOLLOWING;
    const wanted = this.width < NARROW;
    if (wanted !== Boolean(above)) main.insertBefore(picture, wanted ? setup : setup.nextSibling);
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
    if (!(event.ctrlKey || event.metaKey) || event.altKey) return;
    const key = event.key.toLowerCase();
    const at = event.composedPath()[0] as Element;
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

  /** The help is of the field that has the focus: elsewhere there is none. */
  private readonly unhelp = (event: Event): void => {
    const inside = (event.composedPath()[0] as Element).closest?.("tp-form, tp-bar, tp-help");
    if (!inside) this.store.focus(null);
  };

  /** To the field of a path, or to the nearest one around it. */
  private async go(path: string): Promise<void> {
    this.use("cycles");
    if (this.panels.includes("setup")) this.show("setup");
    await this.updateComplete;
    await this.renderRoot.querySelector<Element & { unfold(path: string): Promise<boolean> }>("tp-form")?.unfold(path);
    const find = (p: string) => this.renderRoot.querySelector<HTMLElement>(`[id="f-${p}"]`);
    const field = find(path) ?? find(`${path}[0]`) ?? find(`${path}.offset[0]`);
    field?.scrollIntoView({ block: "center" });
    field?.focus();
  }

  private use(tool: Tool): void {
    this.tool = tool;
    this.requestUpdate();
  }

  private choose(what: string): void {
    this.renderRoot.querySelector<HTMLElement>("#menu")?.hidePopover();
    this.ask(what);
  }

  /** Does what a button of the bar or the menu asks for. */
  private ask(what: string): void {
    const dialog = this.renderRoot.querySelector<HTMLDialogElement>("#ask-reset");
    const actions: Record<string, () => void> = {
      gallery: () => this.use(this.tool === "gallery" ? "cycles" : "gallery"),
      open: () => this.renderRoot.querySelector<HTMLInputElement>("#file")?.click(),
      paste: () => this.paste(!this.pasting),
      reset: () => dialog?.showModal(),
      save: () => this.renderRoot.querySelector<ProgramPart>("tp-program")?.save(),
      sheet: () => this.store.withheld === null && this.use("sheet"),
      lengths: () => this.use("lengths"),
      presets: () => this.renderRoot.querySelector<HTMLDialogElement>("#presets")?.showModal(),
      viewer: () => this.use("viewer"),
      checks: () => {
        this.use("cycles");
        this.show("checks");
      },
      share: () => this.share(),
      "save-job": () => this.saveJob(),
    };
    actions[what]?.();
  }

  /** The form as it stands, also with errors: it is the user's work. */
  private saveJob(): void {
    download(`${JSON.stringify(this.store.draft, null, 2)}\n`, this.store.otherName(".json"), "application/json");
  }

  private async share(): Promise<void> {
    const fragment = await toFragment({ job: this.store.draft, measured: this.store.measured });
    if (fragment === null) {
      this.tell("This job is too long for a link: save it as a file instead");
      return;
    }
    const link = new URL(fragment, location.href).href;
    const told = await copy(link);
    this.tell(
      told === "Copied" ? "A link to this job was copied. The job is in the link itself: no server keeps it." : link,
    );
  }

  private readonly offer = (event: Event): void => {
    this.newer = (event as CustomEvent<() => void>).detail;
    this.requestUpdate();
  };

  /** Takes the job of a link. The address forgets it, so that a reload keeps what is done since. */
  private readonly follow = async (): Promise<void> => {
    const { hash } = location;
    if (!isFragment(hash)) return;
    history.replaceState(null, "", location.pathname + location.search);
    const state = await fromFragment(hash, this.store.longest);
    try {
      if (!state) throw new JobError("Nothing was changed: this link holds no job that can be read here", []);
      this.store.take(state.job, state.measured);
      this.use("cycles");
      this.tell("This is the job of the link that was opened. Undo brings back the one before.");
    } catch (thrown) {
      this.tell(thrown instanceof JobError ? thrown.message : "This link cannot be read");
    }
  };

  private async openJob(event: Event): Promise<void> {
    const input = event.target as HTMLInputElement;
    const file = input.files?.[0];
    if (file) await this.takeFile(file);
    input.value = "";
  }

  /** A file too large for a job is not even read. */
  private async takeFile(file: File): Promise<void> {
    if (file.size > this.store.longest) this.tell(this.store.tooLong(file.size, "file"));
    else {
      // A folder can be dropped, too.
      const text = await file.text().catch(() => null);
      if (text === null) this.tell("This file cannot be read");
      else this.take(text);
    }
  }

  /** A file may be dropped anywhere: a job, a dump, a program. */
  private readonly welcome = (event: DragEvent): void => {
    if (event.dataTransfer?.types.includes("Files")) event.preventDefault();
  };

  /** A text of many megabytes in a field would hold up the browser: it never gets there. */
  private readonly refuse = (event: ClipboardEvent | DragEvent): void => {
    const data = event instanceof DragEvent ? event.dataTransfer : event.clipboardData;
    const field = event.composedPath()[0];
    if (event instanceof DragEvent && data?.files[0]) {
      event.preventDefault();
      this.takeFile(data.files[0]);
      return;
    }
    const there = field instanceof HTMLTextAreaElement ? field.value.length : 0;
    const length = there + (data?.getData("text/plain").length ?? 0);
    if (length <= this.store.longest) return;
    event.preventDefault();
    this.tell(this.store.tooLong(length));
  };

  private paste(open: boolean): void {
    this.pasting = open;
    this.requestUpdate();
    if (open) this.updateComplete.then(() => this.renderRoot.querySelector<HTMLElement>("#paste")?.focus());
  }

  /** What was pasted stays where it is until it could be read. */
  private readPasted(): void {
    const text = this.renderRoot.querySelector<HTMLTextAreaElement>("#paste")?.value ?? "";
    if (this.take(text)) this.paste(false);
  }

  private take(text: string): boolean {
    try {
      const notes = this.store.open(text).filter((f) => f.level !== "error");
      this.use("cycles");
      this.tell(notes.map((f) => f.message).join(" "));
      return true;
    } catch (thrown) {
      if (!(thrown instanceof JobError)) this.tell("This text cannot be read");
      else if (this.view(text, thrown)) return true;
      else this.tell(thrown.message);
      return false;
    }
  }

  /** Shows the moves of a program that no job can be made of; false where it is none. The job that is there stays. */
  private view(text: string, why: JobError): boolean {
    const program = why.findings.some((f) =>
      ["no-job-in-program", "not-understood", "nothing-to-import"].includes(f.code),
    );
    const moves = program ? readProgram(text) : null;
    // One move from nowhere is nothing to see.
    if (!moves || moves.kind.length < 2) return false;
    this.viewed = { text, moves };
    this.use("viewer");
    this.tell(`${why.message}. Its moves are drawn`);
    return true;
  }

  private tell(text: string): void {
    this.told = text;
    this.requestUpdate();
  }
}

customElements.define("touchpath-app", App);
