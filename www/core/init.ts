// The functions of the package without a loader: the caller passes the module.
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

/** Gives the functions their module, `touchpath/touchpath.wasm`: compiled, or as its bytes. Once, before any other call; a second call changes nothing. */
export function init(module: WebAssembly.Module | BufferSource): void {
  raw.initSync({ module });
  attach(raw, raw.__wbg_reset_state);
}
