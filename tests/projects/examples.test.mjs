// The examples, each with the package from its tarball: a portal, React, Vue, a service.
import assert from "node:assert/strict";
import { spawn, spawnSync } from "node:child_process";
import { writeFileSync } from "node:fs";
import { connect } from "node:net";
import { join } from "node:path";
import { after, test } from "node:test";
import { Ajv2020 } from "ajv/dist/2020.js";
import { unzipSync } from "fflate";
import { at } from "../../scripts/lib.mjs";
import { inBrowser, project } from "./installed.mjs";

const inside = inBrowser();

/** Opens a folder's page, and waits for its elements. */
async function open(/** @type {string} */ folder) {
  const opened = await inside.open(folder);
  await opened.page.locator("touch-path .line").first().waitFor({ state: "attached" });
  return opened;
}

test("the portal: a job list, two elements, programs collected as a zip", async () => {
  const { page, problems } = await open(project("portal", ["fflate"], "portal"));
  const [edit, view] = [page.locator("#edit"), page.locator("#view")];
  await page.getByRole("button", { name: "BORE" }).click();
  await edit.locator("[id='f-cycle.diameter']").fill("36");
  const shown = () => view.evaluate((element) => /** @type {any} */ (element).plan.program.text);
  const { defaultJob, plan } = await import("touchpath");
  const bore = defaultJob("hole");
  Object.assign(bore, { name: "BORE", control: { ...bore.control, post: "fanuc", workOffset: 1 } });
  Object.assign(bore.cycle, { diameter: 36 });
  assert.equal(await shown(), plan(bore).program.text);
  await edit.getByRole("button", { name: /^Save / }).click();
  await page.getByRole("button", { name: "POCKET" }).click();
  await view.getByRole("button", { name: /^Save / }).click();
  await page.getByText("2 collected: BORE.nc, POCKET.ngc").waitFor();
  const [download] = await Promise.all([
    page.waitForEvent("download"),
    page.getByRole("button", { name: "Save all" }).click(),
  ]);
  const chunks = [];
  for await (const chunk of await download.createReadStream()) chunks.push(chunk);
  const files = unzipSync(new Uint8Array(Buffer.concat(chunks)));
  assert.equal(Buffer.from(/** @type {Uint8Array} */ (files["BORE.nc"])).toString(), plan(bore).program.text);
  assert.deepEqual(Object.keys(files).sort(), ["BORE.nc", "POCKET.ngc"]);
  await page.getByRole("button", { name: "BORE" }).click();
  assert.equal(await edit.locator("[id='f-cycle.diameter']").inputValue(), "36", "the list keeps what was typed");
  assert.deepEqual(problems, []);
});

for (const [name, libraries, jobName] of /** @type {const} */ ([
  ["react", ["react", "react-dom", "scheduler"], "FROM_REACT"],
  ["vue", ["vue", "@vue"], "FROM_VUE"],
]))
  test(`the host in ${name}: a job down, events up`, async () => {
    const own = project(name, [...libraries], name);
    const { build } = await import("vite");
    await build({
      root: own,
      configFile: false,
      logLevel: "error",
      build: { target: "es2022" },
      define: {
        __VUE_OPTIONS_API__: "true",
        __VUE_PROD_DEVTOOLS__: "false",
        __VUE_PROD_HYDRATION_MISMATCH_DETAILS__: "false",
      },
    });
    const { page, problems } = await open(join(own, "dist"));
    const state = page.getByRole("status").filter({ hasText: jobName });
    assert.match((await state.first().textContent()) ?? "", new RegExp(`^${jobName}: diameter 30, \\d\\d+ lines$`));
    const box = page.locator("[id='f-cycle.diameter']");
    await box.fill("33");
    await page.getByText(`${jobName}: diameter 33`).waitFor();
    await page.getByRole("button", { name: "44 mm" }).click();
    await page.waitForFunction(() => {
      const element = /** @type {any} */ (document.querySelector("touch-path"));
      return element.job.cycle.diameter === 44;
    });
    assert.equal(await box.inputValue(), "44");
    // What the user types stays as it is typed, although the host hands it back.
    await box.fill("5,5");
    await page.getByText(`${jobName}: diameter 5.5`).waitFor();
    assert.equal(await box.inputValue(), "5,5");
    assert.deepEqual(problems, []);
  });

