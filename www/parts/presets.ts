import { html, nothing, type TemplateResult } from "lit";
import { JobError } from "../core/browser.js";
import {
  added,
  keepPresets,
  MOST,
  type Preset,
  presets,
  read,
  written,
} from "../presets.js";
import { w } from "../words.js";
import { download } from "./download.js";
import { StorePart } from "./part.js";

/** Parts of a preset that can be applied separately, with their sections. */
const PARTS: Record<string, [string, string[]]> = {
  stylus: [w("Stylus and overtravel"), ["stylus", "overtravel"]],
  feeds: [w("Feeds"), ["feeds"]],
  control: [w("Control, tool and machine"), ["control", "tool", "machine"]],
};

/** Named presets of stylus, feeds and control: stored, applied, saved as a file. */
class PresetsPart extends StorePart {
  protected override storeEvents: string[] = [];
  private list: Preset[] = presets() ?? [];
  private told = "";
  /** The list before the last change, if it can be undone. */
  private earlier: Preset[] | null = null;
  /** Parts of a preset to apply. */
  private readonly parts = new Set(Object.keys(PARTS));

  override render(): TemplateResult {
    return html`
      <p id="presets-help">${this.t("A machine is stored with its stylus, overtravel, feeds, control and tool, and appears in the list at the top of the page. The cycle, the part and the work offset stay as they are. Machines are stored in this browser.")}</p>
      <div class="tools">
        <input class="filter" id="preset-name" type="text" aria-label=${this.t("Name of the machine")} placeholder=${this.t("Name, such as Mill 2, ball 6")} maxlength="80"
          @keydown=${(e: KeyboardEvent) => e.key === "Enter" && this.keep()} />
        <button type="button" @click=${() => this.keep()}>${this.t("Keep the current values")}</button>
      </div>
      <p class="status-text"><span role="status">${this.told}</span> ${this.earlier ? html`<button type="button" class="quiet" @click=${this.takeBack}>${this.t("Undo")}</button>` : nothing}</p>
      ${
        this.list.length > 0
          ? html`<fieldset class="tools" aria-label=${this.t("Parts of a machine to use")}>${Object.entries(
              PARTS,
            ).map(
              ([part, [name]]) =>
                html`<label class="check"><input type="checkbox" .checked=${this.parts.has(part)} @change=${() => this.choose(part)} /> ${this.t(name)}</label>`,
            )}</fieldset>`
          : nothing
      }
      <ul class="found">${this.list.map(
        (preset) => html`<li class="row"><b class="gap">${preset.name}</b>
          <button type="button" ?disabled=${this.parts.size === 0} aria-label=${this.t("Use {name}", preset.name)} @click=${() => this.use(preset)}>${this.t("Use")}</button>
          <button type="button" aria-label=${this.t("Delete {name}", preset.name)} @click=${() => this.forget(preset)}>${this.t("Forget")}</button></li>`,
      )}</ul>
      <div class="tools">
        <button type="button" ?disabled=${this.list.length === 0} @click=${() => download(written(this.list), "touchpath-presets.json", "application/json")}>${this.t("Save all as a file")}</button>
        <label class="button">${this.t("Open a file of machines")}<input type="file" accept=".json,application/json" @change=${this.open} /></label>
      </div>
    `;
  }

  private keep(): void {
    const box = this.querySelector<HTMLInputElement>("#preset-name");
    const name = box?.value.trim() ?? "";
    if (name === "") this.tell(this.t("A machine needs a name"));
    else {
      const replaced = this.list.some((one) => one.name === name);
      const done = this.put(
        (list) => added(list, this.store.preset(name)),
        replaced,
      );
      if (done)
        this.tell(
          replaced
            ? this.t("Replaced “{name}”", name)
            : this.t("Stored “{name}”", name),
        );
    }
  }

  private choose(part: string): void {
    if (!this.parts.delete(part)) this.parts.add(part);
    this.requestUpdate();
  }

  /** Undoes the last change of the list. */
  private readonly takeBack = (): void => {
    const { earlier } = this;
    // Presets that another tab has added since stay.
    if (earlier && this.put((list) => earlier.reduce(added, list)))
      this.tell("");
  };

  private use(preset: Preset): void {
    try {
      const sections = Object.entries(PARTS).flatMap(([part, [, names]]) =>
        this.parts.has(part) ? names : [],
      );
      this.store.usePreset(preset, sections);
      this.earlier = null;
      this.tell(
        this.t(
          "“{name}” is in use. Undo restores the previous machine.",
          preset.name,
        ),
      );
    } catch (thrown) {
      this.tell(
        thrown instanceof JobError
          ? this.store.why(thrown)
          : this.t("This machine cannot be used"),
      );
    }
  }

  private forget(preset: Preset): void {
    if (
      this.put((list) => list.filter((one) => one.name !== preset.name), true)
    )
      this.tell(this.t("Deleted “{name}”", preset.name));
  }

  /** Adds the presets of a file; those with the same name replace stored ones. */
  private readonly open = async (event: Event): Promise<void> => {
    const input = event.target as HTMLInputElement;
    const file = input.files?.[0];
    input.value = "";
    if (!file) return;
    const text =
      file.size > this.store.longest ? "" : await file.text().catch(() => "");
    const found = read(text);
    if (!found)
      this.tell(
        this.t(
          "Nothing was changed: this file has no machines that can be read here",
        ),
      );
    else if (this.put((list) => found.reduce(added, list), true))
      this.tell(this.t("{count} machines were read", found.length));
  };

  /** Changes the stored list, which another tab may have changed. `loses`: entries disappear, and the change can be undone. */
  private put(change: (list: Preset[]) => Preset[], loses = false): boolean {
    const old = presets() ?? this.list;
    const list = change(old);
    if (list.length > MOST) {
      this.tell(
        this.t(
          "Nothing was changed: at most {most} machines can be stored, and these would be {count}",
          MOST,
          list.length,
        ),
      );
      return false;
    }
    this.list = list;
    this.earlier = loses ? old : null;
    const kept = keepPresets(list);
    this.store.dispatchEvent(new Event("machines"));
    if (kept) return true;
    this.tell(
      this.t(
        "This browser stores nothing: the machines are lost when you leave the page",
      ),
    );
    return false;
  }

  private tell(text: string): void {
    this.told = text;
    this.requestUpdate();
  }
}

customElements.define("tp-presets", PresetsPart);
