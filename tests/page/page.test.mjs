// The served page in Chromium, as a user works with it.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { AxeBuilder } from "@axe-core/playwright";
import { catalog } from "touchpath";
import {
  boxOf,
  chooseUnits,
  field,
  focusedId,
  held,
  more,
  open,
  openText,
  PICTURE,
  page,
  pixels,
  problems,
  program,
  put,
  ready,
  reset,
  saveButton,
  settles,
  setUp,
  textOf,
  unfold,
  until,
} from "./common.mjs";

setUp();

const selected = () => page.locator("tp-program [aria-selected=true] .text").allTextContents();

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
  await page.getByRole("tab", { name: "Results" }).click();
  assert.match((await page.locator("tp-results tr", { hasText: "width1" }).first().textContent()) ?? "", /90\.000/);
  assert.deepEqual(problems, []);
});

test("a decimal comma is a number and stays as it was typed", async () => {
  await field("cycle.width1").fill("80,5");
  assert.match(await program(), /G38\.2 X42\.25 Y0 Z-10 F150/);
  assert.equal(await field("cycle.width1").inputValue(), "80,5");
});

test("the other cycle, and back without losing the form", async () => {
  await field("cycle.width1").fill("77");
  await field("cycle.type").selectOption("double-wall-internal-corner");
  await field("cycle.count1").fill("3");
  assert.match(await program(), /type 13/);
  assert.equal((await program()).match(/^G38\.2/gm)?.length, 5);
  await field("cycle.type").selectOption("internal-rectangle-protected");
  assert.equal(await field("cycle.width1").inputValue(), "77");
});

test("an error stands beside its field, the last good plan stays and is marked, and what was typed is kept", async () => {
  const good = await program();
  await field("cycle.sideClearance1").fill("2");
  const problem = page.locator(`[id="e-cycle.sideClearance1"]`);
  assert.match((await problem.textContent()) ?? "", /ball radius/);
  assert.equal(await field("cycle.sideClearance1").getAttribute("aria-invalid"), "true");
  assert.equal(await program(), good);
  await page.getByText("last good plan").waitFor();
  await field("cycle.depth").fill("ten");
  assert.match((await page.locator("tp-findings").textContent()) ?? "", /2 errors/);
  await page.reload();
  await ready();
  assert.equal(await field("cycle.depth").inputValue(), "ten");
  assert.equal(await field("cycle.sideClearance1").inputValue(), "2");
  await page.locator("tp-findings").getByRole("button", { name: "All" }).click();
  await page.locator("tp-checks a", { hasText: "Depth" }).click();
  assert.equal(await focusedId(), "f-cycle.depth");
  await field("cycle.depth").fill("10");
  await field("cycle.sideClearance1").fill("8");
  assert.equal(await page.getByText("last good plan").filter({ visible: true }).count(), 0);
});

test("units convert what is shown, not the part", async () => {
  await chooseUnits("inch");
  assert.equal(await field("cycle.width1").inputValue(), "3.149606");
  assert.match(await program(), /G20/);
  assert.match(await program(), /G38\.2 X1\.65354/);
  await chooseUnits("mm");
  assert.equal(await field("cycle.width1").inputValue(), "80");
  assert.match(await program(), /G38\.2 X42 Y0 Z-10 F150/);
});

test("a feed is rapid only by its own box, never by an empty field", async () => {
  await field("feeds.longLink").fill("");
  assert.match((await page.locator(`[id="e-feeds.longLink"]`).textContent()) ?? "", /must be a number/);
  await page.getByLabel("Long link feed: rapid").check();
  assert.match(await program(), /G0 X32 Y0 Z-10\n/);
});

