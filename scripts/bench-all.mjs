// Runs the benchmarks one after the other. `--against` compares this build with earlier versions instead and fails if it is slower than its limits.
import { at, run } from "./lib.mjs";

const names = process.argv.includes("--against")
  ? ["against"]
  : ["plan", "many", "page", "first"];
for (const name of names) run("node", [at("scripts", `bench-${name}.mjs`)]);
