// Inputs and report of an opened program's run: the form, the safety rules, the native cycles.
import { html, nothing, type TemplateResult } from "lit";
import { jobOfCalls } from "../calls-job.js";
import type {
  AnyJob,
  ProgramKnown,
  ProgramPart,
  ProgramRun,
} from "../core/browser.js";
import { PROGRAM_POST_TITLES } from "../core/program-posts.js";
import type { Ran } from "../run-text.js";
import type { Store } from "../store.js";
import { w } from "../words.js";
import { handMade, handMadeFields, isHandMade } from "./hand-made.js";

/** Trigger points by the value of `part`. */
const MEETS: [string, number | null | undefined, string][] = [
  ["unknown", undefined, w("not known")],
  ["half", 0.5, w("half way")],
  ["end", 1, w("at the end")],
  ["never", null, w("never")],
];

/** Part from the job in the form, and part entered by hand. */
const FORM = "form";
const HAND = "hand";

/** Maximum number of variables in the form. */
const MOST_ASKED = 60;

const VERDICTS = {
  true: { mark: "✓", word: w("holds") },
  false: { mark: "!", word: w("does not hold") },
  null: { mark: "?", word: w("not known") },
} as const;

/** Written values, one row per line and register: `G54 X 0, Y 5`. For a line that runs several times, the last values. */
function written(
  writes: ProgramRun["writes"],
): { what: string; line: number }[] {
  const MOST = 20;
  const rows = new Map<
    string,
    { register: string; line: number; axes: Map<string, number | null> }
  >();
  for (const { file, line, register, axis, value } of writes) {
    if (file !== 0) continue;
    const key = `${line} ${register}`;
    const row = rows.get(key) ?? { register, line, axes: new Map() };
    if (axis) row.axes.set(axis, value);
    rows.set(key, row);
  }
  return [...rows.values()].slice(0, MOST).map(({ register, line, axes }) => {
    const words = Array.from(axes, ([axis, value]) =>
      value === null ? axis : `${axis} ${Number(value.toFixed(4))}`,
    );
    return { what: `${register} ${words.join(", ")}`.trim(), line };
  });
}

/** The rules that a program breaks. */
export const brokenOf = (rules: ProgramRun["rules"] = []) =>
  rules.filter(({ holds }) => holds === false);

/** Letter of a fault in the list and in the margin of its lines: A to Z, then A2. */
export const letter = (fault: number): string =>
  `${String.fromCharCode(65 + (fault % 26))}${fault < 26 ? "" : Math.floor(fault / 26) + 1}`;

export const noteList = (notes: string[]): TemplateResult | typeof nothing =>
  notes.length > 0
    ? html`<ul class="notes">${notes.map((note) => html`<li>${note}</li>`)}</ul>`
    : nothing;

/** The form and the report beside the moves of a program. */
export class RunPanel {
  /** Variables that were needed when the program was opened, or have a value. A field does not disappear while it is edited. */
  private names: string[] = [];
  /** Lines that read each variable. */
  private lines = new Map<string, number[]>();
  /** Whether the form is open; it stays open while a field is edited. */
  private open = false;

  constructor(
    private readonly store: () => Store,
    private readonly changed: (known: ProgramKnown) => void,
    private readonly point: (line: number) => void,
    private readonly adopt: (job: AnyJob) => void,
  ) {}

  /** Shows another program. */
  begin(): void {
    this.names = [];
    this.lines.clear();
    this.open = false;
  }

  /** Faults first, then lines that are not followed (`notes`), assumptions and inputs, native calls, and the rules that hold. `own`: the user's inputs. */
  render(
    own: ProgramKnown,
    { known, assumes, run, plain, wrong }: Ran,
    notes: string[],
  ): TemplateResult {
    const t = this.store().t.bind(this.store());
    const asked = run.asks.map(({ name }) => name);
    for (const { name, lines } of run.asks) this.lines.set(name, lines);
    this.names = [
      ...new Set([...this.names, ...Object.keys(known.set ?? {}), ...asked]),
    ].slice(0, MOST_ASKED);
    const probes = run.kind.some((k) => run.kinds[k] === "probe");
    const form = this.names.length > 0 || probes;
    const broken = brokenOf(plain.rules);
    const others = plain.rules.filter(({ holds }) => holds !== false);
    const rules = (rows: ProgramRun["rules"]) =>
      html`<ul class="checks">${rows.map((row, k) => this.rule(row, k))}</ul>`;
    return html`
      ${plain.rules.length === 0 ? nothing : broken.length === 0 ? html`<h2>${t("No broken rule was found")}</h2>` : html`<h2>${broken.length === 1 ? t("1 fault") : t("{count} faults", broken.length)}</h2>${rules(broken)}`}
      ${wrong.length > 0 ? html`<ul class="notes">${wrong.map((finding) => html`<li class="warning">${t("The part is not used:")} ${this.store().say(finding.said)}</li>`)}</ul>` : nothing}
      ${noteList(notes)}
      ${plain.writes.length > 0 ? html`<h2>${t("Lasting writes")}</h2><ul class="writes">${written(run.writes).map(({ what, line }) => html`<li>${what}${this.places([line])}</li>`)}</ul>` : nothing}
      ${form ? this.form(own, known, run, assumes) : nothing}
      ${plain.calls.length > 0 ? html`<h2>${t("Native cycles")}</h2>${this.allCalls(plain)}<ul class="calls">${plain.calls.slice(0, 50).map((call) => this.call(call))}</ul>` : nothing}
      ${others.length > 0 ? html`<details class="others"><summary>${t("Other safety rules: {count}", others.length)}</summary>${rules(others)}</details>` : nothing}
    `;
  }

