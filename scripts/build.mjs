// Builds the package into dist/ and the page into dist/page/.
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
import { at, beside, ensureBindgen, ensurePackages, ensureTarget, run, stage, summary } from "./lib.mjs";
import { crateLicences } from "./licences.mjs";
import { trapPanics } from "./panics.mjs";
import { webTypes } from "./web-types.mjs";

/** Where the two modules are built: one whole, and without what a first visit of the page does not need. */
const MODULES = { whole: { folder: "", flags: [] }, first: { folder: "first", flags: ["--no-default-features"] } };

/** A WebAssembly module and its bindings, optimised; gives the folder they are in. */
async function buildModule(/** @type {{ folder: string, flags: string[] }} */ { folder, flags }) {
  const bin = ensureBindgen();
  // A folder of its own: cargo builds one thing at a time in a folder.
  const target = join(process.env.CARGO_TARGET_DIR ?? at("target"), folder);
  const cargo = ["build", "--quiet", "--locked", "--release", "--target", "wasm32-unknown-unknown", "--lib"];
  await beside("cargo", [...cargo, ...flags, "--target-dir", target]);
  const out = join(target, "wasm");
  rmSync(out, { recursive: true, force: true });
  // With the function that replaces a broken instance: www/core/instance.ts calls it.
  const module = `${target}/wasm32-unknown-unknown/release/touchpath.wasm`;
  run(`${bin}/wasm-bindgen`, [module, "--target", "web", "--out-dir", out, "--experimental-reset-state-function"]);
  const wasm = `${out}/touchpath_bg.wasm`;
  await trapPanics(wasm);
  // Judged by what is sent, not by the module: inlining, packed memory and shared expressions make it smaller and its compressed bytes more. Jumps are
  // laid out anew from flat code, which compresses better. Functions of one name's beginning are alike and compress best side by side.
  const optimize = ["--flatten", "--rereloop", "-O3", "-O3", "--reorder-functions-by-name"];
  // First, what became small or unused with the messages of panics is put where it is called.
  const inline = ["--dae-optimizing", "--inlining", "-aimfs", "4", "-fimfs", "2", "-ocimfs", "2", "--dce", "--vacuum"];
  const passes = ["inlining-optimizing", "memory-packing", "local-cse", "simplify-locals"];
  const skip = passes.map((pass) => `--skip-pass=${pass}`);
  // The first kilobyte is the far end of the stack, which the linker puts first: no address is computed from below it.
  const assume = ["--low-memory-unused"];
  const optimizer = at("node_modules", "binaryen", "bin", "wasm-opt");
  await beside("node", [optimizer, ...inline, ...optimize, ...skip, ...assume, wasm, "-o", wasm]);
  return out;
}

