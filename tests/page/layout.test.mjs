// Nothing extends beyond the window, nothing covers the focused element, and a warning is visible.
import assert from "node:assert/strict";
import { test } from "node:test";
import {
  boxOf,
  field,
  focusedId,
  framed,
  open,
  openText,
  page,
  panel,
  problems,
  put,
  SIZES,
  settles,
  setUp,
  steady,
  textOf,
} from "./common.mjs";

setUp();

for (const [width, height] of SIZES) {
  test(`the page was wider than its window at 1024 and 900 pixels: ${width}`, async () => {
    await open({ viewport: { width, height } });
    const over = () =>
      page.evaluate(
        () => (document.scrollingElement?.scrollWidth ?? 0) - innerWidth,
      );
    assert.ok((await over()) <= 0);
    for (const tab of await page.getByRole("tab").all()) {
      await tab.click();
      assert.ok((await over()) <= 0, `${await tab.textContent()}`);
      const panel = page.locator(`#${await tab.getAttribute("aria-controls")}`);
      assert.ok(await panel.isVisible());
    }
    // Content that is clipped by its pane does not widen the page: every part must end inside the window.
    const beyond = await page.evaluate(() => {
      const root = /** @type {ShadowRoot} */ (
        document.querySelector("touch-path")?.shadowRoot
      );
      const all = root.querySelectorAll(
        "tp-bar > *, main > section:not([hidden]), main > .tabs, tp-picture, .picture .tools > *, .timeline > *, footer",
      );
      return [...all]
        .filter(
          (node) =>
            !node.closest(".visually-hidden") &&
            node.getBoundingClientRect().right > innerWidth + 0.5,
        )
        .map((node) => node.outerHTML.slice(0, 80));
    });
    assert.deepEqual(beyond, []);
    for (const tool of ["gallery", "lengths", "sheet"]) {
      await page.evaluate(
        (tool) =>
          /** @type {any} */ (
            document.querySelector("touch-path")
          ).app.actions.ask(tool),
        tool,
      );
      assert.ok((await over()) <= 0, tool);
    }
  });
}

test("what always holds for a control is read where there is room, and leads to its page", async () => {
  await open({ viewport: { width: 1440, height: 900 } });
  await field("control.post").selectOption("fanuc");
  const always = page.locator("tp-findings .control-notes");
  assert.equal(await textOf(always), "Not yet run on this control.");
  await always.click();
  await page.locator("tp-manual").waitFor();
});

for (const [width, height, what] of /** @type {[number, number, string][]} */ ([
  [390, 844, "a phone"],
  [390, 480, "a phone with its keyboard up"],
  [844, 390, "a phone on its side"],
  [640, 400, "200 % zoom"],
])) {
  test(`the picture covered the field in focus: ${what}`, async () => {
    await open({ viewport: { width, height } });
    await field("cycle.depth").fill("-1");
    await field("cycle.width1").fill("-1");
    // Of two units the chosen one has the focus.
    const reached =
      "tp-form :is(input:not([type=radio]:not(:checked)), select, button, textarea):visible:not(:disabled)";
    const fields = await page.locator(reached).count();
    const look = () =>
      page.evaluate(() => {
        const root = /** @type {ShadowRoot} */ (
          document.querySelector("touch-path")?.shadowRoot
        );
        const node = root.activeElement;
        if (!node?.closest("tp-form")) return null;
        const box = node.getBoundingClientRect();
        const seen = root.elementFromPoint(
          box.x + box.width / 2,
          box.y + box.height / 2,
        );
        return {
          id: node.id,
          free:
            seen !== null &&
            (node.contains(seen) ||
              (seen.contains(node) && seen.matches("label"))),
          seen: seen?.outerHTML.slice(0, 60),
        };
      });
    const covered = [];
    for (const key of ["Tab", "Shift+Tab"]) {
      let met = 0;
      const all = page.locator(reached);
      await (key === "Tab" ? all.first() : all.last()).focus();
      for (let state = await look(); state; state = await look()) {
        met++;
        if (!state.free) covered.push({ key, ...state });
        await page.keyboard.press(key);
      }
      assert.equal(met, fields, `every field has the focus once by ${key}`);
    }
    assert.deepEqual(covered, []);
  });
}

