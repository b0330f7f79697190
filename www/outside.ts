// What the page around the element puts in, and which jobs were sent to it.
import { type Cycle, type Finding, type Said, say } from "./core/browser.js";
import { alike, complete, type Draft } from "./job.js";
import type { Store, Units } from "./store.js";
import { w } from "./words.js";

/** Milliseconds in which a host may return a job that it received by `job-change`: frames and stores answer late. */
const ECHO = 1000;

type Input = "job" | "cycle" | "post" | "units";
type Refused = (code: string, ...said: Said) => Finding;

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

  /** Takes a job, a cycle, a control or units. What cannot be taken changes nothing: why, as a finding. */
  input(input: Input, value: unknown): Finding | null {
    const { store } = this;
    const refused: Refused = (code, ...said) => {
      const path = { job: "", cycle: "cycle.type", post: "control.post", units: "units" }[input];
      return { level: "error", code, path, message: say(said), said };
    };
    store.byUser = false;
    try {
      if (input === "job") return this.job(value, refused);
      const known = {
        cycle: store.catalog.cycles.map((c) => c.type as string),
        post: store.catalog.posts.map((p) => p.id),
        units: ["mm", "inch"],
      }[input];
      if (!known.includes(value as string))
        return refused(
          "unknown-value",
          w("Nothing was changed: {input} must be one of {known}"),
          input,
          known.join(", "),
        );
      if (input === "cycle") store.choose(value as Cycle["type"]);
      else if (input === "units") store.setUnits(value as Units);
      else if (value !== store.get("control.post"))
        store.put("control", { ...store.controlOf(value), workOffset: store.get("control.workOffset") });
      return null;
    } catch {
      return refused("unreadable", w("Nothing was changed: the {input} cannot be read"), input);
    } finally {
      store.byUser = true;
    }
  }

  private job(value: unknown, refused: Refused): Finding | null {
    const { store } = this;
    let job = value;
    if (typeof value === "string") {
      if (value.length > store.longest) return refused("too-long", ...store.tooLong(value.length));
      try {
        job = JSON.parse(value);
      } catch {
        return refused("not-json", w("Nothing was changed: the job is not JSON"));
      }
    }
    // What has no JSON, as a BigInt or an object inside itself, no form could send: it throws.
    JSON.stringify(job);
    const problem = store.unusable(job);
    if (problem) return refused("unusable", w("Nothing was changed: the job cannot be used: {problem}"), problem);
    const whole = complete(job as Draft, store.catalog);
    // A job that the host only returns changes nothing, also where it arrives late, while the user is still typing.
    const recent = this.sentJobs.filter(({ at }) => performance.now() - at < ECHO);
    const late = recent.some(({ json }) => alike(whole, JSON.parse(json)));
    if (late || alike(whole, store.draft)) return null;
    store.replace(whole);
    this.forget();
    return null;
  }
}
