// Reads numbers as users type them: decimal comma, true minus, a sum, a unit.
import type { FieldEntry } from "./core/browser.js";

type Unit = FieldEntry["unit"];
type Units = "mm" | "inch";

/** Suffix of each unit, and the units of lengths it implies. */
const SUFFIXES: Record<Unit, [RegExp, Units | null][]> = {
  length: [
    [/\s*mm$/i, "mm"],
    [/\s*(inch|in|"|″)$/i, "inch"],
  ],
  feed: [
    [/\s*mm(\/min)?$/i, "mm"],
    [/\s*(inch|in|ipm|"|″)(\/min)?$/i, "inch"],
  ],
  acceleration: [
    [/\s*mm\/s(²|\^?2)$/i, "mm"],
    [/\s*(inch|in|"|″)\/s(²|\^?2)$/i, "inch"],
  ],
  time: [[/\s*ms$/i, null]],
  angle: [[/\s*(°|deg)$/i, null]],
  none: [],
};

/** `1-1/2` means 1.5 on a drawing and 0.5 as a sum, so it is not read. */
const AMBIGUOUS = /^[+-]?\d+-\d+\/\d+/;
/** `1,000` is a thousand where the decimal sign is a point; `1.000` where it is a comma. */
const THOUSANDS = /^[+-]?\d{1,3}(,000)+(?!\d)/;
const THOUSANDS_BY_POINT = /^[+-]?[1-9]\d{0,2}(\.000)+(?!\d)/;

/** A size and one or two small deviations, as drawings write a tolerance: `25+0.021`, `25 -0,02`, `25+0.021-0`. */
const DEVIATIONS =
  /^(\d+[.,]?\d*)\s*[-+]\s*(\d*[.,]?\d+)(?:\s*[-+/]\s*[-+]?\s*(\d*[.,]?\d+))?$/;
/** Two deviations that cannot be terms of a sum: each has a sign or is 0, and a slash or blank separates them. */
const APART =
  /^\d+[.,]?\d*(?:\s*[-+]\d*[.,]?\d+|\s0)\s*[\s/]\s*(?:[-+]\d*[.,]?\d+|0)$/;
/** `25e7` is a fit: as a number it exceeds any part. */
const FIT = /^\d+[.,]?\d*\s*e\s*([5-9]|1\d)$/i;
/** Upper bound of a deviation that could also be a term of a sum, in the units of the size. A quarter of the size is a second bound. */
const SMALL: Record<Units, number> = { mm: 0.5, inch: 0.02 };

/** Whether the text of a size contains a tolerance and is not a sum. */
function isToleranced(text: string, units: Units): boolean {
  if (FIT.test(text) || APART.test(text)) return true;
  const [, size, ...deviations] = (DEVIATIONS.exec(text) ?? []).map((part) =>
    part?.replace(",", "."),
  );
  const most = Math.min(SMALL[units], Number(size) / 4);
  return (
    deviations.length > 0 &&
    deviations.every((part) => part === undefined || Number(part) < most)
  );
}

/** Maximum length of a sum, in characters. */
const LONGEST = 200;

/**
 * Reads the number of a text in the job's units: `80,5`, `−40`, `80/2+0.5`, `1 1/2`, `3.15 in`. A text without a number stays text and becomes a finding.
 * `comma`: the language writes a decimal comma. `size`: the field is a size of the part, which may include a tolerance.
 */
export function readNumber(
  text: string,
  unit: Unit = "none",
  units: Units = "mm",
  comma = false,
  size = false,
): number | string {
  const thousands = comma ? THOUSANDS_BY_POINT : THOUSANDS;
  if (
    text.length > LONGEST ||
    AMBIGUOUS.test(text.trim()) ||
    thousands.test(text.trim())
  )
    return text;
  // A spreadsheet starts a sum with `=`, a drawing a diameter with `Ø`.
  let rest = text
    .trim()
    .replace(/^=\s*|^[Øø⌀]\s*/, "")
    .replaceAll("−", "-");
  let given: Units | null = null;
  for (const [pattern, of] of SUFFIXES[unit]) {
    if (!pattern.test(rest)) continue;
    rest = rest.replace(pattern, "");
    given = of;
    break;
  }
  const degrees = unit === "angle";
  if (
    size &&
    (degrees || unit === "length") &&
    isToleranced(rest, degrees ? "mm" : (given ?? units))
  )
    return text;
  const value = mixed(rest) ?? sum(rest);
  if (value === null || !Number.isFinite(value)) return text;
  if (given === null || given === units) return value;
  return tidy(given === "inch" ? value * 25.4 : value / 25.4);
}

/** Rounds a computed number. A repeatability can be 0.00025 mm, so small numbers keep three more decimals. */
export function tidy(value: number): number {
  return Number(value.toFixed(Math.abs(value) < 1e-3 ? 9 : 6));
}

/** Whether a text is a sum or has a unit. The field shows the number once it is accepted. */
export function isWorkedOut(text: string): boolean {
  return !/^\s*[+-]?(\d+[.,]?\d*|[.,]\d+)\s*$/.test(text);
}

/** Reads `1 1/2`, as inches are written on drawings. */
function mixed(text: string): number | null {
  const found = /^([+-]?)\s*(\d+)\s+(\d+)\s*\/\s*(\d+)$/.exec(text);
  if (!found) return null;
  const [, sign, whole, over, under] = found;
  return (
    (sign === "-" ? -1 : 1) * (Number(whole) + Number(over) / Number(under))
  );
}

/** Value of a sum of products. Null if the text is not such a sum. */
function sum(text: string): number | null {
  const words =
    text.match(
      /\d+(?:[.,]\d*)?(?:e[+-]?\d+)?|[.,]\d+(?:e[+-]?\d+)?|[-+*/×÷()]|\S/gi,
    ) ?? [];
  let next = 0;
  const take = (...signs: string[]) =>
    signs.includes(words[next] ?? "") ? words[next++] : undefined;

  const factor = (): number => {
    const sign = take("-", "+");
    if (sign)
      return /[-+]/.test(words[next] ?? "")
        ? Number.NaN
        : sign === "-"
          ? -factor()
          : factor();
    if (take("(")) {
      const inner = terms();
      return take(")") ? inner : Number.NaN;
    }
    const word = words[next++] ?? "";
    return /^[\d.,]/.test(word) && /\d/.test(word)
      ? Number(word.replace(",", "."))
      : Number.NaN;
  };
  const product = (): number => {
    let value = factor();
    for (
      let sign = take("*", "/", "×", "÷");
      sign;
      sign = take("*", "/", "×", "÷")
    ) {
      const other = factor();
      value = sign === "*" || sign === "×" ? value * other : value / other;
    }
    return value;
  };
  const terms = (): number => {
    let value = product();
    for (let sign = take("+", "-"); sign; sign = take("+", "-"))
      value += sign === "+" ? product() : -product();
    return value;
  };

  const value = terms();
  // Rounds off binary noise: 0.1+0.2 is 0.3.
  return next === words.length && words.length > 0 && Number.isFinite(value)
    ? words.length === 1
      ? value
      : Number(value.toPrecision(12))
    : null;
}