test("pointing at a line, a move or a touch's row lights up the others", async () => {
  const plain = await pixels();
  await page.locator("tp-program .line", { hasText: "G38.2 X42" }).hover();
  assert.deepEqual(await selected(), ["G38.2 X42 Y0 Z-10 F150"]);
  assert.notEqual((await pixels()).sum, plain.sum, "the picture shows it");
  assert.match((await page.locator(".scrub output").textContent()) ?? "", /^touch 1 · contact X37 Y0 Z-10 · F150$/);
  // A click keeps it lit; one beside the lines changes nothing.
  await page.locator("tp-program .line", { hasText: "G38.2 X42" }).click();
  await page.locator("tp-program .step").nth(3).click();
  await page.getByRole("tab", { name: "Program" }).hover();
  assert.deepEqual(await selected(), ["G38.2 X42 Y0 Z-10 F150"]);
  await page.getByRole("listbox", { name: "Program" }).press("Escape");
  await page.getByRole("tab", { name: "Parameters" }).click();
  assert.equal(await page.locator("tp-table tr.lit").count(), 0);
  await page.locator("tp-table tr", { hasText: "CmdPrm.Flt[-112]" }).hover();
  assert.match((await page.locator(".scrub output").textContent()) ?? "", /touch 3/);
  assert.equal(await page.locator("tp-table tr.lit").count(), 12, "six codes used, six original");
  await page.getByRole("tab", { name: "Program" }).click();
  // Touch 1 in the picture: between the centre and the wall on the right, near the wall.
  const box = await boxOf(page.locator(PICTURE));
  /** @type {string[]} */
  let found = [];
  for (let x = box.width * 0.75; x < box.width && !found[0]?.startsWith("G38.2 X42"); x += 4) {
    await page.mouse.move(box.x + x, box.y + box.height / 2);
    found = await selected();
  }
  assert.deepEqual(found, ["G38.2 X42 Y0 Z-10 F150"]);
});

test("copy and save with the control's extension", async () => {
  await field("name").fill("MY POCKET");
  await page.getByRole("button", { name: "Copy" }).click();
  await page.getByText("Copied").waitFor();
  const copied = await page.evaluate(() => navigator.clipboard.readText());
  const download = page.waitForEvent("download");
  await saveButton().click();
  const saved = await download;
  assert.equal(saved.suggestedFilename(), "MY_POCKET.ngc");
  assert.equal(readFileSync(await saved.path(), "utf8"), copied);
  assert.match(copied, /^\(Job: MY POCKET\)\n[\s\S]*\nM2\n$/);
  await field("control.post").selectOption("grbl");
  assert.match(await textOf(saveButton()), /^Save MY_POCKET\.nc$/);
  assert.doesNotMatch(await program(), /#</);
});

test("the parameter table is copied as text and saved as CSV", async () => {
  await page.getByRole("tab", { name: "Parameters" }).click();
  await page.getByRole("button", { name: "Copy as text" }).click();
  await page.getByText("Copied").waitFor();
  assert.match(
    await page.evaluate(() => navigator.clipboard.readText()),
    /^CmdPrm\.Int\[-1\] = 7\n[\s\S]*CmdPrm\.Flt\[-66\] = 0\n$/,
  );
  const download = page.waitForEvent("download");
  await page.getByRole("button", { name: "Save .csv" }).click();
  assert.match(readFileSync(await (await download).path(), "utf8"), /^code,type,value,meaning\n/);
});

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

test("the keyboard alone is enough", async () => {
  const id = focusedId;
  await page.locator("body").press("Tab");
  for (let i = 0; i < 60 && (await id()) !== "f-cycle.width1"; i++) await page.keyboard.press("Tab");
  assert.equal(await id(), "f-cycle.width1");
  await page.keyboard.type("66");
  assert.match(await program(), /G38\.2 X35 Y0 Z-10 F150/, "focus selects, so that typing replaces");
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
  await page.getByRole("button", { name: "fit" }).click();
  await page.mouse.move(box.x + 4, box.y + 4);
  await page.mouse.down();
  await page.mouse.move(box.x + 60, box.y + 40, { steps: 4 });
  await page.mouse.up();
  assert.notEqual((await pixels()).sum, fitted);
});

test("the virtual part: its fields, its handle, its results", async () => {
  await page.getByRole("tab", { name: "Results" }).click();
  await field("part.offset[0]").fill("0.5");
  await field("part.rotation").fill("1");
  const row = page.locator("tp-results tr", { hasText: "width1" }).first();
  // 74·(1/cos 1° − 1) = 0.01127 too wide; a thousandth is shown.
  assert.match((await row.textContent()) ?? "", /80\.011/);
  assert.match((await page.locator("tp-results .notes").textContent()) ?? "", /cosine error/);
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
    (await page.locator("tp-results tr", { hasText: "center.x" }).first().textContent()) ?? "",
    new RegExp(`\\+${shift[0]}`),
  );
});

