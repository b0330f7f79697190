// Checks the laws with fresh random jobs until it is stopped (Ctrl-C) or a job breaks a law, which is then stored in target/fuzz/. FUZZ_JOBS: jobs per round.
// FUZZ_SEED repeats one round.
import { fuzz } from "./lib.mjs";

const jobs = Number(process.env.FUZZ_JOBS ?? 1_000_000);
do fuzz(jobs);
while (!process.env.FUZZ_SEED);
