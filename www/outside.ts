// What the page around the element puts in, and which jobs were sent to it.
import { type Cycle, type Finding, type Said, say } from "./core/browser.js";
import { alike, complete, type Draft } from "./job.js";
import type { Store, Units } from "./store.js";
import { w } from "./words.js";

/** Milliseconds in which a host may return a job that it received by `job-change`: frames and stores answer late. */
const ECHO = 1000;

type Input = "job" | "cycle" | "post" | "units";
type Setting = "lang" | "readonly";

/** Where in the job an input stands. */
const PATHS: Readonly<Record<string, string>> = { cycle: "cycle.type", post: "control.post", units: "units" };

function refused(input: string, code: string, ...said: Said): Finding {
  return { level: "error", code, path: PATHS[input] ?? "", message: say(said), said };
}

export class Outside {
  /** The jobs that were sent by `job-change`, and when. */
  private sentJobs: { json: string; at: number }[] = [];

  constructor(private readonly store: Store) {}

  /** A job was sent by `job-change`; the host may return it. */
  sent(json: string): void {
    this.sentJobs = [...this.sentJobs.slice(-49), { json, at: performance.now() }];
  }

  /** What comes now is no answer to a job that was sent: a form is put back. */
  forget(): void {
    this.sentJobs = [];
  }

  /** Why an input or a setting cannot be taken; null where it can. Nothing is changed. */
  refusal(input: Input | Setting, value: unknown): Finding | null {
    try {
      if (input === "job") return this.read(value).refusal ?? null;
      if (input === "readonly")
        return typeof value === "boolean"
          ? null
          : refused(input, "wrong-type", w("Nothing was changed: {input} must be true or false"), input);
      if (input === "lang")
        return typeof value === "string" && /^[a-z0-9-]{0,35}$/i.test(value)
          ? null
          : refused(input, "unknown-value", w("Nothing was changed: {input} must be a BCP 47 tag"), input);
      const { cycles, posts } = this.store.catalog;
      const known = {
        cycle: cycles.map((c) => c.type as string),
        post: posts.map((p) => p.id as string),
        units: ["mm", "inch"],
      };
      return known[input].includes(value as string) ? null : this.unknown(input, known[input]);
    } catch {
      return refused(input, "unreadable", w("Nothing was changed: the {input} cannot be read"), input);
    }
  }

  /** That a word is none of those that are known; `several`: some of them may be given. */
  unknown(input: string, known: readonly string[], several = false): Finding {
    const template = several
      ? w("Nothing was changed: {input} must be some of {known}")
      : w("Nothing was changed: {input} must be one of {known}");
    return refused(input, "unknown-value", template, input, known.join(", "));
  }

  /** Takes a job, a cycle, a control or units. What cannot be taken changes nothing: why, as a finding. */
  input(input: Input, value: unknown): Finding | null {
    const { store } = this;
    store.byUser = false;
    try {
      if (input === "job") return this.take(value);
      const refusal = this.refusal(input, value);
      if (refusal) return refusal;
      if (input === "cycle") store.choose(value as Cycle["type"]);
      else if (input === "units") store.setUnits(value as Units);
      else if (value !== store.get("control.post"))
        store.put("control", { ...store.controlOf(value), workOffset: store.get("control.workOffset") });
      return null;
    } catch {
      return refused(input, "unreadable", w("Nothing was changed: the {input} cannot be read"), input);
    } finally {
      store.byUser = true;
    }
  }

  /** A job as the host gives it, or why it cannot be shown. */
  private read(value: unknown): { job?: Draft; refusal?: Finding } {
    const { store } = this;
    let job = value;
    if (typeof value === "string") {
      if (value.length > store.longest) return { refusal: refused("job", "too-long", ...store.tooLong(value.length)) };
      try {
        job = JSON.parse(value);
      } catch {
        return { refusal: refused("job", "not-json", w("Nothing was changed: the job is not JSON")) };
      }
    }
    // What has no JSON, as a BigInt or an object inside itself, no form could send: it throws.
    JSON.stringify(job);
    const problem = store.unusable(job);
    if (problem)
      return {
        refusal: refused("job", "unusable", w("Nothing was changed: the job cannot be used: {problem}"), problem),
      };
    return { job: job as Draft };
  }

  private take(value: unknown): Finding | null {
    const { store } = this;
    const { job, refusal } = this.read(value);
    if (!job) return refusal ?? null;
    const whole = complete(job, store.catalog);
    // A job that the host only returns changes nothing, also where it arrives late, while the user is still typing.
    const recent = this.sentJobs.filter(({ at }) => performance.now() - at < ECHO);
    const late = recent.some(({ json }) => alike(whole, JSON.parse(json)));
    if (late || alike(whole, store.draft)) return null;
    store.replace(whole);
    this.forget();
    return null;
  }
}
