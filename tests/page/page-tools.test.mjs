// Tools of the bar and the menu: gallery, tool lengths, a job from a file or a pasted text.
import assert from "node:assert/strict";
import { test } from "node:test";
import { AxeBuilder } from "@axe-core/playwright";
import {
  field,
  more,
  page,
  pixels,
  problems,
  program,
  reset,
  setUp,
  textOf,
  until,
} from "./common.mjs";

setUp();

test("a job is saved and opened again", async () => {
  await field("cycle.width2").fill("44");
  const download = page.waitForEvent("download");
  await more("Save job");
  const path = await (await download).path();
  await reset();
  assert.equal(await field("cycle.width2").inputValue(), "50");
  await page.locator("#file").setInputFiles(path);
  await until("cycle.width2", "44");
});

test("tool lengths: the manual's examples, a frame by steps, what the control is asked", async () => {
  await more("Tool lengths");
  const answer = page.locator("tp-lentoax .answer");
  const axind = async () =>
    (await answer.locator("tbody td:nth-child(2)").allTextContents())
      .map((t) => t.trim())
      .join(" ");
  await answer.locator("tbody td").first().waitFor();
  assert.equal(await axind(), "3 2 1");
  const said = async () =>
    textOf(page.locator("tp-lentoax [role=status]").first());
  assert.match(
    await said(),
    /L1 acts along \+Z, L2 acts along \+Y, L3 acts along \+X/,
  );
  const before = await pixels();
  assert.ok(before.count > 300, "arrows are drawn");
  await page.getByRole("button", { name: "Add ROT" }).click();
  await page.getByLabel("Step 1: angle").fill("60");
  assert.equal(await axind(), "2 -3 1");
  assert.match(await said(), /Status 1/);
  assert.match((await answer.textContent()) ?? "", /0\.8660254/);
  assert.notEqual((await pixels()).sum, before.sum);
  await page.getByRole("button", { name: "Add MIRROR" }).click();
  await page.getByRole("button", { name: "Step 2: up" }).click();
  await page.getByRole("button", { name: "Step 2: remove" }).click();
  assert.equal(await axind(), "-3 2 1");
  await page.locator("#l-42900").check();
  assert.equal(await axind(), "3 2 1");
  await page.locator("#l-coord").selectOption("TCS");
  assert.equal(await axind(), "-3 2 1");
  await page.locator("#l-type").fill("x");
  assert.match(await said(), /Tool type must be a number/);
  await page
    .locator("#l-group")
    .selectOption({ label: "Turning tools (500 to 599)" });
  await page.locator("#l-42900").uncheck();
  await page.locator("#l-coord").selectOption("BCS");
  assert.equal(await axind(), "2 1 3");
  await page.getByRole("button", { name: "Copy" }).click();
  await page.getByText("Copied").waitFor();
  assert.match(
    await page.evaluate(() => navigator.clipboard.readText()),
    /_STAT=LENTOAX\(_AXIND,_MATRIX,"BCS"\)/,
  );
  const { violations } = await new AxeBuilder({ page }).analyze();
  assert.deepEqual(
    violations
      .filter((v) => v.impact === "serious" || v.impact === "critical")
      .map((v) => v.id),
    [],
  );
  await page.getByRole("button", { name: "Back to the job" }).click();
  assert.match(await program(), /G38\.2/);
  assert.deepEqual(problems, []);
});

test("the gallery: small pictures, search by name or number, a cycle chosen", async () => {
  await page.getByRole("button", { name: "Gallery" }).click();
  const cards = page.locator("tp-gallery li:visible:has([data-type])");
  await cards.first().waitFor();
  assert.equal(await cards.count(), 19);
  assert.equal(await page.locator("tp-gallery [data-set-up]").count(), 5);
  const drawn = await page.locator("tp-gallery canvas").evaluateAll((all) =>
    all.map((node) => {
      const canvas = /** @type {HTMLCanvasElement} */ (node);
      const drawing = /** @type {CanvasRenderingContext2D} */ (
        canvas.getContext("2d")
      );
      const data = new Uint32Array(
        drawing.getImageData(0, 0, canvas.width, canvas.height).data.buffer,
      );
      return data.filter((pixel) => pixel !== data[0]).length;
    }),
  );
  assert.equal(
    drawn.length,
    5 + 17,
    "the ready set-ups; two types have no motion",
  );
  assert.ok(
    drawn.every((count) => count > 150),
    `${drawn}`,
  );
  const search = page.getByLabel("Search the cycles");
  await search.fill("corner");
  assert.equal(await cards.count(), 4);
  await search.fill("1");
  assert.deepEqual(await cards.locator("b").allTextContents(), ["NC action"]);
  await search.fill("16");
  assert.deepEqual(await cards.locator("b").allTextContents(), [
    "Triple wall external corner",
  ]);
  await cards.first().getByRole("button").first().click();
  assert.equal(
    await field("cycle.type").inputValue(),
    "triple-wall-external-corner",
  );
  assert.match(await program(), /type 16: Triple wall external corner/);
  assert.deepEqual(problems, []);
});

test("a dump is pasted in and becomes the job again; nonsense stays where it was pasted", async () => {
  await field("cycle.type").selectOption("hole-protected");
  await field("cycle.diameter").fill("52.5");
  await field("cycle.origin[0]").fill("12");
  await page.getByRole("tab", { name: "Parameters" }).click();
  await page.getByRole("button", { name: "Copy as text" }).click();
  await page.getByText("Copied").waitFor();
  const dump = await page.evaluate(() => navigator.clipboard.readText());
  await reset();
  await more("Paste");
  await page.locator("#paste").fill("no job at all");
  await page.getByRole("button", { name: "Read it" }).click();
  assert.match(
    (await page.locator(".note").textContent()) ?? "",
    /This text gives no job/,
  );
  assert.equal(await page.locator("#paste").inputValue(), "no job at all");
  await page
    .locator("#paste")
    .fill(dump.replaceAll(".Flt[", ". Flt [").replaceAll("52.5", "52,5"));
  await page.getByRole("button", { name: "Read it" }).click();
  assert.equal(await field("cycle.diameter").inputValue(), "52.5");
  assert.equal(await field("cycle.origin[0]").inputValue(), "12");
  assert.match(
    (await page.locator(".note").textContent()) ?? "",
    /does not give feeds.*does not give the stylus/s,
  );
  assert.equal(await page.locator("#paste").count(), 0);
  assert.deepEqual(problems, []);
});
