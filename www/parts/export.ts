import { type Job, type Message, svg } from "../core/browser.js";
import { bytesOfText } from "../core/bytes.js";
import { toFragment } from "../share.js";
import type { Store } from "../store.js";
import { w } from "../words.js";
import { copy, download } from "./download.js";
import type { Into } from "./insert-panel.js";
import type { PicturePart } from "./picture.js";

/** A program to save. */
export interface Saving {
  name: string;
  text: string;
  post: string;
  extension: string;
}

/** The page's part in saving. */
interface Page {
  /** Shows a message about the current state of the job. */
  tell(said: Message): void;
  /** Shows a link to copy by hand. */
  show(link: string): void;
  /** Reports a saved program, and whether another one was saved under this name before. */
  saved(name: string, other: boolean): void;
  /** Offers a program to the host page; returns false if the host page saves it. */
  offer(saving: Saving): boolean;
  /** The visible picture. */
  picture(): PicturePart | null;
  /** Its view. */
  view(): PicturePart["from"];
}

/** Saves and copies: the program, the job, its picture, a link. */
export class Export {
  constructor(
    private readonly store: Store,
    private readonly page: Page,
  ) {}

  /** Saves the program of the current form. Returns false if the form has errors. */
  program(): boolean {
    const { store } = this;
    if (store.stale) return false;
    const { text, post, extension } = store.plan.program;
    const name = store.fileName(extension);
    store.saved = text;
    const other = store.replaces(name);
    store.remember(name);
    if (!this.page.offer({ name, text, post, extension })) return true;
    download(text, name, "text/plain");
    this.page.saved(name, other);
    return true;
  }

  /** Saves another program with that of the job in it. */
  whole({ name, made, isUtf8 }: Into): void {
    if (!made) return;
    const { post } = this.store.plan.program;
    const { text } = made;
    const extension = name.split(".").at(-1) ?? "";
    if (!this.page.offer({ name, text, post, extension })) return;
    download(bytesOfText({ text, isUtf8 }), name, "text/plain");
    this.page.saved(name, false);
  }

  /** Saves the current form, even with errors: it is the user's work. */
  job(): void {
    download(
      `${JSON.stringify(this.store.job, null, 2)}\n`,
      this.store.otherName(".json"),
      "application/json",
    );
  }

  /** Saves the picture of the current form in its current view. */
  picture(): void {
    const { store } = this;
    if (store.withheld !== null) {
      this.page.tell([
        w("No picture to save while the form has an error: {why}"),
        store.withheld,
      ]);
      return;
    }
    download(
      this.svg(),
      store.otherName(`-${this.page.view()}.svg`),
      "image/svg+xml",
    );
  }

  /** The picture in its current view, for the last form with a plan. */
  svg(): string {
    const { store } = this;
    const picture = this.page.picture();
    const job = store.shown as unknown as Job;
    return (
      picture?.svg(`${job.name}: ${store.cycle.title}`) ??
      svg(job, this.page.view())
    );
  }

  /** Copies a link to the job; shows it if the browser does not allow copying. */
  async link(): Promise<void> {
    const fragment = await toFragment({
      job: this.store.job,
      measured: this.store.measured,
    });
    if (fragment === null) {
      this.page.tell([
        w("This job is too long for a link: save it as a file instead"),
      ]);
      return;
    }
    const link = new URL(fragment, location.href).href;
    if (await copy(link))
      this.page.tell([
        w(
          "Link copied. The link itself contains the job: no server stores it.",
        ),
      ]);
    else this.page.show(link);
  }
}
