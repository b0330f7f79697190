// What the command does with one job: text in, texts out. No files, no streams, no exit codes.
import {
  check,
  exportTable,
  type Finding,
  importJob,
  type Job,
  JobError,
  type Measurement,
  measure,
  type Programmed,
  plan,
  programs,
  type ResultRow,
  svg,
} from "../node.js";

/** What is done with every job. */
export interface Task {
  command: "plan" | "check" | "table" | "import" | "evaluate" | "svg";
  /** The control and the form of the program, in the place of the job's own. */
  post?: string;
  form?: string;
  format?: "csv" | "json" | "text";
  view?: "top" | "front" | "side" | "isometric";
  /** What a machine measured, as text. */
  points?: string;
}

/** A job's text and where it stands. */
export interface Item {
  source: string;
  text: string;
  /** Why there is no text; the findings of it then. */
  refused?: string;
}

/** What became of it. */
export interface Outcome {
  source: string;
  /** The job's name, and what its output is called after it; `null` where there is no output. */
  output: { name: string; ending: string; text: string } | null;
  findings: Finding[];
  /** Whether there is no output, or there would have been none. */
  failed: boolean;
}

/** Does the task. Never throws for anything that stands in the text. */
export function perform(task: Task, item: Item): Outcome {
  const { source, text } = item;
  try {
    if (item.refused !== undefined) throw new JobError(item.refused, [problem("too-long", item.refused)]);
    if (task.command === "import") return imported(source, text);
    const job = read(text, task);
    if (task.command === "check") {
      const findings = check(job);
      return { source, output: null, findings, failed: findings.some((f) => f.level === "error") };
    }
    const { ending, out, findings } = made(task, job as Job);
    return { source, output: { name: String((job as Job).name ?? ""), ending, text: out }, findings, failed: false };
  } catch (thrown) {
    const message = thrown instanceof Error ? thrown.message : String(thrown);
    const findings =
      thrown instanceof JobError && thrown.findings.length > 0 ? thrown.findings : [problem("unreadable", message)];
    return { source, output: null, findings, failed: true };
  }
}

const problem = (code: string, message: string): Finding => ({
  level: "error",
  code,
  path: "",
  message,
  said: [message],
});

function made(task: Task, job: Job): { ending: string; out: string; findings: Finding[] } {
  if (task.command === "plan") {
    // Program and findings of one plan.
    const { program, findings } = programs([job]).next().value as Programmed;
    if (!program) throw new JobError("", findings);
    return { ending: `.${program.extension}`, out: program.text, findings };
  }
  if (task.command === "svg") return { ending: ".svg", out: svg(job, task.view), findings: check(job) };
  if (task.command === "table") {
    const format = task.format ?? "text";
    return {
      ending: `-parameters.${format === "text" ? "txt" : format}`,
      out: exportTable(job, format),
      findings: check(job),
    };
  }
  const measured = measure(job, task.points ?? "");
  const out = task.format === "json" ? `${JSON.stringify(measured.results, null, 2)}\n` : printed(measured);
  const findings = [...plan(job).findings, ...measured.findings];
  return { ending: `-results.${task.format === "json" ? "json" : "txt"}`, out, findings };
}

/** Results as columns for people, how the text was read, and the block that is to be typed. */
function printed({ results, block, findings }: Measurement): string {
  const notes = findings.filter((f) => f.level === "info").map((f) => `${f.message}\n`);
  return [listed(results), notes.length > 0 ? "\n" : "", ...notes, block === null ? "" : `\n${block}\n`].join("");
}

/** The job of a text; what is no JSON is a job that is refused. */
function read(text: string, task: Task): unknown {
  let job: unknown;
  try {
    job = JSON.parse(text.replace(/^\uFEFF/, ""));
  } catch (thrown) {
    const why = `This is not JSON: ${thrown instanceof Error ? thrown.message : thrown}`;
    throw new JobError(why, [problem("not-json", why)]);
  }
  if (typeof job !== "object" || job === null || (task.post === undefined && task.form === undefined)) return job;
  const { control } = job as { control?: unknown };
  const own = typeof control === "object" && control !== null ? control : {};
  const wanted = {
    ...(task.post === undefined ? {} : { post: task.post }),
    ...(task.form === undefined ? {} : { form: task.form }),
  };
  return { ...job, control: { ...own, ...wanted } };
}

function imported(source: string, text: string): Outcome {
  const { job, findings, trace } = importJob(text);
  if (trace || !job) {
    const none = "This program says no job, only moves: there is no job to write";
    return { source, output: null, findings: [problem("nothing-to-import", none), ...findings], failed: true };
  }
  const name = typeof job.name === "string" ? job.name : "";
  return {
    source,
    output: { name, ending: ".json", text: `${JSON.stringify(job, null, 2)}\n` },
    findings,
    failed: findings.some((f) => f.level === "error"),
  };
}

/** Results as columns for people. */
function listed(rows: ResultRow[]): string {
  const number = (x: number | string | null) => (typeof x === "number" ? x.toFixed(4) : (x ?? "-"));
  const lines = rows.map((row) => [
    row.code,
    number(row.nominal),
    number(row.value),
    number(row.deviation),
    number(row.uncertainty),
    row.unit,
    row.verdict ?? "",
  ]);
  const table = [["result", "nominal", "value", "deviation", "sigma", "unit", "verdict"], ...lines];
  const widths = (table[0] as string[]).map((_, i) => Math.max(...table.map((line) => (line[i] as string).length)));
  const right = (i: number) => i > 0 && i < 5;
  const cell = (text: string, i: number) =>
    right(i) ? text.padStart(widths[i] as number) : text.padEnd(widths[i] as number);
  return table.map((line) => `${line.map(cell).join("  ").trimEnd()}\n`).join("");
}
