// The package in use: by its own name from the repository, and installed from its tarball.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import {
  mkdirSync,
  mkdtempSync,
  readdirSync,
  readFileSync,
  rmSync,
  writeFileSync,
} from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { fileURLToPath } from "node:url";
import { Ajv2020 } from "ajv/dist/2020.js";

const root = fileURLToPath(new URL("../..", import.meta.url));
/** @type {string} */
let folder;

before(() => {
  folder = mkdtempSync(join(tmpdir(), "touchpath-package-"));
});
after(() => rmSync(folder, { recursive: true, force: true }));

test("by its own name from the repository", async () => {
  const touchpath = await import("touchpath");
  for (const name of [
    "catalog",
    "defaultJob",
    "check",
    "plan",
    "evaluate",
    "measure",
    "moveColumns",
    "importJob",
    "jobSchema",
    "version",
  ]) {
    assert.equal(
      typeof touchpath[/** @type {"plan"} */ (name)],
      "function",
      name,
    );
  }
  const { defaultJob, check, plan, moveColumns, JobError, version } = touchpath;
  assert.equal(
    version(),
    JSON.parse(readFileSync(join(root, "package.json"), "utf8")).version,
  );
  /** @type {any} */
  const job = defaultJob("double-wall-internal-corner");
  // Only a value that no job has by default: the stylus above its ball.
  assert.deepEqual(
    check(job).map((f) => `${f.level} ${f.code}`),
    ["info stylus-not-known"],
  );
  const made = plan(job);
  assert.equal(made.touches.length, 4);
  assert.equal(Object.getPrototypeOf(made), Object.prototype);
  assert.deepEqual(JSON.parse(JSON.stringify(made)), made);
  const columns = moveColumns(job);
  assert.ok(columns.to instanceof Float64Array);
  assert.deepEqual([...columns.to.slice(0, 3)], made.moves[0]?.to);

  job.cycle.clearance1 = Number.NaN;
  job.cycle.count2 = 99;
  assert.throws(
    () => plan(job),
    (error) => {
      assert.ok(error instanceof JobError && error instanceof Error);
      assert.deepEqual(error.findings, check(job));
      assert.deepEqual(error.findings.map((f) => f.path).sort(), [
        "cycle.clearance1",
        "cycle.count2",
      ]);
      return true;
    },
  );
  assert.throws(() => defaultJob(/** @type {any} */ ("bogus")), JobError);
  assert.throws(
    () => touchpath.evaluate(defaultJob("double-wall-internal-corner"), "1"),
    JobError,
  );
  const { proxy, revoke } = Proxy.revocable({}, {});
  revoke();
  assert.equal(check({ format: 1, cycle: proxy })[0]?.level, "error");
});

test("what was measured gives results, points, the block of grbl and how it was read", async () => {
  const { defaultJob, evaluate, JobError, measure } = await import("touchpath");
  const job = {
    ...defaultJob("internal-rectangle-protected"),
    control: { post: /** @type {const} */ ("grbl") },
  };
  const log = ["-163,-150", "-237,-150", "-200,-128", "-200,-172"]
    .map((at) => `[PRB:${at},-70:1]`)
    .join("\n");
  const found = measure(job, `G54\nWCO:-200,-150,-60\n${log}`);
  assert.deepEqual(Object.keys(found).sort(), [
    "block",
    "findings",
    "points",
    "results",
  ]);
  assert.equal(found.block, "G21 G10 L20 P1 X0 Y0");
  assert.deepEqual(found.points[0], [37, 0, -10]);
  assert.deepEqual(
    found.findings.map(({ level, code, path }) => `${level} ${code} ${path}`),
    ["info converted measured", "info block-to-type measured"],
  );
  assert.deepEqual(
    evaluate(job, /** @type {any} */ (found.points)),
    found.results,
  );
  const printed = measure(
    job,
    "CENTER X=  0.1000\nCENTER Y= 0\nWIDTH1= 80\nWIDTH2= 50",
  );
  assert.deepEqual(
    [printed.results[0]?.value, printed.points, printed.block],
    [0.1, [], null],
  );
  assert.throws(
    () => measure(job, log),
    (error) =>
      error instanceof JobError &&
      error.findings.some((f) => f.code === "work-offset-needed"),
  );
});

/** FNV-1a of a text's bytes, 64 bits. */
const fnv = (/** @type {string} */ text) =>
  Buffer.from(text)
    .reduce(
      (hash, byte) =>
        ((hash ^ BigInt(byte)) * 0x100000001b3n) & 0xffffffffffffffffn,
      0xcbf29ce484222325n,
    )
    .toString(16)
    .padStart(16, "0");

