// The command `touchpath` in a shell: its outputs, their place, and its exit codes.

import assert from "node:assert/strict";
import { mkdirSync, readdirSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { file, folder, job, run, setUp, touchpath, wrong } from "./command.mjs";

setUp();

test("one job: its program, its table, its picture, byte for byte those of the package", () => {
  const own = /** @type {any} */ (job("groove"));
  const name = file("groove.json", own);
  assert.deepEqual(run(["plan", name]), {
    status: 0,
    stdout: touchpath.program(own).text,
    stderr: "",
  });
  assert.equal(
    run(["plan", "-"], JSON.stringify(own)).stdout,
    touchpath.program(own).text,
  );
  const fanuc = { ...own, control: { ...own.control, post: "fanuc" } };
  const asked = run(["plan", name, "--post", "fanuc"]);
  assert.equal(asked.stdout, touchpath.program(fanuc).text);
  assert.equal(
    asked.stderr.replace(/:1:\d+:/, ":1:NN:"),
    "groove.json:1:NN: warning: control.post: The job names the control linuxcnc: --post makes it for fanuc [other-control]\n",
  );
  const { control: _, ...unnamed } = own;
  const silent = run(["plan", "-", "--post", "fanuc"], JSON.stringify(unnamed));
  assert.deepEqual(
    [silent.stdout, silent.stderr],
    [asked.stdout, ""],
    "a job that names none is for that control",
  );
  const wrongControl = run(
    ["plan", "-", "--post", "fanuc"],
    JSON.stringify({ ...own, control: 7 }),
  );
  assert.match(
    wrongControl.stderr,
    /^standard input:1:\d+: error: control: /,
    "what is no control is not written over",
  );
  for (const format of /** @type {const} */ (["text", "csv", "json"]))
    assert.equal(
      run(["table", name, "--format", format]).stdout,
      touchpath.exportTable(own, format),
    );
  assert.equal(
    run(["svg", name, "--view", "top"]).stdout,
    touchpath.svg(own, "top"),
  );
  assert.deepEqual(JSON.parse(run(["schema"]).stdout), touchpath.jobSchema());
  assert.deepEqual(JSON.parse(run(["catalog"]).stdout), touchpath.catalog());
  assert.equal(run(["--version"]).stdout, `${touchpath.version()}\n`);
  assert.match(run(["--help"]).stdout, /touchpath plan JOB/);
});

test("check, and a job with errors: everything at once, exit code 1", () => {
  const name = file("wrong.json", { ...wrong(), overtravel: -1 });
  const text = run(["check", name]);
  assert.equal(text.status, 1);
  assert.match(
    text.stdout,
    /^wrong\.json:1:\d+: error: overtravel: .* \[out-of-range\]$/m,
  );
  assert.match(text.stdout, /^wrong\.json:1:\d+: error: cycle\.diameter: /m);
  const json = run(["check", "--json", name]);
  const { source, findings } = JSON.parse(json.stdout);
  assert.deepEqual(
    {
      source,
      findings: findings.map(
        (/** @type {any} */ { line: _line, column: _column, ...f }) => f,
      ),
    },
    { source: name, findings: touchpath.check({ ...wrong(), overtravel: -1 }) },
  );
  for (const args of [["plan"], ["table"], ["svg"]]) {
    const refused = run([...args, name]);
    assert.deepEqual([refused.status, refused.stdout], [1, ""], args.join());
    assert.match(refused.stderr, /error: cycle\.diameter/);
  }
  assert.equal(run(["check", file("good.json", job("hole"))]).status, 0);
  const none = run(["plan", file("none.json", "{")]);
  assert.equal(none.status, 1);
  assert.match(none.stderr, /^none\.json: error: .*\[not-json\]\n$/);
  for (const junk of ["7", "null", "[]", '"x"', ""])
    assert.equal(run(["plan", "-"], junk).status, 1, junk);
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
    [["plan", name, "--post", "mazatrol"], /--post is one of linuxcnc/],
    [["plan", name, "--form", "dance"], /--form is one of/],
    [["table", name, "--format", "xml"], /--format is one of text, csv/],
    [
      ["plan", name, "--format", "csv"],
      /--format is for check, table, moves, examine, verify, evaluate/,
    ],
    [["check", name, "--view", "top"], /--view is for svg/],
    [["plan", name, other], /need a folder/],
    [["plan", name, "--jobs", "0"], /--jobs is a whole number/],
    [["plan", name, "--jobs", "many"], /--jobs is a whole number/],
    [["plan", name, "-o", join(name, "below")], /cannot be made/],
    [["plan", "."], /\. is a folder: name its files, as '\.\/\*\*\/\*\.json'/],
    [
      ["plan", "jobs/", "-o", "none"],
      /jobs\/ is a folder: name its files, as 'jobs\/\*\*/,
    ],
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
  assert.ok(
    !readdirSync(folder).includes("none"),
    "an empty folder was left behind",
  );
  assert.match(
    JSON.parse(run(["plan", "missing.json", "--json"]).stderr).error,
    /There is no file/,
  );
  assert.equal(run([]).status, 2);
});

const MACRO =
  "(bore)\nG21 G90\nG0 X1 Y2.5 Z3\nG38.2 X#1 F50\nG3 X1 Y0 I0 J-1.25 F80\nM463 X-12\nG0 Z9\nM2\n";

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
  const json = JSON.parse(
    run(["moves", "--format", "json", "-"], MACRO.replace("X#1", "X4")).stdout,
  );
  assert.deepEqual(
    [json.dialect, json.units, json.plane, json.moves.length],
    ["iso", "mm", "G17", 4],
  );
  assert.deepEqual(json.moves[0], {
    line: 3,
    kind: "rapid",
    to: [1, 2.5, 3],
    feed: null,
    arc: null,
  });
  assert.equal(json.moves[3].to[0], null);
  const arc = JSON.parse(
    run(["moves", "--format", "json", "-"], "G21 G0 X1 Y0 Z0\nG3 X-1 I-1 F9\n")
      .stdout,
  ).moves[1].arc;
  assert.deepEqual([arc.center, arc.plane], [[0, 0, 0], "G17"]);
  assert.ok(Math.abs(arc.sweep - 180) < 1e-9);
  assert.deepEqual(
    json.findings,
    touchpath.readProgram(MACRO.replace("X#1", "X4")).findings,
  );
});

