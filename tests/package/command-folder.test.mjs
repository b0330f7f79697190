// The command with many files into a folder: names and positions; existing files stay intact.

import assert from "node:assert/strict";
import { spawn, spawnSync } from "node:child_process";
import { createHash } from "node:crypto";
import { once } from "node:events";
import {
  lstatSync,
  mkdirSync,
  readdirSync,
  readFileSync,
  rmSync,
  statSync,
  symlinkSync,
  utimesSync,
  writeFileSync,
} from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import {
  command,
  file,
  folder,
  job,
  run,
  setUp,
  touchpath,
  wrong,
} from "./command.mjs";

setUp();

/** Every file below a folder, with its text. */
const tree = (/** @type {string} */ name) =>
  Object.fromEntries(
    readdirSync(join(folder, name), { recursive: true, encoding: "utf8" })
      .filter((path) => statSync(join(folder, name, path)).isFile())
      .map((path) => [path, readFileSync(join(folder, name, path), "utf8")]),
  );

const programOf = (/** @type {any} */ job) => touchpath.program(job).text;

test("many files into a folder: patterns, folders as those of the jobs, names by the jobs, one that fails", () => {
  mkdirSync(join(folder, "many", "below"), { recursive: true });
  file("many/a.json", job("hole", "ONE"));
  file("many/below/b.json", job("boss", "ONE"));
  file("many/below/c.json", job("web", "../../ESCAPE"));
  file("many/d.json", wrong());
  file("many/e.json", { ...job("groove", "TWO"), control: { post: "haas" } });
  const { status, stdout, stderr } = run([
    "plan",
    "many/**/*.json",
    "-o",
    "out",
  ]);
  assert.equal(status, 1);
  assert.match(stderr, /many\/d\.json:1:\d+: error: cycle\.diameter/);
  const wanted = {
    "many/ONE.ngc": programOf(job("hole", "ONE")),
    "many/below/ONE.ngc": programOf(job("boss", "ONE")),
    "many/below/ESCAPE.ngc": programOf(job("web", "../../ESCAPE")),
    "many/TWO.nc": programOf({
      ...job("groove", "TWO"),
      control: { post: "haas" },
    }),
  };
  assert.deepEqual(tree("out"), wanted);
  const sha = (/** @type {string} */ text) =>
    createHash("sha256").update(text).digest("hex");
  assert.equal(
    stdout,
    [
      `many/a.json: out/many/ONE.ngc (linuxcnc, sha256 ${sha(wanted["many/ONE.ngc"])})`,
      `many/below/b.json: out/many/below/ONE.ngc (linuxcnc, sha256 ${sha(wanted["many/below/ONE.ngc"])})`,
      `many/below/c.json: out/many/below/ESCAPE.ngc (linuxcnc, sha256 ${sha(wanted["many/below/ESCAPE.ngc"])})`,
      "many/d.json: no file, 1 error",
      `many/e.json: out/many/TWO.nc (haas, sha256 ${sha(wanted["many/TWO.nc"])})`,
      "",
    ].join("\n"),
  );
  assert.match(
    run(["plan", "many/e.json", "-o", "warned", "--post", "fanuc"]).stdout,
    /\(fanuc, sha256 .*\), 1 warning\n$/,
  );
  // The same as JSON: with all findings and nothing else.
  const json = run([
    "plan",
    "many/**/*.json",
    "-o",
    "again",
    "--json",
    "--post",
    "fanuc",
  ]);
  assert.deepEqual([json.status, json.stderr], [1, ""]);
  const rows = json.stdout
    .trimEnd()
    .split("\n")
    .map((line) => JSON.parse(line));
  assert.deepEqual(
    rows.map(({ source, file, control, findings }) => [
      source,
      file,
      control,
      findings.some((/** @type {any} */ f) => f.code === "other-control"),
    ]),
    [
      ["many/a.json", "again/many/ONE.nc", "fanuc", true],
      ["many/below/b.json", "again/many/below/ONE.nc", "fanuc", true],
      ["many/below/c.json", "again/many/below/ESCAPE.nc", "fanuc", true],
      ["many/d.json", null, "fanuc", false],
      ["many/e.json", "again/many/TWO.nc", "fanuc", true],
    ],
  );
  for (const { file, hash } of rows)
    assert.equal(hash, file && sha(readFileSync(join(folder, file), "utf8")));
  // Without folders, and from a folder outside.
  assert.equal(
    run(["svg", "many/below/b.json", "many/e.json", "--flat", "-o", "flat"])
      .status,
    0,
  );
  assert.deepEqual(Object.keys(tree("flat")).sort(), ["ONE.svg", "TWO.svg"]);
  const outside = spawnSync(
    "node",
    [command, "svg", "../a.json", join(folder, "many", "e.json"), "-o", "up"],
    {
      cwd: join(folder, "many", "below"),
      encoding: "utf8",
    },
  );
  assert.equal(outside.status, 0, outside.stderr);
  assert.deepEqual(Object.keys(tree("many/below/up")).sort(), [
    "ONE.svg",
    "TWO.svg",
  ]);
});