  /** `own`: the user's inputs; `known` also has the assumptions, which are shown and not stored. */
  private form(
    own: ProgramKnown,
    known: ProgramKnown,
    run: ProgramRun,
    assumes: boolean,
  ): TemplateResult {
    const t = this.store().t.bind(this.store());
    const number = (
      id: string,
      label: string,
      value: number | null | undefined,
      note: string,
      take: (x: number | null) => void,
    ) =>
      html`<div class="field"><label for=${id}>${label}</label><input type="text" id=${id} inputmode="decimal" autocomplete="off" .value=${value === null || value === undefined ? "" : String(value)} @change=${(e: Event) => this.take(e, take)} />${note ? html`<small>${note}</small>` : nothing}</div>`;
    const start = known.start ?? [null, null, null];
    const axis = (i: 0 | 1 | 2) =>
      number(`start-${i}`, `${t("Start")} ${"XYZ"[i]}`, start[i], "", (x) => {
        const place = [...(own.start ?? [null, null, null])] as [
          number | null,
          number | null,
          number | null,
        ];
        place[i] = x;
        const { start: _, ...rest } = own;
        this.changed(
          place.some((one) => one !== null) ? { ...rest, start: place } : rest,
        );
      });
    const variable = (name: string) => {
      const lines = this.lines.get(name) ?? [];
      const note =
        lines.length === 0
          ? ""
          : t(
              "Line {lines}",
              lines
                .slice(0, 5)
                .map((line) => line + 1)
                .join(", "),
            );
      return number(`ask-${name}`, name, known.set?.[name], note, (x) => {
        const { [name]: _, ...rest } = own.set ?? {};
        this.changed({
          ...own,
          set: x === null ? rest : { ...rest, [name]: x },
        });
      });
    };
    this.open ||= this.names.length > 0 || assumes;
    return html`<details class="known" ?open=${this.open}>
      <summary>${t("Run with your values")}</summary>
      ${assumes ? html`<p class="assumed">${t("Assumed, since the program does not state it: start, work offsets and tool length 0, and the trigger points of touches that you have not entered.")}</p>` : nothing}
      <p>${this.names.length > 0 || !assumes ? t("The program reads variables that it never sets. Enter their values here; they are stored under the file name. Results that depend on an empty one are shown as unknown.") : nothing}</p>
      <div class="fields">
        ${this.control(own)}
        ${this.meets("at", t("Touches trigger"), own, known, run)}
        ${known.part && "cycle" in known.part ? nothing : this.meets("positioning", t("Watched positioning triggers"), own, known, run)}
        ${isHandMade(own.part) ? this.hand(own, number) : nothing}
        ${axis(0)}${axis(1)}${axis(2)}
        ${this.names.map(variable)}
      </div>
    </details>`;
  }

  /** Control of the program. Without a choice it is recognised from the text. */
  private control(own: ProgramKnown): TemplateResult {
    const t = this.store().t.bind(this.store());
    const choose = (event: Event) => {
      const post = (event.target as HTMLSelectElement).value;
      const { post: _, ...rest } = own;
      this.changed(
        post ? { ...rest, post: post as NonNullable<typeof own.post> } : rest,
      );
    };
    const titles = Object.entries(PROGRAM_POST_TITLES);
    return html`<div class="field"><label for="known-post">${t("Control")}</label>
      <select id="known-post" @change=${choose}><option value="" ?selected=${!own.post}>${t("by its text")}</option>${titles.map(([post, title]) => html`<option value=${post} ?selected=${own.post === post}>${title}</option>`)}</select></div>`;
  }

  /** Fields of a part entered by hand. */
  private hand(
    known: ProgramKnown,
    number: (
      id: string,
      label: string,
      value: number,
      note: string,
      take: (x: number | null) => void,
    ) => TemplateResult,
  ): TemplateResult | typeof nothing {
    if (!isHandMade(known.part)) return nothing;
    return handMadeFields(
      this.store(),
      known.part,
      (id, label, value, take) =>
        number(id, label, value, "", (x) => x !== null && take(x)),
      (part) => this.changed({ ...known, part }),
    );
  }

