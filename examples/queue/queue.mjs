// Jobs through a queue: any number of producers and workers, on any number of machines. Needs Valkey or Redis.
//
//     node queue.mjs work                    a worker: one process a core
//     node queue.mjs plan jobs/*.json        sends jobs, and writes each program beside its job
//
// REDIS=redis://host:6379 says where the queue is, CONFIG=shop.json which rules hold. Version and rules are in the queue's name, so that a job is planned by a
// worker that has both. A job that was answered in the last hour is not planned again.
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

function work() {
  const worker = new Worker(NAME, async ({ data }) => answer(data), {
    connection,
  });
  worker.on("failed", (job, why) =>
    console.error(`${job?.id}: ${why.message}`),
  );
  // What is under way is answered before the process ends.
  for (const signal of ["SIGINT", "SIGTERM"])
    process.once(signal, () => worker.close().then(() => connection.quit()));
}

async function send(files) {
  const queue = new Queue(NAME, { connection });
  // Every job that waits for its answer listens.
  queue.setMaxListeners(0);
  // Answers are events: none from here on is missed, though the first may come before anything listens.
  const [seconds] = await connection.time();
  const events = new QueueEvents(NAME, {
    connection,
    lastEventId: `${seconds}000-0`,
  });
  const one = async (file) => {
    const job = JSON.parse(await readFile(file, "utf8"));
    // A job whose id is in the queue already is not added again: its answer is that of both.
    const sent = await queue.add("plan", job, {
      jobId: hash(job),
      attempts: 3,
      removeOnComplete: { age: HOUR },
      removeOnFail: true,
    });
    const { program, extension, findings } =
      await sent.waitUntilFinished(events);
    for (const { level, path, message } of findings)
      if (level === "error") console.error(`${file}: ${path}: ${message}`);
    if (program !== null)
      await writeFile(`${file.replace(/\.json$/, "")}.${extension}`, program);
    return program !== null;
  };
  const good = await Promise.all(files.map(one));
  await Promise.all([queue.close(), events.close()]);
  await connection.quit();
  console.log(`${good.filter(Boolean).length} of ${files.length} programs`);
  if (good.includes(false)) process.exitCode = 1;
}

const [what, ...files] = process.argv.slice(2);
if (what === "work") work();
else if (what === "plan" && files.length > 0) await send(files);
else {
  console.error("usage: queue.mjs work | plan JOB...");
  process.exitCode = 2;
}