test("two jobs of one file were renamed without a word: they are refused before anything is written", () => {
  mkdirSync(join(folder, "clash", "below"), { recursive: true });
  file("clash/a.json", job("hole", "ONE"));
  file("clash/b.json", job("boss", "one"));
  file("clash/c.json", job("web", "OTHER"));
  file("clash/below/d.json", job("groove", "OTHER"));
  const refused = run(["plan", "clash/*.json", "-o", "never"]);
  assert.deepEqual([refused.status, refused.stdout], [2, ""]);
  assert.equal(
    refused.stderr,
    "touchpath: clash/a.json and clash/b.json would both be clash/one.ngc: nothing was written\n",
  );
  assert.ok(!readdirSync(folder).includes("never"), "no folder is left behind");
  // In separate folders they are two files; in one folder they conflict.
  const apart = ["plan", "clash/c.json", "clash/below/d.json", "-o", "apart"];
  assert.equal(run(apart).status, 0);
  const before = tree("apart");
  assert.deepEqual(Object.keys(before).sort(), [
    "clash/OTHER.ngc",
    "clash/below/OTHER.ngc",
  ]);
  writeFileSync(join(folder, "apart", "OTHER.ngc"), "good");
  const flat = run([...apart, "--flat"]);
  assert.equal(flat.status, 2);
  assert.match(flat.stderr, /would both be OTHER\.ngc: nothing was written\n$/);
  assert.deepEqual(tree("apart"), { ...before, "OTHER.ngc": "good" });
  // All together, in a short message.
  file(
    "clash/many.ndjson",
    Array.from({ length: 9 }, () => JSON.stringify(job("hole"))).join("\n"),
  );
  const lines = run(["plan", "clash/many.ndjson", "-o", "never"]);
  assert.match(
    lines.stderr,
    /many\.ndjson:1 and clash\/many\.ndjson:2 would both be .*; and 3 more: nothing was written\n$/,
  );
  // A folder has the name of an output file.
  mkdirSync(join(folder, "blocked", "clash", "ONE.ngc"), { recursive: true });
  const blocked = run([
    "plan",
    "clash/a.json",
    "clash/c.json",
    "-o",
    "blocked",
  ]);
  assert.equal(blocked.status, 2);
  assert.match(
    blocked.stderr,
    /ONE\.ngc would be a file and a folder: nothing was written/,
  );
  assert.deepEqual(tree("blocked"), {});
});

/** Waits until something holds. */
async function until(/** @type {() => boolean} */ holds) {
  for (let i = 0; i < 600 && !holds(); i++)
    await new Promise((done) => setTimeout(done, 50));
  assert.ok(holds());
}

