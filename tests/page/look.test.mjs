// The look of the page at its widths and in its colours: small grey screenshots, compared with reviewed ones. Fonts differ between machines, so a few cells may
// differ; a panel that is missing, moved or of the wrong colour changes many. `UPDATE=1` writes them.
import assert from "node:assert/strict";
import { existsSync, mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { test } from "node:test";
import { at } from "../../scripts/lib.mjs";
import { context, open, PICTURE, page, SIZES, setUp } from "./common.mjs";

setUp();

const FOLDER = at("tests", "snapshots", "page");
/** A cell is about as large as a line of text. */
const CELL = 20;
/** Mean difference of a cell allowed, of 255, and percentage of cells that may differ by more than `FAR`. */
const [MEAN, FAR, FEW] = [3.5, 40, 5];

/** The page when it no longer changes: two screenshots are equal. */
async function still() {
  await page.evaluate(
    () => /** @type {any} */ (document.querySelector("touch-path")).ready,
  );
  let [before, now] = [await page.screenshot(), await page.screenshot()];
  while (!now.equals(before)) [before, now] = [now, await page.screenshot()];
  return now;
}

/** The picture as rows of grey cells, two hexadecimal digits each. */
async function cells(/** @type {Buffer} */ png) {
  const blank = await context.newPage();
  const rows = await blank.evaluate(
    async ([data, cell]) => {
      const bytes = Uint8Array.from(atob(/** @type {string} */ (data)), (c) =>
        c.charCodeAt(0),
      );
      const image = await createImageBitmap(
        new Blob([bytes], { type: "image/png" }),
      );
      const pixels = new OffscreenCanvas(image.width, image.height).getContext(
        "2d",
      );
      if (!pixels) throw new Error("no canvas");
      pixels.drawImage(image, 0, 0);
      const { data: rgba } = pixels.getImageData(
        0,
        0,
        image.width,
        image.height,
      );
      const size = Number(cell);
      return Array.from({ length: Math.floor(image.height / size) }, (_, row) =>
        Array.from({ length: Math.floor(image.width / size) }, (_, column) => {
          let sum = 0;
          for (let y = row * size; y < (row + 1) * size; y++)
            for (let x = column * size; x < (column + 1) * size; x++) {
              const i = 4 * (y * image.width + x);
              sum +=
                0.3 * (rgba[i] ?? 0) +
                0.59 * (rgba[i + 1] ?? 0) +
                0.11 * (rgba[i + 2] ?? 0);
            }
          return Math.round(sum / size ** 2)
            .toString(16)
            .padStart(2, "0");
        }).join(""),
      );
    },
    [png.toString("base64"), String(CELL)],
  );
  await blank.close();
  return rows;
}

const greys = (/** @type {string[]} */ rows) =>
  rows.flatMap((row) =>
    (row.match(/../g) ?? []).map((x) => Number.parseInt(x, 16)),
  );

/** Difference of two pictures: mean, and percentage of cells that differ much. */
function difference(
  /** @type {string[]} */ one,
  /** @type {string[]} */ other,
) {
  const [a, b] = [greys(one), greys(other)];
  const off = a.map((x, i) => Math.abs(x - (b[i] ?? 0)));
  return {
    mean: off.reduce((sum, x) => sum + x, 0) / off.length,
    far: (100 * off.filter((x) => x > FAR).length) / off.length,
    same: a.length === b.length,
  };
}

const fits = (
  /** @type {ReturnType<typeof difference>} */ { mean, far, same },
) => same && mean <= MEAN && far <= FEW;

for (const colorScheme of /** @type {const} */ (["light", "dark"]))
  for (const [width, height] of SIZES)
    test(`the page looks as it was seen to: ${width} pixels, ${colorScheme}`, async () => {
      await open({ viewport: { width, height }, colorScheme });
      // The folded form, as a user finds it.
      await page.reload();
      await page.locator(`tp-picture ${PICTURE}`).waitFor();
      const seen = await cells(await still());
      const file = `${FOLDER}/${width}-${colorScheme}.txt`;
      if (process.env.UPDATE) {
        mkdirSync(FOLDER, { recursive: true });
        writeFileSync(file, `${seen.join("\n")}\n`);
      }
      assert.ok(existsSync(file), `${file} is missing: UPDATE=1 writes it`);
      const known = readFileSync(file, "utf8").trimEnd().split("\n");
      const off = difference(seen, known);
      assert.ok(
        fits(off),
        `the page looks otherwise than in ${file}: ${JSON.stringify(off)}`,
      );
      // Faults are found: a missing panel, the other colours.
      await page.evaluate(() =>
        document
          .querySelector("touch-path")
          ?.setAttribute("panels", "form program"),
      );
      const without = difference(await cells(await still()), known);
      assert.ok(
        !fits(without),
        `a missing picture is seen: ${JSON.stringify(without)}`,
      );
    });
