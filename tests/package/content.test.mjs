// Contents of the package and the crate: required files with their licences, and nothing else.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { readdirSync, readFileSync } from "node:fs";
import { dirname, join, posix, relative } from "node:path";
import { test } from "node:test";
import { fileURLToPath } from "node:url";
import { catalog } from "touchpath";

const cwd = fileURLToPath(new URL("../..", import.meta.url));

test("the package had no licence text", () => {
  const [packed] = JSON.parse(
    execFileSync("npm", ["pack", "--dry-run", "--json"], {
      cwd,
      encoding: "utf8",
      stdio: "pipe",
    }),
  );
  const names = packed.files
    .map((/** @type {{ path: string }} */ f) => f.path)
    .sort();
  const core = [
    "api",
    "browser",
    "coded",
    "config-types",
    "embed",
    "frame",
    "init",
    "inline",
    "instance",
    "job-types",
    "layout",
    "node",
    "plan",
    "plan-types",
    "program-posts",
    "protocol",
    "report",
    "results",
    "said",
    "types",
    "unpacked",
    "workerd",
  ];
  const modules = core.flatMap((name) => [
    `dist/${name}.d.ts`,
    `dist/${name}.js`,
  ]);
  // What the element loads is cut into pieces as the bundler likes: their number may change, their kind may not.
  const pieces = names.filter((/** @type {string} */ name) =>
    name.startsWith("dist/element/"),
  );
  assert.ok(
    pieces.includes("dist/element/element.js") &&
      pieces.includes("dist/element/element.d.ts"),
    pieces.join(),
  );
  assert.ok(
    pieces.filter((/** @type {string} */ name) => name.endsWith(".js")).length <
      21 &&
      pieces.every((/** @type {string} */ name) =>
        /\/[a-zA-Z-]+(\.d\.ts|\.js)$/.test(name),
      ),
    pieces.join(),
  );
  const wasm = [
    "inline.d.ts",
    "inline.js",
    "touchpath.d.ts",
    "touchpath.js",
    "touchpath_bg.wasm",
    "touchpath_bg.wasm.d.ts",
  ].map((f) => `dist/wasm/${f}`);
  // The manual, which README, types and catalog point to, and the examples that it points to.
  const all = (/** @type {string} */ folder) =>
    readdirSync(join(cwd, folder), { recursive: true, withFileTypes: true })
      .filter((entry) => entry.isFile() && !/\.(rs|pyc)$/.test(entry.name))
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
        names.some(
          (/** @type {string} */ name) =>
            name === target || name.startsWith(`${target}/`),
        ),
        `${page}: ${link}`,
      );
    }
  }
  for (const { doc } of catalog().cycles) assert.ok(manual.includes(doc), doc);
  const wanted = [
    ...modules,
    ...manual,
    ...pieces,
    "dist/cli/pool.js",
    "dist/cli/serve.js",
    "dist/cli/tasks.js",
    "dist/cli/touchpath.js",
    "dist/cli/worker.js",
    "dist/custom-elements.json",
    "dist/embed.css",
    "dist/embed.html",
    "dist/events.d.ts",
    "dist/events.js",
    "dist/answers.schema.json",
    "dist/config.schema.json",
    "dist/frame.schema.json",
    "dist/attributes.d.ts",
    "dist/react.d.ts",
    "dist/svelte.d.ts",
    "dist/vue.d.ts",
    "dist/web-types.json",
    "dist/react.js",
    "dist/sbom.cdx.json",
    "dist/schema.json",
    "dist/words/de.json",
    "dist/words/ru.json",
    "dist/words/zh-Hans.json",
    "dist/words/zh-Hant.json",
    ...wasm,
    "dist/licences.txt",
    "dist/load.d.ts",
    "dist/load.js",
    "CHANGELOG.md",
    "LICENSE-APACHE",
    "LICENSE-MIT",
    "README.md",
    "package.json",
  ];
  assert.deepEqual(names, wanted.sort());
  const notices = readFileSync(join(cwd, "dist", "licences.txt"), "utf8");
  assert.match(notices, /lit[\s\S]*Google/, "what the element bundles");
  assert.match(
    notices,
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
      notices.split(/^## /m).find((part) => part.startsWith(`${crate} - `)) ??
      "";
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
