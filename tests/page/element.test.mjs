// <touch-path> in a page: jobs in, events and copies out, refusals, and limits of the user.
import assert from "node:assert/strict";
import { test } from "node:test";
import { PICTURE } from "./common.mjs";
import {
  field,
  heard,
  inner,
  LISTEN,
  modules,
  on,
  open,
  page,
  set,
  setUp,
} from "./element.mjs";

setUp();

test("three elements on a page are independent, and one module serves them", async () => {
  await open(`<touch-path cycle="hole"></touch-path><touch-path cycle="groove" post="fanuc" units="inch"></touch-path>
    <touch-path job='{"format":1,"name":"THIRD","cycle":{"type":"internal-rectangle-protected","width1":77}}'></touch-path>`);
  const state = () =>
    page.evaluate(() =>
      [...document.querySelectorAll("touch-path")].map(
        ({ cycle, post, units, job, plan }) => ({
          cycle,
          post,
          units,
          name: job?.name,
          text: plan?.program.text,
        }),
      ),
    );
  const before = await state();
  assert.deepEqual(
    before.map(({ cycle, post, units }) => [cycle, post, units]),
    [
      ["hole", "linuxcnc", "mm"],
      ["groove", "fanuc", "inch"],
      ["internal-rectangle-protected", "linuxcnc", "mm"],
    ],
  );
  assert.equal(before[2]?.name, "THIRD");
  assert.equal(await field("cycle.width1", 2).inputValue(), "77");
  assert.equal(new Set(before.map((one) => one.text)).size, 3);
  assert.equal(modules.length, 1, modules.join());
  await field("cycle.diameter").fill("41");
  const now = await state();
  assert.notEqual(now[0]?.text, before[0]?.text);
  assert.deepEqual(now.slice(1), before.slice(1));
  assert.equal(
    await page.evaluate(() => localStorage.length + sessionStorage.length),
    0,
    "nothing is kept",
  );
});

test("a job comes in as an object or as JSON, and what cannot be used changes nothing", async () => {
  await open("<touch-path></touch-path>", LISTEN);
  const [first] = await heard();
  assert.equal(first?.[0], "plan-change", "the first plan has its event");
  const job = { format: 1, units: "mm", cycle: { type: "boss", diameter: 33 } };
  await set("job", job);
  assert.equal(await field("cycle.diameter").inputValue(), "33");
  const said = await heard();
  assert.ok(
    said.some(
      ([name, { plan }]) => name === "plan-change" && plan.touches.length === 4,
    ),
  );
  assert.ok(
    !said.some(([name]) => name === "job-change"),
    "a job that the page sets is no change by the user",
  );
  // Set again, as a framework does at every rendering.
  await set("job", await on((element) => element.job));
  assert.deepEqual(await heard(), []);
  await on((element) =>
    element.setAttribute(
      "job",
      JSON.stringify({
        ...element.job,
        cycle: { ...element.job.cycle, depth: 7 },
      }),
    ),
  );
  assert.equal(await field("cycle.depth").inputValue(), "7");
  await heard();
  const kept = await on((element) => element.job);
  const bad = [
    "{",
    "[]",
    '"x"',
    "7",
    '{"format":9,"cycle":{"type":"hole"}}',
    '{"format":1,"cycle":{"type":"holes"}}',
  ];
  for (const value of [
    ...bad,
    '{"format":1,"cycle":{"type":"hole","touches":"abc"}}',
    "x".repeat(2_100_000),
  ]) {
    await on((element, value) => element.setAttribute("job", value), value);
    const [[name, detail], ...rest] = /** @type {any} */ (await heard());
    assert.deepEqual(
      [name, detail.refused, detail.findings.length, rest],
      ["finding", true, 1, []],
      value.slice(0, 80),
    );
    assert.match(detail.findings[0].message, /^Nothing was (changed|read)/);
  }
  for (const [input = "", value] of [
    ["cycle", "holes"],
    ["post", "mazatrol"],
    ["units", "cm"],
    ["theme", "drak"],
    ["panels", "form progam"],
    ["storage", "locl"],
  ]) {
    const before = await on((element, input) => element[input], input);
    await set(input, value);
    const [[name, detail], ...rest] = /** @type {any} */ (await heard());
    assert.deepEqual(
      [name, detail.refused, detail.findings[0].code, rest],
      ["finding", true, "unknown-value", []],
      input,
    );
    assert.equal(
      await on((element, input) => element[input], input),
      before,
      `${input} is what it was`,
    );
  }
  await page.evaluate(() => {
    const element = /** @type {any} */ (document.querySelector("touch-path"));
    element.job = {
      format: 1,
      get cycle() {
        throw new Error("no");
      },
    };
    element.job = {
      format: 1,
      cycle: { type: "hole" },
      part: { sizes: () => 7 },
    };
    element.job = null;
    element.job = undefined;
  });
  assert.deepEqual(
    (await heard()).map(([name, { refused }]) => [name, refused]),
    [
      ["finding", true],
      ["finding", true],
    ],
  );
  assert.deepEqual(
    await on((element) => element.job),
    kept,
    "nothing was lost",
  );
});

