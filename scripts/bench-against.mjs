// Compares this build with versions 0.1.0 and 0.2.0 in one process and one browser, as ratios of the times that a user waits. Exits with 1 if a ratio exceeds
// its limit. Earlier versions are built once outside the repository: in TOUCHPATH_CACHE or the user's cache folder.
import { spawnSync } from "node:child_process";
import {
  existsSync,
  readdirSync,
  readFileSync,
  renameSync,
  rmSync,
} from "node:fs";
import { homedir } from "node:os";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { brotliCompressSync } from "node:zlib";
import { comparePages } from "./bench-page.mjs";
import { build } from "./build.mjs";
import { at, root, run } from "./lib.mjs";

/** The commits of the versions. */
const VERSIONS = /** @type {const} */ ({
  "0.1.0": "528981a",
  "0.2.0": "2140042",
});
/** @typedef {keyof typeof VERSIONS} Version */

/** Folder of a version's build, which is made if it is missing. */
function built(/** @type {Version} */ version) {
  const commit = VERSIONS[version];
  const cache =
    process.env.TOUCHPATH_CACHE ??
    join(process.env.XDG_CACHE_HOME ?? join(homedir(), ".cache"), "touchpath");
  const folder = join(cache, commit);
  if (existsSync(folder)) return folder;
  const work = `${folder}.building`;
  rmSync(work, { recursive: true, force: true });
  console.log(`Building ${version} once, into ${folder}`);
  run("git", ["clone", "--quiet", root, work]);
  run("git", ["checkout", "--quiet", commit], { cwd: work });
  run("node", ["scripts/build.mjs"], {
    cwd: work,
    env: { CARGO_TARGET_DIR: undefined },
    quiet: true,
  });
  rmSync(join(work, "target"), { recursive: true });
  renameSync(work, folder);
  return folder;
}

await build();
const folders = { "0.1.0": built("0.1.0"), "0.2.0": built("0.2.0"), now: root };
const load = (/** @type {string} */ folder) =>
  import(pathToFileURL(join(folder, "dist", "node.js")).href);
const packages = {
  "0.2.0": await load(folders["0.2.0"]),
  now: await load(root),
};

/** Rows: the measured time as a ratio to a version, with its limit. @type {{ what: string, to: Version | "", ratio: number, limit: number, unit: string }[]} */
const rows = [];
const add = (
  /** @type {string} */ what,
  /** @type {Version | ""} */ to,
  /** @type {number} */ ratio,
  /** @type {number} */ limit,
  unit = "",
) => rows.push({ what, to, ratio, limit, unit });

/** CPU time of this process, microseconds. */
const cpu = () => process.cpuUsage().user + process.cpuUsage().system;

/** Ratio of the times of two tasks, which run alternately; lower quartile of the rounds. */
function ratio(
  /** @type {() => unknown} */ work,
  /** @type {() => unknown} */ other,
  calls = 40,
) {
  const once = (/** @type {() => unknown} */ work) => {
    const start = cpu();
    for (let i = 0; i < calls; i++) work();
    return cpu() - start;
  };
  for (const each of [work, other, work, other]) once(each);
  const times = Array.from({ length: 21 }, () => [once(work), once(other)]);
  const quartile = (/** @type {number} */ k) =>
    times.map((pair) => pair[k] ?? 0).sort((a, b) => a - b)[5] ?? 0;
  return quartile(0) / quartile(1);
}

/** A job that both versions support. */
const job = (
  /** @type {string} */ type,
  /** @type {object} */ control = {},
) => ({
  format: 1,
  cycle: { type },
  control: { post: "linuxcnc", ...control },
  part: { offset: [0.3, -0.2, 0], rotation: 0.2 },
});
const [pocket, circles] = [
  job("internal-rectangle-protected"),
  { format: 1, cycle: { type: "probing-two-circles" } },
];
const { now, "0.2.0": before } = packages;
const both = (/** @type {(api: any) => () => unknown} */ work, calls = 40) =>
  ratio(work(now), work(before), calls);

add(
  "plan, pocket",
  "0.2.0",
  both((api) => () => api.plan(pocket)),
  1,
);
add(
  "plan, 1411",
  "0.2.0",
  both((api) => () => api.plan(circles)),
  1,
);
const types = before
  .catalog()
  .cycles.filter((/** @type {any} */ cycle) => (cycle.number ?? 0) > 1);
