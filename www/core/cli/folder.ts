// The output files of a run. They are written to a temporary folder and moved into place at the end. A run that is refused, interrupted or out of space leaves
// every file as it was.
import { createHash } from "node:crypto";
import { createReadStream, existsSync, rmdirSync, rmSync } from "node:fs";
import {
  appendFile,
  chmod,
  copyFile,
  mkdir,
  mkdtemp,
  open,
  readdir,
  realpath,
  rename,
  rm,
  stat,
} from "node:fs/promises";
import { dirname, join } from "node:path";
import { programStem } from "../names.js";
import type { Outcome } from "./tasks.js";

/** Wrong use, or an error of the operating system: exit code 2. */
export class Refused extends Error {}

/** Prefix of the names of temporary folders. */
const ASIDE = ".touchpath-";
/** Age in milliseconds after which the leftovers of a killed run are removed. */
const STALE = 86_400_000;
/** Number of files that are synced to the disk in parallel. */
const AT_ONCE = 16;
/** Temporary file with lines for the end, and the number of characters kept in memory instead. */
const LINES = "lines";
const MOST_LINES = 1_000_000;
/** Maximum number of errors listed. */
const MOST_NAMED = 5;

/** The file that a path leads to, with links resolved; null if it does not exist. */
export async function fileAt(path: string): Promise<string | null> {
  const there = await stat(path, { bigint: true }).catch(() => null);
  return there && `${there.dev}:${there.ino}`;
}

/** A file that is not in its place yet. */
interface Waiting {
  source: string;
  /** Path below the folder. */
  file: string;
}

export class Folder {
  private readonly waiting: Waiting[] = [];
  /** Files by their lower-case names, because some systems ignore case. */
  private readonly taken = new Map<string, Waiting>();
  private readonly clashes: string[] = [];
  /** Temporary folder inside the output folder, so that files are moved and not copied. */
  private aside = "";
  /** Lines for the end that are not in the temporary file yet. */
  private lines = "";
  /** Topmost folder that was created. */
  private made: string | undefined;

  constructor(
    private readonly folder: string,
    /** Input files of the jobs. */
    private readonly inputs: Set<string>,
    /** Whether all files go directly into the folder, else into subfolders like those of the jobs. */
    private readonly flat: boolean,
  ) {}

  /** Creates the folder after the first job was read, so that an error in the arguments leaves no folder. */
  async make(): Promise<void> {
    if (this.aside) return;
    try {
      this.made = await mkdir(this.folder, { recursive: true });
      for (const name of await readdir(this.folder))
        if (name.startsWith(ASIDE)) await this.removeStale(name);
      this.aside = await mkdtemp(join(this.folder, ASIDE));
    } catch (thrown) {
      throw new Refused(
        `${this.folder} cannot be made: ${(thrown as Error).message}`,
      );
    }
  }

  /** Writes a temporary file; returns its name and the SHA-256 of its bytes. */
  async put(
    source: string,
    place: string,
    { name, ending, text }: NonNullable<Outcome["output"]>,
  ): Promise<[string, string]> {
    const file = join(
      this.flat ? "" : place,
      `${programStem(name, text)}${ending}`,
    );
    const key = file.normalize("NFC").toLowerCase();
    const other = this.taken.get(key);
    if (other)
      this.clashes.push(`${other.source} and ${source} would both be ${file}`);
    else this.taken.set(key, { source, file });
    const bytes = Buffer.from(text);
    await this.refusing(file, async () => {
      const handle = await open(
        join(this.aside, String(this.waiting.length)),
        "wx",
      );
      await handle.writeFile(bytes).finally(() => handle.close());
    });
    this.waiting.push({ source, file });
    return [
      join(this.folder, file),
      createHash("sha256").update(bytes).digest("hex"),
    ];
  }

  /** Keeps a line for the end. */
  async note(line: string): Promise<void> {
    this.lines += line;
    if (this.lines.length < MOST_LINES) return;
    await this.refusing(LINES, () =>
      appendFile(join(this.aside, LINES), this.lines),
    );
    this.lines = "";
  }

