// The page in Chromium: the page's own work for a keystroke and a hover until everything is updated, laid out and, in the next frame, drawn. Waiting for that
// frame does not count. Times are wall times, so other load shows: other builds of the page, given as folders, run alternately with this one, and the ratios to
// the first of them count.
import { fileURLToPath } from "node:url";
import { chromium } from "playwright-core";
import { at, ensureChromium } from "./lib.mjs";
import { addressOf, serve } from "./serve.mjs";

/** Twelve bores in a plate, side by side. */
const SET_UP = {
  format: 2,
  control: { post: "linuxcnc" },
  cycles: Array.from({ length: 12 }, (_, k) => ({
    name: `BORE${k + 1}`,
    type: "hole",
    diameter: 20,
    origin: [40 * (k % 4), 40 * Math.floor(k / 4), 0],
  })),
};
/** Cycle type or job, the edited field, and its values. @type {[string | typeof SET_UP, string, number[]][]} */
const KEYS = [
  ["internal-rectangle-protected", "cycle.width1", [80, 81, 82.5]],
  ["double-wall-internal-corner", "cycle.rotation", [0, 5, 10]],
  ["probing-two-circles", "cycle.diameter1", [20, 21, 22.5]],
  [SET_UP, "cycle.diameter", [20, 21, 22.5]],
];
const nameOf = (/** @type {string | typeof SET_UP} */ what) =>
  typeof what === "string" ? what : "set-up of 12 bores";
/** Number of turns, and keys and hovers per turn. The first turn is a warm-up. */
const [TURNS, KEYS_A_TURN, HOVERS_A_TURN] = [6, 30, 40];

/** Opens the page of a folder and counts its work. */
async function opened(
  /** @type {import("playwright-core").Browser} */ browser,
  /** @type {string} */ folder,
) {
  const server = await serve(0, folder);
  // In millimetres, like the values.
  const page = await browser.newPage({
    viewport: { width: 1440, height: 900 },
    locale: "en-GB",
  });
  // Work of the page in its frames, milliseconds.
  await page.addInitScript(() => {
    const own = /** @type {any} */ (globalThis);
    const frame = requestAnimationFrame.bind(globalThis);
    own.inFrames = 0;
    own.nextFrame = frame;
    own.requestAnimationFrame = (/** @type {FrameRequestCallback} */ work) =>
      frame((at) => {
        const start = performance.now();
        work(at);
        own.inFrames += performance.now() - start;
      });
  });
  await page.goto(addressOf(server));
  await page.locator(".line").first().waitFor({ state: "attached" });
  await page.evaluate(
    () => /** @type {any} */ (document.querySelector("touch-path"))?.ready,
  );
  const session = await page.context().newCDPSession(page);
  await session.send("Performance.enable");
  const counts = async () => {
    const { metrics } = await session.send("Performance.getMetrics");
    const of = (/** @type {string} */ name) =>
      metrics.find((one) => one.name === name)?.value ?? Number.NaN;
    return { layouts: of("LayoutCount"), styles: of("RecalcStyleCount") };
  };
  return { folder, page, counts, close: () => server.close() };
}

