// The page's state without a browser: the same module as on the page, on the real core. Its subjects are in store-*.
import assert from "node:assert/strict";
import { test } from "node:test";
import { read, Store, setUp } from "./state.mjs";

setUp();

test("a value that is set is in the job, the plan and the event", () => {
  const store = new Store();
  let changes = 0;
  store.addEventListener("change", () => changes++);
  store.set("cycle.width1", 64, "64,0");
  assert.equal(store.get("cycle.width1"), 64);
  assert.equal(store.typed.get("cycle.width1"), "64,0");
  assert.equal(
    store.plan.results.find((/** @type {any} */ row) => row.code === "width1")
      .nominal,
    64,
  );
  assert.equal(changes, 1);
  store.drop("cycle.width1");
  assert.equal(store.get("cycle.width1"), undefined);
  assert.equal(store.typed.size, 0);
});

test("with an error the last good plan stays, is stale, and is withheld with the reason", () => {
  const store = new Store();
  const { plan } = store;
  store.set("cycle.width1", -5);
  assert.equal(store.plan, plan);
  assert.ok(store.stale);
  assert.match(store.withheld, /Width 1/);
  assert.equal(store.at("cycle.width1")[0].level, "error");
  store.set("cycle.width1", 70);
  assert.ok(!store.stale);
  assert.equal(store.withheld, null);
});

test("a cycle that was left comes back with its values, in the present units", () => {
  const store = new Store();
  store.set("cycle.width1", 63.5);
  store.measured = "1,2,3";
  store.set("part.sizes.width1", 0.508);
  store.choose("hole");
  assert.deepEqual(store.get("part.sizes"), {});
  assert.equal(store.cycle.type, "hole");
  assert.equal(store.measured, "");
  store.setUnits("inch");
  store.choose("internal-rectangle-protected");
  assert.equal(store.get("cycle.width1"), 2.5);
  assert.deepEqual(store.get("part.sizes"), { width1: 0.02 });
});

test("the repeatability of a good probe was 20 % larger after inch and back", () => {
  const store = new Store();
  store.set("stylus.repeatability", 0.00025);
  store.setUnits("inch");
  assert.equal(store.get("stylus.repeatability"), 0.000009843);
  store.setUnits("mm");
  assert.equal(store.get("stylus.repeatability"), 0.00025);
  const other = new Store();
  other.set("stylus.repeatability", 0.001);
  other.setUnits("inch");
  const shown = other.get("stylus.repeatability");
  assert.equal(shown, 0.00003937);
  assert.equal(
    other.defaultValue(other.fieldAt("stylus.repeatability")),
    shown,
  );
});

test("what nobody has touched begins with numbers of its units; what was typed, or came with a job, is converted", () => {
  const store = new Store();
  store.set("cycle.width1", 80);
  store.setUnits("inch");
  // 80 mm were typed, although they are the default; 50 mm were not.
  assert.deepEqual(
    [store.get("cycle.width1"), store.get("cycle.width2")],
    [3.149606, 2],
  );
  assert.deepEqual(
    [store.get("stylus.diameter"), store.get("stylus.repeatability")],
    [0.236, 0.00005],
  );
  store.undo();
  assert.deepEqual(
    [store.get("cycle.width1"), store.get("cycle.width2"), store.units],
    [80, 50, "mm"],
  );
  store.redo();
  store.setUnits("mm");
  assert.deepEqual(
    [store.get("cycle.width1"), store.get("cycle.width2")],
    [80, 50],
  );
  const opened = new Store();
  opened.load(structuredClone(opened.draft));
  opened.setUnits("inch");
  assert.deepEqual(
    [opened.get("cycle.width2"), opened.get("stylus.diameter")],
    [1.968504, 0.23622],
  );
});

test("a pocket has two sizes in its name, each with its class, and a job that can only be looked at keeps its sizes", () => {
  const store = new Store();
  store.set("cycle.width1", "80 H7");
  store.set("cycle.width2", "50H9");
  assert.equal(store.draft.name, "POCKET-80H7X50H9");
  const shut = new Store();
  shut.readonly = true;
  shut.set("cycle.width1", "80H7");
  assert.equal(shut.get("cycle.width1"), 80);
});

test("what the page around asks for goes before the user's choice", () => {
  const store = new Store();
  store.askCam(false);
  store.cam = true;
  assert.equal(store.cam, false, "a dump changes nothing of it");
  store.askCam(true);
  assert.equal(store.cam, true);
  store.askCam(null);
  assert.equal(store.cam, false);
});

