// The one state of the page: the job as it stands in the form, and what follows from it.
import {
  type Cycle,
  type CycleEntry,
  check,
  convertUnits,
  defaultJob,
  type FieldEntry,
  type Finding,
  type Job,
  JobError,
  jobName,
  misfit,
  type Plan,
  plan,
  proposedStock,
  type ResultTolerance,
  type Said,
  type Words,
} from "./core/browser.js";
import { LEVELS } from "./core/layout.js";
import { programStem, stem } from "./core/names.js";
import { codeOf } from "./core/results.js";
import { Entries, type Form, type Units } from "./entries.js";
import { byCode, Features, type SetUpState } from "./features.js";
import { Fixed } from "./fixed.js";
import { History } from "./history.js";
import { Outside } from "./host-inputs.js";
import {
  alike,
  complete,
  type Draft,
  dropAt,
  isObject,
  ownIn,
  putAt,
} from "./job.js";
import {
  keepCam,
  keepFiles,
  keepSoon,
  kept,
  keptCam,
  keptFiles,
} from "./persistence.js";
import { placedBeside } from "./place-feature.js";
import { type Preset, SECTIONS } from "./presets.js";
import type { Reading } from "./read-text.js";
import type { Rules } from "./rules.js";
import { type ReadySetUp, readySetUps } from "./set-ups.js";
import { type Lang, w } from "./words.js";

export { sizeField, type Units } from "./entries.js";
export type { Draft } from "./job.js";

/** What is kept of a cycle whose form was left. */
interface Left {
  units: Units;
  cycle: Draft;
  points: Points;
  /** How much larger the sizes of the virtual part are. */
  sizes?: Draft;
  /** The tolerances of its results. */
  tolerances?: Draft;
}

/** Measured points as text, by the units they were typed in: read in other units they would be other points. */
type Points = Record<Units, string>;
const noPoints = (): Points => ({ mm: "", inch: "" });

/** Where no form of the document has had a plan. */
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

/** Everything that a user can change, at a moment. */
interface Moment {
  draft: Draft;
  typed: [string, string][];
  points: Points;
  left: [string, Left][];
  given: string[] | null;
  document: number;
  features: SetUpState;
}

const LOOK_ONLY: Said = [w("Nothing was changed: this job is read-only")];

/** Where people measure in inch, a first job is in inch. */
const beginsInInch = () => /^en-US\b/i.test(navigator.languages[0] ?? "");

/** What the blocks of a program are: the hash over them that its header says, or else all of it. */
const contentOf = (text: string): string =>
  /^\W*(?:\d+ ; )?Blocks below: (\w+)/im.exec(text)?.[1] ?? text;

/** What outlives a reload. */
interface State {
  draft: Draft;
  typed: [string, string][];
  points?: Points;
  left?: [string, Left][];
  given?: string[];
  features?: SetUpState;
}

export class Store extends Entries {
  /** What the page around puts in. */
  readonly outside = new Outside(this);
  draft: Draft;
  /** The cycles of a set-up, of which one is in the form. */
  readonly features = new Features();
  /** The text of number fields as it was typed, by path: `1,5` stays `1,5`. */
  typed = new Map<string, string>();
  findings: Finding[] = [];
  /** The last good plan of this document; an empty one where there was none. */
  plan: Plan = NO_PLAN;
  /** The program that was saved last. */
  saved: string | null = null;
  /** Counts the forms that were computed: another number is another form, also where it has errors. */
  revision = 0;
  /** The number of the document that the job is: another one, the defaults and another cycle have another number, also when they are taken back. */
  document = 0;
  private documents = 0;
  /** Whether `plan` is of an earlier form, since the present one has errors. */
  stale = false;
  /** The document that `plan` is of. */
  private planned = -1;
  /** The job that `plan` is of. */
  shown!: Draft;
  /** The move that is pointed at, or else the one that is pinned. */
  highlight: number | null = null;
  /** The move that stays lit when the pointer leaves. */
  private pinned: number | null = null;
  /** The path of the field that has the focus. */
  focused: string | null = null;
  /** What the page must say about what it found in the browser's storage. */
  notice: Said | null = null;
  /** The points that a machine measured for this job. */
  private points = noPoints();
  /** Whether the page around gave them: the user's undo keeps them then. */
  private pointsGiven = false;
  /** The paths that were given a value; the other fields still have their defaults. Null for a job that was given whole. */
  private given: Set<string> | null = new Set();
  /** Cycles that were left, so that coming back finds their forms and their measured points. */
  private left = new Map<string, Left>();
  private ready?: { revision: number; setUps: ReadySetUp[] };
  private readonly history = new History<Moment>();
  /** Whether the user can change the job. What is put in from outside is taken all the same. */
  private shut = false;
  /** Whether what changes now is changed by the user. */
  byUser = true;
  private readonly local: boolean;
  /** The name that the job has by itself: while it has this one, it follows what is measured. Null where the job is another one. */
  private ownName: string | null = null;
  /** The control that had a work offset which the present one has not: with another control it comes back. */
  private lost: Draft | null = null;
  /** What was saved, by the names of the files. */
  private readonly files: Map<string, string>;

