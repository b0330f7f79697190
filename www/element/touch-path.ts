// <touch-path>: all of Touchpath as one element.
import type { TouchPathEvents } from "../core/events.js";
import type { AnyJob, Config, Cycle, Finding, Plan } from "../core/types.js";
import { FIRST_CYCLE } from "../first-cycle.js";
import type { App } from "../parts/app.js";
import {
  INPUTS,
  type Input,
  type Inputs,
  isWordy,
  OBJECT_AS_TEXT,
  PANEL_NAMES,
  type View,
  WORDS,
  type Wordy,
} from "./attributes.js";
import { followJob } from "./events.js";
import { Attempt, failure, HERE, takeUp } from "./loading.js";
import { Showing } from "./showing.js";

type Units = "mm" | "inch";

/**
 * A probing job: form, picture, program, parameters, results and checks in one element. It fills its box; without a given height it is 480 pixels high.
 *
 * @tag touch-path
 * @attr {string} job - The job as JSON. A job that cannot be shown changes nothing; a `finding` event gives the reason.
 * @attr {string} config - The rules of the portal, as JSON: see `Config`. A `<script type="application/json">` inside the element does the same. A config with errors changes nothing; a `finding` event lists them.
 * @attr {string} cycle - The type of the cycle, such as `hole`. A change keeps the rest of the job.
 * @attr {string} post - The control, by the `id` of a post in the catalog, for the current job and every later one that specifies no control. If a job specifies another control, it has the finding `other-control`.
 * @attr {"mm" | "inch"} units - The units, in the same way; the values of the current job are converted. If a job specifies other units, it has the finding `other-units`.
 * @attr {"light" | "dark" | "auto"} theme - Colours; `auto`, the default, follows the system.
 * @attr {string} lang - The language, as a BCP 47 tag: `en`, `zh-Hans`, `zh-Hant`, `de` or `ru`, with any region. Without it, the language of the nearest enclosing element that has one; with `storage="local"` the user's choice or else the browser's. Any other language shows English. Programs are always English.
 * @attr {boolean} readonly - Whether the user cannot change the job; its program can still be saved.
 * @attr {string} panels - The panels, of `form stage program table results checks`; all by default, but the table only if it is listed here or the mode is `cam`. `none`: only the bar and the footer, for a job whose panels are elsewhere on the page (`<touch-form>`, `<touch-picture>`, `<touch-program>`).
 * @attr {"setter" | "cam"} mode - `cam` also shows what only authors of postprocessors need: parameters, codes, picked touches. Without the attribute the user chooses, and opening a parameter dump switches to `cam`.
 * @attr {"top" | "front" | "side" | "isometric"} view - The view of the picture, `top` by default. The user can change it; the property returns the current one.
 * @attr {"none" | "local"} storage - Whether the job, presets and theme are stored in this browser; `none` by default. Only one element per origin should use `local`.
 * @attr {"session" | "none"} history - Whether the user's steps can be undone here, `session` by default. With `none` the host page has its own undo: Ctrl+Z and Ctrl+Y reach it, and the buttons are gone.
 * @attr {boolean} links - Whether the element loads the job of a link (`#job1=…`) in the page's address and offers such links.
 * @attr {boolean} disabled - Whether the form control is disabled: the job is read-only and is not submitted.
 * @attr {string} name - The name of the job's JSON in a form.
 * @fires {CustomEvent<{ job: AnyJob, plan: Plan | null, findings: Finding[], reason: ChangeReason }>} change - The job, its plan or its findings have changed, by the user or by the host page. `plan` is `null` while the job has errors. `reason` is `edit`, `undo`, `redo`, `open` (another job, or a reset) or `host`.
 * @fires {CustomEvent<{ job: AnyJob }>} job-change - The user has changed the job. It may be a set-up, unless the config has `"setUps": false`.
 * @fires {CustomEvent<{ plan: Plan | null }>} plan-change - The plan has changed, by the user or by the host page. `null` as soon as the job has an error.
 * @fires {CustomEvent<{ name: string, text: string, post: string, extension: string }>} program-save - A program is to be saved. If the event is cancelled, the element saves no file: the host page does.
 * @fires {CustomEvent<Selection>} selection-change - The user has selected another move, line or field, or the selected move is gone.
 * @fires {CustomEvent<{ measured: string }>} measured-change - The user has changed the measured points.
 * @fires {Event} input - The user has changed the job, like `job-change`: for form libraries.
 * @fires {Event} load - The element is loaded and shown: `ready` is fulfilled. Does not bubble.
 * @fires {ErrorEvent} error - The element could not be loaded: `ready` is rejected. Does not bubble.
 * @fires {CustomEvent<{ findings: Finding[], refused: boolean }>} finding - The job's findings have changed; or (`refused`) an input could not be used and changed nothing.
 * @slot - Shown until the element is loaded.
 * @slot header - Replaces the name at the left of the bar.
 * @slot footer - At the right of the footer.
 * @csspart bar - The bar at the top.
 * @csspart form - The form.
 * @csspart stage - The picture, with its tools and its timeline.
 * @csspart tabs - The tabs above the panels.
 * @csspart panel - Every panel; each also by its own name: `program`, `table`, `results`, `checks`.
 * @csspart footer - The footer; it contains Save if the element is less than 600 pixels wide.
 * @cssprop --touchpath-background - The background.
 * @cssprop --touchpath-panel - The background of buttons and bars.
 * @cssprop --touchpath-text - The text.
 * @cssprop --touchpath-accent - Selection, focus and the main button.
 * @cssprop --touchpath-on-accent - Text on the accent colour.
 * @cssprop --touchpath-font - The font, as in the `font` shorthand.
 */
