// The event `change`: one event that tells everything, so that no host page keeps a program that its form no longer has.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { EVENTS } from "../../dist/touchpath-element/events.js";
import { at } from "../../scripts/lib.mjs";
import { field, on, open, page, set, setUp } from "./element.mjs";

setUp();

/** A host page that keeps what `change` tells: the program that it would send to a machine, and the reasons in order. */
const KEEP = `
  window.portal = { program: null, reasons: [], plans: [] };
  document.addEventListener("change", ({ target, detail }) => {
    if (target.localName !== "touch-path") return;
    portal.program = detail.plan?.program.text ?? null;
    portal.job = detail.job;
    portal.findings = detail.findings;
    portal.reasons.push(detail.reason);
  });
  document.addEventListener("plan-change", ({ detail }) => portal.plans.push(detail.plan && detail.plan.results.find((row) => row.code === "diameter")?.nominal));
`;
/** @returns {Promise<any>} */
const portal = () => page.evaluate(() => /** @type {any} */ (window).portal);
/** The reasons since the last call. */
const reasons = () =>
  page.evaluate(() => /** @type {any} */ (window).portal.reasons.splice(0));
const hole = (/** @type {number} */ diameter) => ({
  format: 1,
  cycle: { type: "hole", diameter },
});

test("a portal kept the program of an earlier diameter while the form had an error", async () => {
  await open(`<touch-path post="haas"></touch-path>`, KEEP);
  await set("job", hole(44));
  const before = await portal();
  assert.equal(before.program, await on((one) => one.plan.program.text));
  assert.equal(before.job.cycle.diameter, 44);
  assert.deepEqual(before.plans.at(-1), 44);
  // A bore that is narrower than the ball.
  await field("cycle.diameter").fill("2");
  const after = await portal();
  assert.equal(after.program, null);
  assert.equal(after.job.cycle.diameter, 2);
  assert.equal(after.plans.at(-1), null, "plan-change tells it, too");
  assert.ok(
    after.findings.some(
      (/** @type {any} */ finding) => finding.level === "error",
    ),
  );
  await field("cycle.diameter").fill("50");
  assert.deepEqual((await portal()).plans.at(-1), 50);
  // A job that the config refuses has no program either.
  await set("config", {
    format: 1,
    fields: { "cycle.diameter": { max: 60 } },
  });
  await set("job", hole(70));
  const refused = await portal();
  assert.equal(refused.program, null);
  assert.equal(refused.reasons.at(-1), "host");
  assert.ok(
    refused.findings.some(
      (/** @type {any} */ finding) => finding.code === "not-allowed",
    ),
  );
});

test("each change has its reason, and a change that the page only returns has none", async () => {
  await open(`<touch-path cycle="hole"></touch-path>`, KEEP);
  assert.deepEqual(await reasons(), ["host"], "the first job is the page's");
  await set("job", hole(40));
  assert.deepEqual(await reasons(), ["host"]);
  await set("job", await on((element) => element.job));
  assert.deepEqual(await reasons(), []);
  await field("cycle.diameter").fill("41");
  await field("cycle.diameter").blur();
  assert.deepEqual(await reasons(), ["edit"]);
  assert.deepEqual(await on((one) => [one.canUndo, one.canRedo]), [
    true,
    false,
  ]);
  await on((element) => element.undo());
  assert.deepEqual(await reasons(), ["undo"]);
  assert.deepEqual(await on((one) => [one.canUndo, one.canRedo]), [
    false,
    true,
  ]);
  await field("cycle.diameter").press("Control+y");
  assert.deepEqual(await reasons(), ["redo"]);
  await on((element) => element.store.reset());
  assert.deepEqual(await reasons(), ["open"]);
  await on((element) => element.store.take({ ...element.job, name: "B" }, ""));
  assert.deepEqual(await reasons(), ["open"]);
  // The same form, checked by other rules.
  await set("config", { format: 1, allow: { cycles: ["boss"] } });
  assert.deepEqual([...new Set(await reasons())], ["host"]);
});

test("a listener that sets something in the middle of an event: each change keeps its own reason", async () => {
  await open(`<touch-path cycle="hole"></touch-path>`, KEEP);
  await on((element) => {
    // A portal that locks the form, and brings its rules, as soon as the user has changed something.
    element.addEventListener("job-change", () => {
      element.readonly = true;
      element.measured = "";
      element.config = { format: 1, fields: { "feeds.work": { max: 200 } } };
    });
  });
  await reasons();
  await field("cycle.diameter").fill("41");
  const said = await reasons();
  assert.equal(said[0], "edit");
  assert.ok(
    said.slice(1).every((/** @type {string} */ reason) => reason === "host"),
    said.join(),
  );
});

