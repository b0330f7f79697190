// The command with jobs by the line: in order over threads, as a stream, in little memory, to a reader or a terminal.

import assert from "node:assert/strict";
import { spawn, spawnSync } from "node:child_process";
import { once } from "node:events";
import { readFileSync, symlinkSync } from "node:fs";
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
    if (i === 12)
      return JSON.stringify({ ...job("hole"), name: "x".repeat(2_100_000) });
    return JSON.stringify(
      i % 7 === 3
        ? { ...wrong(), name: `W${i}` }
        : job(types[i % 4], `JOB_${i}`),
    );
  });
}

test("jobs by the line: in order, over any number of threads, the bad ones among the good", () => {
  const all = lines(300);
  file("jobs.ndjson", `${all.join("\n")}\n\n`);
  const outputs = ["1", "2", "5"].map((jobs) =>
    run(["plan", "jobs.ndjson", "--jobs", jobs]),
  );
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
    assert.equal(
      row.program,
      good ? touchpath.program(JSON.parse(String(all[i]))).text : null,
      String(i),
    );
    assert.equal(
      row.findings.some((/** @type {any} */ f) => f.level === "error"),
      !good,
    );
  });
  assert.equal(rows[11].findings[0].code, "not-json");
  assert.equal(rows[12].findings[0].code, "too-long");
  const piped = run(
    ["check", "-", "--ndjson", "--jobs", "2"],
    all.slice(0, 9).join("\n"),
  );
  assert.equal(piped.stdout.trimEnd().split("\n").length, 9);
  assert.match(piped.stdout, /^\{"source":"standard input:1","findings":\[/);
});

test("a reader that does not read holds the command up, and one that leaves ends it with one line", async () => {
  const line = `${JSON.stringify(job("hole"))}\n`.repeat(500);
  const child = spawn(
    "node",
    [command, "plan", "-", "--ndjson", "--jobs", "2"],
    { cwd: folder },
  );
  let taken = 0;
  let blocked = 0;
  child.stdin.on("error", () => undefined);
  // As much as it accepts while its output is not read.
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
  assert.deepEqual(
    [status, stderr],
    [141, ""],
    "not all was judged; no word of it, as of `head`",
  );
});

test("memory does not grow with the number of jobs", async () => {
  const child = spawn(
    "node",
    [command, "plan", "-", "--ndjson", "--jobs", "2"],
    { cwd: folder },
  );
  const line = `${JSON.stringify(job("hole"))}\n`.repeat(100);
  const count = 120;
  let lines = 0;
  /** @type {number[]} */
  const resident = [];
  child.stdout.on("data", (/** @type {Buffer} */ chunk) => {
    for (const byte of chunk) if (byte === 10) lines++;
  });
  for (let i = 0; i < count; i++) {
    if (!child.stdin.write(line))
      await new Promise((done) => child.stdin.once("drain", done));
    const [, kB] =
      /VmRSS:\s+(\d+)/.exec(
        readFileSync(`/proc/${child.pid}/status`, "utf8"),
      ) ?? [];
    resident.push(Number(kB));
  }
  child.stdin.end();
  assert.equal(await new Promise((done) => child.on("close", done)), 0);
  assert.equal(lines, 100 * count);
  const early = Math.max(...resident.slice(0, count / 2));
  const late = Math.max(...resident.slice(count / 2));
  assert.ok(
    late < early * 1.25 + 20_000,
    `${early} kB in the first half, ${late} kB in the second`,
  );
});

test("on a terminal it says how far it is; in a pipe nothing of it is seen", () => {
  file(
    "some.ndjson",
    `${lines(300)
      .filter((_, i) => ![11, 12].includes(i))
      .join("\n")}\n`,
  );
  const seen = spawnSync(
    "script",
    ["-qec", `node ${command} plan some.ndjson -o shown --jobs 1`, "/dev/null"],
    {
      cwd: folder,
      encoding: "utf8",
    },
  );
  assert.match(seen.stdout, /\[#* *\] \d+ jobs, \d+ a second/);
  assert.ok(
    !run(["plan", "some.ndjson", "-o", "hidden"]).stderr.includes("a second"),
  );
});

test("what cannot be read ends the run after what came before it was handed out, over any number of threads", () => {
  // A file that can be opened but not read.
  symlinkSync("/proc/self/mem", join(folder, "broken.ndjson"));
  file(
    "ten.ndjson",
    Array.from({ length: 10 }, (_, i) =>
      JSON.stringify(job("hole", `N${i}`)),
    ).join("\n"),
  );
  for (const jobs of ["1", "2", "4"]) {
    const { status, stdout, stderr } = run([
      "check",
      "ten.ndjson",
      "broken.ndjson",
      "--jobs",
      jobs,
    ]);
    assert.deepEqual(
      [status, stdout.trimEnd().split("\n").length],
      [2, 10],
      jobs,
    );
    assert.match(stderr, /^touchpath: broken\.ndjson cannot be read/);
  }
});

test("a job by the line is answered when it comes, not when there are many; long jobs do not pile up", async () => {
  const child = spawn(
    "node",
    [command, "check", "-", "--ndjson", "--jobs", "2"],
    { cwd: folder },
  );
  for (let i = 1; i <= 3; i++) {
    child.stdin.write(`${JSON.stringify(job("hole", `LIVE_${i}`))}\n`);
    const [answer] = await Promise.race([
      once(child.stdout, "data"),
      new Promise((_, fail) =>
        setTimeout(() => fail(new Error(`no answer to job ${i}`)), 10_000),
      ),
    ]);
    assert.equal(JSON.parse(String(answer)).source, `standard input:${i}`);
  }
  child.stdout.resume();
  const long = `${JSON.stringify(job("hole")).replace("{", `{${" ".repeat(1_900_000)}`)}\n`;
  let most = 0;
  for (let i = 0; i < 60; i++) {
    if (!child.stdin.write(long)) await once(child.stdin, "drain");
    const [, kB] =
      /VmRSS:\s+(\d+)/.exec(
        readFileSync(`/proc/${child.pid}/status`, "utf8"),
      ) ?? [];
    most = Math.max(most, Number(kB));
  }
  child.stdin.end();
  await once(child, "close");
  assert.ok(most < 450_000, `${most} kB`);
});
