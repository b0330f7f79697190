/** Cycle of a first visit. vite.config.mjs reads it here and builds the answers for it into the page. */
export const FIRST_CYCLE = "hole";
