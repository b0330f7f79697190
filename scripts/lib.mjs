// Shared by the scripts: running commands, timing stages, installing missing tools. Uses Node built-ins only.
import { spawn, spawnSync } from "node:child_process";
import {
  existsSync,
  mkdirSync,
  mkdtempSync,
  readFileSync,
  rmSync,
  statSync,
  writeFileSync,
} from "node:fs";
import { tmpdir } from "node:os";
import { delimiter, join } from "node:path";
import { fileURLToPath } from "node:url";

export const root = fileURLToPath(new URL("..", import.meta.url)).replace(
  /[\\/]$/,
  "",
);
export const at = (/** @type {string[]} */ ...parts) => join(root, ...parts);

const target = process.env.CARGO_TARGET_DIR ?? at("target");
const tools = join(target, "tools");
/** Finished stages, and their seconds. @type {[string, number][]} */
const stages = [];

/**
 * Runs a command and shows its output. Ends the script if the command fails.
 * @param {string} command
 * @param {string[]} args
 * @param {{ env?: Record<string, string | undefined>, cwd?: string, quiet?: boolean }} [options]
 */
export function run(
  command,
  args,
  { env = {}, cwd = root, quiet = false } = {},
) {
  const done = spawnSync(command, args, {
    cwd,
    stdio: quiet ? "pipe" : "inherit",
    encoding: "utf8",
    env: { ...process.env, ...env },
  });
  if (done.status !== 0) {
    if (quiet) process.stderr.write(`${done.stdout ?? ""}${done.stderr ?? ""}`);
    failed(
      command,
      args,
      done.error ? done.error.message : `exit ${done.status ?? done.signal}`,
    );
  }
  return done.stdout ?? "";
}

/** Runs a command in parallel with others, like `run`; their output may be mixed. */
export async function beside(
  /** @type {string} */ command,
  /** @type {string[]} */ args,
) {
  const code = await new Promise((done) => {
    spawn(command, args, { cwd: root, stdio: "inherit" })
      .on("close", done)
      .on("error", done);
  });
  if (code !== 0) failed(command, args, `exit ${code}`);
}

/** Runs a command of an npm package, like `beside`. */
export const npx = (/** @type {string[]} */ ...args) =>
  beside("npx", ["--no-install", ...args]);

/** Ends the script and names the command that failed. @returns {never} */
function failed(
  /** @type {string} */ command,
  /** @type {string[]} */ args,
  /** @type {string} */ why,
) {
  console.error(`\nFailed: ${command} ${args.join(" ")} (${why})`);
  summary();
  process.exit(1);
}

/** Checks the laws with random jobs: a quarter of them are always the same, the rest fresh. Ends the script if a job breaks a law. */
export function fuzz(
  /** @type {number} */ jobs,
  /** @type {Record<string, string>} */ seed = {},
) {
  const own = ["--profile", "fuzz", "--target-dir", join(target, "fuzzer")];
  run("cargo", ["test", "--locked", "--quiet", "--test", "fuzz", ...own], {
    env: { ...seed, FUZZ_JOBS: String(jobs) },
  });
}

/** Whether a command exists and works. */
export function works(
  /** @type {string} */ command,
  args = ["--version"],
  env = {},
) {
  return (
    spawnSync(command, args, {
      stdio: "ignore",
      env: { ...process.env, ...env },
    }).status === 0
  );
}

/**
 * Runs a stage and notes its duration.
 * @template T
 * @param {string} name
 * @param {() => T | Promise<T>} work
 */
export async function stage(name, work) {
  const start = performance.now();
  console.log(`\n== ${name}`);
  const result = await work();
  const seconds = (performance.now() - start) / 1000;
  stages.push([name, seconds]);
  console.log(`-- ${name}: ${seconds.toFixed(1)} s`);
  return result;
}

/** Prints the duration of every stage. */
export function summary() {
  if (stages.length === 0) return;
  console.log("\nStages:");
  for (const [name, seconds] of stages)
    console.log(`  ${seconds.toFixed(1).padStart(7)} s  ${name}`);
  const whole = stages.reduce((sum, [, seconds]) => sum + seconds, 0);
  console.log(`  ${whole.toFixed(1).padStart(7)} s  in all`);
}

/** Installs the npm packages of package-lock.json. */
export async function ensurePackages() {
  const marker = at("node_modules", ".package-lock.json");
  const fresh =
    existsSync(marker) &&
    statSync(marker).mtimeMs >= statSync(at("package-lock.json")).mtimeMs;
  if (!fresh)
    await beside("npm", ["ci", "--no-audit", "--no-fund", "--loglevel=error"]);
}

