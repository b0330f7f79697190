// Jobs from outside: files, pasted texts, stored state.
import assert from "node:assert/strict";
import { test } from "node:test";
import {
  chooseUnits,
  context,
  field,
  held,
  more,
  openTab,
  openText,
  page,
  panel,
  problems,
  program,
  ready,
  settles,
  setUp,
  textOf,
  until,
} from "./common.mjs";

setUp();

const note = () => textOf(page.locator(".note"));
/** Everything that must agree: the form's cycle, the current job, the words of the program. */
const cycles = async () => ({
  form: await field("cycle.type").inputValue(),
  held: await held("cycle.type"),
  program: /type (\d+):/.exec(await program())?.[1],
});

/** A job that the form cannot show: tests/package/store-opened.test.mjs has all kinds. */
const UNUSABLE = { format: 1, cycle: { type: "boss", touches: "abc" } };

test("a file or a text that the form cannot show changes nothing, and its path is named", async () => {
  await field("cycle.width1").fill("71");
  const before = { ...(await cycles()), text: await program() };
  await openText(JSON.stringify(UNUSABLE));
  await page.locator(".note", { hasText: "cycle.touches" }).waitFor();
  assert.match(await note(), /Nothing was changed/);
  assert.deepEqual({ ...(await cycles()), text: await program() }, before);
  await page.locator(".note").getByRole("button", { name: "OK" }).click();
  await more("Paste");
  await page.locator("#paste").fill(JSON.stringify(UNUSABLE));
  await page.getByRole("button", { name: "Read it" }).click();
  assert.match(await note(), /cycle\.touches/);
  assert.deepEqual({ ...(await cycles()), text: await program() }, before);
});

test("a stored state that the form cannot show left an empty page: the defaults stand, and the page says so", async () => {
  const tab = await context.newPage();
  await tab.addInitScript(
    (state) => {
      sessionStorage.clear();
      localStorage.setItem("touchpath.job.1", state);
    },
    JSON.stringify({ draft: UNUSABLE, typed: 7 }),
  );
  await tab.goto(page.url());
  await ready(tab);
  assert.match(await textOf(tab.locator(".note")), /cycle\.touches/);
  assert.equal(await field("cycle.type", tab).inputValue(), "hole");
});

test("a leaf of a wrong type stands in its field, beside its message", async () => {
  await openText(
    JSON.stringify({
      format: 1,
      units: "cm",
      control: { post: "mazatrol", workOffset: "G54" },
      cycle: {
        type: "boss",
        depth: "ten",
        diameter: true,
        rotation: null,
        variant: 7,
      },
    }),
  );
  await page.waitForFunction(() =>
    document
      .querySelector("touch-path")
      ?.shadowRoot?.querySelector("[id='e-cycle.depth']"),
  );
  assert.equal(await field("cycle.depth").inputValue(), "ten");
  assert.equal(await field("cycle.diameter").inputValue(), "true");
  assert.equal(
    await field("cycle.rotation").inputValue(),
    "",
    "null is not the default",
  );
  assert.equal(
    await page.locator("tp-form [type=radio]:checked + span").textContent(),
    "cm",
  );
  assert.ok(await page.locator('[id="e-units"]').isVisible());
  for (const [path, shown] of [
    ["control.post", "mazatrol"],
    ["control.workOffset", "G54"],
    ["cycle.variant", "7"],
  ]) {
    assert.equal(
      await textOf(field(path ?? "").locator("option:checked")),
      shown,
      path,
    );
    assert.ok(await page.locator(`[id="e-${path}"]`).isVisible(), path);
  }
  assert.deepEqual(
    await cycles(),
    { form: "boss", held: "boss", program: undefined },
    "no other job's program",
  );
  // Each can be corrected in its field.
  await chooseUnits("mm");
  await field("control.post").selectOption("linuxcnc");
  await field("control.workOffset").selectOption({ index: 1 });
  await field("cycle.variant").selectOption("0");
  for (const [path, value] of /** @type {const} */ ([
    ["cycle.depth", "10"],
    ["cycle.diameter", "40"],
    ["cycle.rotation", "0"],
  ])) {
    await field(path).fill(value);
  }
  assert.equal((await cycles()).program, "5");
});

test("two tabs overwrote each other: what was typed in one was gone after its reload", async () => {
  const other = await openTab();
  await field("cycle.width1").fill("61");
  await field("cycle.depth", other).fill("12");
  await page.reload();
  await ready();
  assert.equal(await field("cycle.width1").inputValue(), "61");
  assert.equal(await field("cycle.depth").inputValue(), "10");
  await other.reload();
  await ready(other);
  assert.equal(await field("cycle.depth", other).inputValue(), "12");
  await field("cycle.depth", other).fill("13");
  const third = await openTab();
  assert.equal(
    await field("cycle.depth", third).inputValue(),
    "13",
    "a new tab starts with what was written last",
  );
});

