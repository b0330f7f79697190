/** The letter that a key stands for in a shortcut: what it types, and on a layout without Latin letters what stands in its place on one with them. */
export function letterOf({ key, code }: KeyboardEvent): string {
  return (/^[a-z]$/i.test(key) ? key : code.replace(/^Key/, "")).toLowerCase();
}
