// The first visit: the picture of its job is there with the first paint, before the module, and only where it is true.
import assert from "node:assert/strict";
import { test } from "node:test";
import { context, page, ready, setUp } from "./common.mjs";

setUp({ width: 1440, height: 900 });

/** A page of its own that waits for its module, or for what else is named, until it is let go. */
async function waiting(/** @type {string} */ address, locale = "de-DE", held = /\.wasm$/) {
  const browser = /** @type {import("playwright-core").Browser} */ (context.browser());
  const own = await browser.newContext({ viewport: { width: 1440, height: 900 }, locale, serviceWorkers: "block" });
  const tab = await own.newPage();
  /** @type {() => void} */
  let go = () => {};
  const gone = new Promise((done) => {
    go = () => done(undefined);
  });
  await tab.route(held, async (route) => {
    await gone;
    await route.continue();
  });
  await tab.goto(address, { waitUntil: "domcontentloaded" });
  return { own, tab, go };
}

const seen = (/** @type {import("playwright-core").Page} */ tab) =>
  tab.evaluate(() => [...document.querySelectorAll(".shell svg")].map((svg) => getComputedStyle(svg).display));

test("a first visit sees the picture before the page itself, where the page then draws it", async () => {
  const { own, tab, go } = await waiting(page.url(), "de-DE", /\/app-[^/]*$/);
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
  const { own, tab } = await waiting(page.url(), "en-US", /\/app-[^/]*$/);
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

/** What stands in the store of the page. */
const stored = (/** @type {import("playwright-core").Page} */ tab) =>
  tab.evaluate(() => {
    const { store } = /** @type {any} */ (document.querySelector("touch-path"));
    return {
      job: store.job,
      plan: structuredClone(store.plan),
      findings: store.findings,
      name: store.get("control.post"),
    };
  });

test("form, picture and program are read before the module, and are what the module says", async () => {
  for (const locale of ["en-GB", "en-US"]) {
    const { own, tab, go } = await waiting(page.url(), locale);
    await tab.locator("tp-program .line").first().waitFor({ state: "attached" });
    const inch = locale === "en-US";
    assert.equal(await tab.locator("#f-cycle\\.width1").inputValue(), inch ? "3" : "80");
    assert.match(await tab.locator("tp-program").innerText(), inch ? /G38\.2 X1\.\d/ : /G38\.2 X42 Y0 Z-10 F150/);
    assert.equal(await tab.locator(`svg.${inch ? "inch" : "mm"}[slot=picture]`).isVisible(), true);
    const before = await stored(tab);
    const ball = await tab.locator(`svg.${inch ? "inch" : "mm"}[slot=picture]`).boundingBox();
    go();
    await tab.evaluate(() => /** @type {any} */ (document.querySelector("touch-path")).ready);
    assert.equal(await tab.locator("svg[slot=picture]").first().isVisible(), false, "the canvas took over");
    const canvas = await tab.locator("tp-picture canvas").first().boundingBox();
    assert.deepEqual(ball, canvas, "in the same place");
    // The module answers now.
    await tab.evaluate(() => {
      const { store } = /** @type {any} */ (document.querySelector("touch-path"));
      store.changed();
    });
    assert.deepEqual(await stored(tab), before);
    await own.close();
  }
});

test("what is typed, chosen and pressed before the module is there is not lost", async () => {
  const { own, tab, go } = await waiting(page.url(), "en-GB");
  await tab.locator("tp-program .line").first().waitFor({ state: "attached" });
  const width = tab.locator("#f-cycle\\.width1");
  await width.click();
  await width.press("Control+a");
  await width.pressSequentially("91.5");
  await tab.locator("#f-control\\.post").first().selectOption("sinumerik");
  await tab.getByRole("tab", { name: "Results" }).click();
  await tab.evaluate(() => {
    /** @type {any} */ (document.querySelector("touch-path")).measured = "1 2 3";
  });
  assert.equal(await width.inputValue(), "91.5");
  assert.equal((await stored(tab)).job.cycle.width1, 80, "it waits");
  go();
  await tab.evaluate(() => /** @type {any} */ (document.querySelector("touch-path")).ready);
  const { job, plan } = await stored(tab);
  assert.equal(job.cycle.width1, 91.5);
  assert.equal(job.control.post, "sinumerik");
  assert.match(plan.program.text, /MEAS=1 .*X=?47\.75/);
  assert.equal(await tab.getByRole("tab", { name: "Results" }).getAttribute("aria-selected"), "true");
  assert.equal(await tab.evaluate(() => /** @type {any} */ (document.querySelector("touch-path")).measured), "1 2 3");
  await own.close();
});

test("a module that does not come is said, in place of the page that waited for it", async () => {
  const browser = /** @type {import("playwright-core").Browser} */ (context.browser());
  const own = await browser.newContext({ locale: "en-GB", serviceWorkers: "block" });
  const tab = await own.newPage();
  await tab.route(/\.wasm$/, (route) => route.abort());
  await tab.goto(page.url());
  await tab.getByRole("alert").waitFor();
  assert.match(await tab.getByRole("alert").innerText(), /^Touchpath could not be loaded: /);
  await own.close();
});
