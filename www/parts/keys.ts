/** Letter of a key in a shortcut: the typed letter, or for another script the Latin letter on the same key. */
export function letterOf({ key, code }: KeyboardEvent): string {
  const other = /^\p{L}$/u.test(key) && !/\p{Script=Latin}/u.test(key);
  return (other ? code.replace(/^Key/, "") : key).toLowerCase();
}
