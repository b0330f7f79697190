// From a form edit to the whole plan: natively and in WebAssembly, with few touches and many, on the nominal and another part; also the size of the module.
// WebAssembly times are CPU times of the process, lower quartiles; native times are wall times. Only ratios within one run count.
import {
  mkdtempSync,
  readdirSync,
  readFileSync,
  rmSync,
  writeFileSync,
} from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { brotliCompressSync, gzipSync } from "node:zlib";
import { build } from "./build.mjs";
import { rooms } from "./functions.mjs";
import { at, run, works } from "./lib.mjs";

await build();
const {
  catalog,
  check,
  defaultJob,
  importJob,
  lentoax,
  plan,
  program,
  programs,
  readProgram,
} = await import("touchpath");

const corner = (
  /** @type {number} */ count1,
  /** @type {number} */ count2,
  part = false,
) => ({
  format: 1,
  cycle: {
    type: "double-wall-internal-corner",
    count1,
    count2,
    step1: 7,
    step2: 6,
  },
  ...(part
    ? { part: { offset: [0.3, -0.2, 0], rotation: 0.2, sizes: { angle: 0.1 } } }
    : {}),
});
/** This many bores in one program, in rows of ten. */
const bores = (/** @type {number} */ count) => ({
  format: 2,
  control: { post: "linuxcnc", workOffset: 1 },
  part: { offset: [0.2, -0.1, 0.05], rotation: 0.1 },
  cycles: Array.from({ length: count }, (_, i) => ({
    type: "hole",
    diameter: 20 + (i % 5),
    origin: [60 * (i % 10), 60 * Math.floor(i / 10), 0],
  })),
});
/** @type {Record<string, any>} */
const jobs = {
  "type 7, 4 touches": {
    format: 1,
    cycle: { type: "internal-rectangle-protected" },
  },
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
  "a set-up of 1 bore": bores(1),
  "a set-up of 10 bores": bores(10),
  "a set-up of 50 bores": bores(50),
};

/** CPU time of this process, microseconds: other load hardly matters. */
const cpu = () => {
  const { user, system } = process.cpuUsage();
  return user + system;
};

/** Microseconds per call of each task, lower quartile of 21 rounds. The tasks alternate, so a slow phase of the machine affects all. */
function times(/** @type {(() => unknown)[]} */ works, calls = 100) {
  for (const work of works) for (let i = 0; i < 3 * calls; i++) work();
  /** @type {number[][]} */
  const rounds = works.map(() => []);
  for (let round = 0; round < 21; round++)
    works.forEach((work, k) => {
      const start = cpu();
      for (let i = 0; i < calls; i++) work();
      rounds[k]?.push((cpu() - start) / calls);
    });
  return rounds.map((own) => own.sort((a, b) => a - b)[5] ?? Number.NaN);
}

const time = (/** @type {() => unknown} */ work, calls = 100) =>
  times([work], calls)[0] ?? Number.NaN;

const args = Object.entries(jobs).map(
  ([name, job]) => `${name}=${JSON.stringify(job)}`,
);
const native = new Map(
  run(
    "cargo",
    ["bench", "--quiet", "--locked", "--bench", "plan", "--", ...args],
    { quiet: true },
  )
    .trim()
    .split("\n")
    .flatMap((line) => {
      const [, name, , ns] = line.match(/^(.*) (\d+) (\d+)$/) ?? [];
      return name
        ? [/** @type {[string, number]} */ ([name, Number(ns) / 1000])]
        : [];
    }),
);

/**
 * Cost of reading back and proving, in instructions, which do not depend on the machine's load. Warm: the same program was read before, as after an edit.
 * Series: other sizes every time, so some lines are new. Cold: the first program of a process.
 */
