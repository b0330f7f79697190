// <touch-path>: the whole of Touchpath as one element. This file is small and loads the rest, with the WebAssembly module beside it, when the
// first element is put into a document.

import type {
  Config,
  Cycle,
  Finding,
  Job,
  PanelName,
  Plan,
} from "./core/types.js";
import { FIRST_CYCLE } from "./first-cycle.js";
import type { App } from "./parts/app.js";
import type { Store } from "./store.js";

type Units = "mm" | "inch";
type View = "top" | "front" | "side" | "isometric";

export type { PanelName };

const PANEL_NAMES: PanelName[] = [
  "form",
  "stage",
  "program",
  "table",
  "results",
  "checks",
];

/** What the events of the element carry, by name. */
export interface TouchPathEvents {
  "job-change": CustomEvent<{ job: Job }>;
  "plan-change": CustomEvent<{ plan: Plan }>;
  "program-save": CustomEvent<{
    name: string;
    text: string;
    post: string;
    extension: string;
  }>;
  "selection-change": CustomEvent<Selection>;
  "measured-change": CustomEvent<{ measured: string }>;
  finding: CustomEvent<{ findings: Finding[]; refused: boolean }>;
}

/** What the user has selected: a move, its program line and its touch, all counted from 0, and the path of the focused field. `null` where nothing is selected. */
export interface Selection {
  move: number | null;
  line: number | null;
  touch: number | null;
  field: string | null;
}

/** The attributes that are inputs. */
const INPUTS = ["config", "job", "cycle", "post", "units"] as const;
/** The properties that are inputs. */
type Input = (typeof INPUTS)[number] | "measured";
/** What is set at one time: what a job leaves out, the others say. */
type Inputs = Partial<Record<Input, unknown>>;

/** The attributes that are words, and which there are. One that is not known changes nothing. */
const WORDS = {
  theme: ["light", "dark", "auto"],
  panels: [...PANEL_NAMES, "none"],
  mode: ["setter", "cam"],
  view: ["top", "front", "side", "isometric"],
  storage: ["none", "local"],
} as const;
type Wordy = keyof typeof WORDS;
const isWordy = (name: string): name is Wordy => Object.hasOwn(WORDS, name);

/** Whether a value is one of the words; of panels, some of them. */
function isKnown(name: Wordy, value: unknown): boolean {
  const words =
    name === "panels" && typeof value === "string"
      ? value.split(/\s+/).filter(Boolean)
      : [value];
  return (
    words.length > 0 &&
    words.every((word) => (WORDS[name] as readonly unknown[]).includes(word))
  );
}

/** Sets again what was set before the class of an element was known: it hides the class's own properties. */
function takeUp<T extends object>(element: T, names: (keyof T)[]): void {
  for (const name of names) {
    if (!Object.hasOwn(element, name)) continue;
    const value = element[name];
    delete element[name];
    element[name] = value;
  }
}

/** One attempt to load the element. */
class Attempt {
  /** Whether it has failed. */
  over = false;
  done!: () => void;
  fail!: (why: unknown) => void;
  readonly ready = new Promise<void>((done, fail) => {
    this.done = done;
    this.fail = (why) => {
      this.over = true;
      fail(why);
    };
  });

  constructor() {
    // Whoever does not wait for it sees it in the element.
    this.ready.catch(() => undefined);
  }
}

/** Said where an element comes into a document: what shows its panels elsewhere may wait for it. */
const HERE = "touchpath-here";

// The class is named where there is no DOM, too: a server that imports this file renders the bare tag.
const Base = (globalThis.HTMLElement ?? class {}) as typeof HTMLElement;

