// <touch-path> in a page of somebody else's: the package's files in a folder, and nothing between them and the browser.
import assert from "node:assert/strict";
import { cpSync, mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, afterEach, before, test } from "node:test";
import { at } from "../../scripts/lib.mjs";
import { addressOf, serve } from "../../scripts/serve.mjs";
import { wordsOf } from "../../scripts/words.mjs";
import { launch, PICTURE } from "./common.mjs";

/** @import {} from "../../www/element.ts" */

/** @type {string} */
let folder;
/** @type {import("node:http").Server} */
let server;
/** @type {import("playwright-core").Browser} */
let browser;
/** @type {import("playwright-core").Page} */
let page;
/** What went wrong unseen. @type {string[]} */
let problems = [];
/** The modules that were loaded. @type {string[]} */
let modules = [];

const POLICY =
  "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self'; connect-src 'self'; require-trusted-types-for 'script'; trusted-types lit-html";

before(async () => {
  folder = mkdtempSync(join(tmpdir(), "touchpath-element-"));
  cpSync(at("dist"), join(folder, "touchpath"), {
    recursive: true,
    filter: (source) => !source.startsWith(at("dist", "page")),
  });
  server = await serve(0, folder);
  browser = await launch();
});
afterEach(async () => {
  await page?.close();
  assert.deepEqual(problems, [], "nothing is complained about on the console");
});
after(async () => {
  await browser?.close();
  server?.close();
  rmSync(folder, { recursive: true });
});

/** Opens a page with this body; every element of it is loaded. */
async function open(/** @type {string} */ body, script = "") {
  writeFileSync(join(folder, "page.css"), "html, body { height: 100%; margin: 0 } touch-path { height: 650px }");
  writeFileSync(join(folder, "page.js"), script);
  writeFileSync(
    join(folder, "page.html"),
    `<!doctype html><html lang="en"><meta charset="utf-8"><meta http-equiv="Content-Security-Policy" content="${POLICY}"><title>Host</title>
<link rel="stylesheet" href="page.css"><script src="page.js"></script><script type="module" src="touchpath/element/element.js"></script>${body}</html>`,
  );
  problems = [];
  modules = [];
  page = await browser.newPage({ viewport: { width: 1300, height: 900 } });
  page.on("pageerror", (error) => problems.push(String(error)));
  page.on("console", (message) => message.type() === "error" && problems.push(message.text()));
  page.on("request", (request) => request.url().endsWith(".wasm") && modules.push(request.url()));
  await page.goto(`${addressOf(server)}page.html`);
  await loaded();
}

const loaded = () =>
  page.evaluate(async () => {
    await customElements.whenDefined("touch-path");
    await Promise.all([...document.querySelectorAll("touch-path")].map((one) => one.ready));
  });

/**
 * Works with the first element of the page.
 * @param {(element: any, arg?: any) => unknown} work
 * @param {unknown} arg
 * @returns {Promise<any>}
 */
const on = (work, arg = null) =>
  page.evaluate(`(${work})(document.querySelector("touch-path"), ${JSON.stringify(arg)})`);
/** Sets a property of it. */
const set = (/** @type {string} */ name, /** @type {unknown} */ value) =>
  page.evaluate(
    ([name, value]) =>
      void Object.assign(/** @type {object} */ (document.querySelector("touch-path")), { [String(name)]: value }),
    [name, value],
  );

/** Keeps the events of the first element, by name. */
const LISTEN = `
  window.heard = [];
  const own = ["job-change", "plan-change", "program-save", "finding"];
  for (const name of own) document.addEventListener(name, (event) => heard.push([name, structuredClone(event.detail)]));
`;
/** @returns {Promise<[string, any][]>} */
const heard = () => page.evaluate(() => /** @type {any} */ (window).heard.splice(0));
const field = (/** @type {string} */ path, n = 0) => page.locator("touch-path").nth(n).locator(`[id="f-${path}"]`);

test("three elements on a page are independent, and one module serves them", async () => {
  await open(`<touch-path cycle="hole"></touch-path><touch-path cycle="groove" post="fanuc" units="inch"></touch-path>
    <touch-path job='{"format":1,"name":"THIRD","cycle":{"type":"internal-rectangle-protected","width1":77}}'></touch-path>`);
  const state = () =>
    page.evaluate(() =>
      [...document.querySelectorAll("touch-path")].map(({ cycle, post, units, job, plan }) => ({
        cycle,
        post,
        units,
        name: job?.name,
        text: plan?.program.text,
      })),
    );
  const before = await state();
  assert.deepEqual(
    before.map(({ cycle, post, units }) => [cycle, post, units]),
    [
      ["hole", "linuxcnc", "mm"],
      ["groove", "fanuc", "inch"],
      ["internal-rectangle-protected", "linuxcnc", "mm"],
    ],
  );
  assert.equal(before[2]?.name, "THIRD");
  assert.equal(await field("cycle.width1", 2).inputValue(), "77");
  assert.equal(new Set(before.map((one) => one.text)).size, 3);
  assert.equal(modules.length, 1, modules.join());
  await field("cycle.diameter").fill("41");
  const now = await state();
  assert.notEqual(now[0]?.text, before[0]?.text);
  assert.deepEqual(now.slice(1), before.slice(1));
  assert.equal(await page.evaluate(() => localStorage.length + sessionStorage.length), 0, "nothing is kept");
});

