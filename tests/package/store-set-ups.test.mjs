// Several cycles in one program: their names and order, sources of the work offset, and followed results.
import assert from "node:assert/strict";
import { test } from "node:test";
import { catalog } from "touchpath";
import {
  listen,
  program,
  read,
  SET_UPS,
  Store,
  said,
  setUp,
  type,
} from "./state.mjs";

setUp();

/** A job that starts with this cycle and writes this work offset. */
function begun(
  /** @type {string} */ cycle,
  /** @type {number | null} */ workOffset = null,
) {
  const store = new Store();
  store.choose(cycle);
  store.put("control.workOffset", workOffset);
  return store;
}

/** The keys of the set-ups that are offered. */
const ready = (/** @type {any} */ store) =>
  store.readySetUps.map((/** @type {any} */ { entry }) => entry.key);

/** A job out of a file. */
function opened(/** @type {object} */ job) {
  const store = new Store();
  store.open(read(JSON.stringify(job)));
  return store;
}

/** A further cycle at this distance along an axis. */
function add(
  /** @type {any} */ store,
  /** @type {string} */ cycle,
  /** @type {Record<string, number>} */ values = {},
) {
  store.addFeature(cycle);
  for (const [path, value] of Object.entries(values))
    store.put(`cycle.${path}`, value);
}

const names = (/** @type {any} */ store) =>
  store.features.all.map((/** @type {any} */ one) => one.name);
/** Renames the cycle in hand. */
const rename = (/** @type {any} */ store, /** @type {string} */ name) =>
  store.renameFeature(store.features.hand, name);
/** Adds a relation of positions. */
const relate = (
  /** @type {any} */ store,
  /** @type {string} */ kind,
  /** @type {string[]} */ of,
) => store.relate((/** @type {any} */ features) => features.relate(kind, of));

