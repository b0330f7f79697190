// Position of a finding in the text of a job.
import { type Node, parseTree } from "jsonc-parser";

/** A position in a text: line and column from 1. */
export interface Place {
  line: number;
  column: number;
}

/** The entry of an object or list that a path starts with, and the rest of the path. For a duplicate key the last one counts. */
function step(
  { type, children = [] }: Node,
  path: string,
): { at: Node; value: Node; rest: string } | null {
  if (type === "array") {
    const [whole, index] = /^\[(\d+)\]\.?/.exec(path) ?? [];
    const value = children[Number(index)];
    return whole && value
      ? { at: value, value, rest: path.slice(whole.length) }
      : null;
  }
  // A key may contain dots: the longest match counts.
  let longest = "";
  let found: Node | null = null;
  for (const property of children) {
    const key = String(property.children?.[0]?.value ?? "");
    const fits =
      path === key || path.startsWith(`${key}.`) || path.startsWith(`${key}[`);
    if (key === "" || !fits || key.length < longest.length) continue;
    longest = key;
    found = property;
  }
  const value = found?.children?.[1];
  return found && value
    ? { at: found, value, rest: path.slice(longest.length).replace(/^\./, "") }
    : null;
}

/** Finds the positions of paths such as `cycles[1].origin[0]` in a JSON text; a missing value has the position of its object. Empty if the text is not JSON. */
export function placesIn(text: string): (path: string) => Place | null {
  // A byte order mark is one character and no JSON.
  const tree = parseTree(text.replace(/^\uFEFF/, " "));
  const ends = [...text.matchAll(/\n/g)].map(({ index }) => index);
  return (path) => {
    if (!tree) return null;
    let at = tree;
    let value = tree;
    let rest = path;
    for (let next = step(value, rest); next; next = step(value, rest))
      ({ at, value, rest } = next);
    const before = ends.filter((end) => end < at.offset);
    return {
      line: before.length + 1,
      column: at.offset - (before.at(-1) ?? -1),
    };
  };
}
