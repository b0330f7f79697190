// The picture: its contents, redraws, view, and cleanup.
import assert from "node:assert/strict";
import { test } from "node:test";
import { catalog } from "touchpath";
import {
  boxOf,
  context,
  dimensionLines,
  field,
  framed,
  onView,
  open,
  PICTURE,
  page,
  pixels,
  program,
  SIZES,
  settles,
  setUp,
} from "./common.mjs";

setUp();

test("a gesture that the browser took over pinned a move", async () => {
  const lit = () =>
    page.locator("tp-program .line[aria-selected=true]").count();
  const { x, y } = await page
    .locator(`tp-picture ${PICTURE}`)
    .evaluate((canvas) => {
      const box = canvas.getBoundingClientRect();
      return { x: box.x + box.width / 2 + 90, y: box.y + box.height / 2 };
    });
  const session = await page.context().newCDPSession(page);
  await session.send("Input.dispatchTouchEvent", {
    type: "touchStart",
    touchPoints: [{ x, y }],
  });
  await session.send("Input.dispatchTouchEvent", {
    type: "touchCancel",
    touchPoints: [],
  });
  await settles(async () => (await lit()) === 0);
  await session.send("Input.dispatchTouchEvent", {
    type: "touchStart",
    touchPoints: [{ x, y }],
  });
  await session.send("Input.dispatchTouchEvent", {
    type: "touchEnd",
    touchPoints: [],
  });
  await page.locator("tp-program .line[aria-selected=true]").waitFor();
});

test("the canvas changed its height with every message", async () => {
  const high = async () =>
    (await boxOf(page.locator(`tp-picture ${PICTURE}`))).height;
  const height = await high();
  for (const [path, value] of /** @type {const} */ ([
    ["feeds.work", "4000"],
    ["cycle.depth", "-1"],
    ["cycle.width1", "x"],
    ["cycle.sideClearance1", "2"],
  ])) {
    await field(path).fill(value);
    assert.equal(await high(), height, path);
  }
  await page.locator("tp-program .line", { hasText: "G38.2" }).first().hover();
  assert.equal(await high(), height, "a hover");
});

test("every hover planned again: only another job is planned and shown", async () => {
  const count = () =>
    page.evaluate(() => {
      const counts = /** @type {any} */ (window).counts;
      const now = { ...counts };
      counts.show = 0;
      counts.highlight = 0;
      return now;
    });
  await page.evaluate(() => {
    const root = /** @type {ShadowRoot} */ (
      document.querySelector("touch-path")?.shadowRoot
    );
    const counts = { show: 0, highlight: 0 };
    Object.assign(window, { counts });
    const { drawing } = /** @type {any} */ (root.querySelector("tp-picture"));
    for (const name of /** @type {("show" | "highlight")[]} */ ([
      "show",
      "highlight",
    ])) {
      const method = drawing.view[name];
      drawing.view[name] = function (/** @type {unknown[]} */ ...args) {
        counts[name]++;
        return method.apply(this, args);
      };
    }
  });
  const plain = await pixels();
  await page.locator("tp-program .line", { hasText: "G38.2 X42" }).hover();
  const hovered = await count();
  assert.equal(hovered.show, 0);
  assert.ok(hovered.highlight > 0, "the move lights up");
  assert.notEqual((await pixels()).sum, plain.sum);
  await field("cycle.width1").fill("90");
  assert.equal((await count()).show, 1, "a keystroke is shown once");
});

test("each opening of Tool lengths kept 512 nodes and a View", async () => {
  const session = await context.newCDPSession(page);
  await session.send("Performance.enable");
  const ask = (/** @type {string} */ tool) =>
    page.evaluate((tool) => {
      const { app } = /** @type {any} */ (document.querySelector("touch-path"));
      return app.actions.ask(tool).then(() => app.updateComplete);
    }, tool);
  const cycles = page.getByRole("button", { name: "Back to the job" });
  const measure = async () => {
    await session.send("HeapProfiler.collectGarbage");
    const { metrics } = await session.send("Performance.getMetrics");
    const value = (/** @type {string} */ name) =>
      metrics.find((m) => m.name === name)?.value ?? Number.NaN;
    return { nodes: value("Nodes"), listeners: value("JSEventListeners") };
  };
  const open = async (/** @type {number} */ times) => {
    for (let i = 0; i < times; i++) {
      await ask("lengths");
      if (i % 10 === 0) await ask("gallery");
      await cycles.click();
    }
  };
  await open(11);
  const before = await measure();
  await open(40);
  const after = await measure();
  const grown = {
    nodes: after.nodes - before.nodes,
    listeners: after.listeners - before.listeners,
  };
  assert.ok(grown.nodes < 1000 && grown.listeners < 20, JSON.stringify(grown));
});

