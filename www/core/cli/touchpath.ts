#!/usr/bin/env node
// The command: jobs in, programs, tables, pictures and findings out. Exit codes: 0 good, 1 findings, 2 wrong use or what the system refuses.
import { createReadStream } from "node:fs";
import { mkdir, stat, writeFile } from "node:fs/promises";
import { availableParallelism } from "node:os";
import { basename, extname, resolve } from "node:path";
import { parseArgs } from "node:util";
import { glob, isDynamicPattern } from "tinyglobby";
import { programStem } from "../names.js";
import { catalog, type Finding, jobSchema, version } from "../node.js";
import { linesOf } from "./lines.js";
import { performAll } from "./pool.js";
import { Progress } from "./progress.js";
import type { Item, Outcome, Task } from "./tasks.js";

const HELP = `touchpath ${version()}: touch-probe cycles as programs, tables and pictures

  touchpath plan JOB…       the program of every job
  touchpath check JOB…      everything that is wrong, unusual or worth knowing
  touchpath table JOB…      the parameter table          --format text|csv|json
  touchpath svg JOB…        the picture                  --view isometric|top|front|side
  touchpath import TEXT…    a job from a dump or a program
  touchpath moves PROGRAM…  the moves of any program     --format text|csv|json
  touchpath evaluate JOB POINTS   the results from measured points   --format text|json
  touchpath schema          the JSON Schema of a job
  touchpath catalog         cycles, fields and controls

JOB is a file with a job, a pattern ('jobs/**/*.json'), or - for the standard input.
A file .ndjson or .jsonl, and with --ndjson any, holds one job per line: each outcome is a line of the output.

  --post P        for this control, in the place of the job's own
  --form F        moves or cycle, in the place of the job's own
  -o, --out DIR   into files there, named after the jobs; existing files are replaced
  --ndjson        one job per line in, one outcome per line out
  --jobs N        on N threads; by default one per core for jobs by the line, else 1
  --json          findings and errors as JSON
  -h, --help      this;  -V, --version

Findings are printed to the standard error output; those of check are its output. Exit code: 0 good, 1 a job with errors or a
program without moves, 2 wrong use.
`;

const COMMANDS = ["plan", "check", "table", "import", "moves", "evaluate", "svg", "schema", "catalog"] as const;
type Command = (typeof COMMANDS)[number];
const VIEWS = ["isometric", "top", "front", "side"] as const;

/** Wrong use, or what the system refuses: exit code 2. */
class Refused extends Error {}

const OPTIONS = {
  post: { type: "string" },
  form: { type: "string" },
  format: { type: "string" },
  view: { type: "string" },
  out: { type: "string", short: "o" },
  jobs: { type: "string" },
  ndjson: { type: "boolean" },
  json: { type: "boolean" },
  help: { type: "boolean", short: "h" },
  version: { type: "boolean", short: "V" },
} as const;

type Values = ReturnType<typeof parseArgs<{ options: typeof OPTIONS }>>["values"];

/** One of a list, or wrong use. */
function oneOf<T extends string>(what: string, value: string, list: readonly T[]): T {
  const found = list.find((one) => one === value);
  if (!found) throw new Refused(`${what} is one of ${list.join(", ")}, not ${value}`);
  return found;
}

/** The task that the options say. */
function taskOf(command: Task["command"], values: Values): Task {
  const task: Task = { command };
  const only = (option: keyof Values, ...commands: string[]) => {
    if (values[option] !== undefined && !commands.includes(command))
      throw new Refused(`--${option} is for ${commands.join(", ")}`);
  };
  only("out", "plan", "table", "svg", "import", "moves", "evaluate");
  only("format", "table", "moves", "evaluate");
  only("view", "svg");
  const jobs = ["plan", "check", "table", "svg", "evaluate"];
  only("post", ...jobs);
  only("form", ...jobs);
  if (values.post !== undefined)
    task.post = oneOf(
      "--post",
      values.post,
      catalog().posts.map((p) => p.id as string),
    );
  if (values.form !== undefined) task.form = oneOf("--form", values.form, ["moves", "cycle"]);
  if (values.view !== undefined) task.view = oneOf("--view", values.view, VIEWS);
  if (values.format !== undefined)
    task.format = oneOf<NonNullable<Task["format"]>>(
      "--format",
      values.format,
      command === "table" || command === "moves" ? ["csv", "json", "text"] : ["json", "text"],
    );
  return task;
}