function countInstructions() {
  console.log(
    "\nInstructions of reading a program back, for each of its bytes (goal: 35), and proof and rules / printing (goal: 1.6)",
  );
  if (!works("valgrind")) {
    console.log("valgrind is not installed: not counted");
    return;
  }
  const messages = run(
    "cargo",
    [
      "bench",
      "--quiet",
      "--locked",
      "--bench",
      "plan",
      "--no-run",
      "--message-format=json",
    ],
    {
      quiet: true,
    },
  );
  const built = messages
    .split("\n")
    .filter((line) => line.includes('"executable":"'));
  const bench = JSON.parse(built.at(-1) ?? "{}").executable;
  const count = (
    /** @type {string} */ stage,
    /** @type {any[]} */ counted,
    warm = 0,
    skip = 0,
  ) => {
    const tool = [
      "--tool=callgrind",
      "--toggle-collect=*counted*",
      "--callgrind-out-file=/dev/null",
      "--log-fd=1",
      bench,
    ];
    const options = [`--count=${stage}`, `--warm=${warm}`, `--skip=${skip}`];
    const said = run(
      "valgrind",
      [...tool, ...options, ...counted.map((job) => JSON.stringify(job))],
      { quiet: true },
    );
    const [, instructions] = said.match(/Collected : (\d+)/) ?? [];
    const [, length] = said.match(/^(\d+)$/m) ?? [];
    return { instructions: Number(instructions), length: Number(length) };
  };
  const kinds = {
    "a rectangle": (/** @type {string} */ post, vary = 0) => ({
      format: 1,
      cycle: {
        type: "internal-rectangle-protected",
        ...(vary && {
          width1: 60 + 7.313 * vary,
          width2: 90 - 1.171 * vary,
          origin: [3.137 * vary, -1.093 * vary, 0],
        }),
      },
      control: { post, workOffset: 1 },
    }),
    "16 touches": (/** @type {string} */ post, vary = 0) => ({
      ...corner(8, 8),
      cycle: {
        ...corner(8, 8).cycle,
        ...(vary && {
          step1: 7 - 0.137 * vary,
          origin: [3.137 * vary, -1.093 * vary, 0],
        }),
      },
      control: { post },
    }),
    "type 1411": (/** @type {string} */ post, vary = 0) => ({
      format: 1,
      cycle: {
        type: "probing-two-circles",
        probePoints: 8,
        ...(vary && { startingAngle: 1.37 * vary }),
      },
      control: { post },
    }),
  };
  console.log(
    "0.2.0 had 74 a byte, and 2.3 to 3.9 by printing (goals: 35 and 1.6)",
  );
  console.log(
    "control, job                  warm   series     cold   proof and rules / printing: warm   series",
  );
  for (const post of ["linuxcnc", "sinumerik", "fanuc", "haas"])
    for (const [name, job] of Object.entries(kinds)) {
      const series = Array.from({ length: 16 }, (_, i) => job(post, i + 1));
      const runs = /** @type {[any[], number, number][]} */ ([
        [[job(post)], 3, 0],
        [series, 0, 8],
      ]);
      const perByte = [
        ...runs,
        /** @type {[any[], number, number]} */ ([[job(post)], 0, 0]),
      ].map(([counted, warm, skip]) => {
        const { instructions, length } = count("read", counted, warm, skip);
        return instructions / length;
      });
      const ratios = runs.map(([counted, warm, skip]) => {
        const [print = 1, prove = 0, rules = 0] = [
          "print",
          "prove",
          "rules",
        ].map((stage) => count(stage, counted, warm, skip).instructions);
        return (prove + rules) / print;
      });
      console.log(
        `${post}, ${name}`.padEnd(25),
        ...perByte.map((each) => each.toFixed(1).padStart(8)),
        ...ratios.map((ratio) => ratio.toFixed(2).padStart(20)),
      );
    }
}

console.log(
  "\nReading a program back and proving it, natively: by the time of printing it; rules by the same",
);
for (const name of Object.keys(jobs)) {
  const [print, prove, rules] = ["print", "prove", "rules"].map(
    (stage) => native.get(`  ${stage}: ${name}`) ?? Number.NaN,
  );
  if (print && prove && rules)
    console.log(
      `${name.padEnd(26)} ${(prove / print).toFixed(2)}   ${(rules / print).toFixed(2)}`,
    );
}

countInstructions();

console.log("\nPrinting a program, natively, MB/s (goal: 250)");
for (const [name, job] of Object.entries(jobs)) {
  const print = native.get(`  print: ${name}`);
  if (print)
    console.log(
      name.padEnd(26),
      (plan(job).program.text.length / print).toFixed(0).padStart(6),
    );
}

