import type { TouchPath } from "./element.js";
import "./element.js";
import { beside } from "./in-worker.js";
import { keep, keepOffline } from "./offline.js";
import type { Asked, Task } from "./tasks.js";

const page = document.querySelector<TouchPath>("touch-path") as TouchPath;

/** What is kept for when there is no network. */
function keepAll(): void {
  keepOffline((take) =>
    page.dispatchEvent(new CustomEvent("update-ready", { detail: take })),
  );
  // The page has loaded it already, unless the browser is to save data.
  const { connection } = navigator as { connection?: { saveData?: boolean } };
  if (!connection?.saveData) keep("rest");
}
// Not before what is shown; a page that could not be shown may be an old one.
page.ready.then(keepAll, keepAll);

const wanted = (event: Event) => (event as CustomEvent<string>).detail;
page.addEventListener("language", (event) => {
  document.documentElement.lang = wanted(event);
  keep(wanted(event));
});
page.addEventListener("load-editor", (event) => keep(wanted(event)));

// Texts that are long enough to hold up the page are read and run in a worker.
page.addEventListener("beside", (event) => {
  const { detail } = event as CustomEvent<Asked<Task>>;
  detail.answer = beside(detail.task, detail.signal);
});
