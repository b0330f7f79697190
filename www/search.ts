// Finds cycles by the words that setters use.
import type { CycleEntry } from "./core/browser.js";
import { w } from "./words.js";

/** Search words of every cycle that measures. */
const MEASURES = w("work offset zero point datum preset centre G54 G55 X Y");
/** Search words of the tool length calculator. */
export const LENGTHS = w(
  "tool length offset frame swivel nutating head axis SINUMERIK LENTOAX",
);

/** Search words in other languages for the English page, by a word in the cycle's name. */
const ELSEWHERE: [RegExp, string][] = [
  [/hole|circles/, "bohrung kreis отверстие окружность 孔 圆"],
  [/boss|circles/, "zapfen welle бобышка вал 凸台 轴"],
  [/internal-rectangle/, "tasche карман 凹槽"],
  [/groove/, "nut паз 槽"],
  [/external-rectangle|web/, "steg block rippe ребро блок 凸筋 厚度 thickness"],
  [/corner/, "ecke угол 角"],
  [/surface|wall/, "fläche wand поверхность стенка 平面 flatness"],
];
const elsewhere = (type: string) =>
  ELSEWHERE.flatMap(([name, words]) => (name.test(type) ? [words] : []));

/** Words without meaning for the search. */
const EMPTY = new Set([
  "a",
  "an",
  "the",
  "with",
  "of",
  "in",
  "on",
  "and",
  "or",
  "to",
  "for",
  "from",
  "my",
  "find",
  "measure",
  "probe",
]);

/** Search words of a query. Words without meaning count only in a query without other words. */
export function wordsIn(query: string): string[] {
  const all = query
    .toLowerCase()
    .split(/[\s,;]+/)
    .filter(Boolean);
  const full = all.filter((word) => !EMPTY.has(word));
  return full.length > 0 ? full : all;
}

/** Whether a text has a word. A short word or a number must match as a whole, a longer word may be a part, also in the singular. */
export function hasWord(text: string, word: string): boolean {
  // Chinese words are short and have no spaces between them.
  if (/^([\x21-\x7e]{1,2}|\d+)$/.test(word))
    return ` ${text} `.split(/[^\p{L}\p{N}]+/u).includes(word);
  return (
    text.includes(word) ||
    (word.length > 3 && word.endsWith("s") && text.includes(word.slice(0, -1)))
  );
}

/** Searchable text of a cycle, in English and in the language of the page. */
export function textOf(
  cycle: CycleEntry,
  english: CycleEntry,
  t: (text: string) => string,
): string {
  const common = cycle.steps.length > 0 ? [MEASURES, t(MEASURES)] : [];
  const own = [cycle, english].flatMap(({ title, says, also, source }) => [
    title,
    says,
    also,
    source,
  ]);
  return [
    ...own,
    cycle.type.replaceAll("-", " "),
    ...common,
    ...elsewhere(cycle.type),
  ]
    .join(" ")
    .toLowerCase();
}

/** Entries whose texts have every word. If no text has all, the entries with most of the words, the best first. */
export function found<T>(
  things: readonly T[],
  query: string,
  text: (thing: T) => string,
): { all: boolean; things: T[] } {
  const words = wordsIn(query);
  const counted = things.map((thing) => {
    const of = text(thing);
    return { thing, count: words.filter((word) => hasWord(of, word)).length };
  });
  const whole = counted.filter(({ count }) => count === words.length);
  if (whole.length > 0)
    return { all: true, things: whole.map(({ thing }) => thing) };
  const some = counted
    .filter(({ count }) => count > 0)
    .sort((a, b) => b.count - a.count);
  return { all: false, things: some.map(({ thing }) => thing) };
}
