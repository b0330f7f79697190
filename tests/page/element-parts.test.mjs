// Panels of a job elsewhere on the page, and two versions of the element on one page.
import assert from "node:assert/strict";
import { cpSync, readdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { PICTURE, panel, settles } from "./common.mjs";
import {
  folder,
  heard,
  inner,
  LISTEN,
  on,
  open,
  POLICY,
  page,
  problems,
  set,
  setUp,
} from "./element.mjs";

setUp();

/** The panels before their element in the markup: the portal chooses the order. */
const PARTS = `<touch-form for="job"></touch-form><touch-picture for="job"></touch-picture><touch-program for="job"></touch-program>
  <touch-path id="job" hidden panels="none"></touch-path>`;
const part = (/** @type {string} */ name) => page.locator(`touch-${name}`);
const width = () => part("form").locator('[id="f-cycle.width1"]');
/** Whether something is ready, in a second. */
const ready = (/** @type {string} */ selector) =>
  page.evaluate(
    (selector) =>
      Promise.race([
        /** @type {any} */ (document.querySelector(selector)).ready.then(
          () => true,
        ),
        new Promise((done) => setTimeout(() => done(false), 1000)),
      ]),
    selector,
  );
const allReady = async () => {
  for (const name of ["form", "picture", "program"])
    assert.ok(await ready(`touch-${name}`), name);
};

test("form, picture and program stand where the portal puts them, and are one job", async () => {
  await open(PARTS, LISTEN);
  await allReady();
  // Each shows only its own panel, without bar and footer.
  const seen = await page.evaluate(() =>
    ["form", "picture", "program"].map((name) => {
      const root = document.querySelector(`touch-${name}`)?.shadowRoot;
      const shown = (/** @type {string} */ what) =>
        [...(root?.querySelectorAll(what) ?? [])].some((one) =>
          one.checkVisibility(),
        );
      return [".setup", ".picture", ".code", "header", "footer", ".tabs"]
        .filter(shown)
        .join(" ");
    }),
  );
  assert.deepEqual(seen, [".setup", ".picture", ".code"]);
  assert.equal(
    await page.locator("#job").isVisible(),
    false,
    "hidden is hidden",
  );

  await width().fill("64");
  await width().press("Tab");
  await settles(async () => {
    const shown = await part("program")
      .locator(".line.touch .text")
      .allTextContents();
    const { lines, text } = await on(({ plan }) => ({
      lines: plan.program.moveLines.filter(
        (/** @type {number} */ _, /** @type {number} */ move) =>
          plan.moves[move].kind === "touch",
      ),
      text: plan.program.text.split("\n"),
    }));
    return (
      (await on((element) => element.job.cycle.width1)) === 64 &&
      shown.join() ===
        lines.map((/** @type {number} */ line) => text[line]).join()
    );
  }, page);
  const changes = (await heard()).filter(([name]) => name === "job-change");
  assert.deepEqual(
    changes.map(([, { job }]) => job.cycle.width1),
    [64],
    "the element says so, once a change",
  );
  assert.equal(await on((element) => element.job.cycle.width1), 64);
  // Inputs from outside show in all.
  await set("cycle", "boss");
  await part("form").locator('[id="f-cycle.diameter"]').waitFor();
  await width()
    .or(part("form").locator('[id="f-cycle.diameter"]'))
    .press("Control+z");
  await settles(
    async () => (await on((element) => element.job.cycle.type)) !== "boss",
    page,
  );
});

test("a line lights up its move in the other panels, and a dimension leads to its field", async () => {
  await open(PARTS);
  await allReady();
  const over = () =>
    part("picture")
      .locator("canvas.over")
      .evaluate((canvas) =>
        /** @type {HTMLCanvasElement} */ (canvas).toDataURL(),
      );
  const before = await over();
  await part("program").locator(".line.touch").first().hover();
  await settles(async () => (await over()) !== before, page);
  // Escape in the picture clears the selection; a click on a dimension goes to its field in another element.
  await page.evaluate((name) => {
    const picture = document
      .querySelector("touch-picture")
      ?.shadowRoot?.querySelector(name);
    picture?.dispatchEvent(
      new CustomEvent("go-to-field", { detail: "cycle.width2", bubbles: true }),
    );
  }, inner("picture"));
  await settles(
    () =>
      page.evaluate(
        () =>
          document.querySelector("touch-form")?.shadowRoot?.activeElement
            ?.id === "f-cycle.width2",
      ),
    page,
  );
});

test("theme, language, rules and panels of the element hold in its panels elsewhere", async () => {
  await open(
    `${PARTS.replace("<touch-program ", '<touch-program panels="program results checks" ')}`,
  );
  await allReady();
  await panel("results", part("program"));
  assert.ok(await part("program").locator("#panel-results").isVisible());
  await set("theme", "dark");
  assert.deepEqual(
    await page.evaluate(
      (app) =>
        ["form", "picture", "program"].map((name) =>
          document
            .querySelector(`touch-${name}`)
            ?.shadowRoot?.querySelector(app)
            ?.classList.contains("dark"),
        ),
      inner("app"),
    ),
    [true, true, true],
  );
  await set("lang", "de");
  await part("program").getByRole("tab", { name: "Ergebnisse" }).waitFor();
  await set("config", { format: 1, hide: { panels: ["results"] } });
  await settles(
    async () => (await part("program").getByRole("tab").count()) === 2,
    page,
  );
  await set("readonly", true);
  await settles(async () => !(await width().isEditable()), page);
});

test("the picture elsewhere is the element's picture: its view, as SVG, drawn", async () => {
  await open(PARTS);
  await allReady();
  await set("view", "isometric");
  await part("picture")
    .locator('button[aria-pressed="true"]', { hasText: "isometric" })
    .waitFor();
  assert.equal(await on((element) => element.view), "isometric");
  assert.match(await on((element) => element.picture()), /^<svg/);
  const ink = await part("picture")
    .locator(PICTURE)
    .evaluate((canvas) => {
      const { width, height } = /** @type {HTMLCanvasElement} */ (canvas);
      const context = /** @type {CanvasRenderingContext2D} */ (
        /** @type {HTMLCanvasElement} */ (canvas).getContext("2d")
      );
      return new Set(
        new Uint32Array(context.getImageData(0, 0, width, height).data.buffer),
      ).size;
    });
  assert.ok(ink > 10, `${ink} colours`);
});

test("panels find an element that comes later, follow another one, and leave nothing behind", async () => {
  await open('<touch-form for="late"></touch-form>');
  assert.equal(await ready("touch-form"), false);
  await page.evaluate(() => {
    const late = Object.assign(document.createElement("touch-path"), {
      id: "late",
      panels: "none",
      cycle: "boss",
    });
    document.body.append(late);
    const other = Object.assign(document.createElement("touch-path"), {
      id: "other",
      panels: "none",
      cycle: "wall",
    });
    document.body.append(other);
  });
  await part("form").locator('[id="f-cycle.diameter"]').waitFor();
  const lent = () =>
    page.evaluate(() =>
      ["late", "other"].map(
        (id) => /** @type {any} */ (document.getElementById(id)).lent.size,
      ),
    );
  assert.deepEqual(await lent(), [1, 0]);
  await part("form").evaluate((form) => form.setAttribute("for", "other"));
  await settles(
    async () =>
      (await part("form").locator('[id="f-cycle.diameter"]').count()) === 0,
    page,
  );
  await settles(async () => (await lent()).join() === "0,1", page);
  await page.evaluate(async () => {
    const form = /** @type {any} */ (document.querySelector("touch-form"));
    for (let i = 0; i < 50; i++) {
      form.remove();
      document.body.append(form);
      if (i % 10 === 0) await form.ready;
    }
    form.remove();
  });
  await settles(async () => (await lent()).join() === "0,0", page);
  assert.deepEqual(
    await page.evaluate(() => {
      const form = /** @type {any} */ (document.createElement("touch-form"));
      form.session = document.getElementById("late");
      document.body.append(form);
      return [form.session.id, form.panels];
    }),
    ["late", "form"],
  );
  await part("form").locator('[id="f-cycle.diameter"]').waitFor();
});

test("an element that comes back has its panels again, and what is looked at is kept", async () => {
  await open(
    PARTS.replace(
      "<touch-program ",
      '<touch-program panels="program results" ',
    ),
  );
  await allReady();
  await panel("results", part("program"));
  await page.evaluate(async () => {
    const [path, form, program] = /** @type {any[]} */ (
      ["touch-path", "touch-form", "touch-program"].map((name) =>
        document.querySelector(name),
      )
    );
    path.remove();
    form.remove();
    // Another element that is added meanwhile changes nothing.
    document.body.append(document.createElement("touch-path"));
    await new Promise((done) => setTimeout(done, 100));
    if (program.shadowRoot.querySelector(".tabs") === null)
      throw new Error("the program is gone");
    program.remove();
    path.cycle = "boss";
    document.body.append(form);
    document.body.append(path);
    document.body.append(program);
    await Promise.all([form.ready, program.ready]);
  });
  // Changes since then are shown.
  await part("form").locator('[id="f-cycle.diameter"]').waitFor();
  await part("program")
    .locator("tr", { hasText: "Diameter" })
    .first()
    .waitFor();
  assert.equal(
    await part("program")
      .getByRole("tab", { name: "Results" })
      .getAttribute("aria-selected"),
    "true",
  );
});

test("panels of an element that could not be loaded say so, and come when it is tried again", async () => {
  await open('<touch-form for="later"></touch-form><main></main>');
  await page.route(/\/app\.js$/, (route) => route.abort());
  const shown = () =>
    page.evaluate(async () => {
      const form = /** @type {any} */ (document.querySelector("touch-form"));
      const place = /** @type {Element} */ (document.querySelector("main"));
      const element = /** @type {any} */ (
        place.firstElementChild ?? document.createElement("touch-path")
      );
      element.id = "later";
      element.remove();
      place.append(element);
      return form.ready.then(
        () => "shown",
        () => form.shadowRoot.querySelector("[role=alert]").textContent,
      );
    });
  assert.match(await shown(), /could not be loaded/);
  problems.length = 0;
  await page.unroute(/\/app\.js$/);
  assert.equal(await shown(), "shown");
});

test("a form that is sent leads to what is wrong in a panel elsewhere, and a panel sends no input of its own", async () => {
  await open(
    `<form id="around">${PARTS.replace("<touch-path", '<touch-path name="job"')}<button>Send</button></form>`,
  );
  await allReady();
  await page.evaluate(() => {
    const own = /** @type {any} */ (window);
    own.inputs = [];
    document.addEventListener("input", (event) =>
      own.inputs.push(/** @type {Element} */ (event.target).localName),
    );
  });
  await part("form").locator('[id="f-cycle.width2"]').fill("-3");
  assert.deepEqual(
    await page.evaluate(() => /** @type {any} */ (window).inputs),
    ["touch-path"],
  );
  await page.getByRole("button", { name: "Send" }).click();
  await settles(
    () =>
      page.evaluate(
        () =>
          document.querySelector("touch-form")?.shadowRoot?.activeElement
            ?.id === "f-cycle.width2",
      ),
    page,
  );
});

test("findings lead to lines and fields of other panels", async () => {
  await open(
    `<touch-form for="job" panels="checks"></touch-form><touch-program for="job"></touch-program><touch-picture for="job" panels="form"></touch-picture>
    <touch-path id="job" panels="none"></touch-path>`,
  );
  await allReady();
  await part("form")
    .locator("li button", { hasText: /[Ll]ine/ })
    .first()
    .click();
  await settles(
    async () => (await part("program").locator(".line.match").count()) > 0,
    page,
  );
  await page.locator("#job .probe").click();
  // The length of the stylus is unset: its checkbox has the focus.
  const focused = () =>
    page.evaluate(
      () =>
        document.querySelector("touch-picture")?.shadowRoot?.activeElement
          ?.ariaLabel,
    );
  await settles(
    async () => ((await focused()) ?? "").startsWith("Stylus length"),
    page,
  );
});

test("what is no element of ours has no panels to show, and one that becomes one has", async () => {
  await open(
    "<touch-form></touch-form><div id=other></div><acme-path id=acme></acme-path><main></main>",
  );
  const shown = (/** @type {string} */ session) =>
    page.evaluate(
      `(async () => { const form = document.querySelector("touch-form"); form.session = ${session}; await new Promise((done) => setTimeout(done, 50)); return [form.session?.localName ?? null, form.shadowRoot.children[0].localName]; })()`,
    );
  for (const none of [
    "5",
    '"job"',
    "{}",
    'document.querySelector("#other")',
    'document.querySelector("#acme")',
    "null",
  ])
    assert.deepEqual(await shown(none), [null, "slot"], none);
  await shown('document.querySelector("#acme")');
  await page.evaluate(async () => {
    const { define } = await import(
      new URL("touchpath/element/element.js", location.href).href
    );
    define("acme-path");
    await /** @type {any} */ (document.querySelector("touch-form")).ready;
  });
  await width().waitFor();
});

test("a page holds two versions: the later one by a name of its own, each with its own insides", async () => {
  // The next version is this one with other names, as its build creates them. Its folder stays until the page has loaded everything.
  const next = join(folder, "next");
  cpSync(join(folder, "touchpath"), next, { recursive: true });
  const { version } = JSON.parse(readFileSync("package.json", "utf8"));
  for (const name of readdirSync(join(next, "element")).filter((name) =>
    name.endsWith(".js"),
  )) {
    const file = join(next, "element", name);
    writeFileSync(
      file,
      readFileSync(file, "utf8")
        .replaceAll(inner(""), "tp-9-0-0-")
        .replaceAll(version, "9.0.0"),
    );
  }
  // Both create the policy for Lit's markup themselves.
  await open(
    "<touch-path></touch-path><acme-path id=acme cycle=boss></acme-path><touch-form for=acme></touch-form>",
    "",
    `${POLICY} 'allow-duplicates'`,
  );
  const versions = await page.evaluate(async () => {
    const file = "./next/element/element.js";
    const { define } = await import(new URL(file, location.href).href);
    define("acme-path");
    const all = ["touch-path", "acme-path"].map(
      (name) => /** @type {any} */ (document.querySelector(name)),
    );
    await Promise.all(all.map((one) => one.ready));
    let taken = "";
    try {
      define("acme-path");
    } catch (thrown) {
      taken = /** @type {Error} */ (thrown).name;
    }
    return [
      ...all.map((one) => one.constructor.version),
      ...all.map((one) => one.shadowRoot.firstElementChild.localName),
      ...all.map((one) => one.plan.program.text.length > 100),
      taken,
    ];
  });
  assert.deepEqual(versions, [
    version,
    "9.0.0",
    inner("app"),
    "tp-9-0-0-app",
    true,
    true,
    "NotSupportedError",
  ]);
  // A panel shows the content of its element, of either version.
  await part("form").locator('[id="f-cycle.diameter"]').waitFor();
  assert.equal(await part("form").locator("tp-9-0-0-form").count(), 1);
  // A second copy of one version shares the classes of the first one.
  const same = await page.evaluate(async () => {
    const file = "./touchpath/element/element.js?copy";
    const { define } = await import(new URL(file, location.href).href);
    define("acme-same");
    const one = /** @type {any} */ (document.createElement("acme-same"));
    document.body.append(one);
    await one.ready;
    return one.plan.program.text.length > 100;
  });
  assert.ok(same);
});
