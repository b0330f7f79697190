// An opened program is run with the user's inputs: it lists the variables that it needs, and the verdict has its lines.
import assert from "node:assert/strict";
import { test } from "node:test";
import {
  field,
  openText,
  page,
  painted,
  program,
  settles,
  setUp,
  textOf,
} from "./common.mjs";

setUp();

/** The touch moves by 20, from 10 to −10. */
const MACRO = `o<edge> sub
G21 G90
G38.2 X[0 - #1] F50
#<edge> = [#5061 - #5410 / 2]
G1 X[#<edge> + 3] F200
G10 L20 P1 X0
G38.2 Y[#1 * 2] F50
o<edge> endsub
`;

const enter = async (/** @type {string} */ id, /** @type {string} */ text) => {
  const input = page.locator(`[id="${id}"]`);
  await input.fill(text);
  await input.press("Tab");
};

/** Position of the stylus before the first block. */
const begins = async (/** @type {string[]} */ ...place) => {
  for (const [axis, text] of place.entries())
    await enter(`start-${axis}`, text);
};

test("what a macro reads and nothing sets could not be entered: it is asked for, and the picture follows", async () => {
  await openText(MACRO, "edge.ngc");
  const viewer = page.locator("tp-viewer");
  await viewer.waitFor();
  assert.match(
    await textOf(viewer.locator(".known")),
    /#1.*Line 3, 7.*#5410.*Line 4/s,
  );
  assert.equal(
    (await painted("tp-viewer", "touch")).count,
    0,
    "nowhere is no place",
  );
  for (const [id, text] of [
    ["start-0", "10"],
    ["start-1", "0"],
    ["start-2", "-2,5"],
    ["ask-#1", "10"],
    ["ask-#5410", "6"],
  ])
    await enter(/** @type {string} */ (id), /** @type {string} */ (text));
  await page.locator("#meets-at").selectOption("half");
  await settles(async () => (await painted("tp-viewer", "touch")).count > 0);
  // A field with an error stays, and changes nothing.
  await enter("ask-#1", "ten");
  assert.equal(
    await page.locator('[id="ask-#1"]').getAttribute("aria-invalid"),
    "true",
  );
  await enter("ask-#1", "10");
  const rule = viewer.locator(".checks li", {
    hasText: "before the last touch has succeeded",
  });
  assert.match(await textOf(rule), /^A\s.*Line 6/s);
  await rule.getByRole("button", { name: "Line 6" }).click();
  // Opened again, it is recognised by its file name.
  await page.getByRole("button", { name: "Back to the job" }).click();
  await openText(MACRO, "edge.ngc");
  await viewer.waitFor();
  assert.equal(await page.locator('[id="ask-#5410"]').inputValue(), "6");
  await openText(MACRO, "other.ngc");
  await settles(
    async () => (await page.locator('[id="ask-#5410"]').inputValue()) === "",
  );
});

test("a routine that computes with its touches was drawn up to the first of them: its start and its touches are assumed, and said so", async () => {
  await openText(
    "G21 G90\nG0 Z20\nG0 X0 Y0\nG1 Z-5 F300\nG38.2 X20 F100\n#1 = #5061\nG1 X[#1-2] F300\nG38.2 Y[#1 * 2] F100\nG10 L20 P1 X0 Y0\nM2\n",
    "routine.ngc",
  );
  const viewer = page.locator("tp-viewer");
  await viewer.waitFor();
  const moves = async () =>
    viewer.evaluate((node) => [.../** @type {any} */ (node).moves.to]);
  // The second touch moves to twice the position of the first.
  assert.deepEqual((await moves()).slice(-3), [18, 40, -5]);
  assert.match(
    await textOf(viewer.locator(".assumed")),
    /start, work offsets and tool length 0, and the trigger points/,
  );
  // Its writes are listed, with their lines.
  assert.match(
    await textOf(viewer.locator(".writes")),
    /^\s*G54 X 0, Y 0\s+Line 9/,
  );
  // Faults come first, with their lines.
  assert.match(await textOf(viewer.locator(".said")), /^\s*3 faults.*Line 9/s);
  assert.match(
    await textOf(page.locator(".sentence")),
    /^Read routine\.ngc as LinuxCNC: 6 moves, 2 of them touches$/,
  );
  // An input replaces an assumption.
  await page.locator("#meets-at").selectOption("half");
  await settles(async () => (await moves()).at(-2) === 20);
  // The start is still assumed, and only inputs are stored.
  assert.equal(await viewer.locator(".assumed").count(), 1);
  assert.match(
    await page.evaluate(() => localStorage["touchpath.programs.1"]),
    /\["routine\.ngc",\{"part":\{"at":0\.5\}\}\]/,
  );
});

