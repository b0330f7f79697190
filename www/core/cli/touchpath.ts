#!/usr/bin/env node
// The command: jobs in; programs, tables, pictures and findings out. Exit codes: 0 good, 1 findings, 2 wrong use or an error of the system.
import { stat } from "node:fs/promises";
import { availableParallelism, constants } from "node:os";
import { basename, resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { parseArgs } from "node:util";
import { bytesOfText } from "../bytes.js";
import { catalog, jobSchema, version } from "../node.js";
import { clock } from "../report.js";
import { converted, explain, inlined, newJob, toolLengths } from "./about.js";
import { completion } from "./completion.js";
import { Folder, fileAt, Refused } from "./folder.js";
import { type Command, completed, FORMS, help, JOBS, NAMES } from "./help.js";
import {
  configFor,
  filesOf,
  isLines,
  itemsOf,
  programOf,
  textOf,
} from "./inputs.js";
import { inserted } from "./insert.js";
import { LIMITS } from "./limits.js";
import { hasList, heldAgainst } from "./manifest.js";
import {
  countOf,
  OPTIONS,
  oneOf,
  taskOf,
  threadsOf,
  type Values,
} from "./options.js";
import { fileAway, handOut, write } from "./outcomes.js";
import { performAll } from "./pool.js";
import { Progress } from "./progress.js";
import type { Authorize } from "./serve.js";
import type { Task } from "./tasks.js";

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

/** Answers a command without jobs; undefined for other commands. */
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
    case "inline":
      takes([0, 0], "no arguments");
      return inlined();
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
  if (command === "insert") {
    const [job, into] = names;
    if (names.length !== 2 || job === undefined || into === undefined)
      throw new Refused("insert takes a job and a program");
    const config = await configFor(values);
    const { text: other, isUtf8 } = await programOf(into);
    const own = await textOf(job);
    const { text, said, code } = inserted(own, other, values.line, config);
    await write(process.stdout, bytesOfText({ text, isUtf8 }));
    await write(process.stderr, `${said}\n`);
    return code;
  }
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
  const [folder = ""] = names;
  const isFolder =
    names.length === 1 &&
    (await stat(folder).catch(() => null))?.isDirectory() === true;
  if (
    command === "verify" &&
    (values.manifest || (isFolder && (await hasList(folder))))
  ) {
    if (!isFolder)
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
  const out =
    values.out === undefined
      ? null
      : await folderOf(values.out, files, values.flat === true);
  try {
    const outcomes = performAll(
      task,
      itemsOf(files, values, longest, progress),
      threads,
    );
    const failed = out
      ? await fileAway(task, values, outcomes, byLine, out, progress)
      : await handOut(task, values, outcomes, byLine, progress);
    return failed ? 1 : 0;
  } finally {
    progress.end();
    out?.leave();
  }
}

/** Serves until a signal ends the process. */
async function served(names: string[], values: Values): Promise<number> {
  const other = Object.keys(values).find(
    (option) =>
      ![
        "port",
        "host",
        "jobs",
        "limit",
        "origin",
        "authorize",
        "config",
        "no-config",
      ].includes(option),
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
  const origins = (values.origin ?? []).map(originOf);
  const authorize =
    values.authorize === undefined
      ? undefined
      : await authorizerOf(values.authorize);
  const { serve } = await import("./serve.js");
  const port = countOf("--port", values.port ?? "3000", 0, 65_535);
  await serve({
    port,
    host: values.host ?? "127.0.0.1",
    threads,
    limits,
    config,
    origins,
    authorize,
  });
  return 0;
}

/** An origin as browsers send it. */
function originOf(given: string): string {
  if (
    given !== "*" &&
    !(URL.canParse(given) && new URL(given).origin === given)
  )
    throw new Refused(
      `--origin is an origin such as https://portal.example, or *, not ${given}`,
    );
  return given;
}

/** The function that decides about requests. */
async function authorizerOf(file: string): Promise<Authorize> {
  let found: { default?: unknown };
  try {
    found = await import(pathToFileURL(resolve(file)).href);
  } catch (thrown) {
    throw new Refused(`${file} cannot be loaded: ${(thrown as Error).message}`);
  }
  if (typeof found.default !== "function")
    throw new Refused(`${file} has no function as its default export`);
  return found.default as Authorize;
}

/** The output folder. Temporary files are removed however the process ends, except by SIGKILL. */
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

/** Ends with one line about the error. */
function refuse(why: string, json: boolean): never {
  const name = basename(process.argv[1] ?? "touchpath", ".js");
  process.stderr.write(
    json ? `${JSON.stringify({ error: why })}\n` : `${name}: ${why}\n`,
  );
  process.exit(2);
}

const json = process.argv.includes("--json");
/** Whether jobs are being judged. If the output closes early, the exit code must not be 0. */
let judging = false;
for (const stream of [process.stdout, process.stderr])
  stream.on("error", (error: NodeJS.ErrnoException) => {
    if (stream === process.stderr) process.exit(2);
    // The reader has closed the pipe, as in `| head -1`: this is no error.
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
