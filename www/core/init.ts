// Functions of the package without a loader: the caller provides the module.
import { attach, type Raw } from "./instance.js";
import * as raw from "./wasm/touchpath.js";

export * from "./api.js";
export { say } from "./said.js";
export type * from "./types.js";

const missing = new Proxy({} as Raw, {
  get() {
    throw new Error(
      "touchpath/init: call init(module) before any other function",
    );
  },
});
attach(missing, () => {});

/** Provides the module, `touchpath/touchpath.wasm`, compiled or as bytes. Call it once before any other function; further calls change nothing. */
export function init(module: WebAssembly.Module | BufferSource): void {
  raw.initSync({ module });
  attach(raw, raw.__wbg_reset_state);
}
