import { coded } from "./coded.js";
import { attach, instance } from "./instance.js";
import {
  arrival,
  completeNow,
  loadWhole,
  raw as module,
  prebuiltAnswers,
} from "./load.js";
import type { ProgramKnown, ProgramRun } from "./types.js";
import type * as raw from "./wasm/touchpath.js";

export * from "./api.js";
export { say } from "./said.js";
export type * from "./types.js";

const here = () => attach(module, module.__wbg_reset_state, completeNow);
if (prebuiltAnswers) attach(prebuiltAnswers, () => undefined);
else here();
arrival?.then(here, () => undefined);

/** Arrival of the module if the page is shown before it; null afterwards. @internal */
export function awaited(): Promise<void> | null {
  return arrival;
}

/** Loads the second part of the module if the page has started with the first. @internal */
export function whole(): Promise<void> {
  return loadWhole();
}

/** Members of the module's picture that a host page may use. */
type Shown = Pick<
  raw.View,
  | "fit"
  | "focus"
  | "free"
  | "highlight"
  | "look"
  | "magnify"
  | "pan"
  | "pick"
  | "play"
  | "resize"
  | "setTheme"
  | "showProgram"
  | "svg"
  | "zoom"
>;

/**
 * The picture of a job on a canvas. It belongs to the instance of the module that made it: if that instance failed, every call throws and a new View is needed.
 */
export interface View extends Shown {
  /** Shows a job. A job with errors leaves the picture as it is and returns `false`. */
  show(job: unknown): boolean;
  /** Shows a job as a small picture: isometric, without axes, numbers and handles. */
  showSmall(job: unknown): boolean;
  /**
   * Shows the answer to a LENTOAX query: the axes of the coordinate system, the lengths as arrows and, for a rotated workpiece system, the base axes. An
   * invalid query leaves the picture as it is and returns `false`.
   */
  showLentoax(query?: unknown): boolean;
}

/** The View of Touchpath's own page: also handles, dimensions and overlays. @internal */
export class PageView extends module.View implements View {
  private readonly madeBy: number;

  constructor(canvas: HTMLCanvasElement) {
    instance.ready();
    super(canvas);
    this.madeBy = instance.number;
  }

  show(job: unknown): boolean {
    const { codes, text } = coded(job);
    return this.showCoded(codes, text);
  }

  showSmall(job: unknown): boolean {
    const { codes, text } = coded(job);
    return this.showSmallCoded(codes, text);
  }

  showLentoax(query?: unknown): boolean {
    const { codes, text } = coded(query);
    return this.showLentoaxCoded(codes, text);
  }

  /** Shows the moves of a run on the part of its inputs. */
  showRun(run: ProgramRun, known: ProgramKnown): void {
    const { codes, text } = coded(known);
    this.showRunCoded(run, codes, text);
  }

  /** Grips an end of the dimension line of a field at a pixel, for the job that is shown. Returns false if it cannot be dragged. */
  gripEnd(
    job: unknown,
    field: string,
    end: 0 | 1,
    x: number,
    y: number,
  ): boolean {
    const { codes, text } = coded(job);
    return this.gripEndCoded(codes, text, field, end, x, y);
  }

  /** A View whose instance is gone has nothing left to free. */
  override free(): void {
    instance.ready();
    if (this.madeBy === instance.number) super.free();
  }

  /** Runs a method in this View's own instance. A failure there breaks all Views of it. */
  static run(
    view: PageView,
    method: (...args: unknown[]) => unknown,
    args: unknown[],
  ): unknown {
    instance.ready();
    if (view.madeBy !== instance.number)
      throw new Error(
        "This View's instance of the module is gone: make a new View",
      );
    return instance.call(() => method.apply(view, args));
  }
}

for (const [name, { value: method }] of Object.entries(
  Object.getOwnPropertyDescriptors(module.View.prototype),
)) {
  if (
    name === "constructor" ||
    name === "free" ||
    name.startsWith("__") ||
    typeof method !== "function"
  )
    continue;
  Object.defineProperty(PageView.prototype, name, {
    configurable: true,
    writable: true,
    value(this: PageView, ...args: unknown[]): unknown {
      return PageView.run(this, method, args);
    },
  });
}
const { dispose } = Symbol as { dispose?: symbol };
if (dispose)
  Object.defineProperty(PageView.prototype, dispose, {
    value: PageView.prototype.free,
  });

/** A picture on your own canvas. */
export const View: new (canvas: HTMLCanvasElement) => View = PageView;
