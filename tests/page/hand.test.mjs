// Saved output always belongs to the form: with an error in it, nothing can be saved.
import assert from "node:assert/strict";
import { test } from "node:test";
import {
  field,
  focusedId,
  openText,
  PICTURE,
  page,
  panel,
  pixels,
  program,
  put,
  saveButton,
  settles,
  setUp,
  textOf,
} from "./common.mjs";

setUp();

const button = (/** @type {string | RegExp} */ name) =>
  page.getByRole("button", { name, exact: true });

/** The text that describes a button. */
async function reason(
  /** @type {import("playwright-core").Locator} */ locator,
) {
  const id = await locator.getAttribute("aria-describedby");
  assert.ok(id, "the button names its reason");
  const text = page.locator(`#${id}`);
  assert.ok(await text.isVisible(), "the reason is seen");
  return textOf(text);
}

test("HEIDENHAIN chosen after SINUMERIK: the SINUMERIK program was saved, and 'Saved' was said", async () => {
  await field("control.post").selectOption("sinumerik");
  assert.match(await program(), /MEAS=1/);
  await put("control.post", "heidenhain");
  for (const one of [saveButton(), button("Copy")]) {
    assert.ok(await one.isDisabled());
    assert.match(await reason(one), /HEIDENHAIN/i);
  }
  const downloads = [];
  page.on("download", (download) => downloads.push(download));
  await saveButton().click({ force: true });
  await page.keyboard.press("Control+s");
  assert.doesNotMatch(await textOf(page.locator("tp-program .tools")), /Saved/);
  await field("control.post").selectOption("linuxcnc");
  assert.ok(await saveButton().isEnabled());
  // A download that is requested now would follow those requested before.
  const download = page.waitForEvent("download");
  await saveButton().click();
  await download;
  assert.equal(downloads.length, 1);
  assert.equal(await button("Copy").getAttribute("aria-describedby"), null);
});

test("a width in error: the table of the width before was copied and saved", async () => {
  await page.getByRole("tab", { name: "Parameters" }).click();
  await field("cycle.width1").fill("-5");
  for (const name of ["Copy as text", "Save .csv"]) {
    assert.ok(await button(name).isDisabled(), name);
    assert.match(await reason(button(name)), /Width 1/);
  }
  await page.getByRole("button", { name: "More" }).click();
  assert.ok(
    await page
      .locator("#menu")
      .getByRole("button", { name: "Save job" })
      .isEnabled(),
    "the form itself can always be saved",
  );
});

test("results of the form before an error say so", async () => {
  await panel("results", page);
  const caption = page.locator("tp-results caption").first();
  assert.doesNotMatch(await textOf(caption), /last good/);
  await field("cycle.width1").fill("-5");
  assert.match(
    await textOf(caption),
    /The form has errors: showing the last valid plan/,
  );
});

/** Amount shown of a plan: moves of the timeline, lines of the program, cells of the table and of the results. */
async function amount() {
  const counts = [Number(await page.locator("#timeline").getAttribute("max"))];
  for (const [tab, what] of /** @type {const} */ ([
    ["Program", "tp-program .line"],
    ["Parameters", "tp-table td"],
    ["Results", "tp-results td"],
  ])) {
    await page.getByRole("tab", { name: tab }).click();
    counts.push(await page.locator(what).count());
  }
  return counts;
}

test("a job with errors stood beside picture, program and results of the job before it", async () => {
  const give = (/** @type {object} */ job) =>
    page.evaluate((job) => {
      /** @type {any} */ (document.querySelector("touch-path")).job = job;
    }, job);
  const stamp = page.locator(".banner");
  assert.ok((await amount()).every((n) => n > 0));
  // Its path can be drawn, although the control has no program for it.
  await give({
    format: 1,
    plane: "G18",
    cycle: { type: "hole" },
    control: { post: "fanuc" },
  });
  await stamp.filter({ hasText: "No program: The tool length" }).waitFor();
  assert.ok((await pixels()).count > 300);
  assert.equal(await textOf(page.locator(".timeline output")), "");
  assert.deepEqual(await amount(), [0, 0, 0, 0]);
  // Nothing can be drawn.
  await give({ format: 1, cycle: { type: "boss", diameter: -5 } });
  await stamp.filter({ hasText: "No program: Diameter" }).waitFor();
  assert.ok(await page.locator(PICTURE).isHidden());
  assert.deepEqual(await amount(), [0, 0, 0, 0]);
  assert.equal(await page.getByText("last valid plan").count(), 0);
  await field("cycle.diameter").fill("30");
  await stamp.waitFor({ state: "detached" });
  const good = await amount();
  assert.ok(good.every((n) => n > 0));
  // A later error of the same job keeps its last valid plan; another cycle has none.
  await put("stylus.diameter", -1);
  await stamp.filter({ hasText: "last valid plan" }).waitFor();
  assert.deepEqual(
    await amount(),
    [0, ...good.slice(1)],
    "there is no run to step through",
  );
  await field("cycle.type").selectOption("web");
  await stamp.filter({ hasText: "No program: Ball diameter" }).waitFor();
  assert.deepEqual(await amount(), [0, 0, 0, 0]);
  // After a reload the state before the error is unknown.
  await page.reload();
  await stamp.filter({ hasText: "No program: Ball diameter" }).waitFor();
  assert.deepEqual(await amount(), [0, 0, 0, 0]);
  assert.match(
    await textOf(page.locator("tp-results caption").first()),
    /No plan can be made of this form/,
  );
});

test("'Copied' stood beside a program that was not the copied one", async () => {
  await button("Copy").click();
  await page.getByText("Copied").waitFor();
  await field("cycle.width1").fill("81");
  assert.doesNotMatch(
    await textOf(page.locator("tp-program .tools")),
    /Copied/,
  );
});

