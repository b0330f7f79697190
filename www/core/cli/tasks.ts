// Performs a command for one job: text in, text out. No files, streams or exit codes.
import { createHash } from "node:crypto";
import {
  type Config,
  catalog,
  check,
  configured,
  exportTable,
  type Finding,
  type FindingCode,
  importJob,
  type Job,
  JobError,
  judged,
  type Measurement,
  measure,
  type Plan,
  type ProgramKnown,
  type ProgramMoves,
  type Programmed,
  plan,
  program,
  programs,
  type ResultRow,
  readProgram,
  runProgram,
  svg,
} from "../node.js";
import {
  type ReportOf,
  report,
  reportCsv,
  reportHtml,
  runsOf,
} from "../report.js";
import { codeOf, isBad, isWritten } from "../results.js";
import { examined, type ReportFormat } from "./examine.js";
import { type Place, placesIn } from "./place.js";
import { verified, verifiedText } from "./verify.js";

/** Task that is performed with every job. */
export interface Task {
  command:
    | "plan"
    | "check"
    | "table"
    | "import"
    | "moves"
    | "examine"
    | "verify"
    | "evaluate"
    | "report"
    | "svg";
  /** Control and program form that replace those of the job. */
  post?: string;
  form?: string;
  /** Whether the output is the whole plan as JSON. */
  whole?: boolean;
  /** Whether a job without errors needs no findings. */
  outputOnly?: boolean;
  /** Whether findings have a position in the text of the job. */
  places?: boolean;
  /** Whether the outcome has the hash of the job's text. */
  hashes?: boolean;
  /** Config that fills in and judges the jobs. */
  config?: Config;
  format?: "csv" | "github" | "html" | "json" | "junit" | "sarif" | "text";
  view?: "top" | "front" | "side" | "isometric";
  /** Measurements of a machine, as text. */
  points?: string;
  /** Measurements of the parts in a report, each as text or several in one text, and its header data. */
  parts?: string[];
  about?: Pick<ReportOf, "by" | "machine" | "when" | "note">;
  /** Inputs of a program; without them `moves` only reads it. */
  known?: ProgramKnown;
}

/** A job's text and its source. */
export interface Item {
  source: string;
  /** Folders that the output keeps. */
  place: string;
  text: string;
  /** Line in a file of jobs. */
  row?: number;
  /** Reason why there is no text, as a finding. */
  refused?: string;
}

/** A finding with its position in the text of its job. */
export type PlacedFinding = Finding & Partial<Place>;

/** Outcome of a job or program. */
export interface Outcome {
  source: string;
  /** Its line: of a job in a file of jobs, or the first line of a program that differs. */
  row?: number;
  place: string;
  /** SHA-256 of the job's text, if the task requests it. */
  given?: string;
  /** Name of the job, and the ending and text of its output; `null` without output. */
  output: { name: string; ending: string; text: string } | null;
  /** Control of the job by its post id; `null` if unknown. */
  control: string | null;
  findings: PlacedFinding[];
  /** Whether the job failed: there is no output, or there would be none. */
  failed: boolean;
}
type Done = Omit<Outcome, "source" | "place">;

/** Findings with positions in the text of a job. Findings about the whole job or the measurements have no position. */
function placed(text: string, findings: Finding[]): PlacedFinding[] {
  try {
    const place = placesIn(text);
    return findings.map((f) =>
      f.path === "" || f.path.startsWith("measured")
        ? f
        : { ...f, ...place(f.path) },
    );
  } catch {
    // Nested more deeply than the parser supports.
    return findings;
  }
}

/** Performs the task. Never throws, for any text. */
export function perform(task: Task, { source, place, ...item }: Item): Outcome {
  try {
    const outcome: Outcome = { source, place, ...done(task, source, item) };
    if (item.row !== undefined) outcome.row = item.row;
    if (task.hashes)
      outcome.given = createHash("sha256").update(item.text).digest("hex");
    if (task.places) outcome.findings = placed(item.text, outcome.findings);
    return outcome;
  } catch (thrown) {
    const message = thrown instanceof Error ? thrown.message : String(thrown);
    const findings =
      thrown instanceof JobError && thrown.findings.length > 0
        ? thrown.findings
        : [problem("unreadable", message)];
    const { row } = item;
    const none = {
      source,
      place,
      output: null,
      control: null,
      findings,
      failed: true,
    };
    return row === undefined ? none : { ...none, row };
  }
}

