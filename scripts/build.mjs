// Builds the package into dist/ and the page into dist/page/, as they are published. `--quick` makes an equivalent build for this machine in a fraction of the
// time: without link-time optimization, and with the module in one part.
import { createHash } from "node:crypto";
import {
  appendFileSync,
  cpSync,
  existsSync,
  mkdirSync,
  mkdtempSync,
  readdirSync,
  readFileSync,
  rmSync,
  statSync,
  writeFileSync,
} from "node:fs";
import { tmpdir } from "node:os";
import { basename, join } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";
import { brotliCompressSync, gzipSync } from "node:zlib";
import { configSchema } from "./config-schema.mjs";
import { elementManifest } from "./element-manifest.mjs";
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
import { split, unnamed } from "./split.mjs";
import { webTypes } from "./web-types.mjs";

/** wasm-bindgen's name of the module. */
const MODULE = "touchpath_bg.wasm";

/** Target folder of the module: `wasm-pack build` reuses it. */
export const targetOf = (/** @type {string} */ folder) =>
  join(process.env.CARGO_TARGET_DIR ?? at("target"), folder);

const profileOf = (/** @type {boolean} */ quick) =>
  quick ? "quick" : "release";

/** Folder of the module and its bindings, with the names of its functions. */
const bindingsOf = (/** @type {boolean} */ quick) =>
  join(targetOf("wasm"), `bindings-${profileOf(quick)}`);

/** Compiles the crate to a module with a profile of Cargo.toml; returns its path. */
async function compile(/** @type {string} */ profile) {
  const target = targetOf("wasm");
  await beside("cargo", [
    "build",
    "--quiet",
    "--locked",
    "--profile",
    profile,
    "--target",
    "wasm32-unknown-unknown",
    "--lib",
    "--target-dir",
    target,
  ]);
  return `${target}/wasm32-unknown-unknown/${profile}/touchpath.wasm`;
}

/** Makes the module and its bindings; returns their folder. Needs no npm package. */
export async function compileModule(/** @type {boolean} */ quick) {
  ensureTarget();
  const [bindings, module] = await Promise.all([
    ensureBindings(),
    compile(profileOf(quick)),
  ]);
  const out = bindingsOf(quick);
  rmSync(out, { recursive: true, force: true });
  await beside(bindings, [module, out]);
  return out;
}

/** Shrinks the module for the download. */
async function optimize(/** @type {string} */ wasm) {
  await trapPanics(wasm);
  // The compressed size counts: inlining, packed memory and shared expressions make the module smaller but its compressed bytes larger. Jumps are rebuilt from
  // flat code, which compresses better. Functions whose names start alike are similar and compress best next to each other.
  const passes = [
    "--flatten",
    "--rereloop",
    "-O3",
    "-O3",
    "--reorder-functions-by-name",
  ];
  // First, functions that have become small or unused without panic messages are inlined.
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
  // The first kilobyte is the far end of the stack, which the linker puts first: no address below it is computed.
  const assume = ["--low-memory-unused"];
  const optimizer = at("node_modules", "binaryen", "bin", "wasm-opt");
  await beside("node", [
    optimizer,
    ...inline,
    ...passes,
    ...skip,
    ...assume,
    // The split uses the names.
    "-g",
    wasm,
    "-o",
    wasm,
  ]);
}

/** Writes the module without its names into www/core/wasm/, optimized unless the build is quick. */
export async function writeModule(
  /** @type {string} */ folder,
  /** @type {boolean} */ quick,
) {
  const [module, out] = [join(folder, MODULE), at("www", "core", "wasm")];
  if (!quick) await optimize(module);
  rmSync(out, { recursive: true, force: true });
  cpSync(folder, out, { recursive: true });
  if (!quick)
    writeFileSync(join(out, MODULE), await unnamed(readFileSync(module)));
  // The generated types use Symbol.dispose, which only the newest `lib` declares; strict compilers of users would fail.
  const types = `${out}/touchpath.d.ts`;
  const plain = readFileSync(types, "utf8").replaceAll(
    /^ *\[Symbol\.dispose\]\(\): void;\n/gm,
    "",
  );
  writeFileSync(
    types,
    `${plain}\nexport function join(rest: WebAssembly.Module): void;\n`,
  );
  writeJoin(join(out, "touchpath.js"));
}

/** A module in two parts is joined in every instance. */
function writeJoin(/** @type {string} */ script) {
  const source = readFileSync(script, "utf8");
  const begins =
    "    wasm = wasmInstance.exports;\n    wasm.__wbindgen_start();\n";
  if (source.split(begins).length !== 2)
    throw new Error("the bindings make their instance in another way");
  const joins = "    if (rest) new WebAssembly.Instance(rest, { p: wasm });\n";
  writeFileSync(
    script,
    `${source.replace(begins, begins + joins)}
let rest;
/** Joins the second part of the module to the first, now and in every new instance. */
export function join(module) {
    new WebAssembly.Instance(module, { p: wasm });
    rest = module;
}
`,
  );
}

