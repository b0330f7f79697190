// The served page in Chromium, used like by a user.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { AxeBuilder } from "@axe-core/playwright";
import { catalog } from "touchpath";
import {
  boxOf,
  field,
  focusedId,
  held,
  more,
  open,
  PICTURE,
  page,
  panel,
  pixels,
  problems,
  program,
  ready,
  reset,
  saveButton,
  setUp,
  unfold,
  until,
} from "./common.mjs";

setUp();

const selected = () =>
  page.locator("tp-program [aria-selected=true] .text").allTextContents();

test("a keystroke changes program, table, picture and results", async () => {
  assert.match(await program(), /G38\.2 X42 Y0 Z-10 F150/);
  const before = await pixels();
  assert.ok(before.count > 2000, "the canvas is not blank");
  await field("cycle.width1").fill("90");
  assert.match(await program(), /G38\.2 X47 Y0 Z-10 F150/);
  assert.notEqual((await pixels()).sum, before.sum);
  await page.getByRole("tab", { name: "Parameters" }).click();
  const row = page.locator("tp-table tr", { hasText: "CmdPrm.Flt[-53]" });
  assert.match((await row.textContent()) ?? "", /90/);
  await panel("results", page);
  assert.match(
    (await page
      .locator("tp-results tr", { hasText: "width1" })
      .first()
      .textContent()) ?? "",
    /90\.000/,
  );
  assert.deepEqual(problems, []);
});

test("an error stands beside its field, the last valid plan stays and is marked, and what was typed is kept", async () => {
  const good = await program();
  await field("cycle.sideClearance1").fill("2");
  const problem = page.locator(`[id="e-cycle.sideClearance1"]`);
  assert.match((await problem.textContent()) ?? "", /ball radius/);
  assert.equal(
    await field("cycle.sideClearance1").getAttribute("aria-invalid"),
    "true",
  );
  assert.equal(await program(), good);
  await page.getByText("last valid plan").waitFor();
  await field("cycle.depth").fill("ten");
  assert.match(
    (await page.locator("tp-findings").textContent()) ?? "",
    /2 errors/,
  );
  await page.reload();
  await ready();
  assert.equal(await field("cycle.depth").inputValue(), "ten");
  assert.equal(await field("cycle.sideClearance1").inputValue(), "2");
  await page
    .locator("tp-findings")
    .getByRole("button", { name: "All" })
    .click();
  await page.locator("tp-checks a", { hasText: "Depth" }).click();
  assert.equal(await focusedId(), "f-cycle.depth");
  await field("cycle.depth").fill("10");
  await field("cycle.sideClearance1").fill("8");
  assert.equal(
    await page.getByText("last valid plan").filter({ visible: true }).count(),
    0,
  );
});

test("a feed is rapid only by its own box, and an empty field says what is missing", async () => {
  await field("feeds.longLink").fill("");
  assert.match(
    (await page.locator(`[id="e-feeds.longLink"]`).textContent()) ?? "",
    /must be a number/,
  );
  await page.getByLabel("Long link feed: rapid").check();
  assert.equal(await held("feeds.longLink"), null);
});

test("the keyboard alone is enough", async () => {
  const id = focusedId;
  await page.locator("body").press("Tab");
  for (let i = 0; i < 60 && (await id()) !== "f-cycle.width1"; i++)
    await page.keyboard.press("Tab");
  assert.equal(await id(), "f-cycle.width1");
  await page.keyboard.type("66");
  assert.match(
    await program(),
    /G38\.2 X35 Y0 Z-10 F150/,
    "focus selects, so that typing replaces",
  );
  const list = page.getByRole("listbox", { name: "Program" });
  await list.focus();
  for (let i = 0; i < 5; i++) await page.keyboard.press("ArrowDown");
  assert.deepEqual(await selected(), ["G38.2 X35 Y0 Z-10 F150"]);
  await page.locator(PICTURE).focus();
  const before = await pixels();
  await page.keyboard.press("+");
  assert.notEqual((await pixels()).sum, before.sum);
  await page.keyboard.press("0");
  await page.getByRole("tab", { name: "Program" }).focus();
  await page.keyboard.press("ArrowRight");
  assert.equal(await id(), "tab-table");
});

