import "./element.js";
import { keep, keepOffline } from "./offline.js";

keepOffline((take) =>
  document.querySelector("touch-path")?.dispatchEvent(new CustomEvent("update-ready", { detail: take })),
);

const wanted = (event: Event) => (event as CustomEvent<string>).detail;
document.querySelector("touch-path")?.addEventListener("language", (event) => {
  document.documentElement.lang = wanted(event);
  keep(wanted(event));
});
document.querySelector("touch-path")?.addEventListener("wanted", (event) => keep(wanted(event)));