test("faults and touches had no place in the program: letters and numbers are in the margin, as in list and picture", async () => {
  const text = `G21 G90 G17\nG38.2 X20 F200\n#1 = #5061\nG0 X0\nG38.2 X-20 F200\nG0 X[[#1+#5061]/2]\nG10 L20 P1 X0\n`;
  const marks = (/** @type {string} */ name) =>
    page
      .locator(`tp-viewer [${name}]`)
      .evaluateAll(
        (lines, name) =>
          lines.map((line) => [
            Number(line.getAttribute("data-number")),
            line.getAttribute(name),
          ]),
        name,
      );
  // Separate lines first, then so many that the editor lists them.
  for (const end of ["M2\n", `M2\n${"( )\n".repeat(6000)}`]) {
    await openText(`${text}${end}`, `marks${end.length}.ngc`);
    await page.locator("tp-viewer [data-touch]").first().waitFor();
    assert.deepEqual(await marks("data-touch"), [
      [2, "1"],
      [5, "2"],
    ]);
    const list = page.locator("tp-viewer .fault");
    const letters = await list.allTextContents();
    assert.deepEqual(letters, ["A", "B", "C"].slice(0, letters.length));
    const written = page.locator("tp-viewer .checks li", {
      hasText: "G54 X is written for any measured value",
    });
    const letter = await textOf(written.locator(".fault"));
    assert.ok(
      (await marks("data-faults")).some(
        ([line, all]) => line === 7 && `${all}`.split(" ").includes(letter),
      ),
    );
  }
  // From the start, which is assumed, to the first touch and to the second.
  assert.ok((await painted("tp-viewer", "touch")).columns > 200);
});

test("a program that checks its touches is not run to its alarm by what is assumed", async () => {
  // At its target the touch would be a miss: half-way the program ends.
  await openText(
    "%\nO1\nG21 G90 G17 G94\nG91 G28 Z0\nG90 G0 X10 Y10\nG43 H1 Z50.\nG31 Z-10. F100\nIF [#5063 LT -9.9] GOTO 99\nG0 Z50.\nG0 X30.\nM30\nN99 #3000=1 (MISSED)\nM30\n%\n",
    "checks.nc",
  );
  const viewer = page.locator("tp-viewer");
  await viewer.waitFor();
  const last = await viewer.evaluate((node) =>
    [.../** @type {any} */ (node).moves.to].slice(-3),
  );
  assert.deepEqual(last, [30, 10, 50]);
  assert.doesNotMatch(await textOf(viewer.locator(".said")), /alarm/);
});

test("no job is made of a call at an assumed position", async () => {
  await openText(
    "%\nO1\nG21 G90\nG43 H1 Z100.\nG65 P9810 Z-10. F2000\nG65 P9814 D40.\nM30\n%\n",
    "bore.nc",
  );
  const calls = page.locator("tp-viewer .calls li");
  await calls.first().waitFor();
  assert.match(await textOf(calls.last()), /P9814/);
  assert.equal(
    await calls
      .getByRole("button", { name: "Create a job from this call" })
      .count(),
    0,
  );
});