test("a warning was a closed line in the colour of text: it is counted and read out at the foot of the page", async () => {
  await field("feeds.work").fill("3000");
  const line = page.locator("tp-findings .verdict");
  assert.match(await textOf(line), /1 warning:\s+\S.*feed/i);
  const colours = await line.evaluate((node) => ({
    own: getComputedStyle(node).color,
    text: getComputedStyle(/** @type {Element} */ (node.closest(".frame")))
      .color,
  }));
  assert.notEqual(colours.own, colours.text);
  assert.ok(await line.getByText("1 warning").isVisible());
  await field("cycle.depth").fill("-1");
  assert.match(
    await textOf(line),
    /1 error, 1 warning: Depth must/,
    "the gravest comes first",
  );
});

test("the page could run whatever script got into it: the policy refuses it, and the tests see it", async () => {
  const refused = await page.evaluate(async () => {
    const names = [];
    // The test's own work may block; a task of the page may not.
    await new Promise((done) => setTimeout(done));
    const trials = {
      code: () => Reflect.construct(Function, ["1"]),
      markup: () => {
        document.createElement("p").innerHTML = "<b>x</b>";
      },
      style: () => {
        const sheet = document.createElement("style");
        sheet.textContent = "body { outline: 9px solid red }";
        document.head.append(sheet);
        if (
          sheet.sheet === null ||
          getComputedStyle(document.body).outlineWidth !== "9px"
        )
          throw new Error("refused");
      },
    };
    for (const [name, trial] of Object.entries(trials)) {
      try {
        trial();
      } catch {
        names.push(name);
      }
    }
    try {
      await fetch("https://elsewhere.invalid/");
    } catch {
      names.push("fetch");
    }
    return names;
  });
  assert.deepEqual(refused, ["code", "markup", "style", "fetch"]);
  for (const what of [
    /TrustedScript/,
    /TrustedHTML/,
    /style-src/,
    /connect-src/,
  ]) {
    assert.ok(
      problems.some((text) => what.test(text)),
      `${what}: ${problems.join("; ")}`,
    );
  }
  problems.splice(0);
});

test("the licences of what the page is made of were missing", async () => {
  await page.getByRole("button", { name: "More" }).click();
  const link = page.getByRole("link", { name: "Licences" });
  const response = await page.request.get(
    new URL((await link.getAttribute("href")) ?? "", page.url()).href,
  );
  assert.equal(response.status(), 200);
  const text = await response.text();
  assert.match(
    text,
    /lit-html[\s\S]*BSD[\s\S]*Redistribution and use in source and binary forms/,
  );
  for (const name of ["serde", "wasm-bindgen", "glam"])
    assert.match(text, new RegExp(`^## ${name} - `, "m"));
});

for (const [width, height] of /** @type {const} */ ([
  [390, 844],
  [844, 390],
  [1440, 900],
]))
  test(`the page scrolled away under its form: ${width} by ${height}`, async () => {
    await open({ viewport: { width, height } });
    await page.evaluate(() =>
      /** @type {any} */ (document.querySelector("touch-path"))?.shadowRoot
        .querySelector("tp-form")
        .unfold(),
    );
    await page.evaluate(() =>
      /** @type {any} */ (document.querySelector("touch-path")).store.set(
        "part.rotation",
        5,
      ),
    );
    await page.getByRole("button", { name: "Go to it" }).click();
    await page.mouse.move(width / 2, 20);
    await page.mouse.wheel(0, 400);
    await page.waitForTimeout(100);
    const [scrolled, over] = await page.evaluate(() => [
      scrollY,
      (document.scrollingElement?.scrollHeight ?? 0) - innerHeight,
    ]);
    assert.deepEqual([scrolled, over], [0, 0]);
    const frame = await page.evaluate(
      () =>
        document
          .querySelector("touch-path")
          ?.shadowRoot?.querySelector(".frame")?.scrollTop,
    );
    assert.equal(frame, 0);
  });

