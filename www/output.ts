// Computes from the job: its plan, findings, and the names and sentences of files.
import {
  check,
  type Finding,
  type Job,
  JobError,
  type Message,
  misfit,
  type Plan,
  plan,
} from "./core/browser.js";
import { LEVELS } from "./core/layout.js";
import { programStem, stem } from "./core/names.js";
import { codeOf } from "./core/results.js";
import { CycleList } from "./cycle-list.js";
import { CatalogView } from "./entries.js";
import type { HostInputs } from "./host-inputs.js";
import type { Draft } from "./job.js";
import { keepFiles } from "./persistence.js";
import { w } from "./words.js";

/** The plan before any valid plan of the document. */
const NO_PLAN: Plan = {
  touches: [],
  moves: [],
  cycles: [],
  relations: [],
  datum: [],
  length: 0,
  time: 0,
  program: {
    post: "",
    extension: "",
    text: "",
    moveLines: [],
    writes: [],
    does: "",
    said: [""],
    proof: null,
    own: false,
  },
  table: [],
  results: [],
  triggers: [],
  findings: [],
  safety: [],
};

/** Hash of the blocks of a program, from its header; the whole text for a program without one. */
const contentOf = (text: string): string =>
  /^\W*(?:\d+ ; )?Blocks below: (\w+)/im.exec(text)?.[1] ?? text;

/** The plan of the job in the form, and the highlighted move. */
export abstract class Output extends CatalogView {
  /** The cycles of a set-up; the form has the active one. */
  readonly features = new CycleList();
  /** Findings with their paths in the form. */
  findings: Finding[] = [];
  /** The same with their paths in the whole job. */
  wholeFindings: Finding[] = [];
  /** Last valid plan of this document; empty if no plan was valid. */
  plan: Plan = NO_PLAN;
  /** Name of the program that was saved last. */
  saved: string | null = null;
  /** Increases with every state of the job, with or without errors. */
  revision = 0;
  /** Number of the document. Opening, reset and another cycle increase it; undo restores it. */
  document = 0;
  /** Whether `plan` belongs to an earlier state because the job has errors. */
  stale = false;
  /** The document of `plan`. */
  protected planned = -1;
  /** The job of `plan`. */
  shown!: Draft;
  /** The highlighted move: the one under the pointer, else the selected one. */
  highlight: number | null = null;
  /** The selected move, highlighted while nothing is pointed at. */
  protected pinned: number | null = null;
  /** Path of the focused field. */
  focused: string | null = null;
  /** Contents of saved files, by name. */
  protected files = new Map<string, string>();

  /** Inputs of the host page. */
  abstract readonly outside: HostInputs;

  /** The whole job. */
  abstract get job(): Draft;

  /** Whether the state is stored in this browser. */
  protected abstract readonly local: boolean;

  /** The job to plan, without values that follow from its plan. */
  protected get toPlan(): Draft {
    return this.job;
  }

  /** Makes the cycle at this index active. */
  abstract bringFeature(index: number): void;

  /** Plans the job. The last valid plan of the document stays while the job has errors. */
  protected compute(): void {
    this.revision++;
    const { job, toPlan } = this;
    let made: Plan | null = null;
    let findings: Finding[];
    try {
      made = plan(toPlan as unknown as Job);
      findings = made.findings;
    } catch (thrown) {
      findings = thrown instanceof JobError ? thrown.findings : check(toPlan);
    }
    const ruled = this.rules.judged(job);
    if (ruled.some(({ level }) => level === "error")) made = null;
    this.wholeFindings = [...findings, ...ruled, ...this.outside.differences()];
    this.findings = this.inForm(this.wholeFindings);
    this.stale = made === null;
    if (made) {
      this.plan = made;
      this.shown = structuredClone(job);
      this.planned = this.document;
      const count = made.moves.length;
      if (this.pinned !== null && this.pinned >= count) this.pinned = null;
      if (this.highlight !== null && this.highlight >= count)
        this.highlight = this.pinned;
    } else if (this.planned !== this.document) {
      // The plan of another document is no earlier state of this one.
      this.planned = -1;
      this.plan = NO_PLAN;
      this.shown = structuredClone(job);
    }
  }

  /** Findings of a set-up with their paths in its form. */
  protected inForm(findings: Finding[]): Finding[] {
    const { features } = this;
    return features.several
      ? findings.map((f) => ({ ...f, path: features.toFormPath(f.path) }))
      : findings;
  }

  /** Whether a finding holds for every job of the control. */
  private isOfControl({ code, level }: Finding): boolean {
    return level !== "error" && this.catalog.standing.includes(code);
  }

  /** The findings about this job. */
  get jobFindings(): Finding[] {
    return this.findings.filter((f) => !this.isOfControl(f));
  }

  /** The findings that hold for every job of the control. */
  get ofControl(): Finding[] {
    return this.findings.filter((f) => this.isOfControl(f));
  }

