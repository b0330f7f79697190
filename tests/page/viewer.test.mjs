// Programs that no job can be made of: their moves are drawn, and the job in the form stays.
import assert from "node:assert/strict";
import { test } from "node:test";
import { framed, more, openText, PICTURE, page, program, setUp, textOf } from "./common.mjs";

setUp();

const FOREIGN = `(found on a machine)
G21 G17 G90
G0 X0 Y0 Z20
G0 Z5
G38.2 Z-5 F100
G1 Z5 F500
G2 X20 Y0 I10 J0 F800
#5=3
G0 Z20
M2
`;

/** How many pixels of the viewer's canvas have each of the page's colours, by name. */
const painted = async () => {
  await framed();
  return page.evaluate(() => {
    const app = document.querySelector("touch-path");
    const canvas = /** @type {HTMLCanvasElement} */ (app?.shadowRoot?.querySelector("tp-viewer canvas"));
    const pixels = canvas.getContext("2d")?.getImageData(0, 0, canvas.width, canvas.height).data ?? [];
    const seen = new Set();
    for (let i = 0; i < pixels.length; i += 4) seen.add(`${pixels[i]},${pixels[i + 1]},${pixels[i + 2]}`);
    const style = getComputedStyle(canvas);
    const rgb = (/** @type {string} */ name) => {
      const probe = document.createElement("i");
      probe.style.color = style.getPropertyValue(`--c-${name}`);
      canvas.parentElement?.append(probe);
      const [r, g, b] = getComputedStyle(probe).color.match(/\d+/g) ?? [];
      probe.remove();
      return seen.has(`${r},${g},${b}`);
    };
    return { touch: rgb("touch"), link: rgb("link"), position: rgb("position") };
  });
};

test("a program of another hand was refused: its moves are drawn, probing told apart, and the job stays", async () => {
  const before = await program();
  await openText(FOREIGN, "foreign.ngc");
  const viewer = page.locator("tp-viewer");
  await viewer.waitFor();
  assert.match(await textOf(viewer.locator("p[role=status]")), /6 moves, 1 of them probing; mm; read as ISO/);
  assert.match(await textOf(viewer.locator(".notes")), /not followed: once, in line 8/);
  assert.match(await textOf(page.locator(".note")), /Its moves are drawn/);
  await viewer.getByRole("button", { name: "front" }).click();
  assert.deepEqual(await painted(), { touch: true, link: true, position: true });
  // What is pointed at says its line.
  const box = await viewer.locator(PICTURE).boundingBox();
  assert.ok(box);
  let told = "";
  // From the left, until the first upright line.
  for (let x = 10; x < box.width && !told.startsWith("Line"); x += 8) {
    await page.mouse.move(box.x + x, box.y + box.height / 2);
    told = await textOf(viewer.locator("p[role=status]"));
  }
  assert.match(told, /^Line (3|4|5|6|7|9): (rapid|feed|probe) to X/);
  await page.getByRole("button", { name: "Cycles", exact: true }).click();
  assert.equal(await program(), before, "the job is as it was");
  await more("Moves of the opened program");
  await viewer.waitFor();
});

test("a shorter program after a longer one left the picture of the first: what was pointed at is forgotten", async () => {
  const long = `G21 G90\nG0 X0 Y0 Z0\n${Array.from({ length: 40 }, (_, i) => `G1 X${i} Y${i % 2 ? 20 : 0} F100`).join("\n")}\nM2\n`;
  await openText(long, "long.ngc");
  const viewer = page.locator("tp-viewer");
  await viewer.waitFor();
  const box = await viewer.locator(PICTURE).boundingBox();
  assert.ok(box);
  const told = () => textOf(viewer.locator("p[role=status]"));
  for (let x = box.width - 10; x > 0 && !(await told()).startsWith("Line"); x -= 8) {
    await page.mouse.move(box.x + x, box.y + box.height / 2);
  }
  assert.match(await told(), /^Line \d\d:/, "a move that the next program has not");
  await openText("G21 G90\nG0 X0 Y0 Z0\nG38.2 X5 F50\nM2\n", "short.ngc");
  await page.waitForFunction(() => {
    const app = document.querySelector("touch-path");
    return app?.shadowRoot
      ?.querySelector("tp-viewer p[role=status]")
      ?.textContent?.startsWith("2 moves, 1 of them probing");
  });
});

test("a file that is dropped on the page was opened by the browser in its place", async () => {
  await page.locator("tp-form").evaluate((target, text) => {
    const dataTransfer = new DataTransfer();
    dataTransfer.items.add(new File([text], "FOREIGN.NC"));
    const over = new DragEvent("dragover", { dataTransfer, bubbles: true, composed: true, cancelable: true });
    target.dispatchEvent(over);
    const drop = new DragEvent("drop", { dataTransfer, bubbles: true, composed: true, cancelable: true });
    target.dispatchEvent(drop);
    if (!over.defaultPrevented || !drop.defaultPrevented) throw new Error("the browser would open the file itself");
  }, FOREIGN);
  await page.locator("tp-viewer").waitFor();
});

test("what is no program is not drawn as one", async () => {
  await openText("Dear setter,\nX marks the spot.\n", "letter.txt");
  await page.locator(".note").waitFor();
  assert.equal(await page.locator("tp-viewer").count(), 0);
});
