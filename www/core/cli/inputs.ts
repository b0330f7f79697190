// Inputs of the command: the files of its arguments, the jobs in them, and the config.

import { createReadStream } from "node:fs";
import { stat } from "node:fs/promises";
import { dirname, extname, join, relative, resolve, sep } from "node:path";
import { glob, isDynamicPattern } from "tinyglobby";
import { type FileText, textOfBytes } from "../bytes.js";
import { type Config, catalog, checkConfig } from "../node.js";
import { Refused } from "./folder.js";
import { CONFIG_FILE } from "./help.js";
import { linesOf } from "./lines.js";
import type { Values } from "./options.js";
import type { Progress } from "./progress.js";
import type { Item } from "./tasks.js";

/** Files of the arguments, each once, in order. A pattern without a match is an error. */
export async function filesOf(
  names: string[],
  folders = false,
): Promise<string[]> {
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

/** Folders that the output of a file keeps: those below the current folder; for a file elsewhere, its path without `..`. */
function placeOf(file: string): string {
  if (file === "-") return "";
  const folders = relative(process.cwd(), dirname(resolve(file))).split(sep);
  const isDrive = (folder: string) =>
    process.platform === "win32" && folder.endsWith(":");
  return folders
    .filter((folder) => folder !== ".." && !isDrive(folder))
    .join(sep);
}

export const isLines = (file: string, values: Values) =>
  values.ndjson === true || [".ndjson", ".jsonl"].includes(extname(file));
const streamOf = (file: string) =>
  file === "-" ? process.stdin : createReadStream(file);

/** Every job of the files, one after the other, read only on demand. */
export async function* itemsOf(
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

/** The bytes of a file; null for one that cannot have at most `longest` characters. */
async function bytesOf(
  file: string,
  longest: number,
  progress?: Progress,
): Promise<Buffer | null> {
  const chunks: Buffer[] = [];
  let size = 0;
  for await (const chunk of progress?.through(streamOf(file)) ??
    streamOf(file)) {
    const bytes = Buffer.from(chunk);
    size += bytes.length;
    // A character has at most four bytes.
    if (size > 4 * longest) return null;
    chunks.push(bytes);
  }
  return Buffer.concat(chunks);
}

/** The text of a file. Reading stops at the maximum length of a job. */
async function whole(
  file: string,
  longest: number,
  refused: string,
  progress?: Progress,
): Promise<Omit<Item, "source" | "place">> {
  const text = (await bytesOf(file, longest, progress))?.toString("utf8");
  return text === undefined || text.length > longest
    ? { text: "", refused }
    : { text };
}

/** The text of a program that is written again with the same bytes. */
export async function programOf(file: string): Promise<FileText> {
  const { longestProgram } = catalog();
  try {
    const bytes = await bytesOf(file, longestProgram);
    if (bytes === null)
      throw new Error(`At most ${longestProgram} characters are read`);
    return textOfBytes(bytes);
  } catch (thrown) {
    throw new Refused(`${file} cannot be read: ${(thrown as Error).message}`);
  }
}

/** Text of the measurements. */
export async function textOf(file: string): Promise<string> {
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

/** The config of a run: of the given file, or else the nearest one. */
export async function configFor(values: Values): Promise<Config | undefined> {
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

/** Reads a config file. */
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
