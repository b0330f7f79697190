// embed.html in a frame: a portal on its list, and pages that are not. Every message is checked against the schema of the package.
import assert from "node:assert/strict";
import {
  cpSync,
  mkdtempSync,
  readFileSync,
  rmSync,
  writeFileSync,
} from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, afterEach, before, test } from "node:test";
import { Ajv2020 } from "ajv/dist/2020.js";
import { at } from "../../scripts/lib.mjs";
import { addressOf, serve } from "../../scripts/serve.mjs";
import { wordsOf } from "../../scripts/words.mjs";
import { site } from "../site.mjs";
import { launch, panel } from "./common.mjs";
import { inner } from "./element.mjs";

/** @type {string} */
let folder;
/** The frame's own server, that of the portal, and one that is not on the list. @type {import("node:http").Server[]} */
let servers = [];
/** @type {import("playwright-core").Browser} */
let browser;
/** @type {import("playwright-core").Page} */
let page;
const origin = (/** @type {number} */ n) =>
  addressOf(/** @type {import("node:http").Server} */ (servers[n])).slice(
    0,
    -1,
  );
const schema = JSON.parse(
  readFileSync(at("www", "package", "frame.schema.json"), "utf8"),
);
const ajv = new Ajv2020({ allowUnionTypes: true }).addSchema(schema);
const isSpoken = (/** @type {string} */ kind, /** @type {unknown} */ message) =>
  assert.ok(
    ajv.validate(`urn:touchpath:frame:1#/$defs/${kind}`, message),
    `${JSON.stringify(message).slice(0, 300)}: ${ajv.errorsText()}`,
  );

/** Permissions of a frame in a sandbox, as in the docs. */
const SANDBOX = "allow-scripts allow-same-origin allow-forms allow-downloads";

before(async () => {
  folder = mkdtempSync(join(tmpdir(), "touchpath-frame-"));
  const own = join(folder, "own");
  site(own);
  const portal = join(folder, "portal");
  cpSync(join(own, "frame.js"), join(portal, "frame.js"));
  cpSync(join(own, "protocol.js"), join(portal, "protocol.js"));
  servers = [
    await serve(0, own),
    await serve(0, portal),
    await serve(0, portal),
  ];
  cpSync(join(own, "embed.html"), join(own, "unconfigured.html"));
  const html = readFileSync(join(own, "embed.html"), "utf8").replace(
    'name="touchpath-origins" content=""',
    `name="touchpath-origins" content="https://portal.example ${origin(1)}"`,
  );
  assert.ok(html.includes(origin(1)));
  writeFileSync(join(own, "embed.html"), html);
  writeFileSync(
    join(portal, "index.html"),
    `<!doctype html><html lang="en"><meta charset="utf-8"><title>Portal</title><iframe width="1200" height="700" src="${origin(0)}/embed.html" title="Probing"></iframe></html>`,
  );
  const index = readFileSync(join(portal, "index.html"), "utf8");
  writeFileSync(
    join(own, "elsewhere.html"),
    "<!doctype html><title>Log in</title>",
  );
  writeFileSync(
    join(portal, "sandboxed.html"),
    index.replace("<iframe ", `<iframe sandbox="${SANDBOX}" `),
  );
  browser = await launch();
});
afterEach(() => page?.close());
after(async () => {
  await browser?.close();
  for (const server of servers) server.close();
  rmSync(folder, { recursive: true });
});

/** A page with the frame in it that records the messages of its window. */
async function open(n = 1, name = "") {
  page = await browser.newPage({ viewport: { width: 1250, height: 760 } });
  await page.addInitScript(() => {
    /** @type {any} */ (window).heard = [];
    addEventListener("message", ({ data }) =>
      /** @type {any} */ (window).heard.push(structuredClone(data)),
    );
  });
  await page.goto(`${origin(n)}/${name}`);
}

/** Connects, with the package's own client. */
const connect = (options = {}) =>
  page.evaluate(
    async (options) => {
      const { connect } = await import(
        /* @vite-ignore */ `${location.origin}/frame.js`
      );
      const iframe = document.querySelector("iframe");
      try {
        const frame = await connect(iframe, options);
        const all = /** @type {any} */ (window);
        all.frame = frame;
        all.told = [];
        for (const type of [
          "change",
          "job-change",
          "plan-change",
          "selection-change",
          "measured-change",
          "program-save",
          "finding",
        ])
          frame.addEventListener(type, (/** @type {CustomEvent} */ event) =>
            all.told.push({ type, detail: event.detail }),
          );
        return frame.version;
      } catch (thrown) {
        return String(thrown);
      }
    },
    { origin: origin(0), ...options },
  );
