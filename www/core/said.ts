// Messages in any language: templates and their values, as in src/text.rs.

/**
 * A message: its English template, then the values of the names in braces in the order of their first appearance. A value is a string that no language changes
 * (a number with its unit, a code, text of the user) or another message.
 */
export type Message = [template: string, ...values: (string | Message)[]];

/**
 * Words of a language: English templates with their translations, which have the same names in braces. Missing texts stay English. The entry `0.5` gives the
 * notation of numbers.
 */
export type Words = Readonly<Record<string, string>>;

const NAME = /\{([A-Za-z0-9_]+)\}/g;
/** A number with an optional unit. */
const NUMBER = /^([+-]?\d+)\.(\d+)( ?(?:mm|inch|°)(?:\/min)?)?$/;

const QUOTES = "\"“”„«»「」‘’'";

/** A number in the notation of the language; other text stays as it is. */
const written = (text: string, words: Words) =>
  words["0.5"] === "0,5" ? text.replace(NUMBER, "$1,$2$3") : text;

/** A piece of a template: the text before a name, the name, and whether it is quoted. The last piece has no name. */
type Piece = [before: string, name: string | null, quoted: boolean];

/** Parsed templates: a table uses the same few hundred texts. */
const taken = new Map<string, Piece[]>();
/** Maximum number of parsed templates kept. */
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
  // Properties of Object.prototype are no translations.
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
    // Quoted text comes from the user: a program line, a name.
    else if (typeof value === "string")
      out += quoted ? value : written(value, words);
    else out += say(value, words);
  }
  return out;
}
