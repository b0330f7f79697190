// npm runs this before it packs. It refuses a quick build, whose module is in one part and in a profile that is not published.
import { readFileSync } from "node:fs";
import { at } from "./lib.mjs";

const module = (/** @type {string} */ name) =>
  readFileSync(at("www", "core", "wasm", name));

if (module("first.wasm").equals(module("touchpath_bg.wasm"))) {
  console.error(
    "dist/ is a quick build, which is not published: run `npm run build` first",
  );
  process.exit(1);
}