test("a run that was killed left half a program in the place of a good one: files are whole, old or new", async () => {
  mkdirSync(join(folder, "kept"));
  const good = "%\n(a good program)\n%\n";
  writeFileSync(join(folder, "kept", "FIRST.ngc"), good);
  for (const signal of /** @type {const} */ ([
    "SIGINT",
    "SIGTERM",
    "SIGKILL",
  ])) {
    const child = spawn(
      "node",
      [command, "plan", "-", "--ndjson", "--jobs", "1", "-o", "kept"],
      { cwd: folder },
    );
    child.stdin.write(
      `${JSON.stringify(job("hole", "FIRST"))}\n${JSON.stringify(job("hole", "SECOND"))}\n`,
    );
    const aside = () =>
      readdirSync(join(folder, "kept")).filter((name) =>
        name.startsWith(".touchpath-"),
      );
    await until(() =>
      aside().some(
        (name) => readdirSync(join(folder, "kept", name)).length === 2,
      ),
    );
    child.kill(signal);
    const [status, by] = await once(child, "close");
    assert.deepEqual(
      [status, by],
      signal === "SIGKILL"
        ? [null, signal]
        : [signal === "SIGINT" ? 130 : 143, null],
    );
    assert.equal(readFileSync(join(folder, "kept", "FIRST.ngc"), "utf8"), good);
    assert.deepEqual(
      readdirSync(join(folder, "kept")).filter((name) => !name.startsWith(".")),
      ["FIRST.ngc"],
    );
    assert.equal(aside().length, signal === "SIGKILL" ? 1 : 0, signal);
  }
  // A run on another day removes the leftovers of a kill.
  const [left = ""] = readdirSync(join(folder, "kept")).filter((name) =>
    name.startsWith("."),
  );
  const past = new Date(Date.now() - 2 * 86_400_000);
  utimesSync(join(folder, "kept", left), past, past);
  const done = run(
    ["plan", "-", "--ndjson", "-o", "kept"],
    JSON.stringify(job("hole", "FIRST")),
  );
  assert.equal(done.status, 0, done.stderr);
  assert.deepEqual(tree("kept"), {
    "FIRST.ngc": programOf(job("hole", "FIRST")),
  });
});

test("a full disk leaves every file as it was, and says so in one line", () => {
  // No file may be longer than about a kilobyte.
  mkdirSync(join(folder, "full"));
  writeFileSync(join(folder, "full", "BIG.ngc"), "good");
  file("big.json", job("hole", "BIG"));
  const limited = spawnSync(
    "bash",
    [
      "-c",
      `trap "" XFSZ; ulimit -f 2; exec node ${command} plan big.json -o full`,
    ],
    {
      cwd: folder,
      encoding: "utf8",
    },
  );
  assert.equal(limited.status, 2, limited.stderr);
  assert.match(
    limited.stderr,
    /^touchpath: BIG\.ngc cannot be written: [^\n]*: nothing was written\n$/,
  );
  assert.deepEqual(tree("full"), { "BIG.ngc": "good" });
});

test("the rights of a file and a link to it stay when it is replaced", () => {
  mkdirSync(join(folder, "rights"));
  mkdirSync(join(folder, "elsewhere"));
  writeFileSync(join(folder, "elsewhere", "REAL.ngc"), "old", { mode: 0o640 });
  symlinkSync(
    join("..", "elsewhere", "REAL.ngc"),
    join(folder, "rights", "BIG.ngc"),
  );
  file("big.json", job("hole", "BIG"));
  assert.equal(run(["plan", "big.json", "-o", "rights"]).status, 0);
  assert.ok(lstatSync(join(folder, "rights", "BIG.ngc")).isSymbolicLink());
  assert.equal(
    readFileSync(join(folder, "elsewhere", "REAL.ngc"), "utf8"),
    programOf(job("hole", "BIG")),
  );
  assert.equal(
    statSync(join(folder, "elsewhere", "REAL.ngc")).mode & 0o777,
    0o640,
  );
});

test("a file that was read is not written over, by whatever name it is reached", () => {
  mkdirSync(join(folder, "own"));
  file("own/SELF.json", job("hole", "SELF"));
  const before = readFileSync(join(folder, "own/SELF.json"), "utf8");
  symlinkSync("own", join(folder, "alias"));
  for (const out of [".", "own/../own/..", "alias/.."]) {
    const { status, stderr } = run(["import", "own/SELF.json", "-o", out]);
    assert.deepEqual(
      [status, stderr],
      [
        2,
        "touchpath: own/SELF.json would be written over the file that was read: nothing was written\n",
      ],
    );
  }
  assert.equal(
    run(["import", "own/SELF.json", "-o", "alias", "--flat"]).status,
    2,
  );
  assert.equal(readFileSync(join(folder, "own/SELF.json"), "utf8"), before);
  assert.deepEqual(readdirSync(join(folder, "own")), ["SELF.json"]);
});

