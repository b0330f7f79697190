import type { TouchPath } from "./element.js";
import { readBeside } from "./read-in-worker.js";
import "./element.js";
import { keep, keepOffline } from "./offline.js";
import type { Unread } from "./parts/intake.js";

/** Milliseconds after which a visitor looks at the page, and nothing is loaded any more. */
const IDLE = 4000;

const page = document.querySelector<TouchPath>("touch-path") as TouchPath;

/** What is kept for when there is no network. */
function keepAll(): void {
  keepOffline((take) =>
    page.dispatchEvent(new CustomEvent("update-ready", { detail: take })),
  );
  // What reads texts, and LENTOAX, once nothing else is loaded.
  const { connection } = navigator as { connection?: { saveData?: boolean } };
  if (!connection?.saveData) setTimeout(() => keep("touchpath_bg"), IDLE);
}
// Not before what is shown; a page that could not be shown may be an old one.
page.ready.then(keepAll, keepAll);

const wanted = (event: Event) => (event as CustomEvent<string>).detail;
page.addEventListener("language", (event) => {
  document.documentElement.lang = wanted(event);
  keep(wanted(event));
});
page.addEventListener("wanted", (event) => keep(wanted(event)));

// Texts that are long enough to hold up the page are read in a worker.
page.addEventListener("read", (event) => {
  const { detail } = event as CustomEvent<Unread>;
  detail.reading = readBeside(detail.text, detail.signal);
});
