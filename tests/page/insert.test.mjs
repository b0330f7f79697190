// The program of the job inside a program of the shop: proposed after the tool change of the probe, read back, saved under the file's name.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import {
  field,
  more,
  page,
  program,
  put,
  setUp,
  textOf,
  undo,
} from "./common.mjs";

setUp();

const PART = `%
O0100 (BRACKET)
G21 G17 G90
T1 M6
G43 H1 Z50.
G0 X0 Y0
T24 M6 (PROBE)
G43 H24 Z50.
M19
T2 M6
G43 H2 Z50.
M30
%
`;

/** Chooses a file to put the program into. */
const chooses = (/** @type {string} */ text) =>
  page.locator("#into").setInputFiles({
    name: "PART.NC",
    mimeType: "text/plain",
    buffer: Buffer.from(text),
  });

test("the program goes after the probe's length, or another line, and the whole is saved", async () => {
  await put("control.post", "haas");
  await put("control.workOffset", 1);
  const own = (await program()).trim().split("\n");
  await more("Insert into a program");
  await chooses(PART);
  const panel = page.getByRole("region", { name: "Insert into a program" });
  await panel.waitFor();
  assert.match(
    await textOf(panel.getByRole("status")),
    /is in lines 9 to \d+ of PART\.NC\. All other lines are unchanged\.$/,
  );
  assert.match(await textOf(panel), /Active after the inserted lines: G21/);
  const saves = async () => {
    const [download] = await Promise.all([
      page.waitForEvent("download"),
      panel.getByRole("button", { name: "Save PART.NC" }).click(),
    ]);
    assert.equal(download.suggestedFilename(), "PART.NC");
    return readFileSync(await download.path(), "utf8").split("\n");
  };
  const first = await saves();
  assert.equal(first[7], "G43 H24 Z50.");
  assert.equal(first[8], "(TOUCHPATH BEGINS)");
  assert.ok(first.includes(String(own.find((line) => line.startsWith("G31")))));
  // The tool changes are offered, and any line can be entered.
  const places = panel.getByLabel("Tool change");
  assert.deepEqual(await places.locator("option").allTextContents(), [
    "",
    "5: 1",
    "8: 24 (probe)",
    "11: 2",
  ]);
  await panel.getByLabel("After line").fill("9");
  await panel.getByLabel("After line").press("Enter");
  await panel.getByText("is in lines 10 to").waitFor();
  const second = await saves();
  assert.deepEqual(second.slice(0, 9), PART.split("\n").slice(0, 9));
  assert.equal(second[9], "(TOUCHPATH BEGINS)");
  // The job is as it was, and its program replaces the earlier one after a change.
  await page.getByRole("button", { name: "Back to the job" }).click();
  await field("cycle.depth").fill("7");
  await more("Insert into a program");
  await chooses(second.join("\n"));
  await panel.getByText("is in lines 10 to").waitFor();
  const third = await saves();
  assert.equal(third.filter((line) => line === "(TOUCHPATH BEGINS)").length, 1);
  assert.ok(third.some((line) => line.includes("CYCLE.DEPTH=7")));
});

test("a program without a place is shown with the reason, and a line gives it one", async () => {
  await put("control.post", "haas");
  await more("Insert into a program");
  await chooses("G21 G90\nG43 H1\nG0 Z50.\nM30\n");
  const panel = page.getByRole("region", { name: "Insert into a program" });
  await panel.getByText("No tool change of a probe is found").waitFor();
  const save = panel.getByRole("button", { name: "Save PART.NC" });
  assert.equal(await save.isDisabled(), true);
  await panel.getByLabel("After line").fill("2");
  await panel.getByLabel("After line").press("Tab");
  await panel.getByText("is in lines 3 to").waitFor();
  assert.equal(await save.isEnabled(), true);
  await page.getByRole("button", { name: "Back to the job" }).click();
  await undo().click();
});
