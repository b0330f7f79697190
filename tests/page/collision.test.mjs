// A run that ends in the part is drawn up to its end.
import assert from "node:assert/strict";
import { test } from "node:test";
import {
  field,
  page,
  panel,
  pixels,
  program,
  put,
  saveButton,
  setUp,
  steady,
  textOf,
} from "./common.mjs";

setUp({ width: 1440, height: 900 });

test("a trial of the virtual part that collides is drawn where it happens, and took the program away", async () => {
  const [good, nominal] = [await pixels(), await program()];
  await field("part.offset[0]").fill("60");
  const stamp = page.locator(".verdict.warning");
  await stamp.waitFor();
  assert.match(
    await textOf(stamp),
    /Move \d+ \(step \d+, .*\) hits the part with the ball centre at X/,
  );
  assert.ok(await saveButton().isEnabled());
  assert.equal(await program(), nominal);
  assert.match(
    await textOf(page.locator(".timeline output")),
    /The run ends in the part/,
  );
  await panel("results", page);
  assert.equal(
    await textOf(
      page.locator("tp-results tbody tr").first().locator("td").nth(2),
    ),
    "–",
    "nothing is stored",
  );
  await page.getByRole("tab", { name: "Program" }).click();
  assert.notEqual((await pixels()).sum, good.sum);
  // The crossed ball is at the position of the message.
  const place = /X (-?[\d.]+), Y (-?[\d.]+)/.exec(await textOf(stamp));
  assert.ok(place);
  const red = await steady(() =>
    page.evaluate(
      ([x, y]) => {
        const root = /** @type {ShadowRoot} */ (
          document.querySelector("touch-path")?.shadowRoot
        );
        const canvas = /** @type {HTMLCanvasElement} */ (
          root.querySelector("tp-picture canvas")
        );
        const picture = /** @type {any} */ (root.querySelector("tp-picture"));
        // The part's origin lies 60 mm beside the work origin: two handles give the picture's scale.
        const at = picture.drawing.use((/** @type {any} */ view) => {
          const [hx, hy] = view.handleSpot("shift");
          const reach =
            view.dragPart("shift", hx + 100, hy).offset[0] -
            view.dragPart("shift", hx, hy).offset[0];
          return [hx + ((x - 60) * 100) / reach, hy - (y * 100) / reach];
        });
        const drawn = /** @type {CanvasRenderingContext2D} */ (
          canvas.getContext("2d")
        );
        const ratio = canvas.width / canvas.clientWidth;
        const [r = 0, g = 0, b = 0] = drawn.getImageData(
          Math.round(at[0] * ratio),
          Math.round(at[1] * ratio),
          1,
          1,
        ).data;
        return [r, g, b];
      },
      /** @type {[number, number]} */ ([Number(place[1]), Number(place[2])]),
    ),
  );
  assert.ok((red[0] ?? 0) > 150 && (red[1] ?? 255) < 100, `${red}`);
  await page
    .locator("tp-findings")
    .getByRole("button", { name: "Back to nominal" })
    .click();
  assert.equal(await field("part.offset[0]").inputValue(), "0");
  await page.locator(".part-note").waitFor({ state: "detached" });
  assert.equal(await page.locator(".part-note").count(), 0);
});

test("a form that has no path keeps the picture of the last valid plan, also after one that had a collision", async () => {
  // The handles of the part are shown while its fields have the focus.
  await field("part.offset[0]").focus();
  const good = await pixels();
  await field("part.offset[0]").fill("60");
  await page.locator(".verdict", { hasText: "hits the part" }).waitFor();
  await field("part.offset[0]").fill("x");
  await page.locator(".banner", { hasText: "last valid plan" }).waitFor();
  assert.match(await program(), /G38\.2 X42/);
  await put("part.offset[0]", 0);
  assert.equal(await page.locator(".banner").count(), 0);
  assert.deepEqual((await pixels()).count, good.count);
});
