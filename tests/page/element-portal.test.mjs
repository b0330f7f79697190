// <touch-path> in its surroundings: look, form, control and language of a host page.
import assert from "node:assert/strict";
import { test } from "node:test";
import { wordsOf } from "../../scripts/words.mjs";
import { settles } from "./common.mjs";
import {
  address,
  field,
  heard,
  inner,
  LISTEN,
  on,
  open,
  page,
  problems,
  set,
  setUp,
} from "./element.mjs";

setUp();

test("panels, theme, slots, parts and custom properties", async () => {
  await open(
    `<touch-path panels="stage program" theme="dark"><p>later</p><b slot="header">Our portal</b><i slot="footer">by us</i></touch-path>`,
  );
  const shown = (/** @type {string} */ what) => page.locator(what).isVisible();
  assert.ok((await shown(inner("picture"))) && (await shown(inner("program"))));
  for (const gone of [
    inner("form"),
    inner("table"),
    inner("results"),
    inner("checks"),
    ".tabs",
    "h1",
  ])
    assert.ok(!(await shown(gone)), gone);
  assert.ok(
    (await page.getByText("Our portal").isVisible()) &&
      (await page.getByText("by us").isVisible()),
  );
  assert.ok(
    !(await page.getByText("later").isVisible()),
    "what stood there until now is gone",
  );
  const background = () =>
    page
      .locator(inner("app"))
      .evaluate((app) => getComputedStyle(app).backgroundColor);
  assert.equal(await background(), "rgb(18, 23, 29)");
  await set("theme", "light");
  assert.equal(await background(), "rgb(255, 255, 255)");
  await set("theme", "auto");
  await page.emulateMedia({ colorScheme: "dark" });
  // The browser applies the scheme some frames later.
  await settles(async () => (await background()) === "rgb(18, 23, 29)", page);
  await page.addStyleTag({ url: address("own.css") }).catch(() => undefined);
  problems.splice(0);
  await on((element) =>
    element.style.setProperty("--touchpath-background", "rgb(1, 2, 3)"),
  );
  assert.equal(await background(), "rgb(1, 2, 3)");
  await page.evaluate(() => {
    const sheet = new CSSStyleSheet();
    sheet.replaceSync("touch-path::part(bar) { background: rgb(9, 9, 9) }");
    document.adoptedStyleSheets = [sheet];
  });
  const bar = await page
    .locator("header")
    .evaluate((node) => getComputedStyle(node).backgroundColor);
  assert.equal(bar, "rgb(9, 9, 9)");
  // Every choice of panels fills the element at every width.
  for (const width of [1300, 800, 390]) {
    await page.setViewportSize({ width, height: 700 });
    for (const panels of [
      "form",
      "stage",
      "program",
      "results checks",
      "form stage",
      "form program table",
      "stage table",
    ]) {
      await set("panels", panels);
      await page.evaluate(
        () =>
          new Promise((done) =>
            requestAnimationFrame(() => requestAnimationFrame(done)),
          ),
      );
      const sizes = await page
        .locator("main > :not([hidden])")
        .evaluateAll((all) =>
          all.map((one) => [one.className, one.clientWidth, one.clientHeight]),
        );
      assert.ok(sizes.length > 0, panels);
      for (const [name, wide, high] of sizes)
        assert.ok(
          Number(wide) > 200 && Number(high) > 25,
          `${panels} at ${width}: ${name} is ${wide} × ${high}`,
        );
      const empty = await page.locator("main").evaluate((main) => {
        const feet = [...main.children].map(
          (one) => one.getBoundingClientRect().bottom,
        );
        return main.getBoundingClientRect().bottom - Math.max(...feet);
      });
      assert.ok(
        empty < 6,
        `${panels} at ${width}: ${empty} px are empty at the foot`,
      );
    }
  }
});

test("a form gets the job and its validity, and puts it back", async () => {
  await open(
    `<form><touch-path name="probing" cycle="hole"></touch-path><fieldset disabled><touch-path name="off"></touch-path></fieldset></form>`,
  );
  const sent = () =>
    page.evaluate(() => {
      const form = /** @type {HTMLFormElement} */ (
        document.querySelector("form")
      );
      return {
        valid: form.checkValidity(),
        data: Object.fromEntries(new FormData(form)),
      };
    });
  const before = await sent();
  assert.deepEqual(
    [before.valid, Object.keys(before.data)],
    [true, ["probing"]],
  );
  assert.equal(JSON.parse(String(before.data.probing)).cycle.type, "hole");
  await field("cycle.diameter").fill("0");
  assert.equal((await sent()).valid, false);
  assert.match(String(await on((element) => element.validationMessage)), /\S/);
  assert.ok(
    await field("cycle.type", 1).isDisabled(),
    "the form's own switch is heard",
  );
  await page.evaluate(() => document.querySelector("form")?.reset());
  const after = await sent();
  assert.deepEqual(
    JSON.parse(String(after.data.probing)),
    JSON.parse(String(before.data.probing)),
  );
  assert.ok(after.valid);
});