test("a View of a broken instance stopped the page: the picture makes itself a new one", async () => {
  // A canvas whose 2D context throws: the exception passes through the module and breaks its instance.
  const before = await pixels();
  await page.evaluate(() => {
    const root = /** @type {ShadowRoot} */ (
      document.querySelector("touch-path")?.shadowRoot
    );
    const canvas = /** @type {HTMLCanvasElement} */ (
      root.querySelector("canvas")
    );
    const drawn = /** @type {any} */ (canvas.getContext("2d"));
    drawn.fillRect = () => {
      delete drawn.fillRect;
      throw new RangeError("Maximum call stack size exceeded");
    };
  });
  await page.getByRole("button", { name: "front", exact: true }).click();
  await page.getByRole("button", { name: "top", exact: true }).click();
  assert.deepEqual(await pixels(), before, "the same picture by a new View");
  await field("cycle.width1").fill("90");
  assert.match(await program(), /G38\.2 X47 Y0 Z-10 F150/);
  assert.notEqual((await pixels()).sum, before.sum);
});

test("a click on an axis looks along it, one beside them isometrically, and by the keyboard the buttons do the same", async () => {
  const pressed = () =>
    page
      .getByRole("toolbar", { name: "Picture" })
      .locator("[aria-pressed=true]")
      .textContent();
  const box = await boxOf(page.locator(`tp-picture ${PICTURE}`));
  const corner = { x: box.x + 34, y: box.y + box.height - 34 };
  assert.equal(await pressed(), "top");
  await page.mouse.click(corner.x + 28, corner.y);
  assert.equal(await pressed(), "side", "along X one sees Y and Z");
  await page.mouse.click(corner.x, corner.y - 28);
  assert.equal(await pressed(), "top", "along Z");
  await page.mouse.click(corner.x, corner.y - 28);
  assert.equal(await pressed(), "front", "along Y");
  await page.mouse.click(corner.x + 18, corner.y - 18);
  assert.equal(await pressed(), "isometric");
  await page.mouse.move(corner.x + 20, corner.y - 18);
  assert.equal(
    await page
      .locator(`tp-picture ${PICTURE}`)
      .evaluate((canvas) => canvas.style.cursor),
    "pointer",
  );
});

test("deviations are drawn ten and a hundred times as large, and not dragged then", async () => {
  await field("part.offset[0]").fill("0.02");
  const button = page.getByRole("button", { name: /Deviations are drawn/ });
  assert.equal(await button.textContent(), "×1");
  const one = (await pixels()).sum;
  await button.click();
  assert.equal(await button.textContent(), "drawn ×10");
  const ten = (await pixels()).sum;
  await button.click();
  assert.equal(await button.textContent(), "drawn ×100");
  assert.equal(new Set([one, ten, (await pixels()).sum]).size, 3);
  const handle = () => onView((view) => view.handleSpot("shift") ?? null);
  assert.equal(await handle(), null);
  await field("part.offset[0]").fill("0");
  assert.equal(await button.count(), 0);
  assert.notEqual(await handle(), null, "a nominal part can be dragged again");
});

