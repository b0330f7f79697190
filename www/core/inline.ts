// Functions of the package with the module inlined, for servers that are bundled into a single file.
import { attach } from "./instance.js";
import { base64 } from "./wasm/inline.js";
import * as raw from "./wasm/touchpath.js";

export * from "./api.js";
export { say } from "./said.js";
export type * from "./types.js";

raw.initSync({ module: Uint8Array.from(atob(base64), (c) => c.charCodeAt(0)) });
attach(raw, raw.__wbg_reset_state);
