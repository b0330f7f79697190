// The playground: what is set here is set on a live element, and written as code.
import { catalog } from "./touchpath/core/browser.js";
import "./touchpath/element/element.js";
import { code, FRAMEWORKS } from "./code.js";

const EVENTS = [
  "change",
  "job-change",
  "plan-change",
  "selection-change",
  "measured-change",
  "program-save",
  "finding",
  "load",
  "error",
];
/** So many events are listed. */
const LISTED = 40;

/** Configs to begin with. */
const EXAMPLES = {
  "One hall: two cycles, two controls": {
    format: 1,
    title: "Hall 3",
    allow: {
      cycles: ["hole", "web"],
      controls: ["haas", "fanuc"],
      units: ["mm"],
      setUps: false,
    },
  },
  "A fixed feed, a hidden field": {
    format: 1,
    fields: {
      "feeds.work": {
        value: 100,
        locked: true,
        reason: "the probe was calibrated at it",
      },
      "stylus.runout": { hidden: true },
    },
  },
  "No results, no checks": {
    format: 1,
    hide: { panels: ["results", "checks"] },
  },
};

const at = (selector) => document.querySelector(selector);
const [form, config, stage, list] = [
  "#attributes",
  "#config",
  "#stage",
  "#events ol",
].map(at);
let element;
let framework = FRAMEWORKS[0];

/** What is set: attributes, the config as it was last good, and whether the panels stand apart. */
const set = { attributes: {}, config: null, apart: false };

function listEvent({ type, detail, message }) {
  const line = document.createElement("li");
  const name = document.createElement("b");
  name.textContent = type;
  const said = JSON.stringify(detail) ?? message ?? "";
  line.append(name, ` ${said.slice(0, 200)}`);
  line.title = said.slice(0, 2000);
  list.prepend(line);
  while (list.children.length > LISTED) list.lastChild.remove();
}

/** Puts an element into the page; its panels apart, where that is asked for. */
function put() {
  element = document.createElement("touch-path");
  element.id = "job";
  for (const type of EVENTS) element.addEventListener(type, listEvent);
  element.hidden = set.apart;
  const parts = set.apart
    ? ["touch-form", "touch-picture", "touch-program"].map((tag) =>
        document.createElement(tag),
      )
    : [];
  for (const part of parts) part.session = element;
  stage.classList.toggle("apart", set.apart);
  stage.replaceChildren(element, ...parts);
}

/** Sets on the element what the form says; what it leaves out is as it was before it was ever set. */
function apply() {
  const wanted = set.apart
    ? { ...set.attributes, panels: "none" }
    : set.attributes;
  for (const { name } of form.elements) {
    if (name === "" || name === "apart") continue;
    const given = wanted[name];
    if (given === undefined) element.removeAttribute(name);
    else element.setAttribute(name, given === true ? "" : given);
  }
  element.config = set.config;
  at("#code pre").textContent = code(framework, set);
}

function read() {
  const data = new FormData(form);
  const panels = data.getAll("panels").join(" ");
  const texts = ["cycle", "post", "units", "mode", "view", "theme", "lang"].map(
    (name) => [name, data.get(name)],
  );
  set.attributes = Object.fromEntries(
    [...texts, ["panels", panels]].filter(([, given]) => given),
  );
  if (data.has("readonly")) set.attributes.readonly = true;
  const { apart } = set;
  set.apart = data.has("apart");
  if (set.apart !== apart) {
    const { job } = element;
    put();
    if (job) element.job = job;
  }
  apply();
}

/** Takes the config as it is typed. One that cannot be used changes nothing, and why is said below it. */
function readConfig() {
  const text = config.value.trim();
  let why = "";
  const refuse = ({ detail }) => {
    if (detail.refused)
      why = detail.findings.map(({ message }) => message).join(" ");
  };
  element.addEventListener("finding", refuse);
  try {
    const given = text === "" ? null : JSON.parse(text);
    element.config = given;
    if (why === "") set.config = given;
  } catch (thrown) {
    why = thrown.message;
  }
  element.removeEventListener("finding", refuse);
  at("#refused").textContent = why;
  apply();
}

function fill() {
  const { cycles, posts } = catalog();
  const option = (text, value = text) => new Option(text, value);
  at("[name=cycle]").append(
    option(""),
    ...cycles.map(({ title, type }) => option(title, type)),
  );
  at("[name=post]").append(
    option(""),
    ...posts.map(({ title, id }) => option(title, id)),
  );
  at("#examples").append(...Object.keys(EXAMPLES).map((name) => option(name)));
  const tabs = FRAMEWORKS.map((name, index) => {
    const tab = Object.assign(document.createElement("button"), {
      type: "button",
      role: "tab",
      textContent: name,
    });
    tab.tabIndex = index === 0 ? 0 : -1;
    tab.ariaSelected = String(index === 0);
    const choose = () => {
      framework = name;
      for (const other of tabs)
        [other.ariaSelected, other.tabIndex] = [
          String(other === tab),
          other === tab ? 0 : -1,
        ];
      tab.focus();
      apply();
    };
    tab.addEventListener("click", choose);
    tab.addEventListener("keydown", ({ key }) => {
      const step = { ArrowRight: 1, ArrowLeft: -1 }[key];
      if (step) tabs[(index + step + tabs.length) % tabs.length].click();
    });
    return tab;
  });
  at("[role=tablist]").append(...tabs);
}

fill();
put();
form.addEventListener("change", read);
config.addEventListener("input", readConfig);
at("#examples").addEventListener("change", ({ target }) => {
  config.value = target.value
    ? JSON.stringify(EXAMPLES[target.value], null, 2)
    : "";
  readConfig();
});
at("#copy").addEventListener("click", () =>
  navigator.clipboard.writeText(code(framework, set)),
);
read();
