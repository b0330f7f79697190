// Cycles are found by the words that setters use.
import assert from "node:assert/strict";
import { test } from "node:test";
import { catalog } from "touchpath";
import { wordsOf } from "../../scripts/words.mjs";
import { Store, search, setUp } from "./state.mjs";

setUp();

/** What is found by these words in the language of a store, as the gallery asks; `lengths` is its other tool. */
function found(/** @type {any} */ store, /** @type {string} */ query) {
  const english = catalog().cycles;
  const t = (/** @type {string} */ text) => store.t(text);
  const textOf = (/** @type {any} */ cycle) =>
    cycle === null
      ? [t("Tool lengths"), search.LENGTHS, t(search.LENGTHS)]
          .join(" ")
          .toLowerCase()
      : search.textOf(
          cycle,
          english.find(({ type }) => type === cycle.type),
          t,
        );
  const { all, things } = search.found(
    [...store.catalog.cycles, null],
    query,
    textOf,
  );
  return {
    all,
    types: things.map((/** @type {any} */ cycle) => cycle?.type ?? "lengths"),
  };
}

/** What setters say, and a cycle that they mean by it. @type {[string, string][]} */
const WORDS = [
  ["pocket", "internal-rectangle"],
  ["bore", "hole"],
  ["slot", "groove"],
  ["stud", "boss"],
  ["outside corner", "double-wall-external-corner"],
  ["pocket with an island", "internal-rectangle-protected"],
  ["island", "external-rectangle"],
  ["edge", "double-wall-external-corner"],
  ["angle", "double-wall-internal-corner"],
  ["rotation", "probing-two-circles"],
  ["skew", "probing-two-circles"],
  ["ring", "hole"],
  ["rings", "hole"],
  ["vise", "groove"],
  ["Z", "surface"],
  ["G54", "boss"],
  ["7", "internal-rectangle-protected"],
];

test("cycles are found by what setters call what they measure", () => {
  const store = new Store();
  for (const [words, type] of WORDS)
    assert.ok(found(store, words).types.includes(type), words);
});

test("only the tool lengths are found by the name of the function that tells them", () => {
  for (const words of ["LENTOAX", "tool length", "SINUMERIK length"])
    assert.deepEqual(found(new Store(), words).types, ["lengths"], words);
});

test("“Z” is a word, and no letter of another one", () => {
  assert.ok(!found(new Store(), "Z").types.includes("hole"));
});

test("what nothing has whole is found by its parts; what nothing has at all is not found", () => {
  const { all, types } = found(new Store(), "pocket LENTOAX");
  assert.equal(all, false);
  assert.ok(
    types.includes("internal-rectangle") && types.includes("lengths"),
    `${types}`,
  );
  assert.deepEqual(found(new Store(), "xyzzy").types, []);
  assert.equal(
    found(new Store(), "").types.length,
    catalog().cycles.length + 1,
  );
});

test("in German a “Tasche” is a pocket", () => {
  const store = new Store();
  store.translate("de", wordsOf("de"));
  assert.deepEqual(found(store, "Tasche").types.sort(), [
    "internal-rectangle",
    "internal-rectangle-protected",
  ]);
});
