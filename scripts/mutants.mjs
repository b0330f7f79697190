// Puts faults into a copy of the tree and checks that the tests named for them fail: `npm run mutants`, or only those with the given parts of names. The faults
// are in tests/mutants/. A fault whose text no longer exists fails the run, so the list stays current.
import { spawnSync } from "node:child_process";
import {
  copyFileSync,
  existsSync,
  mkdirSync,
  readdirSync,
  readFileSync,
  rmSync,
  writeFileSync,
} from "node:fs";
import { dirname, join, relative } from "node:path";
import { at, ensureInterpreter, ensurePackages, run } from "./lib.mjs";

/**
 * A fault: in this file the first text is replaced by the second, and the test must fail: `safety::a_name` of the crate, or `package/store.test.mjs: a name`.
 * @typedef {{ name: string, file: string, old: string, new: string, test: string }} Mutant
 */

/** Number of faults at a time, each in a file of its own. A test that fails because of another fault would be counted for its own, so the folders alternate. */
const AT_ONCE = 8;

const parts = process.argv.slice(2);
/** Faults by folder. */
const rooms = readdirSync(at("tests", "mutants"))
  .filter((name) => name.endsWith(".json"))
  .map(
    (name) =>
      /** @type {Mutant[]} */ (
        JSON.parse(readFileSync(at("tests", "mutants", name), "utf8"))
      ),
  );
const most = Math.max(...rooms.map((room) => room.length));
const mutants = Array.from({ length: most }, (_, turn) =>
  rooms.flatMap((room) => room[turn] ?? []),
)
  .flat()
  .filter(
    ({ name }) =>
      parts.length === 0 || parts.some((part) => name.includes(part)),
  );

/** Errors in the list itself. */
function faults() {
  const gone = mutants.filter(
    ({ file, old }) =>
      !existsSync(at(file)) ||
      readFileSync(at(file), "utf8").split(old).length !== 2,
  );
  const twice = mutants.filter(
    ({ name }, index) =>
      mutants.findIndex((other) => other.name === name) !== index,
  );
  return [
    ...gone.map(
      ({ name, file }) =>
        `${name}: its text is not there exactly once in ${file}`,
    ),
    ...twice.map(({ name }) => `${name}: there are two of this name`),
  ];
}

const tree = at("target", "mutants");
const env = {
  ...process.env,
  CARGO_TARGET_DIR: join(tree, "target"),
  RS274: ensureInterpreter(),
  INSTA_UPDATE: "no",
  CI: "1",
};

/**
 * Copies the tree that git knows. Only changed files are copied, so cargo and its caches reuse the rest. It has its own npm packages: npm would empty a linked
 * folder.
 */
function copy() {
  const listed = run(
    "git",
    ["ls-files", "--cached", "--others", "--exclude-standard", "-z"],
    { quiet: true },
  );
  const files = listed
    .split("\0")
    .filter((name) => name && existsSync(at(name)));
  // A file that was removed here would still be compiled there.
  for (const folder of ["src", "tests"].filter((name) =>
    existsSync(join(tree, name)),
  )) {
    for (const entry of readdirSync(join(tree, folder), {
      recursive: true,
      withFileTypes: true,
    })) {
      const file = join(entry.parentPath, entry.name);
      if (entry.isFile() && !files.includes(relative(tree, file))) rmSync(file);
    }
  }
  for (const file of files) {
    const to = join(tree, file);
    if (existsSync(to) && readFileSync(to).equals(readFileSync(at(file))))
      continue;
    mkdirSync(dirname(to), { recursive: true });
    copyFileSync(at(file), to);
  }
}

const command = (/** @type {string} */ name, /** @type {string[]} */ args) =>
  spawnSync(name, args, {
    cwd: tree,
    env,
    encoding: "utf8",
    maxBuffer: 2 ** 28,
  });

const isNode = (/** @type {Mutant} */ { test }) => test.includes(".mjs");

/** Builds what the tests of these faults need. Returns the compiler's output if it fails. */
function build(/** @type {Mutant[]} */ batch) {
  const steps = [];
  if (batch.some((mutant) => !isNode(mutant)))
    steps.push(
      command("cargo", ["test", "--quiet", "--locked", "--lib", "--no-run"]),
    );
  if (batch.some(isNode))
    steps.push(command("node", ["scripts/build.mjs", "--quick"]));
  return steps.find(({ status }) => status !== 0)?.stderr ?? "";
}

/** Whether a test passes. Null if no test has this name. */
function passes(/** @type {string} */ test) {
  const [file = "", name] = test.split(".mjs: ");
  if (!name) {
    const { status, stdout } = command("cargo", [
      "test",
      "--quiet",
      "--locked",
      "--lib",
      "--",
      "--exact",
      `tests::${test}`,
    ]);
    return /running 0 tests/.test(stdout) ? null : status === 0;
  }
  const literal = name.replaceAll(/[.*+?^${}()|[\]\\]/g, "\\$&");
  const { status, stdout } = command("node", [
    "--test",
    "--test-reporter=tap",
    "--test-name-pattern",
    `^${literal}$`,
    `tests/${file}.mjs`,
  ]);
  return /^# tests 0$/m.test(stdout) || !/^# (pass|fail) [1-9]/m.test(stdout)
    ? null
    : status === 0;
}

const wrong = faults();
if (wrong.length === 0) {
  await ensurePackages();
  copy();
  const broken = build(mutants);
  if (broken) throw new Error(broken);
  for (const test of new Set(mutants.map(({ test }) => test))) {
    const result = passes(test);
    if (result !== true)
      wrong.push(
        result === null
          ? `${test}: there is no such test`
          : `${test}: it fails without a fault`,
      );
  }
}
let caught = 0;
const rest = wrong.length === 0 ? [...mutants] : [];
while (rest.length > 0) {
  /** @type {Mutant[]} */
  const batch = [];
  for (const mutant of [...rest])
    if (
      batch.length < AT_ONCE &&
      batch.every(({ file }) => file !== mutant.file) &&
      batch.every((one) => isNode(one) === isNode(mutant))
    )
      batch.push(...rest.splice(rest.indexOf(mutant), 1));
  for (const { file, old, new: fault } of batch)
    writeFileSync(
      join(tree, file),
      readFileSync(at(file), "utf8").replace(old, () => fault),
    );
  const broken = build(batch);
  if (broken)
    wrong.push(
      `${batch.map(({ name }) => name).join(", ")}: not built\n${broken}`,
    );
  else
    for (const { name, test } of batch) {
      const missed = passes(test);
      if (missed) wrong.push(`${name}: ${test} passes`);
      else caught++;
      console.log(`${missed ? "MISSED" : "caught"}  ${name}  by  ${test}`);
    }
  for (const { file } of batch) copyFileSync(at(file), join(tree, file));
}
for (const why of wrong) console.error(why);
console.log(`${caught} of ${mutants.length} faults are caught`);
process.exit(wrong.length > 0 ? 1 : 0);
