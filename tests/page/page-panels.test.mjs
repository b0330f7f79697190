// The panels beside the form: the program, its parameters, its results, the checks.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import {
  boxOf,
  field,
  held,
  openText,
  PICTURE,
  page,
  panel,
  pixels,
  problems,
  program,
  put,
  saveButton,
  settles,
  setUp,
  textOf,
  until,
} from "./common.mjs";

setUp();

const selected = () =>
  page.locator("tp-program [aria-selected=true] .text").allTextContents();

test("pointing at a line, a move or a touch's row lights up the others", async () => {
  const plain = await pixels();
  await page.locator("tp-program .line", { hasText: "G38.2 X42" }).hover();
  assert.deepEqual(await selected(), ["G38.2 X42 Y0 Z-10 F150"]);
  assert.notEqual((await pixels()).sum, plain.sum, "the picture shows it");
  assert.match(
    (await page.locator(".timeline output").textContent()) ?? "",
    /^touch 1 · contact X37 Y0 Z-10 · F150$/,
  );
  // A click selects it; one beside the lines changes nothing.
  await page.locator("tp-program .line", { hasText: "G38.2 X42" }).click();
  await page.locator("tp-program .step").nth(3).click();
  await page.getByRole("tab", { name: "Program" }).hover();
  assert.deepEqual(await selected(), ["G38.2 X42 Y0 Z-10 F150"]);
  await page.getByRole("listbox", { name: "Program" }).press("Escape");
  await page.getByRole("tab", { name: "Parameters" }).click();
  assert.equal(await page.locator("tp-table tr.lit").count(), 0);
  await page.locator("tp-table tr", { hasText: "CmdPrm.Flt[-112]" }).hover();
  assert.match(
    (await page.locator(".timeline output").textContent()) ?? "",
    /touch 3/,
  );
  assert.equal(
    await page.locator("tp-table tr.lit").count(),
    12,
    "six codes used, six original",
  );
  await page.getByRole("tab", { name: "Program" }).click();
  // Touch 1 in the picture: between the centre and the wall on the right, near the wall.
  const box = await boxOf(page.locator(PICTURE));
  /** @type {string[]} */
  let found = [];
  for (
    let x = box.width * 0.75;
    x < box.width && !found[0]?.startsWith("G38.2 X42");
    x += 4
  ) {
    await page.mouse.move(box.x + x, box.y + box.height / 2);
    found = await selected();
  }
  assert.deepEqual(found, ["G38.2 X42 Y0 Z-10 F150"]);
});

test("each touch of a point that is touched three times lights up the rows of the point", async () => {
  await openText('{"format":1,"cycle":{"type":"hole","repeat":{"times":3}}}');
  // A file is read after its field has it: the test waits for the plan, or it would point at touches of the previous job.
  await settles(() =>
    page.evaluate(() => {
      const { store } = /** @type {any} */ (
        document.querySelector("touch-path")
      );
      const { moves } = store.plan;
      return (
        !store.stale &&
        moves.some(
          (/** @type {any} */ move) =>
            move.kind === "touch" && move.touch === 11,
        )
      );
    }),
  );
  await page.getByRole("tab", { name: "Parameters" }).click();
  const lit = page.locator("tp-table tr.lit code");
  /** @type {string[]} */
  const codes = [];
  for (let touch = 0; touch < 6; touch++) {
    await page.evaluate((touch) => {
      const { store } = /** @type {any} */ (
        document.querySelector("touch-path")
      );
      store.point(
        store.plan.moves.findIndex(
          (/** @type {any} */ move) =>
            move.kind === "touch" && move.touch === touch,
        ),
      );
    }, touch);
    await settles(async () => (await lit.count()) > 0);
    codes.push((await lit.allTextContents()).join());
  }
  assert.match(codes[0] ?? "", /CmdPrm/);
  assert.deepEqual(
    [codes[1], codes[2], codes[4], codes[5]],
    [codes[0], codes[0], codes[3], codes[3]],
  );
  assert.notEqual(codes[0], codes[3]);
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
  assert.match(
    readFileSync(await (await download).path(), "utf8"),
    /^code,type,value,meaning\n/,
  );
});