  /** `local`: stores the state in this browser. `first`: cycle of a new job, by default the first one of the catalog. */
  constructor({
    local = false,
    first,
  }: { local?: boolean; first?: Cycle["type"] } = {}) {
    super();
    this.local = local;
    this.files = local ? keptFiles() : new Map();
    const type = first ?? (this.catalog.cycles[0] as CycleEntry).type;
    this.draft = structuredClone(defaultJob(type)) as unknown as Draft;
    this.compute();
    if (local && !this.restore() && beginsInInch()) {
      this.draft = structuredClone(
        defaultJob(type, "inch"),
      ) as unknown as Draft;
      this.compute();
    }
    this.cams = local && keptCam();
    this.ownName = jobName(this.draft);
  }

  /** The rules of the page around. */
  get rules(): Rules {
    return this.outside.rules;
  }

  /** Fills in the fields that still have their defaults by other rules. */
  configure(): void {
    const { given, rules } = this;
    if (given) {
      const type = this.cycle.type;
      const first = rules.firstOf(this.catalog.cycles.map((one) => one.type));
      if (given.size === 0 && !rules.offers("cycles", type) && first)
        this.choose(first as Cycle["type"]);
      if (!given.has("units") && !rules.allowsUnits(this.units))
        this.setUnits(rules.units(this.units));
      const laid = rules.laid(this.draft);
      const held = [...given].map((path) => [path, this.get(path)] as const);
      this.draft = laid;
      for (const [path, value] of held) putAt(this.draft, path, value);
    }
    this.changed();
  }

  /** The job for a stylus of the page around. */
  useStylus(stylus: Draft): void {
    this.put("stylus", { ...(this.draft.stylus as Draft), ...stylus });
  }

  /** The whole job: of one cycle the form itself, of a set-up all of its cycles. */
  get job(): Draft {
    return this.features.compose(this.draft);
  }

