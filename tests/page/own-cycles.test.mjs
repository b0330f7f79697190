// A program of native cycles: the picture shows their path, the lines are the calls, the results have the control's names.
import assert from "node:assert/strict";
import { test } from "node:test";
import {
  field,
  openText,
  page,
  panel,
  program,
  settles,
  setUp,
  textOf,
} from "./common.mjs";

setUp();

const JOB = JSON.stringify({
  format: 1,
  name: "BOSS_2201",
  cycle: { type: "boss", diameter: 40 },
  control: { post: "fanuc", form: "cycle", workOffset: 1 },
  part: { offset: [0.5, -0.3, 0] },
});

test("a macro's path was shown under steps and feeds that it does not have: it has its calls, and their line lights with each of its moves", async () => {
  await openText(JOB, "boss.json");
  const call = page.locator("tp-program .line", { hasText: "G65 P9814 D40." });
  await call.waitFor();
  assert.equal(
    await page.locator("tp-program .step").count(),
    0,
    "the documented steps are another path's",
  );
  await call.hover();
  assert.match(
    await textOf(page.locator("tp-picture output")),
    /Y-28/,
    "out beside the boss first",
  );
  await page.mouse.move(0, 0);
  await page.locator("#timeline").focus();
  for (const _ of Array(5)) await page.keyboard.press("ArrowRight");
  assert.equal(
    await page
      .locator("tp-program [aria-selected=true]")
      .getAttribute("data-line"),
    await call.getAttribute("data-line"),
  );
  const said = await textOf(page.locator("tp-picture output"));
  assert.match(said, /^touch 1 · contact X0 Y-23 Z-10$/, "no feed of the job");
  assert.match(
    await page.locator("#timeline").getAttribute("aria-valuetext").then(String),
    /call 3, touch 1/,
  );
  await panel("results", page);
  assert.match(
    await textOf(page.locator("tp-results tbody tr").first()),
    /center\.x #135/,
  );
});

test("what the other form of a program has could not be seen beside it: the same job as plain moves", async () => {
  await openText(JOB, "boss.json");
  await page
    .locator("tp-program .line", { hasText: "G65 P9814 D40." })
    .waitFor();
  await page.locator("select.compares").selectOption({ label: "Plain moves" });
  const less = page.locator("tp-program .differences .less", {
    hasText: "G31",
  });
  await less.first().waitFor();
  assert.ok((await less.count()) > 8, "each move is a G31 there");
  await page
    .locator("tp-program .differences .more", { hasText: "G65 P9814" })
    .waitFor();
});

test("a tool is corrected by a size that its macro measures: typed beside the tolerance, said beside the work offset", async () => {
  await openText(
    JSON.stringify({
      format: 1,
      cycle: { type: "hole", diameter: 25 },
      control: { post: "haas", form: "cycle" },
      part: { sizes: { diameter: 0.03 } },
      tolerances: { diameter: { tolerance: "±0.05" } },
    }),
  );
  await panel("measured");
  const box = (/** @type {string} */ name) =>
    page.getByRole("textbox", { name: `diameter: ${name}` });
  const text = () =>
    page.evaluate(() =>
      String(
        /** @type {any} */ (document.querySelector("touch-path")).plan?.program
          .text,
      ),
    );
  assert.equal(
    await box("Dead band").count(),
    0,
    "nothing else is asked before a tool is named",
  );
  await box("Tool offset").fill("5");
  // Key by key: a decimal is incomplete at each of them.
  await box("Percent of the error").pressSequentially("50");
  await box("Dead band").pressSequentially("0,005");
  assert.deepEqual(
    [
      await box("Percent of the error").inputValue(),
      await box("Dead band").inputValue(),
    ],
    ["50", "0,005"],
  );
  await settles(async () =>
    (await text()).includes("G65 P9814 D25. Q2. T5. F0.5 V0.0025 H0.5"),
  );
  const asked = page.locator('[id="f-control.workOffset"]');
  assert.equal(
    await textOf(asked.locator("option:checked")),
    "corrects tool offset 5",
  );
  // Text that is no number stays where it was typed, and is reported.
  await box("Tool offset").fill("five");
  await settles(
    async () =>
      (await page.locator(".tolerances .problem.error").count()) === 1,
  );
  assert.equal(await box("Tool offset").inputValue(), "five");
  await box("Tool offset").fill("5");
  // Another tolerance may be typed from an empty field: the tool stays.
  const tolerance = page.getByRole("textbox", {
    name: /^Tolerance of diameter/,
  });
  await tolerance.fill("");
  await tolerance.fill("±0.04");
  await settles(async () => (await text()).includes("T5. F0.5 V0.0025"));
  // Without a tool no part of it stays.
  for (const name of ["Dead band", "Percent of the error", "Tool offset"])
    await box(name).fill("");
  await settles(async () => (await text()).includes("G65 P9814 D25. Q2. H0.5"));
  assert.equal(await page.locator(".tolerances .problem").count(), 0);
});

