// The package.json of `touchpath-element`: made of that of `touchpath`, so that the two have the same version, licence and addresses.
import { readFileSync } from "node:fs";
import { at } from "./lib.mjs";

/** An entry with types. */
const entry = (/** @type {string} */ path) => ({
  types: `${path}.d.ts`,
  default: `${path}.js`,
});

export function elementManifest() {
  const { version, license, author, homepage, repository, bugs, engines } =
    JSON.parse(readFileSync(at("package.json"), "utf8"));
  return {
    name: "touchpath-element",
    version,
    description:
      "Touch-probe cycles on your own page: the element <touch-path>, its components and its frame",
    license,
    author,
    homepage,
    repository,
    bugs,
    type: "module",
    engines,
    exports: {
      ".": entry("./element/element"),
      "./frame": entry("./frame"),
      "./react": entry("./react"),
      "./svelte": { types: "./svelte.d.ts" },
      "./vue": { types: "./vue.d.ts" },
      "./words/*": { types: "./words/words.d.ts", default: "./words/*.js" },
      "./embed.html": "./embed.html",
      "./frame.schema.json": "./frame.schema.json",
      "./custom-elements.json": "./custom-elements.json",
      "./web-types.json": "./web-types.json",
      "./package.json": "./package.json",
    },
    bin: { "touchpath-element": "./site.js" },
    sideEffects: true,
    dependencies: { touchpath: version },
    peerDependencies: { react: ">=19", svelte: ">=5", vue: ">=3.3" },
    peerDependenciesMeta: {
      react: { optional: true },
      svelte: { optional: true },
      vue: { optional: true },
    },
    customElements: "custom-elements.json",
    "web-types": "web-types.json",
  };
}
