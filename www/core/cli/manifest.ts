// Manifest of a folder of programs: the job of each file, with its hash.
import { createHash } from "node:crypto";
import { readFile, stat } from "node:fs/promises";
import { isAbsolute, join, relative, resolve, sep } from "node:path";
import { glob } from "tinyglobby";
import { catalog, version } from "../node.js";
import { Refused } from "./folder.js";
import { type Outcome, perform, type Task } from "./tasks.js";
import { type Verified, verifiedText } from "./verify.js";

/** A file in the manifest. Paths are relative to the folder. */
export interface Listed {
  file: string;
  sha256: string;
  control: string | null;
  /** File of the job, its line in a file with a job per line, and the SHA-256 of its text. The file is null for a job from standard input. */
  job: { file: string | null; line: number | null; sha256: string };
}

interface Manifest {
  touchpath: string;
  files: Listed[];
}

/** File name of the manifest. */
export const LIST = { name: "manifest", ending: ".json" };
const MANIFEST = `${LIST.name}${LIST.ending}`;

const hashOf = (text: string | Uint8Array) =>
  createHash("sha256").update(text).digest("hex");
const posix = (path: string) => path.split(sep).join("/");
const byName = (a: string, b: string) => (a < b ? -1 : Number(a > b));

/** Manifest of the files written into a folder, as text. */
export function manifestOf(
  folder: string,
  made: { outcome: Outcome; file: string; hash: string }[],
): string {
  const from = (path: string) =>
    posix(relative(resolve(folder), resolve(path)));
  const files = made.map(
    ({ outcome: { source, row, given, control }, file, hash }): Listed => {
      const own =
        row === undefined ? source : source.slice(0, -`:${row}`.length);
      const job = {
        file: own === "standard input" ? null : from(own),
        line: row ?? null,
        sha256: given ?? "",
      };
      return { file: from(file), sha256: hash, control, job };
    },
  );
  const list: Manifest = {
    touchpath: version(),
    files: files.sort((a, b) => byName(a.file, b.file)),
  };
  return `${JSON.stringify(list, null, 2)}\n`;
}

/** Whether a folder has a manifest of this command, perhaps a damaged one: another tool's file of that name is JSON without a version of Touchpath. */
export async function hasList(folder: string): Promise<boolean> {
  const text = await readFile(join(folder, MANIFEST), "utf8").catch(() => null);
  if (text === null) return false;
  try {
    return Object.hasOwn(JSON.parse(text), "touchpath");
  } catch {
    return true;
  }
}

/** Reads the manifest of a folder. */
async function listOf(folder: string): Promise<Listed[]> {
  const path = join(folder, MANIFEST);
  let list: unknown;
  try {
    list = JSON.parse(await readFile(path, "utf8"));
  } catch (thrown) {
    throw new Refused(`${path} cannot be read: ${(thrown as Error).message}`);
  }
  const { files } = (list ?? {}) as Partial<Manifest>;
  if (!Array.isArray(files) || !files.every(isListed))
    throw new Refused(`${path} is not a list of programs`);
  const names = files.map(({ file }) => file.normalize("NFC").toLowerCase());
  if (new Set(names).size < names.length)
    throw new Refused(`${path} names a file twice`);
  return files;
}

/** Whether a value is a manifest entry for a file inside its folder. */
function isListed(one: unknown): one is Listed {
  const { file, sha256, control, job } = (one ?? {}) as Partial<Listed>;
  const isText = (value: unknown) => typeof value === "string";
  const isInside =
    isText(file) &&
    !isAbsolute(String(file)) &&
    !String(file).split(/[/\\]/).includes("..");
  const isLine = job?.line === null || Number.isSafeInteger(job?.line);
  const isJob =
    (job?.file === null || isText(job?.file)) && isText(job?.sha256) && isLine;
  return (
    isInside && isText(sha256) && (control === null || isText(control)) && isJob
  );
}

/** Bytes of a plain file up to the maximum length of a program; null without one. */
async function bytesOf(path: string): Promise<Buffer | null> {
  const there = await stat(path).catch(() => null);
  return there?.isFile() && there.size <= 4 * catalog().longestProgram
    ? readFile(path).catch(() => null)
    : null;
}

/** Compares a folder with its manifest: every file, its job, and files that are not listed. */
export async function* heldAgainst(
  folder: string,
  task: Task,
): AsyncGenerator<Outcome> {
  const list = await listOf(folder);
  const outcome = (
    source: string,
    state: Verified["state"],
    said: string,
  ): Outcome => {
    const verified: Verified = { state, said, lines: [], findings: [] };
    const text =
      task.format === "json"
        ? `${JSON.stringify({ source, ...verified })}\n`
        : verifiedText(source, verified);
    return {
      source,
      place: "",
      output: { name: source, ending: "-verified.txt", text },
      control: null,
      findings: [],
      failed: true,
    };
  };
  const textOf = (path: string) => bytesOf(resolve(folder, path));
  for (const { file, sha256, job } of list) {
    const source = join(folder, file);
    const bytes = await textOf(file);
    if (!bytes)
      yield outcome(source, "missing", "is on the list and not there");
    else if (hashOf(bytes) !== sha256)
      yield outcome(source, "changed", "has changed since it was listed");
    else {
      // The path as a caller would write it.
      const named =
        job.file === null
          ? ""
          : relative(process.cwd(), resolve(folder, job.file));
      const of =
        job.file === null
          ? undefined
          : await jobOf(await textOf(job.file), job.line);
      if (of === null)
        yield outcome(source, "job-missing", `its job ${named} is not there`);
      else if (of !== undefined && hashOf(of) !== job.sha256)
        yield outcome(
          source,
          "job-changed",
          `its job ${named} was changed since: the program is that of the job before`,
        );
      else
        yield perform(task, {
          source,
          place: "",
          text: bytes.toString("utf8"),
        });
    }
  }
  const known = new Set(list.map(({ file }) => file));
  for (const file of (
    await glob("**/*", { cwd: folder, dot: true, onlyFiles: true })
  ).sort(byName))
    if (!known.has(posix(file)) && file !== MANIFEST)
      yield outcome(join(folder, file), "unlisted", "is not on the list");
}

/** Text of a job in its file; null if it is missing. */
async function jobOf(
  bytes: Buffer | null,
  line: number | null,
): Promise<string | null> {
  if (!bytes) return null;
  const text = bytes.toString("utf8");
  return line === null ? text : (text.split("\n")[line - 1] ?? null);
}
