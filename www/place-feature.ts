// Position and sizes of a feature that is added to a job.
import { type Job, JobError, type Plan, plan } from "./core/browser.js";
import type { CatalogView } from "./entries.js";
import type { Draft } from "./job.js";
import { tidy } from "./number.js";

/** Index of the abscissa in each plane. */
const ABSCISSA: Record<string, number> = { G17: 0, G18: 2, G19: 1 };
/** Clearance to the features before it, in the units of the job. */
const CLEARANCE = { mm: 25, inch: 1 };

/**
 * A new cycle with the sizes of the last one of its type, moved along the abscissa until its path is clear of the present plan. Keeps the catalog's values
 * if the last one has errors.
 */
export function placedBeside(
  job: CatalogView,
  present: Plan,
  fresh: Draft,
  last: Draft = {},
): Draft {
  const fields =
    job.catalog.cycles.find(({ type }) => type === fresh.type)?.fields ?? [];
  const points = fields.filter(({ kind }) => /point$/i.test(kind));
  const { tolerances: _, part: __, ...rest } = job.draft;
  const planAlone = (cycle: Draft) => {
    try {
      return plan({ ...rest, cycle } as unknown as Job);
    } catch (thrown) {
      if (!(thrown instanceof JobError)) throw thrown;
      return null;
    }
  };
  // Fields only: picked touches are positions and would stay where they are.
  const like = { ...fresh };
  for (const { key } of fields)
    if (key in last) like[key] = structuredClone(last[key]);
  // A followed position or rotation would put both features in one position.
  for (const { key } of points)
    like[key] = ((like[key] ?? [0, 0, 0]) as unknown[]).map((x) =>
      typeof x === "number" ? x : 0,
    );
  if (typeof like.rotation === "string") like.rotation = 0;
  const planned = planAlone(like);
  const cycle = planned ? like : structuredClone(fresh);
  const own = planned ?? planAlone(cycle);
  if (!own || present.moves.length === 0) return cycle;
  const axis = ABSCISSA[String(job.get("plane"))] ?? 0;
  const along = (of: Plan) => of.moves.map(({ to }) => to[axis] as number);
  const shift = Math.ceil(
    Math.max(...along(present)) +
      CLEARANCE[job.units] -
      Math.min(...along(own)),
  );
  for (const { key, kind } of points) {
    const point = (cycle[key] ?? [0, 0, 0]) as number[];
    // The position of 1411 is in its plane: the abscissa comes first.
    const at = kind === "nominalPoint" ? 0 : axis;
    point[at] = tidy((point[at] ?? 0) + shift);
    cycle[key] = point;
  }
  return cycle;
}
