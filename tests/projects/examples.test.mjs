// The examples, each with the package from its tarball: a portal, React, Vue.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { writeFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { unzipSync } from "fflate";
import { at } from "../../scripts/lib.mjs";
import { inBrowser, project } from "./installed.mjs";

const inside = inBrowser();

/** Opens a folder's page, and waits for its elements. */
async function open(/** @type {string} */ folder) {
  const opened = await inside.open(folder);
  await opened.page
    .locator("touch-path .line")
    .first()
    .waitFor({ state: "attached" });
  return opened;
}

test("the portal: a job list, two elements, programs collected as a zip", async () => {
  const { page, problems } = await open(
    project("portal", ["fflate"], "portal"),
  );
  const [edit, view] = [page.locator("#edit"), page.locator("#view")];
  await page.getByRole("button", { name: "BORE" }).click();
  await edit.locator("[id='f-cycle.diameter']").fill("36");
  const shown = () =>
    view.evaluate((element) => /** @type {any} */ (element).plan.program.text);
  const { defaultJob, plan } = await import("touchpath");
  const bore = defaultJob("hole");
  Object.assign(bore, {
    name: "BORE",
    control: { ...bore.control, post: "fanuc", workOffset: 1 },
  });
  Object.assign(bore.cycle, { diameter: 36 });
  assert.equal(await shown(), plan(bore).program.text);
  await edit.getByRole("button", { name: /^Save / }).click();
  await page.getByRole("button", { name: "POCKET" }).click();
  await view.getByRole("button", { name: /^Save / }).click();
  await page.getByText("2 collected: BORE.nc, POCKET.ngc").waitFor();
  const [download] = await Promise.all([
    page.waitForEvent("download"),
    page.getByRole("button", { name: "Save all" }).click(),
  ]);
  const chunks = [];
  for await (const chunk of await download.createReadStream())
    chunks.push(chunk);
  const files = unzipSync(new Uint8Array(Buffer.concat(chunks)));
  assert.equal(
    Buffer.from(/** @type {Uint8Array} */ (files["BORE.nc"])).toString(),
    plan(bore).program.text,
  );
  assert.deepEqual(Object.keys(files).sort(), ["BORE.nc", "POCKET.ngc"]);
  await page.getByRole("button", { name: "BORE" }).click();
  assert.equal(
    await edit.locator("[id='f-cycle.diameter']").inputValue(),
    "36",
    "the list keeps what was typed",
  );
  assert.deepEqual(problems, []);
});

for (const [name, libraries, jobName] of /** @type {const} */ ([
  ["react", ["react", "react-dom", "scheduler"], "FROM_REACT"],
  ["vue", ["vue", "@vue"], "FROM_VUE"],
]))
  test(`the host in ${name}: a job down, events up`, async () => {
    const own = project(name, [...libraries], name);
    const { build } = await import("vite");
    await build({
      root: own,
      configFile: false,
      logLevel: "error",
      build: { target: "es2022" },
      define: {
        __VUE_OPTIONS_API__: "true",
        __VUE_PROD_DEVTOOLS__: "false",
        __VUE_PROD_HYDRATION_MISMATCH_DETAILS__: "false",
      },
    });
    const { page, problems } = await open(join(own, "dist"));
    const state = page.getByRole("status").filter({ hasText: jobName });
    assert.match(
      (await state.first().textContent()) ?? "",
      new RegExp(`^${jobName}: diameter 30, \\d\\d+ lines$`),
    );
    const box = page.locator("[id='f-cycle.diameter']");
    await box.fill("33");
    await page.getByText(`${jobName}: diameter 33`).waitFor();
    await page.getByRole("button", { name: "44 mm" }).click();
    await page.waitForFunction(() => {
      const element = /** @type {any} */ (document.querySelector("touch-path"));
      return element.job.cycle.diameter === 44;
    });
    assert.equal(await box.inputValue(), "44");
    // The user's input stays as typed, although the host returns it.
    await box.fill("5,5");
    await page.getByText(`${jobName}: diameter 5.5`).waitFor();
    assert.equal(await box.inputValue(), "5,5");
    assert.deepEqual(problems, []);
  });

test("the element was unknown in React's TSX: the example compiles, and a property that is wrong does not", () => {
  const own = project("react-types", ["@types/react", "csstype"], "react");
  // The repository has no types of react-dom.
  writeFileSync(join(own, "dom.d.ts"), 'declare module "react-dom/client";\n');
  writeFileSync(
    join(own, "wrong.tsx"),
    `import { TouchForm, TouchPath } from "touchpath-element/react";
// @ts-expect-error there is no such theme
export const theme = <touch-path theme="drak" />;
// @ts-expect-error there is no such control
export const post = <touch-path post="mazatrol" />;
// @ts-expect-error a plan has no such section
export const plan = <touch-path onplan-change={(event) => event.detail.plan?.nothing} />;
export const all = <TouchPath onChange={({ detail }) => detail.plan?.moves} onLoad={() => {}} onError={(event) => event.error} style={{ height: 640 }} />;
export const form = <TouchForm for="job" className="wide" />;
// @ts-expect-error there is no plan while the job has errors
export const lines = <TouchPath onPlanChange={({ detail }) => detail.plan.moves} />;
`,
  );
  const options = [
    "--strict",
    "--noEmit",
    "--skipLibCheck",
    "false",
    "--jsx",
    "react-jsx",
    "--target",
    "es2022",
  ];
  const resolution = [
    "--module",
    "esnext",
    "--moduleResolution",
    "bundler",
    "--types",
    "",
  ];
  const files = ["main.tsx", "wrong.tsx", "dom.d.ts"];
  const lib = ["--lib", "ES2023,DOM"];
  const tsc = at("node_modules", ".bin", "tsc");
  const ran = spawnSync(tsc, [...options, ...resolution, ...lib, ...files], {
    cwd: own,
    encoding: "utf8",
  });
  assert.equal(ran.status, 0, ran.stdout + ran.stderr);
});