/**
 * A probing job: form, picture, program, parameters, results and checks in one element. It fills its box: without a height that is 480 pixels.
 *
 * @tag touch-path
 * @attr {string} job - The job as JSON. What cannot be shown changes nothing, and a `finding` event says why.
 * @attr {string} config - The rules of the portal, as JSON: see `Config`. A `<script type="application/json">` inside the element does the same. A config with faults changes nothing, and a `finding` event lists them.
 * @attr {string} cycle - The type of the cycle, such as `hole`. Another one keeps the rest of the job.
 * @attr {string} post - The control, by the `id` of a post in the catalog: that of the present job and of every later one that names none. Where a job names another, the finding `other-control` says so.
 * @attr {"mm" | "inch"} units - The units, likewise; the values of the present job are converted. Where a job names others, the finding `other-units` says so.
 * @attr {"light" | "dark" | "auto"} theme - Colours; `auto`, the default, follows the system.
 * @attr {string} lang - The language, as a BCP 47 tag: `en`, `zh-Hans`, `zh-Hant`, `de` or `ru`, with any region. Without it, that of the nearest element around that has one; with `storage="local"` the user's choice, or else the browser's. Any other language shows English. Programs are always English.
 * @attr {boolean} readonly - Whether the job can only be looked at; its program can still be saved.
 * @attr {string} panels - What is shown, of `form stage program table results checks`; all by default, but the table only if it is named here or the mode is `cam`. `none`: the bar and the foot alone, for a job whose panels are elsewhere on the page (`<touch-form>`, `<touch-picture>`, `<touch-program>`).
 * @attr {"setter" | "cam"} mode - `cam` also shows what only the author of a postprocessor needs: parameters, codes, picked touches. Without the attribute the user chooses, and opening a parameter dump switches to `cam`.
 * @attr {"top" | "front" | "side" | "isometric"} view - The view of the picture, `top` by default. The user can change it; the property gives the present one.
 * @attr {"none" | "local"} storage - Whether the job, presets and theme are kept in this browser; `none` by default. Only one element per origin should use `local`.
 * @attr {boolean} links - Whether the job of a link (`#job1=…`) in the page's address is taken up, and such links are handed out.
 * @attr {boolean} disabled - Whether the form control is disabled: the job is read-only and is not submitted.
 * @attr {string} name - The name under which a form gets the job's JSON.
 * @fires {CustomEvent<{ job: Job }>} job-change - The user has changed the job.
 * @fires {CustomEvent<{ plan: Plan }>} plan-change - The plan has changed, by the user or by the page around. A job with errors gives no event.
 * @fires {CustomEvent<{ name: string, text: string, post: string, extension: string }>} program-save - A program is to be saved. Cancelled, the element saves no file: the page around it does.
 * @fires {CustomEvent<Selection>} selection-change - The user has selected another move, line or field, or the selected move is gone.
 * @fires {CustomEvent<{ measured: string }>} measured-change - The user has changed the measured points.
 * @fires {Event} input - The user has changed the job, as `job-change` says: for form libraries.
 * @fires {Event} change - The user has left a changed field or made a choice: for form libraries.
 * @fires {Event} load - The element is loaded and shown: `ready` is fulfilled. Does not bubble.
 * @fires {ErrorEvent} error - The element could not be loaded: `ready` is rejected. Does not bubble.
 * @fires {CustomEvent<{ findings: Finding[], refused: boolean }>} finding - The job's findings have changed; or (`refused`) an input could not be used, and nothing was changed.
 * @slot - Shown until the element is loaded.
 * @slot header - In the place of the name, at the left of the bar.
 * @slot footer - At the right of the line at the foot.
 * @csspart bar - The line at the head.
 * @csspart form - The form.
 * @csspart stage - The picture, with its tools and its timeline.
 * @csspart tabs - The tabs over the panels.
 * @csspart panel - Every panel; each also by its own name: `program`, `table`, `results`, `checks`.
 * @csspart footer - The line at the foot; where the element is less than 600 pixels wide, with Save.
 * @cssprop --touchpath-background - The background.
 * @cssprop --touchpath-panel - The background of buttons and bars.
 * @cssprop --touchpath-text - The text.
 * @cssprop --touchpath-accent - What is chosen, what has the focus, the main button.
 * @cssprop --touchpath-on-accent - The text on it.
 * @cssprop --touchpath-font - The font, as in the `font` shorthand.
 */
export class TouchPath extends Base {
  static readonly formAssociated = true;
  /** The version of the package. If a page loads two versions, the first one defines the elements; the other one is had by `define(name)`. */
  static readonly version = VERSION;
  static readonly observedAttributes = [
    ...INPUTS,
    "lang",
    "theme",
    "readonly",
    "panels",
    "mode",
    "view",
    "storage",
  ];

  /** The page's state, once it is loaded. Not part of what is promised. @internal */
  store?: Store;
  /** What is shown. Not part of what is promised. @internal */
  app?: App;
  /** What shows panels of this job elsewhere on the page. */
  private readonly lent = new Map<TouchPart, App>();
  private readonly inside: ElementInternals;
  private attempt = new Attempt();
  private loading = false;
  /** What the attributes said before there was anything to put it into, and what was set since. */
  private readonly waiting: Inputs = {};
  private readonly later: Inputs = {};
  /** What is set while the page is shown and its module not there yet; null at any other time. */
  private early: Inputs | null = null;
  /** What the attributes that are words say, or last said that is known. */
  private readonly words = new Map<Wordy, string>();
  /** What the browser puts back into a form. */
  private restored: unknown;
  /** What a form puts back. */
  private first: unknown;