/** Works with the connected frame; gives what it was answered, or what it failed with. */
const on = (/** @type {string} */ work) =>
  page.evaluate(
    `(async () => { try { return await (${work}) } catch (thrown) { return { failed: String(thrown), findings: thrown.findings } } })()`,
  );
/** What the frame has told since it was asked last, once it has told all of these. */
const told = async (/** @type {string[]} */ ...wanted) => {
  await page.waitForFunction((wanted) => {
    const { told } = /** @type {any} */ (window);
    const types = told.map((/** @type {any} */ one) => one.type);
    return wanted.every((type) => types.includes(type));
  }, wanted);
  return page.evaluate(() => /** @type {any} */ (window).told.splice(0));
};

test("a portal sets the job, reads it, receives its events and saves the program itself", async () => {
  await open();
  const { version } = await import("touchpath");
  assert.equal(await connect({ saves: true }), version());
  const job = {
    format: 1,
    name: "FROM_PORTAL",
    cycle: { type: "boss", diameter: 31 },
  };
  assert.equal(
    await on(
      `frame.set({ job: ${JSON.stringify(job)}, post: "fanuc", theme: "dark", panels: "form stage program" })`,
    ),
    undefined,
  );
  const { plan } = await import("touchpath");
  const state = /** @type {any} */ (await on("frame.get()"));
  isSpoken("answer", { type: "state", id: 1, state });
  assert.equal(state.job.name, "FROM_PORTAL");
  assert.deepEqual(
    state.plan,
    JSON.parse(JSON.stringify(plan(state.job))),
    "the plan is that of the package",
  );
  const heard = await told("plan-change");
  const inside = page.frameLocator("iframe");
  await inside.locator("[id='f-cycle.diameter']").fill("29");
  await inside.getByRole("button", { name: /^Save / }).click();
  const after = await told("job-change", "program-save");
  for (const one of [...heard, ...after]) isSpoken("answer", one);
  const change = after.find(
    (/** @type {any} */ one) => one.type === "job-change",
  );
  assert.equal(change.detail.job.cycle.diameter, 29);
  const whole = after.find((/** @type {any} */ one) => one.type === "change");
  assert.deepEqual(
    [whole.detail.reason, whole.detail.plan.program.text],
    ["edit", plan(change.detail.job).program.text],
  );
  const saved = after.find(
    (/** @type {any} */ one) => one.type === "program-save",
  ).detail;
  assert.deepEqual(
    [saved.name, saved.post, saved.text],
    ["FROM_PORTAL.nc", "fanuc", plan(change.detail.job).program.text],
  );
});

test("a frame tells that there is no program any more, and leaves undo to its portal", async () => {
  await open();
  await connect();
  await on(
    `frame.set({ job: { format: 1, cycle: { type: "hole", diameter: 44 } }, history: "none" })`,
  );
  await told("change");
  await page
    .frameLocator("iframe")
    .locator("[id='f-cycle.diameter']")
    .fill("2");
  const all = await told("change", "plan-change");
  for (const one of all) isSpoken("answer", one);
  const last = all.findLast((/** @type {any} */ one) => one.type === "change");
  assert.equal(last.detail.plan, null);
  assert.equal(last.detail.job.cycle.diameter, 2);
  const state = /** @type {any} */ (await on("frame.get()"));
  isSpoken("answer", { type: "state", id: 1, state });
  assert.deepEqual([state.canUndo, state.canRedo], [false, false]);
});

