// Runs the test's calls with the parts of the module: in a worker, because a module is shared by all its importers.
import { readFileSync } from "node:fs";
import { parentPort, workerData } from "node:worker_threads";
import * as api from "../../dist/init.js";
import { join } from "../../dist/wasm/touchpath.js";
import { asked } from "./parts.mjs";

const module = (/** @type {string} */ name) =>
  new WebAssembly.Module(
    readFileSync(new URL(`../../www/core/wasm/${name}.wasm`, import.meta.url)),
  );
api.init(module("first"));
const answers = [];
for (const one of asked(api, workerData)) {
  if (one === "join") join(module("rest"));
  else answers.push(one);
}
parentPort?.postMessage(answers);
