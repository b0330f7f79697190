// Writes docs/reference.md from the package itself: doc comments of the types, the element's manifest, the command's help. With `check` it writes nothing and
// fails if the file is stale.
import { execFileSync } from "node:child_process";
import { existsSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";
import { at } from "./lib.mjs";

/** The folders of both packages. */
const PACKAGES = [at("dist"), at("dist", "touchpath-element")];
const read = (/** @type {string} */ path) => {
  const files = PACKAGES.map((folder) => join(folder, path));
  return readFileSync(files.find((file) => existsSync(file)) ?? path, "utf8");
};

/** A doc comment as one paragraph. */
const plain = (/** @type {string} */ comment) =>
  comment
    .trim()
    .replaceAll(/^\/\*\*|\*\/$/g, "")
    .replaceAll(/^\s*\* ?/gm, "")
    .replaceAll(/\s+/g, " ")
    .trim();

/** The declarations of a file of types, each with its doc comment. */
function declarations(/** @type {string} */ text) {
  const comment = String.raw`(?<comment>\/\*\*(?:(?!\*\/)[\s\S])*\*\/\n)?`;
  const long = String.raw`(?:interface|class) (?<long>\w+)[\s\S]*?^\}$`;
  const short = String.raw`(?:type|function|const) (?<short>\w+)`;
  const head = new RegExp(
    `${comment}^export (?:declare )?(?<code>${long}|${short})`,
    "gm",
  );
  return [...text.matchAll(head)].map(({ 0: whole, index, groups = {} }) => {
    const begin = index + whole.length;
    const rest = groups.short ? text.slice(begin, endOf(text, begin)) : "";
    return {
      name: groups.long ?? groups.short ?? "",
      comment: plain(groups.comment ?? ""),
      code: (groups.code ?? "") + rest,
    };
  });
}

/** End of a declaration: its first semicolon outside of all brackets. */
function endOf(/** @type {string} */ text, /** @type {number} */ begin) {
  let depth = 0;
  for (let at = begin; at < text.length; at++) {
    const letter = text[at] ?? "";
    if ("{[(".includes(letter)) depth++;
    else if ("}])".includes(letter)) depth--;
    else if (letter === ";" && depth === 0) return at + 1;
  }
  return text.length;
}

/** Names that a file of types exports, also through re-exports. @returns {string[]} */
function exported(/** @type {string} */ file) {
  const text = read(file);
  const last = (/** @type {string} */ name) =>
    name.split(" as ").at(-1)?.trim() ?? "";
  const named = [...text.matchAll(/^export (?:type )?\{([^}]*)\}/gm)].flatMap(
    ([, list = ""]) => list.split(",").map(last),
  );
  const all = [
    ...text.matchAll(/^export (?:type )?\* from "\.\/([\w-]+)\.js"/gm),
  ];
  const own = declarations(text).map(({ name }) => name);
  return [
    ...own,
    ...named.filter(Boolean),
    ...all.flatMap(([, name]) => exported(`${name}.d.ts`)),
  ];
}

/** Functions of the package, in order. */
function functions() {
  return declarations(read("api.d.ts"))
    .filter(({ code }) => /^(declare )?function /.test(code))
    .map(({ name, comment, code }) => {
      const signature = code
        .replace(/^(declare )?function /, "")
        .replaceAll(/^(?: {4})+/gm, (space) => " ".repeat(space.length / 2));
      return `### ${name}\n\n\`\`\`ts\n${signature}\n\`\`\`\n\n${comment}\n`;
    })
    .join("\n");
}

/** Declarations of a file that match, as TypeScript. */
function types(
  /** @type {string} */ file,
  wanted = (/** @type {string} */ _name) => true,
) {
  return declarations(read(file))
    .filter(({ name }) => wanted(name))
    .map(
      ({ comment, code }) =>
        `${comment ? `${comment}\n\n` : ""}\`\`\`ts\n${code.replaceAll(/^ +private .*;\n/gm, "").replaceAll(/^(?: {4})+/gm, (space) => " ".repeat(space.length / 2))}\n\`\`\`\n`,
    )
    .join("\n");
}

const cell = (/** @type {string | undefined} */ text) =>
  (text ?? "").replaceAll("|", "\\|").replaceAll(/\s+/g, " ");

/** Rows of the element's manifest. @param {string} head @param {any[]} rows @param {(row: any) => (string | undefined)[]} of */
const table = (head, rows, of) => {
  const names = head.split(", ");
  return `| ${names.join(" | ")} |\n|${"---|".repeat(names.length)}\n${rows.map((row) => `| ${of(row).map(cell).join(" | ")} |\n`).join("")}`;
};

/** Methods of a View: its own, and those that it takes from the module's class. */
function view() {
  const types = read("browser.d.ts");
  const own = /export interface View [\s\S]*?^\}/m.exec(types)?.[0] ?? "";
  const named = /Pick<raw\.View, ([^>]*)>/.exec(types)?.[1] ?? "";
  const whole =
    /export class View \{[\s\S]*?^\}/m.exec(read("wasm/touchpath.d.ts"))?.[0] ??
    "";
  const method = /\/\*\*((?:(?!\*\/)[\s\S])*)\*\/\n +(\w+\([^;]*);/g;
  const taken = [...whole.matchAll(method)].filter(([, , code = ""]) =>
    named.includes(`"${code.split("(")[0]}"`),
  );
  const rows = [...own.matchAll(method), ...taken].map(
    ([, comment = "", code = ""]) => [code, plain(comment)],
  );
  return table("method, meaning", rows, ([code, meaning]) => [
    `\`${code}\``,
    meaning,
  ]);
}

