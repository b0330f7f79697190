// Shared by the tests of the page's state: the modules that the page loads, without those that draw, on the real core.
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before } from "node:test";
import { pathToFileURL } from "node:url";
import { build } from "vite";
import { at, root } from "../../scripts/lib.mjs";

/** Modules of `www` that need no document, by the name used here. */
const MODULES = {
  store: "store.ts",
  number: "number.ts",
  text: "read-text.ts",
  setups: "set-ups.ts",
  presets: "presets.ts",
  search: "search.ts",
  sentences: "sentences.ts",
  words: "words.ts",
};

/** @type {any} */
export let Store;
/** What a text from outside is. @type {(text: string) => any} */
export let read;
/** @type {(text: string, unit?: string, units?: string, comma?: boolean, size?: boolean) => number | string} */
export let readNumber;
/** The ready set-ups. @type {any[]} */
export let SET_UPS;
/** @type {any} */
export let presets;
/** @type {any} */
export let search;
/** @type {any} */
export let sentences;
/** @type {any} */
export let words;

/** Builds them for Node and loads them. A test file is a separate process and builds once. */
export function setUp() {
  /** @type {string} */
  let folder;
  before(async () => {
    folder = mkdtempSync(join(tmpdir(), "touchpath-state-"));
    // In Node the package's entry for Node replaces the one for browsers.
    const core = pathToFileURL(at("dist", "node.js")).href;
    await build({
      root,
      configFile: false,
      logLevel: "silent",
      build: {
        ssr: true,
        rolldownOptions: {
          input: Object.fromEntries(
            Object.entries(MODULES).map(([name, file]) => [
              name,
              at("www", file),
            ]),
          ),
        },
        outDir: folder,
        emptyOutDir: true,
      },
      plugins: [
        {
          name: "core",
          enforce: "pre",
          resolveId: (id) =>
            id.endsWith("core/browser.js")
              ? { id: core, external: true }
              : null,
        },
      ],
    });
    const load = (/** @type {keyof typeof MODULES} */ name) =>
      import(pathToFileURL(join(folder, `${name}.js`)).href);
    ({ Store } = await load("store"));
    ({ readNumber } = await load("number"));
    ({ read } = await load("text"));
    ({ SET_UPS } = await load("setups"));
    [presets, search, sentences, words] = await Promise.all([
      load("presets"),
      load("search"),
      load("sentences"),
      load("words"),
    ]);
  });
  after(() => rmSync(folder, { recursive: true, force: true }));
}

/** Types a text into the field of a path, like the page's form. */
export function type(
  /** @type {any} */ store,
  /** @type {string} */ path,
  /** @type {string} */ text,
) {
  const { unit, size } = store.fieldAt(path);
  store.set(
    path,
    readNumber(
      text,
      unit,
      store.units,
      store.comma,
      size && !path.startsWith("part."),
    ),
    text,
  );
}

/** The errors, warnings and notes at a path, in words. */
export const said = (/** @type {any} */ store, /** @type {string} */ path) =>
  store.at(path).map((/** @type {any} */ finding) => finding.message);

/** The lines of the program. @returns {string} */
export const program = (/** @type {any} */ store) =>
  store.plan.program.text.trimEnd();

/** What a store tells its user beside what was asked for, in words. */
export function listen(/** @type {any} */ store) {
  /** @type {string[]} */
  const told = [];
  store.addEventListener("announcement", (/** @type {any} */ event) =>
    told.push(store.say(event.detail)),
  );
  return told;
}

/**
 * Lets a store keep its state, as in a browser whose storage holds these texts at first. Nothing is drawn and no page is left:
 * whether a reload finds what was typed, the page's own tests ask.
 * @param {Record<string, string>} kept
 * @param {() => void} work
 * @param {string} language
 */
export function asInBrowser(kept, work, language = "en-GB") {
  const storage = (/** @type {Map<string, string>} */ texts) => ({
    getItem: (/** @type {string} */ key) => texts.get(key) ?? null,
    setItem: (/** @type {string} */ key, /** @type {string} */ text) =>
      void texts.set(key, text),
  });
  /** @type {Record<string, unknown>} */
  const own = {
    localStorage: storage(new Map(Object.entries(kept))),
    sessionStorage: storage(new Map()),
    navigator: { languages: [language] },
    document: new EventTarget(),
    addEventListener: () => {},
  };
  const before = Object.keys(own).map((name) => [
    name,
    Object.getOwnPropertyDescriptor(globalThis, name),
  ]);
  for (const [name, value] of Object.entries(own))
    Object.defineProperty(globalThis, name, {
      value,
      configurable: true,
      writable: true,
    });
  try {
    work();
  } finally {
    for (const [name, descriptor] of before)
      if (descriptor)
        Object.defineProperty(
          globalThis,
          String(name),
          /** @type {PropertyDescriptor} */ (descriptor),
        );
      else Reflect.deleteProperty(globalThis, String(name));
  }
}
