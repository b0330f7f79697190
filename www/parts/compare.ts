// What differs between two programs, line by line.
import { diffArrays } from "diff";

/** A line of either program: of both (` `), of the earlier or other one only (`-`), of the present one only (`+`). */
export interface Compared {
  sign: " " | "-" | "+";
  text: string;
  /** The 0-based line of the present program; null for one that is not in it. */
  line: number | null;
  /** The same of the other program. */
  other: number | null;
}

/** A row of the comparison: the line of the other program and the line of the present one. */
export type Pair = [Compared | null, Compared | null];

const linesOf = (text: string) => text.replace(/\n$/, "").split("\n");

/** The lines of both programs in their order. */
export function compare(other: string, present: string): Compared[] {
  let [here, there] = [0, 0];
  return diffArrays(linesOf(other), linesOf(present)).flatMap(
    ({ value, added, removed }) =>
      value.map((text): Compared => {
        const sign = added ? "+" : removed ? "-" : " ";
        return {
          sign,
          text,
          line: removed ? null : here++,
          other: added ? null : there++,
        };
      }),
  );
}

/** Both programs beside each other: lines that replace others share their rows. */
export function beside(lines: Compared[]): Pair[] {
  const pairs: Pair[] = [];
  let [less, more]: [Compared[], Compared[]] = [[], []];
  const put = () => {
    for (let i = 0; i < Math.max(less.length, more.length); i++)
      pairs.push([less[i] ?? null, more[i] ?? null]);
    [less, more] = [[], []];
  };
  for (const line of lines) {
    if (line.sign === "-") less.push(line);
    else if (line.sign === "+") more.push(line);
    else {
      put();
      pairs.push([line, line]);
    }
  }
  put();
  return pairs;
}
