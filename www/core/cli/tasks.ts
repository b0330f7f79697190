// What the command does with one job: text in, texts out. No files, no streams, no exit codes.
import {
  check,
  evaluate,
  exportTable,
  type Finding,
  importJob,
  type Job,
  JobError,
  type ProgramMoves,
  type Programmed,
  plan,
  programs,
  type ResultRow,
  readProgram,
  svg,
} from "../node.js";

/** What is done with every job. */
export interface Task {
  command: "plan" | "check" | "table" | "import" | "moves" | "evaluate" | "svg";
  /** The control and the form of the program, in the place of the job's own. */
  post?: string;
  form?: string;
  format?: "csv" | "json" | "text";
  view?: "top" | "front" | "side" | "isometric";
  /** Points that a machine measured, as text. */
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
    if (task.command === "moves") return moves(source, text, task.format ?? "text");
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
  const results = evaluate(job, task.points ?? "");
  const out = task.format === "json" ? `${JSON.stringify(results, null, 2)}\n` : listed(results);
  return { ending: `-results.${task.format === "json" ? "json" : "txt"}`, out, findings: plan(job).findings };
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
    const none = "This program says no job, only moves: there is no job to write. touchpath moves lists them";
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

/** The moves of a program, line by line as an editor counts them. A text without any is a failure: there is nothing to list. */
function moves(source: string, text: string, format: NonNullable<Task["format"]>): Outcome {
  const read = readProgram(text);
  const name = (source.split(/[/\\]/).pop() ?? "").replace(/\.[^.]*$/, "");
  const ending = `-moves.${format === "text" ? "txt" : format}`;
  const out = format === "json" ? movesAsJson(read) : format === "csv" ? movesAsCsv(read) : movesAsText(read);
  return { source, output: { name, ending, text: out }, findings: read.findings, failed: read.kind.length === 0 };
}

/** One move as a row: what is not known is NaN. */
function* rowsOf({ line, kind, kinds, to, feed }: ProgramMoves): Generator<[number, string, number[]]> {
  for (const [i, at] of line.entries())
    yield [at + 1, kinds[kind[i] as number] as string, [...to.subarray(3 * i, 3 * i + 3), feed[i] as number]];
}

function movesAsJson(read: ProgramMoves): string {
  const { dialect, units, plane, arcs, findings } = read;
  const known = (x: number) => (Number.isNaN(x) ? null : x);
  const list = [...rowsOf(read)].map(([line, kind, [x, y, z, feed]]) => ({
    line,
    kind,
    to: [x, y, z].map((x) => known(x as number)),
    feed: known(feed as number),
    arc: null as { center: number[]; sweep: number; plane: string } | null,
  }));
  for (let i = 0; i < arcs.length; i += 6) {
    const [move, x, y, z, sweep, plane] = arcs.subarray(i, i + 6) as unknown as [
      number,
      number,
      number,
      number,
      number,
      number,
    ];
    const own = list[move];
    if (own) own.arc = { center: [x, y, z], sweep, plane: `G${plane}` };
  }
  return `${JSON.stringify({ dialect, units, plane, moves: list, findings }, null, 2)}\n`;
}

function movesAsCsv(read: ProgramMoves): string {
  let out = "line,kind,x,y,z,feed\n";
  for (const [line, kind, numbers] of rowsOf(read))
    out += `${line},${kind},${numbers.map((x) => (Number.isNaN(x) ? "" : x)).join(",")}\n`;
  return out;
}

function movesAsText(read: ProgramMoves): string {
  const row = ([line, kind, ...numbers]: string[]) =>
    `${(line as string).padStart(7)}  ${(kind as string).padEnd(5)}${numbers.map((x) => `  ${x.padStart(11)}`).join("")}\n`;
  let out = row(["line", "kind", "X", "Y", "Z", "feed"]);
  for (const [line, kind, numbers] of rowsOf(read))
    out += row([String(line), kind, ...numbers.map((x) => (Number.isNaN(x) ? "-" : x.toFixed(4)))]);
  return out;
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
