// Inputs and requests of the host page, and the jobs that were sent to it.
import {
  type Config,
  type Cycle,
  checkConfig,
  defaultJob,
  type Finding,
  type FindingCode,
  type Message,
  say,
} from "./core/browser.js";
import { isTooLarge } from "./core/coded.js";
import type { CatalogView, Units } from "./entries.js";
import { alike, complete, type Draft, isObject, isOut } from "./job.js";
import { Rules } from "./rules.js";
import { w } from "./words.js";

/** Milliseconds in which a host may return a job that it received by `job-change`: frames and stores answer late. */
const ECHO = 1000;

export type Input = "job" | "cycle" | "post" | "units" | "config" | "measured";
type Setting = "lang" | "readonly";

/** Requests of the host page. They hold for every job that does not specify its own control or units. */
export interface HostRequest {
  cycle?: Cycle["type"];
  post?: string;
  units?: Units;
}

/** Path of an input in the job. */
const PATHS: Readonly<Record<string, string>> = {
  cycle: "cycle.type",
  post: "control.post",
  units: "units",
  config: "config",
};

function refused(input: string, code: FindingCode, ...said: Message): Finding {
  return {
    level: "error",
    code,
    path: PATHS[input] ?? "",
    message: say(said),
    said,
  };
}

/** A job without its control; everything else stays. */
function withoutControl(job: Draft): Draft {
  const control: Draft = { ...(job.control as Draft) };
  delete control.post;
  delete control.form;
  return { ...job, control };
}

/** What this class needs of the store. */
interface Jobs extends CatalogView {
  asHost<T>(change: () => T): T;
  readonly revision: number;
  readonly job: Draft;
  readonly longest: number;
  measured: string;
  configure(): void;
  choose(type: Cycle["type"]): void;
  setUnits(units: Units): void;
  put(path: string, value: unknown): void;
  replace(whole: Draft): void;
  reconsider(): void;
  unusable(job: unknown): Message | null;
  tooLong(length: number): Message;
}

export class HostInputs {
  /** Jobs sent by `job-change`, with their times. */
  private sentJobs: { json: string; at: number }[] = [];
  private asked: HostRequest = {};
  /** The rules of the host page. */
  rules = new Rules();
  /** The last job of the host page as it was given, and the job made from it. */
  private given: { job: Draft; whole: Draft } | null = null;

  constructor(private readonly store: Jobs) {}

  /** Notes a job that was sent by `job-change`; the host may return it. */
  sent(json: string): void {
    this.sentJobs = [
      ...this.sentJobs.slice(-49),
      { json, at: performance.now() },
    ];
  }

  /** Forgets the sent jobs: the next input replaces the form. */
  forget(): void {
    this.sentJobs = [];
  }

  /** The control that the host page requests. */
  get post(): string | undefined {
    return this.asked.post;
  }

  /** A job with the requests and rules of the host page for values that it omits. A value that is no object stays as it is. */
  filled(job: unknown, asked: HostRequest = this.asked): unknown {
    const whole = this.named(job, asked);
    return isObject(whole) ? this.rules.filled(whole) : whole;
  }

  private named(job: unknown, { cycle, post, units }: HostRequest): unknown {
    if (!isObject(job) || Array.isArray(job.cycles)) return job;
    const whole: Draft = { ...job };
    if (units && job.units === undefined) whole.units = units;
    if (cycle && isOut(job.cycle)) whole.cycle = { type: cycle };
    else if (cycle && isObject(job.cycle) && job.cycle.type === undefined)
      whole.cycle = { ...job.cycle, type: cycle };
    if (!post || !(isOut(job.control) || isObject(job.control))) return whole;
    const control: Draft = { ...(job.control as Draft | null | undefined) };
    if (control.post !== undefined) return whole;
    const { type } = isObject(whole.cycle) ? whole.cycle : {};
    const forms = this.store.formsOf(post, String(type));
    const form =
      control.form === undefined && forms.length > 0 && !forms.includes("moves")
        ? { form: forms[0] }
        : {};
    whole.control = { ...control, ...form, post };
    return whole;
  }

  /** The default job of a cycle for the control and units that the host page requests. */
  fresh(type: Cycle["type"]): Draft {
    const { post, units } = this.asked;
    const job = structuredClone(
      defaultJob(type, units ?? this.rules.units(this.store.units)),
    ) as unknown as Draft;
    const named = this.named(
      post ? withoutControl(job) : job,
      this.asked,
    ) as Draft;
    return this.rules.laid(named, post !== undefined);
  }

