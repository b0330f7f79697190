// Named presets: what belongs to a machine, kept, used, taken along.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { chooseUnits, field, held, more, openTab, page, program, ready, setUp, textOf } from "./common.mjs";

setUp();

const dialog = () => page.getByRole("dialog", { name: "My machines" });
const close = () => dialog().getByRole("button", { name: "Close" }).click();
const openFile = (/** @type {string} */ text) =>
  dialog()
    .locator("input[type=file]")
    .setInputFiles({ name: "p.json", mimeType: "application/json", buffer: Buffer.from(text) });
const told = () => textOf(dialog().getByRole("status"));

test("a preset brings stylus, feeds and control back, in other units and after a reload, and the part stays", async () => {
  await field("stylus.diameter").fill("3");
  await field("feeds.work").fill("80");
  await field("control.post").selectOption("sinumerik");
  await more("My machines");
  await dialog().getByLabel("Name of the machine").fill("Mill 2 <b>");
  await dialog().getByRole("button", { name: "Keep the present values" }).click();
  assert.match(await told(), /Kept “Mill 2 <b>”/);
  await close();
  await page.getByRole("button", { name: "Undo" }).click();
  await page.getByRole("button", { name: "Undo" }).click();
  await page.getByRole("button", { name: "Undo" }).click();
  await page.reload();
  await ready();
  assert.equal(await held("stylus.diameter"), 6);
  await field("cycle.width1").fill("66");
  await chooseUnits("inch");
  await more("My machines");
  await dialog().getByRole("button", { name: "Use Mill 2 <b>" }).click();
  await close();
  assert.deepEqual(
    [await held("units"), await held("stylus.diameter"), await held("feeds.work"), await held("control.post")],
    ["inch", 0.11811, 3.149606, "sinumerik"],
  );
  assert.match(await program(), /MEAS=1/);
  await chooseUnits("mm");
  assert.ok(Math.abs(Number(await held("cycle.width1")) - 66) < 1e-4, "the part is the job's");
  await page.getByRole("button", { name: "Undo" }).click();
  await page.getByRole("button", { name: "Undo" }).click();
  assert.equal(await held("control.post"), "linuxcnc", "undo brings back what was there");
});

test("presets are saved as a file and read again; a file that is none changes nothing, what is none in it is left out", async () => {
  await more("My machines");
  for (const name of ["one", "two", "one"]) {
    await dialog().getByLabel("Name of the machine").fill(name);
    await page.keyboard.press("Enter");
  }
  const names = () => dialog().locator("li b").allTextContents();
  assert.deepEqual(await names(), ["one", "two"]);
  const download = page.waitForEvent("download");
  await dialog().getByRole("button", { name: "Save all as a file" }).click();
  const text = readFileSync(await (await download).path(), "utf8");
  const give = async (/** @type {string} */ text) => {
    await openFile(text);
    await page.waitForTimeout(100);
  };
  await dialog().getByRole("button", { name: "Forget one" }).click();
  assert.deepEqual(await names(), ["two"]);
  for (const bad of [
    "{",
    "[]",
    '{"format":"touchpath-presets","version":2,"presets":[]}',
    '{"format":1,"cycle":{"type":"hole"}}',
  ]) {
    await give(bad);
    assert.match(await told(), /Nothing was changed/, bad);
    assert.deepEqual(await names(), ["two"]);
  }
  await give(text);
  assert.deepEqual(await names(), ["one", "two"]);
  const before = await held("feeds");
  await give(
    JSON.stringify({
      format: "touchpath-presets",
      version: 1,
      presets: [7, { name: "no sections" }, { name: "wrong", sections: { feeds: { work: [] }, __proto__: 1 } }],
    }),
  );
  assert.deepEqual(await names(), ["one", "two", "wrong"]);
  await dialog().getByRole("button", { name: "Use wrong" }).click();
  assert.match(await told(), /Nothing was changed: this machine cannot be used: feeds\.work/);
  assert.deepEqual(await held("feeds"), before);
});

test("two tabs overwrote each other's presets, and a file pushed the user's own out", async () => {
  const other = await openTab();
  const keep = async (/** @type {import("playwright-core").Page} */ tab, /** @type {string} */ name) => {
    await more("My machines", tab);
    await tab.getByLabel("Name of the machine").fill(name);
    await tab.getByRole("button", { name: "Keep the present values" }).click();
    await tab.getByRole("dialog", { name: "My machines" }).getByRole("button", { name: "Close" }).click();
  };
  await keep(page, "Mill A");
  await keep(other, "Mill B");
  await keep(page, "Mill C");
  const names = () => page.locator("tp-presets li b").allTextContents();
  assert.deepEqual(await names(), ["Mill A", "Mill B", "Mill C"]);
  const many = Array.from({ length: 200 }, (_, i) => ({ name: `A${i}`, units: "mm", sections: { stylus: {} } }));
  await more("My machines");
  await openFile(JSON.stringify({ format: "touchpath-presets", version: 1, presets: many }));
  await page.locator("tp-presets [role=status]", { hasText: "at most 200" }).waitFor();
  assert.deepEqual(await names(), ["Mill A", "Mill B", "Mill C"]);
});

test("a preset that leaves something out brings the defaults, not holes", async () => {
  await field("stylus.diameter").fill("3");
  await more("My machines");
  await openFile('{"format":"touchpath-presets","version":1,"presets":[{"name":"bare","sections":{"stylus":{}}}]}');
  await dialog().getByRole("button", { name: "Use bare" }).click();
  assert.equal(await held("stylus.diameter"), 6);
});
