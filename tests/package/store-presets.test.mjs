// Stored machines: their part of a job, valid files of them, and their use in a job.
import assert from "node:assert/strict";
import { test } from "node:test";
import { presets, program, Store, setUp, type } from "./state.mjs";

setUp();

/** The machines of a file that holds these. */
const inFile = (/** @type {unknown[]} */ list) =>
  presets.read(
    JSON.stringify({ format: "touchpath-presets", version: 1, presets: list }),
  );

test("a machine brings stylus, feeds and control back, in other units too, and the part stays", () => {
  const machine = new Store();
  type(machine, "stylus.diameter", "3");
  type(machine, "feeds.work", "80");
  machine.chooseControl("sinumerik");
  const kept = machine.preset("Mill 2 <b>");
  const store = new Store();
  type(store, "cycle.width1", "66");
  store.setUnits("inch");
  store.usePreset(kept);
  assert.deepEqual(
    [
      store.get("units"),
      store.get("stylus.diameter"),
      store.get("feeds.work"),
      store.get("control.post"),
    ],
    ["inch", 0.11811, 3.149606, "sinumerik"],
  );
  assert.match(program(store), /MEAS=1/);
  store.setUnits("mm");
  assert.ok(
    Math.abs(store.get("cycle.width1") - 66) < 1e-4,
    "the part is the job's",
  );
  store.undo();
  store.undo();
  assert.equal(
    store.get("control.post"),
    "linuxcnc",
    "undo brings back what was there",
  );
});

test("a machine changed which work offset is written; and what it holds can be taken by parts", () => {
  const store = new Store();
  store.put("control.workOffset", 3);
  type(store, "stylus.diameter", "4");
  type(store, "feeds.work", "90");
  const kept = store.preset("A");
  store.put("control.workOffset", null);
  type(store, "stylus.diameter", "6");
  type(store, "feeds.work", "150");
  store.usePreset(kept, ["stylus", "overtravel", "control", "tool"]);
  const now = [
    store.get("control.workOffset"),
    store.get("stylus.diameter"),
    store.get("feeds.work"),
  ];
  assert.deepEqual(now, [null, 4, 150]);
  assert.ok(!("workOffset" in kept.sections.control));
  store.put("control.workOffset", 2);
  store.usePreset(kept);
  assert.deepEqual(
    [store.get("control.workOffset"), store.get("feeds.work")],
    [2, 90],
    "that of the job stays",
  );
});

test("of two machines of one name the one that was kept last stays, and names are in order", () => {
  const store = new Store();
  const list = ["one", "two", "one"]
    .map((name) => store.preset(name))
    .reduce(presets.added, []);
  assert.deepEqual(
    list.map((/** @type {any} */ one) => one.name),
    ["one", "two"],
  );
  assert.deepEqual(
    presets.read(presets.written(list)),
    JSON.parse(JSON.stringify(list)),
    "a file brings them back",
  );
});

test("a file that holds no machines is none, and what is none in a file is left out", () => {
  for (const bad of [
    "{",
    "[]",
    '{"format":"touchpath-presets","version":2,"presets":[]}',
    '{"format":1,"cycle":{"type":"hole"}}',
  ])
    assert.equal(presets.read(bad), null, bad);
  const list = inFile([
    7,
    { name: "no sections" },
    { name: "wrong", sections: { feeds: { work: [] }, __proto__: 1 } },
  ]);
  assert.deepEqual(
    list.map((/** @type {any} */ one) => one.name),
    ["wrong"],
  );
  const store = new Store();
  const before = structuredClone(store.draft);
  assert.throws(
    () => store.usePreset(list[0]),
    (/** @type {any} */ thrown) =>
      /^Nothing was changed: this machine cannot be used: feeds\.work/.test(
        store.why(thrown),
      ),
  );
  assert.deepEqual(store.draft, before);
});

test("a machine that leaves something out brings the defaults, not holes", () => {
  const store = new Store();
  type(store, "stylus.diameter", "3");
  store.usePreset(inFile([{ name: "bare", sections: { stylus: {} } }])[0]);
  assert.equal(store.get("stylus.diameter"), 6);
});