  constructor() {
    super();
    this.inside = this.attachInternals();
    // What the page around has put inside is seen until there is more.
    this.attachShadow({ mode: "open" }).append(document.createElement("slot"));
    this.addEventListener("invalid", this.unseen);
  }

  /** Settles when the element has been put into a document, is loaded and shown; fails where it cannot be loaded. Put into a document again it is tried again, and this is another promise. */
  get ready(): Promise<void> {
    return this.attempt.ready;
  }

  connectedCallback(): void {
    takeUp(this, [
      "config",
      "job",
      "cycle",
      "post",
      "units",
      "theme",
      "readonly",
      "panels",
      "mode",
      "view",
      "measured",
      "value",
      "disabled",
      "links",
      "storage",
      "name",
    ]);
    if (this.app) this.shadow.append(this.app);
    if (!this.loading) this.begin();
    this.dispatchEvent(new Event(HERE, { bubbles: true }));
  }

  /** Loads what is shown; where that has failed before, once more. */
  private begin(): void {
    this.loading = true;
    if (this.attempt.over) this.attempt = new Attempt();
    const { attempt } = this;
    this.load().then(
      () => {
        attempt.done();
        this.dispatchEvent(new Event("load"));
      },
      (why) => {
        this.loading = false;
        attempt.fail(why);
        this.dispatchEvent(
          new ErrorEvent("error", { error: why, message: String(why) }),
        );
      },
    );
  }

  disconnectedCallback(): void {
    this.app?.remove();
  }

  attributeChangedCallback(
    name: string,
    before: string | null,
    value: string | null,
  ): void {
    if (value === before) return;
    if ((INPUTS as readonly string[]).includes(name)) {
      this.put(name as Input, value, this.waiting);
    } else if (name === "lang") this.app?.reword();
    else {
      if (isWordy(name)) this.word(name, value);
      this.applyOptions();
    }
  }

  /** The job as it stands in the form, errors and all: a copy; nothing until it is loaded. Set, it may be an object or its JSON. */
  get job(): Job | undefined {
    return this.store && (structuredClone(this.store.job) as unknown as Job);
  }

  set job(value: Job | string | null | undefined) {
    this.put("job", value);
  }

  /** The rules of the portal: what may be chosen, which fields are fixed, hidden or filled in, where the machine can travel. A copy; `null` without a config. May be set as an object or as JSON; `null` removes it. */
  get config(): Config | null {
    return structuredClone(this.store?.rules.config ?? null);
  }

  set config(value: Config | string | null | undefined) {
    this.put("config", value);
  }

  /** The type of the cycle. */
  get cycle(): Cycle["type"] | undefined {
    return this.store?.cycle.type;
  }

  set cycle(value: Cycle["type"] | null | undefined) {
    this.put("cycle", value);
  }

  /** The control of the job, by the id of a post in the catalog. Set, it is that of the present job and of every later one that names none; `null` asks for none. */
  get post(): string | undefined {
    return this.store?.get("control.post") as string | undefined;
  }

  set post(value: string | null | undefined) {
    this.put("post", value);
  }

  /** The units of the job. Set, they convert its values, and are those of every later job that names none; `null` asks for none. */
  get units(): Units | undefined {
    return this.store?.units;
  }

  set units(value: Units | null | undefined) {
    this.put("units", value);
  }

  /** The plan of the job: a copy; null while the job has errors, or nothing is loaded. */
  get plan(): Plan | null {
    return this.store && !this.store.stale
      ? structuredClone(this.store.plan)
      : null;
  }

  /** Everything that is wrong, unusual or worth knowing about the job: a copy. */
  get findings(): Finding[] {
    return structuredClone(this.store?.findings ?? []);
  }

  /** Colours; `auto` follows the system. */
  get theme(): "light" | "dark" | "auto" {
    return (this.words.get("theme") ?? "auto") as "light" | "dark" | "auto";
  }

  set theme(value: "light" | "dark" | "auto" | null | undefined) {
    this.say("theme", value);
  }

  /** Whether the job can only be looked at. */
  get readonly(): boolean {
    return this.hasAttribute("readonly");
  }

  set readonly(value: boolean) {
    this.toggleAttribute("readonly", Boolean(value));
  }

  /** What is shown, as words with spaces between. */
  get panels(): string {
    return this.words.get("panels") ?? PANEL_NAMES.join(" ");
  }

  set panels(value: string | null | undefined) {
    this.say("panels", value);
  }

  /** For whom it is shown: `cam` shows what only the author of a postprocessor needs. */
  get mode(): "setter" | "cam" {
    return (this.words.get("mode") ?? (this.store?.cam ? "cam" : "setter")) as
      | "setter"
      | "cam";
  }