test("a program of moves corrects a tool once the control's offsets are stated, which is asked only then", async () => {
  await openText(
    JSON.stringify({
      format: 1,
      cycle: { type: "hole", diameter: 25 },
      control: { post: "haas", form: "moves" },
      part: { sizes: { diameter: -0.02 } },
      tolerances: { diameter: { tolerance: "±0.05" } },
    }),
  );
  assert.equal(await field("control.toolOffsets").count(), 0);
  await panel("measured");
  const box = (/** @type {string} */ name) =>
    page.getByRole("textbox", { name: `diameter: ${name}` });
  for (const [name, value] of [
    ["Tool offset", "5"],
    ["Mean of parts", "3"],
    ["Stored in", "520"],
  ])
    await box(String(name)).fill(String(value));
  await settles(async () => (await field("control.toolOffsets").count()) === 1);
  await field("control.toolOffsets").selectOption("radius");
  const plan = () =>
    page.evaluate(() =>
      JSON.stringify(
        /** @type {any} */ (document.querySelector("touch-path")).plan,
      ),
    );
  await settles(async () => (await plan()).includes("#2605=#2605+"));
  await settles(async () =>
    (await plan()).includes(
      "after 3 parts like this one the program changes the radius wear of tool 5 by -0.01 mm",
    ),
  );
});

for (const [post, calls] of /** @type {[string, string[]][]} */ ([
  ["heidenhain", ["TCH PROBE 427", "TCH PROBE 421", "TCH PROBE 426"]],
  ["haas", ["G65 P9811", "G65 P9814", "G65 P9812"]],
  ["sinumerik", ["CYCLE978", "CYCLE977", "CYCLE977"]],
]))
  test(`in a set-up of native cycles a move lit the line of another call: ${post}`, async () => {
    await openText(
      JSON.stringify({
        format: 2,
        control: { post, form: "cycle" },
        cycles: [
          { name: "TOP", type: "surface", origin: [-60, 0, 0] },
          { name: "BORE", type: "hole", diameter: 25 },
          { name: "RIB", type: "web", width: 30, origin: [100, 0, 0] },
        ],
      }),
    );
    await settles(
      async () => (await page.locator("tp-program .chapter").count()) === 3,
    );
    assert.deepEqual(
      await page.locator("tp-program .chapter").allTextContents(),
      ["TOP", "BORE", "RIB"],
    );
    const touches = await page.evaluate(() => {
      const { moves } = /** @type {any} */ (
        document.querySelector("touch-path")
      ).plan;
      return [0, 1, 2].map((cycle) =>
        moves.findIndex(
          (/** @type {any} */ move) =>
            move.cycle === cycle && move.kind === "touch",
        ),
      );
    });
    const lit = page.locator("tp-program .line[aria-selected=true]");
    for (const [cycle, move] of touches.entries()) {
      await page.evaluate(
        (move) =>
          /** @type {any} */ (document.querySelector("touch-path")).store.point(
            move,
          ),
        move,
      );
      await settles(async () =>
        (await textOf(lit)).includes(calls[cycle] ?? "none"),
      );
      const numbers = (await program())
        .split("\n")
        .filter((line) => line.includes(calls[cycle] ?? "none"));
      const nth = calls
        .slice(0, cycle)
        .filter((call) => call === calls[cycle]).length;
      assert.equal(
        await textOf(lit.locator(".text")),
        numbers[nth]?.trim(),
        "its own call, and no other",
      );
    }
  });

test("the distance between two bores of a TNC follows from the parameters that it shows, decimal comma and all", async () => {
  const hole = (/** @type {string} */ name, /** @type {number} */ x) => ({
    name,
    type: "hole",
    diameter: 20,
    origin: [x, 0, 0],
  });
  await openText(
    JSON.stringify({
      format: 2,
      name: "BORES",
      control: { post: "heidenhain", form: "cycle" },
      cycles: [hole("LEFT", -60), hole("RIGHT", 60)],
      relations: [{ name: "ROW", type: "line", of: ["LEFT", "RIGHT"] }],
      tolerances: { "ROW.distance": { tolerance: "±0.02" } },
    }),
  );
  // The program computes it, too.
  await settles(async () => /FN 13: /.test(await program()));
  await panel("measured");
  const text = page.locator("#measured");
  assert.match(
    String(await text.getAttribute("placeholder")),
    /^Q1600 = -60$/,
    "what could be typed there",
  );
  await text.fill(
    "Q1600 = -60,02\nQ1601 = 0\nQ1602 = 20\nQ151 = 60,03\nQ152 = 0\nQ153 = 20,01\n",
  );
  const row = page.locator("tp-measured tp-results tbody tr", {
    hasText: "Distance from the first position to the second",
  });
  await settles(
    async () =>
      /120\.050/.test(await textOf(row)) && /\bout\b/.test(await textOf(row)),
  );
});

test("a bore of a TNC did not follow the probed top: the box of its height proposes it, and the program computes with it", async () => {
  await openText(
    JSON.stringify({
      format: 2,
      control: { post: "heidenhain", form: "cycle" },
      limits: { position: 1 },
      cycles: [
        { name: "FACE", type: "surface", origin: [-60, 0, 0] },
        { name: "BORE", type: "hole", diameter: 25 },
      ],
    }),
  );
  await page.locator("button.feature", { hasText: "BORE" }).click();
  const menu = page.locator(
    '.number:has([id="f-cycle.origin[2]"]) select.equals',
  );
  await menu.selectOption("=FACE.point.z");
  await settles(async () => /Q261=\+Q1980/.test(await program()));
  assert.match(await program(), /FN 11: IF \+Q1600 GT \+1 GOTO LBL "STOP1"/);
  assert.equal(await field("cycle.origin[2]").inputValue(), "=FACE.point.z");
});
