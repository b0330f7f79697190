import { createHash } from "node:crypto";
import { readFileSync } from "node:fs";
import { defineConfig } from "vite";

const { version } = JSON.parse(readFileSync(new URL("package.json", import.meta.url), "utf8"));

/** What the page will need is asked for with the page itself, not when the script that needs it has come. @returns {import("vite").Plugin} */
const preload = () => ({
  name: "preload",
  transformIndexHtml: {
    order: "post",
    handler(html, { bundle }) {
      const files = Object.values(bundle ?? {});
      const module = files.find(({ fileName }) => fileName.endsWith(".wasm"));
      const app = files.find((file) => file.type === "chunk" && file.facadeModuleId?.endsWith("/parts/app.ts"));
      const scripts = app?.type === "chunk" ? [app.fileName, ...app.imports] : [];
      const links = scripts
        .filter((name) => !html.includes(name))
        .map((name) => ({ rel: "modulepreload", href: `./${name}` }));
      const as = { rel: "preload", as: "fetch", type: "application/wasm", crossorigin: true };
      const wasm = module ? [{ ...as, href: `./${module.fileName}` }] : [];
      return [...wasm, ...links].map((attrs) => ({ tag: "link", attrs, injectTo: "head" }));
    },
  },
});

/**
 * The picture of the job that a first visit begins with, in the page itself: it is there with the first paint, long before the module. @returns {import("vite").Plugin}
 */
const first = () => ({
  name: "first-picture",
  apply: "build",
  transformIndexHtml: {
    order: "post",
    async handler(html) {
      const { catalog, defaultJob, svg } = await import(new URL("dist/node.js", import.meta.url).href);
      const { type } = catalog().cycles[0];
      const picture = (/** @type {"mm" | "inch"} */ units) =>
        svg(defaultJob(type, units), "top")
          .replace(/<title>.*?<\/title>\n/, "")
          // The page has its own ground and size, and names dimensions in the user's language.
          .replace(/<rect x="0" y="0"[^>]*fill="#fff"\/>\n/, "")
          .replace(/<path [^>]*stroke="#2563eb" fill="none"\/>[\s\S]*(?=<\/svg>)/, "")
          .replace(
            / viewBox="0 0 480 \d+" width="480" height="\d+"/,
            ` class="${units}" viewBox="39 50 402 263" aria-hidden="true"`,
          )
          .replaceAll("touchpath-hatch", `first-hatch-${units}`);
      const cell = "<i></i><i></i><i></i>";
      if (!html.includes(cell)) throw new Error("the page has no place for its first picture");
      // In the page itself: fetched beside the module it would hold up the first paint. The policy allows this script alone.
      const script = readFileSync(new URL("www/first.js", import.meta.url), "utf8").replace(/^\s*\/\/.*\n/gm, "");
      const hash = createHash("sha256").update(script).digest("base64");
      const allowed = "script-src 'self'";
      if (!html.includes(allowed)) throw new Error("the policy of the page is not as it was");
      return {
        html: html
          .replace(cell, `<i></i><i>${picture("mm")}${picture("inch")}</i><i></i>`)
          .replace(allowed, `${allowed} 'sha256-${hash}'`),
        tags: [{ tag: "script", children: script, injectTo: "head" }],
      };
    },
  },
});

export default defineConfig({
  root: "www",
  define: { VERSION: JSON.stringify(version) },
  base: "./",
  plugins: [preload(), first()],
  worker: { format: "es" },
  build: {
    outDir: "../dist/page",
    emptyOutDir: true,
    target: "es2022",
    assetsInlineLimit: 0,
    license: { fileName: "licences.txt" },
  },
});
