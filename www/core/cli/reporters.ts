// Outcomes in the formats of build tools.
import { addressOf } from "./examine.js";
import type { Outcome, PlacedFinding } from "./tasks.js";

const LEVELS = { error: "error", warning: "warning", info: "notice" } as const;

/** Text of a finding, with its path. */
const saidOf = ({ path, message }: PlacedFinding) =>
  path ? `${path}: ${message}` : message;

/** A failure without a finding: a program that does not match its job. */
const unsaid = ({ failed, findings, output }: Outcome) =>
  failed && !findings.some(({ level }) => level === "error")
    ? (output?.text.trim() ?? "failed")
    : null;

/** GitHub workflow commands: annotations at file and line. */
export function github(outcome: Outcome): string {
  const value = (text: string) =>
    text.replaceAll("%", "%25").replaceAll("\r", "%0D").replaceAll("\n", "%0A");
  const property = (text: string) =>
    value(text).replaceAll(":", "%3A").replaceAll(",", "%2C");
  const { row } = outcome;
  const own =
    row === undefined
      ? outcome.source
      : outcome.source.replace(new RegExp(`:${row}$`), "");
  const file = own === "standard input" ? [] : [`file=${property(own)}`];
  const at = row === undefined ? [] : [`line=${row}`];
  const of = (finding: PlacedFinding) => {
    const { level, code, line, column } = finding;
    const place = line === undefined ? at : [`line=${line}`, `col=${column}`];
    return `::${LEVELS[level]} ${[...file, ...place, `title=${property(code)}`].join(",")}::${value(saidOf(finding))}\n`;
  };
  const other = unsaid(outcome);
  return `${other === null ? "" : `::error ${[...file, ...at].join(",")}::${value(other)}\n`}${outcome.findings.map(of).join("")}`;
}

/** Whether XML allows a character: most control characters are forbidden, even escaped. */
const isXml = (sign: string) =>
  sign >= " "
    ? sign !== "\ufffe" && sign !== "\uffff"
    : "\t\n\r".includes(sign);

const xml = (text: string) =>
  Array.from(text, (sign) =>
    isXml(sign) && (sign.codePointAt(0) ?? 0) >> 11 !== 0x1b ? sign : "\ufffd",
  )
    .join("")
    .replaceAll("&", "&amp;")
    .replaceAll("<", "&lt;")
    .replaceAll(">", "&gt;")
    .replaceAll('"', "&quot;");

/** JUnit report with a test case per job or program. `denied`: warnings are failures too. */
export function junit(
  command: string,
  outcomes: Outcome[],
  denied: boolean,
): string {
  let failures = 0;
  const cases = outcomes.map((outcome) => {
    const fails = ({ level }: PlacedFinding) =>
      level === "error" || (denied && level === "warning");
    const at = ({ line, column }: PlacedFinding) =>
      line === undefined ? "" : `:${line}:${column}`;
    const text = (f: PlacedFinding) =>
      `${outcome.source}${at(f)}: ${f.level}: ${saidOf(f)} [${f.code}]`;
    const bad = outcome.findings.filter(fails);
    const other = unsaid(outcome);
    const said = [...(other === null ? [] : [other]), ...bad.map(text)];
    const rest = outcome.findings.filter((f) => !fails(f)).map(text);
    if (said.length > 0) failures++;
    const failure =
      said.length === 0
        ? ""
        : `<failure message="${xml(bad[0] ? saidOf(bad[0]) : (other ?? ""))}" type="${xml(bad[0]?.code ?? "failed")}">${xml(said.join("\n"))}</failure>`;
    const out =
      rest.length === 0
        ? ""
        : `<system-out>${xml(rest.join("\n"))}</system-out>`;
    return `    <testcase name="${xml(outcome.source)}" classname="touchpath.${command}">${failure}${out}</testcase>\n`;
  });
  const counts = `tests="${outcomes.length}" failures="${failures}"`;
  return `<?xml version="1.0" encoding="UTF-8"?>\n<testsuites ${counts}>\n  <testsuite name="touchpath ${command}" ${counts}>\n${cases.join("")}  </testsuite>\n</testsuites>\n`;
}

/** The SARIF results of the findings of one job, as a JSON list. */
export function sarifResults({ source, row, findings }: Outcome): string {
  const file =
    row === undefined ? source : source.replace(new RegExp(`:${row}$`), "");
  const levels = { ...LEVELS, info: "note" };
  return JSON.stringify(
    findings.map((finding) => {
      const { level, code, line = row, column } = finding;
      const region = {
        startLine: line,
        ...(column === undefined ? {} : { startColumn: column }),
      };
      return {
        ruleId: code,
        level: levels[level],
        message: { text: saidOf(finding) },
        locations: [
          {
            physicalLocation: {
              artifactLocation: { uri: addressOf(file) },
              ...(line === undefined ? {} : { region }),
            },
          },
        ],
      };
    }),
  );
}
