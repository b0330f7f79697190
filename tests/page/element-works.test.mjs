// <touch-path> controlled by the host page: inputs and outputs besides the job, and its interface for form libraries.
import assert from "node:assert/strict";
import { test } from "node:test";
import { panel } from "./common.mjs";
import { field, inner, on, open, page, set, setUp } from "./element.mjs";

setUp();

/** Records the events of the first element, by name, in order. */
const LISTEN = `
  window.said = [];
  const names = ["job-change", "selection-change", "measured-change", "program-save", "input", "change", "load"];
  for (const name of names)
    document.addEventListener(name, (event) => said.push([name, structuredClone(event.detail ?? null)]), name === "load");
`;
/** @returns {Promise<[string, any][]>} */
const said = () =>
  page.evaluate(() => /** @type {any} */ (window).said.splice(0));
const names = async () => (await said()).map(([name]) => name);

test("save, undo, redo, highlight, view, picture and measured points from outside", async () => {
  await open(`<touch-path cycle="hole" view="front"></touch-path>`, LISTEN);
  const { version } = await import("touchpath");
  assert.equal(
    await page.evaluate(
      () => /** @type {any} */ (customElements.get("touch-path")).version,
    ),
    version(),
  );
  assert.ok((await names()).includes("load"));
  const pressed = () =>
    page
      .locator(
        `${inner("picture")} .cube button[aria-pressed="true"], ${inner("picture")} button[aria-pressed="true"]`,
      )
      .first()
      .textContent();
  assert.deepEqual(
    [await on((element) => element.view), await pressed()],
    ["front", "front"],
  );
  await page.getByRole("button", { name: "Side" }).click();
  assert.equal(
    await on((element) => element.view),
    "side",
    "the user has turned it",
  );
  await set("view", "front");
  await page.getByRole("button", { name: "Front", pressed: true }).waitFor();
  // The picture is the visible one.
  const { svg } = await import("touchpath");
  const shown = await on((element) => [element.picture(), element.job]);
  const path = (/** @type {string} */ text) => /<path[^>]*>/.exec(text)?.[0];
  assert.match(shown[0], /^<svg/);
  assert.ok(path(svg(shown[1], "front")) !== undefined);
  // The user's changes can be undone from outside.
  assert.deepEqual(await on((element) => [element.undo(), element.redo()]), [
    false,
    false,
  ]);
  await field("cycle.diameter").fill("33");
  await said();
  assert.equal(await on((element) => element.undo()), true);
  assert.notEqual(await on((element) => element.job.cycle.diameter), 33);
  assert.deepEqual(await names(), ["job-change", "input", "change"]);
  assert.equal(await on((element) => element.redo()), true);
  assert.equal(await on((element) => element.job.cycle.diameter), 33);
  await said();
  // Saved from outside like by the button.
  await page.evaluate(() =>
    document.addEventListener("program-save", (event) =>
      event.preventDefault(),
    ),
  );
  assert.equal(await on((element) => element.save()), true);
  const [[name, saving]] = /** @type {[[string, any]]} */ (await said());
  assert.deepEqual(
    [name, saving.text],
    ["program-save", await on((element) => element.plan.program.text)],
  );
  await field("cycle.diameter").fill("");
  assert.equal(await on((element) => element.save()), false);
  assert.ok(
    (await on((element) => element.picture())).startsWith("<svg"),
    "the last good one",
  );
  await field("cycle.diameter").fill("33");
  // Measured points: from outside without an event, by the user with one.
  await said();
  const points = "29.1,0,-10\n";
  await set("measured", points);
  assert.equal(await on((element) => element.measured), points);
  assert.deepEqual(await names(), []);
  await panel("measured", page);
  await page.locator(`${inner("measured")} textarea`).fill("center.x=0.2");
  const measured = (await said()).find(([name]) => name === "measured-change");
  assert.deepEqual(measured?.[1], { measured: "center.x=0.2" });
  await set("measured", null);
  assert.equal(await on((element) => element.measured), "");
  // A move is highlighted, and an invalid one highlights nothing.
  for (const move of [2, -1, 1e9, 0.5, "x", null]) {
    await on((element, move) => element.highlight(move), move);
    assert.equal(
      await on((element) => element.store.highlight),
      move === 2 ? 2 : null,
      String(move),
    );
  }
});

test("the page hears what the user chooses: a move, its line, its touch, a field", async () => {
  await open(`<touch-path cycle="hole"></touch-path>`, LISTEN);
  await said();
  const { plan } = await on((element) => ({ plan: element.plan }));
  const move = plan.moves.findIndex(
    (/** @type {any} */ one) => one.touch === 1,
  );
  await on((element, move) => element.store.pin(move), move);
  assert.deepEqual((await said()).at(-1), [
    "selection-change",
    { move, line: plan.program.moveLines[move], touch: 1, field: null },
  ]);
  await field("cycle.diameter").click();
  assert.equal(
    (await said()).filter(([name]) => name === "selection-change").at(-1)?.[1]
      .field,
    "cycle.diameter",
  );
  await on((element) => element.store.pin(null));
  assert.equal((await said()).at(-1)?.[1].move, null);
});

