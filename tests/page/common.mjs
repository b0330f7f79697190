// Shared by the page's tests: the served page in Chromium, with every unseen problem as a failure.
import assert from "node:assert/strict";
import { after, afterEach, before, beforeEach } from "node:test";
import { chromium } from "playwright-core";
import { addressOf, serve } from "../../scripts/serve.mjs";

const args = [
  "--no-sandbox",
  "--disable-gpu",
  "--disable-quic",
  "--no-first-run",
  "--disable-background-networking",
  "--disable-component-update",
  "--disable-sync",
];

/** @type {import("node:http").Server} */
let server;
/** @type {import("playwright-core").Browser} */
let browser;
/** @type {import("playwright-core").BrowserContext} */
export let context;
/** @type {import("playwright-core").Page} */
export let page;
/** Exceptions and errors on the console, those of the Content-Security-Policy among them. @type {string[]} */
export let problems = [];

/** Chromium, headless. */
export async function launch() {
  const browser = await chromium.launch({
    executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
    args,
  });
  // A short timeout finds missing elements quickly while tests are written.
  const { PATIENCE } = process.env;
  if (!PATIENCE) return browser;
  const own = browser.newContext.bind(browser);
  browser.newContext = async (options) => {
    const context = await own(options);
    context.setDefaultTimeout(Number(PATIENCE));
    return context;
  };
  return browser;
}

/** The widths that the page is made for, with heights they come with. @type {[number, number][]} */
export const SIZES = [
  [1440, 900],
  [1280, 800],
  [1024, 768],
  [900, 700],
  [720, 900],
  [390, 844],
];

/** Calls that change a page or its browser for good: the next test gets new ones. */
const LASTING = ["addInitScript", "exposeFunction", "install"];
/** Changes that last until they are undone. */
const UNDONE = {
  route: async () => {
    await page.unrouteAll({ behavior: "ignoreErrors" });
    await context.unrouteAll({ behavior: "ignoreErrors" });
  },
  emulateMedia: () =>
    page.emulateMedia({
      media: null,
      colorScheme: null,
      reducedMotion: null,
      forcedColors: null,
    }),
  setViewportSize: () => page.setViewportSize(opened),
  setOffline: () => context.setOffline(false),
  newPage: async () => {
    for (const tab of context.pages()) if (tab !== page) await tab.close();
  },
};
/** Whether the page and its browser are in their initial state. */
let asOpened = false;
/** What the test before has changed. @type {Set<keyof typeof UNDONE>} */
const changed = new Set();
/** Initial size of the page. */
let opened = { width: 1280, height: 800 };

/**
 * For every test of a file the page as a first visit has it; a problem on it fails the test. The browser stays, with what it has compiled: only a test that
 * changes it for good gets another one. Without the service worker, which fetches every file again in the background: only what is asked without a network
 * needs it.
 * @param {{ width: number, height: number }} viewport
 * @param {"allow" | "block"} serviceWorkers
 */
export function setUp(
  viewport = { width: 1280, height: 800 },
  serviceWorkers = "block",
) {
  before(async () => {
    server = await serve(0);
    browser = await launch();
  });
  beforeEach(async () => {
    if (asOpened && serviceWorkers === "block") return forget();
    await open({ viewport, serviceWorkers });
    opened = viewport;
    asOpened = true;
    changed.clear();
    const watch = (
      /** @type {any} */ one,
      /** @type {string} */ name,
      /** @type {() => void} */ note,
    ) => {
      const own = one[name];
      one[name] = (/** @type {unknown[]} */ ...args) => {
        note();
        return own.apply(one, args);
      };
    };
    for (const one of /** @type {any[]} */ ([page, context, page.clock])) {
      for (const name of LASTING.filter((name) => name in one))
        watch(one, name, () => (asOpened = false));
      for (const name of /** @type {(keyof typeof UNDONE)[]} */ (
        Object.keys(UNDONE)
      ).filter((name) => name in one))
        watch(one, name, () => changed.add(name));
    }
  });
  afterEach(() =>
    assert.deepEqual(
      problems,
      [],
      "nothing is complained about on the console",
    ),
  );
  after(async () => {
    await browser?.close();
    server?.close();
  });
}

/** The page of a first visit in the same browser, without the state of the previous test. */
async function forget() {
  const undo = [...changed];
  for (const name of undo) await UNDONE[name]();
  changed.clear();
  await page.mouse.move(0, 0);
  await page.evaluate(() => {
    // The page stores its state when it is left.
    for (const storage of [localStorage, sessionStorage]) storage.clear();
    Storage.prototype.setItem = () => {};
  });
  await page.goto("about:blank");
  problems = [];
  await page.goto(addressOf(server));
  await ready();
  await pocket(page);
}

/**
 * The page in a browser of its own.
 * @param {import("playwright-core").BrowserContextOptions} options
 */
export async function open(options) {
  asOpened = false;
  await context?.close();
  // In regions that measure in inch the first job is in inch: here it is in mm.
  const locale = "en-GB";
  context = await browser.newContext({
    permissions: ["clipboard-read", "clipboard-write"],
    locale,
    serviceWorkers: "block",
    ...options,
  });
  problems = [];
  page = await openTab();
}

