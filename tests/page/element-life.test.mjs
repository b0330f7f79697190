// The life cycle of a <touch-path>: set before it is defined, loaded late or never, moved, removed, without leftovers.
import assert from "node:assert/strict";
import { cpSync, rmSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { more } from "./common.mjs";
import {
  field,
  folder,
  inner,
  on,
  open,
  page,
  problems,
  setUp,
  visit,
} from "./element.mjs";

setUp();

test("a property that was set before the class was known is taken up", async () => {
  await open(
    "<touch-path></touch-path>",
    `addEventListener("DOMContentLoaded", () => {}); 
     document.addEventListener("readystatechange", () => { const e = document.querySelector("touch-path"); if (e && !e.constructor.formAssociated) e.job = { format: 1, name: "EARLY", cycle: { type: "web" } }; });`,
  );
  assert.equal(await on((element) => element.job.name), "EARLY");
});

test("put into the page again, an element left a listener behind each time", async () => {
  await open("<touch-path cycle=hole></touch-path>");
  const session = await page.context().newCDPSession(page);
  await session.send("Performance.enable");
  const listeners = async () => {
    await session.send("HeapProfiler.collectGarbage");
    const { metrics } = await session.send("Performance.getMetrics");
    return (
      metrics.find((m) => m.name === "JSEventListeners")?.value ?? Number.NaN
    );
  };
  const again = (/** @type {number} */ count) =>
    page.evaluate(async (count) => {
      const element = /** @type {HTMLElement} */ (
        document.querySelector("touch-path")
      );
      for (let i = 0; i < count; i++) {
        element.remove();
        document.body.append(element);
        await new Promise((done) =>
          requestAnimationFrame(() => requestAnimationFrame(done)),
        );
      }
    }, count);
  await again(5);
  const before = await listeners();
  await again(40);
  const after = await listeners();
  assert.ok(after < before + 20, `${before}, ${after}`);
});

test("200 times into the page and out of it leave nothing behind", async () => {
  await open("<touch-path cycle=hole></touch-path>");
  const session = await page.context().newCDPSession(page);
  await session.send("Performance.enable");
  const measure = async () => {
    await session.send("HeapProfiler.collectGarbage");
    const { metrics } = await session.send("Performance.getMetrics");
    const of = (/** @type {string} */ name) =>
      metrics.find((m) => m.name === name)?.value ?? Number.NaN;
    const memory = await page.evaluate(async () => {
      const { default: init } = await import(
        /* @vite-ignore */ `${location.origin}/touchpath/core/wasm/touchpath.js`
      );
      return (await init()).memory.buffer.byteLength;
    });
    return {
      listeners: of("JSEventListeners"),
      nodes: of("Nodes"),
      heap: of("JSHeapUsedSize"),
      memory,
    };
  };
  const rounds = (/** @type {number} */ count, fresh = true) =>
    page.evaluate(
      async ({ count, fresh }) => {
        const kept = document.createElement("touch-path");
        for (let i = 0; i < count; i++) {
          const element = fresh ? document.createElement("touch-path") : kept;
          document.body.append(element);
          await element.ready;
          await new Promise((done) => requestAnimationFrame(done));
          element.remove();
        }
      },
      { count, fresh },
    );
  await rounds(20);
  const before = await measure();
  await rounds(150);
  await rounds(50, false);
  const now = await measure();
  assert.ok(
    now.listeners <= before.listeners + 10,
    `listeners ${before.listeners}, ${now.listeners}`,
  );
  assert.ok(
    now.nodes <= before.nodes + 200,
    `nodes ${before.nodes}, ${now.nodes}`,
  );
  assert.ok(
    now.heap <= before.heap + 3_000_000,
    `heap ${before.heap}, ${now.heap}`,
  );
  assert.equal(now.memory, before.memory, "the module's memory has not grown");
});

test("moved in the page, an element keeps its job and its steps back", async () => {
  await open(
    "<div><touch-path cycle=hole></touch-path></div><section></section>",
  );
  await field("cycle.diameter").fill("47");
  await page.evaluate(() =>
    document
      .querySelector("section")
      ?.append(/** @type {Node} */ (document.querySelector("touch-path"))),
  );
  assert.equal(await field("cycle.diameter").inputValue(), "47");
  await page.getByRole("button", { name: "Undo" }).click();
  assert.equal(await field("cycle.diameter").inputValue(), "40");
});

test("an element that cannot be loaded says so, and its promise fails", async () => {
  rmSync(join(folder, "broken"), { recursive: true, force: true });
  cpSync(join(folder, "touchpath"), join(folder, "broken"), {
    recursive: true,
  });
  rmSync(join(folder, "broken", "core", "wasm", "touchpath_bg.wasm"));
  writeFileSync(
    join(folder, "broken.html"),
    `<!doctype html><title>x</title><script type="module" src="broken/element/element.js"></script><touch-path></touch-path>`,
  );
  await visit("broken.html");
  await page
    .getByRole("alert")
    .getByText("Touchpath could not be loaded")
    .waitFor();
  const failed = await page.evaluate(async () => {
    try {
      await document.querySelector("touch-path")?.ready;
      return "";
    } catch (thrown) {
      return String(thrown);
    }
  });
  assert.match(failed, /\S/);
});

test("what is set before anything is loaded counts more than the attributes, and a form has it from the start", async () => {
  await open(
    "<form><touch-path name=j cycle=hole post=fanuc></touch-path></form>",
    `window.early = () => Object.fromEntries(new FormData(document.querySelector("form")));
     document.addEventListener("DOMContentLoaded", () => {});
     new MutationObserver(() => {
       const element = document.querySelector("touch-path");
       if (!element || window.was) return;
       window.was = true;
       customElements.whenDefined("touch-path").then(() => {
         element.job = { format: 1, name: "EARLY", cycle: { type: "boss" }, control: { post: "sinumerik" } };
         window.sent = window.early();
       });
     }).observe(document, { childList: true, subtree: true });`,
  );
  assert.deepEqual(
    await on((element) => [element.job.name, element.cycle, element.post]),
    ["EARLY", "boss", "sinumerik"],
  );
  assert.equal(
    JSON.parse(await page.evaluate(() => /** @type {any} */ (window).sent.j))
      .name,
    "EARLY",
  );
});

test("taken out while it loads, and put in again", async () => {
  await open("<section></section>");
  const state = await page.evaluate(async () => {
    const element = document.createElement("touch-path");
    const place = /** @type {Element} */ (document.querySelector("section"));
    place.append(element);
    element.remove();
    await element.ready;
    place.append(element);
    await new Promise((done) => setTimeout(done, 300));
    return {
      lines: element.shadowRoot?.querySelectorAll(".line").length,
      plan: element.plan !== null,
    };
  });
  assert.ok((state.lines ?? 0) > 20 && state.plan, JSON.stringify(state));
});

test("an element whose files did not come is tried again where it is put into the document again", async () => {
  await open("<main></main>");
  await page.route(/\/app\.js$/, (route) => route.abort());
  const ready = () =>
    page.evaluate(async () => {
      const place = /** @type {Element} */ (document.querySelector("main"));
      const element = /** @type {any} */ (
        place.firstElementChild ?? document.createElement("touch-path")
      );
      element.remove();
      place.append(element);
      return element.ready.then(
        () => "shown",
        () => "failed",
      );
    });
  assert.equal(await ready(), "failed");
  assert.deepEqual(problems.splice(0), [
    "Failed to load resource: net::ERR_FAILED",
  ]);
  await page.unroute(/\/app\.js$/);
  assert.equal(await ready(), "shown");
});

test("what was asked for last is shown, however late what was asked for before comes", async () => {
  await open("<main></main>");
  await page.route(/\/gallery\.js$/, async (route) => {
    await new Promise((done) => setTimeout(done, 700));
    await route.continue();
  });
  await page.evaluate(async () => {
    const element = /** @type {any} */ (document.createElement("touch-path"));
    element.style.height = "700px";
    document.querySelector("main")?.append(element);
    await element.ready;
  });
  const coming = page.waitForResponse(/\/gallery\.js$/);
  await page.getByRole("button", { name: "Gallery" }).click();
  await more("Setup sheet to print", page);
  await page.locator(inner("sheet")).waitFor();
  await coming;
  await page.waitForTimeout(200);
  assert.ok(await page.locator(inner("sheet")).isVisible());
  assert.equal(await page.locator(inner("gallery")).count(), 0);
});

test("a name that is set before the element is known is its name", async () => {
  await open(
    "<form></form>",
    `addEventListener("DOMContentLoaded", () => {
      const element = document.createElement("touch-path");
      element.name = "probing";
      document.querySelector("form").append(element);
    });`,
  );
  const sent = await on((element) => [...new FormData(element.form).keys()]);
  assert.deepEqual(sent, ["probing"]);
});
