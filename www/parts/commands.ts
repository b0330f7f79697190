import { html, nothing, type TemplateResult } from "lit";
import { catalog, type FieldEntry } from "../core/browser.js";
import { found, hasWord, LENGTHS, textOf, wordsIn } from "../search.js";
import { w } from "../words.js";
import { StorePart } from "./part.js";

/** A command: an action or a target. */
interface Command {
  /** Its name. */
  name: string;
  /** Its kind. */
  kind: string;
  /** One sentence about it. */
  says?: string;
  /** Additional search words. */
  also?: string;
  /** Event that runs it: name and detail. */
  event: [name: string, detail: string];
}

/** Additional search words of actions. */
const ALSO: Record<string, string> = {
  lengths: LENGTHS,
  measured: w("tolerance report inspection series log results"),
  program: w("G-code lines compare find all lines"),
  table: w("CmdPrm Q parameters codes table"),
  checks: w("rules findings errors warnings safety"),
  presets: w("machine store stylus feeds"),
};
const UNITS = "units millimetre metric imperial inches";
/** Names and numbers of native cycles and macros. */
const NATIVE =
  "Renishaw macros Inspection Plus G65 P9810 P9811 P9812 P9814 P9815 P9816 P9821 P9822 P9823 P9834 P9843 9812 9814 measuring cycles CYCLE977 CYCLE978 977 978 touch probe TCH PROBE 408 409 410 411 412 413 420 421 422 423 424 425 426 427 1411 native own";

/** Maximum number of entries listed. */
const MOST = 40;

/** List to find everything by typing: cycles, fields, controls, tools, actions. */
class CommandsPart extends StorePart {
  protected override storeEvents: string[] = [];
  /** Other actions of the page: key and name. */
  declare actions: [what: string, name: string][];
  private query = "";
  private at = 0;
  private shown = false;
  private readonly english = catalog().cycles;

  static override properties = { actions: { attribute: false } };

  override render(): TemplateResult {
    const list = this.shown ? this.listed() : [];
    const at = Math.min(this.at, list.length - 1);
    return html`<dialog class="commands" aria-label=${this.t("Find anything")} @close=${this.closed} @click=${(e: Event) => e.target === this.dialog && this.dialog?.close()}>${
      this.shown
        ? html`<input class="filter" type="text" role="combobox" aria-expanded="true" aria-controls="command-list" aria-activedescendant=${list.length ? `command-${at}` : nothing}
            aria-label=${this.t("Find anything")} placeholder=${this.t("A cycle, a field, a control, an action …")} spellcheck="false" .value=${this.query}
            @input=${this.typed} @keydown=${(e: KeyboardEvent) => this.key(e, list)} />
          <ul id="command-list" role="listbox" aria-label=${this.t("Find anything")}>${list.map(
            (
              one,
              i,
            ) => html`<li id=${`command-${i}`} role="option" aria-selected=${i === at ? "true" : "false"} @click=${() => this.run(one)}>
              <b>${one.name}</b> <span class="kind">${one.kind}</span>${one.says ? html`<small>${one.says}</small>` : nothing}</li>`,
          )}</ul>
          ${list.length === 0 ? html`<p class="status-text" role="status">${this.t("No matches.")}</p>` : nothing}`
        : nothing
    }</dialog>`;
  }

  /** Opens the list with an empty, focused field. */
  async open(): Promise<void> {
    this.shown = true;
    this.query = "";
    this.at = 0;
    this.requestUpdate();
    await this.updateComplete;
    this.dialog?.showModal();
    this.querySelector("input")?.focus();
  }

  private get dialog(): HTMLDialogElement | null {
    return this.querySelector("dialog");
  }

  private readonly closed = (): void => {
    this.shown = false;
    this.requestUpdate();
  };

  private readonly typed = (event: Event): void => {
    this.query = (event.target as HTMLInputElement).value;
    this.at = 0;
    this.requestUpdate();
  };

  private key(event: KeyboardEvent, list: Command[]): void {
    if (event.isComposing) return;
    const step = { ArrowDown: 1, ArrowUp: -1 }[event.key];
    const one = list[Math.min(this.at, list.length - 1)];
    if (step && list.length > 0) {
      this.at =
        (Math.min(this.at, list.length - 1) + step + list.length) % list.length;
      this.requestUpdate();
      this.updateComplete.then(() =>
        this.querySelector(`#command-${this.at}`)?.scrollIntoView({
          block: "nearest",
        }),
      );
    } else if (event.key === "Enter" && one) this.run(one);
    else return;
    event.preventDefault();
  }

  private run({ event: [name, detail] }: Command): void {
    this.dialog?.close();
    this.dispatchEvent(new CustomEvent(name, { bubbles: true, detail }));
  }

