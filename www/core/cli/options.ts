// Options of the command, and the task they describe.
import type { parseArgs } from "node:util";
import { catalog, type ProgramKnown } from "../node.js";
import { PROGRAM_POSTS } from "../program-posts.js";
import { meant } from "./about.js";
import { Refused } from "./folder.js";
import { FORMS, formatsOf, JOBS, NAMES, VIEWS } from "./help.js";
import type { Task } from "./tasks.js";

export const OPTIONS = {
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
  line: { type: "string" },
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
  origin: { type: "string", multiple: true },
  authorize: { type: "string" },
  "deny-warnings": { type: "boolean" },
  help: { type: "boolean", short: "h" },
  version: { type: "boolean", short: "V" },
} as const;

export type Values = ReturnType<
  typeof parseArgs<{ options: typeof OPTIONS }>
>["values"];

/** Checks that a value is in a list, else reports wrong use. */
export function oneOf<T extends string>(
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

/** The task that the options describe. */
export function taskOf(command: Task["command"], values: Values): Task {
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
  only("reporter", "check", "verify");
  if (values.reporter !== undefined && values.format !== undefined)
    throw new Refused("--reporter is the former name of --format");
  const format = values.format ?? values.reporter;
  if (format !== undefined) {
    const formats = formatsOf(command);
    if (formats.length === 0) {
      const others = NAMES.filter((name) => formatsOf(name).length > 0);
      throw new Refused(`--format is for ${others.join(", ")}`);
    }
    task.format = oneOf(
      "--format",
      format,
      formats as NonNullable<Task["format"]>[],
    );
    const reports = command === "check" || command === "verify";
    if (values.json && reports && format !== "json")
      throw new Refused("--format and --json are two forms of one output");
  }
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
  only("units", "new", "convert");
  for (const option of [
    "port",
    "host",
    "limit",
    "origin",
    "authorize",
  ] as const)
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

/** Inputs of a program from the options. */
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

/** A whole number of an option. */
export function countOf(
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

/** Number of threads. */
export function threadsOf(values: Values, usual: number): number {
  return values.jobs === undefined
    ? usual
    : countOf("--jobs", values.jobs, 1, 64);
}
