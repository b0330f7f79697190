// Codes any value of a caller as numbers and one text: counterpart of src/border/coded.rs. The walk never throws and always ends, for circular objects,
// throwing getters and lists of any length. It runs in JavaScript because every access from the module costs a call.
import {
  DEEPEST,
  FALSE,
  LIST,
  MAP,
  MOST_TEXT,
  MOST_VALUES,
  NO_DATA,
  NULL,
  NUMBER,
  OTHER,
  TEXT,
  TOO_DEEP,
  TOO_LONG,
  TOO_MANY,
  TOO_MANY_KEYS,
  TOO_MUCH_TEXT,
  TRUE,
  UNDEFINED,
  UNREADABLE,
} from "./layout.js";

/** A coded value. Tags and counts as in src/border/coded.rs; all texts are joined, each with a line feed after it. */
export interface Coded {
  codes: Float64Array;
  text: string;
}

const TOO_LARGE = [TOO_DEEP, TOO_LONG, TOO_MANY, TOO_MANY_KEYS, TOO_MUCH_TEXT];

class Coder {
  readonly codes: number[] = [];
  text = "";
  /** Whether a part of the value was left out because of its size. */
  cut = false;
  private values = MOST_VALUES;

  walk(value: unknown, depth: number): void {
    switch (typeof value) {
      case "number":
        this.codes.push(NUMBER, value);
        break;
      case "string":
        if (this.fits(value)) {
          this.codes.push(TEXT, value.length);
          this.text += `${value}\n`;
        } else this.other(TOO_MUCH_TEXT);
        break;
      case "boolean":
        this.codes.push(value ? TRUE : FALSE);
        break;
      case "undefined":
        this.other(UNDEFINED);
        break;
      case "object":
        if (value === null) this.codes.push(NULL);
        else this.object(value, depth);
        break;
      default:
        this.other(NO_DATA);
    }
  }

  /** Codes the entries of an object, or no entry if the object cannot be read. */
  private object(value: object, depth: number): void {
    if (depth === DEEPEST) {
      this.other(TOO_DEEP);
      return;
    }
    const [codes, text] = [this.codes.length, this.text];
    let list: boolean;
    let keys: (string | symbol)[];
    try {
      list = Array.isArray(value);
      keys = list ? [] : Reflect.ownKeys(value);
    } catch {
      this.other(UNREADABLE);
      return;
    }
    if (list) {
      this.list(value as unknown[], depth);
      return;
    }
    if (keys.length > MOST_VALUES) {
      this.other(TOO_MANY_KEYS);
      return;
    }
    this.codes.push(MAP, 0);
    let count = 0;
    for (const key of keys) {
      // A job has no symbol keys.
      if (typeof key !== "string") continue;
      if (!this.fits(key)) {
        this.codes.length = codes;
        this.text = text;
        this.other(TOO_MUCH_TEXT);
        return;
      }
      const before = this.codes.length;
      const said = this.text;
      this.codes.push(key.length);
      this.text += `${key}\n`;
      this.inner(value, key, depth);
      // A key with the value undefined counts as absent.
      if (
        this.codes[before + 1] === OTHER &&
        this.codes[before + 2] === UNDEFINED
      ) {
        this.codes.length = before;
        this.text = said;
      } else count++;
    }
    this.codes[codes + 1] = count;
  }

  private list(value: unknown[], depth: number): void {
    let length: unknown;
    try {
      length = value.length;
    } catch {}
    if (typeof length !== "number" || !(length >= 0)) this.other(UNREADABLE);
    else if (length > MOST_VALUES) this.other(TOO_LONG);
    else {
      const whole = Math.floor(length);
      this.codes.push(LIST, whole);
      for (let i = 0; i < whole; i++) this.inner(value, i, depth);
    }
  }

  /** Value of a key, which a getter may compute. */
  private inner(value: object, key: string | number, depth: number): void {
    this.values = Math.max(this.values - 1, 0);
    let inner: unknown;
    try {
      inner = (value as Record<string | number, unknown>)[key];
    } catch {
      this.other(UNREADABLE);
      return;
    }
    if (this.values === 0) this.other(TOO_MANY);
    else this.walk(inner, depth + 1);
  }

  private fits(text: string): boolean {
    return this.text.length + text.length <= MOST_TEXT;
  }

  private other(what: number): void {
    this.cut ||= TOO_LARGE.includes(what);
    this.codes.push(OTHER, what);
  }
}

/** Whether two coded values are the same. */
export function same(a: Coded, b: Coded): boolean {
  return (
    a.text === b.text &&
    a.codes.length === b.codes.length &&
    a.codes.every((code, i) => Object.is(code, b.codes[i]))
  );
}

/** Whether a value is too large or too deep for a job. Takes about as long as for the largest job, whatever the value. */
export function isTooLarge(value: unknown): boolean {
  const coder = new Coder();
  coder.walk(value, 0);
  return coder.cut;
}

/** Codes a value. Throws only if the caller's stack is exhausted. */
export function coded(value: unknown): Coded {
  const coder = new Coder();
  coder.walk(value, 0);
  return { codes: new Float64Array(coder.codes), text: coder.text };
}
