import "./parts/app.js";
import { keepOffline } from "./offline.js";

keepOffline((take) =>
  document.querySelector("touchpath-app")?.dispatchEvent(new CustomEvent("update-ready", { detail: take })),
);
