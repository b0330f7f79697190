// A size that was typed with a tolerance: the program judges by the middle of its zone and a size limit.
import type { Store } from "./store.js";

/** What is said of such a size: its values are the label, the nominal size, the middle of the zone, half its width, and what was typed. */
const SAID = /^\{label\} takes no tolerance: enter \{nominal\} alone/;

/** A size with a tolerance, as numbers in the job's units. */
interface Toleranced {
  middle: string;
  half: string;
  /** As it was typed. */
  text: string;
  /** Takes it, in one step. */
  take: () => void;
}

/** What was typed into the field of a path, where that is a size with a tolerance. */
export function toleranced(store: Store, path: string): Toleranced | null {
  const said = store.at(path).find((f) => SAID.test(f.said[0]))?.said;
  const [, , , middle, half, text] = (said ?? []) as string[];
  if (!middle || !half || !text) return null;
  return {
    middle,
    half,
    text,
    take: () => store.judge(path, Number(middle), Number(half), text),
  };
}
