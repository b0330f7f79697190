// Runs stages beside each other, each as a process of its own: what it prints comes in one piece, and what hangs or fails ends alone.
import { spawn } from "node:child_process";
import { writeFileSync } from "node:fs";
import { availableParallelism, constants, setPriority } from "node:os";

/**
 * A stage: what it is called, the stages that must have passed before it, and its work. Nothing waits for one that is `patient`: it takes what the others leave of
 * the cores.
 * @typedef {{ name: string, after: string[], patient?: boolean, work: () => unknown }} Stage
 */

const seconds = (/** @type {number} */ start) =>
  (performance.now() - start) / 1000;

/** Runs this script again with these arguments; gives what it printed, in its order, and whether it failed. */
function again(/** @type {string[]} */ args, /** @type {boolean} */ patient) {
  /** @type {Promise<{ printed: Buffer, failed: boolean }>} */
  const ended = new Promise((done) => {
    // A group of its own: what it has started ends with it.
    const child = spawn(process.execPath, [process.argv[1] ?? "", ...args], {
      stdio: ["ignore", "pipe", "pipe"],
      detached: true,
    });
    running.add(child);
    if (patient && child.pid) yieldCores(child.pid);
    /** @type {Buffer[]} */
    const chunks = [];
    for (const stream of [child.stdout, child.stderr])
      stream.on("data", (chunk) => chunks.push(chunk));
    child.on("close", (code) => {
      running.delete(child);
      done({ printed: Buffer.concat(chunks), failed: code !== 0 });
    });
  });
  return ended;
}

/** Lets a process and what it starts take what the others leave. Linux shares its cores by sessions, and each stage is one: the session yields. */
function yieldCores(/** @type {number} */ pid) {
  try {
    setPriority(pid, constants.priority.PRIORITY_BELOW_NORMAL);
    if (process.platform === "linux")
      writeFileSync(
        `/proc/${pid}/autogroup`,
        String(constants.priority.PRIORITY_LOW),
      );
  } catch {
    // Without it the stages share as they are.
  }
}

/** @type {Set<import("node:child_process").ChildProcess>} */
const running = new Set();

/** Ends what still runs. */
function stopAll() {
  for (const child of running)
    try {
      if (child.pid) process.kill(-child.pid);
    } catch {
      // It has ended by itself.
    }
}
for (const signal of /** @type {const} */ (["SIGINT", "SIGTERM"]))
  process.once(signal, () => {
    stopAll();
    process.exit(130);
  });

/**
 * Runs the stages, at most one more at once than there are cores: a browser waits, and a compiler takes what is free. The first of the list that may begin
 * begins first. Ends the script where one fails.
 * @param {Stage[]} stages
 * @param {(name: string) => string[]} args by which this script runs one of them
 * @param {string} [hint] how a run that failed is repeated
 */
export async function runStages(stages, args, hint = "") {
  const start = performance.now();
  /** @type {Map<string, number>} */
  const passed = new Map();
  /** @type {Map<string, Promise<void>>} */
  const begun = new Map();
  const most = availableParallelism() + 1;
  const begin = async (/** @type {Stage} */ { name, patient = false }) => {
    const own = performance.now();
    console.log(`.. ${name} begins at ${seconds(start).toFixed(0)} s`);
    const { printed, failed } = await again(args(name), patient);
    console.log(`\n== ${name}`);
    process.stdout.write(printed);
    console.log(`-- ${name}: ${seconds(own).toFixed(1)} s`);
    if (failed) {
      stopAll();
      print(passed, start);
      console.error(
        `\nFailed: ${name}. It alone: npm test -- "${name}". ${hint}`,
      );
      process.exit(1);
    }
    passed.set(name, seconds(own));
    begun.delete(name);
  };
  for (;;) {
    const next = stages.filter(
      ({ name, after }) =>
        !passed.has(name) &&
        !begun.has(name) &&
        after.every((before) => passed.has(before)),
    );
    for (const one of next.slice(0, most - begun.size))
      begun.set(one.name, begin(one));
    if (begun.size === 0) break;
    await Promise.race(begun.values());
  }
  print(passed, start);
}

/** Prints every stage's time. */
function print(
  /** @type {Map<string, number>} */ passed,
  /** @type {number} */ start,
) {
  console.log("\nStages, which run beside each other:");
  for (const [name, time] of passed)
    console.log(`  ${time.toFixed(1).padStart(7)} s  ${name}`);
  console.log(`  ${seconds(start).toFixed(1).padStart(7)} s  in all`);
}
