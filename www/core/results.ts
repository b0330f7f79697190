// Names and kinds of results, the same in every list.
import type { Plan, ResultRow } from "./plan-types.js";

/** Code of a result; with several cycles or relations with the name of its own: `BORE.diameter`. */
export const codeOf = (
  { cycles, relations }: Pick<Plan, "cycles" | "relations">,
  cycle: number,
  code: string,
): string =>
  cycles.length + relations.length > 1
    ? `${cycles[cycle] ?? relations[cycle - cycles.length]}.${code}`
    : code;

/** Whether the result is a written work offset, not a feature of the part. */
export const isWritten = ({ code }: Pick<ResultRow, "code">): boolean =>
  code.startsWith("offset.");

/** Whether the verdict is that of a bad part. */
export const isBad = (verdict: string | null): boolean =>
  /^(out|rework|scrap|implausible|not measured)/.test(verdict ?? "");
