// A setter's view: three answers, few controls, words of the trade, a tablet. The tasks come from observed users.
import assert from "node:assert/strict";
import { test } from "node:test";
import {
  boxOf,
  field,
  held,
  open,
  page,
  panel,
  saveButton,
  settles,
  setUp,
  steady,
  textOf,
} from "./common.mjs";

setUp({ width: 1440, height: 900 });

/** The page as a visitor has it: nothing is unfolded, nothing for CAM is shown. */
const asVisitor = async (
  /** @type {import("playwright-core").BrowserContextOptions} */ options = {},
) => {
  await open({ viewport: { width: 1440, height: 900 }, ...options });
  await page.evaluate(() => localStorage.clear());
  await page.evaluate(() => sessionStorage.clear());
  // The state is written when the page is left: the next load must not find it.
  await page.addInitScript(() => {
    if (sessionStorage.getItem("fresh")) return;
    localStorage.clear();
    sessionStorage.clear();
    sessionStorage.setItem("fresh", "1");
  });
  await page.reload();
  await page
    .locator("tp-picture canvas")
    .first()
    .waitFor({ state: "attached" });
  await page.locator("tp-program .line").first().waitFor({ state: "attached" });
};

const tabs = () =>
  page.locator("[role=tab] > span:first-child").allTextContents();
const groups = () => page.locator("tp-form .group h2 b").allTextContents();

/** Amount that a page shows: controls and words. */
const shown = () =>
  page.evaluate(() => {
    const root = /** @type {ShadowRoot} */ (
      document.querySelector("touch-path")?.shadowRoot
    );
    const seen = (/** @type {Element | null} */ one) =>
      one?.checkVisibility({ visibilityProperty: true }) &&
      one.getBoundingClientRect().width > 1 &&
      !one.closest(".visually-hidden") &&
      getComputedStyle(one).clipPath === "none";
    const controls = [
      ...root.querySelectorAll("button, input, select, textarea, summary"),
    ].filter(seen).length;
    const texts = document.createTreeWalker(root, NodeFilter.SHOW_TEXT);
    let words = 0;
    for (let node = texts.nextNode(); node; node = texts.nextNode())
      if (
        seen(node.parentElement) &&
        !node.parentElement?.closest("select, style")
      )
        words += (node.textContent?.match(/\S+/g) ?? []).length;
    return { controls, words };
  });

test("a first visit is a bore with five fields and three doors beside it; what CAM needs besides comes with its switch, with a dump, or with a portal that asks", async () => {
  await asVisitor();
  assert.equal(await held("cycle.type"), "hole");
  assert.deepEqual(await tabs(), [
    "Results",
    "Program",
    "Parameters",
    "Measured values, report",
    "Checks",
  ]);
  assert.deepEqual(await groups(), [
    "Clearances, touches, feeds",
    "Machine and probe",
    "Stock and virtual part",
  ]);
  const { controls, words } = await shown();
  assert.ok(controls <= 32 && words <= 200, `${controls} ${words}`);
  assert.equal(
    await field("cycle.type").locator("option").count(),
    17,
    "cycles that move nothing are for CAM",
  );
  assert.match(
    await page.locator(".sentence").innerText(),
    /^Find[\s\S]*hole Ø40[\s\S]*on[\s\S]*LinuxCNC[\s\S]*Ø6 probe[\s\S]*the program[\s\S]*measures only/,
  );
  await page.getByRole("button", { name: "More" }).click();
  await page.getByLabel("For CAM: parameters, codes, picked touches").check();
  await page.keyboard.press("Escape");
  assert.ok((await groups()).includes("Picked touches"));
  assert.equal(await field("cycle.type").locator("option").count(), 19);
  await asVisitor();
  assert.ok(!(await groups()).includes("Picked touches"));
  // A dump in the clipboard: pasted outside of fields it is opened.
  await page.evaluate(() => {
    const data = new DataTransfer();
    data.setData(
      "text/plain",
      "CmdPrm.Int[-1] = 6\nCmdPrm.Flt[-50] = 20\nCmdPrm.Flt[-53] = 61\nCmdPrm.Flt[-54] = 41\n",
    );
    document.body.dispatchEvent(
      new ClipboardEvent("paste", {
        clipboardData: data,
        bubbles: true,
        cancelable: true,
      }),
    );
  });
  await settles(
    async () => (await held("cycle.type")) === "internal-rectangle",
  );
  assert.equal(await held("cycle.width1"), 61);
  assert.ok(
    (await groups()).includes("Picked touches"),
    "who opens a dump writes a postprocessor",
  );
});

