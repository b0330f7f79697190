// Programs without a job: their moves are drawn, and the job in the form stays.
import assert from "node:assert/strict";
import { test } from "node:test";
import {
  boxOf,
  field,
  framed,
  more,
  openText,
  PICTURE,
  page,
  painted,
  program,
  saveButton,
  settles,
  setUp,
  textOf,
} from "./common.mjs";

setUp();

const FOREIGN = `(found on a machine)
G21 G17 G90
G0 X0 Y0 Z20
G0 Z5
G38.2 Z-5 F100
G1 Z5 F500
G2 X20 Y0 I10 J0 F800
#5=#5063
G0 Z20
M2
`;

test("a program of another hand was refused: its moves are drawn, probing in its own style, and the job stays", async () => {
  const before = await program();
  await openText(FOREIGN, "foreign.ngc");
  const viewer = page.locator("tp-viewer");
  await viewer.waitFor();
  assert.match(
    await textOf(viewer.locator(".timeline output")),
    /6 moves, 1 of them probing; mm; read as LinuxCNC/,
  );
  assert.match(
    await textOf(viewer.locator(".notes")),
    /get an unknown value: once, in line 8/,
  );
  assert.match(
    await textOf(page.locator(".sentence")),
    /^Read foreign\.ngc as LinuxCNC: 6 moves, 1 of them touches$/,
  );
  await viewer.getByRole("button", { name: "front" }).click();
  for (const colour of ["touch", "link", "position"])
    assert.ok((await painted("tp-viewer", colour)).count > 0, colour);
  // The item under the pointer shows its line.
  const box = await viewer.locator(PICTURE).boundingBox();
  assert.ok(box);
  let told = "";
  // From the left, until the first upright line.
  for (let x = 10; x < box.width && !told.startsWith("Line"); x += 8) {
    await page.mouse.move(box.x + x, box.y + box.height / 2);
    told = await textOf(viewer.locator(".timeline output"));
  }
  assert.match(told, /^Line (3|4|5|6|7|9): (rapid|feed|probe) to X/);
  await page.getByRole("button", { name: "Back to the job" }).click();
  assert.equal(await program(), before, "the job is as it was");
  await more("Moves of the opened program");
  await viewer.waitFor();
});

test("a probing move that is looked at along its way was not seen: it is a dot with its number, also over the origin", async () => {
  const across = async (
    /** @type {number} */ moves,
    /** @type {string} */ text,
  ) => {
    await openText(text, "foreign.ngc");
    await page
      .locator("tp-viewer .timeline output", {
        hasText: new RegExp(`^${moves} moves`),
      })
      .waitFor();
    return (await painted("tp-viewer", "touch")).columns;
  };
  const head = "G21 G90\nG0 X0 Y0 Z20\nG0 X40 Y10\nG0 Z5\n";
  // A dot of 3 px and beside it a disc of 9 px radius.
  const dot = (/** @type {number} */ seen) =>
    assert.ok(seen >= 16 && seen <= 28, `${seen} pixels`);
  const probing = "G38.2 Z-5 F100\nG0 Z20\n";
  const far = "G0 X80 Y0\nG0 X-40 Y0\n";
  dot(await across(7, `${head}${probing}${far}M2\n`));
  dot(await across(8, `${head}G0 X0 Y0\n${probing}${far}M2\n`));
  assert.equal(await across(7, `${head}G1 Z-5 F100\nG0 Z20\n${far}M2\n`), 0);
  // Drawn in few strokes, it is the same.
  dot(await across(5205, `${head}${probing}${far.repeat(2600)}M2\n`));
});

/** Nothing of the job can be changed or saved; the menu is open afterwards. Returns the number of saves since then. */
async function held() {
  const buttons = page.getByRole("button", {
    name: /^(Undo|Save \S+\.ngc)$/,
  });
  // An opened program has its own sentence at the top, and no Save beside it.
  const disabled = await buttons.evaluateAll((all) =>
    all.map((b) => /** @type {HTMLButtonElement} */ (b).disabled),
  );
  assert.ok(disabled.length > 0 && disabled.every(Boolean), `${disabled}`);
  const control = field("control.post");
  assert.ok(
    (await control.count()) === 0 || (await control.isDisabled()),
    "no job is changed that is not seen",
  );
  let saved = 0;
  page.on("download", () => saved++);
  await page.keyboard.press("Control+s");
  await page.getByRole("button", { name: "More" }).click();
  const menu = page.locator("#menu");
  for (const name of [
    "Copy a link to this job",
    "Setup sheet to print",
    "Save job",
    "Save the picture (SVG)",
    "My machines",
    "Reset",
  ])
    assert.ok(
      await menu.getByRole("button", { name, exact: true }).isDisabled(),
      name,
    );
  return () => saved;
}