test("a job comes in as an object or as JSON, and what cannot be used changes nothing", async () => {
  await open("<touch-path></touch-path>", LISTEN);
  const [first] = await heard();
  assert.equal(first?.[0], "plan-change", "the first plan has its event");
  const job = { format: 1, units: "mm", cycle: { type: "boss", diameter: 33 } };
  await set("job", job);
  assert.equal(await field("cycle.diameter").inputValue(), "33");
  const said = await heard();
  assert.ok(said.some(([name, { plan }]) => name === "plan-change" && plan.touches.length === 4));
  assert.ok(!said.some(([name]) => name === "job-change"), "a job that the page sets is no change by the user");
  // The same again, as a framework does with every rendering.
  await set("job", await on((element) => element.job));
  assert.deepEqual(await heard(), []);
  await on((element) =>
    element.setAttribute("job", JSON.stringify({ ...element.job, cycle: { ...element.job.cycle, depth: 7 } })),
  );
  assert.equal(await field("cycle.depth").inputValue(), "7");
  await heard();
  const kept = await on((element) => element.job);
  const bad = ["{", "[]", '"x"', "7", '{"format":9,"cycle":{"type":"hole"}}', '{"format":1,"cycle":{"type":"holes"}}'];
  for (const value of [...bad, '{"format":1,"cycle":{"type":"hole","touches":"abc"}}', "x".repeat(2_100_000)]) {
    await on((element, value) => element.setAttribute("job", value), value);
    const [[name, detail], ...rest] = /** @type {any} */ (await heard());
    assert.deepEqual(
      [name, detail.refused, detail.findings.length, rest],
      ["finding", true, 1, []],
      value.slice(0, 80),
    );
    assert.match(detail.findings[0].message, /^Nothing was (changed|read)/);
  }
  for (const [input = "", value] of [
    ["cycle", "holes"],
    ["post", "mazak"],
    ["units", "cm"],
    ["theme", "drak"],
    ["panels", "form progam"],
    ["storage", "locl"],
  ]) {
    const before = await on((element, input) => element[input], input);
    await set(input, value);
    const [[name, detail], ...rest] = /** @type {any} */ (await heard());
    assert.deepEqual(
      [name, detail.refused, detail.findings[0].code, rest],
      ["finding", true, "unknown-value", []],
      input,
    );
    assert.equal(await on((element, input) => element[input], input), before, `${input} is what it was`);
  }
  await page.evaluate(() => {
    const element = /** @type {any} */ (document.querySelector("touch-path"));
    element.job = {
      format: 1,
      get cycle() {
        throw new Error("no");
      },
    };
    element.job = { format: 1, cycle: { type: "hole" }, part: { sizes: () => 7 } };
    element.job = null;
    element.job = undefined;
  });
  assert.deepEqual(
    (await heard()).map(([name, { refused }]) => [name, refused]),
    [
      ["finding", true],
      ["finding", true],
    ],
  );
  assert.deepEqual(await on((element) => element.job), kept, "nothing was lost");
});

test("a property that was set before the class was known is taken up", async () => {
  await open(
    "<touch-path></touch-path>",
    `addEventListener("DOMContentLoaded", () => {}); 
     document.addEventListener("readystatechange", () => { const e = document.querySelector("touch-path"); if (e && !e.constructor.formAssociated) e.job = { format: 1, name: "EARLY", cycle: { type: "web" } }; });`,
  );
  assert.equal(await on((element) => element.job.name), "EARLY");
});

test("the user's changes have their events, and a program is saved by the page where it cancels the event", async () => {
  await open("<touch-path cycle=hole></touch-path>", LISTEN);
  await heard();
  await field("cycle.diameter").fill("45");
  const said = await heard();
  assert.deepEqual(
    said.map(([name]) => name),
    ["job-change", "plan-change"],
  );
  assert.equal(said[0]?.[1].job.cycle.diameter, 45);
  await field("cycle.diameter").fill("-3");
  const wrong = await heard();
  assert.deepEqual(
    wrong.map(([name]) => name),
    ["job-change", "finding"],
  );
  assert.equal(wrong[1]?.[1].findings[0].path, "cycle.diameter");
  assert.equal(await on((element) => element.plan), null, "a job with an error has no plan");
  await field("cycle.diameter").fill("45");
  await heard();
  const save = page.getByRole("button", { name: /^Save / });
  const [download] = await Promise.all([page.waitForEvent("download"), save.click()]);
  assert.equal(download.suggestedFilename(), "BORE-D45.ngc");
  const text = await on((element) => element.plan.program.text);
  assert.deepEqual(await heard(), [
    ["program-save", { name: "BORE-D45.ngc", text, post: "linuxcnc", extension: "ngc" }],
  ]);
  let saved = 0;
  page.on("download", () => saved++);
  await page.evaluate(() => document.addEventListener("program-save", (event) => event.preventDefault()));
  await save.click();
  await page.keyboard.press("Control+s");
  assert.equal((await heard()).filter(([name]) => name === "program-save").length, 2);
  await page.waitForTimeout(200);
  assert.equal(saved, 0);
});

