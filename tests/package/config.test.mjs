// A portal's config: functions, schema, command. tests/all/config.rs tests its refusals.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { Ajv2020 } from "ajv/dist/2020.js";
import { at } from "../../scripts/lib.mjs";
import { file, run, setUp, touchpath } from "./command.mjs";

setUp();

/** @type {any} */
const GOOD = {
  format: 1,
  title: "Hall 3",
  units: "mm",
  allow: {
    cycles: ["hole", "web"],
    controls: ["haas", "fanuc"],
    forms: ["moves"],
    units: ["mm", "inch"],
    workOffsets: [null, 1, 2],
    setUps: true,
  },
  hide: { cycles: ["web"], controls: [], panels: ["table"] },
  fields: {
    "feeds.work": { value: 100, locked: true, reason: "calibrated" },
    "control.tool": { value: 99, hidden: true },
    overtravel: { min: 2, max: 8 },
  },
  machines: [
    {
      name: "VF-2",
      control: { post: "haas", tool: 25 },
      feeds: { approach: null },
      overtravel: 4,
    },
  ],
  styli: [{ name: "M4 ball 4", diameter: 4, length: 40, shank: 2.5 }],
  space: {
    zero: [0, 0, 0],
    travel: { min: [-500, -500, -500], max: [500, 500, 500] },
    keepOut: [{ name: "vise", min: [100, -50, -50], max: [200, 50, 50] }],
  },
  findings: [{ level: "info", path: "stylus", message: "Use probe 7" }],
};
/** @type {any} */
const HOLE = { format: 1, cycle: { type: "hole", diameter: 25 } };

test("the functions plan a job under a config, and say everything at once", () => {
  const plain = touchpath.plan({
    ...HOLE,
    control: { post: "haas", tool: 99 },
    feeds: { work: 100 },
  });
  const made = touchpath.plan(HOLE, GOOD);
  assert.equal(made.program.text, plain.program.text);
  assert.equal(touchpath.program(HOLE, GOOD).text, plain.program.text);
  const own = made.findings.at(-1);
  assert.deepEqual(
    [own?.code, own?.level, own?.message],
    ["portal", "info", "Use probe 7"],
  );
  assert.deepEqual(touchpath.configured(HOLE, GOOD).control, {
    post: "haas",
    tool: 99,
  });
  const bad = {
    ...HOLE,
    cycle: { type: "boss", diameter: -1 },
    feeds: { work: 90 },
    overtravel: 9,
  };
  const codes = (/** @type {any[]} */ findings) =>
    findings
      .filter((f) => f.level === "error")
      .map((f) => `${f.code} ${f.path}`);
  const expected = [
    "out-of-range cycle.diameter",
    "not-allowed cycle.type",
    "locked feeds.work",
    "not-allowed overtravel",
  ];
  assert.deepEqual(codes(touchpath.check(bad, GOOD)), expected);
  assert.throws(
    () => touchpath.plan(/** @type {any} */ (bad), GOOD),
    (/** @type {any} */ error) =>
      error instanceof touchpath.JobError &&
      codes(error.findings).join() === expected.join(),
  );
  const outcomes = [
    ...touchpath.programs(/** @type {any} */ ([HOLE, bad, HOLE]), GOOD),
  ];
  assert.deepEqual(
    outcomes.map(({ program }) => program?.post ?? null),
    ["haas", null, "haas"],
  );
  assert.deepEqual(codes(outcomes[1]?.findings ?? []), expected);
  // Without a config nothing is filled in or refused.
  assert.equal(touchpath.plan(HOLE).program.post, "linuxcnc");
});

