// Several cycles in one program on the page: the list above the form, the parts around it, the panels beside it. For the program itself, and for renaming and
// removing, see tests/package/store-set-ups.test.mjs.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import {
  field,
  page,
  panel,
  program,
  put,
  ready,
  setUp,
  textOf,
} from "./common.mjs";

setUp({ width: 1440, height: 900 });

const list = () => page.locator(".features .feature");
const names = () => page.locator(".features .feature b").allTextContents();
/** Another feature, from the gallery. */
async function add(/** @type {string} */ type) {
  await page.getByRole("button", { name: "+ Add a feature" }).click();
  await page.locator(`tp-gallery [data-type="${type}"]`).click();
}
/** Shows the sources of the written axes. */
const written = () =>
  page.locator(".datum details").evaluate((node) => {
    /** @type {HTMLDetailsElement} */ (node).open = true;
  });
const button = (/** @type {string} */ name) =>
  page.getByRole("button", { name, exact: true });

test("a feature is a row of the list; of several the sentence of what is written, the chapters and the tables are seen", async () => {
  await field("cycle.type").selectOption("hole");
  assert.equal(await list().count(), 1);
  await field("control.workOffset").selectOption("1");
  await add("surface");
  assert.deepEqual(await names(), ["BORE", "SURFACE"]);
  await put("cycle.origin[0]", -40);
  await page.getByLabel("Name of this cycle").fill("TOP");
  await page.keyboard.press("Tab");
  await button("TOP earlier").click();
  assert.deepEqual(await names(), ["TOP", "BORE"]);
  await add("wall-angle");
  await put("cycle.origin[0]", 100);
  await written();
  await page
    .getByLabel("rotation is written from")
    .selectOption("WALL.rotation");
  assert.equal(
    await textOf(page.locator(".datum summary")),
    "X Y from BORE, Z from TOP, rotation from WALL → G54",
  );
  // Chapters in the program, a table per cycle in the results, touch numbers start anew.
  assert.deepEqual(
    await page.locator("tp-program .chapter").allTextContents(),
    ["TOP", "WALL", "BORE"],
  );
  assert.deepEqual(await page.locator("tp-program .disc").allTextContents(), [
    "1",
    "1",
    "2",
    "1",
    "2",
    "3",
    "4",
  ]);
  // A click on a line of another cycle makes it active.
  await page.locator("tp-program .line.touch").first().click();
  assert.equal(await field("cycle.type").inputValue(), "surface");
  await list().nth(2).click();
  assert.equal(await field("cycle.type").inputValue(), "hole");
  await written();
  await page.getByLabel("Height between cycles").fill("5");
  await page.keyboard.press("Tab");
  assert.match(
    await textOf(page.locator(".datum .problem")),
    /moves across at 5 mm/,
  );
  await page.getByLabel("Height between cycles").fill("");
  await page.keyboard.press("Tab");
  await panel("results", page);
  assert.equal(
    await page.locator("tp-results table caption").count(),
    4,
    "three cycles and what is written",
  );
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
    await page.evaluate(
      () => document.querySelector("touch-path")?.shadowRoot?.activeElement?.id,
    ),
    "f-cycle.width",
  );
});

