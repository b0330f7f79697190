// The job in the form: its values, who may change it, and undo.
import {
  type Cycle,
  convertUnits,
  defaultJob,
  type FieldEntry,
  JobError,
  jobName,
  type Message,
  type Words,
} from "./core/browser.js";
import type { ChangeReason } from "./core/events.js";
import { byCode, type SetUpState } from "./cycle-list.js";
import type { Units } from "./entries.js";
import { LockedFields } from "./fixed.js";
import { History } from "./history.js";
import { alike, complete, type Draft, dropAt, isObject, putAt } from "./job.js";
import { tidy } from "./number.js";
import { Output } from "./output.js";
import type { Reading } from "./read-text.js";
import type { Rules } from "./rules.js";
import { type Lang, w } from "./words.js";

/** State of a cycle that is restored when the user chooses it again. */
export interface SavedCycle {
  units: Units;
  cycle: Draft;
  points: Points;
  /** Size deviations of the virtual part. */
  sizes?: Draft;
  /** The tolerances of its results. */
  tolerances?: Draft;
}

/** Measured points as text, by the units they were typed in. In other units the same text would mean other points. */
export type Points = Record<Units, string>;
export const noPoints = (): Points => ({ mm: "", inch: "" });

/** Message for a change that is refused because the job is read-only. */
export const LOOK_ONLY: Message = [
  w("Nothing was changed: this job is read-only"),
];

/** Path of the limit for the deviation of a measured size. */
const SIZE_LIMIT = "limits.size";

/** Everything that a user can change, at one moment. */
interface Snapshot {
  draft: Draft;
  typed: [string, string][];
  points: Points;
  left: [string, SavedCycle][];
  given: string[] | null;
  document: number;
  features: SetUpState;
}

/** The job in the form. Every change goes through this class. */
export abstract class Document extends Output {
  /** The job in the form, errors included. */
  draft!: Draft;
  /** The text of number fields as it was typed, by path: `1,5` stays `1,5`. */
  typed = new Map<string, string>();
  /** Measured points of this job. */
  protected points = noPoints();
  /** Whether the host page set them. The user's undo then leaves them as they are. */
  protected pointsGiven = false;
  /** Paths with a value that was set; the other fields still have their defaults. Null for a job that was loaded whole. */
  protected editedPaths: Set<string> | null = new Set();
  /** State of the cycles that were left, restored when the user chooses one again. */
  protected left = new Map<string, SavedCycle>();
  protected readonly history = new History<Snapshot>();
  /** Whether the size limit follows from the tolerances of the next plan. */
  private limitFollows = false;
  /** Whether the user cannot change the job. The host page still can. */
  protected readOnly = false;
  /** Whether the current change is by the host page. */
  protected host = false;
  /** Cause of the user's current change. */
  private userReason: Exclude<ChangeReason, "host"> = "edit";
  /** Whether the user's steps are kept for undo; otherwise the host page has its own. */
  private stepsKept = true;
  /** The default name of the job: while the job has it, the name follows what is measured. Null for another job. */
  protected automaticName: string | null = null;
  /** The number of documents so far. */
  protected documents = 0;
  /** Control settings with a work offset that the current control does not have. It returns with a control that has it. */
  protected controlWithOffset: Draft | null = null;
  /** Control settings of the job before this one. */
  protected beforeControl: Draft | null = null;

  /** The rules of the host page. */
  get rules(): Rules {
    return this.outside.rules;
  }

  /** The whole job: the form itself for one cycle, all cycles for a set-up. */
  get job(): Draft {
    return this.features.compose(this.draft);
  }

  /** Whether the user cannot change the job. */
  get readonly(): boolean {
    return this.readOnly;
  }

  set readonly(shut: boolean) {
    if (shut === this.readOnly) return;
    this.readOnly = shut;
    this.asHost(() => this.dispatchEvent(new Event("change")));
  }

  /** Clears the undo history. */
  clear(): void {
    this.history.clear();
  }

  /** Whether the user's steps can be undone here; otherwise the host page has its own undo. */
  get keepsHistory(): boolean {
    return this.stepsKept;
  }

  set keepsHistory(keeps: boolean) {
    if (keeps === this.stepsKept) return;
    this.stepsKept = keeps;
    this.clear();
    this.asHost(() => this.dispatchEvent(new Event("change")));
  }

