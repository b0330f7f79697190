// Values that JavaScript can pass and JSON cannot express: found, never thrown, never endless. And plans, which are plain objects for every reader.
import assert from "node:assert/strict";
import { readdirSync, readFileSync } from "node:fs";
import { test } from "node:test";
import { inspect } from "node:util";
import {
  catalog,
  check,
  defaultJob,
  evaluate,
  importJob,
  JobError,
  measure,
  moveColumns,
  plan,
  program,
  programs,
} from "touchpath";

/** @type {any} */
const anything = check;
const pocket = () =>
  /** @type {any} */ (defaultJob("internal-rectangle-protected"));
const codes = (/** @type {unknown} */ job) =>
  anything(job).map(
    (/** @type {import("touchpath").Finding} */ f) => `${f.code} ${f.path}`,
  );

test("what JSON cannot say is found", () => {
  const broken = (/** @type {(job: any) => void} */ change) => {
    const job = pocket();
    change(job);
    return codes(job);
  };
  /** Findings of the unchanged job. */
  const said = codes(pocket());
  assert.deepEqual(said, ["stylus-not-known stylus.length"]);
  const feeds =
    "format name units plane overtravel stylus feeds limits machine control tool part cycle".split(
      " ",
    );
  assert.deepEqual(
    broken((job) => {
      job.cycle.width1 = Number.NaN;
    }),
    ["not-finite cycle.width1"],
  );
  assert.deepEqual(
    broken((job) => {
      job.overtravel = Number.NEGATIVE_INFINITY;
    }),
    ["not-finite overtravel"],
  );
  assert.deepEqual(
    broken((job) => {
      job.overtravel = 1n;
    }),
    ["wrong-type overtravel"],
  );
  assert.deepEqual(
    broken((job) => {
      job.name = () => 1;
    }),
    ["wrong-type name"],
  );
  assert.deepEqual(
    broken((job) => {
      job.feeds = job;
    }),
    feeds.map((key) => `unknown-key feeds.${key}`),
  );
  assert.deepEqual(
    broken((job) =>
      Object.defineProperty(job, "name", {
        enumerable: true,
        get() {
          throw 1;
        },
      }),
    ),
    ["wrong-type name"],
  );
  assert.deepEqual(
    broken((job) => {
      job.cycle.origin = new Array(4e9 - 5e8);
    }),
    ["wrong-type cycle.origin"],
  );
  // undefined is a missing key, never null: a feed does not become rapid.
  assert.deepEqual(
    broken((job) => {
      job.feeds.approach = undefined;
    }),
    said,
  );
  assert.deepEqual(
    broken((job) => Object.assign(job, { [Symbol("mine")]: 1 })),
    said,
  );
});

test("nothing that can be handed over throws or hangs", () => {
  /** @type {any} */
  const loop = {};
  loop.a = loop;
  loop.cycle = loop;
  /** @type {any} */
  let deep = {};
  for (let i = 0; i < 5000; i++) deep = { cycle: deep };
  /** @type {any} */
  const wide = {};
  for (let i = 0; i < 60_000; i++) wide[`k${i}`] = i;
  const throwing = new Proxy(
    {},
    {
      get() {
        throw 1;
      },
      ownKeys() {
        throw 2;
      },
    },
  );
  const endless = new Proxy(
    {},
    {
      get: () => endless,
      ownKeys: () => ["cycle", "feeds", "part"],
      getOwnPropertyDescriptor: () => ({
        configurable: true,
        enumerable: true,
      }),
    },
  );
  const long = { length: 5, 0: 1 };
  const strange = [
    undefined,
    null,
    7,
    "job",
    Symbol("x"),
    [],
    loop,
    deep,
    wide,
    throwing,
    endless,
    long,
    Object.create(null),
    { format: 1, cycle: new Map([["type", "internal-rectangle-protected"]]) },
    {
      format: 1,
      cycle: {
        type: "double-wall-internal-corner",
        origin: new Float64Array(3),
      },
    },
    {
      format: 1,
      cycle: { type: "hole", origin: new Proxy([], { get: () => Number.NaN }) },
    },
  ];
  for (const value of strange) {
    assert.ok(codes(value).length > 0, inspect(value, { depth: 0 }));
    for (const call of [
      plan,
      program,
      moveColumns,
      (/** @type {any} */ v) => evaluate(pocket(), v),
      (/** @type {any} */ v) => measure(pocket(), v),
    ]) {
      assert.throws(() => call(/** @type {any} */ (value)), JobError);
    }
  }
});

test("texts count in what a job can hold, and halves of characters stay where they are", () => {
  assert.deepEqual(
    codes({ format: 1, name: "x".repeat(50e6), cycle: { type: "hole" } }),
    ["wrong-type name"],
  );
  assert.throws(() => importJob(" ".repeat(50e6)), JobError);
  /** @type {any} */
  const keys = {};
  for (let i = 0; i < 3000; i++) keys["k".repeat(1000) + i] = 1;
  assert.ok(codes(keys).length > 0);
  // A lone surrogate at the end of one text, and the other half at the start of the next.
  const job = {
    format: 1,
    name: "A\ud83d",
    "\ude00b": 1,
    cycle: { type: "hole" },
  };
  assert.deepEqual(codes(job).sort(), [
    "name-changed name",
    "unknown-key \ufffdb",
  ]);
  const emoji = {
    format: 1,
    name: "😀😀",
    é: 1,
    cycle: { type: "hole", ß: { "😀": 2 } },
  };
  assert.deepEqual(codes(emoji).sort(), [
    "name-changed name",
    "unknown-key cycle.ß",
    "unknown-key é",
  ]);
});