  set mode(value: "setter" | "cam" | null | undefined) {
    this.say("mode", value);
  }

  /** The view of the picture. */
  get view(): View {
    return this.pictured?.view ?? ((this.words.get("view") ?? "top") as View);
  }

  set view(value: View | null | undefined) {
    if (value && this.getAttribute("view") === value) this.word("view", value);
    else this.say("view", value);
  }

  /** Measured points, results or a log, as text: shown and judged in the results. Empty removes them. They are not part of the job. */
  get measured(): string {
    return this.store?.measured ?? "";
  }

  set measured(value: string | null | undefined) {
    this.put("measured", value === null ? "" : value);
  }

  /** Saves the program as the Save button does: fires `program-save`, and saves a file unless that event is cancelled. Returns `false` if the job has errors or the element is not loaded. */
  save(): boolean {
    return this.early === null && (this.app?.save() ?? false);
  }

  /** Undoes the user's last step, as Ctrl+Z does, and fires `job-change`. Returns `false` if there is nothing to undo. */
  undo(): boolean {
    const can = this.store?.canUndo ?? false;
    if (can) this.store?.undo();
    return can;
  }

  /** Redoes the step that was undone last. Returns `false` if there is nothing to redo. */
  redo(): boolean {
    const can = this.store?.canRedo ?? false;
    if (can) this.store?.redo();
    return can;
  }

  /** Highlights a move of the plan, counted from 0, in the picture, the program and the table; `null` shows the user's selection again. */
  highlight(move: number | null): void {
    const { store } = this;
    if (!store) return;
    const known =
      typeof move === "number" &&
      Number.isInteger(move) &&
      move >= 0 &&
      move < store.plan.moves.length;
    store.point(known ? move : null);
  }

  /** The picture in its present view, as SVG text; `null` without a plan. For a job with errors, the picture of its last good plan. */
  picture(): string | null {
    return this.early === null ? (this.pictured?.svg() ?? null) : null;
  }

  /** Whether anything is kept in this browser. It takes effect where it is set before the element is put into a document. */
  get storage(): "none" | "local" {
    return this.words.get("storage") === "local" ? "local" : "none";
  }

  set storage(value: "none" | "local" | null | undefined) {
    this.say("storage", value);
  }

  /** Whether links to the job are followed and offered. Set it before the element is added to a document. */
  get links(): boolean {
    return this.hasAttribute("links");
  }

  set links(value: boolean) {
    this.toggleAttribute("links", Boolean(value));
  }

  /** The name under which a form gets the job. */
  get name(): string {
    return this.getAttribute("name") ?? "";
  }

  set name(value: string | null | undefined) {
    this.say("name", value);
  }

  /** The job as JSON, as a form submits it: for form libraries. Setting it sets `job`. Empty until a job is set or the element is loaded. */
  get value(): string {
    const { store } = this;
    return store
      ? JSON.stringify(store.job)
      : (textOf(this.later.job ?? this.waiting.job) ?? "");
  }

  set value(value: string) {
    if (value !== "") this.put("job", value);
  }

  /** Whether the form control is disabled. */
  get disabled(): boolean {
    return this.hasAttribute("disabled");
  }

  set disabled(value: boolean) {
    this.toggleAttribute("disabled", Boolean(value));
  }

  /** The type of form control. */
  get type(): "touch-path" {
    return "touch-path";
  }

  /** The `<label>` elements of this form control. */
  get labels(): NodeList {
    return this.inside.labels;
  }

  /** The validity of the form control: `customError` while the job has an error. */
  get validity(): ValidityState {
    return this.inside.validity;
  }

  /** Whether the form validates this control: not while it is disabled. */
  get willValidate(): boolean {
    return this.inside.willValidate;
  }

  /** The form around the element. */
  get form(): HTMLFormElement | null {
    return this.inside.form;
  }

  /** Why a form must not be sent; empty where it may. */
  get validationMessage(): string {
    return this.inside.validationMessage;
  }

  /** Whether the job has no error. */
  checkValidity(): boolean {
    return this.inside.checkValidity();
  }

  /** The same, and the browser says why not. */
  reportValidity(): boolean {
    return this.inside.reportValidity();
  }

  /** To the first field of the form. */
  override focus(options?: FocusOptions): void {
    if (this.app) this.app.focusFirst(options);
    else super.focus(options);
  }

  /** The form around the element is put back: so is the job that was there first. */
  formResetCallback(): void {
    this.store?.outside.forget();
    if (this.store) this.put("job", this.first);
  }

