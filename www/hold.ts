// What a user does before the module is there waits for it: it is done again, in order, when it is.

/** Done again later. What is typed stands in its field meanwhile. */
const KEPT = ["keydown", "input", "change", "click"];
/** Without meaning until there is a picture to point at. */
const LOST = ["pointerdown", "pointermove", "pointerup", "wheel", "dblclick"];

/** Holds what is done inside a root until the module is there. Gives a function that does it. */
export function hold(root: ShadowRoot): () => void {
  const held: { target: EventTarget; event: Event }[] = [];
  const keep = (event: Event): void => {
    const target = event.composedPath()[0];
    if (!target) return;
    event.stopImmediatePropagation();
    // A box that is ticked now would be ticked again.
    if (event.type === "click") event.preventDefault();
    const last = held.at(-1);
    // A field has its whole text at the end.
    if (event.type === "input" && last?.event.type === "input" && last.target === target) return;
    held.push({ target, event });
  };
  const lose = (event: Event): void => event.stopImmediatePropagation();
  for (const type of KEPT) root.addEventListener(type, keep, true);
  for (const type of LOST) root.addEventListener(type, lose, true);
  return () => {
    for (const type of KEPT) root.removeEventListener(type, keep, true);
    for (const type of LOST) root.removeEventListener(type, lose, true);
    for (const { target, event } of held) {
      const Again = event.constructor as typeof Event;
      target.dispatchEvent(new Again(event.type, event));
    }
  };
}
