// A small static server for dist/page.
import { open, stat } from "node:fs/promises";
import { createServer } from "node:http";
import { extname, join, resolve, sep } from "node:path";
import { pipeline } from "node:stream";
import { brotliCompress, constants } from "node:zlib";
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

/** Error codes of a missing file; any other error is the server's. */
const missing = ["ENOENT", "ENOTDIR", "ENAMETOOLONG", "ERR_INVALID_ARG_VALUE"];

/**
 * The path of an address in a folder; null if the address leads outside.
 * @param {string} folder
 * @param {string} address
 */
function pathOf(folder, address) {
  try {
    const path = resolve(
      join(
        folder,
        decodeURIComponent(new URL(address, "http://localhost").pathname),
      ),
    );
    return path === folder || path.startsWith(folder + sep) ? path : null;
  } catch {
    return null;
  }
}

/** Whether a file never changes: its name contains the hash of its content. */
export const lasts = (/** @type {string} */ file) =>
  /-[\w-]{8}\.\w+$/.test(file);

/** Compressed files by name and time. @type {Map<string, Promise<Buffer>>} */
const packed = new Map();

/**
 * A file in brotli, compressed once.
 * @param {import("node:fs/promises").FileHandle} handle
 * @param {string} key
 */
function compressed(handle, key) {
  let known = packed.get(key);
  if (!known) {
    const params = { [constants.BROTLI_PARAM_QUALITY]: 5 };
    known = handle
      .readFile()
      .then(
        (bytes) =>
          new Promise((done, fail) =>
            brotliCompress(bytes, { params }, (e, out) =>
              e ? fail(e) : done(out),
            ),
          ),
      );
    packed.set(key, known);
  }
  return known;
}

/**
 * Answers with the file, or a folder's index.html. Returns the status, 200 once the file is being sent.
 * @param {string | null} path
 * @param {import("node:http").ServerResponse} response
 * @param {boolean} brotli whether the browser accepts it and the server is set to it
 */
async function answer(path, response, brotli) {
  if (path === null) return 404;
  try {
    const file = (await stat(path)).isDirectory()
      ? join(path, "index.html")
      : path;
    const handle = await open(file);
    const about = await handle.stat();
    if (!about.isFile()) {
      await handle.close();
      return 404;
    }
    const head = {
      "content-type": types[extname(file)] ?? "application/octet-stream",
      "cache-control": lasts(file) ? "max-age=31536000, immutable" : "no-cache",
    };
    if (brotli && extname(file) !== ".png") {
      const bytes = await compressed(
        handle,
        `${file} ${about.mtimeMs} ${about.size}`,
      ).finally(() => handle.close());
      response
        .writeHead(200, {
          ...head,
          "content-encoding": "br",
          vary: "accept-encoding",
        })
        .end(bytes);
      return 200;
    }
    response.writeHead(200, head);
    pipeline(handle.createReadStream(), response, () => {});
    return 200;
  } catch (error) {
    return missing.includes(
      /** @type {NodeJS.ErrnoException} */ (error).code ?? "",
    )
      ? 404
      : 500;
  }
}

/**
 * Serves a folder, by default the page. Port 0 takes a free port; HOST sets another network interface than this machine's own. Returns the server once it
 * listens. `compresses`: sends brotli, for browsers elsewhere.
 * @param {number} port
 * @returns {Promise<import("node:http").Server>}
 */
export function serve(
  port,
  folder = at("dist", "page"),
  host = process.env.HOST ?? "127.0.0.1",
  compresses = false,
) {
  const root = resolve(folder);
  const server = createServer(async (request, response) => {
    const brotli =
      compresses &&
      /\bbr\b/.test(String(request.headers["accept-encoding"] ?? ""));
    const status = await answer(
      pathOf(root, request.url ?? "/"),
      response,
      brotli,
    );
    if (status === 200) return;
    const words = status === 404 ? "not found" : "this file cannot be read";
    response
      .writeHead(status, { "content-type": "text/plain; charset=utf-8" })
      .end(`${words}\n`);
  });
  return new Promise((done, fail) => {
    server.once("error", fail);
    server.listen(port, host, () => done(server));
  });
}

/**
 * Address of a listening server.
 * @param {import("node:http").Server} server
 */
export function addressOf(server) {
  const place = server.address();
  if (!place || typeof place === "string")
    throw new Error("the server listens on a port");
  const all =
    place.address === "0.0.0.0" ||
    place.address === "::" ||
    place.address === "127.0.0.1";
  const name = place.family === "IPv6" ? `[${place.address}]` : place.address;
  return `http://${all ? "localhost" : name}:${place.port}/`;
}