  /** The kept lines, in pieces. */
  async *noted(): AsyncGenerator<string> {
    const path = join(this.aside, LINES);
    if (this.aside && existsSync(path)) yield* createReadStream(path, "utf8");
    yield this.lines;
  }

  /** Moves all files into place, or none if a target conflicts. */
  async finish(): Promise<void> {
    if (!this.aside) return;
    const refusals = [...this.clashes];
    for (const { file } of this.waiting) {
      const target = join(this.folder, file);
      const there = await stat(target).catch(() => null);
      const found = there && (await fileAt(target));
      if (there?.isDirectory() || this.leadsThrough(file))
        refusals.push(`${file} would be a file and a folder`);
      else if (found && this.inputs.has(found))
        refusals.push(`${file} would be written over the file that was read`);
    }
    if (refusals.length > 0) {
      const more = refusals.length - MOST_NAMED;
      const named = refusals.slice(0, MOST_NAMED).join("; ");
      throw new Refused(
        `${named}${more > 0 ? `; and ${more} more` : ""}: nothing was written`,
      );
    }
    for (const folder of new Set(this.waiting.map(({ file }) => dirname(file))))
      await this.refusing(folder, () =>
        mkdir(join(this.folder, folder), { recursive: true }),
      );
    for (let i = 0; i < this.waiting.length; i += AT_ONCE)
      await Promise.all(
        this.waiting
          .slice(i, i + AT_ONCE)
          .map(({ file }, n) => this.refusing(file, () => this.sync(i + n))),
      );
    for (const [i, { file }] of this.waiting.entries())
      await this.refusing(
        file,
        () => this.place(join(this.aside, String(i)), join(this.folder, file)),
        i,
      );
    this.made = undefined;
  }

  /** Removes the temporary files synchronously, for the end of the process, and a folder that was created for nothing. */
  leave(): void {
    if (this.aside) rmSync(this.aside, { recursive: true, force: true });
    if (this.made === undefined) return;
    try {
      // Removes only empty folders.
      for (let folder = this.folder; ; folder = dirname(folder)) {
        rmdirSync(folder);
        if (folder === this.made || folder === dirname(folder)) break;
      }
    } catch {}
  }

  /** Whether a file exists where this one needs a folder. */
  private leadsThrough(file: string): boolean {
    const folder = dirname(file);
    if (folder === "." || folder === file) return false;
    return (
      this.taken.has(folder.normalize("NFC").toLowerCase()) ||
      this.leadsThrough(folder)
    );
  }

  /** Syncs a file to the disk, so that it is complete even after a power failure. */
  private async sync(index: number): Promise<void> {
    const handle = await open(join(this.aside, String(index)), "r+");
    await handle.datasync().finally(() => handle.close());
  }

  /** Moves a file into place with the permissions of the file that it replaces. A link stays; its target is replaced. */
  private async place(from: string, to: string): Promise<void> {
    const target = await realpath(to).catch(() => to);
    const before = await stat(target).catch(() => null);
    if (before) await chmod(from, before.mode & 0o7777);
    try {
      await rename(from, target);
    } catch (thrown) {
      if ((thrown as NodeJS.ErrnoException).code !== "EXDEV") throw thrown;
      // On another disk the file is copied next to its target first.
      const beside = join(await mkdtemp(join(dirname(target), ASIDE)), "file");
      try {
        await copyFile(from, beside);
        await rename(beside, target);
      } finally {
        await rm(dirname(beside), { recursive: true, force: true });
      }
    }
  }

  private async removeStale(name: string): Promise<void> {
    const path = join(this.folder, name);
    const there = await stat(path).catch(() => null);
    if (there && Date.now() - there.mtimeMs > STALE)
      await rm(path, { recursive: true, force: true });
  }

  /** Runs an operation that the system may refuse. `before`: number of files already in place. */
  private async refusing(
    file: string,
    work: () => Promise<unknown>,
    before = 0,
  ): Promise<void> {
    try {
      await work();
    } catch (thrown) {
      const rest =
        before === 0
          ? "nothing was written"
          : `${before} of ${this.waiting.length} files were written`;
      throw new Refused(
        `${file} cannot be written: ${(thrown as Error).message}: ${rest}`,
      );
    }
  }
}
