// Inspection reports: measurements of parts against numbers computed by hand, as data, CSV, a page, and by the command.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { file, folder, run, setUp, touchpath } from "./command.mjs";

setUp();

const root = new URL("../..", import.meta.url);
const example = () =>
  JSON.parse(
    readFileSync(new URL("examples/set-ups/first-article.json", root), "utf8"),
  );
const reports = () => import(new URL("dist/report.js", root).href);

/** What the program of the first article prints of a part whose bore has this diameter. @param {number} bore */
function printed(bore) {
  const plan = touchpath.plan(example());
  const names = [...plan.cycles, ...plan.relations];
  const rows = plan.results.filter(
    ({ value, code }) => value !== null && !code.startsWith("offset."),
  );
  const value = (/** @type {any} */ row) =>
    names[row.cycle] === "BORE" && row.code === "diameter" ? bore : row.nominal;
  const lines = rows.map((row) =>
    [names[row.cycle], row.code.replace(".", " "), value(row)]
      .join(" ")
      .toUpperCase(),
  );
  return ["FIRST", ...lines].join("\n");
}

test("a series: mean, spread, trend, Cp and Cpk as by hand", async () => {
  const { report, runsOf } = await reports();
  const plan = touchpath.plan(example());
  // 25.008, 25.010, 25.009, 25.013: mean 25.01, squares 4 + 0 + 1 + 9 = 14 µm², s = √(14/3) µm; slope (−1.5·−2 − 0.5·0 + 0.5·−1 + 1.5·3)/5 = 7/5 µm a part.
  const log = [25.008, 25.01, 25.009, 25.013].map(printed).join("\n");
  const runs = runsOf(log, plan);
  assert.equal(runs.length, 4);
  assert.ok(
    runs.every((/** @type {string} */ text) => text.startsWith("FIRST\n")),
    "the name belongs to its run",
  );
  const parts = runs.map((/** @type {string} */ text) =>
    touchpath.measure(example(), text),
  );
  const of = report({ plan, parts, name: "FIRST", by: "Ada" });
  const row = of.rows.find(
    (/** @type {any} */ one) => one.code === "BORE.diameter",
  );
  assert.deepEqual(row.values, [25.008, 25.01, 25.009, 25.013]);
  assert.deepEqual(row.limits, [25, 25.021]);
  const near = (/** @type {number} */ a, /** @type {number} */ b) =>
    assert.ok(Math.abs(a - b) < 1e-9, `${a} ${b}`);
  const s = Math.sqrt(14 / 3) * 1e-3;
  near(row.series.mean, 25.01);
  near(row.series.spread, s);
  near(row.series.trend, 0.0014);
  near(row.series.cp, 0.021 / (6 * s));
  near(row.series.cpk, 0.01 / (3 * s));
  assert.deepEqual(
    [row.series.count, row.series.min, row.series.max],
    [4, 25.008, 25.013],
  );
  assert.equal(
    of.verdict,
    "good within ±",
    "20h6 and 25H7 of nominal size end where they begin",
  );
  assert.equal(of.program, /Blocks below: (\w+)/i.exec(plan.program.text)?.[1]);
  // A single value has no spread, and no capability.
  const one = report({
    plan,
    parts: parts.slice(0, 2).map((/** @type {any} */ { results }) => ({
      results: results.slice(0, 3),
    })),
  });
  assert.equal(
    one.rows.find((/** @type {any} */ r) => r.code === "PITCH.distance").series,
    null,
  );
});

test("the components that Renishaw's macros print are the parts of a series", async () => {
  const { report, runsOf } = await reports();
  const job = touchpath.defaultJob("hole");
  job.cycle.diameter = 40;
  const plan = touchpath.plan(job);
  const log = [40.01, 40.03]
    .map(
      (size, i) =>
        `COMPONENT NO ${i + 1}   FEATURE NO 1\nSIZE D 40.0000   ACTUAL ${size.toFixed(4)}   DEV ${(size - 40).toFixed(4)}\nPOSN X 0.0000   ACTUAL 0.0000\nPOSN Y 0.0000   ACTUAL 0.0000\n`,
    )
    .join("");
  const parts = runsOf(log, plan).map((/** @type {string} */ text) =>
    touchpath.measure(job, text),
  );
  const row = report({ plan, parts }).rows.find(
    (/** @type {any} */ one) => one.code === "diameter",
  );
  assert.deepEqual(row.values, [40.01, 40.03]);
});

