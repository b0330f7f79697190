// Builds the extension for VS Code: dist/vscode/touchpath.vsix, a zip with its manifest, both scripts and the module.
import {
  mkdirSync,
  readdirSync,
  readFileSync,
  rmSync,
  writeFileSync,
} from "node:fs";
import { build } from "esbuild";
import { strToU8, zipSync } from "fflate";
import { at } from "./lib.mjs";
import { crateLicences } from "./licences.mjs";

/** Bundles a script of the extension; also returns the folders of the libraries in it. @param {string} name */
async function bundled(name) {
  const { outputFiles, metafile } = await build({
    entryPoints: [at("www", "editor", `${name}.ts`)],
    bundle: true,
    write: false,
    platform: "node",
    format: "cjs",
    target: "node20",
    minify: true,
    metafile: true,
    external: ["vscode"],
    // Only the module's own loader asks for its address, and the server provides the module.
    logOverride: { "empty-import-meta": "silent" },
  });
  const folders = Object.keys(metafile.inputs).flatMap(
    (path) => /^.*node_modules\/(?:@[^/]+\/)?[^/]+/.exec(path)?.[0] ?? [],
  );
  const text = /** @type {Uint8Array} */ (outputFiles[0]?.contents);
  return { text, folders };
}

/** The licence of a library, with its name. */
function licenceOf(/** @type {string} */ folder) {
  const { name, version, license } = JSON.parse(
    readFileSync(at(folder, "package.json"), "utf8"),
  );
  const file = readdirSync(at(folder)).find((name) =>
    /^licen[cs]e/i.test(name),
  );
  const text = file ? readFileSync(at(folder, file), "utf8").trim() : "";
  return `## ${name} - ${version} (${license})\n\n${text}\n`;
}

const escaped = (/** @type {string} */ text) =>
  text
    .replaceAll("&", "&amp;")
    .replaceAll("<", "&lt;")
    .replaceAll('"', "&quot;");

/** Manifest of the package, as VS Code's gallery and its installer read it. @param {any} own */
const manifest = ({
  name,
  version,
  publisher,
  displayName,
  description,
  engines,
  categories,
}) =>
  `<?xml version="1.0" encoding="utf-8"?>
<PackageManifest Version="2.0.0" xmlns="http://schemas.microsoft.com/developer/vsx-schema/2011">
  <Metadata>
    <Identity Language="en-US" Id="${name}" Version="${version}" Publisher="${publisher}"/>
    <DisplayName>${escaped(displayName)}</DisplayName>
    <Description xml:space="preserve">${escaped(description)}</Description>
    <Categories>${categories.join(",")}</Categories>
    <License>extension/LICENSE.txt</License>
    <Properties>
      <Property Id="Microsoft.VisualStudio.Code.Engine" Value="${engines.vscode}"/>
      <Property Id="Microsoft.VisualStudio.Code.ExtensionKind" Value="workspace"/>
    </Properties>
  </Metadata>
  <Installation><InstallationTarget Id="Microsoft.VisualStudio.Code"/></Installation>
  <Dependencies/>
  <Assets>
    <Asset Type="Microsoft.VisualStudio.Code.Manifest" Path="extension/package.json" Addressable="true"/>
    <Asset Type="Microsoft.VisualStudio.Services.Content.Details" Path="extension/readme.md" Addressable="true"/>
  </Assets>
</PackageManifest>
`;

const TYPES = `<?xml version="1.0" encoding="utf-8"?>
<Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types">${[
  ["json", "application/json"],
  ["js", "application/javascript"],
  ["md", "text/markdown"],
  ["txt", "text/plain"],
  ["wasm", "application/wasm"],
  ["vsixmanifest", "text/xml"],
]
  .map(
    ([ending, type]) =>
      `<Default Extension=".${ending}" ContentType="${type}"/>`,
  )
  .join("")}</Types>
`;

/** Writes the extension. */
export async function buildExtension() {
  const { version } = JSON.parse(readFileSync(at("package.json"), "utf8"));
  const { PROGRAM_POSTS } = await import(
    new URL("../dist/program-posts.js", import.meta.url).href
  );
  const own = {
    ...JSON.parse(readFileSync(at("www", "editor", "extension.json"), "utf8")),
    version,
  };
  own.contributes.configuration.properties["touchpath.control"].enum = [
    null,
    ...PROGRAM_POSTS,
  ];
  const scripts = await Promise.all(["client", "server"].map(bundled));
  const folders = [...new Set(scripts.flatMap(({ folders }) => folders))];
  const licences = [
    ...["LICENSE-MIT", "LICENSE-APACHE"].map((name) =>
      readFileSync(at(name), "utf8"),
    ),
    crateLicences(),
    ...folders.sort().map(licenceOf),
  ];
  /** @type {Record<string, Uint8Array>} */
  const files = {
    "[Content_Types].xml": strToU8(TYPES),
    "extension.vsixmanifest": strToU8(manifest(own)),
    "extension/package.json": strToU8(`${JSON.stringify(own, null, 2)}\n`),
    "extension/readme.md": readFileSync(at("docs", "editor.md")),
    "extension/LICENSE.txt": strToU8(licences.join("\n")),
    "extension/client.js": /** @type {any} */ (scripts[0]).text,
    "extension/server.js": /** @type {any} */ (scripts[1]).text,
    "extension/touchpath.wasm": readFileSync(
      at("dist", "wasm", "touchpath_bg.wasm"),
    ),
  };
  rmSync(at("dist", "vscode"), { recursive: true, force: true });
  mkdirSync(at("dist", "vscode"));
  // The same contents make the same file.
  const mtime = new Date(Date.UTC(1980, 0, 2));
  writeFileSync(
    at("dist", "vscode", "touchpath.vsix"),
    zipSync(files, { mtime, level: 9 }),
  );
}

if (process.argv[1] === import.meta.filename) await buildExtension();
