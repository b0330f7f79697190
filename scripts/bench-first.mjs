// A first visit over slow lines: the times until its picture appears, until form and program can be read, and until the first key is answered. All connections
// share one line, as on a phone: its bytes per second, and a round trip per request.
import { mkdtempSync, rmSync, symlinkSync, writeFileSync } from "node:fs";
import { connect, createServer } from "node:net";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { Transform } from "node:stream";
import { chromium } from "playwright-core";
import { at, ensureChromium } from "./lib.mjs";
import { addressOf, serve } from "./serve.mjs";

/** Mbit per second, and milliseconds of a round trip. */
const LINES = /** @type {const} */ ([
  [1.6, 150],
  [9, 60],
]);
const ROUNDS = 5;

const server = await serve(0, at("dist", "page"), "127.0.0.1", true);
// Minimal page, as the baseline.
const nothing = mkdtempSync(join(tmpdir(), "touchpath-bench-"));
writeFileSync(
  join(nothing, "index.html"),
  "<!doctype html><title>x</title><p>x</p>",
);
const blankServer = await serve(0, nothing, "127.0.0.1", true);
const peer = await peerPage();
const peerServer = await serve(0, join(peer, "dist"), "127.0.0.1", true);
const launch = (/** @type {string[]} */ ...more) =>
  chromium.launch({
    executablePath: ensureChromium().browser,
    args: ["--no-sandbox", ...more],
  });
const browser = await launch("--disable-gpu");
// The peer draws with WebGL. Without a GPU that runs in software, which delays every other page.
const drawing = await launch(
  "--use-angle=swiftshader",
  "--enable-unsafe-swiftshader",
);

/** Makes the smallest page on which gcode-preview draws the moves of the first job; returns its folder. */
async function peerPage() {
  const { defaultJob, plan } = await import("touchpath");
  const { build } = await import("vite");
  const blocks = plan(defaultJob("internal-rectangle-protected")).moves.map(
    ({ to: [x, y, z] }) => `G1 X${x} Y${y} Z${z} F1000`,
  );
  const folder = mkdtempSync(join(tmpdir(), "touchpath-bench-"));
  symlinkSync(at("node_modules"), join(folder, "node_modules"), "junction");
  const html =
    '<!doctype html><title>x</title><canvas width="800" height="600"></canvas><script type="module" src="main.js"></script>';
  writeFileSync(join(folder, "index.html"), html);
  writeFileSync(
    join(folder, "main.js"),
    `import { WebGLPreview } from "gcode-preview";
const preview = new WebGLPreview({ canvas: document.querySelector("canvas"), renderTravel: true });
preview.processGCode(${JSON.stringify(["G21 G90", ...blocks].join("\n"))});
requestAnimationFrame(() => requestAnimationFrame(() => { globalThis.drawn = performance.now(); }));
`,
  );
  await build({
    root: folder,
    configFile: false,
    logLevel: "error",
    build: { target: "es2022" },
  });
  return folder;
}

/** Time until the peer's page has drawn the moves. @param {string} url */
async function drawn(url) {
  const page = await drawing.newPage({
    viewport: { width: 1440, height: 900 },
  });
  await page.goto(url, { waitUntil: "commit" });
  await page.waitForFunction(
    () => /** @type {any} */ (globalThis).drawn,
    undefined,
    { polling: 20 },
  );
  const time = await page.evaluate(
    () => /** @type {number} */ (/** @type {any} */ (globalThis).drawn),
  );
  await page.close();
  return time;
}

/** A slow line to a server. @param {import("node:http").Server} to @param {number} mbit @param {number} trip */
async function lineOf(to, mbit, trip) {
  const home = new URL(addressOf(to));
  const perMs = (mbit * 1e6) / 8 / 1000;
  const line = { bytes: 0, free: 0, url: "", close: () => {} };
  const wait = (/** @type {number} */ ms) =>
    new Promise((done) => setTimeout(done, ms));
  const slow = () =>
    new Transform({
      async transform(chunk, _, done) {
        for (let i = 0; i < chunk.length; i += 8192) {
          const piece = chunk.subarray(i, i + 8192);
          line.free =
            Math.max(line.free, performance.now()) + piece.length / perMs;
          line.bytes += piece.length;
          await wait(line.free - performance.now());
          this.push(piece);
        }
        done();
      },
    });
  const late = () =>
    new Transform({
      transform(chunk, _, done) {
        setTimeout(() => done(null, chunk), trip);
      },
    });
  const proxy = createServer((near) => {
    const far = connect(Number(home.port), "127.0.0.1");
    near.pipe(late()).pipe(far);
    far.pipe(slow()).pipe(near);
    for (const end of [near, far])
      end.on("error", () => [near, far].map((other) => other.destroy()));
  });
  await new Promise((done) =>
    proxy.listen(0, "127.0.0.1", () => done(undefined)),
  );
  line.url = `http://localhost:${/** @type {import("node:net").AddressInfo} */ (proxy.address()).port}/`;
  line.close = () => proxy.close();
  return line;
}