test("to a group of fields, to the cycle or to a picked touch there was no way", async () => {
  await openText(
    '{"format":1,"cycle":{"type":"boss","touches":[{"point":[20,0,-10],"vector":[1,0,0]},{"point":[0,20,-10],"vector":[0,1,0]},{"point":[-20,0,-10],"vector":[-1,0,0]}]}}',
  );
  await page.setViewportSize({ width: 390, height: 844 });
  await page.getByRole("tab", { name: "Setup" }).waitFor();
  for (const [path, id] of [
    ["cycle.touches[1]", "f-cycle.touches[1].point[0]"],
    ["feeds", "f-feeds.approach"],
    ["cycle", "f-cycle.diameter"],
    ["part", "f-part.offset[0]"],
    ["control.workOffset", "f-control.workOffset"],
  ]) {
    await page.getByRole("tab", { name: "Checks" }).click();
    await page.evaluate(
      (path) =>
        /** @type {any} */ (
          document.querySelector("touch-path")
        ).app.actions.go(path),
      path,
    );
    await settles(async () => (await focusedId()) === id).catch(async () => {
      throw new Error(`${path}: ${await focusedId()}`);
    });
  }
  await page.evaluate(() =>
    /** @type {any} */ (document.querySelector("touch-path")).app.actions.go(
      'there is"no such field',
    ),
  );
  assert.equal(
    await page
      .getByRole("tab", { name: "Checks" })
      .getAttribute("aria-selected"),
    "true",
  );
});

test("a key that no job has could only be got rid of by Reset", async () => {
  await openText(
    '{"format":1,"colour":"red","cycle":{"type":"groove","width":41,"sideClearance":1}}',
  );
  assert.equal(await field("cycle.width").inputValue(), "41");
  const foot = page.locator("tp-findings");
  for (let left = 2; left > 0; left--) {
    await page.locator("tp-findings .verdict.error").waitFor();
    await foot.getByRole("button", { name: "Remove it" }).click();
  }
  await page
    .locator("tp-findings .verdict.error")
    .waitFor({ state: "detached" });
  assert.match(await program(), /G38\.2/);
  await page.keyboard.press("Control+z");
  await page
    .getByText(/keys are .*origin|colour/)
    .first()
    .waitFor();
});

test("a cycle of the control's own had the same reason fourteen times in Checks, and no rule", async () => {
  await field("cycle.type").selectOption("probing-two-circles");
  await field("control.post").selectOption("heidenhain");
  await page.getByRole("tab", { name: "Checks" }).click();
  const checks = await textOf(page.locator("tp-checks"));
  assert.equal(
    checks.split("The native cycle makes every move itself").length,
    2,
  );
  assert.match(checks, /The spindle is off before the first motion/);
});

test("a safety rule shows its lines in the program", async () => {
  await page.getByRole("tab", { name: "Checks" }).click();
  const rule = page.locator("tp-checks .checks li", {
    hasText: "A missed touch ends the program",
  });
  const lines = await page.evaluate(() => {
    const { plan } = /** @type {any} */ (document.querySelector("touch-path"));
    const { moveLines } = plan.program;
    return plan.moves.flatMap(
      (/** @type {any} */ move, /** @type {number} */ i) =>
        move.kind === "touch" ? moveLines[i] : [],
    );
  });
  assert.equal(lines.length, 4);
  // Four lines are counted, fewer are listed.
  await rule.getByRole("button", { name: "4 lines" }).click();
  const marked = page.locator("tp-program .line.match");
  assert.deepEqual(
    await marked.evaluateAll((all) =>
      all.map((line) => Number(/** @type {HTMLElement} */ (line).dataset.line)),
    ),
    lines,
  );
  assert.match(await textOf(page.locator("tp-program .found")), /1 of 4/);
  assert.equal(await focusedId(), "tab-program");
  assert.ok(
    await page.locator(`tp-program [data-line="${lines[0]}"].here`).isVisible(),
  );
  // Enter in the field goes to the next match, and another program has no marks.
  await page
    .getByRole("searchbox", { name: "Find in the program" })
    .press("Enter");
  assert.match(await textOf(page.locator("tp-program .found")), /2 of 4/);
  await field("cycle.width1").fill("81");
  assert.equal(await marked.count(), 0);
  // A line of the folded header is unfolded.
  await page.getByRole("tab", { name: "Checks" }).click();
  await page
    .locator("tp-checks")
    .getByRole("button", { name: /^Line / })
    .first()
    .click();
  assert.ok(await page.locator("tp-program .here").isVisible());
});

test("the safety rules stand in Checks, with what this control cannot hold and what the job asked for", async () => {
  await page.getByRole("tab", { name: "Checks" }).click();
  const checks = page.locator("tp-checks");
  assert.match(
    await textOf(checks.locator(".proof")),
    /27 moves match the path, and the arithmetic is right; 15 safety rules hold; 1 this/,
  );
  assert.equal(await checks.locator(".checks li").count(), 16);
  assert.match(
    await textOf(
      checks.locator(".checks li", {
        hasText: "Every missed touch leads to the same exit",
      }),
    ),
    /G38\.2 itself stops the program with an error at the current position/,
  );
  await field("control.protection").selectOption("none");
  assert.match(await textOf(checks.locator(".proof")), /1 does not/);
  assert.match(
    await textOf(checks.locator(".checks li.warning")),
    /!\s+This move is not watched: a contact in it is not noticed Line \d+/,
  );
  // With an error in the form there is no program.
  await field("cycle.width1").fill("-5");
  assert.equal(await checks.locator(".checks").count(), 0);
  assert.match(await textOf(checks.locator(".found")), /Width 1 must/);
});
