// Form edit to whole plan: natively and in WebAssembly, few touches and many, nominal part and another; and the wasm's size.
// Times are medians; what counts are the ratios, all of one run on one machine.
import { readFileSync } from "node:fs";
import { brotliCompressSync, gzipSync } from "node:zlib";
import { build } from "./build.mjs";
import { at, run } from "./lib.mjs";

await build();
const { catalog, check, importJob, lentoax, moveColumns, plan } = await import("touchpath");

const corner = (/** @type {number} */ count1, /** @type {number} */ count2, part = false) => ({
  format: 1,
  cycle: { type: "double-wall-internal-corner", count1, count2, step1: 7, step2: 6 },
  ...(part ? { part: { offset: [0.3, -0.2, 0], rotation: 0.2, sizes: { angle: 0.1 } } } : {}),
});
/** @type {Record<string, any>} */
const jobs = {
  "type 7, 4 touches": { format: 1, cycle: { type: "internal-rectangle-protected" } },
  "type 7, 4 touches, part": {
    format: 1,
    cycle: { type: "internal-rectangle-protected" },
    part: { offset: [0.3, -0.2, 0], rotation: 0.2, sizes: { width1: 0.1 } },
  },
  "type 13, 4 touches": corner(2, 2),
  "type 13, 16 touches": corner(8, 8),
  "type 13, 16 touches, part": corner(8, 8, true),
  "type 7, SINUMERIK": {
    format: 1,
    cycle: { type: "internal-rectangle-protected" },
    control: { post: "sinumerik", workOffset: 1 },
  },
  "1411, SINUMERIK": {
    format: 1,
    cycle: { type: "probing-two-circles", probePoints: 8 },
    control: { post: "sinumerik" },
  },
};

/** Median microseconds of a call. */
function time(/** @type {() => unknown} */ work) {
  for (let i = 0; i < 300; i++) work();
  const rounds = Array.from({ length: 21 }, () => {
    const start = performance.now();
    for (let i = 0; i < 100; i++) work();
    return ((performance.now() - start) / 100) * 1000;
  });
  return rounds.sort((a, b) => a - b)[10] ?? Number.NaN;
}

const args = Object.entries(jobs).map(([name, job]) => `${name}=${JSON.stringify(job)}`);
const native = new Map(
  run("cargo", ["bench", "--quiet", "--locked", "--bench", "plan", "--", ...args], { quiet: true })
    .trim()
    .split("\n")
    .flatMap((line) => {
      const [, name, , ns] = line.match(/^(.*) (\d+) (\d+)$/) ?? [];
      return name ? [/** @type {[string, number]} */ ([name, Number(ns) / 1000])] : [];
    }),
);

console.log(
  "\nReading a program back and proving it, natively: by the time of printing it (under 2), rules by the same",
);
for (const name of Object.keys(jobs)) {
  const [print, prove, rules] = ["print", "prove", "rules"].map(
    (stage) => native.get(`  ${stage}: ${name}`) ?? Number.NaN,
  );
  if (print && prove && rules)
    console.log(`${name.padEnd(26)} ${(prove / print).toFixed(2)}   ${(rules / print).toFixed(2)}`);
}

console.log("\nForm edit to whole plan, median, µs");
console.log("job                         native     wasm   wasm / native   wasm check   wasm columns");
/** @type {Map<string, number>} */
const wasm = new Map();
const timeOf = (/** @type {Map<string, number>} */ times, /** @type {string} */ name) => times.get(name) ?? Number.NaN;
for (const [name, job] of Object.entries(jobs)) {
  wasm.set(
    name,
    time(() => plan(job)),
  );
  const cells = [
    timeOf(native, name).toFixed(1).padStart(8),
    timeOf(wasm, name).toFixed(1).padStart(8),
    (timeOf(wasm, name) / timeOf(native, name)).toFixed(2).padStart(12),
    time(() => check(job))
      .toFixed(1)
      .padStart(13),
    time(() => moveColumns(job))
      .toFixed(1)
      .padStart(13),
  ];
  console.log(name.padEnd(26), ...cells);
}