function done(
  task: Task,
  source: string,
  { text, refused }: Pick<Item, "text" | "refused">,
): Done {
  if (refused !== undefined)
    throw new JobError(refused, [problem("too-long", refused)]);
  if (task.command === "import") return imported(text);
  if (task.command === "moves") return moves(text, task, source);
  if (task.command === "verify") {
    const said = verified(text);
    const out =
      task.format === "json"
        ? `${JSON.stringify({ source, ...said })}\n`
        : verifiedText(source, said);
    const failed = !["same", "version"].includes(said.state);
    const { findings } = said;
    const output = { name: nameOf(source), ending: "-verified.txt", text: out };
    const [first] = said.lines;
    return {
      output,
      control: null,
      findings,
      failed,
      ...(first ? { row: first.line } : {}),
    };
  }
  if (task.command === "examine") {
    const {
      run,
      text: report,
      broken,
    } = examined(
      text,
      task.known ?? {},
      (task.format ?? "text") as ReportFormat,
      source,
    );
    const { findings } = run;
    return {
      output: { name: nameOf(source), ending: "-report.txt", text: report },
      control: null,
      findings,
      failed: broken,
    };
  }
  const { config } = task;
  const given = read(text, task);
  const job = config ? configured(given.job, config) : given.job;
  const overruled = [
    ...given.overruled,
    ...(config ? judged(job, config) : []),
  ];
  const control = controlOf(job);
  if (task.command === "check" || overruled.some((f) => f.level === "error")) {
    const findings = [...check(job), ...overruled];
    return {
      output: null,
      control,
      findings,
      failed: findings.some((f) => f.level === "error"),
    };
  }
  try {
    const { ending, out, findings, bad = false } = made(task, job as Job);
    const name = String((job as Job).name ?? "");
    return {
      output: { name, ending, text: out },
      control,
      findings: [...findings, ...overruled],
      failed: bad,
    };
  } catch (thrown) {
    if (!(thrown instanceof JobError)) throw thrown;
    return {
      output: null,
      control,
      findings: [...thrown.findings, ...overruled],
      failed: true,
    };
  }
}

/** Control of a job: the one it specifies, or else the default. */
function controlOf(job: unknown): string | null {
  if (typeof job !== "object" || job === null) return null;
  const { control } = job as { control?: { post?: unknown } | null };
  const post = control?.post;
  if (post === undefined) return usual();
  return typeof post === "string" ? post : null;
}

let usualControl: string | null = null;

/** Control of a job that specifies no control. */
function usual(): string {
  if (usualControl === null) {
    const fields =
      catalog().sections.find(({ path }) => path === "control")?.fields ?? [];
    usualControl = String(fields.find(({ key }) => key === "post")?.default);
  }
  return usualControl;
}

const problem = (code: FindingCode, message: string): Finding => ({
  level: "error",
  code,
  path: "",
  message,
  said: [message],
});

/** Output of a command for a job. `bad`: a reported part is out of tolerance. */
function made(
  task: Task,
  job: Job,
): { ending: string; out: string; findings: Finding[]; bad?: boolean } {
  if (task.command === "plan" && task.whole) {
    const own = plan(job);
    return {
      ending: ".json",
      out: `${JSON.stringify(own)}\n`,
      findings: own.findings,
    };
  }
  if (task.command === "plan") {
    if (task.outputOnly) {
      const { extension, text } = program(job);
      return { ending: `.${extension}`, out: text, findings: [] };
    }
    // Program and findings of the same plan.
    const { program: made, findings } = programs([job]).next()
      .value as Programmed;
    if (!made) throw new JobError("", findings);
    return { ending: `.${made.extension}`, out: made.text, findings };
  }
  const found = () => (task.outputOnly ? [] : check(job));
  if (task.command === "svg")
    return { ending: ".svg", out: svg(job, task.view), findings: found() };
  if (task.command === "table") {
    const format = (task.format ?? "text") as "csv" | "json" | "text";
    return {
      ending: `-parameters.${format === "text" ? "txt" : format}`,
      out: exportTable(job, format),
      findings: found(),
    };
  }
  if (task.command === "report") return reported(task, job);
  const measured = measure(job, task.points ?? "");
  const planned = plan(job);
  const out =
    task.format === "json"
      ? `${JSON.stringify(measured.results, null, 2)}\n`
      : printed(measured, planned);
  const findings = [...planned.findings, ...measured.findings];
  return {
    ending: `-results.${task.format === "json" ? "json" : "txt"}`,
    out,
    findings,
  };
}

/** Inspection report of one part or a series. */
function reported({ parts = [], about = {}, format = "html" }: Task, job: Job) {
  const planned = plan(job);
  const runs = parts
    .flatMap((text) => runsOf(text, planned))
    .map((text) => measure(job, text));
  const of = report({
    plan: planned,
    parts: runs,
    name: String(job.name ?? ""),
    ...about,
  });
  const out = {
    csv: () => reportCsv(of),
    json: () => `${JSON.stringify(of, null, 2)}\n`,
    html: () => reportHtml(of, svg(job, "top")),
  }[format as "csv" | "json" | "html"]();
  const findings = [
    ...planned.findings,
    ...runs.flatMap((run) => run.findings),
  ];
  return { ending: `-report.${format}`, out, findings, bad: isBad(of.verdict) };
}