test("what a program says of a result is no run, equal parts have no capability, and a set-up of one cycle keeps its names", async () => {
  const { report, runsOf } = await reports();
  const job = /** @type {any} */ ({
    format: 1,
    cycle: { type: "hole", diameter: 25 },
    tolerances: { diameter: { tolerance: "H7", action: "mark" } },
  });
  const plan = touchpath.plan(job);
  const run =
    "center.x=0\ncenter.y=0\ndiameter=25.03\nresidual=0\ndiameter is 25.03, not 25 to 25.021";
  assert.deepEqual(runsOf(run, plan), [run]);
  assert.equal(runsOf(`${run}\n${run}`, plan).length, 2);
  assert.equal(
    runsOf(
      "center.x=0 center.y=0 diameter=25 residual=0\ncenter.x=1 center.y=0 diameter=25 residual=0",
      plan,
    ).length,
    2,
  );
  const equal = Array.from({ length: 3 }, () =>
    touchpath.measure(
      job,
      "center.x=0\ncenter.y=0\ndiameter=25.0131\nresidual=0",
    ),
  );
  const { cp, cpk } = report({ plan, parts: equal }).rows.find(
    (/** @type {any} */ row) => row.code === "diameter",
  ).series;
  assert.deepEqual([cp, cpk], [null, null]);
  // A virtual part with a missed touch has no expected results; a value that a machine did not measure is still not measured.
  const missed = { ...job, part: { offset: [30, 0, 0] } };
  const part = touchpath.measure(missed, "center.x=0\ncenter.y=0\nresidual=0");
  assert.equal(
    report({ plan: touchpath.plan(missed), parts: [part] }).verdict,
    "not measured",
  );
});

test("parts that were read from a control's variables are told apart, and their relations judged", async () => {
  const { report, runsOf } = await reports();
  const owns = touchpath
    .catalog()
    .posts.filter(({ cycles }) =>
      cycles.some(
        ({ type, form, supported }) =>
          type === "hole" && form === "cycle" && supported,
      ),
    );
  assert.ok(owns.length >= 8);
  for (const { id: post } of owns) {
    const hole = (/** @type {string} */ name, /** @type {number} */ x) => ({
      name,
      type: "hole",
      diameter: 20,
      origin: [x, 0, 0],
    });
    const job = /** @type {any} */ ({
      format: 2,
      control: { post, form: "cycle" },
      cycles: [hole("LEFT", -60), hole("RIGHT", 60)],
      relations: [{ name: "ROW", type: "line", of: ["LEFT", "RIGHT"] }],
      tolerances: { "ROW.distance": { tolerance: "±0.1" } },
    });
    const plan = touchpath.plan(job);
    // Some programs compute the relation, too: it is not entered.
    const variables = plan.results.flatMap(({ cycle, stored }) =>
      stored === null || cycle >= plan.cycles.length ? [] : [stored],
    );
    assert.equal(variables.length, 6);
    const values = (/** @type {number} */ x) => [-60, 0, 20, x, 0, 20];
    const run = (/** @type {number} */ x) =>
      variables
        .map((name, i) => `${name} = ${values(x)[i]}`)
        .join("\n")
        .replaceAll(".", ",");
    const runs = runsOf([60.01, 60.05, 60.2].map(run).join("\n"), plan);
    assert.equal(runs.length, 3, post);
    const parts = runs.map((/** @type {string} */ text) =>
      touchpath.measure(job, text),
    );
    const row = report({ plan, parts }).rows.find(
      (/** @type {any} */ { code }) => code === "ROW.distance",
    );
    assert.deepEqual(
      row?.values.map((/** @type {number} */ x) => x.toFixed(6)),
      ["120.010000", "120.050000", "120.200000"],
    );
    assert.equal(
      parts[2]?.results.find(
        (/** @type {any} */ { code }) => code === "distance",
      )?.verdict,
      "out",
      post,
    );
  }
});

