import { readFileSync } from "node:fs";
import { dress, Instance } from "./api.js";
import * as raw from "./wasm/touchpath.js";

export { JobError } from "./api.js";
export { say } from "./said.js";
export type * from "./types.js";

raw.initSync({ module: readFileSync(new URL("./wasm/touchpath_bg.wasm", import.meta.url)) });

export const {
  catalog,
  defaultJob,
  jobName,
  check,
  plan,
  program,
  programs,
  evaluate,
  measure,
  moveColumns,
  importJob,
  readProgram,
  jobSchema,
  exportTable,
  meanings,
  svg,
  convertUnits,
  lentoax,
  lentoaxWords,
  version,
} = dress(raw, new Instance(raw.__wbg_reset_state));