test("a control that the portal had set was lost with the next job that names none", async () => {
  await open();
  await connect();
  const bore = { format: 1, cycle: { type: "hole" } };
  const state = async (/** @type {string} */ set) => {
    assert.equal(await on(`frame.set(${set})`), undefined);
    const { job, plan, findings } = /** @type {any} */ (
      await on("frame.get()")
    );
    const codes = findings
      .map((/** @type {any} */ f) => f.code)
      .filter((/** @type {string} */ c) => c.startsWith("other-"));
    return [job.control.post, job.units, plan.program.post, ...codes];
  };
  const json = JSON.stringify(bore);
  assert.deepEqual(await state('{ post: "fanuc", units: "inch" }'), [
    "fanuc",
    "inch",
    "fanuc",
  ]);
  assert.deepEqual(await state(`{ job: ${json} }`), ["fanuc", "inch", "fanuc"]);
  assert.deepEqual(await state(`{ job: ${json}, post: "haas" }`), [
    "haas",
    "inch",
    "haas",
  ]);
  const other = JSON.stringify({
    ...bore,
    name: "OTHER",
    units: "mm",
    control: { post: "sinumerik" },
  });
  assert.deepEqual(await state(`{ job: ${other} }`), [
    "sinumerik",
    "mm",
    "sinumerik",
    "other-control",
    "other-units",
  ]);
  assert.deepEqual(await state('{ post: "sinumerik", units: "mm" }'), [
    "sinumerik",
    "mm",
    "sinumerik",
  ]);
  // Inputs set together have no order: the cycle beside a job is its cycle.
  assert.deepEqual(
    await state(`{ job: { format: 1, name: "C" }, cycle: "groove" }`),
    ["sinumerik", "mm", "sinumerik"],
  );
  assert.equal(
    /** @type {any} */ (await on("frame.get()")).job.cycle.type,
    "groove",
  );
});

test("a portal rules, dresses and works the frame: config, appearance, view, save, undo, highlight, picture", async () => {
  await open();
  await connect({ saves: true });
  const config = {
    format: 1,
    title: "Hall 3",
    allow: { controls: ["haas"] },
    fields: { "feeds.work": { value: 90 } },
  };
  const appearance = {
    background: "rgb(1, 2, 3)",
    "on-accent": "rgb(4, 5, 6)",
  };
  const set = {
    config,
    appearance,
    view: "isometric",
    measured: "center.x=0.1",
    job: { format: 1, cycle: { type: "hole" } },
  };
  isSpoken("request", { type: "set", id: 1, state: set });
  assert.equal(await on(`frame.set(${JSON.stringify(set)})`), undefined);
  const state = /** @type {any} */ (await on("frame.get()"));
  isSpoken("answer", { type: "state", id: 1, state });
  assert.deepEqual(
    [state.job.control.post, state.job.feeds.work, state.measured],
    ["haas", 90, "center.x=0.1"],
  );
  const inside = page.frameLocator("iframe");
  const background = inside
    .locator(inner("app"))
    .evaluate((app) => getComputedStyle(app).backgroundColor);
  assert.equal(await background, "rgb(1, 2, 3)");
  await inside
    .locator(`${inner("picture")} button[aria-pressed="true"]`, {
      hasText: "Isometric",
    })
    .waitFor();
  const picture = await on("frame.picture()");
  assert.match(String(picture), /^<svg[\s\S]+<\/svg>\s*$/);
  isSpoken("answer", { type: "picture", id: 1, picture });
  assert.match(
    /** @type {any} */ (await on("frame.undo()")).failed,
    /nothing to undo/,
  );
  await inside.locator("[id='f-cycle.diameter']").fill("29");
  await told();
  assert.equal(await on("frame.undo()"), undefined);
  assert.equal(await on("frame.redo()"), undefined);
  assert.equal(
    /** @type {any} */ (await on("frame.get()")).job.cycle.diameter,
    29,
  );
  assert.equal(await on("frame.highlight(3)"), undefined);
  assert.equal(await on("frame.save()"), undefined);
  await panel("program", inside);
  await inside.locator(".code [data-line], .code .line").last().click();
  const after = await told("job-change", "program-save", "selection-change");
  for (const one of after) isSpoken("answer", one);
  await inside.locator("[id='f-cycle.diameter']").fill("-1");
  assert.match(
    /** @type {any} */ (await on("frame.save()")).failed,
    /no program to save: Diameter must be/,
  );
  for (const [wrong, why] of [
    [{ config: { format: 1, tilte: "A" } }, /config has no "tilte"/],
    [{ appearance: { background: 5 } }, /appearance has texts/],
    [{ appearance: { colour: "red" } }, /appearance has texts/],
    [{ view: "below" }, /view must be one of/],
    [{ measured: 5 }, /measured must be text/],
  ]) {
    const refused = /** @type {any} */ (
      await on(`frame.set(${JSON.stringify(wrong)})`)
    );
    assert.match(refused.failed, /** @type {RegExp} */ (why));
  }
  assert.equal(
    await inside
      .locator(inner("app"))
      .evaluate((app) => getComputedStyle(app).backgroundColor),
    "rgb(1, 2, 3)",
  );
});

