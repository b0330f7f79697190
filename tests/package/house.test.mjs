// The house rules of the page's sources, as tests/all/layers.rs has them for the crate.
import assert from "node:assert/strict";
import { readdirSync, readFileSync } from "node:fs";
import { dirname, join, normalize } from "node:path";
import { test } from "node:test";
import { fileURLToPath } from "node:url";

const www = fileURLToPath(new URL("../../www", import.meta.url));

test("files of the page make no circles, types included", () => {
  const files = readdirSync(www, { recursive: true, encoding: "utf8" }).filter(
    (name) =>
      name.endsWith(".ts") && !name.endsWith(".d.ts") && !name.includes("wasm"),
  );
  /** @type {Map<string, string[]>} */
  const imports = new Map();
  for (const file of files) {
    const text = readFileSync(join(www, file), "utf8");
    const paths = [
      ...text.matchAll(/(?:from|import)\s*\(?"(\.[^"?]+)\.js"/g),
    ].map(([, path = ""]) => normalize(join(dirname(file), `${path}.ts`)));
    imports.set(
      file,
      paths.filter((path) => files.includes(path)),
    );
  }
  const reached = (/** @type {string} */ from) => {
    const seen = new Set();
    const next = [...(imports.get(from) ?? [])];
    for (let at = next.pop(); at; at = next.pop()) {
      if (seen.has(at)) continue;
      seen.add(at);
      next.push(...(imports.get(at) ?? []));
    }
    return seen;
  };
  const circles = files.filter((file) => reached(file).has(file));
  assert.deepEqual(circles, [], "these import each other");
  assert.ok([...imports.values()].flat().length > 150, "imports are followed");
});
