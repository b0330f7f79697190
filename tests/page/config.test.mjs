// Choices and changes that a portal's config allows the user of <touch-path>. For values that it fills in and fixes see tests/package/store-config.test.mjs.
import assert from "node:assert/strict";
import { test } from "node:test";
import {
  field,
  heard,
  inner,
  LISTEN,
  on,
  open,
  page,
  set,
  setUp,
} from "./element.mjs";

setUp();

const HALL = {
  format: 1,
  title: "Hall 3",
  allow: {
    cycles: ["hole", "web"],
    controls: ["haas", "fanuc"],
    units: ["mm"],
    workOffsets: [1, 2],
    setUps: false,
  },
  hide: { panels: ["checks"] },
  fields: {
    "feeds.work": {
      value: 100,
      locked: true,
      reason: "the probe was calibrated at it",
    },
    "control.tool": { value: 99, hidden: true },
    "cycle.depth": { value: 7 },
  },
  machines: [
    { name: "VF-2", control: { post: "haas", tool: 25 }, overtravel: 4 },
  ],
  styli: [{ name: "Ball 4", diameter: 4 }],
};
const script = (/** @type {unknown} */ config) =>
  `<script type="application/json">${JSON.stringify(config)}</script>`;
const options = (/** @type {string} */ id) =>
  page
    .locator(`select[id="f-${id}"] option`)
    .evaluateAll((all) => all.map((one) => one.textContent?.trim()));
const errors = () =>
  on((element) =>
    element.findings
      .filter((/** @type {any} */ f) => f.level === "error")
      .map((/** @type {any} */ f) => `${f.code} ${f.path}`),
  );

test("the form offers what the config allows, and begins with what it fills in", async () => {
  await open(`<touch-path>${script(HALL)}</touch-path>`);
  const job = await on((element) => element.job);
  assert.deepEqual(
    [
      job.cycle.type,
      job.cycle.depth,
      job.feeds.work,
      job.control.post,
      job.control.tool,
      job.control.workOffset,
    ],
    ["hole", 7, 100, "haas", 99, 1],
  );
  assert.deepEqual(await errors(), []);
  assert.equal(await on((element) => element.plan.program.post), "haas");
  assert.deepEqual(await options("cycle.type"), ["hole Ø40", "Web"]);
  const machines = await options("control.post");
  assert.deepEqual(machines.slice(0, 1), ["VF-2"]);
  assert.deepEqual(machines.slice(-2), ["Fanuc 30i / 0i-F", "Haas NGC"]);
  assert.equal(machines.length, 3);
  assert.equal(
    (await options("control.workOffset")).length,
    2,
    "two work offsets",
  );
  await page
    .locator(inner("form"))
    .evaluate((/** @type {any} */ form) => form.unfold());
  assert.equal(
    await page.locator(`${inner("form")} input[name="units"]`).count(),
    1,
  );
  assert.equal(await page.locator("#tab-checks").count(), 0);
  assert.equal(
    await page.getByRole("button", { name: "+ Add a feature" }).count(),
    0,
  );
  // The gallery and the list of commands offer no more.
  await page.locator(`${inner("form")} .gallery`).click();
  await page
    .locator(`${inner("gallery")} button[data-type]`)
    .first()
    .waitFor();
  assert.deepEqual(
    await page
      .locator(`${inner("gallery")} button[data-type]`)
      .evaluateAll((all) => all.map((one) => one.dataset.type)),
    ["hole", "web"],
  );
  await page.getByRole("button", { name: "Back to the job" }).click();
  await page.locator(`${inner("bar")} .find`).click();
  await page.locator(`${inner("commands")} input`).fill("control");
  const found = await page
    .locator(`${inner("commands")} li b`)
    .allTextContents();
  assert.ok(
    found.includes("Haas NGC") &&
      !found.some((name) => /LinuxCNC|HEIDENHAIN/.test(name)),
    `${found}`,
  );
  await page.keyboard.press("Escape");
});

test("a fixed field cannot be changed and says why, a hidden one is not there", async () => {
  await open(`<touch-path>${script(HALL)}</touch-path>`);
  await on(
    (element, form) => element.app.querySelector(form).unfold(),
    inner("form"),
  );
  const work = field("feeds.work");
  assert.ok(await work.isDisabled());
  assert.equal(
    await page.locator("fieldset.locked").getAttribute("title"),
    "Fixed by Hall 3: the probe was calibrated at it",
  );
  assert.ok(
    await page
      .locator("p.why")
      .getByText("Fixed by Hall 3: the probe was calibrated at it")
      .isVisible(),
  );
  assert.equal(await field("control.tool").count(), 0);
  assert.ok(await field("feeds.approach").isEnabled());
  // A job of the portal with a wrong value can be corrected.
  await set("job", {
    format: 1,
    cycle: { type: "hole" },
    feeds: { work: 300 },
    control: { post: "heidenhain" },
  });
  assert.deepEqual(await errors(), [
    "not-allowed control.post",
    "locked feeds.work",
  ]);
  assert.equal(await on((element) => element.plan), null);
  assert.ok(
    await page
      .getByText("Hall 3 fixes Work feed at 100 mm/min")
      .first()
      .isVisible(),
  );
  await work.fill("100");
  assert.deepEqual(await errors(), ["not-allowed control.post"]);
  assert.ok(await work.isDisabled(), "it has the value that it must have");
  await page.locator('select[id="f-control.post"]').selectOption("haas");
  assert.deepEqual(await errors(), []);
  assert.ok(await on((element) => element.plan.program.text.length > 100));
});

