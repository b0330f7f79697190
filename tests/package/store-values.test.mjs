// Input of the form reaches the job and the program: values, units, languages, other cycles and back.
import assert from "node:assert/strict";
import { test } from "node:test";
import { catalog } from "touchpath";
import { wordsOf } from "../../scripts/words.mjs";
import {
  asInBrowser,
  program,
  Store,
  said,
  sentences,
  setUp,
  type,
  words,
} from "./state.mjs";

setUp();

test("a keystroke changes program, parameters and results", () => {
  const store = new Store();
  assert.match(program(store), /G38\.2 X42 Y0 Z-10 F150/);
  type(store, "cycle.width1", "90");
  assert.match(program(store), /G38\.2 X47 Y0 Z-10 F150/);
  const { table, results } = store.plan;
  assert.equal(
    table.find((/** @type {any} */ row) => row.code === "CmdPrm.Flt[-53]")
      .value,
    90,
  );
  assert.equal(
    results.find((/** @type {any} */ row) => row.code === "width1").value,
    90,
  );
});

test("a decimal comma is a number and stays as it was typed", () => {
  const store = new Store();
  type(store, "cycle.width1", "80,5");
  assert.match(program(store), /G38\.2 X42\.25 Y0 Z-10 F150/);
  assert.equal(store.typed.get("cycle.width1"), "80,5");
});

test("the other cycle, and back without losing the form", () => {
  const store = new Store();
  type(store, "cycle.width1", "77");
  store.choose("double-wall-internal-corner");
  type(store, "cycle.count1", "3");
  assert.match(program(store), /type 13/);
  assert.equal(program(store).match(/^G38\.2/gm)?.length, 5);
  store.choose("internal-rectangle-protected");
  assert.equal(store.get("cycle.width1"), 77);
});

test("every cycle has a plan without an error, and its moves are of its documented steps", () => {
  const store = new Store();
  for (const { type, steps } of catalog().cycles) {
    store.choose(type);
    assert.equal(store.withheld, null, type);
    assert.equal(store.plan.moves.length > 0, steps.length > 0, type);
    for (const { step } of store.plan.moves)
      assert.ok(steps[step - 1], `${type}: step ${step}`);
  }
});

test("units convert what is shown, not the part", () => {
  const store = new Store();
  // Untouched fields have round values in inch: every value of this job was set.
  for (const section of ["cycle", "stylus", "feeds", "overtravel"])
    store.put(section, store.get(section));
  store.setUnits("inch");
  assert.equal(store.get("cycle.width1"), 3.149606);
  assert.match(program(store), /G20/);
  assert.match(program(store), /G38\.2 X1\.65354/);
  store.setUnits("mm");
  assert.equal(store.get("cycle.width1"), 80);
  assert.match(program(store), /G38\.2 X42 Y0 Z-10 F150/);
});

test("inch is designed: en-US begins with it, and no field that nobody has touched has a conversion in it", () => {
  asInBrowser(
    {},
    () => {
      const store = new Store({ local: true });
      assert.equal(store.units, "inch");
      const values = () => {
        const { stylus, feeds, cycle, overtravel } = store.draft;
        return [
          stylus.diameter,
          stylus.repeatability,
          feeds.longLink,
          cycle.feedDistance,
          cycle.width1,
          overtravel,
        ];
      };
      assert.deepEqual(values(), [0.236, 0.00005, 40, 0.8, 3, 0.2]);
      store.setUnits("mm");
      assert.deepEqual(values(), [6, 0.001, 1000, 20, 80, 5], "back exactly");
      // Typed values are converted.
      type(store, "cycle.width1", "60");
      store.setUnits("inch");
      assert.deepEqual(values(), [0.236, 0.00005, 40, 0.8, 2.362205, 0.2]);
    },
    "en-US",
  );
});

test("a feed is rapid only where it is null, never by an empty field", () => {
  const store = new Store();
  type(store, "feeds.longLink", "");
  assert.match(said(store, "feeds.longLink").join(), /must be a number/);
  store.put("feeds.longLink", null);
  assert.match(program(store), /G0 X32 Y0 Z-10\n/);
});

test("an error is said at its field, and the last good program stays", () => {
  const store = new Store();
  const good = program(store);
  type(store, "cycle.sideClearance1", "2");
  assert.match(said(store, "cycle.sideClearance1").join(), /ball radius/);
  assert.equal(program(store), good);
  assert.ok(store.stale);
  type(store, "cycle.depth", "ten");
  assert.equal(
    store.findings.filter((/** @type {any} */ f) => f.level === "error").length,
    2,
  );
  type(store, "cycle.depth", "10");
  type(store, "cycle.sideClearance1", "8");
  assert.ok(!store.stale);
});

test("each move is said in words with its step, its touch and its place", () => {
  const store = new Store();
  const { moves } = store.plan;
  const first = moves.findIndex(
    (/** @type {any} */ move) => move.kind === "touch",
  );
  const { step, to } = moves[first];
  const inWords = () => sentences.moveInWords(store, first, false);
  assert.equal(
    inWords(),
    `step ${step}, touch 1, work, to X${to[0]} Y${to[1]} Z${to[2]}`,
  );
  type(store, "cycle.depth", "12.5");
  assert.match(inWords(), /Z-12\.5$/);
});

test("numbers are typed in either way, and are the same in the job and in the program", () => {
  const store = new Store();
  store.translate("de", wordsOf("de"));
  type(store, "cycle.width1", "80,5");
  type(store, "cycle.width2", "50.25");
  assert.deepEqual(
    [store.job.cycle.width1, store.job.cycle.width2],
    [80.5, 50.25],
  );
  assert.equal(store.number(String(store.get("cycle.width2"))), "50,25");
  assert.match(program(store), /X40\.25\b|X4\d\.\d/, "a program has points");
  type(store, "cycle.width1", "80,000");
  assert.equal(
    store.get("cycle.width1"),
    80,
    "in a language with a comma that is no thousand",
  );
  store.set("plane", "1.5");
  assert.match(
    store.say(store.at("plane")[0].said),
    /"1\.5"/,
    "what a user wrote is quoted as it was written",
  );
});

test("a language tag leads to the words of its language: Taiwan's are traditional", () => {
  for (const [tags, lang] of /** @type {[string[], string | null][]} */ ([
    [["zh-CN"], "zh-Hans"],
    [["zh-TW"], "zh-Hant"],
    [["de-AT"], "de"],
    [["ru"], "ru"],
    [["en-GB"], "en"],
    [["xx", "de"], "de"],
    [["xx"], null],
  ]))
    assert.equal(words.languageOf(tags), lang, `${tags}`);
  assert.deepEqual(
    [wordsOf("zh-Hans").Program, wordsOf("zh-Hant").Program],
    ["程序", "程式"],
  );
});