test("the element was unknown in React's TSX: the example compiles, and a property that is wrong does not", () => {
  const own = project("react-types", ["@types/react", "csstype"], "react");
  // The repository has no types of react-dom.
  writeFileSync(join(own, "dom.d.ts"), 'declare module "react-dom/client";\n');
  writeFileSync(
    join(own, "wrong.tsx"),
    `import type {} from "touchpath/react";
// @ts-expect-error there is no such theme
export const theme = <touch-path theme="drak" />;
// @ts-expect-error there is no such control
export const post = <touch-path post="mazatrol" />;
// @ts-expect-error a plan has no such section
export const plan = <touch-path onplan-change={(event) => event.detail.plan.nothing} />;
`,
  );
  const options = ["--strict", "--noEmit", "--skipLibCheck", "false", "--jsx", "react-jsx", "--target", "es2022"];
  const resolution = ["--module", "esnext", "--moduleResolution", "bundler", "--types", ""];
  const files = ["main.tsx", "wrong.tsx", "dom.d.ts"];
  const lib = ["--lib", "ES2023,DOM"];
  const tsc = at("node_modules", ".bin", "tsc");
  const ran = spawnSync(tsc, [...options, ...resolution, ...lib, ...files], { cwd: own, encoding: "utf8" });
  assert.equal(ran.status, 0, ran.stdout + ran.stderr);
});

/** The services that run: a test that fails leaves none behind. @type {Set<import("node:child_process").ChildProcess>} */
const running = new Set();
after(() => {
  for (const child of running) child.kill("SIGKILL");
});

/** Starts the service; gives its address and how to end it. */
async function service(/** @type {string} */ own, /** @type {Record<string, string>} */ settings = {}) {
  const child = spawn("node", ["server.js"], { cwd: own, env: { ...process.env, PORT: "0", ...settings } });
  running.add(child);
  let said = "";
  const address = await new Promise((done, fail) => {
    child.stdout.on("data", (chunk) => {
      said += chunk;
      const [, found] = /at (http:\S+)/.exec(said) ?? [];
      if (found) done(found);
    });
    child.on("exit", () => fail(new Error(`the service ended: ${said}`)));
  });
  const end = () =>
    new Promise((done) => {
      child.once("exit", (status) => done([status, said.includes("closed")]));
      child.kill("SIGTERM");
    });
  return { address: String(address), end };
}

test("the service: plans, findings, limits, its own description, and an end without loss", async () => {
  const own = project("service", ["fastify"], "service");
  const { address, end } = await service(own, { LONGEST_BODY: "100000" });
  const post = async (/** @type {string} */ path, /** @type {string} */ body, type = "application/json") => {
    const answer = await fetch(address + path, { method: "POST", body, headers: { "content-type": type } });
    return { status: answer.status, body: await answer.json() };
  };
  const { check, defaultJob, plan, version } = await import("touchpath");
  const job = defaultJob("groove");
  const planned = await post("/plan", JSON.stringify(job));
  assert.deepEqual(planned, { status: 200, body: JSON.parse(JSON.stringify(plan(job))) });
  const wrong = { ...job, cycle: { ...job.cycle, width: -1 } };
  const refused = await post("/plan", JSON.stringify(wrong));
  assert.deepEqual([refused.status, refused.body.findings], [422, check(wrong)]);
  assert.deepEqual(await post("/check", JSON.stringify(wrong)), { status: 200, body: check(wrong) });
  for (const nothing of ["null", "7", "[]", '"x"']) assert.equal((await post("/plan", nothing)).status, 422, nothing);
  const text = plan(/** @type {any} */ ({ ...job, control: { ...job.control, post: "sinumerik" } })).program.text;
  const read = (await post("/import", text, "text/plain")).body;
  assert.deepEqual([read.kind, read.job.cycle.type], ["job", "groove"]);
  for (const [path, body, type, status] of /** @type {[string, string, string, number][]} */ ([
    ["/plan", "{", "application/json", 400],
    ["/plan", "", "application/json", 400],
    ["/plan", '{"__proto__":{"x":1}}', "application/json", 400],
    ["/plan", "x".repeat(200_000), "application/json", 413],
    ["/plan", "a=b", "application/x-www-form-urlencoded", 415],
    ["/import", "{}", "application/json", 415],
    ["/nothing", "{}", "application/json", 404],
  ])) {
    const answer = await post(path, body, type);
    assert.equal(answer.status, status, `${path} ${body.slice(0, 20)}: ${JSON.stringify(answer.body)}`);
    assert.deepEqual([typeof answer.body.error, Object.keys(answer.body)], ["string", ["error"]]);
  }
  assert.deepEqual(await (await fetch(`${address}/health`)).json(), { good: true, version: version() });
  const api = await (await fetch(`${address}/openapi.json`)).json();
  const valid = new Ajv2020({ strict: false }).compile(api.components.schemas.Job);
  assert.ok(valid(job) && !valid(wrong));
  const { Job: ofJob, ...schemas } = /** @type {any} */ (api).components.schemas;
  const answered = new Ajv2020({ strict: false }).addSchema({ ...ofJob, $id: "urn:touchpath:job:1" });
  const isPlan = answered.compile({
    $ref: "#/components/schemas/Plan",
    components: { schemas: { ...schemas, Job: {} } },
  });
  assert.ok(isPlan(planned.body) && !isPlan({ .../** @type {any} */ (planned.body), moves: {} }));
  const operations = Object.values(api.paths).flatMap((/** @type {any} */ path) => Object.values(path));
  assert.deepEqual(
    operations.map((/** @type {any} */ one) => one.operationId),
    ["plan", "check", "importJob", "health"],
  );
  const { example } = api.paths["/plan"].post.requestBody.content["application/json"];
  assert.equal((await post("/plan", JSON.stringify(example))).status, 200);
  assert.deepEqual(Object.keys(api.paths), ["/plan", "/check", "/import", "/health"]);
  for (const status of ["400", "413", "415", "422", "503"])
    assert.ok(api.paths["/plan"].post.responses[status], status);
  // Many at once, and the end in the middle: each is answered.
  const many = Array.from({ length: 40 }, () => post("/plan", JSON.stringify(job)));
  await many[0];
  const ended = end();
  const answers = await Promise.allSettled(many);
  assert.deepEqual(await ended, [0, true]);
  for (const answer of answers)
    if (answer.status === "fulfilled") assert.ok([200, 503].includes(answer.value.status), String(answer.value.status));
  await assert.rejects(fetch(`${address}/health`), "it is gone");
});