test("what nothing has whole is found by its parts, and Enter opens the tool lengths where only they are found", async () => {
  await asVisitor();
  await page.getByRole("button", { name: "Gallery" }).click();
  const search = page.locator("tp-gallery input");
  const found = page.locator("tp-gallery [data-type]:visible");
  await search.fill("pocket LENTOAX");
  assert.match(
    await textOf(page.locator("tp-gallery .status-text")),
    /some of them/,
  );
  await search.fill("LENTOAX");
  assert.equal(await found.count(), 0);
  await page
    .locator("tp-gallery")
    .getByText("which tool length acts on which axis")
    .waitFor();
  await search.press("Enter");
  await page.locator("tp-lentoax").waitFor();
});

test("each cycle and each control has its page, one click away from where it is named", async () => {
  await asVisitor();
  const page7 = page.locator("tp-manual");
  await page
    .locator("tp-help")
    .getByRole("button", { name: "About this cycle" })
    .click();
  await page7.getByRole("heading", { name: "Hole", exact: true }).waitFor();
  assert.match(await textOf(page7), /touched from the centre/);
  await page.keyboard.press("Escape");
  await page.getByRole("button", { name: "Gallery" }).click();
  await page.getByRole("button", { name: "About Boss" }).click();
  await page7.getByRole("button", { name: "Measure this" }).click();
  assert.equal(await held("cycle.type"), "boss");
  await field("control.post").selectOption("sinumerik");
  const mark = page.locator("tp-findings .control-notes");
  assert.match(await textOf(mark), /Not yet run on this control/);
  // The footer is about this job: it omits general notes on the control.
  assert.doesNotMatch(
    await textOf(page.locator("footer")),
    /recalled|not verified/,
  );
  await mark.click();
  await page7.getByRole("heading", { name: /SINUMERIK/ }).waitFor();
  assert.match(await textOf(page7), /None of it was run on a control/);
  await page.keyboard.press("Escape");
  await field("control.post").selectOption("grbl");
  assert.match(await textOf(mark), /approach is not watched/);
});

test("of what a control's own cycle does itself it is not said that the control cannot", async () => {
  await asVisitor();
  await field("cycle.type").selectOption("hole");
  await field("control.post").selectOption("heidenhain");
  await page.getByRole("tab", { name: "Checks" }).click();
  const checks = await textOf(page.locator("tp-checks"));
  assert.match(checks, /left to the native cycles/);
  assert.doesNotMatch(checks, /cannot guarantee/);
  assert.equal(
    await page.locator("tp-checks [aria-label='this control cannot']").count(),
    0,
  );
});

test("one list finds cycles, fields, controls, tools and actions", async () => {
  await asVisitor();
  const search = page.getByRole("combobox", { name: "Find anything" });
  const type = async (/** @type {string} */ words) => {
    await page.keyboard.press("Control+k");
    await search.fill(words);
    await page.keyboard.press("Enter");
    await page.locator("dialog.commands[open]").waitFor({ state: "hidden" });
  };
  await type("boss");
  assert.equal(await held("cycle.type"), "boss");
  await type("haas");
  assert.equal(await held("control.post"), "haas");
  await type("latency");
  const focused = () =>
    page.evaluate(
      () => document.querySelector("touch-path")?.shadowRoot?.activeElement?.id,
    );
  await settles(async () => (await focused()) === "f-machine.latency");
  await type("LENTOAX");
  await page.locator("tp-lentoax").waitFor();
  await page.keyboard.press("Escape");
  await page.keyboard.press("Control+k");
  await search.fill("reset");
  await page.keyboard.press("ArrowDown");
  await page.keyboard.press("ArrowUp");
  assert.match(
    await textOf(page.locator(".commands [aria-selected=true]")),
    /Reset/,
  );
  await page.keyboard.press("Escape");
  assert.equal(await page.locator("dialog[open]").count(), 0);
});

