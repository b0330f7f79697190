// Dragging in the picture: the part and the ends of dimensions stay under the pointer.
import assert from "node:assert/strict";
import { test } from "node:test";
import {
  dimensionLines,
  field,
  held,
  onView,
  PICTURE,
  page,
  setUp,
} from "./common.mjs";

setUp();

/** The picture's View and the middle of a handle in the window, with the pixels of one unit. */
const handle = (/** @type {string} */ name) =>
  onView((view, box, name) => {
    const [x, y] = view.handleSpot(name);
    const reach =
      view.dragPart("shift", x + 1000, y).offset[0] -
      view.dragPart("shift", x, y).offset[0];
    return {
      x: box.x + x,
      y: box.y + y,
      scale: 1000 / reach,
      height: box.height,
    };
  }, name);

/** Drags from a position by this many pixels. */
async function drag(
  /** @type {{x: number, y: number}} */ from,
  /** @type {number} */ dx,
  /** @type {number} */ dy,
  /** @type {number} */ steps,
) {
  await page.mouse.move(from.x, from.y);
  await page.mouse.down();
  await page.mouse.move(from.x + dx, from.y + dy, { steps });
}

const near = (
  /** @type {number} */ value,
  /** @type {number} */ wanted,
  /** @type {string} */ what,
) =>
  assert.ok(
    Math.abs(value - wanted) < 0.004,
    `${what}: ${value}, wanted ${wanted}`,
  );

for (const steps of [1, 10]) {
  test(`a dragged part ran away from the pointer: ${steps} steps`, async () => {
    const { x, y, scale } = await handle("shift");
    // Gripped beside its middle, it stays gripped there.
    await drag({ x: x + 4, y: y - 3 }, 20, -12, steps);
    const offset = /** @type {number[]} */ (await held("part.offset"));
    near(offset[0] ?? 0, 20 / scale, "X");
    near(offset[1] ?? 0, 12 / scale, "Y");
    await page.mouse.up();
    assert.deepEqual(
      await held("part.offset"),
      offset,
      "letting go moves nothing",
    );
  });
}

test("a dragged part ran away where errors came up under an open list: the canvas keeps its height", async () => {
  await field("feeds.work").fill("1500");
  const { x, y, scale, height } = await handle("shift");
  // So far that touches no longer reach their walls.
  await drag({ x, y }, 90, -70, 12);
  await page.locator("tp-badge .badge", { hasText: /^[2-9]/ }).waitFor();
  assert.equal((await handle("shift")).height, height);
  const offset = /** @type {number[]} */ (await held("part.offset"));
  near(offset[0] ?? 0, 90 / scale, "X");
  near(offset[1] ?? 0, 70 / scale, "Y");
  await page.mouse.up();
});

test("a handle jumped to the pointer when it was gripped beside its middle: no turn without a way", async () => {
  const { x, y } = await handle("turn");
  await drag({ x: x + 5, y: y + 6 }, 0, 0, 1);
  await page.mouse.move(x + 5, y + 6);
  await page.mouse.up();
  assert.ok(
    Math.abs(Number(await held("part.rotation"))) < 0.05,
    `${await held("part.rotation")}`,
  );
});

for (const [type, path, end] of /** @type {[string, string, 0 | 1][]} */ ([
  ["internal-rectangle-protected", "cycle.width1", 1],
  ["internal-rectangle-protected", "cycle.width2", 0],
  ["hole", "cycle.diameter", 1],
  ["web", "cycle.width", 0],
]))
  test(`the end of a dimension stays under the pointer that drags it: ${path} of ${type}`, async () => {
    await page.evaluate(
      (type) =>
        /** @type {any} */ (document.querySelector("touch-path")).store.choose(
          type,
        ),
      type,
    );
    const [a, b] = (await dimensionLines())[path];
    const [from, other] = end === 1 ? [b, a] : [a, b];
    const before = Number(await field(path).inputValue());
    // Outwards along the line, and slightly beside it.
    const length = Math.hypot(from.x - other.x, from.y - other.y);
    const way = {
      x: ((from.x - other.x) / length) * 30,
      y: ((from.y - other.y) / length) * 30,
    };
    await drag({ x: from.x + 2, y: from.y - 1 }, way.x, way.y, 6);
    const after = Number(await field(path).inputValue());
    assert.ok(after > before, `${after} > ${before}`);
    const now = (await dimensionLines())[path][end];
    // A value is as exact as a pixel; perpendicular to its direction a line makes room for a growing value.
    const off =
      ((now.x - from.x - way.x) * way.x + (now.y - from.y - way.y) * way.y) /
      30;
    assert.ok(Math.abs(off) < 1.6, JSON.stringify({ from, way, now }));
    await page.mouse.up();
    // One undo step, and the picture may be fitted again.
    await page.keyboard.press("Control+z");
    assert.equal(Number(await field(path).inputValue()), before);
  });