test("a cycle of the control's own was a line that is not understood: it is named, with what contradicts in it", async () => {
  await openText(
    "%\nO1\nG21 G90\nG0 X0. Y0. Z5.\nG65 P9812 X30. Y20. Q5.\nG0 X0. Y0. Z-5.\nG65 P9814 D25.\nM30\n%\n",
    "calls.nc",
  );
  const calls = page.locator("tp-viewer .calls li");
  await calls.first().waitFor();
  assert.match(
    await textOf(calls.nth(0)),
    /G65 P9812 Line 5 web or slot: X 30 .*X and Y exclude each other/s,
  );
  assert.match(
    await textOf(calls.nth(1)),
    /G65 P9814 Line 7 hole or boss, four touches: D 25 \(diameter\)/,
  );
  // A hole of 25 at the stylus position: a click makes it the job.
  await calls
    .nth(1)
    .getByRole("button", { name: "Create a job from this call" })
    .click();
  await field("cycle.diameter").waitFor();
  assert.equal(await field("cycle.diameter").inputValue(), "25");
});

test("a program of several native calls becomes one job, which writes no work offset", async () => {
  await openText(
    "%\nO1\nG90 G21 G17\nG54\nT9 M6\nG43 H9\nG65 P9832\nG65 P9810 X0. Y0. F3000.\nG65 P9810 Z-5.\nG65 P9814 D25. S1.\nG65 P9810 Z20.\nG65 P9810 X60. Y0.\nG65 P9810 Z-5.\nG65 P9814 D16. S2.\nG65 P9810 Z20.\nG65 P9833\nM30\n%\n",
    "bores.nc",
  );
  await page
    .getByRole("button", { name: "Create a job from these 2 calls" })
    .click();
  await page.locator("tp-features").waitFor();
  const job = await page.evaluate(
    () => /** @type {any} */ (document.querySelector("touch-path")).job,
  );
  const { format, control, cycles } = job;
  assert.deepEqual(
    [format, control.post, control.workOffset],
    [2, "fanuc", null],
  );
  // The positions and sizes of the calls.
  assert.deepEqual(
    cycles.map((/** @type {any} */ cycle) => [
      cycle.type,
      cycle.diameter,
      cycle.origin.slice(0, 2),
    ]),
    [
      ["hole", 25, [0, 0]],
      ["hole", 16, [60, 0]],
    ],
  );
  assert.match(await program(), /HOLE2\.CENTER|BORE2\.CENTER/);
});

for (const change of ["G55", "G52 X50.", "G68 X0. Y0. R90."])
  test(`calls before and after ${change} do not become one job: their positions are in two coordinate systems`, async () => {
    await openText(
      `%\nO1\nG90 G21 G17\nG54\nT9 M6\nG43 H9\nG65 P9832\nG65 P9810 X0. Y0. F3000.\nG65 P9810 Z-5.\nG65 P9814 D25.\nG65 P9810 Z20.\n${change}\nG65 P9810 X60. Y0.\nG65 P9810 Z-5.\nG65 P9814 D16.\nG65 P9810 Z20.\nG65 P9833\nM30\n%\n`,
      "systems.nc",
    );
    const calls = page.locator("tp-viewer .calls");
    await calls.waitFor();
    const single = calls.getByRole("button", {
      name: "Create a job from this call",
    });
    assert.equal(await single.count(), 2);
    const whole = page.getByRole("button", { name: /from these \d+ calls/ });
    assert.equal(await whole.count(), 0);
  });

test("a program could not be tried on a part: it is run on the one in the form", async () => {
  await openText(
    "G21 G90\nG38.3 X60 F50\n#<x> = #5061\nG1 X0 F900\nG1 Y#<x>\nM2\n",
    "form.ngc",
  );
  await begins("0", "0", "-5");
  await page.locator("#meets-at").selectOption("form");
  // The pocket of the form is 80 wide, the ball has a radius of 3: 37.
  const shown = async () =>
    page
      .locator("tp-viewer")
      .evaluate((viewer) =>
        [.../** @type {any} */ (viewer).moves.to].slice(-3),
      );
  await settles(async () => (await shown())[1] === 37);
  await page.locator("#meets-at").selectOption("never");
  await settles(async () => (await shown())[1] === 60);
});

