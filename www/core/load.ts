// Loads the module in a browser. The build of the page replaces this file by www/load-first.ts, which starts with a smaller module.
import type { Raw } from "./instance.js";
import init, * as raw from "./wasm/touchpath.js";

await init();

export { raw };

/** Answers until the module is loaded. This version needs no answers. */
export const prebuiltAnswers: Raw | null = null;

/** Arrival of the module; null once it is loaded. */
export const arrival: Promise<void> | null = null;

/** Loads missing parts of the module and returns whether any were missing. This version has no second part, so it returns false. */
export const completeNow = (): boolean => false;

/** Loads missing parts of the module. This version has no second part. */
export async function loadWhole(): Promise<void> {}
