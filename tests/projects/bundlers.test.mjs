// The element in projects of every kind, built and opened under a policy that only allows their own files and WebAssembly.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { cpSync, readdirSync, readFileSync, writeFileSync } from "node:fs";
import { createServer } from "node:http";
import { extname, join } from "node:path";
import { test } from "node:test";
import { at } from "../../scripts/lib.mjs";
import { addressOf } from "../../scripts/serve.mjs";
import { inBrowser, project, tarballs } from "./installed.mjs";

const { open, servers } = inBrowser();

const policy = (other = "") =>
  `default-src 'none'; script-src 'self' ${other} 'wasm-unsafe-eval'; style-src 'self'; connect-src 'self' ${other}; require-trusted-types-for 'script'; trusted-types lit-html`;
const html = (/** @type {string} */ script, csp = policy()) =>
  `<!doctype html><html lang="en"><meta charset="utf-8"><meta http-equiv="Content-Security-Policy" content="${csp}"><title>User</title><script type="module" src="${script}"></script><touch-path cycle="boss"></touch-path></html>`;
/** A user's script: the element, and a function of the package. */
const MAIN = `import "touchpath-element";
import { defaultJob, plan } from "touchpath";
document.title = String(plan(defaultJob("hole")).moves.length);
`;

/** Opens a folder's page: the element shows its job, the function gave its plan, one module was loaded, and nothing was complained about. */
async function opens(/** @type {string} */ folder, modules = 1) {
  /** @type {string[]} */
  const wasm = [];
  const { page, problems } = await open(folder, (page) =>
    page.on(
      "response",
      (response) =>
        response.headers()["content-type"] === "application/wasm" &&
        wasm.push(response.url()),
    ),
  );
  await page
    .waitForFunction(() => customElements.get("touch-path"), null, {
      timeout: 15_000,
    })
    .catch(() => assert.fail(`the element is not defined: ${problems}`));
  const seen = await page.evaluate(async () => {
    const element = /** @type {any} */ (document.querySelector("touch-path"));
    await element.ready;
    return {
      text: element.plan.program.text,
      title: document.title,
      shown: element.shadowRoot.querySelectorAll("#panel-program .line").length,
    };
  });
  const { defaultJob, plan } = await import("touchpath");
  assert.equal(seen.text, plan(defaultJob("boss")).program.text);
  assert.ok(seen.shown > 20);
  assert.deepEqual(problems, []);
  assert.equal(wasm.length, modules, wasm.join());
  await page.close();
  return seen;
}

test("Vite", async () => {
  const own = project("vite");
  writeFileSync(join(own, "main.js"), MAIN);
  writeFileSync(join(own, "index.html"), html("/main.js"));
  const { build } = await import("vite");
  await build({
    root: own,
    configFile: false,
    logLevel: "error",
    build: { target: "es2022", assetsInlineLimit: 0 },
  });
  const { title } = await opens(join(own, "dist"));
  const { defaultJob, plan } = await import("touchpath");
  assert.equal(title, String(plan(defaultJob("hole")).moves.length));
  noBase64(join(own, "dist"));
});

test("webpack", async () => {
  const own = project("webpack");
  writeFileSync(join(own, "main.js"), MAIN);
  const { default: webpack } = await import("webpack");
  const stats = await new Promise((done, fail) =>
    webpack(
      {
        mode: "production",
        context: own,
        entry: "./main.js",
        target: "web",
        output: {
          path: join(own, "dist"),
          module: true,
          filename: "main.js",
          chunkFilename: "[name].js",
        },
        experiments: { outputModule: true },
      },
      (error, stats) => (error ? fail(error) : done(stats)),
    ),
  );
  assert.deepEqual(stats.toJson({ errors: true }).errors, []);
  writeFileSync(join(own, "dist", "index.html"), html("./main.js"));
  await opens(join(own, "dist"));
  noBase64(join(own, "dist"));
});

test("esbuild, with the module copied beside what it writes", async () => {
  const own = project("esbuild");
  writeFileSync(join(own, "main.js"), MAIN);
  const { build } = await import("esbuild");
  await build({
    absWorkingDir: own,
    entryPoints: ["main.js"],
    bundle: true,
    format: "esm",
    splitting: true,
    minify: true,
    outdir: "dist",
    logLevel: "error",
  });
  cpSync(
    join(own, "node_modules", "touchpath", "dist", "wasm", "touchpath_bg.wasm"),
    join(own, "dist", "touchpath_bg.wasm"),
  );
  writeFileSync(join(own, "dist", "index.html"), html("./main.js"));
  await opens(join(own, "dist"));
});

/** The files for a web server, copied by the package's own command. */
const copySite = (/** @type {string} */ own) =>
  execFileSync(
    join(own, "node_modules", ".bin", "touchpath-element"),
    ["site/touchpath"],
    { cwd: own },
  );

