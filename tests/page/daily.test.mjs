// A setter's daily work: changing cycles and controls, presets, pictures, phones, other devices.
import assert from "node:assert/strict";
import { test } from "node:test";
import {
  boxOf,
  chooseUnits,
  field,
  framed,
  held,
  more,
  open,
  page,
  panel,
  put,
  ready,
  settles,
  setUp,
  textOf,
  unfold,
} from "./common.mjs";

setUp();

const dialog = () => page.getByRole("dialog", { name: "My machines" });
const keep = async (/** @type {string} */ name) => {
  await dialog().getByLabel("Name of the machine").fill(name);
  await dialog()
    .getByRole("button", { name: "Keep the current values" })
    .click();
};

test("a preset of the same name gave way without a word, and a forgotten one was gone; what is not chosen of one stays", async () => {
  await more("My machines");
  await keep("A");
  await put("stylus.diameter", 2);
  await keep("A");
  const said = () => textOf(dialog().getByRole("status"));
  assert.equal(await said(), "Replaced “A”");
  await dialog().getByRole("button", { name: "Undo" }).click();
  await put("feeds.work", 90);
  await dialog().getByRole("checkbox", { name: "Feeds" }).uncheck();
  await dialog().getByRole("button", { name: "Use A" }).click();
  assert.equal(await held("stylus.diameter"), 6, "the first one is back");
  assert.equal(await held("feeds.work"), 90, "feeds were not chosen");
  await dialog().getByRole("button", { name: "Delete A" }).click();
  assert.equal(
    await dialog().getByRole("button", { name: "Use A" }).count(),
    0,
  );
  await dialog().getByRole("button", { name: "Undo" }).click();
  await dialog().getByRole("button", { name: "Use A" }).waitFor();
});

test("the form of another cycle began where the one before was scrolled to", async () => {
  await page.locator("tp-form").evaluate((form) => form.scrollTo(0, 400));
  await page.getByRole("button", { name: "Gallery" }).click();
  await page.locator("[data-type=surface]").click();
  await page.locator("tp-gallery").waitFor({ state: "detached" });
  assert.equal(
    await page.locator("tp-form").evaluate((form) => form.scrollTop),
    0,
  );
});

test("in the gallery everything is shown again where nothing is found, and Enter takes the first that is", async () => {
  await page.getByRole("button", { name: "Gallery" }).click();
  const search = page.locator("tp-gallery input");
  const found = () =>
    page
      .locator("tp-gallery [data-type]:visible")
      .evaluateAll((all) => all.map((one) => one.dataset.type));
  await search.fill("pocket");
  assert.deepEqual(await found(), [
    "internal-rectangle",
    "internal-rectangle-protected",
  ]);
  await search.fill("xyzzy");
  await page.getByRole("button", { name: "Show all" }).click();
  assert.equal((await found()).length, 19);
  await search.fill("web");
  await search.press("Enter");
  await page.locator("tp-gallery").waitFor({ state: "detached" });
  assert.equal(await held("cycle.type"), "web");
});

test("back in the browser left the page where the gallery stood", async () => {
  await page.getByRole("button", { name: "Gallery" }).click();
  await page.locator("tp-gallery").waitFor();
  await page.goBack();
  await page.locator("tp-gallery").waitFor({ state: "detached" });
  await page.locator("tp-picture canvas").first().waitFor();
  // The page's own way back leaves no entry in the history.
  await more("Tool lengths");
  await page.getByRole("button", { name: "Back to the job" }).click();
  await page.waitForFunction(() => !history.state);
  await more("Setup sheet to print");
  await page.locator("tp-sheet").waitFor();
  await page.goBack();
  await page.locator("tp-sheet").waitFor({ state: "detached" });
});

