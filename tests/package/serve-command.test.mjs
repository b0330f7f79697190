// `touchpath serve`: answers, refusals, and shutdown.
import assert from "node:assert/strict";
import { spawn, spawnSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { connect } from "node:net";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { after, test } from "node:test";
import { Ajv2020 } from "ajv/dist/2020.js";
import {
  check,
  defaultJob,
  exportTable,
  measure,
  plan,
  program,
  svg,
  version,
} from "touchpath";
import { at } from "../../scripts/lib.mjs";

/** The services that run: a test that fails leaves none behind. @type {Set<import("node:child_process").ChildProcess>} */
const running = new Set();
after(() => {
  for (const child of running) child.kill("SIGKILL");
});

/** Starts the service; gives its address and how to end it. */
async function service(/** @type {string[]} */ ...options) {
  const args = options.includes("--port")
    ? options
    : ["--port", "0", ...options];
  const child = spawn("node", [
    at("dist", "cli", "touchpath.js"),
    "serve",
    ...args,
  ]);
  running.add(child);
  let said = "";
  child.stderr.on("data", (chunk) => {
    said += chunk;
  });
  const address = await new Promise((done, fail) => {
    child.stdout.on("data", (chunk) => {
      said += chunk;
      const [, found] = /at (http:\S+)/.exec(said) ?? [];
      if (found) done(found);
    });
    child.on("exit", (status) =>
      fail(new Error(`the service ended with ${status}: ${said}`)),
    );
  });
  const end = () =>
    new Promise((done) => {
      child.once("exit", (status) => done([status, said.includes("closed")]));
      child.kill("SIGTERM");
    });
  return { address: String(address), end, said: () => said };
}

/** Posts a text. */
async function post(
  /** @type {string} */ address,
  /** @type {string} */ body,
  type = "application/json",
  headers = {},
) {
  const answer = await fetch(address, {
    method: "POST",
    body,
    headers: { "content-type": type, ...headers },
  });
  const text = await answer.text();
  const json = () => JSON.parse(text);
  return { status: answer.status, headers: answer.headers, text, json };
}

const HOLE = /** @type {import("touchpath").Job & Record<string, any>} */ ({
  format: 1,
  name: "BORE",
  cycle: { type: "hole", diameter: 32 },
});

test("every route answers as the function of the package does", async () => {
  const { address, end } = await service("--jobs", "2");
  const job = defaultJob("groove");
  const text = JSON.stringify(job);
  const planned = await post(`${address}/plan`, text);
  assert.deepEqual(
    [planned.status, planned.json()],
    [200, JSON.parse(JSON.stringify(plan(job)))],
  );
  assert.equal(
    (await post(`${address}/program`, text)).text,
    program(job).text,
  );
  assert.equal(
    (await post(`${address}/svg?view=top`, text)).text,
    svg(job, "top"),
  );
  assert.equal(
    (await post(`${address}/table?format=csv`, text)).text,
    exportTable(job, "csv"),
  );
  assert.equal(
    (await post(`${address}/table`, text)).text,
    exportTable(job, "json"),
  );
  const wrong = { ...job, cycle: { ...job.cycle, width: -1 } };
  assert.deepEqual(
    (await post(`${address}/check`, JSON.stringify(wrong))).json(),
    check(wrong),
  );
  const refused = await post(`${address}/plan`, JSON.stringify(wrong));
  assert.deepEqual(
    [refused.status, refused.json().findings],
    [422, check(wrong)],
  );
  const measured =
    "center.x=0.02\ncenter.y=-0.01\ndiameter=32.03\nresidual=0.002";
  const results = await post(
    `${address}/evaluate`,
    JSON.stringify({ job: HOLE, measured }),
  );
  assert.deepEqual(
    results.json(),
    JSON.parse(JSON.stringify(measure(HOLE, measured).results)),
  );
  const read = await post(`${address}/import`, program(job).text, "text/plain");
  assert.equal(read.json().cycle.type, "groove");
  const moves = await post(
    `${address}/moves`,
    "G21 G90\nG0 X1 Y2 Z3\nG38.2 Z-5 F50\n",
    "text/plain",
  );
  assert.deepEqual(
    moves.json().moves.map((/** @type {any} */ move) => [move.line, move.to]),
    [
      [2, [1, 2, 3]],
      [3, [1, 2, -5]],
    ],
  );
  // A job per line, in order, with a bad one among them.
  const lines = [
    HOLE,
    { ...HOLE, cycle: { type: "hole", diameter: -1 } },
    job,
  ].map((one) => JSON.stringify(one));
  const many = await post(
    `${address}/programs`,
    `${lines.join("\n")}\n{\n`,
    "application/x-ndjson",
  );
  const answers = many.text
    .trimEnd()
    .split("\n")
    .map((line) => JSON.parse(line));
  assert.deepEqual(
    answers.map(({ line, program: text, findings }) => [
      line,
      text !== null,
      findings[0]?.level === "error",
    ]),
    [
      [1, true, false],
      [2, false, true],
      [3, true, false],
      [4, false, true],
    ],
  );
  assert.equal(answers[2].program, program(job).text);
  assert.deepEqual(await end(), [0, true]);
});

test("what is no request of a route is refused with its reason, and a name of the request", async () => {
  const { address, end, said } = await service(
    "--jobs",
    "1",
    "--limit",
    "body=100000",
  );
  for (const [
    path,
    body,
    type,
    status,
  ] of /** @type {[string, string, string, number][]} */ ([
    ["/plan", "{", "application/json", 400],
    ["/plan", "", "application/json", 400],
    ["/plan", "null", "application/json", 422],
    ["/plan", "7", "application/json", 422],
    ["/plan", '{"__proto__":{"x":1}}', "application/json", 422],
    ["/plan", "x".repeat(200_000), "application/json", 413],
    ["/plan", "a=b", "application/x-www-form-urlencoded", 415],
    ["/svg?view=inside", JSON.stringify(HOLE), "application/json", 400],
    ["/evaluate", JSON.stringify({ job: HOLE }), "application/json", 400],
    ["/import", "{}", "application/json", 415],
    ["/import", "hello", "text/plain", 422],
    ["/nothing", "{}", "application/json", 404],
  ])) {
    const answer = await post(address + path, body, type, {
      "x-request-id": "shop-7",
    });
    assert.equal(
      answer.status,
      status,
      `${path} ${body.slice(0, 20)}: ${answer.text}`,
    );
    assert.equal(typeof answer.json().error, "string");
    assert.equal(answer.headers.get("x-request-id"), "shop-7");
  }
  const deep = `${'{"a":'.repeat(15_000)}1${"}".repeat(15_000)}`;
  assert.equal((await post(`${address}/plan`, deep)).status, 422);
  assert.equal(
    (await post(`${address}/import`, deep, "text/plain")).status,
    422,
  );
  const own = await post(`${address}/check`, "{}");
  assert.match(own.headers.get("x-request-id") ?? "", /^[0-9a-f-]{36}$/);
  // An invalid id is not returned.
  const odd = await post(`${address}/check`, "{}", "application/json", {
    "x-request-id": "a b<script>",
  });
  assert.match(odd.headers.get("x-request-id") ?? "", /^[0-9a-f-]{36}$/);
  assert.doesNotMatch(said(), /should not have happened|Error/);
  const lines = (await (await fetch(`${address}/metrics`)).text()).split("\n");
  assert.ok(
    lines.includes('touchpath_requests_total{route="/plan",status="413"} 1'),
    lines.join("\n"),
  );
  assert.ok(
    lines.includes('touchpath_requests_total{route="other",status="404"} 1'),
  );
  assert.ok(lines.includes("touchpath_threads 1"));
  for (const line of lines.filter((one) => one !== "" && !one.startsWith("#")))
    assert.match(
      line,
      /^[a-z_]+(\{[a-z]+="[^"]*"(,[a-z]+="[^"]*")*\})? [0-9.e+]+$/,
    );
  assert.deepEqual(await end(), [0, true]);
});