  /** A form that is sent cannot put the focus into an element that is not seen: it goes to what is wrong in the form elsewhere. */
  private readonly unseen = (event: Event): void => {
    if (this.checkVisibility() || this.lent.size === 0) return;
    event.preventDefault();
    const { store } = this;
    const wrong = store?.findings.find((finding) => finding.level === "error");
    if (wrong) this.app?.find(wrong.path);
  };

  formDisabledCallback(): void {
    this.applyOptions();
  }

  /** The browser puts back what a form held before the page was left. */
  formStateRestoreCallback(state: unknown): void {
    if (typeof state !== "string") return;
    this.store?.outside.forget();
    if (this.store) this.put("job", state);
    else this.restored = state;
  }

  /** Why any of what is given could not be taken; nothing is changed. @internal */
  refusals(state: Record<string, unknown>): Finding[] {
    const { store } = this;
    if (!store) return [];
    const found: Finding[] = [];
    for (const [name, value] of Object.entries(state)) {
      if (value === undefined) continue;
      if (!isWordy(name)) {
        found.push(
          ...store.outside.refusals(
            name as Input | "lang" | "readonly",
            value,
            state,
          ),
        );
      } else if (!isKnown(name, value))
        found.push(store.outside.unknown(name, WORDS[name], name === "panels"));
    }
    return found;
  }

  /** Takes what is set at one time, in whatever order it was said: a job names its own control and units, or has those beside it; a cycle beside it is its cycle. @internal */
  take({ config, job, cycle, post, units, measured }: Inputs): void {
    for (const [input, value] of Object.entries({
      config,
      post,
      units,
      cycle,
      job,
      measured,
    }))
      this.put(input as Input, value);
    if (
      job &&
      cycle &&
      this.store?.outside.refusals("cycle", cycle).length === 0
    )
      this.put("cycle", cycle);
  }

  /** The config from a script in the element's markup. */
  private inScript(): string | undefined {
    return (
      this.querySelector(':scope > script[type="application/json"]')
        ?.textContent ?? undefined
    );
  }

  private get shadow(): ShadowRoot {
    return this.shadowRoot as ShadowRoot;
  }

  private async load(): Promise<void> {
    try {
      // One module for every element of the page, and with it one WebAssembly module.
      const { App, Store, awaited, hold, kept, styles } = await import(
        "./parts/app.js"
      );
      const local = this.storage === "local";
      const given = { config: this.inScript(), ...this.waiting };
      // Before the module is there only the job of a first visit can be shown: another tab may have kept one by now.
      const inputs = { ...given, ...this.later, restored: this.restored };
      if (
        Object.values(inputs).some((value) => value !== undefined) ||
        location.hash !== "" ||
        (local && kept().length > 0)
      )
        await awaited();
      const store = new Store({
        local,
        ...(this.links ? { first: FIRST_CYCLE } : {}),
      });
      this.early = awaited() ? {} : null;
      this.store = store;
      this.take(given);
      this.take(this.later);
      for (const name of Object.keys(WORDS))
        this.word(name as Wordy, this.getAttribute(name));
      this.first = structuredClone(store.job);
      if (this.restored !== undefined) this.use("job", this.restored);
      store.clear();
      this.shadow.adoptedStyleSheets = [styles];
      const app = new App(store, {
        host: this,
        local,
        links: this.hasAttribute("links"),
      });
      // The words are there before anything is shown; where they do not come, English is shown until they do.
      await Promise.race([
        app.reword(),
        new Promise((done) => setTimeout(done, 3000)),
      ]);
      this.app = app;
      this.applyOptions();
      this.shadow.replaceChildren(app);
      this.follow(store, app);
      if (this.words.has("view")) app.view = this.words.get("view") as View;
      // One that was taken out meanwhile is drawn when it is put in again.
      if (this.isConnected) await app.updateComplete;
      if (this.early) await this.arrive(app, hold(this.shadow));
    } catch (thrown) {
      this.shadow.replaceChildren(failure(thrown));
      throw thrown;
    }
  }

  /** Waits for the module, and catches up with what was typed and set until then. */
  private async arrive(
    app: App,
    release: (enter: boolean) => void,
  ): Promise<void> {
    try {
      await app.arrived();
    } catch (thrown) {
      this.early = null;
      release(false);
      throw thrown;
    }
    const { early } = this;
    this.early = null;
    this.take(early ?? {});
    release(true);
  }

  /** The element fires its own `input`; boxes in its slots belong to the page. */
  private closes(app: App): void {
    app.addEventListener("input", (event) => {
      const [box] = event.composedPath() as Node[];
      if (box?.getRootNode() === app.getRootNode()) event.stopPropagation();
    });
  }

