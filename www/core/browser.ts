import { dress } from "./api.js";
import init, * as raw from "./wasm/touchpath.js";

export * from "./api.js";
export { View } from "./wasm/touchpath.js";

await init();

export const {
  catalog,
  defaultJob,
  check,
  plan,
  evaluate,
  moveColumns,
  importJob,
  jobSchema,
  exportTable,
  lentoax,
  lentoaxWords,
  version,
} = dress(raw);
