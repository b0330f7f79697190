// Removes panic messages. A panic in WebAssembly is an `unreachable`: its message cannot be printed and only costs bytes.
import { readFileSync, writeFileSync } from "node:fs";

/** Functions of Rust's libraries that only build a panic message and never return. */
const PANICS = [
  /^core(\[\w+\])?::(panicking::|slice::index::slice_index_fail|option::(unwrap|expect)_failed|result::unwrap_failed|cell::panic_|str::slice_error_fail)/,
  /^alloc(\[\w+\])?::(raw_vec::(handle_error|capacity_overflow)|alloc::handle_alloc_error)/,
  /^<?std(\[\w+\])?::panicking::(panic_handler|panic_with_hook|begin_panic)/,
];

/**
 * Expected minimum of matches. Another compiler may use other functions and source locations: the module then works but is larger, and the build prints a note.
 */
const FEWEST = { functions: 8, places: 200 };

/**
 * Parts of binaryen that its types omit.
 * @typedef {{Function: {setBody(fn: unknown, body: unknown): void}}} Bodies
 * @typedef {{getNumDataSegments(): number, getDataSegmentInfo(segment: unknown): {offset: number, data: ArrayBuffer}}} Segments
 */

/** Blanks every source location in a module's data: pointer and length of a name that ends in `.rs`, line and column, four bytes each. Returns their number. */
function blankPlaces(/** @type {Buffer} */ data, /** @type {number} */ offset) {
  /** @type {Map<number, number>} */
  const names = new Map();
  let places = 0;
  for (let i = (4 - (offset % 4)) % 4; i + 16 <= data.length; i += 4) {
    const start = data.readUInt32LE(i) - offset;
    const length = data.readUInt32LE(i + 4);
    const line = data.readUInt32LE(i + 8);
    const column = data.readUInt32LE(i + 12);
    if (
      start < 0 ||
      start + length > data.length ||
      length > 300 ||
      line > 30_000 ||
      column > 300
    )
      continue;
    if (!/^[!-~]+\.rs$/.test(data.toString("latin1", start, start + length)))
      continue;
    names.set(start, length);
    data.fill(0, i, i + 16);
    places++;
  }
  for (const [start, length] of names) data.fill(0, start, start + length);
  return places;
}

/**
 * Removes what only panic messages need from a module with names. Each function that builds a message becomes a trap, and the source locations are blanked. The
 * next optimization removes functions that only these called.
 */
export async function trapPanics(/** @type {string} */ path) {
  // Loaded here: on a fresh machine the same command installs the package.
  const { default: binaryen } = await import("binaryen");
  const module = binaryen.readBinary(readFileSync(path));
  binaryen.setDebugInfo(true);
  const bodies = /** @type {Bodies} */ (/** @type {unknown} */ (binaryen))
    .Function;
  let functions = 0;
  for (let i = 0; i < module.getNumFunctions(); i++) {
    const fn = module.getFunctionByIndex(i);
    const { name, base } = binaryen.getFunctionInfo(fn);
    const plain = name.replaceAll(/\\([0-9a-f]{2})/g, (_, code) =>
      String.fromCharCode(Number.parseInt(code, 16)),
    );
    if (base || !PANICS.some((panic) => panic.test(plain))) continue;
    bodies.setBody(fn, module.unreachable());
    functions++;
  }
  if (!module.validate())
    throw new Error("The module without messages of panics is not valid");
  const binary = Buffer.from(module.emitBinary());
  const segments = /** @type {Segments} */ (/** @type {unknown} */ (module));
  let places = 0;
  for (let i = 0; i < segments.getNumDataSegments(); i++) {
    const { offset, data } = segments.getDataSegmentInfo(
      module.getDataSegmentByIndex(i),
    );
    const at = binary.indexOf(Buffer.from(data));
    if (at < 0) continue;
    places += blankPlaces(binary.subarray(at, at + data.byteLength), offset);
  }
  module.dispose();
  if (functions < FEWEST.functions || places < FEWEST.places)
    console.warn(
      `Of the messages of panics only ${functions} functions and ${places} places were found: the module is larger`,
    );
  writeFileSync(path, binary);
}
