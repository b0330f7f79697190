// Rules for the page's sources, like those in tests/all/layers.rs for the crate.
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

/**
 * Words that make a sentence hard to read, with a better one, and their current number in comments and messages. New ones are refused; lower the number after a
 * rewrite.
 */
const WORST = [
  { word: /\bstands?\b/g, better: "is, has, contains", most: 9 },
  { word: /\bwhoever\b/gi, better: "the caller, the reader", most: 0 },
  { word: /\bwherever\b/gi, better: "everywhere", most: 0 },
  { word: /\bis of\b/g, better: "belongs to", most: 8 },
  { word: /\bis that of\b/g, better: "equals", most: 52 },
  { word: /\bas far as\b/g, better: "up to, if", most: 11 },
  { word: /\bby itself\b/g, better: "automatically", most: 11 },
  { word: /\bnone where\b/gi, better: "`None` if", most: 0 },
];

test("comments and messages get no more of the words that make a reader stop", () => {
  const root = join(www, "..");
  const comments = ["src", "www", "scripts", "tests"].flatMap((folder) =>
    readdirSync(join(root, folder), { recursive: true, encoding: "utf8" })
      .filter((name) => /\.(rs|ts|mjs|css)$/.test(name))
      .filter((name) => !name.startsWith("wasm") && !/core.wasm/.test(name))
      .flatMap((name) =>
        readFileSync(join(root, folder, name), "utf8")
          .split("\n")
          .filter((line) => /^\s*(\/\/|\/?\*)/.test(line)),
      ),
  );
  const messages = Object.keys(
    JSON.parse(readFileSync(join(www, "words", "de.json"), "utf8")),
  );
  const text = [...comments, ...messages].join("\n");
  const more = WORST.flatMap(({ word, better, most }) => {
    const count = text.match(word)?.length ?? 0;
    return count > most
      ? [`${word.source}: ${count}, at most ${most}; write: ${better}`]
      : [];
  });
  assert.deepEqual(more, []);
  assert.ok(comments.length > 10_000, "comments are read");
});