test("measured points give the same results, and bad ones a plain answer", async () => {
  await panel("measured");
  const box = page.locator("#measured");
  await box.fill("37.1,0,-10\n-36.9,0,-10\n0,22,-10\n0,-22,-10");
  const own = (/** @type {string} */ code) =>
    page
      .locator("tp-measured tp-results table")
      .first()
      .locator("tr", { hasText: code })
      .locator(".own")
      .textContent();
  const before = await pixels();
  assert.match((await own("center.x")) ?? "", /^0\.100 \+0\.100$/);
  assert.match((await own("width1")) ?? "", /^80\.000 0\.000$/);
  const { sum } = await pixels();
  await box.fill("37.1,0,-10\n-36.9,0,-10\n0,22,-10\n0,-21,-10");
  assert.notEqual((await pixels()).sum, sum, "the points are in the picture");
  assert.ok(before.count > 0);
  const wide = await page
    .locator("#panel-measured")
    .evaluate((panel) => panel.scrollWidth - panel.clientWidth);
  assert.equal(wide, 0, "nothing of the table is cut off");
  await box.fill("37.1,0\n");
  assert.match(
    (await page.locator("details.measured").textContent()) ?? "",
    /Line 1 has 2 numbers/,
  );
  await page.getByRole("button", { name: "Fill in the points shown" }).click();
  assert.match((await own("width1")) ?? "", /80\.000/);
});

