// Sizes and results with a tolerance: the program's judgement, names, and other units.
import assert from "node:assert/strict";
import { test } from "node:test";
import { plan } from "touchpath";
import { program, read, Store, said, setUp, type } from "./state.mjs";

setUp();

const diameter = (/** @type {any} */ store) =>
  store.plan.results.find((/** @type {any} */ row) => row.code === "diameter");

test("a size keeps the tolerance that is typed behind it, and is judged by it", () => {
  const store = new Store();
  store.choose("hole");
  // ISO 286-2: H7 of 18 to 30 mm is +0.021/0.
  for (const [typed, limits] of /** @type {[string, number[]][]} */ ([
    ["25+0.021", [25, 25.021]],
    ["25H7", [25, 25.021]],
    ["25 ±0,05", [24.95, 25.05]],
    ["25-0.02", [24.98, 25]],
  ])) {
    type(store, "cycle.diameter", typed);
    assert.equal(store.get("cycle.diameter"), typed);
    assert.equal(store.withheld, null);
    assert.deepEqual(
      diameter(store).limits.map((/** @type {number} */ x) => +x.toFixed(6)),
      limits,
    );
    assert.equal(diameter(store).nominal, 25);
    store.settle();
  }
  store.undo();
  assert.equal(store.get("cycle.diameter"), "25 ±0,05");
  type(store, "cycle.diameter", "25Q9");
  assert.match(store.withheld, /ISO 286 has no Q9/);
});

test("a tolerance wider than the usual size limit was refused: the limit follows it until another is entered", () => {
  const store = new Store();
  store.choose("hole");
  const limit = () => store.get("limits.size");
  assert.equal(limit(), 0.5);
  // By hand: 0.5 mm beyond the largest deviation of the tolerance.
  for (const [typed, follows] of /** @type {[string, number][]} */ ([
    ["25 ±0.8", 1.3],
    ["25 +1.5 -2", 2.5],
    ["25", 0.5],
  ])) {
    type(store, "cycle.diameter", typed);
    assert.equal(store.withheld, null);
    assert.equal(limit(), follows);
    store.settle();
  }
  store.undo();
  assert.equal(limit(), 2.5);
  // While there is no plan the job keeps its limit.
  type(store, "cycle.diameter", "25 ±");
  assert.equal(limit(), 2.5);
  type(store, "cycle.diameter", "25 ±1");
  assert.equal(limit(), 1.5);
  type(store, "limits.size", "1.2");
  type(store, "cycle.diameter", "25 ±0.3");
  assert.equal(limit(), 1.2);
  type(store, "cycle.diameter", "25 ±1.4");
  assert.match(store.withheld, /Enter a larger limit/);
});

test("the program has the size limit of the job, also in inch, where a limit of 0.5 mm is no number to type", () => {
  for (const [
    units,
    typed,
    limit,
  ] of /** @type {[string, string[], string][]} */ ([
    ["mm", ["24.5"], "0.5"],
    ["mm", ["25 ±0.8"], "1.3"],
    ["inch", ["1.5"], "0.02"],
    ["inch", ["1.5 ±0.03"], "0.05"],
    ["inch", ["1.5 ±0.03", "1.5"], "0.02"],
  ])) {
    const store = new Store();
    store.choose("hole");
    store.setUnits(units);
    for (const text of typed) type(store, "cycle.diameter", text);
    assert.equal(String(store.get("limits.size")), limit);
    assert.ok(program(store).includes(` GT ${limit}]`));
    assert.equal(store.plan.program.text, plan(store.job).program.text);
    assert.deepEqual(store.shown, store.job);
  }
});

test("a size limit that the page around locks, or a job states, follows no tolerance", () => {
  const locked = new Store();
  locked.choose("hole");
  locked.outside.input("config", {
    format: 1,
    fields: { "limits.size": { value: 0.5, locked: true } },
  });
  const stated = new Store();
  stated.open(read(JSON.stringify({ ...locked.job, name: "STATED" })));
  for (const store of [locked, stated]) {
    type(store, "cycle.diameter", "25 ±0.8");
    assert.match(store.withheld ?? "", /Enter a larger limit/);
    assert.equal(store.get("limits.size"), 0.5);
  }
});

