// The packages as users have them: packed, unpacked beside the libraries of a project, and built with the project's own tools.
import { execFileSync } from "node:child_process";
import {
  cpSync,
  existsSync,
  mkdirSync,
  mkdtempSync,
  rmSync,
  symlinkSync,
  writeFileSync,
} from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { after, before } from "node:test";
import { at } from "../../scripts/lib.mjs";
import { addressOf, serve } from "../../scripts/serve.mjs";
import { launch } from "../page/common.mjs";

/** A folder for projects; it is removed when the tests of the file are over. */
export const folder = mkdtempSync(join(tmpdir(), "touchpath-projects-"));
after(() => rmSync(folder, { recursive: true, force: true }));

const npm = (/** @type {string[]} */ args, cwd = folder) =>
  execFileSync("npm", [...args, "--loglevel=error"], {
    cwd,
    encoding: "utf8",
    stdio: ["ignore", "pipe", "pipe"],
  });

/** The tarballs of both packages. */
export const tarballs = [at(), at("dist", "touchpath-element")].map((from) =>
  join(
    folder,
    JSON.parse(npm(["pack", "--json", "--pack-destination", folder], from))[0]
      .filename,
  ),
);

/**
 * A project with both packages in it, installed from their tarballs, and these libraries of the repository.
 * @param {string} name
 * @param {string[]} libraries
 * @param {string} [from] a folder of `examples/` to begin with
 */
export function project(name, libraries = [], from) {
  const own = join(folder, name);
  mkdirSync(own);
  if (from)
    cpSync(at("examples", from), own, {
      recursive: true,
      filter: (path) => !path.endsWith("node_modules"),
    });
  writeFileSync(
    join(own, "package.json"),
    '{ "private": true, "type": "module" }',
  );
  npm(["install", "--offline", "--no-audit", "--no-fund", ...tarballs], own);
  for (const library of libraries) {
    const place = join(own, "node_modules", library);
    if (existsSync(place)) continue;
    mkdirSync(dirname(place), { recursive: true });
    symlinkSync(at("node_modules", library), place, "junction");
  }
  return own;
}

/** A browser and servers for the tests of a file; they end with them. */
export function inBrowser() {
  /** @type {import("playwright-core").Browser} */
  let browser;
  /** @type {import("node:http").Server[]} */
  const servers = [];
  before(async () => {
    browser = await launch();
  });
  after(async () => {
    await browser.close();
    for (const server of servers) server.close();
  });
  return {
    servers,
    /** Opens a folder's page in the browser; `problems` collects errors that are not visible there. */
    async open(
      /** @type {string} */ folder,
      watch = (/** @type {import("playwright-core").Page} */ _page) => {},
    ) {
      const server = await serve(0, folder);
      servers.push(server);
      const page = await browser.newPage({
        viewport: { width: 1500, height: 800 },
      });
      /** @type {string[]} */
      const problems = [];
      page.on("pageerror", (error) => problems.push(String(error)));
      page.on("console", (message) => {
        const icon = message.location().url.endsWith("favicon.ico");
        if (["error", "warning"].includes(message.type()) && !icon)
          problems.push(message.text());
      });
      watch(page);
      await page.goto(addressOf(server));
      return { page, problems };
    },
  };
}