  /** Whether the current change is by the user, not by the host page. */
  get userChange(): boolean {
    return !this.host;
  }

  /** Cause of the current change. */
  get changeReason(): ChangeReason {
    return this.host ? "host" : this.userReason;
  }

  /** Runs a change by the host page: it adds no undo step and ignores locks and read-only. */
  asHost<T>(change: () => T): T {
    const before = this.host;
    this.host = true;
    try {
      return change();
    } finally {
      this.host = before;
    }
  }

  /** Whether a change is the user's and the job is read-only. */
  protected get refuses(): boolean {
    return this.readOnly && this.userChange;
  }

  get measured(): string {
    return this.points[this.units];
  }

  set measured(text: string) {
    // A change by the host page is no undo step.
    if (this.userChange) this.mark("measured");
    this.pointsGiven = !this.userChange;
    this.points = { ...this.points, [this.units]: text };
    this.keep();
    this.dispatchEvent(new Event("change"));
  }

  /** Loads the points of an opened log. */
  openPoints(text: string): void {
    this.settle();
    this.measured = text;
    this.settle();
  }

  /** Sets a value; every keystroke ends here. Changes of one path are one undo step until `settle`. */
  set(path: string, value: unknown, typed?: string): void {
    const fixed = this.fixed();
    if (this.refuses || fixed.has(path)) return;
    this.mark(path);
    this.editedPaths?.add(path.replace(/\[\d\]$/, ""));
    // The user's choice replaces the remembered work offset, also if it is "none".
    if (path === "control.workOffset") this.controlWithOffset = null;
    if (typed === undefined) this.typed.delete(path);
    else this.typed.set(path, typed);
    this.limitFollows ||=
      !fixed.has(SIZE_LIMIT) && this.changesLimit(path, value);
    putAt(this.draft, path, value);
    if (typeof value === "number") this.untolerate(path);
    if (path === SIZE_LIMIT) this.limitFollows = false;
    fixed.keep(this.draft);
    // Text that was typed inside a value that has been replaced.
    if (typeof value === "object")
      for (const inside of [`${path}.`, `${path}[`]) this.forget(inside);
    this.changed();
  }

  /** Whether a new value of the field at this path may change the size limit: the value or a size before it has a tolerance, and nobody entered a limit. */
  private changesLimit(path: string, value: unknown): boolean {
    if (this.editedPaths === null || this.editedPaths.has(SIZE_LIMIT))
      return false;
    if (!path.startsWith("cycle.") || !this.fieldAt(path)?.size) return false;
    const usual = this.usualSizeLimit();
    if (!alike(this.get(SIZE_LIMIT), usual)) return false;
    return typeof value === "string" || usual !== this.leastSizeLimit();
  }

  protected override get toPlan(): Draft {
    if (!this.limitFollows) return this.job;
    const job = structuredClone(this.job);
    dropAt(job, SIZE_LIMIT);
    return job;
  }

  /** The size limit of a new job. */
  private leastSizeLimit(): number {
    return Number(this.initialValue(this.fieldAt(SIZE_LIMIT) as FieldEntry));
  }

  /** The size limit that follows from the plan: that of a new job, plus the largest deviation that a tolerance allows. */
  private usualSizeLimit(): number {
    const sizes = this.catalog.cycles.flatMap(({ fields }) =>
      fields.filter(({ size, unit }) => size && unit === "length"),
    );
    const reach = this.plan.results
      .filter(({ code }) => sizes.some(({ key }) => key === code))
      .flatMap(({ limits, nominal }) =>
        (limits ?? []).map((limit) => Math.abs(limit - (nominal ?? limit))),
      );
    return tidy(this.leastSizeLimit() + Math.max(0, ...reach));
  }

  /** Puts the size limit that follows from the plan into the job, and plans the job with it. Without a plan the job keeps its limit. */
  private followLimit(): void {
    if (!this.limitFollows || this.stale) return;
    this.limitFollows = false;
    putAt(this.draft, SIZE_LIMIT, this.usualSizeLimit());
    this.compute();
  }

  /** Removes the action and wear correction of a size that no longer has a tolerance. */
  protected untolerate(path: string): void {
    const [, code = ""] = /^cycle\.(\w+)$/.exec(path) ?? [];
    const all = this.draft.tolerances as Draft | undefined;
    const entry = all?.[code];
    if (isObject(entry) && entry.tolerance === undefined) {
      const { [code]: _, ...rest } = all as Draft;
      this.draft.tolerances = rest;
    }
  }

