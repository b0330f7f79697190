// Several cycles in one program: the list above the form, what is written from which, and that one cycle looks as before.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { field, held, page, program, put, ready, setUp, textOf } from "./common.mjs";

setUp({ width: 1440, height: 900 });

const list = () => page.locator(".features .feature");
const names = () => page.locator(".features .feature b").allTextContents();
const add = (/** @type {string} */ type) => page.getByLabel("Add a cycle to this program").selectOption(type);
const button = (/** @type {string} */ name) => page.getByRole("button", { name, exact: true });

test("a setter adds the top and a wall to a bore, and the program writes X, Y, Z and the rotation", async () => {
  await field("cycle.type").selectOption("hole");
  assert.equal(await list().count(), 0, "one cycle looks as before");
  await field("control.workOffset").selectOption("1");
  await add("surface");
  assert.deepEqual(await names(), ["BORE", "SURFACE"]);
  assert.equal(await held("cycle.elevation"), 90, "the new one is in the form");
  await put("cycle.origin[0]", -40);
  await page.getByLabel("Name of this cycle").fill("TOP");
  await page.keyboard.press("Tab");
  await button("TOP earlier").click();
  assert.deepEqual(await names(), ["TOP", "BORE"]);
  await add("wall-angle");
  await put("cycle.origin[0]", 100);
  await page.getByLabel("rotation is written from").selectOption("WALL.rotation");
  assert.deepEqual(await names(), ["TOP", "WALL", "BORE"], "behind the one in hand");
  assert.equal(await textOf(page.locator(".datum p").first()), "X Y from BORE, Z from TOP, rotation from WALL → G54");
  const text = await program();
  assert.match(text, /\(TOP: ENCY[\s\S]*\(WALL: Touchpath[\s\S]*\(BORE: ENCY/);
  assert.match(text, /G10 L2 P1 R\[#5230\+#<wall_turn>\][\s\S]*G10 L20 P1 X\[[\s\S]*M72\nM2$/);
  // Chapters in the program, a table a cycle in the results, the numbers of touches begin anew.
  assert.deepEqual(await page.locator("tp-program .chapter").allTextContents(), ["TOP", "WALL", "BORE"]);
  assert.deepEqual(await page.locator("tp-program .disc").allTextContents(), ["1", "1", "2", "1", "2", "3", "4"]);
  await page.locator("#tab-results").click();
  assert.equal(await page.locator("tp-results table caption").count(), 4, "three cycles and what is written");
});

test("a click on a line of another cycle brings it into the form, and nothing of the job changes", async () => {
  await field("cycle.type").selectOption("hole");
  await add("web");
  await put("cycle.origin[0]", 120);
  const before = await program();
  await page.locator("tp-program .line.touch").first().click();
  assert.equal(await field("cycle.type").inputValue(), "hole");
  assert.equal(await program(), before);
  await list().nth(1).click();
  assert.equal(await held("cycle.origin[0]"), 120);
  assert.equal(await program(), before);
});

test("what is wrong with a cycle is marked at its name, and leads into its form", async () => {
  await field("cycle.type").selectOption("hole");
  await add("web");
  await put("cycle.width", -3);
  await list().first().click();
  assert.match((await list().nth(1).getAttribute("class")) ?? "", /error/);
  await page.getByRole("button", { name: "Go to it" }).click();
  assert.equal(await field("cycle.width").inputValue(), "-3");
  assert.equal(
    await page.evaluate(() => document.querySelector("touch-path")?.shadowRoot?.activeElement?.id),
    "f-cycle.width",
  );
});

test("it is left out, duplicated, removed, taken back, and it outlives a reload", async () => {
  await field("cycle.type").selectOption("hole");
  await add("hole");
  await put("cycle.origin[0]", 90);
  assert.deepEqual(await names(), ["BORE", "BORE2"]);
  await button("Duplicate BORE2").click();
  await put("cycle.origin[0]", 180);
  assert.deepEqual(await names(), ["BORE", "BORE2", "BORE3"]);
  await button("Leave BORE3 out of the program").click();
  assert.doesNotMatch(await program(), /BORE3/);
  await page.reload();
  await ready();
  assert.deepEqual(await names(), ["BORE", "BORE2", "BORE3"]);
  assert.doesNotMatch(await program(), /\(BORE3:/);
  await button("Take BORE3 in again").click();
  assert.match(await program(), /\(BORE3:/);
  await button("Remove BORE3").click();
  await button("Remove BORE2").click();
  assert.equal(await list().count(), 0);
  assert.match(await program(), /\(ENCY\/SprutCAM type 3: Hole\)/, "one cycle again");
  await button("Undo").click();
  assert.deepEqual(await names(), ["BORE", "BORE2"]);
});

test("a file with several cycles is opened and saved as it is; sizes of the virtual part go with their cycles", async () => {
  const job = {
    format: 2,
    name: "PAIR",
    cycles: [
      { name: "A", type: "hole" },
      { name: "B", type: "hole", origin: [150, 0, 0] },
    ],
    clear: 77,
    part: { sizes: { "B.diameter": 0.25 } },
  };
  const text = JSON.stringify(job);
  await page
    .locator("#file")
    .setInputFiles({ name: "pair.json", mimeType: "application/json", buffer: Buffer.from(text) });
  await list().first().waitFor();
  assert.deepEqual(await names(), ["A", "B"]);
  assert.match(await program(), /G38\.3 X0 Y0 Z77/);
  await list().nth(1).click();
  assert.equal(await held("part.sizes.diameter"), 0.25);
  const whole = await page.evaluate(() => /** @type {any} */ (document.querySelector("touch-path")).job);
  assert.deepEqual(
    [whole.format, whole.clear, whole.part.sizes, whole.cycles.map((/** @type {any} */ c) => [c.name, c.type])],
    [
      2,
      77,
      { "B.diameter": 0.25 },
      [
        ["A", "hole"],
        ["B", "hole"],
      ],
    ],
  );
  await page.getByLabel("Height between cycles").fill("20");
  await page.keyboard.press("Tab");
  assert.match(await textOf(page.locator(".datum .problem")), /goes across at 20 mm/);
});

/** Opens a job as a file. */
async function openJob(/** @type {object} */ job) {
  const buffer = Buffer.from(JSON.stringify(job));
  await page.locator("#file").setInputFiles({ name: "job.json", mimeType: "application/json", buffer });
}

const whole = () => page.evaluate(() => /** @type {any} */ (document.querySelector("touch-path")).job);

test("a name that is taken for a while took the datum with it", async () => {
  await openJob({
    format: 2,
    control: { workOffset: 1 },
    cycles: [
      { name: "A", type: "hole" },
      { name: "B", type: "hole", origin: [150, 0, 0] },
    ],
    datum: { x: "A.center.x", y: "A.center.y" },
  });
  await list().nth(1).click();
  const name = page.getByLabel("Name of this cycle");
  await name.fill("A");
  await page.keyboard.press("Tab");
  assert.match(await textOf(page.locator("footer")), /both called A/);
  await name.fill("C");
  await page.keyboard.press("Tab");
  assert.deepEqual(await names(), ["A", "C"]);
  assert.deepEqual((await whole()).datum, { x: "A.center.x", y: "A.center.y" });
});

test("cycles without a name are called as everywhere else, and keep their sizes and what is written from them", async () => {
  await openJob({
    format: 2,
    control: { workOffset: 1 },
    cycles: [{ type: "hole" }, { name: "BORE", type: "hole", origin: [100, 0, 0] }],
    datum: { x: "BORE.center.x", y: "BORE.center.y" },
    part: { sizes: { "BORE.diameter": 0.1 } },
  });
  await list().first().waitFor();
  assert.deepEqual(await names(), ["BORE2", "BORE"]);
  const { cycles, datum, part } = await whole();
  assert.deepEqual([cycles.length, datum.x, part.sizes], [2, "BORE.center.x", { "BORE.diameter": 0.1 }]);
});

test("a list of no cycle is refused, and the last one in the program stays there", async () => {
  await field("cycle.type").selectOption("hole");
  await add("web");
  await put("cycle.origin[0]", 120);
  const before = await whole();
  await openJob({ format: 2, cycles: [] });
  assert.match(await textOf(page.locator(".note")), /Nothing was changed/);
  assert.deepEqual(await whole(), before);
  await page.locator(".note").getByRole("button", { name: "OK" }).click();
  await add("hole");
  await put("cycle.origin[0]", 240);
  await button("Leave BORE2 out of the program").click();
  await list().first().click();
  await button("Leave BORE out of the program").click();
  await list().nth(1).click();
  await button("Remove WEB").click();
  assert.equal((await whole()).cycles.length, 1);
});

/** The program, on the panel that shows it. */
const seen = async () => {
  await page.locator("#tab-program").click();
  return program();
};

test("tolerances of results: typed beside them, kept through renaming, units and a reload, in the program and its judgement", async () => {
  await field("cycle.type").selectOption("hole");
  await put("cycle.diameter", 25);
  await page.locator("#tab-results").click();
  await page.locator(".tolerances > summary").click();
  const box = (/** @type {string} */ code) => page.getByRole("textbox", { name: `Tolerance of ${code}:` });
  await box("diameter").fill("H7");
  assert.equal(await textOf(page.locator(".tolerances small")), "25.0000 … 25.0210");
  assert.match(await page.locator("tp-results table").first().innerText(), /good within ±/);
  await page.getByLabel("What follows from diameter out of its tolerance").selectOption("stop");
  assert.match(await seen(), /\(ABORT,diameter is #<diameter>, not 25 to 25\.021\)/);
  await page.locator("#tab-results").click();
  // A second cycle: the first one's results are named, and keep what they have.
  await add("boss");
  await put("cycle.origin[0]", 120);
  assert.match(await seen(), /\(ABORT,BORE\.diameter is #<bore_diameter>, not 25 to 25\.021\)/);
  await list().first().click();
  await page.getByLabel("Name of this cycle").fill("FIT");
  await page.keyboard.press("Tab");
  assert.match(await seen(), /\(ABORT,FIT\.diameter is/);
  await page.locator("#tab-results").click();
  assert.equal(await box("FIT.diameter").inputValue(), "H7");
  await box("FIT.diameter").fill("±0,0254");
  await page.getByRole("radio", { name: "inch" }).check();
  assert.equal(await box("FIT.diameter").inputValue(), "±0.001");
  await page.getByRole("radio", { name: "mm" }).check();
  assert.equal(await box("FIT.diameter").inputValue(), "±0.0254");
  await box("FIT.diameter").fill("H77");
  assert.match(await page.locator(".tolerances .problem").first().innerText(), /ISO 286 has no H77/);
  await box("FIT.diameter").fill("");
  assert.doesNotMatch(await seen(), /not 25 to/);
});

test("a relation between two cycles: added, named, written from, and gone with its cycle", async () => {
  await field("cycle.type").selectOption("hole");
  await field("control.workOffset").selectOption("1");
  await add("hole");
  await put("cycle.origin[0]", 90);
  await page.getByLabel("Add a relation between cycles").selectOption("line");
  await page.getByLabel("Name of this relation").fill("ROW");
  await page.keyboard.press("Tab");
  await page.getByLabel("rotation is written from").selectOption("ROW.rotation");
  const text = await seen();
  assert.match(text, /#<row_distance>=\[SQRT\[/);
  assert.match(text, /G10 L2 P1 R\[/);
  await page.locator("#tab-results").click();
  assert.match(await page.locator("tp-results").innerText(), /Relations[\s\S]*distance mm[\s\S]*90\.000/);
  await list().first().click();
  await page.getByRole("button", { name: "Duplicate BORE" }).click();
  await put("cycle.origin[1]", 80);
  await page.getByLabel("Add a relation between cycles").selectOption("pitch-circle");
  assert.match(await seen(), /#<rel1_diameter>=/);
  await page.getByRole("button", { name: "Leave BORE3 out of the program" }).click();
  assert.doesNotMatch(await seen(), /rel1_/, "left out with its cycle");
  await page.getByRole("button", { name: "Remove BORE3" }).click();
  assert.equal(await page.getByLabel("Name of this relation").count(), 1, "gone with its cycle");
});

test("what a machine printed of several parts becomes an inspection report", async () => {
  await field("cycle.type").selectOption("hole");
  await put("cycle.diameter", 25);
  await page.locator("#tab-results").click();
  await page.locator("details.measured > summary").click();
  const run = (/** @type {number} */ d) => `center.x=0.01\ncenter.y=0\ndiameter=${d}\nresidual=0.001\n`;
  await page.locator("#measured").fill(run(25.01) + run(25.014));
  await page.getByText("2 parts").waitFor();
  assert.match(await page.locator("tp-results table").first().innerText(), /25\.014/, "the last part");
  await page.getByLabel("Name", { exact: true }).fill("Ada");
  await page.keyboard.press("Tab");
  const saved = page.waitForEvent("download");
  await page.getByRole("button", { name: "Save to print" }).click();
  const file = await (await saved).path();
  const report = readFileSync(file, "utf8");
  assert.match(
    report,
    /Inspection report[\s\S]*Ada[\s\S]*<svg[\s\S]*25\.0140[\s\S]*25\.0120/,
    "the last part, and the mean of both",
  );
});

test("a relation that takes a taken name for a while keeps what is written from it", async () => {
  await field("cycle.type").selectOption("hole");
  await field("control.workOffset").selectOption("1");
  await add("hole");
  await put("cycle.origin[0]", 90);
  await page.getByLabel("Add a relation between cycles").selectOption("line");
  await page.getByLabel("Add a relation between cycles").selectOption("line");
  const boxes = page.getByLabel("Name of this relation");
  await boxes.first().fill("ROW");
  await page.keyboard.press("Tab");
  await page.getByLabel("rotation is written from").selectOption("REL2.rotation");
  await boxes.nth(1).fill("ROW");
  await page.keyboard.press("Tab");
  await boxes.nth(1).fill("LINE");
  await page.keyboard.press("Tab");
  assert.notEqual(
    await page.getByLabel("rotation is written from").inputValue(),
    "ROW.rotation",
    "never from the other one",
  );
});

test("a rotation and a size follow results of earlier cycles, proposed in their boxes", async () => {
  await field("cycle.type").selectOption("hole");
  await add("wall-angle");
  await put("cycle.origin[1]", -45);
  await put("cycle.rotation", -90);
  await add("groove");
  await put("cycle.origin[0]", 100);
  const proposed = (/** @type {string} */ path) =>
    page.locator(`datalist[id='l-${path}'] option`).evaluateAll((all) => all.map((one) => one.getAttribute("value")));
  assert.deepEqual(await proposed("cycle.rotation"), ["=WALL.rotation"]);
  assert.deepEqual(await proposed("cycle.width"), ["=BORE.diameter"]);
  const turn = field("cycle.rotation");
  await turn.fill("=WALL.rotation+90");
  await page.keyboard.press("Tab");
  assert.match(await program(), /X\[\d+-\d+\*#<\w+_sin>\]|#<\w+_cos>/);
  const wide = await turn.evaluate((box) => box.scrollWidth <= box.clientWidth);
  assert.ok(wide, "the whole text can be read");
  await list().nth(1).click();
  await page.getByLabel("Name of this cycle").fill("SIDE");
  await page.keyboard.press("Tab");
  await list().nth(2).click();
  assert.equal(await turn.inputValue(), "=SIDE.rotation+90");
  await put("cycle.rotation", 0);
  await field("cycle.width").fill("=BORE.diameter+5");
  await page.keyboard.press("Tab");
  assert.match(await program(), /\+0\.5\*#<\w+_growth_1>/);
});

test("a cycle follows a relation of the cycles before it, by its name of the day", async () => {
  await field("cycle.type").selectOption("hole");
  await add("hole");
  await put("cycle.origin[0]", 90);
  await page.getByLabel("Add a relation between cycles").selectOption("line");
  await page.getByLabel("Add a relation between cycles").selectOption("center");
  await add("groove");
  await put("cycle.origin[1]", 80);
  const proposed = (/** @type {string} */ path) =>
    page.locator(`datalist[id='l-${path}'] option`).evaluateAll((all) => all.map((one) => one.getAttribute("value")));
  assert.deepEqual(await proposed("cycle.rotation"), ["=REL1.rotation"]);
  assert.ok((await proposed("cycle.origin[0]")).includes("=REL2.center.x"));
  assert.ok((await proposed("cycle.width")).includes("=REL1.distance"));
  await field("cycle.rotation").fill("=REL1.rotation+90");
  await page.keyboard.press("Tab");
  assert.match(await program(), /#<rel1_rotation>[\s\S]*#<groove_turned_by>/, "computed before the groove");
  await page.getByLabel("Name of this relation").first().fill("ROW");
  await page.keyboard.press("Tab");
  assert.equal(await field("cycle.rotation").inputValue(), "=ROW.rotation+90");
  // The first hole has nothing before it.
  await list().first().click();
  assert.deepEqual(await proposed("cycle.origin[0]"), []);
});

test("a place follows a result of an earlier cycle, and keeps to it when that is renamed", async () => {
  await field("cycle.type").selectOption("surface");
  await field("control.workOffset").selectOption("1");
  await put("cycle.origin[0]", -40);
  await add("hole");
  await put("limits.position", 1);
  const z = field("cycle.origin[2]");
  assert.deepEqual(
    await page
      .locator("datalist[id='l-cycle.origin[2]'] option")
      .evaluateAll((all) => all.map((one) => one.getAttribute("value"))),
    ["=SURFACE.point.z"],
  );
  await z.fill("=SURFACE.z-2");
  await page.keyboard.press("Tab");
  assert.equal(await z.inputValue(), "=SURFACE.z-2");
  assert.match(await program(), /G38\.3 X0 Y0 Z\[-12\+#<bore_shift_z>\]/);
  await list().first().click();
  await page.getByLabel("Name of this cycle").fill("TOP");
  await page.keyboard.press("Tab");
  await list().nth(1).click();
  assert.equal(await z.inputValue(), "=TOP.z-2");
  assert.match(await program(), /TOP\.point\.z is #<top_point_z>, more than 1 from 0/);
  // A number stands there again as any other does.
  await put("cycle.origin[2]", -2);
  assert.doesNotMatch(await program(), /shift_z/);
});
