#!/usr/bin/env node
// The command: jobs in, programs, tables, pictures and findings out. Exit codes: 0 good, 1 findings, 2 wrong use or what the system refuses.
import { createReadStream } from "node:fs";
import { stat } from "node:fs/promises";
import { availableParallelism, constants } from "node:os";
import {
  basename,
  dirname,
  extname,
  join,
  relative,
  resolve,
  sep,
} from "node:path";
import { parseArgs } from "node:util";
import { glob, isDynamicPattern } from "tinyglobby";
import {
  type Config,
  catalog,
  checkConfig,
  type Finding,
  jobSchema,
  type ProgramKnown,
  version,
} from "../node.js";
import { PROGRAM_POSTS } from "../program-posts.js";
import { clock } from "../report.js";
import { converted, explain, meant, newJob, toolLengths } from "./about.js";
import { completion } from "./completion.js";
import { sarif } from "./examine.js";
import { Folder, fileAt, Refused } from "./folder.js";
import { LIMITS } from "./limits.js";
import { linesOf } from "./lines.js";
import { heldAgainst, LIST, manifestOf } from "./manifest.js";
import { performAll } from "./pool.js";
import { Progress } from "./progress.js";
import { github, junit } from "./reporters.js";
import type { Item, Outcome, PlacedFinding, Task } from "./tasks.js";

/** The commands: what follows each, what it gives, its formats. */
const COMMANDS = {
  plan: ["JOB…", "the program of every job"],
  check: ["JOB…", "everything that is wrong, unusual or worth knowing"],
  table: ["JOB…", "the parameter table", "text|csv|json"],
  svg: ["JOB…", "the picture"],
  import: ["TEXT…", "a job from a dump or a program"],
  moves: ["PROGRAM…", "the moves of any program", "text|csv|json"],
  examine: [
    "PROGRAM…",
    "what a program of anyone's does: safety rules, cycles, what it asks for",
    "text|json|sarif",
  ],
  verify: [
    "PROGRAM…",
    "whether programs, or all in a folder, still are those of the jobs in their headers",
    "text|json",
  ],
  evaluate: [
    "JOB MEASURED",
    "the results from what a machine printed: points, results, a log with [PRB:…]",
    "text|json",
  ],
  report: [
    "JOB MEASURED…",
    "an inspection report of a part, or of a series: a file a part, or a log of several",
    "html|csv|json",
  ],
  new: ["CYCLE", "a job of a cycle with every value, ready to be changed"],
  convert: ["JOB", "a job in other units: --units mm or inch"],
  lentoax: [
    "[QUERY]",
    "SINUMERIK's LENTOAX: which tool length acts on which axis; a query as in the reference, as JSON or in a file",
  ],
  explain: ["CODE", "what the code of a finding, or a safety rule, means"],
  completion: [
    "SHELL",
    "a script that completes this command in bash, zsh or fish",
  ],
  serve: [
    "",
    "jobs over HTTP: plans, programs, tables, pictures, results; OpenAPI, metrics",
  ],
  schema: ["", "the JSON Schema of a job"],
  catalog: ["", "cycles, fields and controls"],
} as const satisfies Record<string, readonly [string, string, string?]>;
type Command = keyof typeof COMMANDS;
const NAMES = Object.keys(COMMANDS) as Command[];

/** Those that take jobs, and those that take programs. */
const JOBS = ["plan", "check", "table", "svg", "evaluate", "report"];
const FILES = [...JOBS, "import", "moves", "examine", "verify"];

/** The file of rules that is found by itself. */
const CONFIG_FILE = "touchpath.config.json";