test("views, zoom by wheel, drag", async () => {
  const seen = new Set([(await pixels()).sum]);
  for (const name of ["front", "side", "isometric", "top"]) {
    await page.getByRole("button", { name, exact: true }).click();
    seen.add((await pixels()).sum);
  }
  assert.equal(seen.size, 4, "four different pictures");
  const box = await boxOf(page.locator(PICTURE));
  const fitted = (await pixels()).sum;
  await page.mouse.move(box.x + 60, box.y + 60);
  await page.mouse.wheel(0, -300);
  assert.notEqual((await pixels()).sum, fitted);
  await page.locator(PICTURE).dblclick({ position: { x: 60, y: 60 } });
  await page.mouse.move(box.x + 4, box.y + 4);
  await page.mouse.down();
  await page.mouse.move(box.x + 60, box.y + 40, { steps: 4 });
  await page.mouse.up();
  assert.notEqual((await pixels()).sum, fitted);
});

test("the virtual part: its fields, its handle, its results", async () => {
  await panel("results", page);
  await field("part.offset[0]").fill("0.5");
  await field("part.rotation").fill("1");
  const row = page.locator("tp-results tr", { hasText: "width1" }).first();
  // 74·(1/cos 1° − 1) = 0.01127 too wide; a thousandth is shown.
  assert.match((await row.textContent()) ?? "", /80\.011/);
  assert.match(
    (await page.locator("tp-results .notes").textContent()) ?? "",
    /cosine error/,
  );
  await field("part.rotation").fill("0");
  await field("part.offset[0]").fill("0");
  const box = await boxOf(page.locator(PICTURE));
  const middle = { x: box.x + box.width / 2, y: box.y + box.height / 2 };
  await page.mouse.move(middle.x, middle.y);
  await page.mouse.down();
  await page.mouse.move(middle.x + 5, middle.y - 5, { steps: 3 });
  await page.mouse.up();
  const shift = /** @type {const} */ ([
    Number(await field("part.offset[0]").inputValue()),
    Number(await field("part.offset[1]").inputValue()),
  ]);
  assert.ok(shift[0] > 0.1 && shift[1] > 0.1, `${shift}`);
  assert.match(
    (await page
      .locator("tp-results tr", { hasText: "center.x" })
      .first()
      .textContent()) ?? "",
    new RegExp(`\\+${shift[0]}`),
  );
});

test("two circles: a class in a diameter, the verdict of the size, the handle of a touch", async () => {
  await field("cycle.type").selectOption("probing-two-circles");
  await field("control.post").selectOption("heidenhain");
  await field("cycle.diameter1").fill("20H7");
  await field("part.sizes.diameter1").fill("0.05");
  await panel("results", page);
  const status = page.locator("tp-results tr", { hasText: "Q183" }).first();
  assert.match(
    (await status.textContent()) ?? "",
    /2.*scrap: the program continues/,
  );
  await page.getByRole("tab", { name: "Program" }).click();
  await field("cycle.diameter1").fill("20H99");
  assert.match(
    (await page.locator(`[id="e-cycle.diameter1"]`).textContent()) ?? "",
    /ISO 286 has no H99/,
  );
  await field("cycle.diameter1").fill("20H7");
  // The handle of the first touch is to the right of circle 1; dragged up, the start angle becomes 90°.
  const box = await boxOf(page.locator(PICTURE));
  let from = null;
  const cursor = () => page.locator(PICTURE).evaluate((c) => c.style.cursor);
  for (let x = 0; x < box.width / 2 && !from; x += 4) {
    await page.mouse.move(box.x + x, box.y + box.height / 2);
    if ((await cursor()) === "grab")
      from = { x: box.x + x + 4, y: box.y + box.height / 2 };
  }
  assert.ok(from, "a handle is found");
  await page.mouse.move(from.x, from.y);
  await page.mouse.down();
  await page.mouse.move(from.x - 60, from.y - 90, { steps: 5 });
  await page.mouse.up();
  const angle = Number(await field("cycle.startingAngle").inputValue());
  const length = Number(await field("cycle.angularLength").inputValue());
  assert.ok(angle !== 0 || length !== 360, "the form follows the handle");
  assert.deepEqual(problems, []);
});