  /** Fields locked by the host page. A locked field with a wrong value can be changed. */
  protected fixed(bare = false): LockedFields {
    const wrong = new Set(
      this.findings
        .filter(({ code }) => code === "locked")
        .map(({ path }) => path),
    );
    const locked = this.userChange ? this.rules.locked(bare) : [];
    return new LockedFields(
      this.draft,
      locked.filter((path) => !wrong.has(path)),
    );
  }

  /** Sets a value in one undo step, such as a choice from a menu. */
  put(path: string, value: unknown): void {
    this.settle();
    this.set(path, value);
    this.settle();
  }

  /** Puts the virtual part to its nominal position and sizes. */
  putNominal(): void {
    this.put("part", { offset: [0, 0, 0], rotation: 0, sizes: {} });
  }

  /** Removes a key from the job. */
  drop(path: string): void {
    if (this.refuses) return;
    this.mark(null);
    dropAt(this.draft, path);
    this.forget(path);
    this.changed();
  }

  /** Shows the number of a field instead of the expression that was typed. */
  tidy(path: string): void {
    if (this.typed.delete(path)) this.changed();
  }

  protected forget(prefix: string): void {
    for (const path of [...this.typed.keys()])
      if (path.startsWith(prefix)) this.typed.delete(path);
  }

  /** Converts the job to other units. The geometry stays the same. */
  setUnits(units: Units): void {
    if (this.refuses) return;
    if (units === this.draft.units) return;
    this.mark(null);
    // Values without valid units cannot be converted: they keep their numbers and get the new units.
    const known = this.draft.units === "mm" || this.draft.units === "inch";
    const old = this.draft;
    const untouched = known ? this.untouched() : [];
    this.draft = known
      ? (convertUnits(old, units) as unknown as Draft)
      : { ...old, units };
    if (known) this.features.convert(old.units as Units, units);
    for (const [path, field] of untouched)
      putAt(this.draft, path, structuredClone(this.initialValue(field, units)));
    this.typed.clear();
    this.changed();
  }

  /** Fields that still have the defaults of a new job. */
  protected untouched(): [string, FieldEntry][] {
    const { editedPaths: given } = this;
    if (!given) return [];
    const isGiven = (path: string) =>
      [...given].some((one) => path === one || path.startsWith(`${one}.`));
    const locked = this.rules.locked();
    return [...this.metric()].filter(
      ([path, field]) =>
        !isGiven(path) &&
        !locked.includes(path) &&
        alike(this.get(path), this.initialValue(field)),
    );
  }

  /** Ends the current undo step. */
  settle(): void {
    this.history.settle();
  }

  get canUndo(): boolean {
    return !this.readOnly && this.history.canUndo;
  }

  get canRedo(): boolean {
    return !this.readOnly && this.history.canRedo;
  }

  /** Undoes the last step: a field, a drag, an opened file or a reset. */
  undo(): void {
    this.goTo("undo");
  }

  redo(): void {
    this.goTo("redo");
  }

  private goTo(step: "undo" | "redo"): void {
    if (this.refuses) return;
    const moment = this.history[step](() => this.moment());
    this.because(step, () => this.become(moment));
  }

  /** Makes a change of the user with this cause. */
  private because(
    reason: Exclude<ChangeReason, "host">,
    change: () => void,
  ): void {
    this.userReason = reason;
    try {
      change();
    } finally {
      this.userReason = "edit";
    }
  }

  protected moment(): Snapshot {
    const { typed, points, left, editedPaths: given, document } = this;
    return {
      draft: structuredClone(this.draft),
      typed: [...typed],
      points: { ...points },
      left: [...left],
      given: given && [...given],
      document,
      features: this.features.state(),
    };
  }

  /** Called before a change. Changes of the same path share an undo step. */
  protected mark(changing: string | null): void {
    if (this.keepsHistory) this.history.mark(changing, () => this.moment());
  }

  /** Restores an earlier state. */
  protected become(moment: Snapshot | undefined): void {
    if (!moment) return;
    const fixed = this.fixed(true);
    this.limitFollows = false;
    this.draft = moment.draft;
    this.features.restoreSnapshot(moment.features);
    fixed.keep(this.draft);
    this.typed = new Map(moment.typed);
    if (!this.pointsGiven) this.points = moment.points;
    this.left = new Map(moment.left);
    this.editedPaths = moment.given && new Set(moment.given);
    this.document = moment.document;
    this.automaticName = null;
    this.pinned = null;
    this.highlight = null;
    this.changed();
  }