/** The options: as they are typed, what they do, the commands that take them. */
const HELP_OF_OPTIONS: readonly (readonly [
  string,
  string,
  readonly string[],
])[] = [
  [
    "--post P",
    "for this control, in the place of the job's own; of a program: the control that it is for",
    [...JOBS, "new", "moves", "examine"],
  ],
  [
    "--form F",
    "moves or cycle, in the place of the job's own",
    [...JOBS, "new"],
  ],
  [
    "--config FILE",
    `the rules of a portal or a shop: jobs are filled in and judged by them; if left out, those of the nearest ${CONFIG_FILE} in this folder or above`,
    [...JOBS, "serve"],
  ],
  [
    "--no-config",
    `no rules, whatever ${CONFIG_FILE} there is`,
    [...JOBS, "serve"],
  ],
  ["--units U", "mm or inch", ["new", "convert"]],
  ["--view V", "isometric, top, front or side", ["svg"]],
  [
    "--set NAME=X",
    "the value of a variable, as often as there are some: --set '#3014=5' --set R1=2",
    ["moves", "examine"],
  ],
  [
    "--start X,Y,Z",
    "the position of the stylus before the program",
    ["moves", "examine"],
  ],
  [
    "--at F",
    "touches trigger at this fraction of their way, 0 to 1; none: never",
    ["moves", "examine"],
  ],
  [
    "--positioning F",
    "the same of positioning moves that are watched",
    ["moves", "examine"],
  ],
  [
    "--offsets 0",
    "every work offset, shift and tool length that nothing sets is 0; if left out, they are not known",
    ["moves", "examine"],
  ],
  [
    "--with FILE",
    "a file with subprograms, as often as there are some",
    ["moves", "examine"],
  ],
  [
    "--by, --machine, --when, --note TEXT",
    "who measured, where, when (now, if left out), and what else to say",
    ["report"],
  ],
  [
    "-o, --out DIR",
    "into files there, named after the jobs, in folders as those of the jobs; existing files are replaced",
    ["plan", "table", "svg", "import", "moves", "evaluate", "report"],
  ],
  [
    "--manifest",
    "plan -o: lists the files in manifest.json there, each with its job and their hashes; verify DIR: holds the folder against that list",
    ["plan", "verify"],
  ],
  [
    "--flat",
    "with -o: all files into DIR itself",
    ["plan", "table", "svg", "import", "moves", "evaluate", "report"],
  ],
  ["--ndjson", "one job per line in, one outcome per line out", FILES],
  [
    "--jobs N",
    "on N threads; by default one per core for jobs by the line and serve, else 1",
    [...FILES, "serve"],
  ],
  [
    "--port N",
    "listens there: 3000, if left out; 0 takes a free one",
    ["serve"],
  ],
  [
    "--host H",
    "at this address: 127.0.0.1, if left out; 0.0.0.0 for all",
    ["serve"],
  ],
  [
    "--limit NAME=N",
    `body (bytes, ${LIMITS.body}), requests (at once, ${LIMITS.requests}), connections (${LIMITS.connections}), wait (ms, ${LIMITS.wait}); as often as there are some`,
    ["serve"],
  ],
  [
    "--reporter R",
    "text, github (annotations) or junit, for a build",
    ["check", "verify"],
  ],
  [
    "--deny-warnings",
    "a warning ends with exit code 1, as an error does",
    FILES,
  ],
  [
    "--json",
    "findings, answers and errors as JSON; plan: the whole plan, with -o a line a file",
    NAMES.filter((name) => name !== "serve"),
  ],
];

const INPUT = `JOB is a file with a job, a pattern ('jobs/**/*.json'), or - for the standard input.
A file .ndjson or .jsonl, and with --ndjson any, holds one job per line: each outcome is a line of the output.`;

const ENDS = `With -o, files are written when every job is done, all of them or none: two jobs of one file are refused. The output then is a line for every job: its
source, its file with the SHA-256, the control and its findings (as JSON with --json or --ndjson).
Findings are printed to the standard error output; those of check are its output. Exit code: 0 good, 1 a job with errors, a
program without moves, one that breaks a rule or is not that of its job, or a reported part that is not good, 2 wrong use, 141 whoever reads closed the pipe before all was judged.`;

/** A line of the help for each command, and what it gives. */
function usage(command: Command): string {
  const [after, about, formats]: readonly [string, string, string?] =
    COMMANDS[command];
  const head = `  touchpath ${`${command} ${after}`.trim()}`;
  return `${head.padEnd(34)} ${about}${formats ? `   --format ${formats}` : ""}`;
}

