// The schema of the answers: every answer satisfies it, and no answer has other keys.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { existsSync, readFileSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { test } from "node:test";
import { Ajv2020 } from "ajv/dist/2020.js";
import { csharpTypes } from "../../scripts/csharp-types.mjs";
import { at } from "../../scripts/lib.mjs";
import { pythonTypes } from "../../scripts/python-types.mjs";
import {
  command,
  file,
  folder,
  run,
  setUp,
  touchpath,
  wrong,
} from "./command.mjs";

setUp();

const answers = JSON.parse(
  readFileSync(at("dist", "answers.schema.json"), "utf8"),
);
const job = JSON.parse(readFileSync(at("dist", "schema.json"), "utf8"));

/** Objects closed: what is not named is a fault. @param {any} part @returns {any} */
const closed = (part) => {
  if (Array.isArray(part)) return part.map(closed);
  if (typeof part !== "object" || part === null) return part;
  const inner = Object.fromEntries(
    Object.entries(part).map(([key, value]) => [key, closed(value)]),
  );
  return part.type === "object" &&
    part.properties &&
    part.additionalProperties === undefined
    ? { ...inner, additionalProperties: false }
    : inner;
};
const validator = (/** @type {any} */ schema) =>
  new Ajv2020({ strict: false }).addSchema(job).addSchema(schema);
const open = validator(answers);
const strict = validator(closed(answers));

/** Checks a value against a definition; as JSON, as it is transmitted. */
function is(
  /** @type {string} */ name,
  /** @type {unknown} */ value,
  ajv = strict,
) {
  const good = ajv.validate(
    `urn:touchpath:answers:1#/$defs/${name}`,
    JSON.parse(JSON.stringify(value)),
  );
  return good ? null : ajv.errorsText();
}

test("every plan of every cycle on every control is as the schema says, and no more", () => {
  const { cycles, posts } = touchpath.catalog();
  let count = 0;
  for (const { type } of cycles)
    for (const { id } of posts)
      for (const form of ["moves", "cycle"]) {
        const own = touchpath.defaultJob(type);
        const asked = /** @type {any} */ ({
          ...own,
          control: { ...own.control, post: id, form },
        });
        const findings = touchpath.check(asked);
        assert.equal(
          is(
            "Finding",
            findings[0] ?? {
              level: "info",
              code: "portal",
              path: "",
              message: "",
              said: [""],
            },
          ),
          null,
        );
        if (findings.some(({ level }) => level === "error")) continue;
        count++;
        assert.equal(
          is("Plan", touchpath.plan(asked)),
          null,
          `${type} ${id} ${form}`,
        );
      }
  assert.ok(count > 150, `${count} plans`);
  for (const name of ["vise", "two-holes", "first-article"]) {
    const path = at("examples", "set-ups", `${name}.json`);
    assert.equal(
      is("Plan", touchpath.plan(JSON.parse(readFileSync(path, "utf8")))),
      null,
      name,
    );
  }
});

