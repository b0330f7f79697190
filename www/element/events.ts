// Events of the element, and its value in a form.
import type { Finding, Job, Plan } from "../core/types.js";
import type { App } from "../parts/app.js";
import type { Store } from "../store.js";

/** Details of the element's events, by event name. */
export interface TouchPathEvents {
  "job-change": CustomEvent<{ job: Job }>;
  "plan-change": CustomEvent<{ plan: Plan }>;
  "program-save": CustomEvent<{
    name: string;
    text: string;
    post: string;
    extension: string;
  }>;
  "selection-change": CustomEvent<Selection>;
  "measured-change": CustomEvent<{ measured: string }>;
  finding: CustomEvent<{ findings: Finding[]; refused: boolean }>;
}

/** The user's selection: a move, its program line and its touch, all counted from 0, and the path of the focused field. `null` without a selection. */
export interface Selection {
  move: number | null;
  line: number | null;
  touch: number | null;
  field: string | null;
}

/** A plan for an event. It is copied on first access, so listeners that do not read it cost nothing. */
function copyOf(own: Plan): { plan: Plan } {
  let copy: Plan | null = null;
  return {
    get plan() {
      copy ??= structuredClone(own);
      return copy;
    },
  };
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
  let job = "";
  let findings = "";
  let plan: Plan | null = null;
  let measured = store.measured;
  /** Whether a user's change still waits for its `change` event. */
  let commit = false;
  const committed = () => {
    if (!commit || !store.userChange) return;
    commit = false;
    element.dispatchEvent(new Event("change", { bubbles: true }));
  };
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
  const changed = (byUser: boolean) => {
    const { stale } = store;
    if (store.measured !== measured) {
      measured = store.measured;
      if (byUser) element.tell("measured-change", { measured });
    }
    const before = job;
    job = JSON.stringify(store.job);
    inside.setFormValue(job);
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
    // The text of a field may change without the job: `30+2` becomes 32 when the field is left.
    if (byUser && job !== before) {
      store.outside.sent(job);
      element.tell("job-change", { job: JSON.parse(job) });
      element.dispatchEvent(
        new Event("input", { bubbles: true, composed: true }),
      );
      commit = true;
    }
    if (!stale && store.plan !== plan) {
      plan = store.plan;
      element.tell("plan-change", copyOf(plan));
    }
    const found = JSON.stringify(store.findings);
    if (found !== findings) {
      findings = found;
      element.tell("finding", { findings: JSON.parse(found), refused: false });
    }
  };
  store.addEventListener("change", () => {
    changed(store.userChange);
    // The selected move may have disappeared with its plan.
    selected();
  });
  store.addEventListener("edit-committed", committed);
  store.addEventListener("select", selected);
  app.updateComplete.then(() => changed(false));
}
