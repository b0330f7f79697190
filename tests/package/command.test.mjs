// The command `touchpath`, as a shell runs it: what it writes, where, and how it ends.
import assert from "node:assert/strict";
import { spawn, spawnSync } from "node:child_process";
import { createHash } from "node:crypto";
import { once } from "node:events";
import {
  lstatSync,
  mkdirSync,
  mkdtempSync,
  readdirSync,
  readFileSync,
  rmSync,
  statSync,
  symlinkSync,
  utimesSync,
  writeFileSync,
} from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { at } from "../../scripts/lib.mjs";

/** @type {string} */
let folder;
/** @type {typeof import("../../www/core/node.ts")} */
let touchpath;

before(async () => {
  folder = mkdtempSync(join(tmpdir(), "touchpath-command-"));
  touchpath = /** @type {any} */ (await import("touchpath"));
});
after(() => rmSync(folder, { recursive: true }));

const command = at("dist", "cli", "touchpath.js");
/** Runs the command in the folder. */
const run = (/** @type {string[]} */ args, input = "") => {
  const { status, stdout, stderr } = spawnSync("node", [command, ...args], {
    cwd: folder,
    input,
    encoding: "utf8",
    maxBuffer: 1e9,
  });
  return { status, stdout, stderr };
};
/** Writes a file into the folder; gives its name. */
const file = (/** @type {string} */ name, /** @type {unknown} */ content) => {
  writeFileSync(join(folder, name), typeof content === "string" ? content : JSON.stringify(content));
  return name;
};
/** A job of a type under a name. */
const job = (/** @type {any} */ type, name = "PROBE") => ({ ...touchpath.defaultJob(type), name });
const wrong = () => ({ format: 1, name: "WRONG", cycle: { type: "hole", diameter: -1 } });

test("one job: its program, its table, its picture, byte for byte those of the package", () => {
  const own = /** @type {any} */ (job("groove"));
  const name = file("groove.json", own);
  assert.deepEqual(run(["plan", name]), { status: 0, stdout: touchpath.program(own).text, stderr: "" });
  assert.equal(run(["plan", "-"], JSON.stringify(own)).stdout, touchpath.program(own).text);
  const fanuc = { ...own, control: { ...own.control, post: "fanuc" } };
  const asked = run(["plan", name, "--post", "fanuc"]);
  assert.equal(asked.stdout, touchpath.program(fanuc).text);
  assert.equal(
    asked.stderr,
    "groove.json: warning: control.post: The job names the control linuxcnc: --post makes it for fanuc [other-control]\n",
  );
  const { control: _, ...unnamed } = own;
  const silent = run(["plan", "-", "--post", "fanuc"], JSON.stringify(unnamed));
  assert.deepEqual([silent.stdout, silent.stderr], [asked.stdout, ""], "a job that names none is for that control");
  const wrongControl = run(["plan", "-", "--post", "fanuc"], JSON.stringify({ ...own, control: 7 }));
  assert.match(wrongControl.stderr, /^standard input: error: control: /, "what is no control is not written over");
  for (const format of /** @type {const} */ (["text", "csv", "json"]))
    assert.equal(run(["table", name, "--format", format]).stdout, touchpath.exportTable(own, format));
  assert.equal(run(["svg", name, "--view", "top"]).stdout, touchpath.svg(own, "top"));
  assert.deepEqual(JSON.parse(run(["schema"]).stdout), touchpath.jobSchema());
  assert.deepEqual(JSON.parse(run(["catalog"]).stdout), touchpath.catalog());
  assert.equal(run(["--version"]).stdout, `${touchpath.version()}\n`);
  assert.match(run(["--help"]).stdout, /touchpath plan JOB/);
});

