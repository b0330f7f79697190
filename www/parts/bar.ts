import { html, nothing, type TemplateResult } from "lit";
import type { CycleEntry } from "../core/browser.js";
import { alike, type Draft, isObject } from "../job.js";
import { convertedPreset, type Preset, presets, SECTIONS } from "../presets.js";
import { probeInWords, whatInWords } from "../sentences.js";
import { w } from "../words.js";
import { FieldPart } from "./field.js";
import { saveButton } from "./save.js";

/** Values that a native cycle can set, by the values of its fields. */
const SETS: [
  confirmRotation: number,
  transferPosition: number,
  words: string,
][] = [
  [0, 0, w("measures only")],
  [1, 0, w("sets basic rotation")],
  [1, 3, w("sets basic rotation and preset X Y, mean of both circles")],
  [1, 1, w("sets basic rotation and preset X Y by circle 1")],
  [1, 2, w("sets basic rotation and preset X Y by circle 2")],
  [0, 3, w("sets preset X Y, mean of both circles")],
];

/** Code of the finding that shank and body of the probe are unknown and therefore not checked. */
export const STYLUS_UNKNOWN = "stylus-not-known";

/** Placeholders of the menus in the sentence; no language uses brackets. */
const SLOTS = ["[what]", "[machine]", "[does]"];

/** Bar of the page: the sentence with features, machine and write summary, and the buttons for undo and save. */
class BarPart extends FieldPart {
  protected override storeEvents = ["change", "machines"];
  /** Whether the page offers links to the job. */
  links = false;
  /** Whether machines are stored in this browser. */
  local = false;
  /** Title of what is shown instead of the job. Meanwhile nothing of the job can be changed or saved. Empty if the job is shown. */
  declare away: string;
  /** Sentence of the opened program, shown instead of the job's; empty if none is open. */
  declare opened: string;
  /** Whether the page saves programs itself. */
  declare saves: boolean;

  static override properties = {
    away: { attribute: false },
    opened: { attribute: false },
    saves: { attribute: false },
  };

  override render(): TemplateResult {
    const { store } = this;
    const away = this.away !== "";
    const withheld = this.away || store.withheld;
    return html`
      ${
        this.opened
          ? html`<p class="sentence">${this.opened}</p>`
          : html`<fieldset class="sentence" aria-label=${this.t("Job")} ?disabled=${store.readonly || away}>${this.sentence()}
      ${["cycle.type", "control.post", "control.workOffset"].map((path) => this.problems(path))}
      </fieldset>`
      }
      <span class="gap"></span>
      <button type="button" class="find" title=${`${this.t("Find anything")} (Ctrl+K)`} aria-label=${this.t("Find anything")} @click=${() => this.ask("commands")}><span class="words" aria-hidden="true">${this.t("Find anything")}</span><kbd aria-hidden="true">Ctrl K</kbd><span class="sign" aria-hidden="true">⌕</span></button>
      ${
        store.keepsHistory
          ? html`<button type="button" class="icon" aria-label=${this.t("Undo")} title=${`${this.t("Undo")} (Ctrl+Z)`} ?disabled=${!store.canUndo || away} @click=${() => store.undo()}>↶</button>
      <button type="button" class="icon redo" aria-label=${this.t("Redo")} title=${`${this.t("Redo")} (Ctrl+Y)`} ?disabled=${!store.canRedo || away} @click=${() => store.redo()}>↷</button>`
          : nothing
      }
      <button type="button" class="icon" aria-label=${this.t("More")} title=${this.t("More")} popovertarget="menu">⋯</button>
      ${this.saves && !this.opened ? saveButton(store, withheld, () => this.ask("save")) : nothing}
      ${withheld === null ? nothing : html`<span class="visually-hidden" id="withheld">${away ? nothing : this.t("Nothing to save or copy while the form has an error:")} ${withheld}</span>`}
    `;
  }