export class TouchPath extends Showing {
  static readonly formAssociated = true;
  /** The version of the package. If a page loads two versions, the first one defines the elements; use `define(name)` for the other one. */
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
    "history",
  ];

  private readonly inside: ElementInternals;
  private attempt = new Attempt();
  private loading = false;
  /** Inputs from attributes before the element is loaded, and inputs set since. */
  private readonly pendingInputs: Inputs = {};
  private readonly later: Inputs = {};
  /** Inputs set while the page is shown without its module; null at any other time. */
  private beforeLoad: Inputs | null = null;
  /** State that the browser restores in a form. */
  private restored: unknown;
  /** Job that a form reset restores. */
  private first: unknown;

  constructor() {
    super();
    this.inside = this.attachInternals();
    // Content from the host page is shown until the element is loaded.
    this.attachShadow({ mode: "open" }).append(document.createElement("slot"));
    this.addEventListener("invalid", this.unseen);
  }

  /** Settles when the element is in a document, loaded and shown; rejects if it cannot be loaded. Adding it to a document again retries with a new promise. */
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
      "history",
      "name",
    ]);
    if (this.app) this.shadow.append(this.app);
    if (!this.loading) this.begin();
    this.dispatchEvent(new Event(HERE, { bubbles: true }));
  }

  /** Loads the content; retries after a failure. */
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
    if (value === before || value === OBJECT_AS_TEXT) return;
    if ((INPUTS as readonly string[]).includes(name)) {
      this.put(name as Input, value, this.pendingInputs);
    } else if (name === "lang") this.app?.reword();
    else {
      if (isWordy(name)) this.word(name, value);
      this.applyOptions();
    }
  }

  /** A copy of the job in the form, including its errors; `undefined` until the element is loaded. May be set as an object or as JSON. */
  get job(): AnyJob | undefined {
    return this.store && (structuredClone(this.store.job) as unknown as AnyJob);
  }

  set job(value: AnyJob | string | null | undefined) {
    this.put("job", value);
  }

  /**
   * The rules of the portal: allowed choices, fields that are fixed, hidden or filled in, and the machine's travel. A copy; `null` without a config. May be set
   * as an object or as JSON; `null` removes it.
   */
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

  /**
   * The control of the job, by the id of a post in the catalog. Setting it applies to the current job and to every later one that specifies no control; `null`
   * withdraws it.
   */
  get post(): string | undefined {
    return this.store?.get("control.post") as string | undefined;
  }

  set post(value: string | null | undefined) {
    this.put("post", value);
  }

  /** The units of the job. Setting them converts its values and applies to every later job that specifies no units; `null` withdraws them. */
  get units(): Units | undefined {
    return this.store?.units;
  }

  set units(value: Units | null | undefined) {
    this.put("units", value);
  }

  /** The plan of the job: a copy; null while the job has errors or nothing is loaded. */
  get plan(): Plan | null {
    return this.store && !this.store.stale
      ? structuredClone(this.store.plan)
      : null;
  }

  /** All errors, warnings and notes about the job: a copy. */
  get findings(): Finding[] {
    return structuredClone(this.store?.wholeFindings ?? []);
  }

  /** Colours; `auto` follows the system. */
  get theme(): "light" | "dark" | "auto" {
    return (this.words.get("theme") ?? "auto") as "light" | "dark" | "auto";
  }

  set theme(value: "light" | "dark" | "auto" | null | undefined) {
    this.say("theme", value);
  }

  /** Whether the user cannot change the job. */
  get readonly(): boolean {
    return this.hasAttribute("readonly");
  }

  set readonly(value: boolean) {
    this.toggleAttribute("readonly", Boolean(value));
  }

  /** The panels shown, as words separated by blanks. */
  get panels(): string {
    return this.words.get("panels") ?? PANEL_NAMES.join(" ");
  }

  set panels(value: string | null | undefined) {
    this.say("panels", value);
  }

  /** Audience: `cam` also shows what only authors of postprocessors need. */
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
    return this.beforeLoad === null && (this.app?.save() ?? false);
  }

  /** Whether there is a step to undo. It changes with `change` and `measured-change`, and where `readonly` or `history` is set. */
  get canUndo(): boolean {
    return this.store?.canUndo ?? false;
  }

  /** Whether there is a step to redo. */
  get canRedo(): boolean {
    return this.store?.canRedo ?? false;
  }

  /** Undoes the user's last step, as Ctrl+Z does, and fires `job-change`. Returns `false` if there is nothing to undo. */
  undo(): boolean {
    const can = this.canUndo;
    if (can) this.store?.undo();
    return can;
  }

  /** Redoes the step that was undone last. Returns `false` if there is nothing to redo. */
  redo(): boolean {
    const can = this.canRedo;
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

  /** The picture in its current view, as SVG text; `null` without a plan. For a job with errors, the picture of its last valid plan. */
  picture(): string | null {
    return this.beforeLoad === null ? (this.pictured?.svg() ?? null) : null;
  }

  /** Whether the state is stored in this browser. Set it before the element is added to a document. */
  get storage(): "none" | "local" {
    return this.words.get("storage") === "local" ? "local" : "none";
  }

  set storage(value: "none" | "local" | null | undefined) {
    this.say("storage", value);
  }

  /** Whether the user's steps can be undone here; `none` leaves undo to the host page. */
  get history(): "session" | "none" {
    return this.words.get("history") === "none" ? "none" : "session";
  }

  set history(value: "session" | "none" | null | undefined) {
    this.say("history", value);
  }

  /** Whether links to the job are followed and offered. Set it before the element is added to a document. */
  get links(): boolean {
    return this.hasAttribute("links");
  }

  set links(value: boolean) {
    this.toggleAttribute("links", Boolean(value));
  }

  /** The name of the job in a form. */
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
      : (textOf(this.later.job ?? this.pendingInputs.job) ?? "");
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

  /** Reason why a form must not be submitted; empty if it may. */
  get validationMessage(): string {
    return this.inside.validationMessage;
  }

  /** Whether the job has no error. */
  checkValidity(): boolean {
    return this.inside.checkValidity();
  }

  /** Like `checkValidity`; the browser also shows the reason. */
  reportValidity(): boolean {
    return this.inside.reportValidity();
  }

  override addEventListener<K extends keyof TouchPathEvents>(
    type: K,
    listener: (this: TouchPath, event: TouchPathEvents[K]) => unknown,
    options?: boolean | AddEventListenerOptions,
  ): void;
  override addEventListener<K extends keyof HTMLElementEventMap>(
    type: K,
    listener: (this: HTMLElement, event: HTMLElementEventMap[K]) => unknown,
    options?: boolean | AddEventListenerOptions,
  ): void;
  override addEventListener(
    type: string,
    listener: EventListenerOrEventListenerObject,
    options?: boolean | AddEventListenerOptions,
  ): void;
  override addEventListener(
    type: string,
    // biome-ignore lint/suspicious/noExplicitAny: the overloads give the event's type.
    listener: any,
    options?: boolean | AddEventListenerOptions,
  ): void {
    super.addEventListener(type, listener, options);
  }

  /** Focuses the first field of the form. */
  override focus(options?: FocusOptions): void {
    if (this.app) this.app.focusFirst(options);
    else super.focus(options);
  }

  /** The form around the element was reset: restores the first job. */
  formResetCallback(): void {
    this.store?.outside.forget();
    if (this.store) this.put("job", this.first);
  }

  /** A form cannot focus an element that is not visible: focuses the field with the error in the form elsewhere. */
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

  /** The browser restores the value of a form after navigation. */
  formStateRestoreCallback(state: unknown): void {
    if (typeof state !== "string") return;
    this.store?.outside.forget();
    if (this.store) this.put("job", state);
    else this.restored = state;
  }

  /**
   * Applies inputs that are set together, in any order. A job specifies its own control and units or gets the others; a cycle beside it replaces its cycle.
   * @internal
   */
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

  /** The config in a script inside the element's markup. */
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
      // One module, and with it one WebAssembly module, for every element of the page.
      const { App, Store, awaited, bufferInput, kept, styles } = await import(
        "../parts/app.js"
      );
      const local = this.storage === "local";
      const given = { config: this.inScript(), ...this.pendingInputs };
      // Without the module only the first job can be shown; another tab may have stored one by now.
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
      this.beforeLoad = awaited() ? {} : null;
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
      // The words load before anything is shown; if they do not arrive, English is shown until they do.
      await Promise.race([
        app.reword(),
        new Promise((done) => setTimeout(done, 3000)),
      ]);
      this.app = app;
      this.applyOptions();
      this.shadow.replaceChildren(app);
      followJob(this, this.inside, { store, app });
      this.closes(app);
      if (this.words.has("view")) app.view = this.words.get("view") as View;
      // An element that was removed meanwhile is drawn when it is added again.
      if (this.isConnected) await app.updateComplete;
      if (this.beforeLoad) await this.arrive(app, bufferInput(this.shadow));
    } catch (thrown) {
      this.shadow.replaceChildren(failure(thrown));
      throw thrown;
    }
  }

  /** Waits for the module, then applies input that was buffered until then. */
  private async arrive(
    app: App,
    release: (enter: boolean) => void,
  ): Promise<void> {
    try {
      await app.arrived();
    } catch (thrown) {
      this.beforeLoad = null;
      release(false);
      throw thrown;
    }
    const { beforeLoad: early } = this;
    this.beforeLoad = null;
    this.take(early ?? {});
    release(true);
  }

  /** Applies an input, or keeps it until it can. Undefined means nothing was set; null withdraws a request. */
  private put(input: Input, value: unknown, early = this.later): void {
    if (value === undefined || (value === null && input === "job")) return;
    if (!this.store) early[input] = value;
    else if (this.beforeLoad) this.beforeLoad[input] = value;
    else if (value !== null) this.use(input, value);
    else if (input !== "job" && input !== "measured")
      this.store.outside.release(input);
    if (this.store && input === "config") this.applyOptions();
    // A form that is submitted before the element is loaded submits the given job.
    if (!this.store && input === "job") {
      this.inside.setFormValue(textOf(value));
      this.inside.setValidity(
        { customError: true },
        "The job is not checked yet",
      );
    }
  }

  /** Applies an input, or reports why it cannot be applied. */
  private use(input: Input, value: unknown): void {
    const refused = this.store?.outside.input(input, value) ?? [];
    if (refused.length > 0)
      this.tell("finding", { findings: refused, refused: true });
  }
}

/** Most values of a job, as in the crate: the element's first file does not load its layout. */
const MOST_VALUES = 20_000;

/** The value as JSON; null if JSON cannot represent it, or it is too large for a job. */
function textOf(value: unknown): string | null {
  if (typeof value === "string") return value;
  let values = 0;
  const counted = (_: string, inner: unknown) => {
    if (++values > MOST_VALUES) throw new Error("too large");
    return inner;
  };
  try {
    return JSON.stringify(value, counted) ?? null;
  } catch {
    return null;
  }
}
