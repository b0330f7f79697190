// The native calls of an opened program as one job.
import type { Job, ProgramRun, SetUp } from "./core/types.js";

/** Everything in a job that its cycles share. It writes no work offset: each call of a program may write another one. */
const shared = ({ name: _name, cycle: _cycle, ...rest }: Job) => ({
  ...rest,
  control: { ...rest.control, workOffset: null },
});

/**
 * A job with all calls that are documented cycles, in their order. Null for fewer than two such calls, or if they need different probes, feeds or controls.
 * Null also if the program changes its coordinate system: a job has one system, and positions of two systems must not be mixed in it.
 */
export function jobOfCalls({ calls, systems }: ProgramRun): SetUp | null {
  if (systems.length > 0) return null;
  const jobs = calls.flatMap(({ job }) => (job ? [job] : []));
  const [first, ...others] = jobs;
  if (!first || others.length === 0) return null;
  const same = JSON.stringify(shared(first));
  if (others.some((job) => JSON.stringify(shared(job)) !== same)) return null;
  return {
    ...shared(first),
    format: 2,
    cycles: jobs.map(({ cycle }) => cycle) as SetUp["cycles"],
  };
}
