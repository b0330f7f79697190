// Many jobs over several threads: the outcomes come in the order of the jobs, and never more are under way than the threads can use.
import { Worker } from "node:worker_threads";
import { type Item, type Outcome, perform, type Task } from "./tasks.js";

/** So many jobs cross to a thread at once: crossing costs more than a small job. */
const BUNCH = 64;

interface Waiting {
  done(outcomes: Outcome[]): void;
  fail(why: unknown): void;
}

/** A thread, which answers in the order in which it is asked. */
class Thread {
  private readonly worker: Worker;
  private readonly waiting: Waiting[] = [];

  constructor(task: Task) {
    this.worker = new Worker(new URL("./worker.js", import.meta.url), { workerData: task });
    this.worker.on("message", (outcomes: Outcome[]) => this.waiting.shift()?.done(outcomes));
    this.worker.on("error", (why) => {
      for (const { fail } of this.waiting.splice(0)) fail(why);
    });
  }

  ask(bunch: Item[]): Promise<Outcome[]> {
    const answer = new Promise<Outcome[]>((done, fail) => this.waiting.push({ done, fail }));
    // It may fail before anybody waits for it.
    answer.catch(() => undefined);
    this.worker.postMessage(bunch);
    return answer;
  }

  end(): Promise<number> {
    return this.worker.terminate();
  }
}

/** Does the task with every item. */
export async function* performAll(task: Task, items: AsyncIterable<Item>, threads: number): AsyncGenerator<Outcome> {
  if (threads <= 1) {
    for await (const item of items) yield perform(task, item);
    return;
  }
  const pool = Array.from({ length: threads }, () => new Thread(task));
  try {
    /** What was asked and has not been handed on, in order. */
    const under: Promise<Outcome[]>[] = [];
    let turn = 0;
    for await (const bunch of bunches(items)) {
      under.push((pool[turn++ % threads] as Thread).ask(bunch));
      if (under.length >= 2 * threads) yield* await (under.shift() as Promise<Outcome[]>);
    }
    for (const outcomes of under) yield* await outcomes;
  } finally {
    await Promise.all(pool.map((thread) => thread.end()));
  }
}

async function* bunches(items: AsyncIterable<Item>): AsyncGenerator<Item[]> {
  let bunch: Item[] = [];
  for await (const item of items) {
    bunch.push(item);
    if (bunch.length === BUNCH) {
      yield bunch;
      bunch = [];
    }
  }
  if (bunch.length > 0) yield bunch;
}
