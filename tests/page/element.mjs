// Shared by the tests of <touch-path>: a host page, the package's files beside it, and the real browser.
import assert from "node:assert/strict";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, afterEach, before } from "node:test";
import { at } from "../../scripts/lib.mjs";
import { addressOf, serve } from "../../scripts/serve.mjs";
import { site } from "../site.mjs";
import { launch } from "./common.mjs";

/** @import {} from "../../www/element.ts" */

const { version } = JSON.parse(readFileSync(at("package.json"), "utf8"));

/** @type {string} */
export let folder;
/** @type {import("node:http").Server} */
let server;
/** @type {import("playwright-core").Browser} */
let browser;
/** What the browser has compiled serves every test of a file. @type {import("playwright-core").BrowserContext} */
let context;
/** @type {import("playwright-core").Page} */
export let page;
/** What went wrong unseen. @type {string[]} */
export let problems = [];
/** The modules that were loaded. @type {string[]} */
export let modules = [];

export const POLICY =
  "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self'; connect-src 'self'; require-trusted-types-for 'script'; trusted-types lit-html";

/** The package in a served folder; a problem on a page fails its test. */
export function setUp() {
  before(async () => {
    folder = mkdtempSync(join(tmpdir(), "touchpath-element-"));
    site(join(folder, "touchpath"));
    server = await serve(0, folder);
    browser = await launch();
    context = await browser.newContext({
      viewport: { width: 1300, height: 900 },
    });
  });
  afterEach(async () => {
    // No state is kept for the next test.
    if (page && !page.isClosed() && page.url().startsWith("http"))
      await page.evaluate(() => {
        for (const storage of [localStorage, sessionStorage]) storage.clear();
        Storage.prototype.setItem = () => {};
      });
    await page?.close();
    assert.deepEqual(
      problems,
      [],
      "nothing is complained about on the console",
    );
  });
  after(async () => {
    await browser?.close();
    server?.close();
    rmSync(folder, { recursive: true });
  });
}

/** What an element inside is called in the package: by its version, since a page may hold two. */
export const inner = (/** @type {string} */ name) =>
  `tp-${version.replaceAll(".", "-")}-${name}`;

/** Where a file of the folder is served. */
export const address = (/** @type {string} */ name) =>
  `${addressOf(server)}${name}`;

/** A file of the folder in a tab, as it is: nothing is listened to, nothing waited for. */
export async function visit(/** @type {string} */ name) {
  page = await context.newPage();
  await page.goto(address(name));
}

/** Opens a page with this body; every element of it is loaded. */
export async function open(
  /** @type {string} */ body,
  script = "",
  policy = POLICY,
) {
  writeFileSync(
    join(folder, "page.css"),
    "html, body { height: 100%; margin: 0 } touch-path { height: 650px }",
  );
  writeFileSync(join(folder, "page.js"), script);
  writeFileSync(
    join(folder, "page.html"),
    `<!doctype html><html lang="en"><meta charset="utf-8"><meta http-equiv="Content-Security-Policy" content="${policy}"><title>Host</title>
<link rel="stylesheet" href="page.css"><script src="page.js"></script><script type="module" src="touchpath/element/element.js"></script>${body}</html>`,
  );
  problems = [];
  modules = [];
  page = await context.newPage();
  page.on("pageerror", (error) => problems.push(String(error)));
  page.on(
    "console",
    (message) => message.type() === "error" && problems.push(message.text()),
  );
  page.on(
    "request",
    (request) => request.url().endsWith(".wasm") && modules.push(request.url()),
  );
  await page.goto(address("page.html"));
  await loaded();
}

const loaded = () =>
  page.evaluate(async () => {
    await customElements.whenDefined("touch-path");
    await Promise.all(
      [...document.querySelectorAll("touch-path")].map((one) => one.ready),
    );
  });

/**
 * Works with the first element of the page.
 * @param {(element: any, arg?: any) => unknown} work
 * @param {unknown} arg
 * @returns {Promise<any>}
 */
export const on = (work, arg = null) =>
  page.evaluate(
    `(${work})(document.querySelector("touch-path"), ${JSON.stringify(arg)})`,
  );
/** Sets a property of it. */
export const set = (/** @type {string} */ name, /** @type {unknown} */ value) =>
  page.evaluate(
    ([name, value]) =>
      void Object.assign(
        /** @type {object} */ (document.querySelector("touch-path")),
        { [String(name)]: value },
      ),
    [name, value],
  );

/** Records the events of the first element, by name. */
export const LISTEN = `
  window.heard = [];
  const own = ["job-change", "plan-change", "program-save", "finding"];
  for (const name of own) document.addEventListener(name, (event) => heard.push([name, structuredClone(event.detail)]));
`;
/** @returns {Promise<[string, any][]>} */
export const heard = () =>
  page.evaluate(() => /** @type {any} */ (window).heard.splice(0));
export const field = (/** @type {string} */ path, n = 0) =>
  page.locator("touch-path").nth(n).locator(`[id="f-${path}"]`);
