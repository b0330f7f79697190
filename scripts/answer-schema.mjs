// JSON Schema of the package's answers (plans, findings, imports, the catalog …), made from the package's types, which come from the crate's lists.
import { createGenerator } from "ts-json-schema-generator";
import { at } from "./lib.mjs";

/** @typedef {Record<string, any>} Schema */

/** Answers, by the names of their types. */
const ANSWERS = [
  "Plan",
  "Finding",
  "Imported",
  "Catalog",
  "Measurement",
  "ResultRow",
  "Programmed",
  "Lentoax",
  "Report",
];

/** Inputs have a schema of their own. */
const JOB = { $ref: "urn:touchpath:job:1" };
const INPUTS = ["Job", "SetUp"];

/**
 * Converts a part of a schema from draft 07 to 2020-12. Objects may have additional keys: later versions add some.
 * @param {any} part
 * @returns {any}
 */
function inWords(part) {
  if (Array.isArray(part)) return part.map(inWords);
  if (typeof part !== "object" || part === null) return part;
  const {
    items,
    additionalItems,
    additionalProperties,
    properties,
    $ref,
    title: _,
    ...rest
  } = part;
  const each = (/** @type {Schema} */ parts) =>
    Object.fromEntries(
      Object.entries(parts).map(([key, value]) => [key, inWords(value)]),
    );
  const inner = each(rest);
  if (properties) inner.properties = each(properties);
  const own = $ref?.replace("#/definitions/", "");
  if (own)
    Object.assign(
      inner,
      INPUTS.includes(own) ? JOB : { $ref: `#/$defs/${own}` },
    );
  if (Array.isArray(items))
    Object.assign(inner, {
      prefixItems: inWords(items),
      items: inWords(additionalItems ?? false),
    });
  else if (items !== undefined) inner.items = inWords(items);
  if (typeof additionalProperties === "object")
    inner.additionalProperties = inWords(additionalProperties);
  return inner;
}

/** The definitions reachable from these, including them. @param {Schema} all @param {string[]} names */
function reached(all, names) {
  /** @type {Schema} */
  const found = {};
  const visit = (/** @type {string} */ name) => {
    if (found[name] || !all[name]) return;
    found[name] = all[name];
    for (const [, other] of JSON.stringify(all[name]).matchAll(
      /"#\/\$defs\/(\w+)"/g,
    ))
      visit(String(other));
  };
  names.forEach(visit);
  return Object.fromEntries(
    Object.entries(found).sort(([a], [b]) => (a < b ? -1 : 1)),
  );
}

/** @returns {Schema} */
export function answerSchema() {
  const generator = createGenerator({
    path: at("dist", "{types,report}.d.ts"),
    skipTypeCheck: true,
    expose: "export",
  });
  /** @type {Schema} */
  const all = {};
  for (const type of ANSWERS)
    for (const [name, part] of Object.entries(
      generator.createSchema(type).definitions ?? {},
    ))
      all[name] = inWords(part);
  const text = { type: "string" };
  const orNull = { type: ["string", "null"] };
  const findings = { type: "array", items: { $ref: "#/$defs/Finding" } };
  const place = { type: "integer", minimum: 1 };
  const placed = {
    description:
      "A finding with its place in the file of the job, where it is about a place in it.",
    $ref: "#/$defs/Finding",
    properties: { line: place, column: place },
  };
  const object = (
    /** @type {string} */ description,
    /** @type {Schema} */ properties,
  ) => ({
    description,
    type: "object",
    properties,
    required: Object.keys(properties),
  });
  Object.assign(all, {
    PlanLine: object(
      "A line of `touchpath plan --ndjson`: what became of a job.",
      {
        source: text,
        program: orNull,
        findings,
      },
    ),
    FileLine: object(
      "A line of `touchpath plan -o FOLDER --json`: the file of a job.",
      {
        source: text,
        file: orNull,
        hash: orNull,
        control: orNull,
        findings: { type: "array", items: placed },
      },
    ),
    CheckLine: object("A line of `touchpath check --json`.", {
      source: text,
      findings: { type: "array", items: placed },
    }),
  });
  const names = [...ANSWERS, "PlanLine", "FileLine", "CheckLine"];
  return {
    $schema: "https://json-schema.org/draft/2020-12/schema",
    $id: "urn:touchpath:answers:1",
    title: "What Touchpath answers",
    description:
      "By name in $defs. A later version adds keys: readers pass over unknown keys. The job is that of schema.json.",
    $defs: reached(all, names),
  };
}
