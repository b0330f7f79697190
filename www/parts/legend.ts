import { html, type TemplateResult } from "lit";

/** How kinds of lines are drawn: the dashes of src/view/canvas, and the width of the stroke. */
const STROKES = {
  touch: ["", 3],
  link: ["6 4", 2],
  position: ["9 4 2 4", 2],
  rapid: ["12 5", 1],
  ghost: ["1.5 3.5", 2],
  actual: ["7 4", 2],
} as const;

/** A kind of lines with a piece of one: told apart by its dashes, where colours are not seen. */
export function kind(
  name: keyof typeof STROKES,
  words: string,
): TemplateResult {
  const [dashes, width] = STROKES[name];
  return html`<li class=${name}><svg viewBox="0 0 34 4" aria-hidden="true"><line x2="34" y1="2" y2="2" stroke-width=${width} stroke-dasharray=${dashes}></line></svg>${words}</li>`;
}
