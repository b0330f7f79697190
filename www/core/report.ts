// Inspection report of one part or a series, against nominal values and tolerances. Pure functions: the report as data, as CSV and as a page to print.

import type { Integer, Plan, ResultRow } from "./plan-types.js";
import { codeOf, isBad, isWritten } from "./results.js";

/** Header data of a report. */
export interface ReportOf {
  /** Plan of the job. */
  plan: Plan;
  /** Results of each part in order: those of `measure`. */
  parts: { results: ResultRow[] }[];
  /** Inspected part, as the title. */
  name?: string;
  /** Inspector, machine, time and remarks. */
  by?: string;
  machine?: string;
  when?: string;
  note?: string;
}

/** Statistics of one result over several parts. Lengths in the job's units, angles in degrees. */
export interface Series {
  /** Number of parts with a value. */
  count: Integer;
  mean: number;
  min: number;
  max: number;
  /** Standard deviation over the parts, with the divisor count − 1; `null` for a single part. */
  spread: number | null;
  /** Slope of the least-squares line through the values, per part; `null` for fewer than three. */
  trend: number | null;
  /** (upper − lower limit) / (6 × spread); `null` without both limits or without spread. */
  cp: number | null;
  /** Distance of the mean from the nearer limit / (3 × spread); `null` in the same cases. */
  cpk: number | null;
}

/** A result in a report. */
export interface ReportRow {
  /** Its code; in a set-up with the name of its cycle or relation: `BORE.diameter`. */
  code: string;
  meaning: string;
  /** `mm`, `inch` or `deg`. */
  unit: string;
  nominal: number | null;
  limits: [number, number] | null;
  /** A value per part; `null` if not measured. */
  values: (number | null)[];
  /** Deviation of the last part: value minus nominal. */
  deviation: number | null;
  /** Expanded uncertainty (k = 2): 95 of 100 measurements lie within. */
  expanded: number | null;
  /** A verdict per part; `null` without a tolerance. */
  verdicts: (string | null)[];
  /** `null` for a single part. */
  series: Series | null;
}

export interface Report {
  name: string;
  by: string;
  machine: string;
  when: string;
  note: string;
  /** Control of the program. */
  control: string;
  /** Hash of the program's blocks from its header; empty without one. */
  program: string;
  parts: Integer;
  /** The worst verdict: `good`, `good within ±`, `out within ±`, `not measured`, `out` and others; `null` without any tolerance. */
  verdict: string | null;
  rows: ReportRow[];
}

/** Verdict of a result with a tolerance but no value. */
const NOT_MEASURED = "not measured";

/** Verdicts from good to bad. */
const GRADES = [
  "good",
  "good within ±",
  "out within ±",
  NOT_MEASURED,
  "rework",
  "out",
  "scrap",
  "implausible",
];

/** The worst of several verdicts; `null` for an empty list. */
const worst = (verdicts: (string | null)[]): string | null =>
  verdicts.reduce(
    (bad, one) =>
      one !== null &&
      (bad === null || GRADES.indexOf(one) > GRADES.indexOf(bad))
        ? one
        : bad,
    null,
  );

/** A time for the sheet, in the local time zone: `2026-11-26 17:05`. */
export const clock = (moment: Date): string => {
  const two = (n: number) => String(n).padStart(2, "0");
  const day = `${moment.getFullYear()}-${two(moment.getMonth() + 1)}-${two(moment.getDate())}`;
  return `${day} ${two(moment.getHours())}:${two(moment.getMinutes())}`;
};

