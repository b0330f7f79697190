import { html, nothing, type TemplateResult } from "lit";
import { version } from "../core/browser.js";
import type { Store } from "../store.js";
import { LANGUAGES, w } from "../words.js";

const THEMES = ["auto", "light", "dark"] as const;
export type Theme = (typeof THEMES)[number];
const THEME_NAMES = {
  auto: w("as the system"),
  light: w("light"),
  dark: w("dark"),
};

/** Keyboard shortcuts besides Tab, Enter and the arrow keys of a control. */
const KEYS: [string, string][] = [
  [w("Ctrl+Z, Ctrl+Y"), w("undo, redo: fields, choices, drags, files, Reset")],
  [w("Ctrl+K"), w("find anything: cycles, fields, controls, actions")],
  [
    w("Ctrl+V"),
    w("open what is in the clipboard: a dump, a program, a job, a log"),
  ],
  [w("Ctrl+S"), w("save the program")],
  [w("↑ ↓ in a number"), w("one step more or less; with Shift a tenth of it")],
  [w("Enter in a number"), w("work out a sum, and to the next field")],
  [w("Escape in a number"), w("restore the previous value")],
  [w("← → in the timeline"), w("move before, next move")],
  [w("Ctrl+← Ctrl+→ there"), w("touch before, next touch")],
  [w("Space there"), w("play, pause")],
  [w("S there"), w("speed of the run")],
  [w("↑ ↓ in the program"), w("line by line through the moves")],
  [w("Ctrl+F in an opened program"), w("find words in it")],
  [
    w("Enter, Shift+Enter in Find"),
    w("the next line with the words, the one before"),
  ],
  [w("Arrows, +, −, 0 on the picture"), w("shift, zoom, fit")],
  [w("Escape on picture, program, timeline"), w("no move is lit")],
  [w("Escape elsewhere"), w("back to the job")],
];

/** Actions that change or save the job: not available while something else is shown. */
export const OF_THE_JOB = new Set([
  "undo",
  "redo",
  "save",
  "save-job",
  "save-picture",
  "into",
  "share",
  "sheet",
  "presets",
  "reset",
]);

/** Actions outside the form, for the list of commands. */
export function actions({
  store,
  links,
  local,
  away,
}: Frame): [what: string, name: string][] {
  const { readonly, withheld } = store;
  const t = (text: string) => store.t(text);
  const all: [string, string, boolean][] = [
    ["gallery", t("Choose the cycle from pictures"), !readonly],
    ["add", t("Add a feature"), !readonly && store.rules.allowsSetUps],
    ["open", t("Open a file"), !readonly],
    ["paste", t("Paste"), !readonly],
    ["save", t("Save the program"), withheld === null],
    ["save-job", t("Save job"), true],
    ["save-picture", t("Save the picture (SVG)"), withheld === null],
    ["into", t("Insert into a program"), withheld === null],
    ["share", t("Copy a link to this job"), links],
    ["sheet", t("Setup sheet to print"), withheld === null],
    ["presets", t("My machines"), local && !readonly],
    ["lengths", t("Tool lengths (SINUMERIK)"), true],
    ["program", t("Program"), true],
    ["table", t("Parameters"), true],
    ["measured", t("Measured values, report"), true],
    ["checks", t("Checks"), true],
    ["undo", t("Undo"), store.canUndo],
    ["redo", t("Redo"), store.canRedo],
    ["reset", t("Reset"), !readonly],
    ["keys", t("Keys"), true],
    [
      "cam",
      store.cam
        ? t("For setters: hide parameters and codes")
        : t("For CAM: show parameters and codes"),
      !store.camIsAsked,
    ],
  ];
  return all
    .filter(([what, , is]) => is && !(away && OF_THE_JOB.has(what)))
    .map(([what, name]) => [what, name]);
}

/** Data and actions of the frame for the menu and the dialogs. */
export interface Frame {
  store: Store;
  /** Whether presets, theme and language are stored in this browser. */
  local: boolean;
  /** Whether the page follows and offers links. */
  links: boolean;
  /** Whether something else than the job is shown. */
  away: boolean;
  /** Whether the moves of an opened program can be shown again. */
  viewed: boolean;
  theme: Theme;
  /** Whether the presets are loaded. */
  presets: boolean;
  /** Renders again: the entries are updated whenever the menu opens. */
  look(): void;
  choose(what: string): void;
  chooseLanguage(lang: string): void;
  chooseTheme(theme: Theme): void;
}

