import { html, type TemplateResult } from "lit";

/** Line styles of the legend: the dashes of src/view/canvas, and the stroke width. */
const STROKES = {
  touch: ["", 3],
  link: ["6 4", 2],
  position: ["9 4 2 4", 2],
  rapid: ["12 5", 1],
  ghost: ["1.5 3.5", 2],
  actual: ["7 4", 2],
} as const;

/** A kind of line with a sample of it. Dashes distinguish kinds without colour. */
export function kind(
  name: keyof typeof STROKES,
  words: string,
): TemplateResult {
  const [dashes, width] = STROKES[name];
  return html`<li class=${name}><svg viewBox="0 0 34 4" aria-hidden="true"><line x2="34" y1="2" y2="2" stroke-width=${width} stroke-dasharray=${dashes}></line></svg>${words}</li>`;
}
