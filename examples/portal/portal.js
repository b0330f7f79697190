// A portal with a list of jobs, one element to edit them and one to look at what comes of it. Programs are collected, and saved as one zip.
import "touchpath-element";
import { strToU8, zipSync } from "fflate";

/** The jobs of the order, by name; a portal would have them from its server. */
const jobs = new Map([
  [
    "POCKET",
    {
      format: 1,
      name: "POCKET",
      cycle: { type: "internal-rectangle-protected", width1: 80, width2: 50 },
    },
  ],
  [
    "BORE",
    {
      format: 1,
      name: "BORE",
      cycle: { type: "hole", diameter: 32 },
      control: { post: "fanuc", workOffset: 1 },
    },
  ],
  [
    "CORNER",
    {
      format: 1,
      name: "CORNER",
      cycle: { type: "double-wall-internal-corner" },
    },
  ],
]);
/** The programs that the user has saved, by file name. */
const programs = new Map();
let chosen = "";

const [edit, view] = document.querySelectorAll("touch-path");
const zip = document.querySelector("#zip");

function choose(name) {
  chosen = name;
  edit.job = jobs.get(name);
  view.job = jobs.get(name);
  for (const button of document.querySelectorAll("#jobs button"))
    button.ariaCurrent = String(button.textContent === name);
}

for (const name of jobs.keys()) {
  const button = document.createElement("button");
  button.textContent = name;
  button.addEventListener("click", () => choose(name));
  document
    .querySelector("#jobs")
    .appendChild(document.createElement("li"))
    .append(button);
}

edit.addEventListener("job-change", ({ detail: { job } }) => {
  jobs.set(chosen, job);
  view.job = job;
});

for (const element of [edit, view])
  element.addEventListener("program-save", (event) => {
    // The portal keeps the program itself: no file is handed out.
    event.preventDefault();
    programs.set(event.detail.name, event.detail.text);
    zip.disabled = false;
    document.querySelector("#state").textContent =
      `${programs.size} collected: ${[...programs.keys()].join(", ")}`;
  });

zip.addEventListener("click", () => {
  const files = Object.fromEntries(
    [...programs].map(([name, text]) => [name, strToU8(text)]),
  );
  const link = document.createElement("a");
  link.href = URL.createObjectURL(
    new Blob([zipSync(files)], { type: "application/zip" }),
  );
  link.download = "order-4711.zip";
  link.click();
  URL.revokeObjectURL(link.href);
});

choose("POCKET");