  private meets(
    key: "at" | "positioning",
    label: string,
    own: ProgramKnown,
    known: ProgramKnown,
    run: ProgramRun,
  ): TemplateResult {
    const t = this.store().t.bind(this.store());
    const part = known.part ?? {};
    const onPart = "cycle" in part;
    const byHand = isHandMade(part);
    const now = onPart ? undefined : part[key];
    const choose = (event: Event) => {
      const chosen = (event.target as HTMLSelectElement).value;
      if (chosen === HAND) return this.changed({ ...own, part: handMade(run) });
      if (chosen === FORM) {
        const job = structuredClone(
          this.store().draft,
        ) as unknown as ProgramPart;
        return this.changed({ ...own, part: job });
      }
      const value = MEETS.find(([id]) => id === chosen)?.[1];
      const { [key]: _, ...rest } = (onPart ? {} : (own.part ?? {})) as {
        at?: number | null;
        positioning?: number | null;
      };
      this.changed({
        ...own,
        part: value === undefined ? rest : { ...rest, [key]: value },
      });
    };
    return html`<div class="field"><label for=${`meets-${key}`}>${label}</label>
      <select id=${`meets-${key}`} @change=${choose}>${MEETS.map(([id, value, word]) => html`<option value=${id} ?selected=${!onPart && value === now}>${t(word)}</option>`)}
        ${key === "at" ? html`<option value=${HAND} ?selected=${byHand}>${t("on a part entered by hand")}</option><option value=${FORM} ?selected=${onPart && !byHand}>${t("on the part in the form")}</option>` : nothing}</select></div>`;
  }

  /** Reads a number, also with a decimal comma; an empty field has no value. Other text stays for correction. */
  private take(event: Event, take: (x: number | null) => void): void {
    const input = event.target as HTMLInputElement;
    const text = input.value.trim().replace(",", ".").replace("−", "-");
    const value = text === "" ? null : Number(text);
    const wrong = value !== null && !Number.isFinite(value);
    input.ariaInvalid = String(wrong);
    if (!wrong) take(value);
  }

  /** A rule and its result; a fault has its letter. */
  private rule(
    { rule, holds, said, lines }: ProgramRun["rules"][number],
    index: number,
  ): TemplateResult {
    const store = this.store();
    const { mark, word } = VERDICTS[`${holds}`];
    const why = store.catalog.rules.find(({ name }) => name === rule);
    const shown = holds === false ? letter(index) : mark;
    return html`<li class=${holds === false ? "warning" : ""} title=${why ? `${why.why} (${rule})` : rule}><span class=${holds === false ? "mark fault" : "mark"} role="img" aria-label=${holds === false ? `${shown}: ${store.t(word)}` : store.t(word)}>${shown}</span>
      ${store.say(said)}${this.places(lines)}</li>`;
  }

  /** The first lines; a click shows a line. */
  private places(lines: number[]): TemplateResult | typeof nothing {
    if (lines.length === 0) return nothing;
    const t = this.store().t.bind(this.store());
    const says = t(
      "Line {lines}",
      lines
        .slice(0, 8)
        .map((line) => line + 1)
        .join(", "),
    );
    return html` <button type="button" class="quiet" title=${t("Show in the program")} @click=${() => this.point(lines[0] as number)}>${says}${lines.length > 8 ? ", …" : ""}</button>`;
  }

  /** One job of all calls, if possible. */
  private allCalls(run: ProgramRun): TemplateResult | typeof nothing {
    const job = this.store().readonly ? null : jobOfCalls(run);
    if (!job) return nothing;
    return html`<p><button type="button" class="quiet" @click=${() => this.adopt(job)}>${this.store().t("Create a job from these {count} calls", job.cycles.length)}</button></p>`;
  }

  private call({
    line,
    name,
    title,
    mark,
    arguments: given,
    contradictions,
    job,
  }: ProgramRun["calls"][number]): TemplateResult {
    const t = this.store().t.bind(this.store());
    const words = given.map(
      ({ name, value, meaning }) =>
        `${name} ${value ?? "?"}${meaning ? ` (${meaning})` : ""}`,
    );
    return html`<li class=${contradictions.length > 0 ? "warning" : ""}><b>${name}</b>${this.places([line])} <span lang="en">${title ?? ""}${words.length > 0 ? `: ${words.join(", ")}` : ""}</span>
      ${mark === "recalled" ? html`<small>${t("not verified on a control")}</small>` : nothing}
      ${contradictions.length > 0 ? html`<b lang="en">${contradictions.join("; ")}</b>` : nothing}
      ${job && !this.store().readonly ? html`<button type="button" class="quiet" @click=${() => this.adopt(job)}>${t("Create a job from this call")}</button>` : nothing}</li>`;
  }
}
