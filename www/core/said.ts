// What is said to a person, in any language: templates and their values, as src/text.rs has them.

/**
 * A sentence as its English template, then the values of the names in its braces, in the order in which these first appear: a string that is
 * the same in every language (a number with its unit, a code, what a user typed), or again something said.
 */
export type Message = [template: string, ...values: (string | Message)[]];

/**
 * Words of a language: for an English template the one in that language, with the same names in braces. What is missing stays English. The entry `0.5`
 * is how a number is written.
 */
export type Words = Readonly<Record<string, string>>;

const NAME = /\{([A-Za-z0-9_]+)\}/g;
/** A number, and a unit after it. */
const NUMBER = /^([+-]?\d+)\.(\d+)( ?(?:mm|inch|°)(?:\/min)?)?$/;

const QUOTES = "\"“”„«»「」‘’'";

/** A number as the words write it; any other text as it is. */
const written = (text: string, words: Words) =>
  words["0.5"] === "0,5" ? text.replace(NUMBER, "$1,$2$3") : text;

/** A text in pieces: the text before a name, the name, and whether it is quoted; the last piece has no name. */
type Piece = [before: string, name: string | null, quoted: boolean];

/** Texts in pieces, as they were taken apart: a table says the same few hundreds of times. */
const taken = new Map<string, Piece[]>();
/** So many are kept. */
const MOST = 2000;

function piecesOf(text: string): Piece[] {
  const known = taken.get(text);
  if (known) return known;
  const pieces: Piece[] = [];
  let from = 0;
  for (const match of text.matchAll(NAME)) {
    pieces.push([
      text.slice(from, match.index),
      match[1] as string,
      QUOTES.includes(text[match.index - 1] ?? " "),
    ]);
    from = match.index + match[0].length;
  }
  pieces.push([text.slice(from), null, false]);
  if (taken.size >= MOST) taken.clear();
  taken.set(text, pieces);
  return pieces;
}

/** A message as text: in English, or in another language by its words. */
export function say(said: Message, words: Words = {}): string {
  const template = said[0];
  // What hangs on the prototype of an object is no word.
  const text = Object.hasOwn(words, template)
    ? (words[template] as string)
    : template;
  if (said.length === 1) return text;
  const names: string[] = [];
  for (const [, name] of piecesOf(template))
    if (name !== null && !names.includes(name)) names.push(name);
  let out = "";
  for (const [before, name, quoted] of piecesOf(text)) {
    out += before;
    if (name === null) continue;
    const at = names.indexOf(name);
    const value = at < 0 ? undefined : said[at + 1];
    if (value === undefined) out += `{${name}}`;
    // Quoted text comes from the user: a line of a program, a name.
    else if (typeof value === "string")
      out += quoted ? value : written(value, words);
    else out += say(value, words);
  }
  return out;
}