test("a frame in a sandbox works with the words of the docs, and saves a file", async () => {
  assert.ok(
    readFileSync(at("docs", "embedding.md"), "utf8").includes(
      `sandbox="${SANDBOX}"`,
    ),
  );
  await open(1, "sandboxed.html");
  assert.match(await connect(), /^\d+\./);
  assert.equal(
    await on(
      'frame.set({ job: { format: 1, name: "BOXED", cycle: { type: "hole" } } })',
    ),
    undefined,
  );
  const download = page.waitForEvent("download");
  assert.equal(await on("frame.save()"), undefined);
  assert.equal((await download).suggestedFilename(), "BOXED.ngc");
});

test("any origin was an origin to connect to: it is refused, and nothing is sent", async () => {
  await open();
  for (const any of [
    "*",
    "/",
    "",
    "null",
    "about:blank",
    "data:text/html,x",
    undefined,
  ]) {
    const heard = await page.evaluate(
      () => /** @type {any} */ (window).heard.length,
    );
    assert.match(
      await connect({ origin: any }),
      /FrameError: .* is no origin: it must be that of the frame/,
      String(any),
    );
    assert.equal(
      await page.evaluate(() => /** @type {any} */ (window).heard.length),
      heard,
    );
  }
  assert.match(
    await connect({ origin: `${origin(0)}/` }),
    /^\d+\./,
    "an address has its origin",
  );
});

test("a portal sets the language, and what is none is refused", async () => {
  await open();
  await connect();
  assert.equal(await on('frame.set({ lang: "de-CH" })'), undefined);
  const tab = page.frameLocator("iframe").locator("#tab-checks");
  await tab.getByText(/** @type {string} */ (wordsOf("de").Checks)).waitFor();
  const refused = /** @type {any} */ (await on('frame.set({ lang: "<b>" })'));
  assert.match(refused.failed, /lang/);
  assert.equal(
    await tab.locator("span").first().textContent(),
    wordsOf("de").Checks,
  );
});

test("what cannot be used is answered with its reasons, and the conversation continues", async () => {
  await open();
  await connect();
  const before = await on("frame.get()");
  for (const [state, reason] of [
    ['{ job: "{" }', /not JSON/],
    ["{ job: { format: 1 } }", /cycle must be an object/],
    ['{ job: "x".repeat(50_000_000) }', /at most/],
    ['{ post: "mazatrol" }', /post must be one of/],
    ["{ colour: 1 }", /nothing to set that is called colour/],
    ['{ theme: "purple" }', /theme must be one of light, dark, auto/],
    ['{ panels: "form lid" }', /panels must be some of form, stage/],
    ['{ readonly: "yes" }', /readonly must be true or false/],
    ["{ job: null }", /the job cannot be used/],
    // Valid inputs beside it are not applied either.
    [
      '{ job: { format: 1, cycle: { type: "boss" } }, post: "mazatrol", panels: "form" }',
      /post must be one of/,
    ],
    [
      '{ cycle: "boss", units: "inch", theme: "dark", lang: "<b>" }',
      /lang must be a BCP 47 tag/,
    ],
    ['{ units: "inch", post: null }', /post must be one of/],
    ["7", /has a state/],
    ["null", /has a state/],
  ]) {
    const { failed } = /** @type {any} */ (await on(`frame.set(${state})`));
    assert.match(
      failed,
      /** @type {RegExp} */ (reason),
      String(state).slice(0, 60),
    );
  }
  // Raw messages that no client sends.
  const answers = await page.evaluate(
    () =>
      new Promise((done) => {
        const { port } = /** @type {any} */ (window).frame;
        /** @type {unknown[]} */
        const all = [];
        port.onmessage = (/** @type {MessageEvent} */ { data }) =>
          all.push(data) === 6 && done(all);
        for (const message of [
          null,
          7,
          "get",
          [],
          { type: "get" },
          { type: "eval", id: 1.5, code: "1" },
        ])
          port.postMessage(message);
      }),
  );
  for (const answer of /** @type {any[]} */ (answers)) {
    assert.equal(answer.type, "error");
    isSpoken("answer", answer);
  }
  await connect();
  assert.deepEqual(await on("frame.get()"), before, "nothing was changed");
});

