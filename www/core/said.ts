// What is said to a person, in any language: templates and their values, as src/text.rs has them.

/**
 * A sentence as its English template, then what stands in place of the names in its braces, in the order in which these first appear: a string that is
 * the same in every language (a number with its unit, a code, what a user typed), or again something said.
 */
export type Said = [template: string, ...values: (string | Said)[]];

/**
 * Words of a language: for an English template the one in that language, with the same names in braces. What is missing stays English. The entry `0.5`
 * is how a number is written.
 */
export type Words = Readonly<Record<string, string>>;

const NAME = /\{([A-Za-z0-9_]+)\}/g;
/** A number, and a unit behind it. */
const NUMBER = /^([+-]?\d+)\.(\d+)( ?(?:mm|inch|°)(?:\/min)?)?$/;

const QUOTES = "\"“”„«»「」‘’'";

/** A number as the words write it; any other text as it is. */
const written = (text: string, words: Words) => (words["0.5"] === "0,5" ? text.replace(NUMBER, "$1,$2$3") : text);

/** What is said, in English or in the words of a language. */
export function say(said: Said, words: Words = {}): string {
  const [template, ...values] = said;
  const names: string[] = [];
  for (const [, name] of template.matchAll(NAME)) if (!names.includes(name as string)) names.push(name as string);
  // What hangs on the prototype of an object is no word.
  const known = Object.hasOwn(words, template) ? (words[template] as string) : template;
  return known.replace(NAME, (all, name: string, at: number) => {
    const value = values[names.indexOf(name)];
    if (value === undefined) return all;
    if (typeof value !== "string") return say(value, words);
    // What stands in quotes is somebody's own text: a line of a program, a name.
    return QUOTES.includes(known[at - 1] ?? " ") ? value : written(value, words);
  });
}