test("a machine is kept once, stands in the bar, and is one click", async () => {
  await asVisitor();
  await field("control.post").selectOption("haas");
  await page.keyboard.press("Control+k");
  await page
    .getByRole("combobox", { name: "Find anything" })
    .fill("ball diameter");
  await page.keyboard.press("Enter");
  await field("stylus.diameter").fill("4");
  await field("control.post").selectOption({ label: "Store this machine …" });
  const dialog = page.getByRole("dialog", { name: "My machines" });
  await dialog.getByLabel("Name of the machine").fill("Mill 2, ball 4");
  await dialog.getByRole("button", { name: "Keep the current values" }).click();
  await page.keyboard.press("Escape");
  const chosen = () => textOf(field("control.post").locator("option:checked"));
  assert.equal(await chosen(), "Mill 2, ball 4");
  await field("control.post").selectOption("linuxcnc");
  await field("stylus.diameter").fill("6");
  assert.equal(await chosen(), "LinuxCNC");
  await field("control.post").selectOption({ label: "Mill 2, ball 4" });
  assert.deepEqual(
    [await held("control.post"), await held("stylus.diameter")],
    ["haas", 4],
  );
  // In other units it is the same machine.
  await page.getByRole("radio", { name: "inch", exact: true }).check();
  assert.equal(await chosen(), "Mill 2, ball 4");
});

test("what a browser keeps for a machine may be anything: the page stands", async () => {
  await asVisitor();
  await page.evaluate(() => {
    let deep = /** @type {unknown} */ (1);
    for (let i = 0; i < 500; i++) deep = { deep };
    const sections = {
      control: { post: deep, number: [null, "x"] },
      stylus: { diameter: {} },
    };
    const one = { name: "<b>x", units: "inch", overtravel: "y", sections };
    const file = {
      format: "touchpath-presets",
      version: 1,
      presets: [one, { ...one, name: "two", units: "mm" }],
    };
    localStorage.setItem("touchpath.presets.1", JSON.stringify(file));
  });
  await page.reload();
  await page.locator("tp-program .line").first().waitFor({ state: "attached" });
  const named = await field("control.post").locator("option").allTextContents();
  assert.deepEqual(named.slice(0, 2), ["<b>x", "two"]);
  await field("control.post").selectOption({ label: "<b>x" });
  await page.locator("tp-findings .note").waitFor();
  assert.equal(await held("control.post"), "linuxcnc");
});

test("93 work offsets of one word are a number, not 93 entries", async () => {
  await asVisitor();
  await field("control.post").selectOption("haas");
  const offsets = await field("control.workOffset")
    .locator("option")
    .allTextContents();
  assert.deepEqual(offsets.slice(0, 3), [
    "measures only",
    "writes G54",
    "writes G55",
  ]);
  assert.ok(offsets.length < 12, `${offsets.length}`);
  await field("control.workOffset").selectOption({ label: "writes G154 P…" });
  await panel("program");
  const number = page.getByLabel("Number after G154 P");
  await number.fill("12");
  await number.press("Enter");
  assert.match(
    await textOf(page.locator("tp-program .write-summary")),
    /writes G154 P12 X Y/,
  );
  await number.fill("120");
  await number.press("Enter");
  await page
    .locator(".note", { hasText: "Enter a whole number from 1 to 99" })
    .waitFor();
  assert.equal(
    await number.inputValue(),
    "12",
    "what is no such number changes nothing",
  );
});

test("the program shows its moves and four touches; what checks and computes stands under one mark a run", async () => {
  await asVisitor();
  await panel("program");
  for (const post of ["haas", "sinumerik", "linuxcnc", "grbl"]) {
    await field("control.post").selectOption(post);
    const code = page.locator("tp-program .code[role=listbox]");
    const discs = code.locator(".line.touch .disc");
    assert.deepEqual(await discs.allTextContents(), ["1", "2", "3", "4"], post);
    const shown = (
      await code
        .locator("[role=group]:not([hidden]) .line .text")
        .allTextContents()
    ).join("\n");
    assert.doesNotMatch(shown, /GOTO|STOPRE|endif/, post);
    // Nothing is lost: a click opens a run, the button all of them.
    const all = await page.evaluate(
      () =>
        /** @type {any} */ (
          document.querySelector("touch-path")
        ).store.plan.program.text
          .trim()
          .split("\n").length,
    );
    const folds = code.locator(".folded");
    if (post === "grbl") continue;
    const before = await folds.count();
    assert.ok(before > 8, `${post}: ${before}`);
    await folds.first().click();
    assert.equal(await folds.count(), before - 1);
    await page.getByRole("button", { name: "All lines" }).click();
    assert.equal(await code.locator(".line").count(), all, post);
    await page.getByRole("button", { name: "All lines" }).click();
    assert.equal(await folds.count(), before);
  }
});