test("a page that is not on the list is refused, whatever it sends", async () => {
  await open(2);
  assert.match(
    await connect(),
    /FrameError: The frame refuses: http:\/\/localhost:\d+ is not on the list/,
  );
  const heard = await page.evaluate(() => /** @type {any} */ (window).heard);
  assert.ok(heard.length > 0);
  for (const message of heard) isSpoken("refused", message);
  // Without the client: no port is answered, and nothing changes.
  const silent = await page.evaluate(async (origin) => {
    const frame = document.querySelector("iframe")?.contentWindow;
    const channel = new MessageChannel();
    let answers = 0;
    channel.port1.onmessage = () => answers++;
    frame?.postMessage({ touchpath: 1, type: "hello", saves: true }, origin, [
      channel.port2,
    ]);
    for (const message of [
      { type: "set", id: 1, state: { cycle: "boss" } },
      { touchpath: 1, type: "set", state: {} },
      null,
      "x",
      7,
    ]) {
      frame?.postMessage(message, origin);
      channel.port1.postMessage(message);
    }
    await new Promise((done) => setTimeout(done, 500));
    return answers;
  }, origin(0));
  assert.equal(silent, 0);
  assert.match(
    await page
      .frameLocator("iframe")
      .locator("[id='f-cycle.type']")
      .inputValue(),
    /^internal-rectangle/,
  );
});

test("a frame without a list of origins refuses every page; another version of the protocol is refused", async () => {
  await open();
  await connect();
  const refused = await page.evaluate(
    (origin) =>
      new Promise((done) => {
        addEventListener("message", ({ data }) => done(data), { once: true });
        const { port2 } = new MessageChannel();
        document
          .querySelector("iframe")
          ?.contentWindow?.postMessage(
            { touchpath: 2, type: "hello", saves: false },
            origin,
            [port2],
          );
      }),
    origin(0),
  );
  isSpoken("refused", refused);
  assert.match(/** @type {any} */ (refused).reason, /version 1/);
  // As in the package: the list is empty.
  await page.evaluate(
    (src) => {
      const iframe = /** @type {HTMLIFrameElement} */ (
        document.querySelector("iframe")
      );
      return new Promise((done) => {
        iframe.onload = done;
        iframe.src = src;
      });
    },
    `${origin(0)}/unconfigured.html`,
  );
  assert.match(await connect(), /The frame refuses: .* is not on the list/);
  const wrong = await connect({ origin: origin(2), patience: 1200 });
  assert.match(
    wrong,
    /does not answer/,
    "what is said reaches no other origin",
  );
  assert.match(await connect({ origin: "not an origin" }), /is no origin/);
  await page.evaluate(() => document.querySelector("iframe")?.remove());
  assert.match(
    await connect(),
    /FrameError: connect takes the iframe/,
    "null was taken for a wrong origin",
  );
});

test("a portal that leaves, or gives up, leaves nothing dead behind; what is asked of it fails", async () => {
  await open();
  await connect({ saves: true });
  const late = await on("(frame.close(), frame.get())");
  assert.match(/** @type {any} */ (late).failed, /is closed/);
  const inside = page.frameLocator("iframe");
  const save = inside.getByRole("button", { name: /^Save / });
  const [download] = await Promise.all([
    page.waitForEvent("download"),
    save.click(),
  ]);
  assert.equal(
    download.suggestedFilename(),
    "POCKET-80X50.ngc",
    "the frame hands programs out by itself again",
  );
  await connect({ saves: true });
  await page.evaluate(() =>
    Object.assign(window, { first: /** @type {any} */ (window).frame }),
  );
  await connect({ saves: true });
  assert.match(
    /** @type {any} */ (
      await on(
        "(await new Promise((done) => setTimeout(done, 200)), first.get())",
      )
    ).failed,
    /is closed/,
  );
  assert.equal(
    /** @type {any} */ (await on("frame.get()")).job.name,
    "POCKET-80X50",
  );
});

