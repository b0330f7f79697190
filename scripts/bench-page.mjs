// The page in Chromium: what a keystroke and a hover cost of its own work, until everything is updated, laid out and, in the next frame, drawn. The
// wait for that frame does not count. Milliseconds of the browser's clock, so a busy machine shows; goals 8 and 2 at p95.
import { chromium } from "playwright-core";
import { ensureChromium } from "./lib.mjs";
import { addressOf, serve } from "./serve.mjs";

const server = await serve(0);
const browser = await chromium.launch({
  executablePath: ensureChromium().browser,
  args: ["--no-sandbox", "--disable-gpu"],
});
// In millimetres, as the values below are.
const page = await browser.newPage({ viewport: { width: 1440, height: 900 }, locale: "en-GB" });
// What the page does in its frames, milliseconds.
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
await page.locator("touch-path .line").first().waitFor({ state: "attached" });

console.log("\nThe page, ms: a keystroke p50 p95, a hover over the picture p50 p95");
for (const [type, field, values] of /** @type {const} */ ([
  ["internal-rectangle-protected", "cycle.width1", [80, 81, 82.5]],
  ["double-wall-internal-corner", "cycle.count1", [2, 3, 4]],
  ["probing-two-circles", "cycle.diameter1", [20, 21, 22.5]],
])) {
  const times = await page.evaluate(
    async ([type, field, values]) => {
      const element = /** @type {any} */ (document.querySelector("touch-path"));
      const root = /** @type {ShadowRoot} */ (element.shadowRoot);
      element.cycle = type;
      // Looked for once: to look through the page again each time would be counted as its own work.
      const parts = () => [...root.querySelectorAll("tp-app, tp-app *")].filter((part) => "updateComplete" in part);
      let waited = parts();
      const settled = async () => {
        for (const part of waited) await /** @type {any} */ (part).updateComplete;
      };
      await settled();
      waited = parts();
      const input = /** @type {HTMLInputElement} */ (root.getElementById(`f-${field}`));
      const canvas = /** @type {HTMLCanvasElement} */ (root.querySelector("tp-picture canvas"));
      const box = canvas.getBoundingClientRect();
      /** @param {() => void} act */
      const time = async (act) => {
        const own = /** @type {any} */ (globalThis);
        own.inFrames = 0;
        const start = performance.now();
        act();
        await settled();
        document.body.getBoundingClientRect();
        const spent = performance.now() - start;
        // Frames that were asked for before this one have been by then.
        await new Promise((done) => own.nextFrame(done));
        return spent + own.inFrames;
      };
      const rounds = async (/** @type {number} */ count, /** @type {(i: number) => void} */ act) => {
        const all = [];
        for (let i = 0; i < count; i++) {
          const ms = await time(() => act(i));
          if (i >= 20) all.push(ms);
        }
        all.sort((a, b) => a - b);
        return [all[Math.floor(all.length * 0.5)], all[Math.floor(all.length * 0.95)]].map(Number);
      };
      const keys = await rounds(120, (i) => {
        input.value = String(values[i % values.length]);
        input.dispatchEvent(new Event("input", { bubbles: true, composed: true }));
      });
      const hovers = await rounds(220, (i) => {
        const at = {
          clientX: box.left + box.width * (0.2 + 0.6 * ((i * 0.37) % 1)),
          clientY: box.top + box.height * (0.2 + 0.6 * ((i * 0.61) % 1)),
        };
        canvas.dispatchEvent(
          new PointerEvent("pointermove", { ...at, pointerId: 1, pointerType: "mouse", bubbles: true }),
        );
      });
      return [...keys, ...hovers];
    },
    /** @type {const} */ ([type, field, values]),
  );
  console.log(`${type.padEnd(30)} ${times.map((ms) => ms.toFixed(1).padStart(6)).join(" ")}`);
}
await browser.close();
server.close();