test("measured points give the same results, and bad ones a plain answer", async () => {
  await page.getByRole("tab", { name: "Results" }).click();
  await page.getByText("Points that a machine measured").click();
  const box = page.locator("#measured");
  await box.fill("37.1,0,-10\n-36.9,0,-10\n0,22,-10\n0,-22,-10");
  const own = (/** @type {string} */ code) =>
    page.locator("tp-results table").first().locator("tr", { hasText: code }).locator(".own").textContent();
  const before = await pixels();
  assert.match((await own("center.x")) ?? "", /^0\.100 \+0\.100$/);
  assert.match((await own("width1")) ?? "", /^80\.000 0\.000$/);
  const { sum } = await pixels();
  await box.fill("37.1,0,-10\n-36.9,0,-10\n0,22,-10\n0,-21,-10");
  assert.notEqual((await pixels()).sum, sum, "the points are in the picture");
  assert.ok(before.count > 0);
  const wide = await page.locator("#panel-results").evaluate((panel) => panel.scrollWidth - panel.clientWidth);
  assert.equal(wide, 0, "nothing of the table is cut off");
  await box.fill("37.1,0\n");
  assert.match((await page.locator(".measured").textContent()) ?? "", /Line 1 holds 2 numbers/);
  await page.getByRole("button", { name: "Fill in the points shown" }).click();
  assert.match((await own("width1")) ?? "", /80\.000/);
});

