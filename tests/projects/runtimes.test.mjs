// The functions and the component on a portal's server: bundled into one file, with a module that is passed in, and rendered on a server.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { copyFileSync, mkdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { folder, inBrowser, project } from "./installed.mjs";

const { open } = inBrowser();
const { defaultJob, plan } = await import("touchpath");
const WANTED = plan(defaultJob("hole")).program.text;

/** A script of a project that writes the program of a default job. */
const script = (/** @type {string} */ from, before = "") =>
  `import { defaultJob, plan${before && ", init"} } from "${from}";\n${before}process.stdout.write(plan(defaultJob("hole")).program.text);\n`;
const ran = (/** @type {string} */ file, cwd = folder) =>
  execFileSync("node", [file], { cwd, encoding: "utf8" });

/** What the command of a project prints. */
const touchpath = (
  /** @type {string} */ own,
  /** @type {string[]} */ ...args
) =>
  execFileSync(join(own, "node_modules", ".bin", "touchpath"), args, {
    encoding: "utf8",
    maxBuffer: 2 ** 24,
  });

test("a server that is bundled into one file has the module inside", async () => {
  const own = project("single");
  writeFileSync(join(own, "inline.ts"), touchpath(own, "inline"));
  writeFileSync(join(own, "server.js"), script("./inline.ts"));
  const { build } = await import("esbuild");
  for (const [format, ending] of /** @type {const} */ ([
    ["esm", "mjs"],
    ["cjs", "cjs"],
  ])) {
    await build({
      absWorkingDir: own,
      entryPoints: ["server.js"],
      bundle: true,
      platform: "node",
      format,
      outfile: `${format}.${ending}`,
      logLevel: "error",
    });
    // Alone in a folder, as it is deployed.
    const deployed = join(folder, `deployed-${format}`);
    mkdirSync(deployed);
    copyFileSync(
      join(own, `${format}.${ending}`),
      join(deployed, `server.${ending}`),
    );
    assert.equal(ran(`server.${ending}`, deployed), WANTED, format);
  }
});

test("a module is handed over, as bytes or compiled; before that every function says what is missing", () => {
  const own = project("handed");
  const read = `import { readFileSync } from "node:fs";\nimport { createRequire } from "node:module";\nconst bytes = readFileSync(createRequire(import.meta.url).resolve("touchpath/touchpath.wasm"));\n`;
  for (const [name, module] of [
    ["bytes", "bytes"],
    ["compiled", "new WebAssembly.Module(bytes)"],
  ]) {
    writeFileSync(
      join(own, `${name}.js`),
      script(
        "touchpath/init",
        `${read}try { defaultJob("hole"); process.exit(1); } catch (e) { if (!/call init/.test(e.message)) throw e; }\ninit(${module});\n`,
      ),
    );
    assert.equal(ran(`${name}.js`, own), WANTED, name);
  }
});

test("workerd gets the module where it is imported", async () => {
  const own = project("workerd");
  writeFileSync(join(own, "worker.js"), script("touchpath"));
  const { build } = await import("esbuild");
  await build({
    absWorkingDir: own,
    entryPoints: ["worker.js"],
    bundle: true,
    format: "esm",
    conditions: ["workerd"],
    outfile: "dist.mjs",
    logLevel: "error",
    plugins: [
      {
        // There an import of WebAssembly gives the compiled module.
        name: "workerd",
        setup: (build) =>
          build.onLoad({ filter: /\.wasm$/ }, ({ path }) => ({
            contents: `import { readFileSync } from "node:fs"; export default new WebAssembly.Module(readFileSync(${JSON.stringify(path)}));`,
          })),
      },
    ],
    external: ["node:fs"],
  });
  assert.equal(ran("dist.mjs", own), WANTED);
});

test("React: what a server rendered is hydrated with its job and its listeners", async () => {
  const own = project("hydrated", ["react", "react-dom", "scheduler"]);
  writeFileSync(
    join(own, "probe.js"),
    `import { createElement as h, useState } from "react";
import { TouchForm, TouchPath } from "touchpath-element/react";
export function Probe() {
  const [job, setJob] = useState({ format: 1, name: "HYDRATED", cycle: { type: "hole", diameter: 30 } });
  const [readonly, lock] = useState(false);
  const [told, tell] = useState("");
  return h("div", null,
    h("p", { role: "status" }, job.name + " " + job.cycle.diameter + told),
    h("button", { onClick: () => lock(!readonly) }, "Lock"),
    h(TouchPath, { job, readonly, theme: "light", className: "tall", id: "probing", "onjob-change": (event) => setJob(event.detail.job),
      onLoad: () => tell(" loaded"),
      onChange: ({ detail }) => tell(detail.plan ? " with a program" : " without a program") }),
    h(TouchForm, { for: "probing", className: "apart" }));
}
`,
  );
  writeFileSync(
    join(own, "server.js"),
    'import { createElement } from "react";\nimport { renderToString } from "react-dom/server";\nimport { Probe } from "./probe.js";\nprocess.stdout.write(renderToString(createElement(Probe)));\n',
  );
  const markup = ran("server.js", own);
  assert.match(
    markup,
    /<touch-path class="tall" id="probing"><\/touch-path><touch-form for="probing" class="apart"><\/touch-form>/,
  );
  writeFileSync(
    join(own, "main.js"),
    'import { createElement } from "react";\nimport { hydrateRoot } from "react-dom/client";\nimport { Probe } from "./probe.js";\nhydrateRoot(document.getElementById("root"), createElement(Probe), { onRecoverableError: (why) => { throw why; } });\n',
  );
  writeFileSync(
    join(own, "index.html"),
    `<!doctype html><html lang="en"><meta charset="utf-8"><title>User</title><style>.tall { height: 640px }</style><div id="root">${markup}</div><script type="module" src="/main.js"></script></html>`,
  );
  const { build } = await import("vite");
  await build({
    root: own,
    configFile: false,
    logLevel: "error",
    build: { target: "es2022" },
  });
  const { page, problems } = await open(join(own, "dist"));
  const box = page.locator("touch-path [id='f-cycle.diameter']");
  await box.waitFor();
  assert.equal(
    await box.inputValue(),
    "30",
    "the job of the component, not the default one",
  );
  await box.fill("33");
  await page.getByText("HYDRATED 33 with a program").waitFor();
  await page.locator("touch-form [id='f-cycle.diameter']").fill("2");
  await page.getByText("HYDRATED 2 without a program").waitFor();
  await page.getByRole("button", { name: "Lock" }).click();
  await page.waitForFunction(
    () =>
      /** @type {any} */ (document.querySelector("touch-path")).readonly ===
      true,
  );
  assert.deepEqual(problems, []);
});
