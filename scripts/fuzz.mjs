// The laws asked of fresh random jobs until it is stopped (Ctrl-C) or one breaks a law: that job is kept in target/fuzz/.
// FUZZ_JOBS says how many a round; FUZZ_SEED repeats one round.
import { fuzz } from "./lib.mjs";

const jobs = Number(process.env.FUZZ_JOBS ?? 1_000_000);
do fuzz(jobs);
while (!process.env.FUZZ_SEED);
