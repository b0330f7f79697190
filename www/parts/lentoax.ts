import { html, nothing, type TemplateResult } from "lit";
import {
  type Finding,
  JobError,
  type Lentoax,
  type LentoaxQuery,
  lentoax,
  lentoaxWords,
} from "../core/browser.js";
import { readNumber } from "../number.js";
import { AXES_OF } from "../sentences.js";
import type { Store } from "../store.js";
import { w } from "../words.js";
import { CanvasPart } from "./canvas-part.js";
import { copied, copy } from "./download.js";
import { Drawing } from "./drawing.js";

const GROUPS: [string, number][] = [
  [w("Milling tools (100 to 199)"), 120],
  [w("Drills (200 to 299)"), 200],
  [w("Grinding tools (400 to 499)"), 400],
  [w("Turning tools (500 to 599)"), 500],
  [w("Special tools, probes (700 to 799)"), 710],
];
const COORDS: [string, string][] = [
  ["WCS", w("WCS, workpiece")],
  ["BCS", w("BCS, base")],
  ["MCS", w("MCS, machine")],
  ["KCS", w("KCS, kinematic")],
  ["TCS", w("TCS, tool")],
];
const LENGTH_CONST = [0, 17, 18, 19, -17, -18, -19];
const AXES = ["X", "Y", "Z"] as const;
type Step = NonNullable<LentoaxQuery["frame"]>[number];

type Words = ReturnType<typeof lentoaxWords>;

/** Last query by the page's state, restored when the user returns. */
const ASKED = new WeakMap<Store, Question>();

interface Question {
  query: Required<LentoaxQuery>;
  typed: Map<string, string>;
}

/** Tool length calculator: which tool length acts on which axis. */
class LentoaxPart extends CanvasPart {
  protected override storeEvents: string[] = [];
  private query: Required<LentoaxQuery> = {
    plane: "G17",
    toolType: 710,
    frame: [],
    coord: "WCS",
    toolActive: true,
    sd42900: false,
    sd42940: 0,
    sd42950: 0,
  };
  private typed = new Map<string, string>();
  private told = "";

  override connectedCallback(): void {
    const asked = ASKED.get(this.store);
    if (asked) {
      this.query = asked.query;
      this.typed = asked.typed;
    } else ASKED.set(this.store, { query: this.query, typed: this.typed });
    super.connectedCallback();
  }

  protected override updated(): void {
    this.restyle();
  }

  override render(): TemplateResult {
    let answer: Lentoax | null = null;
    let words: Words = { meaning: "", sentence: "", said: [""], program: "" };
    let findings: Finding[] = [];
    try {
      answer = lentoax(this.query);
      words = lentoaxWords(this.query);
    } catch (thrown) {
      if (!(thrown instanceof JobError)) throw thrown;
      findings = thrown.findings;
    }
    return html`
      <section class="ask" aria-label=${this.t("Question")}>${this.form(findings)}</section>
      <section class="see" aria-label=${this.t("Picture")}><canvas role="img" aria-label=${this.store.say(words.said) || this.t("Axes and tool lengths")}></canvas>
        <div role="status">${
          answer
            ? html`<p><b>${this.t("Status {status}", answer.status)}</b>: ${this.store.say([words.meaning])}</p>
              <p class="sentence">${this.store.say(words.said)}</p>`
            : findings.map(
                (f) => html`<p class="problem error">${this.message(f)}</p>`,
              )
        }</div>
      </section>
      ${answer ? html`<section class="answer" aria-label=${this.t("Answer")}>${this.answer(answer, words)}</section>` : nothing}
    `;
  }

