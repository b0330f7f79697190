import { readFileSync } from "node:fs";
import { attach } from "./instance.js";
import * as raw from "./wasm/touchpath.js";

export * from "./api.js";
export { say } from "./said.js";
export type * from "./types.js";

raw.initSync({ module: readFileSync(new URL("./wasm/touchpath_bg.wasm", import.meta.url)) });
attach(raw, raw.__wbg_reset_state);
