import { html, nothing, type PropertyValues, type TemplateResult } from "lit";
import {
  type Job,
  type Plan,
  type Programmed,
  programs,
} from "../core/browser.js";
import type { Form } from "../entries.js";
import type { Store } from "../store.js";
import { w } from "../words.js";
import { Colours } from "./colours.js";
import type { Compared } from "./compare.js";
import { copied, copy, withheld } from "./download.js";
import { Finder } from "./finder.js";
import { StorePart } from "./part.js";

/** Labels of the program forms, as in the form. */
const FORMS: Record<Form, string> = {
  moves: w("Plain moves"),
  cycle: w("The native cycle"),
};

/** A line of the program, counted from 0. */
interface Line {
  text: string;
  line: number;
}

/** A run of lines under one heading. */
interface Block {
  /** Documented step; 0 without one. */
  step: number;
  /** Index of its cycle in the plan. */
  cycle: number;
  lines: Line[];
}

/** Names of folded runs by their lines; the first match counts. */
const RUNS: [RegExp, string, string][] = [
  [
    /^(?:N\d+ ?)+$|^TP_\w+:$|^#3000=/,
    w("1 line for a stop"),
    w("{count} lines for a stop"),
  ],
  [
    /\b(?:IF|if|GOTOF?|STOPRE|endif)\b|^o\d/,
    w("1 line of checks"),
    w("{count} lines of checks"),
  ],
  [/=/, w("1 line of arithmetic"), w("{count} lines of arithmetic")],
];

