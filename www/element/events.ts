// Events of the element, and its value in a form.
import type {
  ChangeReason,
  Selection,
  TouchPathEvents,
} from "../core/events.js";
import type { AnyJob, Finding, Plan } from "../core/types.js";
import type { App } from "../parts/app.js";
import type { Store } from "../store.js";

/** State that the events tell: the job and its findings as JSON, its plan, and the measured points. */
interface Told {
  job: string;
  plan: Plan | null;
  findings: string;
  measured: string;
}

/** Copies of the state, shared by the events of one change. Each is made on first access: listeners that do not read it cost nothing. */
class Copies {
  private readonly made: {
    job?: AnyJob;
    plan?: Plan | null;
    findings?: Finding[];
  } = {};

  constructor(private readonly told: Told) {}

  get job(): AnyJob {
    this.made.job ??= JSON.parse(this.told.job) as AnyJob;
    return this.made.job;
  }

  get plan(): Plan | null {
    this.made.plan ??= structuredClone(this.told.plan);
    return this.made.plan;
  }

  get findings(): Finding[] {
    this.made.findings ??= JSON.parse(this.told.findings) as Finding[];
    return this.made.findings;
  }
}

/** The detail of an event with some of the copies, as own properties: they survive a structured clone. */
function detailOf<K extends "job" | "plan" | "findings", T extends object>(
  copies: Copies,
  keys: readonly K[],
  rest: T,
): Pick<Copies, K> & T {
  for (const key of keys)
    Object.defineProperty(rest, key, {
      get: () => copies[key],
      enumerable: true,
    });
  return rest as Pick<Copies, K> & T;
}

/** The element that dispatches the events. @internal */
interface Dispatcher extends HTMLElement {
  tell<K extends keyof TouchPathEvents>(
    name: K,
    detail: TouchPathEvents[K]["detail"],
  ): boolean;
}

/** Dispatches the element's events and sets the form's value whenever the job changes. @internal */
export function followJob(
  element: Dispatcher,
  inside: ElementInternals,
  { store, app }: { store: Store; app: App },
): void {
  let selection = JSON.stringify({
    move: null,
    line: null,
    touch: null,
    field: null,
  });
  const selected = () => {
    const { selected: move, focused: field } = store;
    const line =
      move === null ? -1 : (store.plan.program.moveLines[move] ?? -1);
    const touch =
      move === null ? null : (store.plan.moves[move]?.touch ?? null);
    const now: Selection = {
      move,
      line: line < 0 ? null : line,
      touch,
      field,
    };
    if (JSON.stringify(now) === selection) return;
    selection = JSON.stringify(now);
    element.tell("selection-change", now);
  };
  /** The last state that was told, and what waits to be told: a listener may change the job in the middle of an event. */
  let told: Told = {
    job: "",
    plan: null,
    findings: "",
    measured: store.measured,
  };
  let newest = told;
  const waiting: { now: Told; reason: ChangeReason }[] = [];
  let busy = false;
  const state = (): Told => {
    const job = JSON.stringify(store.job);
    const findings = JSON.stringify(store.wholeFindings);
    const { measured } = store;
    const plan = store.stale ? null : store.plan;
    // A job that is planned again has the plan of before.
    const same = job === newest.job && findings === newest.findings;
    const kept = same && plan && newest.plan;
    newest = { job, plan: kept || plan, findings, measured };
    return newest;
  };
  /** Sets the value in a form, and the reason why it must not be submitted. */
  const submits = () => {
    inside.setFormValue(newest.job);
    // The browser shows a message at an element that can have the focus.
    const anchor = app.querySelector<HTMLElement>(
      "tp-bar select:enabled, canvas[tabindex]",
    );
    if (store.withheld === null) inside.setValidity({});
    else
      inside.setValidity(
        { customError: true },
        store.withheld,
        anchor ?? undefined,
      );
  };
  const tell = (now: Told, reason: ChangeReason) => {
    const byUser = reason !== "host";
    const before = told;
    told = now;
    const copies = new Copies(now);
    if (now.measured !== before.measured && byUser)
      element.tell("measured-change", { measured: now.measured });
    // The text of a field may change without the job: `30+2` becomes 32 when the field is left.
    if (now.job !== before.job && byUser) {
      store.outside.sent(now.job);
      element.tell("job-change", detailOf(copies, ["job"], {}));
      element.dispatchEvent(
        new Event("input", { bubbles: true, composed: true }),
      );
    }
    if (now.plan !== before.plan)
      element.tell("plan-change", detailOf(copies, ["plan"], {}));
    if (now.findings !== before.findings) {
      const refused = { refused: false };
      element.tell("finding", detailOf(copies, ["findings"], refused));
    }
    if (
      now.job === before.job &&
      now.plan === before.plan &&
      now.findings === before.findings
    )
      return;
    const all = ["job", "plan", "findings"] as const;
    element.tell("change", detailOf(copies, all, { reason }));
  };
  const changed = (reason: ChangeReason) => {
    waiting.push({ now: state(), reason });
    submits();
    if (busy) return;
    busy = true;
    try {
      for (let next = waiting.shift(); next; next = waiting.shift())
        tell(next.now, next.reason);
    } finally {
      busy = false;
    }
  };
  store.addEventListener("change", () => {
    changed(store.changeReason);
    // The selected move may have disappeared with its plan.
    selected();
  });
  store.addEventListener("select", selected);
  app.updateComplete.then(() => changed("host"));
}