test("the buttons of a cycle duplicate it, leave it out, take it in again and remove it; left out it outlives a reload", async () => {
  await field("cycle.type").selectOption("hole");
  await add("hole");
  await put("cycle.origin[0]", 90);
  await button("Duplicate BORE2").click();
  await put("cycle.origin[0]", 180);
  assert.deepEqual(await names(), ["BORE", "BORE2", "BORE3"]);
  await button("Leave BORE3 out of the program").click();
  await page.reload();
  await ready();
  assert.deepEqual(await names(), ["BORE", "BORE2", "BORE3"]);
  assert.doesNotMatch(await program(), /\(BORE3:/);
  await button("Include BORE3 in the program again").click();
  assert.match(await program(), /\(BORE3:/);
  await button("Remove BORE3").click();
  await button("Remove BORE2").click();
  assert.equal(await list().count(), 1);
  await button("Undo").click();
  assert.deepEqual(await names(), ["BORE", "BORE2"]);
});

/** The program, whose panel lists nothing while another one is shown. */
const planned = () =>
  page.evaluate(
    () =>
      /** @type {any} */ (document.querySelector("touch-path")).plan.program
        .text,
  );

test("tolerances are typed beside the results that they are of, with what they come to and what follows from them", async () => {
  await field("cycle.type").selectOption("hole");
  await put("cycle.diameter", 25);
  await panel("measured", page);
  await page.locator(".tolerances > summary").click();
  const box = (/** @type {string} */ code) =>
    page.getByRole("textbox", { name: `Tolerance of ${code}:` });
  await box("diameter").fill("H7");
  assert.equal(
    await textOf(page.locator(".tolerances small")),
    "25.0000 … 25.0210",
  );
  await panel("results", page);
  assert.match(
    await page.locator("tp-results table").first().innerText(),
    /good within ±/,
  );
  await panel("measured", page);
  await page
    .getByLabel("Action when diameter is out of tolerance")
    .selectOption("stop");
  assert.match(
    await planned(),
    /\(ABORT,diameter is #<diameter>, not 25 to 25\.021\)/,
  );
  // In a set-up a result has a name with its cycle.
  await add("boss");
  await put("cycle.origin[0]", 120);
  assert.equal(await box("BORE.diameter").inputValue(), "H7");
  await box("BORE.diameter").fill("H77");
  assert.match(
    await page.locator(".tolerances .problem").first().innerText(),
    /ISO 286 has no H77/,
  );
  await box("BORE.diameter").fill("");
  assert.doesNotMatch(await planned(), /not 25 to/);
});

test("a relation is added from a list and named; it stands in the results and among what can be written", async () => {
  await field("cycle.type").selectOption("hole");
  await field("control.workOffset").selectOption("1");
  await add("hole");
  await put("cycle.origin[0]", 90);
  const relate = page.getByLabel("Add a relation between cycles");
  await relate.selectOption("line");
  const name = page.getByLabel("Name of this relation");
  await name.fill("ROW");
  await page.keyboard.press("Tab");
  await written();
  await page
    .getByLabel("rotation is written from")
    .selectOption("ROW.rotation");
  assert.match(await planned(), /#<row_distance>=\[SQRT\[[\s\S]*G10 L2 P1 R\[/);
  await panel("results", page);
  assert.match(
    await page.locator("tp-results").innerText(),
    /Relations[\s\S]*90\.000/,
  );
  await button("Duplicate BORE2").click();
  await put("cycle.origin[1]", 80);
  await relate.selectOption("pitch-circle");
  assert.match(await planned(), /#<rel1_diameter>=/);
  await button("Remove BORE3").click();
  assert.equal(await name.count(), 1, "gone with its cycle");
});

test("what a machine printed of several parts becomes an inspection report", async () => {
  await field("cycle.type").selectOption("hole");
  await put("cycle.diameter", 25);
  await panel("measured", page);
  const run = (/** @type {number} */ d) =>
    `center.x=0.01\ncenter.y=0\ndiameter=${d}\nresidual=0.001\n`;
  await page.locator("#measured").fill(run(25.01) + run(25.014));
  await page.getByText("2 parts").waitFor();
  await panel("results", page);
  // Of the last part.
  await page
    .locator("tp-results table")
    .first()
    .getByText("25.014")
    .first()
    .waitFor();
  await panel("measured", page);
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

test("results of earlier cycles and relations are proposed in the boxes that can follow them", async () => {
  const proposed = (/** @type {string} */ path) =>
    page
      .locator(`.number:has([id="f-${path}"]) .equals option`)
      .evaluateAll((all) =>
        all.map((one) => one.getAttribute("value")).filter(Boolean),
      );
  const relate = page.getByLabel("Add a relation between cycles");
  await field("cycle.type").selectOption("hole");
  await field("control.workOffset").selectOption("1");
  await add("wall-angle");
  await put("cycle.origin[1]", -45);
  await put("cycle.rotation", -90);
  await add("groove");
  await put("cycle.origin[0]", 100);
  assert.deepEqual(await proposed("cycle.rotation"), ["=WALL.rotation"]);
  assert.deepEqual(await proposed("cycle.width"), ["=BORE.diameter"]);
  const turn = field("cycle.rotation");
  await turn.fill("=WALL.rotation+90");
  await page.keyboard.press("Tab");
  assert.equal(await turn.inputValue(), "=WALL.rotation+90");
  const wide = await turn.evaluate((box) => box.scrollWidth <= box.clientWidth);
  assert.ok(wide, "the whole text can be read");
  // With two holes: their relations, and the position of a surface.
  await button("Remove GROOVE").click();
  await add("surface");
  await put("cycle.origin[0]", -40);
  await add("hole");
  await put("cycle.origin[0]", 90);
  assert.deepEqual(await proposed("cycle.origin[2]"), ["=SURFACE.point.z"]);
  await relate.selectOption("line");
  await relate.selectOption("center");
  await add("groove");
  await put("cycle.origin[1]", 80);
  assert.ok((await proposed("cycle.rotation")).includes("=REL1.rotation"));
  assert.ok((await proposed("cycle.origin[0]")).includes("=REL2.center.x"));
  assert.ok((await proposed("cycle.width")).includes("=REL1.distance"));
  // The first cycle follows nothing.
  await list().first().click();
  assert.deepEqual(await proposed("cycle.origin[0]"), []);
});

test("a stock is one block that fits the features, and an error in it leads to its fields", async () => {
  await field("cycle.type").selectOption("hole");
  await button("+ Add a feature").click();
  await page.locator('tp-gallery [data-type="surface"]').click();
  await page.getByLabel("One block that the features are cut into").check();
  const size = await field("stock.size[0]").inputValue();
  assert.ok(Number(size) > 60, size);
  assert.equal(await page.locator(".verdict .error").count(), 0);
  // 6 mm more than the touched surface: the ball would be in the block.
  const height = Number(await field("stock.size[2]").inputValue());
  await put("stock.size[2]", height + 6);
  await page.locator(".fold", { hasText: "Stock and virtual part" }).click();
  assert.match(await textOf(page.locator(".verdict")), /hits the stock/);
  await page.getByRole("button", { name: "Go to it" }).first().click();
  assert.ok(await field("stock.origin[0]").isVisible());
  await button("Fit it to the features").click();
  assert.equal(Number(await field("stock.size[2]").inputValue()), height);
});