  /** Dispatches events and sets the form's value whenever the job changes. */
  private follow(store: Store, app: App): void {
    let job = "";
    let findings = "";
    let plan: Plan | null = null;
    let measured = store.measured;
    /** Whether a change by the user still waits for its `change` event. */
    let commit = false;
    const committed = () => {
      if (!commit || !store.byUser) return;
      commit = false;
      this.dispatchEvent(new Event("change", { bubbles: true }));
    };
    let selection = JSON.stringify({
      move: null,
      line: null,
      touch: null,
      field: null,
    });
    const selected = () => {
      const { selected: move, focused: field } = store;
      const line =
        move === null ? -1 : (store.plan.program.moveLines[move] ?? -1);
      const touch =
        move === null ? null : (store.plan.moves[move]?.touch ?? null);
      const now: Selection = {
        move,
        line: line < 0 ? null : line,
        touch,
        field,
      };
      if (JSON.stringify(now) === selection) return;
      selection = JSON.stringify(now);
      this.tell("selection-change", now);
    };
    const changed = (byUser: boolean) => {
      const { stale } = store;
      if (store.measured !== measured) {
        measured = store.measured;
        if (byUser) this.tell("measured-change", { measured });
      }
      const before = job;
      job = JSON.stringify(store.job);
      this.inside.setFormValue(job);
      // The browser shows a message where it can put the focus.
      const anchor = app.querySelector<HTMLElement>(
        "tp-bar select:enabled, canvas[tabindex]",
      );
      if (store.withheld === null) this.inside.setValidity({});
      else
        this.inside.setValidity(
          { customError: true },
          store.withheld,
          anchor ?? undefined,
        );
      // What was typed may have changed without the job: `30+2` is worked out when the field is left.
      if (byUser && job !== before) {
        store.outside.sent(job);
        this.tell("job-change", { job: JSON.parse(job) });
        this.dispatchEvent(
          new Event("input", { bubbles: true, composed: true }),
        );
        commit = true;
      }
      if (!stale && store.plan !== plan) {
        plan = store.plan;
        this.tell("plan-change", copyOf(plan));
      }
      const found = JSON.stringify(store.findings);
      if (found !== findings) {
        findings = found;
        this.tell("finding", { findings: JSON.parse(found), refused: false });
      }
    };
    store.addEventListener("change", () => {
      changed(store.byUser);
      // The selected move may be gone with its plan.
      selected();
    });
    store.addEventListener("settled", committed);
    store.addEventListener("select", selected);
    this.closes(app);
    app.updateComplete.then(() => changed(false));
  }

  /** Dispatches an event; false where a listener has cancelled it. @internal */
  tell<K extends keyof TouchPathEvents>(
    name: K,
    detail: TouchPathEvents[K]["detail"],
  ): boolean {
    return this.dispatchEvent(
      new CustomEvent(name, {
        detail,
        bubbles: true,
        composed: true,
        cancelable: name === "program-save",
      }),
    );
  }

  /** Sets an attribute, or removes it. */
  private say(name: string, value: string | null | undefined): void {
    if (value === null || value === undefined) this.removeAttribute(name);
    else this.setAttribute(name, value);
  }

  /** Redraws the picture after custom properties were set. @internal */
  recolour(): void {
    this.store?.dispatchEvent(new Event("recolour"));
  }

  /** Takes an input as soon as there is something to put it into. Undefined says nothing, null that nothing is asked for any more. */
  private put(input: Input, value: unknown, early = this.later): void {
    if (value === undefined || (value === null && input === "job")) return;
    if (!this.store) early[input] = value;
    else if (this.early) this.early[input] = value;
    else if (value !== null) this.use(input, value);
    else if (input !== "job" && input !== "measured")
      this.store.outside.release(input);
    if (this.store && input === "config") this.applyOptions();
    // A form that is sent before anything is loaded sends what it was given.
    if (!this.store && input === "job") {
      this.inside.setFormValue(textOf(value));
      this.inside.setValidity(
        { customError: true },
        "The job is not checked yet",
      );
    }
  }

  /** Takes an input, or says why it cannot be taken. */
  private use(input: Input, value: unknown): void {
    const refused = this.store?.outside.input(input, value) ?? [];
    if (refused.length > 0)
      this.tell("finding", { findings: refused, refused: true });
  }

  /** Takes a word, or says why it cannot be taken: as soon as there is something to say it. */
  private word(name: Wordy, value: string | null): void {
    if (value === null) this.words.delete(name);
    else if (isKnown(name, value)) {
      this.words.set(name, value);
      if (name === "view")
        for (const app of [this.app, ...this.lent.values()])
          if (app) app.view = value as View;
    } else {
      const refused = this.refusals({ [name]: value });
      if (refused.length > 0)
        this.tell("finding", { findings: refused, refused: true });
    }
  }