const options = (list: typeof HELP_OF_OPTIONS) =>
  list.map(([flag, about]) => `  ${flag.padEnd(17)} ${about}`).join("\n");

/** The help: of one command with the options that it takes, or of all. */
function help(command?: Command): string {
  if (command) {
    const own = HELP_OF_OPTIONS.filter(([, , commands]) =>
      commands.includes(command),
    );
    return `${usage(command)}\n\n${JOBS.includes(command) ? `${INPUT}\n\n` : ""}${options(own)}\n`;
  }
  const of = (commands: readonly string[]) =>
    commands.length < 5 ? `of ${commands.join(", ")}: ` : "";
  const all = HELP_OF_OPTIONS.map(
    ([flag, about, commands]) =>
      [flag, of(commands) + about, commands] as const,
  );
  return `touchpath ${version()}: touch-probe cycles as programs, tables and pictures

${NAMES.map(usage).join("\n")}

${INPUT}

${options(all)}
  -h, --help        this, or of one command: touchpath plan --help;  -V, --version

${ENDS}
`;
}

/** What a shell completes. */
function completed(): Parameters<typeof completion>[1] {
  const flags = (command: Command) =>
    HELP_OF_OPTIONS.filter(([, , commands]) =>
      commands.includes(command),
    ).flatMap(([typed]) =>
      [...typed.matchAll(/(?<=^|, )--?[a-z-]+/g)].map(([flag]) => flag),
    );
  const formats = NAMES.flatMap((name) => {
    const [, , list]: readonly [string, string, string?] = COMMANDS[name];
    return list ? [[name, list.split("|")] as const] : [];
  });
  const withFormat = (name: Command) =>
    formats.some(([own]) => own === name) ? ["--format"] : [];
  return {
    about: Object.fromEntries(NAMES.map((name) => [name, COMMANDS[name][1]])),
    options: Object.fromEntries(
      NAMES.map((name) => [
        name,
        [...flags(name), ...withFormat(name), "--help"],
      ]),
    ),
    formats: Object.fromEntries(formats),
    values: {
      "--post": catalog().posts.map(({ id }) => id),
      "--form": FORMS,
      "--units": UNITS,
      "--view": VIEWS,
      "--reporter": REPORTERS,
    },
  };
}

const FORMS = ["moves", "cycle"];
const UNITS = ["mm", "inch"];
const REPORTERS = ["text", "github", "junit"];
const VIEWS = ["isometric", "top", "front", "side"] as const;

const OPTIONS = {
  post: { type: "string" },
  form: { type: "string" },
  config: { type: "string" },
  "no-config": { type: "boolean" },
  format: { type: "string" },
  view: { type: "string" },
  out: { type: "string", short: "o" },
  flat: { type: "boolean" },
  manifest: { type: "boolean" },
  jobs: { type: "string" },
  set: { type: "string", multiple: true },
  start: { type: "string" },
  at: { type: "string" },
  positioning: { type: "string" },
  offsets: { type: "string" },
  with: { type: "string", multiple: true },
  by: { type: "string" },
  machine: { type: "string" },
  when: { type: "string" },
  note: { type: "string" },
  ndjson: { type: "boolean" },
  json: { type: "boolean" },
  units: { type: "string" },
  reporter: { type: "string" },
  port: { type: "string" },
  host: { type: "string" },
  limit: { type: "string", multiple: true },
  "deny-warnings": { type: "boolean" },
  help: { type: "boolean", short: "h" },
  version: { type: "boolean", short: "V" },
} as const;

type Values = ReturnType<
  typeof parseArgs<{ options: typeof OPTIONS }>
>["values"];

/** One of a list, or wrong use. */
function oneOf<T extends string>(
  what: string,
  value: string,
  list: readonly T[],
): T {
  const found = list.find((one) => one === value);
  if (!found)
    throw new Refused(
      `${what} is one of ${list.join(", ")}, not ${value}${meant(value, list)}`,
    );
  return found;
}

