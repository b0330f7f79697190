// Stores the state of a tab across a reload, and the initial state of a new tab.

/** A tab's own state; two tabs do not share it. */
const TAB = "touchpath.tab.1";
/** The last state that any tab stored: the initial state of a new tab. */
const START = "touchpath.job.1";

/** Milliseconds between a change and its write to the storage. A keystroke does not wait for the disk. */
const WAIT = 50;

/** The state to store, while a write is pending. */
let due: (() => Kept) | null = null;

/** A state; `left` is dropped first if the storage is full. */
type Kept = object & { left?: unknown };

/** Called once if the browser stores nothing. */
let refused: (() => void) | null = null;
let toldRefused = false;

/** Stores a state soon, and always before the page is left or hidden. `state` returns the state to store; `without` is called if nothing can be stored. */
export function keepSoon(state: () => Kept, without: () => void): void {
  if (!due) setTimeout(write, WAIT);
  due = state;
  refused = without;
  // Both do nothing when called again.
  addEventListener("pagehide", write);
  document.addEventListener("visibilitychange", write);
}

function write(): void {
  const state = due?.();
  due = null;
  if (!state) return;
  let held = false;
  for (const [storage, key] of places()) {
    // If not everything fits, stores only the job.
    for (const kept of [state, { ...state, left: undefined }]) {
      try {
        storage().setItem(key, JSON.stringify(kept));
        held = true;
        break;
      } catch {
        // No storage, or it is full: the page works without.
      }
    }
  }
  if (held || toldRefused) return;
  toldRefused = true;
  refused?.();
}

/** Stored states: that of this tab first, then that of the last tab. An unreadable one is `null`. */
export function kept(): unknown[] {
  return places().flatMap(([storage, key]) => {
    let text: string | null = null;
    try {
      text = storage().getItem(key);
    } catch {
      // No storage.
    }
    if (text === null) return [];
    try {
      return [JSON.parse(text) as unknown];
    } catch {
      return [null];
    }
  });
}

/** Access to a storage can throw. */
function places(): [() => Storage, string][] {
  return [
    [() => sessionStorage, TAB],
    [() => localStorage, START],
  ];
}

const SAVED = "touchpath.saved.1";
/** Maximum number of files remembered, the last ones. */
const MOST_SAVED = 200;

/** Contents of the files that were saved last, by name. */
export function keptFiles(): Map<string, string> {
  try {
    const pairs = JSON.parse(choice(SAVED) ?? "[]") as unknown;
    const isPair = (pair: unknown) =>
      Array.isArray(pair) &&
      pair.length === 2 &&
      pair.every((x) => typeof x === "string");
    return new Map(
      Array.isArray(pairs) ? (pairs.filter(isPair) as [string, string][]) : [],
    );
  } catch {
    return new Map();
  }
}

export const keepFiles = (files: Map<string, string>) =>
  keepChoice(SAVED, JSON.stringify([...files].slice(-MOST_SAVED)));

const THEME = "touchpath.theme.1";
const CAM = "touchpath.cam.1";
const LANGUAGE = "touchpath.language.1";

/** A stored choice for the page by its name. Null if it was never stored. */
function choice(name: string): string | null {
  try {
    return localStorage.getItem(name);
  } catch {
    return null;
  }
}

/** Stores a choice. Without storage it lasts as long as the page. */
function keepChoice(name: string, value: string): void {
  try {
    localStorage.setItem(name, value);
  } catch {
    // No storage, or it is full.
  }
}

export const keptTheme = () => choice(THEME);
export const keepTheme = (theme: string) => keepChoice(THEME, theme);
export const keptLanguage = () => choice(LANGUAGE);
export const keepLanguage = (language: string) =>
  keepChoice(LANGUAGE, language);
export const keptCam = () => choice(CAM) === "on";
export const keepCam = (on: boolean) => keepChoice(CAM, on ? "on" : "off");