test("the form follows the control, and the control stays where it takes the cycle", () => {
  const store = new Store();
  store.chooseControl("sinumerik");
  store.set("control.form", "cycle");
  assert.ok(!store.stale);
  store.chooseControl("linuxcnc");
  assert.equal(store.get("control.form"), "moves");
  store.chooseControl("sinumerik");
  store.set("control.form", "cycle");
  store.chooseControl("fanuc");
  assert.equal(
    store.get("control.form"),
    "cycle",
    "it was chosen, and this control has macros",
  );
  store.choose("probing-two-circles");
  assert.equal(store.get("control.post"), "fanuc");
  store.chooseControl("heidenhain");
  assert.equal(store.get("control.form"), "cycle");
  store.chooseControl("fanuc");
  assert.equal(
    store.get("control.form"),
    "moves",
    "it was the only one there, and not chosen",
  );
  store.chooseControl("heidenhain");
  store.set("control.workOffset", 3);
  store.choose("hole");
  assert.deepEqual(
    [store.get("control.post"), store.get("control.form")],
    ["heidenhain", "cycle"],
  );
  store.choose("double-wall-external-corner");
  assert.notEqual(store.get("control.post"), "heidenhain");
});

test("a text that is no job changes nothing", () => {
  const store = new Store();
  store.set("cycle.width1", 71);
  const before = structuredClone(store.draft);
  const moves = "G21 G17 G90 G94\nM5\nG0 X1 Y2\nG0 Z3\nG38.2 Z-5 F100\nM2\n";
  for (const text of [
    "nothing",
    "{",
    '{"format":9,"cycle":{"type":"hole"}}',
    moves,
    "x".repeat(3_000_000),
  ]) {
    assert.throws(() => store.open(read(text)), /./);
    assert.deepEqual(store.draft, before);
  }
  assert.throws(() => store.open(read(moves)), /contains no job/);
});

test("a program for any control is opened as the job that made it", () => {
  const store = new Store();
  store.set("cycle.width1", 66);
  for (const { id, cycles } of store.catalog.posts) {
    if (
      !cycles.some(
        (/** @type {any} */ c) => c.type === store.cycle.type && c.supported,
      )
    )
      continue;
    store.set("control.post", id);
    const { text } = store.plan.program;
    const other = new Store();
    other.open(read(text));
    assert.equal(other.get("cycle.width1"), 66, id);
    assert.equal(other.plan.program.text, text, id);
  }
});

test("every job was called PROBE: a name that was not typed follows what is measured", () => {
  const store = new Store();
  const name = () => store.get("name");
  assert.equal(name(), "POCKET-80X50");
  store.set("cycle.width1", 64);
  assert.equal(name(), "POCKET-64X50");
  store.undo();
  assert.equal(name(), "POCKET-80X50");
  store.set("cycle.width1", "x");
  assert.equal(name(), "POCKET");
  store.set("cycle.width1", 60);
  assert.equal(name(), "POCKET-60X50");
  store.choose("hole");
  assert.equal(name(), "BORE-D40");
  store.set("cycle.depth", 12);
  store.set("name", "MINE");
  store.set("cycle.diameter", 25);
  assert.equal(name(), "MINE");
  assert.equal(store.fileName("ngc"), "MINE.ngc");
  // A job from outside keeps its name, for any earlier name.
  store.reset();
  const job = { ...structuredClone(store.draft), name: "BORE-D40" };
  job.cycle.diameter = 30;
  store.load(job);
  assert.equal(name(), "BORE-D40");
  store.set("cycle.diameter", 31);
  assert.equal(name(), "BORE-D40");
  const nameless = structuredClone(store.draft);
  delete nameless.name;
  store.load(nameless);
  assert.equal(name(), "BORE-D31");
});

test("a work offset was lost on the way over a control that has none", () => {
  const store = new Store();
  const held = () => [
    store.get("control.post"),
    store.get("control.workOffset"),
  ];
  store.chooseControl("fanuc");
  store.put("control.workOffset", 2);
  store.chooseControl("grbl");
  assert.deepEqual(held(), ["grbl", null]);
  store.chooseControl("sinumerik");
  assert.deepEqual(held(), ["sinumerik", 2]);
  store.chooseControl("haas");
  store.put("control.workOffset", 13);
  store.chooseControl("fanuc");
  assert.deepEqual(held(), ["fanuc", null]);
  store.chooseControl("grbl");
  store.chooseControl("haas");
  assert.deepEqual(held(), ["haas", 13], "G154 P7");
  // The user's choice holds.
  store.chooseControl("grbl");
  store.put("control.workOffset", null);
  store.chooseControl("haas");
  assert.deepEqual(held(), ["haas", null]);
  // Nor does it carry over to another job.
  store.put("control.workOffset", 2);
  store.chooseControl("grbl");
  store.reset();
  store.chooseControl("haas");
  assert.deepEqual(held(), ["haas", null]);
});

test("a file that held another program when it was saved before is known", () => {
  const store = new Store();
  const file = store.fileName("ngc");
  assert.equal(store.replaces(file), false);
  store.remember(file);
  assert.equal(store.replaces(file), false, "the same again");
  store.set("cycle.depth", 12);
  assert.equal(store.replaces(file), true);
  assert.equal(store.replaces("OTHER.ngc"), false);
  store.undo();
  assert.equal(store.replaces(file), false);
  for (const post of ["heidenhain", "fanuc", "sinumerik"]) {
    if (post === "heidenhain") store.choose("probing-two-circles");
    store.chooseControl(post);
    store.set("cycle.clearanceHeight", 100);
    const own = store.fileName(store.plan.program.extension);
    store.remember(own);
    // For the cycle that each of them writes.
    store.set("cycle.clearanceHeight", 90);
    assert.equal(store.replaces(own), true, post);
  }
});

