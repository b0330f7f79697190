// The set-up sheet, and results on it: with the names of their axes, and the reference of deviations.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import {
  field,
  more,
  page,
  painted,
  panel,
  put,
  redo,
  saveButton,
  settles,
  setUp,
  textOf,
  undo,
  unfold,
} from "./common.mjs";

setUp({ width: 1440, height: 900 });

test("the setup sheet: one printed page with what is expected, boxes for what was, and the program's hash", async () => {
  await more("Setup sheet to print", page);
  const sheet = page.locator("tp-sheet");
  const hash = /Hash of the blocks: (\w{16})\./.exec(await textOf(sheet))?.[1];
  const download = page.waitForEvent("download");
  await saveButton().click();
  const text = readFileSync(await (await download).path(), "utf8");
  assert.ok(
    text.includes(`Blocks below: ${hash}`),
    "the sheet names the program that is at the machine",
  );
  assert.match(await textOf(sheet), /Width 1\s*80/);
  assert.equal(
    await sheet.locator("td.box").count(),
    9,
    "five results and four touches",
  );
  const onePage = async () => {
    await page.emulateMedia({ media: "print" });
    assert.ok(await page.locator("header").isHidden());
    for (const format of ["A4", "Letter"]) {
      const pdf = (
        await page.pdf({ format, preferCSSPageSize: false })
      ).toString("latin1");
      assert.equal(pdf.match(/\/Type\s*\/Page\b/g)?.length, 1, format);
    }
    await page.emulateMedia({ media: "screen" });
  };
  await onePage();
  // The longest: 1411, and two walls with 16 touches.
  await field("cycle.type").selectOption("probing-two-circles");
  await sheet.getByText("Measured diameter 2").waitFor();
  await onePage();
  await page.getByRole("button", { name: "Back to the job" }).click();
  await field("cycle.type").selectOption("double-wall-internal-corner");
  await unfold();
  await field("cycle.count1").fill("8");
  await field("cycle.count2").fill("8");
  await more("Setup sheet to print", page);
  await sheet.getByText("Wall 1 against its nominal direction").waitFor();
  assert.equal(
    await sheet.locator("td.box").count(),
    22,
    "six results and sixteen touches",
  );
  await onePage();
});

