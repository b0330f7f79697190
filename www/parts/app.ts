import { css, html, LitElement, nothing, type TemplateResult, unsafeCSS } from "lit";
import { JobError, type ProgramMoves, readProgram, version } from "../core/browser.js";
import { Store } from "../store.js";
import styles from "../style.css?inline";
import "./findings.js";
import "./form.js";
import "./gallery.js";
import { download } from "./hand.js";
import "./lentoax.js";
import "./picture.js";
import "./program.js";
import "./results.js";
import "./table.js";
import "./viewer.js";

const TABS = { setup: "Setup", program: "Program", table: "Parameters", results: "Results" } as const;
type Tab = keyof typeof TABS;

/** The tabs by the width of the window: what has a place of its own needs none. */
const LAYOUTS: [string, Tab[]][] = [
  ["(min-width: 1180px)", ["program", "table"]],
  ["(min-width: 900px)", ["program", "table", "results"]],
  ["all", ["setup", "program", "table", "results"]],
];

/** The whole page as one element. On a narrow screen one panel is shown at a time; on a wide one they stand side by side. */
class App extends LitElement {
  static override styles = css`${unsafeCSS(styles)}`;
  private readonly store = new Store();
  private tab: Tab = "setup";
  /** The probing cycles, SINUMERIK's LENTOAX, or a program that says no job. */
  private tool: "gallery" | "cycles" | "lengths" | "viewer" = "cycles";
  private viewed: { text: string; moves: ProgramMoves } | null = null;
  /** Whether a text can be pasted in, and what is there of it. */
  private pasting = false;
  private told = this.store.notice;
  private readonly layouts = LAYOUTS.map(([query, tabs]) => ({ query: matchMedia(query), tabs }));
  private readonly relayout = () => this.requestUpdate();

  /** How much of the window the picture takes that stays in sight. */
  private readonly observer = new ResizeObserver(([entry]) =>
    this.style.setProperty("--picture", `${Math.ceil(entry?.target.clientHeight ?? 0)}px`),
  );

  /** The kinds of files that may hold a job. */
  private get readable(): string {
    const programs = this.store.catalog.posts.flatMap(({ extension }) => [
      `.${extension}`,
      `.${extension.toUpperCase()}`,
    ]);
    return [...new Set([".json", ".txt", ".csv", ".i", ...programs, "application/json", "text/plain"])].join(",");
  }

  private get tabs(): Tab[] {
    return this.layouts.find(({ query }) => query.matches)?.tabs ?? [];
  }

  override connectedCallback(): void {
    super.connectedCallback();
    for (const { query } of this.layouts) query.addEventListener("change", this.relayout);
    this.addEventListener("paste", this.refuse);
    this.addEventListener("drop", this.refuse);
    this.addEventListener("dragover", this.welcome);
    this.addEventListener("focusin", this.uncover);
    this.addEventListener("input", this.uncover);
  }

  override disconnectedCallback(): void {
    super.disconnectedCallback();
    for (const { query } of this.layouts) query.removeEventListener("change", this.relayout);
    this.observer.disconnect();
    this.removeEventListener("paste", this.refuse);
    this.removeEventListener("drop", this.refuse);
    this.removeEventListener("dragover", this.welcome);
    this.removeEventListener("focusin", this.uncover);
    this.removeEventListener("input", this.uncover);
  }

  protected override firstUpdated(): void {
    const picture = this.renderRoot.querySelector("tp-picture");
    if (picture) this.observer.observe(picture);
  }

