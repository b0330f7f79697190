// What a tab keeps across a reload, and what a new tab starts with.

/** A tab's own state; two tabs do not share it. */
const TAB = "touchpath.tab.1";
/** The last state that any tab wrote: the start of a new tab. */
const START = "touchpath.job.1";

/** Changes are gathered for so many milliseconds before they are written: that goes to the disk, and a keystroke does not wait for it. */
const WAIT = 50;

/** What is to be kept, while it waits. */
let due: (() => Kept) | null = null;

/** A state, and what of it is least missed. */
type Kept = object & { left?: unknown };

/** Called where the browser keeps nothing; once, since that is so for every change. */
let refused: (() => void) | null = null;
let toldRefused = false;

/** Keeps a state soon, and in any case before the page is left or hidden: `state` is asked for it then, and `without` called where nothing is kept. */
export function keepSoon(state: () => Kept, without: () => void): void {
  if (!due) setTimeout(write, WAIT);
  due = state;
  refused = without;
  // Both do nothing the second time.
  addEventListener("pagehide", write);
  document.addEventListener("visibilitychange", write);
}

function write(): void {
  const state = due?.();
  due = null;
  if (!state) return;
  let held = false;
  for (const [storage, key] of places()) {
    // Where there is no room for everything, the job itself is kept.
    for (const kept of [state, { ...state, left: undefined }]) {
      try {
        storage().setItem(key, JSON.stringify(kept));
        held = true;
        break;
      } catch {
        // No storage, or a full one: without it the page works, but forgets.
      }
    }
  }
  if (held || toldRefused) return;
  toldRefused = true;
  refused?.();
}

/** What was kept: this tab's own state first, then that of the last tab; what is there and cannot be read is `null`. */
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

/** Asking for a storage can itself be refused. */
function places(): [() => Storage, string][] {
  return [
    [() => sessionStorage, TAB],
    [() => localStorage, START],
  ];
}

const SAVED = "touchpath.saved.1";
/** So many files are remembered, the last ones. */
const MOST_SAVED = 200;

/** What the files hold that were saved last, by their names. */
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

/** A choice for the page that was kept under a name; null if nothing was kept. */
function choice(name: string): string | null {
  try {
    return localStorage.getItem(name);
  } catch {
    return null;
  }
}

/** Keeps one. Without storage it lasts as long as the page. */
function keepChoice(name: string, value: string): void {
  try {
    localStorage.setItem(name, value);
  } catch {
    // No storage, or a full one.
  }
}

export const keptTheme = () => choice(THEME);
export const keepTheme = (theme: string) => keepChoice(THEME, theme);
export const keptLanguage = () => choice(LANGUAGE);
export const keepLanguage = (language: string) =>
  keepChoice(LANGUAGE, language);
export const keptCam = () => choice(CAM) === "on";
export const keepCam = (on: boolean) => keepChoice(CAM, on ? "on" : "off");
