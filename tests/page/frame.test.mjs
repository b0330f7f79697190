// The frame around form, picture and panels: one sentence, undo over everything, links, names, what is typed, the timeline.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import {
  boxOf,
  chooseUnits,
  context,
  field,
  held,
  more,
  open,
  openText,
  PICTURE,
  page,
  painted,
  pixels,
  program,
  put,
  ready,
  reset,
  saveButton,
  setUp,
  textOf,
  unfold,
  until,
} from "./common.mjs";

setUp({ width: 1440, height: 900 });

const undo = () => page.getByRole("button", { name: "Undo" });
const redo = () => page.getByRole("button", { name: "Redo" });
const job = () => held("cycle");

test("type 7 fits 1440 × 900 without a scroll bar, and nothing moves while one types", async () => {
  await page.reload();
  await page.locator(`tp-picture ${PICTURE}`).waitFor();
  const over = await page.evaluate(() => {
    const root = /** @type {ShadowRoot} */ (document.querySelector("touch-path")?.shadowRoot);
    const form = /** @type {Element} */ (root.querySelector("tp-form"));
    return [form.scrollHeight - form.clientHeight, (document.scrollingElement?.scrollHeight ?? 0) - innerHeight];
  });
  assert.ok(
    over.every((pixels) => pixels <= 0),
    `${over}`,
  );
  const places = async () =>
    Promise.all(
      ["[id='f-cycle.width2']", `tp-picture ${PICTURE}`, "tp-program .code", "footer", "tp-help"].map((name) =>
        boxOf(page.locator(name)),
      ),
    );
  await field("cycle.width1").focus();
  const before = await places();
  for (const text of ["8", "x", "-5", "2000000", "81"]) {
    await field("cycle.width1").fill(text);
    assert.deepEqual(await places(), before, text);
  }
});

test("Ctrl+Z did nothing for selects, drags, files and Reset: every step is taken back, and comes again", async () => {
  assert.ok((await undo().isDisabled()) && (await redo().isDisabled()), "nothing to take back at first");
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
    page.evaluate(() => structuredClone(/** @type {any} */ (document.querySelector("touch-path")).store.draft));
  const states = [await whole()];
  for (const [, step] of steps) {
    await step();
    states.push(await whole());
  }
  for (let i = steps.length - 1; i >= 0; i--) {
    await undo().click();
    assert.deepEqual(await whole(), states[i], `${steps[i]?.[0]} is taken back`);
  }
  assert.ok(await undo().isDisabled());
  assert.match(await program(), /G38\.2 X42 Y0 Z-10 F150/, "the program is that of the first job");
  for (let i = 1; i < states.length; i++) {
    await redo().click();
    assert.deepEqual(await whole(), states[i], `${steps[i - 1]?.[0]} comes again`);
  }
  assert.ok(await redo().isDisabled());
});

test("after undo and redo every choice showed what was picked last, not what the job holds", async () => {
  const shown = async () => [
    await field("control.post").inputValue(),
    await field("units").inputValue(),
    await field("cycle.type").inputValue(),
  ];
  const holds = async () => [await held("control.post"), await held("units"), await held("cycle.type")];
  for (const post of ["grbl", "sinumerik", "linuxcnc"]) await field("control.post").selectOption(post);
  for (const units of ["inch", "mm"]) await chooseUnits(units);
  for (const cycle of ["boss", "hole"]) await field("cycle.type").selectOption(cycle);
  for (const button of [undo(), redo()]) {
    for (let i = 0; i < 7; i++) {
      await button.click();
      assert.deepEqual(await shown(), await holds(), `step ${i + 1}`);
    }
  }
});

test("undo took measured points away that were entered after the step: they are a step of their own", async () => {
  await field("cycle.width1").fill("81");
  await page.getByRole("tab", { name: "Results" }).click();
  await page.getByText("Points that a machine measured").click();
  const box = page.locator("#measured");
  await box.fill("37.1,0,-10");
  await undo().click();
  assert.deepEqual([await box.inputValue(), await held("cycle.width1")], ["", 81]);
  await redo().click();
  assert.equal(await box.inputValue(), "37.1,0,-10");
  await undo().click();
  await undo().click();
  assert.equal(await held("cycle.width1"), 80);
});