test("the operator's screen is shown as it will stand there", async () => {
  await asVisitor();
  await page.evaluate(() =>
    /** @type {any} */ (document.querySelector("touch-path")).store.put(
      "part.offset[0]",
      0.25,
    ),
  );
  await panel("program");
  const screen = page.locator("tp-program .screen");
  await screen.locator("summary").click();
  // As LinuxCNC's interpreter prints a value in DEBUG: six decimals.
  assert.match(
    await textOf(screen.locator("pre")),
    /^center\.x=0\.250000\ncenter\.y=0\.000000\ndiameter=40\.000000/,
  );
  await field("control.post").selectOption("sinumerik");
  assert.match(
    await textOf(screen.locator("pre")),
    /center\.x=0\.250 center\.y=0\.000/,
  );
});

test("a browser in en-US begins in inch", async () => {
  await asVisitor({ locale: "en-US" });
  assert.equal(await held("units"), "inch");
  assert.equal(await field("cycle.diameter").inputValue(), "1.6");
});

test("a browser in zh-CN has simplified Chinese", async () => {
  await asVisitor({ locale: "zh-CN" });
  assert.equal((await tabs())[0], "结果");
});

/** Counts clicks and keys of a user. */
function counted() {
  let [clicks, keys] = [0, 0];
  return {
    click: async (/** @type {import("playwright-core").Locator} */ where) => {
      clicks++;
      await where.click();
    },
    // One click opens a list, a second one chooses its entry.
    choose: async (
      /** @type {import("playwright-core").Locator} */ list,
      /** @type {string} */ label,
    ) => {
      clicks += 2;
      await list.selectOption({ label });
    },
    type: async (/** @type {string} */ text) => {
      for (const key of text
        .split(/(?=[A-Z][a-z]+$)/)
        .flatMap((part) => (/^[A-Z][a-z]+$/.test(part) ? [part] : [...part]))) {
        keys++;
        await page.keyboard.press(key);
      }
    },
    said: () => [clicks, keys],
  };
}

test("pocket 60 × 40 with an island on a Haas, G55: at most 8 clicks and 7 keys, and no stop", async () => {
  await asVisitor();
  const user = counted();
  await user.choose(field("cycle.type"), "Internal rectangle, protected");
  await user.choose(field("control.post"), "Haas NGC");
  await user.choose(field("control.workOffset"), "writes G55");
  await user.click(field("cycle.width1"));
  await user.type("60Enter");
  await user.type("40");
  const download = page.waitForEvent("download");
  await user.click(saveButton());
  assert.equal((await download).suggestedFilename(), "POCKET-60X40.nc");
  const [clicks, keys] = user.said();
  assert.ok(
    (clicks ?? 9) <= 8 && (keys ?? 99) <= 7,
    `${clicks} clicks, ${keys} keys`,
  );
  assert.match(
    await textOf(page.locator(".sentence .then option:checked")),
    /writes G55 X Y/,
  );
  assert.equal(await held("cycle.type"), "internal-rectangle-protected");
});

test("bore D25 H7 on a Fanuc, G54: at most 6 clicks and 12 keys, and no stop", async () => {
  await asVisitor();
  const user = counted();
  await user.choose(field("control.post"), "Fanuc 30i / 0i-F");
  await user.choose(field("control.workOffset"), "writes G54");
  await user.click(field("cycle.diameter"));
  await user.type("25H7");
  await page.keyboard.press("Tab");
  const download = page.waitForEvent("download");
  await user.click(saveButton());
  assert.equal((await download).suggestedFilename(), "BORE-D25H7.nc");
  const [clicks, keys] = user.said();
  assert.ok(
    (clicks ?? 9) <= 6 && (keys ?? 99) + 1 <= 12,
    `${clicks} clicks, ${keys} keys and Enter`,
  );
  const row = await page.evaluate(() => {
    const { plan } = /** @type {any} */ (document.querySelector("touch-path"));
    return plan.results.find((/** @type {any} */ r) => r.code === "diameter");
  });
  assert.deepEqual(row.limits, [25, 25.021]);
  assert.equal(row.verdict, "good");
});