test("the other answers, and the lines of the command", () => {
  const own = touchpath.defaultJob("hole");
  const points = touchpath
    .plan(own)
    .triggers.map((one) => one?.join(","))
    .join("\n");
  assert.equal(is("Catalog", touchpath.catalog()), null);
  assert.equal(is("Measurement", touchpath.measure(own, points)), null);
  assert.equal(
    is("Lentoax", touchpath.lentoax({ frame: [{ rot: "Z", angle: 60 }] })),
    null,
  );
  assert.equal(
    is("Imported", touchpath.importJob(touchpath.program(own).text)),
    null,
  );
  assert.equal(
    is(
      "Imported",
      touchpath.importJob("G21 G90\nG0 X0 Y0 Z5\nG38.2 Z0 F100\nM2\n"),
    ),
    null,
  );
  for (const outcome of touchpath.programs([
    own,
    /** @type {any} */ ({ format: 1 }),
  ]))
    assert.equal(is("Programmed", outcome), null);
  const name = file("hole.json", own);
  const lines = (/** @type {string[]} */ args, input = "") =>
    run(args, input)
      .stdout.trim()
      .split("\n")
      .map((line) => JSON.parse(line));
  const whole = lines(["plan", name, "--json"])[0];
  assert.deepEqual(
    whole,
    JSON.parse(JSON.stringify(touchpath.plan(own))),
    "plan --json is the plan",
  );
  assert.equal(is("Plan", whole), null);
  for (const line of lines(
    ["plan", "-", "--ndjson"],
    `${JSON.stringify(own)}\n{}\n`,
  ))
    assert.equal(is("PlanLine", line), null);
  // A finding in a file also has line and column.
  for (const line of lines(["plan", name, "-o", "out", "--json"]))
    assert.equal(is("FileLine", line, open), null);
  for (const line of lines(["check", name, "--json"]))
    assert.equal(is("CheckLine", line, open), null);
  writeFileSync(join(folder, "points.txt"), points);
  const reported = run(["report", name, "points.txt", "--format", "json"]);
  assert.equal(reported.status, 0, reported.stderr);
  assert.equal(is("Report", JSON.parse(reported.stdout)), null);
  const bad = run(["plan", file("bad.json", { format: 1 }), "--json"]);
  assert.deepEqual([bad.status, bad.stdout], [1, ""]);
  assert.equal(JSON.parse(bad.stderr).findings[0].code, "missing");
});

test("the schema refuses what is no answer", () => {
  const plan = JSON.parse(
    JSON.stringify(touchpath.plan(touchpath.defaultJob("hole"))),
  );
  assert.equal(is("Plan", plan, open), null);
  const broken = (/** @type {(plan: any) => void} */ change) => {
    const copy = structuredClone(plan);
    change(copy);
    return is("Plan", copy, open);
  };
  assert.notEqual(
    broken((p) => delete p.moves),
    null,
  );
  assert.notEqual(
    broken((p) => p.moves[0].to.pop()),
    null,
  );
  assert.notEqual(
    broken((p) => (p.moves[0].kind = "jump")),
    null,
  );
  assert.notEqual(
    broken((p) => (p.results[0].value = "1")),
    null,
  );
  assert.notEqual(
    broken((p) => (p.findings[0].code = "no-such-code")),
    null,
  );
  assert.equal(
    broken((p) => (p.later = 1)),
    null,
    "a later version may say more",
  );
});

const python = /Python 3\.(1[1-9]|[2-9]\d)/.test(
  spawnSync("python3", ["--version"], { encoding: "utf8" }).stdout ?? "",
);

test("the types for Python are those of the schema", () => {
  const kept = readFileSync(
    at("examples", "python", "touchpath_types.py"),
    "utf8",
  );
  assert.equal(
    kept,
    pythonTypes(),
    "node scripts/python-types.mjs writes them",
  );
});