  /** What is shown, and how. @internal */
  applyOptions(): void {
    const { app, store } = this;
    if (!app || !store) return;
    store.readonly = this.readonly || this.matches(":disabled");
    store.askCam(this.words.has("mode") ? this.mode === "cam" : null);
    const show = (app: App, panels: string, asked: boolean) => {
      const words = panels.split(/\s+/);
      app.applyOptions(
        this.theme,
        PANEL_NAMES.filter(
          (name) => words.includes(name) && store.rules.shows(name),
        ),
        asked,
      );
    };
    show(app, this.panels, this.words.has("panels"));
    for (const [part, app] of this.lent) show(app, part.panels, true);
  }

  /** Shows panels of the job in another element: what is to be put into it, or is put into it again. @internal */
  async lend(
    part: TouchPart,
    again?: App,
  ): Promise<{ app: App; styles: CSSStyleSheet[] }> {
    await this.ready;
    const { App, partStyles, styles } = await import("./parts/app.js");
    const app =
      again ??
      new App(this.store as Store, {
        host: this,
        local: false,
        links: false,
        lent: true,
      });
    if (!again) {
      if (this.words.has("view")) app.view = this.view;
      this.closes(app);
    }
    this.lent.set(part, app);
    this.applyOptions();
    return { app, styles: [styles, partStyles] };
  }

  /** The other element shows them no longer. @internal */
  takeBack(part: TouchPart): void {
    this.lent.delete(part);
  }

  /** What shows the job's picture: this element, or another one. */
  private get pictured(): App | undefined {
    return (
      [this.app, ...this.lent.values()].find((app) => app?.hasPicture) ??
      this.app
    );
  }
}

/**
 * Panels of the job of a `<touch-path>` elsewhere on the page. All of them show the same: what is typed, pointed at or chosen in one is seen in the others. It fills its box.
 */
export class TouchPart extends Base {
  static readonly observedAttributes = ["for", "panels"];
  /** What it shows where `panels` says nothing else. */
  protected readonly own: PanelName = "form";
  /** What is shown, and of whose job: kept while this is out of the document. */
  private held: { session: TouchPath; app: App } | null = null;
  /** Whose job is shown, or is about to be. */
  private whose: TouchPath | null = null;
  private asked: unknown = null;
  private root: Node | null = null;
  private attempt = new Attempt();

  constructor() {
    super();
    this.attachShadow({ mode: "open" }).append(document.createElement("slot"));
  }

  /** Settles when the panels are shown: this element is in a document, and the one whose job it shows is found and loaded. After `for` or `session` has changed it is another promise. */
  get ready(): Promise<void> {
    return this.attempt.ready;
  }

  /** The element whose job it shows: that whose id is in `for`, unless another one is set. */
  get session(): TouchPath | null {
    const session = this.asked ?? this.found();
    // One whose class is not known yet shows nothing so far.
    return session instanceof HTMLElement && "lend" in session
      ? (session as TouchPath)
      : null;
  }

  set session(session: TouchPath | null | undefined) {
    this.asked = session ?? null;
    this.attach();
  }

  /** Which panels are shown, as words with spaces between. */
  get panels(): string {
    const panels = this.getAttribute("panels");
    return panels && isKnown("panels", panels) ? panels : this.own;
  }

  set panels(value: string | null | undefined) {
    if (value === null || value === undefined) this.removeAttribute("panels");
    else this.setAttribute("panels", value);
  }

  connectedCallback(): void {
    takeUp(this, ["session", "panels"]);
    // Its element may be put into the page, or be known, after this one.
    this.root = this.getRootNode();
    this.root.addEventListener(HERE, this.meet);
    this.attach();
  }

  disconnectedCallback(): void {
    this.root?.removeEventListener(HERE, this.meet);
    this.detach();
  }

  attributeChangedCallback(
    name: string,
    before: string | null,
    value: string | null,
  ): void {
    if (value === before) return;
    if (name === "for") this.attach();
    else {
      const refused =
        value === null ? [] : (this.whose?.refusals({ panels: value }) ?? []);
      if (refused.length > 0)
        this.whose?.tell("finding", { findings: refused, refused: true });
      this.whose?.applyOptions();
    }
  }

  private found(): Element | null {
    const id = this.getAttribute("for");
    const root = this.getRootNode();
    return id && (root instanceof Document || root instanceof ShadowRoot)
      ? root.getElementById(id)
      : null;
  }

  /** An element has come into the page. */
  private readonly meet = (): void => {
    if (this.session) this.attach();
  };

