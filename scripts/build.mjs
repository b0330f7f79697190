// Builds the package into dist/ and the page into dist/page/: what is published. `--quick` builds what works alike on this machine, in a fraction of the
// time: without link-time optimization, and with one module in both places.
import { createHash } from "node:crypto";
import {
  appendFileSync,
  cpSync,
  mkdirSync,
  mkdtempSync,
  readdirSync,
  readFileSync,
  rmSync,
  statSync,
  writeFileSync,
} from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";
import { brotliCompressSync, gzipSync } from "node:zlib";
import { configSchema } from "./config-schema.mjs";
import {
  at,
  beside,
  ensureBindings,
  ensurePackages,
  ensureTarget,
  npx,
  stage,
  summary,
} from "./lib.mjs";
import { crateLicences } from "./licences.mjs";
import { trapPanics } from "./panics.mjs";
import { webTypes } from "./web-types.mjs";

/** How a module is built: by a profile of Cargo.toml, in a folder of its own, for cargo builds one thing at a time in a folder. */
const MODULES = {
  whole: { profile: "release", folder: "wasm", flags: [] },
  first: {
    profile: "release",
    folder: "first",
    flags: ["--no-default-features"],
  },
  quick: { profile: "quick", folder: "wasm", flags: [] },
};
/** @typedef {{ profile: string, folder: string, flags: string[] }} Module */

/** Where cargo builds a module: `wasm-pack build` takes the whole one from there. */
export const targetOf = (/** @type {string} */ folder) =>
  join(process.env.CARGO_TARGET_DIR ?? at("target"), folder);

/** Compiles the crate to a module; gives its path. */
async function compile(/** @type {Module} */ { profile, folder, flags }) {
  const target = targetOf(folder);
  // Lints look at the whole module; here what is unused without its features is an error.
  const strict =
    folder === MODULES.first.folder ? ["--", "-D", "warnings"] : [];
  const cargo = [
    strict.length > 0 ? "rustc" : "build",
    "--quiet",
    "--locked",
    "--profile",
    profile,
    "--target",
    "wasm32-unknown-unknown",
    "--lib",
  ];
  await beside("cargo", [
    ...cargo,
    ...flags,
    "--target-dir",
    target,
    ...strict,
  ]);
  return `${target}/wasm32-unknown-unknown/${profile}/touchpath.wasm`;
}

/** A module and its bindings; gives the folder they are in. */
async function buildModule(/** @type {Module} */ kind) {
  const [bindings, module] = await Promise.all([
    ensureBindings(),
    compile(kind),
  ]);
  const out = join(targetOf(kind.folder), `bindings-${kind.profile}`);
  rmSync(out, { recursive: true, force: true });
  await beside(bindings, [module, out]);
  return out;
}

/** Makes a module small for its way to the browser. */
async function optimize(/** @type {string} */ wasm) {
  await trapPanics(wasm);
  // Judged by what is sent, not by the module: inlining, packed memory and shared expressions make it smaller and its compressed bytes more. Jumps are
  // laid out anew from flat code, which compresses better. Functions of one name's beginning are alike and compress best side by side.
  const passes = [
    "--flatten",
    "--rereloop",
    "-O3",
    "-O3",
    "--reorder-functions-by-name",
  ];
  // First, what became small or unused with the messages of panics is put where it is called.
  const inline = [
    "--dae-optimizing",
    "--inlining",
    "-aimfs",
    "4",
    "-fimfs",
    "2",
    "-ocimfs",
    "2",
    "--dce",
    "--vacuum",
  ];
  const skipped = [
    "inlining-optimizing",
    "memory-packing",
    "local-cse",
    "simplify-locals",
  ];
  const skip = skipped.map((pass) => `--skip-pass=${pass}`);
  // The first kilobyte is the far end of the stack, which the linker puts first: no address is computed from below it.
  const assume = ["--low-memory-unused"];
  const optimizer = at("node_modules", "binaryen", "bin", "wasm-opt");
  await beside("node", [
    optimizer,
    ...inline,
    ...passes,
    ...skip,
    ...assume,
    wasm,
    "-o",
    wasm,
  ]);
}