test("a browser that keeps nothing is said, once", async () => {
  await page.addInitScript(() => {
    const counts = Object.assign(globalThis, { refused: 0 });
    Storage.prototype.setItem = () => {
      counts.refused++;
      throw new DOMException("full", "QuotaExceededError");
    };
  });
  await page.reload();
  await ready();
  await field("cycle.width1").fill("70");
  const said = page.locator("tp-findings .note", {
    hasText: "This browser stores nothing",
  });
  await said.waitFor();
  const refused = () =>
    page.evaluate(() => /** @type {any} */ (globalThis).refused);
  const before = await refused();
  await field("cycle.width1").fill("71");
  await said.waitFor({ state: "detached" });
  // It is refused again after a moment.
  await settles(async () => (await refused()) > before);
  await framed();
  assert.equal(await said.count(), 0);
});

test("with an error the menu offered a sheet that did not come, and points of the part before were filled in", async () => {
  await put("cycle.depth", -1);
  await page.getByRole("button", { name: "More" }).click();
  const item = page
    .locator("#menu")
    .getByRole("button", { name: "Save the picture (SVG)" });
  assert.equal(await item.isDisabled(), true);
  assert.match((await item.getAttribute("title")) ?? "", /Depth/);
  const sheet = page
    .locator("#menu")
    .getByRole("button", { name: "Setup sheet to print" });
  assert.equal(await sheet.isDisabled(), true);
  await page.keyboard.press("Escape");
  await panel("measured");
  assert.equal(
    await page
      .getByRole("button", { name: "Fill in the points shown" })
      .isDisabled(),
    true,
  );
});

test("the sheet prints what the virtual part gives, and says so; it is paper in a dark page, too", async () => {
  await page.emulateMedia({ colorScheme: "dark" });
  await put("part.offset[0]", 0.3);
  await more("Setup sheet to print", page);
  const said = page.locator("tp-sheet .warning", { hasText: "virtual part" });
  assert.match(await textOf(said), /X \+0\.3/);
  const ink = await page
    .locator("tp-sheet [data-view=top]")
    .evaluate((canvas) => {
      const { width, height } = /** @type {HTMLCanvasElement} */ (canvas);
      const pen = /** @type {HTMLCanvasElement} */ (canvas).getContext("2d");
      // In the pocket, beside its lines.
      return [
        ...(pen?.getImageData(width * 0.6, height * 0.57, 1, 1).data ?? []),
      ];
    });
  assert.deepEqual(ink.slice(0, 3), [255, 255, 255]);
});

test("a screen reader hears the line that the arrow keys light", async () => {
  const list = page.getByRole("listbox", { name: "Program" });
  await list.focus();
  await page.keyboard.press("ArrowDown");
  const id = await list.getAttribute("aria-activedescendant");
  const lit = page.locator(`[id="${id}"]`);
  assert.equal(await lit.getAttribute("aria-selected"), "true");
  assert.match(await textOf(lit), /G38\.3|call/);
  await page.keyboard.press("Escape");
  assert.equal(await list.getAttribute("aria-activedescendant"), null);
});

test("the parameters of a touch are brought into sight", async () => {
  await page.getByRole("tab", { name: "Parameters" }).click();
  for (const _ of [1, 2, 3])
    await page.locator("#timeline").press("Control+ArrowRight");
  const row = page.locator("tp-table tr.lit").first();
  const [seen, box] = [
    await boxOf(row),
    await boxOf(page.locator("tp-table .scroll")),
  ];
  assert.ok(
    seen.y >= box.y - 1 && seen.y + seen.height <= box.y + box.height + 1,
    "the first row of touch 3",
  );
});

test("the legend names the lines that are there, and a cycle without motion has no timeline", async () => {
  const kinds = () => page.locator(".key li").allTextContents();
  assert.deepEqual(await kinds(), [
    "touch",
    "link, back",
    "positioning",
    "overtravel",
  ]);
  await put("feeds.approach", null);
  await put("part.offset[0]", 0.2);
  assert.deepEqual(await kinds(), [
    "touch",
    "link, back",
    "positioning",
    "rapid",
    "overtravel",
    "virtual part",
  ]);
  await field("cycle.type").selectOption("nc-action");
  await page.getByText("This cycle has no motion").waitFor();
  assert.deepEqual(
    [
      await page.locator(".key li").count(),
      await page.locator(".timeline").count(),
    ],
    [0, 0],
  );
});