test("a field of an optional form showed what was typed into it before it was left out", async () => {
  await field("cycle.type").selectOption("probing-two-circles");
  const use = page.locator("#group-Extrusion-probing-1493-").getByLabel("Use it");
  await use.check();
  await field("cycle.extrusion.length").fill("7");
  await use.uncheck();
  await use.check();
  assert.equal(await field("cycle.extrusion.length").inputValue(), String(await held("cycle.extrusion.length")));
});

test("Ctrl+Z in a field that is not the job's, or in another tool, leaves the job alone", async () => {
  await field("cycle.width1").fill("81");
  await page.getByRole("tab", { name: "Parameters" }).click();
  await page.getByLabel("Filter the parameters").press("Control+z");
  await more("Tool lengths");
  await page.locator("#l-type").press("Control+z");
  await page.locator("tp-lentoax").getByRole("button").first().press("Control+z");
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
  assert.deepEqual([await held("cycle.width1"), await held("cycle.width2")], [123, 45]);
  await page.keyboard.press("Control+z");
  assert.deepEqual([await held("cycle.width1"), await held("cycle.width2")], [123, 50]);
  await page.keyboard.press("Control+z");
  assert.deepEqual([await held("cycle.width1"), await held("cycle.width2")], [80, 50]);
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
          new KeyboardEvent("keydown", { key, code, ctrlKey: true, bubbles: true, composed: true, cancelable: true }),
        ),
      [key, code],
    );
  await press("я", "KeyZ");
  assert.equal(await width.inputValue(), before);
  // н stands on Y, which does again what was undone; on a German keyboard z is typed there, and undoes.
  await press("н", "KeyY");
  assert.equal(await width.inputValue(), "66");
  await press("z", "KeyY");
  assert.equal(await width.inputValue(), before);
  // A Dvorak keyboard has its semicolon there: that is no shortcut.
  await press(";", "KeyZ");
  await press("Dead", "KeyY");
  assert.equal(await width.inputValue(), before);
});

test("Reset asked nothing: it asks, and keeps everything where one thinks better of it", async () => {
  await field("cycle.width1").fill("71");
  await more("Reset");
  const dialog = page.getByRole("dialog");
  assert.match(await textOf(dialog), /Internal rectangle, protected.*Undo brings back/s);
  await dialog.getByRole("button", { name: "Keep" }).click();
  assert.equal(await field("cycle.width1").inputValue(), "71");
  await more("Reset");
  await page.keyboard.press("Escape");
  assert.equal(await field("cycle.width1").inputValue(), "71");
});

for (const [text, value, shown] of /** @type {[string, number | string, string][]} */ ([
  ["80/2+0.5", 40.5, "40.5"],
  ["0,1+0,2", 0.3, "0.3"],
  ["2*(3+4)-(−1)", 15, "15"],
  ["1 1/2", 1.5, "1.5"],
  ["80 mm", 80, "80"],
  ["3.15 in", 80.01, "80.01"],
  ['2"', 50.8, "50.8"],
  ["1e2", 100, "100"],
  ["80,5", 80.5, "80.5"],
  ["80/0", "80/0", "80/0"],
  ["80 kg", "80 kg", "80 kg"],
  ["1.234,5", "1.234,5", "1.234,5"],
  ["((((((80", "((((((80", "((((((80"],
  ["alert(1)", "alert(1)", "alert(1)"],
  ["1-1/2", "1-1/2", "1-1/2"],
  ["1-1/2 in", "1-1/2 in", "1-1/2 in"],
  ["1,000", "1,000", "1,000"],
  ["12,345", 12.345, "12.345"],
  ["--5", "--5", "--5"],
  ["1.2.3", "1.2.3", "1.2.3"],
  ["5 5", "5 5", "5 5"],
  ["2(3)", "2(3)", "2(3)"],
  ["3-", "3-", "3-"],
  ["10 in mm", "10 in mm", "10 in mm"],
  ["e5", "e5", "e5"],
])) {
  test(`typed as a width, accepted by Enter: ${text}`, async () => {
    await field("cycle.width1").fill(text);
    await page.keyboard.press("Enter");
    assert.equal(await held("cycle.width1"), value);
    assert.equal(await field("cycle.width1").inputValue(), shown);
  });
}