test("the top and a wall added to a bore: the program writes X and Y from the bore, Z from the top, the rotation from the wall", () => {
  const store = begun("hole", 1);
  add(store, "surface", { "origin[0]": -40 });
  assert.deepEqual(names(store), ["BORE", "SURFACE"]);
  assert.equal(store.get("cycle.elevation"), 90, "the new one is in the form");
  rename(store, "TOP");
  store.moveFeature(1, 0);
  assert.deepEqual(names(store), ["TOP", "BORE"]);
  add(store, "wall-angle", { "origin[0]": 100 });
  store.writeFrom("rotation", "WALL.rotation");
  assert.deepEqual(
    names(store),
    ["TOP", "WALL", "BORE"],
    "behind the one in hand",
  );
  const from = store.plan.datum.map((/** @type {any} */ row) => [
    row.axis,
    row.from?.split(".")[0],
  ]);
  assert.deepEqual(from, [
    ["x", "BORE"],
    ["y", "BORE"],
    ["z", "TOP"],
    ["rotation", "WALL"],
  ]);
  assert.match(
    program(store),
    /\(TOP: ENCY[\s\S]*\(WALL: Touchpath[\s\S]*\(BORE: ENCY/,
  );
  assert.match(
    program(store),
    /G10 L2 P1 R\[#5230\+#<wall_turn>\][\s\S]*G10 L20 P1 X\[[\s\S]*M72\nM2$/,
  );
});

test("a move of another cycle that is kept lit brings that cycle into the form, and nothing of the job changes", () => {
  const store = begun("hole");
  add(store, "web", { "origin[0]": 120 });
  const before = program(store);
  store.pin(
    store.plan.moves.findIndex(
      (/** @type {any} */ move) => move.kind === "touch",
    ),
  );
  assert.equal(store.get("cycle.type"), "hole");
  assert.equal(program(store), before);
  store.bringFeature(1);
  assert.equal(store.get("cycle.origin[0]"), 120);
  assert.equal(program(store), before);
});

test("what is wrong with a cycle that is not in the form is said at its place in the job, and in the form at its field", () => {
  const store = begun("hole");
  add(store, "web");
  store.put("cycle.width", -3);
  store.bringFeature(0);
  const { path } = store.findings.find(
    (/** @type {any} */ f) => f.level === "error",
  );
  assert.equal(path, "cycles[1].width");
  assert.equal(store.features.placeOf(1), 1);
  store.bringFeature(1);
  assert.equal(store.get("cycle.width"), -3);
  assert.equal(store.at("cycle.width")[0].level, "error");
});

test("a cycle is duplicated, left out and taken in again, removed, and the removal is taken back", () => {
  const store = begun("hole");
  add(store, "hole", { "origin[0]": 90 });
  assert.deepEqual(names(store), ["BORE", "BORE2"]);
  store.duplicateFeature(1);
  store.put("cycle.origin[0]", 180);
  assert.deepEqual(names(store), ["BORE", "BORE2", "BORE3"]);
  store.switchFeature(2);
  assert.doesNotMatch(program(store), /BORE3/);
  assert.deepEqual(names(store), ["BORE", "BORE2", "BORE3"]);
  store.switchFeature(2);
  assert.match(program(store), /\(BORE3:/);
  store.removeFeature(2);
  store.removeFeature(1);
  assert.equal(store.features.several, false);
  assert.match(
    program(store),
    /\(ENCY\/SprutCAM type 3: Hole\)/,
    "one cycle again",
  );
  store.undo();
  assert.deepEqual(names(store), ["BORE", "BORE2"]);
});

test("a file with several cycles is opened and saved as it is; sizes of the virtual part go with their cycles", () => {
  const store = opened({
    format: 2,
    name: "PAIR",
    cycles: [
      { name: "A", type: "hole" },
      { name: "B", type: "hole", origin: [150, 0, 0] },
    ],
    clear: 77,
    part: { sizes: { "B.diameter": 0.25 } },
  });
  assert.deepEqual(names(store), ["A", "B"]);
  assert.match(program(store), /G38\.3 X0 Y0 Z77/);
  store.bringFeature(1);
  assert.equal(store.get("part.sizes.diameter"), 0.25);
  const { format, clear, part, cycles } = store.job;
  assert.deepEqual(
    [
      format,
      clear,
      part.sizes,
      cycles.map((/** @type {any} */ c) => [c.name, c.type]),
    ],
    [
      2,
      77,
      { "B.diameter": 0.25 },
      [
        ["A", "hole"],
        ["B", "hole"],
      ],
    ],
  );
  store.clearAt(20);
  assert.match(said(store, "clear").join(), /moves across at 20 mm/);
});

test("a name that is taken for a while took the datum with it", () => {
  const store = opened({
    format: 2,
    control: { workOffset: 1 },
    cycles: [
      { name: "A", type: "hole" },
      { name: "B", type: "hole", origin: [150, 0, 0] },
    ],
    datum: { x: "A.center.x", y: "A.center.y" },
  });
  store.bringFeature(1);
  rename(store, "A");
  assert.match(store.withheld, /have the same name, A/);
  rename(store, "C");
  assert.deepEqual(names(store), ["A", "C"]);
  assert.deepEqual(store.job.datum, { x: "A.center.x", y: "A.center.y" });
});

test("cycles without a name are called as everywhere else, and keep their sizes and what is written from them", () => {
  const store = opened({
    format: 2,
    control: { workOffset: 1 },
    cycles: [
      { type: "hole" },
      { name: "BORE", type: "hole", origin: [100, 0, 0] },
    ],
    datum: { x: "BORE.center.x", y: "BORE.center.y" },
    part: { sizes: { "BORE.diameter": 0.1 } },
  });
  assert.deepEqual(names(store), ["BORE2", "BORE"]);
  const { cycles, datum, part } = store.job;
  assert.deepEqual(
    [cycles.length, datum.x, part.sizes],
    [2, "BORE.center.x", { "BORE.diameter": 0.1 }],
  );
});

test("a list of no cycle is refused, and the last one in the program stays there", () => {
  const store = begun("hole");
  add(store, "web", { "origin[0]": 120 });
  const before = structuredClone(store.job);
  assert.throws(
    () => store.open(read('{"format":2,"cycles":[]}')),
    /Nothing was changed/,
  );
  assert.deepEqual(store.job, before);
  add(store, "hole", { "origin[0]": 240 });
  assert.deepEqual(names(store), ["BORE", "WEB", "BORE2"]);
  store.switchFeature(2);
  store.switchFeature(0);
  store.removeFeature(1);
  assert.equal(store.job.cycles.length, 1);
});

test("a relation between two cycles is computed, written from, left out and gone with its cycle", () => {
  const store = begun("hole", 1);
  add(store, "hole", { "origin[0]": 90 });
  relate(store, "line", ["BORE", "BORE2"]);
  store.relate((/** @type {any} */ features) =>
    features.changeRelation(0, { name: "ROW" }),
  );
  store.writeFrom("rotation", "ROW.rotation");
  assert.match(program(store), /#<row_distance>=\[SQRT\[/);
  assert.match(program(store), /G10 L2 P1 R\[/);
  const distance = store.plan.results.find(
    (/** @type {any} */ row) => row.code === "distance",
  );
  assert.deepEqual([distance.unit, distance.value], ["mm", 90]);
  store.bringFeature(0);
  store.duplicateFeature(0);
  store.put("cycle.origin[1]", 80);
  relate(store, "pitch-circle", ["BORE", "BORE3", "BORE2"]);
  assert.match(program(store), /#<rel1_diameter>=/);
  store.switchFeature(1);
  assert.doesNotMatch(program(store), /rel1_/, "left out with its cycle");
  store.removeFeature(1);
  assert.equal(store.features.relations.length, 1, "gone with its cycle");
});

test("a relation that takes a taken name for a while keeps what is written from it", () => {
  const store = begun("hole", 1);
  add(store, "hole", { "origin[0]": 90 });
  for (const _ of [1, 2]) relate(store, "line", ["BORE", "BORE2"]);
  const call = (/** @type {number} */ index, /** @type {string} */ name) =>
    store.relate((/** @type {any} */ features) =>
      features.changeRelation(index, { name }),
    );
  call(0, "ROW");
  store.writeFrom("rotation", "REL2.rotation");
  call(1, "ROW");
  call(1, "LINE");
  assert.notEqual(
    store.features.datum.rotation,
    "ROW.rotation",
    "never from the other one",
  );
});

test("a rotation and a size follow results of earlier cycles, and keep to them when those are renamed", () => {
  const store = begun("hole");
  add(store, "wall-angle", { "origin[1]": -45, rotation: -90 });
  add(store, "groove", { "origin[0]": 100 });
  type(store, "cycle.rotation", "=WALL.rotation+90");
  assert.match(program(store), /X\[\d+-\d+\*#<\w+_sin>\]|#<\w+_cos>/);
  store.bringFeature(1);
  rename(store, "SIDE");
  store.bringFeature(2);
  assert.equal(store.get("cycle.rotation"), "=SIDE.rotation+90");
  store.put("cycle.rotation", 0);
  type(store, "cycle.width", "=BORE.diameter+5");
  assert.match(program(store), /\+0\.5\*#<\w+_growth_1>/);
});

test("a cycle follows a relation of the cycles before it, by its name of the day", () => {
  const store = begun("hole");
  add(store, "hole", { "origin[0]": 90 });
  relate(store, "line", ["BORE", "BORE2"]);
  add(store, "groove", { "origin[1]": 80 });
  type(store, "cycle.rotation", "=REL1.rotation+90");
  assert.match(
    program(store),
    /#<rel1_rotation>[\s\S]*#<groove_turned_by>/,
    "computed before the groove",
  );
  store.relate((/** @type {any} */ features) =>
    features.changeRelation(0, { name: "ROW" }),
  );
  assert.equal(store.get("cycle.rotation"), "=ROW.rotation+90");
});

test("a place follows a result of an earlier cycle, and keeps to it when that is renamed", () => {
  const store = begun("surface", 1);
  store.put("cycle.origin[0]", -40);
  add(store, "hole", { "origin[0]": 0 });
  store.put("limits.position", 1);
  type(store, "cycle.origin[2]", "=SURFACE.z-2");
  assert.match(program(store), /G38\.3 X0 Y0 Z\[-12\+#<bore_shift_z>\]/);
  store.bringFeature(0);
  rename(store, "TOP");
  store.bringFeature(1);
  assert.equal(store.get("cycle.origin[2]"), "=TOP.z-2");
  assert.match(
    program(store),
    /TOP\.point\.z is #<top_point_z>, more than 1 from 0/,
  );
  // A number can be restored like any other value.
  store.put("cycle.origin[2]", -2);
  assert.doesNotMatch(program(store), /shift_z/);
});

test("another feature is placed beside what is there, as large as the last of its kind, and begins without an error", () => {
  const types = catalog()
    .cycles.filter(({ maxTouches }) => maxTouches > 0)
    .map(({ type }) => type);
  for (const plane of ["G17", "G18", "G19"])
    for (const first of ["hole", "internal-rectangle-protected", "boss"])
      for (const type of types) {
        const store = begun(first);
        store.put("plane", plane);
        store.addFeature(type);
        assert.equal(store.withheld, null, `${plane} ${first} ${type}`);
        store.addFeature(type);
        assert.equal(store.withheld, null, `${plane} ${first} ${type} twice`);
      }
  const store = begun("hole");
  type(store, "cycle.diameter", "12 H7");
  store.addFeature("surface");
  store.addFeature("hole");
  assert.equal(store.get("cycle.diameter"), "12 H7");
  assert.ok(store.get("cycle.origin[0]") > 20);
  // An existing error does not cause another one.
  type(store, "cycle.depth", "-1");
  store.addFeature("hole");
  assert.deepEqual(names(store), ["BORE", "SURFACE", "BORE2", "BORE3"]);
});

test("a ready set-up is for the machine of the job, in its units, and without an error", () => {
  const begunWith = new Set();
  for (const { id, workOffsets } of catalog().posts)
    for (const units of ["mm", "inch"])
      for (const plane of ["G17", "G18", "G19"])
        for (const workOffset of [null, 1])
          for (const setUp of SET_UPS) {
            const store = begun("hole");
            store.setUnits(units);
            store.chooseControl(id);
            if (workOffsets > 0) store.put("control.workOffset", workOffset);
            store.put("plane", plane);
            store.put("stylus.diameter", units === "mm" ? 5 : 0.2);
            if (!ready(store).includes(setUp.key)) continue;
            if (plane === "G17") begunWith.add(`${setUp.key} ${id}`);
            store.beginSetUp(setUp.key);
            const name = `${id} ${units} ${plane} ${setUp.key}`;
            assert.equal(store.withheld, null, name);
            assert.equal(store.get("control.post"), id);
            assert.equal(
              store.get("stylus.diameter"),
              units === "mm" ? 5 : 0.2,
            );
            assert.equal(store.units, units);
            // The program writes what the card promises, from the stated sources.
            const { x, y, z } = setUp.job.datum ?? {};
            const { datum = {}, control } = store.job;
            assert.deepEqual([datum.x, datum.y, datum.z], [x, y, z], name);
            assert.equal(control.workOffset, setUp.writes ? 1 : null, name);
            const written = store.plan.results
              .map((/** @type {any} */ { code }) => code)
              .filter((/** @type {string} */ code) =>
                /^offset\.[xyz]$/.test(code),
              );
            assert.equal(
              written.length,
              [x, y, z].filter(Boolean).length,
              `${name}: ${written}`,
            );
            store.undo();
            assert.equal(store.features.several, false);
          }
  // Set-ups with followed results are for controls that compute; a report is for every control.
  for (const post of ["linuxcnc", "sinumerik", "fanuc", "haas"])
    for (const { key } of SET_UPS)
      assert.ok(begunWith.has(`${key} ${post}`), `${key} ${post}`);
  for (const { id } of catalog().posts)
    assert.ok(begunWith.has(`first-article ${id}`), id);
});

test("a set-up that native cycles cannot do is in moves, and says so", () => {
  const store = begun("hole");
  store.chooseControl("haas");
  store.put("control.form", "cycle");
  const told = listen(store);
  store.beginSetUp("vise");
  assert.equal(store.get("control.form"), "moves");
  assert.match(told.join(), /The program uses moves/);
});

test("a ready set-up is not offered where the page around fixes what it would change", () => {
  const store = begun("hole", 1);
  const offered = (/** @type {object} */ config) => {
    assert.deepEqual(
      store.outside.input("config", { format: 1, ...config }),
      [],
    );
    return ready(store);
  };
  const all = SET_UPS.map(({ key }) => key);
  assert.deepEqual(offered({}), all);
  assert.deepEqual(offered({ allow: { setUps: false } }), []);
  // Two of them need a limit of the position; the report and the drift check write no work offset.
  const locked = { locked: true };
  assert.deepEqual(offered({ fields: { "limits.position": locked } }), [
    "plate",
    "first-article",
    "drift",
  ]);
  assert.deepEqual(offered({ allow: { workOffsets: [1] } }), [
    "vise",
    "bore-and-top",
    "plate",
  ]);
  store.put("control.workOffset", null);
  assert.ok(offered({ allow: { workOffsets: [null, 2] } }).includes("vise"));
  offered({ fields: { "limits.position": locked, "cycle.origin": locked } });
  const before = JSON.stringify(store.job);
  store.follow("cycle.origin[2]", "=TOP.point.z");
  assert.equal(JSON.stringify(store.job), before);
});

test("another feature leaves what belongs to the place or the fault of the last one", () => {
  const store = begun("hole");
  store.put("cycle.touches", [
    { point: [12.5, 0, -10], vector: [-1, 0, 0] },
    { point: [-12.5, 0, -10], vector: [1, 0, 0] },
    { point: [0, 12.5, -10], vector: [0, -1, 0] },
  ]);
  store.addFeature("hole");
  assert.equal(store.get("cycle.touches"), undefined);
  const wrong = begun("hole");
  type(wrong, "cycle.diameter", "25 Q9");
  wrong.addFeature("hole");
  assert.equal(wrong.get("cycle.diameter"), 40);
  assert.ok(wrong.get("cycle.origin[0]") > 20);
});

test("a place that follows a result has a limit, proposed and said", () => {
  for (const [units, limit] of [
    ["mm", 2],
    ["inch", 0.08],
  ]) {
    const store = begun("surface");
    store.setUnits(units);
    store.addFeature("hole");
    const before = store.get("cycle.origin[2]");
    const told = listen(store);
    store.follow("cycle.origin[2]", "=SURFACE.point.z");
    assert.equal(store.withheld, null);
    assert.equal(store.get("limits.position"), limit);
    const says = `SURFACE.point.z is followed up to ${limit} ${units} away`;
    assert.ok(told.join().includes(says), told.join());
    store.undo();
    assert.deepEqual(
      [store.get("cycle.origin[2]"), store.get("limits.position")],
      [before, null],
    );
  }
});

test("what a missing limit is about was shown, not the limit: its empty field is", () => {
  const store = begun("surface");
  store.addFeature("hole");
  for (const [path, result, limit] of [
    ["cycle.origin[2]", "=SURFACE.point.z", "limits.position"],
    ["cycle.origin[2]", "=SURFACE.point.y", null],
  ]) {
    store.put("limits.position", null);
    store.put(path, result);
    const finding = store.findings.find(
      (/** @type {any} */ { level }) => level === "error",
    );
    assert.equal(store.fieldOf(finding), limit ?? finding.path);
    assert.notEqual(store.fieldOf({ ...finding, message: "" }), limit);
  }
});

test("the stock of a ready set-up fits its features, and those that are added", () => {
  const store = begun("hole");
  assert.equal(store.get("stock") ?? null, null);
  store.beginSetUp("plate");
  const [low, size] = [store.get("stock.origin"), store.get("stock.size")];
  // Bores of 12 at ±40 and ±25, and 10 mm around them.
  assert.deepEqual(
    [low.slice(0, 2), size.slice(0, 2)],
    [
      [-56, -41],
      [112, 82],
    ],
  );
  assert.equal(low[2] + size[2], 0, "its top is the top of the bores");
  store.addFeature("hole");
  const wider = store.get("stock.size");
  assert.ok(wider[0] > size[0] && wider[1] === size[1], wider);
  assert.equal(store.withheld, null);
  store.undo();
  assert.deepEqual(store.get("stock.size"), size);
  // A typed one stays as it is.
  type(store, "stock.size[0]", "150");
  store.addFeature("hole");
  assert.equal(store.get("stock.size[0]"), 150);
});

test("a stock is converted, saved with the program and given back by it", () => {
  const store = begun("hole");
  store.put("stock", { origin: [-50, -40, -25.4], size: [100, 80, 25.4] });
  store.setUnits("inch");
  assert.equal(store.get("stock.size[2]"), 1);
  const again = new Store();
  again.open(read(program(store)));
  assert.deepEqual(again.get("stock"), store.get("stock"));
  // The surface is 6 mm below the top of this block.
  const low = begun("surface");
  low.put("stock", { origin: [-50, -50, -20], size: [100, 100, 26] });
  assert.deepEqual(
    low.findings
      .filter((/** @type {any} */ { level }) => level === "error")
      .map((/** @type {any} */ { code, path }) => [code, path]),
    [["collision", "stock"]],
  );
});

test("a stock without a size has the default one, in the units of the job", () => {
  for (const [units, size] of /** @type {const} */ ([
    ["mm", [100, 100, 20]],
    ["inch", [3.937008, 3.937008, 0.787402]],
  ])) {
    const store = opened({
      format: 1,
      units,
      stock: { origin: [0, 0, 0] },
      cycle: { type: "hole" },
    });
    assert.deepEqual(store.get("stock"), { origin: [0, 0, 0], size }, units);
  }
});
