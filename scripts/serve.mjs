// A small static server for dist/page.
import { open, stat } from "node:fs/promises";
import { createServer } from "node:http";
import { extname, join, resolve, sep } from "node:path";
import { pipeline } from "node:stream";
import { at } from "./lib.mjs";

/** @type {Record<string, string>} */
const types = {
  ".html": "text/html; charset=utf-8",
  ".js": "text/javascript; charset=utf-8",
  ".css": "text/css; charset=utf-8",
  ".wasm": "application/wasm",
  ".svg": "image/svg+xml",
  ".json": "application/json",
  ".webmanifest": "application/manifest+json",
  ".txt": "text/plain; charset=utf-8",
};

/** What is wrong with a file that there is none of; anything else is the server's own trouble. */
const missing = ["ENOENT", "ENOTDIR", "ENAMETOOLONG", "ERR_INVALID_ARG_VALUE"];

/**
 * The path that an address names in a folder; null where it names none there.
 * @param {string} folder
 * @param {string} address
 */
function pathOf(folder, address) {
  try {
    const path = resolve(join(folder, decodeURIComponent(new URL(address, "http://localhost").pathname)));
    return path === folder || path.startsWith(folder + sep) ? path : null;
  } catch {
    return null;
  }
}

/**
 * Answers with the file, or a folder's index.html. Gives the status, 200 once the file is on its way.
 * @param {string | null} path
 * @param {import("node:http").ServerResponse} response
 */
async function answer(path, response) {
  if (path === null) return 404;
  try {
    const file = (await stat(path)).isDirectory() ? join(path, "index.html") : path;
    const handle = await open(file);
    if (!(await handle.stat()).isFile()) {
      await handle.close();
      return 404;
    }
    response.writeHead(200, {
      "content-type": types[extname(file)] ?? "application/octet-stream",
      "cache-control": "no-cache",
    });
    pipeline(handle.createReadStream(), response, () => {});
    return 200;
  } catch (error) {
    return missing.includes(/** @type {NodeJS.ErrnoException} */ (error).code ?? "") ? 404 : 500;
  }
}

/**
 * Serves a folder, the page unless another is named. Port 0 takes any free one; HOST names another interface than this
 * machine's own. Gives the server once it listens.
 * @param {number} port
 * @returns {Promise<import("node:http").Server>}
 */
export function serve(port, folder = at("dist", "page"), host = process.env.HOST ?? "127.0.0.1") {
  const root = resolve(folder);
  const server = createServer(async (request, response) => {
    const status = await answer(pathOf(root, request.url ?? "/"), response);
    if (status === 200) return;
    const words = status === 404 ? "not found" : "this file cannot be read";
    response.writeHead(status, { "content-type": "text/plain; charset=utf-8" }).end(`${words}\n`);
  });
  return new Promise((done, fail) => {
    server.once("error", fail);
    server.listen(port, host, () => done(server));
  });
}

/**
 * Where a server that listens is to be found.
 * @param {import("node:http").Server} server
 */
export function addressOf(server) {
  const place = server.address();
  if (!place || typeof place === "string") throw new Error("the server listens on a port");
  const all = place.address === "0.0.0.0" || place.address === "::" || place.address === "127.0.0.1";
  const name = place.family === "IPv6" ? `[${place.address}]` : place.address;
  return `http://${all ? "localhost" : name}:${place.port}/`;
}
