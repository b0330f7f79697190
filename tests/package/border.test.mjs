// Between JavaScript and the module: an exception that passes through breaks an instance, never the package.
import assert from "node:assert/strict";
import { test } from "node:test";
import * as touchpath from "touchpath";

const { check, defaultJob, evaluate, exportTable, importJob, JobError, plan } =
  touchpath;

/** That a good job is good, and that everything else still answers. */
function sound(/** @type {string} */ after) {
  const job = defaultJob("internal-rectangle-protected");
  assert.deepEqual(
    check(job).filter((f) => f.level === "error"),
    [],
    after,
  );
  assert.equal(plan(job).touches.length, 4, after);
  assert.match(exportTable(job, "csv"), /^code,type,value,meaning\n/, after);
  assert.deepEqual(importJob(JSON.stringify(job)).job, job, after);
}

test("some hundred revoked proxies made every job unreadable for good", () => {
  for (let i = 0; i < 2000; i++) {
    const { proxy, revoke } = Proxy.revocable({}, {});
    revoke();
    const place = i % 3;
    const job =
      place === 0
        ? proxy
        : place === 1
          ? { format: 1, cycle: proxy }
          : { format: 1, cycle: { type: "hole", origin: [proxy, 0, 0] } };
    assert.equal(check(job)[0]?.level, "error");
    if (i % 100 === 0) sound(`after ${i}`);
  }
  sound("at the end");
});

test("a caller's stack overflow, some thousand times, made every job unreadable for good", () => {
  const overflow = () => {
    /** @type {() => unknown} */
    const deeper = () => deeper();
    return deeper();
  };
  const job = {
    format: 1,
    get cycle() {
      return overflow();
    },
  };
  for (let i = 0; i < 2000; i++) assert.equal(check(job)[0]?.level, "error");
  sound("after getters that overflow");
});

test("a call at the very end of the stack broke the module", () => {
  const job = defaultJob("hole");
  let failed = 0;
  const deep = () => {
    try {
      deep();
    } catch {
      // Here the stack is almost exhausted: each call on the way back has a little more of it.
      const found = check(job);
      if (found.some((f) => f.level === "error")) failed++;
      try {
        plan(job);
      } catch (error) {
        if (error instanceof JobError) throw error;
      }
      if (failed < 40) throw new RangeError("on");
    }
  };
  for (let round = 0; round < 10; round++) {
    failed = 0;
    try {
      deep();
    } catch (error) {
      assert.ok(error instanceof RangeError, String(error));
    }
  }
  sound("after calls without a stack");
});

test("a getter that calls in itself does not take the outer call's instance away", () => {
  const job = defaultJob("hole");
  const { proxy, revoke } = Proxy.revocable({}, {});
  revoke();
  /** @type {number[]} */
  const touches = [];
  const outer = {
    ...job,
    get cycle() {
      touches.push(plan(defaultJob("boss")).touches.length);
      check(proxy);
      check({ format: 1, cycle: proxy });
      return job.cycle;
    },
  };
  for (let i = 0; i < 200; i++) {
    assert.deepEqual(check(outer), check(job));
    assert.equal(plan(outer).moves.length, plan(job).moves.length);
  }
  assert.deepEqual(new Set(touches), new Set([4]));
  sound("after calls inside calls");
});

test("whatever is thrown in a job, every function answers as before", () => {
  /** @type {unknown[]} */
  const thrown = [
    new Error("mine"),
    "text",
    null,
    undefined,
    7,
    { findings: "mine" },
    Symbol("mine"),
  ];
  for (const what of thrown) {
    const job = {
      format: 1,
      get cycle() {
        throw what;
      },
    };
    assert.equal(check(job)[0]?.level, "error");
    for (const call of [
      plan,
      (/** @type {any} */ j) => evaluate(j, "1,2,3"),
      (/** @type {any} */ j) => exportTable(j, "csv"),
    ]) {
      assert.throws(() => call(/** @type {any} */ (job)), JobError);
    }
  }
  sound("after everything that was thrown");
});
