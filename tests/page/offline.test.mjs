// Without a network: the page works, and switches to a newer version when the user asks for it.
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
import { test } from "node:test";
import { fileURLToPath } from "node:url";
import { addressOf, lasts, serve } from "../../scripts/serve.mjs";
import { wordsOf } from "../../scripts/words.mjs";
import {
  context,
  field,
  more,
  openText,
  page,
  problems,
  program,
  ready,
  saveButton,
  settles,
  setUp,
} from "./common.mjs";

setUp(undefined, "allow");

/** Waits until the page's files are stored and its later parts are loaded: without the worker, as on every first visit. */
const kept = (tab = page) =>
  tab.evaluate(async () => {
    await navigator.serviceWorker.ready;
    const wait = (/** @type {number} */ ms) =>
      new Promise((done) => setTimeout(done, ms));
    while (!(await navigator.serviceWorker.getRegistration())?.active)
      await wait(20);
    for (const part of ["gallery", "lentoax", "viewer", "sheet", "presets"])
      await customElements.whenDefined(`tp-${part}`);
    return (await caches.keys()).length;
  });

/** Until the worker has written this file down: it does so beside the answer, not before it. */
const written = (/** @type {string} */ name) =>
  page.evaluate(async (part) => {
    for (;;) {
      const kept = await Promise.all(
        (await caches.keys()).map(async (key) =>
          (await caches.open(key)).keys(),
        ),
      );
      if (
        kept.flat().some((request) => request.url.includes(`/assets/${part}-`))
      )
        return;
      await new Promise((done) => setTimeout(done, 50));
    }
  }, name);

test("without a network the page opens, plans, draws, saves and shows its other tools", async () => {
  assert.equal(await kept(), 1);
  await written("rest");
  await context.setOffline(true);
  await page.goto(new URL("index.html?from=home", page.url()).href);
  await ready();
  await page.goto(new URL("./", page.url()).href);
  await ready();
  await field("cycle.width1").fill("90");
  assert.match(await program(), /G38\.2 X47 /);
  const download = page.waitForEvent("download");
  await saveButton().click();
  assert.match(
    readFileSync(await (await download).path(), "utf8"),
    /G38\.2 X47 /,
  );
  await more("Tool lengths");
  await page.locator("tp-lentoax").waitFor();
  await context.setOffline(false);
});

test("a first visit fetched each file twice: the worker takes what the page has loaded", async () => {
  const server = await serve(0);
  /** @type {string[]} */
  const fetched = [];
  server.on("request", (request) => fetched.push(request.url ?? ""));
  const tab = await context.newPage();
  try {
    await tab.goto(addressOf(server));
    await ready(tab);
    assert.equal(await kept(tab), 1);
    const named = fetched.filter(lasts);
    assert.ok(named.length > 20, `${named.length} files`);
    assert.deepEqual(
      named.filter((url, i) => named.indexOf(url) !== i),
      [],
    );
    assert.ok(
      !fetched.includes("/licences.txt"),
      "what nobody asked for is not loaded",
    );
  } finally {
    await tab.close();
    server.close();
  }
});

test("nothing leaves the browser: every request is for a file of the page", async () => {
  /** @type {string[]} */
  const asked = [];
  context.on("request", (request) => asked.push(request.url()));
  await page.reload();
  await ready();
  await kept();
  await field("cycle.width1").fill("90");
  await more("Copy a link to this job", page);
  const origin = new URL(page.url()).origin;
  assert.ok(asked.length > 3);
  assert.deepEqual(
    asked.filter(
      (url) => !url.startsWith(origin) || new URL(url).search !== "",
    ),
    [],
  );
});