for (const locale of ["en-US", "de-DE", "ru-RU"])
  test(`the last tab was cut off where the panels are narrow: ${locale}`, async () => {
    for (const width of [1080, 1024, 720]) {
      await open({ viewport: { width, height: 800 }, locale });
      for (const tab of await page.getByRole("tab").all()) {
        await tab.click();
        const over = await page
          .locator(".tabs")
          .evaluate((tabs) => tabs.scrollWidth - tabs.clientWidth);
        assert.ok(over <= 0, `${width} ${await tab.textContent()} ${over}`);
      }
    }
  });

for (const locale of ["en-US", "de-DE"])
  test(`on a small tablet the speed was cut off, and control and work offset could not be read: ${locale}`, async () => {
    for (const width of [600, 640, 720, 768]) {
      await open({
        viewport: { width, height: 960 },
        hasTouch: true,
        isMobile: true,
        locale,
      });
      const cut = await page.evaluate(() => {
        const root = /** @type {ShadowRoot} */ (
          document.querySelector("touch-path")?.shadowRoot
        );
        const pen = /** @type {CanvasRenderingContext2D} */ (
          document.createElement("canvas").getContext("2d")
        );
        const over = [".timeline", ".tabs", ".picture", "header"].filter(
          (part) => {
            const box = root.querySelector(part);
            return !box || box.scrollWidth > box.clientWidth;
          },
        );
        for (const id of ["f-control.post", "f-control.workOffset"]) {
          const list = /** @type {HTMLSelectElement} */ (
            root.getElementById(id)
          );
          const style = getComputedStyle(list);
          pen.font = style.font;
          const room =
            list.clientWidth -
            Number.parseFloat(style.paddingLeft) -
            Number.parseFloat(style.paddingRight);
          if (pen.measureText(list.selectedOptions[0]?.text ?? "").width > room)
            over.push(id);
        }
        return over;
      });
      assert.deepEqual(cut, [], `${width}`);
      const said = await boxOf(page.locator(".timeline output"));
      assert.ok(said.width > 200, "a move in words");
    }
  });

test("a tap on a dimension left the focus on the picture: it is in the field", async () => {
  await open({ viewport: { width: 1024, height: 768 }, hasTouch: true });
  const spot = await steady(() =>
    page.evaluate(() => {
      const root = /** @type {ShadowRoot} */ (
        document.querySelector("touch-path")?.shadowRoot
      );
      const picture = /** @type {any} */ (root.querySelector("tp-picture"));
      const box = root
        .querySelector("tp-picture canvas")
        ?.getBoundingClientRect();
      for (let y = 4; box && y < box.height; y += 4)
        for (let x = 4; x < box.width; x += 4) {
          const field = picture.drawing.use((/** @type {any} */ view) =>
            view.handleAt(x, y, 14) ? undefined : view.dimensionAt(x, y),
          );
          if (field) return { field, x: box.left + x, y: box.top + y };
        }
      return null;
    }),
  );
  assert.ok(spot);
  await page.touchscreen.tap(spot.x, spot.y);
  await settles(async () => (await focusedId()) === `f-${spot.field}`);
  assert.equal(
    await page.evaluate(
      () => document.querySelector("touch-path")?.shadowRoot?.activeElement?.id,
    ),
    `f-${spot.field}`,
  );
});

test("on a phone on its side the form had no room beside the keyboard", async () => {
  await open({ viewport: { width: 844, height: 200 } });
  await field("cycle.feedDistance").focus();
  const box = await field("cycle.feedDistance").boundingBox();
  const form = await page.locator("tp-form").boundingBox();
  assert.ok(form && form.height > 60, `${form?.height}`);
  assert.ok(
    box &&
      box.y >= form.y - 1 &&
      box.y + box.height <= form.y + form.height + 1,
  );
});