test("the user's changes have their events, and a program is saved by the page where it cancels the event", async () => {
  await open("<touch-path cycle=hole></touch-path>", LISTEN);
  await heard();
  await field("cycle.diameter").fill("45");
  const said = await heard();
  assert.deepEqual(
    said.map(([name]) => name),
    ["job-change", "plan-change"],
  );
  assert.equal(said[0]?.[1].job.cycle.diameter, 45);
  await field("cycle.diameter").fill("-3");
  const wrong = await heard();
  assert.deepEqual(
    wrong.map(([name]) => name),
    ["job-change", "plan-change", "finding"],
  );
  assert.equal(wrong[1]?.[1].plan, null);
  assert.equal(wrong[2]?.[1].findings[0].path, "cycle.diameter");
  assert.equal(
    await on((element) => element.plan),
    null,
    "a job with an error has no plan",
  );
  await field("cycle.diameter").fill("45");
  await heard();
  const save = page.getByRole("button", { name: /^Save / });
  const [download] = await Promise.all([
    page.waitForEvent("download"),
    save.click(),
  ]);
  assert.equal(download.suggestedFilename(), "BORE-D45.ngc");
  const text = await on((element) => element.plan.program.text);
  assert.deepEqual(await heard(), [
    [
      "program-save",
      { name: "BORE-D45.ngc", text, post: "linuxcnc", extension: "ngc" },
    ],
  ]);
  let saved = 0;
  page.on("download", () => saved++);
  await page.evaluate(() =>
    document.addEventListener("program-save", (event) =>
      event.preventDefault(),
    ),
  );
  await save.click();
  await page.keyboard.press("Control+s");
  assert.equal(
    (await heard()).filter(([name]) => name === "program-save").length,
    2,
  );
  await page.waitForTimeout(200);
  assert.equal(saved, 0);
});

test("readonly: nothing changes the job but the page around, and the program can be saved", async () => {
  await open("<touch-path readonly cycle=hole></touch-path>", LISTEN);
  await heard();
  assert.ok(await field("cycle.diameter").isDisabled());
  assert.ok(await field("cycle.type").isDisabled());
  const kept = await on((element) => element.job);
  await page.locator(`${inner("picture")} ${PICTURE}`).focus();
  await page.keyboard.press("Control+z");
  const canvas = await page
    .locator(`${inner("picture")} ${PICTURE}`)
    .boundingBox();
  assert.ok(canvas);
  // The virtual part's handle is at the feature's origin.
  const spot = await page.evaluate((name) => {
    const picture = /** @type {any} */ (
      document.querySelector("touch-path")?.shadowRoot?.querySelector(name)
    );
    return [
      ...picture.drawing.use((/** @type {any} */ view) => {
        view.grips(true);
        return view.handleSpot("shift");
      }),
    ];
  }, inner("picture"));
  await page.mouse.move(canvas.x + spot[0], canvas.y + spot[1]);
  await page.mouse.down();
  await page.mouse.move(canvas.x + spot[0] + 30, canvas.y + spot[1] + 30);
  await page.mouse.up();
  await page.evaluate(() => {
    const data = new DataTransfer();
    data.items.add(
      new File(['{"format":1,"cycle":{"type":"boss"}}'], "job.json"),
    );
    const target = document
      .querySelector("touch-path")
      ?.shadowRoot?.querySelector("main");
    target?.dispatchEvent(
      new DragEvent("drop", {
        dataTransfer: data,
        bubbles: true,
        cancelable: true,
      }),
    );
  });
  await page.getByText("this job is read-only").waitFor();
  assert.deepEqual(await on((element) => element.job), kept);
  assert.ok(await page.getByRole("button", { name: /^Save / }).isEnabled());
  await set("cycle", "boss");
  assert.equal(
    await on((element) => element.job.cycle.type),
    "boss",
    "the page around may",
  );
  await set("readonly", false);
  await field("cycle.diameter").fill("22");
  assert.equal(await on((element) => element.job.cycle.diameter), 22);
  assert.deepEqual(
    (await heard()).filter(([name]) => name === "job-change").length,
    1,
  );
});