test("fields that change nothing are known, and what the program does is one sentence", () => {
  const store = new Store();
  store.choose("hole");
  const counts = (/** @type {string} */ path) =>
    store.counts(path, store.fieldAt(path));
  for (const key of ["startAngle", "angularStep", "stepCount"])
    assert.equal(counts(`cycle.${key}`), false, key);
  store.set("cycle.variant", 1);
  for (const key of ["startAngle", "angularStep", "stepCount", "diameter"])
    assert.ok(counts(`cycle.${key}`), key);
  assert.deepEqual(
    [counts("control.number"), counts("control.setUp")],
    [false, false],
  );
  store.chooseControl("fanuc");
  assert.deepEqual(
    [counts("control.number"), counts("control.setUp")],
    [true, false],
  );
  assert.equal(store.does, "measures only");
  store.put("control.workOffset", 1);
  assert.equal(store.does, "writes G54 X Y");
  assert.equal(store.writes(1), "writes G54 X Y");
  assert.equal(store.writes(2), "writes G55");
  store.choose("probing-two-circles");
  store.chooseControl("heidenhain");
  store.set("cycle.transferPosition", 3);
  store.set("cycle.confirmRotation", 1);
  assert.equal(store.does, "sets the basic rotation and preset X Y");
});

test("any run of steps taken back is the state before it, and taken again the state after it", () => {
  const store = new Store();
  let seed = 7;
  const draw = (/** @type {number} */ n) => {
    seed = (seed * 1103515245 + 12345) % 2147483648;
    return Math.floor((seed / 2147483648) * n);
  };
  const state = () =>
    JSON.stringify([
      store.draft,
      [...store.typed],
      store.measured,
      store.units,
    ]);
  const cycles = [
    "hole",
    "boss",
    "internal-rectangle-protected",
    "probing-two-circles",
  ];
  const steps = [
    () => store.set("cycle.depth", draw(50), String(draw(50))),
    () => store.set("part.offset", [draw(3), 0, 0]),
    () => store.set("stylus.diameter", 1 + draw(5)),
    () => store.setUnits(draw(2) ? "inch" : "mm"),
    () => store.choose(cycles[draw(4)]),
    () => store.reset(),
    () => store.drop("cycle.rotation"),
    () => {
      store.measured = `${draw(9)}, 0, 0`;
    },
    () => store.open(read('{"format":1,"cycle":{"type":"web"}}')),
    () =>
      store.usePreset({
        name: "x",
        units: "inch",
        sections: { stylus: { diameter: 0.1 } },
      }),
  ];
  const states = [state()];
  for (let i = 0; i < 120; i++) {
    store.settle();
    const step = steps[draw(steps.length)];
    step?.();
    // A step without a change may be omitted.
    if (store.history.past.length === states.length) states.push(state());
    else assert.equal(state(), states.at(-1));
  }
  assert.ok(states.length > 80);
  for (let i = states.length - 2; i >= 0; i--) {
    store.undo();
    assert.equal(state(), states[i], `back to ${i}`);
  }
  assert.ok(!store.canUndo);
  for (let i = 1; i < states.length; i++) {
    store.redo();
    assert.equal(state(), states[i], `again to ${i}`);
  }
  assert.ok(!store.canRedo);
});

test("a HEIDENHAIN program and its file had two names: the control wants them the same", () => {
  const store = new Store();
  store.choose("probing-two-circles");
  for (const name of ["Größe Ø 12", "夹具", "PART-7", "a b", ""]) {
    store.set("name", name);
    store.chooseControl("heidenhain");
    const inside = /^0 BEGIN PGM (\S+) MM/.exec(store.plan.program.text)?.[1];
    assert.equal(store.fileName("h"), `${inside}.h`, name);
    store.chooseControl("linuxcnc");
    assert.match(store.fileName("ngc"), /^[A-Za-z0-9_-]+\.ngc$/, name);
  }
  store.set("name", "CON");
  store.chooseControl("heidenhain");
  assert.equal(store.fileName("h"), "CON_.h", "a name that Windows keeps");
});

test("a dry run says so in its first line, its file name and what the program does", () => {
  const store = new Store();
  const { text } = store.plan.program;
  store.set("control.run", "dry");
  assert.match(store.plan.program.text, /^\(DRY RUN: the moves alone/);
  assert.match(store.fileName("ngc"), /^[A-Z0-9_-]+-DRY\.ngc$/);
  assert.match(
    store.does,
    /^makes a dry run: measures nothing, writes nothing/i,
  );
  assert.ok(
    store.plan.results.every((/** @type {any} */ row) => row.value === null),
  );
  store.set("control.run", "normal");
  assert.equal(store.plan.program.text, text);
});
