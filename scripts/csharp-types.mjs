// Types of the answers for C#, from the package's schema: `node scripts/csharp-types.mjs` writes examples/csharp/TouchpathTypes.cs.
import { readFileSync, writeFileSync } from "node:fs";
import { at } from "./lib.mjs";

/** @typedef {Record<string, any>} Schema */

const VALUES = /** @type {Record<string, string>} */ ({
  number: "double",
  integer: "int",
  boolean: "bool",
});
const PLAIN = /** @type {Record<string, string>} */ ({
  ...VALUES,
  string: "string",
});

/**
 * The class or type of a part of the schema. A union or a recursive type is an object.
 * @param {Schema} part
 * @param {Record<string, Schema>} all
 * @param {string[]} inside the names of the definitions around it
 * @returns {string}
 */
function typeOf(part, all, inside = []) {
  if (part.$ref) {
    const name = part.$ref.slice("#/$defs/".length);
    const own = all[name];
    if (own?.properties) return name;
    return own && !inside.includes(name)
      ? typeOf(own, all, [...inside, name])
      : "object";
  }
  const types = Array.isArray(part.type) ? part.type : [part.type];
  const unions = /** @type {Schema[]} */ (
    part.anyOf ?? types.map((type) => ({ ...part, type }))
  );
  const some = unions.filter(({ type }) => type !== "null");
  const [one] = some;
  if (!one) return "object";
  if (unions.length > 1) {
    const own = [...new Set(some.map((member) => typeOf(member, all, inside)))];
    const [only = "object", ...more] = own;
    if (more.length > 0) return "object";
    return some.length < unions.length && Object.values(VALUES).includes(only)
      ? `${only}?`
      : only;
  }
  if (one.enum || one.const !== undefined) {
    const [first] = one.enum ?? [one.const];
    return PLAIN[typeof first] ?? "object";
  }
  if (one.type !== "array") return PLAIN[one.type] ?? "object";
  const inner = [...(one.prefixItems ?? []), ...(one.items ? [one.items] : [])];
  const kinds = [...new Set(inner.map((item) => typeOf(item, all, inside)))];
  return kinds.length === 1 ? `${kinds[0]}[]` : "object[]";
}

const escaped = (/** @type {string} */ text) =>
  text.replaceAll("&", "&amp;").replaceAll("<", "&lt;");
/** A text as the summary of the next declaration. @param {string | undefined} text @param {string} indent */
const summary = (text, indent) =>
  text
    ? [
        `${indent}/// <summary>${escaped(text.replaceAll(/\s*\n\s*/g, " "))}</summary>`,
      ]
    : [];

/** All types as text. */
export function csharpTypes() {
  const { $defs } = /** @type {{ $defs: Record<string, Schema> }} */ (
    JSON.parse(readFileSync(at("dist", "answers.schema.json"), "utf8"))
  );
  const classes = Object.entries($defs).filter(([, part]) => part.properties);
  const fields = (/** @type {Schema} */ part) =>
    Object.entries(part.properties).flatMap(([key, own]) => {
      const type = typeOf(own, $defs);
      const missing =
        !part.required?.includes(key) && Object.values(VALUES).includes(type)
          ? "?"
          : "";
      const name = `${key[0]?.toUpperCase()}${key.slice(1)}`;
      return [
        ...summary(/** @type {Schema} */ (own).description, "        "),
        `        public ${type}${missing} ${name} { get; set; }`,
      ];
    });
  return [
    "// What Touchpath answers, as types: of Plan, Finding, Measurement and the rest of touchpath/answers.schema.json.",
    "// Made from that schema by scripts/csharp-types.mjs. A later version adds keys: pass over what is not known.",
    "// Keys are read whatever their case: so does Newtonsoft.Json by itself, and System.Text.Json with JsonSerializerDefaults.Web.",
    "namespace Touchpath",
    "{",
    classes
      .map(([name, part]) =>
        [
          ...summary(part.description, "    "),
          `    public class ${name}`,
          "    {",
          ...fields(part),
          "    }",
        ].join("\n"),
      )
      .join("\n\n"),
    "}",
    "",
  ].join("\n");
}

if (process.argv[1] === import.meta.filename)
  writeFileSync(at("examples", "csharp", "TouchpathTypes.cs"), csharpTypes());
