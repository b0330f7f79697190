// Size budgets of a first visit: more is a decision, not an accident.
import assert from "node:assert/strict";
import { readdirSync, readFileSync } from "node:fs";
import { test } from "node:test";
import { fileURLToPath } from "node:url";
import { brotliCompressSync, constants, gzipSync } from "node:zlib";
import { functions } from "../../scripts/functions.mjs";

const at = (/** @type {string} */ path) =>
  fileURLToPath(new URL(`../../${path}`, import.meta.url));

/**
 * Bytes. Measured: 731.6 kB for the module, and 840 kB for all that an English page loads sooner or later; before 0.3, 294.3 and 453. What came since: what machines print (17 kB of
 * the module), plausible and complete before the write, the stylus and what a machine needs to stop, what programs do and their numbers, the positive list of codes, macros (19 kB), any
 * program run (57 kB: Klartext, SINUMERIK, the table of calls, what is known and the rules, about a quarter each),
 * Renishaw's macros and the programs that call them (13 kB), both ways of a condition, HEIDENHAIN ISO, moves of its cycles, headings, ranges and Centroid's calls (14 kB), six controls more, HEIDENHAIN's 408 to 427 and CYCLE977 and 978 with their moves, and which word takes which code (22 kB); sentences and search words of cycles, material cut open, what inch begins with (8 kB), and of the page the questions, the manual, the list of everything and machines (14 kB); several cycles in one program (31 kB, and 8 kB of the page) and the angle of a wall (2.5 kB); tolerances with what a program does out of them, and relations (18 kB), on the page too (4 kB), and reports (3 kB of the page); the picture of the first job in the page (1.3 kB); places that follow results (12.7 kB), and rotations and sizes that do (11 kB), also those of relations, which own cycles have too (8.7 kB); HEIDENHAIN set-ups (1 kB), and tools that macros correct (6.6 kB, 2 kB of the page); a portal's rules (14.4 kB, 2 kB of the page), and what works the element from outside (1.5 kB of the page), and panels elsewhere on the page (1.1 kB of it); lines that were read before (3.6 kB); points that are touched several times (3.2 kB); what a native cycle does with a bad result, watched positioning on grbl with the reports of its log, dry runs and fields that nothing uses (7.4 kB), what their macros print (2.6 kB), and the logs of HEIDENHAIN with the probe input and D0 on a SINUMERIK (2.5 kB); sizes with their tolerance (2 kB), and of the page ready set-ups, features beside each other and words to look for (7 kB); the stock, its check, its drawing and its proposal (5.6 kB); where the coordinate system is and what is written (20 kB), and macros of four more controls with their files (9 kB); distances of relations and numbers of a program's touches in the picture (0.6 kB), with their marks in the margin of a program and limits that follow tolerances (1.4 kB of the page); programs inside other programs (18.7 kB, 1.7 kB of the page); lines of the shop and the check of the tool (15 kB, 5 kB of them in the first part), the question before the write (3 kB); what programs compute between native cycles, and single touches (17 kB, nothing of it in the first part), also on a SINUMERIK (5 kB), and tools that moves correct (8 kB, 3 kB of it in the first part); editions of macros, native cycles that ask before they write, tools that cycles of a HEIDENHAIN correct (5.5 kB, 1.3 kB of the page).
 * A first visit begins with the functions that it, all ENCY cycles and the edits of their forms run: 303.1 kB, 478 before. The rest, 372 kB, is joined to it when it has come.
 * Each language's words, 65 to 88 kB, are loaded where they are wanted, and so are the editor of opened programs and the worker that reads long texts.
 */
const BUDGET = {
  module: 732_500,
  first: 317_000,
  page: 560_500,
  words: 89_500,
  editor: 70_000,
  reader: 10_100,
};

test("the module and the page stay within their budgets", () => {
  const wasm = readFileSync(at("dist/wasm/touchpath_bg.wasm"));
  const params = {
    [constants.BROTLI_PARAM_QUALITY]: 11,
    [constants.BROTLI_PARAM_LGWIN]: 24,
  };
  const module = brotliCompressSync(wasm, { params }).length;
  const [first = 0, rest = 0] = ["first", "rest"].map(
    (name) =>
      brotliCompressSync(readFileSync(at(`www/core/wasm/${name}.wasm`)), {
        params,
      }).length,
  );
  const languages = readdirSync(at("www/words"))
    .filter((name) => name !== "core.json")
    .map((name) => `${name.replace(".json", "")}-`);
  const isWords = (/** @type {string} */ name) =>
    languages.some((language) => name.startsWith(language));
  const isEditor = (/** @type {string} */ name) =>
    name.startsWith("program-editor-");
  const isReader = (/** @type {string} */ name) => name.startsWith("reader-");
  const isRest = (/** @type {string} */ name) => name.startsWith("rest-");
  const all = readdirSync(at("dist/page/assets"));
  const zipped = (/** @type {string} */ name) =>
    gzipSync(readFileSync(at(`dist/page/assets/${name}`)), { level: 9 }).length;
  assert.equal(
    all.filter(isWords).length,
    languages.length,
    "each language has a file of words",
  );
  assert.equal(
    all.filter(isEditor).length,
    1,
    "the editor has a file of its own",
  );
  assert.equal(
    all.filter(isReader).length,
    1,
    "the worker has a file of its own",
  );
  assert.deepEqual(
    all
      .filter((name) => name.endsWith(".wasm"))
      .map((name) => name.replace(/-[\w-]{8}\.wasm$/, ""))
      .sort(),
    ["first", "rest"],
    "no function is there twice",
  );
  for (const [rare, budget] of /** @type {const} */ ([
    [isWords, BUDGET.words],
    [isEditor, BUDGET.editor],
    [isReader, BUDGET.reader],
  ]))
    for (const name of all.filter(rare)) {
      const bytes = zipped(name);
      assert.ok(
        bytes <= budget,
        `${name} has ${bytes} bytes in gzip, ${budget} are allowed`,
      );
    }
  const assets = all
    .filter(
      (name) =>
        ![isWords, isEditor, isReader, isRest].some((rare) => rare(name)),
    )
    .map((name) => at(`dist/page/assets/${name}`));
  const page = [at("dist/page/index.html"), ...assets].reduce(
    (sum, file) => sum + gzipSync(readFileSync(file), { level: 9 }).length,
    0,
  );
  // As the compiler left it: with names.
  const target = process.env.CARGO_TARGET_DIR ?? at("target");
  const largest = functions(
    readFileSync(
      `${target}/wasm/wasm32-unknown-unknown/release/touchpath.wasm`,
    ),
  );
  assert.ok(
    largest.length > 500 &&
      largest.some(({ name }) => name.includes("touchpath")),
    "the functions are found",
  );
  const list = largest
    .slice(0, 20)
    .map(({ size, name }) => `${String(size).padStart(8)}  ${name}`);
  const told = `\nThe largest functions, bytes before wasm-opt:\n${list.join("\n")}`;
  assert.ok(
    module <= BUDGET.module,
    `the module has ${module} bytes in brotli, ${BUDGET.module} are allowed${told}`,
  );
  assert.ok(
    first <= BUDGET.first,
    `the first part has ${first} bytes in brotli, ${BUDGET.first} are allowed${told}`,
  );
  assert.ok(
    first + rest <= 1.05 * module,
    `the parts have ${first} and ${rest} bytes, the whole module ${module}`,
  );
  assert.ok(
    page <= BUDGET.page,
    `a first visit loads ${page} bytes in gzip, ${BUDGET.page} are allowed${told}`,
  );
});