/** The task that the options say. */
function taskOf(command: Task["command"], values: Values): Task {
  const task: Task = { command };
  const only = (option: keyof Values, ...commands: string[]) => {
    if (values[option] !== undefined && !commands.includes(command))
      throw new Refused(`--${option} is for ${commands.join(", ")}`);
  };
  only("out", "plan", "table", "svg", "import", "moves", "evaluate", "report");
  if (values.flat && values.out === undefined)
    throw new Refused("--flat is for files in a folder (-o)");
  only("manifest", "plan", "verify");
  if (values.manifest && command === "plan" && values.out === undefined)
    throw new Refused("--manifest is for programs in a folder (-o)");
  task.hashes = values.manifest === true && command === "plan";
  only("format", "table", "moves", "examine", "verify", "evaluate", "report");
  for (const option of ["by", "machine", "when", "note"] as const)
    only(option, "report");
  for (const option of [
    "set",
    "start",
    "at",
    "positioning",
    "offsets",
    "with",
  ] as const)
    only(option, "moves", "examine");
  only("view", "svg");
  only("post", ...JOBS, "moves", "examine");
  only("form", ...JOBS);
  only("config", ...JOBS);
  only("no-config", ...JOBS);
  only("reporter", "check", "verify");
  if (values.reporter !== undefined && values.json)
    throw new Refused("--reporter and --json are two forms of one output");
  if (values.reporter !== undefined)
    oneOf("--reporter", values.reporter, REPORTERS);
  only("units", "new", "convert");
  for (const option of ["port", "host", "limit"] as const)
    only(option, "serve");
  const ofPrograms = command === "moves" || command === "examine";
  if (values.post !== undefined && !ofPrograms)
    task.post = oneOf(
      "--post",
      values.post,
      catalog().posts.map((p) => p.id as string),
    );
  if (values.form !== undefined)
    task.form = oneOf("--form", values.form, FORMS);
  if (values.view !== undefined)
    task.view = oneOf("--view", values.view, VIEWS);
  if (values.format !== undefined)
    task.format = oneOf<NonNullable<Task["format"]>>(
      "--format",
      values.format,
      command === "table" || command === "moves"
        ? ["csv", "json", "text"]
        : command === "examine"
          ? ["json", "sarif", "text"]
          : command === "report"
            ? ["csv", "html", "json"]
            : ["json", "text"],
    );
  if (
    command === "examine" ||
    values.set ||
    values.start ||
    values.at ||
    values.positioning ||
    values.offsets ||
    (values.post && ofPrograms) ||
    values.with
  )
    task.known = knownOf(values);
  return task;
}

/** What the options say of a program. */
function knownOf(values: Values): ProgramKnown {
  const number = (option: string, text: string) => {
    const value = Number(text);
    if (text.trim() === "" || !Number.isFinite(value))
      throw new Refused(`${option} takes numbers, not ${text}`);
    return value;
  };
  const known: ProgramKnown = {};
  for (const given of values.set ?? []) {
    const [, name, value] = /^(.+?)=([^=]*)$/.exec(given) ?? [];
    if (name === undefined || value === undefined)
      throw new Refused(`--set takes NAME=VALUE, not ${given}`);
    known.set = { ...known.set, [name.trim()]: number("--set", value) };
  }
  if (values.start !== undefined) {
    const place = values.start
      .split(",")
      .map((part) => number("--start", part));
    if (place.length !== 3)
      throw new Refused(`--start takes X,Y,Z, not ${values.start}`);
    known.start = place as [number, number, number];
  }
  if (values.post !== undefined)
    known.post = oneOf("--post", values.post, [...PROGRAM_POSTS]);
  if (values.offsets !== undefined) {
    if (number("--offsets", values.offsets) !== 0)
      throw new Refused(
        "--offsets takes 0 only: give others by their variables, with --set",
      );
    known.offsets = 0;
  }
  const part = (option: "at" | "positioning") => {
    const text = values[option];
    if (text === undefined) return {};
    return { [option]: text === "none" ? null : number(`--${option}`, text) };
  };
  if (values.at !== undefined || values.positioning !== undefined)
    known.part = { ...part("at"), ...part("positioning") };
  return known;
}