test("a form inside the form is taken in by its box, and its program is opened again as it was saved", async () => {
  await field("cycle.type").selectOption("probing-two-circles");
  await field("control.post").selectOption("heidenhain");
  await unfold();
  await page
    .locator("#group-Extrusion-probing-1493-")
    .getByLabel("Use it")
    .check();
  await field("cycle.extrusion.points").fill("3");
  assert.match(
    await program(),
    /\n\d+ TCH PROBE 1493 EXTRUSION PROBING ~\n {4}Q1140=\+3 /,
  );
  const download = page.waitForEvent("download");
  await saveButton().click();
  const text = readFileSync(await (await download).path(), "utf8");
  await reset();
  assert.doesNotMatch(await program(), /1493/);
  await page.locator("#file").setInputFiles({
    name: "A.H",
    mimeType: "text/plain",
    buffer: Buffer.from(text),
  });
  await until("cycle.extrusion.points", "3");
  assert.equal(
    `${await program()}\n`,
    text,
    "what was saved comes back byte for byte",
  );
  assert.match(
    (await page.locator(".note").textContent()) ?? "",
    /does not contain the part's position/,
  );
  assert.deepEqual(problems, []);
});

test("every cycle has a plan on the page, and its steps light up with the move", async () => {
  for (const { type, steps } of catalog().cycles) {
    await field("cycle.type").selectOption(type);
    assert.equal(await page.locator("tp-findings .error").count(), 0, type);
    if (steps.length === 0) continue;
    const heads = await page.locator("tp-program .step span").allTextContents();
    assert.ok(
      heads.length > 1 && heads.every((text) => steps.includes(text)),
      type,
    );
    const moves = Number(await page.locator("#timeline").getAttribute("max"));
    for (const move of [1, moves]) {
      await page.locator("#timeline").fill(String(move));
      const said =
        (await page.locator("#timeline").getAttribute("aria-valuetext")) ?? "";
      const step = Number(/step (\d+)/.exec(said)?.[1]);
      const lit = await page
        .locator("tp-program .step.lit span")
        .allTextContents();
      assert.ok(
        lit.length > 0 && lit.every((text) => text === steps[step - 1]),
        `${type}: ${lit} at ${said}`,
      );
      // The highlighted line is under the heading of that step.
      const over = await page
        .locator("tp-program [aria-selected=true]")
        .locator("..")
        .getAttribute("aria-label");
      assert.equal(over, `Step ${step}: ${steps[step - 1]}`, type);
    }
  }
  assert.deepEqual(problems, []);
});

