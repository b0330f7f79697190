// What the page asks of the module, and the package does not offer.
import { coded } from "./coded.js";
import { instance, raw } from "./instance.js";
import type { Said } from "./said.js";

/** Why the form cannot show a job, as a sentence that names the path; null where it can. A single value may still be wrong. */
export function misfit(job: unknown): Said | null {
  const { codes, text } = coded(job);
  return instance.call(() => raw.misfit(codes, text));
}
