// The worker that reads a long text: the page can be used meanwhile.
import { read } from "./read-text.js";

addEventListener("message", ({ data }: MessageEvent<string>) =>
  postMessage(read(data)),
);
// What was sent before the module is there would be lost.
postMessage("ready");
