// Writes docs/reference.md from what the package says of itself: doc comments of the types, the element's manifest, the command's help.
// With `check` nothing is written, and a stale file fails.
import { execFileSync } from "node:child_process";
import { readFileSync, writeFileSync } from "node:fs";
import { fileURLToPath } from "node:url";
import { at } from "./lib.mjs";

const read = (/** @type {string} */ name) => readFileSync(at("dist", name), "utf8");

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
  const short = String.raw`(?:type|function|const) (?<short>\w+)(?:[^\n]*;|[\s\S]*?^\}[^\n]*;)$`;
  const all = text.matchAll(new RegExp(`${comment}^export (?:declare )?(?<code>${long}|${short})`, "gm"));
  return [...all].map(({ groups = {} }) => {
    const name = groups.long ?? groups.short ?? "";
    return { name, comment: plain(groups.comment ?? ""), code: groups.code ?? "" };
  });
}

/** The functions of the package, in their order. */
function functions() {
  const api = declarations(read("api.d.ts")).find(({ name }) => name === "Api")?.code ?? "";
  // One line, or as many as there are to the brace that stands as far in as the name. A name may have type parameters.
  const member = String.raw`^ {4}(\w+)((?:<[^\n]*>)?\((?:[^\n]*;|[^\n]*\{\n[\s\S]*?^ {4}\}[^\n]*;))$`;
  const members = [...api.matchAll(new RegExp(String.raw`(\/\*\*(?:(?!\*\/)[\s\S])*\*\/)\n${member}`, "gm"))];
  return members
    .map(([, comment = "", name, signature = ""]) => {
      const code = `${name}${signature}`.replaceAll(/^ {4}( *)/gm, (_, more) => " ".repeat(more.length / 2));
      return `### ${name}\n\n\`\`\`ts\n${code}\n\`\`\`\n\n${plain(comment)}\n`;
    })
    .join("\n");
}

function types(/** @type {string} */ file, /** @type {string[]} */ without = []) {
  return declarations(read(file))
    .filter(({ name }) => !without.includes(name))
    .map(
      ({ comment, code }) =>
        `${comment ? `${comment}\n\n` : ""}\`\`\`ts\n${code.replaceAll(/^ +private .*;\n/gm, "").replaceAll(/^ {4}/gm, "  ")}\n\`\`\`\n`,
    )
    .join("\n");
}

const cell = (/** @type {string | undefined} */ text) => (text ?? "").replaceAll("|", "\\|").replaceAll(/\s+/g, " ");

/** Rows of the element's manifest. @param {string} head @param {any[]} rows @param {(row: any) => (string | undefined)[]} of */
const table = (head, rows, of) => {
  const names = head.split(", ");
  return `| ${names.join(" | ")} |\n|${"---|".repeat(names.length)}\n${rows.map((row) => `| ${of(row).map(cell).join(" | ")} |\n`).join("")}`;
};

function element() {
  const [one] = JSON.parse(read("custom-elements.json")).modules[0].declarations;
  const code = (/** @type {string} */ text) => (text ? `\`${text}\`` : "");
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

const help = execFileSync("node", [at("dist", "cli", "touchpath.js"), "--help"], { encoding: "utf8" });
const page = `# Reference

<!-- generated: npm run build && node scripts/reference.mjs -->

What the package offers, from its own doc comments. How it is put into a portal, a service or a project: [embedding](embedding.md).

## Functions: \`import { plan } from "touchpath"\`

${functions()}
## Types

Lengths are in the job's units, feeds in units a minute, angles in degrees, counter-clockwise positive.

${types("types.d.ts")}
### Plans and catalog

${types("plan-types.d.ts")}
### Jobs

The fields of every cycle: [the manual](cycles/), \`touchpath/schema.json\`, and the types of the package.

## The element: \`import "touchpath/element"\`

${element()}
## The frame: \`import { connect } from "touchpath/frame"\`

${types("frame.d.ts")}
### Messages

${types("protocol.d.ts")}
## The command: \`npx touchpath\`

\`\`\`text
${help.replace(/^touchpath \S+:/, "touchpath:")}\`\`\`
`;

const file = at("docs", "reference.md");
if (process.argv[2] === "check") {
  if (readFileSync(file, "utf8") !== page) {
    console.error("docs/reference.md is stale: run `node scripts/reference.mjs`");
    process.exit(1);
  }
} else if (process.argv[1] === fileURLToPath(import.meta.url)) writeFileSync(file, page);