/** Checks a value against a type, key by key, and reports the first difference. */
const HOLDS = `
import json, sys, types
from typing import Literal, NotRequired, Union, get_args, get_origin, get_type_hints, is_typeddict
import touchpath_types
def holds(value, kind, path):
    origin = get_origin(kind)
    if is_typeddict(kind):
        hints = get_type_hints(kind)
        if not isinstance(value, dict): return f"{path}: {value!r} is no {kind.__name__}"
        missing = kind.__required_keys__ - value.keys()
        unknown = value.keys() - hints.keys()
        if missing or unknown: return f"{path}: missing {sorted(missing)}, unknown {sorted(unknown)}"
        return next((bad for key, own in value.items() if (bad := holds(own, hints[key], f"{path}.{key}"))), None)
    if origin is NotRequired: return holds(value, get_args(kind)[0], path)
    if origin in (Union, types.UnionType):
        bad = [holds(value, own, path) for own in get_args(kind)]
        return None if None in bad else bad[0]
    if origin is Literal: return None if value in get_args(kind) else f"{path}: {value!r} is not one of the words"
    if origin is list:
        if not isinstance(value, list): return f"{path}: {value!r} is no list"
        return next((bad for i, own in enumerate(value) if (bad := holds(own, get_args(kind)[0], f"{path}[{i}]"))), None)
    if origin is dict or kind is dict: return None if isinstance(value, dict) else f"{path}: {value!r} is no object"
    if kind is type(None): return None if value is None else f"{path}: {value!r} is not None"
    if kind is float: kind = (int, float)
    if kind is object or str(kind) == "typing.Any": return None
    return None if isinstance(value, kind) and not (isinstance(value, bool) and kind is not bool) else f"{path}: {value!r} is no {kind}"
for name, value in json.load(sys.stdin):
    print(holds(value, getattr(touchpath_types, name), name))
`;
test("what comes out is what Python's types say", {
  skip: !python && "there is no python3 of 3.11",
}, () => {
  const { catalog, measure, plan } = touchpath;
  const hole = plan(touchpath.defaultJob("hole"));
  const values = [
    ["Plan", hole],
    ["Plan", plan(touchpath.defaultJob("probing-two-circles"))],
    ["Catalog", catalog()],
    [
      "Measurement",
      measure(
        touchpath.defaultJob("hole"),
        "center.x=0\ncenter.y=0\ndiameter=40\nresidual=0",
      ),
    ],
    ["Finding", hole.findings[0]],
    // A missing key, an invalid word.
    ["Plan", { ...hole, moves: undefined }],
    ["Plan", { ...hole, moves: [{ ...hole.moves[0], kind: "jump" }] }],
  ];
  const ran = spawnSync("python3", ["-c", HOLDS], {
    cwd: at("examples", "python"),
    input: JSON.stringify(values),
    encoding: "utf8",
    env: { ...process.env, PYTHONDONTWRITEBYTECODE: "1" },
  });
  const said = ran.stdout.trimEnd().split("\n");
  assert.deepEqual(said.slice(0, 5), Array(5).fill("None"), ran.stderr);
  assert.match(said[5] ?? "", /missing \['moves'\]/);
  assert.match(said[6] ?? "", /moves\[0\]\.kind: 'jump'/);
});

test("the example in Python plans a job by the command", {
  skip: !python && "there is no python3 of 3.11",
}, () => {
  const example = (/** @type {string} */ name) =>
    spawnSync(
      "python3",
      [at("examples", "python", "table.py"), name, "node", command],
      {
        cwd: folder,
        encoding: "utf8",
        env: { ...process.env, PYTHONDONTWRITEBYTECODE: "1" },
      },
    );
  const own = touchpath.defaultJob("hole");
  const { table, program, touches } = touchpath.plan(own);
  const good = example(file("own.json", own));
  assert.equal(good.status, 0, good.stderr);
  const lines = good.stdout.split("\n");
  assert.equal(
    lines.filter((line) => line.startsWith("CmdPrm.")).length,
    table.length,
  );
  assert.equal(
    lines.filter((line) => line.startsWith("touch ")).length,
    touches.length,
  );
  assert.ok(
    good.stdout.includes(
      `${program.post}: ${program.text.trimEnd().split("\n").length} lines`,
    ),
  );
  const bad = example(file("wrong.json", wrong()));
  assert.deepEqual([bad.status, bad.stdout], [1, ""]);
  assert.match(bad.stderr, /^wrong\.json:1: cycle\.diameter: /m);
});

const json = "/usr/lib/cli/Newtonsoft.Json-5.0/Newtonsoft.Json.dll";
const mono = spawnSync("mcs", ["--version"]).status === 0 && existsSync(json);
const without = { skip: !mono && "there is no mcs with Newtonsoft.Json" };
/** Compiles a program with the types, and gives what runs it. @returns {(args: string[], input?: string) => import("node:child_process").SpawnSyncReturns<string>} */
function compiled(/** @type {string} */ name, /** @type {string} */ source) {
  const out = join(folder, `${name}.exe`);
  const built = spawnSync(
    "mcs",
    [
      `-out:${out}`,
      `-r:${json}`,
      source,
      at("examples", "csharp", "TouchpathTypes.cs"),
    ],
    {
      encoding: "utf8",
    },
  );
  assert.equal(built.status, 0, built.stdout + built.stderr);
  return (args, input = "") =>
    spawnSync("mono", [out, ...args], {
      cwd: folder,
      input,
      encoding: "utf8",
      env: { ...process.env, MONO_PATH: dirname(json) },
    });
}

