// A thread of the command: performs a task with a batch of items and answers in the order of its requests.
import { parentPort } from "node:worker_threads";
import { type Item, perform, type Task } from "./tasks.js";

parentPort?.on("message", ({ task, bunch }: { task: Task; bunch: Item[] }) =>
  parentPort?.postMessage(bunch.map((item) => perform(task, item))),
);
