/** Cycle of a first visit. vite.config.mjs builds the answers for this cycle into the page. */
export const FIRST_CYCLE = "hole";
