// The worker that reads and runs long texts: the page can be used meanwhile.
import { read } from "./read-text.js";
import { runText } from "./run-text.js";
import type { Task } from "./tasks.js";

addEventListener("message", ({ data }: MessageEvent<Task>) =>
  postMessage("read" in data ? read(data.read) : runText(data.run, data.known)),
);
// What was sent before the module is there would be lost.
postMessage("ready");