/**
 * Opens the page for a first visit; returns the milliseconds from its start, and the bytes loaded before the answer. @param {string} url @param {{ bytes:
 * number }} line
 */
async function visit(url, line) {
  const context = await browser.newContext({
    viewport: { width: 1440, height: 900 },
    locale: "en-GB",
  });
  const page = await context.newPage();
  await page.addInitScript(() => {
    const own = /** @type {any} */ (globalThis);
    const look = () => {
      const root = document.querySelector("touch-path")?.shadowRoot;
      const width = /** @type {HTMLInputElement | null} */ (
        root?.getElementById("f-cycle.width1") ?? null
      );
      if (width && !own.read && root?.querySelector(".line")) {
        own.read = performance.now();
        width.value = "91";
        width.dispatchEvent(
          new Event("input", { bubbles: true, composed: true }),
        );
      }
      if (
        root?.querySelector("tp-program")?.textContent?.includes("X47.5") &&
        !own.answered
      )
        own.answered = performance.now();
      if (!own.answered) requestAnimationFrame(look);
    };
    requestAnimationFrame(look);
  });
  line.bytes = 0;
  await page.goto(url, { waitUntil: "commit" });
  await page.waitForFunction(
    () => /** @type {any} */ (globalThis).answered,
    undefined,
    { polling: 20 },
  );
  const { bytes } = line;
  const times = await page.evaluate(() => ({
    picture:
      performance.getEntriesByName("first-contentful-paint")[0]?.startTime ??
      Number.NaN,
    read: /** @type {number} */ (/** @type {any} */ (globalThis).read),
    answered: /** @type {number} */ (/** @type {any} */ (globalThis).answered),
  }));
  await context.close();
  return { ...times, bytes };
}

/** Time until the first paint of an empty page. @param {string} url */
async function empty(url) {
  const page = await browser.newPage();
  await page.goto(url, { waitUntil: "commit" });
  await page.waitForFunction(
    () => performance.getEntriesByName("first-contentful-paint").length > 0,
  );
  const time = await page.evaluate(
    () =>
      performance.getEntriesByName("first-contentful-paint")[0]?.startTime ?? 0,
  );
  await page.close();
  return time;
}

const middle = (/** @type {number[]} */ list) =>
  list.sort((a, b) => a - b)[list.length >> 1] ?? Number.NaN;

console.log(
  "\nA first visit, ms: an empty page painted, picture seen, form and program read, first key answered; kB until then; gcode-preview's smallest page draws the moves",
);
console.log(
  "picture / empty (goal: 1.6), answer / (bytes at the line's speed + 2 round trips) (goals: 1.25 and 1.8), picture / gcode-preview's (goal: 1)",
);
for (const [mbit, trip] of LINES) {
  const [line, blankLine] = [
    await lineOf(server, mbit, trip),
    await lineOf(blankServer, mbit, trip),
  ];
  const peerLine = await lineOf(peerServer, mbit, trip);
  // The first pages of a browser start its processes.
  for (let i = 0; i < 2; i++) {
    await visit(line.url, line);
    await empty(blankLine.url);
    await drawn(peerLine.url);
  }
  /** @type {Awaited<ReturnType<typeof visit>>[]} */
  const visits = [];
  /** @type {number[]} */
  const blank = [];
  /** @type {number[]} */
  const others = [];
  for (let i = 0; i < ROUNDS; i++) {
    blank.push(await empty(blankLine.url));
    visits.push(await visit(line.url, line));
    others.push(await drawn(peerLine.url));
  }
  const of = (/** @type {"picture" | "read" | "answered" | "bytes"} */ key) =>
    middle(visits.map((one) => one[key]));
  const least = of("bytes") / ((mbit * 1e6) / 8000) + 2 * trip;
  const cells = [
    middle(blank),
    of("picture"),
    of("read"),
    of("answered"),
    of("bytes") / 1000,
    middle(others),
  ];
  console.log(
    `${mbit} Mbit/s, ${trip} ms`.padEnd(20),
    ...cells.map((x) => x.toFixed(0).padStart(7)),
    (of("picture") / middle(blank)).toFixed(2).padStart(8),
    (of("answered") / least).toFixed(2).padStart(6),
    (of("picture") / middle(others)).toFixed(2).padStart(6),
  );
  for (const one of [line, blankLine, peerLine]) one.close();
}
await Promise.all([browser.close(), drawing.close()]);
for (const one of [server, blankServer, peerServer]) one.close();
for (const folder of [nothing, peer]) rmSync(folder, { recursive: true });