console.log(
  "\nForm edit to whole plan, µs. `plan` has all but what is read: sections and table are made then. Natively it is the same",
);
console.log(
  "job                         native     wasm   wasm / native   sections read   table too   program   check   (goals of the ratio: 1.3, full jobs 1.5)",
);
/** @type {Map<string, number>} */
const wasm = new Map();
const timeOf = (
  /** @type {Map<string, number>} */ times,
  /** @type {string} */ name,
) => times.get(name) ?? Number.NaN;
for (const [name, job] of Object.entries(jobs)) {
  const read = (/** @type {import("touchpath").Plan} */ p) => [
    p.touches,
    p.moves,
    p.program,
    p.results,
    p.safety,
  ];
  const [whole = Number.NaN, ...others] = times([
    () => plan(job),
    () => read(plan(job)),
    () => ({ ...plan(job) }),
    () => program(job),
    () => check(job),
  ]);
  wasm.set(name, whole);
  const cells = [
    timeOf(native, `  plan: ${name}`).toFixed(1).padStart(8),
    timeOf(wasm, name).toFixed(1).padStart(8),
    (timeOf(wasm, name) / timeOf(native, `  plan: ${name}`))
      .toFixed(2)
      .padStart(12),
    ...others.map((micros) => micros.toFixed(1).padStart(12)),
  ];
  console.log(name.padEnd(26), ...cells);
}

// Cost that a command or server pays once: everything is new.
const first = `const start = performance.now(); const { plan } = await import(${JSON.stringify(pathToFileURL(at("dist", "node.js")).href)});
  const loaded = performance.now(); plan(JSON.parse(process.argv[1])); console.log(loaded - start, performance.now() - loaded);`;
console.log(
  "\nThe first plan of a process, ms: the module loaded, the plan; the same plan when warm",
);
for (const name of ["type 7, 4 touches", "type 13, 16 touches"]) {
  const runs = Array.from({ length: 5 }, () =>
    run(
      "node",
      ["--input-type=module", "-e", first, JSON.stringify(jobs[name])],
      { quiet: true },
    )
      .trim()
      .split(" ")
      .map(Number),
  );
  const cells = [0, 1].map((k) =>
    Math.min(...runs.map((one) => one[k] ?? Number.NaN)).toFixed(1),
  );
  console.log(
    name.padEnd(26),
    ...[...cells, (timeOf(wasm, name) / 1000).toFixed(2)].map((cell) =>
      cell.padStart(8),
    ),
  );
}

console.log(
  "\nRatios                                          native     wasm",
);
const ratio = (
  /** @type {string} */ label,
  /** @type {string} */ a,
  /** @type {string} */ b,
) => {
  const of = (/** @type {Map<string, number>} */ times) =>
    (timeOf(times, a) / timeOf(times, b)).toFixed(2).padStart(8);
  console.log(label.padEnd(45), of(native), of(wasm));
};
ratio(
  "16 touches / 4 touches (type 13)",
  "type 13, 16 touches",
  "type 13, 4 touches",
);
ratio(
  "with part / without, 16 touches (goal: < 2)",
  "type 13, 16 touches, part",
  "type 13, 16 touches",
);
ratio(
  "10 bores / 1 bore (goal: at most 10)",
  "a set-up of 10 bores",
  "a set-up of 1 bore",
);
ratio("50 bores / 1 bore", "a set-up of 50 bores", "a set-up of 1 bore");
ratio(
  "with part / without, 4 touches (type 7)",
  "type 7, 4 touches, part",
  "type 7, 4 touches",
);

// Calls of native cycles: calls and their path, a run on the displaced part, the program. The same job as moves of LinuxCNC is 1.
console.log(
  "\nOwn cycles, plan / plan of LinuxCNC's moves, wasm   type 7   hole   web",
);
const called = ["internal-rectangle-protected", "hole", "web"];
const placed = (
  /** @type {string} */ type,
  /** @type {string} */ post,
  /** @type {"moves" | "cycle"} */ form,
) =>
  /** @type {any} */ ({
    format: 1,
    cycle: { type },
    part: { offset: [0.3, -0.2, 0] },
    control: { post, form },
  });
for (const { id, cycles } of catalog().posts) {
  const served = (/** @type {string} */ type) =>
    cycles.some(
      (entry) =>
        entry.type === type && entry.form === "cycle" && entry.supported,
    );
  if (!called.every(served)) continue;
  const cells = called.map((type) => {
    const [own = Number.NaN, moves = Number.NaN] = times([
      () => plan(placed(type, id, "cycle")),
      () => plan(placed(type, "linuxcnc", "moves")),
    ]);
    return (own / moves).toFixed(2).padStart(8);
  });
  console.log(id.padEnd(50), ...cells);
}