/** The files that the arguments name, each once, in order. A pattern that matches nothing is a mistake, not nothing to do. */
async function filesOf(names: string[]): Promise<string[]> {
  const files: string[] = [];
  for (const name of names) {
    const there = name === "-" ? undefined : await stat(name).catch(() => null);
    if (there?.isDirectory())
      throw new Refused(`${name} is a folder: name its files, as '${name.replace(/[/\\]+$/, "")}/**/*.json'`);
    if (there !== null) files.push(name);
    else if (!isDynamicPattern(name)) throw new Refused(`There is no file ${name}`);
    else {
      const found = await glob(name, { dot: false, expandDirectories: false });
      if (found.length === 0) throw new Refused(`No file matches ${name}`);
      files.push(...found.sort());
    }
  }
  return [...new Set(files)];
}

const isLines = (file: string, values: Values) =>
  values.ndjson === true || [".ndjson", ".jsonl"].includes(extname(file));
const streamOf = (file: string) => (file === "-" ? process.stdin : createReadStream(file));

/** Every job of the files, one after the other, never more than are asked for. */
async function* itemsOf(files: string[], values: Values, longest: number, progress: Progress): AsyncGenerator<Item> {
  const refused = `At most ${longest} characters are read`;
  for (const file of files) {
    const source = file === "-" ? "standard input" : file;
    try {
      if (isLines(file, values)) {
        for await (const { number, text, tooLong } of linesOf(progress.through(streamOf(file)), longest)) {
          if (text.trim() === "" && !tooLong) continue;
          yield { source: `${source}:${number}`, text, ...(tooLong ? { refused } : {}) };
        }
      } else yield { source, ...(await whole(file, longest, refused, progress)) };
    } catch (thrown) {
      throw new Refused(`${source} cannot be read: ${(thrown as Error).message}`);
    }
  }
}

/** The text of a file. Of one that is longer than any job may be, no more is read. */
async function whole(
  file: string,
  longest: number,
  refused: string,
  progress?: Progress,
): Promise<Omit<Item, "source">> {
  const chunks: Buffer[] = [];
  let size = 0;
  for await (const chunk of progress?.through(streamOf(file)) ?? streamOf(file)) {
    const bytes = Buffer.from(chunk);
    size += bytes.length;
    // A character has four bytes at most.
    if (size > 4 * longest) return { text: "", refused };
    chunks.push(bytes);
  }
  const text = Buffer.concat(chunks).toString("utf8");
  return text.length > longest ? { text: "", refused } : { text };
}

/** Writes, and waits where the reader is slow. */
async function write(stream: NodeJS.WriteStream, text: string): Promise<void> {
  if (stream.write(text)) return;
  await new Promise<void>((done) => stream.once("drain", done));
}

/** The points that were measured. */
async function textOf(file: string): Promise<string> {
  const longest = catalog().longestText;
  try {
    const { text, refused } = await whole(file, longest, `At most ${longest} characters are read`);
    if (refused) throw new Error(refused);
    return text;
  } catch (thrown) {
    throw new Refused(`${file} cannot be read: ${(thrown as Error).message}`);
  }
}

/** A finding for people. */
const said = (source: string, { level, path, message, code }: Finding) =>
  `${source}: ${level}: ${path ? `${path}: ` : ""}${message} [${code}]\n`;

/** Puts the outputs into files of a folder. Two of the same name get two names, and no job is written over: nothing is lost. */
class Folder {
  private readonly taken = new Set<string>();
  private made = false;

  constructor(
    private readonly folder: string,
    /** The files that the jobs come from, as whole paths. */
    private readonly inputs: Set<string>,
  ) {}

  /** Makes the folder, where that is not done: after the first job was read, so that a mistake in the arguments leaves none behind. */
  async make(): Promise<void> {
    if (this.made) return;
    await mkdir(this.folder, { recursive: true }).catch((thrown: Error) => {
      throw new Refused(`${this.folder} cannot be made: ${thrown.message}`);
    });
    this.made = true;
  }

  async put({ name, ending, text }: NonNullable<Outcome["output"]>): Promise<void> {
    const plain = programStem(name, text);
    let file = `${plain}${ending}`;
    for (let n = 2; this.taken.has(file.toLowerCase()); n++) file = `${plain}-${n}${ending}`;
    this.taken.add(file.toLowerCase());
    const path = resolve(this.folder, file);
    if (this.inputs.has(path)) throw new Refused(`${file} would be written over the file that was read`);
    try {
      await writeFile(path, text);
    } catch (thrown) {
      throw new Refused(`${file} cannot be written: ${(thrown as Error).message}`);
    }
  }
}

