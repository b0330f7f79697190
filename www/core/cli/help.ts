// Commands and their options, for the help text and the completion of shells.
import { catalog, version } from "../node.js";
import type { completion } from "./completion.js";
import { LIMITS } from "./limits.js";

/** Commands with their arguments, output and formats. */
const COMMANDS = {
  plan: ["JOB…", "the program of every job"],
  check: ["JOB…", "errors, warnings and notes", "text|json|github|junit|sarif"],
  table: ["JOB…", "the parameter table", "text|csv|json"],
  svg: ["JOB…", "the picture"],
  import: ["TEXT…", "a job from a dump or a program"],
  moves: ["PROGRAM…", "the moves of any program", "text|csv|json"],
  examine: [
    "PROGRAM…",
    "check any program: safety rules, native cycles, variables to set",
    "text|json|sarif",
  ],
  verify: [
    "PROGRAM…",
    "check that programs, or all in a folder, match the jobs in their headers",
    "text|json|github|junit",
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
  insert: [
    "JOB PROGRAM",
    "insert the program of a job into another program, after the tool change of the probe",
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
  inline: [
    "",
    "a script with the functions and the module, for a server that is bundled into one file",
  ],
  schema: ["", "the JSON Schema of a job"],
  catalog: ["", "cycles, fields and controls"],
} as const satisfies Record<string, readonly [string, string, string?]>;
export type Command = keyof typeof COMMANDS;
export const NAMES = Object.keys(COMMANDS) as Command[];

/** Formats of a command's output. */
export function formatsOf(command: Command): string[] {
  const [, , formats]: readonly [string, string, string?] = COMMANDS[command];
  return formats?.split("|") ?? [];
}

/** Commands that take jobs, and those that take programs. */
export const JOBS = ["plan", "check", "table", "svg", "evaluate", "report"];
const FILES = [...JOBS, "import", "moves", "examine", "verify"];

/** The file of rules that is found automatically. */
export const CONFIG_FILE = "touchpath.config.json";

/** Options: spelling, description, and the commands that accept them. */
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
    [...JOBS, "insert", "serve"],
  ],
  [
    "--no-config",
    `no rules, whatever ${CONFIG_FILE} there is`,
    [...JOBS, "insert", "serve"],
  ],
  ["--line N", "insert the program after this line", ["insert"]],
  ["--units U", "mm or inch", ["new", "convert"]],
  ["--view V", "isometric, top, front or side", ["svg"]],
  [
    "--set NAME=X",
    "set a variable (repeatable): --set '#3014=5' --set R1=2",
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
    "write one file per job to DIR, in the folders of the jobs; overwrites existing files",
    ["plan", "table", "svg", "import", "moves", "evaluate", "report"],
  ],
  [
    "--manifest",
    "plan -o: lists the files in manifest.json there, each with its job and their hashes; verify DIR compares the folder with that list, if there is one",
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
    "--origin URL",
    "pages of this origin may read the answers, as https://portal.example; * for all; repeatable",
    ["serve"],
  ],
  [
    "--authorize FILE",
    "a module whose default function gets method, path and headers, and returns whether the request is answered",
    ["serve"],
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
program without moves, one that breaks a rule or is not that of its job, or a reported part that is not good, 2 wrong use, 141 the output pipe was closed before all jobs were checked.`;

/** Help line of each command, and its output. */
function usage(command: Command): string {
  const [after, about, formats]: readonly [string, string, string?] =
    COMMANDS[command];
  const head = `  touchpath ${`${command} ${after}`.trim()}`;
  return `${head.padEnd(34)} ${about}${formats ? `   --format ${formats}` : ""}`;
}

const options = (list: typeof HELP_OF_OPTIONS) =>
  list.map(([flag, about]) => `  ${flag.padEnd(17)} ${about}`).join("\n");

/** The help: for one command with its options, or for all. */
export function help(command?: Command): string {
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

/** Data for the completion of a shell. */
export function completed(): Parameters<typeof completion>[1] {
  const flags = (command: Command) =>
    HELP_OF_OPTIONS.filter(([, , commands]) =>
      commands.includes(command),
    ).flatMap(([typed]) =>
      [...typed.matchAll(/(?<=^|, )--?[a-z-]+/g)].map(([flag]) => flag),
    );
  const formats = NAMES.flatMap((name) => {
    const list = formatsOf(name);
    return list.length > 0 ? [[name, list] as const] : [];
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
    },
  };
}

export const FORMS = ["moves", "cycle"];
export const UNITS = ["mm", "inch"];
export const VIEWS = ["isometric", "top", "front", "side"] as const;