/** One turn of a page: milliseconds per key and per hover, layouts and style passes per key. Null if the page rejects the job. */
async function turn(
  /** @type {Awaited<ReturnType<typeof opened>>} */ { page, counts },
  /** @type {(typeof KEYS)[number]} */ [type, field, values],
) {
  const act = (
    /** @type {"choose" | "key" | "hover"} */ what,
    /** @type {number} */ count,
  ) =>
    page.evaluate(
      async ([what, count, type, field, values]) => {
        const own = /** @type {any} */ (globalThis);
        const root =
          document.querySelector("touch-path, touchpath-app")?.shadowRoot ??
          document;
        const id = (/** @type {string} */ name) =>
          /** @type {HTMLInputElement} */ (root.getElementById(`f-${name}`));
        const send = (
          /** @type {HTMLElement} */ to,
          /** @type {string} */ event,
        ) =>
          to.dispatchEvent(new Event(event, { bubbles: true, composed: true }));
        const parts = [...root.querySelectorAll("*")].filter(
          (part) => "updateComplete" in part,
        );
        const settled = async () => {
          for (const part of parts)
            await /** @type {any} */ (part).updateComplete;
        };
        if (what === "choose" && typeof type !== "string") {
          const element = /** @type {any} */ (
            document.querySelector("touch-path")
          );
          if (!element || !("job" in element)) return null;
          element.job = type;
          await settled();
        } else if (what === "choose" && id("cycle.type").value !== type) {
          id("cycle.type").value = String(type);
          send(id("cycle.type"), "change");
        }
        const canvas = /** @type {HTMLCanvasElement} */ (
          root.querySelector("tp-picture canvas")
        );
        const box = canvas.getBoundingClientRect();
        const times = [];
        for (let i = 0; i < count; i++) {
          own.inFrames = 0;
          const start = performance.now();
          if (what === "key") {
            const input = id(field);
            input.value = String(values[i % values.length]);
            send(input, "input");
          } else {
            const place = {
              clientX: box.left + box.width * (0.2 + 0.6 * ((i * 0.37) % 1)),
              clientY: box.top + box.height * (0.2 + 0.6 * ((i * 0.61) % 1)),
            };
            const event = {
              ...place,
              pointerId: 1,
              pointerType: "mouse",
              bubbles: true,
            };
            canvas.dispatchEvent(new PointerEvent("pointermove", event));
          }
          await settled();
          document.body.getBoundingClientRect();
          const spent = performance.now() - start;
          // Earlier requests for this frame have run by then.
          await new Promise((done) => own.nextFrame(() => setTimeout(done)));
          times.push(spent + own.inFrames);
        }
        return times;
      },
      /** @type {const} */ ([what, count, type, field, values]),
    );
  if ((await act("choose", 0)) === null) return null;
  await page.waitForTimeout(300);
  const before = await counts();
  const keys = (await act("key", KEYS_A_TURN)) ?? [];
  const after = await counts();
  return {
    keys,
    hovers: (await act("hover", HOVERS_A_TURN)) ?? [],
    // This requests the frame that the page would use anyway.
    layouts: (after.layouts - before.layouts) / KEYS_A_TURN,
    styles: (after.styles - before.styles) / KEYS_A_TURN,
  };
}

const quantile = (/** @type {number[]} */ list, /** @type {number} */ share) =>
  [...list].sort((a, b) => a - b)[Math.floor(list.length * share)] ??
  Number.NaN;

/** Compares this page with others, given as folders. Prints the times; returns, by cycle type, the ratios of a key and a hover to the first other page. */
export async function comparePages(/** @type {string[]} */ ...others) {
  const args = ["--no-sandbox", "--disable-gpu"];
  const browser = await chromium.launch({
    executablePath: ensureChromium().browser,
    args,
  });
  const pages = [];
  for (const folder of [at("dist", "page"), ...others])
    pages.push(await opened(browser, folder));
  console.log(
    "\nThe page, ms: a keystroke p50 p95, layouts and style passes of it, a hover over the picture p50 p95",
  );
  if (pages.length > 1)
    console.log("ratios of p50 to the first other page: keystroke, hover");
  /** @type {Record<string, { key: number, hover: number }>} */
  const ratios = {};
  for (const kind of KEYS) {
    /** @type {NonNullable<Awaited<ReturnType<typeof turn>>>[][]} */
    const turns = pages.map(() => []);
    for (let i = 0; i <= TURNS; i++)
      for (const [k, page] of pages.entries()) {
        const one = await turn(page, kind);
        if (i > 0 && one) turns[k]?.push(one);
      }
    const costs = turns.map((own) => {
      const [keys, hovers] = [
        own.flatMap((one) => one.keys),
        own.flatMap((one) => one.hovers),
      ];
      const mean = (/** @type {"layouts" | "styles"} */ of) =>
        own.reduce((sum, one) => sum + one[of], 0) / own.length;
      return {
        key: quantile(keys, 0.5),
        hover: quantile(hovers, 0.5),
        rest: [
          quantile(keys, 0.95),
          mean("layouts"),
          mean("styles"),
          quantile(hovers, 0.95),
        ],
      };
    });
    const [mine, other] = costs;
    const ratio =
      mine && other
        ? { key: mine.key / other.key, hover: mine.hover / other.hover }
        : null;
    if (ratio) ratios[nameOf(kind[0])] = ratio;
    for (const [k, { key, hover, rest }] of costs.entries()) {
      const [slow = 0, layouts = 0, styles = 0, slowHover = 0] = rest;
      const cells = [key, slow, layouts, styles, hover, slowHover].map((x) =>
        x.toFixed(1).padStart(6),
      );
      const last =
        k === 0 && ratio
          ? [ratio.key, ratio.hover].map((x) => x.toFixed(2).padStart(7))
          : [];
      console.log(
        (k === 0 ? nameOf(kind[0]) : `  ${pages[k]?.folder}`).padEnd(30),
        ...cells,
        ...last,
      );
    }
  }
  await browser.close();
  for (const page of pages) page.close();
  return ratios;
}

if (process.argv[1] === fileURLToPath(import.meta.url))
  await comparePages(...process.argv.slice(2));
