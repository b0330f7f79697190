// A job's program inside another program: the function and the command.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { defaultJob, importJob, insertProgram, JobError } from "touchpath";
import { command, file, folder, run, setUp } from "./command.mjs";

setUp();

const PART =
  "%\r\nO0100 (BRACKET)\r\nG21 G17 G90\r\nT1 M6\r\nG43 H1 Z50.\r\n(PROBE)\r\nT24 M6\r\nG43 H24 Z50.\r\nM19\r\nT2 M6\r\nG43 H2 Z50.\r\nM30\r\n%\r\n";

function bore(name = "BORE", diameter = 30) {
  const job = defaultJob("hole");
  Object.assign(job, { name });
  Object.assign(job.cycle, { diameter });
  Object.assign(job.control, { post: "haas", workOffset: 1 });
  return job;
}

test("the function puts the program after the probe's length, with the line ends of the other program", () => {
  const { text, first, count, places, findings } = insertProgram(bore(), PART);
  const lines = text.split("\r\n");
  assert.equal(lines[first - 1], "G43 H24 Z50.");
  assert.equal(lines[first], "(TOUCHPATH BEGINS)");
  assert.equal(lines[first + count - 1], "(TOUCHPATH ENDS)");
  lines.splice(first, count);
  assert.equal(lines.join("\r\n"), PART);
  assert.deepEqual(places, [
    { line: 4, tool: "1", probe: false },
    { line: 7, tool: "24", probe: true },
    { line: 10, tool: "2", probe: false },
  ]);
  assert.deepEqual(
    findings.filter(({ code }) => code === "modes-set").length,
    1,
  );
  const { job } = importJob(text);
  assert.equal(job?.format === 1 && job.cycle.type, "hole");
  // Another line, and a config that refuses the job.
  assert.equal(insertProgram(bore(), PART, { line: 8 }).first, 9);
  assert.throws(
    () =>
      insertProgram(bore(), PART, {
        config: { format: 1, allow: { controls: ["fanuc"] } },
      }),
    JobError,
  );
  for (const wrong of /** @type {any[]} */ ([5, null, undefined, {}]))
    assert.throws(() => insertProgram(bore(), wrong), JobError);
  for (const line of [-1, 1e9, 0.5, Number.NaN])
    try {
      insertProgram(bore(), PART, { line });
    } catch (thrown) {
      assert.ok(thrown instanceof JobError, String(thrown));
    }
});

test("the command writes the whole program, says where it is, and verifies it", () => {
  writeFileSync(join(folder, "part.nc"), PART);
  const job = file("bore.json", bore());
  const made = run(["insert", job, "part.nc"]);
  assert.equal(made.status, 0);
  assert.match(made.stderr, /^The program is in lines 9 to \d+\n/);
  assert.equal(made.stdout, insertProgram(bore(), PART).text);
  writeFileSync(join(folder, "whole.nc"), made.stdout);
  assert.equal(run(["verify", "whole.nc"]).status, 0);
  // A second program, after a line; the first one is edited.
  const second = file("second.json", bore("SECOND", 50));
  const both = run(["insert", second, "whole.nc", "--line", "8"]);
  assert.equal(both.status, 0, both.stderr);
  writeFileSync(join(folder, "both.nc"), both.stdout);
  assert.equal(run(["verify", "both.nc"]).status, 0);
  const text = readFileSync(join(folder, "both.nc"), "utf8");
  for (const [digit, other] of [
    ["X17. Y0.", "X18. Y0."],
    ["X27. Y0.", "X28. Y0."],
  ]) {
    const edited = text.replace(String(digit), String(other));
    assert.notEqual(edited, text);
    writeFileSync(join(folder, "edited.nc"), edited);
    const { status, stdout } = run(["verify", "edited.nc"]);
    assert.equal(status, 1, digit);
    assert.match(stdout, new RegExp(`should be: .*${digit}`));
  }
  // A comment that is gone, and a block that came in above the header.
  for (const [from, to] of [
    ["(TOUCHPATH ENDS)", "(X)"],
    ["(TOUCHPATH BEGINS)", "(TOUCHPATH BEGINS)\r\nG1 Z-50. F5000."],
    ["(TOUCHPATH BEGINS, LABEL SET 2)", "(X)"],
  ]) {
    const edited = text.replace(String(from), String(to));
    assert.notEqual(edited, text);
    writeFileSync(join(folder, "edited.nc"), edited);
    assert.equal(run(["verify", "edited.nc"]).status, 1, from);
  }
  // A change of the program around does not count.
  writeFileSync(join(folder, "around.nc"), text.replace("M19", "M19 M8"));
  assert.equal(run(["verify", "around.nc"]).status, 0);
});

test("a file that is not UTF-8 keeps its bytes", () => {
  const name = Buffer.from([0x28, 0xfc, 0x29, 0x0d, 0x0a]);
  writeFileSync(
    join(folder, "latin.nc"),
    Buffer.concat([Buffer.from("\uFEFF"), Buffer.from(PART)]),
  );
  writeFileSync(
    join(folder, "latin1.nc"),
    Buffer.concat([name, Buffer.from(PART)]),
  );
  const job = file("bore.json", bore());
  for (const source of ["latin.nc", "latin1.nc"]) {
    const { stdout } = spawnSync("node", [command, "insert", job, source], {
      cwd: folder,
    });
    const given = readFileSync(join(folder, source));
    const head = given.subarray(0, given.indexOf("M19"));
    assert.ok(stdout.subarray(0, head.length).equals(head), source);
    const tail = given.subarray(head.length);
    assert.ok(
      stdout.subarray(stdout.length - tail.length).equals(tail),
      source,
    );
  }
});

test("what cannot be done is refused with its reason, and nothing is written", () => {
  const job = file("bore.json", bore());
  writeFileSync(join(folder, "none.nc"), "G21 G90\nG0 X0\nM30\n");
  const refused = run(["insert", job, "none.nc"]);
  assert.deepEqual([refused.status, refused.stdout], [1, ""]);
  assert.match(refused.stderr, /No tool change of a probe is found/);
  const small = file("small.json", bore("SMALL", 2));
  assert.match(run(["insert", small, "none.nc"]).stderr, /^error: cycle\./);
  for (const wrong of [
    ["insert", job],
    ["insert", job, "none.nc", "none.nc"],
    ["insert", job, "none.nc", "--line", "0"],
    ["insert", job, "none.nc", "--line", "x"],
    ["insert", job, "missing.nc"],
  ])
    assert.equal(run(wrong).status, 2, wrong.join(" "));
});