  /** Findings at a path, the most severe first. */
  at(path: string): Finding[] {
    const own = this.findings.filter((f) => f.path === path);
    return own.sort(
      (a, b) => LEVELS.indexOf(a.level) - LEVELS.indexOf(b.level),
    );
  }

  /** Path of the field to correct for a finding: an empty field that its message quotes, else the path of the finding. */
  fieldOf({ message, path }: Finding): string {
    for (const section of this.catalog.sections)
      for (const { key, label } of section.fields) {
        const named = `${section.path}.${key}`;
        if (this.get(named) === null && message.includes(`"${label}"`))
          return named;
      }
    return path;
  }

  /** Whether the plan uses a native cycle. */
  get ownCycle(): boolean {
    return (this.shown.control as Draft | undefined)?.form === "cycle";
  }

  /** Whether there is nothing to show: the form has errors, and `plan` is empty. */
  get blank(): boolean {
    return this.stale && this.plan === NO_PLAN;
  }

  /** First error of the job, which withholds the plan. Null if there is none. */
  get withheld(): string | null {
    if (!this.stale) return null;
    const error = this.findings.find((f) => f.level === "error");
    return this.say(error?.said ?? [w("No plan can be made of this form")]);
  }

  /** Whether neither the program nor a native cycle computes results on this control. */
  get computesNothing(): boolean {
    const { post, form } = this.shown.control as { post: string; form: string };
    return form !== "cycle" && this.postOf(post)?.computes === false;
  }

  /** A code with the name of its cycle as a prefix. Unchanged in a job with one cycle. */
  ofCycle(cycle: number, what: string): string {
    return codeOf(this.plan, cycle, what);
  }

  /** The number of a touch in its cycle, from 1. */
  touchNumber(touch: number): number {
    const { touches } = this.plan;
    const cycle = touches[touch]?.cycle ?? 0;
    return touch - touches.findIndex((one) => one.cycle === cycle) + 1;
  }

  /** Documented steps of a cycle of the plan, by its index in the job. */
  stepsOf(cycle: number): string[] {
    const own = (this.shown.cycles as Draft[] | undefined)?.[cycle];
    return own
      ? (this.catalog.cycles.find((c) => c.type === own.type)?.steps ?? [])
      : this.cycle.steps;
  }

  /** The write summary of the program: which offsets and presets it writes. */
  get does(): string {
    return this.say(this.plan.program.said);
  }

  /** Sentence about the write of the work offset with this number. */
  writes(offset: number): string {
    const word = this.post?.workOffsetWords[offset - 1] ?? `#${offset}`;
    return this.stale || offset !== this.get("control.workOffset")
      ? this.t("writes {offset}", word)
      : this.does;
  }

  /** Whether a program with this name but other blocks was saved before. */
  replaces(file: string): boolean {
    const before = this.files.get(file);
    return before !== undefined && before !== contentOf(this.plan.program.text);
  }

  /** Notes that the program was saved under this name. */
  remember(file: string): void {
    this.files.delete(file);
    this.files.set(file, contentOf(this.plan.program.text));
    if (this.local) keepFiles(this.files);
    this.dispatchEvent(new Event("change"));
  }

  /** The name of the program's file. */
  fileName(extension: string): string {
    return `${programStem(this.draft.name, this.stale ? "" : this.plan.program.text)}.${extension}`;
  }

  /** Name of any other file of this job; it contains the cycle. */
  otherName(what: string): string {
    return this.features.several
      ? `${stem(this.draft.name)}${what}`
      : `${stem(this.draft.name)}-${this.cycle.type}${what}`;
  }

  /** Highlights a move; `null` highlights the selected one again. */
  point(index: number | null): void {
    const lit = index ?? this.pinned;
    if (lit === this.highlight) return;
    this.highlight = lit;
    this.dispatchEvent(new Event("highlight"));
  }

  /** Selects a move, or none. */
  pin(index: number | null): void {
    const cycle = index === null ? undefined : this.plan.moves[index]?.cycle;
    if (cycle !== undefined && !this.stale)
      this.bringFeature(this.features.placeOf(cycle));
    const before = this.pinned;
    this.pinned = index;
    this.point(index);
    if (index !== before) this.dispatchEvent(new Event("select"));
  }

  /** The selected move. */
  get selected(): number | null {
    return this.pinned;
  }

  /** Sets the focused field. */
  focus(path: string | null): void {
    if (path === this.focused) return;
    this.focused = path;
    this.dispatchEvent(new Event("focus"));
    this.dispatchEvent(new Event("select"));
  }

  /** Reason why a job cannot be shown; null if it can. */
  unusable(job: unknown): Message | null {
    const format = check(job).find(
      (f) => f.level === "error" && f.path === "format",
    );
    return misfit(job) ?? format?.said ?? null;
  }
}