test("what had the focus and is gone leaves it to what is near, not to the start of the page", async () => {
  const at = () =>
    page.evaluate(() => {
      const activeElement =
        document.querySelector("touch-path")?.shadowRoot?.activeElement;
      return (
        activeElement?.getAttribute("aria-label") ??
        activeElement?.textContent?.trim() ??
        null
      );
    });
  const settled = (/** @type {string} */ name) =>
    settles(async () => (await at()) === name);
  const more = page.getByRole("button", { name: "More" });
  for (const item of ["Keys", "My machines"]) {
    await more.focus();
    await page.keyboard.press("Enter");
    await page
      .locator("#menu")
      .getByRole("button", { name: item, exact: true })
      .press("Enter");
    await page.locator("dialog[open]").waitFor();
    await page.keyboard.press("Escape");
    await settled("More");
  }
  const lengths = async () => {
    await more.press("Enter");
    await page
      .locator("#menu")
      .getByRole("button", { name: "Tool lengths" })
      .press("Enter");
    await page.locator("tp-lentoax").waitFor();
  };
  // On first use it is loaded: an element that gets the focus meanwhile keeps it.
  await lengths();
  assert.equal(await at(), "More");
  await page.getByRole("button", { name: "Back to the job" }).press("Enter");
  await settled("More");
  // Then it appears immediately, and the focus is where it was the first time.
  await lengths();
  assert.equal(await at(), "More");
  await page.getByRole("button", { name: "Back to the job" }).press("Enter");
  await settled("More");
  await field("cycle.width1").fill("81");
  await page.getByRole("button", { name: "Undo" }).press("Enter");
  await settles(async () => (await at()) !== null);
  // An element that still exists, but that the user left, does not get the focus back.
  await field("cycle.width1").fill("82");
  const button = page.getByRole("button", { name: "Undo" });
  await button.click();
  await page.mouse.click(2, 2);
  await page.evaluate(() =>
    /** @type {any} */ (
      document.querySelector("touch-path")?.shadowRoot
    )?.activeElement?.blur(),
  );
  await page.waitForTimeout(600);
  assert.equal(await at(), null);
});

test("Redo in the menu of a phone could always be chosen", async () => {
  await open({ viewport: { width: 390, height: 844 } });
  const more = page.getByRole("button", { name: "More" });
  const redo = page.locator("#menu").getByRole("button", { name: "Redo" });
  await more.click();
  assert.ok((await redo.isVisible()) && (await redo.isDisabled()));
  await page.keyboard.press("Escape");
  const before = await field("cycle.width1").inputValue();
  await field("cycle.width1").fill("81");
  await page.getByRole("button", { name: "Undo" }).click();
  assert.equal(await field("cycle.width1").inputValue(), before);
  await more.click();
  await redo.click();
  assert.equal(await field("cycle.width1").inputValue(), "81");
});

test("on a phone Save stands at the foot, on wider pages in the bar, and always once", async () => {
  for (const [width, height, there] of /** @type {const} */ ([
    [390, 844, "footer"],
    [390, 480, "footer"],
    [390, 280, "footer"],
    [599, 800, "footer"],
    [600, 800, "header"],
    [844, 200, "header"],
    [1440, 900, "header"],
  ])) {
    await page.setViewportSize({ width, height });
    const save = page.locator(`${there} .primary`);
    await save.waitFor();
    assert.equal(
      await page.locator(".primary").count(),
      1,
      `${width} x ${height}`,
    );
    const box = await boxOf(save);
    assert.ok(
      box.y >= 0 && box.y + box.height <= height && box.x + box.width <= width,
      JSON.stringify(box),
    );
  }
  await page.setViewportSize({ width: 390, height: 844 });
  const download = page.waitForEvent("download");
  await page.locator("footer .primary").click();
  assert.equal((await download).suggestedFilename(), "POCKET-80X50.ngc");
  await put("cycle.depth", -1);
  assert.ok(await page.locator("footer .primary").isDisabled());
  assert.match(
    (await page.locator("footer .primary").getAttribute("title")) ?? "",
    /^Depth must be/,
  );
});

