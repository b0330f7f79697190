// Sizes and results with a tolerance: what a program judges by, what it is called, and what other units make of it.
import assert from "node:assert/strict";
import { test } from "node:test";
import {
  listen,
  program,
  read,
  Store,
  said,
  setUp,
  toleranced,
  type,
} from "./state.mjs";

setUp();

/** Types a size with a tolerance, and takes what is proposed for it; gives the limit that holds then. */
function judged(
  /** @type {any} */ store,
  /** @type {string} */ path,
  /** @type {string} */ text,
) {
  const told = listen(store);
  type(store, path, text);
  toleranced(store, path).take();
  assert.match(told.join(), new RegExp(`^${text} is judged`));
  return store.get("limits.size");
}

test("25+0.021 became 25.021 without a word: it stays as typed, and the check says what to enter", () => {
  const store = new Store();
  store.choose("hole");
  for (const typed of ["25+0.021", "25H7"]) {
    type(store, "cycle.diameter", typed);
    assert.equal(store.typed.get("cycle.diameter"), typed);
    assert.match(
      store.withheld,
      new RegExp(
        `enter 25 alone, or 25\\.0105 with a size limit of 0\\.0105 to have "${typed.replace("+", "\\+")}" judged`,
      ),
    );
    assert.equal(toleranced(store, "cycle.diameter").text, typed);
  }
  // A difference that may be meant can be judged, too.
  type(store, "cycle.diameter", "25-0.02");
  assert.equal(toleranced(store, "cycle.diameter").text, "25-0.02");
});

test("a size with a fit is judged by its limits, in one step that can be taken back", () => {
  const store = new Store();
  const told = listen(store);
  store.choose("hole");
  type(store, "cycle.diameter", "25H7");
  toleranced(store, "cycle.diameter").take();
  assert.deepEqual(
    [store.get("cycle.diameter"), store.get("limits.size")],
    [25.0105, 0.0105],
  );
  assert.deepEqual(told, [
    "25H7 is judged: 25.0105 with a size limit of 0.0105",
  ]);
  assert.match(
    program(store),
    /diameter is #<diameter>, more than 0.0105 from 25.0105/,
  );
  store.undo();
  assert.equal(store.get("limits.size"), 0.5);
});

test("a name says the class of a size as long as it is the size that was judged", () => {
  const store = new Store();
  store.choose("hole");
  type(store, "cycle.diameter", "25H7");
  toleranced(store, "cycle.diameter").take();
  assert.equal(store.fileName("ngc"), "BORE-D25H7.ngc");
  type(store, "cycle.diameter", "30");
  assert.equal(store.fileName("ngc"), "BORE-D30.ngc");
  store.undo();
  assert.equal(store.fileName("ngc"), "BORE-D25H7.ngc");
  store.undo();
  type(store, "cycle.diameter", "50/2+0.5");
  assert.equal(store.get("cycle.diameter"), 25.5);
  assert.equal(store.fileName("ngc"), "BORE-D25_5.ngc");
});

test("the one limit is that of the narrowest size that was judged, also in other units, and of another job it is another", () => {
  const store = new Store();
  store.choose("internal-rectangle");
  // ISO 286-2: of 50 to 80 mm H7 is 0.030 and H9 0.074.
  assert.equal(judged(store, "cycle.width1", "80H7"), 0.015);
  assert.equal(judged(store, "cycle.width2", "60H9"), 0.015);
  store.setUnits("inch");
  assert.ok(
    Math.abs(judged(store, "cycle.width2", "2H9") - 0.015 / 25.4) < 1e-6,
  );
  store.reset();
  assert.ok(
    Math.abs(judged(store, "cycle.width2", "2H9") - 0.037 / 25.4) < 1e-6,
  );
});

/** Two circles on the control whose cycle takes tolerances. */
function circles() {
  const store = new Store();
  store.choose("probing-two-circles");
  store.chooseControl("heidenhain");
  return store;
}

test("a diameter of two circles takes a class, and the result of a size beyond it is scrap", () => {
  const store = circles();
  assert.match(
    program(store),
    /^0 BEGIN PGM CIRCLES-D20 MM\n[\s\S]*\n\d+ TCH PROBE 1411 PROBING TWO CIRCLES ~\n/,
  );
  type(store, "cycle.diameter1", "20H7");
  assert.match(program(store), /QS1116="20H7" ;DIAMETER 1 ~/);
  type(store, "part.sizes.diameter1", "0.05");
  const status = store.plan.results.find(
    (/** @type {any} */ row) => row.code === "Q183" || row.stored === "Q183",
  );
  assert.equal(status.value, 2);
  assert.match(store.say(status.said.verdict), /scrap: the program continues/);
  type(store, "cycle.diameter1", "20H99");
  assert.match(said(store, "cycle.diameter1").join(), /ISO 286 has no H99/);
});