  /** The sentence in the word order of the language, with a menu for each placeholder. */
  private sentence(): (TemplateResult | typeof nothing)[] {
    const { store } = this;
    // Punctuation after a menu stays on its line.
    const slots: Record<
      string,
      (sign: string) => TemplateResult | typeof nothing
    > = {
      what: (sign) =>
        html`<span class="bar-field what">${this.select("cycle.type", this.cycles(), (type) => store.choose(type as CycleEntry["type"]), this.t("What do you measure?"), { title: store.cycle.says })}${sign}</span>`,
      machine: (sign) =>
        html`<span class="bar-field where">${this.hides("control.post") ? nothing : this.machine()}${this.probe()}${sign}</span>`,
      does: (sign) =>
        this.hides("control.workOffset")
          ? nothing
          : html`<span class="bar-field then">${this.does()}${sign}</span>`,
    };
    const words = this.t(
      "Find {what} on {machine}; the program {does}",
      ...SLOTS,
    );
    const pieces = words.matchAll(/\[(\w+)\]([;,:.。；，]?)|[^[]+/g);
    return [...pieces]
      .filter(([piece]) => piece.trim() !== "")
      .map(
        ([piece, slot, sign]) =>
          slots[slot ?? ""]?.(sign ?? "") ??
          html`<span class="word" aria-hidden="true">${piece.trim()}</span>`,
      );
  }

  /** Ball diameter, as a link to the fields of the probe. A dot marks an unknown shank or body. */
  private probe(): TemplateResult {
    const unknown = this.store.findings.find(
      ({ code }) => code === STYLUS_UNKNOWN,
    );
    const about = unknown
      ? this.store.say(unknown.said)
      : this.t("The probe and the machine");
    return html`<button type="button" class="probe" title=${about} @click=${() => this.dispatchEvent(new CustomEvent("go-to-field", { detail: unknown ? "stylus.length" : "stylus.diameter", bubbles: true }))}>${probeInWords(this.store)}${unknown ? html`<span class="dot" aria-label=${about} role="img"></span>` : nothing}</button>`;
  }

  /** Whether the host page hides a field that has no error. */
  private hides(path: string): boolean {
    return !this.store.rules.showsField(path) && !this.isBad(path);
  }

  /** Grouped by source, whose name leaves no room for the cycle's: `ENCY/SprutCAM type 7` shows the source and the number. */
  private cycles() {
    const { store } = this;
    const last = Number.POSITIVE_INFINITY;
    const still = (cycle: CycleEntry) =>
      cycle.steps.length === 0 && !store.cam && cycle.type !== store.cycle.type;
    const sorted = store.catalog.cycles
      .filter(
        (cycle) =>
          !still(cycle) &&
          (cycle.type === store.cycle.type ||
            store.rules.offers("cycles", cycle.type)),
      )
      .sort((a, b) => (a.number ?? last) - (b.number ?? last));
    return sorted.map(({ type, title, source }) => {
      const [under = "", ...number] = source.split(" ");
      const plain = store.cam ? `${title} · ${number.join(" ")}` : title;
      const label = type === store.cycle.type ? whatInWords(store) : plain;
      return { value: type, under, label };
    });
  }

  /** Stored machines and the controls. A control that does not support this cycle gives the reason when it is chosen. */
  private machine(): TemplateResult {
    const { store } = this;
    const offered = store.rules.machines;
    const taken = (one: Preset) =>
      offered.some(({ name }) => name === one.name);
    const may = ({ sections }: Preset) => {
      const post = (sections.control as Draft | undefined)?.post;
      return typeof post !== "string" || store.rules.offers("controls", post);
    };
    const mine = (this.local ? (presets() ?? []) : []).filter(
      (one) => !taken(one) && may(one),
    );
    const kept = [...offered, ...mine];
    const used = kept.find((one) => this.isUsed(one));
    const own = mine.length > 0 ? this.t("My machines") : " ";
    const under = (list: Preset[], under: string) =>
      list.map(({ name }) => ({
        value: `machine:${name}`,
        label: name,
        under,
      }));
    const machines = [
      ...under(offered, this.t("Machines")),
      ...under(mine, own),
    ];
    const posts = this.posts().map((post) => ({
      ...post,
      under: kept.length > 0 ? this.t("Controls") : "",
    }));
    const keep = this.local
      ? [{ value: "keep:", label: this.t("Store this machine …"), under: own }]
      : [];
    const choices =
      kept.length > 0 ? [...machines, ...keep, ...posts] : [...posts, ...keep];
    const path = "control.post";
    const value = used ? `machine:${used.name}` : store.get(path);
    const choose = (chosen: string) => this.chooseMachine(chosen, kept);
    return this.select(path, choices, choose, this.t("On which machine?"), {
      title: store.post?.title,
      value,
    });
  }

  private chooseMachine(chosen: string, kept: Preset[]): void {
    const preset = kept.find(({ name }) => chosen === `machine:${name}`);
    if (chosen === "keep:") this.ask("presets");
    else if (preset)
      this.dispatchEvent(
        new CustomEvent("machine", { bubbles: true, detail: preset }),
      );
    else
      this.dispatchEvent(
        new CustomEvent("choose", {
          bubbles: true,
          detail: `control.post:${chosen}`,
        }),
      );
    // Removes a rejected choice from the list.
    this.requestUpdate();
  }

  /** Whether the job uses this stored machine unchanged. */
  private isUsed(preset: Preset): boolean {
    const { draft, units } = this.store;
    const { overtravel, sections } = convertedPreset(preset, units);
    return (
      isSame(overtravel, draft.overtravel) &&
      SECTIONS.every((key) => isSame(unwritten(sections[key]), draft[key]))
    );
  }

  /** Controls that do not support this cycle are listed with the reason. */
  private posts() {
    const { store } = this;
    const offered = store.catalog.posts.filter(
      ({ id }) => id === store.post?.id || store.rules.offers("controls", id),
    );
    return offered.map((post) => {
      const not = store.whyNot(post.id);
      return {
        value: post.id,
        label: not ? `${post.title} –` : post.title,
        ...(not ? { not } : {}),
      };
    });
  }

  /** Target of the write: a work offset, or what the native cycle sets; otherwise the write summary. */
  private does(): TemplateResult {
    const { store } = this;
    const own = store.ownPreset(store.get("control.post"), store.cycle.type);
    const none = store.post?.workOffsets === 0 || own;
    if (none && (store.get("control.workOffset") ?? null) === null) {
      if (store.fieldAt("cycle.confirmRotation") && own) return this.sets();
      return html`<span class="write-summary" role="note">${store.stale ? this.t("no program") : store.does}</span>`;
    }
    const choose = (n: string) => {
      store.put("control.workOffset", n === "" ? null : Number(n));
      this.requestUpdate();
    };
    const { offsets, paged } = this.offsets();
    const first = paged?.first ?? 0;
    const value = store.get("control.workOffset") ?? null;
    const inPages = paged && typeof value === "number" && value >= first;
    return html`${this.select("control.workOffset", offsets, choose, this.t("What should it do?"), { value: inPages ? first : value })}${
      inPages && paged
        ? html`<label class="page"><span>${paged.word}</span><input type="text" inputmode="numeric" id="offset-page" aria-label=${this.t("Number after {word}", paged.word)} .value=${String(value - first + 1)}
            @change=${(e: Event) => this.page(e.target as HTMLInputElement, first, paged.count)} /></label>`
        : nothing
    }`;
  }

  /** Reads the number of an offset such as G154 P12; other text changes nothing. */
  private page(box: HTMLInputElement, first: number, count: number): void {
    const page = Number(box.value);
    if (Number.isInteger(page) && page >= 1 && page <= count)
      this.store.put("control.workOffset", first + page - 1);
    else {
      this.dispatchEvent(
        new CustomEvent("announce", {
          bubbles: true,
          detail: [w("Enter a whole number from 1 to {most}"), String(count)],
        }),
      );
      this.requestUpdate();
      box.value = String(
        Number(this.store.get("control.workOffset")) - first + 1,
      );
    }
  }

  /** Values that the native cycle sets. */
  private sets(): TemplateResult {
    const { store } = this;
    const cycle = store.draft.cycle as Draft;
    const is = `${cycle.confirmRotation} ${cycle.transferPosition}`;
    const known = SETS.map(([rotation, position, words]) => ({
      value: `${rotation} ${position}`,
      label: this.t(words),
    }));
    const other = known.some(({ value }) => value === is)
      ? []
      : [{ value: is, label: store.does }];
    const take = (chosen: string) => {
      const [confirmRotation, transferPosition] = chosen.split(" ").map(Number);
      store.put("cycle", { ...cycle, confirmRotation, transferPosition });
    };
    return this.select(
      "cycle.confirmRotation",
      [...known, ...other],
      take,
      this.t("What should it do?"),
      {
        value: is,
        id: "does",
      },
    );
  }

  /** Work offsets. Many offsets with the same word, such as G154 P1 to P99, are one entry with a number. */
  private offsets() {
    const { store } = this;
    const { post } = store;
    const value = store.get("control.workOffset") ?? null;
    const words = post?.workOffsetWords ?? [];
    const start = words.findIndex((word) => /^\S+ P\d+$/.test(word));
    const single = start < 0 ? (post?.workOffsets ?? 0) : start;
    const known = post?.workOffsets ?? 0;
    const most =
      start < 0
        ? Math.max(single, typeof value === "number" ? Math.min(value, 99) : 0)
        : single;
    const numbers = Array.from({ length: most }, (_, i) => ({
      value: (i + 1) as number | null | string,
      label: store.writes(i + 1),
    }));
    const word = words[start]?.replace(/\d+$/, "") ?? "";
    const paged =
      start < 0 ? null : { first: start + 1, count: known - start, word };
    if (paged)
      numbers.push({
        value: paged.first,
        label: store.t("writes {offset}", `${word}…`),
      });
    if (start >= 0 && typeof value === "number" && value > known)
      numbers.push({ value, label: store.writes(value) });
    const none =
      value === null && !store.stale ? store.does : this.t("measures only");
    const allowed = (one: number | null) =>
      one === value || store.rules.allowsOffset(one);
    const all = [
      { value: null as number | null | string, label: none },
      ...numbers,
    ];
    const offsets = all.filter((one) =>
      typeof one.value === "string" ? true : allowed(one.value),
    );
    return { offsets, paged };
  }

  private ask(what: string): void {
    this.dispatchEvent(
      new CustomEvent("run-action", { bubbles: true, detail: what }),
    );
  }
}

/** A section of a stored machine without the work offset, which belongs to the job. */
function unwritten(section: unknown): unknown {
  if (!isObject(section)) return section;
  const { workOffset: _, ...rest } = section;
  return rest;
}

/** Whether a stored machine matches. Keys that it does not specify are not compared. */
function isSame(kept: unknown, now: unknown): boolean {
  if (kept === undefined) return true;
  if (
    typeof kept !== "object" ||
    kept === null ||
    typeof now !== "object" ||
    now === null
  )
    return alike(kept, now);
  return Object.entries(kept).every(([key, value]) =>
    alike(value, (now as Draft)[key] ?? null),
  );
}

customElements.define("tp-bar", BarPart);
