// What an editor shows of a program: findings and safety rules at their lines, and plain words for a line.
import type { ProgramRun } from "../core/types.js";

/** A note at a line, counted from 0. */
export interface Note {
  line: number;
  level: "error" | "warning" | "info";
  /** Code of a finding, name of a rule, or `call-unsound`. */
  code: string;
  message: string;
}

/** Probing words, with their meaning. */
const WORDS: readonly (readonly [RegExp, string])[] = [
  [
    /(?<![A-Z#_])G38\.2(?!\d)/i,
    "`G38.2`: probing move. It stops at the contact; without one the control stops with an alarm.",
  ],
  [
    /(?<![A-Z#_])G38\.3(?!\d)/i,
    "`G38.3`: probing move. It stops at the contact; without one the program goes on at the end of the move.",
  ],
  [
    /(?<![A-Z#_])G38\.4(?!\d)/i,
    "`G38.4`: move away from the part. It stops where the contact ends; if it does not end, the control stops with an alarm.",
  ],
  [
    /(?<![A-Z#_])G38\.5(?!\d)/i,
    "`G38.5`: move away from the part. It stops where the contact ends; if it does not end, the program goes on at the end of the move.",
  ],
  [
    /(?<![A-Z#_])G31(?:\.\d)?(?!\d)/i,
    "`G31`: skip move. It stops at the signal of the probe. Without one it goes to its end, and the program itself must ask whether there was a contact.",
  ],
  [
    /(?<![A-Z_])MEAS\s*=/i,
    "`MEAS`: measuring move. It stops at the signal of the probe and deletes the distance to go.",
  ],
  [
    /(?<![A-Z_])MEAW\s*=/i,
    "`MEAW`: measuring move. It keeps the position of the signal and goes on to its end.",
  ],
];

/** Whether a program probes: rules and notes are about probing only. */
export function isProbing({ kind, kinds, calls }: ProgramRun): boolean {
  return calls.length > 0 || kind.some((one) => kinds[one] === "probe");
}

/** Largest number of marked lines of one rule or finding, and of notes of a program. */
const MOST_LINES = 20;
const MOST_NOTES = 1000;

/** Notes of a program at its lines; notes without a line are at the first one. */
export function notesOf(run: ProgramRun): Note[] {
  const notes: Note[] = [];
  const add = (
    level: Note["level"],
    code: string,
    message: string,
    lines: readonly number[],
  ) => {
    const more = lines.length - MOST_LINES;
    const text = more > 0 ? `${message} (and ${more} lines more)` : message;
    for (const line of lines.length > 0 ? lines.slice(0, MOST_LINES) : [0])
      if (notes.length < MOST_NOTES)
        notes.push({ line, level, code, message: text });
  };
  if (!isProbing(run)) return notes;
  for (const { rule, holds, message, lines } of run.rules) {
    if (holds === false) add("error", rule, message, lines);
    // An undecided rule without lines has no place in the text.
    else if (holds === null && lines.length > 0)
      add("info", rule, `Not known: ${message}`, lines);
  }
  for (const { line, file, name, contradictions } of run.calls)
    if (file === 0)
      for (const why of contradictions)
        add("error", "call-unsound", `${name}: ${why}`, [line]);
  for (const { level, code, message, lines } of run.findings)
    add(level, code, message, lines);
  for (const { name, lines } of run.asks)
    add(
      "info",
      "unset-variable",
      `${name} is read, and nothing in this program sets it`,
      lines,
    );
  return notes;
}

/** Help for a line, as Markdown: its native calls, its probing words, and the ends of its moves. `null` for a line without any of these. */
export function wordsOf(
  run: ProgramRun,
  line: number,
  text: string,
): string | null {
  if (!isProbing(run)) return null;
  const code = text.replace(/\(.*?\)|;.*/g, "");
  const said: string[] = [];
  for (const call of run.calls)
    if (call.line === line && call.file === 0) {
      const mark =
        call.mark === "recalled" ? " (not verified on a control)" : "";
      said.push(`**${call.name}**: ${call.title ?? "not known here"}${mark}`);
      const words = call.arguments.map(
        ({ name, value, meaning, range }) =>
          `- \`${name} ${value ?? "?"}\`: ${meaning ?? "not known"}${range === null ? "" : ` (${range})`}`,
      );
      if (words.length > 0) said.push(words.join("\n"));
    }
  for (const [word, meaning] of WORDS) if (word.test(code)) said.push(meaning);
  const ways: number[] = [];
  for (let move = 0; move < run.line.length; move++)
    if (run.line[move] === line && (run.file[move] ?? 0) === 0) ways.push(move);
  const shown = ways.slice(0, 3).map((move) => wayOf(run, move));
  if (shown.length > 0) said.push(shown.join("\n\n"));
  if (ways.length > 3) said.push(`and ${ways.length - 3} moves more`);
  return said.length > 0 ? said.join("\n\n") : null;
}

/** A move in words. */
function wayOf({ kind, kinds, to, feed }: ProgramRun, move: number): string {
  const number = (x: number) => String(Number(x.toFixed(4)));
  const axes = ["X", "Y", "Z"].map((axis, i) => {
    const x = to[3 * move + i] ?? Number.NaN;
    return `${axis}${Number.isNaN(x) ? " unknown" : number(x)}`;
  });
  const rate = feed[move] ?? Number.NaN;
  const what = { rapid: "Rapid", feed: "Move", probe: "Probing move" }[
    kinds[kind[move] ?? 0] ?? ""
  ];
  return `${what ?? "Move"} to ${axes.join(" ")}${Number.isNaN(rate) ? "" : ` at F${number(rate)}`}`;
}
