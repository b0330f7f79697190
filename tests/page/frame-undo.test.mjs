// Undo of everything: every step is undone and redone, by button and keyboard, and Reset asks first.
import assert from "node:assert/strict";
import { test } from "node:test";
import {
  chooseUnits,
  field,
  held,
  more,
  openText,
  page,
  panel,
  program,
  redo,
  reset,
  setUp,
  undo,
  until,
} from "./common.mjs";

setUp({ width: 1440, height: 900 });

test("Ctrl+Z did nothing for selects, drags, files and Reset: every step is taken back, and comes again", async () => {
  assert.ok(
    (await undo().isDisabled()) && (await redo().isDisabled()),
    "nothing to take back at first",
  );
  /** @type {[string, () => Promise<unknown>][]} */
  const steps = [
    ["a field", () => field("cycle.width1").fill("81")],
    ["a choice", () => field("control.post").selectOption("sinumerik")],
    ["units", () => chooseUnits("inch")],
    ["a box", () => page.getByLabel("Long link feed: rapid").check()],
    ["another cycle", () => field("cycle.type").selectOption("boss")],
    [
      "a file",
      async () => {
        await openText('{"format":1,"cycle":{"type":"hole","diameter":33}}');
        await until("cycle.diameter", "33");
      },
    ],
    ["a reset", reset],
  ];
  const whole = () =>
    page.evaluate(() =>
      structuredClone(
        /** @type {any} */ (document.querySelector("touch-path")).store.draft,
      ),
    );
  const states = [await whole()];
  for (const [, step] of steps) {
    await step();
    states.push(await whole());
  }
  for (let i = steps.length - 1; i >= 0; i--) {
    await undo().click();
    assert.deepEqual(
      await whole(),
      states[i],
      `${steps[i]?.[0]} is taken back`,
    );
  }
  assert.ok(await undo().isDisabled());
  assert.match(
    await program(),
    /G38\.2 X42 Y0 Z-10 F150/,
    "the program is that of the first job",
  );
  for (let i = 1; i < states.length; i++) {
    await redo().click();
    assert.deepEqual(
      await whole(),
      states[i],
      `${steps[i - 1]?.[0]} comes again`,
    );
  }
  assert.ok(await redo().isDisabled());
});

test("after undo and redo every choice showed what was picked last, not what the job holds", async () => {
  const shown = async () => [
    await field("control.post").inputValue(),
    await field("units").inputValue(),
    await field("cycle.type").inputValue(),
  ];
  const holds = async () => [
    await held("control.post"),
    await held("units"),
    await held("cycle.type"),
  ];
  for (const post of ["grbl", "sinumerik", "linuxcnc"])
    await field("control.post").selectOption(post);
  for (const units of ["inch", "mm"]) await chooseUnits(units);
  for (const cycle of ["boss", "hole"])
    await field("cycle.type").selectOption(cycle);
  for (const button of [undo(), redo()]) {
    for (let i = 0; i < 7; i++) {
      await button.click();
      assert.deepEqual(await shown(), await holds(), `step ${i + 1}`);
    }
  }
});

test("undo took measured points away that were entered after the step: they are a step of their own", async () => {
  await field("cycle.width1").fill("81");
  await panel("measured");
  const box = page.locator("#measured");
  await box.fill("37.1,0,-10");
  await undo().click();
  assert.deepEqual(
    [await box.inputValue(), await held("cycle.width1")],
    ["", 81],
  );
  await redo().click();
  assert.equal(await box.inputValue(), "37.1,0,-10");
  await undo().click();
  await undo().click();
  assert.equal(await held("cycle.width1"), 80);
});

test("a field of an optional form showed what was typed into it before it was left out", async () => {
  await field("cycle.type").selectOption("probing-two-circles");
  const use = page
    .locator("#group-Extrusion-probing-1493-")
    .getByLabel("Use it");
  await use.check();
  await field("cycle.extrusion.length").fill("7");
  await use.uncheck();
  await use.check();
  assert.equal(
    await field("cycle.extrusion.length").inputValue(),
    String(await held("cycle.extrusion.length")),
  );
});

test("Ctrl+Z in a field that is not the job's, or in another tool, leaves the job alone", async () => {
  await field("cycle.width1").fill("81");
  await page.getByRole("tab", { name: "Parameters" }).click();
  await page.getByLabel("Filter the parameters").press("Control+z");
  await more("Tool lengths");
  await page.locator("#l-type").press("Control+z");
  await page
    .locator("tp-lentoax")
    .getByRole("button")
    .first()
    .press("Control+z");
  assert.equal(await held("cycle.width1"), 81);
});

test("a box that is ticked, cleared and ticked again is three steps", async () => {
  const box = page.getByLabel("Long link feed: rapid");
  await box.check();
  await box.uncheck();
  await box.check();
  for (const wanted of ["number", "object", "number"]) {
    await undo().click();
    assert.equal(typeof (await held("feeds.longLink")), wanted);
  }
  assert.ok(await undo().isDisabled());
});

test("letters typed in one field are one step, in another field another, and the keyboard takes them back", async () => {
  await field("cycle.width1").focus();
  await page.keyboard.type("123");
  await page.keyboard.press("Tab");
  await page.keyboard.type("45");
  assert.deepEqual(
    [await held("cycle.width1"), await held("cycle.width2")],
    [123, 45],
  );
  await page.keyboard.press("Control+z");
  assert.deepEqual(
    [await held("cycle.width1"), await held("cycle.width2")],
    [123, 50],
  );
  await page.keyboard.press("Control+z");
  assert.deepEqual(
    [await held("cycle.width1"), await held("cycle.width2")],
    [80, 50],
  );
  await page.keyboard.press("Control+y");
  assert.equal(await held("cycle.width1"), 123);
  await page.keyboard.press("Control+Shift+z");
  assert.equal(await held("cycle.width2"), 45);
  assert.equal(await field("cycle.width2").inputValue(), "45");
});

test("on a Russian keyboard Ctrl+Z did nothing: a shortcut is a key's letter, or its place where it has none", async () => {
  const width = field("cycle.width1");
  const before = await width.inputValue();
  await width.fill("66");
  // What Chromium sends for Ctrl with the key that has я on it.
  const press = (/** @type {string} */ key, /** @type {string} */ code) =>
    width.evaluate(
      (input, [key, code]) =>
        input.dispatchEvent(
          new KeyboardEvent("keydown", {
            key,
            code,
            ctrlKey: true,
            bubbles: true,
            composed: true,
            cancelable: true,
          }),
        ),
      [key, code],
    );
  await press("я", "KeyZ");
  assert.equal(await width.inputValue(), before);
  // н is on the key Y, which means redo; on a German keyboard that key types z, which means undo.
  await press("н", "KeyY");
  assert.equal(await width.inputValue(), "66");
  await press("z", "KeyY");
  assert.equal(await width.inputValue(), before);
  // A Dvorak keyboard has its semicolon there: that is no shortcut.
  await press(";", "KeyZ");
  await press("Dead", "KeyY");
  assert.equal(await width.inputValue(), before);
});

test("Reset puts the form back at once, says so, and Undo brings everything back", async () => {
  await field("cycle.width1").fill("71");
  await more("Reset");
  assert.equal(await field("cycle.width1").inputValue(), "80");
  await page
    .locator("tp-findings .note", {
      hasText: "Undo restores the previous values",
    })
    .waitFor();
  await undo().click();
  assert.equal(await field("cycle.width1").inputValue(), "71");
});
