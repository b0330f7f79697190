// Texts of the page in its language.
import {
  type Catalog,
  catalog,
  JobError,
  type Message,
  say,
  type Words,
} from "./core/browser.js";
import type { Finding } from "./core/types.js";
import { type Lang, worded } from "./words.js";

/** A refusal by the page itself; its message is in the language of the page. */
export class Refusal extends JobError {}

export class Phrases extends EventTarget {
  private readonly english: Catalog = catalog();
  /** The catalog in the language of the page. */
  catalog: Catalog = this.english;
  /** The language and its words. */
  lang: Lang = "en";
  words: Words = {};

  /** Switches the language of all texts. */
  protected speak(lang: Lang, words: Words): void {
    this.lang = lang;
    this.words = words;
    this.catalog = lang === "en" ? this.english : worded(this.english, words);
    this.dispatchEvent(new Event("language"));
  }

  /** A message in the language of the page. */
  say(said: Message): string {
    return say(said, this.words);
  }

  /** A text of the page in its language. Values replace the names in braces. */
  t(template: string, ...values: (string | number | Message)[]): string {
    return this.say([
      template,
      ...values.map((value) =>
        typeof value === "number" ? String(value) : value,
      ),
    ]);
  }

  /** A decimal number in the notation of this language. */
  number(text: string): string {
    return this.comma ? text.replace(".", ",") : text;
  }

  /** Whether this language writes a decimal comma. */
  get comma(): boolean {
    return this.words["0.5"] === "0,5";
  }

  /** Reason of a refusal, in the language of the page. */
  why(refused: JobError): string {
    const errors = refused.findings.filter((f) => f.level === "error");
    const [first] = errors;
    if (refused instanceof Refusal || !first) return refused.message;
    return errors.length === 1
      ? this.say(first.said)
      : this.t("{message} (and {count} more)", first.said, errors.length - 1);
  }

  protected refusal(said: Message, findings: Finding[] = []): Refusal {
    return new Refusal(this.say(said), findings);
  }
}
