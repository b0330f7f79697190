import { readBeside } from "./read-in-worker.js";
import "./element.js";
import { keep, keepOffline } from "./offline.js";
import type { Unread } from "./parts/intake.js";

keepOffline((take) =>
  document.querySelector("touch-path")?.dispatchEvent(new CustomEvent("update-ready", { detail: take })),
);

const wanted = (event: Event) => (event as CustomEvent<string>).detail;
document.querySelector("touch-path")?.addEventListener("language", (event) => {
  document.documentElement.lang = wanted(event);
  keep(wanted(event));
});
document.querySelector("touch-path")?.addEventListener("wanted", (event) => keep(wanted(event)));

// Texts that are long enough to hold up the page are read in a worker.
document.querySelector("touch-path")?.addEventListener("read", (event) => {
  const { detail } = event as CustomEvent<Unread>;
  detail.reading = readBeside(detail.text, detail.signal);
});
