import {
  type AnyJob,
  awaited,
  type Finding,
  JobError,
  type ProgramMoves,
  readProgram,
} from "../core/browser.js";
import { textOfBytes } from "../core/bytes.js";
import { type Reading, read } from "../read-text.js";
import { fromFragment, isFragment } from "../share.js";
import type { Store } from "../store.js";
import type { Into } from "./insert-panel.js";

/** The page's part in opening texts. */
interface Page {
  /** Shows a message to the user; an empty text removes it. */
  tell(text: string): void;
  /** Shows the job again, whatever is shown now. */
  showJob(): void;
  /** Shows parameters and codes: the text came from a CAM system. */
  forCam(): void;
  /** Whether the results are among the panels. */
  showsResults(): boolean;
  /** Shows the results and the measured points. */
  showResults(): void;
  /** Shows the moves of a program without a job. */
  showMoves(viewed: Viewed): void;
  /** Loads the part of the module that reads texts, with a message if it takes a while. */
  whole(): Promise<void>;
  /** Reads a text in a worker until the signal aborts it. Null without a worker. */
  beside(text: string, signal: AbortSignal): Promise<Reading> | null;
}

/** The part of the module that reads texts could not be loaded. */
class NotLoaded extends Error {}

/** Texts from this many characters on are read in a worker; shorter ones are read faster than a worker starts. */
const LONG = 100_000;

/** A shorter text is no program and no dump: it was meant for a field. */
const SHORTEST = 8;

