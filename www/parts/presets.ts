import { html, type TemplateResult } from "lit";
import { JobError } from "../core/browser.js";
import { added, keepPresets, MOST, type Preset, presets, read, written } from "../presets.js";
import { download } from "./hand.js";
import { Part } from "./part.js";

/** Named presets of stylus, feeds and control: kept, used, taken along as a file. */
class PresetsPart extends Part {
  protected override follows: string[] = [];
  private list: Preset[] = presets() ?? [];
  private told = "";

  override render(): TemplateResult {
    return html`
      <p id="presets-help">${this.t("A preset holds stylus, overtravel, feeds, control and tool: what belongs to a machine. The cycle and the part stay as they are. Presets are kept in this browser.")}</p>
      <div class="tools">
        <input class="filter" id="preset-name" type="text" aria-label=${this.t("Name of the preset")} placeholder=${this.t("Name, such as Mill 2, ball 6")} maxlength="80"
          @keydown=${(e: KeyboardEvent) => e.key === "Enter" && this.keep()} />
        <button type="button" @click=${() => this.keep()}>${this.t("Keep the present values")}</button>
      </div>
      <p role="status" class="told">${this.told}</p>
      <ul class="found">${this.list.map(
        (preset) => html`<li class="row"><b class="gap">${preset.name}</b>
          <button type="button" aria-label=${this.t("Use {name}", preset.name)} @click=${() => this.use(preset)}>${this.t("Use")}</button>
          <button type="button" aria-label=${this.t("Forget {name}", preset.name)} @click=${() => this.forget(preset)}>${this.t("Forget")}</button></li>`,
      )}</ul>
      <div class="tools">
        <button type="button" ?disabled=${this.list.length === 0} @click=${() => download(written(this.list), "touchpath-presets.json", "application/json")}>${this.t("Save all as a file")}</button>
        <label class="button">${this.t("Open a file of presets")}<input type="file" accept=".json,application/json" @change=${this.open} /></label>
      </div>
    `;
  }

  private keep(): void {
    const box = this.querySelector<HTMLInputElement>("#preset-name");
    const name = box?.value.trim() ?? "";
    if (name === "") this.tell(this.t("A preset needs a name"));
    else if (this.put((list) => added(list, this.store.preset(name)))) this.tell(this.t("Kept “{name}”", name));
  }

  private use(preset: Preset): void {
    try {
      this.store.usePreset(preset);
      this.tell(this.t("“{name}” is used. Undo brings back what was there.", preset.name));
    } catch (thrown) {
      this.tell(thrown instanceof JobError ? this.store.why(thrown) : this.t("This preset cannot be used"));
    }
  }

  private forget(preset: Preset): void {
    if (this.put((list) => list.filter((one) => one.name !== preset.name)))
      this.tell(this.t("Forgot “{name}”", preset.name));
  }

  /** Those of a file come beside those that are here; of the same name, that of the file counts. */
  private readonly open = async (event: Event): Promise<void> => {
    const input = event.target as HTMLInputElement;
    const file = input.files?.[0];
    input.value = "";
    if (!file) return;
    const text = file.size > this.store.longest ? "" : await file.text().catch(() => "");
    const found = read(text);
    if (!found) this.tell(this.t("Nothing was changed: this file holds no presets that can be read here"));
    else if (this.put((list) => found.reduce(added, list)))
      this.tell(this.t("{count} presets were read", found.length));
  };

  /** Changes the list as it is kept now: another tab may have changed it. */
  private put(change: (list: Preset[]) => Preset[]): boolean {
    const list = change(presets() ?? this.list);
    if (list.length > MOST) {
      this.tell(
        this.t("Nothing was changed: at most {most} presets are kept, and these would be {count}", MOST, list.length),
      );
      return false;
    }
    this.list = list;
    if (keepPresets(list)) return true;
    this.tell(this.t("This browser keeps nothing: the presets are there until the page is left"));
    return false;
  }

  private tell(text: string): void {
    this.told = text;
    this.requestUpdate();
  }
}

customElements.define("tp-presets", PresetsPart);
