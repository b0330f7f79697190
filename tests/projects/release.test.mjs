// A release without publishing: the package packs and installs, the crate packs and compiles from its package.
import assert from "node:assert/strict";
import { execFileSync, spawnSync } from "node:child_process";
import { existsSync, readFileSync } from "node:fs";
import { test } from "node:test";
import { at } from "../../scripts/lib.mjs";

test("the crate compiles from what would be published", () => {
  execFileSync(
    "cargo",
    ["package", "--quiet", "--locked", "--allow-dirty", "--offline"],
    { cwd: at(), stdio: "pipe" },
  );
});

test("the reference is what the package says of itself", () => {
  execFileSync("node", ["scripts/reference.mjs", "check"], {
    cwd: at(),
    stdio: "inherit",
  });
});

test("a function with type parameters was missing in the reference", async () => {
  const page = readFileSync(at("docs", "reference.md"), "utf8");
  // Functions of a loaded module; the other exports load it, return messages, or belong to the page.
  const {
    JobError: _,
    say: __,
    misfit: ___,
    judged: ____,
    ...functions
  } = await import(at("dist", "node.js"));
  const names = Object.keys(functions);
  assert.ok(names.includes("defaultJob") && names.length > 15, names.join());
  for (const name of names)
    assert.match(
      page,
      new RegExp(`^### ${name}\n\n\`{3}ts\n${name}[<(]`, "m"),
      name,
    );
});

test("every link of the README leads to a file of the repository, where a registry's page takes it", () => {
  const readme = readFileSync(at("README.md"), "utf8");
  const links = [...readme.matchAll(/\]\(([^)#]+)(#[^)]*)?\)/g)].map(
    ([, path = ""]) => path,
  );
  assert.ok(links.length > 20);
  const missing = links.filter(
    (path) => !/^https:/.test(path) && !existsSync(at(path)),
  );
  assert.deepEqual(missing, []);
});

for (const [name, wanted] of /** @type {const} */ ([
  // The direct dependencies of the crate, and what the page is made with.
  ["touchpath", ["glam", "serde_json", "wasm-bindgen", "strsim", "hono"]],
  ["touchpath-element", ["lit", "%40codemirror/view"]],
]))
  test(`the bill of materials of ${name} names every crate and library that is shipped`, async () => {
    const { components, dependencies } = JSON.parse(
      readFileSync(at("dist", "sbom", `${name}.cdx.json`), "utf8"),
    );
    /** @type {string[]} */
    const named = components.map((/** @type {any} */ one) => one.purl);
    const lock = readFileSync(at("Cargo.lock"), "utf8");
    const { packages } = JSON.parse(
      readFileSync(at("package-lock.json"), "utf8"),
    );
    for (const purl of named) {
      const [, kind, name = "", version] = /** @type {string[]} */ (
        /^pkg:(cargo|npm)\/(.+)@([^@]+)$/.exec(purl)
      );
      if (kind === "cargo")
        assert.ok(
          lock.includes(`name = "${name}"\nversion = "${version}"`),
          purl,
        );
      else
        assert.equal(
          packages[`node_modules/${decodeURIComponent(name)}`]?.version,
          version,
          purl,
        );
    }
    for (const library of wanted)
      assert.ok(
        named.some((purl) => purl.includes(`/${library}@`)),
        library,
      );
    const own = dependencies.find((/** @type {any} */ one) =>
      one.ref.startsWith(`pkg:npm/${name}@`),
    );
    assert.equal(own.dependsOn.length, named.length);
    assert.ok(
      components.every((/** @type {any} */ one) => one.licenses.length),
    );
  });

test("a release is refused where a version or the changelog does not fit or a placeholder is left, and the workflow asks before it publishes", () => {
  const release = (/** @type {string} */ tag) =>
    spawnSync("node", ["scripts/release.mjs", tag], {
      cwd: at(),
      encoding: "utf8",
    });
  const { version, ...fields } = JSON.parse(
    readFileSync(at("package.json"), "utf8"),
  );
  for (const field of ["author", "homepage", "repository", "bugs"])
    assert.ok(fields[field], `package.json has no ${field}`);
  const wrong = release("v99.0.0");
  assert.equal(wrong.status, 1);
  assert.match(wrong.stderr, /the tag says 99\.0\.0/);
  const { status, stderr } = release(`v${version}`);
  // Between releases only the changelog may be missing, and addresses that nobody has set yet.
  for (const name of ["package.json", "Cargo.toml"])
    assert.equal(
      stderr.includes(`${name} has placeholders: `),
      readFileSync(at(name), "utf8").includes("touchpath.invalid"),
      stderr,
    );
  const rest = stderr.replaceAll(/^.* has placeholders: .*\n/gm, "");
  assert.ok(rest === "" || /^CHANGELOG\.md .*\n$/.test(rest), stderr);
  assert.equal(status, stderr === "" ? 0 : 1);
  const workflow = readFileSync(
    at(".github", "workflows", "release.yml"),
    "utf8",
  );
  const order = [
    "id-token: write",
    ".ci/run",
    "scripts/release.mjs",
    "cargo publish --dry-run",
    "npm publish --provenance",
    "npm publish ./dist/touchpath-element --provenance",
    "cargo publish --locked",
  ].map((step) => workflow.indexOf(step));
  assert.ok(
    order.every((place, i) => place > (order[i - 1] ?? 0)),
    order.join(),
  );
});