test("a true minus and a tolerance: the first is a number, the second is no sum", async () => {
  await field("cycle.origin[0]").fill("−40");
  assert.equal(await held("cycle.origin[0]"), -40);
  await field("cycle.type").selectOption("probing-two-circles");
  await unfold();
  await field("cycle.diameter1").fill("20+0.05-0.02");
  await page.keyboard.press("Enter");
  assert.equal(await held("cycle.diameter1"), "20+0.05-0.02");
});

test("arrow keys step, Escape puts back, Enter moves to the next field", async () => {
  const box = field("cycle.width1");
  await box.focus();
  await page.keyboard.press("ArrowUp");
  await page.keyboard.press("ArrowUp");
  await page.keyboard.press("Shift+ArrowDown");
  assert.equal(await box.inputValue(), "81.9");
  assert.match(await program(), /G38\.2 X42\.95 /);
  await page.keyboard.press("Escape");
  assert.equal(await box.inputValue(), "80");
  await page.keyboard.press("Enter");
  await page.keyboard.type("60");
  assert.equal(await field("cycle.width2").inputValue(), "60");
});

test("a touch at F3000 and a part turned by 20° are seen without opening anything", async () => {
  await page.reload();
  await page.locator(`tp-picture ${PICTURE}`).waitFor();
  await put("feeds.work", 3000);
  await put("part.rotation", 20);
  assert.ok(await page.locator("tp-findings .verdict.warning").isVisible());
  assert.ok(await page.locator(".trial", { hasText: "turned 20°" }).isVisible());
  const folded = (/** @type {string} */ name) => page.locator("tp-form .fold", { hasText: name });
  assert.match((await folded("Feeds").getAttribute("class")) ?? "", /warning/);
  assert.match((await folded("Virtual part").getAttribute("class")) ?? "", /warning/);
  assert.match(await textOf(folded("Virtual part")), /turned 20°/);
  assert.match(await textOf(folded("Feeds")), /3000/);
});

test("the box at the foot says what the field in focus is, puts its default back, and says what is wrong", async () => {
  const help = page.locator("tp-help");
  const { height } = await boxOf(help);
  await field("cycle.width1").fill("81");
  assert.match(await textOf(help), /Width 1\s+CmdPrm\.Flt\[-53\].*From touch point 1 to touch point 2.*Default 80/s);
  await help.getByRole("button", { name: /back to its default/ }).click();
  assert.equal(await field("cycle.width1").inputValue(), "80");
  await field("cycle.sideClearance1").fill("2");
  assert.match(await textOf(help), /ball radius/);
  assert.equal((await boxOf(help)).height, height);
});

test("a control that does not take this cycle cannot be chosen, and says why", async () => {
  const options = await field("control.post")
    .locator("option:disabled")
    .evaluateAll((all) =>
      all.map((o) => [/** @type {HTMLOptionElement} */ (o).value, /** @type {HTMLElement} */ (o).title]),
    );
  assert.deepEqual(
    options.map(([id]) => id),
    ["heidenhain"],
  );
  assert.ok((options[0]?.[1] ?? "").length > 20);
});

