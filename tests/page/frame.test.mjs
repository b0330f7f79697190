// The frame around form, picture and panels: the sentence, links, names, input, the timeline.
import assert from "node:assert/strict";
import { test } from "node:test";
import {
  boxOf,
  context,
  field,
  held,
  more,
  onView,
  open,
  PICTURE,
  page,
  panel,
  pixels,
  program,
  put,
  ready,
  saveButton,
  settles,
  setUp,
  textOf,
  undo,
  unfold,
  until,
} from "./common.mjs";

setUp({ width: 1440, height: 900 });

const job = () => held("cycle");

test("type 7 fits 1440 × 900 without a scroll bar, and nothing moves while one types", async () => {
  await page.reload();
  await page.locator(`tp-picture ${PICTURE}`).waitFor();
  await page.locator("#tab-program").click();
  const over = await page.evaluate(() => {
    const root = /** @type {ShadowRoot} */ (
      document.querySelector("touch-path")?.shadowRoot
    );
    const form = /** @type {Element} */ (root.querySelector("tp-form"));
    return [
      form.scrollHeight - form.clientHeight,
      (document.scrollingElement?.scrollHeight ?? 0) - innerHeight,
    ];
  });
  assert.ok(
    over.every((pixels) => pixels <= 0),
    `${over}`,
  );
  const places = async () =>
    Promise.all(
      [
        "[id='f-cycle.width2']",
        `tp-picture ${PICTURE}`,
        "tp-program .code",
        ".state",
        "tp-help",
      ].map((name) => boxOf(page.locator(name))),
    );
  await field("cycle.width1").focus();
  const before = await places();
  for (const text of ["8", "x", "-5", "2000000", "81"]) {
    await field("cycle.width1").fill(text);
    assert.deepEqual(await places(), before, text);
  }
});

