// The playground among the examples: its settings are applied to the element, and its code is valid.
import assert from "node:assert/strict";
import { cpSync, mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, beforeEach, test } from "node:test";
import { at } from "../../scripts/lib.mjs";
import { addressOf, serve } from "../../scripts/serve.mjs";
import { site } from "../site.mjs";
import { launch, settles } from "./common.mjs";

/** @type {import("node:http").Server} */
let server;
/** @type {import("playwright-core").Browser} */
let browser;
/** @type {import("playwright-core").Page} */
let page;
/** @type {string} */
let folder;
/** @type {string[]} */
let problems = [];

before(async () => {
  folder = mkdtempSync(join(tmpdir(), "touchpath-playground-"));
  cpSync(at("examples", "playground"), folder, { recursive: true });
  site(join(folder, "touchpath"));
  server = await serve(0, folder);
  browser = await launch();
});
beforeEach(async () => {
  await page?.close();
  problems = [];
  page = await browser.newPage({ viewport: { width: 1440, height: 900 } });
  page.on("pageerror", (error) => problems.push(String(error)));
  page.on(
    "console",
    (message) => message.type() === "error" && problems.push(message.text()),
  );
  await page.goto(`${addressOf(server)}index.html`);
  await ready();
});
after(async () => {
  await browser?.close();
  server?.close();
  rmSync(folder, { recursive: true });
});

const ready = async () => {
  await page.locator("touch-path").waitFor({ state: "attached" });
  await page.evaluate(() =>
    /** @type {any} */ (document.querySelector("touch-path")).ready.then(
      () => undefined,
    ),
  );
};
const of = (/** @type {string} */ what) =>
  page.evaluate((what) => {
    const element = /** @type {any} */ (document.querySelector("touch-path"));
    return (
      what.split(".").reduce((value, key) => value?.[key], element) ?? null
    );
  }, what);
const codeOf = async (/** @type {string} */ framework) => {
  await page.getByRole("tab", { name: framework }).click();
  return (await page.locator("#code pre").textContent()) ?? "";
};

test("what is set is set on the element, and its events are listed", async () => {
  await page.locator("[name=cycle]").selectOption("boss");
  await page.locator("[name=post]").selectOption("haas");
  await page.locator("[name=lang]").selectOption("de");
  await page.locator('[name=panels][value="form"]').check();
  assert.deepEqual(
    [await of("cycle"), await of("post"), await of("lang"), await of("panels")],
    ["boss", "haas", "de", "form"],
  );
  await page.locator("[name=lang]").selectOption("");
  assert.equal(await of("lang"), "");
  await page.locator('touch-path [id="f-cycle.diameter"]').fill("33");
  await page.locator("#events li", { hasText: "job-change" }).first().waitFor();
  assert.match(
    (await page
      .locator("#events li", { hasText: "plan-change" })
      .first()
      .textContent()) ?? "",
    /"plan"/,
  );
  assert.deepEqual(problems, []);
});

test("a config holds, one that cannot be used is refused below it", async () => {
  await page
    .getByLabel("Example of a config")
    .selectOption({ label: "One hall: two cycles, two controls" });
  assert.deepEqual(await of("config.allow.cycles"), ["hole", "web"]);
  const refused = page.locator("#refused");
  assert.equal(await refused.textContent(), "");
  await page
    .getByLabel("Config", { exact: true })
    .fill('{ "format": 1, "allow": { "cycles": ["holes"] } }');
  assert.match(
    (await refused.textContent()) ?? "",
    /allow\.cycles\[0\] must be one of/,
  );
  assert.deepEqual(
    await of("config.allow.cycles"),
    ["hole", "web"],
    "the one before holds",
  );
  await page.getByLabel("Config", { exact: true }).fill("{");
  assert.notEqual(await refused.textContent(), "");
  await page.getByLabel("Config", { exact: true }).fill("");
  assert.deepEqual(
    [await refused.textContent(), await of("config")],
    ["", null],
  );
});

