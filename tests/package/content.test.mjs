// Contents of the packages and the crate: required files with their licences, and nothing else.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { createHash } from "node:crypto";
import { readdirSync, readFileSync } from "node:fs";
import { dirname, join, posix, relative } from "node:path";
import { test } from "node:test";
import { fileURLToPath } from "node:url";
import { catalog } from "touchpath";

const cwd = fileURLToPath(new URL("../..", import.meta.url));

/** The two packages: folder, and the folder of what the build makes for it. */
const CORE = { folder: cwd, built: join(cwd, "dist") };
const ELEMENT = {
  folder: join(cwd, "dist", "touchpath-element"),
  built: join(cwd, "dist", "touchpath-element"),
};

/** Packed size of a package, and its files in order. @returns {{ size: number, files: string[] }} */
function packed({ folder } = CORE) {
  const args = ["pack", "--dry-run", "--json"];
  const [{ size, files }] = JSON.parse(
    execFileSync("npm", args, {
      cwd: folder,
      encoding: "utf8",
      stdio: "pipe",
    }),
  );
  const names = files.map((/** @type {{ path: string }} */ { path }) => path);
  return { size, files: names.sort() };
}

const modules = (/** @type {string[]} */ ...names) =>
  names.flatMap((name) => [`${name}.d.ts`, `${name}.js`]);
const LICENCES = ["LICENSE-APACHE", "LICENSE-MIT"];

test("touchpath has the functions, one copy of the module and the command, in about a megabyte", () => {
  const { size, files } = packed();
  const own = modules(
    "api",
    "browser",
    "coded",
    "config-types",
    "init",
    "instance",
    "job-types",
    "layout",
    "load",
    "node",
    "plan",
    "plan-types",
    "program-posts",
    "report",
    "results",
    "said",
    "types",
    "unpacked",
    "wasm/touchpath",
  );
  const command = ["pool", "serve", "tasks", "touchpath", "worker"];
  const wanted = [
    ...[
      ...own,
      ...command.map((name) => `cli/${name}.js`),
      "answers.schema.json",
      "config.schema.json",
      "licences.txt",
      "schema.json",
      "wasm/touchpath_bg.wasm",
      "workerd.js",
    ].map((name) => `dist/${name}`),
    ...LICENCES,
    "README.md",
    "package.json",
  ];
  assert.deepEqual(files, wanted.sort());
  assert.ok(size <= 1_092_500, `${size} bytes packed`);
});

test("touchpath-element has the element, its words, the frame and the manual", () => {
  const { files } = packed(ELEMENT);
  // What the element loads is cut into pieces as the bundler likes: their number may change, their kind may not.
  const pieces = files.filter((name) => name.startsWith("element/"));
  assert.ok(
    pieces.includes("element/element.js") &&
      pieces.includes("element/element.d.ts"),
    pieces.join(),
  );
  assert.ok(
    pieces.filter((name) => name.endsWith(".js")).length < 16 &&
      pieces.every((name) => /\/[a-zA-Z-]+(\.d\.ts|\.js)$/.test(name)),
    pieces.join(),
  );
  // The manual, which README, types and catalog point to, and the examples that it points to. The pictures stay in the repository.
  const all = (/** @type {string} */ folder) =>
    readdirSync(join(cwd, folder), { recursive: true, withFileTypes: true })
      .filter(
        (entry) => entry.isFile() && !/\.(rs|pyc|png|svg)$/.test(entry.name),
      )
      .map((entry) =>
        relative(cwd, join(entry.parentPath, entry.name)).replaceAll("\\", "/"),
      );
  const manual = [...all("docs"), ...all("examples")];
  // No link leads out of the package.
  for (const page of manual.filter((name) => name.endsWith(".md"))) {
    const links = readFileSync(join(cwd, page), "utf8").matchAll(
      /\]\((?!https?:|#)([^)\s#]+)/g,
    );
    for (const [, link = ""] of links) {
      const target = posix.join(dirname(page), link).replace(/\/$/, "");
      assert.ok(
        /\.(png|svg)$/.test(target) ||
          files.some(
            (name) => name === target || name.startsWith(`${target}/`),
          ),
        `${page}: ${link}`,
      );
    }
  }
  for (const { doc } of catalog().cycles) assert.ok(manual.includes(doc), doc);
  const wanted = [
    ...pieces,
    ...manual,
    ...modules("embed", "events", "frame", "protocol", "react"),
    ...["de.js", "ru.js", "zh-Hans.js", "zh-Hant.js", "words.d.ts"].map(
      (name) => `words/${name}`,
    ),
    "attributes.d.ts",
    "core.js",
    "custom-elements.json",
    "embed.css",
    "embed.html",
    "frame.schema.json",
    "licences.txt",
    "report.js",
    "site.js",
    "svelte.d.ts",
    "vue.d.ts",
    "web-types.json",
    ...LICENCES,
    "CHANGELOG.md",
    "README.md",
    "package.json",
  ];
  assert.deepEqual(files, wanted.sort());
});

test("no file is shipped twice, in one package or in both", () => {
  /** @type {Map<string, string>} */
  const seen = new Map();
  for (const { folder } of [CORE, ELEMENT])
    for (const name of packed({ folder, built: folder }).files) {
      if (LICENCES.includes(name)) continue;
      const bytes = readFileSync(join(folder, name));
      // A module of types has an empty script, and a script an empty module of types.
      if (bytes.length < 12) continue;
      const hash = createHash("sha256").update(bytes).digest("hex");
      assert.ok(!seen.has(hash), `${name} is ${seen.get(hash)}`);
      seen.set(hash, name);
    }
});

test("both packages have the same version, and the licences of what they contain", () => {
  const manifest = ({ folder } = CORE) =>
    JSON.parse(readFileSync(join(folder, "package.json"), "utf8"));
  const { version, dependencies } = manifest(ELEMENT);
  assert.deepEqual(
    [version, dependencies],
    [manifest().version, { touchpath: manifest().version }],
  );
  const notices = ({ built } = CORE) =>
    readFileSync(join(built, "licences.txt"), "utf8");
  assert.match(
    notices(ELEMENT),
    /lit[\s\S]*Google/,
    "what the element bundles",
  );
  assert.match(
    notices(),
    /tinyglobby[\s\S]*Permission/,
    "what the command bundles",
  );
  for (const crate of [
    "glam",
    "js-sys",
    "serde",
    "serde-wasm-bindgen",
    "wasm-bindgen",
    "web-sys",
  ]) {
    const own =
      notices()
        .split(/^## /m)
        .find((part) => part.startsWith(`${crate} - `)) ?? "";
    assert.match(own, /Permission is hereby granted|Apache License/, crate);
  }
});

test("the crate took README files and licences of node_modules with it", () => {
  const args = ["package", "--list", "--allow-dirty", "--offline"];
  const names = execFileSync("cargo", args, {
    cwd,
    encoding: "utf8",
    stdio: "pipe",
  })
    .trim()
    .split("\n");
  const made = [
    ".cargo_vcs_info.json",
    "Cargo.lock",
    "Cargo.toml",
    "Cargo.toml.orig",
  ];
  const own =
    /^(src\/.*\.(rs|md|csv|json|txt)|benches\/.*\.rs|examples\/\w+\.rs|README\.md|LICENSE-(MIT|APACHE))$/;
  assert.deepEqual(
    names.filter((name) => !own.test(name) && !made.includes(name)),
    [],
  );
  for (const name of [
    "src/lib.rs",
    "benches/plan.rs",
    "README.md",
    "LICENSE-MIT",
    "LICENSE-APACHE",
  ])
    assert.ok(names.includes(name), name);
});