test("the size limit of a job in inch follows in inch, and that of a set-up the widest tolerance", () => {
  const inch = new Store();
  inch.choose("hole");
  inch.setUnits("inch");
  type(inch, "cycle.diameter", "1 ±0.03");
  assert.equal(inch.withheld, null);
  assert.equal(inch.get("limits.size"), 0.05);
  const both = new Store();
  both.choose("hole");
  type(both, "cycle.diameter", "25 ±0.8");
  both.addFeature("internal-rectangle");
  type(both, "cycle.width1", "60 ±1.5");
  assert.equal(both.withheld, null);
  assert.equal(both.get("limits.size"), 2);
});

test("a name says the class of a size as long as that is the size", () => {
  const store = new Store();
  store.choose("hole");
  type(store, "cycle.diameter", "25H7");
  store.settle();
  assert.equal(store.fileName("ngc"), "BORE-D25H7.ngc");
  type(store, "cycle.diameter", "30");
  assert.equal(store.fileName("ngc"), "BORE-D30.ngc");
  store.undo();
  assert.equal(store.fileName("ngc"), "BORE-D25H7.ngc");
  type(store, "cycle.diameter", "50/2+0.5");
  assert.equal(store.get("cycle.diameter"), 25.5);
  assert.equal(store.fileName("ngc"), "BORE-D25_5.ngc");
});

test("sizes with a tolerance are the same zones in other units", () => {
  const store = new Store();
  store.choose("internal-rectangle");
  type(store, "cycle.width1", "80H7");
  type(store, "cycle.width2", "60 ±0.1");
  const zones = () =>
    ["width1", "width2"].map(
      (code) =>
        store.plan.results.find((/** @type {any} */ row) => row.code === code)
          .limits,
    );
  const before = zones();
  store.setUnits("inch");
  assert.equal(store.withheld, null);
  zones().forEach(([low, high], i) => {
    assert.ok(Math.abs(low * 25.4 - before[i][0]) < 1e-4, `${low}`);
    assert.ok(Math.abs(high * 25.4 - before[i][1]) < 1e-4, `${high}`);
  });
});

test("what follows from a size out of its tolerance stands beside it, and the sheet of tolerances shows the size", () => {
  const store = new Store();
  store.choose("hole");
  type(store, "cycle.diameter", "25 H7");
  assert.equal(store.sizeWithTolerance(0, "diameter"), "25 H7");
  store.tolerate(0, { diameter: { action: "stop" } });
  assert.match(program(store), /not 25 to 25\.021/);
  type(store, "cycle.diameter", "25");
  assert.equal(store.sizeWithTolerance(0, "diameter"), null);
});

/** Two circles on the control whose cycle supports tolerances. */
function circles() {
  const store = new Store();
  store.choose("probing-two-circles");
  store.chooseControl("heidenhain");
  return store;
}

test("what follows from a tolerance goes with it", () => {
  const store = new Store();
  store.choose("hole");
  type(store, "cycle.diameter", "25 H7");
  store.tolerate(0, { diameter: { action: "stop" } });
  assert.equal(store.withheld, null);
  type(store, "cycle.diameter", "26");
  assert.deepEqual([store.withheld, store.job.tolerances], [null, {}]);
  // A tolerance in the list belongs to the list.
  store.tolerate(0, { diameter: { tolerance: "±0.1", action: "mark" } });
  type(store, "cycle.diameter", "27");
  assert.deepEqual(store.tolerance(0, "diameter"), {
    tolerance: "±0.1",
    action: "mark",
  });
  // An empty entry is removed, and two that are set together are one step.
  const pocket = new Store();
  pocket.choose("internal-rectangle");
  for (const key of ["width1", "width2"])
    type(pocket, `cycle.${key}`, "60 ±0.05");
  pocket.settle();
  pocket.tolerate(0, { width1: { action: "stop" }, width2: {} });
  pocket.tolerate(0, { width1: {} });
  assert.deepEqual(pocket.job.tolerances, {});
  pocket.settle();
  pocket.tolerate(0, {
    width1: { action: "stop" },
    width2: { action: "stop" },
  });
  pocket.undo();
  assert.deepEqual(pocket.job.tolerances, {});
});

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
        store.initialValue(field) ?? null,
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
  // Untouched fields have round values in inch: these were set.
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
    store.tolerate(0, { diameter: tolerance });
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
  // A second cycle: the first one's results get names, and keep their tolerances.
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
