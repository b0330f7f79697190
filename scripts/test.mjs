// Installs missing tools and runs every test, in parallel stages. `setup` only installs; `check` makes a quick build and checks format, lints and types; the
// name of a stage runs that stage alone. Laws and fuzzer use random cases: `--seed N` repeats those of an earlier run.
import { spawnSync } from "node:child_process";
import { readdirSync, rmSync } from "node:fs";
import { dirname } from "node:path";
import { parseArgs } from "node:util";
import {
  build,
  buildPackage,
  compileModule,
  printSizes,
  targetOf,
  writeModule,
  writeParts,
} from "./build.mjs";
import {
  at,
  ensureBindgen,
  ensureChromium,
  ensureDebianPackages,
  ensureFirefox,
  ensureInterpreter,
  ensureOldestRust,
  ensurePackages,
  ensureTarget,
  ensureWasmPack,
  ensureWebKit,
  fuzz,
  npx,
  pathWith,
  root,
  run,
} from "./lib.mjs";
import { runStages } from "./stages.mjs";

/** @typedef {import("./stages.mjs").Stage} Stage */

const { values, positionals } = parseArgs({
  options: { seed: { type: "string" } },
  allowPositionals: true,
});
const seed =
  values.seed === undefined
    ? Date.now() % 2 ** 32
    : Number(values.seed || Number.NaN);
const random = { FUZZ_SEED: String(seed), PROPTEST_RNG_SEED: String(seed) };

/** The test files of a folder, by name: Node's versions differ in what a folder means to the test runner. */
const tests = (/** @type {string} */ folder) =>
  readdirSync(at("tests", folder))
    .filter((name) => name.endsWith(".test.mjs"))
    .map((name) => at("tests", folder, name));
/** A test that hangs fails. */
const patient = ["--test", "--test-timeout=900000"];
const nodeTests = (
  /** @type {string} */ folder,
  /** @type {string[]} */ ...flags
) =>
  run(
    "node",
    [
      ...patient,
      ...flags,
      ...tests(folder).filter((file) => !file.endsWith(ENGINES)),
    ],
    {
      env: { CHROMIUM: ensureChromium().shell },
    },
  );
/** The tests in other browsers. */
const ENGINES = "engines.test.mjs";

/** Tests the page in Firefox and WebKit. */
function engines() {
  const [chromium, firefox, webkit] = [
    ensureChromium(),
    ensureFirefox(),
    ensureWebKit(),
  ];
  const env = {
    CHROMIUM: chromium.shell,
    FIREFOX: firefox.browser,
    GECKODRIVER: firefox.driver,
    WEBKITDRIVER: webkit.driver,
    XVFB_RUN: webkit.screen,
  };
  run("node", [...patient, at("tests", "page", ENGINES)], { env });
}

/** Least number of tests that must have passed, by command. wasm-pack silently skips a test file without a fitting mode, so the tests are counted. */
const LEAST = { "test --node": 7, "test --headless --chrome": 7 };

/** Runs wasm-pack as a user would. It finds chromedriver, and wasm-bindgen of the version in Cargo.lock, on the path. */
async function wasmPack(/** @type {string[]} */ ...args) {
  const command = args.join(" ");
  const least = LEAST[/** @type {keyof typeof LEAST} */ (command)] ?? 0;
  const path = pathWith(
    ensureWasmPack(),
    await ensureBindgen(),
    dirname(ensureChromium().driver),
  );
  const done = spawnSync("wasm-pack", args, {
    cwd: root,
    encoding: "utf8",
    // Target folder of the whole module: `wasm-pack build` then has nothing left to compile.
    env: { ...process.env, ...path, CARGO_TARGET_DIR: targetOf("wasm") },
  });
  process.stdout.write(`${done.stdout ?? ""}${done.stderr ?? ""}`);
  const passed = [
    ...`${done.stdout}${done.stderr}`.matchAll(/(\d+) passed/g),
  ].reduce((sum, [, n]) => sum + Number(n), 0);
  if (done.status === 0 && passed >= least) return;
  console.error(
    `wasm-pack ${command}: exit ${done.status}, ${passed} tests passed, ${least} expected`,
  );
  process.exit(1);
}

const cargo = (/** @type {string[]} */ ...args) =>
  run("cargo", args, { env: { RUSTDOCFLAGS: "-D warnings" } });
const clippy = (/** @type {string[]} */ ...args) =>
  cargo("clippy", "--quiet", "--locked", ...args, "--", "-D", "warnings");

/** Tools that a machine may lack. @type {Stage[]} */
const SETUP = [
  { name: "Packages", after: [], work: ensurePackages },
  {
    name: "Rust",
    after: [],
    work: () => {
      ensureTarget();
      ensureOldestRust();
    },
  },
  { name: "Debian packages", after: [], work: ensureDebianPackages },
  {
    name: "Tools of tests",
    patient: true,
    after: ["Rust"],
    work: async () => {
      await ensureBindgen();
      ensureWasmPack();
      ensureFirefox();
    },
  },
];