/** Opens connections and begins a request on each, of which no more comes. */
async function halfOpen(
  /** @type {string} */ address,
  /** @type {number} */ count,
  begun = "content-length: 100\r\n\r\n{",
) {
  const { hostname, port } = new URL(address);
  const sockets = Array.from({ length: count }, () => {
    const socket = connect(Number(port), hostname, () =>
      socket.write(`POST /plan HTTP/1.1\r\nhost: x\r\ncontent-type: application/json\r\n${begun}`),
    );
    // What it is answered is read, and with it that the connection ends.
    return socket.on("error", () => undefined).resume();
  });
  const either = (/** @type {import("node:net").Socket} */ socket) =>
    new Promise((done) => ["connect", "close"].map((event) => socket.once(event, done)));
  await Promise.all(sockets.map(either));
  await new Promise((done) => setTimeout(done, 200));
  return sockets;
}

/** When every one of them is closed, also by a fault. */
const closed = (/** @type {import("node:net").Socket[]} */ sockets) =>
  Promise.all(sockets.map((socket) => socket.destroyed || new Promise((done) => socket.once("close", done))));

test("the service judges jobs by the rules of a file, and does not begin with wrong ones", async () => {
  const own = project("ruled", ["fastify"], "service");
  const write = (/** @type {string} */ name, /** @type {unknown} */ config) =>
    writeFileSync(join(own, name), JSON.stringify(config));
  write("shop.json", {
    format: 1,
    title: "Hall 3",
    allow: { controls: ["haas"] },
    fields: { "feeds.work": { max: 100 } },
  });
  write("wrong.json", { format: 1, tilte: "Hall 3" });
  await assert.rejects(service(own, { CONFIG: "wrong.json" }), /ended/);
  const { address, end } = await service(own, { CONFIG: "shop.json" });
  const planned = async (/** @type {unknown} */ job) => {
    const headers = { "content-type": "application/json" };
    const answer = await fetch(`${address}/plan`, { method: "POST", body: JSON.stringify(job), headers });
    return { status: answer.status, body: await answer.json() };
  };
  const hole = { format: 1, cycle: { type: "hole" }, feeds: { work: 90 } };
  assert.equal((await planned(hole)).body.program.post, "haas");
  const refused = await planned({ ...hole, control: { post: "fanuc" }, feeds: { work: 101 } });
  const errors = refused.body.findings.filter((/** @type {any} */ f) => f.level === "error");
  assert.deepEqual(
    [refused.status, errors.map((/** @type {any} */ f) => `${f.code} ${f.path}`)],
    [422, ["not-allowed control.post", "not-allowed feeds.work"]],
  );
  await end();
});