test("a newer version waits until its user takes it, and the job stays", async () => {
  const folder = mkdtempSync(join(tmpdir(), "touchpath-page-"));
  cpSync(fileURLToPath(new URL("../../dist/page", import.meta.url)), folder, {
    recursive: true,
  });
  const server = await serve(0, folder);
  const tab = await context.newPage();
  try {
    await tab.goto(addressOf(server));
    await ready(tab);
    await kept(tab);
    await tab.reload();
    await ready(tab);
    await field("cycle.diameter", tab).fill("77");
    // The newer version: another worker with another title.
    const old = readFileSync(join(folder, "sw.js"), "utf8");
    writeFileSync(
      join(folder, "sw.js"),
      old.replace(/const VERSION = "\w+"/, 'const VERSION = "newer"'),
    );
    writeFileSync(
      join(folder, "index.html"),
      readFileSync(join(folder, "index.html"), "utf8").replace(
        "<title>",
        "<title>Newer ",
      ),
    );
    await tab.reload();
    await tab.locator(".note", { hasText: "newer version" }).waitFor();
    assert.equal(await tab.title(), "Touchpath", "not before it is taken");
    await tab.getByRole("button", { name: "Load it" }).click();
    await tab.waitForFunction(() => document.title === "Newer Touchpath");
    await ready(tab);
    assert.equal(await field("cycle.diameter", tab).inputValue(), "77");
    assert.deepEqual(
      await tab.evaluate(() => caches.keys()),
      ["touchpath / newer"],
      "nothing of the old one is kept",
    );
  } finally {
    await tab.close();
    server.close();
    rmSync(folder, { recursive: true });
  }
  assert.deepEqual(problems, []);
});

test("the language that was chosen is there without a network, and no other is loaded", async () => {
  await kept();
  /** @type {string[]} */
  const asked = [];
  context.on("request", (request) =>
    asked.push(new URL(request.url()).pathname),
  );
  const choose = async (/** @type {string} */ language) => {
    await page.locator("button[popovertarget=menu]").click();
    await page.locator("touch-path #lang").selectOption(language);
  };
  await choose("de");
  const { Results: german } = wordsOf("de");
  await page.getByRole("tab", { name: german }).waitFor();
  assert.equal(
    asked.filter((path) => /\/(ru|zh-Hant)-[^/]+\.js$/.test(path)).length,
    0,
    "words that are not wanted",
  );
  await written("de");
  await context.setOffline(true);
  await page.goto(new URL("./", page.url()).href);
  await ready();
  await page.getByRole("tab", { name: german }).waitFor();
  // A file that was never requested is missing: the page reports it, and keeps the current language.
  await choose("ru");
  await page.locator("touch-path .note").waitFor();
  await page.getByRole("tab", { name: german }).waitFor();
  await context.setOffline(false);
  assert.ok(
    problems.splice(0).length > 0,
    "the browser says, too, that a file did not come",
  );
});

test("the editor of opened programs: loaded with the first of them, there without a network from the second on, plain text before", async () => {
  await kept();
  /** @type {string[]} */
  const asked = [];
  context.on("request", (request) =>
    asked.push(new URL(request.url()).pathname),
  );
  const editors = () =>
    asked.filter((path) => /\/program-editor-[^/]+\.js$/.test(path)).length;
  const short = "G21 G90\nG0 X0 Y0 Z20\nG38.2 Z-5 F100\nM2\n";
  // So long that the document does not contain every line.
  const foreign = `${"(a line)\n".repeat(5000)}${short}`;
  const lines = async () =>
    (await page.locator("tp-viewer .line").allTextContents()).slice(0, 4);
  const again = async (/** @type {boolean} */ offline) => {
    await context.setOffline(offline);
    await page.goto(new URL("./", page.url()).href);
    await ready();
  };
  await page.waitForTimeout(800);
  assert.equal(editors(), 0, "no program was opened yet");
  await openText(short, "foreign.nc");
  await page.locator("tp-viewer .line").first().waitFor();
  await page.waitForTimeout(300);
  assert.equal(editors(), 0, "a program of a few lines needs none");
  await again(true);
  await openText(foreign, "foreign.nc");
  assert.equal(
    await page.locator("tp-viewer .listing pre").textContent(),
    foreign,
  );
  // The browser says that a file did not come: the editor, for each time that the program is shown.
  await settles(async () => problems.splice(0).length > 0);
  await settles(
    async () => (await page.locator("tp-viewer .running").count()) === 0,
  );
  await page.waitForTimeout(300);
  problems.splice(0);
  await again(false);
  await openText(foreign, "foreign.nc");
  await page.locator("tp-viewer .line").first().waitFor();
  assert.ok(editors() > 0);
  await written("program-editor");
  await again(true);
  await openText(foreign, "foreign.nc");
  await page.locator("tp-viewer .line").first().waitFor();
  assert.deepEqual(await lines(), foreign.split("\n").slice(0, 4));
  await context.setOffline(false);
});
