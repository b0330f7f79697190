// Checks that a program is still that of the job in its header.
import { diffArrays } from "diff";
import {
  type AnyJob,
  type Finding,
  importJob,
  insertProgram,
  JobError,
  program,
} from "../node.js";

/** Result of verifying a program. Broken safety rules are a finding, `unsafe-program`. */
export interface Verified {
  /**
   * `same`; `version`: only another version wrote it; `changed`; `refused`: its job no longer has a program; `no-job`. By the manifest of a folder also
   * `missing`, `unlisted`, `job-changed`, `job-missing`.
   */
  state:
    | "same"
    | "version"
    | "changed"
    | "refused"
    | "no-job"
    | "missing"
    | "unlisted"
    | "job-changed"
    | "job-missing";
  said: string;
  /** First lines that differ, from 1: actual and expected text. */
  lines: { line: number; is: string | null; wanted: string | null }[];
  findings: Finding[];
}

/** Maximum number of lines listed. */
const LISTED = 5;
/** Header lines that depend on the version. */
const STAMP = /Made by Touchpath |Blocks below: |^\s*$/i;

const linesOf = (text: string) =>
  text.replace(/^\uFEFF/, "").split(/\r\n|\r|\n/);
/** Blocks below the header with their lines, and the last line of the header; without a header, and of a whole text, all blocks, and 0. */
function blocks(
  text: string,
  whole = false,
): {
  own: { line: number; text: string }[];
  head: number;
} {
  const all = linesOf(text).map((text, i) => ({
    line: i + 1,
    text: text.trimEnd(),
  }));
  const end = whole
    ? -1
    : all.findIndex(({ text }) => /Blocks below: [0-9A-F]+/i.test(text));
  const own = all.slice(end + 1).filter(({ text }) => !STAMP.test(text));
  return { own, head: end + 1 };
}

/** Most edits that are looked for between the common beginning and end. */
const MOST_EDITS = 2000;

/** Lines that differ: each changed line with the expected one, and added and missing lines. `head`: the last line of the header. */
function differing(
  is: { line: number; text: string }[],
  wanted: { text: string }[],
  head: number,
): Verified["lines"] {
  const same = (i: number, j: number) => is[i]?.text === wanted[j]?.text;
  const least = Math.min(is.length, wanted.length);
  let begin = 0;
  while (begin < least && same(begin, begin)) begin++;
  let end = 0;
  while (
    end < least - begin &&
    same(is.length - 1 - end, wanted.length - 1 - end)
  )
    end++;
  const texts = (list: { text: string }[]) =>
    list.slice(begin, list.length - end).map(({ text }) => text);
  const [mine, theirs] = [texts(is), texts(wanted)];
  const changes = diffArrays(theirs, mine, { maxEditLength: MOST_EDITS }) ?? [
    { removed: true, added: false, value: theirs },
    { removed: false, added: true, value: mine },
  ];
  const lines: Verified["lines"] = [];
  let [next, missing, extra] = [begin, [] as string[], [] as typeof is];
  const flush = () => {
    const after = extra.at(-1)?.line ?? is[next - 1]?.line ?? head;
    for (let i = 0; i < Math.max(extra.length, missing.length); i++)
      // Beyond the limit lines are compared in their order, and some are the same.
      if (extra[i]?.text !== missing[i])
        lines.push({
          line: extra[i]?.line ?? after + 1,
          is: extra[i]?.text ?? null,
          wanted: missing[i] ?? null,
        });
    [missing, extra] = [[], []];
  };
  for (const { added, removed, value } of changes) {
    if (removed) missing.push(...value);
    else {
      const own = is.slice(next, next + value.length);
      if (added) extra.push(...own);
      else flush();
      next += value.length;
    }
  }
  flush();
  return lines;
}

/** Number of lines of a text with these words. */
const count = (text: string, words: RegExp) => text.match(words)?.length ?? 0;

/** Whether a text has first and last comments of inserted programs, each pair around one header. */
function hasPairs(text: string): boolean {
  const begun = count(text, /\bTouchpath begins\b/gi);
  return [/\bTouchpath ends\b/gi, /\bMade by Touchpath\b/gi].every(
    (words) => count(text, words) === begun,
  );
}

/** The text as its jobs make it: the program of the header's job, or another program with the inserted ones. */
function expected(text: string, job: AnyJob): string {
  const inside = [...text.matchAll(/^.*\bTouchpath begins\b/gim)];
  if (inside.length === 0) return program(job).text;
  const declared = text.match(/^DEF INT TP.*$/gm)?.join("\n") ?? "";
  return inside.reduce((whole, { index }) => {
    const { job } = importJob(`${declared}\n${text.slice(index)}`);
    return job === null ? whole : insertProgram(job, whole).text;
  }, text);
}

/** Compares a program with its job. */
export function verified(text: string): Verified {
  const done = (
    state: Verified["state"],
    said: string,
    findings: Finding[],
    lines: Verified["lines"] = [],
  ) => ({
    state,
    said,
    lines,
    findings,
  });
  let read: ReturnType<typeof importJob>;
  try {
    read = importJob(text);
  } catch (thrown) {
    if (!(thrown instanceof JobError)) throw thrown;
    if (thrown.findings.some(({ code }) => code === "not-understood"))
      return done(
        "changed",
        "has lines that are not of its job's program",
        thrown.findings,
      );
    return done("no-job", "its header says no job", thrown.findings);
  }
  const { job, findings } = read;
  if (job === null) return done("no-job", "its header says no job", findings);
  let wanted: string;
  try {
    wanted = expected(text, job);
  } catch (thrown) {
    if (!(thrown instanceof JobError)) throw thrown;
    const why = thrown.findings.some(({ code }) => code === "not-inserted")
      ? `its job's program does not fit there: ${thrown.message}`
      : "this version refuses its job";
    return done("refused", why, thrown.findings);
  }
  const isInside = /\bTouchpath (begins|ends)\b/i.test(text);
  if (isInside && !hasPairs(text))
    return done(
      "changed",
      "has an inserted program without its first or last comment",
      findings,
    );
  const { own, head } = blocks(text, isInside);
  const lines = differing(own, blocks(wanted, isInside).own, head);
  if (lines.length > 0) {
    const many =
      lines.length === 1 ? "a line differs" : `${lines.length} lines differ`;
    return done(
      "changed",
      `${many} from its job's program`,
      findings,
      lines.slice(0, LISTED),
    );
  }
  const version = /Made by Touchpath (\S+)/i.exec(text)?.[1];
  const now = /Made by Touchpath (\S+)/i.exec(wanted)?.[1];
  if (version !== undefined && version.toLowerCase() !== now?.toLowerCase())
    return done(
      "version",
      `is its job's program; version ${version} wrote it`,
      findings,
    );
  return done("same", "is its job's program", findings);
}

/** The result as text. */
export function verifiedText(
  source: string,
  { said, lines }: Verified,
): string {
  const differ = lines.map(
    ({ line, is, wanted }) =>
      `  line ${line}: ${is ?? "(missing)"}\n${" ".repeat(9)}should be: ${wanted ?? "(nothing)"}\n`,
  );
  return [`${source}: ${said}\n`, ...differ].join("");
}
