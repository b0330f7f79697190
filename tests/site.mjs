// The folder that `touchpath-element FOLDER` makes, from this repository's build.
import { execFileSync } from "node:child_process";
import { mkdtempSync, rmSync, symlinkSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { at, root } from "../scripts/lib.mjs";

/** Copies the element, its frame and the functions into a folder, as users do. */
export function site(/** @type {string} */ folder) {
  const packages = mkdtempSync(join(tmpdir(), "touchpath-packages-"));
  symlinkSync(root, join(packages, "touchpath"), "junction");
  execFileSync("node", [at("dist", "touchpath-element", "site.js"), folder], {
    env: { ...process.env, NODE_PATH: packages },
  });
  rmSync(packages, { recursive: true });
}
