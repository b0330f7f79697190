// Runs the module's functions that a first visit, all ENCY cycles and the edits of their forms use; each function reports itself.
import { readFileSync, writeFileSync } from "node:fs";
import { at } from "./lib.mjs";

const [, , path = "", out = ""] = process.argv;
const module = new WebAssembly.Module(readFileSync(path));
const MOST = 10_000;
const ran = new Uint8Array(MOST);
const { Instance } = WebAssembly;
WebAssembly.Instance = /** @type {any} */ (
  function counted(
    /** @type {WebAssembly.Module} */ own,
    /** @type {WebAssembly.Imports} */ imports,
  ) {
    const env = {
      hit: (/** @type {number} */ index) => {
        ran[index] = 1;
      },
    };
    return new Instance(own, { ...imports, env });
  }
);
const api = await import(at("dist", "init.js"));
api.init(module);

const SECTIONS = [
  "touches",
  "moves",
  "cycles",
  "relations",
  "datum",
  "program",
  "results",
  "triggers",
  "findings",
  "safety",
  "table",
];

/** Everything that the page requests for a job. */
function ask(/** @type {any} */ job) {
  const tries = [
    () => api.check(job),
    () => {
      const plan = api.plan(job);
      for (const section of SECTIONS) JSON.stringify(plan[section]);
    },
    () => api.misfit(job),
    () => api.jobName(job),
    () => api.meanings(job),
    () => api.proposedStock(job),
    () => api.moveColumns(job),
    () => api.convertUnits(job, "inch"),
  ];
  for (const attempt of tries)
    try {
      attempt();
    } catch {
      // Some jobs have errors on purpose.
    }
}

api.version();
const { cycles } = api.catalog();
for (const { type, number, fields } of cycles) {
  if (number === null) continue;
  const job = api.defaultJob(type);
  ask(job);
  for (const { key } of fields)
    for (const value of [1, -5, 0, 3.25, "a", null, [1, 2, 3]])
      ask({ ...job, cycle: { ...job.cycle, [key]: value } });
}
// Any cycle can be chosen and added beside another one.
for (const { type } of cycles) {
  const { cycle, ...rest } = api.defaultJob(type);
  const several = { ...rest, format: 2, cycles: [cycle, cycle] };
  for (const attempt of [() => api.jobName(several), () => api.misfit(several)])
    try {
      attempt();
    } catch {
      // Same as above.
    }
}
const [{ type }] = cycles;
const job = api.defaultJob(type);
ask(api.defaultJob(type, "inch"));
for (const section of ["stylus", "part", "probe", "machine", "limits", "feeds"])
  for (const value of [
    {},
    { offset: [0.1, 0.2, 0], rotation: 0.2 },
    { diameter: 4 },
  ])
    ask({
      ...job,
      [section]: { .../** @type {any} */ (job)[section], ...value },
    });
writeFileSync(out, ran);
