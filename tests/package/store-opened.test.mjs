// Jobs and programs from outside: a valid one is loaded whole, an invalid one changes nothing and is reported.
import assert from "node:assert/strict";
import { test } from "node:test";
import { defaultJob, plan } from "touchpath";
import { asInBrowser, program, read, Store, setUp, type } from "./state.mjs";

setUp();

/** Jobs that the form cannot show, each with the path or the word that must be named. @type {[string, object][]} */
const unusable = [
  ["cycle.touches", { format: 1, cycle: { type: "boss", touches: "abc" } }],
  [
    "cycle.touches",
    {
      format: 1,
      cycle: { type: "boss", touches: [{ point: [1, 2], vector: [0, 0, 1] }] },
    },
  ],
  ["cycle.custom", { format: 1, cycle: { type: "boss", custom: 5 } }],
  ["cycle.properties", { format: 1, cycle: { type: "boss", properties: [] } }],
  ["cycle.origin", { format: 1, cycle: { type: "boss", origin: "here" } }],
  ["cycle.depth", { format: 1, cycle: { type: "boss", depth: { mm: 5 } } }],
  ["cycle.type", { format: 1, cycle: { type: "bogus" } }],
  ["cycle", { format: 1, cycle: [] }],
  ["tool.frame", { format: 1, cycle: { type: "boss" }, tool: { frame: 5 } }],
  [
    "tool.frame",
    { format: 1, cycle: { type: "boss" }, tool: { frame: ["X"] } },
  ],
  ["part", { format: 1, cycle: { type: "boss" }, part: 5 }],
  [
    "part.sizes",
    { format: 1, cycle: { type: "boss" }, part: { sizes: { diameter: [] } } },
  ],
  ["feeds", { format: 1, cycle: { type: "boss" }, feeds: "x" }],
  ["feeds.work", { format: 1, cycle: { type: "boss" }, feeds: { work: [] } }],
  ["newer", { format: 3, cycle: { type: "boss" } }],
  ["format", { cycle: { type: "boss" } }],
];

test("a file that the form cannot show left three cycles at once: it changes nothing, and its path is named", () => {
  const store = new Store();
  type(store, "cycle.width1", "71");
  const before = [structuredClone(store.draft), program(store)];
  for (const [path, job] of unusable) {
    const open = () => store.open(read(JSON.stringify(job)));
    assert.throws(open, (/** @type {any} */ thrown) => {
      const why = store.why(thrown);
      assert.match(why, /Nothing was changed/, path);
      assert.ok(why.includes(path), `${path}: ${why}`);
      return true;
    });
    assert.deepEqual([store.draft, program(store)], before, path);
  }
});

test("a stored state that the form cannot show left an empty page: the defaults stand, and the store says so", () => {
  for (const [path, draft] of unusable)
    asInBrowser(
      { "touchpath.job.1": JSON.stringify({ draft, typed: 7 }) },
      () => {
        const store = new Store({ local: true });
        assert.ok(store.say(store.notice).includes(path), path);
        assert.equal(
          store.get("cycle.type"),
          "internal-rectangle-protected",
          path,
        );
        assert.equal(store.stale, false, path);
      },
    );
});

test("kept text that cannot be read was passed over in silence", () => {
  asInBrowser({ "touchpath.job.1": "{" }, () => {
    const store = new Store({ local: true });
    assert.match(
      store.say(store.notice),
      /The state stored in this browser cannot be used/,
    );
    assert.equal(store.get("cycle.width1"), 80);
  });
});

test("a kept form that is no such form is left out, and the rest is there", () => {
  const points = { mm: "", inch: "" };
  const left = [
    ["hole", { units: "mm", cycle: { type: "hole", touches: "abc" }, points }],
    ["web", { units: "mm", cycle: { type: "groove", width: 3 }, points }],
    [
      "groove",
      {
        units: "mm",
        cycle: { ...defaultJob("groove").cycle, width: 33 },
        points,
      },
    ],
    ["surface", null],
    7,
  ];
  const state = JSON.stringify({ draft: defaultJob("boss"), typed: [], left });
  asInBrowser({ "touchpath.job.1": state }, () => {
    const store = new Store({ local: true });
    assert.equal(store.notice, null);
    assert.equal(store.get("cycle.type"), "boss");
    for (const [type, key, value] of /** @type {const} */ ([
      ["groove", "cycle.width", 33],
      ["web", "cycle.width", 30],
      ["hole", "cycle.diameter", 40],
    ])) {
      store.choose(type);
      assert.equal(store.get(key), value, type);
    }
  });
});

test("the page could not leave a job that says only its cycle", () => {
  const store = new Store();
  store.open(read('{"format":1,"cycle":{"type":"hole"}}'));
  assert.match(program(store), /type 3:/);
  store.choose("boss");
  assert.equal(store.get("cycle.type"), "boss");
  assert.match(program(store), /type 5:/);
  store.setUnits("inch");
  assert.match(program(store), /G20/);
});

test("what a job leaves out is at the catalog's default in the job's own units, as in the package", () => {
  /** @type {any[]} */
  const jobs = [
    { format: 1, cycle: { type: "hole" }, part: null, feeds: {}, tool: null },
    { format: 1, units: "inch", cycle: { type: "hole", diameter: 1.5 } },
    {
      format: 1,
      cycle: {
        type: "probing-two-circles",
        probe: { feed: 100 },
        extrusion: { points: 3 },
      },
    },
  ];
  for (const job of jobs) {
    const { part, tool, ...sound } = job;
    const store = new Store();
    store.open(read(JSON.stringify(job)));
    const wanted = plan(part === null ? sound : job);
    assert.equal(store.plan.program.post, wanted.program.post);
    assert.equal(store.plan.moves.length, wanted.moves.length);
    // Converted defaults are rounded to a millionth.
    wanted.moves.forEach(({ to, feed }, k) => {
      assert.equal(store.plan.moves[k].feed, feed);
      for (const [i, x] of to.entries())
        assert.ok(
          Math.abs(store.plan.moves[k].to[i] - x) < 5e-6,
          `move ${k + 1} of ${JSON.stringify(job)}`,
        );
    });
  }
});

test("measured points stayed across a change of cycle and units: they belong to the job they were entered for", () => {
  const points = "37.1,0,-10\n-36.9,0,-10\n0,22,-10\n0,-22,-10";
  const store = new Store();
  store.measured = points;
  store.choose("surface");
  assert.equal(store.measured, "");
  store.choose("internal-rectangle-protected");
  assert.equal(store.measured, points, "they come back with their form");
  store.setUnits("inch");
  assert.equal(store.measured, "", "in inches they would be other points");
  store.setUnits("mm");
  assert.equal(store.measured, points);
  store.open(
    read('{"format":1,"cycle":{"type":"internal-rectangle-protected"}}'),
  );
  assert.equal(store.measured, "");
});

test("a key that no job has is taken out, and comes back when that is taken back", () => {
  const store = new Store();
  store.open(
    read(
      '{"format":1,"colour":"red","cycle":{"type":"groove","width":41,"sideClearance":1}}',
    ),
  );
  assert.equal(store.get("cycle.width"), 41);
  const unknown = () =>
    store.findings.filter((/** @type {any} */ f) => f.code === "unknown-key");
  for (let left = 2; left > 0; left--) {
    assert.equal(unknown().length, left);
    assert.ok(store.stale);
    store.drop(unknown()[0].path);
  }
  assert.equal(store.withheld, null);
  assert.match(program(store), /G38\.2/);
  store.undo();
  assert.equal(unknown().length, 1);
});
