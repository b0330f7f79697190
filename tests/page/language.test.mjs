// Languages of the page: chosen by the browser or the user, stored, complete, and without wrong numbers or another program.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { wordsOf } from "../../scripts/words.mjs";
import {
  context,
  field,
  open,
  openTab,
  openText,
  page,
  panel,
  problems,
  program,
  put,
  ready,
  setUp,
  textOf,
} from "./common.mjs";

setUp({ width: 1440, height: 900 });

const LANGUAGES = /** @type {const} */ ({
  de: "de-AT",
  ru: "ru",
  "zh-Hant": "zh-TW",
});
const inside = (/** @type {string} */ selector) =>
  page.locator(`touch-path ${selector}`);
/** The page in a browser of this language. */
const openIn = (
  /** @type {string} */ locale,
  viewport = { width: 1440, height: 900 },
) => open({ viewport, locale });

for (const [language, locale] of Object.entries(LANGUAGES)) {
  test(`a browser in ${locale} gets the page in ${language}, and the same program`, async () => {
    const english = await program();
    await openIn(locale);
    const words = wordsOf(language);
    assert.equal(await inside("tp-app").getAttribute("lang"), language);
    assert.equal(await textOf(inside("#tab-program")), words.Program);
    assert.equal(
      await textOf(inside("label[for='f-cycle.width1']")),
      words["Width 1"],
    );
    assert.equal(await program(), english, "a program is English always");
    // A finding in the footer, in the help and at Save.
    await field("cycle.sideClearance1").fill("90");
    const message = await textOf(inside("tp-findings .verdict"));
    const said = /** @type {string} */ (
      words[
        "{clearance_label} ({clearance}) puts the ball into the opposite wall: with {label} of {width} it must be less than {limit}"
      ]
    );
    const shown = said
      .replace(
        "{clearance_label}",
        /** @type {string} */ (words["Side clearance 1"]),
      )
      .replace("{clearance}", "90 mm")
      .replace("{label}", /** @type {string} */ (words["Width 1"]))
      .replace("{width}", "80 mm")
      .replace("{limit}", "77 mm");
    assert.ok(message.includes(shown), message);
    assert.ok((await textOf(inside("#withheld"))).includes(shown));
  });

  test(`no English is left in ${language}`, async () => {
    await openIn(locale);
    // Words of the page that are the same in that language, names, and codes.
    const same = new Set(
      Object.entries(wordsOf(language)).flatMap(([english, words]) =>
        english === words ? [english] : [],
      ),
    );
    const left = await page.evaluate(async () => {
      const host = /** @type {any} */ (document.querySelector("touch-path"));
      const root = host.shadowRoot;
      /** @type {string[]} */
      const found = [];
      const skip =
        ".code, pre, code, #lang option, .unit, h1, option[value^='linux'], canvas + *";
      const walk = () => {
        const all = document.createTreeWalker(root, NodeFilter.SHOW_TEXT);
        for (let node = all.nextNode(); node; node = all.nextNode())
          if (!node.parentElement?.closest(skip))
            found.push(node.textContent?.trim() ?? "");
        for (const one of root.querySelectorAll(
          "[aria-label], [title], [placeholder]",
        ))
          for (const name of ["aria-label", "title", "placeholder"])
            found.push(one.getAttribute(name) ?? "");
      };
      root.querySelector("tp-form").unfold();
      /** Waits until nothing changes: two frames with the same length of the page. */
      const rest = async () => {
        for (let before = -1; before !== root.textContent.length; ) {
          before = root.textContent.length;
          for (let frame = 0; frame < 2; frame++)
            await new Promise((done) => requestAnimationFrame(done));
        }
      };
      for (const tab of root.querySelectorAll("[role=tab]")) {
        tab.click();
        for (const details of root.querySelectorAll("details"))
          details.open = true;
        await rest();
        walk();
      }
      for (const tool of ["gallery", "lengths", "sheet", "cycles"]) {
        await host.app.actions.ask(tool === "cycles" ? "gallery" : tool);
        await rest();
        walk();
      }
      return [...new Set(found)];
    });
    assert.ok(left.length > 250, `${left.length} texts are seen`);
    const words = wordsOf(language);
    // A translated text must not appear in English.
    const english = left.filter(
      (text) =>
        Object.hasOwn(words, text) &&
        words[text] !== text &&
        !same.has(text) &&
        !Object.values(words).includes(text),
    );
    assert.deepEqual(english, []);
  });
}

