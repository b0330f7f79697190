// Builds everything and serves the page. PORT sets the port; the default is 4173, or a free one if that is in use. HOST sets the network interface; by default
// only this machine sees the page.
import { build } from "./build.mjs";
import { addressOf, serve } from "./serve.mjs";

await build({ quick: true });
const wanted = process.env.PORT;
const open = (/** @type {number} */ port) =>
  serve(port, undefined, undefined, true);
const server = await open(Number(wanted ?? 4173)).catch((error) => {
  if (wanted || error.code !== "EADDRINUSE") throw error;
  return open(0);
});
console.log(`\nTouchpath is at ${addressOf(server)}`);