console.log("\nRatios                                          native     wasm");
const ratio = (/** @type {string} */ label, /** @type {string} */ a, /** @type {string} */ b) => {
  const of = (/** @type {Map<string, number>} */ times) => (timeOf(times, a) / timeOf(times, b)).toFixed(2).padStart(8);
  console.log(label.padEnd(45), of(native), of(wasm));
};
ratio("16 touches / 4 touches (type 13)", "type 13, 16 touches", "type 13, 4 touches");
ratio("with part / without, 16 touches (goal: < 2)", "type 13, 16 touches, part", "type 13, 16 touches");
ratio("with part / without, 4 touches (type 7)", "type 7, 4 touches, part", "type 7, 4 touches");

// Every type of the family against its number of touches, in WebAssembly. A corner needs two, one a wall.
const counted = (/** @type {import("touchpath").CycleEntry} */ cycle, /** @type {number} */ n) => {
  const keys = cycle.fields.map((field) => field.key);
  if (keys.includes("stepCount")) return { variant: 1, stepCount: n, angularStep: 360 / Math.max(n, 3) };
  if (keys.includes("count1"))
    return n < 2 ? null : { count1: Math.ceil(n / 2), count2: Math.floor(n / 2), step1: 3, step2: 3 };
  return undefined;
};
const steps = [1, 2, 3, 4, 6, 8, 10, 12, 14, 16];
console.log("\nPlan time against touches in WebAssembly, median, µs (16 / 4 touches where a type has both)");
console.log("type".padEnd(36), ...steps.map((n) => String(n).padStart(7)), "  16 / 4");
for (const cycle of catalog()
  .cycles.filter((c) => c.number !== null)
  .sort((a, b) => (a.number ?? 0) - (b.number ?? 0))) {
  const times = steps.map((n) => {
    const extra = counted(cycle, n);
    if (extra === null) return null;
    /** @type {any} */
    const job = { format: 1, cycle: { type: cycle.type, ...extra } };
    const touches = plan(job).touches.length;
    return touches === n ? time(() => plan(job)) : null;
  });
  /** @type {any} */
  const none = { format: 1, cycle: { type: cycle.type } };
  if (plan(none).touches.length === 0) times[0] = time(() => plan(none));
  const [four, sixteen] = [times[3], times[9]];
  const ratio = four && sixteen ? (sixteen / four).toFixed(2) : "";
  console.log(
    `${cycle.number} ${cycle.title}`.padEnd(36),
    ...times.map((t) => (t?.toFixed(0) ?? "").padStart(7)),
    ratio.padStart(8),
  );
}

console.log("\nOthers in WebAssembly, median, µs");
const program = plan(jobs["type 7, SINUMERIK"]).program.text;
const dump = plan(jobs["type 7, 4 touches"])
  .table.map((row) => `${row.code} = ${row.value}`)
  .join("\n");
const others = {
  "LENTOAX, ROT Z60": () => lentoax({ frame: [{ rot: "Z", angle: 60 }] }),
  "dump of type 7 to job": () => importJob(dump),
  "SINUMERIK program to job": () => importJob(program),
};
for (const [name, work] of Object.entries(others)) console.log(name.padEnd(36), time(work).toFixed(1).padStart(8));

const bytes = readFileSync(at("dist", "wasm", "touchpath_bg.wasm"));
const sizes = {
  raw: bytes.length,
  gzip: gzipSync(bytes, { level: 9 }).length,
  brotli: brotliCompressSync(bytes).length,
};
console.log("\nBytes of the wasm");
for (const [name, size] of Object.entries(sizes)) {
  console.log(name.padEnd(8), String(size).padStart(8), `${((100 * size) / sizes.raw).toFixed(0)} %`.padStart(6));
}