test("a frame that is loaded anew keeps its listeners, and has back what was set and typed", async () => {
  await open();
  await connect({ saves: true });
  await on(
    `frame.addEventListener("load", (event) => told.push({ type: "load", detail: event.detail }))`,
  );
  const job = {
    format: 1,
    name: "KEPT",
    cycle: { type: "boss", diameter: 31 },
  };
  const appearance = { accent: "rgb(10, 20, 30)" };
  await on(
    `frame.set(${JSON.stringify({ job, post: "haas", panels: "form program", appearance })})`,
  );
  const inside = page.frameLocator("iframe");
  await inside.locator("[id='f-cycle.diameter']").fill("28");
  await inside.locator("[id='f-cycle.depth']").fill("x");
  await page.waitForFunction(() =>
    JSON.stringify(/** @type {any} */ (window).told).includes('"depth":"x"'),
  );
  await told();
  // Requests during the load wait for it.
  await on(
    `document.querySelector("iframe").addEventListener("load", () => { window.during = frame.get(); })`,
  );
  const frames = page
    .frames()
    .find((frame) => frame.url().includes("embed.html"));
  await frames?.evaluate(() => location.reload()).catch(() => undefined);
  await page.waitForFunction(
    () => /** @type {any} */ (window).during !== undefined,
  );
  const state = /** @type {any} */ (await on("during"));
  assert.deepEqual(
    [
      state.job.name,
      state.job.control.post,
      state.job.cycle.diameter,
      state.job.cycle.depth,
    ],
    ["KEPT", "haas", 28, "x"],
  );
  assert.deepEqual(
    (await told()).filter((/** @type {any} */ one) => one.type === "load"),
    [{ type: "load", detail: { refused: null } }],
  );
  assert.equal(
    await inside
      .locator("touch-path")
      .evaluate((one) => one.style.getPropertyValue("--touchpath-accent")),
    appearance.accent,
  );
  await inside.locator("[id='f-cycle.depth']").fill("12");
  await inside.getByRole("button", { name: /^Save / }).click();
  const saved = (await told("program-save")).find(
    (/** @type {any} */ one) => one.type === "program-save",
  ).detail;
  assert.equal(saved.name, "KEPT.nc", "the portal still saves by itself");
  // With another page first, such as a login: the last page gets the messages.
  await frames
    ?.evaluate((name) => location.assign(name), `${origin(0)}/elsewhere.html`)
    .catch(() => undefined);
  await page.waitForTimeout(1300);
  const elsewhere = page
    .frames()
    .find((frame) => frame.url().includes("elsewhere.html"));
  await elsewhere
    ?.evaluate((name) => location.assign(name), `${origin(0)}/embed.html`)
    .catch(() => undefined);
  await page.waitForFunction(() =>
    /** @type {any} */ (window).told.some(
      (/** @type {any} */ one) => one.type === "load",
    ),
  );
  await page.waitForTimeout(700);
  assert.equal(/** @type {any} */ (await on("frame.get()")).job.name, "KEPT");
  assert.deepEqual(
    (await told()).filter((/** @type {any} */ one) => one.type === "load"),
    [{ type: "load", detail: { refused: null } }],
  );
  // Another page in its place answers nothing, and a closed connection does not return.
  await on("(frame.close(), 0)");
  await frames?.evaluate(() => location.reload()).catch(() => undefined);
  assert.match(
    /** @type {any} */ (await on("frame.get()")).failed,
    /is closed/,
  );
});

test("a frame that was taken out answers nothing: what is asked of it fails", async () => {
  await open();
  await connect({ patience: 5000 });
  await page.evaluate(() => document.querySelector("iframe")?.remove());
  assert.match(
    /** @type {any} */ (await on("frame.get()")).failed,
    /The frame does not answer/,
  );
});

test("a frame whose module cannot be loaded says so at once", async () => {
  const wasm = join(folder, "own", "core", "wasm", "touchpath_bg.wasm");
  const kept = readFileSync(wasm);
  rmSync(wasm);
  try {
    await open();
    assert.match(await connect(), /FrameError: .*\S/);
    assert.doesNotMatch(await connect(), /does not answer/);
  } finally {
    writeFileSync(wasm, kept);
  }
});
