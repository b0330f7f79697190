// The files of a run. They are written aside and put into their places at the end, each whole: a run that is refused, interrupted, or out of space
// leaves every file as it was.
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

/** Wrong use, or what the system refuses: exit code 2. */
export class Refused extends Error {}

/** How the names of what is written aside begin. */
const ASIDE = ".touchpath-";
/** What a run that was killed has left aside is removed after so many milliseconds. */
const STALE = 86_400_000;
/** So many files are brought to the disk at once. */
const AT_ONCE = 16;
/** Where the lines for the end lie aside, and so many characters of them do not. */
const LINES = "lines";
const MOST_LINES = 1_000_000;
/** So many mistakes are named. */
const MOST_NAMED = 5;

/** Which file a path leads to, whatever it is called; null if the file does not exist. */
export async function fileAt(path: string): Promise<string | null> {
  const there = await stat(path, { bigint: true }).catch(() => null);
  return there && `${there.dev}:${there.ino}`;
}

/** A file that has no place yet. */
interface Waiting {
  source: string;
  /** Below the folder. */
  file: string;
}

export class Folder {
  private readonly waiting: Waiting[] = [];
  /** The files by their names without regard to case, as some systems see them. */
  private readonly taken = new Map<string, Waiting>();
  private readonly clashes: string[] = [];
  /** Where files are written first: inside the folder, so that they need not be copied. */
  private aside = "";
  /** What is said of the jobs at the end, as much of it as is not written aside. */
  private lines = "";
  /** The topmost folder that was made. */
  private made: string | undefined;

  constructor(
    private readonly folder: string,
    /** The files that the jobs come from. */
    private readonly inputs: Set<string>,
    /** Whether all files go into the folder itself, or below it into folders as those of the jobs. */
    private readonly flat: boolean,
  ) {}

  /** Makes the folder, where that is not done: after the first job was read, so that a mistake in the arguments leaves none behind. */
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

  /** Writes a file aside; gives its name and the SHA-256 of its bytes. */
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

  /** The lines that were kept, in pieces. */
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

  /** Removes what lies aside, at once: for the end of the process. A folder that was made for nothing goes, too. */
  leave(): void {
    if (this.aside) rmSync(this.aside, { recursive: true, force: true });
    if (this.made === undefined) return;
    try {
      // Only what is empty goes.
      for (let folder = this.folder; ; folder = dirname(folder)) {
        rmdirSync(folder);
        if (folder === this.made || folder === dirname(folder)) break;
      }
    } catch {}
  }

  /** Whether one of the files is where this one needs a folder. */
  private leadsThrough(file: string): boolean {
    const folder = dirname(file);
    if (folder === "." || folder === file) return false;
    return (
      this.taken.has(folder.normalize("NFC").toLowerCase()) ||
      this.leadsThrough(folder)
    );
  }

  /** Brings a file to the disk, so that even after a power failure it is whole in its place. */
  private async sync(index: number): Promise<void> {
    const handle = await open(join(this.aside, String(index)), "r+");
    await handle.datasync().finally(() => handle.close());
  }

  /** Puts a file into its place, with the rights of the one that was there. A link stays, and what it leads to is replaced. */
  private async place(from: string, to: string): Promise<void> {
    const target = await realpath(to).catch(() => to);
    const before = await stat(target).catch(() => null);
    if (before) await chmod(from, before.mode & 0o7777);
    try {
      await rename(from, target);
    } catch (thrown) {
      if ((thrown as NodeJS.ErrnoException).code !== "EXDEV") throw thrown;
      // On another disk it is copied beside its place first.
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

  /** Does what the system may refuse. `before`: how many files are in their places. */
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