/** The menu of rarely used actions. */
export function menu(frame: Frame): TemplateResult {
  const { store, links, local, away } = frame;
  const { readonly } = store;
  const t = (text: string) => store.t(text);
  const item = (
    what: string,
    name: string,
    offered = true,
    only = "",
    disabled = false,
  ) =>
    offered
      ? html`<button type="button" class=${only || nothing} ?disabled=${disabled || (away && OF_THE_JOB.has(what))} @click=${() => frame.choose(what)}>${name}</button>`
      : nothing;
  const { withheld } = store;
  const of = (what: string, name: string, only = "") =>
    html`<button type="button" class=${only || nothing} ?disabled=${away || withheld !== null} aria-describedby=${withheld === null ? nothing : "withheld"} title=${withheld ?? nothing} @click=${() => frame.choose(what)}>${name}</button>`;
  const chosen = (event: Event) => (event.target as HTMLSelectElement).value;
  return html`<div class="menu" id="menu" popover role="group" aria-label=${t("More")} @beforetoggle=${() => frame.look()}>
      ${item("commands", t("Find anything"), true, "on-phone")} ${item("redo", t("Redo"), !readonly && store.keepsHistory, "on-phone", !store.canRedo)}
      ${item("open", t("Open a file"), !readonly)} ${item("paste", t("Paste"), !readonly)} ${item("share", t("Copy a link to this job"), links)} ${of("sheet", t("Setup sheet to print"))}
      ${item("save-job", t("Save job"))} ${of("into", t("Insert into a program"))} ${of("save-picture", t("Save the picture (SVG)"))} ${item("presets", t("My machines"), local && !readonly)}
      ${item("lengths", t("Tool lengths (SINUMERIK)"))} ${item("viewer", t("Moves of the opened program"), frame.viewed)} ${item("keys", t("Keys"))} ${item("reset", t("Reset"), !readonly)}
      <label class="check"><input type="checkbox" id="cam" ?disabled=${store.camIsAsked} .checked=${store.cam} @change=${(
        e: Event,
      ) => {
        store.cam = (e.target as HTMLInputElement).checked;
      }} /> ${t("For CAM: parameters, codes, picked touches")}</label>
      <label>${t("Language")} <select id="lang" @change=${(e: Event) => frame.chooseLanguage(chosen(e))}>${Object.entries(LANGUAGES).map(([lang, name]) => html`<option value=${lang} lang=${lang} ?selected=${lang === store.lang}>${name}</option>`)}</select></label>
      <label>${t("Colours")} <select id="theme" @change=${(e: Event) => frame.chooseTheme(chosen(e) as Theme)}>${THEMES.map((theme) => html`<option value=${theme} ?selected=${theme === frame.theme}>${t(THEME_NAMES[theme])}</option>`)}</select></label>
      ${links ? html`<small>${t("Nothing leaves this browser")}</small>` : nothing}
      <small>Touchpath ${version()} · <a href=${new URL("./licences.txt", document.baseURI).href} ?hidden=${!links}>${t("Licences")}</a></small>
    </div>`;
}

/** Dialogs over the page: presets, list of keys. */
export function dialogs({ store, presets }: Frame): TemplateResult {
  const t = (text: string) => store.t(text);
  const close = html`<form method="dialog" class="tools"><button>${t("Close")}</button></form>`;
  return html`<dialog id="presets" aria-label=${t("My machines")} aria-describedby="presets-help">
      ${presets ? html`<tp-presets .store=${store}></tp-presets>` : nothing}
      ${close}
    </dialog>
    <dialog id="keys" aria-labelledby="keys-title">
      <h2 id="keys-title" tabindex="-1">${t("Keys")}</h2>
      <dl class="keys">${KEYS.map(([keys, what]) => html`<dt>${t(keys)}</dt><dd>${t(what)}</dd>`)}</dl>
      ${close}
    </dialog>`;
}