test("a deviation that is drawn larger, and one that is not any more, are in the picture", async () => {
  const far = () =>
    page.evaluate(() => {
      const canvas = /** @type {any} */ (
        document.querySelector("touch-path")
      ).shadowRoot.querySelector("tp-picture canvas");
      const { width, height } = canvas;
      const { data } = canvas
        .getContext("2d")
        .getImageData(0, 0, width, height);
      // The outline of the virtual part, by its colour: its extent across the picture.
      let [least, most] = [width, 0];
      for (let i = 0; i < data.length; i += 4)
        if (
          Math.abs(data[i] - 15) < 12 &&
          Math.abs(data[i + 1] - 107) < 12 &&
          Math.abs(data[i + 2] - 117) < 12
        ) {
          const x = (i / 4) % width;
          [least, most] = [Math.min(least, x), Math.max(most, x)];
        }
      return [least / width, most / width];
    });
  await put("part.offset[0]", 0.2);
  for (const _ of [1, 2])
    await page.getByRole("button", { name: /Deviations are drawn/ }).click();
  await page
    .getByRole("button", { name: "Deviations are drawn 100 times as large" })
    .waitFor();
  await framed();
  const [left, right] = await far();
  assert.ok((left ?? 0) > 0.02 && (right ?? 1) < 0.98, `${left} ${right}`);
  await put("part.offset[0]", 12);
  await framed();
  const [from, to] = await far();
  assert.ok((to ?? 0) - (from ?? 0) > 0.3, `not a speck: ${from} ${to}`);
});

test("a long number in inch was printed over its unit", async () => {
  for (const [width, hasTouch] of /** @type {[number, boolean][]} */ ([
    [390, true],
    [1024, true],
    [1280, false],
  ])) {
    await open({
      viewport: { width, height: 844 },
      hasTouch,
      isMobile: hasTouch && width < 600,
    });
    await chooseUnits("inch");
    await unfold();
    const over = await page.locator("tp-form .number").evaluateAll((boxes) => {
      const pen = /** @type {CanvasRenderingContext2D} */ (
        document.createElement("canvas").getContext("2d")
      );
      return boxes.flatMap((box) => {
        const input = box.querySelector("input");
        const unit = box.querySelector(".unit");
        if (
          !input ||
          !unit?.checkVisibility() ||
          getComputedStyle(unit).opacity === "0"
        )
          return [];
        const style = getComputedStyle(input);
        pen.font = style.font;
        const end =
          input.getBoundingClientRect().left +
          Number.parseFloat(style.paddingLeft) +
          pen.measureText(input.value).width;
        return end > unit.getBoundingClientRect().left + 1
          ? [`${input.id} ${input.value}`]
          : [];
      });
    });
    assert.deepEqual(over, [], `${width}`);
  }
});

test("on a phone the chip of the door that is looked at stands out, and one with an error, too", async () => {
  await open({
    viewport: { width: 390, height: 844 },
    hasTouch: true,
    isMobile: true,
  });
  const now = () => page.locator(".chips [aria-current]").allTextContents();
  assert.deepEqual(await now(), []);
  await page
    .locator(".chips")
    .getByRole("button", { name: "Machine and probe" })
    .click();
  await page.waitForFunction(() => {
    const root = document.querySelector("touch-path")?.shadowRoot;
    return (
      root?.querySelector(".chips [aria-current]")?.textContent ===
      "Machine and probe"
    );
  });
  await put("feeds.work", -1);
  assert.deepEqual(await page.locator(".chips .error").allTextContents(), [
    "Clearances, touches, feeds",
  ]);
});