/** Control and units of every element of the page, of its job and its program, and the findings about them. */
const asked = () =>
  page.evaluate(() =>
    [...document.querySelectorAll("touch-path")].map(
      ({ post, units, plan, findings }) => [
        post,
        units,
        plan?.program.post,
        plan && (/\bG20\b/.test(plan.program.text) ? "inch" : "mm"),
        ...findings
          .filter(({ code }) => code.startsWith("other-"))
          .map(({ code, level, path }) => [code, level, path].join()),
      ],
    ),
  );

const BORE = { format: 1, name: "BORE", cycle: { type: "hole", diameter: 2 } };

test("a control and units that the page asks for were lost with the first job that names none", async () => {
  const bore = JSON.stringify(BORE);
  await open(
    `<touch-path post="fanuc" units="inch"></touch-path><touch-path post="fanuc" units="inch" job='${bore}'></touch-path><touch-path job='${bore}' units="inch" post="fanuc"></touch-path>`,
    LISTEN,
  );
  await set("job", BORE);
  await page.evaluate(async (job) => {
    for (const [first, second] of [
      ["post", "job"],
      ["job", "post"],
    ]) {
      const element = document.createElement("touch-path");
      for (const name of [first, second, "units"])
        Object.assign(element, {
          [String(name)]: { job, post: "fanuc", units: "inch" }[String(name)],
        });
      document.body.append(element);
      await element.ready;
    }
  }, BORE);
  // 2 inch, as in a job in inch.
  assert.deepEqual(
    await asked(),
    Array(5).fill(["fanuc", "inch", "fanuc", "inch"]),
  );
  const sizes = await page.evaluate(() =>
    [...document.querySelectorAll("touch-path")].map(
      ({ job }) =>
        job?.format === 1 && job.cycle.type === "hole" && job.cycle.diameter,
    ),
  );
  // Earlier requests determine the units in which the job is read; set after it, units convert.
  assert.deepEqual(sizes, [2, 2, 2, 2, 2]);
  // Every door through which a job comes in.
  const file = (/** @type {string} */ name, /** @type {string} */ text) =>
    page
      .locator("touch-path")
      .first()
      .locator("#file")
      .setInputFiles({
        name,
        mimeType: "text/plain",
        buffer: Buffer.from(text),
      });
  await file("web.json", '{"format":1,"cycle":{"type":"web"}}');
  await page.waitForFunction(
    () => document.querySelector("touch-path")?.cycle === "web",
  );
  assert.deepEqual((await asked())[0], ["fanuc", "inch", "fanuc", "inch"]);
  await on((element) => element.store.reset());
  assert.deepEqual(
    (await asked())[0],
    ["fanuc", "inch", "fanuc", "inch"],
    "the defaults",
  );
  const { defaultJob, exportTable } = await import("touchpath");
  await file("dump.txt", exportTable(defaultJob("groove"), "text"));
  await page.waitForFunction(
    () => document.querySelector("touch-path")?.cycle === "groove",
  );
  // A dump is read in mm.
  assert.deepEqual((await asked())[0], [
    "fanuc",
    "mm",
    "fanuc",
    "mm",
    "other-units,warning,units",
  ]);
  await set("job", {
    format: 1,
    units: "inch",
    cycle: { type: "boss" },
    control: { workOffset: 2 },
  });
  assert.deepEqual((await asked())[0], ["fanuc", "inch", "fanuc", "inch"]);
  assert.equal(await on((element) => element.job.control.workOffset), 2);
});

