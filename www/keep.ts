// What a tab keeps across a reload, and what a new tab starts with.

/** A tab's own state; two tabs do not share it. */
const TAB = "touchpath.tab.1";
/** The last state that any tab wrote: the start of a new tab. */
const START = "touchpath.job.1";

/** Keeps a state. Without storage the page works, but forgets. */
export function keep(state: unknown): void {
  const text = JSON.stringify(state);
  for (const [storage, key] of places()) {
    try {
      storage().setItem(key, text);
    } catch {
      // No storage, or a full one.
    }
  }
}

/** What was kept: this tab's own state first, then that of the last tab. */
export function kept(): unknown[] {
  return places().flatMap(([storage, key]) => {
    try {
      const text = storage().getItem(key);
      return text === null ? [] : [JSON.parse(text) as unknown];
    } catch {
      return [];
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

const THEME = "touchpath.theme.1";

/** The colours that were chosen in this browser; null where none were. */
export function keptTheme(): string | null {
  try {
    return localStorage.getItem(THEME);
  } catch {
    return null;
  }
}

export function keepTheme(theme: string): void {
  try {
    localStorage.setItem(THEME, theme);
  } catch {
    // Without storage the choice lasts as long as the page.
  }
}
