// Foreign programs, run by the package and judged by the command.
import assert from "node:assert/strict";
import { test } from "node:test";
import { file, run, setUp, touchpath } from "./command.mjs";

setUp();

/** A foreign macro: the touch moves by 20, from 10 to −10. */
const MACRO = `o<edge> sub
G21 G90
G38.2 X[0 - #1] F50
#<edge> = [#5061 - #5410 / 2]
G1 X[#<edge> + 3] F200
G10 L20 P1 X0
G38.2 Y[#1 * 2] F50
o<edge> endsub
`;

test("runProgram: what is known moves the probe, what is not is NaN and asked for", () => {
  const { runProgram } = touchpath;
  const bare = runProgram(MACRO);
  assert.deepEqual(bare.asks, [
    { name: "#1", lines: [2, 6] },
    { name: "#5410", lines: [3] },
  ]);
  assert.ok(Number.isNaN(bare.to[0]));
  const known = {
    set: { "#1": 10, "#5410": 6 },
    start: /** @type {[number, number, number]} */ ([10, 0, -2]),
    part: { at: 0.5 },
  };
  const told = runProgram(MACRO, known);
  assert.deepEqual(
    [told.dialect, told.units, told.asks, told.kinds],
    ["iso", "mm", [], ["rapid", "feed", "probe"]],
  );
  // Half-way from 10 to −10 is 0; the ball's radius is 3.
  assert.deepEqual([...told.to], [-10, 0, -2, 0, 0, -2, 0, 20, -2]);
  // At X0 the write of the offset moves nothing.
  assert.deepEqual([...told.contacts], [0, 0, 0, -2, 2, 0, 10, -2]);
  assert.deepEqual([...told.systems], []);
  assert.deepEqual([...told.line], [2, 4, 6]);
  const early = told.rules.find(({ rule }) => rule === "offset-after-touches");
  assert.deepEqual([early?.holds, early?.lines], [false, [5]]);
  for (const finding of told.findings)
    assert.ok(Array.isArray(finding.lines), finding.code);
  assert.deepEqual(
    runProgram(MACRO, known),
    told,
    "the same text and knowledge give the same run",
  );
});

test("runProgram: a job as the part: a program touches it where its ball makes contact", () => {
  /** @type {any} */
  const part = {
    cycle: { type: "hole", origin: [0, 0, 0], diameter: 40 },
    part: { offset: [0.5, 0, 0], rotation: 0, sizes: {} },
    stylus: { diameter: 6 },
  };
  const text =
    "G21 G90\nG0 X0 Y0 Z-5\nG38.2 X30 F50\nG0 X0\nG38.2 X-30\nG0 X0 Z20\nG38.2 X30\nM2\n";
  const run = touchpath.runProgram(text, { part, start: [0, 0, 20] });
  // The wall is at 20.5 and at −19.5, the ball's radius is 3; above the hole there is nothing, and G38.2 stops the program.
  const near = (/** @type {number[]} */ own, /** @type {number[]} */ wanted) =>
    assert.ok(
      own.length === wanted.length &&
        own.every((x, i) => Math.abs(x - Number(wanted[i])) < 1e-9),
      `${own}`,
    );
  near([...run.contacts], [1, 17.5, 0, -5, 3, -16.5, 0, -5]);
  assert.throws(
    () =>
      touchpath.runProgram(text, {
        part: { cycle: { ...part.cycle, diameter: -1 } },
      }),
    /diameter/i,
  );
});

test("runProgram: what is handed over wrongly is refused, all of it at once; nothing hangs or breaks", () => {
  /** @type {any} */
  const anything = touchpath.runProgram;
  const findings = (/** @type {unknown} */ known) => {
    try {
      anything("G21", known);
    } catch (thrown) {
      return /** @type {any} */ (thrown).findings.map(
        (/** @type {any} */ f) => f.path,
      );
    }
    return [];
  };
  assert.deepEqual(
    findings({
      set: { "#1": "x", 5: 1 },
      start: [1],
      part: { at: 2 },
      dialect: "apt",
      much: 1,
    }).sort(),
    ["dialect", "much", "part.at", "set.#1", "set.5", "start"],
  );
  for (const junk of [7, "x", [], () => 1])
    assert.equal(findings(junk).length, 1, String(junk));
  for (const none of [undefined, null, {}])
    assert.deepEqual(findings(none), []);
  /** @type {any} */
  const circle = { set: {} };
  circle.set.again = circle;
  assert.ok(findings(circle).length > 0);
  assert.throws(() => anything(5), /A program is text/);
  const endless = "o1 while [1]\nG38.3 X1 F50\no1 endwhile\n";
  assert.ok(
    touchpath.runProgram(endless, { part: { at: 0.5 } }).findings.length > 0,
  );
  const round =
    "BEGIN PGM A MM\nLBL 1\nL IX+1 F100\nFN 9: IF +1 EQU +1 GOTO LBL 1\nEND PGM A MM\n";
  assert.ok(touchpath.runProgram(round).findings.length > 0);
  assert.ok(
    touchpath.runProgram("AGAIN:\nG1 X=IC(1) F10\nGOTOB AGAIN\nM30\n", {
      dialect: "sinumerik",
    }).findings.length > 0,
  );
});

