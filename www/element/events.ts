// Events of the element, and its value in a form.
import type {
  ChangeReason,
  Selection,
  TouchPathEvents,
} from "../core/events.js";
import type { AnyJob, Finding, Plan } from "../core/types.js";
import type { App } from "../parts/app.js";
import type { Store } from "../store.js";

/** State that the events tell: the job and its findings as JSON, and its plan. */
interface Told {
  job: string;
  plan: Plan | null;
  findings: string;
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
  let measured = store.measured;
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
  let state: Told & { revision: number; copies: Copies };
  /** The present state. A listener may have changed it since the last event. */
  const now = () => {
    if (state?.revision === store.revision) return state;
    const told: Told = {
      job: JSON.stringify(store.job),
      plan: store.stale ? null : store.plan,
      findings: JSON.stringify(store.findings),
    };
    state = { ...told, revision: store.revision, copies: new Copies(told) };
    return state;
  };
  /** Last told state by each event, and by `change`. */
  const told: Told = { job: "", plan: null, findings: "" };
  let whole: Told = { ...told };
  /** Sets the value in a form, and the reason why it must not be submitted. */
  const submits = () => {
    inside.setFormValue(now().job);
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
  const changed = (reason: ChangeReason) => {
    const byUser = reason !== "host";
    if (store.measured !== measured) {
      measured = store.measured;
      if (byUser) element.tell("measured-change", { measured });
    }
    submits();
    // The text of a field may change without the job: `30+2` becomes 32 when the field is left.
    if (told.job !== now().job) {
      told.job = now().job;
      if (byUser) {
        store.outside.sent(told.job);
        element.tell("job-change", detailOf(now().copies, ["job"], {}));
        element.dispatchEvent(
          new Event("input", { bubbles: true, composed: true }),
        );
      }
    }
    if (told.plan !== now().plan) {
      told.plan = now().plan;
      element.tell("plan-change", detailOf(now().copies, ["plan"], {}));
    }
    if (told.findings !== now().findings) {
      told.findings = now().findings;
      const refused = { refused: false };
      element.tell("finding", detailOf(now().copies, ["findings"], refused));
    }
    const { job, plan, findings, copies } = now();
    if (job === whole.job && plan === whole.plan && findings === whole.findings)
      return;
    whole = { job, plan, findings };
    const all = ["job", "plan", "findings"] as const;
    element.tell("change", detailOf(copies, all, { reason }));
  };
  store.addEventListener("change", () => {
    changed(store.changeReason);
    // The selected move may have disappeared with its plan.
    selected();
  });
  store.addEventListener("select", selected);
  app.updateComplete.then(() => changed("host"));
}
