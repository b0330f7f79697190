// The write summary is one sentence: in the bar, under the program, on the sheet. Also names of files, and unused fields.
import assert from "node:assert/strict";
import { test } from "node:test";
import {
  field,
  held,
  more,
  openTab,
  page,
  panel,
  program,
  put,
  saveButton,
  setUp,
  textOf,
  unfold,
} from "./common.mjs";

setUp({ width: 1440, height: 900 });

const SENTENCE = "sets the basic rotation and preset X Y";

test("a job that sets rotation and preset was said to measure only, in the bar and on the sheet", async () => {
  await field("cycle.type").selectOption("probing-two-circles");
  await field("control.post").selectOption("heidenhain");
  const does = page.locator("tp-bar #does");
  const chosen = () => textOf(does.locator("option:checked"));
  assert.equal(await chosen(), "measures only");
  assert.equal(
    await field("control.workOffset").count(),
    0,
    "this cycle takes none",
  );
  // In the bar, where users look first; the fields of the form follow.
  await does.selectOption({
    label: "sets basic rotation and preset X Y, mean of both circles",
  });
  assert.equal(await field("cycle.confirmRotation").inputValue(), "1");
  assert.equal(await field("cycle.transferPosition").inputValue(), "3");
  await field("cycle.confirmRotation").selectOption("2");
  assert.match(
    await chosen(),
    /preset X Y/,
    "what is not among the common choices is said all the same",
  );
  await field("cycle.confirmRotation").selectOption("1");
  assert.equal(
    await textOf(page.locator("tp-program .write-summary")),
    `This program ${SENTENCE}`,
  );
  assert.match(
    (await program()).replaceAll(/\n\d+ ; /g, " ").toLowerCase(),
    new RegExp(SENTENCE.toLowerCase()),
  );
  await more("Setup sheet to print", page);
  const sheet = page.getByRole("article", { name: "Setup sheet" });
  assert.ok(
    (await textOf(sheet.locator("p").first())).includes(`, ${SENTENCE} ·`),
  );
  assert.ok(!(await textOf(sheet)).includes("measures only"));
});

test("fields that change nothing stood there with a value", async () => {
  await field("cycle.type").selectOption("hole");
  await unfold();
  const angular = ["startAngle", "angularStep", "stepCount"].map((key) =>
    field(`cycle.${key}`),
  );
  for (const one of angular) assert.equal(await one.count(), 0);
  await field("cycle.variant").selectOption("1");
  for (const one of angular) await one.waitFor();
  for (const path of ["control.number", "control.setUp"])
    assert.equal(await field(path).count(), 0, path);
  await field("control.post").selectOption("fanuc");
  assert.equal(
    await field("control.number").inputValue(),
    "1000",
    "the number that the program has",
  );
  await put("name", "BORE2201");
  assert.equal(await field("control.number").inputValue(), "2201");
  // An ignored value is shown so that it can be removed.
  await put("control.number", 7);
  await field("control.post").selectOption("linuxcnc");
  assert.equal(await field("control.number").inputValue(), "7");
  await page
    .locator(".verdict", { hasText: "have no number: it is ignored" })
    .waitFor();
});

test("a size is judged by the tolerance that is typed behind it, by Tab and by Enter", async () => {
  await field("cycle.type").selectOption("hole");
  const diameter = field("cycle.diameter");
  for (const [typed, key] of [
    ["25+0.021", "Tab"],
    ["25 ±0.02", "Enter"],
    ["25 H7", "Tab"],
  ]) {
    await diameter.fill(/** @type {string} */ (typed));
    await page.keyboard.press(/** @type {string} */ (key));
    assert.equal(await diameter.inputValue(), typed, "what was typed stays");
    assert.equal(await held("cycle.diameter"), typed);
    assert.equal(await held("tolerances.diameter"), undefined);
  }
  assert.equal(await textOf(saveButton()), "Save BORE-D25H7.ngc");
  assert.match(
    await textOf(page.locator(".sentence .what option:checked")),
    /hole Ø25 H7/,
  );
  await page.getByLabel("Out of tolerance").selectOption("stop");
  assert.match(await program(), /not 25 to 25\.021/);
  await panel("results");
  const row = page.locator("tp-results tr", { hasText: "Diameter" }).first();
  assert.match(await textOf(row), /25\.01[01].*good/s);
  // An arrow key changes the size, and the tolerance stays.
  await diameter.press("ArrowUp");
  assert.equal(await diameter.inputValue(), "26 H7");
  await page.getByRole("button", { name: "Undo" }).click();
  assert.equal(await diameter.inputValue(), "25 H7");
});

test("Enter works a sum out", async () => {
  await field("cycle.type").selectOption("hole");
  const diameter = field("cycle.diameter");
  await diameter.fill("50/2+0.5");
  await page.keyboard.press("Enter");
  assert.equal(await diameter.inputValue(), "25.5");
  assert.equal(await textOf(saveButton()), "Save BORE-D25_5.ngc");
});

test("another program of the same name took the place of the first without a word", async () => {
  const save = async () => {
    const download = page.waitForEvent("download");
    await saveButton().click();
    return (await download).suggestedFilename();
  };
  const note = page.locator("tp-findings .note");
  assert.equal(await save(), "POCKET-80X50.ngc");
  assert.equal(
    await textOf(page.locator("tp-program .status-text:not(.found)")),
    "Saved POCKET-80X50.ngc",
  );
  assert.equal(await note.count(), 0);
  await field("cycle.depth").fill("12");
  await note
    .filter({ hasText: "POCKET-80X50.ngc was saved before with other content" })
    .waitFor();
  assert.equal(
    await saveButton().getAttribute("title"),
    "POCKET-80X50.ngc was saved before with other content",
  );
  await save();
  assert.match(
    await textOf(page.locator("tp-program .status-text:not(.found)")),
    /with other content than the one saved before$/,
  );
  assert.equal(await note.count(), 0);
  // Another day, another tab.
  const tab = await openTab();
  await tab.locator('[id="f-cycle.depth"]').fill("10");
  await tab
    .locator("tp-findings .note", {
      hasText: "was saved before with other content",
    })
    .waitFor();
});

test("the lines that ask the control about a turning tool asked for a milling tool", async () => {
  await more("Tool lengths");
  await page
    .locator("#l-group")
    .selectOption({ label: "Turning tools (500 to 599)" });
  const lines = page.locator("tp-lentoax pre");
  await lines
    .filter({ hasText: "_AXIND[0]<>2) OR (_AXIND[1]<>1) OR (_AXIND[2]<>3)" })
    .waitFor();
});