/** Installs Rust's WebAssembly target. */
export function ensureTarget() {
  const name = "wasm32-unknown-unknown";
  const sysroot = run("rustc", ["--print", "sysroot"], { quiet: true }).trim();
  if (!existsSync(join(sysroot, "lib", "rustlib", name)))
    run("rustup", ["target", "add", name]);
}

/** Installs the oldest supported Rust, `rust-version` in Cargo.toml; returns its version. */
export function ensureOldestRust() {
  const version =
    /^rust-version = "(.+)"$/m.exec(
      readFileSync(at("Cargo.toml"), "utf8"),
    )?.[1] ?? "";
  const known = run("rustup", ["toolchain", "list"], { quiet: true });
  if (
    !known
      .split("\n")
      .some(
        (line) =>
          line.startsWith(`${version}-`) || line.startsWith(`${version}.`),
      )
  )
    run("rustup", [
      "toolchain",
      "install",
      version,
      "--profile",
      "minimal",
      "--no-self-update",
    ]);
  return version;
}

/** Builds a workspace member for WebAssembly modules next to the crate; returns the folder of its commands. */
async function ensureTool(/** @type {string} */ name) {
  const folder = join(tools, "build");
  await beside("cargo", [
    "build",
    "--quiet",
    "--locked",
    "--package",
    name,
    "--target-dir",
    folder,
  ]);
  return join(folder, "debug");
}

/** The command that writes the bindings of a module. */
export const ensureBindings = async () =>
  join(await ensureTool("touchpath-tools"), "bindings");

/** wasm-bindgen and its test runner for wasm-pack; returns their folder. */
export const ensureBindgen = () => ensureTool("touchpath-wasm-pack-tools");

/** wasm-pack; returns its folder. */
export function ensureWasmPack() {
  if (works("wasm-pack")) return "";
  const folder = join(tools, "bin");
  if (!works(join(folder, "wasm-pack"))) {
    // It runs for a second: a release build or debug info would take longer than it saves.
    run(
      "cargo",
      [
        "install",
        "wasm-pack",
        "--debug",
        "--version",
        "0.15.1",
        "--locked",
        "--root",
        tools,
        "--quiet",
      ],
      { env: { CARGO_PROFILE_DEV_DEBUG: "0" } },
    );
  }
  return folder;
}

/** Runs apt-get, as root or with sudo. */
function apt(/** @type {string[]} */ ...args) {
  const sudo = process.getuid?.() === 0 ? [] : ["sudo", "-n"];
  const [command, ...rest] = [...sudo, "apt-get", ...args];
  run(command ?? "apt-get", rest, {
    quiet: true,
    env: { DEBIAN_FRONTEND: "noninteractive" },
  });
}

let updated = false;
/** A new machine has no package lists, and old lists contain files that no longer exist. */
function aptUpdate() {
  if (!updated) apt("update");
  updated = true;
}

/** Installs Debian packages. */
function aptInstall(/** @type {string[]} */ ...packages) {
  if (packages.length === 0) return;
  aptUpdate();
  apt("install", "-y", "--no-install-recommends", ...packages);
}

/** The first of these commands that works; the one in this variable takes precedence. */
const find = (/** @type {string} */ variable, /** @type {string[]} */ names) =>
  [process.env[variable], ...names].find((name) => name && works(name));
const findChromium = () =>
  find("CHROMIUM", ["chromium", "chromium-browser", "google-chrome"]);
const findChromedriver = () => find("CHROMEDRIVER", ["chromedriver"]);
const findFirefox = () => find("FIREFOX", ["firefox-esr", "firefox"]);
const webKit = () => ({
  driver: process.env.WEBKITDRIVER ?? "WebKitWebDriver",
  screen: process.env.XVFB_RUN ?? "xvfb-run",
});
const hasWebKit = () =>
  works(webKit().screen, ["--help"]) && works(webKit().driver, ["--help"]);

/** Installs the tests' Debian packages together: browsers, their drivers, LinuxCNC's interpreter. */
export function ensureDebianPackages() {
  const missing = [];
  if (!findChromium() || !findChromedriver())
    missing.push("chromium", "chromium-driver");
  if (!findFirefox()) missing.push("firefox-esr");
  if (!hasWebKit()) missing.push("webkit2gtk-driver", "xvfb", "xauth");
  aptInstall(...missing);
  ensureChromium();
  ensureInterpreter();
}