for (const [width, height] of /** @type {[number, number][]} */ ([
  [1440, 900],
  [768, 1024],
  [390, 844],
]))
  test(`a vise corner and a plate take at most 4 clicks each, and no stop: ${width} × ${height}`, async () => {
    for (const [name, writes] of [
      ["vise", "G54 X Y Z and rotation"],
      ["plate", "G54 X Y and rotation"],
    ]) {
      await asVisitor({ viewport: { width, height }, locale: "en-GB" });
      const user = counted();
      const find = page.getByRole("button", { name: /Find anything/ });
      if (width > 600) await user.click(find);
      else {
        await user.click(page.getByRole("button", { name: "More" }));
        await user.click(find);
      }
      const search = page.locator("tp-commands input");
      await search.waitFor();
      await user.type(String(name));
      await page
        .locator("tp-commands [role=option][aria-selected=true]", {
          hasText: new RegExp(String(name), "i"),
        })
        .waitFor();
      await page.keyboard.press("Enter");
      const download = page.waitForEvent("download");
      await user.click(saveButton());
      assert.equal(
        (await download).suggestedFilename(),
        `${name?.toUpperCase()}.ngc`,
      );
      const [clicks = 9] = user.said();
      assert.ok(clicks <= 4, `${clicks} clicks`);
      const does = await page.evaluate(
        () =>
          /** @type {any} */ (document.querySelector("touch-path")).plan.program
            .does,
      );
      assert.equal(does, `writes ${writes}`);
    }
  });

for (const [width, height] of /** @type {[number, number][]} */ ([
  [768, 1024],
  [1024, 768],
  [1180, 820],
  [844, 390],
  [640, 400],
  [390, 844],
]))
  test(`the drawing has 55 % of its canvas, and no text is under 13 px: ${width} × ${height}`, async () => {
    await asVisitor({
      viewport: { width, height },
      hasTouch: true,
      isMobile: width < 800,
    });
    await page.evaluate(() =>
      /** @type {any} */ (document.querySelector("touch-path")).store.choose(
        "internal-rectangle-protected",
      ),
    );
    const share = await steady(() =>
      page.evaluate(() => {
        const root = document.querySelector("touch-path")?.shadowRoot;
        const picture = /** @type {any} */ (root?.querySelector("tp-picture"));
        const canvas = /** @type {HTMLCanvasElement} */ (
          picture.querySelector("canvas")
        );
        const lines = picture.drawing.use((/** @type {any} */ view) =>
          view.dimensionLines(),
        );
        // As wide, or where the picture is low as high.
        const long = (/** @type {string} */ field) => {
          const [, x1, y1, x2, y2] = lines.find(
            (/** @type {any[]} */ line) => line[0] === field,
          );
          return Math.hypot(x2 - x1, y2 - y1);
        };
        return Math.max(
          long("cycle.width1") / canvas.clientWidth,
          long("cycle.width2") / canvas.clientHeight,
        );
      }),
    );
    assert.ok(share >= 0.55, `${share}`);
    const small = await page.evaluate(() => {
      const root = /** @type {ShadowRoot} */ (
        document.querySelector("touch-path")?.shadowRoot
      );
      return [...root.querySelectorAll("*")]
        .filter(
          (one) =>
            one.checkVisibility() &&
            [...one.childNodes].some(
              (n) => n.nodeType === 3 && n.nodeValue?.trim(),
            ),
        )
        .filter((one) => !one.closest(".visually-hidden, style, option"))
        .filter((one) => Number.parseFloat(getComputedStyle(one).fontSize) < 13)
        .map(
          (one) =>
            `${one.tagName}.${one.className} ${one.textContent?.trim().slice(0, 20)}`,
        );
    });
    assert.deepEqual(small, []);
    if (height > width && width >= 600) {
      const [picture, form] = [
        await boxOf(page.locator("tp-picture")),
        await boxOf(page.locator("tp-form")),
      ];
      assert.ok(
        picture.y + picture.height <= form.y && picture.width > 0.95 * width,
        "the picture is above, and whole",
      );
    }
  });
