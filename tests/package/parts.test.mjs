// The page loads the module in two parts: together they answer like the whole, and the first alone never answers wrongly.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { Worker } from "node:worker_threads";
import * as api from "../../dist/node.js";
import { asked } from "./parts.mjs";

const sizeOf = (/** @type {string} */ name) =>
  readFileSync(new URL(`../../www/core/wasm/${name}.wasm`, import.meta.url))
    .length;
/** A quick build has everything in the first part. */
const skip = sizeOf("rest") < 100 && "a quick build is not split";

/** @returns {Promise<string[]>} */
const parts = (/** @type {{ early: boolean }} */ workerData) =>
  new Promise((done, fail) => {
    const address = new URL("parts-worker.mjs", import.meta.url);
    const worker = new Worker(address, { workerData });
    worker.once("message", done);
    worker.once("error", fail);
  });
const whole = (/** @type {{ early: boolean }} */ wanted) =>
  [...asked(api, wanted)].filter((one) => one !== "join");

test("the parts of the module answer as the whole", { skip }, async () => {
  const [own, wanted] = [
    await parts({ early: false }),
    whole({ early: false }),
  ];
  assert.ok(wanted.length >= 900, String(wanted.length));
  for (const [i, answer] of wanted.entries()) assert.equal(own[i], answer);
});

test("the first part alone answers as the whole, or traps: what a first visit asks does not trap", {
  skip,
}, async () => {
  const [own, wanted] = [await parts({ early: true }), whole({ early: true })];
  assert.ok(wanted.length >= 800, String(wanted.length));
  const traps = own.filter((answer) => answer === "trap").length;
  for (const [i, answer] of wanted.entries())
    if (own[i] !== "trap") assert.equal(own[i], answer);
  // The import, which is called on purpose, and rare edits.
  assert.equal(own.at(-2), "trap");
  assert.ok(traps <= 10, `${traps} of ${own.length}`);
});