/** Both modules, into www/core/wasm/, with the bindings of the whole one: they serve both. */
async function buildWasm() {
  const [whole, first] = await Promise.all([buildModule(MODULES.whole), buildModule(MODULES.first)]);
  const out = at("www", "core", "wasm");
  rmSync(out, { recursive: true, force: true });
  cpSync(whole, out, { recursive: true });
  cpSync(join(first, "touchpath_bg.wasm"), join(out, "first.wasm"));
  // The generated types name Symbol.dispose, which only the newest `lib` knows: users' strict compilers must not stumble.
  const types = `${out}/touchpath.d.ts`;
  const plain = readFileSync(types, "utf8").replaceAll(/^ *\[Symbol\.dispose\]\(\): void;\n/gm, "");
  writeFileSync(types, `${plain}\nexport function use(module: WebAssembly.Module): void;\n`);
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

function buildPackage() {
  rmSync(at("dist"), { recursive: true, force: true });
  run("npx", ["--no-install", "tsc", "-p", "tsconfig.package.json"]);
  // The first module is the page's alone.
  cpSync(at("www", "core", "wasm"), at("dist", "wasm"), {
    recursive: true,
    filter: (path) => !path.endsWith("first.wasm"),
  });
  writeFileSync(at("dist", "licences.txt"), crateLicences());
  for (const name of ["embed.html", "frame.schema.json", "react.d.ts", "react.js", ...TYPES])
    cpSync(at("www", name), at("dist", name));
  cpSync(at("www", "page.css"), at("dist", "embed.css"));
  mkdirSync(at("dist", "words"));
  for (const name of readdirSync(at("www", "words")).filter((name) => name !== "core.json"))
    cpSync(at("www", "words", name), at("dist", "words", name));
  buildBundles();
}

/** What is bundled: the element, with its types (only its own: the rest is the core's) and its manifest, and the command. */
function buildBundles() {
  run("npx", ["--no-install", "vite", "build", "--config", "vite.element.config.mjs", "--logLevel", "warn"]);
  run("npx", ["--no-install", "vite", "build", "--config", "vite.cli.config.mjs", "--logLevel", "warn"]);
  const types = mkdtempSync(join(tmpdir(), "touchpath-"));
  run("npx", ["--no-install", "tsc", "-p", "tsconfig.element.json", "--outDir", types]);
  const own = readFileSync(join(types, "element.d.ts"), "utf8").replaceAll("./core/types.js", "../types.js");
  rmSync(types, { recursive: true });
  writeFileSync(at("dist", "element", "element.d.ts"), own);
  for (const folder of ["element", "cli"]) {
    const bundled = at("dist", folder, "licences.txt");
    appendFileSync(at("dist", "licences.txt"), `\n${readFileSync(bundled, "utf8")}`);
    rmSync(bundled);
  }
  run("npx", ["--no-install", "cem", "analyze", "--config", "custom-elements-manifest.config.mjs", "--quiet"]);
  writeFileSync(at("dist", "web-types.json"), `${JSON.stringify(webTypes(), null, 2)}\n`);
}

/** The JSON Schemas of a job, of a config and of what is answered, as files. */
async function writeSchema() {
  const { catalog, jobSchema } = await import(pathToFileURL(at("dist", "node.js")).href);
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
  for (const file of files) hash.update(file).update(readFileSync(join(page, file)));
  const words = readdirSync(at("www", "words")).map((name) => name.replace(".json", ""));
  const rare = new RegExp(`^assets/(${["program-editor", "touchpath_bg", ...words].join("|")})-[\\w-]{8}\\.\\w+$`);
  const wanted = files.filter((file) => file === "licences.txt" || rare.test(file));
  const all = ["./", ...files.filter((file) => file !== "index.html" && !wanted.includes(file))];
  const worker = readFileSync(at("www", "sw.js"), "utf8")
    .replace("const FILES = [];", `const FILES = ${JSON.stringify(all)};`)
    .replace("const WANTED = [];", `const WANTED = ${JSON.stringify(wanted)};`)
    .replace('const VERSION = "";', `const VERSION = "${hash.digest("hex").slice(0, 16)}";`);
  writeFileSync(join(page, "sw.js"), worker);
}

/** Vite writes the licences of the JavaScript that it bundles; the module's are put beneath them. */
function buildPage() {
  run("npx", ["--no-install", "vite", "build", "--logLevel", "warn"]);
  appendFileSync(at("dist", "page", "licences.txt"), `\n${crateLicences()}`);
  writeWorker();
}

/** Everything. */
export async function build() {
  await stage("Packages", ensurePackages);
  await stage("WebAssembly", async () => {
    ensureTarget();
    await buildWasm();
  });
  await stage("Package", async () => {
    buildPackage();
    await writeSchema();
  });
  await stage("Page", buildPage);
  const wasm = readFileSync(at("dist", "wasm", "touchpath_bg.wasm"));
  const kB = (/** @type {number} */ bytes) => `${(bytes / 1000).toFixed(1)} kB`;
  console.log(
    `wasm: ${kB(wasm.length)}, gzip ${kB(gzipSync(wasm, { level: 9 }).length)}, brotli ${kB(brotliCompressSync(wasm).length)}`,
  );
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  await build();
  summary();
}
