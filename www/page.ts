import "./element.js";
import { keepOffline } from "./offline.js";

keepOffline((take) =>
  document.querySelector("touch-path")?.dispatchEvent(new CustomEvent("update-ready", { detail: take })),
);