test("every job of the repository plans as the crate plans it", async () => {
  const { plan } = await import("touchpath");
  const { version } = JSON.parse(
    readFileSync(join(root, "package.json"), "utf8"),
  );
  const native = readFileSync(
    join(root, "tests/snapshots/programs.snap"),
    "utf8",
  );
  const names = readdirSync(join(root, "tests/jobs")).map((file) =>
    file.replace(".json", ""),
  );
  assert.ok(names.length > 40);
  for (const name of names) {
    const job = JSON.parse(
      readFileSync(join(root, `tests/jobs/${name}.json`), "utf8"),
    );
    const text = plan(job).program.text.replace(
      new RegExp(version.replaceAll(".", "\\."), "gi"),
      "VERSION",
    );
    assert.ok(
      native.includes(`\n${name} ${fnv(text)}\n`),
      `${name}: the program in wasm is the native one, byte for byte`,
    );
  }
});

test("jobs and programs are imported", async () => {
  const { defaultJob, importJob, plan, JobError } = await import("touchpath");
  const job = defaultJob("internal-rectangle-protected");
  const own = importJob(JSON.stringify(job));
  assert.deepEqual(own, { kind: "job", job, findings: own.findings });
  const broken = { ...job, overtravel: -1, mine: "kept" };
  const back = importJob(JSON.stringify(broken));
  assert.deepEqual(back.job, broken, "nothing of a user's work is dropped");
  assert.deepEqual(back.findings.map((f) => f.code).sort(), [
    "out-of-range",
    "unknown-key",
  ]);
  const circles = defaultJob("probing-two-circles");
  const text = plan(circles).program.text;
  const read = importJob(text);
  assert.ok(read.kind === "job" && plan(read.job).program.text === text);
  for (const nothing of ["", "G1 X0", "{", "7", undefined]) {
    assert.throws(() => importJob(/** @type {string} */ (nothing)), JobError);
  }
});

test("a program of moves that says no job gives its moves", async () => {
  const { catalog, defaultJob, importJob, plan } = await import("touchpath");
  const job = defaultJob("hole");
  const takes = catalog().posts.filter(({ cycles }) =>
    cycles.some(
      ({ type, form, supported }) =>
        type === "hole" && form === "moves" && supported,
    ),
  );
  assert.ok(takes.length >= 5);
  for (const { id: post } of takes) {
    job.control.post = post;
    job.control.header = "short";
    const { program, moves } = plan(job);
    const imported = importJob(program.text);
    assert.ok(imported.kind === "moves" && imported.job === null, post);
    const { trace, findings } = imported;
    assert.deepEqual(
      findings.map((f) => f.code),
      ["no-job-in-program"],
    );
    // The first position is approached in steps.
    const touches = trace.moves.filter((m) => m.kind === "touch");
    assert.equal(touches.length, 4, post);
    assert.deepEqual(trace.moves.at(-1)?.to, moves.at(-1)?.to, post);
    assert.deepEqual(
      touches.map((m) => m.line),
      moves.flatMap((m, i) =>
        m.kind === "touch" ? [program.moveLines[i]] : [],
      ),
    );
  }
});

for (const [page, heading] of [
  ["README.md", "## Ways to use it"],
  ["docs/embedding.md", "## The functions in an example"],
])
  test(`the example of ${page} does what it says`, () => {
    const text = readFileSync(join(root, page ?? ""), "utf8");
    const [, code = ""] =
      text.slice(text.indexOf(heading ?? "")).match(/```js\n([\s\S]*?)```/) ??
      [];
    assert.match(code, /from "touchpath"/);
    const file = join(root, "dist", "example.mjs");
    writeFileSync(file, code);
    try {
      const shown = execFileSync("node", [file], {
        cwd: root,
        encoding: "utf8",
      });
      assert.match(shown, /M2\n/);
      assert.match(shown, /code: 'width1'/);
    } finally {
      rmSync(file);
    }
  });

test("the README is read in three minutes", () => {
  const words = readFileSync(join(root, "README.md"), "utf8")
    .split(/\s+/)
    .filter(Boolean);
  assert.ok(words.length <= 700, `${words.length} words`);
});

