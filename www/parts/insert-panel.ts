// The program of the job inside another program: where it is, other places, and saving the whole.
import { html, nothing, type TemplateResult } from "lit";
import {
  type AnyJob,
  type Insertion,
  insertProgram,
  JobError,
} from "../core/browser.js";
import type { FileText } from "../core/bytes.js";
import type { Store } from "../store.js";
import { noteList } from "./run-panel.js";

/** Another program with the program of the job in it. */
export interface Into {
  /** The other program, whether its file is UTF-8, and its name. */
  other: string;
  isUtf8: boolean;
  name: string;
  /** The line after which the program goes, counted from 0; `null`: after the tool change of the probe. */
  line: number | null;
  /** Name of the job. */
  job: string;
  made: Insertion | null;
  /** Reason if it is not in the other program. */
  why: string;
}

/** Inserts the program of the form into another one. */
export function into(
  store: Store,
  { text: other, isUtf8 }: FileText,
  name: string,
  line: number | null = null,
): Into {
  const job = store.shown as unknown as AnyJob;
  const all = { other, isUtf8, name, line, job: job.name ?? "" };
  try {
    const made = insertProgram(job, other, line === null ? {} : { line });
    return { ...all, made, why: "" };
  } catch (thrown) {
    if (!(thrown instanceof JobError)) throw thrown;
    return { ...all, made: null, why: store.why(thrown) };
  }
}

/** The panel beside the moves of the whole program. */
export function insertPanel(
  store: Store,
  { name, line, job, made, why }: Into,
  put: (line: number) => void,
  save: () => void,
): TemplateResult {
  const t = store.t.bind(store);
  const chosen = (event: Event) => {
    const line = Number((event.target as HTMLInputElement).value);
    if (Number.isInteger(line) && line > 0) put(line - 1);
  };
  const places = made?.places ?? [];
  const place = made?.line ?? line;
  return html`<section class="into" aria-label=${t("Insert into a program")}>
    ${
      made
        ? html`<p role="status">${t("{job} is in lines {first} to {last} of {file}. All other lines are unchanged.", job, made.first + 1, made.first + made.count, name)}</p>`
        : html`<p role="status" class="warning">${why}</p>`
    }
    ${noteList(made?.findings.map(({ said }) => store.say(said)) ?? [])}
    <p class="tools">
      <label>${t("After line")} <input type="text" inputmode="numeric" size="6" .value=${place === null ? "" : String(place + 1)} @change=${chosen} /></label>
      ${
        places.length > 0
          ? html`<label>${t("Tool change")} <select @change=${chosen}><option value=""></option>${places.map(({ line, tool, probe }) => html`<option value=${line + 1} ?selected=${line === place}>${line + 1}: ${tool ?? ""}${probe ? ` (${t("probe")})` : ""}</option>`)}</select></label>`
          : nothing
      }
      <button type="button" class="primary" ?disabled=${!made} @click=${save}>${t("Save {file}", name)}</button>
    </p>
  </section>`;
}