test("readonly: nothing changes the job but the page around, and the program can be saved", async () => {
  await open("<touch-path readonly cycle=hole></touch-path>", LISTEN);
  await heard();
  assert.ok(await field("cycle.diameter").isDisabled());
  assert.ok(await field("cycle.type").isDisabled());
  const kept = await on((element) => element.job);
  await page.locator(`tp-picture ${PICTURE}`).focus();
  await page.keyboard.press("Control+z");
  const canvas = await page.locator(`tp-picture ${PICTURE}`).boundingBox();
  assert.ok(canvas);
  // The virtual part's handle stands at the feature's own origin.
  const spot = await page.evaluate(() => {
    const picture = /** @type {any} */ (document.querySelector("touch-path")?.shadowRoot?.querySelector("tp-picture"));
    return [...picture.drawing.use((/** @type {any} */ view) => view.handleSpot("shift"))];
  });
  await page.mouse.move(canvas.x + spot[0], canvas.y + spot[1]);
  await page.mouse.down();
  await page.mouse.move(canvas.x + spot[0] + 30, canvas.y + spot[1] + 30);
  await page.mouse.up();
  await page.evaluate(() => {
    const data = new DataTransfer();
    data.items.add(new File(['{"format":1,"cycle":{"type":"boss"}}'], "job.json"));
    const target = document.querySelector("touch-path")?.shadowRoot?.querySelector("main");
    target?.dispatchEvent(new DragEvent("drop", { dataTransfer: data, bubbles: true, cancelable: true }));
  });
  await page.getByText("this job is read-only").waitFor();
  assert.deepEqual(await on((element) => element.job), kept);
  assert.ok(await page.getByRole("button", { name: /^Save / }).isEnabled());
  await set("cycle", "boss");
  assert.equal(await on((element) => element.job.cycle.type), "boss", "the page around may");
  await set("readonly", false);
  await field("cycle.diameter").fill("22");
  assert.equal(await on((element) => element.job.cycle.diameter), 22);
  assert.deepEqual((await heard()).filter(([name]) => name === "job-change").length, 1);
});

test("a word that is not known was passed over in silence: it is refused, and what was shown stays", async () => {
  await open("<touch-path></touch-path>");
  await page.evaluate(() => {
    const element = document.createElement("touch-path");
    for (const [name, value] of [
      ["panels", "form progam"],
      ["theme", "drak"],
      ["storage", "locl"],
    ])
      element.setAttribute(/** @type {string} */ (name), /** @type {string} */ (value));
    /** @type {any} */ (window).refused = [];
    element.addEventListener("finding", ({ detail }) => {
      if (detail.refused) /** @type {any} */ (window).refused.push(detail.findings[0]?.message);
    });
    document.querySelector("touch-path")?.replaceWith(element);
    return element.ready;
  });
  const said = await page.evaluate(() => /** @type {any} */ (window).refused);
  assert.equal(said.length, 3, said.join("\n"));
  for (const reason of [
    "panels must be some of form, stage",
    "theme must be one of",
    "storage must be one of none, local",
  ])
    assert.ok(said.join("\n").includes(reason), reason);
  assert.ok(await page.locator("tp-form").isVisible(), "all is shown, as without the attribute");
  await set("panels", "stage");
  await set("panels", "stage forms");
  assert.ok(!(await page.locator("tp-form").isVisible()) && (await page.locator("tp-picture").isVisible()));
});

