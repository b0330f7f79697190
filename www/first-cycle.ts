/** What a first visit begins with; vite.config.mjs keeps the answers of the module for it. */
export const FIRST_CYCLE = "hole";
