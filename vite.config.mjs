import { createHash } from "node:crypto";
import { readFileSync } from "node:fs";
import { fileURLToPath } from "node:url";
import { defineConfig } from "vite";

/** Cycle of a first visit. */
const [, FIRST_CYCLE = ""] =
  /FIRST_CYCLE = "([\w-]+)"/.exec(
    readFileSync(new URL("www/first-cycle.ts", import.meta.url), "utf8"),
  ) ?? [];

const { version } = JSON.parse(
  readFileSync(new URL("package.json", import.meta.url), "utf8"),
);

/** What the page will need is asked for with the page itself, not when the script that needs it has come. @returns {import("vite").Plugin} */
const preload = () => ({
  name: "preload",
  transformIndexHtml: {
    order: "post",
    handler(html, { bundle }) {
      const files = Object.values(bundle ?? {});
      const module = files.find(({ fileName }) =>
        /\bfirst-[^/]*\.wasm$/.test(fileName),
      );
      const app = files.find(
        (file) =>
          file.type === "chunk" &&
          file.facadeModuleId?.endsWith("/parts/app.ts"),
      );
      const scripts =
        app?.type === "chunk" ? [app.fileName, ...app.imports] : [];
      const links = scripts
        .filter((name) => !html.includes(name))
        .map((name) => ({ rel: "modulepreload", href: `./${name}` }));
      // A server that sends one after the other sends scripts first: with them the page can be read.
      const as = {
        rel: "preload",
        as: "fetch",
        type: "application/wasm",
        crossorigin: true,
        fetchpriority: "low",
      };
      const wasm = module ? [{ ...as, href: `./${module.fileName}` }] : [];
      return [...wasm, ...links].map((attrs) => ({
        tag: "link",
        attrs,
        injectTo: "head",
      }));
    },
  },
});

/** The page begins with the first part of the module; its workers wait for both. @returns {import("vite").Plugin} */
const parts = (/** @type {string} */ loader) => {
  let replaced = false;
  return {
    name: "parts-of-the-module",
    enforce: "pre",
    resolveId(id, from) {
      if (id !== "./load.js" || !from?.endsWith("/core/browser.ts"))
        return null;
      replaced = true;
      return fileURLToPath(new URL(loader, import.meta.url));
    },
    // The bindings would have the whole module beside them.
    transform: (code, id) =>
      id.endsWith("/core/wasm/touchpath.js")
        ? code.replace("new URL('touchpath_bg.wasm', import.meta.url)", "''")
        : null,
    buildEnd(error) {
      if (!error && !replaced)
        throw new Error(
          "www/core/load.ts was not replaced: the page would load the whole module, too",
        );
    },
  };
};

/** A value as a script that makes it: JSON knows neither NaN nor -0. @returns {string} */
function written(/** @type {unknown} */ value) {
  if (typeof value === "number")
    return Object.is(value, -0) ? "-0" : String(value);
  if (ArrayBuffer.isView(value))
    return `new ${value.constructor.name}([${Array.from(/** @type {Float64Array} */ (value), written).join(",")}])`;
  if (Array.isArray(value)) return `[${value.map(written).join(",")}]`;
  if (value === null || typeof value !== "object")
    return JSON.stringify(value) ?? "void 0";
  return `{${Object.entries(value)
    .map(([key, inner]) => `${JSON.stringify(key)}:${written(inner)}`)
    .join(",")}}`;
}

/**
 * What the module says of the jobs that a first visit begins with: www/first-answers.ts answers with it until the module is there. @returns {import("vite").Plugin}
 */
