// Splits the module by use. The first part has every function that a first visit, all ENCY cycles and the edits of their forms run; the second part joins its
// memory and table. A function of the second part that is called too early traps; it never runs wrong code.
import { spawnSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath } from "node:url";

/** binaryen's names of the function table and the memory. */
const TABLE = "0";
const MEMORY = "0";
const EXTERNREFS = "__wbindgen_externrefs";
/** Import name of the second part: the exports of the first. */
const FIRST = "p";
/** Table entry of an element that is not loaded yet. */
const MISSING = "missing__";

/** Functions that only run in a browser, by words of their names: the picture, and wasm-bindgen's support. */
const PICTURE =
  /view|View|picture|lengths|web_sys|js_sys|FnOnce::call_once|dlmalloc|__wbindgen|__externref|wasm::Last/;

/** Pictures that a first visit does not draw: opened programs, tool lengths, SVG. */
const RARE =
  /svg|show_?program|show_?run|show_?lentoax|show_moves|path_of|of_program|whole::rows|draw_arrows/i;

/**
 * Parts of binaryen that its types omit.
 * @typedef {any} Binaryen
 * @typedef {{ name: string, module: string, base: string, params: number, results: number }} Fn
 */

/** A name as Rust writes it: binaryen escapes characters that are no letters. */
const plain = (/** @type {string} */ name) =>
  name.replaceAll(/\\([0-9a-f]{2})/g, (_, code) =>
    String.fromCharCode(Number.parseInt(code, 16)),
  );

/** Loaded here: on a fresh machine the same command installs the package. @returns {Promise<Binaryen>} */
const load = async () => (await import("binaryen")).default;

/** @returns {Fn[]} */
const functionsOf = (/** @type {Binaryen} */ b, /** @type {any} */ module) =>
  Array.from({ length: module.getNumFunctions() }, (_, i) =>
    b.getFunctionInfo(module.getFunctionByIndex(i)),
  );

/** A module in which every function reports its index to `env.hit` before it runs, and the names of the functions. */
async function counting(/** @type {Buffer} */ bytes) {
  const b = await load();
  const module = b.readBinary(bytes);
  module.addFunctionImport("hit__", "env", "hit", b.i32, b.none);
  const names = functionsOf(b, module)
    .filter(({ base }) => !base)
    .map(({ name }) => name);
  for (const [index, name] of names.entries()) {
    const fn = module.getFunction(name);
    const { body, results } = b.getFunctionInfo(fn);
    const hit = module.call("hit__", [module.i32.const(index)], b.none);
    b.Function.setBody(fn, module.block(null, [hit, body], results));
  }
  const counted = Buffer.from(module.emitBinary());
  module.dispose();
  return { counted, names };
}

/** Names of the functions that the jobs of `scripts/profile.mjs` run. */
async function profile(/** @type {Buffer} */ bytes) {
  const { counted, names } = await counting(bytes);
  const folder = mkdtempSync(join(tmpdir(), "touchpath-"));
  const [module, hits] = [join(folder, "module.wasm"), join(folder, "hits")];
  writeFileSync(module, counted);
  const script = fileURLToPath(new URL("profile.mjs", import.meta.url));
  const { status } = spawnSync("node", [script, module, hits], {
    stdio: "inherit",
  });
  if (status !== 0) throw new Error("the profile of the module did not run");
  const ran = readFileSync(hits);
  rmSync(folder, { recursive: true });
  return new Set(names.filter((_, index) => ran[index] === 1));
}

/** The function in each slot of the table. */
function slotsOf(/** @type {Binaryen} */ b, /** @type {any} */ module) {
  /** @type {Map<number, string>} */
  const slots = new Map();
  for (let i = 0; i < module.getNumElementSegments(); i++) {
    const segment = b.getElementSegmentInfo(module.getElementSegmentByIndex(i));
    const begin = b.getExpressionInfo(segment.offset).value;
    for (const [k, name] of segment.data.entries()) slots.set(begin + k, name);
  }
  return slots;
}

/** Replaces functions in slots of the table. */
function fill(
  /** @type {Binaryen} */ b,
  /** @type {any} */ module,
  /** @type {Map<number, string>} */ slots,
) {
  for (let i = module.getNumElementSegments() - 1; i >= 0; i--) {
    const segment = module.getElementSegmentByIndex(i);
    module.removeElementSegment(b.getElementSegmentInfo(segment).name);
  }
  /** @type {{ begin: number, names: string[] }[]} */
  const runs = [];
  for (const [slot, name] of [...slots].sort(([a], [b]) => a - b)) {
    const last = runs.at(-1);
    if (last && last.begin + last.names.length === slot) last.names.push(name);
    else runs.push({ begin: slot, names: [name] });
  }
  for (const [i, { begin, names }] of runs.entries())
    module.addActiveElementSegment(
      TABLE,
      `e${i}`,
      names,
      module.i32.const(begin),
    );
}