const points = "37.1,0,-10\n-36.9,0,-10\n0,22,-10\n0,-22,-10";

test("measured points are there after a reload, and gone with another cycle, other units or another job", async () => {
  const box = page.locator("#measured");
  await panel("measured");
  await box.fill(points);
  await field("cycle.type").selectOption("surface");
  assert.equal(await box.inputValue(), "");
  assert.doesNotMatch(await textOf(page.locator("tp-results")), /Points given/);
  await field("cycle.type").selectOption("internal-rectangle-protected");
  assert.equal(await box.inputValue(), points);
  await chooseUnits("inch");
  assert.equal(await box.inputValue(), "");
  await chooseUnits("mm");
  await page.reload();
  await ready();
  await panel("measured");
  assert.equal(await box.inputValue(), points);
  await openText(
    '{"format":1,"cycle":{"type":"internal-rectangle-protected"}}',
  );
  await settles(async () => (await box.inputValue()) === "");
});

test("ten megabytes that are pasted, dropped or opened froze the tab: they are refused with a sentence", async () => {
  const most = await page.evaluate(
    () =>
      /** @type {any} */ (document.querySelector("touch-path")).store
        .longestProgram,
  );
  for (const kind of ["paste", "drop"]) {
    await more("Paste");
    const taken = await page.locator("#paste").evaluate(
      (box, { kind, length }) => {
        const data = new DataTransfer();
        data.setData("text/plain", "x".repeat(length));
        const options = { bubbles: true, composed: true, cancelable: true };
        const event =
          kind === "paste"
            ? new ClipboardEvent("paste", { ...options, clipboardData: data })
            : new DragEvent("drop", { ...options, dataTransfer: data });
        return box.dispatchEvent(event);
      },
      { kind, length: 10_000_000 },
    );
    assert.equal(
      taken,
      false,
      `${kind}: the browser does not put it into the page`,
    );
    assert.match(await note(), /10,000,000 characters, and at most/);
    assert.equal(await page.locator("#paste").inputValue(), "");
    await page.getByRole("button", { name: "Cancel" }).click();
    await page.locator(".note").getByRole("button", { name: "OK" }).click();
  }
  await page.evaluate(() => {
    Blob.prototype.text = () => Promise.reject(new Error("the file was read"));
  });
  const before = await program();
  await openText(" ".repeat(most + 1));
  await page
    .locator(".note", { hasText: "20,000,001 bytes, and at most" })
    .waitFor();
  assert.equal(await program(), before);
});

test("a text that is pasted by the keyboard, and is short enough, is read", async () => {
  await more("Paste");
  await page.evaluate(
    (text) => navigator.clipboard.writeText(text),
    '{"format":1,"cycle":{"type":"hole"}}',
  );
  await page.locator("#paste").press("Control+v");
  await page.getByRole("button", { name: "Read it" }).click();
  await settles(async () => /type 3:/.test(await program()));
});

/** A job file that is long enough to be read in a worker: it begins with many spaces. */
const long = (/** @type {string} */ type) =>
  `${" ".repeat(300_000)}{"format":1,"cycle":{"type":"${type}"}}`;

/** Notes the workers that the page starts. A worker may end before the browser reports it, so the page itself counts. */
async function workersOfThePage() {
  await page.evaluate(() => {
    /** @type {string[]} */
    const started = [];
    const { Worker } = globalThis;
    globalThis.Worker = class extends Worker {
      constructor(/** @type {ConstructorParameters<typeof Worker>} */ ...all) {
        super(...all);
        started.push(new URL(String(all[0]), location.href).pathname);
      }
    };
    Object.assign(globalThis, { started });
  });
  return () =>
    page.evaluate(() => /** @type {string[]} */ (Object(globalThis).started));
}

test("a long text is read in a worker of the page's own, with the same answer as by the page itself", async () => {
  const workers = await workersOfThePage();
  await openText('{"format":1,"cycle":{"type":"boss"}}');
  await until("cycle.type", "boss");
  assert.deepEqual(await workers(), [], "a short one is not");
  await openText(long("hole"));
  await until("cycle.type", "hole");
  const [first, ...others] = await workers();
  assert.deepEqual(others, []);
  assert.match(first ?? "", /\/assets\/reader-[^/]+\.js$/);
  assert.deepEqual(
    await page.locator(".note").allTextContents(),
    [],
    "nothing is left of what was said while it was read",
  );
  // Errors of a text are reported as always.
  const wrong = `${" ".repeat(300_000)}{"format":3,"cycle":{"type":"hole"}}`;
  await openText(wrong);
  await settles(async () => /Nothing was changed/.test(await note()));
  const beside = await note();
  assert.equal(await held("cycle.type"), "hole");
  assert.equal((await workers()).length, 2);
  await page.evaluate(() => Object.assign(globalThis, { Worker: undefined }));
  await openText(long("boss"));
  await until("cycle.type", "boss");
  await openText(wrong);
  await settles(async () => (await note()) === beside);
  assert.equal(
    (await workers()).length,
    2,
    "where there are no workers the page reads by itself",
  );
});