for (const width of [1280, 390])
  test(`the note of a copied link pushed the page down by a line, and the next keystroke pulled it up: ${width}`, async () => {
    await open({
      viewport: { width, height: 844 },
      permissions: ["clipboard-read", "clipboard-write"],
    });
    const places = () =>
      page.evaluate(() => {
        const root = /** @type {ShadowRoot} */ (
          document.querySelector("touch-path")?.shadowRoot
        );
        return [
          ...root.querySelectorAll("main, main > *, footer, .primary"),
        ].map((part) => JSON.stringify(part.getBoundingClientRect()));
      });
    const before = await places();
    await page.evaluate(() =>
      /** @type {any} */ (document.querySelector("touch-path")).app.actions.ask(
        "share",
      ),
    );
    const note = page.locator("tp-findings .note", { hasText: "Link copied" });
    await note.waitFor();
    assert.deepEqual(await places(), before);
    await field("cycle.width1").fill("81");
    await note.waitFor({ state: "detached" });
    assert.deepEqual(await places(), before);
  });

test("on a phone the help of a field had to be scrolled: every text fits its box", async () => {
  await page.setViewportSize({ width: 390, height: 844 });
  const [seen, cut] = await page.evaluate(async () => {
    const { store, shadowRoot } = /** @type {any} */ (
      document.querySelector("touch-path")
    );
    const help = shadowRoot.querySelector("tp-help");
    const cut = [];
    let seen = 0;
    for (const { type } of store.catalog.cycles) {
      store.choose(type);
      for (const { id } of shadowRoot.querySelectorAll("tp-form [id^='f-']")) {
        store.focus(id.slice(2));
        await help.updateComplete;
        seen++;
        if (help.scrollHeight > help.clientHeight + 1)
          cut.push(`${type} ${id}`);
      }
    }
    return [seen, cut];
  });
  assert.ok(seen > 300, `${seen}`);
  assert.deepEqual(cut, []);
});

for (const width of [768, 844, 900, 1024, 1080, 1280, 1440])
  test(`on tablets “measures only” was cut off, and the timeline was too short to drag: ${width}`, async () => {
    await open({ viewport: { width, height: 844 }, hasTouch: true });
    const free = await field("control.workOffset").evaluate(
      (/** @type {HTMLSelectElement} */ select) => {
        const pen = /** @type {CanvasRenderingContext2D} */ (
          document.createElement("canvas").getContext("2d")
        );
        const { font, paddingLeft, paddingRight } = getComputedStyle(select);
        pen.font = font;
        // The arrow of a choice is in the padding.
        const room =
          select.clientWidth -
          Number.parseFloat(paddingLeft) -
          Number.parseFloat(paddingRight);
        return (
          room - pen.measureText(select.selectedOptions[0]?.text ?? "").width
        );
      },
    );
    assert.ok(free > -1, `${free} pixels are left`);
    const track = await boxOf(page.locator("#timeline"));
    assert.ok(track.width >= 120, `${track.width}`);
  });