test("machines and styli of the portal are chosen by name", async () => {
  await open(`<touch-path>${script(HALL)}</touch-path>`);
  await on(
    (element, form) => element.app.querySelector(form).unfold(),
    inner("form"),
  );
  await page
    .locator('select[id="f-control.post"]')
    .selectOption("machine:VF-2");
  assert.deepEqual(
    await on((element) => [
      element.job.control.tool,
      element.job.overtravel,
      element.job.control.workOffset,
    ]),
    [25, 4, 1],
  );
  await page.locator("#f-styli").selectOption({ label: "Ball 4" });
  assert.equal(await on((element) => element.job.stylus.diameter), 4);
  assert.equal(
    await on((element) => element.job.stylus.repeatability),
    0.001,
    "the rest stays",
  );
  await page.getByRole("button", { name: "Undo" }).click();
  assert.equal(await on((element) => element.job.stylus.diameter), 6);
});

test("a path beyond the travel is drawn, and has no program", async () => {
  await open(`<touch-path></touch-path>`, LISTEN);
  await heard();
  const travel = { min: [-20, -20, -100], max: [20, 20, 100] };
  await set("config", { format: 1, space: { travel } });
  assert.ok(
    (await errors()).every(
      (/** @type {string} */ code) => code === "beyond-travel cycle",
    ),
  );
  assert.ok((await errors()).length > 0);
  assert.ok(
    await page
      .getByText(/^No program: .+ beyond the travel/)
      .first()
      .isVisible(),
  );
  assert.equal(await on((element) => element.plan), null);
  const events = await heard();
  assert.ok(
    events.some(([name, detail]) => name === "finding" && !detail.refused) &&
      events.every(([name]) => name !== "job-change"),
  );
  assert.equal(
    await page
      .locator(`form, ${inner("bar")} button.main`)
      .first()
      .isVisible(),
    true,
  );
  await set("config", null);
  assert.deepEqual(await errors(), []);
});

test("a config that is wrong changes nothing, and every fault of it is said", async () => {
  await open(`<touch-path>${script(HALL)}</touch-path>`, LISTEN);
  await heard();
  await set("config", { format: 1, tilte: "A", allow: { cycles: ["well"] } });
  const refused = (await heard()).find(
    ([name, detail]) => name === "finding" && detail.refused,
  )?.[1];
  assert.deepEqual(
    refused.findings.map((/** @type {any} */ f) => `${f.code} ${f.path}`),
    ["unknown-key config.tilte", "unknown-value config.allow.cycles[0]"],
  );
  assert.equal(await on((element) => element.config.title), "Hall 3");
  await set("config", "{");
  assert.equal((await heard()).at(-1)?.[1].findings[0].code, "not-json");
  await on((element) =>
    element.setAttribute("config", '{ "format": 1, "title": "Hall 4" }'),
  );
  assert.equal(await on((element) => element.config.title), "Hall 4");
});

test("what the bar asks can be hidden, and is there again where it must be put right", async () => {
  const fields = {
    units: { hidden: true },
    "control.post": { hidden: true },
    "control.workOffset": { hidden: true },
    "feeds.work": { hidden: true, locked: true, value: 90 },
  };
  await open(
    `<touch-path>${script({ format: 1, allow: { controls: ["haas"] }, fields })}</touch-path>`,
  );
  await on(
    (element, form) => element.app.querySelector(form).unfold(),
    inner("form"),
  );
  const seen = async () => {
    const all = ["control.post", "control.workOffset", "feeds.work"].map(
      (path) => page.locator(`[id="f-${path}"]`).count(),
    );
    return [
      ...(await Promise.all(all)),
      await page.locator(`${inner("bar")} input[name="units"]`).count(),
    ];
  };
  assert.deepEqual(await seen(), [0, 0, 0, 0]);
  await set("job", {
    format: 1,
    cycle: { type: "hole" },
    control: { post: "fanuc" },
    feeds: { work: 80 },
  });
  assert.deepEqual(await seen(), [1, 0, 1, 0]);
});
