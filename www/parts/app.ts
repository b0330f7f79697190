import { css, html, LitElement, nothing, type TemplateResult, unsafeCSS } from "lit";
import { JobError, version } from "../core/browser.js";
import { Store } from "../store.js";
import styles from "../style.css?inline";
import "./findings.js";
import "./form.js";
import "./gallery.js";
import "./lentoax.js";
import "./picture.js";
import "./program.js";
import "./results.js";
import "./table.js";

const TABS = { setup: "Setup", program: "Program", table: "Parameters", results: "Results" } as const;
type Tab = keyof typeof TABS;

/** The whole page as one element. On a narrow screen one panel is shown at a time; on a wide one they stand side by side. */
class App extends LitElement {
  static override styles = css`${unsafeCSS(styles)}`;
  private readonly store = new Store();
  private tab: Tab = "setup";
  /** The probing cycles, or SINUMERIK's LENTOAX. */
  private tool: "gallery" | "cycles" | "lengths" = "cycles";
  /** Whether a text can be pasted in, and what is there of it. */
  private pasting = false;
  private told = "";
  private readonly wide = matchMedia("(min-width: 900px)");
  private readonly relayout = () => this.requestUpdate();

  override connectedCallback(): void {
    super.connectedCallback();
    this.wide.addEventListener("change", this.relayout);
  }

  override disconnectedCallback(): void {
    super.disconnectedCallback();
    this.wide.removeEventListener("change", this.relayout);
  }

  override render(): TemplateResult {
    const wide = this.wide.matches;
    const tabs: Tab[] = wide ? ["program", "table"] : ["setup", "program", "table", "results"];
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
        </nav>
        <span class="gap"></span>
        <button type="button" @click=${() => this.store.reset()}>Reset</button>
        <button type="button" @click=${this.saveJob}>Save job</button>
        <button type="button" aria-expanded=${this.pasting ? "true" : "false"} @click=${() => this.paste(!this.pasting)}>Paste</button>
        <label class="button">Open job<input type="file" accept=".json,.h,.H,.txt,.csv,.nc,.i,.mpf,.MPF,application/json,text/plain" @change=${this.openJob} /></label>
        <small>${version()}</small>
      </header>
      ${this.told ? html`<p class="note" role="status">${this.told} <button type="button" @click=${this.hush}>OK</button></p>` : nothing}
      ${
        this.pasting
          ? html`<section class="paste" aria-label="Paste">
        <label for="paste">A dump of CmdPrm codes, a program with cycle 1411, a SINUMERIK program that was written here, or a job</label>
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

  /** To the field of a path, or to the nearest one around it. */
  private async go(path: string): Promise<void> {
    if (!this.wide.matches) this.show("setup");
    await this.updateComplete;
    const find = (p: string) => this.renderRoot.querySelector<HTMLElement>(`[id="f-${p}"]`);
    const field = find(path) ?? find(`${path}[0]`) ?? find(`${path}.offset[0]`);
    field?.scrollIntoView({ block: "center" });
    field?.focus();
  }

  private use(tool: "gallery" | "cycles" | "lengths"): void {
    this.tool = tool;
    this.requestUpdate();
  }

  private hush(): void {
    this.told = "";
    this.requestUpdate();
  }

  private saveJob(): void {
    const link = document.createElement("a");
    const text = `${JSON.stringify(this.store.draft, null, 2)}\n`;
    link.href = URL.createObjectURL(new Blob([text], { type: "application/json" }));
    link.download = "job.json";
    link.click();
    URL.revokeObjectURL(link.href);
  }

  private async openJob(event: Event): Promise<void> {
    const input = event.target as HTMLInputElement;
    const text = await input.files?.[0]?.text();
    input.value = "";
    this.take(text ?? "");
  }

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
      this.told = notes.map((f) => f.message).join(" ");
      this.use("cycles");
      return true;
    } catch (thrown) {
      this.told = thrown instanceof JobError ? thrown.message : "This text cannot be read";
      this.requestUpdate();
      return false;
    }
  }
}

customElements.define("touchpath-app", App);