test("an opened program stood under “No problems found”, and Save handed out the job that was not seen", async () => {
  await field("cycle.width1").fill("90");
  const verdict = page.locator(":is(.state, footer):visible").first();
  assert.match(await textOf(verdict), /Ready to save/);
  await openText("G21 G90\nG0 X0 Y0 Z50\nG1 Z-500 F500\nM30\n", "deep.ngc");
  await page.locator("tp-viewer").waitFor();
  assert.doesNotMatch(await textOf(verdict), /Ready|27 moves/);
  assert.match(await textOf(verdict), /Not checked, not proven/);
  const saved = await held();
  // Escape closes the menu, belongs to the host page in its slot, and then leads back to the job.
  await page.keyboard.press("Escape");
  await page.locator("tp-viewer").waitFor();
  await page.evaluate(() => {
    const own = document.createElement("button");
    own.slot = "footer";
    document.querySelector("touch-path")?.append(own);
    own.focus();
  });
  await page.keyboard.press("Escape");
  await framed();
  await page.locator("tp-viewer").waitFor();
  await page.getByRole("button", { name: "More" }).focus();
  await page.keyboard.press("Escape");
  await page.locator("tp-viewer").waitFor({ state: "detached" });
  assert.match(
    await textOf(page.locator(":is(.state, footer):visible").first()),
    /Ready to save/,
  );
  assert.ok(await saveButton().isEnabled());
  assert.equal(await field("cycle.width1").inputValue(), "90");
  assert.equal(saved(), 0);
});

test("Tool lengths stood over “No problems found” with a Save beside it: that handed out the job that was not seen", async () => {
  await field("cycle.width1").fill("90");
  await more("Tool lengths");
  await page.locator("tp-lentoax").waitFor();
  assert.equal(
    await textOf(page.locator("footer")),
    "Tool lengths are shown, not the job",
  );
  const saved = await held();
  await page.keyboard.press("Escape");
  await page.getByRole("button", { name: "Back to the job" }).click();
  assert.match(
    await textOf(page.locator(":is(.state, footer):visible").first()),
    /Ready to save/,
  );
  assert.ok(await saveButton().isEnabled());
  assert.equal(await field("cycle.width1").inputValue(), "90");
  assert.equal(saved(), 0);
});

test("a shorter program after a longer one left the picture of the first: what was pointed at is forgotten", async () => {
  const long = `G21 G90\nG0 X0 Y0 Z0\n${Array.from({ length: 40 }, (_, i) => `G1 X${i} Y${i % 2 ? 20 : 0} F100`).join("\n")}\nM2\n`;
  await openText(long, "long.ngc");
  const viewer = page.locator("tp-viewer");
  await viewer.waitFor();
  const box = await viewer.locator(PICTURE).boundingBox();
  assert.ok(box);
  const told = () => textOf(viewer.locator(".timeline output"));
  for (
    let x = box.width - 10;
    x > 0 && !(await told()).startsWith("Line");
    x -= 8
  ) {
    await page.mouse.move(box.x + x, box.y + box.height / 2);
  }
  assert.match(
    await told(),
    /^Line \d\d:/,
    "a move that the next program has not",
  );
  await openText("G21 G90\nG0 X0 Y0 Z0\nG38.2 X5 F50\nM2\n", "short.ngc");
  await page.waitForFunction(() => {
    const app = document.querySelector("touch-path");
    return app?.shadowRoot
      ?.querySelector("tp-viewer .timeline output")
      ?.textContent?.startsWith("2 moves, 1 of them probing");
  });
});