  private form(findings: Finding[]): TemplateResult {
    const q = this.query;
    const group =
      GROUPS.filter(([, type]) => type <= q.toolType).at(-1) ?? GROUPS[0];
    const select = (
      label: string,
      id: string,
      options: [string | number, string][],
      value: string | number,
      take: (v: string) => void,
    ) =>
      html`<div class="field"><label for=${id}>${label}</label><select id=${id} @change=${(e: Event) => this.change(() => take((e.target as HTMLSelectElement).value))}>
        ${options.map(([v, text]) => html`<option value=${v} ?selected=${v === value}>${text}</option>`)}</select></div>`;
    const box = (
      label: string,
      id: string,
      value: boolean,
      take: (v: boolean) => void,
    ) =>
      html`<div class="field wide"><label class="check"><input id=${id} type="checkbox" .checked=${value}
        @change=${(e: Event) => this.change(() => take((e.target as HTMLInputElement).checked))} /> ${label}</label></div>`;
    return html`<form @submit=${(e: Event) => e.preventDefault()} autocomplete="off">
      <fieldset><legend>${this.t("Tool and plane")}</legend>
        ${select(
          this.t("Plane"),
          "l-plane",
          [
            ["G17", "G17"],
            ["G18", "G18"],
            ["G19", "G19"],
          ],
          q.plane,
          (v) => {
            q.plane = v as "G17";
          },
        )}
        ${select(
          this.t("Coordinate system (_COORD)"),
          "l-coord",
          COORDS.map(([v, text]): [string, string] => [v, this.t(text)]),
          q.coord,
          (v) => {
            q.coord = v;
          },
        )}
        ${select(
          this.t("Tool group"),
          "l-group",
          GROUPS.map(([text, type]): [number, string] => [type, this.t(text)]),
          group?.[1] ?? 100,
          (v) => {
            q.toolType = Number(v);
            this.typed.delete("l-type");
          },
        )}
        <div class="field"><label for="l-type">${this.t("Tool type")}</label>${this.number(
          "l-type",
          q.toolType,
          (v) => {
            q.toolType = v as number;
          },
        )}</div>
        ${box(this.t("A tool is active"), "l-active", q.toolActive, (v) => {
          q.toolActive = v;
        })}
      </fieldset>
      <fieldset><legend>${this.t("Active frame")}</legend>
        <div class="field wide">
          ${q.frame.length === 0 ? html`<p class="help">${this.t("No frame: the workpiece system is the base system, but for shifts.")}</p>` : nothing}
          <ol class="steps">${q.frame.map((step, i) => this.step(step, i))}</ol>
          <button type="button" @click=${() => this.change(() => q.frame.push({ rot: "Z", angle: 0 }))}>${this.t("Add ROT")}</button>
          <button type="button" @click=${() => this.change(() => q.frame.push({ mirror: "X" }))}>${this.t("Add MIRROR")}</button>
        </div>
      </fieldset>
      <fieldset><legend>${this.t("Setting data")}</legend>
        ${box(
          this.t(
            "SD42900 $SC_MIRROR_TOOL_LENGTH: mirroring changes the sign of the length",
          ),
          "l-42900",
          q.sd42900,
          (v) => {
            q.sd42900 = v;
          },
        )}
        ${select(
          "SD42940 $SC_TOOL_LENGTH_CONST",
          "l-42940",
          LENGTH_CONST.map((n): [number, string] => [
            n,
            n === 0 ? this.t("0: by the active plane") : `${n}`,
          ]),
          q.sd42940,
          (v) => {
            q.sd42940 = Number(v);
          },
        )}
        ${select(
          "SD42950 $SC_TOOL_LENGTH_TYPE",
          "l-42950",
          [
            [0, this.t("0: by tool type")],
            [1, this.t("1: as for milling")],
            [2, this.t("2: as for turning")],
          ],
          q.sd42950,
          (v) => {
            q.sd42950 = Number(v) as 0;
          },
        )}
      </fieldset>
      ${findings.length ? html`<p class="problem error">${this.t("The question has errors.")}</p>` : nothing}
    </form>`;
  }

  private step(step: Step, i: number): TemplateResult {
    const frame = this.query.frame;
    const turns = "rot" in step;
    const axis = turns ? step.rot : step.mirror;
    const name = this.t("Step {step}", i + 1);
    const move = (to: number) =>
      this.change(() => {
        this.typed.clear();
        frame.splice(to, 0, ...frame.splice(i, 1));
      });
    return html`<li>
      <span>${turns ? "ROT" : "MIRROR"}</span>
      <select aria-label=${`${name}: ${this.t("axis")}`} @change=${(e: Event) =>
        this.change(() => {
          const chosen = (e.target as HTMLSelectElement).value as "X";
          frame[i] = turns
            ? { rot: chosen, angle: step.angle }
            : { mirror: chosen };
        })}>${AXES.map((a) => html`<option ?selected=${a === axis}>${a}</option>`)}</select>
      ${
        turns
          ? this.number(
              `l-angle-${i}`,
              step.angle,
              (v) => {
                frame[i] = { rot: step.rot, angle: v as number };
              },
              `${name}: ${this.t("angle")}`,
            )
          : html`<span class="gap"></span>`
      }
      <button type="button" aria-label=${`${name}: ${this.t("up")}`} ?disabled=${i === 0} @click=${() => move(i - 1)}>↑</button>
      <button type="button" aria-label=${`${name}: ${this.t("down")}`} ?disabled=${i === frame.length - 1} @click=${() => move(i + 1)}>↓</button>
      <button type="button" aria-label=${`${name}: ${this.t("remove")}`} @click=${() =>
        this.change(() => {
          this.typed.clear();
          frame.splice(i, 1);
        })}>×</button>
    </li>`;
  }

