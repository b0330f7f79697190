// The module in a browser. The page's own build has www/load-first.ts in this one's place: it begins with a smaller module, and is shown before that is
// there.
import type { Raw } from "./instance.js";
import init, * as raw from "./wasm/touchpath.js";

await init();

export { raw };

/** What answers until the module is there. */
export const prebuiltAnswers: Raw | null = null;

/** The arrival of the module; null once it is there. */
export const arrival: Promise<void> | null = null;

/** Brings what the module lacks, and says whether it lacked anything: nothing. */
export const completeNow = (): boolean => false;

/** Loads what the module lacks: nothing. */
export async function loadWhole(): Promise<void> {}
