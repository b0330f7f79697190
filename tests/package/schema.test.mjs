// The JSON Schema and the check accept the same structure and ranges, in both directions.
import assert from "node:assert/strict";
import { readdirSync, readFileSync } from "node:fs";
import { test } from "node:test";
import { Ajv2020 } from "ajv/dist/2020.js";
import { at } from "../../scripts/lib.mjs";

/** Errors that a schema cannot express: they depend on several fields, on the control, or on the meaning of a text. The schema covers every other code. */
const BEYOND = [
  "align-needs-confirm",
  "approach-beyond-wall",
  "ball-too-wide",
  "circle-in-circle",
  "clear-too-low",
  "clearance-height-too-low",
  "clearance-too-small",
  "code-twice",
  "collision",
  "crossing-too-low",
  "cycle-chooses-points",
  "cycle-name",
  "cycle-no-zone",
  "cycle-not-parallel",
  "cycle-one-path",
  "cycle-path-short",
  "cycle-plane",
  "datum-apart",
  "datum-unknown",
  "dist-too-short",
  "edge-contact",
  "extrusion-direction",
  "form-unsupported",
  "given-incomplete",
  "length-not-along-tool-axis",
  "no-arc",
  "no-circle",
  "no-contact",
  "no-direction",
  "no-extrusion",
  "not-a-tolerance",
  "not-a-value",
  "not-known",
  "not-on-one-circle",
  "not-on-one-wall",
  "not-rectangular",
  "nothing-to-write",
  "pairs-not-square",
  "path-not-above",
  "picks-out-of-range",
  "place-of-result",
  "plane-unsupported",
  "probe-move-too-short",
  "protection-unsupported",
  "reaction-unsupported",
  "relation-of",
  "rotary-unsupported",
  "rotation-unsupported",
  "search-too-short",
  "semi-automatic-unsupported",
  "set-up-unsupported",
  "shank-collision",
  "short-arc",
  "small-hole",
  "start-in-feature",
  "starts-disagree",
  "stops-too-late",
  "tolerance-beyond-limit",
  "tolerance-unknown",
  "tolerance-unsupported",
  "too-far",
  "too-many-digits",
  "too-many-registers",
  "too-many-touches",
  "tool-axis-reversed",
  "touch-above-top",
  "touch-askew",
  "touch-beyond-corner",
  "touch-missing",
  "touch-too-short",
  "touches-coincide",
  "touches-not-level",
  "unsafe-program",
  "vector-not-in-plane",
  "vector-not-unit",
  "vector-not-upwards",
  "vector-wrong-way",
  "vectors-not-opposite",
  "walls-parallel",
  "work-offset-unsupported",
  "wrong-count",
  "wrong-wall",
];
/** The same for a code that the schema covers elsewhere: a size that leaves nothing, a stud of zero diameter. */
const BEYOND_AT = [
  /^out-of-range part\.sizes\./,
  /^out-of-range cycle(s\[\d+\])?(\.cycle)?\.diameter\d$/,
  /^unknown-key part\.sizes\./,
  // The size may contain it.
  /^missing tolerances\..*\.tolerance$/,
];

/** Numbers in the order in which they are drawn: the same every time. */
function dice(/** @type {number} */ seed) {
  let state = seed;
  return (/** @type {number} */ below) => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return Math.floor((state / 2 ** 32) * below);
  };
}

/** Replacements for a value. */
const STRANGE = [
  null,
  true,
  "",
  "x",
  "12",
  -1,
  0,
  0.5,
  1,
  3,
  7,
  90,
  361,
  1e5,
  -1e7,
  1e9,
  [],
  {},
  [0, 0, 0],
  [1, 2],
  ["a", 1, 2],
  "G18",
  "inch",
];

/** Every place of a job, as a path. @returns {(string | number)[][]} */
function places(
  /** @type {unknown} */ value,
  /** @type {(string | number)[]} */ path = [],
) {
  if (typeof value !== "object" || value === null) return [path];
  const keys = Array.isArray(value)
    ? value.map((_, i) => i)
    : Object.keys(value);
  return [
    path,
    ...keys.flatMap((key) =>
      places(/** @type {any} */ (value)[key], [...path, key]),
    ),
  ];
}

/** Changes a job somewhere. */
function changed(
  /** @type {any} */ job,
  /** @type {(below: number) => number} */ roll,
) {
  const all = places(job);
  const path = all[1 + roll(all.length - 1)] ?? ["cycle"];
  const last = path[path.length - 1] ?? "";
  let place = job;
  for (const key of path.slice(0, -1)) place = place[key];
  const held = place[last];
  const way = roll(10);
  if (way < 1 && !Array.isArray(place)) delete place[last];
  else if (way < 2 && !Array.isArray(place)) place[`${last}x`] = 1;
  else if (way < 6 && typeof held === "number")
    place[last] = [
      held * (roll(400) / 100),
      held + roll(20) - 10,
      -held,
      held * 1000,
      held / 1000,
    ][roll(5)];
  else place[last] = structuredClone(STRANGE[roll(STRANGE.length)]);
}

