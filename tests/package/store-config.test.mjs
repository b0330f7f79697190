// Rules of a portal: filled-in and fixed values, independent of the order of inputs.
import assert from "node:assert/strict";
import { test } from "node:test";
import { Store, setUp } from "./state.mjs";

setUp();

const HALL = {
  format: 1,
  title: "Hall 3",
  allow: {
    cycles: ["hole", "web"],
    controls: ["haas", "fanuc"],
    units: ["mm"],
    workOffsets: [1, 2],
    setUps: false,
  },
  hide: { panels: ["checks"] },
  fields: {
    "feeds.work": {
      value: 100,
      locked: true,
      reason: "the probe was calibrated at it",
    },
    "control.tool": { value: 99, hidden: true },
    "cycle.depth": { value: 7 },
  },
  machines: [
    { name: "VF-2", control: { post: "haas", tool: 25 }, overtravel: 4 },
  ],
  styli: [{ name: "Ball 4", diameter: 4 }],
};

/** What the element gives its store, as the host page sets it: each input in its turn. */
function given(/** @type {[string, unknown][]} */ ...inputs) {
  const store = new Store();
  for (const [input, value] of inputs)
    assert.deepEqual(store.outside.input(input, value), [], input);
  return store;
}

const errors = (/** @type {any} */ store) =>
  store.findings.flatMap((/** @type {any} */ f) =>
    f.level === "error" ? [`${f.code} ${f.path}`] : [],
  );

test("a job begins with what the config allows and fills in", () => {
  const store = given(["config", HALL]);
  const { cycle, feeds, control } = store.job;
  assert.deepEqual(
    [
      cycle.type,
      cycle.depth,
      feeds.work,
      control.post,
      control.tool,
      control.workOffset,
    ],
    ["hole", 7, 100, "haas", 99, 1],
  );
  assert.deepEqual(errors(store), []);
  assert.equal(store.plan.program.post, "haas");
});

test("a job of the portal's that breaks its own rules has no program until it is put right", () => {
  const store = given(
    ["config", HALL],
    [
      "job",
      {
        format: 1,
        cycle: { type: "hole" },
        feeds: { work: 300 },
        control: { post: "heidenhain" },
      },
    ],
  );
  assert.deepEqual(errors(store), [
    "not-allowed control.post",
    "locked feeds.work",
  ]);
  assert.ok(store.stale);
  assert.match(
    store.at("feeds.work")[0].message,
    /^Hall 3 fixes Work feed at 100 mm\/min/,
  );
  store.set("feeds.work", 100, "100");
  assert.deepEqual(errors(store), ["not-allowed control.post"]);
  store.set("feeds.work", 90, "90");
  assert.equal(
    store.get("feeds.work"),
    100,
    "it has the value that it must have",
  );
  store.chooseControl("haas");
  assert.deepEqual(errors(store), []);
  assert.ok(store.plan.program.text.length > 100);
});

test("machines and styli of the portal are taken into the job, and the rest of it stays", () => {
  const store = given(["config", HALL]);
  store.usePreset(store.rules.machines[0]);
  assert.deepEqual(
    [
      store.get("control.tool"),
      store.get("overtravel"),
      store.get("control.workOffset"),
    ],
    [25, 4, 1],
  );
  store.useStylus(store.rules.styli("mm")[0].stylus);
  assert.deepEqual(
    [store.get("stylus.diameter"), store.get("stylus.repeatability")],
    [4, 0.001],
  );
  store.undo();
  assert.equal(store.get("stylus.diameter"), 6);
});

test("the order in which job and config are set does not matter, and what the user has typed is not filled over", () => {
  const job = { format: 1, name: "A", cycle: { type: "web", width: 20 } };
  const result = (/** @type {any} */ store) => [
    store.job.control.post,
    store.job.cycle.depth,
    store.job.feeds.work,
    store.findings.map((/** @type {any} */ f) => f.code).sort(),
  ];
  const first = given(["config", HALL], ["job", job]);
  const last = given(["job", job], ["config", JSON.stringify(HALL)]);
  assert.deepEqual(result(first), result(last));
  assert.deepEqual(result(first).slice(0, 3), ["haas", 7, 100]);
  last.set("cycle.width", 21, "21");
  assert.deepEqual(
    last.outside.input("config", {
      ...HALL,
      fields: { "cycle.depth": { value: 3 } },
    }),
    [],
  );
  assert.equal(last.get("cycle.depth"), 7);
});