/** Hands out what became of every job; whether there was an error in any. */
async function handOut(
  task: Task,
  values: Values,
  outcomes: AsyncIterable<Outcome>,
  byLine: boolean,
  inputs: Set<string>,
  progress: Progress,
): Promise<boolean> {
  const folder = values.out === undefined ? null : new Folder(values.out, inputs);
  let failed = false;
  for await (const outcome of outcomes) {
    failed ||= outcome.failed;
    await folder?.make();
    progress.count();
    const { source, output, findings } = outcome;
    // What is written stands on a line of its own.
    if (!folder || findings.length > 0) progress.clear();
    if (folder && output) await folder.put(output);
    if (byLine && !folder) {
      const text =
        task.command === "check" ? {} : { [task.command === "plan" ? "program" : "output"]: output?.text ?? null };
      await write(process.stdout, `${JSON.stringify({ source, ...text, findings })}\n`);
    } else {
      if (!folder && output) await write(process.stdout, output.text);
      const to = task.command === "check" ? process.stdout : process.stderr;
      if (values.json) {
        if (task.command === "check" || findings.length > 0)
          await write(to, `${JSON.stringify({ source, findings })}\n`);
      } else
        for (const finding of findings)
          if (task.command === "check" || finding.level !== "info" || (outcome.failed && !output))
            await write(to, said(source, finding));
    }
  }
  return failed;
}

async function main(args: string[]): Promise<number> {
  let parsed: { values: Values; positionals: string[] };
  try {
    parsed = parseArgs({ args, options: OPTIONS, allowPositionals: true });
  } catch (thrown) {
    throw new Refused((thrown as Error).message);
  }
  const { values, positionals } = parsed;
  const [word, ...names] = positionals;
  if (values.version) await write(process.stdout, `${version()}\n`);
  else if (values.help || word === undefined) {
    await write(values.help ? process.stdout : process.stderr, HELP);
    return values.help ? 0 : 2;
  } else return run(oneOf("The command", word, COMMANDS), names, values);
  return 0;
}

async function run(command: Command, names: string[], values: Values): Promise<number> {
  if (command === "schema" || command === "catalog") {
    const given = Object.keys(values).find((option) => option !== "json");
    if (names.length > 0 || given) throw new Refused(`${command} takes no files and no options`);
    await write(process.stdout, `${JSON.stringify(command === "schema" ? jobSchema() : catalog(), null, 2)}\n`);
    return 0;
  }
  const task = taskOf(command, values);
  if (command === "evaluate") {
    const [, points] = names;
    if (names.length !== 2 || points === undefined || (names[0] === "-" && points === "-"))
      throw new Refused("evaluate takes a job and a file of measured points");
    task.points = await textOf(points);
    names.length = 1;
  }
  if (names.length === 0) throw new Refused(`${command} takes files; - is the standard input`);
  const files = await filesOf(names);
  const byLine = files.some((file) => isLines(file, values));
  if (files.length > 1 && !byLine && values.out === undefined && command !== "check" && command !== "import")
    throw new Refused("Several jobs need a folder (-o): one after the other they are no program");
  const cores = byLine ? Math.min(availableParallelism(), 8) : 1;
  const threads = values.jobs === undefined ? cores : Number(values.jobs);
  if (!Number.isInteger(threads) || threads < 1 || threads > 64)
    throw new Refused("--jobs is a whole number from 1 to 64");
  const { longestText, longestProgram } = catalog();
  const longest = command === "moves" ? longestProgram : longestText;
  const progress = new Progress(process.stderr, byLine || files.length > 1);
  for (const file of files) if (file !== "-") progress.expect((await stat(file)).size);
  try {
    const inputs = new Set(files.map((file) => resolve(file)));
    const outcomes = performAll(task, itemsOf(files, values, longest, progress), threads);
    return (await handOut(task, values, outcomes, byLine, inputs, progress)) ? 1 : 0;
  } finally {
    progress.end();
  }
}

/** Ends with one line about what went wrong. */
function refuse(why: string, json: boolean): never {
  const name = basename(process.argv[1] ?? "touchpath", ".js");
  process.stderr.write(json ? `${JSON.stringify({ error: why })}\n` : `${name}: ${why}\n`);
  process.exit(2);
}

const json = process.argv.includes("--json");
for (const stream of [process.stdout, process.stderr])
  stream.on("error", (error: NodeJS.ErrnoException) => {
    if (stream === process.stderr) process.exit(2);
    refuse(error.code === "EPIPE" ? "The output was closed: the rest was not written" : error.message, json);
  });
try {
  process.exitCode = await main(process.argv.slice(2));
} catch (thrown) {
  refuse(thrown instanceof Refused ? thrown.message : `This should not have happened: ${thrown}`, json);
}