test("check, and a job with errors: everything at once, exit code 1", () => {
  const name = file("wrong.json", { ...wrong(), overtravel: -1 });
  const text = run(["check", name]);
  assert.equal(text.status, 1);
  assert.match(text.stdout, /^wrong\.json: error: overtravel: .* \[out-of-range\]$/m);
  assert.match(text.stdout, /^wrong\.json: error: cycle\.diameter: /m);
  const json = run(["check", "--json", name]);
  assert.deepEqual(JSON.parse(json.stdout), {
    source: name,
    findings: touchpath.check({ ...wrong(), overtravel: -1 }),
  });
  for (const args of [["plan"], ["table"], ["svg"]]) {
    const refused = run([...args, name]);
    assert.deepEqual([refused.status, refused.stdout], [1, ""], args.join());
    assert.match(refused.stderr, /error: cycle\.diameter/);
  }
  assert.equal(run(["check", file("good.json", job("hole"))]).status, 0);
  const none = run(["plan", file("none.json", "{")]);
  assert.equal(none.status, 1);
  assert.match(none.stderr, /^none\.json: error: This is not JSON: .*\[not-json\]\n$/);
  for (const junk of ["7", "null", "[]", '"x"', ""]) assert.equal(run(["plan", "-"], junk).status, 1, junk);
});

