// What differs between two programs, line by line.
import { diffArrays } from "diff";

/** A line of either program: of both (` `), of the earlier or other one only (`-`), of the present one only (`+`). */
export interface Compared {
  sign: " " | "-" | "+";
  text: string;
  /** The 0-based line of the present program; null for one that is not in it. */
  line: number | null;
}

const linesOf = (text: string) => text.replace(/\n$/, "").split("\n");

/** The lines of both programs in their order. */
export function compare(other: string, present: string): Compared[] {
  let line = 0;
  return diffArrays(linesOf(other), linesOf(present)).flatMap(({ value, added, removed }) =>
    value.map((text): Compared => ({ sign: added ? "+" : removed ? "-" : " ", text, line: removed ? null : line++ })),
  );
}
