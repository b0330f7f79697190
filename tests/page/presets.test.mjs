// Named presets of a machine: stored, used, exported. For their contents see tests/package/store-presets.test.mjs.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import {
  field,
  held,
  more,
  openTab,
  page,
  ready,
  setUp,
  textOf,
} from "./common.mjs";

setUp();

const dialog = () => page.getByRole("dialog", { name: "My machines" });
const close = () => dialog().getByRole("button", { name: "Close" }).click();
const openFile = (/** @type {string} */ text) =>
  dialog()
    .locator("input[type=file]")
    .setInputFiles({
      name: "p.json",
      mimeType: "application/json",
      buffer: Buffer.from(text),
    });
const told = () => textOf(dialog().getByRole("status"));

test("a machine is kept over a reload, and used it says so; one that leaves something out brings the defaults", async () => {
  await field("stylus.diameter").fill("3");
  await field("control.post").selectOption("sinumerik");
  await more("My machines");
  await dialog().getByLabel("Name of the machine").fill("Mill 2 <b>");
  await dialog()
    .getByRole("button", { name: "Keep the current values" })
    .click();
  assert.match(await told(), /Stored “Mill 2 <b>”/);
  await close();
  await page.getByRole("button", { name: "Undo" }).click();
  await page.getByRole("button", { name: "Undo" }).click();
  await page.reload();
  await ready();
  assert.equal(await held("stylus.diameter"), 6);
  await more("My machines");
  await dialog().getByRole("button", { name: "Use Mill 2 <b>" }).click();
  assert.match(
    await told(),
    /“Mill 2 <b>” is in use\. Undo restores the previous machine\./,
  );
  assert.deepEqual(
    [await held("stylus.diameter"), await held("control.post")],
    [3, "sinumerik"],
  );
  await openFile(
    '{"format":"touchpath-presets","version":1,"presets":[{"name":"bare","sections":{"stylus":{}}}]}',
  );
  await dialog().getByRole("button", { name: "Use bare" }).click();
  assert.equal(await held("stylus.diameter"), 6);
});

test("machines are saved as a file and read again; a file that is none changes nothing, and one that cannot be used says why", async () => {
  await more("My machines");
  for (const name of ["one", "two", "one"]) {
    await dialog().getByLabel("Name of the machine").fill(name);
    await page.keyboard.press("Enter");
  }
  const names = () => dialog().locator("li b").allTextContents();
  const tells = (/** @type {RegExp} */ text) =>
    dialog().getByRole("status").filter({ hasText: text }).waitFor();
  assert.deepEqual(await names(), ["one", "two"]);
  const download = page.waitForEvent("download");
  await dialog().getByRole("button", { name: "Save all as a file" }).click();
  const text = readFileSync(await (await download).path(), "utf8");
  await dialog().getByRole("button", { name: "Delete one" }).click();
  assert.deepEqual(await names(), ["two"]);
  await openFile("{");
  await tells(/Nothing was changed/);
  assert.deepEqual(await names(), ["two"]);
  await openFile(text);
  await tells(/2 machines were read/);
  assert.deepEqual(await names(), ["one", "two"]);
  const wrong = { name: "wrong", sections: { feeds: { work: [] } } };
  await openFile(
    JSON.stringify({
      format: "touchpath-presets",
      version: 1,
      presets: [7, wrong],
    }),
  );
  await tells(/1 machines were read/);
  assert.deepEqual(await names(), ["one", "two", "wrong"]);
  await dialog().getByRole("button", { name: "Use wrong" }).click();
  await tells(/Nothing was changed: this machine cannot be used: feeds\.work/);
});

test("two tabs overwrote each other's presets, and a file pushed the user's own out", async () => {
  const other = await openTab();
  const keep = async (
    /** @type {import("playwright-core").Page} */ tab,
    /** @type {string} */ name,
  ) => {
    await more("My machines", tab);
    await tab.getByLabel("Name of the machine").fill(name);
    await tab.getByRole("button", { name: "Keep the current values" }).click();
    await tab
      .getByRole("dialog", { name: "My machines" })
      .getByRole("button", { name: "Close" })
      .click();
  };
  await keep(page, "Mill A");
  await keep(other, "Mill B");
  await keep(page, "Mill C");
  const names = () => page.locator("tp-presets li b").allTextContents();
  assert.deepEqual(await names(), ["Mill A", "Mill B", "Mill C"]);
  const many = Array.from({ length: 200 }, (_, i) => ({
    name: `A${i}`,
    units: "mm",
    sections: { stylus: {} },
  }));
  await more("My machines");
  await openFile(
    JSON.stringify({ format: "touchpath-presets", version: 1, presets: many }),
  );
  await page
    .locator("tp-presets [role=status]", { hasText: "at most 200" })
    .waitFor();
  assert.deepEqual(await names(), ["Mill A", "Mill B", "Mill C"]);
});
