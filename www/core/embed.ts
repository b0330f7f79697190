// Script of embed.html, inside the frame. It accepts messages only from the origins on its own list.
import { EVENTS } from "./events.js";
import {
  type Answer,
  type Deed,
  type FrameState,
  type Hello,
  PROTOCOL,
  type Refused,
  type Token,
} from "./protocol.js";
import type { Finding } from "./types.js";

/** Members of the element used here; the class is in another file. */
interface Element extends HTMLElement {
  readonly ready: Promise<void>;
  job: unknown;
  readonly plan: unknown;
  readonly findings: Finding[];
  readonly measured: string;
  readonly validationMessage: string;
  readonly canUndo: boolean;
  readonly canRedo: boolean;
  picture(): string | null;
  save(): boolean;
  undo(): boolean;
  redo(): boolean;
  highlight(move: number | null): void;
  recolour(): void;
  refusals(state: Record<string, unknown>): Finding[];
  take(inputs: Record<string, unknown>): void;
}

const WORDS = ["theme", "lang", "panels", "mode", "view", "history"] as const;
const KEYS = [
  "config",
  "job",
  "cycle",
  "post",
  "units",
  "measured",
  "readonly",
  "appearance",
  ...WORDS,
];
const TOKENS: readonly Token[] = [
  "background",
  "panel",
  "text",
  "accent",
  "on-accent",
  "font",
];
const element = document.querySelector("touch-path") as Element;
/** Origins that may connect to this frame, separated by blanks. */
const allowed = (
  document.querySelector<HTMLMetaElement>("meta[name=touchpath-origins]")
    ?.content ?? ""
)
  .split(/\s+/)
  .filter(Boolean);
/** Ends the current connection when a portal opens another one. */
let ended: AbortController | null = null;

const isObject = (value: unknown): value is Record<string, unknown> =>
  typeof value === "object" && value !== null && !Array.isArray(value);

addEventListener("message", (event: MessageEvent) => {
  const { data, origin, source, ports } = event;
  if (
    !isObject(data) ||
    typeof data.touchpath !== "number" ||
    data.type !== "hello"
  )
    return;
  const refuse = (reason: string) => {
    const answer: Refused = { touchpath: PROTOCOL, type: "refused", reason };
    (source as Window | null)?.postMessage(answer, {
      targetOrigin: origin === "null" ? "*" : origin,
    });
  };
  if (!allowed.includes(origin))
    refuse(`${origin} is not on the list of this frame`);
  else if (source !== parent || source === window)
    refuse("only the page around may connect to this frame");
  else if (data.touchpath !== PROTOCOL)
    refuse(`this frame has version ${PROTOCOL} of the protocol`);
  else if (!ports[0]) refuse("there was no port in the hello");
  else accept(ports[0], data as unknown as Hello);
});

async function accept(port: MessagePort, { saves }: Hello): Promise<void> {
  ended?.abort();
  const mine = new AbortController();
  ended = mine;
  const { signal } = mine;
  const say = (answer: Answer) => port.postMessage(answer);
  signal.addEventListener("abort", () => {
    say({ type: "ended" });
    port.close();
  });
  port.onmessage = ({ data }) => {
    if (isObject(data) && data.type === "end") mine.abort();
    else receive(data, say);
  };
  let version = "";
  try {
    await element.ready;
    // The element has loaded this module already. A static import that fails would leave the portal without an answer.
    version = (await import("./browser.js")).version();
  } catch (thrown) {
    say({ type: "error", id: null, message: String(thrown), findings: [] });
    return;
  }
  if (signal.aborted) return;
  for (const type of EVENTS) {
    const tell = (event: Event) => {
      if (type === "program-save" && saves) event.preventDefault();
      say({ type, detail: (event as CustomEvent).detail } as Answer);
    };
    element.addEventListener(type, tell, { signal });
  }
  say({ type: "welcome", version });
}

function receive(data: unknown, say: (answer: Answer) => void): void {
  const id =
    isObject(data) && Number.isSafeInteger(data.id)
      ? (data.id as number)
      : null;
  const error = (message: string, findings: Finding[] = []) =>
    say({ type: "error", id, message, findings });
  if (!isObject(data) || id === null)
    error("A message has a type and an id, a whole number");
  else if (data.type === "get") {
    const { job, plan, findings, measured, canUndo, canRedo } = element;
    say({
      type: "state",
      id,
      state: { job, plan, findings, measured, canUndo, canRedo },
    } as Answer);
  } else if (data.type === "picture")
    say({ type: "picture", id, picture: element.picture() });
  else if (data.type === "do") {
    const why = done(data.deed);
    if (why === null) say({ type: "done", id });
    else error(why);
  } else if (data.type !== "set")
    error("A message is of type set, get, picture or do");
  else if (!isObject(data.state))
    error("A message of type set has a state, an object");
  else {
    const { appearance, ...state } = data.state;
    const unknown = Object.keys(state).filter((key) => !KEYS.includes(key));
    if (unknown.length > 0)
      error(`There is nothing to set that is called ${unknown.join(", ")}`);
    else if (appearance !== undefined && !isAppearance(appearance))
      error(`appearance has texts for some of ${TOKENS.join(", ")}`);
    else {
      // All or nothing: a refused portal knows that no part of its state was applied.
      const refused = element.refusals(state);
      if (refused.length === 0) refused.push(...set(data.state as FrameState));
      if (refused.length > 0)
        error(refused.map((f) => f.message).join(". "), refused);
      else say({ type: "done", id });
    }
  }
}

/** Whether every token is text. CSS ignores values that it does not understand. */
const isAppearance = (value: unknown) =>
  isObject(value) &&
  Object.entries(value).every(
    ([token, text]) =>
      TOKENS.includes(token as Token) && typeof text === "string",
  );

/** Performs an action for the portal; returns the reason of a failure, or null. */
function done(deed: unknown): string | null {
  const asked = (isObject(deed) ? deed : {}) as Partial<Deed>;
  switch (asked.do) {
    case "save":
      return element.save()
        ? null
        : `There is no program to save: ${element.validationMessage}`;
    case "undo":
    case "redo":
      return element[asked.do]() ? null : `There is nothing to ${asked.do}`;
    case "highlight":
      if (
        asked.move !== null &&
        !(Number.isInteger(asked.move) && Number(asked.move) >= 0)
      )
        return "highlight takes a move, counted from 0, or null";
      element.highlight(asked.move ?? null);
      return null;
    default:
      return "A deed is save, undo, redo or highlight";
  }
}

/** Applies a state; returns findings for inputs that could not be used. */
function set({ appearance, ...state }: FrameState): Finding[] {
  const refused: Finding[] = [];
  const note = (event: Event) => {
    const { detail } = event as CustomEvent<{
      findings: Finding[];
      refused: boolean;
    }>;
    if (detail.refused) refused.push(...detail.findings);
  };
  element.addEventListener("finding", note);
  element.take({ ...state });
  for (const [token, text] of Object.entries(appearance ?? {}))
    element.style.setProperty(`--touchpath-${token}`, text);
  if (appearance) element.recolour();
  for (const word of WORDS)
    if (state[word] !== undefined)
      element.setAttribute(word, String(state[word]));
  if (state.readonly !== undefined)
    element.toggleAttribute("readonly", state.readonly);
  element.removeEventListener("finding", note);
  return refused;
}