test("a long program that says no job is read in a worker, too, and one whose worker does not come by the page", async () => {
  const rows = Array.from(
    { length: 6_000 },
    (_, i) => `N${i + 3} G1 X${i % 200} Y${Math.floor(i / 200)} F500`,
  );
  const text = `G21 G90\nG0 X0 Y0 Z5\n${rows.join("\n")}\nM2\n`;
  const said = () => textOf(page.locator("tp-viewer .timeline output"));
  await openText(text, "long.nc");
  await settles(async () => /^6001 moves/.test(await said()));
  await page.getByRole("button", { name: "Back to the job" }).click();
  await context.route(/\/reader-[^/]+\.js$/, (route) => route.abort());
  await openText(`${text}G1 X0\n`.replace("M2\n", ""), "longer.nc");
  await settles(async () => /^6002 moves/.test(await said()));
});

test("the run of a long program froze the page: it runs in a worker, and what was read is shown meanwhile", async () => {
  const rows = Array.from({ length: 2_500 }, (_, i) => `G1 X${i % 200} F500`);
  const text = `G21 G17 G90\nM5\n${rows.join("\n")}\nG38.2 Z-5 F100\nM2\n`;
  const workers = await workersOfThePage();
  await openText(text, "long.ngc");
  await settles(async () => (await workers()).length > 0);
  const viewer = page.locator("tp-viewer");
  // A wait inside the page is lost if a worker starts or ends meanwhile.
  const verdict = viewer.getByText("No broken rule was found");
  await settles(() => verdict.isVisible());
  assert.equal(await viewer.locator(".running").count(), 0);
  // An input runs it again.
  await viewer.locator("#start-2").fill("10");
  await viewer.locator("#start-2").press("Tab");
  const end = () =>
    viewer.evaluate((node) => /** @type {any} */ (node).ran.run.to.at(-1));
  await settles(async () => (await end()) === -5);
});

test("of two texts the one that was opened last counts, whichever is read first", async () => {
  // Both in one task; reading the first takes longer, and so does its file.
  await page.evaluate(
    async ([first, second]) => {
      const { intake } = /** @type {any} */ (
        document.querySelector("touch-path")
      ).app;
      await Promise.all([
        intake.file(new File([first ?? ""], "1")),
        intake.file(new File([second ?? ""], "2")),
      ]);
    },
    [long("hole"), '{"format":1,"cycle":{"type":"boss"}}'],
  );
  assert.equal(await held("cycle.type"), "boss");
});

test("a job that the page around sets while a long text is read was overwritten by the text", async () => {
  await page.evaluate(async (text) => {
    const element = /** @type {any} */ (document.querySelector("touch-path"));
    const read = element.app.intake.text(text);
    element.job = { format: 1, cycle: { type: "boss" } };
    await read;
  }, long("hole"));
  assert.equal(await held("cycle.type"), "boss");
  assert.match(await note(), /the job was replaced while this text was read/);
});

test("a worker whose text is of no use any more ran to its end", async () => {
  // Workers that never answer.
  await page.evaluate(() => {
    const counts = Object.assign(globalThis, { workers: 0 });
    const { Worker } = globalThis;
    globalThis.Worker = class extends Worker {
      constructor(/** @type {ConstructorParameters<typeof Worker>} */ ...all) {
        super(...all);
        counts.workers++;
      }
      postMessage() {}
      terminate() {
        super.terminate();
        counts.workers--;
      }
    };
  });
  const workers = () =>
    page.evaluate(() => /** @type {any} */ (globalThis).workers);
  const buffer = Buffer.from(long("hole"));
  await page
    .locator("#file")
    .setInputFiles({ name: "job.json", mimeType: "text/plain", buffer });
  await settles(async () => (await workers()) === 1);
  await openText('{"format":1,"cycle":{"type":"boss"}}');
  await until("cycle.type", "boss");
  assert.equal(await workers(), 0);
});

test("a stricter policy around the page left it empty: without workers it does what it can", async () => {
  await page.route("**/", async (route) => {
    const response = await route.fetch();
    const policy = "require-trusted-types-for 'script'; trusted-types lit-html";
    await route.fulfill({
      response,
      headers: { ...response.headers(), "content-security-policy": policy },
    });
  });
  await page.goto(new URL("./?strict", page.url()).href.replace("?strict", ""));
  await page.reload();
  await ready();
  await openText(long("hole"));
  await until("cycle.type", "hole");
  assert.ok(problems.splice(0).every((text) => /polic/i.test(text)));
});
