// Jobs through a queue: any number of producers and workers, on any number of machines. Needs Valkey or Redis.
//
//     node queue.mjs work                    a worker: one process a core
//     node queue.mjs plan jobs/*.json        sends jobs, and writes each program beside its job
//
// REDIS=redis://host:6379 says where the queue is, CONFIG=shop.json which rules hold. Version and rules are in the queue's name, so that a job is planned by a
// worker that has both. A batch that was answered in the last hour is not planned again.
import { createHash } from "node:crypto";
import { readFile, writeFile } from "node:fs/promises";
import { Queue, QueueEvents, Worker } from "bullmq";
import { Redis } from "ioredis";
import { JobError, plan, version } from "touchpath";

/** A worker waits for its queue for as long as that is away. */
const connection = new Redis(process.env.REDIS ?? "redis://127.0.0.1:6379", {
  maxRetriesPerRequest: null,
});
/** The rules of the shop, the same for all workers. */
const config = process.env.CONFIG
  ? JSON.parse(await readFile(process.env.CONFIG, "utf8"))
  : undefined;
const hash = (value) =>
  createHash("sha256").update(JSON.stringify(value)).digest("hex");
const NAME = `touchpath-${hash([version(), config ?? null]).slice(0, 16)}`;
const HOUR = 3600;

/** What a job is answered with. A job with errors is an answer, too: trying it again would find the same. */
function answer(job) {
  try {
    const { program, findings } = plan(job, config);
    return { program: program.text, extension: program.extension, findings };
  } catch (thrown) {
    if (!(thrown instanceof JobError)) throw thrown;
    return { program: null, extension: null, findings: thrown.findings };
  }
}

/** Jobs in a message: sending a job costs several times as much as planning it. */
const BATCH = 64;
/** Batches under way at a time. More would only need more memory and connections. */
const WINDOW = 16;

function work() {
  const worker = new Worker(NAME, async ({ data }) => data.map(answer), {
    connection,
  });
  worker.on("failed", (batch, why) =>
    console.error(`${batch?.id}: ${why.message}`),
  );
  // What is under way is answered before the process ends.
  for (const signal of ["SIGINT", "SIGTERM"])
    process.once(signal, () => worker.close().then(() => connection.quit()));
}

/** The files in batches, each read when it is sent. */
function* batches(files) {
  for (let i = 0; i < files.length; i += BATCH) yield files.slice(i, i + BATCH);
}

async function send(files) {
  const queue = new Queue(NAME, { connection });
  // Every batch under way listens.
  queue.setMaxListeners(0);
  // Answers are events: none from here on is missed, though the first may come before anything listens.
  const [seconds] = await connection.time();
  const events = new QueueEvents(NAME, {
    connection,
    lastEventId: `${seconds}000-0`,
  });
  events.setMaxListeners(0);
  let good = 0;
  const one = async (names) => {
    // One after the other: open files are few, however many jobs there are.
    const jobs = [];
    for (const file of names)
      jobs.push(JSON.parse(await readFile(file, "utf8")));
    // A batch that is in the queue already is not added again: its answer is that of both.
    const sent = await queue.add("plan", jobs, {
      jobId: hash(jobs),
      attempts: 3,
      removeOnComplete: { age: HOUR },
      removeOnFail: true,
    });
    const answers = await sent.waitUntilFinished(events);
    for (const [i, file] of names.entries()) {
      const { program, extension, findings } = answers[i];
      for (const { level, path, message } of findings)
        if (level === "error") console.error(`${file}: ${path}: ${message}`);
      if (program === null) continue;
      await writeFile(`${file.replace(/\.json$/, "")}.${extension}`, program);
      good++;
    }
  };
  // Each of the window takes the next batch as soon as its last one is answered.
  const rest = batches(files);
  await Promise.all(
    Array.from({ length: WINDOW }, async () => {
      for (const names of rest) await one(names);
    }),
  );
  await Promise.all([queue.close(), events.close()]);
  await connection.quit();
  console.log(`${good} of ${files.length} programs`);
  if (good < files.length) process.exitCode = 1;
}

const [what, ...files] = process.argv.slice(2);
if (what === "work") work();
else if (what === "plan" && files.length > 0) await send(files);
else {
  console.error("usage: queue.mjs work | plan JOB...");
  process.exitCode = 2;
}