test("a file that is dropped on the page was opened by the browser in its place", async () => {
  await page.locator("tp-form").evaluate((target, text) => {
    const dataTransfer = new DataTransfer();
    dataTransfer.items.add(new File([text], "FOREIGN.NC"));
    const over = new DragEvent("dragover", {
      dataTransfer,
      bubbles: true,
      composed: true,
      cancelable: true,
    });
    target.dispatchEvent(over);
    const drop = new DragEvent("drop", {
      dataTransfer,
      bubbles: true,
      composed: true,
      cancelable: true,
    });
    target.dispatchEvent(drop);
    if (!over.defaultPrevented || !drop.defaultPrevented)
      throw new Error("the browser would open the file itself");
  }, FOREIGN);
  await page.locator("tp-viewer").waitFor();
});

test("a program that was refused was not shown: its text is, with the reason, also where nothing of it moves", async () => {
  const before = await program();
  const viewer = page.locator("tp-viewer");
  // A subroutine without a caller is shown, with its text.
  await openText(
    "o<edge> sub\n  o10 if [#5400 NE #3101]\n    (abort, wrong tool)\n  o10 endif\n  G91\n  G38.2 X-[#<reach>] F[#2]\no<edge> endsub\n",
    "edge.ngc",
  );
  await viewer.locator(".listing", { hasText: "o<edge> sub" }).waitFor();
  assert.match(
    await textOf(viewer.locator(".timeline output")),
    /^1 moves, 1 of them probing/,
  );
  // Text that the importer rejects is reported for a text that does not run.
  assert.doesNotMatch(await textOf(viewer.locator(".notes")), /LinuxCNC/);
  await page.getByRole("button", { name: "Back to the job" }).click();
  await openText("G21;G91;G38.2 Z-17 F70;G0 Z2\n", "macro.nc");
  await viewer.locator(".listing", { hasText: "G21;G91;G38." }).waitFor();
  assert.match(await textOf(viewer.locator(".timeline output")), /^0 moves/);
  assert.match(
    `${await textOf(viewer.locator(".notes"))} ${await textOf(page.locator(".note"))}`,
    /semicolon/,
  );
  assert.match(
    await textOf(page.locator(".note")),
    /^This program is shown as text without a job\. /,
  );
  await page.getByRole("button", { name: "Back to the job" }).click();
  assert.equal(await program(), before);
});

test("a program of more than two million characters was not read, though its moves could be", async () => {
  const rows = Array.from(
    { length: 90_000 },
    (_, i) => `N${i} G1 X${i % 300} Y${i % 7} F500`,
  );
  const text = `G21 G90\nG0 X0 Y0 Z5\n${rows.join("\n")}\nM2\n`;
  assert.ok(text.length > 2_000_000);
  await openText(text, "contour.nc");
  const viewer = page.locator("tp-viewer");
  await viewer
    .locator(".timeline output", { hasText: "90001 moves" })
    .waitFor();
  assert.match(
    await textOf(viewer.locator(".notes")),
    /a job is made of at most 2 million/,
  );
});

test("a long program: only lines that are seen are in the document; a line and its move light each other", async () => {
  const rows = Array.from(
    { length: 20_000 },
    (_, i) => `N${i + 4} G1 X${i % 200} Y${Math.floor(i / 200)} F500`,
  );
  await openText(
    `(long)\nG21 G90\nG0 X0 Y0 Z5\n${rows.join("\n")}\nM2\n`,
    "long.nc",
  );
  const viewer = page.locator("tp-viewer");
  const lines = viewer.locator(".listing .line");
  await lines.first().waitFor();
  assert.ok((await lines.count()) < 300, String(await lines.count()));
  const told = () => textOf(viewer.locator(".timeline output"));
  // Words far below are found, and their line is scrolled to.
  await viewer.getByLabel("Find in the program").fill("n15000 ");
  const found = viewer.locator(".line.here");
  await found.waitFor();
  assert.equal(await textOf(found), "N15000 G1 X196 Y74 F500");
  assert.equal(await found.getAttribute("data-number"), "15000");
  assert.equal(await textOf(viewer.locator(".status-text.found")), "1 of 1");
  // The line shows its move, and the picture the line of a move.
  await found.hover();
  assert.equal(await told(), "Line 15000: feed to X196 Y74 Z5 at 500");
  assert.equal(
    await textOf(viewer.locator(".line.lit")),
    "N15000 G1 X196 Y74 F500",
  );
  const box = await viewer.locator(PICTURE).boundingBox();
  assert.ok(box);
  await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
  await framed();
  const line = /^Line (\d+): /.exec(await told())?.[1];
  assert.ok(line && line !== "15000", line);
  assert.match(
    await textOf(viewer.locator(".line.lit")),
    new RegExp(`^N${line} `),
  );
  assert.ok(await viewer.locator(".line.lit").isVisible());
  // By keyboard: Ctrl+F goes to Find, Ctrl+A and a copy take all lines, and nothing can be typed into them.
  const listing = viewer.getByRole("textbox", { name: "The program" });
  await listing.focus();
  await page.keyboard.type("G0");
  await page.keyboard.press("Control+a");
  await page.keyboard.press("Control+c");
  const copied = await page.evaluate(() => navigator.clipboard.readText());
  assert.equal(
    copied,
    `(long)\nG21 G90\nG0 X0 Y0 Z5\n${rows.join("\n")}\nM2\n`,
  );
  await page.keyboard.press("Control+f");
  assert.ok(
    await viewer
      .getByLabel("Find in the program")
      .evaluate((input) => input.matches(":focus")),
  );
});