test("the worker at the edge answers a job with its program, and what is none with the reason", async () => {
  const own = project("edge", [], "edge");
  const job = {
    format: 1,
    name: "EDGE",
    cycle: { type: "hole", diameter: 30 },
  };
  writeFileSync(
    join(own, "ask.mjs"),
    `import worker from "./worker.js";
const ask = async (body, headers = {}, method = "POST") => {
  const answer = await worker.fetch(new Request("http://edge.example/", { method, headers, body }));
  return [answer.status, await answer.text(), answer.headers.get("etag")];
};
const job = ${JSON.stringify(JSON.stringify(job))};
const first = await ask(job);
console.log(JSON.stringify([first, await ask(job, { "if-none-match": first[2] }), await ask("{"), await ask(job.replace("30", "-3")), await ask(undefined, {}, "GET")]));`,
  );
  const ran = spawnSync("node", ["ask.mjs"], { cwd: own, encoding: "utf8" });
  assert.equal(ran.status, 0, ran.stderr);
  const answers = JSON.parse(ran.stdout);
  const { plan } = await import("touchpath");
  assert.equal(answers[0][1], plan(/** @type {any} */ (job)).program.text);
  assert.deepEqual(
    answers.map((/** @type {any} */ answer) => answer[0]),
    [200, 412, 400, 422, 405],
  );
  assert.match(answers[0][2], /^"[0-9a-f]{64}"$/);
  assert.equal(JSON.parse(answers[3][1]).findings[0].path, "cycle.diameter");
});

const python =
  spawnSync("python3", [
    "-c",
    "import sys; sys.exit(sys.version_info < (3, 11))",
  ]).status === 0;
test("Python: every name in the types of the answers is defined, and indices are whole numbers", {
  skip: python ? false : "Python 3.11 is missing",
}, () => {
  const { stdout, stderr } = spawnSync(
    "python3",
    [
      "-B",
      "-c",
      "import typing, touchpath_types as t; [typing.get_type_hints(c) for c in vars(t).values() if typing.is_typeddict(c)]; print(typing.get_type_hints(t.ProgramText)['moveLines'], typing.get_type_hints(t.Move)['touch'])",
    ],
    { cwd: at("examples", "python"), encoding: "utf8" },
  );
  assert.equal(stdout.trim(), "list[int] int | None", stderr);
});

const duckdb = spawnSync("python3", ["-c", "import duckdb"]).status === 0;
test("a table of features in DuckDB gets a program a row, part by part", {
  skip: !duckdb && "there is no duckdb",
}, () => {
  const own = project("duckdb", [], "duckdb");
  const sql = (/** @type {string} */ query) => {
    const ran = spawnSync(
      "python3",
      [
        "-c",
        `import duckdb, json; print(json.dumps(duckdb.execute("""${query}""").fetchall()))`,
      ],
      {
        cwd: own,
        encoding: "utf8",
      },
    );
    assert.equal(ran.status, 0, ran.stderr);
    return JSON.parse(ran.stdout);
  };
  // Row 3 has no name, rows 5 and 6 have the same.
  sql(`COPY (SELECT CASE WHEN i = 3 THEN NULL WHEN i IN (5, 6) THEN 'DUP' ELSE 'BORE_' || i END AS name, i * 0.5 AS x, 3.0 AS y, CASE i WHEN 7 THEN -1 ELSE 20 + i END AS diameter, 8.0 AS depth,
    ['linuxcnc', 'haas'][1 + i % 2] AS post FROM range(40) t(i)) TO 'bores.parquet'`);
  const make = (/** @type {string[]} */ ...args) =>
    spawnSync(
      "python3",
      ["programs.py", "bores.parquet", "it's", "--parts", "3", ...args],
      {
        cwd: own,
        encoding: "utf8",
      },
    );
  const first = make("--only", "1");
  assert.equal(first.status, 0, first.stderr);
  assert.match(first.stdout, /^part 2 of 3\n$/);
  assert.equal(make().status, 0);
  const rows = sql(
    `SELECT row, name, program, findings FROM 'it''s/*.parquet' ORDER BY row`,
  );
  assert.deepEqual(
    rows.map((/** @type {any[]} */ [row]) => row),
    Array.from({ length: 40 }, (_, row) => row),
  );
  assert.deepEqual(
    [3, 5, 6].map((row) => rows[row]?.[1]),
    ["ROW_3", "DUP", "DUP"],
  );
  for (const [, name, program, findings] of rows) {
    if (name === "BORE_7")
      assert.deepEqual(
        [program, JSON.parse(findings)[0].path],
        [null, "cycle.diameter"],
      );
    else assert.match(program, new RegExp(`\\(job: ${name}\\)`, "i"));
  }
});