for (const [width, height] of /** @type {[number, number][]} */ ([
  [390, 844],
  [1024, 768],
]))
  test(`where fingers point, targets are 44 px and texts can be read: ${width}`, async () => {
    await open({ viewport: { width, height }, hasTouch: true, isMobile: true });
    const faults = [];
    for (const tab of ["Setup", "Program", "Parameters", "Results", "Checks"]) {
      await page.getByRole("tab", { name: tab }).click();
      await framed();
      faults.push(
        ...(await page.evaluate((tab) => {
          const root = /** @type {ShadowRoot} */ (
            document.querySelector("touch-path")?.shadowRoot
          );
          const seen = (/** @type {Element} */ one) =>
            one.checkVisibility() && one.getClientRects().length > 0;
          const small = [
            ...root.querySelectorAll(
              "button, select, input:not(.visually-hidden, [type=radio], [type=checkbox])",
            ),
          ].filter((one) => {
            if (!seen(one) || one.matches(".quiet, td button, p button"))
              return false;
            const { width, height } = one.getBoundingClientRect();
            return width > 1 && (width < 43.5 || height < 43.5);
          });
          const texts = [
            ...root.querySelectorAll(
              "p, td, th, label, button, summary, .line, .step, .note, .verdict",
            ),
          ].filter(
            (one) =>
              seen(one) &&
              !one.closest(".visually-hidden, .key, .clock") &&
              one.textContent?.trim() &&
              Number.parseFloat(getComputedStyle(one).fontSize) < 13,
          );
          return [...small, ...texts].map(
            (one) =>
              `${tab}: ${one.tagName} ${one.className} ${one.textContent?.trim().slice(0, 20)}`,
          );
        }, tab)),
      );
    }
    assert.deepEqual(faults, []);
  });

test("forced colours: the picture has the user's, and what is not chosen has no line", async () => {
  await page.emulateMedia({ forcedColors: "active", colorScheme: "dark" });
  const ground = () =>
    page
      .locator("tp-picture canvas")
      .first()
      .evaluate((canvas) => {
        const pen = /** @type {HTMLCanvasElement} */ (canvas).getContext("2d");
        const probe = document.createElement("span");
        probe.style.color = "Canvas";
        document.body.append(probe);
        const wanted = getComputedStyle(probe).color;
        probe.remove();
        const [r, g, b] = pen?.getImageData(3, 3, 1, 1).data ?? [];
        return `rgb(${r}, ${g}, ${b})` === wanted;
      });
  await settles(ground);
});

test("what is pasted and cannot be read says why beside it, and Escape closes it", async () => {
  await open({
    viewport: { width: 390, height: 844 },
    hasTouch: true,
    isMobile: true,
  });
  await more("Paste");
  const box = page.getByRole("dialog", { name: "Paste" });
  await box.locator("#paste").fill("hello");
  await box.getByRole("button", { name: "Read it" }).click();
  const why = box.getByRole("status");
  await why.filter({ hasText: /neither/ }).waitFor();
  const seen = await boxOf(why);
  assert.ok(seen.y > 0 && seen.y + seen.height < 844, "in sight");
  assert.equal(await box.locator("#paste").inputValue(), "hello");
  await page.keyboard.press("Escape");
  await box.waitFor({ state: "hidden" });
});

test("a height turns the picture to where it is seen, an angle about the tool axis, too", async () => {
  const view = () =>
    page.locator(".picture .cube [aria-pressed=true]").textContent();
  for (const type of [
    "hole",
    "internal-rectangle",
    "groove",
    "web-three-points",
    "probing-two-circles",
  ]) {
    await field("cycle.type").selectOption(type);
    await unfold();
    for (const key of [
      "topClearance",
      "middleClearance",
      "feedDistance",
      "clearanceHeight",
    ]) {
      if ((await field(`cycle.${key}`).count()) === 0) continue;
      await page
        .getByRole("button", { name: "top", exact: true })
        .click({ force: true });
      await field(`cycle.${key}`).focus();
      await settles(async () => /front|side/.test((await view()) ?? ""));
    }
    for (const key of [
      "rotation",
      "startAngle",
      "startingAngle",
      "angularLength",
    ]) {
      if ((await field(`cycle.${key}`).count()) === 0) continue;
      await page.getByRole("button", { name: "front", exact: true }).click();
      await field(`cycle.${key}`).focus();
      await settles(async () => (await view()) === "top");
    }
  }
});