test("panels apart have the job as it was", async () => {
  await page.locator("[name=cycle]").selectOption("hole");
  await page.locator('touch-path [id="f-cycle.diameter"]').fill("33");
  await page.getByLabel(/panels apart/).check();
  await ready();
  const field = page.locator('touch-form [id="f-cycle.diameter"]');
  await settles(async () => (await field.inputValue()) === "33", page);
  assert.equal(await page.locator("touch-path").isVisible(), false);
  await field.fill("34");
  await page.getByLabel(/panels apart/).uncheck();
  await ready();
  await settles(
    async () =>
      (await page
        .locator('touch-path [id="f-cycle.diameter"]')
        .inputValue()) === "34",
    page,
  );
  assert.deepEqual(problems, []);
});

/** Text that would end a script, a text or a template. */
const AWKWARD = "</script><b>\"'`$" + "{x}\\";

test("the code for six frameworks is code of each, with and without a config, together and apart", async () => {
  const { parse, compileScript, compileTemplate } = await import(
    "vue/compiler-sfc"
  );
  const { compile } = await import("svelte/compiler");
  const { transform } = await import("esbuild");
  const scripts = (/** @type {string} */ text) =>
    [...text.matchAll(/<script type="module">([\s\S]*?)<\/script>/g)].map(
      ([, script = ""]) => script,
    );
  const reads = /** @type {Record<string, (text: string) => unknown>} */ ({
    HTML: (text) =>
      Promise.all(scripts(text).map((script) => transform(script))),
    React: (text) => transform(text, { loader: "tsx", jsx: "automatic" }),
    Vue: (text) => {
      const { descriptor, errors } = parse(text);
      assert.deepEqual(errors, []);
      compileScript(descriptor, { id: "x" });
      const { errors: faults } = compileTemplate({
        source: descriptor.template?.content ?? "",
        filename: "x.vue",
        id: "x",
      });
      assert.deepEqual(faults, []);
    },
    Svelte: (text) => compile(text, { generate: "client" }),
    Angular: (text) =>
      transform(text, {
        loader: "ts",
        tsconfigRaw: { compilerOptions: { experimentalDecorators: true } },
      }),
    Frame: (text) =>
      Promise.all(scripts(text).map((script) => transform(script))),
  });
  const seen = new Set();
  for (const apart of [false, true])
    for (const config of ["", JSON.stringify({ format: 1, title: AWKWARD })]) {
      await page.locator("[name=cycle]").selectOption("hole");
      await page.getByLabel("readonly").check();
      await page.getByLabel(/panels apart/).setChecked(apart);
      await page.getByLabel("Config", { exact: true }).fill(config);
      for (const [framework, read] of Object.entries(reads)) {
        const text = await codeOf(framework);
        await read(text);
        assert.match(text, /hole/, framework);
        assert.equal(
          /<touch-form/.test(text),
          apart && framework !== "Frame",
          framework,
        );
        assert.equal(text.includes("</script><b>"), false, framework);
        seen.add(text);
      }
    }
  // A frame shows one element, with separate panels or not.
  assert.equal(seen.size, 22);
  assert.deepEqual(problems, []);
});

test("the HTML that is written shows what the playground shows", async () => {
  await page.locator("[name=cycle]").selectOption("boss");
  await page.locator("[name=post]").selectOption("fanuc");
  await page
    .getByLabel("Example of a config")
    .selectOption({ label: "A fixed feed, a hidden field" });
  const program = await of("plan.program.text");
  const html = await codeOf("HTML");
  await page.route("**/written.html", (route) =>
    route.fulfill({
      contentType: "text/html",
      body: `<!doctype html><title>Written</title>${html}`,
    }),
  );
  await page.goto(`${addressOf(server)}written.html`);
  await ready();
  assert.equal(await of("plan.program.text"), program);
  assert.equal(
    await page.evaluate(
      () =>
        /** @type {any} */ (document.querySelector("touch-path")).config.fields[
          "feeds.work"
        ].value,
    ),
    100,
  );
});