test("a dump becomes the job again, and so does a program for SINUMERIK", async () => {
  const { catalog, defaultJob, exportTable, importJob, plan } = await import(
    "touchpath"
  );
  for (const { type, number } of catalog().cycles) {
    if (number === null) continue;
    /** @type {any} */
    const job = defaultJob(type);
    job.cycle.custom = [{ code: 7, type: "Flt", value: 0.5 }];
    for (const format of /** @type {const} */ (["text", "csv", "json"])) {
      assert.deepEqual(
        importJob(exportTable(job, format)).job,
        job,
        `${type} ${format}`,
      );
    }
    job.control.post = "sinumerik";
    const { text } = plan(job).program;
    const read = importJob(text);
    assert.ok(
      read.kind === "job" && plan(read.job).program.text === text,
      type,
    );
  }
});

test("the schema takes every good job and refuses what is none", async () => {
  const { catalog, defaultJob, jobSchema } = await import("touchpath");
  const validate = new Ajv2020({ strict: false }).compile(jobSchema());
  for (const { type } of catalog().cycles)
    assert.ok(
      validate(defaultJob(type)),
      `${type}: ${JSON.stringify(validate.errors)}`,
    );
  for (const file of readdirSync(join(root, "tests/jobs"))) {
    const job = JSON.parse(
      readFileSync(join(root, "tests/jobs", file), "utf8"),
    );
    assert.ok(validate(job), `${file}: ${JSON.stringify(validate.errors)}`);
  }
  const job = () => defaultJob("hole");
  const broken = [
    {},
    { ...job(), format: 2 },
    { ...job(), mine: 1 },
    { ...job(), units: "cm" },
    { ...job(), cycle: { type: "holes" } },
    { ...job(), cycle: { type: "hole", width1: 4 } },
    { ...job(), cycle: { type: "hole", diameter: 0 } },
    { ...job(), cycle: { type: "hole", diameter: "40" } },
    { ...job(), cycle: { type: "hole", origin: [1, 2] } },
    { ...job(), cycle: { type: "hole", stepCount: 17 } },
    { ...job(), cycle: { type: "hole", touches: [{ point: [1, 2, 3] }] } },
    { ...job(), feeds: { work: null } },
    { ...job(), tool: { frame: [{ rot: "X" }] } },
  ];
  for (const value of broken)
    assert.ok(!validate(value), JSON.stringify(value).slice(0, 200));
  assert.ok(
    validate({
      ...job(),
      feeds: { longLink: null },
      cycle: { type: "hole", topClearance: null },
    }),
  );
});

test("the parameter table as text", async () => {
  const { defaultJob, exportTable, plan, JobError } = await import("touchpath");
  const job = defaultJob("double-wall-internal-corner");
  assert.match(exportTable(job, "text"), /^CmdPrm\.Int\[-1\] = 13\n/);
  assert.deepEqual(JSON.parse(exportTable(job, "json")), plan(job).table);
  assert.equal(
    exportTable(job, "csv").trimEnd().split("\n").length,
    plan(job).table.length + 1,
  );
  assert.throws(() => exportTable(job, /** @type {any} */ ("xml")), JobError);
});

test("LENTOAX answers, and refuses what is no question", async () => {
  const { lentoax, lentoaxWords, JobError } = await import("touchpath");
  assert.deepEqual(lentoax(), {
    status: 0,
    axind: [3, 2, 1],
    matrix: [
      [0, 0, 1],
      [0, 1, 0],
      [1, 0, 0],
    ],
  });
  assert.deepEqual(
    lentoax({ frame: [{ rot: "Z", angle: 90 }] }).axind,
    [2, -3, 1],
  );
  assert.deepEqual(lentoax({ coord: "nowhere", toolActive: false }), {
    status: -1,
    axind: [0, 0, 0],
    matrix: [
      [0, 0, 0],
      [0, 0, 0],
      [0, 0, 0],
    ],
  });
  assert.match(lentoaxWords({ toolType: 500 }).sentence, /L1 acts along \+Y/);
  for (const wrong of [
    7,
    { plane: "G20" },
    { frame: [{ rot: "W", angle: 1 }] },
    { frame: [{ rot: "X", angle: Number.NaN }] },
    { frame: {} },
    { tool: 1 },
    { sd42950: 3 },
  ]) {
    assert.throws(
      () => lentoax(/** @type {any} */ (wrong)),
      JobError,
      JSON.stringify(wrong),
    );
  }
});

