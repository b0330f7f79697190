// The extension for VS Code, from its file: the server that the editor starts, asked as the editor asks.
import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import {
  mkdirSync,
  mkdtempSync,
  readFileSync,
  rmSync,
  writeFileSync,
} from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { after, before, test } from "node:test";
import { strFromU8, unzipSync } from "fflate";
import { defaultJob, program, version } from "touchpath";
import {
  createMessageConnection,
  StreamMessageReader,
  StreamMessageWriter,
} from "vscode-jsonrpc/node";
import { at } from "../../scripts/lib.mjs";

const folder = mkdtempSync(join(tmpdir(), "touchpath-editor-"));
const files = unzipSync(readFileSync(at("dist", "vscode", "touchpath.vsix")));
/** @type {import("node:child_process").ChildProcess} */
let server;
/** @type {import("vscode-jsonrpc").MessageConnection} */
let editor;
/** What the server said last of each document. @type {Map<string, any[]>} */
const said = new Map();
/** Called at every message about a document. @type {Set<() => void>} */
const waiting = new Set();

before(async () => {
  for (const [name, bytes] of Object.entries(files)) {
    mkdirSync(join(folder, dirname(name)), { recursive: true });
    writeFileSync(join(folder, name), bytes);
  }
  server = spawn("node", [join(folder, "extension", "server.js"), "--stdio"], {
    stdio: ["pipe", "pipe", "inherit"],
  });
  editor = createMessageConnection(
    new StreamMessageReader(/** @type {any} */ (server.stdout)),
    new StreamMessageWriter(/** @type {any} */ (server.stdin)),
  );
  editor.onNotification(
    "textDocument/publishDiagnostics",
    ({ uri, diagnostics }) => {
      said.set(uri, diagnostics);
      for (const one of waiting) one();
    },
  );
  editor.onRequest("client/registerCapability", () => null);
  editor.onRequest("workspace/configuration", () => [{ control: "haas" }]);
  editor.listen();
  const { capabilities } = /** @type {any} */ (
    await editor.sendRequest("initialize", {
      processId: process.pid,
      rootUri: null,
      capabilities: {
        workspace: {
          configuration: true,
          didChangeConfiguration: { dynamicRegistration: true },
        },
      },
    })
  );
  assert.equal(capabilities.hoverProvider, true);
  await editor.sendNotification("initialized", {});
});

after(() => {
  editor?.dispose();
  server?.kill();
  rmSync(folder, { recursive: true, force: true });
});

/** Waits for what the server says next of a document. @param {string} uri @returns {Promise<any[]>} */
const next = (uri) =>
  new Promise((done) => {
    const hear = () => {
      const found = said.get(uri);
      if (!found) return;
      waiting.delete(hear);
      said.delete(uri);
      done(found);
    };
    waiting.add(hear);
    hear();
  });

/** Opens a program; gives what is said of it. @param {string} name @param {string} text */
async function opened(name, text) {
  const uri = `file:///${name}`;
  await editor.sendNotification("textDocument/didOpen", {
    textDocument: { uri, languageId: "probing-program", version: 1, text },
  });
  return next(uri);
}

/** What is said below the pointer in a line. @param {string} name @param {number} line */
async function hover(name, line) {
  const found = /** @type {any} */ (
    await editor.sendRequest("textDocument/hover", {
      textDocument: { uri: `file:///${name}` },
      position: { line, character: 1 },
    })
  );
  return found?.contents.value ?? null;
}

