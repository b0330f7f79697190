// Many jobs: the command with 100,000 of them, or the number in the first argument, and the service under load next to a server that only returns the JSON.
// Runs locally. Times are wall times; the ratio counts.
import { spawn } from "node:child_process";
import { once } from "node:events";
import {
  mkdirSync,
  mkdtempSync,
  readFileSync,
  rmSync,
  symlinkSync,
  writeFileSync,
} from "node:fs";
import { Agent, request } from "node:http";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { at } from "./lib.mjs";

const { defaultJob } = await import("touchpath");
const types = /** @type {const} */ ([
  "hole",
  "groove",
  "internal-rectangle-protected",
  "double-wall-internal-corner",
]);
const jobs = types.map((type) => JSON.stringify(defaultJob(type)));

/** Resident memory of a process, MB. */
const resident = (/** @type {number | undefined} */ pid) =>
  Number(
    /VmRSS:\s+(\d+)/.exec(readFileSync(`/proc/${pid}/status`, "utf8"))?.[1],
  ) / 1000;

/** Number of jobs for the command, in batches of 100. */
const COUNT =
  Math.max(1, Math.round(Number(process.argv[2] ?? 100_000) / 100)) * 100;

async function command(/** @type {number} */ threads, count = COUNT) {
  const child = spawn(
    "node",
    [
      at("dist", "cli", "touchpath.js"),
      "plan",
      "-",
      "--ndjson",
      "--jobs",
      String(threads),
    ],
    {
      stdio: ["pipe", "pipe", "inherit"],
    },
  );
  const start = performance.now();
  const ended = once(child, "close");
  let lines = 0;
  child.stdout.on("data", (/** @type {Buffer} */ chunk) => {
    for (const byte of chunk) if (byte === 10) lines++;
  });
  const bunch = `${Array.from({ length: 100 }, (_, i) => jobs[i % jobs.length]).join("\n")}\n`;
  const fifths = [0, 0, 0, 0, 0];
  for (let i = 0; i < count / 100; i++) {
    if (!child.stdin.write(bunch)) await once(child.stdin, "drain");
    const fifth = Math.floor((i * 500) / count);
    fifths[fifth] = Math.max(fifths[fifth] ?? 0, resident(child.pid));
  }
  child.stdin.end();
  await ended;
  if (lines !== count) throw new Error(`${lines} of ${count} outcomes`);
  const rate = count / ((performance.now() - start) / 1000);
  console.log(
    `${String(threads).padStart(2)} threads  ${rate.toFixed(0).padStart(6)}   ${fifths.map((mb) => mb.toFixed(0)).join(" ")}`,
  );
}

console.log(
  `\nThe command, ${COUNT.toLocaleString("en")} jobs by the line: jobs a second, and the most memory in each fifth of them, MB`,
);
for (const threads of [1, 2]) await command(threads);

/** Requests per second, the 99th percentile of their times, and the server's memory afterwards. */
async function load(
  /** @type {string[]} */ args,
  path = "/plan",
  count = 4000,
  atOnce = 16,
) {
  const child = spawn("node", args, { stdio: ["ignore", "pipe", "inherit"] });
  const [said] = await once(child.stdout, "data");
  const { hostname, port } = new URL(/http:\S+/.exec(String(said))?.[0] ?? "");
  const agent = new Agent({ keepAlive: true, maxSockets: atOnce });
  const one = (/** @type {string | undefined} */ body) =>
    new Promise((done, fail) => {
      const asked = performance.now();
      const sent = request(
        {
          hostname,
          port,
          path,
          method: "POST",
          agent,
          headers: { "content-type": "application/json" },
        },
        (answer) => {
          answer.resume();
          answer.on("end", () =>
            answer.statusCode === 200
              ? done(performance.now() - asked)
              : fail(new Error(`status ${answer.statusCode}`)),
          );
        },
      );
      sent.on("error", fail);
      sent.end(body);
    });
  const run = async (/** @type {number} */ many) => {
    /** @type {number[]} */
    const times = [];
    let next = 0;
    const start = performance.now();
    await Promise.all(
      Array.from({ length: atOnce }, async () => {
        while (next < many)
          times.push(Number(await one(jobs[next++ % jobs.length])));
      }),
    );
    return {
      rate: many / ((performance.now() - start) / 1000),
      times: times.sort((a, b) => a - b),
    };
  };
  await run(500);
  const { rate, times } = await run(count);
  const memory = resident(child.pid);
  agent.destroy();
  child.kill("SIGTERM");
  await once(child, "exit");
  return {
    rate,
    p99: times[Math.floor(times.length * 0.99)] ?? Number.NaN,
    memory,
  };
}

const folder = mkdtempSync(join(tmpdir(), "touchpath-bench-"));
mkdirSync(join(folder, "node_modules", "@hono"), { recursive: true });
for (const name of ["hono", join("@hono", "node-server")])
  symlinkSync(
    at("node_modules", name),
    join(folder, "node_modules", name),
    "junction",
  );
writeFileSync(
  join(folder, "echo.mjs"),
  `import { serve } from "@hono/node-server";
import { Hono } from "hono";
const app = new Hono();
app.post("/plan", async (c) => c.json(await c.req.json()));
const server = serve({ fetch: app.fetch, port: 0, hostname: "127.0.0.1" }, ({ port }) =>
  console.log("at http://127.0.0.1:" + port),
);
process.once("SIGTERM", () => server.close());
`,
);
const served = [at("dist", "cli", "touchpath.js"), "serve", "--port", "0"];
console.log(
  "\nThe service, 16 at once: requests a second, 99 of 100 within so many ms, memory MB",
);
const echo = await load([join(folder, "echo.mjs")]);
const plans = await load(served);
const checks = await load(served, "/check");
for (const [name, { rate, p99, memory }] of Object.entries({
  "echo of the JSON": echo,
  "POST /check": checks,
  "POST /plan": plans,
}))
  console.log(
    `${name.padEnd(18)} ${rate.toFixed(0).padStart(6)} ${p99.toFixed(1).padStart(7)} ${memory.toFixed(0).padStart(5)}   ${(rate / echo.rate).toFixed(2)} of the echo`,
  );
rmSync(folder, { recursive: true });
