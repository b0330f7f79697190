// What is shown of the text of an opened program, by its editor or before that is loaded.

/** What a line does: it probes, it moves nothing (`plain`), or it moves. */
export type Kind = "touch" | "plain" | "";

/** The lines that were found, which count from 0, and the one of them that is shown; -1 is none. */
export interface Found {
  matches: ReadonlySet<number>;
  here: number;
}

/** Mark in the margin of a line: the letters of its faults, else the number of its touch. */
export interface Mark {
  faults: string;
  touch: string;
}

/** What is shown of a text. */
export interface Shown {
  text: string;
  kind: (line: number) => Kind;
  marks: ReadonlyMap<number, Mark>;
  /** What is said of lines, at their margin. */
  notes: ReadonlyMap<number, string[]>;
  found: Found;
  /** The line that is lit; -1 is none. */
  lit: number;
  /** The line that is brought into sight; -1 is none. */
  sight: number;
}

/** The attributes of a line for its mark: CSS prints what they say. */
export const attributesOf = (mark: Mark | undefined): Record<string, string> =>
  mark?.faults
    ? { "data-faults": mark.faults }
    : mark?.touch
      ? { "data-touch": mark.touch }
      : {};

/** A line that is brought into sight is this far from the edge, px. */
export const MARGIN = 40;

/** A text of more lines, or of a longer line, has the editor. */
const MOST_LINES = 5000;
const LONGEST_LINE = 5000;

/** Whether a text is shown as lines. */
export function isShort(text: string): boolean {
  const lines = text.split(/\r\n?|\n/, MOST_LINES + 1);
  return (
    lines.length <= MOST_LINES &&
    lines.every((line) => line.length <= LONGEST_LINE)
  );
}