/** Bytes of a module without its data and data count: the first part has the memory and its content. */
function withoutData(/** @type {Buffer} */ bytes) {
  const [DATA, COUNT] = [11, 12];
  const parts = [bytes.subarray(0, 8)];
  for (let at = 8; at < bytes.length; ) {
    const id = bytes[at];
    let [length, shift, next] = [0, 0, at + 1];
    for (let byte = 0x80; byte & 0x80; shift += 7) {
      byte = bytes[next++] ?? 0;
      length |= (byte & 0x7f) << shift;
    }
    const end = next + length;
    if (id !== DATA && id !== COUNT) parts.push(bytes.subarray(at, end));
    at = end;
  }
  return Buffer.concat(parts);
}

/** A call of the function in a slot, with the function's own parameters. */
const through = (
  /** @type {Binaryen} */ b,
  /** @type {any} */ module,
  /** @type {Fn} */ { params, results },
  /** @type {number} */ slot,
) =>
  module.call_indirect(
    TABLE,
    module.i32.const(slot),
    b
      .expandType(params)
      .map((/** @type {number} */ type, /** @type {number} */ i) =>
        module.local.get(i, type),
      ),
    params,
    results,
  );

/**
 * The first part: a cold function becomes a call through the table, or is removed if nothing calls it.
 * @param {Binaryen} b
 * @param {any} module
 * @param {Fn[]} all
 * @param {Set<string>} cold
 */
function firstPart(b, module, all, cold) {
  const slots = slotsOf(b, module);
  /** @type {Map<string, number>} */
  const slotOf = new Map();
  for (const [slot, name] of slots)
    if (!slotOf.has(name)) slotOf.set(name, slot);
  const size = b.getTableInfo(module.getTable(TABLE)).initial;
  let next = size;
  for (const fn of all.filter(({ name }) => cold.has(name))) {
    const slot = slotOf.get(fn.name) ?? next++;
    slotOf.set(fn.name, slot);
    module.removeFunction(fn.name);
    module.addFunction(
      fn.name,
      fn.params,
      fn.results,
      [],
      through(b, module, fn, slot),
    );
  }
  module.addFunction(MISSING, b.none, b.none, [], module.unreachable());
  const early = [...slots].map(([slot, name]) => [
    slot,
    cold.has(name) ? MISSING : name,
  ]);
  fill(b, module, new Map(/** @type {[number, string][]} */ (early)));
  module.addTableExport(TABLE, "t");
  module.runPasses(["remove-unused-module-elements"]);
  return { slots, slotOf, size };
}

/**
 * Splits a module with names; `hot` selects the functions of the first part.
 * @param {Binaryen} b
 * @param {Buffer} bytes
 * @param {(name: string) => boolean} hot
 * @returns {{ first: Buffer, rest: Buffer }}
 */