/** The report as data. */
export function report({
  plan,
  parts,
  name = "",
  by = "",
  machine = "",
  when = "",
  note = "",
}: ReportOf): Report {
  const key = ({ cycle, code }: ResultRow) => codeOf(plan, cycle, code);
  const measured = parts.map(
    ({ results }) => new Map(results.map((row) => [key(row), row])),
  );
  // A work offset that the program writes is no feature of the part.
  const listed = plan.results.filter(
    (row) => !isWritten(row) && row.unit !== "",
  );
  const found = (row: ResultRow) =>
    row.value !== null ||
    row.limits !== null ||
    measured.some(
      (part) =>
        part.get(key(row))?.value != null || part.get(key(row))?.limits != null,
    );
  const rows = listed.filter(found).map((row): ReportRow => {
    const code = key(row);
    const own = measured.map((part) => part.get(code));
    const last = own.at(-1);
    const limits = last?.limits ?? row.limits;
    const values = own.map((part) => part?.value ?? null);
    const series = parts.length > 1 ? seriesOf(values, limits) : null;
    return {
      code,
      meaning: row.meaning,
      unit: row.unit,
      nominal: row.nominal,
      limits,
      values,
      deviation: last?.deviation ?? null,
      expanded: last?.uncertainty == null ? null : 2 * last.uncertainty,
      verdicts: own.map((part) =>
        limits !== null && part?.value == null
          ? NOT_MEASURED
          : (part?.verdict ?? null),
      ),
      series,
    };
  });
  return {
    name,
    by,
    machine,
    when,
    note,
    control: plan.program.post,
    program: /Blocks below: (\w+)/i.exec(plan.program.text)?.[1] ?? "",
    parts: parts.length,
    verdict: worst(rows.flatMap(({ verdicts }) => verdicts)),
    rows,
  };
}

function seriesOf(
  values: (number | null)[],
  limits: [number, number] | null,
): Series | null {
  const known = values.flatMap((value, part) =>
    value === null ? [] : [{ value, part }],
  );
  const count = known.length;
  if (count === 0) return null;
  const of = known.map(({ value }) => value);
  const mean = of.reduce((sum, x) => sum + x, 0) / count;
  const squares = of.reduce((sum, x) => sum + (x - mean) ** 2, 0);
  const spread = count > 1 ? Math.sqrt(squares / (count - 1)) : null;
  const middle = known.reduce((sum, { part }) => sum + part, 0) / count;
  const along = known.reduce((sum, { part }) => sum + (part - middle) ** 2, 0);
  const slope = known.reduce(
    (sum, { part, value }) => sum + (part - middle) * (value - mean),
    0,
  );
  // Rounding noise of equal values is no spread.
  const able =
    limits !== null &&
    spread !== null &&
    spread > 1e-9 * Math.max(1, Math.abs(mean));
  return {
    count,
    mean,
    min: Math.min(...of),
    max: Math.max(...of),
    spread,
    trend: count > 2 ? slope / along : null,
    cp: able ? (limits[1] - limits[0]) / (6 * spread) : null,
    cpk: able
      ? Math.min(limits[1] - mean, mean - limits[0]) / (3 * spread)
      : null,
  };
}

/** Line that Renishaw's macros print above the results of a part. */
const COMPONENT = /^[\s*]*COMPONENT[\s*]+NO[\s*]+(\d+)/;

/**
 * Splits a log into the runs of a program, one per part. A run starts where a result repeats, where a line has only the name of the program, or where
 * Renishaw's macros print the next component. A text of points or of one run stays whole.
 */
export function runsOf(text: string, plan: Plan): string[] {
  const pointed = (text: string) => text.toLowerCase().replace(/[\s*_]+/g, ".");
  // A result appears under its name or under the variable that stores it: `#138`, `_OVR[4]`.
  const names = plan.results.flatMap(({ cycle, code, stored }) => {
    const own = codeOf(plan, cycle, code).toLowerCase();
    return [own, ...(stored === null ? [] : [pointed(stored)])].map((name) => ({
      name,
      own,
    }));
  });
  const coded = (line: string) => {
    const plain = pointed(line);
    // A value follows it. A remark about a result has no value.
    const found = names.filter(({ name }) =>
      new RegExp(
        `(^|[^a-z0-9.])${name.replace(/[.[\]#$]/g, "\\$&")}(\\.?=\\.?|\\.)[-+]?\\.?\\d`,
      ).test(plain),
    );
    return found.sort((a, b) => b.name.length - a.name.length)[0]?.own;
  };
  const runs: string[][] = [];
  let said = new Set<string>();
  let component: string | undefined;
  for (const line of text.split(/\r?\n/)) {
    const code = coded(line);
    const next = COMPONENT.exec(line)?.[1];
    if (next !== undefined && next !== component) {
      if (component !== undefined) {
        runs.push([]);
        said = new Set();
      }
      component = next;
    }
    if (runs.length === 0 || (code !== undefined && said.has(code))) {
      // The name of the program precedes its first result.
      const named = runs.at(-1)?.at(-1);
      const moved =
        named !== undefined && said.size > 0 && coded(named) === undefined
          ? [runs.at(-1)?.pop() as string]
          : [];
      runs.push(moved);
      said = new Set();
    }
    if (code !== undefined) said.add(code);
    runs.at(-1)?.push(line);
  }
  return runs.map((lines) => lines.join("\n"));
}