test("a program of very many moves froze the page while it was drawn: it is drawn in few strokes, and looks the same", async () => {
  await page.evaluate(() => {
    const strokes = Object.assign(globalThis, { strokes: 0 });
    const { stroke } = CanvasRenderingContext2D.prototype;
    CanvasRenderingContext2D.prototype.stroke = function (
      /** @type {any[]} */ ...path
    ) {
      strokes.strokes++;
      Reflect.apply(stroke, this, path);
    };
  });
  const round = "G0 X0 Y0\nG1 X40 F500\nG1 Y30\nG1 X0\nG38.2 Y10 F100\n";
  const seen = async (/** @type {string} */ text) => {
    await page.evaluate(() => Object.assign(globalThis, { strokes: 0 }));
    await openText(text, "rounds.ngc");
    // A long text is read in a worker.
    await page
      .locator("tp-viewer .timeline output", {
        hasText: `${text.split("\n").length - 3} moves`,
      })
      .waitFor();
    await page
      .locator("tp-viewer")
      .getByRole("button", { name: "top" })
      .click();
    const touch = (await painted("tp-viewer", "touch")).count > 0;
    // Extent of the drawing: except for arrow heads and dashes, a long program has the same lines.
    const inked = await page.evaluate(() => {
      const app = document.querySelector("touch-path");
      const canvas = /** @type {HTMLCanvasElement} */ (
        app?.shadowRoot?.querySelector("tp-viewer canvas")
      );
      const { width, height } = canvas;
      const pixels =
        canvas.getContext("2d")?.getImageData(0, 0, width, height).data ?? [];
      const [r, g, b] = pixels;
      const ink = (/** @type {number} */ x, /** @type {number} */ y) => {
        const at = 4 * (y * width + x);
        return pixels[at] !== r || pixels[at + 1] !== g || pixels[at + 2] !== b;
      };
      const count = (/** @type {number} */ n) =>
        Array.from({ length: Math.round(n) }, (_, i) => i);
      // Axes and scale are lower.
      const row = count(width).filter((x) =>
        count(height / 3).some((y) => ink(x, y + Math.round(height / 3))),
      );
      return { left: row[0], right: row.at(-1) };
    });
    return {
      touch,
      inked,
      strokes: await page.evaluate(
        () => /** @type {any} */ (globalThis).strokes,
      ),
    };
  };
  const feeds = () =>
    page
      .locator("tp-viewer .key .link line")
      .evaluate((line) =>
        getComputedStyle(line).strokeDasharray === "none" ? "solid" : "dashed",
      );
  // So many touches that neither picture has numbers.
  const short = await seen(`G21 G17 G90\nG0 Z5\n${round.repeat(51)}M2\n`);
  assert.equal(await feeds(), "dashed");
  const long = await seen(`G21 G17 G90\nG0 Z5\n${round.repeat(3000)}M2\n`);
  assert.ok(long.touch);
  assert.equal(
    await feeds(),
    "solid",
    "the key shows the lines as they are drawn",
  );
  // An arrow head is 4 px to either side of its line.
  for (const side of /** @type {const} */ (["left", "right"]))
    assert.ok(
      Math.abs((long.inked[side] ?? 0) - (short.inked[side] ?? -9)) <= 4,
      side,
    );
  assert.ok(long.strokes < 200, `${long.strokes} strokes for 15000 moves`);
});