test("a broken rule and a contradicting argument are errors at their lines, until they are mended", async () => {
  const lines = [
    "%",
    "O1",
    "G21 G90 G17 G40 G49 G80 G94",
    "G0 X0 Y0 Z10.",
    "G65 P9811 Z-5. F500.",
    "G31 Z-20. F100.",
    "M30",
    "%",
  ];
  const found = await opened("bad.nc", lines.join("\n"));
  const errors = found.filter(({ severity }) => severity === 1);
  const unsound = errors.find(({ code }) => code === "call-unsound");
  assert.equal(unsound.range.start.line, 4);
  assert.match(unsound.message, /F is 500: 0 to 1 is possible/);
  assert.ok(found.every(({ source }) => source === "touchpath"));
  // The share of the error that the correction takes.
  lines[4] = "G65 P9811 Z-5. F0.5";
  await editor.sendNotification("textDocument/didChange", {
    textDocument: { uri: "file:///bad.nc", version: 2 },
    contentChanges: [{ text: lines.join("\n") }],
  });
  const mended = await next("file:///bad.nc");
  assert.ok(!mended.some(({ code }) => code === "call-unsound"));
});

test("a program of ours breaks no rule, and its touches say where they go", async () => {
  const { text } = program({
    .../** @type {any} */ (defaultJob("hole")),
    control: { post: "haas" },
  });
  const found = await opened("ours.nc", text);
  assert.deepEqual(
    found.filter(({ severity }) => severity === 1),
    [],
  );
  const touch = text
    .split("\n")
    .findIndex((line) => /^G31 .*F150\./.test(line));
  const words = await hover("ours.nc", touch);
  assert.match(
    words,
    /`G31`: skip move\. It stops at the signal of the probe\./,
  );
  assert.match(words, /Probing move to X-?\d+(\.\d+)? Y.* Z.* at F150/);
});

test("a macro call is explained, argument by argument, and a program that does not probe is left alone", async () => {
  await opened(
    "call.nc",
    "%\nO1\nG21 G90\nG65 P9814 D50. Z-10. R-10.\nM30\n%\n",
  );
  const words = await hover("call.nc", 3);
  assert.match(words, /^\*\*G65 P9814\*\*: /);
  assert.match(words, /- `D 50`: .*diameter/);
  assert.deepEqual(await opened("milling.nc", "G0 X0\nG1 X10 F100\nM30\n"), []);
  for (const line of [0, 1, 2])
    assert.equal(await hover("milling.nc", line), null);
  await editor.sendNotification("textDocument/didClose", {
    textDocument: { uri: "file:///call.nc" },
  });
  assert.deepEqual(await next("file:///call.nc"), []);
});

test("words without blanks are explained, and a program with a hundred thousand faults is no flood", async () => {
  await opened("tight.ngc", "G21G90G94\nN30G38.2Z-5F100\n#1=#31\nM2\n");
  assert.match(await hover("tight.ngc", 1), /^`G38\.2`: probing move/);
  assert.ok(!/G31/.test((await hover("tight.ngc", 2)) ?? ""));
  const flood = `G21 G90\nG38.2 Z-5 F100\n${"WHAT IS THIS\n".repeat(1e5)}M2\n`;
  const found = await opened("flood.ngc", flood);
  assert.ok(found.length > 20 && found.length <= 1000, String(found.length));
  assert.ok(found.some(({ message }) => /and \d+ lines more/.test(message)));
});

test("the file is one that an editor installs: manifest, version, engine, licences", () => {
  const text = (/** @type {string} */ name) =>
    strFromU8(/** @type {any} */ (files[name]));
  const own = JSON.parse(text("extension/package.json"));
  assert.equal(own.version, version());
  assert.ok(
    own.contributes.configuration.properties["touchpath.control"].enum.includes(
      "haas",
    ),
  );
  const manifest = text("extension.vsixmanifest");
  assert.ok(
    manifest.includes(`Version="${version()}" Publisher="${own.publisher}"`),
  );
  assert.ok(files[`extension/${own.main}`]);
  for (const [, path = ""] of manifest.matchAll(/ Path="([^"]+)"/g))
    assert.ok(files[path], path);
  assert.match(
    text("extension/LICENSE.txt"),
    /## vscode-languageserver - .*\(MIT\)\n\n.*Microsoft/,
  );
  // Each kind of file has its type.
  for (const name of Object.keys(files).slice(1))
    assert.ok(
      text("[Content_Types].xml").includes(
        `Extension=".${name.split(".").at(-1)}"`,
      ),
      name,
    );
});