/** Decimals of a value: one more than a control displays. */
const decimals = (unit: string) => (unit === "inch" ? 5 : 4);
const shown = (x: number | null, digits: number) =>
  x === null ? "" : x.toFixed(digits).replace(/^-(0\.?0*)$/, "$1");

/** A field of CSV. Text that a spreadsheet would take for a formula stays text. */
const field = (text: string) => {
  const safe =
    /^[=+@\t\r-]/.test(text) && !/^[+-]?\d/.test(text) ? `'${text}` : text;
  return /[",\n\r]/.test(safe) ? `"${safe.replaceAll('"', '""')}"` : safe;
};

/** The report as CSV, a line per result. */
export function reportCsv({ rows, parts }: Report): string {
  const each = Array.from({ length: parts }, (_, i) =>
    parts > 1 ? ` ${i + 1}` : "",
  );
  const head = ["result", "meaning", "unit", "nominal", "lower", "upper"];
  head.push(
    ...each.map((n) => `measured${n}`),
    "deviation",
    "expanded uncertainty",
    ...each.map((n) => `verdict${n}`),
  );
  if (parts > 1)
    head.push("count", "mean", "min", "max", "spread", "trend", "Cp", "Cpk");
  const lines = rows.map((row) => {
    const n = decimals(row.unit);
    const number = (x: number | null | undefined, digits = n) =>
      shown(x ?? null, digits);
    const own = [
      row.code,
      row.meaning,
      row.unit,
      number(row.nominal),
      number(row.limits?.[0]),
      number(row.limits?.[1]),
    ];
    own.push(
      ...row.values.map((value) => number(value)),
      number(row.deviation),
      number(row.expanded, n + 1),
    );
    own.push(...row.verdicts.map((verdict) => verdict ?? ""));
    if (parts > 1) {
      const { series } = row;
      own.push(
        String(series?.count ?? 0),
        number(series?.mean),
        number(series?.min),
        number(series?.max),
      );
      own.push(
        number(series?.spread, n + 1),
        number(series?.trend, n + 1),
        number(series?.cp, 2),
        number(series?.cpk, 2),
      );
    }
    return own;
  });
  return `${[head, ...lines].map((line) => line.map(field).join(",")).join("\n")}\n`;
}

const escaped = (text: string) =>
  text.replace(
    /[&<>"]/g,
    (c) =>
      ({ "&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;" })[c] as string,
  );

/** Text of the page in a language; English if omitted. */
export type Words = (template: string, ...values: string[]) => string;

const english: Words = (template, ...values) => {
  let at = 0;
  return template.replace(/\{\w+\}/g, () => values[at++] ?? "");
};

const STYLE = `@page{margin:14mm}body{font:13px/1.4 system-ui,sans-serif;color:#111;background:#fff;max-width:190mm;margin:1.5rem auto;padding:0 1rem}
h1{font-size:1.4em;margin:0 0 .3em}table{border-collapse:collapse;width:100%;margin:1em 0}caption{text-align:left;font-weight:bold;padding:.3em 0}
th,td{border-bottom:1px solid #bbb;padding:.25em .4em;text-align:left;vertical-align:top}.n{text-align:right;font-variant-numeric:tabular-nums;white-space:nowrap}
code{font-size:.92em}.bad{font-weight:bold;color:#a30d0d}.open{font-weight:bold}svg{width:100%;max-height:95mm}dl{display:grid;grid-template-columns:auto 1fr auto 1fr;gap:.1em .8em;margin:.6em 0}
dt{color:#555}dd{margin:0}tr{break-inside:avoid}.verdict{font-size:1.15em}.sign{display:flex;gap:2em;margin-top:2.5em}.sign span{flex:1;border-top:1px solid #111;padding-top:.2em}`;

/** The report as a page to print on A4 or Letter. `picture`: SVG text from `svg`. `t` translates its texts into the language `lang`. */
export function reportHtml(
  of: Report,
  picture = "",
  t: Words = english,
  lang = "en",
): string {
  const { rows, parts, verdict } = of;
  const grade = (word: string | null) =>
    word === null
      ? ""
      : `<span class="${isBad(word) ? "bad" : /±/.test(word) ? "open" : ""}">${escaped(word === NOT_MEASURED ? t("not measured") : t(word))}</span>`;
  const head = [
    t("Result"),
    t("Nominal"),
    t("Limits"),
    parts > 1 ? t("Last part") : t("Measured"),
    t("Deviation"),
    "± 2σ",
    t("Verdict"),
  ];
  const unit = (row: ReportRow) => (row.unit === "deg" ? "°" : ` ${row.unit}`);
  const lines = rows.map((row, i) => {
    const n = decimals(row.unit);
    const limits =
      row.limits === null
        ? ""
        : `${shown(row.limits[0], n)} … ${shown(row.limits[1], n)}`;
    const last = row.values.at(-1) ?? null;
    const cells = [
      shown(row.nominal, n),
      limits,
      last === null ? "–" : shown(last, n),
      shown(row.deviation, n),
      shown(row.expanded, n + 1),
    ];
    return `<tr><td>${i + 1}. ${escaped(t(row.meaning))} <code>${escaped(row.code)}</code>${escaped(unit(row))}</td>${cells.map((cell) => `<td class="n">${cell}</td>`).join("")}<td>${grade(row.verdicts.at(-1) ?? null)}</td></tr>`;
  });
  const said = (pairs: [string, string][]) =>
    pairs
      .filter(([, value]) => value !== "")
      .map(
        ([label, value]) =>
          `<dt>${escaped(label)}</dt><dd>${escaped(value)}</dd>`,
      );
  const facts = said([
    [t("Machine"), of.machine],
    [t("Name"), of.by],
    [t("Date"), of.when],
    [t("Control"), of.control],
    [t("Program"), of.program],
    [t("Parts"), String(parts)],
    [t("Note"), of.note],
  ]);
  return `<!doctype html>
<html lang="${escaped(lang)}"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width"><title>${escaped(`${t("Inspection report")} ${of.name}`.trim())}</title><style>${STYLE}</style></head><body>
<h1>${escaped(t("Inspection report"))}${of.name ? `: ${escaped(of.name)}` : ""}</h1>
${verdict === null ? "" : `<p class="verdict">${escaped(t("Verdict"))}: ${grade(verdict)}</p>`}
<dl>${facts.join("")}</dl>
${picture}
<table><thead><tr>${head.map((cell, i) => `<th${i > 0 && i < 6 ? ' class="n"' : ""}>${escaped(cell)}</th>`).join("")}</tr></thead><tbody>${lines.join("\n")}</tbody></table>
${parts > 1 ? seriesTable(rows, t) : ""}
<p>${escaped(t("± 2σ is twice the standard uncertainty of the touches. A value that is closer to a limit than that may be on either side of it: good within ±, out within ±."))}</p>
<p class="sign"><span>${escaped(t("Date"))}</span><span>${escaped(t("Name"))}</span></p>
</body></html>
`;
}

/** Statistics of a series of parts. */
function seriesTable(rows: ReportRow[], t: Words): string {
  const head = [
    t("Result"),
    t("Parts"),
    t("Mean"),
    t("Smallest"),
    t("Largest"),
    t("Spread s"),
    t("Trend a part"),
    "Cp",
    "Cpk",
  ];
  const lines = rows.flatMap(({ code, unit, series }) => {
    if (series === null) return [];
    const n = decimals(unit);
    const { count, mean, min, max, spread, trend, cp, cpk } = series;
    const cells = [
      String(count),
      shown(mean, n),
      shown(min, n),
      shown(max, n),
      shown(spread, n + 1),
      shown(trend, n + 1),
      shown(cp, 2),
      shown(cpk, 2),
    ];
    return [
      `<tr><td><code>${escaped(code)}</code></td>${cells.map((cell) => `<td class="n">${cell}</td>`).join("")}</tr>`,
    ];
  });
  return `<table><caption>${escaped(t("The series"))}</caption><thead><tr>${head.map((cell, i) => `<th${i > 0 ? ' class="n"' : ""}>${escaped(cell)}</th>`).join("")}</tr></thead><tbody>${lines.join("\n")}</tbody></table>`;
}