/** A program without the comments that say its job. */
const blocks = (/** @type {string} */ text) =>
  text.replace(/^\(job .*\n/gm, "");

test("touches are picked one by one and taken back", async () => {
  await page.getByRole("button", { name: "Pick touches one by one" }).click();
  const before = await program();
  await page.getByLabel("Point of touch 1, X").fill("45");
  assert.match(await program(), /G38\.2 X47 Y0 Z-10 F150/);
  assert.match(
    (await page.locator(`[id="e-cycle.width1"]`).textContent()) ?? "",
    /85 mm between the picked touches/,
  );
  await page.getByLabel("Vector of touch 1, X").fill("1");
  assert.match(
    (await page.locator(".picks").textContent()) ?? "",
    /must be opposite|points the wrong way/,
  );
  await page.getByRole("button", { name: "Back to the dimensions" }).click();
  assert.equal(blocks(await program()), blocks(before));
  assert.deepEqual(problems, []);
});

test("a frame of the tool lengths is made in their tool and applied to the job; a program is pasted back in", async () => {
  await field("control.post").selectOption("sinumerik");
  await field("control.workOffset").selectOption({ label: "writes G505" });
  await field("tool.type").fill("500");
  assert.match(
    (await page.locator("tp-findings").textContent()) ?? "",
    /L1 acts along \+Y/,
  );
  await field("tool.type").fill("710");
  await more("Tool lengths");
  await page.getByRole("button", { name: "Add ROT" }).click();
  await page.getByLabel("Step 1: angle").fill("60");
  await page.getByRole("button", { name: "Apply to the job" }).click();
  assert.match(
    (await page.locator("tp-form").textContent()) ?? "",
    /Frame: ROT Z60/,
  );
  assert.equal(
    await page.locator("tp-findings .error").count(),
    0,
    "a turn about the tool axis leaves L1 where it is",
  );
  const text = await program();
  await reset();
  await more("Paste");
  await page.locator("#paste").fill(text);
  await page.getByRole("button", { name: "Read it" }).click();
  assert.equal(
    await program(),
    text,
    "what was written comes back byte for byte",
  );
  assert.deepEqual(problems, []);
});

// The colours of the dark page are the same at every width.
for (const [colorScheme, width, height] of /** @type {const} */ ([
  ["light", 1280, 800],
  ["light", 390, 844],
  ["dark", 390, 844],
])) {
  test(`no serious accessibility problem at ${width} px, ${colorScheme}, also with errors`, async () => {
    await open({ viewport: { width, height }, colorScheme });
    const violations = async () => {
      // The page has no frames, which the other mode would check one by one: it takes five times as long.
      const axe = new AxeBuilder({ page })
        .setLegacyMode()
        .options({ resultTypes: ["violations"] });
      // In dark mode only the colours differ.
      if (colorScheme === "dark") axe.withRules("color-contrast");
      const { violations } = await axe.analyze();
      return violations
        .filter((v) => v.impact === "serious" || v.impact === "critical")
        .map(
          (v) =>
            `${v.id}: ${v.nodes.map((n) => n.html.slice(0, 120)).join(" | ")}`,
        );
    };
    assert.deepEqual(await violations(), []);
    await field("cycle.depth").fill("-1");
    await field("feeds.work").fill("1500");
    assert.deepEqual(await violations(), []);
    await field("cycle.depth").fill("10");
    await field("cycle.type").selectOption("probing-two-circles");
    assert.deepEqual(await violations(), []);
    await field("cycle.type").selectOption("web-three-points");
    await field("control.post").selectOption("sinumerik");
    await unfold();
    await page.getByRole("button", { name: "Pick touches one by one" }).click();
    await more("Paste");
    assert.deepEqual(await violations(), []);
    await page.getByRole("button", { name: "Cancel" }).click();
    if (width < 1080) {
      for (const name of [
        "Program",
        "Parameters",
        "Results",
        "Checks",
        "Setup",
      ]) {
        await page.getByRole("tab", { name }).click();
        assert.deepEqual(await violations(), []);
      }
    }
    await page.getByRole("button", { name: "More" }).click();
    assert.deepEqual(await violations(), []);
    await page.keyboard.press("Escape");
    await more("Setup sheet to print");
    await page.locator("tp-sheet").waitFor();
    assert.deepEqual(await violations(), []);
    await page.getByRole("button", { name: "Back to the job" }).click();
    await page.keyboard.press("Control+k");
    await page.getByRole("combobox", { name: "Find anything" }).fill("ball");
    assert.deepEqual(await violations(), []);
    await page.keyboard.press("Escape");
    for (const topic of ["cycle:hole", "control:sinumerik"]) {
      await page.evaluate(
        (topic) =>
          /** @type {any} */ (
            document.querySelector("touch-path")
          ).app.actions.about(topic),
        topic,
      );
      await page.locator("tp-manual h2").waitFor();
      assert.deepEqual(await violations(), []);
    }
    await page.evaluate(() =>
      /** @type {any} */ (document.querySelector("touch-path")).app.actions.ask(
        "gallery",
      ),
    );
    assert.deepEqual(await violations(), []);
    const over = await page.evaluate(
      () =>
        document.documentElement.scrollWidth -
        document.documentElement.clientWidth,
    );
    assert.equal(over, 0, "nothing sticks out to the side");
    assert.deepEqual(problems, []);
  });
}