/** Writes the two parts of the module for the page; in a quick build the first part has everything. */
export async function writeParts(/** @type {boolean} */ quick) {
  const module = readFileSync(join(bindingsOf(quick), MODULE));
  const { first, rest } = quick
    ? { first: module, rest: module.subarray(0, 8) }
    : await split(module);
  writeFileSync(at("www", "core", "wasm", "first.wasm"), first);
  writeFileSync(at("www", "core", "wasm", "rest.wasm"), rest);
}

/** Folder of the package `touchpath-element`. */
const ELEMENT = at("dist", "touchpath-element");

/** Builds the package except for its bundles. */
async function buildCore() {
  rmSync(at("dist"), { recursive: true, force: true });
  await npx("tsc", "-p", "tsconfig.package.json");
  // Only the page uses the parts of the module, and nobody its bare exports.
  cpSync(at("www", "core", "wasm"), at("dist", "wasm"), {
    recursive: true,
    filter: (path) => !/(first|rest)\.wasm$|_bg\.wasm\.d\.ts$/.test(path),
  });
  // The same as those of Node.
  rmSync(at("dist", "workerd.d.ts"));
  // Only the class View is public, and has its comments.
  const types = at("dist", "wasm", "touchpath.d.ts");
  const [head = "", view = ""] = readFileSync(types, "utf8").split(
    /(?=export class View)/,
  );
  const end = view.indexOf("\n}\n");
  const bare = (/** @type {string} */ text) =>
    text.replaceAll(/\/\*\*[\s\S]*?\*\/\n/g, "");
  writeFileSync(types, bare(head) + view.slice(0, end) + bare(view.slice(end)));
  for (const folder of ["", "wasm"]) await withoutComments(at("dist", folder));
}

/** Takes the comments out of the scripts of a folder: the types have them. */
async function withoutComments(/** @type {string} */ folder) {
  // The build itself installs its package.
  const { transform } = await import("esbuild");
  const scripts = readdirSync(folder).filter((name) => name.endsWith(".js"));
  for (const file of scripts.map((name) => join(folder, name))) {
    const source = readFileSync(file, "utf8");
    const { code } = await transform(source, {
      minifySyntax: true,
      minifyWhitespace: true,
      // Node shows the line of an error that nobody catches. Bundlers look for `import.meta.url` within a line.
      lineLimit: source.includes("import.meta") ? undefined : 100,
    });
    writeFileSync(file, code);
  }
}

/** Builds the package `touchpath-element` except for its bundles: it takes the functions from the package `touchpath`. */
function buildElement() {
  mkdirSync(join(ELEMENT, "words"), { recursive: true });
  for (const name of readdirSync(at("www", "package")))
    cpSync(at("www", "package", name), join(ELEMENT, name));
  for (const name of ["embed", "events", "frame", "protocol"])
    for (const ending of ["js", "d.ts"]) {
      const file = at("dist", `${name}.${ending}`);
      const text = readFileSync(file, "utf8")
        .replaceAll('"./types.js"', '"touchpath"')
        .replaceAll('"./browser.js"', '"./core.js"');
      writeFileSync(join(ELEMENT, `${name}.${ending}`), text);
      rmSync(file);
    }
  const write = (/** @type {string} */ name, /** @type {string} */ text) =>
    writeFileSync(join(ELEMENT, name), text);
  write("core.js", 'export * from "touchpath/browser";\n');
  write("report.js", 'export * from "touchpath/report";\n');
  for (const name of readdirSync(at("www", "words")).filter(
    (name) => name !== "core.json",
  )) {
    const words = JSON.parse(readFileSync(at("www", "words", name), "utf8"));
    write(
      `words/${basename(name, ".json")}.js`,
      `export default ${JSON.stringify(words, null, 1)};\n`,
    );
  }
  write(
    "words/words.d.ts",
    'import type { Words } from "touchpath";\ndeclare const words: Words;\nexport default words;\n',
  );
  cpSync(at("www", "page.css"), join(ELEMENT, "embed.css"));
  for (const name of ["CHANGELOG.md", "LICENSE-MIT", "LICENSE-APACHE"])
    cpSync(at(name), join(ELEMENT, name));
  // The manual without its pictures, and the examples.
  const manual = (/** @type {string} */ path) => !/\.(png|svg)$/.test(path);
  const example = (/** @type {string} */ path) =>
    !/\.(rs|pyc)$|__pycache__|node_modules/.test(path);
  for (const [folder, filter] of /** @type {const} */ ([
    ["docs", manual],
    ["examples", example],
  ]))
    cpSync(at(folder), join(ELEMENT, folder), { recursive: true, filter });
  const manifest = elementManifest();
  for (const name of readdirSync(at("examples"))) {
    const own = `examples/${name}/package.json`;
    // Outside the repository an example takes the packages from the registry.
    if (existsSync(join(ELEMENT, own)))
      write(
        own,
        readFileSync(at(own), "utf8").replaceAll(
          /"file:[^"]*"/g,
          `"${manifest.version}"`,
        ),
      );
  }
  const json = (/** @type {unknown} */ value) =>
    `${JSON.stringify(value, null, 2)}\n`;
  write("package.json", json(manifest));
}