test("a job that names another control than the page asks for says so, to the user and to the page", async () => {
  await open('<touch-path post="fanuc" units="mm"></touch-path>', LISTEN);
  await heard();
  await set("job", { ...BORE, units: "inch", control: { post: "linuxcnc" } });
  const both = [
    "other-control,warning,control.post",
    "other-units,warning,units",
  ];
  assert.deepEqual((await asked())[0], [
    "linuxcnc",
    "inch",
    "linuxcnc",
    "inch",
    ...both,
  ]);
  const event = (await heard()).findLast(([name]) => name === "finding");
  assert.deepEqual(
    event?.[1].findings
      .filter((/** @type {any} */ f) => f.code.startsWith("other-"))
      .map((/** @type {any} */ f) => f.message),
    [
      `The host page asks for ${await title("fanuc")}, this job specifies LinuxCNC: the program is for LinuxCNC`,
      "The host page asks for mm, this job is in inch: the program is in inch",
    ],
  );
  await page.locator("#tab-checks").click();
  await page.getByText("this job specifies LinuxCNC").first().waitFor();
  // Requested again, it is applied: the job changes.
  await set("post", "fanuc");
  await set("units", "mm");
  assert.deepEqual((await asked())[0], ["fanuc", "mm", "fanuc", "mm"]);
  assert.equal(
    await on((element) => element.job.cycle.diameter),
    50.8,
    "the part is the same",
  );
  // The user's choice is a job with another control, too, and is withdrawn with the attribute.
  await field("control.post").selectOption("haas");
  assert.deepEqual((await asked())[0]?.slice(2), ["haas", "mm", both[0]]);
  await on((element) => element.removeAttribute("post"));
  assert.deepEqual((await asked())[0]?.slice(2), ["haas", "mm"]);
  const later = { format: 1, cycle: { type: "hole" } };
  await set("job", { ...later, name: "LATER" });
  assert.deepEqual(
    (await asked())[0]?.slice(2),
    ["linuxcnc", "mm"],
    "nothing is asked for any more",
  );
  await set("post", "mazatrol");
  await set("job", { ...later, name: "LAST" });
  assert.deepEqual(
    (await asked())[0]?.slice(2),
    ["linuxcnc", "mm"],
    "what is not known is not asked for",
  );
});

test("a cycle that the control does not take made a program for another control: it has an error", async () => {
  await open(
    '<touch-path post="heidenhain" cycle="double-wall-external-corner"></touch-path>',
  );
  const state = () =>
    on((element) => [
      element.post,
      element.plan,
      element.findings
        .map((/** @type {any} */ f) => f.code)
        .includes("form-unsupported"),
    ]);
  assert.deepEqual(await state(), ["heidenhain", null, true]);
  await field("cycle.type").selectOption("probing-two-circles");
  assert.deepEqual(
    await on((element) => [element.post, element.plan.program.post]),
    ["heidenhain", "heidenhain"],
  );
  await field("cycle.type").selectOption("double-wall-external-corner");
  assert.deepEqual(await state(), ["heidenhain", null, true]);
});

/** The title of a control. */
async function title(/** @type {string} */ id) {
  const { catalog } = await import("touchpath");
  return String(catalog().posts.find((post) => post.id === id)?.title);
}

test("an invalid job says why where the browser can show it, and the focus comes to the first field", async () => {
  await open(
    "<form><touch-path name=j cycle=hole></touch-path><button>Send</button></form>",
  );
  await field("cycle.diameter").fill("-1");
  await page.getByRole("button", { name: "Send" }).click();
  assert.ok(
    await on(
      (element) =>
        element.matches(":focus-within") || document.activeElement === element,
    ),
  );
  await on((element) => element.focus());
  assert.equal(
    await on((element) => element.shadowRoot.activeElement.id),
    "f-cycle.diameter",
  );
  await set("readonly", true);
  await on((element) => element.focus());
  assert.equal(
    await on((element) => element.shadowRoot.activeElement.localName),
    "canvas",
  );
});

test("in somebody else's page: no second main, nothing said of privacy, keys of a slotted field are its own", async () => {
  await open(
    "<touch-path cycle=hole panels=program><input slot=header aria-label=Ordernumber></touch-path>",
  );
  assert.equal(await page.getByRole("main").count(), 0);
  assert.equal(await page.getByText("Nothing leaves this browser").count(), 0);
  await set("job", { format: 1, cycle: { type: "hole", diameter: -1 } });
  assert.equal(
    await page.getByRole("button", { name: "Go to it" }).count(),
    0,
    "there is no form to go to",
  );
  await page.getByLabel("Ordernumber").fill("abc");
  await page.keyboard.press("Control+z");
  assert.notEqual(
    await page.getByLabel("Ordernumber").inputValue(),
    "abc",
    "the browser's own undo",
  );
});

