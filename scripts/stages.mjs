// Runs stages in parallel, each as a process: its output is printed in one piece, and a stage that hangs or fails ends alone.
import { spawn } from "node:child_process";
import { writeFileSync } from "node:fs";
import { availableParallelism, constants, setPriority } from "node:os";

/**
 * A stage: its name, the stages that must have passed before it, and its work. No stage waits for a `patient` one, which uses the idle time of the cores.
 * @typedef {{ name: string, after: string[], patient?: boolean, work: () => unknown }} Stage
 */

const seconds = (/** @type {number} */ start) =>
  (performance.now() - start) / 1000;

/** Runs this script again with these arguments; returns its output in order, and whether it failed. */
function again(/** @type {string[]} */ args, /** @type {boolean} */ patient) {
  /** @type {Promise<{ printed: Buffer, failed: boolean }>} */
  const ended = new Promise((done) => {
    // A process group, so that child processes end with it.
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

/** Gives a process and its children a low priority. Linux shares the cores by session, and each stage is one, so the session yields. */
function yieldCores(/** @type {number} */ pid) {
  try {
    setPriority(pid, constants.priority.PRIORITY_BELOW_NORMAL);
    if (process.platform === "linux")
      writeFileSync(
        `/proc/${pid}/autogroup`,
        String(constants.priority.PRIORITY_LOW),
      );
  } catch {
    // Without this the stages share the cores equally.
  }
}

/** @type {Set<import("node:child_process").ChildProcess>} */
const running = new Set();

/** Ends the running stages. */
function stopAll() {
  for (const child of running)
    try {
      if (child.pid) process.kill(-child.pid);
    } catch {
      // The process has already ended.
    }
}
for (const signal of /** @type {const} */ (["SIGINT", "SIGTERM"]))
  process.once(signal, () => {
    stopAll();
    process.exit(130);
  });

/**
 * Runs the stages, at most one more than there are cores: a browser waits, and a compiler uses the free time. Ready stages start in the order of the list. Ends
 * the script if a stage fails.
 * @param {Stage[]} stages
 * @param {(name: string) => string[]} args arguments with which this script runs a stage
 * @param {string} [hint] command that repeats a failed run
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

/** Prints the duration of every stage. */
function print(
  /** @type {Map<string, number>} */ passed,
  /** @type {number} */ start,
) {
  console.log("\nStages, which run beside each other:");
  for (const [name, time] of passed)
    console.log(`  ${time.toFixed(1).padStart(7)} s  ${name}`);
  console.log(`  ${seconds(start).toFixed(1).padStart(7)} s  in all`);
}