test("wrong use: one line, exit code 2, nothing written", () => {
  const name = file("hole.json", job("hole"));
  const other = file("other.json", job("boss"));
  mkdirSync(join(folder, "jobs"));
  for (const [args, why] of /** @type {[string[], RegExp][]} */ ([
    [["fly", name], /The command is one of plan, check/],
    [["plan"], /takes files/],
    [["plan", "missing.json"], /There is no file missing\.json/],
    [["plan", "missing-*.json"], /No file matches/],
    [["plan", name, "--colour"], /--colour/],
    [["plan", name, "--post", "mazak"], /--post is one of linuxcnc/],
    [["plan", name, "--form", "dance"], /--form is one of/],
    [["table", name, "--format", "xml"], /--format is one of csv/],
    [["plan", name, "--format", "csv"], /--format is for table, moves, evaluate/],
    [["check", name, "--view", "top"], /--view is for svg/],
    [["plan", name, other], /need a folder/],
    [["plan", name, "--jobs", "0"], /--jobs is a whole number/],
    [["plan", name, "--jobs", "many"], /--jobs is a whole number/],
    [["plan", name, "-o", join(name, "below")], /cannot be made/],
    [["plan", "."], /\. is a folder: name its files, as '\.\/\*\*\/\*\.json'/],
    [["plan", "jobs/", "-o", "none"], /jobs\/ is a folder: name its files, as 'jobs\/\*\*/],
    [["schema", name], /takes no files/],
    [["schema", "--post", "fanuc"], /takes no files and no options/],
    [["check", name, "-o", "nothing"], /--out is for plan/],
    [["plan", name, "--flat"], /--flat is for files in a folder/],
    [["evaluate", "-", "-"], /takes a job and a file/],
    [["evaluate", name], /takes a job and a file/],
    [["evaluate", name, "missing.csv"], /cannot be read/],
  ])) {
    const { status, stdout, stderr } = run(args);
    assert.deepEqual([status, stdout], [2, ""], `${args.join(" ")}: ${stderr}`);
    assert.match(stderr, why);
    assert.match(stderr, /^touchpath: [^\n]*\n$/, args.join(" "));
  }
  assert.ok(!readdirSync(folder).includes("none"), "an empty folder was left behind");
  assert.match(JSON.parse(run(["plan", "missing.json", "--json"]).stderr).error, /There is no file/);
  assert.equal(run([]).status, 2);
});

const MACRO = "(bore)\nG21 G90\nG0 X1 Y2.5 Z3\nG38.2 X#1 F50\nG3 X1 Y0 I0 J-1.25 F80\nM463 X-12\nG0 Z9\nM2\n";

test("moves: what readProgram reads, as text, CSV and JSON, with its findings", () => {
  const name = file("bore.ngc", MACRO);
  const read = touchpath.readProgram(MACRO);
  const text = run(["moves", name]);
  assert.equal(text.status, 0);
  assert.deepEqual(
    text.stdout.split("\n").map((line) => line.trim().split(/ +/)),
    [
      ["line", "kind", "X", "Y", "Z", "feed"],
      ["3", "rapid", "1.0000", "2.5000", "3.0000", "-"],
      ["4", "probe", "-", "2.5000", "3.0000", "50.0000"],
      ["5", "feed", "1.0000", "0.0000", "3.0000", "80.0000"],
      ["7", "rapid", "-", "-", "9.0000", "-"],
      [""],
    ],
  );
  for (const { message } of read.findings.filter((f) => f.level !== "info"))
    assert.ok(text.stderr.includes(message), message);
  assert.match(text.stderr, /M463 .*line 6/);
  assert.equal(
    run(["moves", "--format", "csv", name]).stdout,
    "line,kind,x,y,z,feed\n3,rapid,1,2.5,3,\n4,probe,,2.5,3,50\n5,feed,1,0,3,80\n7,rapid,,,9,\n",
  );
  const json = JSON.parse(run(["moves", "--format", "json", "-"], MACRO.replace("X#1", "X4")).stdout);
  assert.deepEqual([json.dialect, json.units, json.plane, json.moves.length], ["iso", "mm", "G17", 4]);
  assert.deepEqual(json.moves[0], { line: 3, kind: "rapid", to: [1, 2.5, 3], feed: null, arc: null });
  assert.equal(json.moves[3].to[0], null);
  const arc = JSON.parse(run(["moves", "--format", "json", "-"], "G21 G0 X1 Y0 Z0\nG3 X-1 I-1 F9\n").stdout).moves[1]
    .arc;
  assert.deepEqual([arc.center, arc.plane], [[0, 0, 0], "G17"]);
  assert.ok(Math.abs(arc.sweep - 180) < 1e-9);
  assert.deepEqual(json.findings, touchpath.readProgram(MACRO.replace("X#1", "X4")).findings);
});

test("moves: a text without any fails, many go into a folder, and more is read than of a job", () => {
  const none = run(["moves", file("none.nc", "G21;G91;G38.2 Z-17 F70\n")]);
  assert.equal(none.status, 1);
  assert.match(none.stderr, /semicolon.*line 1 \[no-moves\]/);
  assert.equal(run(["moves", file("a.nc", "G0 X1\n"), file("b.nc", "G0 X2\n")]).status, 2);
  assert.equal(run(["moves", "a.nc", "b.nc", "--format", "csv", "-o", "lists"]).status, 0);
  assert.deepEqual(readdirSync(join(folder, "lists")).sort(), ["a-moves.csv", "b-moves.csv"]);
  assert.match(run(["moves", "a.nc", "--format", "xml"]).stderr, /csv, json, text/);
  assert.match(run(["moves", "a.nc", "--post", "fanuc"]).stderr, /--post is for/);
  const long = `G21\n${"G1 X1 F100 (a comment of some length)\n".repeat(60_000)}`;
  assert.ok(long.length > touchpath.catalog().longestText && long.length < touchpath.catalog().longestProgram);
  const listed = run(["moves", "--format", "csv", file("long.nc", long)]);
  assert.deepEqual([listed.status, listed.stdout.split("\n").length], [0, 60_002]);
  assert.match(run(["import", "long.nc"]).stderr, /At most 2000000 characters/);
});

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
  const { status, stdout, stderr } = run(["plan", "many/**/*.json", "-o", "out"]);
  assert.equal(status, 1);
  assert.match(stderr, /many\/d\.json: error: cycle\.diameter/);
  const wanted = {
    "many/ONE.ngc": programOf(job("hole", "ONE")),
    "many/below/ONE.ngc": programOf(job("boss", "ONE")),
    "many/below/ESCAPE.ngc": programOf(job("web", "../../ESCAPE")),
    "many/TWO.nc": programOf({ ...job("groove", "TWO"), control: { post: "haas" } }),
  };
  assert.deepEqual(tree("out"), wanted);
  const sha = (/** @type {string} */ text) => createHash("sha256").update(text).digest("hex");
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
  // The same as JSON: with all findings, and nothing beside it.
  const json = run(["plan", "many/**/*.json", "-o", "again", "--json", "--post", "fanuc"]);
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
  for (const { file, hash } of rows) assert.equal(hash, file && sha(readFileSync(join(folder, file), "utf8")));
  // Without folders, and from a folder outside.
  assert.equal(run(["svg", "many/below/b.json", "many/e.json", "--flat", "-o", "flat"]).status, 0);
  assert.deepEqual(Object.keys(tree("flat")).sort(), ["ONE.svg", "TWO.svg"]);
  const outside = spawnSync("node", [command, "svg", "../a.json", join(folder, "many", "e.json"), "-o", "up"], {
    cwd: join(folder, "many", "below"),
    encoding: "utf8",
  });
  assert.equal(outside.status, 0, outside.stderr);
  assert.deepEqual(Object.keys(tree("many/below/up")).sort(), ["ONE.svg", "TWO.svg"]);
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
  // In folders of their own they are two files; in one folder they are not.
  const apart = ["plan", "clash/c.json", "clash/below/d.json", "-o", "apart"];
  assert.equal(run(apart).status, 0);
  const before = tree("apart");
  assert.deepEqual(Object.keys(before).sort(), ["clash/OTHER.ngc", "clash/below/OTHER.ngc"]);
  writeFileSync(join(folder, "apart", "OTHER.ngc"), "good");
  const flat = run([...apart, "--flat"]);
  assert.equal(flat.status, 2);
  assert.match(flat.stderr, /would both be OTHER\.ngc: nothing was written\n$/);
  assert.deepEqual(tree("apart"), { ...before, "OTHER.ngc": "good" });
  // All at once, in few words.
  file("clash/many.ndjson", Array.from({ length: 9 }, () => JSON.stringify(job("hole"))).join("\n"));
  const lines = run(["plan", "clash/many.ndjson", "-o", "never"]);
  assert.match(
    lines.stderr,
    /many\.ndjson:1 and clash\/many\.ndjson:2 would both be .*; and 3 more: nothing was written\n$/,
  );
  // A folder stands where a file must be.
  mkdirSync(join(folder, "blocked", "clash", "ONE.ngc"), { recursive: true });
  const blocked = run(["plan", "clash/a.json", "clash/c.json", "-o", "blocked"]);
  assert.equal(blocked.status, 2);
  assert.match(blocked.stderr, /ONE\.ngc would be a file and a folder: nothing was written/);
  assert.deepEqual(tree("blocked"), {});
});

