// Sets up what a machine lacks and runs every test. `setup` only sets up; `check` builds, then checks format, lints and types.
// Laws and fuzzer ask random cases: `--seed N` asks those of an earlier run again.
import { spawnSync } from "node:child_process";
import { readdirSync, rmSync } from "node:fs";
import { dirname } from "node:path";
import { parseArgs } from "node:util";
import { build } from "./build.mjs";
import {
  at,
  ensureBindgen,
  ensureChromium,
  ensureFirefox,
  ensureInterpreter,
  ensureOldestRust,
  ensurePackages,
  ensureTarget,
  ensureWasmPack,
  ensureWebKit,
  fuzz,
  pathWith,
  root,
  run,
  stage,
  summary,
} from "./lib.mjs";

const { values, positionals } = parseArgs({ options: { seed: { type: "string" } }, allowPositionals: true });
const [only, ...more] = positionals;
const seed = values.seed === undefined ? Date.now() % 2 ** 32 : Number(values.seed || Number.NaN);
if (more.length > 0 || ![undefined, "setup", "check"].includes(only) || !Number.isSafeInteger(seed) || seed < 0) {
  console.error("test.mjs takes nothing, setup or check, and --seed with a whole number");
  process.exit(2);
}
const random = { FUZZ_SEED: String(seed), PROPTEST_RNG_SEED: String(seed) };
/** The test files of a folder, by name: what a folder means to Node's runner differs from version to version. */
const tests = (/** @type {string} */ folder) =>
  readdirSync(at("tests", folder))
    .filter((name) => name.endsWith(".test.mjs"))
    .map((name) => at("tests", folder, name));
/** A test that hangs is a test that fails. */
const patient = ["--test", "--test-timeout=900000"];
const npx = (/** @type {string[]} */ ...args) => run("npx", ["--no-install", ...args]);

/** How many tests must have passed, by the command. wasm-pack skips a test file that has no fitting mode without failing: the tests are counted. */
const LEAST = { "test --node": 7, "test --headless --chrome": 7 };

/**
 * A command of wasm-pack.
 * @param {Record<string, string | undefined>} env
 * @param {string[]} args
 */
function wasmPack(env, ...args) {
  const command = args.join(" ");
  const least = LEAST[/** @type {keyof typeof LEAST} */ (command)] ?? 0;
  const done = spawnSync("wasm-pack", args, {
    cwd: root,
    encoding: "utf8",
    env: { ...process.env, ...env },
  });
  process.stdout.write(done.stdout ?? "");
  process.stderr.write(done.stderr ?? "");
  const passed = [...`${done.stdout}${done.stderr}`.matchAll(/(\d+) passed/g)].reduce(
    (sum, [, n]) => sum + Number(n),
    0,
  );
  if (done.status !== 0 || passed < least) {
    console.error(`\nFailed: wasm-pack ${command}: exit ${done.status}, ${passed} tests passed, ${least} expected`);
    summary();
    process.exit(1);
  }
}

const tools = await stage("Set-up", () => {
  ensurePackages();
  ensureTarget();
  if (only === "check") return null;
  return {
    rs274: ensureInterpreter(),
    chromium: ensureChromium(),
    firefox: ensureFirefox(),
    webkit: ensureWebKit(),
    bindgen: ensureBindgen(),
    wasmPack: ensureWasmPack(),
    oldest: ensureOldestRust(),
  };
});

if (only !== "setup") {
  if (only === "check") await build();
  await stage("Format and lints", () => {
    npx("biome", "ci", "--error-on-warnings", ".");
    run("cargo", ["fmt", "--all", "--check"]);
    run("cargo", ["clippy", "--quiet", "--locked", "--all-targets", "--", "-D", "warnings"]);
    const wasm = ["clippy", "--quiet", "--locked", "--lib", "--target", "wasm32-unknown-unknown"];
    for (const features of [[], ["--no-default-features"]])
      run("cargo", [...wasm, ...features, "--", "-D", "warnings"]);
    run("cargo", ["doc", "--quiet", "--locked", "--no-deps", "--lib"], { env: { RUSTDOCFLAGS: "-D warnings" } });
  });
}
if (tools && !only) {
  console.log(`Random cases of this run: npm test -- --seed ${seed}`);
  await stage("Native tests", () =>
    run("cargo", ["test", "--locked"], { env: { ...random, RS274: tools.rs274, CI: "1", INSTA_UPDATE: "no" } }),
  );
  await stage("Oldest Rust", () =>
    run("cargo", [`+${tools.oldest}`, "check", "--quiet", "--locked"], {
      env: { CARGO_TARGET_DIR: at("target", "oldest") },
    }),
  );
  await stage("Fuzz", () => fuzz(200_000, random));
  await build();
}
if (only !== "setup") {
  await stage("Types", () => {
    npx("tsc", "-p", "tsconfig.json");
    npx("tsc", "-p", "tsconfig.scripts.json");
  });
}
if (tools && !only) {
  // As anyone types them. What wasm-pack looks for it finds on the path: chromedriver, and wasm-bindgen of the version in Cargo.lock.
  const env = pathWith(tools.wasmPack, tools.bindgen, dirname(tools.chromium.driver));
  await stage("WebAssembly tests in Node", () => wasmPack(env, "test", "--node"));
  await stage("WebAssembly tests in Chromium", () => wasmPack(env, "test", "--headless", "--chrome"));
  await stage("wasm-pack's own package", () => {
    wasmPack(env, "build");
    rmSync(at("pkg"), { recursive: true });
  });
  await stage("Package tests", () => run("node", [...patient, ...tests("package")]));
  const { chromium, firefox, webkit } = tools;
  const browser = {
    env: {
      CHROMIUM: chromium.shell,
      FIREFOX: firefox.browser,
      GECKODRIVER: firefox.driver,
      WEBKITDRIVER: webkit.driver,
      XVFB_RUN: webkit.screen,
    },
  };
  await stage("Project tests", () => run("node", [...patient, ...tests("projects")], browser));
  // Two files at a time: a page waits for its module and its workers, and two cores do both.
  await stage("Page tests", () => run("node", [...patient, "--test-concurrency=2", ...tests("page")], browser));
}
summary();
