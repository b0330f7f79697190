// Licences of the crates in the WebAssembly module, whose notices are distributed with it.
import { readdirSync, readFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { run } from "./lib.mjs";

/** @typedef {{ id: string, name: string, version: string, license: string | null, manifest_path: string, targets: { kind: string[] }[] }} Crate */

/** The crates that touchpath depends on, directly and indirectly, without build dependencies. */
function crates() {
  const args = [
    "metadata",
    "--format-version",
    "1",
    "--locked",
    "--filter-platform",
    "wasm32-unknown-unknown",
  ];
  /** @type {{ packages: Crate[], resolve: { root: string, nodes: { id: string, deps: { pkg: string, dep_kinds: { kind: string | null }[] }[] }[] } }} */
  const { packages, resolve } = JSON.parse(run("cargo", args, { quiet: true }));
  const found = new Set([resolve.root]);
  for (const id of found) {
    const crate = packages.find((p) => p.id === id);
    if (crate?.targets.some((t) => t.kind.includes("proc-macro"))) {
      found.delete(id);
      continue;
    }
    for (const { pkg, dep_kinds } of resolve.nodes.find((n) => n.id === id)
      ?.deps ?? []) {
      if (dep_kinds.some(({ kind }) => kind === null)) found.add(pkg);
    }
  }
  return packages
    .filter((p) => found.has(p.id))
    .sort((a, b) => (a.name < b.name ? -1 : 1));
}

/** Every crate with its licence files, as text. A text that several crates have is printed once. */
export function crateLicences() {
  /** The crate of each text. @type {Map<string, string>} */
  const printed = new Map();
  const parts = crates().map(({ name, version, license, manifest_path }) => {
    const folder = dirname(manifest_path);
    const files = readdirSync(folder)
      .filter((file) => /^(licen[cs]e|copying|notice)/i.test(file))
      .sort();
    const texts = files.map((file) => {
      const text = readFileSync(join(folder, file), "utf8").trim();
      const other = printed.get(text);
      printed.set(text, other ?? name);
      const title = text.split("\n", 1)[0]?.trim();
      return other ? `${title}: the text is that of ${other} above.` : text;
    });
    return [
      `## ${name} - ${version} (${license ?? "see below"})`,
      ...texts,
    ].join("\n\n");
  });
  return `# Licences of the crates in the WebAssembly module\n\n${parts.join("\n\n")}\n`;
}