/** Results as text columns, how the text was read, and the block to type. */
function printed(
  { results, block, findings }: Measurement,
  plan: Plan,
): string {
  const notes = findings
    .filter((f) => f.level === "info")
    .map((f) => `${f.message}\n`);
  return [
    listed(results, plan),
    notes.length > 0 ? "\n" : "",
    ...notes,
    block === null ? "" : `\n${block}\n`,
  ].join("");
}

/** Value of a JSON text. Throws `JobError` if it is not JSON. */
export function parsed(text: string): unknown {
  try {
    return JSON.parse(text.replace(/^\uFEFF/, ""));
  } catch (thrown) {
    const why = `This is not JSON: ${thrown instanceof Error ? thrown.message : thrown}`;
    throw new JobError(why, [problem("not-json", why)]);
  }
}

/** Reads the job of a text, with the control of the task. */
function read(
  text: string,
  { post, form }: Task,
): { job: unknown; overruled: Finding[] } {
  const job = parsed(text);
  if (
    typeof job !== "object" ||
    job === null ||
    (post === undefined && form === undefined)
  )
    return { job, overruled: [] };
  const { control } = job as { control?: unknown };
  // The check reports a value that is no section.
  if (
    control !== undefined &&
    control !== null &&
    (typeof control !== "object" || Array.isArray(control))
  )
    return { job, overruled: [] };
  const own = (control ?? {}) as { post?: unknown };
  const wanted = {
    ...(post === undefined ? {} : { post }),
    ...(form === undefined ? {} : { form }),
  };
  const names =
    post !== undefined && own.post !== undefined && own.post !== post;
  const message = `The job names the control ${String(own.post)}: --post makes it for ${post}`;
  const overruled: Finding[] = names
    ? [
        {
          ...problem("other-control", message),
          level: "warning",
          path: "control.post",
        },
      ]
    : [];
  return { job: { ...job, control: { ...own, ...wanted } }, overruled };
}

function imported(text: string): Done {
  const { job, findings } = importJob(text);
  if (job === null) {
    const none =
      "This program says no job, only moves: there is no job to write. touchpath moves lists them";
    return {
      output: null,
      control: null,
      findings: [problem("nothing-to-import", none), ...findings],
      failed: true,
    };
  }
  const name = typeof job.name === "string" ? job.name : "";
  return {
    output: {
      name,
      ending: ".json",
      text: `${JSON.stringify(job, null, 2)}\n`,
    },
    control: controlOf(job),
    findings,
    failed: findings.some((f) => f.level === "error"),
  };
}

/** Base name of the output of a program. */
const nameOf = (source: string) =>
  (source.split(/[/\\]/).pop() ?? "").replace(/\.[^.]*$/, "");

/** The moves of a program, with line numbers from 1. A text without moves is a failure. */
function moves(
  text: string,
  { format = "text", known }: Task,
  source: string,
): Done {
  const read = known ? runProgram(text, known) : readProgram(text);
  const name = nameOf(source);
  const ending = `-moves.${format === "text" ? "txt" : format}`;
  const out =
    format === "json"
      ? movesAsJson(read)
      : format === "csv"
        ? movesAsCsv(read)
        : movesAsText(read);
  return {
    output: { name, ending, text: out },
    control: null,
    findings: read.findings,
    failed: read.kind.length === 0,
  };
}

/** A move as a row; unknown values are NaN. */
function* rowsOf({
  line,
  kind,
  kinds,
  to,
  feed,
}: ProgramMoves): Generator<[number, string, number[]]> {
  for (const [i, at] of line.entries())
    yield [
      at + 1,
      kinds[kind[i] as number] as string,
      [...to.subarray(3 * i, 3 * i + 3), feed[i] as number],
    ];
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
    const [move, x, y, z, sweep, plane] = arcs.subarray(
      i,
      i + 6,
    ) as unknown as [number, number, number, number, number, number];
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
    out += row([
      String(line),
      kind,
      ...numbers.map((x) => (Number.isNaN(x) ? "-" : x.toFixed(4))),
    ]);
  return out;
}

/** Results as text columns. */
function listed(rows: ResultRow[], plan: Plan): string {
  const number = (x: number | string | null) =>
    typeof x === "number" ? x.toFixed(4) : (x ?? "-");
  const lines = rows.map((row) => [
    isWritten(row) ? row.code : codeOf(plan, row.cycle, row.code),
    number(row.nominal),
    number(row.value),
    number(row.deviation),
    number(row.uncertainty),
    row.unit,
    row.verdict ?? "",
  ]);
  const table = [
    ["result", "nominal", "value", "deviation", "sigma", "unit", "verdict"],
    ...lines,
  ];
  const widths = (table[0] as string[]).map((_, i) =>
    Math.max(...table.map((line) => (line[i] as string).length)),
  );
  const right = (i: number) => i > 0 && i < 5;
  const cell = (text: string, i: number) =>
    right(i)
      ? text.padStart(widths[i] as number)
      : text.padEnd(widths[i] as number);
  return table
    .map((line) => `${line.map(cell).join("  ").trimEnd()}\n`)
    .join("");
}
