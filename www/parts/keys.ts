/** The letter that a key stands for in a shortcut: what it types, and where that is a letter of another script what is in its place in Latin. */
export function letterOf({ key, code }: KeyboardEvent): string {
  const other = /^\p{L}$/u.test(key) && !/\p{Script=Latin}/u.test(key);
  return (other ? code.replace(/^Key/, "") : key).toLowerCase();
}