/** Waits until something holds. */
async function until(/** @type {() => boolean} */ holds) {
  for (let i = 0; i < 600 && !holds(); i++) await new Promise((done) => setTimeout(done, 50));
  assert.ok(holds());
}

test("a run that was killed left half a program in the place of a good one: files are whole, old or new", async () => {
  mkdirSync(join(folder, "kept"));
  const good = "%\n(a good program)\n%\n";
  writeFileSync(join(folder, "kept", "FIRST.ngc"), good);
  for (const signal of /** @type {const} */ (["SIGINT", "SIGTERM", "SIGKILL"])) {
    const child = spawn("node", [command, "plan", "-", "--ndjson", "--jobs", "1", "-o", "kept"], { cwd: folder });
    child.stdin.write(`${JSON.stringify(job("hole", "FIRST"))}\n${JSON.stringify(job("hole", "SECOND"))}\n`);
    const aside = () => readdirSync(join(folder, "kept")).filter((name) => name.startsWith(".touchpath-"));
    await until(() => aside().some((name) => readdirSync(join(folder, "kept", name)).length === 2));
    child.kill(signal);
    const [status, by] = await once(child, "close");
    assert.deepEqual([status, by], signal === "SIGKILL" ? [null, signal] : [signal === "SIGINT" ? 130 : 143, null]);
    assert.equal(readFileSync(join(folder, "kept", "FIRST.ngc"), "utf8"), good);
    assert.deepEqual(
      readdirSync(join(folder, "kept")).filter((name) => !name.startsWith(".")),
      ["FIRST.ngc"],
    );
    assert.equal(aside().length, signal === "SIGKILL" ? 1 : 0, signal);
  }
  // What a kill has left is removed by a run of another day.
  const [left = ""] = readdirSync(join(folder, "kept")).filter((name) => name.startsWith("."));
  const past = new Date(Date.now() - 2 * 86_400_000);
  utimesSync(join(folder, "kept", left), past, past);
  const done = run(["plan", "-", "--ndjson", "-o", "kept"], JSON.stringify(job("hole", "FIRST")));
  assert.equal(done.status, 0, done.stderr);
  assert.deepEqual(tree("kept"), { "FIRST.ngc": programOf(job("hole", "FIRST")) });
});