  /** Reports a side effect of a change to the user. */
  protected announce(said: Message): void {
    this.dispatchEvent(new CustomEvent("announcement", { detail: said }));
  }

  /** Changes the language of the page. Does not change the job. */
  translate(lang: Lang, words: Words): void {
    this.asHost(() => {
      this.speak(lang, words);
      this.dispatchEvent(new Event("change"));
    });
  }

  /** Checks the job again after the rules of the host page have changed. */
  reconsider(): void {
    this.changed();
  }

  protected changed(): void {
    this.nameAnew();
    this.compute();
    this.followLimit();
    this.keep();
    this.dispatchEvent(new Event("change"));
  }

  /** Updates the program name, unless the user has typed one. */
  protected nameAnew(): void {
    const name = jobName(this.job);
    if (this.automaticName !== null && this.draft.name === this.automaticName)
      this.draft.name = name;
    this.automaticName = name;
  }

  /** The default job of a cycle in the job's units, filled in by the rules of the host page. */
  protected freshOf(type: Cycle["type"]): Draft {
    return this.rules.laid(
      structuredClone(defaultJob(type, this.units)) as unknown as Draft,
    );
  }

  /** Loads a whole job that fits the form. `given`: the paths that were set. */
  load(job: Draft, measured = "", given: Set<string> | null = null): void {
    if (this.refuses) return;
    const fixed = this.fixed(true);
    this.mark(null);
    this.document = ++this.documents;
    this.beforeControl = null;
    this.controlWithOffset = null;
    this.automaticName = null;
    this.limitFollows = false;
    this.editedPaths = given;
    this.draft = this.formOf(job);
    fixed.keep(this.draft);
    this.points = { ...noPoints(), [this.units]: measured };
    this.left = new Map(
      [...this.left].map(([type, left]) => [
        type,
        { ...left, points: noPoints() },
      ]),
    );
    this.typed.clear();
    this.pinned = null;
    this.highlight = null;
    this.because("open", () => this.changed());
  }

  /** The form of a job. For a set-up it is that of the first cycle; the list keeps the others. */
  protected formOf(job: Draft): Draft {
    const several = Array.isArray(job.cycles);
    const { tolerances } = job;
    const single = several
      ? this.features.take(job, this.catalog)
      : {
          ...job,
          ...(isObject(tolerances) ? { tolerances: byCode(tolerances) } : {}),
        };
    if (!several) this.features.alone();
    return complete(this.outside.filled(single) as Draft, this.catalog);
  }

  /** Replaces the document and clears undo and the cycles that were left. */
  replace(whole: Draft): void {
    if (this.refuses) return;
    const same =
      alike((whole.cycle as Draft | undefined)?.type, this.cycle.type) &&
      whole.units === this.draft.units;
    this.load(whole, same ? this.measured : "");
    this.left = new Map();
    this.clear();
  }

  /** Loads the job of a link. Throws `JobError` and changes nothing if the form cannot show it. */
  take(job: unknown, measured: string): void {
    if (this.refuses) throw this.refusal(LOOK_ONLY);
    const problem = this.unusable(job);
    if (problem)
      throw this.refusal([
        w(
          "Nothing was changed: the job of this link cannot be used: {problem}",
        ),
        problem,
      ]);
    this.load(job as Draft, measured);
  }

  /** Loads the job of a text that was read. Throws `JobError` and changes nothing if the text has no job or the form cannot show it. */
  open({ imported, findings }: Reading): void {
    if (this.refuses) throw this.refusal(LOOK_ONLY);
    if (!imported) throw new JobError(findings[0]?.message ?? "", findings);
    const problem: Message | null =
      imported.kind === "moves"
        ? [w("this program contains no job")]
        : this.unusable(imported.job);
    if (problem)
      throw this.refusal(
        [w("Nothing was changed: {problem}"), problem],
        findings,
      );
    this.load(
      this.outside.ofText(imported.job as unknown as Draft, imported.findings),
    );
  }

  /** Stores the state in this browser, if it is stored at all. */
  protected abstract keep(): void;
}
