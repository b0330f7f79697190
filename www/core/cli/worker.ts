// One thread of the command: it does a task with a bunch of items, and answers in the order in which it is asked.
import { parentPort } from "node:worker_threads";
import { type Item, perform, type Task } from "./tasks.js";

parentPort?.on("message", ({ task, bunch }: { task: Task; bunch: Item[] }) =>
  parentPort?.postMessage(bunch.map((item) => perform(task, item))),
);
