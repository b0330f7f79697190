// Buffers input until the module is loaded. Fields accept text; every other control waits.
import { letterOf } from "./parts/keys.js";

/** Keys that act with Ctrl on the whole page. Undo keys stay with the field: there is nothing else to undo yet. */
const COMMANDS = ["k", "s"];
const UNDO = ["y", "z"];
/** Events that the picture handles once it exists. */
const POINTS = ["pointerdown", "pointermove", "pointerup", "wheel", "dblclick"];

const isText = (target: unknown): target is HTMLInputElement =>
  target instanceof HTMLInputElement &&
  ["text", "search"].includes(target.type);

/** Buffers input inside a root. Returns a function that ends this; `enter` applies the typed text. */
export function bufferInput(root: ShadowRoot): (enter: boolean) => void {
  /** Texts in the order in which they were typed, and whether the user has left the field. */
  const typed = new Map<HTMLInputElement, { text: string; left: boolean }>();
  const isInside = (event: Event) => event.composedPath().includes(root);

  const type = (event: Event): void => {
    event.stopImmediatePropagation();
    const [field] = event.composedPath();
    if (!isText(field)) return;
    typed.delete(field);
    typed.set(field, { text: field.value, left: event.type === "change" });
    // The program shown no longer belongs to the form.
    root.host.setAttribute("data-typed", "");
  };
  const press = (event: Event): void => {
    event.preventDefault();
    event.stopImmediatePropagation();
  };
  const point = (event: Event): void => event.stopImmediatePropagation();
  /** A list would open, and its choice would be lost. */
  const open = (event: Event): void => {
    if (event.composedPath()[0] instanceof HTMLSelectElement)
      event.preventDefault();
  };
  const key = (event: KeyboardEvent): void => {
    const [at] = event.composedPath();
    if (!isInside(event) && at !== document.body) return;
    const commands = (event.ctrlKey || event.metaKey) && !event.altKey;
    const letter = letterOf(event);
    if (commands && COMMANDS.includes(letter)) press(event);
    else if (at instanceof HTMLSelectElement && event.key !== "Tab")
      press(event);
    else if (isInside(event) || (commands && UNDO.includes(letter)))
      event.stopImmediatePropagation();
  };

  const ways: [EventTarget, string[], (event: never) => void][] = [
    [root, ["input", "change"], type],
    [root, ["click"], press],
    [root, POINTS, point],
    [root, ["mousedown"], open],
    // Runs before the handlers of the page for keys.
    [window, ["keydown"], key],
  ];
  for (const [at, names, act] of ways)
    for (const name of names)
      at.addEventListener(name, act as EventListener, {
        capture: true,
        passive: false,
      });
  root.host.setAttribute("aria-busy", "true");

  return (enter) => {
    for (const [at, names, act] of ways)
      for (const name of names)
        at.removeEventListener(name, act as EventListener, true);
    root.host.removeAttribute("aria-busy");
    root.host.removeAttribute("data-typed");
    for (const [field, { text, left }] of enter ? typed : []) {
      if (!field.isConnected) continue;
      // The page may have been rendered again since then.
      field.value = text;
      for (const name of left ? ["input", "change"] : ["input"])
        field.dispatchEvent(new Event(name, { bubbles: true, composed: true }));
    }
  };
}
