// What both kinds of elements need to come into a document: their properties, an attempt to load, and what is shown if it fails.

// The class is named where there is no DOM, too: a server that imports this file renders the bare tag.
export const Base = (globalThis.HTMLElement ?? class {}) as typeof HTMLElement;

/** Said where an element comes into a document: what shows its panels elsewhere may wait for it. */
export const HERE = "touchpath-here";

/** Sets again what was set before the class of an element was known: it hides the class's own properties. */
export function takeUp<T extends object>(element: T, names: (keyof T)[]): void {
  for (const name of names) {
    if (!Object.hasOwn(element, name)) continue;
    const value = element[name];
    delete element[name];
    element[name] = value;
  }
}

/** One attempt to load the element. */
export class Attempt {
  /** Whether it has failed. */
  over = false;
  done!: () => void;
  fail!: (why: unknown) => void;
  readonly ready = new Promise<void>((done, fail) => {
    this.done = done;
    this.fail = (why) => {
      this.over = true;
      fail(why);
    };
  });

  constructor() {
    // Callers that do not wait for it see the failure in the element.
    this.ready.catch(() => undefined);
  }
}

/** What an element shows that could not be loaded: nothing else can say it. */
export function failure(thrown: unknown): HTMLElement {
  const note = document.createElement("p");
  note.setAttribute("role", "alert");
  note.textContent = `Touchpath could not be loaded: ${thrown instanceof Error ? thrown.message : String(thrown)}`;
  return note;
}
