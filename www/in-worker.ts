// Reads and runs long texts in a worker.
import { script } from "./offline.js";
import address from "./reader.js?worker&url";
import type { Answer, Task } from "./tasks.js";

/** Does a task beside the page. Fails where there can be no worker, what it does breaks, or the signal aborts it. */
export function beside<T extends Task>(
  task: T,
  signal: AbortSignal,
): Promise<Answer<T>> {
  return new Promise((done, fail) => {
    const worker = new Worker(script(address), { type: "module" });
    // One that does not come, over a slow network, is not waited for.
    const late = setTimeout(
      () => end(() => fail(new Error("the worker did not come"))),
      3000,
    );
    const abort = () => end(() => fail(signal.reason));
    const end = (settle: () => void) => {
      clearTimeout(late);
      signal.removeEventListener("abort", abort);
      worker.terminate();
      settle();
    };
    signal.addEventListener("abort", abort);
    worker.onmessage = ({ data }: MessageEvent<"ready" | Answer<T>>) => {
      if (data === "ready") {
        clearTimeout(late);
        worker.postMessage(task);
      } else end(() => done(data as Answer<T>));
    };
    worker.onerror = (event) => {
      // The page itself does it once more: nothing is lost that the console should say.
      event.preventDefault();
      end(() => fail(new Error(event.message)));
    };
  });
}