test("64 requests whose bodies never came closed the service to everybody else", async () => {
  const own = project("slow", ["fastify"], "service");
  const { address, end } = await service(own, { PATIENCE: "2000", MOST_CONNECTIONS: "300" });
  const { defaultJob } = await import("touchpath");
  const planned = async () =>
    (
      await fetch(`${address}/plan`, {
        method: "POST",
        body: JSON.stringify(defaultJob("hole")),
        headers: { "content-type": "application/json" },
      })
    ).status;
  const begun = Date.now();
  const sockets = [
    ...(await halfOpen(address, 100)),
    ...(await halfOpen(address, 50, "x-more: ")),
    ...(await halfOpen(address, 50, "transfer-encoding: chunked\r\n\r\n1")),
  ];
  assert.equal(await planned(), 200);
  assert.equal((await fetch(`${address}/health`)).status, 200);
  // They are shown out when their time is over, and not half a minute later.
  await closed(sockets);
  assert.ok(Date.now() - begun < 10_000, `${Date.now() - begun} ms`);
  // More connections than are taken are closed, and room comes back.
  const many = await halfOpen(address, 320);
  await closed(many);
  assert.equal(await planned(), 200);
  assert.deepEqual(await end(), [0, true]);
});

test("a text of 200,000 levels was a fault of the service: it is a job that is refused", async () => {
  const own = project("deep", ["fastify"], "service");
  const { address, end } = await service(own);
  const post = async (/** @type {string} */ path, /** @type {string} */ body, type = "application/json") => {
    const answer = await fetch(address + path, { method: "POST", body, headers: { "content-type": type } });
    return [
      answer.status,
      .../** @type {any} */ ((await answer.json()).findings?.map((/** @type {any} */ f) => f.code) ?? []),
    ];
  };
  const deep = `${'{"a":'.repeat(200_000)}1${"}".repeat(200_000)}`;
  assert.deepEqual(await post("/import", deep, "text/plain"), [422, "nested-too-deeply"]);
  assert.deepEqual(await post("/import", "{".repeat(200_000), "text/plain"), [422, "nothing-to-import"]);
  assert.equal((await post("/plan", deep))[0], 422);
  assert.equal((await post("/plan", `{"format":1,"cycle":{"type":"hole"},"x":${deep}}`))[0], 422);
  assert.equal((await post("/check", deep))[0], 200);
  assert.equal((await post("/plan", "{".repeat(200_000)))[0], 400);
  assert.deepEqual(await end(), [0, true]);
});

test("the service answers too many at once with 503, and does not wait for a body that never comes", async () => {
  const own = project("busy", ["fastify"], "service");
  const { address, end } = await service(own, { MOST_AT_ONCE: "2", PATIENCE: "3000" });
  const { hostname, port } = new URL(address);
  // Long answers, one behind the other, of which nothing is read: they wait, and count.
  const body = JSON.stringify(Object.fromEntries(Array.from({ length: 300 }, (_, i) => [`unknown${i}`, i])));
  const request = `POST /check HTTP/1.1\r\nhost: x\r\ncontent-type: application/json\r\ncontent-length: ${Buffer.byteLength(body)}\r\n\r\n${body}`;
  const greedy = connect(Number(port), hostname, () => greedy.write(request.repeat(300))).pause();
  greedy.on("error", () => undefined);
  const plain = () =>
    fetch(`${address}/check`, { method: "POST", body: "{}", headers: { "content-type": "application/json" } });
  let late = await plain();
  for (let i = 0; i < 100 && late.status === 200; i++) {
    await new Promise((done) => setTimeout(done, 50));
    late = await plain();
  }
  assert.deepEqual(
    [late.status, late.headers.get("retry-after"), await late.json()],
    [503, "1", { error: "too many requests at once" }],
  );
  assert.equal((await fetch(`${address}/health`)).status, 200, "who watches it is always answered");
  greedy.destroy();
  // Requests that wait behind each other on connections that break off do not count for ever.
  greedy.destroy();
  for (let i = 0; i < 5; i++)
    await new Promise((done) => {
      const socket = connect(Number(port), hostname, () => {
        const one = "POST /check HTTP/1.1\r\nhost: x\r\ncontent-type: application/json\r\ncontent-length: 2\r\n\r\n{}";
        socket.write(one.repeat(10), () => {
          socket.resetAndDestroy();
          done(null);
        });
      });
      socket.on("error", () => undefined);
    });
  await closed(await halfOpen(address, 2));
  assert.equal((await plain()).status, 200);
  assert.deepEqual(await end(), [0, true]);
});
