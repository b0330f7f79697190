// The element for the package: one small entry and what it loads, around the package's own core.
import { readFileSync } from "node:fs";
import { defineConfig } from "vite";

const { version } = JSON.parse(
  readFileSync(new URL("package.json", import.meta.url), "utf8"),
);

/** A page may hold two versions: the elements inside have the version in their names, for a name can be taken once only. @returns {import("vite").Plugin} */
const named = () => ({
  name: "named-by-version",
  enforce: "pre",
  transform: (code, id) =>
    /\/www\/.*\.(?:ts|css)(?:\?|$)/.test(id)
      ? code.replaceAll(
          /\btp-(?=[a-z])/g,
          `tp-${version.replaceAll(".", "-")}-`,
        )
      : null,
});

/** Files of the package that the bundle leaves alone, by their sources. @type {[RegExp, string][]} */
const OWN = [
  [/^.*core\/browser\.js$/, "../core.js"],
  [/^.*core\/report\.js$/, "../report.js"],
  [/^.*words\/([\w-]+)\.json$/, "../words/$1.js"],
];

export default defineConfig({
  root: "www",
  define: { VERSION: JSON.stringify(version) },
  publicDir: false,
  plugins: [
    named(),
    {
      name: "core",
      enforce: "pre",
      resolveId: (id) => {
        const own = OWN.find(([source]) => source.test(id));
        return own ? { id: id.replace(...own), external: true } : null;
      },
    },
  ],
  build: {
    outDir: "../dist/touchpath-element/element",
    emptyOutDir: true,
    target: "es2022",
    minify: true,
    assetsInlineLimit: 0,
    license: { fileName: "licences.txt" },
    lib: { entry: "element.ts", formats: ["es"], fileName: () => "element.js" },
    rolldownOptions: { output: { chunkFileNames: "[name].js" } },
  },
});