for (const [language, locale] of Object.entries({ en: "en-GB", ...LANGUAGES }))
  for (const viewport of [
    { width: 1440, height: 900 },
    { width: 1280, height: 800 },
    { width: 390, height: 844 },
  ])
    test(`${language} fits ${viewport.width} pixels`, async () => {
      await openIn(locale, viewport);
      await page.evaluate(() =>
        /** @type {any} */ (document.querySelector("touch-path")).store.choose(
          "probing-two-circles",
        ),
      );
      await put("cycle.diameter2", "20H7");
      await put("part", {
        offset: [0.12, -0.3, 0],
        rotation: 2,
        sizes: { diameter2: 0.05 },
      });
      const wide = await page.evaluate(async () => {
        const root = /** @type {ShadowRoot} */ (
          document.querySelector("touch-path")?.shadowRoot
        );
        /** @type {string[]} */
        const found = [];
        const look = (
          /** @type {string} */ selector,
          /** @type {string} */ where,
        ) => {
          for (const box of root.querySelectorAll(selector))
            if (box.checkVisibility() && box.scrollWidth > box.clientWidth + 1)
              found.push(
                `${where}: ${selector} ${box.scrollWidth} > ${box.clientWidth}`,
              );
        };
        for (const tab of /** @type {NodeListOf<HTMLElement>} */ (
          root.querySelectorAll("[role=tab]")
        )) {
          tab.click();
          // The panel exists in the next frame, and is laid out in the one after it.
          for (let frame = 0; frame < 2; frame++)
            await new Promise((done) => requestAnimationFrame(done));
          for (const selector of [
            ".frame",
            "header",
            ".tabs",
            "main > section",
            "tp-form",
            ".tools button",
            ".timeline",
            "tp-bar .primary",
          ])
            look(selector, tab.id);
        }
        return found;
      });
      assert.deepEqual(wide, []);
    });

test("numbers are written as the language does, typed in either way, and unchanged in the job", async () => {
  await openIn("de");
  const width = field("cycle.width1");
  await width.fill("80,5");
  await width.press("Enter");
  assert.equal(await width.inputValue(), "80,5");
  await field("cycle.width2").fill("50.25");
  await field("cycle.depth").focus();
  await put("cycle.width2", 50.25);
  assert.equal(await field("cycle.width2").inputValue(), "50,25");
  const job = await page.evaluate(
    () => /** @type {any} */ (document.querySelector("touch-path")).job,
  );
  assert.deepEqual([job.cycle.width1, job.cycle.width2], [80.5, 50.25]);
  await panel("results", page);
  assert.match(await textOf(inside("tp-results tbody").first()), /80,500/);
  assert.doesNotMatch(
    await textOf(inside("tp-results tbody").first()),
    /80\.500/,
  );
  assert.match(await program(), /X40\.25\b|X4\d\.\d/, "a program has points");
  // Points that are filled in as a start stay readable as points.
  await panel("measured");
  await inside("details.measured button").first().click();
  assert.match(await inside("#measured").inputValue(), /^-?\d+\.\d+, /);
  assert.equal(await inside("tp-measured .problem").count(), 0);
});

test("in a language with a comma a field that is only looked at stays as it is, and what the page prints can be typed", async () => {
  await openIn("de");
  await put("cycle.width1", 70.25);
  const width = field("cycle.width1");
  await width.focus();
  await width.press("Escape");
  assert.equal(await width.inputValue(), "70,25");
  await width.fill("80,000");
  assert.equal(
    await page.evaluate(
      () =>
        /** @type {any} */ (document.querySelector("touch-path")).job.cycle
          .width1,
    ),
    80,
  );
  // Text of a user is quoted as it was written.
  await put("plane", "1.5");
  assert.match(await textOf(inside("tp-findings .verdict")), /"1\.5"/);
});

test("a number in the other way of writing shows what it was read as", async () => {
  await openIn("de-AT");
  const width = field("cycle.width1");
  await width.fill("81.250");
  assert.equal(
    await width.inputValue(),
    "81.250",
    "nothing moves under the fingers",
  );
  await width.blur();
  assert.equal(await width.inputValue(), "81,25");
  await openIn("en");
  await field("cycle.width1").fill("81,250");
  await field("cycle.width1").blur();
  assert.equal(await field("cycle.width1").inputValue(), "81.25");
});

test("the picture that is saved has the names and numbers of the page's language", async () => {
  await openIn("de-AT");
  await field("cycle.width1").fill("80,5");
  const words = wordsOf("de");
  await page.locator("tp-bar [popovertarget=menu]").click();
  const [download] = await Promise.all([
    page.waitForEvent("download"),
    page
      .locator("#menu")
      .getByRole("button", { name: words["Save the picture (SVG)"] })
      .click(),
  ]);
  const svg = readFileSync(await download.path(), "utf8");
  const texts = svg.replaceAll(/<\/?tspan[^>]*>/g, "").replaceAll(/\s+/g, " ");
  assert.ok(texts.includes(`>${words["Width 1"]} 80,5<`), "a dimension");
  assert.ok(
    svg.includes(
      `<title>POCKET-80_5X50: ${words["Internal rectangle, protected"]}</title>`,
    ),
    svg.slice(0, 400),
  );
});