test("before its editor is there, a found line was not brought into sight; when the editor came, the listing returned to its start", async () => {
  /** @type {() => void} */
  let send = () => {};
  const sent = new Promise((done) => {
    send = () => done(null);
  });
  await page.route(/\/program-editor-[^/]+\.js$/, async (route) => {
    await sent;
    await route.continue();
  });
  const lines = Array.from({ length: 400 }, (_, i) => `G0 X${i} Y0`);
  // So long that it has the editor.
  const rest = Array.from({ length: 5000 }, (_, i) => `G0 X${i % 400} Y1`);
  await openText(
    ["G21 G90", ...lines, "G38.2 Z-5 F100", ...rest, "M2", ""].join("\n"),
    "foreign.nc",
  );
  const viewer = page.locator("tp-viewer");
  await viewer.getByLabel("Find in the program").fill("g38.2");
  const plain = viewer.locator(".listing pre");
  const height = 13 * 1.5;
  // The line counts from 0, and its rest is above it.
  const line = 401 * height;
  // What the run says of the program may still change the height of the listing: the line is in sight whatever that is.
  await settles(async () => {
    const [top = 0, room = 0] = await plain.evaluate((box) => [
      box.scrollTop,
      box.clientHeight,
    ]);
    return top > 0 && top < line && line + height < top + room;
  });
  send();
  const scroller = viewer.locator(".cm-scroller");
  await scroller.waitFor();
  // The editor estimates the heights of lines that it has not drawn: where the found line is on the screen counts.
  const here = viewer.locator(".line.here");
  await settles(async () => {
    const [box, found] = [
      await scroller.boundingBox(),
      await here.boundingBox(),
    ];
    return (
      !!box &&
      !!found &&
      box.y < found.y &&
      found.y + found.height < box.y + box.height
    );
  });
  assert.match(await textOf(here), /G38\.2/);
});

test("on a phone the listing jumped under the pointer: what is said of a line has its room", async () => {
  await page.setViewportSize({ width: 390, height: 844 });
  await openText(FOREIGN, "foreign.ngc");
  const said = page.locator("tp-viewer .timeline output");
  await page.locator("tp-viewer .line").first().waitFor();
  const { height } = await boxOf(said);
  for (const line of [4, 6]) {
    await page.locator("tp-viewer .line").nth(line).hover();
    assert.match(await textOf(said), new RegExp(`^Line ${line + 1}: `));
    assert.equal((await boxOf(said)).height, height);
  }
});

test("a line of a million characters broke the listing when it was clicked and scrolled", async () => {
  await openText(
    `G21 G90\nG0 X0 Y0 Z5\nG1 X1 F100\n(${"long ".repeat(200_000)})\nG1 X2\n`,
    "long.nc",
  );
  const lines = page.locator("tp-viewer .listing .line");
  await lines.nth(3).waitFor();
  const scroller = page.locator("tp-viewer .cm-scroller");
  for (const top of [2_000, 10_000, 60_000, 0]) {
    await scroller.click({ position: { x: 200, y: 150 } });
    await scroller.evaluate((box, top) => box.scrollTo({ top }), top);
    await framed();
    await framed();
    assert.ok((await lines.count()) > 0, `at ${top}`);
  }
  assert.equal(await lines.first().getAttribute("data-number"), "1");
});

test("a viewer that was taken out of its page while it updated never listed again", async () => {
  await openText(FOREIGN, "foreign.ngc");
  const lines = page.locator("tp-viewer .listing .line");
  await lines.first().waitFor();
  await page.evaluate(async () => {
    const element = /** @type {HTMLElement} */ (
      document.querySelector("touch-path")
    );
    const viewer = /** @type {any} */ (
      element.shadowRoot?.querySelector("tp-viewer")
    );
    const place = /** @type {HTMLElement} */ (element.parentElement);
    element.remove();
    viewer.requestUpdate();
    await viewer.updateComplete;
    place.append(element);
  });
  await lines.first().waitFor();
  assert.equal(await lines.nth(4).textContent(), "G38.2 Z-5 F100");
});
