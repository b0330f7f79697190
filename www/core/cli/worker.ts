// One thread of the command.
import { parentPort, workerData } from "node:worker_threads";
import { type Item, perform, type Task } from "./tasks.js";

parentPort?.on("message", (bunch: Item[]) =>
  parentPort?.postMessage(bunch.map((item) => perform(workerData as Task, item))),
);