/** A parameter table of a CAM system, as text. */
const DUMP = /CmdPrm|\.Flt\[|\.Int\[/i;

/** A program that is viewed without a job. */
export interface Viewed {
  text: string;
  moves: ProgramMoves;
  /** Reasons why it yields no job. */
  why: Finding[];
  /** Its file name; null for a pasted text. */
  name: string | null;
  /** If the program of the job was inserted. */
  into?: Into;
}

/** Opens texts from outside: chosen and dropped files, pasted text, links. A text that cannot be used changes nothing and is reported. */
export class Intake {
  /** Aborts the reading of a text when another text arrives. */
  private last = new AbortController();

  constructor(
    private readonly store: Store,
    private readonly page: Page,
  ) {}

  /** Types of files that may contain a job. */
  get readable(): string {
    const programs = this.store.catalog.posts.flatMap(({ extension }) => [
      `.${extension}`,
      `.${extension.toUpperCase()}`,
    ]);
    return [
      ...new Set([
        ".json",
        ".txt",
        ".csv",
        ".log",
        ".i",
        ...programs,
        "application/json",
        "text/plain",
      ]),
    ].join(",");
  }

  /** A file that is too large for any program is not read. */
  async file(file: File): Promise<void> {
    const { signal, document } = this.begin();
    if (file.size > this.store.longestProgram)
      this.page.tell(this.store.say(this.store.tooLong(file.size, "file")));
    else {
      // A folder can be dropped, too.
      const text = await file.text().catch(() => null);
      if (signal.aborted) return;
      if (text === null)
        this.page.tell(this.store.t("This file cannot be read"));
      else await this.text(text, document, file.name);
    }
  }

  /** Opens the files that a user chose. */
  readonly chosen = async (event: Event): Promise<void> => {
    const input = event.target as HTMLInputElement;
    const file = input.files?.[0];
    if (file) await this.file(file);
    input.value = "";
  };

  /** Inserts the program of the job into the file that a user chose. */
  readonly insert = async (event: Event): Promise<void> => {
    const input = event.target as HTMLInputElement;
    const file = input.files?.[0];
    input.value = "";
    if (!file) return;
    const { signal } = this.begin();
    if (file.size > this.store.longestProgram) {
      this.page.tell(this.store.say(this.store.tooLong(file.size, "file")));
      return;
    }
    const bytes = await file.arrayBuffer().catch(() => null);
    if (signal.aborted || this.store.withheld !== null) return;
    if (bytes === null) {
      this.page.tell(this.store.t("This file cannot be read"));
      return;
    }
    const parts = Promise.all([import("./viewer.js"), this.page.whole()]);
    const [viewer] = (await parts.catch(() => null)) ?? [];
    if (signal.aborted) return;
    const read = textOfBytes(new Uint8Array(bytes));
    if (viewer) this.put(viewer.into(this.store, read, file.name));
    else
      this.page.tell(
        this.store.t(
          "This part of the page could not be loaded. Check the network connection",
        ),
      );
  };

  /** Shows a program with the program of the job in it. */
  put(into: Into): void {
    const text = into.made?.text ?? into.other;
    this.page.showMoves({
      text,
      moves: readProgram(text),
      why: [],
      name: into.name,
      into,
    });
    this.page.tell("");
  }

  /** Accepts files dropped anywhere: a job, a dump, a program. */
  readonly welcome = (event: DragEvent): void => {
    if (event.dataTransfer?.types.includes("Files")) event.preventDefault();
  };

  /** Keeps texts of many megabytes out of fields, where they would block the browser. */
  readonly refuse = (event: ClipboardEvent | DragEvent): void => {
    const data =
      event instanceof DragEvent ? event.dataTransfer : event.clipboardData;
    const field = event.composedPath()[0];
    if (event instanceof DragEvent && data?.files[0]) {
      event.preventDefault();
      this.file(data.files[0]);
      return;
    }
    const there = field instanceof HTMLTextAreaElement ? field.value.length : 0;
    const length = there + (data?.getData("text/plain").length ?? 0);
    if (length <= this.store.longest) return;
    event.preventDefault();
    this.page.tell(this.store.say(this.store.tooLong(length, "paste")));
  };

  /** Opens a text that was pasted outside of fields: a file, or more than a word. */
  readonly paste = async (event: ClipboardEvent): Promise<void> => {
    const file = event.clipboardData?.files[0];
    const text = event.clipboardData?.getData("text/plain") ?? "";
    if (!file && text.trim().length < SHORTEST) return;
    event.preventDefault();
    if (file) await this.file(file);
    else if (text.length > this.store.longest)
      this.page.tell(this.store.say(this.store.tooLong(text.length, "paste")));
    else await this.text(text);
  };

  /** Loads the job of a link and removes it from the address, so that a reload keeps later changes. */
  readonly link = async (): Promise<void> => {
    const { hash } = location;
    if (!isFragment(hash)) return;
    await awaited();
    history.replaceState(
      history.state,
      "",
      location.pathname + location.search,
    );
    const { signal } = this.begin();
    const state = await fromFragment(hash, this.store.longest);
    if (signal.aborted) return;
    try {
      if (!state) {
        this.page.tell(
          this.store.t(
            "Nothing was changed: this link holds no job that can be read here",
          ),
        );
        return;
      }
      this.store.take(state.job, state.measured);
      this.page.showJob();
      this.page.tell(
        this.store.t(
          "This is the job of the link that was opened. Undo brings back the one before.",
        ),
      );
    } catch (thrown) {
      this.page.tell(
        thrown instanceof JobError
          ? this.store.why(thrown)
          : this.store.t("This link cannot be read"),
      );
    }
  };

  /** Reads a text. `document` was the job's document at the start. Returns false if nothing can be made of it. */
  async text(
    text: string,
    document = this.store.document,
    name: string | null = null,
  ): Promise<boolean> {
    const { signal } = this.begin();
    try {
      await awaited();
      const reading = await this.read(text, signal);
      if (signal.aborted) return false;
      if (document === this.store.document)
        return this.take(text, reading, name);
      this.page.tell(
        this.store.t(
          "Nothing was changed: the job was replaced while this text was read",
        ),
      );
      return false;
    } catch (thrown) {
      const why =
        thrown instanceof NotLoaded
          ? this.store.t(
              "This part of the page could not be loaded. Check the network connection",
            )
          : this.store.t("This text cannot be read");
      if (!signal.aborted) this.page.tell(why);
      return false;
    }
  }

  /** Loads the job of a call in an opened program, or of all its calls. */
  adopt(job: AnyJob): void {
    try {
      this.store.open({
        imported: { kind: "job", job, findings: [] },
        findings: [],
        moves: null,
        points: 0,
      });
      this.page.showJob();
      this.page.tell(
        "cycles" in job
          ? this.store.t(
              "Job created from {count} calls; fields they do not specify have their defaults. It writes no work offset until you choose one. Undo restores the previous job.",
              job.cycles.length,
            )
          : this.store.t(
              "Job created from this call; fields it does not specify have their defaults. Undo restores the previous job.",
            ),
      );
    } catch (thrown) {
      if (!(thrown instanceof JobError)) throw thrown;
      this.page.tell(this.store.why(thrown));
    }
  }

  /** Opens a pasted text. */
  readonly pasted = (text: string): Promise<boolean> => this.text(text);

  /** Aborts the reading. */
  stop(): void {
    this.last.abort();
  }

  /** Starts reading another text. */
  private begin(): { signal: AbortSignal; document: number } {
    this.last.abort();
    this.last = new AbortController();
    return { signal: this.last.signal, document: this.store.document };
  }

  /** Reads a text, a long one in a worker if possible. */
  private async read(text: string, signal: AbortSignal): Promise<Reading> {
    const reading = text.length < LONG ? null : this.page.beside(text, signal);
    if (!reading) return this.here(text);
    this.page.tell(this.store.t("This text is being read …"));
    return reading.catch((thrown) => {
      if (signal.aborted) throw thrown;
      return this.here(text);
    });
  }

  /** Reads a text in the page itself. */
  private async here(text: string): Promise<Reading> {
    try {
      await this.page.whole();
    } catch {
      throw new NotLoaded();
    }
    return read(text);
  }

  /** Loads the measured points of a log if the page shows results. */
  private takePoints(text: string, count: number): boolean {
    if (!this.page.showsResults()) {
      this.page.tell(this.store.t("This text cannot be read"));
      return false;
    }
    this.store.openPoints(text.trim());
    this.page.showResults();
    this.page.tell(
      this.store.t(
        "{count} measured points were taken from this log: Results compares them with this job",
        count,
      ),
    );
    return true;
  }

  /** Shows the job of a text, or else its moves; returns false if it has neither. */
  private take(text: string, reading: Reading, name: string | null): boolean {
    try {
      if (reading.points > 0) return this.takePoints(text, reading.points);
      this.store.open(reading);
    } catch (thrown) {
      if (!(thrown instanceof JobError)) throw thrown;
      const why = this.store.why(thrown);
      // The current job stays.
      const { moves } = reading;
      if (!moves) {
        this.page.tell(why);
        return false;
      }
      this.page.showMoves({
        text,
        moves,
        name,
        why: thrown.findings.filter((f) => f.level === "error"),
      });
      this.page.tell(
        moves.kind.length > 0
          ? ""
          : this.store.t(
              "This program is shown as text without a job. {why}",
              why,
            ),
      );
      return true;
    }
    // The footer shows the job's own findings.
    const ofJob = new Set(this.store.findings.map((f) => f.message));
    const news = reading.findings.filter(
      (f) => f.level !== "error" && !ofJob.has(f.message),
    );
    const notes = news.map((f) => this.store.say(f.said));
    if (DUMP.test(text) || news.some(({ code }) => code === "not-in-dump"))
      this.page.forCam();
    this.page.showJob();
    this.page.tell(
      notes.length > 1
        ? notes.map((note) => `• ${note}`).join("\n")
        : (notes[0] ?? ""),
    );
    return true;
  }
}