test("installed from its tarball, in JavaScript and in strict TypeScript", () => {
  const [packed] = JSON.parse(
    execFileSync("npm", ["pack", "--json", "--pack-destination", folder], {
      cwd: root,
      encoding: "utf8",
    }),
  );
  const names = packed.files.map((/** @type {{ path: string }} */ f) => f.path);
  assert.ok(
    names.includes("dist/node.js") &&
      names.includes("dist/browser.js") &&
      names.includes("dist/wasm/touchpath_bg.wasm"),
  );
  assert.ok(
    !names.some(
      (/** @type {string} */ n) =>
        n.startsWith("dist/page") ||
        n.startsWith("src") ||
        n.startsWith("target"),
    ),
    names.join(),
  );
  const user = join(folder, "user");
  mkdirSync(user);
  writeFileSync(
    join(user, "package.json"),
    JSON.stringify({ name: "user", private: true, type: "module" }),
  );
  execFileSync(
    "npm",
    [
      "install",
      "--offline",
      "--no-audit",
      "--no-fund",
      join(folder, packed.filename),
    ],
    {
      cwd: user,
      stdio: "pipe",
    },
  );

  const script = `const t = await import("touchpath"); console.log(t.plan(t.defaultJob("internal-rectangle-protected")).moves.length)`;
  assert.equal(
    execFileSync("node", ["--input-type=module", "-e", script], {
      cwd: user,
      encoding: "utf8",
    }),
    "27\n",
  );

  writeFileSync(
    join(user, "use.ts"),
    `import { catalog, check, defaultJob, evaluate, importJob, JobError, measure, moveColumns, plan, version } from "touchpath";
import type { Catalog, Finding, Job, Measurement, Move, MoveColumns, ParameterRow, Plan, PostId, ResultRow, SetUp, Vec3 } from "touchpath";
const job: Job = defaultJob("internal-rectangle-protected");
const short: Job = { format: 1, cycle: { type: "double-wall-internal-corner", count1: 3 }, feeds: { approach: null } };
const found: Finding[] = check(short);
const made: Plan = plan(job);
const move: Move | undefined = made.moves[0];
const to: Vec3 | undefined = move?.to;
const rows: ParameterRow[] = made.table;
const results: ResultRow[] = evaluate(job, "1,2,3");
const measurement: Measurement = measure(job, "1,2,3");
const columns: MoveColumns = moveColumns(job);
const all: Catalog = catalog();
const circles: Job = { format: 1, cycle: { type: "probing-two-circles", point1: ["10@10.02", 0, "?"], diameter1: "10H7", extrusion: null } };
const whole = defaultJob("hole");
whole.feeds = { approach: null };
whole.part = { rotation: 1 };
whole.cycle.properties = { wcsMode: 1 };
whole.cycle.touches = [{ point: [0, 0, 0], vector: [1, 0, 0] }];
const posts: PostId[] = catalog().posts.map((post) => post.id);
console.log(whole, posts);
const read = importJob("x");
const taken: Job | SetUp | null = read.job;
const drawn: number =
  read.kind === "moves" ? read.trace.moves.length : read.job.format === 2 ? read.job.cycles.length : read.job.cycle.type.length;
const pair: SetUp = { format: 2, cycles: [{ name: "TOP", type: "surface" }, { type: "hole", diameter: 25 }], datum: { z: "TOP.point.z" } };
const both: string[] = plan(pair).cycles;
const follows: SetUp = { format: 2, cycles: [{ type: "web", width: "=A.diameter-2", rotation: "=SIDE.rotation+90", origin: [0, 0, "=TOP.z"] }] };
// @ts-expect-error what is no size of the part follows nothing
const deep: SetUp = { format: 2, cycles: [{ type: "web", depth: "=A.diameter" }] };
// @ts-expect-error a program of moves has no job
const lie: Job = importJob("x").job;
try { plan(short); } catch (error) { if (error instanceof JobError) console.log(error.findings[0]?.message); }
console.log(circles, taken, drawn, lie, found, to, rows, results, measurement, columns, all, version());
// @ts-expect-error a feed is a number or null
const wrong: Job = { format: 1, feeds: { approach: "fast" }, cycle: { type: "double-wall-internal-corner" } };
// @ts-expect-error there is no such cycle
const bogus: Job = { format: 1, cycle: { type: "bogus" } };
export { bogus, both, deep, follows, wrong };
`,
  );
  const tsc = join(root, "node_modules", ".bin", "tsc");
  const types = [
    "--types",
    "",
    "--skipLibCheck",
    "false",
    "--lib",
    "ES2023,DOM",
  ];
  for (const resolution of [
    ["--module", "nodenext"],
    ["--module", "esnext", "--moduleResolution", "bundler"],
  ]) {
    execFileSync(
      tsc,
      [
        "--strict",
        "--noEmit",
        "--target",
        "es2022",
        ...types,
        ...resolution,
        "use.ts",
      ],
      {
        cwd: user,
        stdio: "inherit",
      },
    );
  }
});