test("what changes nothing fires nothing: an equal config, the same control, a field that is left", async () => {
  await open(`<touch-path cycle="hole"></touch-path>`, KEEP);
  const config = { format: 1, fields: { "feeds.work": { max: 200 } } };
  await set("config", config);
  await field("cycle.diameter").fill("40+1");
  await reasons();
  const { plans } = await portal();
  await set("config", config);
  await set("post", await on((element) => element.post));
  await field("cycle.diameter").blur();
  assert.equal(await field("cycle.diameter").inputValue(), "41");
  assert.deepEqual(await reasons(), []);
  assert.equal((await portal()).plans.length, plans.length);
});

test("findings of a set-up have the paths of the job that is told with them", async () => {
  await open(`<touch-path></touch-path>`, KEEP);
  await set("job", {
    format: 2,
    cycles: [
      { type: "hole", name: "A", diameter: 2 },
      { type: "hole", name: "B", origin: [90, 0, 0] },
    ],
  });
  const { findings } = await portal();
  const paths = findings
    .filter((/** @type {any} */ one) => one.level === "error")
    .map((/** @type {any} */ one) => one.path);
  assert.ok(paths.includes("cycles[0].diameter"), paths.join());
  assert.deepEqual(await on((element) => element.findings), findings);
  await reasons();
  await on((element) => element.store.bringFeature(1));
  assert.deepEqual(await reasons(), []);
});

test("a listener that sets the job in the middle of an event hears the last state last", async () => {
  await open(`<touch-path cycle="hole"></touch-path>`, KEEP);
  await on((element, job) => {
    element.addEventListener("job-change", () => {
      element.job = job;
    });
  }, hole(33));
  await field("cycle.diameter").fill("2");
  const { job, program, plans } = await portal();
  assert.equal(job.cycle.diameter, 33);
  assert.equal(program, await on((element) => element.plan.program.text));
  assert.equal(plans.at(-1), 33);
});

test("history=none leaves undo to the host page", async () => {
  await open(
    `<touch-path cycle="hole" history="none"></touch-path>`,
    `${KEEP} window.keys = []; document.addEventListener("keydown", (event) => event.ctrlKey && event.key !== "Control" && keys.push([event.key, event.defaultPrevented]));`,
  );
  await field("cycle.diameter").fill("41");
  assert.deepEqual(await on((one) => [one.canUndo, one.undo()]), [
    false,
    false,
  ]);
  assert.equal(
    await page.locator('touch-path button[aria-label="Undo"]').count(),
    0,
  );
  await field("cycle.diameter").press("Control+z");
  await field("cycle.diameter").press("Control+y");
  assert.deepEqual(await page.evaluate("keys"), [
    ["z", false],
    ["y", false],
  ]);
  await on((element) => element.removeAttribute("history"));
  await field("cycle.diameter").fill("42");
  assert.equal(await on((element) => element.undo()), true);
});

test("an object that a server wrote as text waits for its property", async () => {
  await open(
    `<touch-path job="[object Object]" config="[object Object]" cycle="boss"></touch-path>`,
    `window.refused = []; document.addEventListener("finding", ({ detail }) => detail.refused && refused.push(detail.findings));`,
  );
  assert.deepEqual(await page.evaluate("refused"), []);
  assert.equal(await on((element) => element.cycle), "boss");
  await set("job", hole(44));
  assert.equal(await on((element) => element.job.cycle.diameter), 44);
  assert.deepEqual(await page.evaluate("refused"), []);
});

test("a job of a million codes is refused before it is copied, as an object and as text", async () => {
  await open(
    `<touch-path cycle="hole"></touch-path>`,
    `window.refused = []; document.addEventListener("finding", ({ detail }) => detail.refused && refused.push(detail.findings[0].code));`,
  );
  await on((element) => {
    const custom = new Array(1e6).fill({ code: 1, value: 2 });
    const job = { format: 1, cycle: { type: "hole", custom } };
    element.job = job;
    // A text of two million characters at most is read at all.
    job.cycle.custom = new Array(5e4).fill({ code: 1, value: 2 });
    element.job = JSON.stringify(job);
    // Few objects, but two to the power of twenty values.
    let deep = /** @type {any} */ ([1, 2]);
    for (let i = 0; i < 20; i++) deep = [deep, deep];
    element.job = { ...job, cycle: { type: "hole", custom: deep } };
  });
  assert.deepEqual(await page.evaluate("refused"), [
    "too-long",
    "too-long",
    "too-long",
  ]);
  assert.deepEqual(await on((element) => element.job.cycle.custom ?? []), []);
});

test("the list of events is that of the element's description", () => {
  const [{ declarations }] = JSON.parse(
    readFileSync(
      at("dist", "touchpath-element", "custom-elements.json"),
      "utf8",
    ),
  ).modules;
  const described = declarations
    .find((/** @type {any} */ one) => one.name === "TouchPath")
    .events.map((/** @type {any} */ event) => event.name);
  assert.deepEqual(
    described.sort(),
    [...EVENTS, "input", "load", "error"].sort(),
  );
});