test("the bar reads as the job's sentence: what is written, under which name", async () => {
  // Before, what was to be seen of it was "measures only, writes …".
  assert.equal(await textOf(field("control.workOffset").locator("option:checked")), "measures only");
  await field("control.workOffset").selectOption("1");
  assert.equal(await textOf(field("control.workOffset").locator("option:checked")), "writes G54 X Y");
  // A cycle that measures nothing that it could write, and one that turns the offset, too.
  await field("cycle.type").selectOption("nc-action");
  const writes = () => textOf(field("control.workOffset").locator("option:checked"));
  assert.equal(await writes(), "moves nothing, writes nothing");
  await field("cycle.type").selectOption("surface");
  assert.equal(await writes(), "writes G54 Z");
  await field("cycle.type").selectOption("internal-rectangle-protected");
  for (const [name, file] of /** @type {[string, string][]} */ ([
    ["Größe Ø 12", "Grosse_O_12.ngc"],
    ["夹具", "PROBE.ngc"],
    ["CON", "CON_.ngc"],
    ["-rf", "rf.ngc"],
    ["../../etc/passwd", "etc_passwd.ngc"],
    ["x".repeat(300), `${"x".repeat(60)}.ngc`],
    ["", "PROBE.ngc"],
  ])) {
    await put("name", name);
    assert.equal(await textOf(saveButton()), `Save ${file}`);
  }
  await field("cycle.width1").focus();
  const download = page.waitForEvent("download");
  await page.keyboard.press("Control+s");
  assert.equal((await download).suggestedFilename(), "PROBE.ngc");
  const other = page.waitForEvent("download");
  await more("Save job");
  assert.equal((await other).suggestedFilename(), "PROBE-internal-rectangle-protected.json");
});