test("a word that is not known was passed over in silence: it is refused, and what was shown stays", async () => {
  await open("<touch-path></touch-path>");
  await page.evaluate(() => {
    const element = document.createElement("touch-path");
    for (const [name, value] of [
      ["panels", "form progam"],
      ["theme", "drak"],
      ["storage", "locl"],
    ])
      element.setAttribute(
        /** @type {string} */ (name),
        /** @type {string} */ (value),
      );
    /** @type {any} */ (window).refused = [];
    element.addEventListener("finding", ({ detail }) => {
      if (detail.refused)
        /** @type {any} */ (window).refused.push(detail.findings[0]?.message);
    });
    document.querySelector("touch-path")?.replaceWith(element);
    return element.ready;
  });
  const said = await page.evaluate(() => /** @type {any} */ (window).refused);
  assert.equal(said.length, 3, said.join("\n"));
  for (const reason of [
    "panels must be some of form, stage",
    "theme must be one of",
    "storage must be one of none, local",
  ])
    assert.ok(said.join("\n").includes(reason), reason);
  assert.ok(
    await page.locator(inner("form")).isVisible(),
    "all is shown, as without the attribute",
  );
  await set("panels", "stage");
  await set("panels", "stage forms");
  assert.ok(
    !(await page.locator(inner("form")).isVisible()) &&
      (await page.locator(inner("picture")).isVisible()),
  );
});

test("another job is another document: the user cannot undo into the one before, and no value of it comes back", async () => {
  await open("<touch-path></touch-path>", LISTEN);
  await set("job", {
    format: 1,
    name: "A",
    cycle: { type: "hole", diameter: 32 },
  });
  await set("job", {
    format: 1,
    name: "B",
    cycle: { type: "boss", diameter: 20 },
  });
  assert.ok(await page.getByRole("button", { name: "Undo" }).isDisabled());
  await page.locator(`${inner("picture")} ${PICTURE}`).focus();
  await page.keyboard.press("Control+z");
  assert.equal(await on((element) => element.job.name), "B");
  await set("cycle", "hole");
  assert.equal(
    await field("cycle.diameter").inputValue(),
    "40",
    "not the 32 of A",
  );
});

test("a host that returns each changed job late does not overwrite what is typed", async () => {
  await open(
    "<touch-path cycle=hole></touch-path>",
    `document.addEventListener("job-change", ({ target, detail }) => setTimeout(() => { target.job = detail.job; }, 120));`,
  );
  await field("cycle.diameter").focus();
  await page.keyboard.press("Control+a");
  await page.keyboard.type("31.25", { delay: 70 });
  await page.waitForFunction(
    () =>
      /** @type {any} */ (document.querySelector("touch-path")).job.cycle
        .diameter === 31.25,
  );
  assert.equal(await field("cycle.diameter").inputValue(), "31.25");
});

