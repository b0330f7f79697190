import type { TouchPath } from "./element.js";
import "./element.js";
import { beside } from "./in-worker.js";
import { keep, keepOffline } from "./offline.js";
import type { Asked, Task } from "./tasks.js";

const page = document.querySelector<TouchPath>("touch-path") as TouchPath;

/** Stores files for use without a network. */
function keepAll(): void {
  keepOffline((take) =>
    page.dispatchEvent(new CustomEvent("update-ready", { detail: take })),
  );
  // The page has loaded it already, unless the browser saves data.
  const { connection } = navigator as { connection?: { saveData?: boolean } };
  if (!connection?.saveData) keep("rest");
}
// Waits until the page is shown. A page that fails to load may be an old one.
page.ready.then(keepAll, keepAll);

const wanted = (event: Event) => (event as CustomEvent<string>).detail;
page.addEventListener("language", (event) => {
  document.documentElement.lang = wanted(event);
  keep(wanted(event));
});
page.addEventListener("load-editor", (event) => keep(wanted(event)));

// Reads and runs texts in a worker if they are long enough to block the page.
page.addEventListener("beside", (event) => {
  const { detail } = event as CustomEvent<Asked<Task>>;
  detail.answer = beside(detail.task, detail.signal);
});