/** Lines without a move that a setter looks for: writes, messages, calls, ends. */
const SEEN =
  /^(?:G10 |\$P_UIFR\[\d+,\w,TR\]=\$P|#(?:52[2-9]\d|53[0-3]\d|7\d{3}|14\d{3})=#|\(DEBUG,|\(PRINT,|\(LOG,|MSG\("[a-z]|DPRNT|POPEN|M(?:0|00|1|2|30|72)$|G65 |CALL O|CYCLE\d|\d+ | +Q|%|\(READ THE)/;

/** A line number padded to the same width. Plain text, because a box per number would be laid out at every keystroke. */
const numberOf = (line: number) => `${String(line + 1).padStart(4)}  `;

/** A line that announces the next move, from 1: for SINUMERIK, and for Fanuc and Haas. The program's checks before the move follow it. */
const NAMED = /^(?:TP_MOVE|#149)=(\d+)$/;

/** A comment line, or the start of a Klartext program. */
const COMMENT = /^(?:\d+ )?(?:;|\(|BEGIN PGM)|^%/;

/** How long the note about a saved or copied program is shown, ms: it has the place of the search count. */
const TOLD = 8000;

/** A block that calls a native cycle with moves; not a protected move, a probe switch, a link between features, or 1493. */
const CALL =
  /^(?:G65 P|CALL O)(?!\d\d(?:10|3[2-5])\b)|^CYCLE\d+\(|^\d+ TCH PROBE (?!1493)/;

/** Numbers of the touches that moves make, from 1, for the first touch of each point. */
function touchNumbers(store: Store): Map<number, number> {
  const seen = new Set<number>();
  const numbers = new Map<number, number>();
  store.plan.moves.forEach(({ kind, touch }, move) => {
    if (kind !== "touch" || touch === null || seen.has(touch)) return;
    seen.add(touch);
    numbers.set(move, store.touchNumber(touch));
  });
  return numbers;
}

/** Messages of the program after measuring, with the values of the virtual part: DEBUG of LinuxCNC, MSG of SINUMERIK. */
function screenText(store: Store): string[] {
  const { program, results } = store.plan;
  const named = (row: Plan["results"][number]) =>
    store.ofCycle(row.cycle, row.code);
  const put = (text: string, digits: number) =>
    text.replaceAll(
      /([\w.]+)=(?:#<\w+>|"<<R\d+(?:<<")?)/g,
      (all, code: string) => {
        const value = results.find((row) => named(row) === code)?.value;
        return typeof value === "number"
          ? `${code}=${value.toFixed(digits)}`
          : all;
      },
    );
  return program.text.split("\n").flatMap((line) => {
    const debug = /^\(DEBUG,(.*)\)$/.exec(line)?.[1];
    // DEBUG shows values with six decimals.
    if (debug !== undefined) return [put(debug, 6)];
    const message = /^MSG\("(.*?)"?\)$/.exec(line)?.[1];
    return message !== undefined && /="<<R\d+/.test(message)
      ? [put(message, 3)]
      : [];
  });
}

/** The program by lines under the documented steps. The line of the current move is highlighted. */
class ProgramPart extends StorePart {
  protected override storeEvents = ["change"];
  protected override lights = true;
  private told = "";
  /** The program that was saved or copied; its message holds for no other. */
  private toldOf = "";
  private unfolded = false;
  /** Comparison: none, with the program saved last, or with that for another control. */
  private against = "";
  /** The module that compares programs, loaded on demand. */
  private compares: typeof import("./compare.js") | null = null;
  /** Whether both programs are side by side. */
  private wide = false;
  private readonly colours = new Colours();
  /** The program with syntax colours, and whether its header is unfolded. */
  private coloured = "";
  private readonly finder = new Finder(
    () => this.store,
    () => this.store.plan.program.text,
    () => this.toFound(),
  );

  override render(): TemplateResult {
    const { stale } = this.store;
    const { program, moves, cycles } = this.store.plan;
    const why = stale ? "withheld-program" : nothing;
    const lines =
      program.text === "" ? [] : program.text.replace(/\n$/, "").split("\n");
    const moveAt = new Map(program.moveLines.map((line, move) => [line, move]));
    // The last move of each call.
    const callAt = new Map(this.lines.map((line, move) => [line, move]));
    const { head } = this;
    // Blocks with their own numbers need no line numbers.
    const own =
      lines.length > 0 && lines.every((text) => /^(\d+ | )/.test(text));
    // Calls of native cycles are not divided into documented steps.
    const stepsOf = (cycle: number) =>
      program.own ? [] : this.store.stepsOf(cycle);
    const numbers = touchNumbers(this.store);
    const row = ({ text, line }: Line) => {
      const move = moveAt.get(line);
      const kind =
        move === undefined
          ? "plain"
          : moves[move]?.kind === "touch"
            ? "touch"
            : "";
      const touch = move === undefined ? undefined : numbers.get(move);
      return html`<div role="option" class=${`line ${kind}`} data-line=${line} aria-selected="false">${own ? nothing : html`<span class="line-number">${numberOf(line)}</span>`}<span class="text">${text}</span>${touch === undefined ? nothing : html`<span class="disc" role="img" aria-label=${this.t("touch {touch}", touch)}>${touch}</span>`}</div>`;
    };
    /** Folds lines without a move that are rarely needed. */
    const rows = (lines: Line[]) => {
      const plain = ({ text, line }: Line) =>
        !moveAt.has(line) && !SEEN.test(text);
      const runs: Line[][] = [];
      for (const one of lines) {
        const last = runs.at(-1)?.[0];
        if (last && plain(last) && plain(one)) runs.at(-1)?.push(one);
        else runs.push([one]);
      }
      return runs.map((run) => {
        const [first] = run as [Line];
        if (!plain(first) || this.everything || this.opened.has(first.line))
          return run.map(row);
        return html`<div role="option" aria-selected="false" class="folded" data-run=${first.line}><span class="line-number">   ⋯  </span>${this.runInWords(run)}</div>`;
      });
    };
    const numbered = lines.map((text, line) => ({ text, line }));
    let now = "";
    const blocks: Block[] = [];
    for (const one of numbered.slice(head)) {
      const named = NAMED.exec(one.text)?.[1];
      const move =
        moveAt.get(one.line) ??
        (named === undefined ? callAt.get(one.line) : Number(named) - 1);
      const { step = 0, cycle = 0 } =
        (move === undefined ? undefined : moves[move]) ?? blocks.at(-1) ?? {};
      const next = `${cycle} ${step}`;
      if (next !== now || blocks.length === 0)
        blocks.push({ step, cycle, lines: [] });
      now = next;
      blocks.at(-1)?.lines.push(one);
    }
    return html`
      <div class="tools">
        <button type="button" ?disabled=${stale} aria-describedby=${why} @click=${this.copy}>${this.t("Copy")}</button>
        <span role="status" class="status-text">${stale || this.toldOf !== program.text ? "" : this.told}</span>
        ${this.finder.render(this.comparing)}
        <select class="compares" aria-label=${this.t("Compare the program")} title=${this.t("Compare with …")} ?hidden=${this.store.saved === null && !this.otherForm} @change=${this.choose}>
          <option value="">⇄ ${this.t("Compare with …")}</option>
          <option value="saved" ?disabled=${this.store.saved === null}>${this.t("the one saved last")}</option>
          ${this.otherForm ? html`<option value="form">${this.t(FORMS[this.otherForm])}</option>` : nothing}
        </select>
        <button type="button" class="all" aria-pressed=${this.everything ? "true" : "false"} ?hidden=${this.comparing} title=${this.t("Show also the lines that check, compute and stop")} @click=${this.unfold}>${this.t("All lines")}</button>
      </div>
      ${head > 0 && !this.comparing ? html`<button type="button" class="head" aria-expanded=${this.unfolded ? "true" : "false"} @click=${this.fold}><span aria-hidden="true">${this.unfolded ? "▾" : "▸"}</span> ${this.t("header ({count})", head)}</button>` : nothing}
      ${withheld(this.store, "withheld-program")}
      ${this.comparing ? this.differences() : nothing}
      <div class=${stale ? "code stale" : "code"} ?hidden=${this.comparing} role="listbox" lang="en" translate="no" tabindex="0" aria-label=${this.t("Program")} @keydown=${this.key}
        @mouseover=${(e: MouseEvent) => this.onLine(e, (move) => this.store.point(move))} @mouseleave=${() => this.store.point(null)}
        @click=${this.clicked}>
        ${head > 0 ? html`<div role="group" aria-label=${this.t("Before the first move")} ?hidden=${!this.unfolded}>${numbered.slice(0, head).map(row)}</div>` : nothing}
        ${blocks.map((block, i) => {
          const begins =
            cycles.length > 1 && block.cycle !== blocks[i - 1]?.cycle;
          const text = stepsOf(block.cycle)[block.step - 1];
          const chapter = begins
            ? html`<div class="step chapter" role="presentation"><b>${cycles[block.cycle]}</b></div>`
            : nothing;
          if (!text)
            return html`${chapter}<div role="group" aria-label=${begins ? String(cycles[block.cycle]) : this.t("Program")}>${rows(block.lines)}</div>`;
          return html`${chapter}<div role="group" aria-label=${this.t("Step {step}: {words}", block.step, text)}>
            <div class="step" data-step=${block.step} role="presentation"><b>${block.step}</b> <span>${text}</span></div>
            ${rows(block.lines)}</div>`;
        })}
      </div>
      ${this.screen()}
      <p class="write-summary">${stale ? this.t("no program") : this.t("This program {does}", program.said)}</p>
    `;
  }

  /** The output of the program at its end, for the virtual part. */
  private screen(): TemplateResult | typeof nothing {
    const lines = screenText(this.store);
    if (lines.length === 0) return nothing;
    return html`<details class="screen"><summary>${this.t("On the operator's screen at the end")}</summary><pre lang="en" translate="no">${lines.join("\n")}</pre></details>`;
  }

  /** Name of a folded run of lines. */
  private runInWords(run: Line[]): string {
    const [, one, many] = RUNS.find(([is]) =>
      run.some(({ text }) => is.test(text)),
    ) ?? [null, w("1 more line"), w("{count} more lines")];
    return run.length === 1 ? this.t(one) : this.t(many, run.length);
  }

  /** A click opens a folded run, or selects the move of a line. */
  private readonly clicked = (event: MouseEvent): void => {
    const run = (event.target as Element).closest<HTMLElement>("[data-run]")
      ?.dataset.run;
    if (run !== undefined) this.open(Number(run));
    else this.onLine(event, (move) => this.store.pin(move));
  };

  /** Opens a folded run. */
  private open(line: number): void {
    this.opened.add(line);
    this.requestUpdate();
  }

  /** Shows every line, or only the important ones. */
  readonly unfold = (): void => {
    this.everything = !this.everything;
    this.opened.clear();
    this.requestUpdate();
  };

  /** Whether every line is shown. */
  private everything = false;
  /** Opened runs, by their first lines. */
  private readonly opened = new Set<number>();

  /** Number of header lines, which are folded: those before the first move, or before the first block of a program of native cycles. */
  private get head(): number {
    const { moveLines, text } = this.store.plan.program;
    const made = moveLines.find((line) => line >= 0);
    const first =
      made ??
      text.split("\n").findIndex((line) => line !== "" && !COMMENT.test(line));
    return first > 3 ? first : 0;
  }

  /** The plan of the line table. */
  private lined: Plan | null = null;
  private known: number[] = [];

  /** Line of each move; for the move of a native cycle, the line of its call. */
  private get lines(): readonly number[] {
    const { plan } = this.store;
    if (this.lined === plan) return this.known;
    const { moveLines, own, text } = plan.program;
    const calls = [...text.split("\n").entries()]
      .filter(([, block]) => CALL.test(block))
      .map(([line]) => line);
    let [call, made] = [-1, ""];
    this.known = plan.moves.map(({ cycle, step }, move) => {
      const line = moveLines[move] ?? -1;
      if (line >= 0) return line;
      // A step of such a program is a call. The next call makes the moves to its first touch.
      const leads = !own || step < 2;
      if (!leads && made !== `${cycle} ${step}`)
        [call, made] = [call + 1, `${cycle} ${step}`];
      return calls[leads ? call + 1 : call] ?? -1;
    });
    this.lined = plan;
    return this.known;
  }

  /** Whether differences are shown instead of the program. */
  private get comparing(): boolean {
    return this.against !== "" && this.compares !== null;
  }

  /** The document whose lines are shown. */
  private document = -1;

  /** Ends a comparison if the control has no other form for the job's cycle. */
  protected override willUpdate(): void {
    this.finder.again();
    const form = this.against === "form" && this.otherForm !== undefined;
    if (this.store.document !== this.document) this.opened.clear();
    this.document = this.store.document;
    if (this.against !== "saved" && !form) this.against = "";
    if (!this.comparing || this.store.stale) this.wide = false;
  }

  /** The other form in which the job's control has a program for this cycle. */
  private get otherForm(): Form | undefined {
    const { store } = this;
    const own = (store.shown as { control?: { form?: unknown } }).control?.form;
    return store
      .formsOf(store.plan.program.post, store.cycle.type)
      .find((form) => form !== own);
  }

  private readonly choose = async (event: Event): Promise<void> => {
    this.against = (event.target as HTMLSelectElement).value;
    try {
      if (this.against !== "") this.compares ??= await import("./compare.js");
    } catch {
      this.against = "";
      this.tell(
        this.t(
          "This part of the page could not be loaded. Check the network connection",
        ),
      );
    }
    this.requestUpdate();
  };

  /** The program to compare with, or the reason why a comparison is impossible. */
  private other(): { text: string } | { why: string } {
    const { store } = this;
    if (this.against === "saved")
      return store.saved === null ? { why: "" } : { text: store.saved };
    const control = store.controlOf(
      store.plan.program.post,
      this.otherForm ?? "moves",
      store.shown,
    );
    const { program, findings } = programs([
      { ...store.shown, control } as unknown as Job,
    ]).next().value as Programmed;
    const error = findings.find((f) => f.level === "error");
    return program
      ? { text: program.text }
      : { why: error ? this.message(error) : "" };
  }

  /** Every line of both programs. A sign and a colour show the origin of a line. */
  private differences(): TemplateResult {
    const other = this.other();
    if ("why" in other || !this.compares)
      return html`<p class="problem">${"why" in other ? other.why : ""}</p>`;
    const lines = this.compares.compare(
      other.text,
      this.store.plan.program.text,
    );
    const count = (sign: string) =>
      lines.filter((one) => one.sign === sign).length;
    return html`<p class="compared"><span role="status">${this.t("{more} lines only here, {less} lines only there", count("+"), count("-"))}</span>
        <button type="button" class="quiet" ?disabled=${this.store.stale} @click=${() => this.widen(true)}>${this.t("Side by side")}</button></p>
      <dialog class="beside" aria-label=${this.t("Side by side")} @close=${() => this.widen(false)}>${this.wide ? this.beside(lines) : nothing}</dialog>
      <div class=${this.store.stale ? "code differences stale" : "code differences"} lang="en" translate="no" tabindex="0" role="region" aria-label=${this.t("Differences")}>${lines.map(
        ({ sign, text, line }) =>
          html`<div class=${`line ${sign === "+" ? "more" : sign === "-" ? "less" : "plain"}`}><span class="line-number">${line === null ? "" : numberOf(line)}</span><span class="sign">${this.sign(sign)}</span><span class="text">${text}</span></div>`,
      )}</div>`;
  }

  /** Origin of a line: a sign with its meaning. */
  private sign(sign: Compared["sign"]): TemplateResult | string {
    if (sign === " ") return sign;
    const says =
      sign === "-"
        ? this.t("not in this program")
        : this.t("only in this program");
    return html`<span role="img" aria-label=${says}>${sign}</span>`;
  }

  private async widen(wide: boolean): Promise<void> {
    this.wide = wide;
    this.requestUpdate();
    await this.updateComplete;
    if (wide)
      this.querySelector<HTMLDialogElement>("dialog.beside")?.showModal();
  }

  /** Both programs in two columns. */
  private beside(lines: Compared[]): TemplateResult | typeof nothing {
    const cells = (one: Compared | null, line: number | null | undefined) => {
      const kind =
        one === null ? "none" : { " ": "", "-": "less", "+": "more" }[one.sign];
      return html`<td class=${`line-number ${kind}`}>${one ? this.sign(one.sign) : nothing} ${typeof line === "number" ? line + 1 : ""}</td><td class=${kind}>${one?.text}</td>`;
    };
    return html`<form method="dialog" class="tools"><button>${this.t("Close")}</button></form>
      <table><colgroup><col class="line-number" /><col /><col class="line-number" /><col /></colgroup><thead><tr><th colspan="2" scope="colgroup">${this.t(this.against === "form" && this.otherForm ? FORMS[this.otherForm] : w("saved last"))}</th><th colspan="2" scope="colgroup">${this.t("this program")}</th></tr></thead>
        <tbody lang="en" translate="no">${this.compares?.beside(lines).map(([left, right]) => html`<tr>${cells(left, left?.other)}${cells(right, right?.line)}</tr>`)}</tbody></table>`;
  }

  protected override updated(changed: PropertyValues): void {
    super.updated(changed);
    if (!this.wide)
      this.querySelector<HTMLDialogElement>("dialog.beside")?.close();
    // The user's choice stays in the list, even if the options change.
    const list = this.querySelector<HTMLSelectElement>("select.compares");
    if (list) list.value = this.against;
    this.mark();
    this.colours.follow(
      this.querySelector<HTMLElement>(".code[role=listbox]") as HTMLElement,
    );
    const shown = `${this.unfolded} ${this.everything} ${this.opened.size} ${this.store.plan.program.text}`;
    if (shown === this.coloured) return;
    this.coloured = shown;
    this.colours.show(120);
  }

  override connectedCallback(): void {
    super.connectedCallback();
    // After a move to another position of the page the colours are lost.
    this.requestUpdate();
  }

  override disconnectedCallback(): void {
    super.disconnectedCallback();
    clearTimeout(this.untell);
    this.coloured = "";
    this.colours.leave();
  }

  /** Highlights line and step of the current move without rendering the lines again. */
  protected override light(): void {
    const { highlight, plan } = this.store;
    const line = highlight === null ? -1 : (this.lines[highlight] ?? -1);
    const step = highlight === null ? 0 : (plan.moves[highlight]?.step ?? 0);
    for (const old of this.querySelectorAll("[aria-selected=true]")) {
      old.setAttribute("aria-selected", "false");
      old.removeAttribute("id");
    }
    for (const old of this.querySelectorAll(".step.lit"))
      old.classList.remove("lit");
    const lit = this.lineAt(line) as HTMLElement | null;
    lit?.setAttribute("aria-selected", "true");
    const list = this.querySelector(".code[role=listbox]");
    // Screen readers announce the highlighted line.
    if (lit) {
      lit.id = "lit-line";
      list?.setAttribute("aria-activedescendant", lit.id);
    } else list?.removeAttribute("aria-activedescendant");
    for (const heading of this.querySelectorAll(`[data-step="${step}"]`))
      heading.classList.add("lit");
    if (this.matches(":hover") || this.comparing) return;
    const box = this.querySelector<HTMLElement>(".code");
    if (!lit || !box) return;
    const above = lit.offsetTop;
    if (
      above < box.scrollTop ||
      above + lit.offsetHeight > box.scrollTop + box.clientHeight
    ) {
      box.scrollTop = above - box.clientHeight / 2;
    }
  }

  private readonly fold = () => {
    this.unfolded = !this.unfolded;
    this.requestUpdate();
  };

  /** Shows these lines. */
  find(lines: number[]): void {
    this.against = "";
    this.finder.give(lines);
  }

  /** Marks the lines that match the search. */
  private mark(): void {
    const { matches, here } = this.finder.found;
    for (const old of this.querySelectorAll(".line.match"))
      old.classList.remove("match", "here");
    for (const line of matches) this.lineAt(line)?.classList.add("match");
    this.lineAt(here)?.classList.add("here");
  }

  /** Scrolls to the current match, also inside the folded header. */
  private async toFound(): Promise<void> {
    const { here } = this.finder.found;
    if (here >= 0 && here < this.head) this.unfolded = true;
    // Opens a folded run with a match.
    if (here >= this.head && !this.lineAt(here)) this.everything = true;
    this.requestUpdate();
    await this.updateComplete;
    this.lineAt(here)?.scrollIntoView({ block: "nearest" });
  }

  /** Calls `act` with the move of the line under the pointer; null for a line without a move. Does nothing beside the lines. */
  private onLine(event: MouseEvent, act: (move: number | null) => void): void {
    const line = (event.target as Element).closest<HTMLElement>("[data-line]")
      ?.dataset.line;
    if (line === undefined) return;
    const { program } = this.store.plan;
    const made = program.moveLines.lastIndexOf(Number(line));
    const move =
      made < 0 && program.own ? this.lines.indexOf(Number(line)) : made;
    act(move < 0 ? null : move);
  }

  private lineAt(line: number): Element | null {
    return this.querySelector(`[data-line="${line}"]`);
  }

  private key(event: KeyboardEvent): void {
    if (event.key === "Escape") this.store.pin(null);
    const step = { ArrowDown: 1, ArrowUp: -1 }[event.key];
    if (!step) return;
    event.preventDefault();
    const last = this.store.plan.moves.length - 1;
    const now = this.store.highlight ?? (step > 0 ? -1 : last + 1);
    this.store.pin(Math.max(0, Math.min(last, now + step)));
  }

  private async copy(): Promise<void> {
    if (!this.store.stale)
      this.tell(this.t(copied(await copy(this.store.plan.program.text))));
  }

  /** Shows a message about this program only. */
  tell(text: string): void {
    this.told = text;
    this.toldOf = this.store.plan.program.text;
    this.requestUpdate();
    clearTimeout(this.untell);
    this.untell = setTimeout(() => {
      this.told = "";
      this.requestUpdate();
    }, TOLD);
  }

  private untell?: ReturnType<typeof setTimeout>;
}

export type { ProgramPart };

customElements.define("tp-program", ProgramPart);