test("an answer is known again by its tag: 304 without a plan, 412 to a POST", async () => {
  const { address, end } = await service("--jobs", "1");
  const ask = (
    /** @type {string} */ path,
    /** @type {HeadersInit} */ headers = {},
  ) => fetch(address + path, { headers });
  const of = (/** @type {unknown} */ job) =>
    `?job=${encodeURIComponent(JSON.stringify(job))}`;
  const first = await ask(`/program${of(HOLE)}`);
  assert.equal(await first.text(), program(HOLE).text);
  const tag = first.headers.get("etag") ?? "";
  assert.match(tag, /^"[\w-]{43}"$/);
  assert.equal(first.headers.get("cache-control"), "no-cache");
  const again = await ask(`/program${of(HOLE)}`, {
    "if-none-match": `"other", ${tag}`,
  });
  assert.deepEqual([again.status, await again.text()], [304, ""]);
  assert.equal(
    (
      await ask(`/program${of({ ...HOLE, name: "B" })}`, {
        "if-none-match": tag,
      })
    ).status,
    200,
  );
  assert.equal(
    (await ask(`/plan${of(HOLE)}`, { "if-none-match": tag })).status,
    200,
    "of another route",
  );
  const known = await post(
    `${address}/program`,
    JSON.stringify(HOLE),
    "application/json",
    { "if-none-match": tag },
  );
  assert.deepEqual([known.status, known.headers.get("etag")], [412, tag]);
  const views = await Promise.all(
    ["top", "side"].map((view) => ask(`/svg${of(HOLE)}&view=${view}`)),
  );
  assert.notEqual(views[0]?.headers.get("etag"), views[1]?.headers.get("etag"));
  const catalog = await ask("/catalog");
  assert.equal(
    (
      await ask("/catalog", {
        "if-none-match": catalog.headers.get("etag") ?? "",
      })
    ).status,
    304,
  );
  assert.deepEqual(await end(), [0, true]);
});