  /** The job of a text. A dump specifies no control: its default gives way to the requested one. */
  ofText(job: Draft, findings: Finding[]): Draft {
    return this.asked.post &&
      findings.some(({ code }) => code === "not-in-dump")
      ? withoutControl(job)
      : job;
  }

  /** Warnings if the job specifies another control or other units than the host page requests. */
  differences(): Finding[] {
    const { asked, store } = this;
    const found: Finding[] = [];
    const note = (code: FindingCode, path: string, ...said: Message) =>
      found.push({ level: "warning", code, path, message: say(said), said });
    const [wanted, named] = [store.postOf(asked.post), store.post];
    if (wanted && named && wanted !== named)
      note(
        "other-control",
        "control.post",
        w(
          "The host page asks for {asked}, this job specifies {named}: the program is for {named}",
        ),
        wanted.title,
        named.title,
      );
    const { units } = store.draft;
    if (
      asked.units &&
      (units === "mm" || units === "inch") &&
      units !== asked.units
    )
      note(
        "other-units",
        "units",
        w(
          "The host page asks for {asked}, this job is in {named}: the program is in {named}",
        ),
        asked.units,
        units,
      );
    return found;
  }

  /** Errors that refuse a config. */
  private faults(value: unknown): Finding[] {
    const config = configOf(value);
    if (config === undefined)
      return [
        refused(
          "config",
          "not-json",
          w("Nothing was changed: the config is not JSON"),
        ),
      ];
    const problems = checkConfig(config).filter(
      ({ level }) => level === "error",
    );
    return problems.map((f) => ({
      ...refused(
        "config",
        f.code,
        w("Nothing was changed: the config cannot be used: {problem}"),
        f.said,
      ),
      path: f.path,
    }));
  }

  /** All reasons why inputs cannot be applied. */
  refusals(
    input: Input | Setting,
    value: unknown,
    asked: HostRequest = {},
  ): Finding[] {
    if (input === "config") return this.faults(value);
    const refusal = this.refusal(input, value, asked);
    return refusal ? [refusal] : [];
  }

  /** Reason why one input cannot be applied; null if it can. Changes nothing. `asked`: the other requests made at the same time. */
  private refusal(
    input: Exclude<Input, "config"> | Setting,
    value: unknown,
    asked: HostRequest = {},
  ): Finding | null {
    try {
      if (input === "job") return this.read(value, asked).refusal ?? null;
      if (input === "measured") {
        if (typeof value !== "string")
          return refused(
            input,
            "wrong-type",
            w("Nothing was changed: {input} must be text"),
            input,
          );
        const { store } = this;
        return value.length > store.longest
          ? refused(input, "too-long", ...store.tooLong(value.length))
          : null;
      }
      if (input === "readonly")
        return typeof value === "boolean"
          ? null
          : refused(
              input,
              "wrong-type",
              w("Nothing was changed: {input} must be true or false"),
              input,
            );
      if (input === "lang")
        return typeof value === "string" && /^[a-z0-9-]{0,35}$/i.test(value)
          ? null
          : refused(
              input,
              "unknown-value",
              w("Nothing was changed: {input} must be a BCP 47 tag"),
              input,
            );
      const { cycles, posts } = this.store.catalog;
      const known = {
        cycle: cycles.map((c) => c.type as string),
        post: posts.map((p) => p.id as string),
        units: ["mm", "inch"],
      };
      return known[input].includes(value as string)
        ? null
        : this.unknown(input, known[input]);
    } catch {
      return refused(
        input,
        "unreadable",
        w("Nothing was changed: the {input} cannot be read"),
        input,
      );
    }
  }

  /** Message for an unknown word. `several`: more than one word may be given. */
  unknown(input: string, known: readonly string[], several = false): Finding {
    const template = several
      ? w("Nothing was changed: {input} must be some of {known}")
      : w("Nothing was changed: {input} must be one of {known}");
    return refused(input, "unknown-value", template, input, known.join(", "));
  }

  /** Applies a job, cycle, control, units or config. An input with errors changes nothing; returns its findings. */
  input(input: Input, value: unknown): Finding[] {
    return this.store.asHost(() => this.put(input, value));
  }

