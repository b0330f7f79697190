// Several cycles in one program: the list above the form, what is written from which, and that one cycle looks as before.
import assert from "node:assert/strict";
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