test("an element has the language of its own lang, or that of what is around it", async () => {
  await open(
    `<touch-path id="own" lang="de-CH"></touch-path><section lang="ru"><touch-path id="around"></touch-path></section><touch-path id="none" lang="tlh"></touch-path>`,
  );
  const tab = (/** @type {string} */ id) =>
    page.locator(`#${id} #tab-results`).textContent();
  const [de, ru, zh] = ["de", "ru", "zh-Hant"].map(
    (language) => wordsOf(language).Results,
  );
  assert.deepEqual(
    [await tab("own"), await tab("around"), await tab("none")],
    [de, ru, "Results"],
  );
  // Texts for the host page stay data: English, with the parts for a translation.
  const said = await page.evaluate(() => {
    const own = /** @type {any} */ (document.querySelector("#own"));
    own.job = { ...own.job, overtravel: -1 };
    return { findings: own.findings, message: own.validationMessage };
  });
  assert.equal(
    said.findings[0].message,
    "Overtravel must be from 0.01 to 1000 mm",
  );
  assert.deepEqual(said.findings[0].said[1], ["Overtravel"]);
  assert.ok(said.message.includes(wordsOf("de").Overtravel), said.message);
  // The language can change later. Without a language the element uses that of its surroundings.
  await page.evaluate(() => {
    const [own, none] = ["own", "none"].map(
      (id) => /** @type {HTMLElement} */ (document.getElementById(id)),
    );
    own?.removeAttribute("lang");
    if (none) none.lang = "zh-TW";
  });
  await page.waitForFunction(
    (zh) =>
      document.querySelector("#none")?.shadowRoot?.querySelector("#tab-results")
        ?.textContent === zh,
    zh,
  );
  await page.waitForFunction(
    () =>
      document.querySelector("#own")?.shadowRoot?.querySelector("#tab-results")
        ?.textContent === "Results",
  );
  assert.equal(await tab("around"), ru);
  // The language of the surroundings may change.
  await page.evaluate(() => {
    document.documentElement.lang = "de";
    document.querySelector("section")?.removeAttribute("lang");
  });
  for (const id of ["own", "around"])
    await page.waitForFunction(
      ([id, de]) =>
        document
          .querySelector(`#${id}`)
          ?.shadowRoot?.querySelector("#tab-results")?.textContent === de,
      [id, de],
    );
  assert.equal(await tab("none"), zh, "its own language stays");
});

test("the language that is set last is shown, however late the words of the one before come", async () => {
  await page?.close();
  await open("<main></main>");
  await page.route(/\/de\.js$/, async (route) => {
    await new Promise((done) => setTimeout(done, 700));
    await route.continue();
  });
  await page.evaluate(async () => {
    const element = /** @type {any} */ (document.createElement("touch-path"));
    element.lang = "de";
    document.querySelector("main")?.append(element);
    await new Promise((done) => setTimeout(done, 250));
    element.lang = "ru";
    await element.ready;
  });
  const ru = wordsOf("ru").Results;
  await page.waitForFunction(
    (ru) =>
      document
        .querySelector("touch-path")
        ?.shadowRoot?.querySelector("#tab-results")?.textContent === ru,
    ru,
  );
  // Inside a shadow root of the host, the language of the host page counts.
  const german = await page.evaluate(async () => {
    const host = document.createElement("div");
    host.lang = "de-DE";
    document.body.append(host);
    const element = /** @type {any} */ (document.createElement("touch-path"));
    host.attachShadow({ mode: "open" }).append(element);
    await element.ready;
    return element.shadowRoot.querySelector("#tab-results").textContent;
  });
  assert.equal(german, wordsOf("de").Results);
});

test("a job that no form can send was taken, and its form sent the one before: it is refused", async () => {
  await open(
    "<form><touch-path name=j cycle=hole></touch-path></form>",
    LISTEN,
  );
  await heard();
  const state = await on((element) => {
    const turning = { format: 1, cycle: { type: "hole" } };
    Object.assign(turning, { self: turning });
    for (const job of [
      { format: 1, cycle: { type: "hole", diameter: 10n } },
      { format: 1, note: 10n, cycle: { type: "hole" } },
      turning,
    ])
      element.job = job;
    return [
      element.job.cycle.diameter,
      element.plan !== null,
      element.form.checkValidity(),
    ];
  });
  assert.deepEqual(state, [40, true, true]);
  const events = await heard();
  assert.deepEqual(
    events.map(([name, { refused, findings }]) => [
      name,
      refused,
      findings[0].code,
    ]),
    // An object that holds itself is nested without end.
    ["unreadable", "unreadable", "too-long"].map((code) => [
      "finding",
      true,
      code,
    ]),
  );
});

test("a form that was put back within a second of its first job kept the last one", async () => {
  await open("<form><touch-path name=j cycle=hole></touch-path></form>");
  for (const value of ["45", "40", "50"])
    await field("cycle.diameter").fill(value);
  const held = await on((element) => {
    element.form.reset();
    return [
      element.job.cycle.diameter,
      JSON.parse(String(new FormData(element.form).get("j"))).cycle.diameter,
    ];
  });
  assert.deepEqual(held, [40, 40]);
});