for (const [
  text,
  value,
  shown,
] of /** @type {[string, number | string, string][]} */ ([
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
  assert.ok(
    await page.locator(".part-note", { hasText: "turned 20°" }).isVisible(),
  );
  const folded = (/** @type {string} */ name) =>
    page.locator("tp-form .fold", { hasText: name });
  assert.match(
    (await folded("Clearances, touches, feeds").getAttribute("class")) ?? "",
    /warning/,
  );
  assert.match(
    (await folded("Stock and virtual part").getAttribute("class")) ?? "",
    /warning/,
  );
  assert.match(await textOf(folded("Stock and virtual part")), /turned 20°/);
  assert.match(await textOf(folded("Clearances, touches, feeds")), /3000/);
});

test("the box at the foot says what the field in focus is, puts its default back, and says what is wrong", async () => {
  const help = page.locator("tp-help");
  const { height } = await boxOf(help);
  await field("cycle.width1").fill("81");
  assert.match(
    await textOf(help),
    /Width 1\s+CmdPrm\.Flt\[-53\].*From touch point 1 to touch point 2.*Default 80/s,
  );
  await help.getByRole("button", { name: /back to its default/ }).click();
  assert.equal(await field("cycle.width1").inputValue(), "80");
  await field("cycle.sideClearance1").fill("2");
  assert.match(await textOf(help), /ball radius/);
  assert.equal((await boxOf(help)).height, height);
});

test("a control that does not take this cycle says why when it is chosen, and the job stays", async () => {
  await field("cycle.type").selectOption("double-wall-external-corner");
  const options = await field("control.post")
    .locator("option.not")
    .evaluateAll((all) =>
      all.map((o) => /** @type {HTMLOptionElement} */ (o).value),
    );
  assert.deepEqual(options, ["heidenhain"]);
  await field("control.post").selectOption("heidenhain");
  // By a click or a tap: no pointer can hover over an entry of a list.
  await page
    .locator(".note", {
      hasText: /HEIDENHAIN TNC7 .* has no program for this cycle: .{20}/,
    })
    .waitFor();
  assert.equal(await held("control.post"), "linuxcnc");
  assert.equal(
    await field("control.post").inputValue(),
    "linuxcnc",
    "the list shows what holds",
  );
  await field("cycle.type").selectOption("internal-rectangle-protected");
});

test("the bar reads as the job's sentence: what is written, under which name", async () => {
  // Before, only "measures only, writes …" was visible of it.
  assert.equal(
    await textOf(field("control.workOffset").locator("option:checked")),
    "measures only",
  );
  await field("control.workOffset").selectOption("1");
  assert.equal(
    await textOf(field("control.workOffset").locator("option:checked")),
    "writes G54 X Y",
  );
  // A cycle without a value to write, and one that also rotates the offset.
  await field("cycle.type").selectOption("nc-action");
  const writes = () =>
    textOf(field("control.workOffset").locator("option:checked"));
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
  assert.equal(
    (await other).suggestedFilename(),
    "PROBE-internal-rectangle-protected.json",
  );
});

test("a link holds the whole job, and no server gets it", async () => {
  await field("cycle.width1").fill("66.5");
  await field("name").fill("夹具 Ø12");
  await more("Copy a link to this job", page);
  await page.locator(".note", { hasText: "Link copied" }).waitFor();
  const link = await page.evaluate(() => navigator.clipboard.readText());
  assert.match(link, /\/#job1=[\w-]+$/);
  const wanted = await page.evaluate(
    () =>
      /** @type {any} */ (document.querySelector("touch-path")).store.plan
        .program.text,
  );
  const tab = await context.newPage();
  /** @type {string[]} */
  const asked = [];
  tab.on("request", (request) => asked.push(request.url()));
  await tab.goto(link);
  await ready(tab);
  await tab.locator(".note", { hasText: "job of the link" }).waitFor();
  // A message about a job does not appear for the previous one.
  await tab.getByRole("button", { name: "Undo" }).click();
  await tab.locator(".note").waitFor({ state: "detached", timeout: 3000 });
  await tab.getByRole("button", { name: "Redo" }).click();
  assert.equal(await field("cycle.width1", tab).inputValue(), "66.5");
  assert.equal(
    await tab.evaluate(
      () =>
        /** @type {any} */ (document.querySelector("touch-path")).store.plan
          .program.text,
    ),
    wanted,
  );
  assert.ok(asked.every((url) => !url.includes("job1=")));
  assert.equal(
    new URL(tab.url()).hash,
    "",
    "a reload keeps what is done since",
  );
  await field("cycle.width1", tab).fill("70");
  await tab.reload();
  await ready(tab);
  assert.equal(await field("cycle.width1", tab).inputValue(), "70");
  await tab.close();
});

test("a link of version 1 stays readable, and a broken, foreign or huge one changes nothing and says so", async () => {
  const zip = async (/** @type {string} */ text) => {
    const stream = new Blob([text])
      .stream()
      .pipeThrough(new CompressionStream("deflate-raw"));
    return Buffer.from(await new Response(stream).arrayBuffer()).toString(
      "base64url",
    );
  };
  // As written by version 1; it must stay readable.
  const kept =
    "FcgxDoAgFETBu7yahtj92yCsUSPBIBaEcHfjlDM4y4oNtlJzaJh3xB4v_df6LYy9XMKRjpDVVLHFz-nICs9blTCYHw";
  const before = await job();
  const bad = [
    "#job1=",
    "#job1=%%%",
    "#job1=AAAA",
    "#job2=AAAA",
    `#job1=${"A".repeat(40_000)}`,
    `#job1=${await zip("7")}`,
    `#job1=${await zip('{"job":{"format":1,"cycle":{"type":"boss","touches":"abc"}}}')}`,
    `#job1=${await zip('{"job":{"format":3,"cycle":{"type":"boss"}}}')}`,
    // Three million characters in a short link.
    `#job1=${await zip(`{"job":"${" ".repeat(3_000_000)}"}`)}`,
  ];
  for (const hash of bad) {
    await page.evaluate((hash) => {
      location.hash = hash;
    }, hash);
    await page
      .locator(".note", { hasText: "Nothing was changed" })
      .waitFor({ timeout: 3000 });
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
  const said = () => textOf(page.locator(".timeline output"));
  await page.locator("#timeline").press("Control+ArrowRight");
  assert.match(await said(), /^touch 1 · contact X37 Y0 Z-10 · F150$/);
  await page.locator("#timeline").press("Control+ArrowRight");
  assert.match(await said(), /touch 2/);
  await page.locator("#timeline").press("Control+ArrowLeft");
  assert.match(await said(), /touch 1/);
  await page.locator("#timeline").focus();
  await page.keyboard.press("Control+ArrowRight");
  assert.match(await said(), /touch 2/);
  await page.keyboard.press("Space");
  await page.getByRole("button", { name: "Pause" }).waitFor();
  const one = await pixels();
  // The ball is moving.
  await settles(async () => (await pixels()).sum !== one.sum);
  await page.getByRole("button", { name: "Pause" }).click();
  const still = await pixels();
  await page.waitForTimeout(200);
  assert.equal((await pixels()).sum, still.sum);
});

test("the times of the moves are the plan's time", async () => {
  const [sum, time] = await page.evaluate(() => {
    const app = /** @type {any} */ (document.querySelector("touch-path"));
    const times = app.shadowRoot.querySelector("tp-picture").timeline.times;
    return [
      times.reduce(
        (/** @type {number} */ a, /** @type {number} */ b) => a + b,
        0,
      ),
      app.store.plan.time,
    ];
  });
  assert.ok(Math.abs(sum / 60 - time) < 1e-9, `${sum} s against ${time} min`);
});

test("a click on a dimension goes to its field, and a focused depth turns the picture to where it is seen", async () => {
  const place = () =>
    onView((view, box) => {
      for (let y = 0; y < box.height; y += 4)
        if (view.dimensionAt(box.width / 2, y) === "cycle.width1")
          return { x: box.x + box.width / 2, y: box.y + y + 6 };
      return null;
    });
  // The name of width 1 is below or above the middle once the pocket is drawn.
  await settles(async () => (await place()) !== null);
  const at = /** @type {{ x: number, y: number }} */ (await place());
  await page.mouse.click(at.x, at.y);
  await page.waitForFunction(
    () =>
      document.querySelector("touch-path")?.shadowRoot?.activeElement?.id ===
      "f-cycle.width1",
  );
  const looks = () =>
    page.locator(".picture .cube [aria-pressed=true]").textContent();
  assert.equal(await looks(), "top");
  await field("cycle.depth").focus();
  await settles(async () => (await looks()) === "front");
  // Width 2 is not visible from the front, but from above.
  await field("cycle.width2").focus();
  await settles(async () => (await looks()) === "top");
});

test("a line that is clicked stays lit when the pointer leaves; Escape frees it", async () => {
  const lit = () =>
    page.locator("tp-program [aria-selected=true] .text").allTextContents();
  await page.locator("tp-program .line", { hasText: "G38.2 X42" }).click();
  await page.locator("tp-form").hover();
  assert.deepEqual(await lit(), ["G38.2 X42 Y0 Z-10 F150"]);
  await page.locator("tp-program .line", { hasText: "G38.2 X-42" }).hover();
  assert.deepEqual(
    await lit(),
    ["G38.2 X-42 Y0 Z-10 F150"],
    "pointing shows another",
  );
  await page.locator("tp-form").hover();
  assert.deepEqual(await lit(), ["G38.2 X42 Y0 Z-10 F150"]);
  await page.getByRole("listbox", { name: "Program" }).press("Escape");
  assert.deepEqual(await lit(), []);
});

test("a note that a link was copied went on after the job was another one", async () => {
  const note = page.locator(".note");
  await more("Copy a link to this job", page);
  assert.match(await textOf(note), /Link copied/);
  await field("cycle.width1").fill("81");
  await note.waitFor({ state: "detached" });
  // A save while the program is hidden is still reported.
  await page.setViewportSize({ width: 900, height: 800 });
  await panel("results", page);
  await saveButton().click();
  assert.match(await textOf(note), /Saved POCKET-81X50\.ngc/);
});

test("nothing plays that is not seen", async () => {
  await page.getByRole("button", { name: "Play" }).click();
  await more("Tool lengths");
  const clock = () =>
    page.evaluate(
      () =>
        /** @type {any} */ (
          document.querySelector("touch-path")
        ).shadowRoot.querySelector("tp-picture").timeline.clock,
    );
  await settles(async () => (await clock()) === null);
});

test("what is narrower than a tablet keeps its order for eye and Tab: picture, form, tabs", async () => {
  await open({ viewport: { width: 390, height: 844 } });
  const order = await page
    .locator("main > *:visible")
    .evaluateAll((all) => all.map((n) => n.className));
  assert.deepEqual(order, ["picture", "setup", "tabs"]);
  const tops = await Promise.all(
    [".picture", ".setup", ".tabs"].map(
      async (n) => (await boxOf(page.locator(n))).y,
    ),
  );
  assert.deepEqual(
    [...tops].sort((a, b) => a - b),
    tops,
  );
  await page.setViewportSize({ width: 1440, height: 900 });
  const wide = () =>
    page
      .locator("main > *:visible")
      .evaluateAll((all) => all.map((n) => n.className));
  await settles(
    async () => (await wide()).slice(0, 3).join() === "setup,picture,state",
  );
  // The picture is still drawn.
  await settles(async () => (await pixels()).count > 2000);
});