test("moves: a text without any fails, many go into a folder, and more is read than of a job", () => {
  const none = run(["moves", file("none.nc", "G21;G91;G38.2 Z-17 F70\n")]);
  assert.equal(none.status, 1);
  assert.match(none.stderr, /semicolon.*line 1 \[no-moves\]/);
  assert.equal(
    run(["moves", file("a.nc", "G0 X1\n"), file("b.nc", "G0 X2\n")]).status,
    2,
  );
  assert.equal(
    run(["moves", "a.nc", "b.nc", "--format", "csv", "-o", "lists"]).status,
    0,
  );
  assert.deepEqual(readdirSync(join(folder, "lists")).sort(), [
    "a-moves.csv",
    "b-moves.csv",
  ]);
  assert.match(
    run(["moves", "a.nc", "--format", "xml"]).stderr,
    /text, csv, json/,
  );
  assert.match(
    run(["moves", "a.nc", "--post", "abacus"]).stderr,
    /linuxcnc, grbl/,
  );
  assert.match(
    run(["moves", "a.nc", "--offsets", "4"]).stderr,
    /--offsets takes 0 only/,
  );
  assert.match(
    run(["moves", "a.nc", "--form", "cycle"]).stderr,
    /--form is for/,
  );
  const long = `G21\n${"G1 X1 F100 (a comment of some length)\n".repeat(60_000)}`;
  assert.ok(
    long.length > touchpath.catalog().longestText &&
      long.length < touchpath.catalog().longestProgram,
  );
  const listed = run(["moves", "--format", "csv", file("long.nc", long)]);
  assert.deepEqual(
    [listed.status, listed.stdout.split("\n").length],
    [0, 60_002],
  );
  assert.match(run(["import", "long.nc"]).stderr, /At most 2000000 characters/);
});

test("a program that says no job ended with 1 and no error", () => {
  const { status, stdout, stderr } = run([
    "import",
    file("foreign.nc", "G21 G90 G0 X0 Y0\nG1 X5 F100\nM30\n"),
  ]);
  assert.deepEqual([status, stdout], [1, ""]);
  assert.match(stderr, /^foreign\.nc: error: .* \[nothing-to-import\]$/m);
});

