// Calls for the whole module and its parts.

const SECTIONS = [
  "touches",
  "moves",
  "program",
  "results",
  "safety",
  "table",
  "findings",
];

/** What a call gives, as text; of one that traps only that it did. */
function answer(/** @type {() => unknown} */ call) {
  try {
    return JSON.stringify(call()) ?? "nothing";
  } catch (thrown) {
    if (thrown instanceof WebAssembly.RuntimeError) return "trap";
    return `refused: ${/** @type {Error} */ (thrown).message}`;
  }
}

const planOf = (/** @type {any} */ api, /** @type {any} */ job) => {
  const plan = api.plan(job);
  return SECTIONS.map((section) => plan[section]);
};

/**
 * The answers of a module, one after the other; `join` where its rest is to be joined.
 * @param {any} api
 * @param {{ early: boolean }} of `early`: without the rest, what a first visit asks
 */
export function* asked(api, { early }) {
  const { cycles, posts } = api.catalog();
  if (early) {
    for (const { type, number, fields } of cycles) {
      const job = api.defaultJob(type);
      if (number === null) continue;
      yield answer(() => api.check(job));
      yield answer(() => planOf(api, job));
      for (const { key } of fields)
        for (const value of [1, -5, "a", 7.25, null]) {
          const cycle = { ...job.cycle, [key]: value };
          yield answer(() => planOf(api, { ...job, cycle }));
        }
    }
    // A call that comes too early traps, and later calls are correct.
    yield answer(() => api.importJob("{}"));
    yield answer(() => planOf(api, api.defaultJob(cycles[0].type)));
    return;
  }
  yield "join";
  for (const { type } of cycles) {
    const job = api.defaultJob(type);
    for (const { key: post } of posts)
      for (const form of ["moves", "cycle"]) {
        const control = { ...job.control, post, form, workOffset: 1 };
        const own = { ...job, control };
        yield answer(() => api.check(own));
        yield answer(() => planOf(api, own));
      }
    yield answer(() => api.svg(job, "isometric"));
    yield answer(() => api.exportTable(job, "csv"));
    yield answer(() => api.convertUnits(job, "inch"));
  }
  const program = api.plan(api.defaultJob(cycles[0].type)).program.text;
  yield answer(() => api.importJob(program));
  yield answer(() => Array.from(api.runProgram(program).to));
  yield answer(() => api.jobSchema());
  yield answer(() => api.lentoax({}));
}