test("what is handed out are copies; points stay with their job, and no job is said to change with them", async () => {
  await open("<touch-path cycle=hole readonly></touch-path>", LISTEN);
  // A read-only job accepts a log of the probe, too: its points change no job.
  const log = ["20 0", "0 20", "-20 0", "0 -20"]
    .map((at) => `${at} -10 0 0 0 0 0 0\n`)
    .join("");
  await page.locator("#file").setInputFiles({
    name: "probe.log",
    mimeType: "text/plain",
    buffer: Buffer.from(log),
  });
  await page.getByText("4 measured points were taken from this log").waitFor();
  await on((element) => {
    element.plan.program.text = "M30";
    element.findings.push({});
  });
  assert.match(await on((element) => element.plan.program.text), /M2\n$/);
  await heard();
  await page
    .locator("#measured")
    .fill("17,0,-10\n0,17,-10\n-17,0,-10\n0,-17,-10");
  assert.deepEqual(await heard(), []);
  await on((element) => {
    element.job = { ...element.job, overtravel: 6 };
  });
  assert.match(await page.locator("#measured").inputValue(), /^17,0,-10/);
});

test("the log of a sender gives results, and the block to type with a button that copies it", async () => {
  await open("<touch-path cycle=hole post=grbl></touch-path>");
  // A hole of 40 and a ball of 6 in G55 at X100 Y50 Z-80, 0.5 off in X: contacts at 17 from the centre, where
  // X is 0 at a Y of √(17² − 0.5²) = 16.99264.
  const log = ["117.5,50", "83.5,50", "100,66.99264", "100,33.00736"]
    .map((xy) => `<<< [PRB:${xy},-90:1]\n<<< ok\n`)
    .join("");
  await page.locator("#file").setInputFiles({
    name: "run.log",
    mimeType: "text/plain",
    buffer: Buffer.from(log),
  });
  await page.getByText("4 measured points were taken from this log").waitFor();
  await page.getByText("Type $# and paste the answer").waitFor();
  assert.equal(await page.locator(".block").count(), 0);
  await page.locator("#measured").fill(`G55\nWCO:100,50,-80\n${log}`);
  await page.getByText("Type this before anything moves").waitFor();
  assert.equal(
    await page.locator(".block .code").textContent(),
    "G21 G10 L20 P2 X-0.5 Y0",
  );
  assert.match(
    (await page.locator(".measured").textContent()) ?? "",
    /WCO in line 2: X100 Y50 Z-80 \(mm\)/,
  );
  await page.context().grantPermissions(["clipboard-read", "clipboard-write"]);
  await page.locator(".block").getByRole("button", { name: "Copy" }).click();
  await page.locator(".block").getByText("Copied").waitFor();
  assert.equal(
    await page.evaluate(() => navigator.clipboard.readText()),
    "G21 G10 L20 P2 X-0.5 Y0",
  );
});

test("what a page puts in as undefined is not there: the default stands in, and units convert", async () => {
  await open("<touch-path></touch-path>");
  const state = await on((element) => {
    element.job = {
      format: 1,
      units: undefined,
      stylus: { diameter: 3 },
      cycle: { type: "hole", diameter: 32, depth: undefined },
    };
    const whole = structuredClone(element.job);
    element.units = "inch";
    return {
      units: whole.units,
      keys: Object.values(whole.cycle).includes(undefined),
      diameter: element.job.cycle.diameter,
    };
  });
  assert.deepEqual(state, { units: "mm", keys: false, diameter: 1.259843 });
});

test("a job of thousands of touches held up the page: few of them are listed", async () => {
  await open("<touch-path cycle=hole></touch-path>");
  const rows = await on(async (element, form) => {
    const touches = Array.from({ length: 2000 }, () => ({
      point: [1, 2, 3],
      vector: [1, 0, 0],
    }));
    element.job = { format: 1, cycle: { type: "hole", touches } };
    await element.app.updateComplete;
    await element.shadowRoot.querySelector(form).updateComplete;
    return [
      element.shadowRoot.querySelectorAll(".picks li").length,
      element.findings[0].code,
      element.job.cycle.touches.length,
    ];
  }, inner("form"));
  assert.deepEqual(rows, [50, "too-many-touches", 2000]);
});
