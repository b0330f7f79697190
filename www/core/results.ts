// Words for results, the same in every list.
import type { Plan, ResultRow } from "./plan-types.js";

/** The code of a result; where there are several cycles, or relations, behind the name of its own: `BORE.diameter`. */
export const codeOf = (
  { cycles, relations }: Pick<Plan, "cycles" | "relations">,
  cycle: number,
  code: string,
): string =>
  cycles.length + relations.length > 1
    ? `${cycles[cycle] ?? relations[cycle - cycles.length]}.${code}`
    : code;

/** Whether it says what a program writes, and nothing of the part. */
export const isWritten = ({ code }: Pick<ResultRow, "code">): boolean =>
  code.startsWith("offset.");

/** Whether no good part has this verdict. */
export const isBad = (verdict: string | null): boolean =>
  /^(out|rework|scrap|implausible|not measured)/.test(verdict ?? "");
