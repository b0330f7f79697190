import "./element.js";
import { keepOffline, keepWords } from "./offline.js";

keepOffline((take) =>
  document.querySelector("touch-path")?.dispatchEvent(new CustomEvent("update-ready", { detail: take })),
);

document.querySelector("touch-path")?.addEventListener("language", (event) => {
  const { detail } = event as CustomEvent<string>;
  document.documentElement.lang = detail;
  keepWords(detail);
});
