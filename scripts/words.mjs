// Missing and unused words of each language: `node scripts/words.mjs` prints both, and tests/package/words.test.mjs checks them. Simplified Chinese is made
// from the traditional words with every run.
import { readdirSync, readFileSync, writeFileSync } from "node:fs";
import { fileURLToPath } from "node:url";
import { Converter } from "opencc-js";

const at = (/** @type {string} */ path) =>
  fileURLToPath(new URL(`../${path}`, import.meta.url));
const json = (/** @type {string} */ path) =>
  JSON.parse(readFileSync(at(path), "utf8"));

/** A double-quoted text after `t(` or `w(`. */
const MARKED = /\b[tw]\(\s*("(?:[^"\\]|\\.)*")/g;

/** Folders of the page's sources, with the report that it saves. */
const folders = ["www", "www/parts"];
const files = ["www/core/report.ts"];

/** Every English text that may be shown: those of the crate, and those marked in the page's sources. */
export function texts() {
  const found = new Set(/** @type {string[]} */ (json("www/words/core.json")));
  const sources = folders.flatMap((folder) =>
    readdirSync(at(folder)).map((name) => `${folder}/${name}`),
  );
  for (const path of [...sources, ...files])
    if (path.endsWith(".ts"))
      for (const [, text] of readFileSync(at(path), "utf8").matchAll(MARKED))
        found.add(JSON.parse(/** @type {string} */ (text)));
  // Notation of numbers.
  found.add("0.5");
  return found;
}

/** The languages, by their files. */
export const languages = () =>
  readdirSync(at("www/words"))
    .filter((name) => name !== "core.json")
    .map((name) => name.replace(".json", ""));

/** The words of a language, by their English text. */
export const wordsOf = (/** @type {string} */ language) =>
  /** @type {Record<string, string>} */ (json(`www/words/${language}.json`));

/** Terms that differ on the mainland, replaced after characters and general words. @type {[string, string][]} */
const TERMS = [
  ["座标", "坐标"],
  ["控制器", "数控系统"],
  ["色彩", "颜色"],
  ["壁面", "侧壁"],
  ["进给速率", "进给速度"],
];

/** The words of simplified Chinese, from the traditional ones. */
export function simplified() {
  const convert = Converter({ from: "twp", to: "cn" });
  const said = (/** @type {string} */ text) =>
    TERMS.reduce((all, [from, to]) => all.replaceAll(from, to), convert(text));
  return Object.fromEntries(
    Object.entries(wordsOf("zh-Hant")).map(([english, text]) => [
      english,
      said(text),
    ]),
  );
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  const all = texts();
  writeFileSync(
    at("www/words/zh-Hans.json"),
    `${JSON.stringify(simplified(), null, 2)}\n`,
  );
  for (const language of languages()) {
    const words = wordsOf(language);
    const missing = [...all].filter((text) => !Object.hasOwn(words, text));
    const unused = Object.keys(words).filter((text) => !all.has(text));
    console.log(
      `${language}: ${missing.length} missing, ${unused.length} unused`,
    );
    for (const text of missing) console.log(`  - ${JSON.stringify(text)}`);
    for (const text of unused) console.log(`  + ${JSON.stringify(text)}`);
  }
}