test("examine: rules, calls and what is asked for, as text, JSON and SARIF; exit code 1 where a rule is broken", () => {
  const name = file("edge.ngc", MACRO);
  const text = run([
    "examine",
    name,
    "--set",
    "#1=10",
    "--set",
    "#5410=6",
    "--start",
    "10,0,-2",
    "--at",
    "0.5",
  ]);
  assert.equal(text.status, 1);
  assert.match(
    text.stdout,
    /^edge\.ngc: iso, mm, 3 moves, 2 of them probing$/m,
  );
  assert.match(
    text.stdout,
    /^ {2}BREAKS +offset-after-touches +.*\[line 6\]$/m,
  );
  assert.match(
    run(["examine", name]).stdout,
    /^ {2}asks +--set #1=… \[lines 3, 7\]$/m,
  );
  const json = JSON.parse(run(["examine", name, "--format", "json"]).stdout);
  assert.deepEqual(
    json.rules.map((/** @type {any} */ row) => row.rule),
    touchpath.runProgram(MACRO).rules.map(({ rule }) => rule),
  );
  const calls = file("calls.nc", "G21 G90\nG65 P9812 X5. Y6.\nM30\n");
  const log = JSON.parse(
    run(["examine", name, calls, "--format", "sarif"]).stdout,
  );
  assert.equal(log.version, "2.1.0");
  const places = log.runs[0].results.map((/** @type {any} */ result) => [
    result.ruleId,
    result.level,
    result.locations[0].physicalLocation.artifactLocation.uri,
    result.locations[0].physicalLocation.region?.startLine,
  ]);
  const has = (/** @type {any[]} */ ...row) =>
    assert.ok(
      places.some((/** @type {any[]} */ own) =>
        row.every((x, i) => own[i] === x),
      ),
      row.join(" "),
    );
  has("offset-after-touches", "error", "edge.ngc", 6);
  has("call-unsound", "error", "calls.nc", 2);
  const ids = log.runs[0].tool.driver.rules.map(
    (/** @type {any} */ rule) => rule.id,
  );
  assert.deepEqual(
    [...new Set(places.map((/** @type {any[]} */ [id]) => id))].sort(),
    ids,
  );
  // Nothing is broken: exit code 0. Subprograms of other files are run.
  const main = file("main.nc", "G21 G17 G90\nM5\no<go> call\nM2\n");
  const sub = file("go.ngc", "o<go> sub\nG38.2 Z-5 F50\no<go> endsub\n");
  const good = run(["examine", main, "--with", sub, "--start", "0,0,9"]);
  assert.deepEqual(
    [good.status, /1 moves, 1 of them probing/.test(good.stdout)],
    [0, true],
    good.stdout,
  );
  assert.match(
    run(["moves", main, "--with", sub, "--format", "csv"]).stdout,
    /^2,probe,,,-5,50$/m,
  );
  for (const wrong of [
    ["--set", "5"],
    ["--set", "#1=x"],
    ["--start", "1,2"],
    ["--at", "half"],
    ["--with", "no.ngc"],
  ])
    assert.equal(run(["examine", name, ...wrong]).status, 2, wrong.join(" "));
  assert.match(
    run(["plan", "-", "--at", "1"]).stderr,
    /--at is for moves, examine/,
  );
});

test("runProgram: where the coordinate system is, what is written, for which control", () => {
  const { runProgram } = touchpath;
  const text = "G21 G90 G54\nG0 Z20\nG38.2 Z0 F60\nG10 L20 P1 Z0\nG0 Z5\n";
  const run = runProgram(text, {
    start: [0, 0, 30],
    part: { at: 0.5 },
    post: "grbl",
  });
  // The contact is at 10, which is set to 0: Z5 is 15 in the system before.
  assert.deepEqual(
    [...run.systems],
    [2, 0, 0, 10, 0],
    "index, origin, rotation",
  );
  assert.equal(run.to.at(-1), 5);
  assert.deepEqual(run.writes, [
    {
      line: 3,
      file: 0,
      kind: "offset",
      register: "G54",
      axis: "Z",
      value: 0,
      guarded: false,
    },
  ]);
  // The shift between G54 and G55 is unknown, or nothing is set.
  const other = "G21 G90 G54\nG0 Z20\nG55\nG91 G0 Z5\n";
  const end = (/** @type {any} */ known) =>
    runProgram(other, { start: [0, 0, 30], ...known }).to.at(-1);
  assert.ok(Number.isNaN(end({})));
  assert.equal(end({ offsets: 0 }), 25);
  assert.equal(end({ set: { "#5223": 1, "#5243": 4 } }), 22);
  assert.throws(
    () => runProgram(text, /** @type {any} */ ({ post: "abacus", offsets: 3 })),
    (/** @type {any} */ error) =>
      error.findings
        .map((/** @type {any} */ f) => f.path)
        .sort()
        .join() === "offsets,post",
  );
});