/** Types of the elements by file name: only their own, the core has the rest. */
async function elementTypes() {
  const types = mkdtempSync(join(tmpdir(), "touchpath-"));
  await npx("tsc", "-p", "tsconfig.element.json", "--outDir", types);
  const inside = readdirSync(join(types, "element"));
  const files = ["element.d.ts", ...inside.map((name) => `element/${name}`)];
  const own = files.map((file) => [
    basename(file),
    readFileSync(join(types, file), "utf8")
      .replaceAll('"./element/', '"./')
      .replaceAll(/"\.\.?\/core\/types\.js"/g, '"touchpath"')
      .replaceAll(/"\.\.?\/core\/events\.js"/g, '"../events.js"'),
  ]);
  rmSync(types, { recursive: true });
  return Object.fromEntries(own);
}

/** Builds the bundles: the element with its types and manifest, the command, and the licences of their contents. */
async function buildBundles() {
  const vite = (/** @type {string} */ config) =>
    npx("vite", "build", "--config", config, "--logLevel", "warn");
  const [types] = await Promise.all([
    elementTypes(),
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
  for (const [name, text] of Object.entries(types))
    writeFileSync(join(ELEMENT, "element", name), text);
  const take = (/** @type {string} */ file) => {
    const text = readFileSync(file, "utf8");
    rmSync(file);
    return text;
  };
  writeFileSync(
    at("dist", "licences.txt"),
    `${crateLicences()}\n${take(at("dist", "cli", "licences.txt"))}`,
  );
  writeFileSync(
    join(ELEMENT, "licences.txt"),
    take(join(ELEMENT, "element", "licences.txt")),
  );
  // The build itself installs their packages.
  const [{ sbom }, { buildExtension }] = await Promise.all([
    import("./sbom.mjs"),
    import("./vscode.mjs"),
  ]);
  mkdirSync(at("dist", "sbom"));
  for (const [name, folder, manifest] of /** @type {const} */ ([
    ["touchpath", at("dist"), at("package.json")],
    ["touchpath-element", ELEMENT, join(ELEMENT, "package.json")],
  ]))
    writeFileSync(
      at("dist", "sbom", `${name}.cdx.json`),
      sbom(folder, manifest),
    );
  await buildExtension();
  writeFileSync(
    join(ELEMENT, "web-types.json"),
    `${JSON.stringify(webTypes(), null, 2)}\n`,
  );
}

/** Writes the JSON Schemas of a job, a config and the answers. */
async function writeSchema() {
  const { catalog, jobSchema } = await import(
    pathToFileURL(at("dist", "node.js")).href
  );
  // The build itself installs its package.
  const { answerSchema } = await import("./answer-schema.mjs");
  const write = (/** @type {string} */ name, /** @type {unknown} */ schema) =>
    writeFileSync(at("dist", name), `${JSON.stringify(schema)}\n`);
  write("schema.json", jobSchema());
  write("answers.schema.json", answerSchema());
  write("config.schema.json", configSchema(catalog(), jobSchema()));
}

/** Writes the service worker with the names of all files of the page and their common version. */
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
    `^assets/(${["program-editor", "rest", ...words].join("|")})-[\\w-]{8}\\.\\w+$`,
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

/** Vite writes the licences of the bundled JavaScript; those of the module are appended. */
async function buildPage() {
  await npx("vite", "build", "--logLevel", "warn");
  appendFileSync(at("dist", "page", "licences.txt"), `\n${crateLicences()}`);
  writeWorker();
}

/** Builds the package and the page from an existing module; the page from its parts. */
export async function buildPackage(parts = async () => {}) {
  await buildCore();
  buildElement();
  // The manifest belongs to the elements and the schemas to the core: neither waits for the other.
  await Promise.all([buildBundles(), writeSchema(), parts().then(buildPage)]);
}

/** Prints the compressed sizes of the module. */
export function printSizes() {
  const wasm = readFileSync(at("dist", "wasm", "touchpath_bg.wasm"));
  const kB = (/** @type {number} */ bytes) => `${(bytes / 1000).toFixed(1)} kB`;
  console.log(
    `wasm: ${kB(wasm.length)}, gzip ${kB(gzipSync(wasm, { level: 9 }).length)}, brotli ${kB(brotliCompressSync(wasm).length)}`,
  );
}

/** Builds everything, for publication or quickly for this machine. */
export async function build({ quick = false } = {}) {
  const [folder] = await stage("Packages and WebAssembly", () =>
    Promise.all([compileModule(quick), ensurePackages()]),
  );
  if (quick) await writeModule(folder, quick);
  else await stage("Optimization", () => writeModule(folder, quick));
  await stage("Package and page", () => buildPackage(() => writeParts(quick)));
  if (!quick) printSizes();
}

if (process.argv[1] === fileURLToPath(import.meta.url)) {
  await build({ quick: process.argv.includes("--quick") });
  summary();
}