test("what is pointed at is drawn over the picture, and the picture beneath stays", async () => {
  await open({});
  const drawn = async () => {
    await framed();
    return page.locator("tp-picture canvas").evaluateAll((all) =>
      all.map((node) => {
        const canvas = /** @type {HTMLCanvasElement} */ (node);
        const context = /** @type {CanvasRenderingContext2D} */ (
          canvas.getContext("2d")
        );
        const data = new Uint32Array(
          context.getImageData(0, 0, canvas.width, canvas.height).data.buffer,
        );
        return {
          sum: data.reduce(
            (sum, pixel, i) => (sum * 31 + i + pixel) % 1_000_000_007,
            0,
          ),
          any: data.some((x) => x !== 0),
        };
      }),
    );
  };
  const [picture, over] = /** @type {[any, any]} */ (await drawn());
  assert.ok(picture.any && !over.any, "nothing is lit");
  await page.locator("#timeline").focus();
  await page.keyboard.press("Control+ArrowRight");
  const [same, lit] = /** @type {[any, any]} */ (await drawn());
  assert.equal(same.sum, picture.sum);
  assert.ok(lit.any);
  await page.keyboard.press("Control+ArrowRight");
  const [still, next] = /** @type {[any, any]} */ (await drawn());
  assert.equal(still.sum, picture.sum);
  assert.notEqual(next.sum, lit.sum);
  await page.keyboard.press("Escape");
  assert.equal((await drawn())[1]?.any, false, "and nothing again");
});

test("each change is planned once, and the picture is drawn once a frame", async () => {
  await page.addInitScript(() => {
    const own = /** @type {any} */ (globalThis);
    own.drawn = 0;
    const { fillRect } = CanvasRenderingContext2D.prototype;
    CanvasRenderingContext2D.prototype.fillRect = function (
      x,
      y,
      width,
      height,
    ) {
      // A picture starts with its background.
      if (x === 0 && y === 0 && width === this.canvas.clientWidth) own.drawn++;
      fillRect.call(this, x, y, width, height);
    };
  });
  await page.reload();
  await page.locator(`tp-picture ${PICTURE}`).waitFor({ state: "attached" });
  const count = async (/** @type {() => unknown} */ act) => {
    await framed();
    const read = () =>
      page.evaluate(() => {
        const root = /** @type {ShadowRoot} */ (
          document.querySelector("touch-path")?.shadowRoot
        );
        return [
          /** @type {any} */ (globalThis).drawn,
          /** @type {any} */ (root.querySelector("tp-app")).store.revision,
        ];
      });
    const [drawn, plans] = await read();
    await act();
    await framed();
    await framed();
    const [later, more] = await read();
    return [later - drawn, more - plans];
  };
  const typed = (/** @type {number[]} */ values) =>
    page.evaluate((values) => {
      const root = document.querySelector("touch-path")?.shadowRoot;
      const input = /** @type {HTMLInputElement} */ (
        root?.getElementById("f-cycle.width1")
      );
      for (const value of values) {
        input.value = String(value);
        input.dispatchEvent(
          new Event("input", { bubbles: true, composed: true }),
        );
      }
    }, values);
  assert.deepEqual(
    await count(() => {}),
    [0, 0],
    "a page at rest draws nothing",
  );
  await field("cycle.width1").focus();
  assert.deepEqual(await count(() => typed([64])), [1, 1], "a keystroke");
  assert.deepEqual(
    await count(() => typed([65, 66, 67])),
    [1, 3],
    "three in a frame",
  );
  assert.deepEqual(
    await count(() => page.keyboard.press("Control+z")),
    [1, 1],
    "a step back",
  );
  const given = await count(() =>
    page.evaluate(async () => {
      const element = /** @type {any} */ (document.querySelector("touch-path"));
      for (const width1 of [70, 71, 72]) {
        element.job = {
          ...element.job,
          cycle: { ...element.job.cycle, width1 },
        };
        await null;
      }
    }),
  );
  assert.deepEqual(
    given,
    [1, 3],
    "three jobs of a host in a frame, each rendered",
  );
  // The small drawing of the cycle in the bar gets its colours and its size immediately, one by one.
  assert.deepEqual(
    await count(() => page.emulateMedia({ colorScheme: "dark" })),
    [1 + 2, 0],
    "other colours",
  );
});