test("panels, theme, slots, parts and custom properties", async () => {
  await open(
    `<touch-path panels="stage program" theme="dark"><p>later</p><b slot="header">Our portal</b><i slot="footer">by us</i></touch-path>`,
  );
  const shown = (/** @type {string} */ what) => page.locator(what).isVisible();
  assert.ok((await shown("tp-picture")) && (await shown("tp-program")));
  for (const gone of ["tp-form", "tp-table", "tp-results", "tp-checks", ".tabs", "h1"])
    assert.ok(!(await shown(gone)), gone);
  assert.ok((await page.getByText("Our portal").isVisible()) && (await page.getByText("by us").isVisible()));
  assert.ok(!(await page.getByText("later").isVisible()), "what stood there until now is gone");
  const background = () => page.locator("tp-app").evaluate((app) => getComputedStyle(app).backgroundColor);
  assert.equal(await background(), "rgb(18, 23, 29)");
  await set("theme", "light");
  assert.equal(await background(), "rgb(255, 255, 255)");
  await set("theme", "auto");
  await page.emulateMedia({ colorScheme: "dark" });
  // The browser takes the scheme up with its next frame.
  await page.waitForFunction(() => matchMedia("(prefers-color-scheme: dark)").matches);
  await page.evaluate(() => new Promise(requestAnimationFrame));
  assert.equal(await background(), "rgb(18, 23, 29)");
  await page.addStyleTag({ url: `${addressOf(server)}own.css` }).catch(() => undefined);
  problems = [];
  await on((element) => element.style.setProperty("--touchpath-background", "rgb(1, 2, 3)"));
  assert.equal(await background(), "rgb(1, 2, 3)");
  await page.evaluate(() => {
    const sheet = new CSSStyleSheet();
    sheet.replaceSync("touch-path::part(bar) { background: rgb(9, 9, 9) }");
    document.adoptedStyleSheets = [sheet];
  });
  const bar = await page.locator("header").evaluate((node) => getComputedStyle(node).backgroundColor);
  assert.equal(bar, "rgb(9, 9, 9)");
  // Every choice of panels fills the element, at every width.
  for (const width of [1300, 800, 390]) {
    await page.setViewportSize({ width, height: 700 });
    for (const panels of [
      "form",
      "stage",
      "program",
      "results checks",
      "form stage",
      "form program table",
      "stage table",
    ]) {
      await set("panels", panels);
      await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
      const sizes = await page
        .locator("main > :not([hidden])")
        .evaluateAll((all) => all.map((one) => [one.className, one.clientWidth, one.clientHeight]));
      assert.ok(sizes.length > 0, panels);
      for (const [name, wide, high] of sizes)
        assert.ok(Number(wide) > 200 && Number(high) > 25, `${panels} at ${width}: ${name} is ${wide} × ${high}`);
      const empty = await page.locator("main").evaluate((main) => {
        const feet = [...main.children].map((one) => one.getBoundingClientRect().bottom);
        return main.getBoundingClientRect().bottom - Math.max(...feet);
      });
      assert.ok(empty < 6, `${panels} at ${width}: ${empty} px are empty at the foot`);
    }
  }
});

test("a form gets the job and its validity, and puts it back", async () => {
  await open(
    `<form><touch-path name="probing" cycle="hole"></touch-path><fieldset disabled><touch-path name="off"></touch-path></fieldset></form>`,
  );
  const sent = () =>
    page.evaluate(() => {
      const form = /** @type {HTMLFormElement} */ (document.querySelector("form"));
      return { valid: form.checkValidity(), data: Object.fromEntries(new FormData(form)) };
    });
  const before = await sent();
  assert.deepEqual([before.valid, Object.keys(before.data)], [true, ["probing"]]);
  assert.equal(JSON.parse(String(before.data.probing)).cycle.type, "hole");
  await field("cycle.diameter").fill("0");
  assert.equal((await sent()).valid, false);
  assert.match(String(await on((element) => element.validationMessage)), /\S/);
  assert.ok(await field("cycle.type", 1).isDisabled(), "the form's own switch is heard");
  await page.evaluate(() => document.querySelector("form")?.reset());
  const after = await sent();
  assert.deepEqual(JSON.parse(String(after.data.probing)), JSON.parse(String(before.data.probing)));
  assert.ok(after.valid);
});

/** The control and the units of every element of the page, of its job and of its program, and which of the findings speak of them. */
const asked = () =>
  page.evaluate(() =>
    [...document.querySelectorAll("touch-path")].map(({ post, units, plan, findings }) => [
      post,
      units,
      plan?.program.post,
      plan && (/\bG20\b/.test(plan.program.text) ? "inch" : "mm"),
      ...findings
        .filter(({ code }) => code.startsWith("other-"))
        .map(({ code, level, path }) => [code, level, path].join()),
    ]),
  );
const BORE = { format: 1, name: "BORE", cycle: { type: "hole", diameter: 2 } };

test("a control and units that the page asks for were lost with the first job that names none", async () => {
  const bore = JSON.stringify(BORE);
  await open(
    `<touch-path post="fanuc" units="inch"></touch-path><touch-path post="fanuc" units="inch" job='${bore}'></touch-path><touch-path job='${bore}' units="inch" post="fanuc"></touch-path>`,
    LISTEN,
  );
  await set("job", BORE);
  await page.evaluate(async (job) => {
    for (const [first, second] of [
      ["post", "job"],
      ["job", "post"],
    ]) {
      const element = document.createElement("touch-path");
      for (const name of [first, second, "units"])
        Object.assign(element, { [String(name)]: { job, post: "fanuc", units: "inch" }[String(name)] });
      document.body.append(element);
      await element.ready;
    }
  }, BORE);
  // 2 inch, as a job in inch has it.
  assert.deepEqual(await asked(), Array(5).fill(["fanuc", "inch", "fanuc", "inch"]));
  const sizes = await page.evaluate(() =>
    [...document.querySelectorAll("touch-path")].map(({ job }) => job?.cycle.type === "hole" && job.cycle.diameter),
  );
  // In which units the job is read depends on what was asked for before it: set after it, units convert.
  assert.deepEqual(sizes, [2, 2, 2, 2, 2]);
  // Every door through which a job comes in.
  const file = (/** @type {string} */ name, /** @type {string} */ text) =>
    page
      .locator("touch-path")
      .first()
      .locator("#file")
      .setInputFiles({ name, mimeType: "text/plain", buffer: Buffer.from(text) });
  await file("web.json", '{"format":1,"cycle":{"type":"web"}}');
  await page.waitForFunction(() => document.querySelector("touch-path")?.cycle === "web");
  assert.deepEqual((await asked())[0], ["fanuc", "inch", "fanuc", "inch"]);
  await on((element) => element.store.reset());
  assert.deepEqual((await asked())[0], ["fanuc", "inch", "fanuc", "inch"], "the defaults");
  const { defaultJob, exportTable } = await import("touchpath");
  await file("dump.txt", exportTable(defaultJob("groove"), "text"));
  await page.waitForFunction(() => document.querySelector("touch-path")?.cycle === "groove");
  // A dump is read in mm.
  assert.deepEqual((await asked())[0], ["fanuc", "mm", "fanuc", "mm", "other-units,warning,units"]);
  await set("job", { format: 1, units: "inch", cycle: { type: "boss" }, control: { workOffset: 2 } });
  assert.deepEqual((await asked())[0], ["fanuc", "inch", "fanuc", "inch"]);
  assert.equal(await on((element) => element.job.control.workOffset), 2);
});

