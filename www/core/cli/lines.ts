// Splits a stream into lines, independent of its chunks. The rest of a line that is too long is skipped.
import { StringDecoder } from "node:string_decoder";

export interface Line {
  /** Line number, from 1. */
  number: number;
  text: string;
  /** Whether the line was too long; it then has no text. */
  tooLong: boolean;
}

export async function* linesOf(
  stream: AsyncIterable<Buffer | string>,
  longest: number,
): AsyncGenerator<Line> {
  const decoder = new StringDecoder("utf8");
  let text = "";
  let number = 1;
  let tooLong = false;
  for await (const chunk of stream) {
    const parts = (
      text + (typeof chunk === "string" ? chunk : decoder.write(chunk))
    ).split("\n");
    text = parts.pop() as string;
    for (const part of parts) {
      const over = tooLong || part.length > longest;
      yield { number: number++, text: over ? "" : part, tooLong: over };
      tooLong = false;
    }
    if (text.length > longest) {
      text = "";
      tooLong = true;
    }
  }
  text += decoder.end();
  if (text !== "" || tooLong)
    yield { number, text: tooLong ? "" : text, tooLong };
}
