// Compares two programs line by line.
import { diffArrays } from "diff";

/** A line: of both programs (` `), only of the other one (`-`), only of the current one (`+`). */
export interface Compared {
  sign: " " | "-" | "+";
  text: string;
  /** 0-based line in the current program; null if it is not there. */
  line: number | null;
  /** 0-based line in the other program; null if it is not there. */
  other: number | null;
}

/** A row of the comparison: the line of the other program and that of the current one. */
export type Pair = [Compared | null, Compared | null];

const linesOf = (text: string) => text.replace(/\n$/, "").split("\n");

/** Lines of both programs in order. */
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

/** Both programs side by side. Lines that replace others share their rows. */
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
