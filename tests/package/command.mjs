// Shared by the command's tests: a folder, jobs in it, and a shell that runs `touchpath` there.

import { spawnSync } from "node:child_process";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before } from "node:test";
import { at } from "../../scripts/lib.mjs";

/** @type {string} */
export let folder;
/** @type {typeof import("../../www/core/node.ts")} */
export let touchpath;

/** A folder for the tests of a file, and the package to compare the command with. */
export function setUp() {
  before(async () => {
    folder = mkdtempSync(join(tmpdir(), "touchpath-command-"));
    touchpath = /** @type {any} */ (await import("touchpath"));
  });
  after(() => rmSync(folder, { recursive: true }));
}

export const command = at("dist", "cli", "touchpath.js");
/** Runs the command in the folder. */
export const run = (/** @type {string[]} */ args, input = "") => {
  const { status, stdout, stderr } = spawnSync("node", [command, ...args], {
    cwd: folder,
    input,
    encoding: "utf8",
    maxBuffer: 1e9,
  });
  return { status, stdout, stderr };
};
/** Writes a file into the folder; returns its name. */
export const file = (
  /** @type {string} */ name,
  /** @type {unknown} */ content,
) => {
  writeFileSync(
    join(folder, name),
    typeof content === "string" ? content : JSON.stringify(content),
  );
  return name;
};
/** A job of a type under a name. */
export const job = (/** @type {any} */ type, name = "PROBE") => ({
  ...touchpath.defaultJob(type),
  name,
});
export const wrong = () => ({
  format: 1,
  name: "WRONG",
  cycle: { type: "hole", diameter: -1 },
});