test("a config that is wrong changes nothing, and every fault of it is said", () => {
  const store = given(["config", HALL]);
  const faults = store.outside.input("config", {
    format: 1,
    tilte: "A",
    allow: { cycles: ["well"] },
  });
  assert.deepEqual(
    faults.map((/** @type {any} */ f) => `${f.code} ${f.path}`),
    ["unknown-key config.tilte", "unknown-value config.allow.cycles[0]"],
  );
  assert.equal(store.rules.config.title, "Hall 3");
  assert.equal(store.outside.input("config", "{")[0].code, "not-json");
  assert.equal(store.rules.config.title, "Hall 3");
});

test("a config that fills in nothing holds for the job that was set before it", () => {
  const store = given(
    [
      "job",
      { format: 1, cycle: { type: "web", width: 20 }, feeds: { work: 150 } },
    ],
    ["config", { format: 1, findings: [{ message: "The order is closed" }] }],
  );
  assert.deepEqual(errors(store), ["portal "]);
  assert.ok(store.stale);
  store.outside.input("config", {
    format: 1,
    fields: { "feeds.work": { value: 100 } },
  });
  assert.deepEqual(
    [errors(store), store.get("feeds.work")],
    [[], 150],
    "what the job says stays",
  );
  store.outside.release("config");
  // The job that is already shown still belongs to the portal.
  store.outside.input("job", structuredClone(store.job));
  store.outside.input("config", {
    format: 1,
    fields: { "feeds.work": { value: 90 } },
  });
  assert.equal(store.get("feeds.work"), 150);
});

test("nothing that the user does changes a fixed field", () => {
  const fields = {
    "cycle.diameter": { locked: true },
    "stylus.diameter": { value: 5, locked: true },
    "part.rotation": { locked: true },
  };
  const styli = [{ name: "Ball 4", diameter: 4, length: 30 }];
  const machines = [{ name: "VF-2", stylus: { diameter: 3, shank: 2 } }];
  const store = given(
    ["config", { format: 1, fields, styli, machines }],
    ["cycle", "hole"],
  );
  const now = () =>
    ["cycle.diameter", "stylus.diameter", "part.rotation"].map((path) =>
      store.get(path),
    );
  const before = now();
  assert.equal(before[1], 5);
  store.useStylus(store.rules.styli("mm")[0].stylus);
  assert.deepEqual([now(), store.get("stylus.length")], [before, 30]);
  store.usePreset(store.rules.machines[0]);
  assert.deepEqual([now(), store.get("stylus.shank")], [before, 2]);
  store.set("cycle.diameter", 60);
  store.put("part", { offset: [1, 0, 0], rotation: 3, sizes: {} });
  store.set("cycle.diameter", "25 H7");
  assert.deepEqual([now(), store.get("part.offset[0]")], [before, 1]);
  store.reset();
  assert.deepEqual(now(), before);
  // Other units convert it, to the last digit.
  store.setUnits("inch");
  assert.deepEqual(errors(store), []);
  assert.equal(store.get("stylus.diameter"), 0.19685);
});

test("the defaults of a cycle are for a control that is allowed, in a form that it has", () => {
  for (const controls of [
    ["grbl"],
    ["linuxcnc"],
    ["sinumerik"],
    ["heidenhain"],
    ["haas", "heidenhain"],
  ]) {
    const store = given(
      ["config", { format: 1, allow: { controls } }],
      ["cycle", "probing-two-circles"],
    );
    store.reset();
    assert.deepEqual(
      [controls.includes(store.get("control.post")), store.stale],
      [true, false],
      `${controls}`,
    );
  }
});

test("a control that the config fills in is that of a new job, and one that is asked for goes before it", () => {
  const fields = { "control.post": { value: "haas" } };
  for (const rules of [
    { fields },
    { allow: { controls: ["linuxcnc", "haas"] }, fields },
  ]) {
    const store = given(["config", { format: 1, ...rules }], ["cycle", "hole"]);
    assert.equal(store.get("control.post"), "haas");
    store.reset();
    assert.equal(store.get("control.post"), "haas");
  }
  assert.equal(
    given(["config", { format: 1, fields }], ["post", "fanuc"]).get(
      "control.post",
    ),
    "fanuc",
  );
});

test("a path beyond the travel of the machine is planned, and has no program", () => {
  const store = given([
    "config",
    {
      format: 1,
      space: { travel: { min: [-20, -20, -100], max: [20, 20, 100] } },
    },
  ]);
  assert.ok(errors(store).length > 0);
  assert.ok(
    errors(store).every(
      (/** @type {string} */ error) => error === "beyond-travel cycle",
    ),
  );
  assert.ok(store.stale);
  assert.match(store.withheld, /beyond the travel/);
  store.outside.release("config");
  assert.deepEqual(errors(store), []);
});