  private number(
    id: string,
    value: number,
    take: (v: number | string) => void,
    name?: string,
  ): TemplateResult {
    return html`<span class="number"><input id=${id} type="text" inputmode="decimal" aria-label=${name ?? nothing} .value=${this.typed.get(id) ?? this.store.number(String(value))}
      @focus=${(e: Event) => (e.target as HTMLInputElement).select()}
      @input=${(e: Event) =>
        this.change(() => {
          const text = (e.target as HTMLInputElement).value;
          this.typed.set(id, text);
          take(readNumber(text, "none", "mm", this.store.comma));
        })} />${name ? html`<span class="unit">°</span>` : nothing}</span>`;
  }

  private answer(answer: Lentoax, words: Words): TemplateResult {
    const names = AXES_OF[this.query.plane];
    const roles = [this.t("Abscissa"), this.t("Ordinate"), this.t("Applicate")];
    return html`
      <table>
        <caption>${this.t("_AXIND and _MATRIX")}</caption>
        <thead><tr><th>${this.t("Axis")}</th><th class="n">_AXIND</th><th class="n">L1</th><th class="n">L2</th><th class="n">L3</th></tr></thead>
        <tbody>${answer.matrix.map(
          (
            row,
            i,
          ) => html`<tr><td>${roles[i]} ${names[i]}</td><td class="n"><b>${answer.axind[i]}</b></td>
          ${row.map((x) => html`<td class="n">${Number.isInteger(x) ? x : this.store.number(x.toFixed(7))}</td>`)}</tr>`,
        )}</tbody>
      </table>
      <h2>${this.t("Ask the control itself")}</h2>
      <div class="tools"><button type="button" @click=${() => this.copy(words.program)}>${this.t("Copy")}</button><button type="button" ?disabled=${this.store.readonly} @click=${this.take}>${this.t("Apply to the job")}</button><span role="status" class="status-text">${this.told}</span></div>
      <pre class="code" lang="en" translate="no" tabindex="0">${words.program}</pre>
      <p class="help">${this.t("The call is the manual's; the check after it is ours: it compares with the answer above, and was not run on a control. The manual's own example turned by 60° says in its text that L1 lies along the negative ordinate; its printed result (-3) and the geometry say L3: a misprint.")}</p>
    `;
  }

  /** Transfers tool, plane and frame to the job, which is then checked for them. */
  private take(): void {
    const { plane, toolType, frame, sd42900, sd42940, sd42950 } = this.query;
    this.store.put("plane", plane);
    this.store.put("tool", {
      type: toolType,
      frame: structuredClone(frame),
      sd42900,
      sd42940,
      sd42950,
    });
    this.dispatchEvent(new CustomEvent("taken", { bubbles: true }));
  }

  private change(make: () => void): void {
    make();
    this.told = "";
    this.requestUpdate();
  }

  protected override restyle = (): void => {
    const canvas = this.querySelector("canvas");
    if (!canvas || !this.isConnected) return;
    if (!this.drawing) {
      this.drawing = new Drawing(canvas, (view) =>
        view.showLentoax(this.query),
      );
      this.observer.observe(canvas);
    }
    if (canvas.clientWidth === 0) return;
    this.drawing.restyle();
    this.drawing.use((view) => view.showLentoax(this.query));
  };

  private async copy(text: string): Promise<void> {
    this.told = this.t(copied(await copy(text)));
    this.requestUpdate();
  }
}

customElements.define("tp-lentoax", LentoaxPart);
