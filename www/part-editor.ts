// Edits the features of the job: their order, what they follow, and the tolerances of their results.
import {
  type Cycle,
  proposedStock,
  type ResultTolerance,
} from "./core/browser.js";
import type { CycleList } from "./cycle-list.js";
import { alike, type Draft, isObject, putAt } from "./job.js";
import { Machine } from "./machine.js";
import { placedBeside } from "./place-feature.js";
import { type ReadySetUp, readySetUps } from "./set-ups.js";
import { w } from "./words.js";

/** Changes the list of features. */
export abstract class PartEditor extends Machine {
  protected ready?: { revision: number; setUps: ReadySetUp[] };

  /** Ready set-ups that suit the machine of the job. Planned on first use, once per state of the job. */
  get readySetUps(): ReadySetUp[] {
    if (this.ready?.revision !== this.revision)
      this.ready = { revision: this.revision, setUps: readySetUps(this) };
    return this.ready.setUps;
  }

  /** Starts a job from the ready set-up with this key. */
  beginSetUp(key: string): void {
    const job = this.readySetUps.find((one) => one.entry.key === key)?.job;
    if (!job) return;
    const { form } = this.draft.control as Draft;
    this.load(job, "", this.editedPaths);
    if ((job.control as Draft).form !== form)
      this.announce([
        w(
          "The program uses moves: native cycles cannot compute with each other's results",
        ),
      ]);
  }

  /**
   * Adds a cycle of this type after the active one and makes it active. It is placed beside the other features, with the sizes of the last one of its type.
   * Stock that fits the features is enlarged to fit the new one.
   */
  addFeature(type: Cycle["type"]): void {
    const fresh = this.freshOf(type) as { cycle: Draft };
    const last = this.features.lastOf(this.draft, type);
    const cycle = placedBeside(this, this.plan, fresh.cycle, last);
    const { stock } = this.draft;
    const fixed = this.fixed();
    const isFixed = ["origin", "size"].some((key) => fixed.has(`stock.${key}`));
    const fits = stock && !isFixed && alike(stock, proposedStock(this.job));
    this.arrange(() => {
      this.features.add(this.draft, cycle);
      this.features.activate(this.draft, this.features.hand + 1);
      if (fits) this.draft.stock = proposedStock(this.job) ?? stock;
    });
  }

  /** Duplicates a feature and makes the copy active. */
  duplicateFeature(index: number): void {
    this.arrange(() => {
      this.features.activate(this.draft, index);
      const { cycle, part, tolerances } = structuredClone(this.draft) as Record<
        string,
        Draft
      >;
      this.features.add(this.draft, cycle as Draft, {
        sizes: part?.sizes as Draft,
        tolerances: tolerances ?? {},
      });
      this.features.activate(this.draft, index + 1);
    });
  }

  removeFeature(index: number): void {
    this.arrange(() => this.features.remove(this.draft, index));
  }

  moveFeature(from: number, to: number): void {
    this.arrange(() => this.features.move(this.draft, from, to));
  }

  renameFeature(index: number, name: string): void {
    this.arrange(() => this.features.rename(this.draft, index, name, true));
  }

  /** Includes or excludes a feature. At least one is always included. */
  switchFeature(index: number): void {
    const { all } = this.features;
    const one = all[index];
    if (!one || (!one.off && all.filter(({ off }) => !off).length === 1))
      return;
    this.arrange(() => {
      this.features.storeActive(this.draft);
      this.features.all[index] = {
        ...(this.features.all[index] as typeof one),
        off: !one.off,
      };
    });
  }

  /** Makes the cycle at this index active. The job itself does not change. */
  bringFeature(index: number): void {
    if (!this.features.several || index === this.features.hand) return;
    this.features.activate(this.draft, index);
    this.typed.clear();
    this.focus(null);
    this.changed();
  }

  /** Sets the result that an axis is written from: a code, `null` for none, `undefined` for the proposed one. */
  writeFrom(axis: string, from: string | null | undefined): void {
    this.arrange(() => {
      const { [axis]: _, ...rest } = this.features.datum;
      this.features.datum =
        from === undefined ? rest : { ...rest, [axis]: from };
    });
  }

