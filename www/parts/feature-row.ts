import { html, nothing, type TemplateResult } from "lit";
import { type CycleEntry, defaultJob } from "../core/browser.js";
import type { Feature } from "../cycle-list.js";
import { sizesInWords } from "../sentences.js";
import type { Draft, Store } from "../store.js";
import { w } from "../words.js";
import { Drawing } from "./drawing.js";
import { StorePart } from "./part.js";

/** Small drawing of a cycle. */
class MiniPart extends StorePart {
  protected override storeEvents: string[] = [];
  declare type: CycleEntry["type"];
  private drawing?: Drawing;
  private drawn = "";

  static override properties = { type: { attribute: false } };

  override render(): TemplateResult {
    return html`<canvas class="mini" aria-hidden="true"></canvas>`;
  }

  protected override updated(changed: Map<PropertyKey, unknown>): void {
    super.updated(changed);
    const canvas = this.querySelector<HTMLCanvasElement>("canvas");
    if (this.drawn === this.type || !canvas?.checkVisibility()) return;
    this.drawn = this.type;
    const show = (view: { showSmall(job: unknown): boolean }) =>
      view.showSmall(defaultJob(this.type));
    if (this.drawing) this.drawing.use(show);
    this.drawing ??= new Drawing(canvas, show);
    this.drawing.restyle();
  }

  private readonly repaint = () => this.drawing?.restyle();

  override connectedCallback(): void {
    super.connectedCallback();
    this.store.addEventListener("recolour", this.repaint);
  }

  override disconnectedCallback(): void {
    super.disconnectedCallback();
    this.store.removeEventListener("recolour", this.repaint);
    this.drawing?.free();
    this.drawing = undefined;
    this.drawn = "";
  }
}

customElements.define("tp-mini", MiniPart);

/** Results of a cycle as symbols: `X Y ∠`, or `judged`. */
function givesInWords(store: Store, index: number): string {
  const rows = store.plan.results.filter(
    ({ cycle, value }) => cycle === index && value !== null,
  );
  if (rows.some(({ limits }) => limits !== null)) return store.t("judged");
  const { datum } = store.plan;
  const name = store.plan.cycles[index]?.toLowerCase();
  const axes = datum
    .filter(
      ({ axis, choices }) =>
        axis !== "rotation" &&
        choices.some((one) => one.split(".")[0]?.toLowerCase() === name),
    )
    .map(({ axis }) => axis.toUpperCase());
  const has = (pattern: RegExp) => rows.some(({ code }) => pattern.test(code));
  return [
    ...axes,
    ...(has(/^diameter/) ? ["Ø"] : has(/^width/) ? ["↔"] : []),
    ...(has(/^rotation$/) ? ["∠"] : []),
  ].join(" ");
}

/** Highest level of the findings of a feature. */
function levelOf(
  store: Store,
  place: number,
  now: boolean,
): string | undefined {
  const is = (path: string) => {
    const index = /^cycles\[(\d+)\]/.exec(path)?.[1];
    return index === undefined
      ? now && /^cycle\b/.test(path)
      : store.features.placeOf(Number(index)) === place;
  };
  return ["error", "warning"].find((level) =>
    store.findings.some((f) => f.level === level && is(f.path)),
  );
}

/** A feature of the job with its position in the list. */
interface Row {
  one: Pick<Feature, "name" | "cycle" | "off">;
  place: number;
  count: number;
  /** Whether its form is open. */
  now: boolean;
}

/** Rows for the features of the job; one row for a job with one cycle. */
export function rowsOf(store: Store): Row[] {
  const { features, draft } = store;
  if (!features.several) {
    const cycle = draft.cycle as Draft;
    return [
      { one: { name: "", cycle, off: false }, place: 0, count: 1, now: true },
    ];
  }
  const all = features.inOrder(draft);
  return all.map((one, place) => ({
    one,
    place,
    count: all.length,
    now: place === features.hand,
  }));
}

