import { readFileSync } from "node:fs";
import { attach } from "./instance.js";
import * as raw from "./wasm/touchpath.js";

export * from "./api.js";
export { say } from "./said.js";
export type * from "./types.js";

// Written so that no bundler treats it as an asset of a page and replaces the address.
const beside = (path: string) => new URL(path, import.meta.url);
raw.initSync({ module: readFileSync(beside("./wasm/touchpath_bg.wasm")) });
attach(raw, raw.__wbg_reset_state);
