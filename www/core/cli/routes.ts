// Routes of the service that take a job or a text.
import type { Task } from "./tasks.js";

/** Input of a route, and its task. */
export interface Route {
  path: string;
  id: string;
  about: string;
  takes: "job" | "text" | "measured";
  /** Content type of the answer; for JSON the name of its schema. */
  gives: { type: string; schema?: string };
  /** Query parameter that selects a format, and the formats. */
  query?: readonly [string, readonly string[]];
  task: Task;
}

export const JSON_TYPE = "application/json";

export const ROUTES: readonly Route[] = [
  {
    path: "/plan",
    id: "plan",
    about: "The whole plan of a job",
    takes: "job",
    gives: { type: JSON_TYPE, schema: "Plan" },
    task: { command: "plan", whole: true },
  },
  {
    path: "/check",
    id: "check",
    about: "Everything that is wrong, unusual or worth knowing about a job",
    takes: "job",
    gives: { type: JSON_TYPE },
    task: { command: "check" },
  },
  {
    path: "/program",
    id: "program",
    about: "The program of a job",
    takes: "job",
    gives: { type: "text/plain" },
    task: { command: "plan" },
  },
  {
    path: "/table",
    id: "table",
    about: "The parameter table of a job",
    takes: "job",
    gives: { type: JSON_TYPE },
    query: ["format", ["json", "csv", "text"]],
    task: { command: "table", format: "json" },
  },
  {
    path: "/svg",
    id: "svg",
    about: "The picture of a job",
    takes: "job",
    gives: { type: "image/svg+xml" },
    query: ["view", ["isometric", "top", "front", "side"]],
    task: { command: "svg" },
  },
  {
    path: "/evaluate",
    id: "evaluate",
    about: "The results from what a machine printed",
    takes: "measured",
    gives: { type: JSON_TYPE },
    task: { command: "evaluate", format: "json" },
  },
  {
    path: "/import",
    id: "importJob",
    about: "A job from a dump or a program",
    takes: "text",
    gives: { type: JSON_TYPE, schema: "Job" },
    task: { command: "import" },
  },
  {
    path: "/moves",
    id: "moves",
    about: "The moves of any program",
    takes: "text",
    gives: { type: JSON_TYPE },
    task: { command: "moves", format: "json" },
  },
];