/** Text with this nesting depth around a value. */
const nested = (
  /** @type {number} */ levels,
  inner = "1",
  [open = "", close = ""] = ['{"a":', "}"],
) => open.repeat(levels) + inner + close.repeat(levels);

test("a job of 200,000 levels came back as an object that no JSON can be written of: it is refused", () => {
  const refused = (/** @type {string} */ text) => {
    try {
      JSON.stringify(importJob(text));
      return null;
    } catch (thrown) {
      assert.ok(thrown instanceof JobError, String(thrown));
      JSON.stringify(thrown.findings);
      return thrown.findings[0]?.code;
    }
  };
  for (const text of [
    nested(200_000),
    nested(200_000, "1", ["[", "]"]),
    nested(200_000, "1", ['[{"a":', "}]"]),
    `{"format":1,"cycle":{"type":"hole"},"x":${nested(200_000)}}`,
    `{"CmdPrm.Int[-1]":7,"x":${nested(200_000)}}`,
    nested(101),
  ])
    assert.equal(refused(text), "nested-too-deeply", text.slice(0, 40));
  for (const text of [
    "{".repeat(200_000),
    "[".repeat(200_000),
    '{"a":'.repeat(200_000),
    "(".repeat(200_000),
  ])
    assert.equal(refused(text), "nothing-to-import", text.slice(0, 40));
  assert.equal(refused(`G38.2 Z${"[".repeat(200_000)}`), "not-understood");
  // Braces in a text do not count, nor does an escaped quote end it; 100 levels are read.
  const name = `${'\\"{['.repeat(50_000)}`;
  const kept = {
    format: 1,
    name,
    cycle: { type: "hole" },
    mine: JSON.parse(nested(99)),
  };
  assert.deepEqual(importJob(JSON.stringify(kept)).job, kept);
  assert.equal(refused("x".repeat(1_900_000)), "nothing-to-import");
  const long = {
    format: 1,
    name: "x".repeat(1_900_000),
    cycle: { type: "hole" },
  };
  assert.deepEqual(importJob(JSON.stringify(long)).job, long);
});

/** Every job of the tests that has a plan. */
const jobs = readdirSync(new URL("../jobs/", import.meta.url)).map((name) =>
  JSON.parse(readFileSync(new URL(`../jobs/${name}`, import.meta.url), "utf8")),
);

test("a plan is a plain object: to clone, spread, JSON and comparison", () => {
  const sections = [
    "touches",
    "moves",
    "length",
    "time",
    "cycles",
    "relations",
    "datum",
    "program",
    "table",
    "results",
    "triggers",
    "findings",
    "safety",
  ];
  for (const job of jobs) {
    const whole = plan(job);
    assert.deepEqual(Object.keys(whole), sections);
    assert.equal(Object.getPrototypeOf(whole), Object.prototype);
    const plain = JSON.parse(JSON.stringify(plan(job)));
    assert.deepStrictEqual({ ...plan(job) }, plain);
    assert.deepStrictEqual(structuredClone(plan(job)), plain);
    assert.deepStrictEqual(plan(job), plan(job));
    assert.notDeepStrictEqual(plan(job), { ...plain, length: -1 });
    assert.equal(
      inspect(plan(job), { depth: 9 }),
      inspect(plain, { depth: 9 }),
    );
    // Read twice it is the same object; assigned, the assigned value.
    assert.equal(whole.moves, whole.moves);
    whole.moves = [];
    assert.deepEqual(whole.moves, []);
    assert.equal(Object.freeze(plan(job)).touches.length, plain.touches.length);
  }
});

test("a plan's table is that of the job as it was planned", () => {
  const job = pocket();
  const first = plan(job);
  job.cycle.width1 = 60;
  const second = plan(job);
  const width = (/** @type {import("touchpath").Plan} */ p) =>
    p.table.find((row) => row.field === "cycle.width1")?.value;
  assert.deepEqual([width(first), width(second)], [80, 60]);
});

test("columns are the moves, the program is the plan's, in a row of many too", () => {
  for (const job of jobs) {
    const { moves, program: own } = plan(job);
    const columns = moveColumns(job);
    assert.deepEqual(
      moves.map((m) => [...m.to, m.feed, m.kind, m.step, m.touch ?? -1]),
      moves.map((_, i) => [
        ...columns.to.slice(3 * i, 3 * i + 3),
        columns.feeds[columns.feed[i] ?? 99],
        columns.kinds[columns.kind[i] ?? 99],
        columns.step[i],
        columns.touch[i],
      ]),
    );
    assert.equal(columns.to.length, 3 * moves.length);
    assert.deepEqual(
      [...columns.arcs],
      moves.flatMap(({ arc }, i) => (arc ? [i, ...arc.center, arc.sweep] : [])),
    );
    // The columns belong to the caller.
    columns.to.fill(0);
    assert.deepEqual(
      [...moveColumns(job).to],
      moves.flatMap((m) => m.to),
    );
    assert.deepEqual(program(job), own);
  }
  const bad = { format: 1, cycle: { type: "hole", depth: -1 } };
  let asked = 0;
  function* row() {
    for (const job of [jobs[0], bad, jobs[1]]) {
      asked++;
      yield/** @type {any} */ (job);
    }
  }
  const made = programs(row());
  assert.equal(made.next().value.program.text, plan(jobs[0]).program.text);
  assert.equal(asked, 1, "one by one");
  const rest = [...made];
  assert.equal(rest[0]?.program, null);
  assert.ok(
    rest[0]?.findings.some(
      (f) => f.code === "out-of-range" && f.path === "cycle.depth",
    ),
  );
  assert.equal(rest[1]?.program?.text, plan(jobs[1]).program.text);
  assert.throws(() => [...programs(/** @type {any} */ (7))], TypeError);
  assert.ok(catalog().cycles.length > 0);
});
