// Writes outputs, findings and reports of the command to streams or files.
import type { Finding } from "../node.js";
import { sarif } from "./examine.js";
import type { Folder } from "./folder.js";
import { LIST, manifestOf } from "./manifest.js";
import type { Values } from "./options.js";
import type { Progress } from "./progress.js";
import { github, junit, sarifResults } from "./reporters.js";
import type { Outcome, PlacedFinding, Task } from "./tasks.js";

/** Writes and waits for a slow reader. */
export async function write(
  stream: NodeJS.WriteStream,
  text: string | Uint8Array,
): Promise<void> {
  if (stream.write(text)) return;
  await new Promise<void>((done) => stream.once("drain", done));
}

/** A finding as text. */
const said = (
  source: string,
  { level, path, message, code, line, column }: PlacedFinding,
) =>
  `${source}${line === undefined ? "" : `:${line}:${column}`}: ${level}: ${path ? `${path}: ` : ""}${message} [${code}]\n`;

/** Number of errors and warnings as text. */
function counted(findings: Finding[]): string {
  const count = (level: Finding["level"]) => {
    const { length } = findings.filter((finding) => finding.level === level);
    return length === 0 ? [] : [`${length} ${level}${length === 1 ? "" : "s"}`];
  };
  return [...count("error"), ...count("warning")]
    .map((words) => `, ${words}`)
    .join("");
}

/** Outcome of a job in one JSON line: its file with SHA-256, the control and the findings. */
function outcomeLine(
  { source, control, findings }: Outcome,
  file: string | null,
  hash: string | null,
  json: boolean,
): string {
  if (json)
    return `${JSON.stringify({ source, file, hash, control, findings })}\n`;
  const made =
    file === null
      ? "no file"
      : `${file} (${control ?? "no control"}, sha256 ${hash})`;
  return `${source}: ${made}${counted(findings)}\n`;
}

/** Findings of a job as text or JSON. */
async function report(
  task: Task,
  values: Values,
  { source, output, findings, failed }: Outcome,
): Promise<void> {
  const to = task.command === "check" ? process.stdout : process.stderr;
  // A whole plan contains its findings.
  if (task.command === "plan" && task.whole && output) return;
  const asJson = task.command === "check" && task.format === "json";
  if (values.json || asJson) {
    if (task.command === "check" || findings.length > 0)
      await write(to, `${JSON.stringify({ source, findings })}\n`);
    return;
  }
  for (const finding of findings)
    if (
      task.command === "check" ||
      finding.level !== "info" ||
      (failed && !output)
    )
      await write(to, said(source, finding));
}

/** Whether warnings count as errors and there is one. */
const isDenied = (values: Values, { findings }: Outcome) =>
  values["deny-warnings"] === true &&
  findings.some(({ level }) => level === "warning");

/** Writes the outcome of every job. Returns whether any had an error. */
export async function handOut(
  task: Task,
  values: Values,
  outcomes: AsyncIterable<Outcome>,
  byLine: boolean,
  progress: Progress,
): Promise<boolean> {
  let failed = false;
  const results: string[] = [];
  const reported: Outcome[] = [];
  for await (const outcome of outcomes) {
    failed ||= outcome.failed || isDenied(values, outcome);
    progress.count();
    if (task.format === "junit") {
      reported.push(outcome);
      continue;
    }
    if (task.format === "github") {
      progress.clear();
      await write(process.stdout, github(outcome));
      continue;
    }
    if (task.format === "sarif") {
      // A run of a program has its results as text.
      results.push(outcome.output?.text ?? sarifResults(outcome));
      continue;
    }
    // Each output starts on a new line.
    progress.clear();
    const { source, output, findings } = outcome;
    if (byLine) {
      const text =
        task.command === "check"
          ? {}
          : {
              [task.command === "plan" ? "program" : "output"]:
                output?.text ?? null,
            };
      await write(
        process.stdout,
        `${JSON.stringify({ source, ...text, findings })}\n`,
      );
      continue;
    }
    if (output) await write(process.stdout, output.text);
    // A report contains its findings, except as text.
    const within = task.command === "examine" || task.command === "verify";
    if (!within || (task.format ?? "text") === "text")
      await report(task, values, outcome);
  }
  if (task.format === "sarif") await write(process.stdout, sarif(results));
  if (task.format === "junit")
    await write(
      process.stdout,
      junit(task.command, reported, values["deny-warnings"] === true),
    );
  return failed;
}

/** Writes the output of every job into a file of its own, all or none, and reports each outcome. Returns whether any had an error. */
export async function fileAway(
  task: Task,
  values: Values,
  outcomes: AsyncIterable<Outcome>,
  byLine: boolean,
  folder: Folder,
  progress: Progress,
): Promise<boolean> {
  const json = byLine || values.json === true;
  let failed = false;
  const made: Parameters<typeof manifestOf>[1] = [];
  for await (const outcome of outcomes) {
    failed ||= outcome.failed || isDenied(values, outcome);
    await folder.make();
    progress.count();
    const { source, place, output, findings } = outcome;
    const [file, hash] = output
      ? await folder.put(source, place, output)
      : [null, null];
    if (values.manifest && file !== null && hash !== null)
      made.push({ outcome: { ...outcome, output: null }, file, hash });
    await folder.note(outcomeLine(outcome, file, hash, json));
    if (json || findings.length === 0) continue;
    progress.clear();
    await report(task, values, outcome);
  }
  if (values.manifest)
    await folder.put("the list", "", {
      ...LIST,
      text: manifestOf(values.out as string, made),
    });
  await folder.finish();
  progress.clear();
  for await (const lines of folder.noted()) await write(process.stdout, lines);
  return failed;
}