// Every type of the family by its number of touches, in WebAssembly. A corner needs two, one per wall.
const counted = (
  /** @type {import("touchpath").CycleEntry} */ cycle,
  /** @type {number} */ n,
) => {
  const keys = cycle.fields.map((field) => field.key);
  if (keys.includes("stepCount"))
    return { variant: 1, stepCount: n, angularStep: 360 / Math.max(n, 3) };
  if (keys.includes("count1"))
    return n < 2
      ? null
      : {
          count1: Math.ceil(n / 2),
          count2: Math.floor(n / 2),
          step1: 3,
          step2: 3,
        };
  return undefined;
};
const steps = [1, 2, 3, 4, 6, 8, 10, 12, 14, 16];
console.log(
  "\nPlan time against touches in WebAssembly, µs (16 / 4 touches where a type has both)",
);
console.log(
  "type".padEnd(36),
  ...steps.map((n) => String(n).padStart(7)),
  "  16 / 4",
);
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

console.log("\nOthers in WebAssembly, µs");
const sinumerik = plan(jobs["type 7, SINUMERIK"]).program.text;
const dump = plan(jobs["type 7, 4 touches"])
  .table.map((row) => `${row.code} = ${row.value}`)
  .join("\n");
const others = {
  "LENTOAX, ROT Z60": () => lentoax({ frame: [{ rot: "Z", angle: 60 }] }),
  "dump of type 7 to job": () => importJob(dump),
  "SINUMERIK program to job": () => importJob(sinumerik),
};
for (const [name, work] of Object.entries(others))
  console.log(name.padEnd(36), time(work).toFixed(1).padStart(8));

// Many jobs, each with every value, alternately for LinuxCNC and SINUMERIK: the load of a server.
const kinds = catalog().cycles.filter((c) => (c.number ?? 0) > 1);
const full = kinds.map(({ type }, i) => ({
  ...defaultJob(type),
  control: {
    ...defaultJob(type).control,
    post:
      i % 2
        ? /** @type {const} */ ("sinumerik")
        : /** @type {const} */ ("linuxcnc"),
  },
}));
function* many(/** @type {number} */ count) {
  for (let i = 0; i < count; i++)
    yield/** @type {any} */ (full[i % full.length]);
}
console.log(
  "\nJobs to programs, one core: jobs a second (goal: 15,000), MB/s of program, memory in MB",
);
for (const made of programs(many(2000)))
  if (!made.program) throw new Error(JSON.stringify(made.findings));
let [done, text, start] = [0, 0, cpu()];
for (const made of programs(many(200_000))) {
  text += made.program?.text.length ?? 0;
  if (++done % 40_000 === 0) {
    const seconds = (cpu() - start) / 1e6;
    const memory = process.memoryUsage().rss / 1e6;
    console.log(
      String(done).padStart(8),
      (40_000 / seconds).toFixed(0).padStart(8),
      (text / seconds / 1e6).toFixed(1).padStart(8),
      memory.toFixed(0).padStart(6),
    );
    [text, start] = [0, cpu()];
  }
}

// Reading programs of any hand, beside what browsers use today. Their probe moves are counted, too.
// Neither says its types.
// @ts-expect-error
const { default: GcodeToolpath } = await import("gcode-toolpath");
// @ts-expect-error
const { parseStringSync } = await import("gcode-parser");
const foreign = (/** @type {number} */ lines) => {
  const body = Array.from({ length: lines }, (_, i) =>
    i % 10 === 9
      ? `G38.2 Z-${(i % 7) + 1} F100`
      : `G1 X${((i * 37) % 1000) / 8} Y${((i * 53) % 900) / 8} Z${(i % 40) / 4} F800`,
  );
  return `G21 G90\nG0 X0 Y0 Z5\n${body.join("\n")}\nM2\n`;
};
console.log(
  "\nA program of so many lines to its moves, µs, and by how much this is faster (goal: 40)",
);
console.log(
  "lines        touchpath   gcode-toolpath   gcode-parser   faster than the first   probe moves: here, there",
);
for (const lines of [50, 1000, 10_000, 100_000]) {
  const text = foreign(lines);
  const calls = Math.max(1, Math.round(20_000 / lines));
  let straight = 0;
  const theirs = () => {
    straight = 0;
    new GcodeToolpath({ addLine: () => straight++ }).loadFromStringSync(text);
  };
  const few = lines > 20_000;
  const [own = Number.NaN, ...slow] = times(
    [
      () => readProgram(text),
      ...(few ? [] : [theirs, () => parseStringSync(text)]),
    ],
    calls,
  );
  const [toolpath = Number.NaN, parser = Number.NaN] = few
    ? [once(theirs), once(() => parseStringSync(text))]
    : slow;
  const { kind, kinds } = readProgram(text);
  const probes = kind.filter((k) => kinds[k] === "probe").length;
  console.log(
    String(lines).padEnd(10),
    own.toFixed(1).padStart(11),
    toolpath.toFixed(0).padStart(16),
    parser.toFixed(0).padStart(14),
    (toolpath / own).toFixed(0).padStart(23),
    `${probes}, ${straight - (kind.length - probes) > 0 ? straight - (kind.length - probes) : 0}`.padStart(
      26,
    ),
  );
}

