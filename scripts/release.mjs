// Checks that this tree can be released under a tag: one version everywhere, and a changelog entry. Publishes nothing.
import { readFileSync } from "node:fs";
import { at } from "./lib.mjs";

const [tag = ""] = process.argv.slice(2);
const text = (/** @type {string} */ name) => readFileSync(at(name), "utf8");
const versions = {
  "the tag": tag.replace(/^v/, ""),
  "package.json": JSON.parse(text("package.json")).version,
  "package-lock.json": JSON.parse(text("package-lock.json")).version,
  "Cargo.toml": /^version = "(.*)"$/m.exec(text("Cargo.toml"))?.[1],
  "Cargo.lock": /name = "touchpath"\nversion = "(.*)"/.exec(
    text("Cargo.lock"),
  )?.[1],
};
const problems = [];
// Placeholders: nobody can own a name below .invalid. npm compares a provenance with the repository in package.json.
for (const name of ["package.json", "Cargo.toml"]) {
  const lines = text(name).split("\n");
  const found = lines.filter((line) => line.includes("touchpath.invalid"));
  if (found.length > 0)
    problems.push(
      `${name} has placeholders: ${found.map((line) => line.trim()).join(" ")}`,
    );
}
const wanted = versions["package.json"];
for (const [place, version] of Object.entries(versions))
  if (version !== wanted)
    problems.push(`${place} says ${version}, package.json ${wanted}`);
const changelog = text("CHANGELOG.md");
if (!changelog.includes(`\n## ${wanted} (20`))
  problems.push(`CHANGELOG.md has no dated section ${wanted}`);
if (changelog.includes("(not yet released)"))
  problems.push("CHANGELOG.md has changes that are not yet released");
for (const problem of problems) console.error(problem);
process.exit(problems.length > 0 ? 1 : 0);