test("two circles with an extrusion come back byte for byte from the program that was saved, which lacks the part's position", () => {
  const store = circles();
  type(store, "cycle.diameter1", "20H7");
  const { fields } = store.cycle.sections.find(
    (/** @type {any} */ section) => section.key === "extrusion",
  );
  store.put(
    "cycle.extrusion",
    Object.fromEntries(
      fields.map((/** @type {any} */ field) => [
        field.key,
        store.begins(field) ?? null,
      ]),
    ),
  );
  type(store, "cycle.extrusion.points", "3");
  assert.match(
    program(store),
    /\n\d+ TCH PROBE 1493 EXTRUSION PROBING ~\n {4}Q1140=\+3 /,
  );
  const { text } = store.plan.program;
  store.reset();
  assert.doesNotMatch(program(store), /1493/);
  const reading = read(text);
  store.open(reading);
  assert.equal(store.get("cycle.diameter1"), "20H7");
  assert.equal(store.plan.program.text, text);
  const notes = reading.findings.map(
    (/** @type {any} */ finding) => finding.message,
  );
  assert.match(notes.join(), /does not contain the part's position/);
});

test("texts with tolerances stayed as they were when the units changed: ten millimetres became ten inches", () => {
  const store = new Store();
  store.choose("probing-two-circles");
  // What nobody has touched begins as in inch: these were given.
  store.set("cycle.point1", [-30, 0, -10]);
  store.set("cycle.point2", [30, 0, -10]);
  type(store, "cycle.diameter1", "10H7");
  type(store, "cycle.diameter2", "20+0.05-0.02");
  const places = () =>
    store.plan.touches.map((/** @type {any} */ touch) => touch.point);
  const before = places();
  store.setUnits("inch");
  assert.equal(store.stale, false);
  const after = places();
  assert.equal(after.length, before.length);
  before.forEach((/** @type {number[]} */ point, /** @type {number} */ k) => {
    for (const [i, mm] of point.entries())
      assert.ok(
        Math.abs(after[k][i] * 25.4 - mm) < 1e-3,
        `touch ${k + 1}: ${after[k]} against ${point}`,
      );
  });
  store.setUnits("mm");
  type(store, "cycle.diameter1", "ten");
  store.setUnits("inch");
  assert.equal(
    store.get("cycle.diameter1"),
    "ten",
    "what is no number stays as it is",
  );
});

test("the tolerance of a result is kept through another cycle, another name and other units, and is in the program", () => {
  const store = new Store();
  store.choose("hole");
  store.put("cycle.diameter", 25);
  const give = (/** @type {object | undefined} */ tolerance) =>
    store.tolerate(0, "diameter", tolerance);
  const held = () => store.tolerance(0, "diameter").tolerance;
  give({ tolerance: "H7" });
  const limits = () =>
    store.plan.results.find((/** @type {any} */ row) => row.code === "diameter")
      .limits;
  assert.deepEqual(limits(), [25, 25.021]);
  give({ tolerance: "H7", action: "stop" });
  assert.match(
    program(store),
    /\(ABORT,diameter is #<diameter>, not 25 to 25\.021\)/,
  );
  // A second cycle: the first one's results are named, and keep what they have.
  store.addFeature("boss");
  store.put("cycle.origin[0]", 120);
  assert.match(
    program(store),
    /\(ABORT,BORE\.diameter is #<bore_diameter>, not 25 to 25\.021\)/,
  );
  store.bringFeature(0);
  store.renameFeature(0, "FIT");
  assert.match(program(store), /\(ABORT,FIT\.diameter is/);
  assert.equal(held(), "H7");
  give({ tolerance: "±0,0254", action: "stop" });
  store.setUnits("inch");
  assert.equal(held(), "±0.001");
  store.setUnits("mm");
  assert.equal(held(), "±0.0254");
  give({ tolerance: "H77", action: "stop" });
  assert.match(store.withheld, /ISO 286 has no H77/);
  give(undefined);
  assert.doesNotMatch(program(store), /not 25 to/);
});