/** The headless shell, in which a page opens in half the time; Chromium itself if no package has the shell, or if CHROMIUM is set. */
function ensureShell(/** @type {string} */ browser) {
  const name = "chromium-headless-shell";
  if (process.env.CHROMIUM) return browser;
  if (!works(name)) {
    const sudo = process.getuid?.() === 0 ? [] : ["sudo", "-n"];
    const [command = "apt-get", ...rest] = [
      ...sudo,
      "apt-get",
      "install",
      "-y",
      "--no-install-recommends",
      name,
    ];
    spawnSync(command, rest, {
      stdio: "ignore",
      env: { ...process.env, DEBIAN_FRONTEND: "noninteractive" },
    });
  }
  return works(name) ? absolute(name) : browser;
}

/** Chromium, its driver and the browser for the page's tests; returns their paths. */
export function ensureChromium() {
  if (!findChromium() || !findChromedriver())
    aptInstall("chromium", "chromium-driver");
  const [browser, driver] = [findChromium(), findChromedriver()];
  if (!browser || !driver)
    throw new Error(
      "Chromium and chromedriver are needed: set CHROMIUM and CHROMEDRIVER",
    );
  return {
    browser: absolute(browser),
    driver: absolute(driver),
    shell: ensureShell(absolute(browser)),
  };
}

/** Firefox and its driver, which Debian does not package. */
export function ensureFirefox() {
  if (!findFirefox()) aptInstall("firefox-esr");
  const own = join(tools, "gecko");
  const findDriver = () =>
    find("GECKODRIVER", ["geckodriver", join(own, "bin", "geckodriver")]);
  const install = [
    "install",
    "geckodriver",
    "--version",
    "0.37.1",
    "--locked",
    "--debug",
    "--quiet",
    "--root",
    own,
  ];
  if (!findDriver()) run("cargo", install);
  const [browser, driver] = [findFirefox(), findDriver()];
  if (!browser || !driver)
    throw new Error(
      "Firefox and geckodriver are needed: set FIREFOX and GECKODRIVER",
    );
  return { browser: absolute(browser), driver: absolute(driver) };
}

/** The driver of WebKit, and a virtual screen for it. */
export function ensureWebKit() {
  if (!hasWebKit()) aptInstall("webkit2gtk-driver", "xvfb", "xauth");
  if (!hasWebKit())
    throw new Error(
      "WebKitWebDriver and xvfb-run are needed: set WEBKITDRIVER and XVFB_RUN",
    );
  const { driver, screen } = webKit();
  return { driver: absolute(driver), screen: absolute(screen) };
}

function absolute(/** @type {string} */ command) {
  if (command.includes("/")) return command;
  const places = (process.env.PATH ?? "")
    .split(delimiter)
    .map((folder) => join(folder, command));
  return places.find((path) => existsSync(path)) ?? command;
}

/** LinuxCNC's interpreter, extracted from Debian's package without installing it; returns the command. */
export function ensureInterpreter() {
  if (process.env.RS274) return process.env.RS274;
  const folder = join(tools, "linuxcnc");
  const command = join(folder, "rs274");
  if (!existsSync(command)) {
    mkdirSync(folder, { recursive: true });
    const packages = [
      "linuxcnc-uspace",
      "libboost-python1.74.0",
      "libpython3.11",
    ];
    const download = mkdtempSync(join(tmpdir(), "touchpath-"));
    const args = ["-o", "APT::Sandbox::User=root", "download", ...packages];
    const first = spawnSync("apt-get", args, {
      cwd: download,
      stdio: "ignore",
    });
    if (first.status !== 0) {
      aptUpdate();
      run("apt-get", args, { cwd: download, quiet: true });
    }
    run("sh", ["-c", `for deb in *.deb; do dpkg -x "$deb" "${folder}"; done`], {
      cwd: download,
      quiet: true,
    });
    rmSync(download, { recursive: true });
    const lib = `${folder}/usr/lib:${folder}/usr/lib/x86_64-linux-gnu`;
    writeFileSync(
      command,
      `#!/bin/sh\nLD_LIBRARY_PATH="${lib}" exec "${folder}/usr/bin/rs274" "$@"\n`,
      {
        mode: 0o755,
      },
    );
  }
  return command;
}

/** PATH with these folders in front. */
export const pathWith = (/** @type {string[]} */ ...folders) => ({
  PATH: [...folders.filter(Boolean), process.env.PATH].join(delimiter),
});
