// The first visit: the picture of its job is part of the first paint, before the module, and only if it is true.
import assert from "node:assert/strict";
import { test } from "node:test";
import { context, page, ready, settles, setUp } from "./common.mjs";

setUp({ width: 1440, height: 900 });

/** A page that waits for its module, or another file, until it is released. */
async function waiting(
  /** @type {string} */ address,
  locale = "de-DE",
  held = /\.wasm$/,
) {
  const browser = /** @type {import("playwright-core").Browser} */ (
    context.browser()
  );
  const own = await browser.newContext({
    viewport: { width: 1440, height: 900 },
    locale,
    serviceWorkers: "block",
  });
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
  tab.evaluate(() =>
    [...document.querySelectorAll(".shell svg")].map(
      (svg) => getComputedStyle(svg).display,
    ),
  );

test("a first visit sees the picture before the page itself, where the page then draws it", async () => {
  const { own, tab, go } = await waiting(page.url(), "de-DE", /\/app-[^/]*$/);
  assert.deepEqual(await seen(tab), ["block", "none"]);
  const balls = await tab.locator(".shell svg.mm circle").evaluateAll((all) =>
    all.map((one) => {
      const { left, right, top, bottom } = one.getBoundingClientRect();
      return { left, right, top, bottom };
    }),
  );
  go();
  await tab.locator("tp-picture canvas").first().waitFor();
  assert.equal(
    await tab.locator(".shell").isVisible(),
    false,
    "the page took over",
  );
  const canvas = await tab.locator("tp-picture canvas").first().boundingBox();
  assert.ok(canvas);
  const { x, y, width, height } = canvas;
  const ends = [
    Math.min(...balls.map(({ left }) => left)) - x,
    x + width - Math.max(...balls.map(({ right }) => right)),
    Math.min(...balls.map(({ top }) => top)) - y,
    y + height - Math.max(...balls.map(({ bottom }) => bottom)),
  ];
  const [left = 0, right = 0, above = 0, below = 0] = ends;
  assert.ok(
    Math.min(...ends) > 0 &&
      Math.abs(left - right) < width / 10 &&
      Math.abs(above - below) < height / 10,
    `the hole stood in the middle of where the canvas is: ${ends}`,
  );
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

/** The state of the page. */
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
    await tab.locator("tp-results tr").first().waitFor({ state: "attached" });
    const inch = locale === "en-US";
    assert.equal(
      await tab.locator("#f-cycle\\.diameter").inputValue(),
      inch ? "1.6" : "40",
    );
    assert.match(
      await tab.locator("tp-results").innerText(),
      inch ? /1\.6000/ : /40\.000/,
    );
    assert.equal(
      await tab
        .locator(`svg.${inch ? "inch" : "mm"}[slot=picture]`)
        .isVisible(),
      true,
    );
    const before = await stored(tab);
    const ball = await tab
      .locator(`svg.${inch ? "inch" : "mm"}[slot=picture]`)
      .boundingBox();
    go();
    await tab.evaluate(
      () => /** @type {any} */ (document.querySelector("touch-path")).ready,
    );
    assert.equal(
      await tab.locator("svg[slot=picture]").first().isVisible(),
      false,
      "the canvas took over",
    );
    const canvas = await tab.locator("tp-picture canvas").first().boundingBox();
    assert.deepEqual(ball, canvas, "in the same place");
    // The module answers now.
    await tab.evaluate(() => {
      const { store } = /** @type {any} */ (
        document.querySelector("touch-path")
      );
      store.changed();
    });
    assert.deepEqual(await stored(tab), before);
    await own.close();
  }
});

const element = (/** @type {import("playwright-core").Page} */ tab) =>
  tab.evaluate(
    () => /** @type {any} */ (document.querySelector("touch-path")).ready,
  );

test("what is typed before the module is there is not lost, and nothing else can be done until then", async () => {
  const { own, tab, go } = await waiting(page.url(), "en-GB");
  await tab.locator("tp-results tr").first().waitFor({ state: "attached" });
  /** @type {string[]} */
  const saved = [];
  tab.on("download", (download) => saved.push(download.suggestedFilename()));
  const width = tab.locator("#f-cycle\\.diameter");
  await width.click();
  await width.press("Control+a");
  await width.pressSequentially("91.5");
  await width.press("Tab");
  await tab.keyboard.press("Control+a");
  await tab.keyboard.type("44");
  assert.equal(await width.inputValue(), "91.5");
  assert.equal((await stored(tab)).job.cycle.diameter, 40, "it waits");
  // The program is the previous one: it is marked as such, and cannot be saved.
  assert.equal(
    await tab.evaluate(() =>
      /** @type {any} */ (document.querySelector("touch-path")).save(),
    ),
    false,
  );
  await width.press("Control+s");
  await tab.mouse.click(700, 400);
  await tab.keyboard.press("Control+s");
  await tab.getByRole("button", { name: /^Save/ }).first().click();
  await tab.locator("#tab-program").click();
  await tab.evaluate(() => {
    /** @type {any} */ (document.querySelector("touch-path")).measured =
      "1 2 3";
  });
  go();
  await element(tab);
  const { job, plan } = await stored(tab);
  assert.deepEqual([job.cycle.diameter, job.cycle.depth], [91.5, 44]);
  assert.match(plan.program.text, /G38\.2 X47\.75 /);
  assert.equal(
    await tab
      .getByRole("tab", { name: "Program" })
      .getAttribute("aria-selected"),
    "false",
  );
  assert.equal(
    await tab.evaluate(
      () => /** @type {any} */ (document.querySelector("touch-path")).measured,
    ),
    "1 2 3",
  );
  assert.deepEqual(saved, []);
  assert.equal(await tab.locator("touch-path").getAttribute("aria-busy"), null);
  const download = tab.waitForEvent("download");
  await tab.keyboard.press("Control+s");
  assert.equal((await download).suggestedFilename(), "BORE-D91_5.ngc");
  await own.close();
});