test("a bundle for Node takes the element's functions for browsers", async () => {
  const own = project("for-node", ["react"]);
  writeFileSync(
    join(own, "main.js"),
    'import "touchpath-element/react";\nimport { plan } from "touchpath";\nconsole.log(typeof plan);\n',
  );
  const { build } = await import("esbuild");
  for (const conditions of [[], ["workerd"]])
    await build({
      absWorkingDir: own,
      entryPoints: ["main.js"],
      bundle: true,
      format: "esm",
      platform: "node",
      conditions,
      external: ["react"],
      loader: { ".wasm": "file" },
      outfile: "out.mjs",
      logLevel: "error",
    });
});

test("a folder with the files, and no tool at all", async () => {
  const own = project("plain");
  copySite(own);
  writeFileSync(
    join(own, "site", "main.js"),
    MAIN.replace(
      '"touchpath-element"',
      '"./touchpath/element/element.js"',
    ).replace('"touchpath"', '"./touchpath/core/browser.js"'),
  );
  writeFileSync(join(own, "site", "index.html"), html("./main.js"));
  await opens(join(own, "site"));
});

test("modules that come from another origin", async () => {
  const own = project("elsewhere");
  copySite(own);
  const dist = join(own, "site", "touchpath");
  const types = /** @type {Record<string, string>} */ ({
    ".js": "text/javascript",
    ".wasm": "application/wasm",
  });
  const elsewhere = createServer((request, response) => {
    const name = new URL(request.url ?? "/", "http://localhost").pathname;
    response.writeHead(200, {
      "content-type": types[extname(name)] ?? "text/plain",
      "access-control-allow-origin": "*",
    });
    response.end(readFileSync(join(dist, name)));
  });
  await new Promise((done) =>
    elsewhere.listen(0, "127.0.0.1", () => done(null)),
  );
  servers.push(elsewhere);
  const origin = addressOf(elsewhere).slice(0, -1);
  writeFileSync(
    join(own, "site", "index.html"),
    html(`${origin}/element/element.js`, policy(origin)),
  );
  await opens(join(own, "site"));
});

/** Nothing is put into scripts that is a file of its own. */
function noBase64(/** @type {string} */ folder) {
  for (const name of readdirSync(folder, { recursive: true, encoding: "utf8" }))
    if (name.endsWith(".js"))
      assert.doesNotMatch(
        readFileSync(join(folder, name), "utf8"),
        /base64,[A-Za-z0-9+/]{200}/,
        name,
      );
}

test("Node: a script, threads, a server that renders the tag", () => {
  const own = project("node");
  writeFileSync(
    join(own, "main.mjs"),
    `import { isMainThread, parentPort, Worker } from "node:worker_threads";
import { defaultJob, plan } from "touchpath";
import "touchpath-element";
import schema from "touchpath/schema.json" with { type: "json" };
const lines = plan(defaultJob("hole")).program.text.split("\\n").length;
if (isMainThread) {
  const answers = await Promise.all([1, 2, 3].map(() => new Promise((done) => new Worker(new URL(import.meta.url)).once("message", done))));
  console.log(new Set([lines, ...answers]).size, schema.$id);
} else parentPort.postMessage(lines);
`,
  );
  assert.equal(
    execFileSync("node", ["main.mjs"], { cwd: own, encoding: "utf8" }),
    "1 urn:touchpath:job:1\n",
  );
  const bin = join(own, "node_modules", ".bin", "touchpath");
  assert.match(
    execFileSync(bin, ["--version"], { cwd: own, encoding: "utf8" }),
    /^\d+\.\d+\.\d+(-\w+)?\n$/,
  );
});

/** Compiles `use.ts` of a project with strict TypeScript, with or without the types of libraries. */
function compiles(
  /** @type {string} */ own,
  /** @type {string[]} */ resolution,
  skipsLibraries = "false",
) {
  const strict = [
    "--strict",
    "--noEmit",
    "--target",
    "es2022",
    "--lib",
    "ES2023,DOM",
    "--types",
    "",
  ];
  const tsc = join(own, "node_modules", "typescript", "bin", "tsc");
  execFileSync(
    tsc,
    [...strict, "--skipLibCheck", skipsLibraries, ...resolution, "use.ts"],
    {
      cwd: own,
      stdio: "inherit",
    },
  );
}