/** A message on the console, with the file it is about. */
const complaint = (
  /** @type {import("playwright-core").ConsoleMessage} */ message,
) => `${message.text()} (${message.location().url})`;

/** One more tab of the same browser. */
export async function openTab() {
  const tab = await context.newPage();
  tab.on("pageerror", (error) => problems.push(String(error)));
  tab.on(
    "console",
    (message) =>
      message.type() === "error" && problems.push(complaint(message)),
  );
  await tab.goto(addressOf(server));
  await ready(tab);
  await pocket(tab);
  return tab;
}

/** A cycle that has more to show than the bore of a first visit. Nothing that was done before can be taken back. */
const pocket = (/** @type {import("playwright-core").Page} */ tab) =>
  tab.evaluate(() => {
    const { store } = /** @type {any} */ (document.querySelector("touch-path"));
    store.choose("internal-rectangle-protected");
    store.clear();
  });

/** Waits until the page is shown. */
export async function ready(tab = page) {
  await tab.getByRole("heading", { name: "Touchpath" }).waitFor();
  await tab.locator(`tp-picture ${PICTURE}`).waitFor({ state: "attached" });
  // A first visit is shown before its module is loaded.
  await tab.evaluate(
    () => /** @type {any} */ (document.querySelector("touch-path")).ready,
  );
  await unfold(tab);
}

/** Shows everything that a switch hides: parameters, every group of the form, every line of the program. */
export const unfold = (tab = page) =>
  tab.evaluate(() => {
    const element = /** @type {any} */ (document.querySelector("touch-path"));
    const root = element?.shadowRoot;
    // Includes what only authors of postprocessors need: tests of a setter's view switch it off.
    if (element?.store) element.store.cam = true;
    /** @type {any} */ (root?.querySelector("tp-form"))?.unfold();
    // The results are shown first beside form and picture: most tests need the program.
    const results = root?.querySelector("#tab-results[aria-selected=true]");
    if (results) root.querySelector("#tab-program")?.click();
    const program = /** @type {any} */ (root?.querySelector("tp-program"));
    if (program && !program.everything) program.unfold();
  });

/**
 * Shows a panel of the job: its tab is behind the others where it is shown already. What was measured is beside the results where there is no room for both.
 * @param {"setup" | "results" | "program" | "table" | "measured" | "checks"} name
 * @param {any} tab
 */
export async function panel(name, tab = page) {
  const own = tab.locator(`#tab-${name}`);
  const there = name !== "measured" || (await own.count()) > 0;
  const to = there ? own : tab.locator("#tab-results");
  if ((await to.getAttribute("aria-selected")) !== "true") await to.click();
}

/** Chooses in the menu of what is rarely used. */
export async function more(/** @type {string | RegExp} */ name, tab = page) {
  await tab.getByRole("button", { name: "More" }).click();
  await tab
    .locator("#menu")
    .getByRole("button", { name, exact: name === "Reset" })
    .click();
}

/** Puts the whole form back. */
export const reset = () => more("Reset");

/** Sets a value of the job, as a file or another program would: also one that the page does not offer. */
export const put = (/** @type {string} */ path, /** @type {unknown} */ value) =>
  page.evaluate(
    ([path, value]) =>
      /** @type {any} */ (document.querySelector("touch-path")).store.set(
        path,
        value,
      ),
    /** @type {[string, unknown]} */ ([path, value]),
  );

/** Buttons for undo and redo. */
export const undo = () => page.getByRole("button", { name: "Undo" });
export const redo = () => page.getByRole("button", { name: "Redo" });

/** The primary button. */
export const saveButton = () =>
  page.getByRole("button", { name: /^(Save )?\S+\.(ngc|nc|mpf|h)$/i });

/** A field by its path in the job. */
export const field = (/** @type {string} */ path, tab = page) =>
  tab.locator(`[id="f-${path}"]`);

/** Chooses the units of the job. */
export const chooseUnits = (/** @type {string} */ units) =>
  page.getByRole("radio", { name: units, exact: true }).check();

/** Visible text of a locator. */
export const textOf = async (
  /** @type {import("playwright-core").Locator} */ locator,
) => (await locator.textContent()) ?? "";

/** The visible program. */
export const program = async (tab = page) =>
  (await tab.locator("tp-program .text").allTextContents()).join("\n");

/** Chooses a file with this text. */
export async function openText(
  /** @type {string} */ text,
  name = "job.json",
  tab = page,
) {
  const file = tab.locator("#file");
  await file.setInputFiles({
    name,
    mimeType: "text/plain",
    buffer: Buffer.from(text),
  });
  // The page empties it when the text is read: until then the previous job is shown.
  await settles(async () => (await file.inputValue()) === "", tab);
}

/** The picture, without the canvas over it. */
export const PICTURE = "canvas:not(.over, .mini)";

