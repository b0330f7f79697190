// The languages: each has words for every text and no others; braces, numbers and codes are the same.
import assert from "node:assert/strict";
import { readdirSync, readFileSync } from "node:fs";
import { test } from "node:test";
import { fileURLToPath } from "node:url";
import { languages, simplified, texts, wordsOf } from "../../scripts/words.mjs";

const at = (/** @type {string} */ path) =>
  fileURLToPath(new URL(`../../${path}`, import.meta.url));
const found = (/** @type {RegExp} */ what, /** @type {string} */ text) =>
  [...new Set(text.match(what) ?? [])].sort();
const NAMES = /\{[A-Za-z0-9_]+\}/g;
/** Codes that are typed or read on a control. */
const CODES =
  /\b(?:Q[1-9]\d+|G\d+(?:\.\d)?|R\d+|CYCLE\d+|SD\d+|CmdPrm[.\w]*|MEAS|LENTOAX)\b|\$\w+|#\d+/g;

test("simplified Chinese is that of the traditional words, as `node scripts/words.mjs` makes it", () => {
  assert.deepEqual(wordsOf("zh-Hans"), simplified());
  assert.ok(languages().includes("zh-Hans"));
});

for (const language of languages()) {
  test(`${language} has words for every text, and for no other`, () => {
    const [all, words] = [texts(), wordsOf(language)];
    assert.ok(all.size > 1000, `${all.size} texts are found`);
    assert.deepEqual(
      [...all].filter((text) => !Object.hasOwn(words, text)),
      [],
      "missing",
    );
    assert.deepEqual(
      Object.keys(words).filter((text) => !all.has(text)),
      [],
      "unused",
    );
  });

  test(`${language} keeps names in braces, codes, and what surrounds a text`, () => {
    let translated = 0;
    for (const [text, words] of Object.entries(wordsOf(language))) {
      assert.ok(words.trim() !== "", text);
      assert.deepEqual(found(NAMES, words), found(NAMES, text), text);
      assert.deepEqual(found(CODES, words), found(CODES, text), text);
      // A text that is appended to another one starts the same.
      assert.equal(/^ /.test(words), /^ /.test(text), text);
      assert.doesNotMatch(words, /[<>\n]/, text);
      if (words !== text) translated++;
    }
    assert.ok(translated > 1000, `${translated} texts have words of their own`);
  });
}

test("no part of the page says an English text of its own", () => {
  // Text that Lit puts between tags or into visible attributes.
  const shown =
    />\s*([A-Z][a-z]+(?: [a-z]+)*)\s*<\/|(?:aria-label|title|placeholder|alt)="([A-Za-z][^"$]+)"/g;
  const names = new Set(["Touchpath"]);
  let parts = 0;
  for (const name of readdirSync(at("www/parts")).filter((name) =>
    name.endsWith(".ts"),
  )) {
    parts++;
    const source = readFileSync(at(`www/parts/${name}`), "utf8");
    const own = [...source.matchAll(shown)].map(
      ([, text, attribute]) => text ?? attribute ?? "",
    );
    assert.deepEqual(
      own.filter((text) => !names.has(text)),
      [],
      name,
    );
  }
  assert.ok(parts > 15);
  // Text in style sheets has no translation.
  const styles = readdirSync(at("www/styles")).map((name) => `styles/${name}`);
  assert.ok(styles.length > 8);
  for (const name of [...styles, "page.css"]) {
    const source = readFileSync(at(`www/${name}`), "utf8");
    assert.deepEqual(
      source.match(/\bcontent:[^;"]*"[^";]*[A-Za-z][^";]*"/g),
      null,
      name,
    );
  }
});

test("the words of a language are a module of the package", async () => {
  const { default: words } = await import(
    "../../dist/touchpath-element/words/de.js"
  );
  assert.deepEqual(words, wordsOf("de"));
});

test("what is said is the message, and the message in another language", async () => {
  const { check, defaultJob, evaluate, lentoaxWords, meanings, plan, say } =
    await import("touchpath");
  const words = wordsOf("de");
  const all = new Set(Object.keys(words));
  /** @type {Set<string>} */
  const english = new Set();
  // A word without letters, or of one code, needs none.
  const needs = (/** @type {string} */ text) =>
    text
      .replaceAll(NAMES, "")
      .split(/[^a-zA-Z]+/)
      .some((word) => /[a-z]/.test(word) && word.length > 1);
  const walk = (
    /** @type {import("touchpath").Message} */ [template, ...values],
  ) => {
    if (needs(template) && !all.has(template)) english.add(template);
    for (const value of values) if (Array.isArray(value)) walk(value);
  };
  let count = 0;
  const said = (
    /** @type {string} */ message,
    /** @type {import("touchpath").Message} */ what,
  ) => {
    assert.equal(say(what), message);
    walk(what);
    count++;
  };
  const { catalog } = await import("touchpath");
  for (const { type } of catalog().cycles) {
    const job = defaultJob(type);
    for (const { id } of catalog().posts)
      for (const change of [
        {},
        { units: "inch" },
        { part: { offset: [0.5, 0.2, 0], rotation: 3 } },
        { control: { ...job.control, post: id } },
        { control: { ...job.control, post: id, workOffset: 1, form: "moves" } },
        {
          feeds: { work: 9000 },
          stylus: { diameter: 99, start: "x" },
          part: [],
          plane: "G20",
          overtravel: -1,
          more: 1,
        },
        {
          cycle: {
            ...job.cycle,
            touches: [{ point: [1], vector: [0, 0, 3] }],
            custom: 7,
            depth: Number.NaN,
          },
        },
      ]) {
        const changed = /** @type {any} */ ({ ...job, ...change });
        for (const finding of check(changed))
          said(finding.message, finding.said);
        if (check(changed).some((f) => f.level === "error")) continue;
        const made = plan(changed);
        for (const row of made.safety) said(row.message, row.said);
        const means = meanings(changed);
        assert.equal(means.length, made.table.length);
        made.table.forEach((row, i) => {
          said(
            row.meaning,
            /** @type {import("touchpath").Message} */ (means[i]),
          );
        });
        for (const row of [
          ...made.results,
          ...evaluate(
            changed,
            made.triggers.map((t) => t ?? [0, 0, 0]),
          ),
        ]) {
          said(row.meaning, row.said.meaning);
          if (row.said.note)
            said(/** @type {string} */ (row.note), row.said.note);
          if (row.said.verdict)
            said(/** @type {string} */ (row.verdict), row.said.verdict);
        }
      }
  }
  const answer = lentoaxWords({ toolType: 500 });
  said(answer.sentence, answer.said);
  assert.ok(count > 10_000, `${count} texts were compared`);
  // The page itself joins the help of a field, in lower case, to its label.
  assert.deepEqual([...english], []);
  const [finding] = check({ ...defaultJob("hole"), overtravel: 5000.5 });
  assert.equal(finding?.message, "Overtravel must be from 0.01 to 1000 mm");
  assert.equal(
    say(/** @type {any} */ (finding?.said), words),
    say(
      [
        "{label} must be {allowed}",
        ["Overtravel"],
        ["from {min} to {max}{unit}", "0.01", "1000", " mm"],
      ],
      words,
    ),
  );
  assert.match(say(/** @type {any} */ (finding?.said), words), /0,01/);
});