test("the types of the element and of the frame, in strict TypeScript", () => {
  const own = project("types", ["typescript"]);
  writeFileSync(
    join(own, "use.ts"),
    `import { define, TouchPath, type TouchPathEvents } from "touchpath-element";
import { connect, FrameError, type FrameView } from "touchpath-element/frame";
const element: TouchPath = document.createElement("touch-path");
element.job = { format: 1, cycle: { type: "hole", diameter: 20 } };
element.job = { format: 2, cycles: [{ type: "hole", name: "BORE" }, { type: "surface" }] };
element.theme = "dark";
document.createElement("touch-picture").session = element;
define("acme-path");
// @ts-expect-error no panel of a panel
document.createElement("touch-form").session = document.createElement("touch-form");
element.addEventListener("job-change", ({ detail }) => { const name: string | undefined = detail.job.name; console.log(name); });
element.addEventListener("program-save", (event: TouchPathEvents["program-save"]) => { event.preventDefault(); console.log(event.detail.text); });
element.addEventListener("job-change", ({ detail }) => {
  // @ts-expect-error a set-up has no cycle: the format must be asked first
  console.log(detail.job.cycle.type);
  if (detail.job.format === 1) console.log(detail.job.cycle.type);
});
element.addEventListener("change", ({ detail: { plan, reason } }) => {
  // @ts-expect-error there is no plan while the job has errors
  console.log(plan.program.text);
  console.log(plan?.program.text, reason === "edit", element.canUndo);
});
const view: FrameView = await (await connect(document.createElement("iframe"), { origin: "https://x.example" })).get();
console.log(view.plan?.moves.length, FrameError, element.plan?.program.text);
// @ts-expect-error there is no such theme
element.theme = "blue";
// @ts-expect-error there is no such cycle
element.cycle = "holes";
`,
  );
  writeFileSync(join(own, "package.json"), '{"type":"module"}');
  compiles(own, ["--module", "nodenext"]);
  compiles(own, ["--module", "esnext", "--moduleResolution", "bundler"]);
});

test("Vue's templates and Svelte's markup know the element, and refuse what it does not take", () => {
  const own = project("frameworks", [
    "typescript",
    "vue",
    "@vue",
    "svelte",
    "csstype",
  ]);
  writeFileSync(
    join(own, "use.ts"),
    `import type {} from "touchpath-element/svelte";
import type {} from "touchpath-element/vue";
import type { SvelteHTMLElements } from "svelte/elements";
import type { GlobalComponents } from "vue";
type Vue = InstanceType<GlobalComponents["touch-path"]>["$props"];
type Svelte = SvelteHTMLElements["touch-path"];
const job = { format: 1, cycle: { type: "hole", diameter: 20 } } as const;
export const vue: Vue = { job, theme: "dark", class: "wide", onJobChange: (event) => console.log(event.detail.job.name), onChange: ({ detail }) => console.log(detail.reason), history: "none" };
export const part: InstanceType<GlobalComponents["touch-form"]>["$props"] = { for: "job", panels: "form checks" };
export const program: SvelteHTMLElements["touch-program"] = { for: "job", session: null };
export const svelte: Svelte = { job, post: "haas", class: "wide", "onplan-change": ({ detail }) => console.log(detail.plan?.moves) };
// @ts-expect-error a panel has no job of its own
export const own: SvelteHTMLElements["touch-program"] = { job };
// @ts-expect-error there is no such theme
export const blue: Vue = { theme: "blue" };
// @ts-expect-error there is no such control
export const post: Svelte = { post: "mazatrol" };
// @ts-expect-error there is no such cycle
export const cycle: Vue = { cycle: "holes" };
// @ts-expect-error a plan has no such section
export const plan: Svelte = { "onplan-change": ({ detail }) => console.log(detail.plan.nothing) };
`,
  );
  writeFileSync(join(own, "package.json"), '{"type":"module"}');
  // Svelte's own types use names that no browser library has.
  compiles(
    own,
    ["--module", "esnext", "--moduleResolution", "bundler"],
    "true",
  );
});

test("JetBrains' editors know the element: every attribute, property and event of its manifest", () => {
  const json = (/** @type {string} */ name) =>
    JSON.parse(readFileSync(at("dist", "touchpath-element", name), "utf8"));
  const own = json("package.json");
  const types = json(own["web-types"]);
  const [element, ...parts] = types.contributions.html.elements;
  const [declared] = json(own.customElements).modules.flatMap(
    (/** @type {any} */ one) => one.declarations,
  );
  assert.deepEqual(
    [types.version, element.name],
    [own.version, declared.tagName],
  );
  const names = (/** @type {any[]} */ list) =>
    list.map(({ name }) => name).sort();
  assert.deepEqual(names(element.attributes), names(declared.attributes));
  assert.deepEqual(names(element.js.events), names(declared.events));
  assert.ok(
    names(element.js.properties).includes("measured") &&
      !names(element.js.properties).includes("save"),
  );
  assert.deepEqual(names(parts), [
    "touch-form",
    "touch-picture",
    "touch-program",
  ]);
  for (const part of parts)
    assert.deepEqual(names(part.attributes), ["for", "panels"]);
  for (const one of [...element.attributes, ...element.js.events])
    assert.ok(one.description, one.name);
});

test("publint and Are the types wrong? find nothing", async () => {
  const run = (/** @type {string} */ tool, /** @type {string[]} */ ...args) =>
    execFileSync("npx", ["--no-install", tool, ...args], {
      encoding: "utf8",
      stdio: "pipe",
    });
  for (const tarball of tarballs) {
    assert.match(run("publint", "--strict", tarball), /All good/);
    // Files that are no modules have no types.
    run(
      "attw",
      tarball,
      "--profile",
      "esm-only",
      "--exclude-entrypoints",
      "touchpath.wasm",
      "embed.html",
    );
  }
});