test("a job that names another control than the page asks for says so, to the user and to the page", async () => {
  await open('<touch-path post="fanuc" units="mm"></touch-path>', LISTEN);
  await heard();
  await set("job", { ...BORE, units: "inch", control: { post: "linuxcnc" } });
  const both = ["other-control,warning,control.post", "other-units,warning,units"];
  assert.deepEqual((await asked())[0], ["linuxcnc", "inch", "linuxcnc", "inch", ...both]);
  const event = (await heard()).findLast(([name]) => name === "finding");
  assert.deepEqual(
    event?.[1].findings
      .filter((/** @type {any} */ f) => f.code.startsWith("other-"))
      .map((/** @type {any} */ f) => f.message),
    [
      `The page around asks for ${await title("fanuc")}, and this job names LinuxCNC: the program is for LinuxCNC`,
      "The page around asks for mm, and this job is in inch: the program is in inch",
    ],
  );
  await page.locator("#tab-checks").click();
  await page.getByText("this job names LinuxCNC").first().waitFor();
  // Asked for again, it is taken: the job changes.
  await set("post", "fanuc");
  await set("units", "mm");
  assert.deepEqual((await asked())[0], ["fanuc", "mm", "fanuc", "mm"]);
  assert.equal(await on((element) => element.job.cycle.diameter), 50.8, "the part is the same");
  // The user's choice is a job that names another one, too, and goes with the attribute.
  await field("control.post").selectOption("haas");
  assert.deepEqual((await asked())[0]?.slice(2), ["haas", "mm", both[0]]);
  await on((element) => element.removeAttribute("post"));
  assert.deepEqual((await asked())[0]?.slice(2), ["haas", "mm"]);
  const later = { format: 1, cycle: { type: "hole" } };
  await set("job", { ...later, name: "LATER" });
  assert.deepEqual((await asked())[0]?.slice(2), ["linuxcnc", "mm"], "nothing is asked for any more");
  await set("post", "mazak");
  await set("job", { ...later, name: "LAST" });
  assert.deepEqual((await asked())[0]?.slice(2), ["linuxcnc", "mm"], "what is not known is not asked for");
});

test("a cycle that the control does not take made a program for another control: it has an error", async () => {
  await open('<touch-path post="heidenhain" cycle="hole"></touch-path>');
  const state = () =>
    on((element) => [
      element.post,
      element.plan,
      element.findings.map((/** @type {any} */ f) => f.code).includes("form-unsupported"),
    ]);
  assert.deepEqual(await state(), ["heidenhain", null, true]);
  await field("cycle.type").selectOption("probing-two-circles");
  assert.deepEqual(await on((element) => [element.post, element.plan.program.post]), ["heidenhain", "heidenhain"]);
  await field("cycle.type").selectOption("boss");
  assert.deepEqual(await state(), ["heidenhain", null, true]);
});

/** The title of a control. */
async function title(/** @type {string} */ id) {
  const { catalog } = await import("touchpath");
  return String(catalog().posts.find((post) => post.id === id)?.title);
}

test("put into the page again, an element left a listener behind each time", async () => {
  await open("<touch-path cycle=hole></touch-path>");
  const session = await page.context().newCDPSession(page);
  await session.send("Performance.enable");
  const listeners = async () => {
    await session.send("HeapProfiler.collectGarbage");
    const { metrics } = await session.send("Performance.getMetrics");
    return metrics.find((m) => m.name === "JSEventListeners")?.value ?? Number.NaN;
  };
  const again = (/** @type {number} */ count) =>
    page.evaluate(async (count) => {
      const element = /** @type {HTMLElement} */ (document.querySelector("touch-path"));
      for (let i = 0; i < count; i++) {
        element.remove();
        document.body.append(element);
        await new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)));
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
    const of = (/** @type {string} */ name) => metrics.find((m) => m.name === name)?.value ?? Number.NaN;
    const memory = await page.evaluate(async () => {
      const { default: init } = await import(/* @vite-ignore */ `${location.origin}/touchpath/wasm/touchpath.js`);
      return (await init()).memory.buffer.byteLength;
    });
    return { listeners: of("JSEventListeners"), nodes: of("Nodes"), heap: of("JSHeapUsedSize"), memory };
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
  assert.ok(now.listeners <= before.listeners + 10, `listeners ${before.listeners}, ${now.listeners}`);
  assert.ok(now.nodes <= before.nodes + 200, `nodes ${before.nodes}, ${now.nodes}`);
  assert.ok(now.heap <= before.heap + 3_000_000, `heap ${before.heap}, ${now.heap}`);
  assert.equal(now.memory, before.memory, "the module's memory has not grown");
});

