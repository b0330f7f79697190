// Entry for Cloudflare's workerd, which compiles a module only where it is imported.
import { attach } from "./instance.js";
import * as raw from "./wasm/touchpath.js";
// @ts-expect-error: there it is the compiled module, and not what it exports
import module from "./wasm/touchpath_bg.wasm";

export * from "./api.js";
export { say } from "./said.js";
export type * from "./types.js";

raw.initSync({ module });
attach(raw, raw.__wbg_reset_state);
