// The first visit: the picture of its job is there with the first paint, before the module, and only where it is true.
import assert from "node:assert/strict";
import { test } from "node:test";
import { context, page, ready, setUp } from "./common.mjs";

setUp({ width: 1440, height: 900 });

/** A page of its own that waits for its module until it is let go. */
async function waiting(/** @type {string} */ address, locale = "de-DE") {
  const browser = /** @type {import("playwright-core").Browser} */ (context.browser());
  const own = await browser.newContext({ viewport: { width: 1440, height: 900 }, locale, serviceWorkers: "block" });
  const tab = await own.newPage();
  /** @type {() => void} */
  let go = () => {};
  const held = new Promise((done) => {
    go = () => done(undefined);
  });
  await tab.route(/\.wasm$/, async (route) => {
    await held;
    await route.continue();
  });
  await tab.goto(address, { waitUntil: "domcontentloaded" });
  return { own, tab, go };
}

const seen = (/** @type {import("playwright-core").Page} */ tab) =>
  tab.evaluate(() => [...document.querySelectorAll(".shell svg")].map((svg) => getComputedStyle(svg).display));

test("a first visit sees the picture before the module, where the page then draws it", async () => {
  const { own, tab, go } = await waiting(page.url());
  assert.deepEqual(await seen(tab), ["block", "none"]);
  const ball = await tab.locator(".shell svg.mm circle").first().boundingBox();
  go();
  await tab.locator("tp-picture canvas").first().waitFor();
  assert.equal(await tab.locator(".shell").isVisible(), false, "the page took over");
  const canvas = await tab.locator("tp-picture canvas").first().boundingBox();
  assert.ok(ball && canvas && ball.x > canvas.x && ball.x < canvas.x + canvas.width, "it stood where the canvas is");
  await own.close();
});

test("where people measure in inch it is that of inch", async () => {
  const { own, tab } = await waiting(page.url(), "en-US");
  assert.deepEqual(await seen(tab), ["none", "block"]);
  await own.close();
});

test("with a job in the address, or one that was kept, there is none", async () => {
  const { own, tab, go } = await waiting(`${page.url()}#job=x`);
  assert.deepEqual(await seen(tab), ["none", "none"]);
  go();
  await tab.locator("tp-picture canvas").first().waitFor();
  await tab.evaluate(() => localStorage.setItem("touchpath.job.1", "{}"));
  const again = await own.newPage();
  await again.route(/\.wasm$/, () => {});
  await again.goto(page.url(), { waitUntil: "domcontentloaded" });
  assert.deepEqual(await seen(again), ["none", "none"]);
  await own.close();
  await ready();
});