test("lines that belong to a move stood above the heading of its step", async () => {
  for (const [post, names] of [
    ["sinumerik", /TP_MOVE=\d+$/],
    ["fanuc", /#149=\d+$/],
    ["linuxcnc", /G38\.|G1 /],
  ]) {
    await openText(
      JSON.stringify({
        format: 1,
        cycle: { type: "internal-rectangle-protected" },
        control: { post },
      }),
    );
    await until("control.post", String(post));
    const first = await page
      .locator("tp-program .step + .line .text")
      .evaluateAll((rows) => rows.slice(1).map((row) => row.textContent));
    assert.ok(first.length > 8, String(post));
    for (const text of first)
      assert.match(text ?? "", /** @type {RegExp} */ (names), String(post));
  }
});

test("words are found in the program, in its folded header too, and stay found while it changes", async () => {
  const find = page.getByLabel("Find in the program");
  const here = () => page.locator("tp-program .line.here").textContent();
  const said = () =>
    page.locator("tp-program .status-text.found").textContent();
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
  await page
    .locator("tp-program .line.here", { hasText: "Job: POCKET-70X50" })
    .waitFor({ state: "visible" });
  await find.fill("no such words");
  assert.equal(await said(), "not found");
  await find.fill("");
  assert.deepEqual(
    [await said(), await page.locator("tp-program .line.match").count()],
    ["", 0],
  );
});

test("all moves are listed in words, and the list is of the form", async () => {
  await panel("measured");
  await page.getByText("All moves in words").click();
  const words = page.locator("tp-measured .moves li");
  // A folded section is filled once the browser reports it open.
  await words.first().waitFor();
  assert.equal(
    await words.count(),
    Number(await page.locator("#timeline").getAttribute("max")),
  );
  const touch = words.filter({ hasText: "touch 1, work" });
  assert.match(
    await textOf(touch),
    /^step \d+, touch 1, work, to X37 Y0 Z-10$/,
  );
  await field("cycle.depth").fill("12.5");
  assert.match(await textOf(touch), /Z-12\.5$/);
});

test("this job on every control: what each makes of it, and the way there", async () => {
  await page.getByRole("tab", { name: "Checks" }).click();
  await page.getByText("This job on every control").click();
  const rows = page.locator("tp-checks .controls tbody tr:not(.why)");
  const { catalog, defaultJob, programs } = await import("touchpath");
  const job = /** @type {any} */ (defaultJob("internal-rectangle-protected"));
  const wanted = catalog().posts.flatMap((post) =>
    ["moves", "cycle"]
      .filter((form) =>
        post.cycles.some(
          (c) => c.type === job.cycle.type && c.form === form && c.supported,
        ),
      )
      .map((form) => {
        const [made] = programs([
          { ...job, control: { ...job.control, post: post.id, form } },
        ]);
        return [
          post.title,
          form === "moves" ? "moves" : "native cycle",
          made?.program
            ? String(made.program.text.split("\n").length - 1)
            : "–",
        ];
      }),
  );
  await rows.first().waitFor();
  const shown = await rows.evaluateAll((all) =>
    all.map((row) =>
      [...row.children].slice(0, 3).map((cell) => cell.textContent?.trim()),
    ),
  );
  assert.deepEqual(shown, wanted);
  await rows
    .getByRole("button", {
      name: "Choose SINUMERIK 840D sl / 828D, native cycle",
    })
    .click();
  assert.deepEqual(
    [await held("control.post"), await held("control.form")],
    ["sinumerik", "cycle"],
  );
  await page.getByRole("button", { name: "Undo" }).click();
  assert.equal(await held("control.post"), "linuxcnc");
});

test("the table: groups that fold, a filter", async () => {
  await page.getByRole("tab", { name: "Parameters" }).click();
  const rows = page.locator("tp-table tbody tr:not(.group)");
  assert.deepEqual(
    (await page.locator("tp-table tr.group button").allTextContents()).map(
      (t) => t.replace(/\s+/g, " ").trim(),
    ),
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

test("a value with a tolerance has a bar: where it lies between its limits, and by how much it may scatter", async () => {
  await field("cycle.type").selectOption("probing-two-circles");
  await put("cycle.diameter1", "20+0.05-0.05");
  await panel("results", page);
  const bar = page.locator("tp-results .band");
  assert.equal(await bar.count(), 1);
  assert.equal(
    await bar.getAttribute("aria-label"),
    "20.000, limits 19.950 and 20.050: good",
  );
  /** Where something of the bar is, in percent of its width. */
  const at = async (/** @type {string} */ what, /** @type {string} */ name) =>
    Number.parseFloat((await bar.locator(what).getAttribute(name)) ?? "");
  assert.equal(
    await at("circle", "cx"),
    50,
    "the nominal size is in the middle",
  );
  const spread = async () =>
    (await at("line", "x2")) - (await at("line", "x1"));
  const before = await spread();
  assert.ok(before > 0);
  await put("stylus.repeatability", 0.002);
  assert.ok(Math.abs((await spread()) - 2 * before) < 0.1);
  // Too small: left of the good range, and labelled so.
  await put("part", {
    offset: [0, 0, 0],
    rotation: 0,
    sizes: { diameter1: -0.08 },
  });
  // 0.03 below the limit, where 0.1 are 50 wide.
  assert.ok(Math.abs((await at("circle", "cx")) - (25 - 15)) < 0.5);
  assert.match((await bar.getAttribute("class")) ?? "", /bad/);
  assert.equal(
    await bar.getAttribute("aria-label"),
    "19.920, limits 19.950 and 20.050: rework",
  );
});

test("two tolerances of one size are put right where the error leads to", async () => {
  await page.evaluate(() => {
    const { store } = /** @type {any} */ (document.querySelector("touch-path"));
    store.choose("hole");
    store.tolerate(0, { diameter: { tolerance: "±0.1", action: "stop" } });
  });
  await put("cycle.diameter", "25 H7");
  await page.getByRole("button", { name: "Go to it" }).click();
  const box = page.locator("[id='f-tolerances.diameter']");
  await settles(() =>
    box.evaluate(
      (it) => /** @type {Document} */ (it.getRootNode()).activeElement === it,
    ),
  );
  assert.equal(await box.inputValue(), "±0.1");
  await box.fill("");
  // Its action stays, and applies to the size.
  assert.deepEqual(
    await page.evaluate(() => {
      const { store } = /** @type {any} */ (
        document.querySelector("touch-path")
      );
      return [store.withheld, store.job.tolerances];
    }),
    [null, { diameter: { action: "stop" } }],
  );
  assert.deepEqual(
    [await box.inputValue(), await box.isDisabled()],
    ["25 H7", true],
  );
});

test("the words of a program have colours, those of the program that is shown", async () => {
  const coloured = (/** @type {string} */ kind) =>
    page.evaluate((kind) => {
      const ranges = /** @type {StaticRange[]} */ ([
        .../** @type {any} */ (CSS.highlights.get(`touchpath-${kind}`) ?? []),
      ]);
      return ranges.map((range) =>
        (range.startContainer.nodeValue ?? "").slice(
          range.startOffset,
          range.endOffset,
        ),
      );
    }, kind);
  await settles(async () => (await coloured("code")).includes("G38.3"));
  await settles(async () => (await coloured("variable")).includes("#5070"));
  // Only visible lines: those of the folded header and of the end are coloured when they become visible.
  await settles(async () => {
    const all = [...(await coloured("comment")), ...(await coloured("code"))];
    return !all.includes("(Job: POCKET-80X50)") && !all.includes("M2");
  });
  await page.locator("tp-program .line").last().scrollIntoViewIfNeeded();
  await settles(async () => (await coloured("code")).includes("M2"));
  await page.getByRole("button", { name: /header/ }).click();
  await page.locator("tp-program .line").first().scrollIntoViewIfNeeded();
  await settles(async () =>
    (await coloured("comment")).includes("(Job: POCKET-80X50)"),
  );
  await page.getByRole("button", { name: /header/ }).click();
  // Those of another program replace them: nothing of the first stays.
  await field("control.post").selectOption("sinumerik");
  await settles(async () => (await coloured("code")).includes("STOPRE"));
  assert.ok(
    !(await coloured("code")).includes("G38.3") &&
      !(await coloured("variable")).includes("#5070"),
  );
  // Typing leaves none behind: all are replaced, and no words are coloured twice.
  await page.evaluate(() => {
    const code = [.../** @type {any} */ (CSS.highlights.get("touchpath-code"))];
    Object.assign(globalThis, { before: new Set(code) });
  });
  await field("cycle.depth").fill("11");
  await settles(async () => (await program()).includes("Z-11"));
  await settles(() =>
    page.evaluate(() => {
      const ranges = /** @type {StaticRange[]} */ ([
        .../** @type {any} */ (CSS.highlights.get("touchpath-code")),
      ]);
      const { before } = /** @type {any} */ (globalThis);
      const twice = (
        /** @type {StaticRange} */ one,
        /** @type {StaticRange} */ other,
      ) =>
        one !== other &&
        one.startContainer === other.startContainer &&
        one.startOffset === other.startOffset;
      return (
        ranges.length > 0 &&
        ranges.every(
          (one) =>
            !before.has(one) && !ranges.some((other) => twice(one, other)),
        )
      );
    }),
  );
});

test("a program is compared with the one saved last and with the other form of its control", async () => {
  const choice = page.getByLabel("Compare the program");
  const shown = page.locator("tp-program .differences .line");
  const texts = async (/** @type {string} */ kind) =>
    page.locator(`tp-program .differences .${kind} .text`).allTextContents();
  assert.ok(
    await choice.locator("option[value=saved]").isDisabled(),
    "nothing was saved yet",
  );
  const listed = () =>
    page.locator("tp-program .code[role=listbox] .text").allTextContents();
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
  assert.ok(
    less.some((text) => /X42 /.test(text)) &&
      more.some((text) => /X43 /.test(text)),
    `${less} ${more}`,
  );
  // Without the lines of the other, each program is complete.
  const all = await page
    .locator("tp-program .differences .line")
    .evaluateAll((lines) =>
      lines.map((line) => [
        line.className,
        line.querySelector(".text")?.textContent ?? "",
      ]),
    );
  const without = (/** @type {string} */ kind) =>
    all.filter(([name]) => !name?.includes(kind)).map(([, text]) => text);
  assert.deepEqual(without("less"), now);
  assert.deepEqual(without("more"), before);
  assert.match(
    await textOf(page.locator("tp-program .compared [role=status]")),
    /^\d+ lines only here, \d+ lines only there$/,
  );
  // The control's other form has its own words. Another control's program has no line in common, so it is not offered.
  await field("control.post").selectOption("haas");
  await choice.selectOption("form");
  await settles(async () =>
    (await texts("less")).some((text) => /G65 P9812/.test(text)),
  );
  const offered = await choice
    .locator("option")
    .evaluateAll((all) =>
      all.map((one) => /** @type {HTMLOptionElement} */ (one).value),
    );
  assert.deepEqual(offered, ["", "saved", "form"]);
  // A control with one form: nothing is left to compare with, and the program is shown.
  await field("control.post").selectOption("linuxcnc");
  await page.locator("tp-program .code[role=listbox]").waitFor();
  assert.equal(await shown.count(), 0);
  assert.equal(
    await choice.inputValue(),
    "",
    "the list says that nothing is compared",
  );
  await field("control.post").selectOption("haas");
  await choice.selectOption("form");
  await shown.first().waitFor();
  // Side by side: each column is its whole program, with replacing lines beside each other.
  await page.getByRole("button", { name: "Side by side" }).click();
  const rows = page.locator("dialog.beside tbody tr");
  const column = async (/** @type {number} */ n) =>
    (
      await rows.locator(`td:nth-child(${n}):not(.none)`).allTextContents()
    ).join("\n");
  assert.equal(
    `${await column(4)}\n`,
    await page.evaluate(
      () =>
        /** @type {any} */ (document.querySelector("touch-path")).plan.program
          .text,
    ),
  );
  const { plan } = await import("touchpath");
  const other = await page.evaluate(
    () => /** @type {any} */ (document.querySelector("touch-path")).job,
  );
  other.control.form = "cycle";
  assert.equal(`${await column(2)}\n`, plan(other).program.text);
  assert.ok((await rows.locator("td.less + td + td.more").count()) > 10);
  await page.keyboard.press("Escape");
  await settles(async () => (await rows.count()) === 0);
  // Another control from outside closes it.
  await page.getByRole("button", { name: "Side by side" }).click();
  await rows.first().waitFor();
  await page.evaluate(() =>
    Object.assign(document.querySelector("touch-path") ?? {}, { post: "grbl" }),
  );
  await settles(
    async () =>
      (await rows.count()) === 0 && (await choice.inputValue()) === "",
  );
  await page.evaluate(() =>
    Object.assign(document.querySelector("touch-path") ?? {}, {
      post: "linuxcnc",
    }),
  );
  await choice.selectOption("saved");
  // Back to the program.
  await choice.selectOption("");
  await page.locator("tp-program .code[role=listbox]").waitFor();
  assert.equal(await shown.count(), 0);
  assert.deepEqual(await listed(), now);
});
