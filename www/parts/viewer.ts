// The moves of any program: drawn, and told apart. Nothing is checked here, and no job is made of it.
import { html, nothing, type PropertyValues, type TemplateResult } from "lit";
import type { ProgramMoves } from "../core/browser.js";
import { Drawing, VIEWS } from "./drawing.js";
import { Part } from "./part.js";

class ViewerPart extends Part {
  viewed!: { text: string; moves: ProgramMoves };
  protected override follows: string[] = [];
  private drawing?: Drawing;
  private drawn?: object;
  private look: (typeof VIEWS)[number] = "top";
  private pointed: number | null = null;
  private grip: { x: number; y: number } | null = null;
  private readonly observer = new ResizeObserver(() => this.drawing?.dress());
  private readonly dark = matchMedia("(prefers-color-scheme: dark)");
  private readonly recolour = () => this.drawing?.dress();

  static override properties = { viewed: { attribute: false } };

  override render(): TemplateResult {
    const { moves } = this.viewed;
    return html`
      <div class="see">
        <div class="tools" role="toolbar" aria-label="Picture of the program">
          ${VIEWS.map((name) => html`<button type="button" aria-pressed=${this.look === name ? "true" : "false"} @click=${() => this.turn(name)}>${name}</button>`)}
          <span class="gap"></span>
          <button type="button" aria-label="Zoom out" @click=${() => this.drawing?.zoom(1 / 1.4)}>−</button>
          <button type="button" aria-label="Zoom in" @click=${() => this.drawing?.zoom(1.4)}>+</button>
          <button type="button" @click=${() => this.drawing?.use((view) => view.fit())}>fit</button>
        </div>
        <canvas tabindex="0" role="img" aria-label=${this.says()} @pointerdown=${this.down} @pointermove=${this.move}
          @pointerup=${this.up} @pointercancel=${this.up} @keydown=${(e: KeyboardEvent) => this.drawing?.key(e)}></canvas>
        <p role="status">${this.pointed === null ? this.says() : this.one(this.pointed)}</p>
        <ul class="key" aria-label="Colours">
          <li class="touch">probing</li><li class="link">feed</li><li class="rapid">rapid</li>
        </ul>
        <p>Nothing of it is checked or proven: it is what its words say.</p>
        ${moves.findings.length > 0 ? html`<ul class="notes">${moves.findings.map((f) => html`<li>${f.message}</li>`)}</ul>` : nothing}
      </div>
      <pre class="code" tabindex="0" aria-label="The program">${this.viewed.text}</pre>
    `;
  }

  override connectedCallback(): void {
    super.connectedCallback();
    this.dark.addEventListener("change", this.recolour);
  }

  override disconnectedCallback(): void {
    super.disconnectedCallback();
    this.dark.removeEventListener("change", this.recolour);
    this.observer.disconnect();
    this.drawing?.free();
    this.drawing = undefined;
    this.drawn = undefined;
  }

  protected override firstUpdated(): void {
    this.canvas().addEventListener("wheel", (event) => this.drawing?.wheel(event), { passive: false });
  }

  protected override updated(_changed: PropertyValues): void {
    if (!this.drawing && this.isConnected) {
      const canvas = this.canvas();
      this.drawing = new Drawing(canvas, (view) => {
        view.look(this.look);
        view.showProgram(this.viewed.text);
      });
      this.observer.observe(canvas);
    }
    this.drawing?.use((view) => {
      if (this.drawn && this.drawn !== this.viewed) view.showProgram(this.viewed.text);
      view.highlight(this.pointed ?? undefined);
    });
    this.drawn = this.viewed;
  }

  private canvas(): HTMLCanvasElement {
    return this.querySelector("canvas") as HTMLCanvasElement;
  }

  private says(): string {
    const { kind, kinds, units, dialect } = this.viewed.moves;
    const probing = kind.filter((k) => kinds[k] === "probe").length;
    const read = dialect === "sinumerik" ? "SINUMERIK" : "ISO";
    return `${kind.length} moves, ${probing} of them probing; ${units ?? "units not said"}; read as ${read}`;
  }

  private one(index: number): string {
    const { to, kind, kinds, feed, line } = this.viewed.moves;
    const place = ["X", "Y", "Z"].flatMap((axis, i) => {
      const x = to[3 * index + i] as number;
      return Number.isNaN(x) ? [] : [`${axis}${Number(x.toFixed(4))}`];
    });
    const rate = feed[index] as number;
    const words = [kinds[kind[index] as number], `to ${place.join(" ")}`, Number.isNaN(rate) ? "" : `at ${rate}`];
    return `Line ${(line[index] as number) + 1}: ${words.filter(Boolean).join(" ")}`;
  }

  private turn(name: (typeof VIEWS)[number]): void {
    this.look = name;
    this.drawing?.use((view) => view.look(name));
    this.requestUpdate();
  }

  private down(event: PointerEvent): void {
    this.canvas().setPointerCapture(event.pointerId);
    this.grip = { x: event.offsetX, y: event.offsetY };
  }

  private move(event: PointerEvent): void {
    const { offsetX: x, offsetY: y } = event;
    if (this.grip) {
      const [dx, dy] = [x - this.grip.x, y - this.grip.y];
      this.drawing?.use((view) => view.pan(dx, dy));
      this.grip = { x, y };
      return;
    }
    const pointed = this.drawing?.use((view) => view.pick(x, y)) ?? null;
    if (pointed === this.pointed) return;
    this.pointed = pointed;
    this.requestUpdate();
  }

  private up(): void {
    this.grip = null;
  }
}

customElements.define("tp-viewer", ViewerPart);
