// The worker that reads and runs long texts: the page can be used meanwhile.
import { perform, type Task } from "./tasks.js";

addEventListener("message", ({ data }: MessageEvent<Task>) =>
  postMessage(perform(data)),
);
// What was sent before the module is there would be lost.
postMessage("ready");