// The same natively, next to two crates that split a program into words.
console.log(
  "\nNatively, µs of the clock: Touchpath's moves, and by how much that is faster than the words of the crates gcode and g-code",
);
const folder = mkdtempSync(join(tmpdir(), "touchpath-bench-"));
for (const lines of [50, 1000, 10_000, 100_000]) {
  const file = join(folder, "program.ngc");
  writeFileSync(file, foreign(lines));
  const readers = [
    "--manifest-path",
    at("tools", "readers", "Cargo.toml"),
    "--target-dir",
    at("target"),
  ];
  const said = run(
    "cargo",
    ["run", "--quiet", "--locked", "--release", ...readers, "--", file],
    { quiet: true },
  );
  const [own = Number.NaN, ...crates] = said
    .trim()
    .split("\n")
    .map((line) => Number(line.split(" ")[1]));
  console.log(
    String(lines).padEnd(10),
    own.toFixed(1).padStart(11),
    ...crates.map((micros) => (micros / own).toFixed(1).padStart(8)),
  );
}
rmSync(folder, { recursive: true });

/** Tasks of half a second are timed three times. */
function once(/** @type {() => unknown} */ work) {
  const rounds = [0, 1, 2].map(() => {
    const start = cpu();
    work();
    return cpu() - start;
  });
  return Math.min(...rounds);
}

/** Sizes of version 0.2.0, before jobs and plans were passed in one piece. Its page had the whole module. */
const BEFORE = {
  raw: 988_298,
  gzip: 411_649,
  brotli: 319_000,
  "first, brotli": 319_000,
  "page, gzip": 443_000,
};
const bytes = readFileSync(at("dist", "wasm", "touchpath_bg.wasm"));
const gzip = (/** @type {Buffer} */ file) =>
  gzipSync(file, { level: 9 }).length;
// Loaded on demand: the words of a language, the editor of opened programs and the worker for long texts.
const rare = [
  ...readdirSync(at("www", "words")).map((name) => name.replace(".json", "-")),
  "program-editor-",
  "reader-",
  "rest-",
];
const page = readdirSync(at("dist", "page", "assets"))
  .filter((name) => !rare.some((start) => name.startsWith(start)))
  .map((name) => readFileSync(at("dist", "page", "assets", name)));
const sizes = {
  raw: bytes.length,
  gzip: gzip(bytes),
  brotli: brotliCompressSync(bytes).length,
  "first, brotli": brotliCompressSync(
    readFileSync(at("www", "core", "wasm", "first.wasm")),
  ).length,
  "page, gzip": [
    ...page,
    readFileSync(at("dist", "page", "index.html")),
  ].reduce((sum, file) => sum + gzip(file), 0),
};
console.log("\nBytes of the wasm, and of a first visit of the page; before");
for (const [name, size] of Object.entries(sizes)) {
  const before = BEFORE[/** @type {keyof typeof BEFORE} */ (name)];
  console.log(
    name.padEnd(14),
    String(size).padStart(8),
    String(before).padStart(8),
    `${((100 * size) / before).toFixed(0)} %`.padStart(6),
  );
}

// By function names: shared code such as collections and formatting is the rest. Mazak, Brother, Hurco and Okuma are rows of `renishaw`.
const target = process.env.CARGO_TARGET_DIR ?? at("target");
const built = rooms(
  readFileSync(
    join(target, "wasm", "wasm32-unknown-unknown", "release", "touchpath.wasm"),
  ),
);
console.log("\nCode by room and control, kB before wasm-opt");
for (const [name, size] of built)
  console.log(name.padEnd(22), (size / 1000).toFixed(1).padStart(8));
