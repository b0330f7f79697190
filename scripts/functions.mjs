// Analyses the functions of a WebAssembly module.

/** Functions of a module with names, with their bytes, largest first. */
export function functions(/** @type {Buffer} */ wasm) {
  let i = 8;
  const number = () => {
    let [value, shift] = [0, 0];
    for (;;) {
      const byte = wasm[i++] ?? 0;
      value += (byte & 127) * 2 ** shift;
      shift += 7;
      if (byte < 128) return value;
    }
  };
  const text = () => {
    const length = number();
    i += length;
    return wasm.toString("utf8", i - length, i);
  };
  let imported = 0;
  /** @type {number[]} */
  const sizes = [];
  /** @type {Map<number, string>} */
  const names = new Map();
  while (i < wasm.length) {
    const section = number();
    const length = number();
    const end = i + length;
    if (section === 2) {
      for (let count = number(); count > 0; count--) {
        text();
        text();
        const kind = number();
        if (kind === 0) imported++;
        // A global has a type and its mutability; a table has a type in front of its limits.
        if (kind === 1 || kind === 3) number();
        const limits = number();
        if (kind === 1 || kind === 2)
          for (let n = limits & 1 ? 2 : 1; n > 0; n--) number();
      }
    } else if (section === 10) {
      for (let count = number(); count > 0; count--) {
        const size = number();
        sizes.push(size);
        i += size;
      }
    } else if (section === 0 && text() === "name") {
      while (i < end) {
        const part = number();
        const stop = number() + i;
        if (part === 1)
          for (let count = number(); count > 0; count--)
            names.set(number(), text());
        i = stop;
      }
    }
    i = end;
  }
  const named = sizes.map((size, n) => ({
    size,
    name: (names.get(n + imported) ?? "?")
      .replace(/^_ZN\d+|17h[0-9a-f]{16}E$/g, "")
      .replace(/\d+(?=[a-z_$])/gi, "::"),
  }));
  return named.sort((a, b) => b.size - a.size);
}

const FOLDERS = new Set([
  "fanuc",
  "grbl",
  "heidenhain",
  "iso",
  "linuxcnc",
  "own",
  "renishaw",
  "sinumerik",
]);

/** Code bytes of each folder of the crate and each control, largest first, for a module as the compiler left it. */
export function rooms(/** @type {Buffer} */ wasm) {
  /** @type {Map<string, number>} */
  const sums = new Map();
  for (const { name, size } of functions(wasm)) {
    const [, room = "the rest", inner = ""] =
      /touchpath\W+([a-z_]+)\W+([a-z_0-9]+)/.exec(
        name.replaceAll("..", "::"),
      ) ?? [];
    // A control is a folder; files next to the folders belong to all controls.
    const named =
      room === "control" && FOLDERS.has(inner) ? `control::${inner}` : room;
    sums.set(named, (sums.get(named) ?? 0) + size);
  }
  return [...sums].sort(([, a], [, b]) => b - a);
}