test("a dump becomes a job again, and measured points become results", () => {
  const own = /** @type {any} */ (job("double-wall-internal-corner"));
  const dump = file("dump.txt", touchpath.exportTable(own, "text"));
  const back = run(["import", dump]);
  assert.equal(back.status, 0);
  assert.deepEqual(
    JSON.parse(back.stdout),
    touchpath.importJob(touchpath.exportTable(own, "text")).job,
  );
  assert.equal(run(["import", file("nothing.txt", "G1 X0\n")]).status, 1);
  const name = file("corner.json", own);
  const points = touchpath
    .plan(own)
    .triggers.map((t) => (t ?? []).join(", "))
    .join("\n");
  const results = run([
    "evaluate",
    name,
    file("points.csv", points),
    "--format",
    "json",
  ]);
  assert.deepEqual(
    JSON.parse(results.stdout),
    JSON.parse(JSON.stringify(touchpath.evaluate(own, points))),
  );
  assert.match(
    run(["evaluate", name, "points.csv"]).stdout,
    /^corner\.x +0\.0000 +-?0\.0000/m,
  );
  const few = run(["evaluate", name, file("few.csv", "1, 2, 3")]);
  assert.equal(few.status, 1);
  assert.match(few.stderr, /error/);
});

test("a log of grbl becomes results and the block to type; without the work offset it is asked for", () => {
  // A pocket of 80 x 50 in G54 at X-200 Y-150 Z-60, touched 0.1 and 0.2 off: see tests/all/wayback.
  const touches = [
    "-162.9,-150",
    "-236.9,-150",
    "-200,-127.8",
    "-200,-171.8",
  ].map((at) => `[PRB:${at},-70:1]\nok\n`);
  const pocket = /** @type {any} */ (job("internal-rectangle-protected"));
  const name = file("grbl.json", { ...pocket, control: { post: "grbl" } });
  const log = `G54\n<Idle|MPos:0,0,0|WCO:-200.000,-150.000,-60.000>\n${touches.join("")}`;
  const { status, stdout, stderr } = run([
    "evaluate",
    name,
    file("run.log", log),
  ]);
  assert.equal(status, 0, stderr);
  assert.match(stdout, /^center\.x +0\.0000 +0\.1000/m);
  assert.match(
    stdout,
    /^Converted from machine coordinates by WCO in line 2: X-200 Y-150 Z-60 \(mm\)$/m,
  );
  assert.match(stdout, /\n\nG21 G10 L20 P1 X-0\.1 Y-0\.2\n$/);
  const asked = run(["evaluate", name, file("asked.log", touches.join(""))]);
  assert.equal(asked.status, 1);
  assert.match(
    asked.stderr,
    /error: measured: .*Type \$#.* \[work-offset-needed\]/,
  );
});