test("moved in the page, an element keeps its job and its steps back", async () => {
  await open("<div><touch-path cycle=hole></touch-path></div><section></section>");
  await field("cycle.diameter").fill("47");
  await page.evaluate(() =>
    document.querySelector("section")?.append(/** @type {Node} */ (document.querySelector("touch-path"))),
  );
  assert.equal(await field("cycle.diameter").inputValue(), "47");
  await page.getByRole("button", { name: "Undo" }).click();
  assert.equal(await field("cycle.diameter").inputValue(), "40");
});

test("an element that cannot be loaded says so, and its promise fails", async () => {
  rmSync(join(folder, "broken"), { recursive: true, force: true });
  cpSync(join(folder, "touchpath"), join(folder, "broken"), { recursive: true });
  rmSync(join(folder, "broken", "wasm", "touchpath_bg.wasm"));
  writeFileSync(
    join(folder, "broken.html"),
    `<!doctype html><title>x</title><script type="module" src="broken/element/element.js"></script><touch-path></touch-path>`,
  );
  page = await browser.newPage();
  await page.goto(`${addressOf(server)}broken.html`);
  await page.getByRole("alert").getByText("Touchpath could not be loaded").waitFor();
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

test("another job is another document: the user cannot undo into the one before, and no value of it comes back", async () => {
  await open("<touch-path></touch-path>", LISTEN);
  await set("job", { format: 1, name: "A", cycle: { type: "hole", diameter: 32 } });
  await set("job", { format: 1, name: "B", cycle: { type: "boss", diameter: 20 } });
  assert.ok(await page.getByRole("button", { name: "Undo" }).isDisabled());
  await page.locator(`tp-picture ${PICTURE}`).focus();
  await page.keyboard.press("Control+z");
  assert.equal(await on((element) => element.job.name), "B");
  await set("cycle", "hole");
  assert.equal(await field("cycle.diameter").inputValue(), "40", "not the 32 of A");
});

test("a host that returns each changed job late does not overwrite what is typed", async () => {
  await open(
    "<touch-path cycle=hole></touch-path>",
    `document.addEventListener("job-change", ({ target, detail }) => setTimeout(() => { target.job = detail.job; }, 120));`,
  );
  await field("cycle.diameter").focus();
  await page.keyboard.press("Control+a");
  await page.keyboard.type("31.25", { delay: 70 });
  await page.waitForTimeout(400);
  assert.equal(await on((element) => element.job.cycle.diameter), 31.25);
  assert.equal(await field("cycle.diameter").inputValue(), "31.25");
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
  assert.deepEqual(await on((element) => [element.job.name, element.cycle, element.post]), [
    "EARLY",
    "boss",
    "sinumerik",
  ]);
  assert.equal(JSON.parse(await page.evaluate(() => /** @type {any} */ (window).sent.j)).name, "EARLY");
});

test("an invalid job says why where the browser can show it, and the focus comes to the first field", async () => {
  await open("<form><touch-path name=j cycle=hole></touch-path><button>Send</button></form>");
  await field("cycle.diameter").fill("-1");
  await page.getByRole("button", { name: "Send" }).click();
  assert.ok(await on((element) => element.matches(":focus-within") || document.activeElement === element));
  await on((element) => element.focus());
  assert.equal(await on((element) => element.shadowRoot.activeElement.id), "f-cycle.origin[0]");
  await set("readonly", true);
  await on((element) => element.focus());
  assert.equal(await on((element) => element.shadowRoot.activeElement.localName), "canvas");
});

test("what is handed out are copies; points stay with their job, and no job is said to change with them", async () => {
  await open("<touch-path cycle=hole readonly></touch-path>", LISTEN);
  // Of a job that can only be looked at, too, a log of the probe is taken: its points change no job.
  const log = ["20 0", "0 20", "-20 0", "0 -20"].map((at) => `${at} -10 0 0 0 0 0 0\n`).join("");
  await page.locator("#file").setInputFiles({ name: "probe.log", mimeType: "text/plain", buffer: Buffer.from(log) });
  await page.getByText("4 measured points were taken from this log").waitFor();
  await on((element) => {
    element.plan.program.text = "M30";
    element.findings.push({});
  });
  assert.match(await on((element) => element.plan.program.text), /M2\n$/);
  await heard();
  await page.locator("#measured").fill("17,0,-10\n0,17,-10\n-17,0,-10\n0,-17,-10");
  assert.deepEqual(await heard(), []);
  await on((element) => {
    element.job = { ...element.job, overtravel: 6 };
  });
  assert.match(await page.locator("#measured").inputValue(), /^17,0,-10/);
});

test("the log of a sender gives results, and the block to type with a button that copies it", async () => {
  await open("<touch-path cycle=hole post=grbl></touch-path>");
  // A hole of 40 and a ball of 6 in G55 at X100 Y50 Z-80, 0.5 off in X: contacts at 17 from the centre, where
  // X is 0 at a Y of √(17² − 0.5²) = 16.99264.
  const log = ["117.5,50", "83.5,50", "100,66.99264", "100,33.00736"]
    .map((xy) => `<<< [PRB:${xy},-90:1]\n<<< ok\n`)
    .join("");
  await page.locator("#file").setInputFiles({ name: "run.log", mimeType: "text/plain", buffer: Buffer.from(log) });
  await page.getByText("4 measured points were taken from this log").waitFor();
  await page.getByText("Type $# and paste the answer").waitFor();
  assert.equal(await page.locator(".block").count(), 0);
  await page.locator("#measured").fill(`G55\nWCO:100,50,-80\n${log}`);
  await page.getByText("Type this before anything moves").waitFor();
  assert.equal(await page.locator(".block .code").textContent(), "G21 G10 L20 P2 X-0.5 Y0");
  assert.match((await page.locator(".measured").textContent()) ?? "", /WCO in line 2: X100 Y50 Z-80 \(mm\)/);
  await page.context().grantPermissions(["clipboard-read", "clipboard-write"]);
  await page.locator(".block").getByRole("button", { name: "Copy" }).click();
  await page.locator(".block").getByText("Copied").waitFor();
  assert.equal(await page.evaluate(() => navigator.clipboard.readText()), "G21 G10 L20 P2 X-0.5 Y0");
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
    return { lines: element.shadowRoot?.querySelectorAll(".line").length, plan: element.plan !== null };
  });
  assert.ok((state.lines ?? 0) > 20 && state.plan, JSON.stringify(state));
});

