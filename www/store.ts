// State of the page. It is stored in the browser and changes from one job to another.
import {
  type Cycle,
  type CycleEntry,
  defaultJob,
  jobName,
  type Message,
} from "./core/browser.js";
import { CycleList, type SetUpState } from "./cycle-list.js";
import { noPoints, type Points, type SavedCycle } from "./document.js";
import { HostInputs } from "./host-inputs.js";
import {
  complete,
  convertCycleParts,
  type Draft,
  isObject,
  putAt,
} from "./job.js";
import { PartEditor } from "./part-editor.js";
import { keepCam, keepSoon, kept, keptCam, keptFiles } from "./persistence.js";
import { w } from "./words.js";

export { sizeField, type Units } from "./entries.js";
export type { Draft } from "./job.js";

/** Whether the first job is in inch: in regions that measure in inch. */
const beginsInInch = () => /^en-US\b/i.test(navigator.languages[0] ?? "");

/** State that survives a reload. */
interface State {
  draft: Draft;
  typed: [string, string][];
  points?: Points;
  left?: [string, SavedCycle][];
  given?: string[];
  features?: SetUpState;
}

/** The state of the page: machine, features and document of the job, its plan, and what is stored in the browser. */
export class Store extends PartEditor {
  /** Inputs of the host page. */
  readonly outside = new HostInputs(this);
  /** Message about the state found in the browser's storage. */
  notice: Message | null = null;
  protected readonly local: boolean;
  protected cams = false;
  protected camAsked: boolean | null = null;
  protected opensPart = false;

  /** `local`: stores the state in this browser. `first`: cycle of a new job, by default the first one of the catalog. */
  constructor({
    local = false,
    first,
  }: { local?: boolean; first?: Cycle["type"] } = {}) {
    super();
    this.local = local;
    if (local) this.files = keptFiles();
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
    this.automaticName = jobName(this.draft);
  }

  /** Fills in the fields with default values again, by other rules. */
  configure(): void {
    const { editedPaths: given, rules } = this;
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

  /** Changes the cycle and stores the state of the previous one. The rest of the job stays the same. */
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
    const { cycle, sizes, tolerances } = convertCycleParts(
      units,
      {
        cycle: back?.cycle ?? (fresh.cycle as Draft),
        sizes: back?.sizes ?? {},
        tolerances: back?.tolerances ?? {},
      },
      back?.units ?? units,
    );
    // The rules have already filled in a form that is restored.
    for (const path of [...(this.editedPaths ?? [])])
      if (path.startsWith("cycle")) this.editedPaths?.delete(path);
    if (back) this.editedPaths?.add("cycle");
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
    if (!this.userChange) return;
    if (now !== post)
      this.announce([
        w(
          "{control} does not support this cycle: the program is now for {other}",
        ),
        title(post),
        title(now),
      ]);
    else if (own !== now && this.formsOf(own, type).includes("cycle"))
      this.announce([
        w(
          "This is a cycle of {control}; the program for {other} makes its moves",
        ),
        title(own),
        title(now),
      ]);
  }

  /** Message for a text that is too long to read. */
  tooLong(length: number, what: "text" | "file" | "paste" = "text"): Message {
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

  /** Maximum length of a text with a job, in characters. */
  get longest(): number {
    return this.catalog.longestText;
  }

  /** Maximum length of a program to show, in characters. */
  get longestProgram(): number {
    return this.catalog.longestProgram;
  }

  /** Resets the active cycle to its defaults. */
  reset(): void {
    this.load(this.outside.fresh(this.cycle.type), "", new Set());
  }

  /** Whether the page shows what only authors of postprocessors need. */
  get cam(): boolean {
    return this.camAsked ?? this.cams;
  }

  /** Sets the user's choice, also when a dump is opened. A request of the host page takes precedence. */
  set cam(on: boolean) {
    if (this.camAsked !== null || on === this.cams) return;
    this.cams = on;
    if (this.local) keepCam(on);
    this.showCam();
  }

  /** Sets the request of the host page; null leaves the choice to the user. */
  askCam(on: boolean | null): void {
    const before = this.cam;
    this.camAsked = on;
    if (this.cam !== before) this.showCam();
  }

  /** Whether the host page requests it on or off. */
  get camIsAsked(): boolean {
    return this.camAsked !== null;
  }

  protected showCam(): void {
    this.dispatchEvent(new Event("cam-mode"));
    this.asHost(() => this.dispatchEvent(new Event("change")));
  }

  /** Whether the virtual part's group of the form is open. */
  get partOpen(): boolean {
    return this.opensPart;
  }

  set partOpen(open: boolean) {
    if (open === this.opensPart) return;
    this.opensPart = open;
    this.dispatchEvent(new Event("focus"));
  }

  protected keep(): void {
    if (!this.local) return;
    keepSoon(
      (): State => ({
        draft: this.draft,
        typed: [...this.typed],
        points: this.points,
        left: [...this.left],
        ...(this.editedPaths ? { given: [...this.editedPaths] } : {}),
        ...(this.features.several ? { features: this.features.state() } : {}),
      }),
      () =>
        this.announce([
          w(
            "This browser stores nothing: save the job as a file before you close the page",
          ),
        ]),
    );
  }

  /** Restores the stored state. Reports a state that cannot be used and leaves it in the storage. */
  protected restore(): boolean {
    for (const state of kept()) {
      const { draft, typed, points, left, given, features } = (
        isObject(state) ? state : {}
      ) as Partial<State>;
      const several = CycleList.fits(features) ? features : null;
      if (several) this.features.restoreSnapshot(several);
      const problem = this.unusable(
        several && isObject(draft) ? this.features.compose(draft) : draft,
      );
      if (problem) this.features.alone();
      if (problem) {
        this.notice = [
          w("The state stored in this browser cannot be used: {problem}"),
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
      this.editedPaths = Array.isArray(given)
        ? new Set(given.filter((path) => typeof path === "string"))
        : null;
      this.document = ++this.documents;
      this.compute();
      return true;
    }
    return false;
  }

  /** Whether a stored value is the form of a cycle that can be shown again. */
  protected isLeft(one: unknown): one is [string, SavedCycle] {
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
}