/** Row of the list: drawing, name, type, sizes and results. The open row also has the buttons that move, copy and remove it. */
export function featureRow(
  store: Store,
  { one, place, count, now }: Row,
): TemplateResult {
  const { several } = store.features;
  const title =
    store.catalog.cycles.find((c) => c.type === one.cycle.type)?.title ?? "";
  const level = several ? levelOf(store, place, now) : undefined;
  const sizes = sizesInWords(store, one.cycle);
  const inPlan = several
    ? store.features.all.slice(0, place).filter(({ off }) => !off).length
    : 0;
  const gives = store.stale || one.off ? "" : givesInWords(store, inPlan);
  const says = [several ? title : "", sizes, one.off ? store.t("left out") : ""]
    .filter(Boolean)
    .join(" · ");
  const words = html`<tp-mini .store=${store} .type=${one.cycle.type as CycleEntry["type"]}></tp-mini><b>${several ? one.name : title}</b><span class="gives">${gives}</span><small>${says}</small>`;
  const drop = (event: DragEvent) => {
    const from = Number(
      event.dataTransfer?.getData("text/x-touchpath-cycle") || Number.NaN,
    );
    event.preventDefault();
    event.stopPropagation();
    if (Number.isInteger(from) && from !== place)
      store.moveFeature(from, place);
  };
  if (!several)
    return html`<button type="button" class="feature gallery" aria-label=${store.t("Gallery")} title=${store.t("Choose the cycle from pictures")} ?disabled=${store.readonly} @click=${(e: Event) => e.target?.dispatchEvent(new CustomEvent("run-action", { bubbles: true, detail: "gallery" }))}>${words}</button>`;
  return html`<div class="head" draggable=${store.readonly ? "false" : "true"}
      @dragstart=${(e: DragEvent) => e.dataTransfer?.setData("text/x-touchpath-cycle", String(place))}
      @dragover=${(e: DragEvent) => e.dataTransfer?.types.includes("text/x-touchpath-cycle") && e.preventDefault()}
      @drop=${drop}>
      <button type="button" class=${`feature ${level ?? ""}`} aria-current=${now ? "true" : nothing} aria-expanded=${now ? "true" : "false"} @click=${() => store.bringFeature(place)}>${words}</button>
      ${now ? acts(store, one.name, place, count, one.off) : nothing}</div>`;
}

/** Icon: two overlapping sheets. */
const TWICE = html`<svg class="sign" viewBox="0 0 16 16" aria-hidden="true"><path d="M2 5h9v9H2zM5 5V2h9v9h-3"></path></svg>`;

/** Name field and buttons of the open feature in a job with several. */
function acts(
  store: Store,
  name: string,
  place: number,
  count: number,
  off: boolean,
): TemplateResult {
  const button = (
    sign: string | TemplateResult,
    label: string,
    does: () => void,
    disabled = false,
  ) =>
    html`<button type="button" class="icon" aria-label=${store.t(label, name)} title=${store.t(label, name)} ?disabled=${disabled || store.readonly} @click=${(
      event: Event,
    ) => {
      event.stopPropagation();
      does();
    }}>${sign}</button>`;
  const rename = (box: HTMLInputElement) => {
    const text = box.value.trim();
    if (text !== "") store.renameFeature(place, text);
    else box.value = store.features.all[place]?.name ?? "";
  };
  return html`<span class="row-actions"><input type="text" maxlength="12" spellcheck="false" aria-label=${store.t("Name of this cycle")} .value=${name} ?disabled=${store.readonly} @change=${(e: Event) => rename(e.target as HTMLInputElement)} />
    ${button("↑", w("{cycle} earlier"), () => store.moveFeature(place, place - 1), place === 0)}
    ${button("↓", w("{cycle} later"), () => store.moveFeature(place, place + 1), place + 1 === count)}
    ${button(TWICE, w("Duplicate {cycle}"), () => store.duplicateFeature(place))}
    ${button(off ? "○" : "●", off ? w("Include {cycle} in the program again") : w("Leave {cycle} out of the program"), () => store.switchFeature(place))}
    ${button("✕", w("Remove {cycle}"), () => store.removeFeature(place))}</span>`;
}