test("what the schema takes and refuses, the check takes and refuses", async () => {
  const { catalog, check, convertUnits, defaultJob, jobSchema } = await import(
    "touchpath"
  );
  const valid = new Ajv2020({ strict: false }).compile(jobSchema());
  const starts = [
    ...catalog().cycles.map(({ type }) => defaultJob(type)),
    ...readdirSync(at("tests/jobs")).map((name) =>
      JSON.parse(readFileSync(at("tests/jobs", name), "utf8")),
    ),
  ];
  const rare = defaultJob("hole");
  Object.assign(rare.cycle, {
    custom: ["Int", "Flt", "Bol"].map((type, i) => ({
      code: i + 1,
      type,
      value: [7, 0.5, true][i],
    })),
  });
  Object.assign(rare.tool, {
    frame: [{ rot: "X", angle: 0 }, { mirror: "Z" }, { mirror: "Z" }],
  });
  starts.push(rare, rare, rare);
  const setUps = readdirSync(at("examples/set-ups")).map((name) =>
    JSON.parse(readFileSync(at("examples/set-ups", name), "utf8")),
  );
  // As often as all others together: they are larger.
  while (setUps.length < starts.length) setUps.push(...setUps);
  starts.push(...setUps);
  const roll = dice(20261122);
  const tally = { taken: 0, refused: 0, beyond: 0 };
  for (let i = 0; i < 30_000; i++) {
    const start = starts[roll(starts.length)];
    const job = structuredClone(
      roll(3) === 0 ? convertUnits(start, "inch") : start,
    );
    for (let count = 1 + roll(3); count > 0; count--) changed(job, roll);
    const errors = check(job).filter((f) => f.level === "error");
    const codes = errors.map((f) => f.code);
    const told = () =>
      `${JSON.stringify(job)}\ncheck: ${codes}\nschema: ${JSON.stringify(valid.errors?.map((e) => [e.instancePath, e.message]))}`;
    if (valid(job)) {
      const beyondIt = (
        /** @type {{ code: string, path: string }} */ { code, path },
      ) =>
        BEYOND.includes(code) ||
        BEYOND_AT.some((place) => place.test(`${code} ${path}`));
      const unsaid = errors.filter((error) => !beyondIt(error));
      assert.deepEqual(unsaid, [], told());
      tally[codes.length ? "beyond" : "taken"]++;
    } else {
      assert.ok(codes.length > 0, told());
      tally.refused++;
    }
  }
  assert.ok(
    tally.taken > 2000 && tally.refused > 5000 && tally.beyond > 300,
    JSON.stringify(tally),
  );
});

test("the ends of every range are the same in both, in mm and in inch", async () => {
  const { catalog, check, convertUnits, defaultJob, jobSchema } = await import(
    "touchpath"
  );
  const valid = new Ajv2020({ strict: false }).compile(jobSchema());
  let count = 0;
  for (const { type, fields } of catalog().cycles)
    for (const { key, kind, range, unit } of fields) {
      if (!range || !["number", "count"].includes(kind)) continue;
      for (const units of /** @type {const} */ (["mm", "inch"]))
        for (const end of range)
          for (const aside of [-2e-4, 0, 2e-4]) {
            const job = /** @type {any} */ (
              convertUnits(defaultJob(type), units)
            );
            const scale = units === "inch" && unit === "length" ? 25.4 : 1;
            job.cycle[key] =
              (kind === "count" ? end + Math.sign(aside) : end + aside) / scale;
            const mine = check(job).some(
              (f) => f.path === `cycle.${key}` && f.code === "out-of-range",
            );
            assert.equal(
              !valid(job),
              mine,
              `${type}.${key} = ${job.cycle[key]} ${units}`,
            );
            count++;
          }
    }
  assert.ok(count > 1000, String(count));
});

test("jobs of format 1 stay readable: those that were written with it have the same path", async () => {
  const { check, jobSchema, plan } = await import("touchpath");
  const valid = new Ajv2020({ strict: false }).compile(jobSchema());
  const lines = readFileSync(at("tests/data/format-1.ndjson"), "utf8")
    .trim()
    .split("\n");
  assert.ok(lines.length > 40, String(lines.length));
  for (const line of lines) {
    const { job, ...path } = /** @type {any} */ (JSON.parse(line));
    assert.ok(valid(/** @type {unknown} */ (job)), job.name);
    assert.deepEqual(
      check(job).filter((f) => f.level === "error"),
      [],
      job.name,
    );
    const { touches, moves, length, table } = plan(job);
    const now = {
      touches: touches.length,
      moves: moves.length,
      length: Number(length.toFixed(4)),
      rows: table.length,
    };
    assert.deepEqual(now, path, job.name);
  }
});