test("verify: programs still are those of the jobs in their headers, or the lines are named that are not", () => {
  const own = /** @type {any} */ (job("hole"));
  const programs = join(folder, "programs", "shop");
  mkdirSync(programs, { recursive: true });
  const put = (/** @type {string} */ name, /** @type {string} */ text) =>
    file(join("programs", "shop", name), text);
  const { text } = touchpath.program(own);
  put("same.ngc", text.replaceAll("\n", "\r\n"));
  const good = run(["verify", join(folder, "programs")]);
  assert.equal(good.status, 0, good.stderr);
  assert.match(good.stdout, /same\.ngc: is its job's program\n$/);

  const touch = text.split("\n").findIndex((line) => line.startsWith("G38.2"));
  const line = /** @type {string} */ (text.split("\n")[touch]);
  put("edited.ngc", text.replace(line, line.replace("F150", "F1500")));
  put(
    "older.ngc",
    text.replace(
      `Made by Touchpath ${touchpath.version()}`,
      "Made by Touchpath 0.2.0",
    ),
  );
  put("other.ngc", "G21\nG0 X5\nM2\n");
  put(
    "refused.ngc",
    text.replace(/cycle\.diameter=[\d.]+/, "cycle.diameter=5"),
  );
  put("longer.ngc", text.replace(line, `${line}\nM5`));
  put("strange.ngc", text.replace(line, `${line}\nG4 P1`));
  const bad = run(["verify", join(folder, "programs")]);
  assert.equal(bad.status, 1);
  assert.match(
    bad.stdout,
    /older\.ngc: is its job's program; version 0\.2\.0 wrote it\n/,
  );
  assert.match(bad.stdout, /other\.ngc: its header says no job\n/);
  assert.match(
    bad.stdout,
    /strange\.ngc: has lines that are not of its job's program\n/,
  );
  assert.match(
    bad.stderr,
    /strange\.ngc: error: Line \d+: this code is not understood: "G4"/,
  );
  assert.match(bad.stdout, /refused\.ngc: this version refuses its job\n/);
  assert.ok(
    bad.stdout.includes(
      `edited.ngc: a line differs from its job's program\n  line ${touch + 1}: ${line.replace("F150", "F1500")}\n         should be: ${line}\n`,
    ),
    bad.stdout,
  );
  const listed = run([
    "verify",
    join(programs, "longer.ngc"),
    "--format",
    "json",
  ]);
  assert.equal(listed.status, 1);
  const { state, lines } = JSON.parse(listed.stdout);
  assert.deepEqual(
    [state, lines],
    ["changed", [{ line: touch + 2, is: "M5", wanted: null }]],
  );
  assert.equal(run(["verify", join(folder, "nothing-there")]).status, 2);
});

test("verify listed 47 lines where two were edited: the first and the last touch", () => {
  const own = /** @type {any} */ (job("hole"));
  own.control = { post: "haas" };
  const text = touchpath.program(own).text.split("\n");
  const touches = text.flatMap((line, i) =>
    /^G31 .*F150\./.test(line) ? [i] : [],
  );
  const [first = 0, last = 0] = [touches[0], touches.at(-1)];
  assert.ok(last - first > 10);
  for (const i of [first, last])
    text[i] = String(text[i]).replace("F150.", "F1500.");
  // A line that is missing, and one that was added, far from them.
  const gone = text.findIndex((line) => /^M9$/.test(line));
  const name = file("two.nc", text.filter((_, i) => i !== gone).join("\n"));
  const { stdout, status } = run(["verify", name, "--format", "json"]);
  assert.equal(status, 1);
  const { said, lines } = JSON.parse(stdout);
  assert.equal(said, "3 lines differ from its job's program");
  assert.deepEqual(
    lines.map((/** @type {any} */ one) => one.line),
    [gone + 1, first, last],
  );
  assert.deepEqual(lines[0], { line: gone + 1, is: null, wanted: "M9" });
  assert.equal(lines[2].is, text[last]);
  assert.equal(lines[2].wanted, String(text[last]).replace("F1500.", "F150."));
});

test("verify names the place of a missing first block, and no equal lines of a program that differs everywhere", () => {
  const own = /** @type {any} */ (job("hole"));
  own.control = { post: "haas" };
  const text = touchpath.program(own).text.split("\n");
  const head = text.findIndex((line) => /Blocks below/i.test(line));
  const told = (/** @type {string} */ name, /** @type {string[]} */ lines) =>
    JSON.parse(
      run(["verify", file(name, lines.join("\n")), "--format", "json"]).stdout,
    );
  const first = told(
    "first.ngc",
    text.filter((_, i) => i !== head + 1),
  );
  assert.deepEqual(first.lines, [
    { line: head + 2, is: null, wanted: text[head + 1] },
  ]);
  const blocks = text.slice(head + 1).filter((line) => line.trim() !== "");
  const none = told("none.ngc", text.slice(0, head + 1));
  assert.match(none.said, new RegExp(`^${blocks.length} lines differ`));
  assert.ok(none.lines.every((/** @type {any} */ one) => one.line > head));
  // More edits than are looked for.
  const cycles = Array.from({ length: 80 }, (_, i) => ({
    type: "hole",
    name: `B${i}`,
    origin: [60 * i, 0, 0],
  }));
  const many = touchpath
    .program({ format: 2, cycles: /** @type {any} */ (cycles) })
    .text.split("\n");
  const moved = many.map((line) =>
    line.startsWith("(") ? line : line.replace(/F\d+/, "F77"),
  );
  const count = moved.filter((line, i) => line !== many[i]).length;
  assert.ok(count > 1000);
  const { said, lines } = told("many.ngc", moved);
  assert.equal(said, `${count} lines differ from its job's program`);
  assert.ok(lines.every((/** @type {any} */ one) => one.is !== one.wanted));
});
