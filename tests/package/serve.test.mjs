// The server of `npm start`: only visible on this machine, and not ended by a file.
import assert from "node:assert/strict";
import {
  chmodSync,
  mkdirSync,
  mkdtempSync,
  rmSync,
  symlinkSync,
  writeFileSync,
} from "node:fs";
import { request } from "node:http";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { addressOf, serve } from "../../scripts/serve.mjs";

/** @type {string} */
let root;
/** @type {import("node:http").Server} */
let server;

before(async () => {
  root = mkdtempSync(join(tmpdir(), "touchpath-serve-"));
  for (const folder of ["page", "page/inner", "page/empty", "page-secret"])
    mkdirSync(join(root, folder));
  writeFileSync(join(root, "page", "index.html"), "the page");
  writeFileSync(join(root, "page", "inner", "index.html"), "inner");
  writeFileSync(join(root, "page-secret", "key.txt"), "secret");
  writeFileSync(join(root, "key.txt"), "secret");
  server = await serve(0, join(root, "page"));
});
after(() => {
  server.close();
  rmSync(root, { recursive: true, force: true });
});

/**
 * A request with its path unchanged: fetch would normalize it.
 * @param {string} path
 * @returns {Promise<{ status: number | undefined, type: string | undefined, text: string }>}
 */
const get = (path, base = addressOf(server)) =>
  new Promise((done, fail) => {
    request(
      {
        ...(({ hostname, port }) => ({ hostname, port }))(new URL(base)),
        path,
      },
      (response) => {
        let text = "";
        response.setEncoding("utf8");
        response.on("data", (part) => {
          text += part;
        });
        response.on("end", () =>
          done({
            status: response.statusCode,
            type: response.headers["content-type"],
            text,
          }),
        );
      },
    )
      .on("error", fail)
      .end();
  });

test("it listened on every interface while it printed localhost", () => {
  const place = server.address();
  assert.ok(place && typeof place === "object");
  assert.equal(place.address, "127.0.0.1");
  assert.equal(addressOf(server), `http://localhost:${place.port}/`);
});

test("HOST names another interface", async () => {
  const open = await serve(0, join(root, "page"), "0.0.0.0");
  const place = open.address();
  assert.ok(place && typeof place === "object");
  assert.equal(place.address, "0.0.0.0");
  assert.equal((await get("/", addressOf(open))).text, "the page");
  open.close();
});

test("one file that could not be read ended it", async () => {
  const locked = join(root, "page", "locked.txt");
  writeFileSync(locked, "no");
  chmodSync(locked, 0o000);
  symlinkSync("loop", join(root, "page", "loop"));
  // Nor can a folder in place of the file be read.
  mkdirSync(join(root, "page", "folder", "index.html"), { recursive: true });
  for (const path of [
    "/locked.txt",
    "/loop",
    "/folder",
    "/empty/",
    "/none",
    "/%00",
    "/%E0%A4%A",
    `/${"x".repeat(5000)}`,
  ]) {
    const { status } = await get(path);
    // Root reads even protected files.
    const wanted = { "/loop": [500], "/locked.txt": [500, 200] }[path] ?? [404];
    assert.ok(wanted.includes(status ?? 0), `${path.slice(0, 20)}: ${status}`);
    assert.equal((await get("/")).text, "the page", `after ${path}`);
  }
});

test("a folder beside it whose name only begins alike was served too", async () => {
  for (const path of [
    "/../page-secret/key.txt",
    "/%2e%2e/page-secret/key.txt",
    "/..%2fpage-secret%2fkey.txt",
    "/..%2fkey.txt",
  ]) {
    const { status, text } = await get(path);
    assert.equal(status, 404, path);
    assert.doesNotMatch(text, /secret/);
  }
  assert.equal((await get("/inner/")).text, "inner");
  assert.equal((await get("/index.html?x=1")).type, "text/html; charset=utf-8");
});