test("a job that another tab keeps meanwhile, and a link that is pasted, wait for the module", async () => {
  const { own, tab, go } = await waiting(
    page.url(),
    "en-GB",
    /\.wasm$|\/app-[^/]*$/,
  );
  await tab.evaluate(() => localStorage.setItem("touchpath.job.1", "{}"));
  go();
  await element(tab);
  assert.equal((await stored(tab)).job.cycle.diameter, 40);
  await own.close();
  const link = await page.evaluate(async () => {
    const { store } = /** @type {any} */ (document.querySelector("touch-path"));
    store.set("cycle.width1", 77);
    await navigator.clipboard.writeText("");
    /** @type {any} */ (document.querySelector("touch-path")).app.actions.ask(
      "share",
    );
    for (;;) {
      const text = await navigator.clipboard.readText();
      if (text !== "") return text;
      await new Promise((done) => setTimeout(done, 50));
    }
  });
  const other = await waiting(page.url(), "en-GB");
  await other.tab
    .locator("tp-results tr")
    .first()
    .waitFor({ state: "attached" });
  await other.tab.evaluate((hash) => {
    location.hash = hash;
  }, new URL(link).hash);
  other.go();
  await element(other.tab);
  await other.tab.waitForFunction(
    () =>
      /** @type {any} */ (document.querySelector("touch-path")).store.job.cycle
        .width1 === 77,
  );
  await other.own.close();
});

test("the module comes in two parts: what needs the second one before it is there waits for it", async () => {
  const browser = /** @type {import("playwright-core").Browser} */ (
    context.browser()
  );
  const own = await browser.newContext({
    locale: "en-GB",
    serviceWorkers: "block",
  });
  const tab = await own.newPage();
  /** @type {string[]} */
  const modules = [];
  tab.on("request", (request) => {
    const name = /([a-z_]+)-[\w-]{8}\.wasm$/.exec(request.url())?.[1];
    if (name) modules.push(name);
  });
  /** @type {(() => void)[]} */
  const held = [];
  await tab.route(/\/rest-[^/]+\.wasm$/, async (route) => {
    await new Promise((done) => held.push(() => done(undefined)));
    await route.continue();
  });
  const problems = /** @type {string[]} */ ([]);
  tab.on("pageerror", ({ message }) => problems.push(message));
  await tab.goto(page.url());
  await element(tab);
  const state = () =>
    tab.evaluate(() => {
      const { stale, plan } = /** @type {any} */ (
        document.querySelector("touch-path")
      ).store;
      return [stale, plan.program.post];
    });
  assert.deepEqual(await state(), [false, "linuxcnc"]);
  // The first part has no SINUMERIK.
  const chosen = tab.evaluate(() => {
    const touchpath = /** @type {any} */ (document.querySelector("touch-path"));
    const { job } = touchpath;
    touchpath.job = { ...job, control: { ...job.control, post: "sinumerik" } };
  });
  // It is loaded with the page, and requested once more by a call that cannot wait.
  await settles(async () => held.length > 0);
  const all = setInterval(() => {
    for (const go of held.splice(0)) go();
  }, 50).unref();
  await chosen;
  clearInterval(all);
  assert.deepEqual(await state(), [false, "sinumerik"]);
  assert.deepEqual([...new Set(modules)], ["first", "rest"]);
  assert.deepEqual(problems, []);
  await own.close();
});

test("a module that came on the third attempt lost nothing", async () => {
  const browser = /** @type {import("playwright-core").Browser} */ (
    context.browser()
  );
  const own = await browser.newContext({
    locale: "en-GB",
    serviceWorkers: "block",
  });
  const tab = await own.newPage();
  let attempts = 0;
  await tab.route(/\.wasm$/, (route) =>
    ++attempts < 3 ? route.abort() : route.continue(),
  );
  await tab.goto(page.url());
  await tab.locator("#f-cycle\\.diameter").fill("91");
  await element(tab);
  assert.ok(attempts >= 3);
  assert.equal((await stored(tab)).job.cycle.diameter, 91);
  await own.close();
});

test("without its module the page says so in its place", async () => {
  const browser = /** @type {import("playwright-core").Browser} */ (
    context.browser()
  );
  const own = await browser.newContext({
    locale: "en-GB",
    serviceWorkers: "block",
  });
  const tab = await own.newPage();
  await tab.route(/\.wasm$/, (route) => route.abort());
  await tab.goto(page.url());
  await tab.getByRole("alert").waitFor();
  assert.match(
    await tab.getByRole("alert").innerText(),
    /^Touchpath could not be loaded: /,
  );
  await own.close();
});
