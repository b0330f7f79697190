// Types of the answers for Python, from the package's schema: `node scripts/python-types.mjs` writes examples/python/touchpath_types.py.
import { readFileSync, writeFileSync } from "node:fs";
import { at } from "./lib.mjs";

/** @typedef {Record<string, any>} Schema */

const PLAIN = /** @type {Record<string, string>} */ ({
  string: "str",
  number: "float",
  integer: "int",
  boolean: "bool",
  null: "None",
  object: "dict[str, Any]",
});
/** Names that no class attribute can have. */
const WORDS = new Set([
  "from",
  "in",
  "is",
  "class",
  "def",
  "pass",
  "None",
  "global",
  "import",
  "lambda",
  "with",
]);

const literal = (/** @type {unknown[]} */ values) =>
  `Literal[${values.map((one) => (one === null ? "None" : JSON.stringify(one))).join(", ")}]`;

/** Members of a union, or the type itself. @param {Schema} part @returns {string[]} */
const members = (part) =>
  part.anyOf ? part.anyOf.flatMap(members) : [typeOf(part)];

/** Python type of a part of the schema. @param {Schema} part @returns {string} */
function typeOf(part) {
  const of = (/** @type {Schema[]} */ parts) =>
    [...new Set(parts.flatMap(members))].join(" | ");
  if (part.$ref)
    return part.$ref.startsWith("#/$defs/")
      ? part.$ref.slice("#/$defs/".length)
      : "Job";
  if (part.enum) return literal(part.enum);
  if (part.const !== undefined) return literal([part.const]);
  if (part.anyOf) return of(part.anyOf);
  if (Array.isArray(part.type))
    return of(
      part.type.map((/** @type {string} */ type) => ({ ...part, type })),
    );
  if (part.type === "array") {
    const inner = [
      ...(part.prefixItems ?? []),
      ...(part.items ? [part.items] : []),
    ];
    return `list[${inner.length > 0 ? of(inner) : "Any"}]`;
  }
  return PLAIN[part.type] ?? "Any";
}

/** A text as comments. @param {string | undefined} text @param {string} indent */
const comments = (text, indent) =>
  text ? text.split("\n").map((line) => `${indent}# ${line}`.trimEnd()) : [];

/** Whether a definition is an alias of a type. @param {Schema} part */
const isAlias = (part) => part.type !== "object" || !part.properties;

/** The aliases in the order of their dependencies: Python evaluates them from top to bottom. @param {[string, Schema][]} all */
function inOrder(all) {
  const done = new Set();
  const ordered = /** @type {[string, Schema][]} */ ([]);
  const visit = (/** @type {string} */ name) => {
    const own = all.find(([known]) => known === name);
    if (!own || done.has(name)) return;
    done.add(name);
    for (const [, other] of JSON.stringify(own[1]).matchAll(
      /"#\/\$defs\/(\w+)"/g,
    ))
      visit(String(other));
    ordered.push(own);
  };
  for (const [name] of all) visit(name);
  return ordered;
}

/** A definition as text. @param {string} name @param {Schema} part */
function definition(name, part) {
  // The inner use of a recursive name is not followed.
  if (isAlias(part))
    return [
      `${name}: TypeAlias = ${typeOf(part).replaceAll(new RegExp(`\\b${name}\\b`, "g"), "Any")}`,
    ];
  const fields = Object.entries(part.properties);
  const typed = (/** @type {string} */ key, /** @type {Schema} */ own) =>
    part.required?.includes(key) ? typeOf(own) : `NotRequired[${typeOf(own)}]`;
  if (fields.some(([key]) => WORDS.has(key) || !/^[A-Za-z_]\w*$/.test(key)))
    return [
      `${name} = TypedDict(`,
      `    "${name}",`,
      "    {",
      ...fields.map(
        ([key, own]) => `        "${key}": ${JSON.stringify(typed(key, own))},`,
      ),
      "    },",
      ")",
    ];
  return [
    `class ${name}(TypedDict):`,
    ...fields.flatMap(([key, own]) => [
      ...comments(own.description, "    "),
      `    ${key}: ${typed(key, own)}`,
    ]),
  ];
}

/** All types as text. */
export function pythonTypes() {
  const { $defs } = JSON.parse(
    readFileSync(at("dist", "answers.schema.json"), "utf8"),
  );
  const defined = /** @type {[string, Schema][]} */ (Object.entries($defs));
  const aliases = inOrder(defined.filter(([, part]) => isAlias(part)));
  const head = `"""What Touchpath answers, as types: of Plan, Finding, Measurement and the rest of touchpath/answers.schema.json.

Made from that schema by scripts/python-types.mjs. A later version adds keys: pass over what is not known.
"""

from __future__ import annotations

from typing import Any, Literal, NotRequired, TypeAlias, TypedDict

# A job, as touchpath/schema.json has it.
Job: TypeAlias = dict[str, Any]
`;
  const all = [...defined.filter(([, part]) => !isAlias(part)), ...aliases].map(
    ([name, part]) =>
      [
        "",
        "",
        ...comments(part.description, ""),
        ...definition(name, part),
      ].join("\n"),
  );
  return `${head}${all.join("\n")}\n`;
}

if (process.argv[1] === import.meta.filename)
  writeFileSync(at("examples", "python", "touchpath_types.py"), pythonTypes());