test("under a path with version and rules an answer is kept for ever, and another version is refused", async () => {
  const { address, end } = await service("--no-config");
  const query = `?job=${encodeURIComponent(JSON.stringify(HOLE))}`;
  const health = await (await fetch(`${address}/health`)).json();
  assert.equal(health.path, `/v/${version()}`);
  const kept = await fetch(`${address}${health.path}/program${query}`);
  assert.equal(await kept.text(), program(HOLE).text);
  assert.equal(
    kept.headers.get("cache-control"),
    "public, max-age=31536000, immutable",
  );
  const plain = await fetch(`${address}/program${query}`);
  assert.equal(plain.headers.get("cache-control"), "no-cache");
  const other = await fetch(`${address}/v/0.0.1/program${query}`);
  assert.equal(other.status, 404);
  assert.equal(
    other.headers.get("cache-control"),
    "no-store",
    "the next version has this path",
  );
  assert.match((await other.json()).error, /this service answers at \/v\//);
  const bad = await fetch(`${address}${health.path}/program?job={}`);
  assert.deepEqual(
    [bad.status, bad.headers.get("cache-control")],
    [422, "no-cache"],
  );
  await end();
  // Other rules are another path.
  const folder = mkdtempSync(join(tmpdir(), "touchpath-edition-"));
  const file = join(folder, "shop.json");
  writeFileSync(file, '{"format":1,"title":"Shop"}');
  const ruled = await service("--config", file);
  const { path } = await (await fetch(`${ruled.address}/health`)).json();
  assert.match(path, new RegExp(`^/v/${version()}-[0-9a-f]{12}$`));
  await ruled.end();
  rmSync(folder, { recursive: true });
});

test("pages of named origins may read the answers, and a function of the user's decides who is answered", async () => {
  const folder = mkdtempSync(join(tmpdir(), "touchpath-authorize-"));
  const file = join(folder, "who.mjs");
  writeFileSync(
    file,
    'export default ({ method, path, headers }) => headers.authorization === "Bearer secret" && method === "POST" && path === "/program";',
  );
  const { address, end } = await service(
    "--no-config",
    "--origin",
    "https://portal.example",
    "--authorize",
    file,
  );
  const ask = (
    /** @type {Record<string, string>} */ headers,
    path = "/program",
  ) =>
    fetch(`${address}${path}`, {
      method: "POST",
      headers: { "content-type": "application/json", ...headers },
      body: JSON.stringify(HOLE),
    });
  const origin = "https://portal.example";
  const good = await ask({ authorization: "Bearer secret", origin });
  assert.equal(good.status, 200);
  assert.equal(good.headers.get("access-control-allow-origin"), origin);
  const stranger = await ask({
    authorization: "Bearer secret",
    origin: "https://evil.example",
  });
  assert.equal(stranger.headers.get("access-control-allow-origin"), null);
  const nobody = await ask({ origin });
  assert.equal(nobody.status, 401);
  assert.match((await nobody.json()).error, /not authorised/);
  assert.equal(
    nobody.headers.get("access-control-allow-origin"),
    origin,
    "the page can read why",
  );
  assert.equal(
    (await ask({ authorization: "Bearer secret" }, "/plan")).status,
    401,
  );
  // No shared cache may hand such an answer to others.
  writeFileSync(
    file,
    'export default ({ headers }) => headers.authorization === "Bearer secret";',
  );
  const shared = await service("--no-config", "--authorize", file);
  const kept = await fetch(
    `${shared.address}/v/${version()}/program?job=${JSON.stringify(HOLE)}`,
    { headers: { authorization: "Bearer secret" } },
  );
  assert.equal(
    kept.headers.get("cache-control"),
    "private, max-age=31536000, immutable",
  );
  await shared.end();
  // The browser asks before it sends a job.
  const before = await fetch(`${address}/program`, {
    method: "OPTIONS",
    headers: { origin, "access-control-request-method": "POST" },
  });
  assert.equal(before.status, 204);
  assert.equal((await fetch(`${address}/health`)).status, 200);
  await end();
  for (const options of [
    ["--origin", "portal.example"],
    ["--origin", "https://portal.example/path"],
    ["--authorize", join(folder, "missing.mjs")],
  ])
    await assert.rejects(service("--no-config", ...options), /ended with 2/);
  rmSync(folder, { recursive: true });
});

test("it describes itself, and what it answers is as described", async () => {
  const { address, end } = await service("--jobs", "1");
  const api = await (await fetch(`${address}/openapi.json`)).json();
  const { Job: ofJob, ...schemas } = /** @type {any} */ (api).components
    .schemas;
  const valid = new Ajv2020({ strict: false }).compile(ofJob);
  assert.ok(
    valid(HOLE) && !valid({ ...HOLE, cycle: { type: "hole", diameter: -1 } }),
  );
  const answered = new Ajv2020({ strict: false }).addSchema({
    ...ofJob,
    $id: "urn:touchpath:job:1",
  });
  const isPlan = answered.compile({
    $ref: "#/components/schemas/Plan",
    components: { schemas: { ...schemas, Job: {} } },
  });
  const { example } =
    api.paths["/plan"].post.requestBody.content["application/json"];
  const planned = /** @type {any} */ (
    (await post(`${address}/plan`, JSON.stringify(example))).json()
  );
  const other = { ...planned, moves: {} };
  assert.ok(isPlan(planned) && !isPlan(other));
  const operations = Object.values(api.paths).flatMap(
    (/** @type {any} */ path) => Object.values(path),
  );
  const ids = operations.map((/** @type {any} */ one) => one.operationId);
  assert.equal(new Set(ids).size, ids.length);
  // Every route that it names is there, and every example is taken.
  for (const [path, methods] of /** @type {[string, any][]} */ (
    Object.entries(api.paths)
  )) {
    if (methods.post && path !== "/programs") {
      const [type = ""] = Object.keys(methods.post.requestBody.content);
      const { example = "G0 X1" } = methods.post.requestBody.content[type];
      const body =
        typeof example === "string" ? example : JSON.stringify(example);
      const answer = await post(address + path, body, type);
      assert.ok(
        [200, 422].includes(answer.status),
        `${path}: ${answer.status} ${answer.text.slice(0, 200)}`,
      );
      assert.equal(
        answer.status === 422,
        path === "/import",
        `${path}: ${answer.text.slice(0, 200)}`,
      );
    }
    if (methods.get && !methods.post) {
      const own = path.replace("{edition}", version());
      const query = own === path ? "" : `?job=${JSON.stringify(example)}`;
      assert.equal((await fetch(address + own + query)).status, 200, path);
    }
  }
  assert.deepEqual(await (await fetch(`${address}/health`)).json(), {
    good: true,
    version: version(),
    path: `/v/${version()}`,
  });
  assert.deepEqual(await end(), [0, true]);
});

test("clients that leave, that are slow, that ask in other ways", async () => {
  const { address, end, said } = await service(
    "--jobs",
    "2",
    "--limit",
    "wait=1000",
  );
  const { hostname, port } = new URL(address);
  const ndjson =
    "POST /programs HTTP/1.1\r\nhost: x\r\ncontent-type: application/x-ndjson\r\ntransfer-encoding: chunked\r\n\r\n";
  const slow = {
    ...HOLE,
    cycle: {
      ...HOLE.cycle,
      variant: 1,
      angularStep: 20,
      stepCount: 16,
      repeat: { times: 3 },
    },
  };
  const lines = `${JSON.stringify(slow)}\n`.repeat(256);
  // As many as the threads accept in parallel, then the client disconnects.
  for (const after of [5, 60, 150])
    await new Promise((done) => {
      const socket = connect(Number(port), hostname, () => {
        socket.write(
          `${ndjson}${Buffer.byteLength(lines).toString(16)}\r\n${lines}\r\n`,
        );
        setTimeout(() => done(socket.destroy()), after);
      });
      socket.on("error", () => undefined);
    });
  // Until the threads have noticed: a loaded machine takes its time.
  for (let free = false; !free; ) {
    const start = performance.now();
    const { status } = await fetch(
      `${address}/plan?job=${encodeURIComponent(JSON.stringify(HOLE))}`,
    );
    free = status === 200 && performance.now() - start < 300;
  }
  // Jobs that arrive one by one, for longer than a request may take.
  const answered = await new Promise((done) => {
    let text = "";
    const socket = connect(Number(port), hostname, async () => {
      socket.write(ndjson);
      const line = `${JSON.stringify(HOLE)}\n`;
      for (let i = 0; i < 6; i++) {
        socket.write(`${Buffer.byteLength(line).toString(16)}\r\n${line}\r\n`);
        await new Promise((next) => setTimeout(next, 300));
      }
      socket.end("0\r\n\r\n");
    });
    socket.on("data", (chunk) => {
      text += chunk;
    });
    socket.on("close", () => done(text));
  });
  assert.deepEqual(
    [...String(answered).matchAll(/"line":(\d+)/g)].map(([, line]) =>
      Number(line),
    ),
    [1, 2, 3, 4, 5, 6],
  );
  // Half a body, then a disconnect: no error of the service.
  const half = connect(Number(port), hostname, () => {
    half.write(
      "POST /plan HTTP/1.1\r\nhost: x\r\ncontent-type: application/json\r\ncontent-length: 100\r\n\r\n{",
    );
    setTimeout(() => half.destroy(), 50);
  });
  await closed([half]);
  const of = `?job=${encodeURIComponent(JSON.stringify(HOLE))}`;
  const tag = (await fetch(`${address}/plan${of}`)).headers.get("etag") ?? "";
  const headers = { "if-none-match": `W/${tag}` };
  const states = await Promise.all([
    fetch(`${address}/plan${of}`, { headers }),
    fetch(`${address}/plan${of}`, { headers, method: "HEAD" }),
    fetch(`${address}/plan`, { method: "DELETE" }),
    fetch(`${address}/programs`),
    fetch(`${address}/programs`, {
      method: "POST",
      body: "{}",
      headers: { "content-type": "text/plain" },
    }),
    fetch(`${address}/plan`),
    fetch(`${address}/plan`, {
      method: "POST",
      body: "{}",
      headers: {
        "content-type": "application/json",
        "content-encoding": "gzip",
      },
    }),
  ]);
  assert.deepEqual(
    states.map(({ status }) => status),
    [304, 304, 405, 405, 415, 400, 415],
  );
  assert.equal(states[2]?.headers.get("allow"), "GET, HEAD, POST");
  const bad = `?job=${encodeURIComponent('{"format":1}')}`;
  assert.equal(
    (await fetch(`${address}/plan${bad}`)).headers.get("etag"),
    null,
    "what is refused has no tag",
  );
  assert.doesNotMatch(said(), /Error|should not/);
  assert.deepEqual(await end(), [0, true]);
});

test("it ends well from the first moment on, and says why it cannot begin", async () => {
  for (const after of [0, 20, 100]) {
    const { end } = await service("--jobs", "2");
    await new Promise((done) => setTimeout(done, after));
    assert.deepEqual(await end(), [0, true], `after ${after} ms`);
  }
  const { address, end } = await service("--jobs", "1");
  const { port } = new URL(address);
  await assert.rejects(
    service("--port", port),
    /ended with 2.*touchpath: 127\.0\.0\.1:\d+ cannot be listened at/s,
  );
  await assert.rejects(
    service("--host", "no.such.host.invalid"),
    /ended with 2.*cannot be listened at/s,
  );
  await assert.rejects(service("--limit", "wait=5=6"), /ended with 2/);
  assert.deepEqual(await end(), [0, true]);
});

test("jobs are judged by the rules of a file, and wrong rules or options end it before it begins", async () => {
  const folder = mkdtempSync(join(tmpdir(), "touchpath-serve-"));
  const file = (/** @type {string} */ name, /** @type {unknown} */ config) => {
    writeFileSync(join(folder, name), JSON.stringify(config));
    return join(folder, name);
  };
  const shop = file("shop.json", {
    format: 1,
    title: "Hall 3",
    allow: { controls: ["haas"] },
    fields: { "feeds.work": { max: 100 } },
  });
  await assert.rejects(
    service("--config", file("wrong.json", { format: 1, tilte: "x" })),
    /ended with 2.*tilte/s,
  );
  await assert.rejects(service("--port", "70000"), /ended with 2.*0 to 65535/s);
  await assert.rejects(
    service("--limit", "bodi=3"),
    /ended with 2.*Did you mean body/s,
  );
  await assert.rejects(service("--post", "haas"), /ended with 2/);
  const { address, end } = await service("--config", shop, "--jobs", "1");
  const hole = { format: 1, cycle: { type: "hole" }, feeds: { work: 90 } };
  const good = await post(`${address}/plan`, JSON.stringify(hole));
  assert.equal(good.json().program.post, "haas");
  const bad = await post(
    `${address}/plan`,
    JSON.stringify({
      ...hole,
      control: { post: "fanuc" },
      feeds: { work: 101 },
    }),
  );
  const errors = bad
    .json()
    .findings.filter((/** @type {any} */ f) => f.level === "error");
  assert.deepEqual(
    [bad.status, errors.map((/** @type {any} */ f) => `${f.code} ${f.path}`)],
    [422, ["not-allowed control.post", "not-allowed feeds.work"]],
  );
  assert.deepEqual(await end(), [0, true]);
});

/** Opens connections and starts a request on each that never continues. */
async function halfOpen(
  /** @type {string} */ address,
  /** @type {number} */ count,
  begun = "content-length: 100\r\n\r\n{",
) {
  const { hostname, port } = new URL(address);
  const sockets = Array.from({ length: count }, () => {
    const socket = connect(Number(port), hostname, () =>
      socket.write(
        `POST /plan HTTP/1.1\r\nhost: x\r\ncontent-type: application/json\r\n${begun}`,
      ),
    );
    // Reads the answer, and with it the end of the connection.
    return socket.on("error", () => undefined).resume();
  });
  const either = (/** @type {import("node:net").Socket} */ socket) =>
    new Promise((done) =>
      ["connect", "close"].map((event) => socket.once(event, done)),
    );
  await Promise.all(sockets.map(either));
  await new Promise((done) => setTimeout(done, 200));
  return sockets;
}

/** When every one of them is closed, also by a fault. */
const closed = (/** @type {import("node:net").Socket[]} */ sockets) =>
  Promise.all(
    sockets.map(
      (socket) =>
        socket.destroyed || new Promise((done) => socket.once("close", done)),
    ),
  );

test("requests whose bodies never come block no other, and are closed", async () => {
  const { address, end } = await service(
    "--limit",
    "wait=2000",
    "--limit",
    "connections=300",
  );
  const planned = async () =>
    (await post(`${address}/plan`, JSON.stringify(HOLE))).status;
  const begun = Date.now();
  const sockets = [
    ...(await halfOpen(address, 100)),
    ...(await halfOpen(address, 50, "x-more: ")),
    ...(await halfOpen(address, 50, "transfer-encoding: chunked\r\n\r\n1")),
  ];
  assert.equal(await planned(), 200);
  await closed(sockets);
  assert.ok(Date.now() - begun < 10_000, `${Date.now() - begun} ms`);
  // Connections beyond the limit are closed, and later there is room again.
  await closed(await halfOpen(address, 320));
  assert.equal(await planned(), 200);
  assert.deepEqual(await end(), [0, true]);
});

test("too many at once are answered with 503, and connections that break off do not count for ever", async () => {
  const { address, end } = await service(
    "--limit",
    "requests=2",
    "--limit",
    "wait=3000",
    "--jobs",
    "1",
  );
  const { hostname, port } = new URL(address);
  // Long answers, one after the other, that nobody reads: they wait, and count.
  const body = JSON.stringify(
    Object.fromEntries(
      Array.from({ length: 300 }, (_, i) => [`unknown${i}`, i]),
    ),
  );
  const request = `POST /check HTTP/1.1\r\nhost: x\r\ncontent-type: application/json\r\ncontent-length: ${Buffer.byteLength(body)}\r\n\r\n${body}`;
  const greedy = connect(Number(port), hostname, () =>
    greedy.write(request.repeat(300)),
  ).pause();
  greedy.on("error", () => undefined);
  const plain = () => post(`${address}/check`, "{}");
  // Many in parallel, some of which find the service busy.
  let late = await plain();
  for (let i = 0; i < 200 && late.status === 200; i++)
    late =
      (await Promise.all(Array.from({ length: 12 }, plain))).find(
        ({ status }) => status !== 200,
      ) ?? late;
  assert.deepEqual(
    [late.status, late.headers.get("retry-after"), late.json()],
    [503, "1", { error: "too many requests at once" }],
  );
  assert.equal(
    (await fetch(`${address}/health`)).status,
    200,
    "who watches it is always answered",
  );
  greedy.destroy();
  for (let i = 0; i < 5; i++)
    await new Promise((done) => {
      const socket = connect(Number(port), hostname, () => {
        const one =
          "POST /check HTTP/1.1\r\nhost: x\r\ncontent-type: application/json\r\ncontent-length: 2\r\n\r\n{}";
        socket.write(one.repeat(10), () => {
          socket.resetAndDestroy();
          done(null);
        });
      });
      socket.on("error", () => undefined);
    });
  await closed(await halfOpen(address, 2));
  for (let i = 0; i < 50 && (await plain()).status !== 200; i++)
    await new Promise((done) => setTimeout(done, 50));
  assert.equal((await plain()).status, 200);
  assert.deepEqual(await end(), [0, true]);
});

test("at the end what is under way is answered", async () => {
  const { address, end } = await service("--jobs", "2");
  const many = Array.from({ length: 40 }, () =>
    post(`${address}/plan`, JSON.stringify(HOLE)),
  );
  await many[0];
  const ended = end();
  const answers = await Promise.allSettled(many);
  assert.deepEqual(await ended, [0, true]);
  const answered = answers.flatMap((answer) =>
    answer.status === "fulfilled" ? [answer.value.status] : [],
  );
  assert.ok(
    answered.length > 0 &&
      answered.every((status) => [200, 503].includes(status)),
    String(answered),
  );
  await assert.rejects(fetch(`${address}/health`), "it is gone");
});

test("the container runs what the command takes, and its health check asks the service", async () => {
  const file = readFileSync(at("examples", "service", "Containerfile"), "utf8");
  const args = (/** @type {string} */ word) =>
    JSON.parse(new RegExp(`${word} (\\[.*\\])`).exec(file)?.[1] ?? "[]");
  const [name, command, ...options] = args("\\nCMD");
  assert.deepEqual([name, command], ["touchpath", "serve"]);
  const { address, end } = await service(...options, "--jobs", "1");
  const { port } = new URL(address);
  const [node, flag, script] = args("HEALTHCHECK CMD");
  assert.deepEqual([node, flag], ["node", "-e"]);
  const asks = (/** @type {string} */ at) =>
    spawnSync("node", ["-e", script.replace(":3000/", `:${at}/`)]).status;
  let status = asks(port);
  for (let i = 0; i < 20 && status !== 0; i++) status = asks(port);
  assert.equal(status, 0);
  assert.deepEqual(await end(), [0, true]);
  assert.equal(asks(port), 1);
});

test("in Kubernetes it runs what the command takes, with the config of the map, and the probes ask the service", async () => {
  const file = readFileSync(
    at("examples", "kubernetes", "touchpath.yaml"),
    "utf8",
  );
  const words = (/** @type {string} */ key) =>
    new RegExp(`\\b${key}: \\[(.*)\\]`).exec(file)?.[1]?.split(", ") ?? [];
  const [name, command, ...options] = words("args").map((word) =>
    word.replaceAll('"', ""),
  );
  assert.deepEqual([name, command], ["touchpath", "serve"]);
  const config = options.indexOf("--config") + 1;
  assert.match(
    file,
    new RegExp(`mountPath: ${dirname(options[config] ?? "")}\\b`),
  );
  const folder = mkdtempSync(join(tmpdir(), "touchpath-kubernetes-"));
  options[config] = join(folder, "config.json");
  writeFileSync(
    options[config],
    /config\.json: \|\n( {4}.*\n)+/.exec(file)?.[1] ?? "",
  );
  const { address, end } = await service(...options);
  for (const [, path] of file.matchAll(/httpGet: \{ path: (\S+),/g)) {
    let { status } = await fetch(new URL(String(path), address));
    for (let i = 0; i < 50 && status === 503; i++) {
      await new Promise((done) => setTimeout(done, 100));
      ({ status } = await fetch(new URL(String(path), address)));
    }
    assert.equal(status, 200, path);
  }
  assert.deepEqual(await end(), [0, true]);
  rmSync(folder, { recursive: true });
});
