// Loads the module in a worker. The page has fetched both parts already.
import type { Raw } from "./core/instance.js";
import first from "./core/wasm/first.wasm?url";
import rest from "./core/wasm/rest.wasm?url";
import init, * as raw from "./core/wasm/touchpath.js";

const compiled = fetch(rest)
  .then((response) => response.arrayBuffer())
  .then((bytes) => WebAssembly.compile(bytes));
await init({ module_or_path: first });
raw.join(await compiled);

export { raw };
export const prebuiltAnswers: Raw | null = null;
export const arrival: Promise<void> | null = null;
export const completeNow = (): boolean => false;
export async function loadWhole(): Promise<void> {}