/** The files that the arguments name, each once, in order. A pattern that matches nothing is a mistake, not nothing to do. */
async function filesOf(names: string[], folders = false): Promise<string[]> {
  const files: string[] = [];
  for (const name of names) {
    const there = name === "-" ? undefined : await stat(name).catch(() => null);
    if (there?.isDirectory() && folders) {
      const found = await glob("**/*", {
        cwd: name,
        dot: false,
        onlyFiles: true,
      });
      if (found.length === 0) throw new Refused(`There is no file in ${name}`);
      files.push(...found.sort().map((file) => join(name, file)));
      continue;
    }
    if (there?.isDirectory())
      throw new Refused(
        `${name} is a folder: name its files, as '${name.replace(/[/\\]+$/, "")}/**/*.json'`,
      );
    if (there !== null) files.push(name);
    else if (!isDynamicPattern(name))
      throw new Refused(`There is no file ${name}`);
    else {
      const found = await glob(name, { dot: false, expandDirectories: false });
      if (found.length === 0) throw new Refused(`No file matches ${name}`);
      files.push(...found.sort());
    }
  }
  return [...new Set(files)];
}

/** The folders of a file as its output keeps them: those below the present folder; of a file elsewhere all but the way up. */
function placeOf(file: string): string {
  if (file === "-") return "";
  const folders = relative(process.cwd(), dirname(resolve(file))).split(sep);
  const isDrive = (folder: string) =>
    process.platform === "win32" && folder.endsWith(":");
  return folders
    .filter((folder) => folder !== ".." && !isDrive(folder))
    .join(sep);
}

const isLines = (file: string, values: Values) =>
  values.ndjson === true || [".ndjson", ".jsonl"].includes(extname(file));
const streamOf = (file: string) =>
  file === "-" ? process.stdin : createReadStream(file);

/** Every job of the files, one after the other, never more than are asked for. */
async function* itemsOf(
  files: string[],
  values: Values,
  longest: number,
  progress: Progress,
): AsyncGenerator<Item> {
  const refused = `At most ${longest} characters are read`;
  for (const file of files) {
    const source = file === "-" ? "standard input" : file;
    const place = placeOf(file);
    try {
      if (isLines(file, values)) {
        for await (const { number, text, tooLong } of linesOf(
          progress.through(streamOf(file)),
          longest,
        )) {
          if (text.trim() === "" && !tooLong) continue;
          yield {
            source: `${source}:${number}`,
            row: number,
            place,
            text,
            ...(tooLong ? { refused } : {}),
          };
        }
      } else
        yield {
          source,
          place,
          ...(await whole(file, longest, refused, progress)),
        };
    } catch (thrown) {
      throw new Refused(
        `${source} cannot be read: ${(thrown as Error).message}`,
      );
    }
  }
}

