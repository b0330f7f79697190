// The command in a build: positions of findings in a file, and the formats of GitHub and JUnit.
import assert from "node:assert/strict";
import { writeFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { file, folder, run, setUp, touchpath, wrong } from "./command.mjs";

setUp();

/** A handwritten job of two cycles, with errors in lines 5, 6, 9 and 11. */
const WRITTEN = `{
  "format": 2,
  "name": "VISE \\"A\\"", "units": "mm",
  "cycles": [
    { "type": "hole", "name": "BORE", "diameter": -1 },
    { "type": "web", "widht": 20, "origin": [0, [1], "x"] }
  ],
  "tolerances": {
    "BORE.diameter": { "tolerance": "about 5" }
  },
  "feeds": { "work": 0, "work": 9999999 }
}
`;
const FINDING = /^(.+?):(\d+):(\d+): (\w+): ([^:]+): .* \[([\w-]+)\]$/;

test("a finding says the line and the column of what it is about", () => {
  writeFileSync(join(folder, "vise.json"), WRITTEN);
  const lines = WRITTEN.split("\n");
  const { status, stdout } = run(["check", "vise.json"]);
  assert.equal(status, 1);
  const found = stdout
    .split("\n")
    .filter((line) => line.includes(": error: "))
    .map((line) => FINDING.exec(line)?.slice(1) ?? [line]);
  /** @type {Record<string, string>} */
  const begins = {
    "cycles[0].diameter": '"diameter"',
    "cycles[1].widht": '"widht"',
    "cycles[1].origin[1]": "[1]",
    "cycles[1].origin[2]": '"x"',
    "feeds.work": '"work": 9999999',
  };
  const seen = new Set();
  for (const [name, line, column, , path = ""] of found) {
    assert.equal(name, "vise.json");
    const begin = begins[path];
    if (begin === undefined) continue;
    seen.add(path);
    const own = (lines[Number(line) - 1] ?? "").slice(Number(column) - 1);
    assert.ok(own.startsWith(begin), `${path} at ${line}:${column}: ${own}`);
  }
  assert.deepEqual([...seen].sort(), Object.keys(begins).sort(), stdout);
  const json = JSON.parse(
    run(["check", "vise.json", "--json"]).stdout,
  ).findings;
  assert.deepEqual(
    json
      .filter(
        (/** @type {any} */ f) =>
          f.path === "feeds.work" && f.level === "error",
      )
      .map((/** @type {any} */ f) => f.line),
    [11],
  );
  // A missing value is reported at its object; a tolerance's key has a dot in it.
  writeFileSync(
    join(folder, "bore.json"),
    '{ "format": 1,\n  "cycle": { "type": "hole" },\n  "tolerances": { "diameter": { "tolerance": "about 5" } } }',
  );
  assert.match(
    run(["check", "bore.json"]).stdout,
    /^bore\.json:3:\d+: error: tolerances\.diameter/m,
  );
  writeFileSync(join(folder, "none.json"), '\ufeff\n{ "format": 1 }');
  assert.match(
    run(["check", "none.json"]).stdout,
    /^none\.json:2:1: error: cycle: /m,
  );
});

test("annotations for GitHub, at the file and the line", () => {
  writeFileSync(
    join(folder, "a,b%.json"),
    '{ "format": 1,\n"cycle": { "type": "hole" },\n"name": 5 }',
  );
  const { status, stdout } = run(["check", "a,b%.json", "--format", "github"]);
  assert.equal(status, 1);
  const [first] = stdout
    .split("\n")
    .filter((line) => line.startsWith("::error"));
  assert.equal(
    first,
    "::error file=a%2Cb%25.json,line=3,col=1,title=wrong-type::name: Program name must be text, not a number",
  );
  assert.ok(
    stdout
      .split("\n")
      .every(
        (line) => line === "" || /^::(error|warning|notice) file=/.test(line),
      ),
  );
  const rows = run(
    ["check", "-", "--format", "github", "--ndjson"],
    `${JSON.stringify(touchpath.defaultJob("hole"))}\n{}\n`,
  );
  assert.match(rows.stdout, /^::error line=2,title=missing::/m);
  writeFileSync(join(folder, "l.ndjson"), "{}\n");
  assert.match(
    run(["check", "l.ndjson", "--format", "github"]).stdout,
    /^::error file=l\.ndjson,line=1,title=missing::/m,
  );
  assert.equal(
    run(["check", "a,b%.json", "--format", "github", "--json"]).status,
    2,
  );
  writeFileSync(
    join(folder, "own.json"),
    JSON.stringify(touchpath.defaultJob("hole")),
  );
  writeFileSync(join(folder, "points.txt"), "1,2\n");
  assert.match(
    run(["evaluate", "own.json", "points.txt"]).stderr,
    /^own\.json: error: measured/m,
    "no place of the job",
  );
  const good = touchpath.plan(touchpath.defaultJob("hole")).program.text;
  writeFileSync(join(folder, "good.ngc"), good);
  writeFileSync(join(folder, "bad.ngc"), good.replace("F150", "F151"));
  const verified = run(["verify", "good.ngc", "bad.ngc", "--format", "github"]);
  assert.equal(verified.status, 1);
  assert.match(
    verified.stdout,
    /^::error file=bad\.ngc,line=\d+::bad\.ngc.*%0A.*F151%0A/m,
  );
  assert.ok(!/^::(error|warning) file=good/m.test(verified.stdout));
});

test("check writes a SARIF log, with line and column", () => {
  writeFileSync(
    join(folder, "sarif.json"),
    '{ "format": 1,\n"cycle": { "type": "hole", "diamter": 30 } }',
  );
  const { status, stdout } = run(["check", "sarif.json", "--format", "sarif"]);
  assert.equal(status, 1);
  const [{ results, tool }] = JSON.parse(stdout).runs;
  const [first] = results;
  assert.equal(first.ruleId, "unknown-key");
  assert.match(first.message.text, /Did you mean "diameter"\?$/);
  assert.deepEqual(first.locations[0].physicalLocation, {
    artifactLocation: { uri: "sarif.json" },
    region: { startLine: 2, startColumn: 28 },
  });
  assert.ok(
    tool.driver.rules.some(
      (/** @type {any} */ rule) => rule.id === first.ruleId,
    ),
  );
  // The former name of --format.
  assert.equal(
    run(["check", "sarif.json", "--reporter", "sarif"]).stdout,
    stdout,
  );
  assert.equal(
    run(["check", "sarif.json", "--reporter", "text", "--format", "text"])
      .status,
    2,
  );
});

test("a report for JUnit: a case a job, hostile text and all", async () => {
  file("good.json", touchpath.defaultJob("hole"));
  file("wrong.json", { ...wrong(), '<b>&"\u0000\ud800': 1 });
  file("warned.json", {
    format: 1,
    cycle: { type: "hole" },
    stylus: { diameter: 30 },
  });
  const ran = (/** @type {string[]} */ ...more) =>
    run([
      "check",
      "good.json",
      "wrong.json",
      "warned.json",
      "--format",
      "junit",
      ...more,
    ]);
  const { status, stdout } = ran();
  assert.equal(status, 1);
  assert.match(
    stdout,
    /^<\?xml version="1\.0" encoding="UTF-8"\?>\n<testsuites tests="3" failures="1">/,
  );
  assert.match(
    stdout,
    /<testcase name="wrong\.json" classname="touchpath\.check"><failure message="[^"<>]+" type="[\w-]+">[^<>]*cycle\.diameter[^<>]*<\/failure>/,
  );
  assert.match(stdout, /&lt;b&gt;&amp;&quot;/);
  // biome-ignore lint/suspicious/noControlCharactersInRegex: it is what must not be there.
  assert.ok(!/[\u0000-\u0008]/.test(stdout));
  const open = [...stdout.matchAll(/<([a-z][a-z-]*)[ >]/g)]
    .map(([, name]) => name)
    .sort();
  const closed = [...stdout.matchAll(/<\/(\w[\w-]*)>/g)]
    .map(([, name]) => name)
    .sort();
  assert.deepEqual(open, closed);
  assert.match(
    ran("--deny-warnings").stdout,
    /<testsuites tests="3" failures="2">/,
  );
  assert.equal(run(["check", "good.json", "--format", "junit"]).status, 0);
  assert.equal(run(["check", "good.json", "--format", "tap"]).status, 2);
  assert.equal(run(["plan", "good.json", "--format", "junit"]).status, 2);
});

test("a finding of a job in one line says its column: 12 characters stand before it", () => {
  writeFileSync(
    join(folder, "line.json"),
    '{"format":1,"overtravel":-1,"cycle":{"type":"hole"}}',
  );
  const { status, stdout } = run(["check", "line.json"]);
  assert.equal(status, 1);
  assert.match(stdout, /^line\.json:1:13: error: /m);
});