test("a link holds the whole job, and no server gets it", async () => {
  await field("cycle.width1").fill("66.5");
  await field("name").fill("夹具 Ø12");
  await page.getByRole("button", { name: "Share" }).click();
  await page.locator(".note", { hasText: "Link copied" }).waitFor();
  const link = await page.evaluate(() => navigator.clipboard.readText());
  assert.match(link, /\/#job1=[\w-]+$/);
  const wanted = await page.evaluate(
    () => /** @type {any} */ (document.querySelector("touch-path")).store.plan.program.text,
  );
  const tab = await context.newPage();
  /** @type {string[]} */
  const asked = [];
  tab.on("request", (request) => asked.push(request.url()));
  await tab.goto(link);
  await ready(tab);
  await tab.locator(".note", { hasText: "job of the link" }).waitFor();
  // What is said of a job is not said of the one before it.
  await tab.getByRole("button", { name: "Undo" }).click();
  await tab.locator(".note").waitFor({ state: "detached", timeout: 3000 });
  await tab.getByRole("button", { name: "Redo" }).click();
  assert.equal(await field("cycle.width1", tab).inputValue(), "66.5");
  assert.equal(
    await tab.evaluate(() => /** @type {any} */ (document.querySelector("touch-path")).store.plan.program.text),
    wanted,
  );
  assert.ok(asked.every((url) => !url.includes("job1=")));
  assert.equal(new URL(tab.url()).hash, "", "a reload keeps what is done since");
  await field("cycle.width1", tab).fill("70");
  await tab.reload();
  await ready(tab);
  assert.equal(await field("cycle.width1", tab).inputValue(), "70");
  await tab.close();
});

test("a link of version 1 stays readable, and a broken, foreign or huge one changes nothing and says so", async () => {
  const zip = async (/** @type {string} */ text) => {
    const stream = new Blob([text]).stream().pipeThrough(new CompressionStream("deflate-raw"));
    return Buffer.from(await new Response(stream).arrayBuffer()).toString("base64url");
  };
  // As version 1 wrote it; it must be read for ever.
  const kept = "FcgxDoAgFETBu7yahtj92yCsUSPBIBaEcHfjlDM4y4oNtlJzaJh3xB4v_df6LYy9XMKRjpDVVLHFz-nICs9blTCYHw";
  const before = await job();
  const bad = [
    "#job1=",
    "#job1=%%%",
    "#job1=AAAA",
    "#job2=AAAA",
    `#job1=${"A".repeat(40_000)}`,
    `#job1=${await zip("7")}`,
    `#job1=${await zip('{"job":{"format":1,"cycle":{"type":"boss","touches":"abc"}}}')}`,
    `#job1=${await zip('{"job":{"format":2,"cycle":{"type":"boss"}}}')}`,
    // Three million characters in a short link.
    `#job1=${await zip(`{"job":"${" ".repeat(3_000_000)}"}`)}`,
  ];
  for (const hash of bad) {
    await page.evaluate((hash) => {
      location.hash = hash;
    }, hash);
    await page.locator(".note", { hasText: "Nothing was changed" }).waitFor({ timeout: 3000 });
    assert.deepEqual(await job(), before, hash.slice(0, 40));
    await page.locator(".note").getByRole("button", { name: "OK" }).click();
  }
  await page.evaluate((hash) => {
    location.hash = hash;
  }, `#job1=${kept}`);
  await until("cycle.diameter", "31");
  await undo().click();
  assert.deepEqual(await job(), before);
});

test("the timeline: play, pause, touch by touch, and the move in words with its place", async () => {
  const said = () => textOf(page.locator(".scrub output"));
  await page.getByRole("button", { name: "Next touch" }).click();
  assert.match(await said(), /^touch 1 · contact X37 Y0 Z-10 · F150$/);
  await page.getByRole("button", { name: "Next touch" }).click();
  assert.match(await said(), /touch 2/);
  await page.getByRole("button", { name: "Touch before" }).click();
  assert.match(await said(), /touch 1/);
  await page.locator("#scrub").focus();
  await page.keyboard.press("Control+ArrowRight");
  assert.match(await said(), /touch 2/);
  await page.keyboard.press("Space");
  await page.getByRole("button", { name: "Pause" }).waitFor();
  const one = await pixels();
  await page.waitForTimeout(400);
  assert.notEqual((await pixels()).sum, one.sum, "the ball is on its way");
  await page.getByRole("button", { name: "Pause" }).click();
  const still = await pixels();
  await page.waitForTimeout(200);
  assert.equal((await pixels()).sum, still.sum);
});

test("the times of the moves are the plan's time", async () => {
  const [sum, time] = await page.evaluate(() => {
    const app = /** @type {any} */ (document.querySelector("touch-path"));
    const times = app.shadowRoot.querySelector("tp-picture").timeline.times;
    return [times.reduce((/** @type {number} */ a, /** @type {number} */ b) => a + b, 0), app.store.plan.time];
  });
  assert.ok(Math.abs(sum / 60 - time) < 1e-9, `${sum} s against ${time} min`);
});

test("a click on a dimension goes to its field, and a focused depth turns the picture to where it is seen", async () => {
  const at = await page.evaluate(() => {
    const root = /** @type {ShadowRoot} */ (document.querySelector("touch-path")?.shadowRoot);
    const picture = /** @type {any} */ (root.querySelector("tp-picture"));
    const box = /** @type {HTMLElement} */ (picture.querySelector("canvas")).getBoundingClientRect();
    return picture.drawing.use((/** @type {any} */ view) => {
      for (let y = 0; y < box.height; y += 4)
        if (view.dimensionAt(box.width / 2, y) === "cycle.width1")
          return { x: box.x + box.width / 2, y: box.y + y + 6 };
      return null;
    });
  });
  assert.ok(at, "width 1 stands below or above the middle");
  await page.mouse.click(at.x, at.y);
  await page.waitForFunction(
    () => document.querySelector("touch-path")?.shadowRoot?.activeElement?.id === "f-cycle.width1",
  );
  const looks = () => page.locator(".picture .tools [aria-pressed=true]").textContent();
  assert.equal(await looks(), "top");
  await field("cycle.depth").focus();
  await page.waitForTimeout(50);
  assert.equal(await looks(), "front");
  await field("cycle.width2").focus();
  await page.waitForTimeout(50);
  assert.equal(await looks(), "top", "in front of the part width 2 is not seen, from above it is");
});

test("a line that is clicked stays lit when the pointer leaves; Escape frees it", async () => {
  const lit = () => page.locator("tp-program [aria-selected=true] .text").allTextContents();
  await page.locator("tp-program .line", { hasText: "G38.2 X42" }).click();
  await page.locator("tp-form").hover();
  assert.deepEqual(await lit(), ["G38.2 X42 Y0 Z-10 F150"]);
  await page.locator("tp-program .line", { hasText: "G38.2 X-42" }).hover();
  assert.deepEqual(await lit(), ["G38.2 X-42 Y0 Z-10 F150"], "pointing shows another");
  await page.locator("tp-form").hover();
  assert.deepEqual(await lit(), ["G38.2 X42 Y0 Z-10 F150"]);
  await page.getByRole("listbox", { name: "Program" }).press("Escape");
  assert.deepEqual(await lit(), []);
});

test("the setup sheet: one printed page with what is expected, boxes for what was, and the program's hash", async () => {
  await page.getByRole("button", { name: "Setup sheet" }).click();
  const sheet = page.locator("tp-sheet");
  await sheet.getByText(/^[0-9a-f]{64}$/).waitFor();
  const { createHash } = await import("node:crypto");
  const download = page.waitForEvent("download");
  await saveButton().click();
  const text = readFileSync(await (await download).path());
  assert.equal(await textOf(sheet.locator(".hash code")), createHash("sha256").update(text).digest("hex"));
  assert.match(await textOf(sheet), /Width 1\s*80/);
  assert.equal(await sheet.locator("td.box").count(), 9, "five results and four touches");
  const onePage = async () => {
    await page.emulateMedia({ media: "print" });
    assert.ok(await page.locator("header").isHidden());
    for (const format of ["A4", "Letter"]) {
      const pdf = (await page.pdf({ format, preferCSSPageSize: false })).toString("latin1");
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
  await page.getByRole("button", { name: "Setup sheet" }).click();
  await sheet.getByText("Wall 1 against its nominal direction").waitFor();
  assert.equal(await sheet.locator("td.box").count(), 22, "six results and sixteen touches");
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
    const positioning = await textOf(field("control.protection").locator("option:checked"));
    assert.equal(/not on this control/.test(positioning), post === "grbl", positioning);
    await page.getByRole("button", { name: "Setup sheet" }).click();
    const job = /** @type {any} */ (defaultJob("internal-rectangle-protected"));
    const lines = plan({ ...job, control: { ...job.control, post } }).program.text.split("\n");
    const said = await textOf(sheet.locator(".head"));
    // From the units on, word by word, and nothing of the job's values.
    const first = lines.findIndex((line) => /^[(;] ?units/i.test(line));
    const end = lines.findIndex((line) => /^[(;] ?made by/i.test(line));
    assert.ok(first > 0 && end > first + 3, post);
    const wanted = lines.slice(first, end).map((line) => (line.startsWith(";") ? line.slice(2) : line.slice(1, -1)));
    assert.deepEqual(said.split("\n").slice(1), wanted, post);
    assert.ok(wanted.some((line) => /probe in the spindle and switched on/i.test(line)));
    assert.equal(/expected to report/.test(await textOf(sheet)), reports, post);
    assert.match(await textOf(sheet), /Work feed\s*150 mm\/min/);
    await page.keyboard.press("Escape");
    await sheet.waitFor({ state: "detached" });
    await page.getByRole("tab", { name: "Results" }).click();
    const caption = reports ? "What the control will have stored" : "What the touches will give";
    await page.locator("tp-results").getByText(caption).waitFor();
  }
});

test("the setup sheet drew the handle of the virtual part as if it were a feature", async () => {
  // A nominal part is not drawn: of its colour there is the handle alone, which stands out while a field of the part has the focus.
  await field("part.offset[0]").focus();
  const handle = async (/** @type {string} */ part) => (await painted(part, "actual")).count;
  assert.ok((await handle("tp-picture")) > 20);
  await page.getByRole("button", { name: "Setup sheet" }).click();
  await page.locator("tp-sheet canvas").waitFor();
  await page.waitForTimeout(300);
  assert.equal(await handle("tp-sheet"), 0);
});

test("a result of another plane stood under the name of another axis: in G18 the abscissa is Z", async () => {
  await field("cycle.type").selectOption("hole");
  await put("plane", "G18");
  await put("part.offset", [1, 0, 5]);
  await page.getByRole("tab", { name: "Results" }).click();
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
  await page.getByRole("tab", { name: "Results" }).click();
  const results = page.locator("tp-results");
  assert.doesNotMatch(await textOf(results), /middle of the tolerance zone/);
  await field("cycle.diameter1").fill("20H7");
  await results.getByText("Deviations are from the middle of the tolerance zone.").waitFor();
  assert.match(await textOf(results.locator("tr", { hasText: "Q966" }).first()), /Measured diameter 1/);
});

test("a note that a link was copied went on after the job was another one", async () => {
  const note = page.locator(".note");
  await page.getByRole("button", { name: "Share" }).click();
  assert.match(await textOf(note), /Link copied/);
  await field("cycle.width1").fill("81");
  await note.waitFor({ state: "detached" });
  // What is saved while the program is not seen is said all the same.
  await page.setViewportSize({ width: 900, height: 800 });
  await page.getByRole("tab", { name: "Results" }).click();
  await saveButton().click();
  assert.match(await textOf(note), /Saved POCKET-81X50\.ngc/);
});

test("the setup sheet is of the form as it stands: its picture follows, and with an error there is none", async () => {
  await field("cycle.type").selectOption("hole");
  await field("cycle.diameter").fill("abc");
  await field("cycle.type").focus();
  await field("cycle.diameter").fill("55");
  await page.getByRole("button", { name: "Setup sheet" }).click();
  const picture = () =>
    page.locator("tp-sheet canvas").evaluate((c) => /** @type {HTMLCanvasElement} */ (c).toDataURL());
  const hole = await picture();
  await field("cycle.type").selectOption("internal-rectangle");
  await page.waitForTimeout(50);
  assert.notEqual(await picture(), hole);
  await undo().click();
  assert.equal(await picture(), hole);
  await undo().click();
  assert.match(await textOf(page.locator("tp-sheet")), /No setup sheet while the form has an error/);
  assert.equal(await page.locator("tp-sheet :is(article, canvas)").count(), 0);
  assert.equal(await page.getByRole("button", { name: "Print" }).count(), 0);
  await redo().click();
  assert.equal(await picture(), hole);
});

test("nothing plays that is not seen", async () => {
  await page.getByRole("button", { name: "Play" }).click();
  await more("Tool lengths");
  await page.waitForTimeout(100);
  const clock = () =>
    page.evaluate(
      () =>
        /** @type {any} */ (document.querySelector("touch-path")).shadowRoot.querySelector("tp-picture").timeline.clock,
    );
  assert.equal(await clock(), null);
});

test("what is narrower than a tablet keeps its order for eye and Tab: picture, form, tabs", async () => {
  await open({ viewport: { width: 390, height: 844 } });
  const order = await page.locator("main > *:visible").evaluateAll((all) => all.map((n) => n.className));
  assert.deepEqual(order, ["picture", "setup", "tabs"]);
  const tops = await Promise.all([".picture", ".setup", ".tabs"].map(async (n) => (await boxOf(page.locator(n))).y));
  assert.deepEqual(
    [...tops].sort((a, b) => a - b),
    tops,
  );
  await page.setViewportSize({ width: 1440, height: 900 });
  await page.waitForTimeout(100);
  const wide = await page.locator("main > *:visible").evaluateAll((all) => all.map((n) => n.className));
  assert.deepEqual(wide.slice(0, 3), ["setup", "picture", "tabs"]);
  assert.ok((await pixels()).count > 2000, "the picture is still drawn");
});