test("a full disk leaves every file as it was, and says so in one line", () => {
  // No file may be longer than a kilobyte or so.
  mkdirSync(join(folder, "full"));
  writeFileSync(join(folder, "full", "BIG.ngc"), "good");
  file("big.json", job("hole", "BIG"));
  const limited = spawnSync("bash", ["-c", `trap "" XFSZ; ulimit -f 2; exec node ${command} plan big.json -o full`], {
    cwd: folder,
    encoding: "utf8",
  });
  assert.equal(limited.status, 2, limited.stderr);
  assert.match(limited.stderr, /^touchpath: BIG\.ngc cannot be written: [^\n]*: nothing was written\n$/);
  assert.deepEqual(tree("full"), { "BIG.ngc": "good" });
});

test("the rights of a file and a link to it stay when it is replaced", () => {
  mkdirSync(join(folder, "rights"));
  mkdirSync(join(folder, "elsewhere"));
  writeFileSync(join(folder, "elsewhere", "REAL.ngc"), "old", { mode: 0o640 });
  symlinkSync(join("..", "elsewhere", "REAL.ngc"), join(folder, "rights", "BIG.ngc"));
  file("big.json", job("hole", "BIG"));
  assert.equal(run(["plan", "big.json", "-o", "rights"]).status, 0);
  assert.ok(lstatSync(join(folder, "rights", "BIG.ngc")).isSymbolicLink());
  assert.equal(readFileSync(join(folder, "elsewhere", "REAL.ngc"), "utf8"), programOf(job("hole", "BIG")));
  assert.equal(statSync(join(folder, "elsewhere", "REAL.ngc")).mode & 0o777, 0o640);
});

test("a program that says no job ended with 1 and no error", () => {
  const { status, stdout, stderr } = run(["import", file("foreign.nc", "G21 G90 G0 X0 Y0\nG1 X5 F100\nM30\n")]);
  assert.deepEqual([status, stdout], [1, ""]);
  assert.match(stderr, /^foreign\.nc: error: This program says no job, only moves.* \[nothing-to-import\]$/m);
});

test("a dump becomes a job again, and measured points become results", () => {
  const own = /** @type {any} */ (job("double-wall-internal-corner"));
  const dump = file("dump.txt", touchpath.exportTable(own, "text"));
  const back = run(["import", dump]);
  assert.equal(back.status, 0);
  assert.deepEqual(JSON.parse(back.stdout), touchpath.importJob(touchpath.exportTable(own, "text")).job);
  assert.equal(run(["import", file("nothing.txt", "G1 X0\n")]).status, 1);
  const name = file("corner.json", own);
  const points = touchpath
    .plan(own)
    .triggers.map((t) => (t ?? []).join(", "))
    .join("\n");
  const results = run(["evaluate", name, file("points.csv", points), "--format", "json"]);
  assert.deepEqual(JSON.parse(results.stdout), JSON.parse(JSON.stringify(touchpath.evaluate(own, points))));
  assert.match(run(["evaluate", name, "points.csv"]).stdout, /^corner\.x +0\.0000 +-?0\.0000/m);
  const few = run(["evaluate", name, file("few.csv", "1, 2, 3")]);
  assert.equal(few.status, 1);
  assert.match(few.stderr, /error/);
});

