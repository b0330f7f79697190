// Where in the text of a job a finding stands.

/** A place in a text, both counted from 1. */
export interface Place {
  line: number;
  column: number;
}

const BLANK = /\s/;

/** Behind white space. */
function past(text: string, i: number): number {
  let at = i;
  while (at < text.length && BLANK.test(text[at] as string)) at++;
  return at;
}

/** Behind a string that begins here. */
function pastString(text: string, i: number): number {
  let at = i + 1;
  while (at < text.length && text[at] !== '"') at += text[at] === "\\" ? 2 : 1;
  return at + 1;
}

/** Behind a value that begins here, however deep it is. */
function pastValue(text: string, i: number): number {
  let depth = 0;
  let at = i;
  do {
    const sign = text[at];
    if (sign === '"') {
      at = pastString(text, at);
      continue;
    }
    if (sign === "{" || sign === "[") depth++;
    else if (sign === "}" || sign === "]") depth--;
    at++;
    if (depth > 0) continue;
    if (sign === "}" || sign === "]") break;
    // A number or a word ends before what separates.
    while (at < text.length && !/[\s,\]}]/.test(text[at] as string)) at++;
    break;
  } while (at < text.length);
  return at;
}

/** What lies in a list or an object that begins here: where each begins, where its value begins, and its key. */
function* inside(text: string, i: number): Generator<{ at: number; value: number; key: string }> {
  const object = text[i] === "{";
  let at = past(text, i + 1);
  for (let n = 0; at < text.length && text[at] !== "}" && text[at] !== "]"; n++) {
    let [key, value] = [`[${n}]`, at];
    if (object) {
      const end = pastString(text, at);
      key = JSON.parse(text.slice(at, end)) as string;
      value = past(text, past(text, end) + 1);
    }
    yield { at, value, key };
    at = past(text, pastValue(text, value));
    if (text[at] === ",") at = past(text, at + 1);
  }
}

/** Where a path such as `cycles[1].origin[0]` stands in a JSON text; of what is not there, that in which it is missing. */
export function placeOf(text: string, path: string): Place {
  let value = past(text, 0);
  let at = value;
  for (let rest = path; rest !== "" && (text[value] === "{" || text[value] === "["); ) {
    // A key may have dots in it: the longest that fits is meant, and of a key that is there twice the last one.
    let found: { at: number; value: number; key: string } | null = null;
    for (const one of inside(text, value)) {
      const fits = rest === one.key || rest.startsWith(`${one.key}.`) || rest.startsWith(`${one.key}[`);
      if (fits && one.key !== "" && (!found || one.key.length >= found.key.length)) found = one;
    }
    if (!found) break;
    ({ at, value } = found);
    rest = rest.slice(found.key.length).replace(/^\./, "");
  }
  const before = text.slice(0, at);
  const line = before.split("\n").length;
  return { line, column: at - before.lastIndexOf("\n") };
}