test("a missing value is not good, and a bad one is the verdict", async () => {
  const { report } = await reports();
  const plan = touchpath.plan(example());
  const text = printed(25.01);
  const measured = (/** @type {string} */ log) =>
    report({ plan, parts: [touchpath.measure(example(), log)] });
  assert.equal(
    measured(text.replace(/RIB WIDTH.*\n/, "")).verdict,
    "not measured",
  );
  assert.equal(measured(printed(25.04)).verdict, "out");
  // 25H7 ends at 25.021, and the expanded uncertainty of the diameter is 0.002.
  assert.equal(measured(printed(25.0215)).verdict, "out within ±");
  const { rows } = measured(text);
  assert.ok(
    !rows.some((/** @type {any} */ row) => row.code === "POCKET.rotation"),
    "what nothing measures is not listed",
  );
});

test("the page and the CSV hold what was typed as text", async () => {
  const { report, reportCsv, reportHtml } = await reports();
  const plan = touchpath.plan(example());
  const part = touchpath.measure(example(), printed(25.01));
  const nasty = '<script>alert("x")</script>';
  const of = report({
    plan,
    parts: [part],
    name: nasty,
    by: nasty,
    machine: '=cmd|"x"',
    note: nasty,
    when: nasty,
  });
  const page = reportHtml(of, touchpath.svg(example(), "top"));
  assert.ok(!page.includes("<script"), "escaped");
  assert.match(
    page,
    /<svg[\s\S]*BORE\.diameter[\s\S]*25\.0000 … 25\.0210[\s\S]*25\.0100/,
  );
  const lines = reportCsv(of).trimEnd().split("\n");
  assert.equal(
    lines[0],
    "result,meaning,unit,nominal,lower,upper,measured,deviation,expanded uncertainty,verdict",
  );
  assert.ok(
    lines.includes(
      "BORE.diameter,Diameter,mm,25.0000,25.0000,25.0210,25.0100,0.0100,0.00200,good",
    ),
  );
});

test("the command reports a part, a log of several, and fails where a part is not good", () => {
  const job = file("first.json", example());
  const good = file("good.txt", printed(25.01));
  const log = file("log.txt", `${printed(25.01)}\n${printed(25.012)}\n`);
  const bad = file("bad.txt", printed(25.05));
  const csv = run(["report", job, good, log, "--format", "csv"]);
  assert.equal(csv.status, 0, csv.stderr);
  assert.match(csv.stdout, /measured 1,measured 2,measured 3/);
  const json = JSON.parse(
    run([
      "report",
      job,
      good,
      "--format",
      "json",
      "--by",
      "Ada",
      "--machine",
      "VF-2",
      "--when",
      "today",
    ]).stdout,
  );
  assert.deepEqual(
    [json.by, json.machine, json.when, json.parts],
    ["Ada", "VF-2", "today", 1],
  );
  const out = run(["report", job, bad]);
  assert.deepEqual(
    [out.status, out.stdout.startsWith("<!doctype html>")],
    [1, true],
  );
  const status = (/** @type {string} */ name, /** @type {string} */ text) =>
    run(["report", job, file(name, text)]).status;
  assert.equal(
    status("near.txt", printed(25.0215)),
    1,
    "out, if only within the uncertainty",
  );
  assert.equal(
    status("gap.txt", printed(25.01).replace(/RIB WIDTH.*\n/, "")),
    1,
    "not measured",
  );
  assert.equal(
    status("within.txt", printed(25.0205)),
    0,
    "good, if only within the uncertainty",
  );
  assert.equal(run(["report", job]).status, 2);
  assert.equal(run(["plan", job, "--by", "Ada"]).status, 2);
  assert.equal(run(["report", job, good, "-o", "reports"]).status, 0);
  assert.match(
    readFileSync(join(folder, "reports", "FIRST-report.html"), "utf8"),
    /Inspection report/,
  );
});
