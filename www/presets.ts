// Named presets: settings of a machine, stored in this browser and in files.
import { convertUnits } from "./core/browser.js";
import { isObject } from "./job.js";

/** The sections of a job that a preset holds. */
export const SECTIONS = [
  "stylus",
  "feeds",
  "control",
  "tool",
  "machine",
] as const;

/** A preset: the sections in its own units. */
export interface Preset {
  name: string;
  units: "mm" | "inch";
  overtravel?: unknown;
  sections: Record<string, unknown>;
}

const KEY = "touchpath.presets.1";
const FORMAT = "touchpath-presets";
/** Maximum number of presets stored, and the maximum length of a name in characters. */
export const MOST = 200;
const LONGEST_NAME = 80;

/** The list that was read last, and its text. */
let known: { text: string; list: Preset[] } = { text: "", list: [] };

/** Presets of this browser; null if it stores nothing. Unreadable entries are skipped. */
export function presets(): Preset[] | null {
  try {
    const text = localStorage.getItem(KEY) ?? "";
    if (text !== known.text) known = { text, list: read(text) ?? [] };
    return known.list;
  } catch {
    return null;
  }
}

/** Presets that were converted to other units. */
const converted = new WeakMap<Preset, Preset>();

/** A preset in these units. A preset that cannot be converted stays as it is: it fits no job. */
export function convertedPreset(
  preset: Preset,
  units: Preset["units"],
): Preset {
  if (preset.units === units) return preset;
  const known = converted.get(preset);
  if (known) return known;
  let made = preset;
  try {
    const { overtravel, ...sections } = convertUnits(
      {
        format: 1,
        units: preset.units,
        overtravel: preset.overtravel,
        ...preset.sections,
      },
      units,
    ) as unknown as Record<string, unknown>;
    made = { ...preset, units, overtravel, sections };
  } catch {
    // The storage may hold anything.
  }
  converted.set(preset, made);
  return made;
}

/** Stores exactly these presets. Returns false if this browser stores nothing. */
export function keepPresets(list: Preset[]): boolean {
  try {
    localStorage.setItem(KEY, written(list));
    return true;
  } catch {
    return false;
  }
}

/** These presets as the text of a file. */
export function written(list: Preset[]): string {
  return `${JSON.stringify({ format: FORMAT, version: 1, presets: list }, null, 2)}\n`;
}

/** Presets of a file's text. Null if the text contains no preset. Other entries are skipped. */
export function read(text: string): Preset[] | null {
  let file: unknown;
  try {
    file = JSON.parse(text);
  } catch {
    return null;
  }
  if (
    !isObject(file) ||
    file.format !== FORMAT ||
    file.version !== 1 ||
    !Array.isArray(file.presets)
  )
    return null;
  return file.presets.flatMap((one: unknown) => {
    if (
      !isObject(one) ||
      typeof one.name !== "string" ||
      !isObject(one.sections)
    )
      return [];
    const { name, sections, overtravel } = one;
    const units = one.units === "inch" ? "inch" : "mm";
    const held = SECTIONS.filter((section) => isObject(sections[section]));
    if (held.length === 0) return [];
    const taken = Object.fromEntries(
      held.map((section) => [section, sections[section]]),
    );
    return [
      {
        name: name.slice(0, LONGEST_NAME),
        units,
        overtravel,
        sections: taken,
      } satisfies Preset,
    ];
  });
}

/** A list with one more preset; one with the same name is replaced. The list may exceed the maximum. */
export function added(list: Preset[], one: Preset): Preset[] {
  const named = { ...one, name: one.name.trim().slice(0, LONGEST_NAME) };
  return [...list.filter((other) => other.name !== named.name), named].sort(
    (a, b) => a.name.localeCompare(b.name),
  );
}
