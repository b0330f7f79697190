import { defineConfig } from "vite";

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

export default defineConfig({
  root: "www",
  base: "./",
  plugins: [preload()],
  worker: { format: "es" },
  build: {
    outDir: "../dist/page",
    emptyOutDir: true,
    target: "es2022",
    assetsInlineLimit: 0,
    license: { fileName: "licences.txt" },
  },
});
