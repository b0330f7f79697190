// Reads long texts in a worker.
import { script } from "./offline.js";
import type { Reading } from "./read-text.js";
import address from "./reader.js?worker&url";

/** Reads a text beside the page. Fails where there can be no worker, what it does breaks, or the signal aborts it. */
export function readBeside(
  text: string,
  signal: AbortSignal,
): Promise<Reading> {
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
    worker.onmessage = ({ data }: MessageEvent<"ready" | Reading>) => {
      if (data === "ready") {
        clearTimeout(late);
        worker.postMessage(text);
      } else end(() => done(data));
    };
    worker.onerror = (event) => {
      // It is read once more, by the page itself: nothing is lost that the console should say.
      event.preventDefault();
      end(() => fail(new Error(event.message)));
    };
  });
}
