// Texts of files that are written again with the same bytes: UTF-8, or else one byte a character.

/** A text, and whether its file is UTF-8. */
export interface FileText {
  text: string;
  isUtf8: boolean;
}

/** The text of a file. A mark of the byte order stays in it. */
export function textOfBytes(bytes: Uint8Array): FileText {
  try {
    const decoder = new TextDecoder("utf-8", { fatal: true, ignoreBOM: true });
    return { text: decoder.decode(bytes), isUtf8: true };
  } catch {
    const PIECE = 8192;
    let text = "";
    for (let from = 0; from < bytes.length; from += PIECE)
      text += String.fromCharCode(...bytes.subarray(from, from + PIECE));
    return { text, isUtf8: false };
  }
}

/** The bytes of such a text. */
export const bytesOfText = ({
  text,
  isUtf8,
}: FileText): Uint8Array<ArrayBuffer> =>
  isUtf8
    ? new TextEncoder().encode(text)
    : Uint8Array.from(text, (letter) => letter.charCodeAt(0));