  /** Makes a field follow a result. A followed position requires a limit: without one, sets 2 mm (0.08 inch) and announces it. */
  follow(path: string, result: string): void {
    const proposed = this.units === "inch" ? 0.08 : 2;
    const limits = this.draft.limits as Draft;
    const fixed = this.fixed();
    if (fixed.has(path)) return;
    const needs =
      path.startsWith("cycle.origin") &&
      limits.position === null &&
      !fixed.has("limits.position");
    this.arrange(() => {
      putAt(this.draft, path, result);
      this.typed.delete(path);
      if (needs) putAt(this.draft, "limits.position", proposed);
    });
    if (needs)
      this.announce([
        w("{what} is followed up to {limit} away: Position limit"),
        result.slice(1),
        `${proposed} ${this.units}`,
      ]);
  }

  /** Sets the height of the clearance plane between the cycles. */
  clearAt(height: number | null): void {
    this.arrange(() => {
      this.features.clear = height;
    });
  }

  /** Changes the relations between results. */
  relate(change: (features: CycleList) => void): void {
    this.arrange(() => {
      const { features, draft } = this;
      features.storeActive(draft);
      change(features);
      // A field that follows a relation gets its new name, in the form too.
      draft.cycle = features.all[features.hand]?.cycle ?? draft.cycle;
    });
  }

  /** Tolerances of a result's cycle; those of the active cycle are in the form. Undefined for a cycle that is no longer in the program. */
  protected toleratedOf(
    cycle: number,
  ): { tolerances: Draft; keep: (tolerances: Draft) => void } | undefined {
    const { features, draft, plan } = this;
    // Looks up by name: while the form has errors, the plan may have another order.
    const name = [...plan.cycles, ...plan.relations][cycle]?.toLowerCase();
    const named = (one: { name: string }) => one.name.toLowerCase() === name;
    const own = [...features.all, ...features.relations].find(named);
    if (!features.several || own === features.all[features.hand]) {
      const keep = (tolerances: Draft) => {
        draft.tolerances = tolerances;
      };
      return { tolerances: (draft.tolerances ?? {}) as Draft, keep };
    }
    if (!own) return undefined;
    const keep = (tolerances: Draft) => {
      own.tolerances = tolerances;
    };
    return { tolerances: own.tolerances, keep };
  }

  /** Tolerance of a result of the plan; undefined without one. */
  tolerance(cycle: number, code: string): ResultTolerance | undefined {
    return this.toleratedOf(cycle)?.tolerances[code] as
      | ResultTolerance
      | undefined;
  }

  /** Text of a size that contains a tolerance, by cycle of the plan and code of the result; null if the size is a number or follows a result. */
  sizeWithTolerance(cycle: number, code: string): string | null {
    const { features, draft } = this;
    const own = features.several
      ? features.inOrder(draft)[features.placeOf(cycle)]?.cycle
      : (draft.cycle as Draft);
    const entry = this.catalog.cycles.find(({ type }) => type === own?.type);
    const size = entry?.fields.find(
      ({ key, size, kind }) => size && kind === "number" && key === code,
    );
    const value = size && own?.[code];
    return typeof value === "string" && !value.trimStart().startsWith("=")
      ? value
      : null;
  }

  /** Sets or removes the tolerances of several results of a cycle in one undo step. */
  tolerate(
    cycle: number,
    changes: Record<string, ResultTolerance | undefined>,
  ): void {
    if (this.refuses) return;
    this.mark(`tolerances.${cycle}.${Object.keys(changes)}`);
    const own = this.toleratedOf(cycle);
    const all = { ...own?.tolerances, ...changes };
    own?.keep(
      Object.fromEntries(
        Object.entries(all).filter(
          ([, one]) => isObject(one) && Object.keys(one).length > 0,
        ),
      ),
    );
    this.changed();
  }

  /** Changes the list of cycles in one undo step. */
  protected arrange(change: () => void): void {
    if (this.refuses) return;
    this.settle();
    this.mark(null);
    const before = this.draft.cycle;
    change();
    if (this.draft.cycle !== before) {
      this.typed.clear();
      this.pinned = null;
      this.highlight = null;
    }
    this.editedPaths?.add("cycle");
    this.settle();
    this.changed();
  }
}