const full = types.map(
  (/** @type {any} */ { type }, /** @type {number} */ k) => {
    const whole = before.defaultJob(type);
    return {
      ...whole,
      control: { ...whole.control, post: k % 2 ? "sinumerik" : "linuxcnc" },
    };
  },
);
// Each version gets every value that it supports.
const own = full.map((/** @type {any} */ one) => {
  const whole = now.defaultJob(one.cycle.type);
  return { ...whole, control: { ...whole.control, post: one.control.post } };
});
add(
  "programs of full jobs",
  "0.2.0",
  ratio(
    () => own.map((/** @type {object} */ one) => now.program(one)),
    () => full.map((/** @type {object} */ one) => before.program(one)),
    6,
  ),
  0.8,
);
const triggers = now.plan(pocket).triggers ?? [];
add(
  "evaluate",
  "0.2.0",
  both((api) => () => api.evaluate(pocket, triggers)),
  0.9,
);
add(
  "svg",
  "0.2.0",
  both((api) => () => api.svg(pocket, "top")),
  0.9,
);
const texts = {
  now: now.plan(job("hole", { post: "sinumerik" })),
  before: before.plan(job("hole", { post: "sinumerik" })),
};
add(
  "import of a SINUMERIK program",
  "0.2.0",
  ratio(
    () => now.importJob(texts.now.program.text),
    () => before.importJob(texts.before.program.text),
  ),
  0.9,
);

/** Milliseconds from the start of a process to its first plan. */
function cold(/** @type {string} */ folder) {
  const url = JSON.stringify(
    pathToFileURL(join(folder, "dist", "node.js")).href,
  );
  const script = `const { plan } = await import(${url}); plan(${JSON.stringify(pocket)}); const { user, system } = process.cpuUsage(); console.log(user + system);`;
  return Number(
    spawnSync("node", ["--input-type=module", "-e", script], {
      encoding: "utf8",
    }).stdout,
  );
}
const starts = Array.from({ length: 9 }, () => [
  cold(root),
  cold(folders["0.2.0"]),
]);
const least = (/** @type {number} */ k) =>
  Math.min(...starts.map((pair) => pair[k] ?? Number.NaN));
add("import of the package and first plan", "0.2.0", least(0) / least(1), 0.9);

/** Brotli kB that a first visit loads before its first answer: the page, its requests and the module. */
function firstVisit() {
  const page = at("dist", "page");
  const html = readFileSync(join(page, "index.html"), "utf8");
  const asked = [...html.matchAll(/(?:href|src)="\.\/(assets\/[^"]+)"/g)].map(
    ([, name = ""]) => name,
  );
  const answers = readdirSync(join(page, "assets")).filter((name) =>
    name.startsWith("first-answers-"),
  );
  const files = new Set([
    "index.html",
    ...asked,
    ...answers.map((name) => `assets/${name}`),
  ]);
  return (
    [...files].reduce(
      (sum, name) =>
        sum + brotliCompressSync(readFileSync(join(page, name))).length,
      0,
    ) / 1000
  );
}
add("first visit until its answer, kB", "", firstVisit(), 370, "kB");

for (const [type, { key, hover }] of Object.entries(
  await comparePages(join(folders["0.1.0"], "dist", "page")),
)) {
  add(`key, ${type}`, "0.1.0", key, 0.7);
  add(`hover, ${type}`, "0.1.0", hover, 1);
}

console.log(
  "\nThis build / an earlier version                            limit",
);
for (const { what, to, ratio, limit, unit } of rows) {
  const name = to ? `${what} / ${to}` : what;
  const digits = unit ? 0 : 2;
  const over = ratio > limit ? "  above" : "";
  console.log(
    name.padEnd(50),
    ratio.toFixed(digits).padStart(7),
    limit.toFixed(digits).padStart(7) + over,
  );
}
const above = rows.filter(({ ratio, limit }) => !(ratio <= limit));
console.log(`\n${above.length} of ${rows.length} are above their limit`);
process.exit(above.length > 0 ? 1 : 0);
