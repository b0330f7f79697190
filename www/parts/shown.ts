// Display data of an opened program, for its editor and for the plain list.

/** Effect of a line: it probes, has no move (`plain`), or moves. */
export type Kind = "touch" | "plain" | "";

/** Matching lines, from 0, and the index of the current one; -1 without one. */
export interface Found {
  matches: ReadonlySet<number>;
  here: number;
}

/** Mark in the margin of a line: the letters of its faults, else the number of its touch. */
export interface Mark {
  faults: string;
  touch: string;
}

/** Display data of a text. */
export interface Shown {
  text: string;
  kind: (line: number) => Kind;
  marks: ReadonlyMap<number, Mark>;
  /** Notes about lines, for their margin. */
  notes: ReadonlyMap<number, string[]>;
  found: Found;
  /** The highlighted line; -1 without one. */
  lit: number;
  /** The line to scroll to; -1 without one. */
  sight: number;
}

/** Attributes of a line for its mark: CSS prints their values. */
export const attributesOf = (mark: Mark | undefined): Record<string, string> =>
  mark?.faults
    ? { "data-faults": mark.faults }
    : mark?.touch
      ? { "data-touch": mark.touch }
      : {};

/** Distance from the edge of a line that was scrolled to, px. */
export const MARGIN = 40;

/** A text with more lines, or with a longer line, gets the editor. */
const MOST_LINES = 5000;
const LONGEST_LINE = 5000;

/** Whether a text is shown as a list of lines. */
export function isShort(text: string): boolean {
  const lines = text.split(/\r\n?|\n/, MOST_LINES + 1);
  return (
    lines.length <= MOST_LINES &&
    lines.every((line) => line.length <= LONGEST_LINE)
  );
}
