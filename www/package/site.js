#!/usr/bin/env node
// Copies the element, its frame and the functions into a folder for a web server: pages use them there without a build tool.
import { cpSync, existsSync, readdirSync, readFileSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

const USAGE = `touchpath-element FOLDER
  Copies the element, its frame and the functions into FOLDER, for pages without a build tool:
  <script type="module" src="FOLDER/element/element.js"></script>
  Run it again after an update. The origins in FOLDER/embed.html are kept.
`;
const ORIGINS = /(?<=<meta name="touchpath-origins" content=")[^"]*/;
/** Files of this package that need a bundler or Node. */
const NOT_SERVED = ["core.js", "react.js", "report.js", "site.js"];

function copy(folder) {
  const own = dirname(fileURLToPath(import.meta.url));
  const core = dirname(dirname(createRequire(import.meta.url).resolve("touchpath/touchpath.wasm")));
  const frame = join(folder, "embed.html");
  const origins = existsSync(frame) && ORIGINS.exec(readFileSync(frame, "utf8"))?.[0];
  const served = readdirSync(own).filter((name) => /\.(js|html|css)$/.test(name) && !NOT_SERVED.includes(name));
  for (const name of served) cpSync(join(own, name), join(folder, name));
  for (const name of ["element", "words"])
    cpSync(join(own, name), join(folder, name), { recursive: true, filter: (path) => !path.endsWith(".d.ts") });
  for (const name of readdirSync(core).filter((name) => name.endsWith(".js") && !["node.js", "workerd.js"].includes(name)))
    cpSync(join(core, name), join(folder, "core", name));
  for (const name of ["touchpath.js", "touchpath_bg.wasm"]) cpSync(join(core, "wasm", name), join(folder, "core", "wasm", name));
  // A browser does not find a package by its name.
  writeFileSync(join(folder, "core.js"), 'export * from "./core/browser.js";\n');
  writeFileSync(join(folder, "report.js"), 'export * from "./core/report.js";\n');
  if (origins) writeFileSync(frame, readFileSync(frame, "utf8").replace(ORIGINS, () => origins));
}

const [folder, ...more] = process.argv.slice(2);
if (folder === "--help") process.stdout.write(USAGE);
else if (!folder || folder.startsWith("-") || more.length > 0) {
  process.stderr.write(USAGE);
  process.exitCode = 2;
} else
  try {
    copy(folder);
  } catch (why) {
    process.stderr.write(`touchpath-element: ${why.message}\n`);
    process.exitCode = 2;
  }