  private async attach(): Promise<void> {
    const session = this.isConnected ? this.session : null;
    if (session === this.whose) return;
    this.detach();
    this.whose = session;
    if (!session) return;
    const { attempt } = this;
    const root = this.shadowRoot as ShadowRoot;
    try {
      const { app, styles } = await session.lend(
        this,
        this.held?.session === session ? this.held.app : undefined,
      );
      if (this.whose !== session) return session.takeBack(this);
      this.held = { session, app };
      root.adoptedStyleSheets = styles;
      root.replaceChildren(app);
      await app.updateComplete;
      attempt.done();
    } catch (why) {
      if (this.whose !== session) return;
      // It is tried again when the element comes back.
      session.takeBack(this);
      this.whose = null;
      root.replaceChildren(failure(why));
      attempt.fail(why);
    }
  }

  private detach(): void {
    if (this.attempt.over || this.whose) this.attempt = new Attempt();
    this.whose?.takeBack(this);
    this.whose = null;
    this.shadowRoot?.replaceChildren(document.createElement("slot"));
  }
}

/**
 * The form of the job of a `<touch-path>` elsewhere on the page.
 *
 * @tag touch-form
 * @attr {string} for - The id of that element, in the same document or shadow root. From anywhere else the property `session` is set to it.
 * @attr {string} panels - What is shown in place of its own panel, as words of `panels` of `<touch-path>`; several stand side by side or behind tabs.
 */
export class TouchForm extends TouchPart {}

/**
 * The picture of the job of a `<touch-path>` elsewhere on the page.
 *
 * @tag touch-picture
 * @attr {string} for - The id of that element, in the same document or shadow root. From anywhere else the property `session` is set to it.
 * @attr {string} panels - What is shown in place of its own panel, as words of `panels` of `<touch-path>`; several stand side by side or behind tabs.
 */
export class TouchPicture extends TouchPart {
  protected override readonly own = "stage";
}

/**
 * The program of the job of a `<touch-path>` elsewhere on the page.
 *
 * @tag touch-program
 * @attr {string} for - The id of that element, in the same document or shadow root. From anywhere else the property `session` is set to it.
 * @attr {string} panels - What is shown in place of its own panel, as words of `panels` of `<touch-path>`; several stand side by side or behind tabs.
 */
export class TouchProgram extends TouchPart {
  protected override readonly own = "program";
}

/** What an element shows that could not be loaded: nothing else can say it. */
function failure(thrown: unknown): HTMLElement {
  const note = document.createElement("p");
  note.setAttribute("role", "alert");
  note.textContent = `Touchpath could not be loaded: ${thrown instanceof Error ? thrown.message : String(thrown)}`;
  return note;
}

/** The value as JSON; null if JSON cannot hold it. */
function textOf(value: unknown): string | null {
  try {
    return typeof value === "string" ? value : (JSON.stringify(value) ?? null);
  } catch {
    return null;
  }
}

/** A plan for an event: copied when it is read for the first time: listeners that do not read it cost nothing. */
function copyOf(own: Plan): { plan: Plan } {
  let copy: Plan | null = null;
  return {
    get plan() {
      copy ??= structuredClone(own);
      return copy;
    },
  };
}

declare global {
  interface HTMLElementTagNameMap {
    "touch-path": TouchPath;
    "touch-form": TouchForm;
    "touch-picture": TouchPicture;
    "touch-program": TouchProgram;
  }
  interface HTMLElementEventMap extends TouchPathEvents {}
}

// Where another version of this file was first, its elements stay: this one can be had by another name.
if (globalThis.customElements) {
  if (!customElements.get("touch-path"))
    customElements.define("touch-path", TouchPath);
  if (!customElements.get("touch-form"))
    customElements.define("touch-form", TouchForm);
  if (!customElements.get("touch-picture"))
    customElements.define("touch-picture", TouchPicture);
  if (!customElements.get("touch-program"))
    customElements.define("touch-program", TouchProgram);
}

/**
 * Gives the whole element of this version a name of its own, for a page that holds another version as `touch-path`. Its panels elsewhere on the page are those
 * of `<touch-form>`, `<touch-picture>` and `<touch-program>`, whichever version these are of. Throws where the name is taken or not valid for an element; does
 * nothing where there is no document.
 */
export function define(name: string): void {
  if (!globalThis.customElements) return;
  // A second copy of one version shares what the first has defined inside.
  const known = customElements.get("touch-path") as
    | typeof TouchPath
    | undefined;
  const version = known?.version === TouchPath.version ? known : TouchPath;
  customElements.define(name, class extends version {});
}