  private listed(): Command[] {
    const text = ({ name, kind, says = "", also = "" }: Command) =>
      `${name} ${kind} ${says} ${also}`.toLowerCase();
    const words = wordsIn(this.query);
    // Matches of the name come before other matches.
    const called = ({ name }: Command) =>
      words.every((word) => hasWord(name.toLowerCase(), word));
    const all = found(this.all(), this.query, text).things;
    return [...all.filter(called), ...all.filter((one) => !called(one))].slice(
      0,
      MOST,
    );
  }

  /** Command that switches between moves and native cycles, found by the names and numbers of these cycles. */
  private forms(): Command[] {
    const { store } = this;
    const { post } = store;
    const now = store.get("control.form");
    const field = store.fieldAt("control.form");
    if (!post || !field) return [];
    return store
      .formsOf(post.id, store.cycle.type)
      .filter((form) => form !== now)
      .map((form) => ({
        name: `${post.title}: ${field.choices.find(({ value }) => value === form)?.label ?? form}`,
        kind: this.t("action"),
        says: field.help,
        also: form === "cycle" ? NATIVE : "",
        event: ["choose", `control.form:${form}`],
      }));
  }

  private all(): Command[] {
    const { store } = this;
    const { cycle, catalog } = store;
    const cycles = catalog.cycles
      .filter(
        (one) =>
          (store.cam || one.steps.length > 0) &&
          store.rules.offers("cycles", one.type),
      )
      .map((one): Command => {
        const english =
          this.english.find(({ type }) => type === one.type) ?? one;
        const also = textOf(one, english, (text) => this.t(text));
        return {
          name: one.title,
          kind: this.t("measure"),
          says: one.says,
          also,
          event: ["choose", `cycle.type:${one.type}`],
        };
      });
    const about = cycles.map(
      ({ name, event }): Command => ({
        name: this.t("About {cycle}", name),
        kind: this.t("manual"),
        event: ["open-manual", event[1].replace("cycle.type", "cycle")],
      }),
    );
    const setUps = store.readySetUps.map(
      ({ entry: { key, name, says } }): Command => ({
        name: this.t(name),
        kind: this.t("Ready set-ups"),
        says: this.t(says),
        also: `${name} ${says}`,
        event: ["choose", `set-up:${key}`],
      }),
    );
    const posts = catalog.posts.filter(({ id }) =>
      store.rules.offers("controls", id),
    );
    const controls = posts.flatMap((post): Command[] => [
      {
        name: post.title,
        kind: this.t("control"),
        event: ["choose", `control.post:${post.id}`],
      },
      {
        name: this.t("About {control}", post.title),
        kind: this.t("manual"),
        event: ["open-manual", `control:${post.id}`],
      },
    ]);
    const field =
      (path: string) =>
      (entry: FieldEntry): Command[] => {
        const at = path === "" ? entry.key : `${path}.${entry.key}`;
        if (
          entry.label === "" ||
          at === "cycle.type" ||
          !store.rules.showsField(at)
        )
          return [];
        if (!store.cam && entry.group.startsWith("Postprocessor")) return [];
        return [
          {
            name: entry.label,
            kind: this.t(entry.group),
            says: entry.help,
            also: entry.code ?? "",
            event: ["go-to-field", at],
          },
        ];
      };
    const fields = [
      ...cycle.fields.flatMap(field("cycle")),
      ...cycle.sections.flatMap(({ key, fields }) =>
        fields.flatMap(field(`cycle.${key}`)),
      ),
      ...catalog.sections.flatMap(({ path, fields }) =>
        fields.flatMap(field(path)),
      ),
    ];
    const actions = this.actions.map(
      ([what, name]): Command => ({
        name,
        kind: this.t("action"),
        also: [ALSO[what] ?? "", this.t(ALSO[what] ?? "")].join(" "),
        event: ["run-action", what],
      }),
    );
    const units = (["mm", "inch"] as const)
      .filter(
        (units) => units !== store.units && store.rules.allowsUnits(units),
      )
      .map(
        (units): Command => ({
          name: this.t("Units: {units}", units),
          kind: this.t("action"),
          also: UNITS,
          event: ["choose", `units:${units}`],
        }),
      );
    const all = [
      ...cycles,
      ...setUps,
      ...this.forms(),
      ...actions,
      ...units,
      ...fields,
      ...controls,
      ...about,
    ];
    // A read-only job is offered no actions that change it.
    return store.readonly
      ? all.filter(({ event: [name] }) => name !== "choose")
      : all;
  }
}

export type { CommandsPart };

customElements.define("tp-commands", CommandsPart);
