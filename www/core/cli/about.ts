// Commands without jobs: the meaning of a code, a new job, tool lengths, conversion of units, help for one command.
import { readFileSync } from "node:fs";
import {
  catalog,
  convertUnits,
  defaultJob,
  type Job,
  JobError,
  type LentoaxQuery,
  lentoax,
  lentoaxWords,
  version,
} from "../node.js";
import { CODES, RULES } from "./codes.js";
import { Refused } from "./folder.js";
import { parsed } from "./tasks.js";

/** Edit distance of two words. */
function apart(one: string, other: string): number {
  let row = Array.from({ length: other.length + 1 }, (_, i) => i);
  for (const [i, letter] of [...one].entries()) {
    const next = [i + 1];
    for (const [j, wanted] of [...other].entries())
      next.push(
        Math.min(
          (row[j] ?? 0) + Number(letter !== wanted),
          (row[j + 1] ?? 0) + 1,
          (next[j] ?? 0) + 1,
        ),
      );
    row = next;
  }
  return row.at(-1) ?? 0;
}

/** `. Did you mean check?` if the list has a similar word; else empty. */
export function meant(word: string, list: readonly string[]): string {
  const near = list.map((known) => ({
    known,
    off: apart(word.toLowerCase(), known),
  }));
  const best = near.sort((a, b) => a.off - b.off)[0];
  return best && best.off <= Math.max(1, Math.floor(word.length / 4))
    ? `. Did you mean ${best.known}?`
    : "";
}

/** Meaning of the code of a finding or a safety rule. */
export function explain(code: string, json: boolean): string {
  const word = code.toLowerCase();
  const own = <T>(table: Record<string, T>) =>
    Object.hasOwn(table, word) ? table[word] : undefined;
  const [rule, meaning] = [own(RULES), own(CODES)];
  if (rule === undefined && meaning === undefined)
    throw new Refused(
      `There is no finding and no rule ${code}${meant(word, [...Object.keys(CODES), ...Object.keys(RULES)])}`,
    );
  const said = rule
    ? { rule: word, asks: rule[0], why: rule[1] }
    : { code: word, meaning };
  if (json) return `${JSON.stringify(said)}\n`;
  return rule
    ? `${word} (safety rule)\n\n${rule[0]}\n${rule[1]}\n`
    : `${word}\n\n${meaning}\n`;
}

/** A job of a cycle with every value, ready to edit. */
export function newJob(
  type: string,
  given: { post?: string; form?: string; units?: string },
): string {
  const types = catalog().cycles.map((cycle) => cycle.type as string);
  const known = types.find((one) => one === type);
  if (!known)
    throw new Refused(
      `There is no cycle ${type} (touchpath catalog lists them)${meant(type, types)}`,
    );
  const { units = "mm" } = given;
  if (units !== "mm" && units !== "inch")
    throw new Refused(`--units is mm or inch, not ${units}`);
  const job = defaultJob(known as "hole", units);
  const post = given.post ?? job.control.post;
  const forms =
    catalog()
      .posts.find(({ id }) => id === post)
      ?.cycles.filter(({ type }) => type === known) ?? [];
  const wanted = forms.filter(
    ({ form }) => given.form === undefined || form === given.form,
  );
  const taken = wanted.find(({ supported }) => supported);
  if (!taken)
    throw new Refused(
      `${post} does not take ${known}: ${wanted.map(({ form, reason }) => `${form}: ${reason}`).join("; ")}`,
    );
  const control = { ...job.control, post, form: taken.form };
  return `${JSON.stringify({ ...job, control }, null, 2)}\n`;
}

/** Which tool length acts on which axis of a SINUMERIK. */
export function toolLengths(text: string | undefined, json: boolean): string {
  try {
    const query =
      text === undefined ? undefined : (objectOf(text) as LentoaxQuery);
    const answer = lentoax(query);
    if (json) return `${JSON.stringify(answer)}\n`;
    const { sentence, program } = lentoaxWords(query);
    return `${sentence}\n_AXIND = ${answer.axind.join(", ")}\n\n${program}`;
  } catch (thrown) {
    throw refused(thrown);
  }
}

/** A script with the functions and the module, for servers that are bundled into one file. It is TypeScript as well. */
export function inlined(): string {
  // Written so that no bundler takes it for an asset and replaces the address.
  const beside = (path: string) => new URL(path, import.meta.url);
  const module = readFileSync(beside("../wasm/touchpath_bg.wasm"), "base64");
  return `// Made by \`touchpath inline\`, version ${version()}: make it again after an update.
import { init } from "touchpath/init";

export * from "touchpath/init";

init(Uint8Array.from(atob("${module}"), (c) => c.charCodeAt(0)));
`;
}

/** A job in other units. */
export function converted(text: string, units: string): string {
  if (units !== "mm" && units !== "inch")
    throw new Refused(`--units is mm or inch, not ${units}`);
  try {
    const job = objectOf(text) as Job;
    if (![undefined, "mm", "inch"].includes(job.units))
      throw new Refused(`The job's units are ${job.units}: mm or inch`);
    if (!isWritable(job))
      throw new Refused(
        "The job has a number that is too large to be written again",
      );
    return `${JSON.stringify(convertUnits(job, units), null, 2)}\n`;
  } catch (thrown) {
    throw refused(thrown);
  }
}

function objectOf(text: string): object {
  const value = parsed(text);
  if (typeof value !== "object" || value === null || Array.isArray(value))
    throw new Refused("This is JSON, but not an object");
  return value;
}

/** Whether JSON can represent every number of a value. */
const isWritable = (value: unknown): boolean =>
  typeof value === "object" && value !== null
    ? Object.values(value).every(isWritable)
    : typeof value !== "number" || Number.isFinite(value);

const refused = (thrown: unknown) =>
  thrown instanceof JobError
    ? new Refused(thrown.findings.map((finding) => finding.message).join("; "))
    : thrown;
