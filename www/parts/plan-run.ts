import {
  moveInShort,
  moveInWords,
  pathInWords,
  runInWords,
} from "../sentences.js";
import type { Store } from "../store.js";
import type { Run } from "./timeline.js";

/** The moves of the plan, for the timeline. */
export class PlanRun implements Run {
  constructor(private readonly store: () => Store) {}

  /** While the form has errors the last valid plan is shown, and cannot be stepped through. */
  get count(): number {
    const { stale, plan } = this.store();
    return stale ? 0 : plan.moves.length;
  }

  get at(): number | null {
    return this.count === 0 ? null : this.store().highlight;
  }

  get touches(): number[] {
    return this.store().plan.moves.flatMap((move, i) =>
      move.kind === "touch" ? [i + 1] : [],
    );
  }

  get chapters(): number[] {
    const { moves } = this.store().plan;
    return moves.flatMap(({ cycle }, i) =>
      i > 0 && cycle !== moves[i - 1]?.cycle ? [i] : [],
    );
  }

  point(move: number | null): void {
    this.store().pin(move);
  }

  words(move: number | null, short: boolean): string {
    const store = this.store();
    const ends = store.findings.some(({ code }) => code === "collision")
      ? store.t("The run ends in the part")
      : "";
    if (store.stale) return ends;
    if (move !== null)
      return short ? moveInShort(store, move) : moveInWords(store, move);
    const whole = short ? pathInWords(store) : runInWords(store);
    return ends ? `${whole} · ${ends}` : whole;
  }
}
