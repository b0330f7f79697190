import { type Job, type Message, svg } from "../core/browser.js";
import { toFragment } from "../share.js";
import type { Store } from "../store.js";
import { w } from "../words.js";
import { copy, download } from "./download.js";
import type { PicturePart } from "./picture.js";

/** A program to be saved. */
export interface Saving {
  name: string;
  text: string;
  post: string;
  extension: string;
}

/** What the page does with what is handed out. */
interface Page {
  /** Says something of the job as it is now. */
  tell(said: Message): void;
  /** Shows a link, to be taken by hand. */
  show(link: string): void;
  /** Says where the program is seen that it was saved, and whether another one of this name was saved before. */
  saved(name: string, other: boolean): void;
  /** Offers a program to the host page; false where that saves it itself. */
  offer(saving: Saving): boolean;
  /** The picture that is looked at. */
  picture(): PicturePart | null;
  /** Where it is looked at from. */
  view(): PicturePart["from"];
}

/** What is handed out: the program, the job, its picture, a link to it. */
export class Export {
  constructor(
    private readonly store: Store,
    private readonly page: Page,
  ) {}

  /** Saves the program, only ever that of the present form. False if the form has errors. */
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

  /** Saves the present form, also with errors: it is the user's work. */
  job(): void {
    download(
      `${JSON.stringify(this.store.job, null, 2)}\n`,
      this.store.otherName(".json"),
      "application/json",
    );
  }

  /** Saves the picture in its present view, of the present form. */
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

  /** The picture as it is looked at, of the last form that had a plan. */
  svg(): string {
    const { store } = this;
    const picture = this.page.picture();
    const job = store.shown as unknown as Job;
    return (
      picture?.svg(`${job.name}: ${store.cycle.title}`) ??
      svg(job, this.page.view())
    );
  }

  /** Copies a link to the job; where the browser does not allow that, shows it. */
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
        w("Link copied. The job is in the link itself: no server keeps it."),
      ]);
    else this.page.show(link);
  }
}
