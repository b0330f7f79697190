// Describes the plan in words: a move, the run, a result, the displacement of the virtual part.
import { PROGRAM_POST_TITLES } from "./core/program-posts.js";
import type { Message, Plan, ProgramMoves, ResultRow } from "./core/types.js";
import type { Draft, Store } from "./store.js";
import { w } from "./words.js";

/** Names of the dialects of opened programs. */
const DIALECTS = {
  iso: "ISO",
  sinumerik: "SINUMERIK",
  klartext: "HEIDENHAIN",
} as const;

/** What a program was read as: a control, or the common dialect of several. */
export const readAs = ({
  post,
  dialect,
}: Pick<ProgramMoves, "post" | "dialect">): string =>
  post ? PROGRAM_POST_TITLES[post] : DIALECTS[dialect];

/** Names of the feeds. */
const FEEDS: Record<Plan["moves"][number]["feed"], string> = {
  approach: w("approach"),
  longLink: w("long link"),
  work: w("work"),
  retract: w("retract"),
  return: w("return"),
  rapid: w("rapid"),
};

/** Kind of a move, as the legend of the picture names its line, and its end. */
function parts(
  store: Store,
  { kind, touch, to, feed, cycle, step }: Plan["moves"][number],
): { what: Message; place: string } {
  const what: Message = {
    position: [feed === "longLink" ? w("link") : w("positioning")] as Message,
    touch: [
      w("touch {touch}"),
      String(store.touchNumber(touch ?? 0)),
    ] as Message,
    back: [w("back")] as Message,
  }[kind];
  const place = ["X", "Y", "Z"].map(
    (axis, i) =>
      axis + store.number(String(Number((to[i] as number).toFixed(4)))),
  );
  const name =
    store.plan.cycles.length > 1 ? store.plan.cycles[cycle] : undefined;
  if (name === undefined) return { what, place: place.join(" ") };
  const said: Message =
    step === 0
      ? [w("on the way to {cycle}"), name]
      : [w("{cycle}: {what}"), name, what];
  return { what: said, place: place.join(" ") };
}

/** A move of the plan. */
export function moveInWords(
  store: Store,
  index: number,
  numbered = true,
): string {
  const { moves } = store.plan;
  const move = moves[index] as Plan["moves"][number];
  const { what, place } = parts(store, move);
  // Macros use their own feeds.
  const said: Message = store.plan.program.own
    ? [w("call {step}, {what}, to {place}"), String(move.step), what, place]
    : [
        w("step {step}, {what}, {feed}, to {place}"),
        String(move.step),
        what,
        [FEEDS[move.feed]],
        place,
      ];
  return numbered
    ? store.t("{move} of {count}: {words}", index + 1, moves.length, said)
    : store.say(said);
}

/** Value of a feed in the form; undefined for a rapid. */
export function rateOf(
  store: Store,
  feed: Plan["moves"][number]["feed"],
): number | null {
  const { feeds, cycle } = store.shown as {
    feeds?: Draft;
    cycle?: { probe?: Draft };
  };
  const value = store.cycle.ownFeeds
    ? cycle?.probe?.[feed === "work" ? "feed" : feed]
    : feeds?.[feed];
  return typeof value === "number" ? value : null;
}

/** Speed of a move as a program writes it: `F150`, or rapid. */
function speed(store: Store, feed: Plan["moves"][number]["feed"]): string {
  const rate = rateOf(store, feed);
  return rate === null
    ? store.say([FEEDS.rapid])
    : `F${store.number(String(rate))}`;
}

/** Short description of a move: `touch 1 · contact X37 Y0 Z-10 · F150`. */
export function moveInShort(store: Store, index: number): string {
  const move = store.plan.moves[index] as Plan["moves"][number];
  const { what, place } = parts(store, move);
  const where =
    move.kind === "touch" ? store.t("contact {place}", place) : place;
  const own =
    store.plan.program.own &&
    !["approach", "longLink", "return"].includes(move.feed);
  return [
    store.say(what),
    where,
    ...(own ? [] : [speed(store, move.feed)]),
  ].join(" · ");
}

/** A duration as minutes and seconds. */
export function clockOf(seconds: number): string {
  const whole = Math.round(seconds);
  return `${Math.floor(whole / 60)}:${String(whole % 60).padStart(2, "0")}`;
}

/** Abscissa, ordinate and tool axis of each plane. */
export const AXES_OF = { G17: "XYZ", G18: "ZXY", G19: "YZX" } as const;

/** Name of a result with an axis, by the part of its code before the axis. */
const NAMED: Record<string, string> = {
  center: w("Centre {axis}"),
  corner: w("Corner {axis}"),
  point: w("Point {axis}"),
};