test("a log of grbl becomes results and the block to type; without the work offset it is asked for", () => {
  // A pocket of 80 x 50 in G54 at X-200 Y-150 Z-60, touched 0.1 and 0.2 off: see tests/all/wayback.
  const touches = ["-162.9,-150", "-236.9,-150", "-200,-127.8", "-200,-171.8"].map((at) => `[PRB:${at},-70:1]\nok\n`);
  const pocket = /** @type {any} */ (job("internal-rectangle-protected"));
  const name = file("grbl.json", { ...pocket, control: { post: "grbl" } });
  const log = `G54\n<Idle|MPos:0,0,0|WCO:-200.000,-150.000,-60.000>\n${touches.join("")}`;
  const { status, stdout, stderr } = run(["evaluate", name, file("run.log", log)]);
  assert.equal(status, 0, stderr);
  assert.match(stdout, /^center\.x +0\.0000 +0\.1000/m);
  assert.match(stdout, /^Converted from machine coordinates by WCO in line 2: X-200 Y-150 Z-60 \(mm\)$/m);
  assert.match(stdout, /\n\nG21 G10 L20 P1 X-0\.1 Y-0\.2\n$/);
  const asked = run(["evaluate", name, file("asked.log", touches.join(""))]);
  assert.equal(asked.status, 1);
  assert.match(asked.stderr, /error: measured: .*Type \$#.* \[work-offset-needed\]/);
});

/** Jobs by the line, every seventh of them wrong, one no JSON and one too long. */
function lines(/** @type {number} */ count) {
  const types = /** @type {const} */ ([
    "hole",
    "groove",
    "internal-rectangle-protected",
    "double-wall-internal-corner",
  ]);
  return Array.from({ length: count }, (_, i) => {
    if (i === 11) return "no job";
    if (i === 12) return JSON.stringify({ ...job("hole"), name: "x".repeat(2_100_000) });
    return JSON.stringify(i % 7 === 3 ? { ...wrong(), name: `W${i}` } : job(types[i % 4], `JOB_${i}`));
  });
}

test("jobs by the line: in order, over any number of threads, the bad ones among the good", () => {
  const all = lines(300);
  file("jobs.ndjson", `${all.join("\n")}\n\n`);
  const outputs = ["1", "2", "5"].map((jobs) => run(["plan", "jobs.ndjson", "--jobs", jobs]));
  const [first] = outputs;
  for (const output of outputs) assert.deepEqual(output, first);
  assert.deepEqual([first?.status, first?.stderr], [1, ""]);
  const rows = (first?.stdout ?? "")
    .trimEnd()
    .split("\n")
    .map((line) => JSON.parse(line));
  assert.equal(rows.length, 300);
  rows.forEach((row, i) => {
    assert.equal(row.source, `jobs.ndjson:${i + 1}`);
    const good = ![11, 12].includes(i) && i % 7 !== 3;
    assert.equal(row.program, good ? touchpath.program(JSON.parse(String(all[i]))).text : null, String(i));
    assert.equal(
      row.findings.some((/** @type {any} */ f) => f.level === "error"),
      !good,
    );
  });
  assert.equal(rows[11].findings[0].code, "not-json");
  assert.equal(rows[12].findings[0].code, "too-long");
  const piped = run(["check", "-", "--ndjson", "--jobs", "2"], all.slice(0, 9).join("\n"));
  assert.equal(piped.stdout.trimEnd().split("\n").length, 9);
  assert.match(piped.stdout, /^\{"source":"standard input:1","findings":\[/);
});

test("a reader that does not read holds the command up, and one that leaves ends it with one line", async () => {
  const line = `${JSON.stringify(job("hole"))}\n`.repeat(500);
  const child = spawn("node", [command, "plan", "-", "--ndjson", "--jobs", "2"], { cwd: folder });
  let taken = 0;
  let blocked = 0;
  child.stdin.on("error", () => undefined);
  // As much as it takes while its output is not read.
  for (let i = 0; i < 400 && blocked < 20; i++) {
    if (child.stdin.write(line)) {
      taken += line.length;
      blocked = 0;
    } else {
      await Promise.race([
        new Promise((done) => child.stdin.once("drain", done)),
        new Promise((done) => setTimeout(done, 100)),
      ]);
      if (child.stdin.writableNeedDrain) blocked++;
      else taken += line.length;
    }
  }
  assert.ok(blocked >= 20, "it stops taking");
  assert.ok(taken < 10_000_000, `${taken} bytes were taken`);
  let stderr = "";
  child.stderr.on("data", (chunk) => {
    stderr += chunk;
  });
  child.stdout.destroy();
  child.stdin.end();
  const status = await new Promise((done) => child.on("close", done));
  assert.deepEqual([status, stderr], [2, "touchpath: The output was closed: the rest was not written\n"]);
});

test("memory does not grow with the number of jobs", async () => {
  const child = spawn("node", [command, "plan", "-", "--ndjson", "--jobs", "2"], { cwd: folder });
  const line = `${JSON.stringify(job("hole"))}\n`.repeat(100);
  const count = 120;
  let lines = 0;
  /** @type {number[]} */
  const resident = [];
  child.stdout.on("data", (/** @type {Buffer} */ chunk) => {
    for (const byte of chunk) if (byte === 10) lines++;
  });
  for (let i = 0; i < count; i++) {
    if (!child.stdin.write(line)) await new Promise((done) => child.stdin.once("drain", done));
    const [, kB] = /VmRSS:\s+(\d+)/.exec(readFileSync(`/proc/${child.pid}/status`, "utf8")) ?? [];
    resident.push(Number(kB));
  }
  child.stdin.end();
  assert.equal(await new Promise((done) => child.on("close", done)), 0);
  assert.equal(lines, 100 * count);
  const early = Math.max(...resident.slice(0, count / 2));
  const late = Math.max(...resident.slice(count / 2));
  assert.ok(late < early * 1.25 + 20_000, `${early} kB in the first half, ${late} kB in the second`);
});

test("on a terminal it says how far it is; in a pipe nothing of it is seen", () => {
  file(
    "some.ndjson",
    `${lines(300)
      .filter((_, i) => ![11, 12].includes(i))
      .join("\n")}\n`,
  );
  const seen = spawnSync("script", ["-qec", `node ${command} plan some.ndjson -o shown --jobs 1`, "/dev/null"], {
    cwd: folder,
    encoding: "utf8",
  });
  assert.match(seen.stdout, /\[#* *\] \d+ jobs, \d+ a second/);
  assert.ok(!run(["plan", "some.ndjson", "-o", "hidden"]).stderr.includes("a second"));
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
      [2, "touchpath: own/SELF.json would be written over the file that was read: nothing was written\n"],
    );
  }
  assert.equal(run(["import", "own/SELF.json", "-o", "alias", "--flat"]).status, 2);
  assert.equal(readFileSync(join(folder, "own/SELF.json"), "utf8"), before);
  assert.deepEqual(readdirSync(join(folder, "own")), ["SELF.json"]);
});

test("what cannot be read ends the run after what came before it was handed out, over any number of threads", () => {
  // A file that can be opened, and fails when it is read.
  symlinkSync("/proc/self/mem", join(folder, "broken.ndjson"));
  file("ten.ndjson", Array.from({ length: 10 }, (_, i) => JSON.stringify(job("hole", `N${i}`))).join("\n"));
  for (const jobs of ["1", "2", "4"]) {
    const { status, stdout, stderr } = run(["check", "ten.ndjson", "broken.ndjson", "--jobs", jobs]);
    assert.deepEqual([status, stdout.trimEnd().split("\n").length], [2, 10], jobs);
    assert.match(stderr, /^touchpath: broken\.ndjson cannot be read/);
  }
});

test("a job by the line is answered when it comes, not when there are many; long jobs do not pile up", async () => {
  const child = spawn("node", [command, "check", "-", "--ndjson", "--jobs", "2"], { cwd: folder });
  for (let i = 1; i <= 3; i++) {
    child.stdin.write(`${JSON.stringify(job("hole", `LIVE_${i}`))}\n`);
    const [answer] = await Promise.race([
      once(child.stdout, "data"),
      new Promise((_, fail) => setTimeout(() => fail(new Error(`no answer to job ${i}`)), 10_000)),
    ]);
    assert.equal(JSON.parse(String(answer)).source, `standard input:${i}`);
  }
  child.stdout.resume();
  const long = `${JSON.stringify(job("hole")).replace("{", `{${" ".repeat(1_900_000)}`)}\n`;
  let most = 0;
  for (let i = 0; i < 60; i++) {
    if (!child.stdin.write(long)) await once(child.stdin, "drain");
    const [, kB] = /VmRSS:\s+(\d+)/.exec(readFileSync(`/proc/${child.pid}/status`, "utf8")) ?? [];
    most = Math.max(most, Number(kB));
  }
  child.stdin.end();
  await once(child, "close");
  assert.ok(most < 450_000, `${most} kB`);
});