test("a control of a form as libraries look for it: value, type, labels, validity, disabled, input and change", async () => {
  await open(
    `<form><label for="p">Probing</label><touch-path id="p" name="probing" cycle="hole"></touch-path></form>`,
    LISTEN,
  );
  const state = () =>
    on((element) => [
      element.type,
      element.labels.length,
      element.validity.valid,
      element.willValidate,
      element.disabled,
      JSON.parse(element.value).cycle.diameter,
    ]);
  const { defaultJob } = await import("touchpath");
  const own = defaultJob("hole").cycle.diameter;
  assert.deepEqual(await state(), ["touch-path", 1, true, true, false, own]);
  await set(
    "value",
    JSON.stringify({ format: 1, cycle: { type: "hole", diameter: 31 } }),
  );
  assert.equal((await state())[5], 31);
  await said();
  // Input and change at every key that changes the job; leaving the field changes nothing.
  await field("cycle.diameter").focus();
  await said();
  await page.keyboard.press("Control+A");
  await page.keyboard.type("32");
  const typed = await names();
  assert.deepEqual(
    typed.filter((name) => name === "input").length,
    typed.filter((name) => name === "job-change").length,
  );
  assert.deepEqual(
    typed.filter((name) => name === "input").length,
    typed.filter((name) => name === "change").length,
  );
  assert.ok(typed.includes("input"));
  await page.keyboard.press("Tab");
  assert.deepEqual(
    (await names()).filter((name) => name === "change" || name === "input"),
    [],
  );
  // A choice fires both together.
  await page.locator('select[id="f-cycle.type"]').selectOption("boss");
  assert.deepEqual(
    (await names()).filter((name) => name === "change" || name === "input"),
    ["input", "change"],
  );
  await field("cycle.diameter").fill("-1");
  assert.deepEqual((await state()).slice(2, 4), [false, true]);
  assert.ok(await on((element) => element.validity.customError));
  await set("disabled", true);
  assert.deepEqual((await state()).slice(3, 5), [false, true]);
  assert.ok(await field("cycle.diameter").isDisabled());
  assert.deepEqual(
    await page.evaluate(() => [
      ...new FormData(
        /** @type {HTMLFormElement} */ (document.querySelector("form")),
      ).keys(),
    ]),
    [],
  );
  await set("disabled", false);
  assert.ok(await field("cycle.diameter").isEnabled());
});

test("of a set-up the form and the events have all cycles, and bringing one into the form changes nothing", async () => {
  await open(
    `<form><touch-path name="probing" cycle="hole"></touch-path></form>`,
    LISTEN,
  );
  await on((element) => element.store.addFeature("web"));
  const sent = () =>
    page.evaluate(() =>
      JSON.parse(
        String(
          new FormData(
            /** @type {HTMLFormElement} */ (document.querySelector("form")),
          ).get("probing"),
        ),
      ),
    );
  assert.equal((await sent()).cycles.length, 2);
  const change = (await said()).find(([name]) => name === "job-change");
  assert.equal(change?.[1].job.cycles.length, 2);
  assert.deepEqual(
    await on((element) => JSON.parse(element.value)),
    await sent(),
  );
  await on((element) => element.store.bringFeature(0));
  assert.ok(!(await names()).includes("job-change"));
  await on((element) => element.store.clearAt(60));
  assert.ok((await names()).includes("job-change"));
  assert.equal((await sent()).clear, 60);
});

test("what is chosen goes with the plan that it was of, and what the page around measured stays", async () => {
  await open(`<touch-path cycle="hole"></touch-path>`, LISTEN);
  await on((element) => element.store.pin(5));
  assert.equal(
    (await said()).filter(([name]) => name === "selection-change").length,
    1,
  );
  await page.locator('select[id="f-cycle.type"]').selectOption("web");
  assert.equal(
    (await said()).filter(([name]) => name === "selection-change").at(-1)?.[1]
      .move,
    null,
  );
  await field("cycle.width").fill("22");
  await set("measured", "1 2 3");
  await said();
  assert.equal(await on((element) => element.undo()), true);
  assert.equal(await on((element) => element.measured), "1 2 3");
  assert.ok(!(await names()).includes("measured-change"));
});

test("boxes in the slots are the page's, words can be taken back, and the view holds without a picture", async () => {
  await open(
    `<touch-path view="isometric" panels="form"><input slot="header" id="own"></touch-path>`,
    LISTEN,
  );
  await said();
  await page.locator("#own").fill("x");
  assert.deepEqual(await names(), ["input"]);
  const picture = () => on((element) => [element.view, element.picture()]);
  const [view, before] = await picture();
  assert.equal(view, "isometric");
  await set("view", "top");
  assert.notEqual((await picture())[1], before);
  await set("view", "isometric");
  await set("panels", null);
  await page
    .locator(`${inner("picture")} button[aria-pressed="true"]`, {
      hasText: "isometric",
    })
    .waitFor();
  assert.equal(await on((element) => element.getAttribute("panels")), null);
  // The picture is the requested one, immediately.
  const sides = await on((element) => {
    const all = [];
    for (const one of ["top", "side"]) {
      element.view = one;
      all.push(element.view, element.picture());
    }
    return all;
  });
  assert.deepEqual([sides[0], sides[2]], ["top", "side"]);
  assert.notEqual(sides[1], sides[3]);
  await set("theme", undefined);
  assert.equal(await on((element) => element.theme), "auto");
});