async function format() {
  await npx("biome", "ci", "--error-on-warnings", ".");
  cargo("fmt", "--all", "--check");
}

function lints() {
  clippy("--all-targets");
  clippy("--lib", "--target", "wasm32-unknown-unknown");
}

const types = () =>
  Promise.all([
    npx("tsc", "-p", "tsconfig.json"),
    npx("tsc", "-p", "tsconfig.scripts.json"),
  ]);

/** Stages of `npm run check`. @type {Stage[]} */
const CHECKS = [
  { name: "Format", after: ["Packages"], work: format },
  { name: "Lints", patient: true, after: ["Rust"], work: lints },
  { name: "Types", after: ["Package"], work: types },
];

const native = ["test", "--locked"];

/**
 * All stages, in the order in which ready ones start. The module comes first, because the tests of the page are the longest, and while a page waits, compilers
 * have a core. Stages with the same cargo folder run one after the other.
 * @type {Stage[]}
 */
const TESTS = [
  ...SETUP.slice(0, 3),
  {
    name: "WebAssembly",
    after: ["Rust"],
    work: async () => {
      const folder = await compileModule(false);
      // Another stage installs the packages, and has finished by then.
      await ensurePackages();
      await writeModule(folder, false);
    },
  },
  {
    name: "Package",
    after: ["WebAssembly"],
    work: async () => {
      await buildPackage(() => writeParts(false));
      printSizes();
    },
  },
  ...SETUP.slice(3),
  {
    name: "Page tests",
    after: ["Package", "Debian packages"],
    work: () => nodeTests("page", "--test-concurrency=2"),
  },
  {
    name: "Page tests in other browsers",
    after: ["Package", "Tools of tests"],
    work: engines,
  },
  { name: "Lints", patient: true, after: ["Rust"], work: lints },
  {
    name: "Native tests, compiled",
    patient: true,
    after: ["Lints"],
    work: () => cargo(...native, "--no-run"),
  },
  {
    name: "Native tests",
    patient: true,
    after: ["Native tests, compiled", "Debian packages"],
    work: () =>
      run("cargo", native, {
        env: {
          ...random,
          RS274: ensureInterpreter(),
          CI: "1",
          INSTA_UPDATE: "no",
        },
      }),
  },
  {
    name: "WebAssembly tests",
    patient: true,
    after: ["WebAssembly", "Tools of tests"],
    work: async () => {
      await wasmPack("test", "--node");
      await wasmPack("test", "--headless", "--chrome");
      await wasmPack("build");
      rmSync(at("pkg"), { recursive: true });
    },
  },
  {
    name: "Project tests",
    after: ["Package", "Native tests, compiled", "Debian packages"],
    work: () => nodeTests("projects"),
  },
  {
    name: "Package tests",
    after: ["Package"],
    work: () => nodeTests("package"),
  },
  {
    name: "Fuzz",
    patient: true,
    after: ["Native tests, compiled"],
    work: () => fuzz(60_000, random),
  },
  {
    name: "Oldest Rust",
    patient: true,
    after: ["Rust"],
    work: () =>
      cargo(
        `+${ensureOldestRust()}`,
        "check",
        "--quiet",
        "--locked",
        "--target-dir",
        targetOf("oldest"),
      ),
  },
  {
    name: "Documentation",
    patient: true,
    after: ["Native tests, compiled"],
    work: () => cargo("doc", "--quiet", "--locked", "--no-deps", "--lib"),
  },
  { name: "Format", after: ["Packages"], work: format },
  { name: "Types", after: ["Package"], work: types },
];

const names = ["setup", "check", ...TESTS.map(({ name }) => name)];
const [only, ...more] = positionals;
if (
  more.length > 0 ||
  (only && !names.includes(only)) ||
  !Number.isSafeInteger(seed) ||
  seed < 0
) {
  console.error(
    `test.mjs takes --seed with a whole number, and one of: ${names.join("; ")}`,
  );
  process.exit(2);
}
const stage = TESTS.find(({ name }) => name === only);
const again = (/** @type {string} */ name) => [name, "--seed", String(seed)];
const sameCases = `The same random cases again: npm test -- --seed ${seed}`;
/** Only these stages; their requirements exist already. */
const alone = (/** @type {Stage[]} */ stages) =>
  stages.map((one) => ({
    ...one,
    after: one.after.filter((name) =>
      stages.some((other) => other.name === name),
    ),
  }));
if (stage) await stage.work();
else if (only === "setup") await runStages(alone(SETUP), again);
else if (only === "check") {
  await build({ quick: true });
  await runStages(alone(CHECKS), again);
} else {
  console.log(sameCases);
  await runStages(TESTS, again, sameCases);
}
