// A whole state in a link. The fragment of an address is never sent to a server.
import { isObject } from "./job.js";

/** Content of a link. Links of version 1 stay readable. */
export interface Shared {
  job: unknown;
  /** Measured points, as text in the job's units. */
  measured: string;
}

const KEY = "#job1=";
/** Maximum length of a link: some programs truncate longer ones. */
const LONGEST_LINK = 30_000;

/** Fragment of a state; null if it exceeds the maximum length. */
export async function toFragment(state: Shared): Promise<string | null> {
  const bytes = await through(
    new TextEncoder().encode(JSON.stringify(state)),
    new CompressionStream("deflate-raw"),
  );
  const text = Array.from(bytes ?? [], (byte) =>
    String.fromCharCode(byte),
  ).join("");
  const fragment =
    KEY +
    btoa(text).replaceAll("+", "-").replaceAll("/", "_").replace(/=+$/, "");
  return fragment.length > LONGEST_LINK ? null : fragment;
}

/** Whether a fragment belongs to a link of this page. */
export const isFragment = (hash: string): boolean => hash.startsWith("#job");

/** State of a fragment; null if it cannot be read. Unpacks at most a fixed number of characters. */
export async function fromFragment(
  hash: string,
  longest: number,
): Promise<Shared | null> {
  if (!hash.startsWith(KEY) || hash.length > LONGEST_LINK) return null;
  try {
    const text = atob(
      hash.slice(KEY.length).replaceAll("-", "+").replaceAll("_", "/"),
    );
    const packed = Uint8Array.from(text, (c) => c.charCodeAt(0));
    const bytes = await through(
      packed,
      new DecompressionStream("deflate-raw"),
      longest,
    );
    const state: unknown =
      bytes &&
      JSON.parse(new TextDecoder("utf-8", { fatal: true }).decode(bytes));
    if (!isObject(state)) return null;
    const { job, measured } = state;
    return { job, measured: typeof measured === "string" ? measured : "" };
  } catch {
    return null;
  }
}

/** Pipes bytes through a stream; null if the output exceeds the maximum. */
async function through(
  bytes: Uint8Array<ArrayBuffer>,
  stream: CompressionStream | DecompressionStream,
  longest = Number.POSITIVE_INFINITY,
): Promise<Uint8Array | null> {
  const reader = new Blob([bytes]).stream().pipeThrough(stream).getReader();
  const parts: Uint8Array<ArrayBuffer>[] = [];
  let length = 0;
  for (
    let { done, value } = await reader.read();
    !done;
    { done, value } = await reader.read()
  ) {
    if (!value) continue;
    length += value.length;
    if (length > longest) {
      await reader.cancel();
      return null;
    }
    parts.push(value);
  }
  return new Uint8Array(await new Blob(parts).arrayBuffer());
}
