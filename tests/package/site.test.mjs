// The command `touchpath-element FOLDER`: files for a web server.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import {
  existsSync,
  mkdtempSync,
  readFileSync,
  rmSync,
  writeFileSync,
} from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, test } from "node:test";
import { at } from "../../scripts/lib.mjs";
import { site } from "../site.mjs";

const folder = mkdtempSync(join(tmpdir(), "touchpath-site-"));
after(() => rmSync(folder, { recursive: true }));

test("an update brings every file again and keeps the origins of the frame", () => {
  const own = join(folder, "site");
  site(own);
  const [frame, script] = ["embed.html", join("element", "element.js")].map(
    (name) => join(own, name),
  );
  const fresh = readFileSync(String(frame), "utf8");
  const edited = fresh.replace(
    'origins" content=""',
    () => 'origins" content="https://portal.example https://$&.example"',
  );
  assert.notEqual(edited, fresh);
  writeFileSync(String(frame), edited.replace("<title>", "<title>Old "));
  writeFileSync(String(script), "old");
  site(own);
  assert.equal(readFileSync(String(frame), "utf8"), edited);
  assert.notEqual(readFileSync(String(script), "utf8"), "old");
  // What only a bundler, Node or an editor uses is not served.
  for (const name of ["react.js", "site.js", "core/node.js", "frame.d.ts"])
    assert.ok(!existsSync(join(own, name)), name);
});

test("without one folder it explains itself and copies nothing", () => {
  const run = (/** @type {string[]} */ ...args) =>
    spawnSync("node", [at("dist", "touchpath-element", "site.js"), ...args], {
      cwd: folder,
      encoding: "utf8",
    });
  for (const args of [[], ["-x"], ["one", "two"]]) {
    const { status, stdout, stderr } = run(...args);
    assert.deepEqual([status, stdout], [2, ""], args.join());
    assert.match(stderr, /^touchpath-element FOLDER\n/);
  }
  assert.equal(run("--help").status, 0);
  // The functions are another package, which is missing here.
  const { status, stderr } = run("alone");
  assert.equal(status, 2);
  assert.match(stderr, /^touchpath-element: Cannot find .*touchpath/);
  assert.ok(!existsSync(join(folder, "alone")));
});
