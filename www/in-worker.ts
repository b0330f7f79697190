// Reads and runs long texts in a worker.
import { script } from "./offline.js";
import address from "./reader.js?worker&url";
import type { Answer, Task } from "./tasks.js";

/** Runs a task in a worker. Fails without worker support, if the task throws, or if the signal aborts it. */
export function beside<T extends Task>(
  task: T,
  signal: AbortSignal,
): Promise<Answer<T>> {
  return new Promise((done, fail) => {
    const worker = new Worker(script(address), { type: "module" });
    // Does not wait for a worker that a slow network delays.
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
      // The page repeats the task itself, so the console needs no error.
      event.preventDefault();
      end(() => fail(new Error(event.message)));
    };
  });
}