test("in somebody else's page: no second main, nothing said of privacy, keys of a slotted field are its own", async () => {
  await open("<touch-path cycle=hole panels=program><input slot=header aria-label=Ordernumber></touch-path>");
  assert.equal(await page.getByRole("main").count(), 0);
  assert.equal(await page.getByText("Nothing leaves this browser").count(), 0);
  await set("job", { format: 1, cycle: { type: "hole", diameter: -1 } });
  assert.equal(await page.getByRole("button", { name: "Go to it" }).count(), 0, "there is no form to go to");
  await page.getByLabel("Ordernumber").fill("abc");
  await page.keyboard.press("Control+z");
  assert.notEqual(await page.getByLabel("Ordernumber").inputValue(), "abc", "the browser's own undo");
});

test("an element has the language of its own lang, or that of what is around it", async () => {
  await open(
    `<touch-path id="own" lang="de-CH"></touch-path><section lang="ru"><touch-path id="around"></touch-path></section><touch-path id="none" lang="tlh"></touch-path>`,
  );
  const tab = (/** @type {string} */ id) => page.locator(`#${id} #tab-results`).textContent();
  const [de, ru, zh] = ["de", "ru", "zh-Hant"].map((language) => wordsOf(language).Results);
  assert.deepEqual([await tab("own"), await tab("around"), await tab("none")], [de, ru, "Results"]);
  // What an element says to the page around stays data: English, with what can be said in another language beside it.
  const said = await page.evaluate(() => {
    const own = /** @type {any} */ (document.querySelector("#own"));
    own.job = { ...own.job, overtravel: -1 };
    return { findings: own.findings, message: own.validationMessage };
  });
  assert.equal(said.findings[0].message, "Overtravel must be from 0.01 to 1000 mm");
  assert.deepEqual(said.findings[0].said[1], ["Overtravel"]);
  assert.ok(said.message.includes(wordsOf("de").Overtravel), said.message);
  // Another language later; none is that of what is around.
  await page.evaluate(() => {
    const [own, none] = ["own", "none"].map((id) => /** @type {HTMLElement} */ (document.getElementById(id)));
    own?.removeAttribute("lang");
    if (none) none.lang = "zh-TW";
  });
  await page.waitForFunction(
    (zh) => document.querySelector("#none")?.shadowRoot?.querySelector("#tab-results")?.textContent === zh,
    zh,
  );
  await page.waitForFunction(
    () => document.querySelector("#own")?.shadowRoot?.querySelector("#tab-results")?.textContent === "Results",
  );
  assert.equal(await tab("around"), ru);
  // What is around an element may change its language.
  await page.evaluate(() => {
    document.documentElement.lang = "de";
    document.querySelector("section")?.removeAttribute("lang");
  });
  for (const id of ["own", "around"])
    await page.waitForFunction(
      ([id, de]) => document.querySelector(`#${id}`)?.shadowRoot?.querySelector("#tab-results")?.textContent === de,
      [id, de],
    );
  assert.equal(await tab("none"), zh, "its own language stays");
});