test("the types for C# are those of the schema", () => {
  const kept = readFileSync(
    at("examples", "csharp", "TouchpathTypes.cs"),
    "utf8",
  );
  assert.equal(
    kept,
    csharpTypes(),
    "node scripts/csharp-types.mjs writes them",
  );
});

/** Reads each value as its type, with an error for an unknown key, and writes it again. */
const AGAIN = `
using System; using Newtonsoft.Json; using Newtonsoft.Json.Linq; using Newtonsoft.Json.Serialization;
static class Again {
  static void Main() {
    var strict = new JsonSerializerSettings { MissingMemberHandling = MissingMemberHandling.Error, ContractResolver = new CamelCasePropertyNamesContractResolver() };
    foreach (var pair in JArray.Parse(Console.In.ReadToEnd())) {
      try {
        var value = JsonConvert.DeserializeObject(pair[1].ToString(), Type.GetType("Touchpath." + pair[0]), strict);
        Console.WriteLine(JsonConvert.SerializeObject(value, strict));
      } catch (JsonException bad) { Console.WriteLine(JsonConvert.SerializeObject(bad.Message)); }
    }
  }
}`;
test(
  "what comes out is the same after C#'s types have read and written it",
  without,
  () => {
    const { catalog, measure, plan } = touchpath;
    const hole = plan(touchpath.defaultJob("hole"));
    const values = /** @type {[string, unknown][]} */ ([
      ["Plan", hole],
      ["Plan", plan(touchpath.defaultJob("probing-two-circles"))],
      ["Catalog", catalog()],
      [
        "Measurement",
        measure(
          touchpath.defaultJob("hole"),
          "center.x=0\ncenter.y=0\ndiameter=40\nresidual=0",
        ),
      ],
      ["Finding", hole.findings[0]],
      ["Plan", { ...hole, unknown: 1 }],
      ["Plan", { ...hole, moves: [{ ...hole.moves[0], step: "one" }] }],
    ]);
    const ran = compiled("again", join(folder, file("again.cs", AGAIN)))(
      [],
      JSON.stringify(values),
    );
    const said = ran.stdout
      .trimEnd()
      .split("\n")
      .map((line) => JSON.parse(line));
    assert.deepEqual(
      said.slice(0, 5),
      JSON.parse(JSON.stringify(values.slice(0, 5).map(([, value]) => value))),
      ran.stderr,
    );
    assert.match(said[5], /Could not find member 'unknown'/);
    assert.match(said[6], /moves\[0\]\.step/);
  },
);

test("the example in C# plans a job by the command", without, () => {
  const run = compiled("table", at("examples", "csharp", "Table.cs"));
  const own = touchpath.defaultJob("hole");
  const { table, touches } = touchpath.plan(own);
  const good = run([file("own.json", own), "node", command]);
  assert.equal(good.status, 0, good.stderr);
  const lines = good.stdout.split("\n");
  assert.equal(
    lines.filter((line) => line.startsWith("CmdPrm.")).length,
    table.length,
  );
  assert.equal(
    lines.filter((line) => line.startsWith("touch ")).length,
    touches.length,
  );
  const bad = run([file("wrong.json", wrong()), "node", command]);
  assert.deepEqual([bad.status, bad.stdout], [1, ""]);
  assert.match(bad.stderr, /^wrong\.json: cycle\.diameter: /m);
  assert.equal(run(["nothing.json", "node", command]).status, 2);
});
