// Runs many jobs on several threads. Outcomes keep the order of the jobs and are returned as soon as possible. The number of pending jobs is bounded.
import { Worker } from "node:worker_threads";
import { type Item, type Outcome, perform, type Task } from "./tasks.js";

/** Batch size: jobs, and characters in total. Passing a message to a thread costs more than a small job. */
const BUNCH = { jobs: 64, characters: 250_000 };

interface Waiting {
  done(outcomes: Outcome[]): void;
  fail(why: Error): void;
}

/** A thread. It answers in the order of its requests. */
export class Thread {
  private readonly worker: Worker;
  private readonly waiting: Waiting[] = [];
  /** Error that ended the thread. */
  private dead: Error | null = null;

  constructor() {
    this.worker = new Worker(new URL("./worker.js", import.meta.url));
    this.worker.on("message", (outcomes: Outcome[]) =>
      this.waiting.shift()?.done(outcomes),
    );
    this.worker.on("error", (why) =>
      this.die(why instanceof Error ? why : new Error(String(why))),
    );
    this.worker.on("exit", () => this.die(new Error("A thread has ended")));
  }

  ask(task: Task, bunch: Item[]): Promise<Outcome[]> {
    const answer = new Promise<Outcome[]>((done, fail) => {
      if (this.dead) fail(this.dead);
      else this.waiting.push({ done, fail });
    });
    // The promise may be rejected before it is awaited.
    answer.catch(() => undefined);
    if (!this.dead) this.worker.postMessage({ task, bunch });
    return answer;
  }

  end(): Promise<number> {
    return this.worker.terminate();
  }

  private die(why: Error): void {
    this.dead ??= why;
    for (const { fail } of this.waiting.splice(0)) fail(this.dead);
  }
}

/** Workers, and how many batches they run in parallel. */
export interface Workers {
  readonly width: number;
  ask(task: Task, bunch: Item[]): Promise<Outcome[]>;
}

/** Performs the task with every item on this many threads. */
export async function* performAll(
  task: Task,
  items: AsyncIterable<Item>,
  threads: number,
): AsyncGenerator<Outcome> {
  if (threads <= 1) {
    for await (const item of items) yield perform(task, item);
    return;
  }
  const pool = Array.from({ length: threads }, () => new Thread());
  let turn = 0;
  const ask = (task: Task, bunch: Item[]) =>
    (pool[turn++ % threads] as Thread).ask(task, bunch);
  try {
    yield* performOn({ width: threads, ask }, task, items);
  } finally {
    await Promise.all(pool.map((thread) => thread.end()));
  }
}

/** Performs the task with every item. If reading fails, pending outcomes are returned before the error. */
export async function* performOn(
  workers: Workers,
  task: Task,
  items: AsyncIterable<Item>,
): AsyncGenerator<Outcome> {
  const source = bunches(items);
  let next: Promise<IteratorResult<Item[]>> | null = started(source.next());
  /** Pending requests, in order. */
  const under: Promise<Outcome[]>[] = [];
  let failed: { why: unknown } | null = null;
  while (next || under.length > 0) {
    const [head] = under;
    const settled = (promise: Promise<unknown>, name: string) =>
      promise.then(
        () => name,
        () => name,
      );
    const full = under.length >= 2 * workers.width;
    const first: string = await Promise.race([
      ...(head ? [settled(head, "head")] : []),
      ...(next && !full ? [settled(next, "next")] : []),
    ]);
    if (first === "head") yield* await (under.shift() as Promise<Outcome[]>);
    else
      try {
        const { value, done } = await (next as Promise<IteratorResult<Item[]>>);
        if (!done) under.push(started(workers.ask(task, value)));
        next = done ? null : started(source.next());
      } catch (why) {
        failed = { why };
        next = null;
      }
  }
  if (failed) throw failed.why;
}

/** A promise that is awaited later. Until then its rejection is not an unhandled one. */
function started<T>(promise: Promise<T>): Promise<T> {
  promise.catch(() => undefined);
  return promise;
}

/** Batches of items; a batch ends early if the next item is not available yet. */
async function* bunches(items: AsyncIterable<Item>): AsyncGenerator<Item[]> {
  const source = items[Symbol.asyncIterator]();
  let bunch: Item[] = [];
  let characters = 0;
  const take = () => {
    const taken = bunch;
    bunch = [];
    characters = 0;
    return taken;
  };
  let next = source.next();
  // Awaited below in every case.
  next.catch(() => undefined);
  for (;;) {
    if (bunch.length > 0) {
      const soon = new Promise<"wait">((done) =>
        setImmediate(() => done("wait")),
      );
      const there = await Promise.race([
        next.then(
          () => "there",
          () => "there",
        ),
        soon,
      ]);
      if (there === "wait") yield take();
    }
    let result: IteratorResult<Item>;
    try {
      result = await next;
    } catch (why) {
      if (bunch.length > 0) yield take();
      throw why;
    }
    if (result.done) break;
    bunch.push(result.value);
    characters += result.value.text.length;
    if (bunch.length === BUNCH.jobs || characters >= BUNCH.characters)
      yield take();
    next = source.next();
    next.catch(() => undefined);
  }
  if (bunch.length > 0) yield take();
}