test("the setup sheet says what must be so before the start, and promises no report of a control that computes nothing", async () => {
  const sheet = page.locator("tp-sheet");
  const { plan, defaultJob } = await import("touchpath");
  for (const [post, reports] of /** @type {const} */ ([
    ["grbl", false],
    ["fanuc", true],
    ["sinumerik", true],
    ["linuxcnc", true],
  ])) {
    await field("control.post").selectOption(post);
    const positioning = await textOf(
      field("control.protection").locator("option:checked"),
    );
    assert.doesNotMatch(positioning, /not on this control/);
    await more("Setup sheet to print", page);
    const job = /** @type {any} */ (defaultJob("internal-rectangle-protected"));
    const lines = plan({
      ...job,
      control: { ...job.control, post },
    }).program.text.split("\n");
    const said = await textOf(sheet.locator(".head"));
    // From the units on, word by word, and nothing of the job's values.
    const first = lines.findIndex((line) => /^[(;] ?units/i.test(line));
    const end = lines.findIndex((line) => /^[(;] ?made by/i.test(line));
    assert.ok(first > 0 && end > first + 3, post);
    const wanted = lines
      .slice(first, end)
      .map((line) =>
        line.startsWith(";") ? line.slice(2) : line.slice(1, -1),
      );
    // Sentences on paper are not broken at the columns of the program.
    const whole = said.split("\n").slice(1);
    assert.equal(whole.join(" "), wanted.join(" "), post);
    assert.equal(
      whole.length < wanted.length,
      ["grbl", "fanuc"].includes(post),
      `${post}: ${whole.length} of ${wanted.length}`,
    );
    assert.ok(
      wanted.some((line) => /probe in the spindle and switched on/i.test(line)),
    );
    assert.equal(
      /Expected and reported values/.test(await textOf(sheet)),
      reports,
      post,
    );
    assert.match(await textOf(sheet), /Work feed\s*150 mm\/min/);
    await page.keyboard.press("Escape");
    await sheet.waitFor({ state: "detached" });
    await panel("results", page);
    const caption = reports
      ? "Results the control will store"
      : "Results expected from the touches";
    await page.locator("tp-results").getByText(caption).waitFor();
  }
});

test("the setup sheet drew the handle of the virtual part as if it were a feature", async () => {
  // A nominal part is not drawn: only the handle has its colour, and it is shown while a field of the part has the focus.
  await field("part.offset[0]").focus();
  const handle = async (/** @type {string} */ part) =>
    (await painted(part, "actual")).count;
  assert.ok((await handle("tp-picture")) > 20);
  await more("Setup sheet to print", page);
  await page.locator("tp-sheet [data-view=top]").waitFor();
  await settles(async () => (await handle("tp-sheet")) === 0);
});

test("a result of another plane stood under the name of another axis: in G18 the abscissa is Z", async () => {
  await field("cycle.type").selectOption("hole");
  await put("plane", "G18");
  await put("part.offset", [1, 0, 5]);
  await panel("results", page);
  const row = (/** @type {string} */ part, /** @type {string} */ code) =>
    textOf(page.locator(`${part} tr`, { hasText: code }).first());
  assert.match(await row("tp-results", "center.x"), /^\s*Centre Z .*5\.000/s);
  assert.match(await row("tp-results", "center.y"), /^\s*Centre X .*1\.000/s);
  await put("control.workOffset", 2);
  const shift = /^\s*Shift of G55 in Z that the program writes/;
  assert.match(await row("tp-results", "offset.x"), shift);
  await more("Setup sheet to print");
  await page.locator("tp-sheet").waitFor();
  assert.match(await row("tp-sheet", "center.x"), /^\s*Centre Z /);
  assert.match(await row("tp-sheet", "offset.x"), shift);
  await page.getByRole("button", { name: "Back to the job" }).click();
  await put("plane", "G19");
  assert.match(await row("tp-results", "center.x"), /^\s*Centre Y /);
});

test("results that are judged say where deviations count from", async () => {
  await field("cycle.type").selectOption("probing-two-circles");
  await unfold();
  await panel("results", page);
  const results = page.locator("tp-results");
  assert.doesNotMatch(await textOf(results), /middle of the tolerance zone/);
  await field("cycle.diameter1").fill("20H7");
  await results
    .getByText("Deviations are from the middle of the tolerance zone.")
    .waitFor();
  assert.match(
    await textOf(results.locator("tr", { hasText: "Q966" }).first()),
    /Measured diameter 1/,
  );
});

test("the setup sheet is of the form as it stands: its picture follows, and with an error there is none", async () => {
  await field("cycle.type").selectOption("hole");
  await field("cycle.diameter").fill("abc");
  await field("cycle.type").focus();
  await field("cycle.diameter").fill("55");
  await more("Setup sheet to print", page);
  const picture = () =>
    page
      .locator("tp-sheet [data-view=top]")
      .evaluate((c) => /** @type {HTMLCanvasElement} */ (c).toDataURL());
  const hole = await picture();
  await field("cycle.type").selectOption("internal-rectangle");
  await settles(async () => (await picture()) !== hole);
  await undo().click();
  await settles(async () => (await picture()) === hole);
  await undo().click();
  assert.match(
    await textOf(page.locator("tp-sheet")),
    /No setup sheet while the form has an error/,
  );
  assert.equal(await page.locator("tp-sheet :is(article, canvas)").count(), 0);
  assert.equal(await page.getByRole("button", { name: "Print" }).count(), 0);
  await redo().click();
  assert.equal(await picture(), hole);
});
