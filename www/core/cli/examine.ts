// The `examine` command: safety rules of any program, the variables it needs, the native cycles it calls.
import {
  type ProgramKnown,
  type ProgramRun,
  runProgram,
  version,
} from "../node.js";

/** Format of a report. */
export type ReportFormat = "text" | "json" | "sarif";

/** A report, and whether the program breaks a rule. */
export interface Report {
  run: ProgramRun;
  text: string;
  broken: boolean;
}

/** Runs a program and reports on it. */
export function examined(
  text: string,
  known: ProgramKnown,
  format: ReportFormat,
  source: string,
): Report {
  const run = runProgram(text, known);
  const broken =
    run.rules.some(({ holds }) => holds === false) ||
    run.calls.some((call) => call.contradictions.length > 0);
  const write = { text: asText, json: asJson, sarif: asResults }[format];
  return { run, text: write(run, source), broken };
}

/** Line numbers from 1, as an editor counts; only the first few of many. */
function listed(lines: number[]): string {
  const shown = lines.slice(0, 12).map((line) => line + 1);
  const more = lines.length > shown.length ? ", …" : "";
  return shown.length === 0
    ? ""
    : ` [${shown.length === 1 ? "line" : "lines"} ${shown.join(", ")}${more}]`;
}

const VERDICTS = { true: "keeps", false: "BREAKS", null: "unknown" } as const;

function asText(run: ProgramRun, source: string): string {
  const { kind, kinds, rules, asks, calls } = run;
  const probing = kind.filter((k) => kinds[k] === "probe").length;
  const head = `${source}: ${run.dialect}, ${run.units ?? "units not stated"}, ${kind.length} moves, ${probing} of them probing\n`;
  const rule = ({ rule, holds, message, lines }: ProgramRun["rules"][number]) =>
    `  ${VERDICTS[`${holds}`].padEnd(8)}${rule.padEnd(22)}${message}${listed(lines)}\n`;
  const call = ({
    line,
    name,
    title,
    mark,
    arguments: given,
    contradictions,
  }: ProgramRun["calls"][number]) => {
    const words = given.map(
      ({ name, value, meaning }) =>
        `${name} ${value ?? "?"}${meaning === null ? "" : ` (${meaning})`}`,
    );
    const what =
      title === null
        ? "not known here"
        : `${title}${mark === "recalled" ? ", not verified on a control" : ""}`;
    const wrong = contradictions.map((why) => `; REFUSED: ${why}`).join("");
    return `  calls   line ${line + 1}: ${name}, ${what}${words.length === 0 ? "" : `: ${words.join(", ")}`}${wrong}\n`;
  };
  const ask = ({ name, lines }: ProgramRun["asks"][number]) =>
    `  asks    --set ${name}=…${listed(lines)}\n`;
  return [head, ...rules.map(rule), ...calls.map(call), ...asks.map(ask)].join(
    "",
  );
}

function asJson(
  { dialect, units, plane, rules, asks, calls, findings, kind }: ProgramRun,
  source: string,
): string {
  return `${JSON.stringify({ source, dialect, units, plane, moves: kind.length, rules, asks, calls, findings })}\n`;
}

/** A path as a relative address. */
export const addressOf = (path: string): string =>
  path.split(/[/\\]/).map(encodeURIComponent).join("/");

/** The SARIF results of one program, as a JSON list. */
function asResults(run: ProgramRun, source: string): string {
  const places = (lines: number[]) =>
    (lines.length === 0 ? [null] : lines).map((line) => ({
      physicalLocation: {
        artifactLocation: { uri: addressOf(source) },
        ...(line === null ? {} : { region: { startLine: line + 1 } }),
      },
    }));
  const result = (
    ruleId: string,
    level: string,
    text: string,
    lines: number[],
  ) =>
    places(lines).map((place) => ({
      ruleId,
      level,
      message: { text },
      locations: [place],
    }));
  const rules = run.rules
    .filter(({ holds }) => holds !== true)
    .flatMap(({ rule, holds, message, lines }) =>
      result(rule, holds === false ? "error" : "note", message, lines),
    );
  const calls = run.calls.flatMap(({ line, name, contradictions }) =>
    contradictions.flatMap((why) =>
      result("call-unsound", "error", `${name}: ${why}`, [line]),
    ),
  );
  const levels = { error: "error", warning: "warning", info: "note" } as const;
  const findings = run.findings.flatMap(({ level, code, message, lines }) =>
    result(code, levels[level], message, lines),
  );
  return JSON.stringify([...rules, ...calls, ...findings]);
}

/** One SARIF log (2.1.0) with the results of every program. */
export function sarif(lists: string[]): string {
  const results = lists.flatMap(
    (list) => JSON.parse(list) as { ruleId: string }[],
  );
  const ids = [...new Set(results.map(({ ruleId }) => ruleId))].sort();
  const driver = {
    name: "Touchpath",
    version: version(),
    rules: ids.map((id) => ({ id })),
  };
  const log = {
    $schema: "https://json.schemastore.org/sarif-2.1.0.json",
    version: "2.1.0",
    runs: [{ tool: { driver }, columnKind: "utf16CodeUnits", results }],
  };
  return `${JSON.stringify(log, null, 2)}\n`;
}