test("where nothing can be kept, a chosen language lasts as long as the page", async () => {
  await page.addInitScript(() => {
    const refuse = () => {
      throw new DOMException("no storage", "SecurityError");
    };
    Object.defineProperty(window, "localStorage", { get: refuse });
    Object.defineProperty(window, "sessionStorage", { get: refuse });
  });
  await page.reload();
  await ready();
  await page.locator("button[popovertarget=menu]").click();
  await inside("#lang").selectOption("de");
  await page.getByRole("tab", { name: wordsOf("de").Program }).waitFor();
  assert.equal(await page.evaluate(() => document.documentElement.lang), "de");
});

test("a language is chosen by hand, and kept", async () => {
  await page.getByRole("button", { name: "More" }).click();
  await inside("#lang").selectOption("ru");
  const { Results: name } = wordsOf("ru");
  await page.getByRole("tab", { name }).waitFor();
  await page.reload();
  await ready();
  await page.getByRole("tab", { name }).waitFor();
  // Another tab starts in it; back in English, nothing of it stays.
  const other = await openTab();
  await other.getByRole("tab", { name }).waitFor();
  await page.locator("button[popovertarget=menu]").click();
  await inside("#lang").selectOption("en");
  await page.getByRole("tab", { name: "Results" }).waitFor();
  assert.equal(await inside("tp-app").getAttribute("lang"), "en");
  await page.keyboard.press("Escape");
  assert.doesNotMatch(await inside("tp-app").innerText(), /[а-яё]{3}/i);
  assert.equal(context.pages().length, 2);
});

test("words that cannot be had leave the language that is there, and say so", async () => {
  await page.route(/\/de-[^/]+\.js$/, (route) => route.abort());
  await page.locator("button[popovertarget=menu]").click();
  const before = await textOf(inside("#tab-program"));
  await inside("#lang").selectOption("de");
  await page.getByText("could not be loaded").waitFor();
  assert.equal(await textOf(inside("#tab-program")), before);
  // The browser says, too, that a file did not come.
  assert.equal(problems.splice(0).length, 1);
});

test("the keys and the question before Reset are in the language, too", async () => {
  await openIn("de");
  const words = wordsOf("de");
  await page.locator("button[popovertarget=menu]").click();
  await page.getByRole("button", { name: words.Keys, exact: true }).click();
  await page
    .getByText(/** @type {string} */ (words["save the program"]))
    .waitFor();
  await page.getByRole("button", { name: words.Close }).click();
  await page.locator("button[popovertarget=menu]").click();
  await page.getByRole("button", { name: words.Reset, exact: true }).click();
  await page
    .getByText(/** @type {string} */ (words["Internal rectangle, protected"]))
    .last()
    .waitFor();
});

test("the scale of a picture has the decimal sign of the language", async () => {
  await openIn("de-AT");
  // Texts in pictures.
  await page.evaluate(() => {
    const own = /** @type {any} */ (globalThis);
    own.written = [];
    const write = CanvasRenderingContext2D.prototype.fillText;
    CanvasRenderingContext2D.prototype.fillText = function (text, x, y) {
      own.written.push(text);
      write.call(this, text, x, y);
    };
  });
  /** The scale, looked at so closely that it is less than a millimetre. */
  const scale = (/** @type {string} */ part) =>
    inside(`${part} canvas:not(.over)`).evaluate(async (canvas) => {
      const own = /** @type {any} */ (globalThis);
      const { x, y, width, height } = canvas.getBoundingClientRect();
      const at = {
        clientX: x + width / 2,
        clientY: y + height / 2,
        bubbles: true,
        cancelable: true,
      };
      let last = "";
      for (let round = 0; round < 40 && !last.startsWith("0"); round++) {
        own.written = [];
        canvas.dispatchEvent(new WheelEvent("wheel", { ...at, deltaY: -300 }));
        for (let frame = 0; frame < 2; frame++)
          await new Promise((done) => requestAnimationFrame(done));
        last =
          own.written.findLast((/** @type {string} */ text) =>
            text.endsWith(" mm"),
          ) ?? "";
      }
      return last;
    });
  const speak = async (/** @type {string} */ language) => {
    await inside("#lang").evaluate((list, language) => {
      /** @type {HTMLSelectElement} */ (list).value = language;
      list.dispatchEvent(new Event("change", { bubbles: true }));
    }, language);
    await page.locator(`touch-path tp-app[lang=${language}]`).waitFor();
  };
  assert.match(await scale("tp-picture"), /^0,\d+ mm$/);
  await speak("en");
  assert.match(await scale("tp-picture"), /^0\.\d+ mm$/);
  await openText("G21 G90 G1 X0 Y0 Z0 F100\nX20 Y10\nM2\n", "plain.ngc");
  await inside("tp-viewer canvas").first().waitFor();
  assert.match(await scale("tp-viewer"), /^0\.\d+ mm$/);
  await speak("ru");
  assert.match(await scale("tp-viewer"), /^0,\d+ mm$/);
});