  private put(input: Input, value: unknown): Finding[] {
    const { store } = this;
    try {
      if (input === "job") return this.take(value);
      const refusals = this.refusals(input, value);
      if (refusals.length > 0) return refusals;
      if (input === "config") {
        this.configure(structuredClone(configOf(value)) as Config);
        return [];
      }
      if (input === "measured") {
        if (store.measured !== value) store.measured = value as string;
        return [];
      }
      this.asked = { ...this.asked, [input]: value };
      const { revision } = store;
      if (input === "cycle") store.choose(value as Cycle["type"]);
      else if (input === "units") store.setUnits(value as Units);
      else if (value !== store.get("control.post"))
        store.put("control", {
          ...store.controlOf(value),
          workOffset: store.get("control.workOffset"),
        });
      // The job may have the requested values already.
      if (store.revision === revision) store.reconsider();
      return [];
    } catch {
      return [
        refused(
          input,
          "unreadable",
          w("Nothing was changed: the {input} cannot be read"),
          input,
        ),
      ];
    }
  }

  /** Applies other rules. They fill in the portal's job if the user has not changed it, else only fields with their defaults. */
  private configure(config: Config | null): void {
    const { store, given } = this;
    this.rules = new Rules(config);
    if (!given || !alike(given.whole, store.job)) {
      store.configure();
      return;
    }
    const filled = this.filled(given.job) as Draft;
    const whole = Array.isArray(filled.cycles)
      ? filled
      : complete(filled, store.catalog);
    if (alike(whole, store.job)) store.reconsider();
    else {
      store.replace(whole);
      this.given = { job: given.job, whole: structuredClone(store.job) };
    }
  }

  /** Withdraws a request of the host page. The job stays as it is. */
  release(input: keyof HostRequest | "config"): void {
    if (input === "config") {
      if (!this.rules.config) return;
      this.rules = new Rules();
      this.store.asHost(() => this.store.reconsider());
      return;
    }
    if (this.asked[input] === undefined) return;
    const { [input]: _, ...rest } = this.asked;
    this.asked = rest;
    this.store.asHost(() => this.store.reconsider());
  }

  /** Reads a job of the host with its requests, or reports why it cannot be shown. */
  private read(
    value: unknown,
    asked: HostRequest = {},
  ): { job?: Draft; own?: Draft; refusal?: Finding } {
    const { store } = this;
    let job = value;
    if (typeof value === "string") {
      if (value.length > store.longest)
        return {
          refusal: refused("job", "too-long", ...store.tooLong(value.length)),
        };
      try {
        job = JSON.parse(value);
      } catch {
        return {
          refusal: refused(
            "job",
            "not-json",
            w("Nothing was changed: the job is not JSON"),
          ),
        };
      }
    }
    if (isTooLarge(job))
      return {
        refusal: refused(
          "job",
          "too-long",
          w("Nothing was changed: this job is too large, or nested too deeply"),
        ),
      };
    // Throws for a value without JSON, such as a BigInt or a circular object.
    JSON.stringify(job);
    const own = job as Draft;
    job = this.filled(job, { ...this.asked, ...asked });
    const problem = store.unusable(job);
    if (problem)
      return {
        refusal: refused(
          "job",
          "unusable",
          w("Nothing was changed: the job cannot be used: {problem}"),
          problem,
        ),
      };
    return { job: job as Draft, own };
  }

  private take(value: unknown): Finding[] {
    const { store } = this;
    const { job, own, refusal } = this.read(value);
    if (!job || !own) return refusal ? [refusal] : [];
    const whole = Array.isArray(job.cycles)
      ? job
      : complete(job, store.catalog);
    // A job that the host merely returns changes nothing, even if it arrives late while the user is typing.
    const recent = this.sentJobs.filter(
      ({ at }) => performance.now() - at < ECHO,
    );
    const late = recent.some(({ json }) => alike(whole, JSON.parse(json)));
    if (late) return [];
    if (!alike(whole, store.job)) {
      store.replace(whole);
      this.forget();
    }
    this.given = {
      job: structuredClone(own),
      whole: structuredClone(store.job),
    };
    return [];
  }
}

/** A config, as an object or as JSON; undefined if the JSON is invalid. */
function configOf(value: unknown): unknown {
  if (typeof value !== "string") return value;
  try {
    return JSON.parse(value);
  } catch {
    return undefined;
  }
}