test("a wrong config is refused by every function that takes one, and by the schema", () => {
  const ajv = new Ajv2020({ strict: true, allowUnionTypes: true });
  const schema = JSON.parse(
    readFileSync(at("dist", "config.schema.json"), "utf8"),
  );
  const fits = ajv.compile(schema);
  assert.deepEqual(
    [touchpath.checkConfig(GOOD), fits(GOOD), fits.errors],
    [[], true, null],
  );
  assert.deepEqual(
    [touchpath.checkConfig({ format: 1 }), fits({ format: 1 })],
    [[], true],
  );
  /** @type {[string, unknown][]} */
  const changes = [
    ["format", 2],
    ["format", undefined],
    ["title", 5],
    ["title", "x".repeat(61)],
    ["units", "cm"],
    ["other", 1],
    ["allow", []],
    ["allow.cycles", ["well"]],
    ["allow.cycles", []],
    ["allow.controls", "haas"],
    ["allow.forms", ["both"]],
    ["allow.units", ["mm", "cm"]],
    ["allow.workOffsets", [0]],
    ["allow.workOffsets", [1.5]],
    ["allow.workOffsets", []],
    ["allow.setUps", "no"],
    ["allow.other", 1],
    ["hide.cycles", ["well"]],
    ["hide.panels", ["picture"]],
    ["fields", []],
    ["fields.overtravel", 5],
    ["fields.overtravel.min", "2"],
    ["fields.overtravel.max", null],
    ["fields.overtravel.locked", 1],
    ["fields.overtravel.reason", "x".repeat(201)],
    ["fields.overtravel.least", 1],
    ["machines", {}],
    ["machines", [{ control: {} }]],
    ["machines", [{ name: " " }]],
    ["machines", [{ name: "A", cycle: {} }]],
    ["machines", [{ name: "A", feeds: { wrok: 1 } }]],
    ["styli", [{ name: "A", diametre: 1 }]],
    ["space.zero", [0, 0]],
    ["space.travel", { min: [0, 0, 0] }],
    ["space.keepOut", [{ min: [0, 0, 0], max: [1, 1, 1] }]],
    ["space.keepOut", [{ name: "A", min: [0, 0, "0"], max: [1, 1, 1] }]],
    ["space.travel.max", [500, 500, 200_000]],
    ["machines", [{ name: "\u0085\ufeff" }]],
    ["findings", [{ level: "info" }]],
    ["findings", [{ level: "fatal", message: "m" }]],
    ["findings", [{ message: "m", text: "m" }]],
  ];
  for (const [path, value] of changes) {
    const config = structuredClone(GOOD);
    const keys = path.split(".");
    const last = String(keys.pop());
    const place = keys.reduce(
      (/** @type {any} */ inside, key) => inside[key],
      config,
    );
    if (value === undefined) delete place[last];
    else place[last] = value;
    const faults = touchpath.checkConfig(config);
    assert.ok(
      faults.some((f) => f.level === "error" && f.path.startsWith("config")),
      `${path} = ${JSON.stringify(value)} is found`,
    );
    assert.ok(
      !fits(config),
      `${path} = ${JSON.stringify(value)} is refused by the schema`,
    );
    assert.throws(() => touchpath.plan(HOLE, config), touchpath.JobError, path);
    assert.throws(
      () => touchpath.configured(HOLE, config),
      touchpath.JobError,
      path,
    );
    assert.deepEqual(touchpath.check(HOLE, config), faults, path);
  }
  // Only the check covers the meaning of a value at its path.
  for (const fields of [
    { "feeds.wrk": {} },
    { "feeds.work": { value: 0 } },
    { overtravel: { min: 3, max: 2 } },
  ])
    assert.equal(touchpath.checkConfig({ format: 1, fields }).length, 1);
  // The lists are those of the catalog.
  const { cycles, posts } = touchpath.catalog();
  const { properties } = schema.properties.allow;
  assert.deepEqual(
    properties.cycles.items.enum,
    cycles.map(({ type }) => type),
  );
  assert.deepEqual(
    properties.controls.items.enum,
    posts.map(({ id }) => id),
  );
});

test("what is no data of a job is refused as what it is, under a config too", () => {
  const found = (/** @type {any} */ job) => touchpath.check(job, { format: 1 });
  for (const job of [
    JSON.parse('{"format":1,"cycle":{"type":"hole"},"__proto__":{"x":1}}'),
    { ...HOLE, name: "x".repeat(3_000_000) },
    { ...HOLE, name: () => 1 },
    { ...HOLE, feeds: { work: 5n } },
  ])
    assert.deepEqual(found(job), touchpath.check(job));
  const thrower = Object.defineProperty({ ...HOLE }, "feeds", {
    enumerable: true,
    get() {
      throw new Error("no");
    },
  });
  assert.ok(found(thrower).some(({ level }) => level === "error"));
});

test("a key that is undefined is not there", () => {
  /** @type {any} */
  const config = {
    format: 1,
    allow: { controls: ["haas"], units: ["inch"], workOffsets: [2] },
  };
  /** @type {any} */
  const job = {
    format: 1,
    units: undefined,
    control: undefined,
    feeds: undefined,
    cycle: { type: "hole" },
  };
  assert.equal(touchpath.plan(job, config).program.post, "haas");
  assert.equal(job.control, undefined, "the job itself is left alone");
});