test("a list of the programs: what is missing, changed, strange, or of another job than it was", () => {
  mkdirSync(join(folder, "shop"));
  for (const [name, type] of Object.entries({
    a: "hole",
    b: "boss",
    c: "groove",
    d: "web",
  }))
    file(
      `shop/${name}.json`,
      job(/** @type {any} */ (type), name.toUpperCase()),
    );
  file(
    "shop/many.ndjson",
    `${JSON.stringify(job("hole", "E"))}\n${JSON.stringify(job("boss", "F"))}\n`,
  );
  const args = [
    "plan",
    "shop/*.json",
    "shop/many.ndjson",
    "-o",
    "made",
    "--manifest",
  ];
  assert.equal(
    run(["plan", "shop/*.json", "-o", "made", "--manifest"]).status,
    0,
  );
  const list = () =>
    JSON.parse(readFileSync(join(folder, "made", "manifest.json"), "utf8"));
  const sha = (/** @type {string} */ name) =>
    createHash("sha256")
      .update(readFileSync(join(folder, name)))
      .digest("hex");
  assert.deepEqual(list().files[0], {
    file: "shop/A.ngc",
    sha256: sha("made/shop/A.ngc"),
    control: "linuxcnc",
    job: { file: "../shop/a.json", line: null, sha256: sha("shop/a.json") },
  });
  // The same jobs make the same manifest, also from a file of jobs.
  assert.equal(run(args.filter((arg) => arg !== "shop/*.json")).status, 0);
  assert.deepEqual(
    list().files.map((/** @type {any} */ one) => [
      one.file,
      one.job.file,
      one.job.line,
    ]),
    [
      ["shop/E.ngc", "../shop/many.ndjson", 1],
      ["shop/F.ngc", "../shop/many.ndjson", 2],
    ],
  );
  run(["plan", "shop/*.json", "-o", "made", "--manifest"]);
  const before = readFileSync(join(folder, "made/manifest.json"));
  run(["plan", "shop/*.json", "-o", "made", "--manifest"]);
  assert.deepEqual(readFileSync(join(folder, "made/manifest.json")), before);
  rmSync(join(folder, "made/shop/E.ngc"));
  rmSync(join(folder, "made/shop/F.ngc"));
  // A folder with a list is compared with it in any case.
  const good = run(["verify", "made", "--manifest"]);
  assert.equal(run(["verify", "made"]).stdout, good.stdout);
  // A damaged list is told, in place of a comparison without it.
  const whole = readFileSync(join(folder, "made/manifest.json"));
  writeFileSync(join(folder, "made/manifest.json"), whole.subarray(0, -10));
  assert.equal(run(["verify", "made"]).status, 2);
  writeFileSync(join(folder, "made/manifest.json"), whole);
  assert.deepEqual(
    [good.status, good.stdout.trimEnd().split("\n").length],
    [0, 4],
  );
  // Each is a possible change of a folder.
  writeFileSync(
    join(folder, "made/shop/A.ngc"),
    `${readFileSync(join(folder, "made/shop/A.ngc"), "utf8")}\n`,
  );
  rmSync(join(folder, "made/shop/B.ngc"));
  file("shop/c.json", { ...job("groove", "C"), overtravel: 4 });
  rmSync(join(folder, "shop/d.json"));
  file("made/notes.txt", "notes");
  file("made/.hidden.ngc", "G0");
  const bad = run(["verify", "made", "--manifest", "--format", "json"]);
  assert.equal(bad.status, 1);
  assert.deepEqual(
    bad.stdout
      .trimEnd()
      .split("\n")
      .map((line) => JSON.parse(line))
      .map(({ source, state }) => [source, state]),
    [
      ["made/shop/A.ngc", "changed"],
      ["made/shop/B.ngc", "missing"],
      ["made/shop/C.ngc", "job-changed"],
      ["made/shop/D.ngc", "job-missing"],
      ["made/.hidden.ngc", "unlisted"],
      ["made/notes.txt", "unlisted"],
    ].map(([source = "", state]) => [join(source), state]),
  );
  assert.match(
    run(["verify", "made", "--manifest"]).stdout,
    /its job shop[/\\]c\.json was changed since/,
  );
  for (const wrong of [
    ["verify", "shop", "--manifest"],
    ["verify", "made/shop/A.ngc", "--manifest"],
    ["plan", "shop/a.json", "--manifest"],
    ["check", "shop/a.json", "--manifest"],
  ])
    assert.equal(run(wrong).status, 2, wrong.join(" "));
  const entry = (/** @type {object} */ more) => {
    const one = {
      file: "x",
      sha256: "y",
      control: null,
      job: { file: null, line: null, sha256: "" },
      ...more,
    };
    return JSON.stringify({ files: [one] });
  };
  for (const text of [
    "{",
    "[]",
    '{"files":[{"file":1}]}',
    entry({ file: "../../etc/passwd" }),
    entry({ file: "/dev/zero" }),
    entry({ file: "a\\..\\..\\b" }),
    entry({ job: { file: 2, line: null, sha256: "" } }),
    entry({ job: { file: "x", line: "x", sha256: "" } }),
    entry({}).replace(
      "[{",
      '[{"file":"X","sha256":"","control":null,"job":{"file":null,"line":null,"sha256":""}},{',
    ),
  ]) {
    writeFileSync(join(folder, "made/manifest.json"), text);
    assert.equal(run(["verify", "made", "--manifest"]).status, 2, text);
  }
});