test("the language that is set last is shown, however late the words of the one before come", async () => {
  await page?.close();
  await open("<main></main>");
  await page.route(/\/de\.js$/, async (route) => {
    await new Promise((done) => setTimeout(done, 700));
    await route.continue();
  });
  await page.evaluate(async () => {
    const element = /** @type {any} */ (document.createElement("touch-path"));
    element.lang = "de";
    document.querySelector("main")?.append(element);
    await new Promise((done) => setTimeout(done, 250));
    element.lang = "ru";
    await element.ready;
  });
  const ru = wordsOf("ru").Results;
  await page.waitForFunction(
    (ru) => document.querySelector("touch-path")?.shadowRoot?.querySelector("#tab-results")?.textContent === ru,
    ru,
  );
  // Inside a shadow root of the host's own, the language of the page around is meant.
  const german = await page.evaluate(async () => {
    const host = document.createElement("div");
    host.lang = "de-DE";
    document.body.append(host);
    const element = /** @type {any} */ (document.createElement("touch-path"));
    host.attachShadow({ mode: "open" }).append(element);
    await element.ready;
    return element.shadowRoot.querySelector("#tab-results").textContent;
  });
  assert.equal(german, wordsOf("de").Results);
});

test("an element whose files did not come is tried again where it is put into the document again", async () => {
  await open("<main></main>");
  await page.route(/\/app\.js$/, (route) => route.abort());
  const ready = () =>
    page.evaluate(async () => {
      const place = /** @type {Element} */ (document.querySelector("main"));
      const element = /** @type {any} */ (place.firstElementChild ?? document.createElement("touch-path"));
      element.remove();
      place.append(element);
      return element.ready.then(
        () => "shown",
        () => "failed",
      );
    });
  assert.equal(await ready(), "failed");
  assert.deepEqual(problems.splice(0), ["Failed to load resource: net::ERR_FAILED"]);
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
  await page.getByRole("button", { name: "Setup sheet" }).click();
  await page.locator("tp-sheet").waitFor();
  await coming;
  await page.waitForTimeout(200);
  assert.ok(await page.locator("tp-sheet").isVisible());
  assert.equal(await page.locator("tp-gallery").count(), 0);
});

test("what a page puts in as undefined is not there: the default stands in, and units convert", async () => {
  await open("<touch-path></touch-path>");
  const state = await on((element) => {
    element.job = {
      format: 1,
      units: undefined,
      stylus: { diameter: 3 },
      cycle: { type: "hole", diameter: 32, depth: undefined },
    };
    const whole = structuredClone(element.job);
    element.units = "inch";
    return {
      units: whole.units,
      keys: Object.values(whole.cycle).includes(undefined),
      diameter: element.job.cycle.diameter,
    };
  });
  assert.deepEqual(state, { units: "mm", keys: false, diameter: 1.259843 });
});

test("a job that no form can send was taken, and its form sent the one before: it is refused", async () => {
  await open("<form><touch-path name=j cycle=hole></touch-path></form>", LISTEN);
  await heard();
  const state = await on((element) => {
    const turning = { format: 1, cycle: { type: "hole" } };
    Object.assign(turning, { self: turning });
    for (const job of [
      { format: 1, cycle: { type: "hole", diameter: 10n } },
      { format: 1, note: 10n, cycle: { type: "hole" } },
      turning,
    ])
      element.job = job;
    return [element.job.cycle.diameter, element.plan !== null, element.form.checkValidity()];
  });
  assert.deepEqual(state, [40, true, true]);
  const events = await heard();
  assert.deepEqual(
    events.map(([name, { refused, findings }]) => [name, refused, findings[0].code]),
    Array(3).fill(["finding", true, "unreadable"]),
  );
});

test("a form that was put back within a second of its first job kept the last one", async () => {
  await open("<form><touch-path name=j cycle=hole></touch-path></form>");
  for (const value of ["45", "40", "50"]) await field("cycle.diameter").fill(value);
  const held = await on((element) => {
    element.form.reset();
    return [element.job.cycle.diameter, JSON.parse(String(new FormData(element.form).get("j"))).cycle.diameter];
  });
  assert.deepEqual(held, [40, 40]);
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

test("a job of thousands of touches held up the page: few of them are listed", async () => {
  await open("<touch-path cycle=hole></touch-path>");
  const rows = await on(async (element) => {
    const touches = Array.from({ length: 5000 }, () => ({ point: [1, 2, 3], vector: [1, 0, 0] }));
    element.job = { format: 1, cycle: { type: "hole", touches } };
    const app = element.shadowRoot.querySelector("tp-app");
    await app.updateComplete;
    await element.shadowRoot.querySelector("tp-form").updateComplete;
    return [
      element.shadowRoot.querySelectorAll(".picks li").length,
      element.findings[0].code,
      element.job.cycle.touches.length,
    ];
  });
  assert.deepEqual(rows, [50, "too-many-touches", 5000]);
});