/**
 * The whole module and the smaller one that the page begins with, with the bindings of the whole one: they serve both. Gives the folders they are in.
 * Needs no package of npm.
 */
export async function compileModules(/** @type {boolean} */ quick) {
  ensureTarget();
  if (!quick)
    return Promise.all([
      buildModule(MODULES.whole),
      buildModule(MODULES.first),
    ]);
  const out = await buildModule(MODULES.quick);
  return [out, out];
}

/** Both modules, optimized unless they are for this machine, into www/core/wasm/. */
export async function writeModules(
  /** @type {string[]} */ [whole = "", first = ""],
  /** @type {boolean} */ quick,
) {
  if (!quick)
    await Promise.all(
      [whole, first].map((folder) =>
        optimize(join(folder, "touchpath_bg.wasm")),
      ),
    );
  const out = at("www", "core", "wasm");
  rmSync(out, { recursive: true, force: true });
  cpSync(whole, out, { recursive: true });
  cpSync(join(first, "touchpath_bg.wasm"), join(out, "first.wasm"));
  // The generated types name Symbol.dispose, which only the newest `lib` knows: users' strict compilers must not stumble.
  const types = `${out}/touchpath.d.ts`;
  const plain = readFileSync(types, "utf8").replaceAll(
    /^ *\[Symbol\.dispose\]\(\): void;\n/gm,
    "",
  );
  writeFileSync(
    types,
    `${plain}\nexport function use(module: WebAssembly.Module): void;\n`,
  );
  appendFileSync(
    `${out}/touchpath.js`,
    "\n/** Puts another build of the module in the place of this one. */\nexport function use(module) {\n    wasmModule = module;\n    __wbg_reset_state();\n}\n",
  );
  // For servers that are bundled into one file.
  const wasm = readFileSync(`${out}/touchpath_bg.wasm`, "base64");
  writeFileSync(`${out}/inline.js`, `export const base64 = "${wasm}";\n`);
  writeFileSync(`${out}/inline.d.ts`, "export const base64: string;\n");
}

/** What frameworks know of the element. */
const TYPES = ["attributes.d.ts", "svelte.d.ts", "vue.d.ts"];

/** The package but for what is bundled into it. */
async function buildCore() {
  rmSync(at("dist"), { recursive: true, force: true });
  await npx("tsc", "-p", "tsconfig.package.json");
  // The first module is the page's alone.
  cpSync(at("www", "core", "wasm"), at("dist", "wasm"), {
    recursive: true,
    filter: (path) => !path.endsWith("first.wasm"),
  });
  for (const name of [
    "embed.html",
    "frame.schema.json",
    "react.d.ts",
    "react.js",
    ...TYPES,
  ])
    cpSync(at("www", name), at("dist", name));
  cpSync(at("www", "page.css"), at("dist", "embed.css"));
  mkdirSync(at("dist", "words"));
  for (const name of readdirSync(at("www", "words")).filter(
    (name) => name !== "core.json",
  ))
    cpSync(at("www", "words", name), at("dist", "words", name));
}

/** The types of the element: only its own, the rest is the core's. */
async function writeElementTypes() {
  const types = mkdtempSync(join(tmpdir(), "touchpath-"));
  await npx("tsc", "-p", "tsconfig.element.json", "--outDir", types);
  const own = readFileSync(join(types, "element.d.ts"), "utf8").replaceAll(
    "./core/types.js",
    "../types.js",
  );
  rmSync(types, { recursive: true });
  return own;
}

/** What is bundled: the element, with its types and its manifest, and the command; and the licences of all that is in them. */
async function buildBundles() {
  const vite = (/** @type {string} */ config) =>
    npx("vite", "build", "--config", config, "--logLevel", "warn");
  const [types] = await Promise.all([
    writeElementTypes(),
    vite("vite.element.config.mjs"),
    vite("vite.cli.config.mjs"),
    npx(
      "cem",
      "analyze",
      "--config",
      "custom-elements-manifest.config.mjs",
      "--quiet",
    ),
  ]);
  writeFileSync(at("dist", "element", "element.d.ts"), types);
  const bundled = ["element", "cli"].map((folder) =>
    at("dist", folder, "licences.txt"),
  );
  writeFileSync(
    at("dist", "licences.txt"),
    [
      crateLicences(),
      ...bundled.map((file) => readFileSync(file, "utf8")),
    ].join("\n"),
  );
  for (const file of bundled) rmSync(file);
  writeFileSync(
    at("dist", "web-types.json"),
    `${JSON.stringify(webTypes(), null, 2)}\n`,
  );
}