test("lines that belong to a move stood above the heading of its step", async () => {
  for (const [post, names] of [
    ["sinumerik", /TP_MOVE=\d+$/],
    ["fanuc", /#149=\d+$/],
    ["linuxcnc", /G38\.|G1 /],
  ]) {
    await openText(JSON.stringify({ format: 1, cycle: { type: "internal-rectangle-protected" }, control: { post } }));
    await until("control.post", String(post));
    const first = await page
      .locator("tp-program .step + .line .text")
      .evaluateAll((rows) => rows.slice(1).map((row) => row.textContent));
    assert.ok(first.length > 8, String(post));
    for (const text of first) assert.match(text ?? "", /** @type {RegExp} */ (names), String(post));
  }
});

test("words are found in the program, in its folded header too, and stay found while it changes", async () => {
  const find = page.getByLabel("Find in the program");
  const here = () => page.locator("tp-program .line.here").textContent();
  const said = () => page.locator("tp-program .told.found").textContent();
  await find.fill("g38.2");
  assert.equal(await page.locator("tp-program .line.match").count(), 4);
  assert.equal(await said(), "1 of 4");
  const first = await here();
  await find.press("Enter");
  assert.equal(await said(), "2 of 4");
  await find.press("Shift+Enter");
  assert.equal(await here(), first);
  await find.press("Shift+Enter");
  assert.equal(await said(), "4 of 4");
  await field("cycle.width1").fill("70");
  assert.equal(await page.locator("tp-program .line.match").count(), 4);
  await find.fill("Job: POCKET-70X50");
  await page.locator("tp-program .line.here", { hasText: "Job: POCKET-70X50" }).waitFor({ state: "visible" });
  await find.fill("no such words");
  assert.equal(await said(), "not found");
  await find.fill("");
  assert.deepEqual([await said(), await page.locator("tp-program .line.match").count()], ["", 0]);
});

test("all moves in words, as many as the plan has, each with its place", async () => {
  await page.getByRole("tab", { name: "Results" }).click();
  await page.getByText("All moves in words").click();
  const words = page.locator("tp-results .moves li");
  const { defaultJob, plan } = await import("touchpath");
  const { moves } = plan(defaultJob("internal-rectangle-protected"));
  assert.equal(await words.count(), moves.length);
  const first = moves.findIndex((m) => m.kind === "touch");
  const [x, y, z] = moves[first]?.to ?? [];
  assert.equal(await words.nth(first).textContent(), `step ${moves[first]?.step}, touch 1, work, to X${x} Y${y} Z${z}`);
  await field("cycle.depth").fill("12.5");
  assert.match((await words.nth(first).textContent()) ?? "", /Z-12\.5$/, "the list is of the form");
});

test("this job on every control: what each makes of it, and the way there", async () => {
  await page.getByRole("tab", { name: "Checks" }).click();
  await page.getByText("This job on every control").click();
  const rows = page.locator("tp-checks .controls tbody tr:not(.why)");
  const { catalog, defaultJob, programs } = await import("touchpath");
  const job = /** @type {any} */ (defaultJob("internal-rectangle-protected"));
  const wanted = catalog().posts.flatMap((post) =>
    ["moves", "cycle"]
      .filter(
        (form) =>
          form === "moves" || post.cycles.some((c) => c.type === job.cycle.type && c.form === form && c.supported),
      )
      .map((form) => {
        const [made] = programs([{ ...job, control: { ...job.control, post: post.id, form } }]);
        return [
          post.title,
          form === "moves" ? "moves" : "own cycle",
          made?.program ? String(made.program.text.split("\n").length - 1) : "–",
        ];
      }),
  );
  const shown = await rows.evaluateAll((all) =>
    all.map((row) => [...row.children].slice(0, 3).map((cell) => cell.textContent?.trim())),
  );
  assert.deepEqual(shown, wanted);
  await rows.getByRole("button", { name: "Choose SINUMERIK 840D sl / 828D, own cycle" }).click();
  assert.deepEqual([await held("control.post"), await held("control.form")], ["sinumerik", "cycle"]);
  await page.getByRole("button", { name: "Undo" }).click();
  assert.equal(await held("control.post"), "linuxcnc");
});

test("two circles: tolerances, verdicts, handles, Klartext out and in", async () => {
  await field("cycle.type").selectOption("probing-two-circles");
  await field("control.post").selectOption("heidenhain");
  assert.match(await program(), /^0 BEGIN PGM CIRCLES-D20 MM\n[\s\S]*\n\d+ TCH PROBE 1411 PROBING TWO CIRCLES ~\n/);
  await field("cycle.diameter1").fill("20H7");
  assert.match(await program(), /QS1116="20H7" ;DIAMETER 1 ~/);
  await field("part.sizes.diameter1").fill("0.05");
  await page.getByRole("tab", { name: "Results" }).click();
  const status = page.locator("tp-results tr", { hasText: "Q183" }).first();
  assert.match((await status.textContent()) ?? "", /2.*scrap: the program continues/);
  await page.getByRole("tab", { name: "Program" }).click();
  await field("cycle.diameter1").fill("20H99");
  assert.match((await page.locator(`[id="e-cycle.diameter1"]`).textContent()) ?? "", /ISO 286 has no H99/);
  await field("cycle.diameter1").fill("20H7");
  // The handle of the first touch stands to the right of circle 1; dragged up, the start angle becomes 90°.
  const box = await boxOf(page.locator(PICTURE));
  let from = null;
  const cursor = () => page.locator(PICTURE).evaluate((c) => c.style.cursor);
  for (let x = 0; x < box.width / 2 && !from; x += 4) {
    await page.mouse.move(box.x + x, box.y + box.height / 2);
    if ((await cursor()) === "grab") from = { x: box.x + x + 4, y: box.y + box.height / 2 };
  }
  assert.ok(from, "a handle is found");
  await page.mouse.move(from.x, from.y);
  await page.mouse.down();
  await page.mouse.move(from.x - 60, from.y - 90, { steps: 5 });
  await page.mouse.up();
  const angle = Number(await field("cycle.startingAngle").inputValue());
  const length = Number(await field("cycle.angularLength").inputValue());
  assert.ok(angle !== 0 || length !== 360, "the form follows the handle");
  // Extrusion in and out.
  await unfold();
  await page.locator("#group-Extrusion-probing-1493-").getByLabel("Use it").check();
  await field("cycle.extrusion.points").fill("3");
  assert.match(await program(), /\n\d+ TCH PROBE 1493 EXTRUSION PROBING ~\n {4}Q1140=\+3 /);
  const download = page.waitForEvent("download");
  await saveButton().click();
  const path = await (await download).path();
  const text = readFileSync(path, "utf8");
  await reset();
  assert.doesNotMatch(await program(), /1493/);
  await page.locator("#file").setInputFiles({ name: "A.H", mimeType: "text/plain", buffer: Buffer.from(text) });
  await until("cycle.diameter1", "20H7");
  assert.equal(`${await program()}\n`, text, "what was saved comes back byte for byte");
  assert.match((await page.locator(".note").textContent()) ?? "", /does not contain the part's position/);
  assert.deepEqual(problems, []);
});

test("tool lengths: the manual's examples, a frame by steps, what the control is asked", async () => {
  await more("Tool lengths");
  const answer = page.locator("tp-lentoax .answer");
  const axind = async () =>
    (await answer.locator("tbody td:nth-child(2)").allTextContents()).map((t) => t.trim()).join(" ");
  await answer.locator("tbody td").first().waitFor();
  assert.equal(await axind(), "3 2 1");
  const said = async () => textOf(page.locator("tp-lentoax [role=status]").first());
  assert.match(await said(), /L1 acts along \+Z, L2 acts along \+Y, L3 acts along \+X/);
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
  await page.locator("#l-group").selectOption({ label: "Turning tools (500 to 599)" });
  await page.locator("#l-42900").uncheck();
  await page.locator("#l-coord").selectOption("BCS");
  assert.equal(await axind(), "2 1 3");
  await page.getByRole("button", { name: "Copy" }).click();
  await page.getByText("Copied").waitFor();
  assert.match(await page.evaluate(() => navigator.clipboard.readText()), /_STAT=LENTOAX\(_AXIND,_MATRIX,"BCS"\)/);
  const { violations } = await new AxeBuilder({ page }).analyze();
  assert.deepEqual(
    violations.filter((v) => v.impact === "serious" || v.impact === "critical").map((v) => v.id),
    [],
  );
  await page.getByRole("button", { name: "Back to the job" }).click();
  assert.match(await program(), /G38\.2/);
  assert.deepEqual(problems, []);
});

test("the gallery: small pictures, search by name or number, a cycle chosen", async () => {
  await page.getByRole("button", { name: "Gallery" }).click();
  const cards = page.locator("tp-gallery li:visible");
  await cards.first().waitFor();
  assert.equal(await cards.count(), 18);
  const drawn = await page.locator("tp-gallery canvas").evaluateAll((all) =>
    all.map((node) => {
      const canvas = /** @type {HTMLCanvasElement} */ (node);
      const drawing = /** @type {CanvasRenderingContext2D} */ (canvas.getContext("2d"));
      const data = new Uint32Array(drawing.getImageData(0, 0, canvas.width, canvas.height).data.buffer);
      return data.filter((pixel) => pixel !== data[0]).length;
    }),
  );
  assert.equal(drawn.length, 16, "two types have no motion");
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
  assert.deepEqual(await cards.locator("b").allTextContents(), ["Triple wall external corner"]);
  await cards.first().getByRole("button").click();
  assert.equal(await field("cycle.type").inputValue(), "triple-wall-external-corner");
  assert.match(await program(), /type 16: Triple wall external corner/);
  assert.deepEqual(problems, []);
});

test("every cycle has a plan on the page, and its steps light up with the move", async () => {
  for (const { type, steps } of catalog().cycles) {
    await field("cycle.type").selectOption(type);
    assert.equal(await page.locator("tp-findings .error").count(), 0, type);
    if (steps.length === 0) continue;
    const heads = await page.locator("tp-program .step span").allTextContents();
    assert.ok(heads.length > 1 && heads.every((text) => steps.includes(text)), type);
    const moves = Number(await page.locator("#scrub").getAttribute("max"));
    for (const move of [1, moves]) {
      await page.locator("#scrub").fill(String(move));
      const said = (await page.locator("#scrub").getAttribute("aria-valuetext")) ?? "";
      const step = Number(/step (\d+)/.exec(said)?.[1]);
      const lit = await page.locator("tp-program .step.lit span").allTextContents();
      assert.ok(lit.length > 0 && lit.every((text) => text === steps[step - 1]), `${type}: ${lit} at ${said}`);
      // The line that is lit stands under a heading of that step.
      const over = await page.locator("tp-program [aria-selected=true]").locator("..").getAttribute("aria-label");
      assert.equal(over, `Step ${step}: ${steps[step - 1]}`, type);
    }
  }
  assert.deepEqual(problems, []);
});

test("the table: groups that fold, a filter", async () => {
  await page.getByRole("tab", { name: "Parameters" }).click();
  const rows = page.locator("tp-table tbody tr:not(.group)");
  assert.deepEqual(
    (await page.locator("tp-table tr.group button").allTextContents()).map((t) => t.replace(/\s+/g, " ").trim()),
    ["▾ System 2", "▾ Dimensions 8", "▾ Touches 24", "▾ Original touches 24"],
  );
  assert.equal(await rows.count(), 58);
  await page.getByRole("button", { name: /^▾ Touches/ }).click();
  assert.equal(await rows.count(), 34);
  assert.equal(
    await page
      .getByRole("button", { name: /Touches 24/ })
      .first()
      .getAttribute("aria-expanded"),
    "false",
  );
  const filter = page.getByLabel("Filter the parameters");
  await filter.fill("clearance");
  assert.equal(await rows.count(), 3);
  await filter.fill("[-118]");
  assert.match((await rows.textContent()) ?? "", /Fourth: touch point, X/);
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
  assert.match((await page.locator(".note").textContent()) ?? "", /This text gives no job/);
  assert.equal(await page.locator("#paste").inputValue(), "no job at all");
  await page.locator("#paste").fill(dump.replaceAll(".Flt[", ". Flt [").replaceAll("52.5", "52,5"));
  await page.getByRole("button", { name: "Read it" }).click();
  assert.equal(await field("cycle.diameter").inputValue(), "52.5");
  assert.equal(await field("cycle.origin[0]").inputValue(), "12");
  assert.match((await page.locator(".note").textContent()) ?? "", /does not give feeds.*does not give the stylus/s);
  assert.equal(await page.locator("#paste").count(), 0);
  assert.deepEqual(problems, []);
});

/** A program without the comments that say its job. */
const blocks = (/** @type {string} */ text) => text.replace(/^\(job .*\n/gm, "");

test("touches are picked one by one and taken back", async () => {
  await page.getByRole("button", { name: "Pick touches one by one" }).click();
  const before = await program();
  await page.getByLabel("Point of touch 1, X").fill("45");
  assert.match(await program(), /G38\.2 X47 Y0 Z-10 F150/);
  assert.match((await page.locator(`[id="e-cycle.width1"]`).textContent()) ?? "", /85 mm between the picked touches/);
  await page.getByLabel("Vector of touch 1, X").fill("1");
  assert.match((await page.locator(".picks").textContent()) ?? "", /must be opposite|points the wrong way/);
  await page.getByRole("button", { name: "Back to the dimensions" }).click();
  assert.equal(blocks(await program()), blocks(before));
  assert.deepEqual(problems, []);
});

test("SINUMERIK: the probe's length decides, the program comes back", async () => {
  await field("control.post").selectOption("sinumerik");
  await field("control.workOffset").selectOption({ label: "writes G505" });
  assert.match(await program(), /MEAS=1 G1 X42 Y0 Z-10 F150\nSTOPRE\nIF \$AC_MEA\[1\]==0 GOTOF TP_MISSED/);
  assert.match(await program(), /\$P_UIFR\[5,X,TR\]=/);
  await field("tool.type").fill("500");
  assert.match((await page.locator("tp-findings").textContent()) ?? "", /L1 acts along \+Y/);
  await field("tool.type").fill("710");
  await more("Tool lengths");
  await page.getByRole("button", { name: "Add ROT" }).click();
  await page.getByLabel("Step 1: angle").fill("60");
  await page.getByRole("button", { name: "Apply to the job" }).click();
  assert.match((await page.locator("tp-form").textContent()) ?? "", /Frame: ROT Z60/);
  assert.equal(await page.locator("tp-findings .error").count(), 0, "a turn about the tool axis leaves L1 where it is");
  const text = await program();
  await reset();
  await more("Paste");
  await page.locator("#paste").fill(text);
  await page.getByRole("button", { name: "Read it" }).click();
  assert.equal(await program(), text, "what was written comes back byte for byte");
  assert.deepEqual(problems, []);
});

test("a file that is nothing is refused and the form stays", async () => {
  await field("cycle.width1").fill("71");
  await page.locator("#file").setInputFiles({ name: "x.txt", mimeType: "text/plain", buffer: Buffer.from("G1 X0") });
  assert.match((await page.locator(".note").textContent()) ?? "", /This text gives no job/);
  assert.equal(await field("cycle.width1").inputValue(), "71");
});

for (const colorScheme of /** @type {const} */ (["light", "dark"])) {
  for (const [width, height] of /** @type {const} */ ([
    [1280, 800],
    [390, 844],
  ])) {
    test(`no serious accessibility problem at ${width} px, ${colorScheme}, also with errors`, async () => {
      await open({ viewport: { width, height }, colorScheme });
      const violations = async () => {
        // The page has no frames, which the other mode asks for one by one: it takes five times as long.
        const axe = new AxeBuilder({ page }).setLegacyMode().options({ resultTypes: ["violations"] });
        const { violations } = await axe.analyze();
        return violations
          .filter((v) => v.impact === "serious" || v.impact === "critical")
          .map((v) => `${v.id}: ${v.nodes.map((n) => n.html.slice(0, 120)).join(" | ")}`);
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
        for (const name of ["Program", "Parameters", "Results", "Checks", "Setup"]) {
          await page.getByRole("tab", { name }).click();
          assert.deepEqual(await violations(), []);
        }
      }
      await page.getByRole("button", { name: "More" }).click();
      assert.deepEqual(await violations(), []);
      await page.locator("#menu").getByRole("button", { name: "Setup sheet" }).click();
      assert.deepEqual(await violations(), []);
      await page.getByRole("button", { name: "Back to the job" }).click();
      await page.evaluate(() => /** @type {any} */ (document.querySelector("touch-path")).app.ask("gallery"));
      assert.deepEqual(await violations(), []);
      const over = await page.evaluate(
        () => document.documentElement.scrollWidth - document.documentElement.clientWidth,
      );
      assert.equal(over, 0, "nothing sticks out to the side");
      assert.deepEqual(problems, []);
    });
  }
}

test("a value with a tolerance has a bar: where it lies between its limits, and by how much it may scatter", async () => {
  await field("cycle.type").selectOption("probing-two-circles");
  await put("cycle.diameter1", "20+0.05-0.05");
  await page.getByRole("tab", { name: "Results" }).click();
  const bar = page.locator("tp-results .band");
  assert.equal(await bar.count(), 1);
  assert.equal(await bar.getAttribute("aria-label"), "20.000, limits 19.950 and 20.050: good");
  assert.equal(Number(await bar.locator("circle").getAttribute("cx")), 50, "the nominal size is in the middle");
  const spread = async () =>
    Number(await bar.locator("line").getAttribute("x2")) - Number(await bar.locator("line").getAttribute("x1"));
  const before = await spread();
  assert.ok(before > 0);
  await put("stylus.repeatability", 0.002);
  assert.ok(Math.abs((await spread()) - 2 * before) < 0.1);
  // Too small: left of what is good, and said to be so.
  await put("part", { offset: [0, 0, 0], rotation: 0, sizes: { diameter1: -0.08 } });
  // 0.03 below the limit, where 0.1 are 50 wide.
  assert.ok(Math.abs(Number(await bar.locator("circle").getAttribute("cx")) - (25 - 15)) < 0.5);
  assert.match((await bar.getAttribute("class")) ?? "", /bad/);
  assert.equal(await bar.getAttribute("aria-label"), "19.920, limits 19.950 and 20.050: rework");
});

test("the words of a program have colours, those of the program that is shown", async () => {
  const coloured = (/** @type {string} */ kind) =>
    page.evaluate((kind) => {
      const ranges = /** @type {StaticRange[]} */ ([
        .../** @type {any} */ (CSS.highlights.get(`touchpath-${kind}`) ?? []),
      ]);
      return ranges.map((range) => (range.startContainer.nodeValue ?? "").slice(range.startOffset, range.endOffset));
    }, kind);
  await settles(async () => (await coloured("code")).includes("G38.3"));
  assert.ok((await coloured("variable")).includes("#5070"));
  // Of the lines in sight only: those of the folded header and of the end come when they are seen.
  const all = await coloured("comment");
  assert.ok(!all.some((text) => text === "(Job: POCKET-80X50)") && !(await coloured("code")).includes("M2"));
  await page.locator("tp-program .line").last().scrollIntoViewIfNeeded();
  await settles(async () => (await coloured("code")).includes("M2"));
  await page.getByRole("button", { name: /header/ }).click();
  await page.locator("tp-program .line").first().scrollIntoViewIfNeeded();
  await settles(async () => (await coloured("comment")).includes("(Job: POCKET-80X50)"));
  await page.getByRole("button", { name: /header/ }).click();
  // Those of another program take their place: nothing of the first is left.
  await field("control.post").selectOption("sinumerik");
  await settles(async () => (await coloured("code")).includes("STOPRE"));
  assert.ok(!(await coloured("code")).includes("G38.3") && !(await coloured("variable")).includes("#5070"));
  // Where the list comes to rest other lines may be in sight.
  await page.waitForTimeout(300);
  const count = (await coloured("code")).length;
  await field("cycle.depth").fill("11");
  await settles(async () => (await program()).includes("Z-11"));
  await page.waitForTimeout(300);
  assert.equal((await coloured("code")).length, count, "typing leaves none behind");
});

test("a program is compared with the one saved last and with that for another control", async () => {
  const choice = page.getByLabel("Compare the program");
  const shown = page.locator("tp-program .differences .line");
  const texts = async (/** @type {string} */ kind) =>
    page.locator(`tp-program .differences .${kind} .text`).allTextContents();
  assert.ok(await choice.locator("option[value=saved]").isDisabled(), "nothing was saved yet");
  const listed = () => page.locator("tp-program .code[role=listbox] .text").allTextContents();
  const before = await listed();
  const saved = page.waitForEvent("download");
  await saveButton().click();
  await saved;
  await choice.selectOption("saved");
  await shown.first().waitFor();
  assert.deepEqual([await texts("more"), await texts("less")], [[], []]);
  await field("cycle.width1").fill("82");
  await settles(async () => (await texts("more")).length > 0);
  const now = await listed();
  const [more, less] = [await texts("more"), await texts("less")];
  assert.ok(less.some((text) => /X42 /.test(text)) && more.some((text) => /X43 /.test(text)), `${less} ${more}`);
  // Without the lines of the other, each program is whole.
  const all = await page
    .locator("tp-program .differences .line")
    .evaluateAll((lines) => lines.map((line) => [line.className, line.querySelector(".text")?.textContent ?? ""]));
  const without = (/** @type {string} */ kind) => all.filter(([name]) => !name?.includes(kind)).map(([, text]) => text);
  assert.deepEqual(without("less"), now);
  assert.deepEqual(without("more"), before);
  assert.match(
    await textOf(page.locator("tp-program .compared [role=status]")),
    /^\d+ lines only here, \d+ lines only there$/,
  );
  // Another control: its own words are there.
  await choice.selectOption("grbl");
  await settles(async () => (await texts("less")).some((text) => /G38\.2/.test(text)));
  // The job for that control itself: nothing is left to compare with, and the program is there.
  await field("control.post").selectOption("grbl");
  await page.locator("tp-program .code[role=listbox]").waitFor();
  assert.equal(await shown.count(), 0);
  await field("control.post").selectOption("linuxcnc");
  assert.equal(await choice.inputValue(), "", "the list says that nothing is compared");
  await choice.selectOption("grbl");
  await shown.first().waitFor();
  // Side by side: each column is its whole program, and lines that replace others stand beside them.
  await page.getByRole("button", { name: "Side by side" }).click();
  const rows = page.locator("dialog.beside tbody tr");
  const column = async (/** @type {number} */ n) =>
    (await rows.locator(`td:nth-child(${n}):not(.none)`).allTextContents()).join("\n");
  assert.equal(
    `${await column(4)}\n`,
    await page.evaluate(() => /** @type {any} */ (document.querySelector("touch-path")).plan.program.text),
  );
  const { plan } = await import("touchpath");
  const other = await page.evaluate(() => /** @type {any} */ (document.querySelector("touch-path")).job);
  other.control.post = "grbl";
  assert.equal(`${await column(2)}\n`, plan(other).program.text);
  assert.ok((await rows.locator("td.less + td + td.more").count()) > 10);
  await page.keyboard.press("Escape");
  await settles(async () => (await rows.count()) === 0);
  // Another control from outside closes it.
  await page.getByRole("button", { name: "Side by side" }).click();
  await rows.first().waitFor();
  await page.evaluate(() => Object.assign(document.querySelector("touch-path") ?? {}, { post: "grbl" }));
  await settles(async () => (await rows.count()) === 0 && (await choice.inputValue()) === "");
  await page.evaluate(() => Object.assign(document.querySelector("touch-path") ?? {}, { post: "linuxcnc" }));
  await choice.selectOption("grbl");
  // Back to the program.
  await choice.selectOption("");
  await page.locator("tp-program .code[role=listbox]").waitFor();
  assert.equal(await shown.count(), 0);
  assert.deepEqual(await listed(), now);
});