/**
 * Name of a result. For a result along an axis, the name of that axis: x in a code is the plane's abscissa, y its ordinate, z the tool axis. Otherwise its
 * meaning.
 */
export function resultInWords(store: Store, { code, said }: ResultRow): string {
  const [thing = "", letter = ""] = code.split(".");
  const axis =
    AXES_OF[(store.shown.plane ?? "G17") as keyof typeof AXES_OF][
      "xyz".indexOf(letter)
    ];
  return letter !== "" && axis && Object.hasOwn(NAMED, thing)
    ? store.t(NAMED[thing] as string, axis)
    : store.say(said.meaning);
}

/** Number of moves of the path and its length. */
export function pathInWords(store: Store): string {
  const { moves, length } = store.plan;
  const words = store.t(
    "{count} moves · {length}",
    moves.length,
    `${length.toFixed(0)} ${store.units}`,
  );
  return store.plan.program.own
    ? `${words} · ${store.t("native cycles")}`
    : words;
}

/** Summary of the run: moves, length, minutes and seconds. */
export function runInWords(store: Store): string {
  return `${pathInWords(store)} · ${clockOf(store.plan.time * 60)}`;
}

/** Displacement and size deviations of the virtual part, in words. Empty for a nominal part. */
export function deviations(store: Store): string[] {
  const part = store.get("part") as
    | { offset?: unknown[]; rotation?: unknown; sizes?: Draft }
    | undefined;
  const signed = (x: number) => store.number(x > 0 ? `+${x}` : String(x));
  // An invalid number is reported at its field.
  const off = (x: unknown): x is number => typeof x === "number" && x !== 0;
  const shifts = (part?.offset ?? []).flatMap((x, i) =>
    off(x) ? [`${"XYZ"[i]} ${signed(x)}`] : [],
  );
  const turn = off(part?.rotation) ? part.rotation : 0;
  const sizes = store.cycle.fields.flatMap(({ key, label }) => {
    const value = part?.sizes?.[key] ?? 0;
    return off(value) ? [`${label} ${signed(value)}`] : [];
  });
  return [
    ...shifts,
    ...(turn === 0 ? [] : [store.t("turned {angle}", `${String(turn)}°`)]),
    ...sizes,
  ];
}

/** Results whose uncertainty includes the ball's eccentricity, as a list that may be empty. */
export const ofRunout = (
  rows: ResultRow[],
  say: (row: ResultRow) => string,
): string =>
  rows
    .filter((row) => (row.uncertaintyRunout ?? 0) > 0)
    .map(say)
    .join(", ");

/** A size in drawing notation: `Ø25 H7`, `80`. */
function sizeInWords(store: Store, key: string, value: unknown): string {
  const text =
    typeof value === "number" ? store.number(String(value)) : String(value);
  return `${key.startsWith("diameter") && !/^[Øø⌀]/.test(text) ? "Ø" : ""}${text.trim()}`;
}

/** The lengths of a cycle in drawing notation: `Ø25 H7`, `80 × 50`. Omits sizes that follow a result. */
export function sizesInWords(store: Store, cycle: Draft): string {
  const entry = store.catalog.cycles.find(({ type }) => type === cycle.type);
  const sizes = (entry?.fields ?? [])
    .filter(({ size, unit }) => size && unit === "length")
    .map(({ key }) => [key, cycle[key]] as const)
    .filter(
      ([, value]) =>
        value !== undefined && !String(value).trimStart().startsWith("="),
    );
  return sizes
    .map(([key, value]) => sizeInWords(store, key, value))
    .join(" × ");
}

/** A name inside a sentence. Other languages keep capitals: German nouns always have one. */
export const inside = (store: Store, name: string) =>
  store.lang === "en" && !/^.[A-Z]|[a-z][A-Z]/.test(name)
    ? `${name.charAt(0).toLowerCase()}${name.slice(1)}`
    : name;

/** Maximum number of features listed by name. */
const MOST_NAMED = 3;

/** The probed features: `hole Ø25 H7`, `TOP, CORNER and BORE`, `6 features`. */
export function whatInWords(store: Store): string {
  const names = store.features
    .inOrder(store.draft)
    .filter(({ off }) => !off)
    .map(({ name }) => name);
  if (names.length > MOST_NAMED)
    return store.t("{count} features", names.length);
  if (names.length > 1)
    return store.t(
      "{list} and {last}",
      names.slice(0, -1).join(", "),
      names.at(-1) ?? "",
    );
  const title = inside(store, store.cycle.title);
  return `${title} ${sizesInWords(store, store.draft.cycle as Draft)}`.trim();
}

/** The probe: `Ø6 probe`. */
export function probeInWords(store: Store): string {
  const value = store.get("stylus.diameter");
  const diameter =
    typeof value === "number" ? store.number(String(value)) : "?";
  return store.t("Ø{diameter} probe", diameter);
}