function parts(b, bytes, hot) {
  const [first, rest] = [b.readBinary(bytes), b.readBinary(bytes)];
  const all = functionsOf(b, first);
  const cold = new Set(
    all.filter(({ name, base }) => !base && !hot(name)).map(({ name }) => name),
  );
  const { slots, slotOf, size } = firstPart(b, first, all, cold);
  const there = functionsOf(b, first);
  const left = new Set(there.map(({ name }) => name));
  // Hot functions that only cold ones call belong to the second part.
  const lost = all.filter(({ name }) => !cold.has(name) && !left.has(name));
  if (lost.some(({ base }) => !base)) {
    first.dispose();
    rest.dispose();
    const names = new Set(lost.map(({ name }) => name));
    return parts(b, bytes, (name) => hot(name) && !names.has(name));
  }
  for (const { name, module, base, params, results } of lost)
    first.addFunctionImport(name, module, base, params, results);
  // Only functions that the first part calls need a new slot.
  let end = size;
  /** @type {Map<number, string>} */
  const late = new Map([...slots].filter(([, name]) => cold.has(name)));
  for (const fn of there) {
    const slot = cold.has(fn.name) ? (slotOf.get(fn.name) ?? 0) : 0;
    if (slot < size) continue;
    b.Function.setBody(first.getFunction(fn.name), through(b, first, fn, end));
    late.set(end++, fn.name);
  }
  first.removeExport("t");
  first.removeTable(TABLE);
  first.addTable(TABLE, end, end);
  first.addTableExport(TABLE, "t");

  for (let i = rest.getNumExports() - 1; i >= 0; i--)
    rest.removeExport(b.getExportInfo(rest.getExportByIndex(i)).name);
  fill(b, rest, late);
  for (const { name, params, results } of all.filter(
    ({ name }) => !cold.has(name),
  )) {
    rest.removeFunction(name);
    rest.addFunctionImport(name, FIRST, name, params, results);
  }
  rest.addMemoryImport(MEMORY, FIRST, "memory");
  rest.removeTable(TABLE);
  rest.addTable(TABLE, end, end);
  rest.addTableImport(TABLE, FIRST, "t");
  rest.addTableImport(EXTERNREFS, FIRST, EXTERNREFS);
  const globals = Array.from({ length: first.getNumGlobals() }, (_, i) =>
    b.getGlobalInfo(first.getGlobalByIndex(i)),
  );
  for (const { name, type, mutable } of globals) {
    rest.removeGlobal(name);
    rest.addGlobalImport(name, FIRST, name, type, mutable);
  }
  rest.runPasses(["remove-unused-module-elements"]);
  hand(b, first, rest);
  for (const module of [first, rest])
    if (!module.validate())
      throw new Error("a part of the module is not valid");
  b.setDebugInfo(false);
  for (const module of [first, rest]) module.runPasses(["strip-debug"]);
  const made = {
    first: Buffer.from(first.emitBinary()),
    rest: withoutData(Buffer.from(rest.emitBinary())),
  };
  first.dispose();
  rest.dispose();
  return made;
}

/** An import of the second part becomes an export of the first, with a short name in capitals, which is unique there. */
function hand(
  /** @type {Binaryen} */ b,
  /** @type {any} */ first,
  /** @type {any} */ rest,
) {
  let count = 0;
  const short = () => (count++).toString(36).toUpperCase();
  for (const { name, params, results } of functionsOf(b, rest).filter(
    ({ base }) => base,
  )) {
    const own = short();
    rest.removeFunction(name);
    rest.addFunctionImport(name, FIRST, own, params, results);
    first.addFunctionExport(name, own);
  }
  const globals = Array.from({ length: rest.getNumGlobals() }, (_, i) =>
    b.getGlobalInfo(rest.getGlobalByIndex(i)),
  );
  for (const { name, type, mutable } of globals) {
    const own = short();
    rest.removeGlobal(name);
    rest.addGlobalImport(name, FIRST, own, type, mutable);
    first.addGlobalExport(name, own);
  }
}

/** A module without its names. */
export async function unnamed(/** @type {Buffer} */ bytes) {
  const b = await load();
  const module = b.readBinary(bytes);
  b.setDebugInfo(false);
  module.runPasses(["strip-debug"]);
  const binary = Buffer.from(module.emitBinary());
  module.dispose();
  return binary;
}

/** Functions that each function calls, by name. */
function callsOf(/** @type {Binaryen} */ b, /** @type {Buffer} */ bytes) {
  const module = b.readBinary(bytes);
  const text = /** @type {string} */ (module.emitText());
  module.dispose();
  /** @type {Map<string, Set<string>>} */
  const calls = new Map();
  let own = new Set();
  for (const [, word, quoted, bare = ""] of text.matchAll(
    /\((func|call|return_call) \$(?:"([^"]*)"|([^\s()]+))/g,
  )) {
    const name = quoted ?? bare;
    if (word === "func") {
      own = new Set();
      calls.set(name, own);
    } else own.add(name);
  }
  return calls;
}

/** These functions with the functions of Rust's libraries that they call. */
function withLibraries(
  /** @type {Set<string>} */ names,
  /** @type {Map<string, Set<string>>} */ calls,
) {
  const all = new Set(names);
  for (const name of all)
    for (const called of calls.get(name) ?? [])
      if (!plain(called).includes("touchpath")) all.add(called);
  return all;
}

/** Both parts of a module with names. */
export async function split(/** @type {Buffer} */ bytes) {
  const b = await load();
  b.setDebugInfo(true);
  const ran = await profile(bytes);
  const calls = callsOf(b, bytes);
  const picture = [...calls.keys()].filter(
    (name) => PICTURE.test(plain(name)) && !RARE.test(plain(name)),
  );
  const hot = withLibraries(new Set([...ran, ...picture]), calls);
  return parts(b, bytes, (name) => hot.has(name));
}
