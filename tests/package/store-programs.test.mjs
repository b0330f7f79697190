// Programs without a job, and measurements: their content, and why no job is made.
import assert from "node:assert/strict";
import { test } from "node:test";
import { measure } from "touchpath";
import { read, Store, setUp, type } from "./state.mjs";

setUp();

/** Why no job is made of a text, as the page says it. */
function refusal(/** @type {any} */ store, /** @type {any} */ reading) {
  try {
    store.open(reading);
  } catch (thrown) {
    return store.why(thrown);
  }
  assert.fail("no job should be made of it");
}

test("a program of another hand that makes no job has its moves, or at least its text, with the reason; the job stays", () => {
  const store = new Store();
  const before = structuredClone(store.draft);
  for (const [
    name,
    text,
    moves,
    why,
  ] of /** @type {[string, string, number, RegExp][]} */ ([
    [
      "a subroutine that nothing calls",
      "o<edge> sub\n  o10 if [#5400 NE #3101]\n    (abort, wrong tool)\n  o10 endif\n  G91\n  G38.2 X-[#<reach>] F[#2]\no<edge> endsub\n",
      1,
      /LinuxCNC/,
    ],
    [
      "blocks after semicolons",
      "G21;G91;G38.2 Z-17 F70;G0 Z2\n",
      0,
      /semicolon/,
    ],
    ["a macro of the machine", "; corner\nG6500\n", 0, /G6500/],
    [
      "a cycle that is not known",
      "0  BEGIN PGM TOP MM\n1  TCH PROBE 417 Q263=+7\n2  END PGM TOP MM\n",
      0,
      /cycle 1411/,
    ],
  ])) {
    const reading = read(text);
    assert.equal(reading.moves?.kind.length, moves, name);
    const notes = [...reading.findings, ...reading.moves.findings].map(
      (/** @type {any} */ f) => f.message,
    );
    assert.match([...notes, refusal(store, reading)].join(), why, name);
    assert.deepEqual(store.draft, before, name);
  }
});

test("of a program of more than two million characters the moves are read, and no job is made", () => {
  const rows = Array.from(
    { length: 90_000 },
    (_, i) => `N${i} G1 X${i % 300} Y${i % 7} F500`,
  );
  const text = `G21 G90\nG0 X0 Y0 Z5\n${rows.join("\n")}\nM2\n`;
  assert.ok(text.length > 2_000_000);
  const reading = read(text);
  assert.equal(reading.moves.kind.length, 90_001);
  assert.match(
    refusal(new Store(), reading),
    /a job is made of at most 2 million/,
  );
});

test("what is no program is not drawn as one", () => {
  const reading = read("Dear setter,\nX marks the spot.\n");
  assert.equal(reading.moves, null);
  assert.notEqual(refusal(new Store(), reading), "");
});

test("LinuxCNC's log of a probe gives the measured points of the job, and one step takes them back", () => {
  const log = [37, -37.02, 0.01, -0.02].map((x, i) =>
    i < 2 ? `${x} 0 -10` : `0 ${i === 2 ? 22.01 : -22} -10`,
  );
  const text = log.map((line) => `${line} 0 0 0 0 0 0\n`).join("");
  assert.equal(read(text).points, 4);
  const store = new Store();
  store.openPoints(text.trim());
  const { results } = measure(store.job, store.measured);
  // The balls are 74.02 apart, and the ball is 6 wide.
  assert.equal(
    results.find((row) => row.code === "width1")?.value?.toFixed(3),
    "80.020",
  );
  store.undo();
  assert.equal(store.measured, "");
});

test("a probing move, its feeds and what is not followed are told apart in a program that was found on a machine", () => {
  const { moves } = read(
    "(found on a machine)\nG21 G17 G90\nG0 X0 Y0 Z20\nG0 Z5\nG38.2 Z-5 F100\nG1 Z5 F500\nG2 X20 Y0 I10 J0 F800\n#5=#5063\nG0 Z20\nM2\n",
  );
  const kinds = [...moves.kind].map(
    (/** @type {number} */ kind) => moves.kinds[kind],
  );
  assert.equal(kinds.length, 6);
  assert.equal(kinds.filter((kind) => kind === "probe").length, 1);
  assert.match(
    moves.findings.map((/** @type {any} */ f) => f.message).join(),
    /get an unknown value: once, in line 8/,
  );
});

test("a text of one move from nowhere gives no job, and the form stays", () => {
  const store = new Store();
  type(store, "cycle.width1", "71");
  assert.match(refusal(store, read("G1 X0")), /This text gives no job/);
  assert.equal(store.get("cycle.width1"), 71);
});
