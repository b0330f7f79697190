// A release without publishing: the package packs and installs, the crate packs and compiles from its package.
import assert from "node:assert/strict";
import { execFileSync, spawnSync } from "node:child_process";
import { readFileSync } from "node:fs";
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

test("a release is refused where a version or the changelog does not fit or no repository is named, and the workflow asks before it publishes", () => {
  const release = (/** @type {string} */ tag) =>
    spawnSync("node", ["scripts/release.mjs", tag], {
      cwd: at(),
      encoding: "utf8",
    });
  const { version, repository } = JSON.parse(
    readFileSync(at("package.json"), "utf8"),
  );
  const wrong = release("v99.0.0");
  assert.equal(wrong.status, 1);
  assert.match(wrong.stderr, /the tag says 99\.0\.0/);
  const { status, stderr } = release(`v${version}`);
  // Between releases only the changelog may be missing, and a repository that has no name yet.
  const nameless =
    "package.json names no repository: npm publishes no provenance without it\n";
  assert.equal(stderr.startsWith(nameless), !repository);
  const rest = stderr.replace(nameless, "");
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
    "cargo publish --locked",
  ].map((step) => workflow.indexOf(step));
  assert.ok(
    order.every((place, i) => place > (order[i - 1] ?? 0)),
    order.join(),
  );
});