/** The text of a file. Of one that is longer than any job may be, no more is read. */
async function whole(
  file: string,
  longest: number,
  refused: string,
  progress?: Progress,
): Promise<Omit<Item, "source" | "place">> {
  const chunks: Buffer[] = [];
  let size = 0;
  for await (const chunk of progress?.through(streamOf(file)) ??
    streamOf(file)) {
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

/** What was measured. */
async function textOf(file: string): Promise<string> {
  const longest = catalog().longestText;
  try {
    const { text, refused } = await whole(
      file,
      longest,
      `At most ${longest} characters are read`,
    );
    if (refused) throw new Error(refused);
    return text;
  } catch (thrown) {
    throw new Refused(`${file} cannot be read: ${(thrown as Error).message}`);
  }
}

/** The rules that jobs are judged by: of the file that is named, or else of the nearest one. */
async function configFor(values: Values): Promise<Config | undefined> {
  if (values.config !== undefined && values["no-config"])
    throw new Refused("--config and --no-config are not for one run");
  if (values.config !== undefined) return configOf(values.config);
  if (values["no-config"]) return undefined;
  for (let folder = process.cwd(); ; folder = dirname(folder)) {
    const file = join(folder, CONFIG_FILE);
    if ((await stat(file).catch(() => null))?.isFile())
      return configOf(relative(process.cwd(), file));
    if (folder === dirname(folder)) return undefined;
  }
}

/** The rules of a file. */
async function configOf(file: string): Promise<Config> {
  let config: unknown;
  try {
    config = JSON.parse((await textOf(file)).replace(/^\uFEFF/, ""));
  } catch (thrown) {
    if (thrown instanceof Refused) throw thrown;
    throw new Refused(`${file} is not JSON: ${(thrown as Error).message}`);
  }
  const faults = checkConfig(config).filter(({ level }) => level === "error");
  if (faults.length === 0) return config as Config;
  throw new Refused(
    `${file}: ${faults.map(({ path, message }) => `${path}: ${message}`).join("; ")}`,
  );
}

/** A finding for people. */
const said = (
  source: string,
  { level, path, message, code, line, column }: PlacedFinding,
) =>
  `${source}${line === undefined ? "" : `:${line}:${column}`}: ${level}: ${path ? `${path}: ` : ""}${message} [${code}]\n`;

/** How many findings there are of each level that matters, for people. */
function counted(findings: Finding[]): string {
  const count = (level: Finding["level"]) => {
    const { length } = findings.filter((finding) => finding.level === level);
    return length === 0 ? [] : [`${length} ${level}${length === 1 ? "" : "s"}`];
  };
  return [...count("error"), ...count("warning")]
    .map((words) => `, ${words}`)
    .join("");
}

/** What became of a job, in one line: its file, with the SHA-256 of it, the control and the findings. */
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

/** The findings of a job, for people or as JSON. */
async function report(
  task: Task,
  values: Values,
  { source, output, findings, failed }: Outcome,
): Promise<void> {
  const to = task.command === "check" ? process.stdout : process.stderr;
  // A whole plan has its findings in it.
  if (task.command === "plan" && task.whole && output) return;
  if (values.json) {
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

/** Whether a warning counts as an error, and there is one. */
const isDenied = (values: Values, { findings }: Outcome) =>
  values["deny-warnings"] === true &&
  findings.some(({ level }) => level === "warning");

/** Hands out what became of every job; whether there was an error in any. */
async function handOut(
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
    if (values.reporter === "junit") {
      reported.push(outcome);
      continue;
    }
    if (values.reporter === "github") {
      progress.clear();
      await write(process.stdout, github(outcome));
      continue;
    }
    if (task.format === "sarif" && outcome.output) {
      results.push(outcome.output.text);
      continue;
    }
    // What is written stands on a line of its own.
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
    // A report has its findings in it, but as text.
    const within = task.command === "examine" || task.command === "verify";
    if (!within || (task.format ?? "text") === "text")
      await report(task, values, outcome);
  }
  if (task.format === "sarif") await write(process.stdout, sarif(results));
  if (values.reporter === "junit")
    await write(
      process.stdout,
      junit(task.command, reported, values["deny-warnings"] === true),
    );
  return failed;
}

/** Puts the output of every job into a file of its own, all of them or none, and says of every job what became of it; whether there was an error in any. */
async function fileAway(
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
    const command =
      word === undefined ? undefined : oneOf("The command", word, NAMES);
    await write(values.help ? process.stdout : process.stderr, help(command));
    return values.help ? 0 : 2;
  } else return run(oneOf("The command", word, NAMES), names, values);
  return 0;
}

/** What is answered at once, without jobs to work through; undefined of the other commands. */
async function answered(
  command: Command,
  names: string[],
  values: Values,
): Promise<string | undefined> {
  const takes = (
    count: [number, number],
    what: string,
    ...allowed: string[]
  ) => {
    const other = Object.keys(values).find(
      (option) => !["json", ...allowed].includes(option),
    );
    if (other !== undefined)
      throw new Refused(`--${other} is not for ${command}`);
    if (names.length < count[0] || names.length > count[1])
      throw new Refused(`${command} takes ${what}`);
  };
  const [given = ""] = names;
  switch (command) {
    case "explain":
      takes([1, 1], "the code of a finding, or the name of a safety rule");
      return explain(given, values.json === true);
    case "completion":
      takes([1, 1], "bash, zsh or fish");
      return completion(given, completed());
    case "new": {
      takes([1, 1], "the type of a cycle", "post", "form", "units");
      const posts = catalog().posts.map(({ id }) => id as string);
      if (values.post !== undefined) oneOf("--post", values.post, posts);
      if (values.form !== undefined) oneOf("--form", values.form, FORMS);
      return newJob(given, values);
    }
    case "convert":
      takes([1, 1], "a job", "units");
      if (values.units === undefined)
        throw new Refused("convert takes --units mm or --units inch");
      return converted(await textOf(given), values.units);
    case "lentoax":
      takes([0, 1], "nothing, a query as JSON, or a file with one");
      if (names.length === 0)
        return toolLengths(undefined, values.json === true);
      return toolLengths(
        given.trimStart().startsWith("{") ? given : await textOf(given),
        values.json === true,
      );
    default:
      return undefined;
  }
}

async function run(
  command: Command,
  names: string[],
  values: Values,
): Promise<number> {
  const answer = await answered(command, names, values);
  if (answer !== undefined) {
    await write(process.stdout, answer);
    return 0;
  }
  if (command === "serve") return served(names, values);
  if (command === "schema" || command === "catalog") {
    const given = Object.keys(values).find((option) => option !== "json");
    if (names.length > 0 || given)
      throw new Refused(`${command} takes no files and no options`);
    await write(
      process.stdout,
      `${JSON.stringify(command === "schema" ? jobSchema() : catalog(), null, 2)}\n`,
    );
    return 0;
  }
  judging = true;
  const task = taskOf(command as Task["command"], values);
  if (JOBS.includes(command)) {
    const config = await configFor(values);
    if (config) task.config = config;
  }
  if (command === "evaluate") {
    const [, points] = names;
    if (
      names.length !== 2 ||
      points === undefined ||
      (names[0] === "-" && points === "-")
    )
      throw new Refused(
        "evaluate takes a job and a file with what was measured",
      );
    task.points = await textOf(points);
    names.length = 1;
  }
  if (command === "report") {
    const measured = names.splice(1);
    if (measured.length === 0)
      throw new Refused(
        "report takes a job and a file with what was measured of each part",
      );
    task.parts = await Promise.all((await filesOf(measured)).map(textOf));
    const { by, machine, note, when = clock(new Date()) } = values;
    task.about = {
      when,
      ...(by ? { by } : {}),
      ...(machine ? { machine } : {}),
      ...(note ? { note } : {}),
    };
  }
  if (names.length === 0)
    throw new Refused(`${command} takes files; - is the standard input`);
  if (command === "verify" && values.manifest) {
    const [folder] = names;
    if (
      names.length !== 1 ||
      !folder ||
      !(await stat(folder).catch(() => null))?.isDirectory()
    )
      throw new Refused(
        "verify --manifest takes a folder with a list, as plan -o DIR --manifest writes it",
      );
    const silent = new Progress(process.stderr, false);
    return Number(
      await handOut(task, values, heldAgainst(folder, task), false, silent),
    );
  }
  if (task.known && values.with)
    task.known.files = Object.fromEntries(
      await Promise.all(
        values.with.map(
          async (file) => [basename(file), await textOf(file)] as const,
        ),
      ),
    );
  const files = await filesOf(names, command === "verify");
  const byLine = files.some((file) => isLines(file, values));
  if (
    files.length > 1 &&
    !byLine &&
    values.out === undefined &&
    !["check", "import", "examine", "verify"].includes(command)
  )
    throw new Refused(
      "Several jobs need a folder (-o): one after the other they are no program",
    );
  if (JOBS.includes(command) && !byLine) task.places = true;
  task.whole = values.json === true && !byLine && values.out === undefined;
  const cores = byLine ? Math.min(availableParallelism(), 8) : 1;
  const threads = threadsOf(values, cores);
  const { longestText, longestProgram } = catalog();
  const longest = ["moves", "examine", "verify"].includes(command)
    ? longestProgram
    : longestText;
  const progress = new Progress(process.stderr, byLine || files.length > 1);
  for (const file of files)
    if (file !== "-") progress.expect((await stat(file)).size);
  const folder =
    values.out === undefined
      ? null
      : await folderOf(values.out, files, values.flat === true);
  try {
    const outcomes = performAll(
      task,
      itemsOf(files, values, longest, progress),
      threads,
    );
    const failed = folder
      ? await fileAway(task, values, outcomes, byLine, folder, progress)
      : await handOut(task, values, outcomes, byLine, progress);
    return failed ? 1 : 0;
  } finally {
    progress.end();
    folder?.leave();
  }
}

/** A whole number of an option. */
function countOf(
  option: string,
  text: string,
  least: number,
  most: number,
): number {
  const value = Number(text);
  if (!/^\d+$/.test(text) || value < least || value > most)
    throw new Refused(
      `${option} is a whole number from ${least} to ${most}, not ${text}`,
    );
  return value;
}

/** Serves until a signal ends the process. */
async function served(names: string[], values: Values): Promise<number> {
  const other = Object.keys(values).find(
    (option) =>
      !["port", "host", "jobs", "limit", "config", "no-config"].includes(
        option,
      ),
  );
  if (other !== undefined) throw new Refused(`--${other} is not for serve`);
  if (names.length > 0) throw new Refused("serve takes no files");
  const limits = { ...LIMITS };
  for (const given of values.limit ?? []) {
    const [name = "", number = ""] = given.split(/=(.*)/s);
    const known = oneOf(
      "--limit",
      name,
      Object.keys(LIMITS) as (keyof typeof LIMITS)[],
    );
    limits[known] = countOf(`--limit ${known}`, number, 1, 1_000_000_000);
  }
  const config = await configFor(values);
  const threads = threadsOf(values, Math.min(availableParallelism(), 8));
  const { serve } = await import("./serve.js");
  const port = countOf("--port", values.port ?? "3000", 0, 65_535);
  await serve({
    port,
    host: values.host ?? "127.0.0.1",
    threads,
    limits,
    config,
  });
  return 0;
}

/** On how many threads. */
function threadsOf(values: Values, usual: number): number {
  return values.jobs === undefined
    ? usual
    : countOf("--jobs", values.jobs, 1, 64);
}

/** The folder of the outputs. However the process ends, but for a kill that cannot be seen, nothing is left aside. */
async function folderOf(
  out: string,
  files: string[],
  flat: boolean,
): Promise<Folder> {
  const inputs = await Promise.all(
    files.filter((file) => file !== "-").map(fileAt),
  );
  const folder = new Folder(
    out,
    new Set(inputs.filter((input) => input !== null)),
    flat,
  );
  process.on("exit", () => folder.leave());
  for (const signal of ["SIGINT", "SIGTERM", "SIGHUP"] as const)
    process.on(signal, () => process.exit(128 + constants.signals[signal]));
  return folder;
}

/** Ends with one line about what went wrong. */
function refuse(why: string, json: boolean): never {
  const name = basename(process.argv[1] ?? "touchpath", ".js");
  process.stderr.write(
    json ? `${JSON.stringify({ error: why })}\n` : `${name}: ${why}\n`,
  );
  process.exit(2);
}

const json = process.argv.includes("--json");
/** Whether jobs are judged: where the output is closed before all are, the exit code must not be that of good ones. */
let judging = false;
for (const stream of [process.stdout, process.stderr])
  stream.on("error", (error: NodeJS.ErrnoException) => {
    if (stream === process.stderr) process.exit(2);
    // Whoever reads has enough, as in `| head -1`: no word of it.
    if (error.code === "EPIPE") process.exit(judging ? 141 : 0);
    refuse(error.message, json);
  });
try {
  process.exitCode = await main(process.argv.slice(2));
} catch (thrown) {
  refuse(
    thrown instanceof Refused
      ? thrown.message
      : `This should not have happened: ${thrown}`,
    json,
  );
}