/** Types of the cycles' forms, with their manual pages. */
function cycles() {
  const all = declarations(read("job-types.d.ts")).flatMap(({ name, code }) => {
    const type = /^ {4}type: "([\w-]+)";$/m.exec(code)?.[1];
    return type && name !== "CustomCode" ? [{ name, type }] : [];
  });
  return {
    names: all.map(({ name }) => name),
    text: table("type, `cycle.type`, page", all, ({ name, type }) => [
      `\`${name}\``,
      `\`${type}\``,
      `[its fields](cycles/${type}.md)`,
    ]),
  };
}

const code = (/** @type {string} */ text) => (text ? `\`${text}\`` : "");

function element() {
  const [one] = JSON.parse(read("custom-elements.json")).modules[0]
    .declarations;
  const order = one.attributes.filter((/** @type {any} */ a) => a.description);
  return `${one.description}

### Attributes

${table("attribute, type, meaning", order, (a) => [code(a.name), code(a.type?.text), a.description])}
### Properties and methods

${table("name, type, meaning", one.members, (m) => [code(m.kind === "method" ? `${m.name}()` : m.name), code(m.type?.text), m.description])}
### Events

${table("event, detail, meaning", one.events, (e) => [code(e.name), code(/<(.*)>$/.exec(e.type.text)?.[1] ?? ""), e.description])}
### Slots, parts, custom properties

${table("slot, meaning", one.slots, (s) => [code(s.name) || "(none)", s.description])}
${table("part, meaning", one.cssParts, (p) => [code(p.name), p.description])}
${table("custom property, meaning", one.cssProperties, (p) => [code(p.name), p.description])}`;
}

/** Elements that show panels of a job elsewhere; they differ in their panels. */
function parts() {
  const [, ...all] = JSON.parse(read("custom-elements.json")).modules[0]
    .declarations;
  const [one] = all;
  return `### Panels elsewhere on the page

${table("element, class, what it is", all, (part) => [code(`<${part.tagName}>`), code(part.name), part.description])}
${table("attribute, type, meaning", one.attributes, (a) => [code(a.name), code(a.type?.text), a.description])}
${table("property, type, meaning", one.members, (m) => [code(m.name), code(m.type?.text), m.description])}`;
}

const forms = cycles();
const help = execFileSync(
  "node",
  [at("dist", "cli", "touchpath.js"), "--help"],
  { encoding: "utf8" },
);
const page = `# Reference

<!-- generated: npm run build && node scripts/reference.mjs -->

What the packages offer, from their own doc comments. How they are put into a portal, a service or a project: [embedding](embedding.md).

## Functions: \`import { plan } from "touchpath"\`

${functions()}
### say

${types("said.d.ts", (name) => name === "say")}
### JobError

${types("instance.d.ts", (name) => name === "JobError")}
### View

In browsers only. The picture of a job on a canvas: \`new View(canvas)\`. It belongs to the instance of the module that made it: where that broke, every call throws, and a new View is needed.
Freed (\`free()\`) it gives back its memory.

${view()}
## Types

Lengths are in the job's units, feeds in units a minute, angles in degrees, counter-clockwise positive.

${types("types.d.ts")}
${types("said.d.ts", (name) => name !== "say")}
### Configs

What a config is for, with an example: [the portal in charge](embedding.md#the-portal-in-charge).

${types("config-types.d.ts")}
### Plans and catalog

\`FindingCode\` is the union of all codes in [findings](findings.md).

${types("plan-types.d.ts", (name) => name !== "FindingCode")}
### Jobs

The fields of every cycle: [the manual](cycles/), \`touchpath/schema.json\`, and the types of the package. \`Cycle\` is any of them.

${types("job-types.d.ts", (name) => name !== "Cycle" && !forms.names.includes(name))}
${forms.text}

## The element: \`import "touchpath-element"\`

${element()}
${parts()}
### Types

The class of the element is \`TouchPath\`, and that of panels elsewhere \`TouchPart\`.

${types("events.d.ts", (name) => name !== "EVENTS")}
${types("element/element.d.ts")}
### React

\`import type {} from "touchpath-element/react"\` tells TSX of the element.

${types("react.d.ts")}
## The frame: \`import { connect } from "touchpath-element/frame"\`

${types("frame.d.ts")}
### Messages

${types("protocol.d.ts")}
## The command: \`npx touchpath\`

\`\`\`text
${help.replace(/^touchpath \S+:/, "touchpath:")}\`\`\`
`;

// The page contains every importable name: declared, or as code.
const entries = [
  "node.d.ts",
  "browser.d.ts",
  "frame.d.ts",
  "react.d.ts",
  "element/element.d.ts",
];
// Functions for the page only are not declared.
const inside = ["judged", "misfit"];
const values = Object.keys(
  await import(pathToFileURL(at("dist", "node.js")).href),
).filter((name) => !inside.includes(name));
const missing = [
  ...new Set([...values, ...entries.flatMap((entry) => exported(entry))]),
].filter(
  (name) =>
    !new RegExp(
      `^(### |(interface|class|type|function|const) )${name}\\b|\`${name}\``,
      "m",
    ).test(page),
);
if (missing.length > 0) {
  console.error(`docs/reference.md lacks ${missing.join(", ")}`);
  process.exit(1);
}

const file = at("docs", "reference.md");
if (process.argv[2] === "check") {
  if (readFileSync(file, "utf8") !== page) {
    console.error(
      "docs/reference.md is stale: run `node scripts/reference.mjs`",
    );
    process.exit(1);
  }
} else if (process.argv[1] === fileURLToPath(import.meta.url))
  writeFileSync(file, page);