test("on a phone the form was not there: it had the class of something that makes room", async () => {
  await page.setViewportSize({ width: 390, height: 844 });
  await openText(MACRO, "phone.ngc");
  await page.getByText("Run with your values").waitFor();
  await enter("ask-#1", "10");
  await page.setViewportSize({ width: 1440, height: 900 });
});

test("a part that lies off could not be put into the picture: by hand, and the program runs on it", async () => {
  // From 0 towards 60: a wall at 20, displaced by 2, is touched by a ball of 6 at 19.
  await openText(
    "G21 G90\nG38.3 X60 F50\n#<x> = #5061\nG1 X0 F900\nG1 Y#<x>\nM2\n",
    "hand.ngc",
  );
  await begins("0", "0", "-5");
  await page.locator("#meets-at").selectOption("hand");
  await page.locator("#hand-kind").selectOption("internal-rectangle");
  for (const [id, text] of [
    ["hand-0", "0"],
    ["hand-2", "0"],
    ["hand-width1", "40"],
    ["hand-width2", "60"],
    ["hand-off-0", "2"],
  ])
    await enter(/** @type {string} */ (id), /** @type {string} */ (text));
  const slider = page.locator("tp-viewer .timeline input");
  await slider.focus();
  await slider.press("End");
  assert.match(
    await textOf(page.locator("tp-viewer .timeline output")),
    /Line 5: .* Y19 Z-5/,
  );
  await settles(async () => (await painted("tp-viewer", "actual")).count > 0);
  // An invalid part has a finding, and its fields stay.
  await enter("hand-ball", "-1");
  assert.match(
    await textOf(page.locator("tp-viewer .notes .warning")),
    /The part is not used: .*ball/i,
  );
  assert.equal(await page.locator("#hand-width1").inputValue(), "40");
});

test("where a long program names its parts, and what is said of a line, could not be found: headings and a margin", async () => {
  const text = `%\nO1\nG21 G17 G90 G40\nG65 P100 A5.\nM30\nO100 (EDGE)\nG31 X#1 F50\n#5221=#5061\nM99\nO200 (NEVER)\n${"G4\n".repeat(80)}M99\n%\n`;
  await openText(text, "headings.nc");
  const select = page.locator("tp-viewer .headings");
  await select.waitFor();
  assert.deepEqual(await select.locator("option").allTextContents(), [
    "Go to",
    "2: O1",
    "6: O100 (EDGE)",
    "10: O200 (NEVER)",
  ]);
  await select.selectOption({ label: "10: O200 (NEVER)" });
  await page.locator('tp-viewer .lit[data-line="9"]').waitFor();
  await select.selectOption({ label: "6: O100 (EDGE)" });
  const noted = page.locator('tp-viewer .noted[data-line="7"]');
  await noted.click();
  assert.match(
    await textOf(page.locator("tp-viewer .read .notes")),
    /G54 X is written for any measured value/,
  );
});

test("which control a program is for could not be told: a list, and no refusal of a text that runs", async () => {
  // FluidNC alone writes the work offset by P; the importer reads a text with G92 as LinuxCNC and refuses it.
  await openText("G21 G90\nG38.2 Z-10 F50 P1\nG92 X0\nG0 Z5\n", "told.nc");
  await begins("0", "0", "0");
  const panel = page.locator("tp-viewer .said");
  assert.doesNotMatch(await textOf(panel), /read as a program for/);
  assert.doesNotMatch(await textOf(panel), /active Z/);
  await page.locator("#known-post").selectOption({ label: "FluidNC" });
  await panel.locator(".writes li", { hasText: "active Z 1" }).waitFor();
});