test("no config, however hostile, gets through a function", () => {
  /** @type {any} */
  const cyclic = { format: 1 };
  cyclic.allow = cyclic;
  const thrower = {
    get format() {
      throw new Error("no");
    },
  };
  const many = {
    format: 1,
    fields: Object.fromEntries(
      Array.from({ length: 100_000 }, (_, i) => [`a${i}`, {}]),
    ),
  };
  const proxy = new Proxy(
    {},
    { ownKeys: () => ["format", "__proto__"], get: () => 1 },
  );
  for (const config of [
    null,
    5,
    "x",
    [],
    () => 1,
    Symbol("s"),
    5n,
    cyclic,
    thrower,
    many,
    proxy,
    new Map(),
  ]) {
    const started = performance.now();
    const faults = touchpath.checkConfig(config);
    assert.ok(
      faults.length > 0 && performance.now() - started < 2000,
      String(typeof config),
    );
    assert.ok(
      touchpath
        .check(HOLE, /** @type {any} */ (config))
        .some(({ level }) => level === "error"),
    );
  }
  const title = {
    format: 1,
    title: "A\n(MSG)\u0000",
    allow: { controls: ["haas"] },
  };
  const text = touchpath.plan(HOLE, /** @type {any} */ (title)).program.text;
  assert.ok(!text.includes("MSG"), "no word of a config stands in a program");
});

test("the command judges jobs by a file of rules", () => {
  const config = file("shop.json", GOOD);
  const good = file("good.json", HOLE);
  const bad = file("bad.json", { ...HOLE, feeds: { work: 90 } });
  const made = run(["plan", good, "--config", config]);
  assert.equal(made.status, 0, made.stderr);
  assert.equal(made.stdout, touchpath.plan(HOLE, GOOD).program.text);
  for (const name of ["plan", "table", "svg"]) {
    const refused = run([name, bad, "--config", config]);
    assert.deepEqual([refused.status, refused.stdout], [1, ""], name);
    assert.match(
      refused.stderr,
      /error: feeds\.work: Hall 3 fixes Work feed at 100 mm\/min: calibrated \[locked\]/,
    );
  }
  assert.equal(run(["check", good, "--config", config]).status, 0);
  assert.match(run(["check", bad, "--config", config]).stdout, /\[locked\]/);
  const lines = run(
    ["plan", "-", "--ndjson", "--jobs", "2", "--config", config],
    `${JSON.stringify(HOLE)}\n`.repeat(3),
  );
  assert.equal(lines.stdout.trim().split("\n").length, 3);
  assert.ok(
    lines.stdout
      .split("\n")
      .filter(Boolean)
      .every((line) => /HAAS|%/.test(JSON.parse(line).program)),
  );
  const wrong = run([
    "plan",
    good,
    "--config",
    file("wrong.json", { format: 1, tilte: "A", allow: { cycles: ["well"] } }),
  ]);
  assert.equal(wrong.status, 2);
  assert.match(
    wrong.stderr,
    /wrong\.json: config\.tilte: .+; config\.allow\.cycles\[0\]: /,
  );
  assert.equal(
    run(["plan", good, "--config", good]).status,
    2,
    "a job is no config",
  );
  assert.equal(
    run(["import", good, "--config", config]).status,
    2,
    "it is for jobs",
  );
});

test("the example of the docs works", () => {
  const docs = readFileSync(at("docs", "embedding.md"), "utf8");
  const config = JSON.parse(
    /<script type="application\/json">([\s\S]+?)<\/script>/.exec(docs)?.[1] ??
      "",
  );
  assert.deepEqual(touchpath.checkConfig(config), []);
  assert.equal(touchpath.plan(HOLE, config).program.post, "haas");
  /** @type {any} */
  const near = {
    format: 1,
    cycle: { type: "hole", diameter: 25, origin: [0, -40, 0] },
    stylus: { length: 50, shank: 4, body: 40 },
  };
  const refused = touchpath
    .check(near, config)
    .filter(({ code }) => code === "keep-out");
  // The zone follows the move in the message.
  assert.deepEqual(
    refused.map(({ path, said }) => [path, said[2]]),
    [["cycle", "vise jaw"]],
  );
});