const answers = () => ({
  name: "first-answers",
  resolveId: (id) => (id === "virtual:first-answers" ? id : null),
  async load(id) {
    if (id !== "virtual:first-answers") return null;
    const dist = (/** @type {string} */ name) =>
      new URL(`dist/${name}`, import.meta.url);
    const raw = await import(dist("wasm/touchpath.js").href);
    const { coded } = await import(dist("coded.js").href);
    const { Sink } = await import(dist("instance.js").href);
    raw.initSync({ module: readFileSync(dist("wasm/touchpath_bg.wasm")) });
    const catalog = raw.catalog();
    const type = FIRST_CYCLE;
    const known = (/** @type {"mm" | "inch"} */ units) => {
      const job = raw.defaultJob(type, units);
      const { codes, text } = coded(job);
      const packed = (/** @type {"plan" | "table" | "meanings"} */ which) => {
        const sink = new Sink();
        raw[which](codes, text, sink);
        return { numbers: sink.numbers, text: sink.text };
      };
      return {
        job,
        name: raw.jobName(codes, text),
        misfit: raw.misfit(codes, text),
        findings: raw.check(codes, text),
        plan: packed("plan"),
        table: packed("table"),
        meanings: packed("meanings"),
      };
    };
    return `export default ${written({ type, version: raw.version(), limits: raw.limits(), catalog, mm: known("mm"), inch: known("inch") })};`;
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
    async handler(html, { bundle }) {
      const { defaultJob, svg } = await import(
        new URL("dist/node.js", import.meta.url).href
      );
      const type = FIRST_CYCLE;
      const picture = (/** @type {"mm" | "inch"} */ units) =>
        svg(defaultJob(type, units), "top")
          .replace(/<title>.*?<\/title>\n/, "")
          // The page has its own ground and size, and names dimensions in the user's language.
          .replace(/<rect x="0" y="0"[^>]*fill="#fff"\/>\n/, "")
          .replace(
            /<path [^>]*stroke="#2563eb" fill="none"\/>[\s\S]*(?=<\/svg>)/,
            "",
          )
          .replace(
            / viewBox="0 0 480 \d+" width="480" height="\d+"/,
            ` class="${units}" viewBox="43 43 394 394" aria-hidden="true"`,
          )
          .replaceAll("touchpath-hatch", `first-hatch-${units}`);
      const cell = "<i></i><i></i><i></i>";
      if (!html.includes(cell))
        throw new Error("the page has no place for its first picture");
      // In the page itself: fetched beside the module it would hold up the first paint. The policy allows this script alone.
      const answers = Object.values(bundle ?? {}).find(
        (file) =>
          file.type === "chunk" &&
          file.facadeModuleId?.endsWith("/first-answers.ts"),
      );
      if (!answers)
        throw new Error("the answers of the first job have no file");
      const script = readFileSync(
        new URL("www/first.js", import.meta.url),
        "utf8",
      )
        .replace(/^\s*\/\/.*\n/gm, "")
        .replace("first-answers.js", answers.fileName);
      // So is its style, for which the first paint waits.
      const [link, address = ""] =
        /<link rel="stylesheet"[^>]* href="\.\/([^"]+)">\s*/.exec(html) ?? [];
      const sheet = bundle?.[address];
      if (link === undefined || sheet?.type !== "asset")
        throw new Error("the page has no style");
      const style = String(sheet.source).trim();
      delete bundle?.[address];
      const allow = (
        /** @type {string} */ page,
        /** @type {string} */ rule,
        /** @type {string} */ content,
      ) => {
        if (!page.includes(rule))
          throw new Error("the policy of the page is not as it was");
        return page.replace(
          rule,
          `${rule} 'sha256-${createHash("sha256").update(content).digest("base64")}'`,
        );
      };
      const whole = html
        .replace(link, "")
        .replace(
          cell,
          `<i></i><i>${picture("mm")}${picture("inch")}</i><i></i>`,
        );
      return {
        html: allow(
          allow(whole, "script-src 'self'", script),
          "style-src 'self'",
          style,
        ),
        tags: [
          { tag: "style", children: style, injectTo: "head" },
          { tag: "script", children: script, injectTo: "head" },
        ],
      };
    },
  },
});

export default defineConfig({
  root: "www",
  define: { VERSION: JSON.stringify(version) },
  base: "./",
  plugins: [parts("www/load-first.ts"), answers(), preload(), first()],
  worker: { format: "es", plugins: () => [parts("www/load-both.ts")] },
  build: {
    outDir: "../dist/page",
    emptyOutDir: true,
    target: "es2022",
    assetsInlineLimit: 0,
    license: { fileName: "licences.txt" },
  },
});
