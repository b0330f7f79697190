// Common to both kinds of elements: their properties, an attempt to load, and the message if it fails.

// The class is also declared without a DOM: a server that imports this file renders the bare tag.
export const Base = (globalThis.HTMLElement ?? class {}) as typeof HTMLElement;

/** Event of an element that enters a document; elements that show its panels wait for it. */
export const HERE = "touchpath-here";

/** Sets properties again that were set before the element's class was defined. They hide the properties of the class. */
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
    // Callers that do not await it see the failure in the element.
    this.ready.catch(() => undefined);
  }
}

/** Message of an element that could not be loaded. */
export function failure(thrown: unknown): HTMLElement {
  const note = document.createElement("p");
  note.setAttribute("role", "alert");
  note.textContent = `Touchpath could not be loaded: ${thrown instanceof Error ? thrown.message : String(thrown)}`;
  return note;
}