  override render(): TemplateResult {
    const tabs = this.tabs;
    const active = tabs.includes(this.tab) ? this.tab : (tabs[0] as Tab);
    const hidden = (tab: Tab) => tabs.includes(tab) && tab !== active;
    return html`
      <header>
        <h1>Touchpath</h1>
        <p>Touch-probe cycles, seen before the machine moves</p>
        <nav aria-label="Tools">
          <button type="button" aria-pressed=${this.tool === "gallery" ? "true" : "false"} @click=${() => this.use("gallery")}>Gallery</button>
          <button type="button" aria-pressed=${this.tool === "cycles" ? "true" : "false"} @click=${() => this.use("cycles")}>Cycles</button>
          <button type="button" aria-pressed=${this.tool === "lengths" ? "true" : "false"} @click=${() => this.use("lengths")}>Tool lengths</button>
          ${this.viewed ? html`<button type="button" aria-pressed=${this.tool === "viewer" ? "true" : "false"} @click=${() => this.use("viewer")}>Moves</button>` : nothing}
        </nav>
        <span class="gap"></span>
        <button type="button" @click=${() => this.store.reset()}>Reset</button>
        <button type="button" @click=${this.saveJob}>Save job</button>
        <button type="button" aria-expanded=${this.pasting ? "true" : "false"} @click=${() => this.paste(!this.pasting)}>Paste</button>
        <label class="button">Open job<input type="file" accept=${this.readable} @change=${this.openJob} /></label>
        <small>${version()} <a href="./licences.txt">Licences</a></small>
      </header>
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
      <main ?hidden=${this.tool !== "cycles"} @go=${(e: CustomEvent<string>) => this.go(e.detail)}>
        <section class="picture" aria-label="Picture">
          <tp-picture .store=${this.store}></tp-picture>
          <tp-findings .store=${this.store}></tp-findings>
        </section>
        <div class="tabs" role="tablist" aria-label="Panels">
          ${tabs.map(
            (
              tab,
            ) => html`<button type="button" role="tab" id=${`tab-${tab}`} aria-controls=${`panel-${tab}`} tabindex=${tab === active ? 0 : -1}
            aria-selected=${tab === active ? "true" : "false"} @click=${() => this.show(tab)} @keydown=${(e: KeyboardEvent) => this.key(e, tabs, tab)}>${TABS[tab]}</button>`,
          )}
        </div>
        <section class="setup" id="panel-setup" aria-label="Setup" ?hidden=${hidden("setup")}><tp-form .store=${this.store}></tp-form></section>
        <section class="program" id="panel-program" aria-label="Program" ?hidden=${hidden("program")}><tp-program .store=${this.store}></tp-program></section>
        <section class="table" id="panel-table" aria-label="Parameters" ?hidden=${hidden("table")}><tp-table .store=${this.store}></tp-table></section>
        <section class="results" id="panel-results" aria-label="Results" ?hidden=${hidden("results")}><tp-results .store=${this.store}></tp-results></section>
      </main>
      ${this.tool === "gallery" ? html`<tp-gallery role="main" .store=${this.store} @chosen=${() => this.use("cycles")}></tp-gallery>` : nothing}
      ${this.tool === "viewer" && this.viewed ? html`<tp-viewer role="main" .store=${this.store} .viewed=${this.viewed}></tp-viewer>` : nothing}
      ${this.tool === "lengths" ? html`<tp-lentoax role="main" .store=${this.store} @taken=${() => this.use("cycles")}></tp-lentoax>` : nothing}
    `;
  }

  private show(tab: Tab): void {
    this.tab = tab;
    this.requestUpdate();
  }

  private key(event: KeyboardEvent, tabs: Tab[], tab: Tab): void {
    const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
    if (!step) return;
    const next = tabs[(tabs.indexOf(tab) + step + tabs.length) % tabs.length] as Tab;
    this.show(next);
    this.updateComplete.then(() => this.renderRoot.querySelector<HTMLElement>(`#tab-${next}`)?.focus());
  }

  /** Brings a field out from under the picture that stays in sight: a browser that scrolls to the caret knows nothing of it. */
  private readonly uncover = (event: Event): void => {
    const field = event.composedPath()[0];
    const picture = this.renderRoot.querySelector("tp-picture");
    if (!(field instanceof HTMLElement) || !picture || picture.contains(field)) return;
    requestAnimationFrame(() => {
      if (getComputedStyle(picture).position !== "sticky") return;
      const hidden = picture.getBoundingClientRect().bottom + 34 - field.getBoundingClientRect().top;
      if (hidden > 0 && field.isConnected) scrollBy(0, -hidden);
    });
  };

  /** To the field of a path, or to the nearest one around it. */
  private async go(path: string): Promise<void> {
    if (this.tabs.includes("setup")) this.show("setup");
    await this.updateComplete;
    const find = (p: string) => this.renderRoot.querySelector<HTMLElement>(`[id="f-${p}"]`);
    const field = find(path) ?? find(`${path}[0]`) ?? find(`${path}.offset[0]`);
    field?.scrollIntoView({ block: "center" });
    field?.focus();
  }

  private use(tool: "gallery" | "cycles" | "lengths" | "viewer"): void {
    this.tool = tool;
    this.requestUpdate();
  }

  /** The form as it stands, also with errors: it is the user's work. */
  private saveJob(): void {
    download(`${JSON.stringify(this.store.draft, null, 2)}\n`, "job.json", "application/json");
  }

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
