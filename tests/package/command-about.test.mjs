// Commands without jobs: the meaning of a code, a new job, tool lengths, other units, help for one command; and the end of a pipe.
import assert from "node:assert/strict";
import { spawn, spawnSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { at } from "../../scripts/lib.mjs";
import {
  command,
  file,
  folder,
  job,
  run,
  setUp,
  touchpath,
  wrong,
} from "./command.mjs";

setUp();

test("explain says what the docs say of every code, and what each rule asks", () => {
  const listed = [
    ...readFileSync(at("docs", "findings.md"), "utf8").matchAll(
      /^\| `([\w-]+)` \| (.+) \|$/gm,
    ),
  ];
  assert.ok(listed.length > 150);
  for (const [, code, meaning] of [listed[0], listed.at(-1), listed[80]].map(
    (row) => row ?? [],
  )) {
    assert.deepEqual(run(["explain", String(code)]), {
      status: 0,
      stdout: `${code}\n\n${meaning}\n`,
      stderr: "",
    });
    assert.deepEqual(
      JSON.parse(run(["explain", String(code).toUpperCase(), "--json"]).stdout),
      { code, meaning },
    );
  }
  const { safety } = touchpath.plan(job("hole"));
  for (const { rule } of safety)
    assert.match(
      run(["explain", rule]).stdout,
      new RegExp(`^${rule} \\(safety rule\\)\n\n.+\n.+\n$`),
    );
  const unknown = run(["explain", "ball-to-wide"]);
  assert.deepEqual([unknown.status, unknown.stdout], [2, ""]);
  assert.equal(
    unknown.stderr,
    "touchpath: There is no finding and no rule ball-to-wide. Did you mean ball-too-wide?\n",
  );
  assert.equal(run(["explain"]).status, 2);
  for (const name of ["constructor", "__proto__"])
    assert.equal(run(["explain", name]).status, 2, name);
});

test("new gives a job that plans, for the control that is named", () => {
  const made = run(["new", "groove", "--post", "sinumerik", "--units", "inch"]);
  assert.equal(made.status, 0, made.stderr);
  const expected = touchpath.defaultJob("groove", "inch");
  assert.deepEqual(JSON.parse(made.stdout), {
    ...expected,
    control: { ...expected.control, post: "sinumerik" },
  });
  assert.match(run(["plan", "-"], made.stdout).stdout, /MEAS=1/);
  for (const { type } of touchpath.catalog().cycles)
    assert.equal(
      run(["check", "-"], run(["new", type]).stdout).status,
      0,
      type,
    );
  assert.match(
    run(["new", "grove"]).stderr,
    /There is no cycle grove .+\. Did you mean groove\?/,
  );
  // In a form that the control supports; another form is refused with its reason.
  for (const { id, cycles } of touchpath.catalog().posts) {
    const { status, stdout } = run(["new", "hole", "--post", id]);
    assert.equal(status, 0, id);
    assert.equal(run(["check", "-"], stdout).status, 0, id);
    assert.ok(
      cycles.some(
        ({ type, form, supported }) =>
          type === "hole" &&
          form === JSON.parse(stdout).control.form &&
          supported,
      ),
    );
  }
  const grbl = run(["new", "hole", "--post", "grbl", "--form", "cycle"]);
  assert.deepEqual([grbl.status, grbl.stdout], [2, ""]);
  assert.match(grbl.stderr, /grbl does not take hole: cycle: /);
  assert.match(
    run(["new", "hole", "--units", "cm"]).stderr,
    /--units is mm or inch, not cm/,
  );
  assert.match(
    run(["new", "hole", "--post", "hass"]).stderr,
    /Did you mean haas\?/,
  );
  assert.match(run(["new", "hole", "--flat"]).stderr, /--flat is not for new/);
});

test("convert gives the same part in other units", () => {
  const own = file("metric.json", job("hole"));
  const { status, stdout } = run(["convert", own, "--units", "inch"]);
  assert.equal(status, 0);
  assert.deepEqual(
    JSON.parse(stdout),
    touchpath.convertUnits(/** @type {any} */ (job("hole")), "inch"),
  );
  assert.match(run(["convert", own]).stderr, /convert takes --units/);
  assert.match(
    run(["convert", "-", "--units", "mm"], "{").stderr,
    /This is not JSON/,
  );
  assert.match(
    run(["convert", "-", "--units", "mm"], "[]").stderr,
    /not an object/,
  );
  const bom = run(
    ["convert", "-", "--units", "inch"],
    `\uFEFF${JSON.stringify(job("hole"))}`,
  );
  assert.equal(bom.stdout, stdout, "as a file of Windows begins");
  assert.match(
    run(["convert", "-", "--units", "inch"], '{"format":1,"units":"furlong"}')
      .stderr,
    /units are furlong/,
  );
  assert.match(
    run(["convert", "-", "--units", "inch"], '{"format":1,"overtravel":1e400}')
      .stderr,
    /too large/,
  );
});

test("lentoax answers a query: the example of the manual", () => {
  const query = file("query.json", { frame: [{ rot: "Z", angle: 60 }] });
  assert.deepEqual(
    JSON.parse(run(["lentoax", query, "--json"]).stdout).axind,
    [2, -3, 1],
  );
  const text = run(["lentoax", query]).stdout;
  assert.match(
    text,
    /^L1 acts along \+1·Z, .+\n_AXIND = 2, -3, 1\n\nDEF INT _STAT\n/,
  );
  assert.match(run(["lentoax"]).stdout, /^L1 acts along \+Z/);
  assert.equal(
    run(["lentoax", readFileSync(join(folder, query), "utf8")]).stdout,
    text,
    "the query itself, in place of its file",
  );
  assert.match(
    run(["lentoax", "-"], '{"plane":"G20"}').stderr,
    /Plane must be one of/,
  );
});

test("help for one command names its options and no others", () => {
  const all = run(["--help"]).stdout;
  const usages = [...all.matchAll(/^ {2}touchpath (\w+)/gm)].map(([, name]) =>
    String(name),
  );
  assert.equal(usages.length, 20);
  for (const name of usages) {
    const { status, stdout, stderr } = run([name, "--help"]);
    assert.deepEqual([status, stderr], [0, ""], name);
    assert.match(stdout, new RegExp(`^ {2}touchpath ${name}\\b`));
  }
  assert.match(run(["svg", "--help"]).stdout, /--view/);
  assert.doesNotMatch(run(["svg", "--help"]).stdout, /--positioning/);
  assert.match(run(["chek", "x.json"]).stderr, /Did you mean check\?/);
});

test("--deny-warnings: a warning ends as an error does, and files are written all the same", () => {
  const warned = file("warned.json", {
    ...job("hole"),
    tolerances: { diameter: { tolerance: "39.7..39.75" } },
  });
  assert.ok(
    touchpath
      .check(JSON.parse(readFileSync(join(folder, warned), "utf8")))
      .some((f) => f.level === "warning"),
  );
  assert.equal(run(["check", warned]).status, 0);
  assert.equal(run(["check", warned, "--deny-warnings"]).status, 1);
  assert.equal(
    run(["plan", warned, "--deny-warnings", "-o", "denied"]).status,
    1,
  );
  assert.match(
    readFileSync(join(folder, "denied", "PROBE.ngc"), "utf8"),
    /G38/,
  );
  // The same for a program whose header is only partly understood, in both formats.
  const program = touchpath
    .program(job("hole"))
    .text.replace("(job format=1", "(job format=1 nothing=1");
  const verified = file("unknown.ngc", program);
  for (const format of ["text", "json"]) {
    const said = run([
      "verify",
      verified,
      "--format",
      format,
      "--deny-warnings",
    ]);
    assert.deepEqual(
      [
        said.status,
        said.stdout.includes("header-unknown") ||
          said.stderr.includes("header-unknown"),
      ],
      [1, true],
      format,
    );
  }
  assert.equal(
    run(["check", file("wrong-again.json", wrong()), "--deny-warnings"]).status,
    1,
  );
});

test("a reader that has enough is no error", async () => {
  const child = spawn(
    "sh",
    ["-c", `node "${command}" catalog | head -1; exit`],
    { cwd: folder },
  );
  let [out, err] = ["", ""];
  child.stdout.on("data", (chunk) => {
    out += chunk;
  });
  child.stderr.on("data", (chunk) => {
    err += chunk;
  });
  const status = await new Promise((done) => child.on("close", done));
  assert.deepEqual([status, out, err], [0, "{\n", ""]);
});

test("a shell completes commands, options, what stands behind them, and files", () => {
  const script = run(["completion", "bash"]).stdout;
  /** What bash offers for the last of these words. @param {...string} words */
  const offered = (...words) => {
    const line = `${script}\nCOMP_WORDS=(touchpath ${words.map((word) => `'${word}'`).join(" ")}); COMP_CWORD=${words.length}; _touchpath; printf '%s\\n' "\${COMPREPLY[@]}"`;
    const done = spawnSync("bash", ["--norc", "-c", line], {
      encoding: "utf8",
      cwd: at("tests", "package"),
    });
    assert.equal(done.stderr, "");
    return done.stdout.trim().split("\n");
  };
  assert.deepEqual(offered("c"), ["check", "convert", "completion", "catalog"]);
  assert.deepEqual(offered("plan", "--post", "ha"), ["haas"]);
  assert.deepEqual(offered("plan", "--f"), ["--form", "--flat"]);
  assert.deepEqual(offered("svg", "--view", ""), [
    "isometric",
    "top",
    "front",
    "side",
  ]);
  assert.deepEqual(offered("table", "--format", ""), ["text", "csv", "json"]);
  assert.deepEqual(offered("examine", "--format", "s"), ["sarif"]);
  assert.deepEqual(offered("new", "hol"), ["hole", "hole-protected"]);
  assert.deepEqual(offered("explain", "ball-to"), ["ball-too-wide"]);
  // Bash completes nothing else with files.
  assert.deepEqual(offered("plan", "command-ab"), [""]);
  assert.match(script, /^complete -o default -F _touchpath touchpath$/m);
  assert.match(run(["completion", "powershell"]).stderr, /bash, zsh, fish/);
  for (const shell of ["zsh", "fish"])
    assert.match(run(["completion", shell]).stdout, /touchpath/);
});

test("a plan depends on the job alone: not on time zone, locale, machine, order of keys or what was planned before", () => {
  /** The same object with its keys in the opposite order. @returns {unknown} */
  const turned = (/** @type {unknown} */ value) =>
    typeof value === "object" && value !== null && !Array.isArray(value)
      ? Object.fromEntries(
          Object.entries(value)
            .reverse()
            .map(([key, inner]) => [key, turned(inner)]),
        )
      : value;
  const hole = {
    ...job("hole"),
    part: { offset: [0.1, 0.2, 0], rotation: 0.5, sizes: { diameter: 0.02 } },
  };
  const [one, other] = [
    file("one.json", hole),
    file("other.json", /** @type {any} */ (turned(hole))),
  ];
  const planned = (/** @type {string} */ name, env = {}) =>
    spawnSync("node", [command, "plan", name, "--json"], {
      cwd: folder,
      encoding: "utf8",
      env: { ...process.env, ...env },
    });
  const first = planned(one);
  assert.equal(first.status, 0);
  assert.equal(
    planned(one, {
      TZ: "Asia/Tokyo",
      LANG: "de_DE.UTF-8",
      LC_ALL: "de_DE.UTF-8",
    }).stdout,
    first.stdout,
  );
  assert.equal(planned(other).stdout, first.stdout);
  assert.equal(JSON.parse(first.stdout).touches.length, 4);
  const before = JSON.stringify(touchpath.plan(/** @type {any} */ (hole)));
  for (const { type } of touchpath.catalog().cycles)
    touchpath.check(touchpath.defaultJob(type));
  touchpath.importJob(JSON.parse(before).program.text);
  assert.equal(
    JSON.stringify(touchpath.plan(/** @type {any} */ (turned(hole)))),
    before,
  );
});