/** Ends of the dimension lines, in the window. */
export const dimensionLines = () =>
  onView((view, box) =>
    Object.fromEntries(
      view
        .dimensionLines()
        .map((/** @type {any} */ [field, x1, y1, x2, y2]) => [
          field,
          [
            { x: box.x + x1, y: box.y + y1 },
            { x: box.x + x2, y: box.y + y2 },
          ],
        ]),
    ),
  );

/**
 * Asks the page's picture, once it is settled: its View, and the box of its canvas in the window.
 * @param {(view: any, box: { x: number, y: number, width: number, height: number }, arg: any) => unknown} work runs in the page
 * @param {unknown} arg
 * @returns {Promise<any>}
 */
export const onView = (work, arg = null) =>
  steady(() =>
    page.evaluate(`(() => {
      const root = document.querySelector("touch-path").shadowRoot;
      const picture = root.querySelector("tp-picture");
      const box = picture.querySelector("canvas").getBoundingClientRect().toJSON();
      return picture.drawing.use((view) => (${work})(view, box, ${JSON.stringify(arg)}));
    })()`),
  );

/** Waits until a change is drawn: once per frame. */
export const framed = (tab = page) =>
  tab.evaluate(
    () => new Promise((done) => requestAnimationFrame(() => done(null))),
  );

/**
 * A value read from the picture, once two frames in a row give the same: a new
 * job is fitted to the picture one frame after it is chosen.
 * @template T
 * @param {() => Promise<T>} read
 * @returns {Promise<T>}
 */
export async function steady(read) {
  for (let last = ""; ; ) {
    await framed();
    const value = await read();
    const text = JSON.stringify(value);
    if (text === last) return value;
    last = text;
  }
}

/** Drawn pixels of a canvas and its overlay: the number that are not background, and a checksum. */
export const pixels = async () => {
  await framed();
  return page
    .locator(`${PICTURE}:visible`)
    .first()
    .evaluate((node) => {
      let count = 0;
      let sum = 0;
      const over = node.parentElement?.querySelector("canvas.over");
      for (const canvas of /** @type {HTMLCanvasElement[]} */ (
        over ? [node, over] : [node]
      )) {
        const drawn = /** @type {CanvasRenderingContext2D} */ (
          canvas.getContext("2d")
        );
        const data = new Uint32Array(
          drawn.getImageData(0, 0, canvas.width, canvas.height).data.buffer,
        );
        data.forEach((pixel, i) => {
          if (pixel === data[0]) return;
          count++;
          sum = (sum * 31 + i + pixel) % 1_000_000_007;
        });
      }
      return { count, sum };
    });
};

/** Number of pixels of a part's picture with exactly this colour of the theme, and the number of their columns. */
export const painted = async (
  /** @type {string} */ part,
  /** @type {string} */ colour,
) => {
  await framed();
  return page
    .locator(`${part} ${PICTURE}`)
    .first()
    .evaluate((node, colour) => {
      const canvas = /** @type {HTMLCanvasElement} */ (node);
      const probe = document.createElement("i");
      probe.style.color = getComputedStyle(canvas).getPropertyValue(
        `--c-${colour}`,
      );
      canvas.after(probe);
      const wanted = getComputedStyle(probe).color.match(/\d+/g)?.join();
      probe.remove();
      const drawn = /** @type {CanvasRenderingContext2D} */ (
        canvas.getContext("2d")
      );
      const { data, width } = drawn.getImageData(
        0,
        0,
        canvas.width,
        canvas.height,
      );
      const columns = new Set();
      let count = 0;
      for (let i = 0; i < data.length; i += 4) {
        if (`${data[i]},${data[i + 1]},${data[i + 2]}` !== wanted) continue;
        count++;
        columns.add((i / 4) % width);
      }
      return { count, columns: columns.size };
    }, colour);
};

/** Position of a part of the page in the window. */
export async function boxOf(
  /** @type {import("playwright-core").Locator} */ locator,
) {
  const box = await locator.boundingBox();
  assert.ok(box, "it is on the page");
  return box;
}

/** Id of the focused element. */
export const focusedId = () =>
  page.evaluate(
    () =>
      document.querySelector("touch-path")?.shadowRoot?.activeElement?.id ?? "",
  );

/** Until a field holds a text. */
export const until = (/** @type {string} */ path, /** @type {string} */ text) =>
  page.waitForFunction(
    ([id, text]) => {
      const input = document
        .querySelector("touch-path")
        ?.shadowRoot?.getElementById(id ?? "");
      return (
        /** @type {HTMLInputElement | null | undefined} */ (input)?.value ===
        text
      );
    },
    [`f-${path}`, text],
  );

/** The value at a path of the job as the page holds it. */
export const held = (/** @type {string} */ path, tab = page) =>
  tab.evaluate(
    (path) =>
      /** @type {any} */ (document.querySelector("touch-path")).store.get(path),
    path,
  );

/** Waits until a condition holds that no selector expresses. */
export async function settles(
  /** @type {() => Promise<boolean>} */ holds,
  tab = page,
) {
  // As long as the browser's own waits: a page whose processor is busy elsewhere takes seconds.
  for (let i = 0; i < 600; i++) {
    if (await holds()) return;
    await tab.waitForTimeout(50);
  }
  assert.fail("it never holds");
}