  /** The ready set-ups that suit the machine of the job. Planned on first use, once for each state of the job. */
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
    this.load(job, "", this.given);
    if ((job.control as Draft).form !== form)
      this.tell([
        w(
          "The program uses moves: native cycles cannot compute with each other's results",
        ),
      ]);
  }

  /** Adds a cycle of this type after the active one and makes it active: beside the other features, with the sizes of the last one of its type. A stock that fits the features fits the new one, too. */
  addFeature(type: Cycle["type"]): void {
    const fresh = this.freshOf(type) as { cycle: Draft };
    const last = this.features.lastOf(this.draft, type);
    const cycle = placedBeside(this, this.plan, fresh.cycle, last);
    const { stock } = this.draft;
    const fits = stock && alike(stock, proposedStock(this.job));
    this.arrange(() => {
      this.features.add(this.draft, cycle);
      this.features.bring(this.draft, this.features.hand + 1);
      if (fits) this.draft.stock = proposedStock(this.job) ?? stock;
    });
  }

  /** The same as the one at a place, behind it, and in the form. */
  duplicateFeature(index: number): void {
    this.arrange(() => {
      this.features.bring(this.draft, index);
      const { cycle, part, tolerances } = structuredClone(this.draft) as Record<
        string,
        Draft
      >;
      this.features.add(this.draft, cycle as Draft, {
        sizes: part?.sizes as Draft,
        tolerances: tolerances ?? {},
      });
      this.features.bring(this.draft, index + 1);
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

  /** Leaves one out of the program, or takes it in again. One stays in. */
  switchFeature(index: number): void {
    const { all } = this.features;
    const one = all[index];
    if (!one || (!one.off && all.filter(({ off }) => !off).length === 1))
      return;
    this.arrange(() => {
      this.features.stow(this.draft);
      this.features.all[index] = {
        ...(this.features.all[index] as typeof one),
        off: !one.off,
      };
    });
  }

  /** What is written into an axis: a result, none, or what is proposed. */
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
      this.tell([
        w("{what} is followed up to {limit} away: Position limit"),
        result.slice(1),
        `${proposed} ${this.units}`,
      ]);
  }

  /** The height between the cycles. */
  clearAt(height: number | null): void {
    this.arrange(() => {
      this.features.clear = height;
    });
  }

  /** Changes what is computed of the results of cycles. */
  relate(change: (features: Features) => void): void {
    this.arrange(() => {
      const { features, draft } = this;
      features.stow(draft);
      change(features);
      // What follows a relation goes by its new name, in the form too.
      draft.cycle = features.all[features.hand]?.cycle ?? draft.cycle;
    });
  }

  /** Where the tolerances of a result are kept: of the cycle in hand in the form. Undefined for a cycle that is no longer in the program. */
  private toleratedOf(
    cycle: number,
  ): { tolerances: Draft; keep: (tolerances: Draft) => void } | undefined {
    const { features, draft, plan } = this;
    // By its name: where the form has errors, the plan may be of another order.
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

  /** The tolerance of a result of the plan; undefined where it has none. */
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

  /** Brings the cycle at a place into the form. Nothing of the job is changed. */
  bringFeature(index: number): void {
    if (!this.features.several || index === this.features.hand) return;
    this.features.bring(this.draft, index);
    this.typed.clear();
    this.focus(null);
    this.changed();
  }

  /** Changes the list of cycles, in one step. */
  private arrange(change: () => void): void {
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
    this.given?.add("cycle");
    this.settle();
    this.changed();
  }

  /** Whether what only the author of a postprocessor needs is shown. */
  get cam(): boolean {
    return this.camAsked ?? this.cams;
  }

  /** The user's choice, also by a dump that was opened. What the page around asks for goes before it. */
  set cam(on: boolean) {
    if (this.camAsked !== null || on === this.cams) return;
    this.cams = on;
    if (this.local) keepCam(on);
    this.showCam();
  }

  /** What the page around asks for; null leaves it to the user. */
  askCam(on: boolean | null): void {
    const before = this.cam;
    this.camAsked = on;
    if (this.cam !== before) this.showCam();
  }

  /** Whether the page around asks for it, or for its absence. */
  get camIsAsked(): boolean {
    return this.camAsked !== null;
  }

  private showCam(): void {
    this.dispatchEvent(new Event("cam"));
    this.byUser = false;
    this.dispatchEvent(new Event("change"));
    this.byUser = true;
  }

  private cams = false;
  private camAsked: boolean | null = null;

  /** Whether the virtual part's group of the form is open. */
  get partOpen(): boolean {
    return this.opensPart;
  }

  set partOpen(open: boolean) {
    if (open === this.opensPart) return;
    this.opensPart = open;
    this.dispatchEvent(new Event("focus"));
  }

  private opensPart = false;

  /** Whether a finding says how the control always is, and nothing about this job. */
  stands({ code, level }: Finding): boolean {
    return level !== "error" && this.catalog.standing.includes(code);
  }

  /** Whether the plan is of a cycle of the control's own. */
  get ownCycle(): boolean {
    return (this.shown.control as Draft | undefined)?.form === "cycle";
  }

  /** The findings about this job. */
  get ofJob(): Finding[] {
    return this.findings.filter((f) => !this.stands(f));
  }

  /** Another language for everything that is shown. The job stays as it is. */
  translate(lang: Lang, words: Words): void {
    this.byUser = false;
    try {
      this.speak(lang, words);
      this.dispatchEvent(new Event("change"));
    } finally {
      this.byUser = true;
    }
  }

  /** Whether the job can only be looked at. */
  get readonly(): boolean {
    return this.shut;
  }

  set readonly(shut: boolean) {
    if (shut === this.shut) return;
    this.shut = shut;
    this.byUser = false;
    this.dispatchEvent(new Event("change"));
    this.byUser = true;
  }

  /** Forgets the steps that could be taken back. */
  clear(): void {
    this.history.clear();
  }

  /** Whether a change is the user's and the job is not to be changed. */
  private get refuses(): boolean {
    return this.shut && this.byUser;
  }

  /** The longest text that a job is made of, in characters. */
  get longest(): number {
    return this.catalog.longestText;
  }

  /** The longest program that is shown, in characters. */
  get longestProgram(): number {
    return this.catalog.longestProgram;
  }

  /** Whether there is nothing to show: the form has errors, and `plan` is empty. */
  get blank(): boolean {
    return this.stale && this.plan === NO_PLAN;
  }

  /** Why nothing of the plan is handed out: the form's first error. Null where the plan is the form's. */
  get withheld(): string | null {
    if (!this.stale) return null;
    const error = this.findings.find((f) => f.level === "error");
    return this.say(error?.said ?? [w("No plan can be made of this form")]);
  }

  get measured(): string {
    return this.points[this.units];
  }

  set measured(text: string) {
    // What the page around sets is not a step of the user's.
    if (this.byUser) this.mark("measured");
    this.pointsGiven = !this.byUser;
    this.points = { ...this.points, [this.units]: text };
    this.keep();
    this.dispatchEvent(new Event("change"));
  }

  /** Sets a value; every keystroke comes through here. Changes of one path are one step back until `settle`. */
  set(path: string, value: unknown, typed?: string): void {
    const fixed = this.fixed();
    if (this.refuses || fixed.has(path)) return;
    this.mark(path);
    this.given?.add(path.replace(/\[\d\]$/, ""));
    // What the user chooses now holds, also that none is written.
    if (path === "control.workOffset") this.lost = null;
    if (typed === undefined) this.typed.delete(path);
    else this.typed.set(path, typed);
    putAt(this.draft, path, value);
    if (typeof value === "number") this.untolerate(path);
    fixed.keep(this.draft);
    // What was typed inside a value that is another one now.
    if (typeof value === "object")
      for (const inside of [`${path}.`, `${path}[`]) this.forget(inside);
    this.changed();
  }

  /** Removes the action and wear correction of a size that no longer has a tolerance. */
  private untolerate(path: string): void {
    const [, code = ""] = /^cycle\.(\w+)$/.exec(path) ?? [];
    const all = this.draft.tolerances as Draft | undefined;
    const entry = all?.[code];
    if (isObject(entry) && entry.tolerance === undefined) {
      const { [code]: _, ...rest } = all as Draft;
      this.draft.tolerances = rest;
    }
  }

  /** What the user cannot change: what the page around fixes, unless it has another value than it must have. */
  private fixed(bare = false): Fixed {
    const wrong = new Set(
      this.findings
        .filter(({ code }) => code === "locked")
        .map(({ path }) => path),
    );
    const locked = this.byUser ? this.rules.locked(bare) : [];
    return new Fixed(
      this.draft,
      locked.filter((path) => !wrong.has(path)),
    );
  }

  /** Another control, and what of the job it has not. */
  chooseControl(post: unknown, form?: Form): void {
    const old = this.draft.control as Draft;
    if (post !== old.post) this.beforeControl = old;
    this.put("control", {
      ...this.controlOf(post, form),
      workOffset: this.offsetFor(post),
    });
    this.tellLost(old);
  }

  /** The work offset on another control: the job's, or else the one that the present control has not. */
  private offsetFor(post: unknown): unknown {
    const old = this.draft.control as Draft;
    if (old.workOffset === null && this.lost)
      return this.offsetOn(post, this.lost);
    const offset = this.offsetOn(post, old);
    if (offset === null && old.workOffset !== null) this.lost = old;
    return offset;
  }

  /** Says that a work offset is not written any more, where this control has none of that name. */
  private tellLost({ post, workOffset }: Draft): void {
    if (
      typeof workOffset !== "number" ||
      (this.draft.control as Draft).workOffset !== null
    )
      return;
    const word = this.offsetWord(post, workOffset) ?? String(workOffset);
    this.tell([
      w("This control has no {offset}: the program now writes no work offset"),
      word,
    ]);
  }

  /** Says what was done beside what was asked for. */
  private tell(said: Said): void {
    this.dispatchEvent(new CustomEvent("told", { detail: said }));
  }

  /** The points of a log that was opened. */
  openPoints(text: string): void {
    this.settle();
    this.measured = text;
    this.settle();
  }

  /** The virtual part lies as the drawing says. */
  putNominal(): void {
    this.put("part", { offset: [0, 0, 0], rotation: 0, sizes: {} });
  }

  /** Sets a value by one act of the user, such as a choice: a step of its own. */
  put(path: string, value: unknown): void {
    this.settle();
    this.set(path, value);
    this.settle();
  }

  /** Takes a key out of the job. */
  drop(path: string): void {
    if (this.refuses) return;
    this.mark(null);
    dropAt(this.draft, path);
    this.forget(path);
    this.changed();
  }

  /** Another cycle; the rest of the job stays, and what was left is kept. */
  choose(type: Cycle["type"]): void {
    if (this.refuses) return;
    const old = this.draft.cycle as Draft;
    if (type === old.type) return;
    this.mark(null);
    const { units } = this;
    const part = this.draft.part as Draft;
    const { sizes: mine, tolerances: limits } = {
      ...part,
      tolerances: this.draft.tolerances,
    } as Record<string, Draft>;
    this.left.set(String(old.type), {
      units,
      cycle: old,
      points: this.points,
      sizes: mine,
      tolerances: limits,
    });
    const back = this.left.get(type);
    const fresh = this.freshOf(type);
    const { post } = this.draft.control as Draft;
    this.takeControl(type, fresh.control as Draft);
    this.document = ++this.documents;
    const { cycle, sizes, tolerances } = ownIn(
      units,
      {
        cycle: back?.cycle ?? (fresh.cycle as Draft),
        sizes: back?.sizes ?? {},
        tolerances: back?.tolerances ?? {},
      },
      back?.units ?? units,
    );
    // A form that comes back was filled in before.
    for (const path of [...(this.given ?? [])])
      if (path.startsWith("cycle")) this.given?.delete(path);
    if (back) this.given?.add("cycle");
    this.draft.cycle = cycle;
    this.features.called(cycle);
    part.sizes = sizes;
    this.draft.tolerances = tolerances;
    this.points = back?.points ?? noPoints();
    this.forget("cycle");
    this.forget("part.sizes");
    this.pinned = null;
    this.highlight = null;
    this.changed();
    const now = (this.draft.control as Draft).post;
    const own = (fresh.control as Draft).post;
    const title = (id: unknown) => this.postOf(id)?.title ?? String(id);
    if (!this.byUser) return;
    if (now !== post)
      this.tell([
        w("{control} does not take this cycle: the program is now for {other}"),
        title(post),
        title(now),
      ]);
    else if (own !== now && this.formsOf(own, type).includes("cycle"))
      this.tell([
        w(
          "This is a cycle of {control}; the program for {other} makes its moves",
        ),
        title(own),
        title(now),
      ]);
  }

  /** The default job of a cycle in the job's units, with what the rules of the page around say of it. */
  private freshOf(type: Cycle["type"]): Draft {
    return this.rules.laid(
      structuredClone(defaultJob(type, this.units)) as unknown as Draft,
    );
  }

  /**
   * The control for another cycle: that of the job if it takes the cycle, else the one before it, else the one that the cycle is usually for. The
   * control that the page around asks for stays: where it does not take the cycle, the job has an error.
   */
  private takeControl(type: string, usual: Draft): void {
    const old = this.draft.control as Draft;
    const takes =
      [old, this.beforeControl, usual].find(
        (one) => one && this.serves(one.post, type),
      ) ?? usual;
    const forms = this.formsOf(takes.post, type);
    const form = forms.includes(takes.form as Form)
      ? takes.form
      : (forms[0] ?? takes.form);
    if (takes.post === old.post) {
      const workOffset = this.ownPreset(old.post, type) ? null : old.workOffset;
      this.draft.control = { ...old, form, workOffset };
    } else {
      const workOffset = this.offsetFor(takes.post);
      this.beforeControl = old;
      this.draft.control = { ...old, post: takes.post, form, workOffset };
    }
  }

  /** Whether a control takes a cycle, or the page around asks for it. */
  private serves(post: unknown, type: string): boolean {
    return post === this.outside.post || this.formsOf(post, type).length > 0;
  }

  /** The control that the job was for before this one. */
  private beforeControl: Draft | null = null;

  /** Other units: the values shown are converted, the geometry stays. */
  setUnits(units: Units): void {
    if (this.refuses) return;
    if (units === this.draft.units) return;
    this.mark(null);
    // Numbers in units that are none cannot be converted: they stay, and now have units.
    const known = this.draft.units === "mm" || this.draft.units === "inch";
    const old = this.draft;
    const untouched = known ? this.untouched() : [];
    this.draft = known
      ? (convertUnits(old, units) as unknown as Draft)
      : { ...old, units };
    if (known) this.features.convert(old.units as Units, units);
    for (const [path, field] of untouched)
      putAt(this.draft, path, structuredClone(this.begins(field, units)));
    this.typed.clear();
    this.changed();
  }

  /** The fields that still hold what a new job begins with. */
  private untouched(): [string, FieldEntry][] {
    const { given } = this;
    if (!given) return [];
    const isGiven = (path: string) =>
      [...given].some((one) => path === one || path.startsWith(`${one}.`));
    const locked = this.rules.locked();
    return [...this.metric()].filter(
      ([path, field]) =>
        !isGiven(path) &&
        !locked.includes(path) &&
        alike(this.get(path), this.begins(field)),
    );
  }

  /** Takes a whole job, one that fits the form. `given`: the paths that were given a value. */
  load(job: Draft, measured = "", given: Set<string> | null = null): void {
    if (this.refuses) return;
    const fixed = this.fixed(true);
    this.mark(null);
    this.document = ++this.documents;
    this.beforeControl = null;
    this.lost = null;
    this.ownName = null;
    this.given = given;
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
    this.changed();
  }

  /** The form of a job: of a set-up that of its first cycle, and the others wait. */
  private formOf(job: Draft): Draft {
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

  /** Takes another document: nothing of the one before can be taken back, or comes back with a cycle. */
  replace(whole: Draft): void {
    if (this.refuses) return;
    const same =
      alike((whole.cycle as Draft | undefined)?.type, this.cycle.type) &&
      whole.units === this.draft.units;
    this.load(whole, same ? this.measured : "");
    this.left = new Map();
    this.clear();
  }

  /** Takes the job of a link. Throws `JobError`, and changes nothing, where it cannot be shown. */
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

  /** Takes the job of a text that was read. Throws `JobError`, and changes nothing, if the text holds no job, or one that the form cannot show. */
  open({ imported, findings }: Reading): void {
    if (this.refuses) throw this.refusal(LOOK_ONLY);
    if (!imported) throw new JobError(findings[0]?.message ?? "", findings);
    const problem: Said | null =
      imported.kind === "moves"
        ? [w("this program says no job")]
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

  /** What is said of a text that is too long to be read. */
  tooLong(length: number, what: "text" | "file" | "paste" = "text"): Said {
    const count = (n: number) => n.toLocaleString(this.lang);
    const templates = {
      file: w(
        "Nothing was read: this file has {count} bytes, and at most {most} are read",
      ),
      text: w(
        "Nothing was read: this text has {count} characters, and at most {most} are read",
      ),
      paste: w(
        "Nothing was read: this text has {count} characters, and at most {most} can be pasted. A longer program can be opened as a file",
      ),
    };
    return [
      templates[what],
      count(length),
      count(what === "file" ? this.longestProgram : this.longest),
    ];
  }

  /** Back to the defaults of the present cycle. */
  reset(): void {
    this.load(this.outside.fresh(this.cycle.type), "", new Set());
  }

  /** What belongs to the machine, as a preset. Which work offset is written belongs to the job. */
  preset(name: string): Preset {
    const sections = structuredClone(
      Object.fromEntries(
        SECTIONS.map((section) => [section, this.draft[section]]),
      ),
    );
    delete (sections.control as Draft).workOffset;
    return {
      name,
      units: this.units,
      overtravel: this.draft.overtravel,
      sections,
    };
  }

  /**
   * Takes these sections of a preset, in this job's units; the work offset stays, if the control has it. Throws `JobError`, and changes nothing, where
   * it does not fit.
   */
  usePreset(
    preset: Preset,
    parts: readonly string[] = [...Object.keys(preset.sections), "overtravel"],
  ): void {
    if (this.refuses) throw this.refusal(LOOK_ONLY);
    const { units: held, draft } = this;
    const old = draft.control as Draft;
    const all: Draft = { ...preset.sections, overtravel: preset.overtravel };
    const taken = Object.fromEntries(
      Object.entries(all).filter(
        ([key, x]) => parts.includes(key) && x !== undefined,
      ),
    );
    if (isObject(taken.control)) {
      const { post } = taken.control;
      const forms = this.formsOf(post, this.cycle.type);
      const form = forms.includes(taken.control.form as Form)
        ? taken.control.form
        : (forms[0] ?? taken.control.form);
      taken.control = {
        ...taken.control,
        form,
        workOffset: this.offsetOn(post),
      };
    }
    const job = {
      ...structuredClone(draft),
      ...structuredClone(taken),
      units: preset.units,
    };
    const problem = this.unusable(job);
    if (problem)
      throw this.refusal([
        w("Nothing was changed: this machine cannot be used: {problem}"),
        problem,
      ]);
    const whole = complete(this.outside.filled(job) as Draft, this.catalog);
    const fitted = (preset.units === held
      ? whole
      : convertUnits(whole, held)) as unknown as Draft;
    this.mark(null);
    const fixed = this.fixed();
    for (const key of Object.keys(taken)) {
      draft[key] = structuredClone(fitted[key]);
      this.given?.add(key);
      this.forget(key);
    }
    fixed.keep(draft);
    this.changed();
    this.tellLost(old);
  }

  /** What is changed next is a step of its own. */
  settle(): void {
    this.history.settle();
    this.dispatchEvent(new Event("settled"));
  }

  get canUndo(): boolean {
    return !this.shut && this.history.canUndo;
  }

  get canRedo(): boolean {
    return !this.shut && this.history.canRedo;
  }

  /** Takes the last step back, whatever it was: a field, a drag, a file, a reset. */
  undo(): void {
    if (!this.refuses) this.become(this.history.undo(() => this.moment()));
  }

  redo(): void {
    if (!this.refuses) this.become(this.history.redo(() => this.moment()));
  }

  /** Points at a move; at none, the pinned one stays lit. */
  point(index: number | null): void {
    const lit = index ?? this.pinned;
    if (lit === this.highlight) return;
    this.highlight = lit;
    this.dispatchEvent(new Event("highlight"));
  }

  /** Keeps a move lit, or none. */
  pin(index: number | null): void {
    const cycle = index === null ? undefined : this.plan.moves[index]?.cycle;
    if (cycle !== undefined && !this.stale)
      this.bringFeature(this.features.placeOf(cycle));
    const before = this.pinned;
    this.pinned = index;
    this.point(index);
    if (index !== before) this.dispatchEvent(new Event("select"));
  }

  /** The move that stays lit. */
  get selected(): number | null {
    return this.pinned;
  }

  /** A field has the focus. */
  focus(path: string | null): void {
    if (path === this.focused) return;
    this.focused = path;
    this.dispatchEvent(new Event("focus"));
    this.dispatchEvent(new Event("select"));
  }

  /** A number field shows its number again, not the sum that was typed. */
  tidy(path: string): void {
    if (this.typed.delete(path)) this.changed();
  }

  /** Whether nothing on the control of the plan computes results: neither the program nor a cycle of its own. */
  get bare(): boolean {
    const { post, form } = this.shown.control as { post: string; form: string };
    return form !== "cycle" && this.postOf(post)?.computes === false;
  }

  /** What is said of something of a cycle, with the name of that cycle in front of it; of a job of one cycle as it is. */
  ofCycle(cycle: number, what: string): string {
    return codeOf(this.plan, cycle, what);
  }

  /** The number of a touch in its cycle, from 1. */
  touchNumber(touch: number): number {
    const { touches } = this.plan;
    const cycle = touches[touch]?.cycle ?? 0;
    return touch - touches.findIndex((one) => one.cycle === cycle) + 1;
  }

  /** The documented steps of a cycle of the plan, by its place in the job. */
  stepsOf(cycle: number): string[] {
    const own = (this.shown.cycles as Draft[] | undefined)?.[cycle];
    return own
      ? (this.catalog.cycles.find((c) => c.type === own.type)?.steps ?? [])
      : this.cycle.steps;
  }

  /** What the program of the plan does with offsets and presets, in a sentence. */
  get does(): string {
    return this.say(this.plan.program.said);
  }

  /** What the program does with the work offset of a number, in words. */
  writes(offset: number): string {
    const word = this.post?.workOffsetWords[offset - 1] ?? `#${offset}`;
    return this.stale || offset !== this.get("control.workOffset")
      ? this.t("writes {offset}", word)
      : this.does;
  }

  /** Whether a program of this name was saved before, and had other blocks than the one of the plan. */
  replaces(file: string): boolean {
    const before = this.files.get(file);
    return before !== undefined && before !== contentOf(this.plan.program.text);
  }

  /** The program of the plan was saved as this file. */
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

  /** The name of any other file of this job: the cycle is in it. */
  otherName(what: string): string {
    return this.features.several
      ? `${stem(this.draft.name)}${what}`
      : `${stem(this.draft.name)}-${this.cycle.type}${what}`;
  }

  /** Findings at a path, the gravest first. */
  at(path: string): Finding[] {
    const own = this.findings.filter((f) => f.path === path);
    return own.sort(
      (a, b) => LEVELS.indexOf(a.level) - LEVELS.indexOf(b.level),
    );
  }

  /** What is asked of the job has changed, and not the job. */
  reconsider(): void {
    this.changed();
  }

  private changed(): void {
    this.nameAnew();
    this.compute();
    this.keep();
    this.dispatchEvent(new Event("change"));
    if (this.history.settled) this.dispatchEvent(new Event("settled"));
  }

  /** A name that was not typed follows what is measured. */
  private nameAnew(): void {
    const name = jobName(this.job);
    if (this.ownName !== null && this.draft.name === this.ownName)
      this.draft.name = name;
    this.ownName = name;
  }

  private keep(): void {
    if (!this.local) return;
    keepSoon(
      (): State => ({
        draft: this.draft,
        typed: [...this.typed],
        points: this.points,
        left: [...this.left],
        ...(this.given ? { given: [...this.given] } : {}),
        ...(this.features.several ? { features: this.features.state() } : {}),
      }),
      () =>
        this.tell([
          w(
            "This browser keeps nothing: save the job as a file, or it is lost with this page",
          ),
        ]),
    );
  }

  private compute(): void {
    this.revision++;
    const { job } = this;
    let made: Plan | null = null;
    let findings: Finding[];
    try {
      made = plan(job as unknown as Job);
      findings = made.findings;
    } catch (thrown) {
      findings = thrown instanceof JobError ? thrown.findings : check(job);
    }
    const ruled = this.rules.judged(job);
    if (ruled.some(({ level }) => level === "error")) made = null;
    this.findings = [
      ...this.inForm([...findings, ...ruled]),
      ...this.outside.differences(),
    ];
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
      // The plan of another document says nothing of this one, not even of how it was.
      this.planned = -1;
      this.plan = NO_PLAN;
      this.shown = structuredClone(job);
    }
  }

  /** Findings of a set-up with the paths that its form has. */
  private inForm(findings: Finding[]): Finding[] {
    const { features } = this;
    return features.several
      ? findings.map((f) => ({ ...f, path: features.inForm(f.path) }))
      : findings;
  }

  /** Why a job cannot be shown; null where it can. */
  unusable(job: unknown): Said | null {
    const format = check(job).find(
      (f) => f.level === "error" && f.path === "format",
    );
    return misfit(job) ?? format?.said ?? null;
  }

  /** Takes up what was kept. What cannot be used is left alone, and the page says so. */
  private restore(): boolean {
    for (const state of kept()) {
      const { draft, typed, points, left, given, features } = (
        isObject(state) ? state : {}
      ) as Partial<State>;
      const several = Features.fits(features) ? features : null;
      if (several) this.features.become(several);
      const problem = this.unusable(
        several && isObject(draft) ? this.features.compose(draft) : draft,
      );
      if (problem) this.features.alone();
      if (problem) {
        this.notice = [
          w("What was kept in this browser cannot be used: {problem}"),
          problem,
        ];
        continue;
      }
      const isText = (pair: unknown) =>
        Array.isArray(pair) &&
        pair.length === 2 &&
        pair.every((x) => typeof x === "string");
      this.draft = complete(draft as Draft, this.catalog);
      this.typed = new Map(Array.isArray(typed) ? typed.filter(isText) : []);
      for (const units of ["mm", "inch"] as const)
        if (typeof points?.[units] === "string")
          this.points[units] = points[units];
      this.left = new Map(
        Array.isArray(left) ? left.filter((one) => this.isLeft(one)) : [],
      );
      this.given = Array.isArray(given)
        ? new Set(given.filter((path) => typeof path === "string"))
        : null;
      this.document = ++this.documents;
      this.compute();
      return true;
    }
    return false;
  }

  /** Whether something kept is a form of a cycle that can be shown again. */
  private isLeft(one: unknown): one is [string, Left] {
    const [type, left] = Array.isArray(one) ? one : [];
    if (!isObject(left) || !isObject(left.cycle) || !isObject(left.points))
      return false;
    const texts = Object.values(left.points as Draft).every(
      (text) => typeof text === "string",
    );
    const job = {
      format: 1,
      units: left.units,
      cycle: left.cycle,
      part: { sizes: left.sizes },
      tolerances: left.tolerances ?? {},
    };
    return (
      texts &&
      ["mm", "inch"].includes(String(left.units)) &&
      left.cycle.type === type &&
      !this.unusable(job)
    );
  }

  private moment(): Moment {
    const { typed, points, left, given, document } = this;
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

  /** Before a change: what it is of decides whether it can be taken back by itself. */
  private mark(changing: string | null): void {
    this.history.mark(changing, () => this.moment());
  }

  /** Becomes what it was at a moment. */
  private become(moment: Moment | undefined): void {
    if (!moment) return;
    const fixed = this.fixed(true);
    this.draft = moment.draft;
    this.features.become(moment.features);
    fixed.keep(this.draft);
    this.typed = new Map(moment.typed);
    if (!this.pointsGiven) this.points = moment.points;
    this.left = new Map(moment.left);
    this.given = moment.given && new Set(moment.given);
    this.document = moment.document;
    this.ownName = null;
    this.pinned = null;
    this.highlight = null;
    this.changed();
  }

  private forget(prefix: string): void {
    for (const path of [...this.typed.keys()])
      if (path.startsWith(prefix)) this.typed.delete(path);
  }
}