/** The JSON Schemas of a job, of a config and of what is answered, as files. */
async function writeSchema() {
  const { catalog, jobSchema } = await import(
    pathToFileURL(at("dist", "node.js")).href
  );
  // Its package is installed by the build itself.
  const { answerSchema } = await import("./answer-schema.mjs");
  const write = (/** @type {string} */ name, /** @type {unknown} */ schema) =>
    writeFileSync(at("dist", name), `${JSON.stringify(schema, null, 2)}\n`);
  write("schema.json", jobSchema());
  write("answers.schema.json", answerSchema());
  write("config.schema.json", configSchema(catalog(), jobSchema()));
}

/** The service worker with the names of all files of the page, and a version that is theirs. */
function writeWorker() {
  const page = at("dist", "page");
  const files = readdirSync(page, { recursive: true, encoding: "utf8" })
    .filter((name) => statSync(join(page, name)).isFile())
    .map((name) => name.replaceAll("\\", "/"))
    .sort();
  const hash = createHash("sha256");
  for (const file of files)
    hash.update(file).update(readFileSync(join(page, file)));
  const words = readdirSync(at("www", "words")).map((name) =>
    name.replace(".json", ""),
  );
  const rare = new RegExp(
    `^assets/(${["program-editor", "touchpath_bg", ...words].join("|")})-[\\w-]{8}\\.\\w+$`,
  );
  const wanted = files.filter(
    (file) => file === "licences.txt" || rare.test(file),
  );
  const all = [
    "./",
    ...files.filter((file) => file !== "index.html" && !wanted.includes(file)),
  ];
  const worker = readFileSync(at("www", "sw.js"), "utf8")
    .replace("const FILES = [];", `const FILES = ${JSON.stringify(all)};`)
    .replace("const WANTED = [];", `const WANTED = ${JSON.stringify(wanted)};`)
    .replace(
      'const VERSION = "";',
      `const VERSION = "${hash.digest("hex").slice(0, 16)}";`,
    );
  writeFileSync(join(page, "sw.js"), worker);
}

/** Vite writes the licences of the JavaScript that it bundles; the module's are put beneath them. */
async function buildPage() {
  await npx("vite", "build", "--logLevel", "warn");
  appendFileSync(at("dist", "page", "licences.txt"), `\n${crateLicences()}`);
  writeWorker();
}

/** The package and the page from modules that are there. */
export async function buildPackage() {
  await buildCore();
  // The manifest is the page's own affair, and the schemas are the core's: none waits for another.
  await Promise.all([buildBundles(), writeSchema(), buildPage()]);
}

/** The sizes of the module, as it is sent. */
export function printSizes() {
  const wasm = readFileSync(at("dist", "wasm", "touchpath_bg.wasm"));
  const kB = (/** @type {number} */ bytes) => `${(bytes / 1000).toFixed(1)} kB`;
  console.log(
    `wasm: ${kB(wasm.length)}, gzip ${kB(gzipSync(wasm, { level: 9 }).length)}, brotli ${kB(brotliCompressSync(wasm).length)}`,
  );
}

/** Everything: for who publishes it, or quickly for this machine. */
export async function build({ quick = false } = {}) {
  const [modules] = await stage("Packages and WebAssembly", () =>
    Promise.all([compileModules(quick), ensurePackages()]),
  );
  if (quick) await writeModules(modules, quick);
  else await stage("Optimization", () => writeModules(modules, quick));
  await stage("Package and page", buildPackage);
  if (!quick) printSizes();
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  await build({ quick: process.argv.includes("--quick") });
  summary();
}