for (const locale of ["en-US", "de-DE", "ru-RU", "zh-TW"])
  test(`on a touch screen boxes of the form stood outside of it: ${locale}`, async () => {
    for (const [width, height] of [
      [320, 700],
      [390, 844],
      [1024, 768],
    ]) {
      await open({
        viewport: { width: width ?? 0, height: height ?? 0 },
        hasTouch: true,
        isMobile: true,
        locale,
      });
      for (const type of [
        "internal-rectangle-protected",
        "probing-two-circles",
      ]) {
        await put("cycle.type", type);
        await framed();
        await page.evaluate(() =>
          /** @type {any} */ (document.querySelector("touch-path"))?.shadowRoot
            .querySelector("tp-form")
            .unfold(),
        );
        const beyond = await page.locator("tp-form").evaluate((form) => {
          const right =
            form.getBoundingClientRect().left + form.clientWidth + 1;
          const boxes = [...form.querySelectorAll(".group *")].filter(
            (box) => !box.closest(".visually-hidden"),
          );
          return boxes
            .filter((box) => box.getBoundingClientRect().right > right)
            .map((box) => box.outerHTML.slice(0, 90));
        });
        assert.deepEqual(beyond, [], `${width} ${type}`);
      }
    }
  });

test("a phone that was turned lost the field that had the focus", async () => {
  await open({
    viewport: { width: 844, height: 390 },
    hasTouch: true,
    isMobile: true,
  });
  await field("cycle.width2").focus();
  for (const [width, height] of [
    [390, 844],
    [844, 390],
  ]) {
    await page.setViewportSize({ width: width ?? 0, height: height ?? 0 });
    await settles(async () => (await focusedId()) === "f-cycle.width2");
    await settles(async () => {
      const [box, form] = [
        await boxOf(field("cycle.width2")),
        await boxOf(page.locator("tp-form")),
      ];
      return box.y >= form.y && box.y + box.height <= form.y + form.height + 1;
    });
  }
});

test("on a phone on its side the views covered the picture, and the timeline had no time", async () => {
  for (const [width, height] of [
    [844, 390],
    [390, 844],
    [1024, 768],
    [1440, 900],
  ]) {
    await open({
      viewport: { width: width ?? 0, height: height ?? 0 },
      hasTouch: true,
    });
    const [tools, canvas] = [
      await boxOf(page.locator(".picture .cube")),
      await boxOf(page.locator(".canvas")),
    ];
    // In a corner of the picture.
    assert.ok(
      tools.width <= canvas.width / 3 && tools.y >= canvas.y,
      `${width}`,
    );
    await page.locator("#timeline").press("Control+ArrowRight");
    assert.match(await textOf(page.locator(".clock")), /^0:0\d \/ 0:32$/);
    const [rail, scrub] = [
      await boxOf(page.locator(".track")),
      await boxOf(page.locator(".timeline")),
    ];
    assert.ok(rail.width >= 64, `${width}: ${rail.width}`);
    assert.ok(rail.height >= 12, "the marks of touches are not cut");
    if (width === 1440)
      assert.ok(rail.width > 0.5 * scrub.width, "the rail has what is left");
    const said = page.locator(".timeline output");
    const cut = await said.evaluate(
      (words) => words.scrollWidth - words.clientWidth,
    );
    assert.ok(cut <= 0, `${width}: the move in words is cut by ${cut}`);
  }
});

test("from the gallery the focus went to another button than it had come from", async () => {
  const gallery = page.getByRole("button", { name: "Gallery" });
  await gallery.focus();
  await page.keyboard.press("Enter");
  await page.locator("tp-gallery").waitFor();
  await page.keyboard.press("Escape");
  await page.keyboard.press("Escape");
  await settles(() => gallery.evaluate((button) => button.matches(":focus")));
});

test("a result that cannot deviate stood as a column over what follows the table: each result is a row", async () => {
  await open({ viewport: { width: 768, height: 1024 } });
  await openText(
    JSON.stringify({ format: 1, cycle: { type: "hole" } }),
    "job.json",
  );
  await panel("results");
  const rows = page.locator("tp-results tbody tr[role=row]");
  await settles(async () => (await rows.count()) === 4);
  const tops = await rows.evaluateAll((rows) =>
    rows.map(
      (row) =>
        new Set(
          [...row.children].map((cell) =>
            Math.round(cell.getBoundingClientRect().top),
          ),
        ).size,
    ),
  );
  assert.deepEqual(tops, [1, 1, 1, 1]);
});