test("rules that are found by themselves: those of the nearest folder, named ones before them, or none", () => {
  mkdirSync(join(folder, "hall", "jobs"), { recursive: true });
  const rules = (/** @type {string} */ title) => ({
    format: 1,
    title,
    fields: { "feeds.work": { max: 100 } },
  });
  file("hall/touchpath.config.json", rules("Hall"));
  file("hall/other.json", {
    format: 1,
    fields: { "feeds.work": { max: 1000 } },
  });
  file("hall/jobs/fast.json", { ...job("hole", "FAST"), feeds: { work: 140 } });
  const inside = (/** @type {string[]} */ ...args) =>
    spawnSync("node", [command, ...args], {
      cwd: join(folder, "hall", "jobs"),
      encoding: "utf8",
    });
  const ruled = inside("check", "fast.json");
  assert.deepEqual(
    [ruled.status, /Hall.*\[not-allowed\]/.test(ruled.stdout)],
    [1, true],
    ruled.stdout,
  );
  assert.equal(inside("check", "fast.json", "--no-config").status, 0);
  assert.equal(
    inside("check", "fast.json", "--config", "../other.json").status,
    0,
  );
  assert.equal(
    inside("check", "fast.json", "--config", "../other.json", "--no-config")
      .status,
    2,
  );
  assert.equal(
    run(["check", "hall/jobs/fast.json"]).status,
    0,
    "above it there are none",
  );
  file("hall/jobs/touchpath.config.json", { format: 1, tilte: "x" });
  const broken = inside("plan", "fast.json");
  assert.deepEqual([broken.status, broken.stdout], [2, ""]);
  assert.match(broken.stderr, /touchpath\.config\.json: config\.tilte/);
  assert.equal(inside("moves", "fast.json").status, 1, "it is for jobs");
});

test("the programs of a file with a job a line are verified by their own lines", () => {
  file(
    "lines.ndjson",
    `${JSON.stringify(job("hole", "E"))}\n${JSON.stringify(job("boss", "F"))}\n`,
  );
  assert.equal(
    run(["plan", "lines.ndjson", "-o", "of-lines", "--manifest"]).status,
    0,
  );
  const { status, stdout } = run(["verify", "of-lines", "--manifest"]);
  assert.equal(status, 0, stdout);
  assert.equal(stdout.trimEnd().split("\n").length, 2);
});