test("on a phone the axis X lay on the name of 1411's first diameter: no name stands on the axes", async () => {
  for (const [width, height] of SIZES) {
    await page.setViewportSize({ width, height });
    for (const { type } of catalog().cycles) {
      await page.evaluate(
        (type) =>
          Object.assign(document.querySelector("touch-path") ?? {}, {
            cycle: type,
          }),
        type,
      );
      await framed();
      const found = await page.evaluate(() => {
        const picture = /** @type {any} */ (
          document
            .querySelector("touch-path")
            ?.shadowRoot?.querySelector("tp-picture")
        );
        const { clientHeight } = picture.querySelector("canvas");
        const { view } = picture.drawing;
        const axes = [
          [62, clientHeight - 34],
          [34, clientHeight - 62],
        ];
        return axes.map(([x, y]) => view.dimensionAt(x, y) ?? null);
      });
      assert.deepEqual(found, [null, null], `${type} at ${width}`);
    }
  }
});

test("in front of 1411 the names of its diameters lay on each other on a phone: each stands alone, in every view", async () => {
  let seen = 0;
  // The widest picture, the narrowest beside a form, and the phone's.
  for (const [width, height] of SIZES.filter(([width]) =>
    [1440, 900, 390].includes(width),
  )) {
    await page.setViewportSize({ width, height });
    for (const look of ["top", "front", "side"]) {
      await page
        .locator("tp-picture")
        .getByRole("button", { name: look, exact: true })
        .click();
      for (const { type } of catalog().cycles) {
        await page.evaluate(
          (type) =>
            Object.assign(document.querySelector("touch-path") ?? {}, {
              cycle: type,
            }),
          type,
        );
        await framed();
        const names = await page.evaluate(() => {
          const root = /** @type {ShadowRoot} */ (
            document.querySelector("touch-path")?.shadowRoot
          );
          const { view } = /** @type {any} */ (root.querySelector("tp-picture"))
            .drawing;
          return view
            .dimensionLines()
            .map(
              (
                /** @type {[string, number, number, number, number]} */ [
                  own,
                  a,
                  b,
                  c,
                  d,
                ],
              ) => {
                // Half length of a name along its line, pixels.
                const far = Math.hypot(c - a, d - b) || 1;
                const [x, y] = [(40 * (c - a)) / far, (40 * (d - b)) / far];
                const at = (/** @type {number} */ way) =>
                  view.dimensionAt(
                    (a + c) / 2 + way * x,
                    (b + d) / 2 + way * y,
                  ) ?? own;
                return [own, at(-1), at(0), at(1)];
              },
            );
        });
        for (const [own, ...found] of names)
          assert.deepEqual(
            found,
            [own, own, own],
            `${type} at ${width}, ${look}`,
          );
        seen += names.length;
      }
    }
  }
  assert.ok(seen > 150, `${seen} names`);
});

test("the lit touch struck out its own number: the search past the contact is not lit, and the number lies above", async () => {
  await open({ viewport: { width: 1700, height: 900 } });
  await page.locator("#timeline").press("Control+ArrowRight");
  await framed();
  const { width1, width2 } = Object.fromEntries(
    Object.entries(await dimensionLines()).map(([path, ends]) => [
      path.replace("cycle.", ""),
      ends,
    ]),
  );
  // Touch 1 is in the middle of the right wall; its number begins 7 pixels behind that and ends 25 behind it, and the search goes on for 5 mm.
  const [left, right] = width1;
  const y = (width2[0].y + width2[1].y) / 2;
  const beyond = ((right.x - left.x) / 80) * 5;
  assert.ok(beyond > 27, `${beyond}`);
  const box = await boxOf(page.locator("tp-picture canvas.over"));
  const [number, past] = await page.locator("tp-picture canvas.over").evaluate(
    (node, spots) => {
      const canvas = /** @type {HTMLCanvasElement} */ (node);
      const context = /** @type {CanvasRenderingContext2D} */ (
        canvas.getContext("2d")
      );
      const ratio = canvas.width / canvas.clientWidth;
      return spots.map(([x, y]) => [
        ...context.getImageData(Number(x) * ratio, Number(y) * ratio, 1, 1)
          .data,
      ]);
    },
    [9, 26.5].map((off) => [right.x + off - box.x, y - box.y]),
  );
  const [red, green, , solid] = /** @type {number[]} */ (number);
  assert.ok(
    solid === 255 && Number(red) > 200 && Number(green) < 80,
    `${number}`,
  );
  assert.equal(past?.[3], 0, "nothing is lit past the contact");
});
