// Part of an opened program, entered by hand: a simple feature with its position and displacement.
import { html, type TemplateResult } from "lit";
import type { Job, ProgramPart, ProgramRun } from "../core/browser.js";
import type { Store } from "../store.js";
import { w } from "../words.js";

/** Name that marks such a job. */
const NAME = "BY_HAND";

/** The features with their sizes. */
const KINDS: [string, string, [Size, string][]][] = [
  ["hole", w("Hole"), [["diameter", w("Diameter")]]],
  ["boss", w("Boss"), [["diameter", w("Diameter")]]],
  [
    "internal-rectangle",
    w("Internal rectangle"),
    [
      ["width1", w("Width along X")],
      ["width2", w("Width along Y")],
    ],
  ],
  [
    "external-rectangle",
    w("External rectangle"),
    [
      ["width1", w("Width along X")],
      ["width2", w("Width along Y")],
    ],
  ],
  ["surface", w("Top side"), []],
];

type Size = "diameter" | "width1" | "width2" | "depth";

type Cycle = { type: string; origin: number[] } & Partial<Record<Size, number>>;

export function isHandMade(
  part: unknown,
): part is ProgramPart & { cycle: Cycle } {
  return (
    typeof part === "object" &&
    part !== null &&
    "cycle" in part &&
    (part as { name?: string }).name === NAME
  );
}

/** A feature of this kind near the position where the program probes. */
export function handMade(run: ProgramRun, kind = "hole"): ProgramPart {
  const seen: [number[], number[], number[]] = [[], [], []];
  run.kind.forEach((is, move) => {
    if (run.kinds[is] !== "probe") return;
    for (const axis of [0, 1, 2] as const) {
      const x = run.to[3 * move + axis] as number;
      if (!Number.isNaN(x)) seen[axis].push(x);
    }
  });
  const round = (x: number) => Math.round(x * 1e3) / 1e3;
  const ends = (xs: number[]) =>
    (xs.length > 0 ? [Math.min(...xs), Math.max(...xs)] : [0, 0]) as [
      number,
      number,
    ];
  const [x, y, z] = seen.map(ends) as [
    [number, number],
    [number, number],
    [number, number],
  ];
  const middle = ([low, high]: [number, number]) => round((low + high) / 2);
  const inch = run.units === "inch" ? 25.4 : 1;
  // A touch searches past the wall, so the probed span is larger than the size.
  const size = (ends: [number, number]) =>
    Math.max(round(ends[1] - ends[0]), round(40 / inch));
  const depth = round(20 / inch);
  const sizes = { diameter: size(x), width1: size(x), width2: size(y), depth };
  const origin = [
    middle(x),
    middle(y),
    kind === "surface" ? z[0] : round(z[0] + depth / 2),
  ];
  return made(
    kind,
    run.units ?? "mm",
    origin,
    sizes,
    round(6 / inch),
    [0, 0, 0],
  );
}

function made(
  type: string,
  units: "mm" | "inch",
  origin: number[],
  sizes: Record<string, number>,
  ball: number,
  offset: number[],
): ProgramPart {
  const own =
    KINDS.find(([kind]) => kind === type)?.[2].map(([key]) => key) ?? [];
  const fields = Object.fromEntries(
    [...own, "depth"].map((key) => [key, sizes[key]]),
  );
  const cycle =
    type === "surface"
      ? { type, origin, elevation: 90 }
      : { type, origin, ...fields };
  return {
    format: 1,
    name: NAME,
    units,
    stylus: { diameter: ball },
    cycle,
    part: { offset },
  } as unknown as Job as ProgramPart;
}

/** Its fields: `number` makes the input for a number, `change` sets another part. */
export function handMadeFields(
  store: Store,
  part: ProgramPart & { cycle: Cycle },
  number: (
    id: string,
    label: string,
    value: number,
    take: (x: number) => void,
  ) => TemplateResult,
  change: (part: ProgramPart) => void,
): TemplateResult {
  const t = store.t.bind(store);
  const {
    cycle,
    units = "mm",
    stylus,
    part: lies,
  } = part as unknown as {
    cycle: Cycle;
    units?: "mm" | "inch";
    stylus: { diameter: number };
    part: { offset: number[] };
  };
  const depth = cycle.depth ?? 20 / (units === "inch" ? 25.4 : 1);
  const sizes: Record<string, number> = { depth };
  for (const [, , keys] of KINDS)
    for (const [key] of keys)
      sizes[key] = cycle[key] ?? cycle.diameter ?? cycle.width1 ?? 2 * depth;
  const now = (
    changed: Partial<{
      type: string;
      origin: number[];
      sizes: Record<string, number>;
      ball: number;
      offset: number[];
    }>,
  ) =>
    change(
      made(
        changed.type ?? cycle.type,
        units,
        changed.origin ?? cycle.origin,
        { ...sizes, ...changed.sizes },
        changed.ball ?? stylus.diameter,
        changed.offset ?? lies.offset,
      ),
    );
  const put = (list: number[], i: number, x: number) =>
    list.map((old, at) => (at === i ? x : old));
  const keys = KINDS.find(([kind]) => kind === cycle.type)?.[2] ?? [];
  return html`<div class="field"><label for="hand-kind">${t("Feature")}</label>
      <select id="hand-kind" @change=${(e: Event) => now({ type: (e.target as HTMLSelectElement).value })}>
        ${KINDS.map(([kind, word]) => html`<option value=${kind} ?selected=${kind === cycle.type}>${t(word)}</option>`)}
      </select></div>
    ${[0, 1, 2].map((i) => number(`hand-${i}`, `${t(i === 2 ? w("Top side") : w("Middle"))} ${"XYZ"[i]}`, cycle.origin[i] as number, (x) => now({ origin: put(cycle.origin, i, x) })))}
    ${keys.map(([key, word]) => number(`hand-${key}`, t(word), sizes[key] as number, (x) => now({ sizes: { [key]: x } })))}
    ${keys.length > 0 ? number("hand-depth", t("Depth"), depth, (x) => now({ sizes: { depth: x } })) : ""}
    ${number("hand-ball", t("Ball diameter"), stylus.diameter, (ball) => now({ ball }))}
    ${[0, 1, 2].map((i) => number(`hand-off-${i}`, `${t("Displaced by")} ${"XYZ"[i]}`, lies.offset[i] as number, (x) => now({ offset: put(lies.offset, i, x) })))}`;
}
