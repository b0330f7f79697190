// Worker that reads and runs long texts while the page stays usable.
import { read } from "./read-text.js";
import { runText } from "./run-text.js";
import type { Task } from "./tasks.js";

addEventListener("message", ({ data }: MessageEvent<Task>) =>
  postMessage("read" in data ? read(data.read) : runText(data.run, data.known)),
);
// A message that is sent before the module is loaded would be lost.
postMessage("ready");