test("a dimension that is there for its field only stays while it is dragged; an end that does not move cannot be gripped", async () => {
  await page.evaluate(() =>
    /** @type {any} */ (document.querySelector("touch-path")).store.choose(
      "hole",
    ),
  );
  const path = "cycle.feedDistance";
  assert.equal((await dimensionLines())[path], undefined);
  await field(path).focus();
  await page.waitForFunction(
    () =>
      document
        .querySelector("touch-path")
        ?.shadowRoot?.querySelector("tp-picture [aria-pressed=true]")
        ?.textContent === "front",
  );
  const [start, end] = (await dimensionLines())[path];
  assert.ok(end.y < start.y, "up");
  const cursor = () =>
    page
      .locator(`tp-picture ${PICTURE}`)
      .evaluate((canvas) => canvas.style.cursor);
  await page.mouse.move(start.x, start.y + 2);
  assert.notEqual(await cursor(), "grab");
  await page.mouse.move(end.x, end.y - 2);
  assert.equal(await cursor(), "grab");
  await drag({ x: end.x, y: end.y - 2 }, 0, -30, 6);
  assert.ok((await dimensionLines())[path], "it is seen while it is dragged");
  assert.ok(Math.abs((await dimensionLines())[path][1].y - (end.y - 30)) < 1.6);
  await page.mouse.up();
  assert.ok(Number(await field(path).inputValue()) > 20);
  assert.equal(
    (await dimensionLines())[path],
    undefined,
    "the field has the focus no longer",
  );
});

test("a dimension that only looks is not dragged, and a click on its end changes nothing", async () => {
  const [, end] = (await dimensionLines())["cycle.width1"];
  await page.mouse.click(end.x, end.y);
  assert.equal(await field("cycle.width1").inputValue(), "80");
  await page.evaluate(() =>
    document.querySelector("touch-path")?.toggleAttribute("readonly", true),
  );
  await drag(end, 30, 0, 3);
  await page.mouse.up();
  assert.equal(await field("cycle.width1").inputValue(), "80");
});

test("a slow drag of a dimension's end is a drag, and one into an error can be dragged back", async () => {
  const [, end] = (await dimensionLines())["cycle.width1"];
  await page.mouse.move(end.x, end.y);
  await page.mouse.down();
  for (let i = 1; i <= 30; i++) await page.mouse.move(end.x + i, end.y);
  await page.mouse.up();
  const wide = Number(await field("cycle.width1").inputValue());
  assert.ok(wide > 82, `${wide}`);
  await page.keyboard.press("Control+z");
  // Narrower than twice the clearance there is no job: the value still follows, and returns.
  const [, again] = (await dimensionLines())["cycle.width1"];
  await drag(again, -280, 0, 10);
  assert.ok((await page.locator("tp-findings .verdict.error").count()) > 0);
  await page.mouse.move(again.x, again.y, { steps: 5 });
  await page.mouse.up();
  assert.ok(
    Math.abs(Number(await field("cycle.width1").inputValue()) - 80) < 0.5,
  );
  assert.equal(await page.locator("tp-findings .verdict.error").count(), 0);
});

test("a drag makes one plan a frame, however many moves the browser sends, and ends where the last one was", async () => {
  const { x, y, scale } = await handle("shift");
  await page.mouse.move(x, y);
  await page.mouse.down();
  const plans = await page.evaluate(
    async ([x, y]) => {
      const { store, shadowRoot } = /** @type {any} */ (
        document.querySelector("touch-path")
      );
      const canvas = shadowRoot.querySelector("tp-picture canvas");
      let plans = 0;
      store.addEventListener("change", () => plans++);
      const frame = () => new Promise((done) => requestAnimationFrame(done));
      await frame();
      for (let i = 1; i <= 8; i++) {
        const at = { clientX: Number(x) + 3 * i, clientY: Number(y) - 2 * i };
        canvas.dispatchEvent(
          new PointerEvent("pointermove", {
            ...at,
            pointerId: 1,
            pointerType: "mouse",
          }),
        );
      }
      const first = plans;
      await frame();
      await frame();
      return [first, plans];
    },
    [x, y],
  );
  assert.deepEqual(plans, [1, 2]);
  const offset = /** @type {number[]} */ (await held("part.offset"));
  near(offset[0] ?? 0, 24 / scale, "X");
  near(offset[1] ?? 0, 16 / scale, "Y");
  await page.mouse.up();
});

test("what the browser sends last before the button is let go counts, in the same frame too", async () => {
  const { x, y, scale } = await handle("shift");
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.evaluate(
    ([x, y]) => {
      const canvas = document
        .querySelector("touch-path")
        ?.shadowRoot?.querySelector("tp-picture canvas");
      const send = (/** @type {string} */ type, /** @type {number} */ by) =>
        canvas?.dispatchEvent(
          new PointerEvent(type, {
            clientX: Number(x) + by,
            clientY: Number(y),
            pointerId: 1,
            pointerType: "mouse",
            bubbles: true,
          }),
        );
      send("pointermove", 6);
      send("pointermove", 18);
      send("pointerup", 18);
    },
    [x, y],
  );
  near(
    /** @type {number[]} */ (await held("part.offset"))[0] ?? 0,
    18 / scale,
    "X",
  );
  await page.mouse.up();
});
