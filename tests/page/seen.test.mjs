// Problems that a new user found on the page, with a test each.
import assert from "node:assert/strict";
import { test } from "node:test";
import {
  field,
  held,
  more,
  onView,
  open,
  page,
  panel,
  pixels,
  put,
  ready,
  settles,
  setUp,
  textOf,
} from "./common.mjs";

setUp({ width: 1440, height: 900 });

/** The lines of the dimensions, pixels of the picture, by field. @type {() => Promise<[string, number, number, number, number][]>} */
const lines = () =>
  onView((view) =>
    [...view.dimensionLines()].map((/** @type {any} */ line) => [...line]),
  );
const lengthOf = async (/** @type {string} */ path) => {
  const [, x, y, u, v] = (await lines()).find(([field]) => field === path) ?? [
    "",
    0,
    0,
    0,
    0,
  ];
  return Math.hypot(u - x, v - y);
};

test("a key was dead where nothing had the focus: Ctrl+S saves there, Ctrl+Z takes back", async () => {
  await field("cycle.width1").fill("70");
  await page.locator("tp-findings").click({ position: { x: 200, y: 90 } });
  assert.equal(
    await page.evaluate(() => document.activeElement === document.body),
    true,
  );
  const download = page.waitForEvent("download");
  await page.keyboard.press("Control+s");
  assert.equal((await download).suggestedFilename(), "POCKET-70X50.ngc");
  await page.keyboard.press("Control+z");
  assert.equal(await held("cycle.width1"), 80);
});

test("the picture was fitted anew at each keystroke: what is edited keeps its scale while it fits, and is fitted where it does not", async () => {
  const scale = (await lengthOf("cycle.width1")) / 80;
  for (const width of [79, 82, 70]) {
    await field("cycle.width1").fill(String(width));
    const now = await lengthOf("cycle.width1");
    assert.ok(
      Math.abs(now - width * scale) < 0.01,
      `${width}: ${now} pixels, ${width * scale} wanted`,
    );
  }
  for (const width of [400, 20]) {
    await field("cycle.width1").fill(String(width));
    const now = await lengthOf("cycle.width1");
    assert.ok(
      now > 60 && now < 800 && Math.abs(now - width * scale) > 10,
      `${width}: ${now} pixels`,
    );
  }
  // Back again it is about as large as it was, and a part that is moved far is near the middle again.
  await field("cycle.width1").fill("140");
  await field("cycle.width1").fill("80");
  assert.ok(Math.abs((await lengthOf("cycle.width1")) / 80 / scale - 1) < 0.3);
  await field("cycle.origin[0]").fill("30");
  const [, x, , u] = (await lines()).find(
    ([field]) => field === "cycle.width1",
  ) ?? ["", 0, 0, 0, 0];
  const { width } = (await page
    .locator("tp-picture canvas")
    .first()
    .boundingBox()) ?? { width: 0 };
  assert.ok(
    Math.abs((x + u) / 2 - width / 2) < 0.2 * width,
    `${x} to ${u} of ${width}`,
  );
});

test("another cycle was not fitted after the picture had been moved: it was out of sight", async () => {
  await page.locator("tp-picture canvas").first().hover();
  for (let i = 0; i < 8; i++) await page.mouse.wheel(0, -300);
  await field("cycle.type").selectOption("hole");
  const across = await lengthOf("cycle.diameter");
  assert.ok(across > 100 && across < 700, `${across} pixels`);
});

for (const [width, height] of /** @type {const} */ ([
  [390, 844],
  [844, 390],
]))
  test(`what is said of the picture is not under its tools, and the timeline fits: ${width} by ${height}`, async () => {
    await open({ viewport: { width, height }, hasTouch: true, isMobile: true });
    await put("part.offset[0]", 0.2);
    await page.locator("#timeline").press("Control+ArrowRight");
    const trial = await page.locator(".part-note").boundingBox();
    assert.ok(trial);
    for (const button of await page
      .locator(".picture .cube button:visible")
      .all()) {
      const box = await button.boundingBox();
      const beside =
        box && (box.x >= trial.x + trial.width || box.x + box.width <= trial.x);
      assert.ok(
        box && (beside || box.y + box.height <= trial.y),
        await textOf(button),
      );
    }
    const clock = await page.locator(".clock").boundingBox();
    assert.ok(clock && clock.x + clock.width <= width, `${clock?.x}`);
    assert.match(
      await textOf(page.locator(".timeline output:visible")),
      /^touch 1 · contact X37 Y0 Z-10/,
    );
  });

test("a part that lies elsewhere was not said beside an error", async () => {
  await put("part.rotation", 20);
  await field("cycle.width1").fill("10");
  await page.locator(".banner").waitFor();
  assert.match(await textOf(page.locator(".part-note")), /turned 20°/);
  const [stamp, trial] = await Promise.all([
    page.locator(".banner").boundingBox(),
    page.locator(".part-note").boundingBox(),
  ]);
  assert.ok(
    stamp &&
      trial &&
      (stamp.y + stamp.height <= trial.y || stamp.x + stamp.width <= trial.x),
    "side by side",
  );
});

test("a turn of 20° was drawn as one of 200°: it is not drawn larger", async () => {
  const button = page.getByRole("button", { name: /Deviations are drawn/ });
  await put("part.rotation", 1);
  await button.click();
  assert.equal(await textOf(button), "drawn ×10");
  await button.click();
  assert.equal(await textOf(button), "×1", "a hundred times would be 100°");
  await button.click();
  await put("part.rotation", 3);
  assert.equal(await button.count(), 0, "and it is drawn as it is again");
});

test("the timeline of a form with an error still told moves, length and time of the last good one", async () => {
  const said = () => textOf(page.locator(".timeline output"));
  assert.match(await said(), /^27 moves/);
  await field("cycle.width1").fill("10");
  await page.locator(".banner").waitFor();
  assert.equal(await said(), "");
  assert.equal(
    await page.getByRole("button", { name: "Play" }).isDisabled(),
    true,
  );
  assert.equal(await page.locator("#timeline").getAttribute("max"), "0");
});

test("the clock of the timeline follows the moves", async () => {
  const clock = () => textOf(page.locator(".clock"));
  assert.equal(await clock(), "0:00 / 0:32");
  await page.locator("#timeline").press("Control+ArrowRight");
  // Down from 30 to 10 at F2000, to touch 1 along 32 and 20 at F1000, 5 at F150: 0.6 + 3.12 + 2 s.
  assert.match(await clock(), /^0:0[56] \/ 0:32$/);
  await page.locator("#timeline").fill("27");
  assert.equal(await clock(), "0:32 / 0:32");
});

test("only keys went move by move", async () => {
  const move = () => page.locator("#timeline").inputValue();
  await page.locator("#timeline").press("ArrowRight");
  await page.locator("#timeline").press("ArrowRight");
  assert.equal(await move(), "2");
  assert.match(
    await textOf(page.locator(".timeline output")),
    /^positioning · X0 Y0 Z10 · F2000$/,
  );
  await page.locator("#timeline").press("ArrowLeft");
  assert.equal(await move(), "1");
  await page.locator("#timeline").press("ArrowLeft");
  await page.locator("#timeline").press("ArrowLeft");
  assert.equal(await move(), "0");
});

test("forms of cycles that were left were gone after a reload", async () => {
  await field("cycle.width1").fill("99");
  await field("cycle.type").selectOption("boss");
  await page.reload();
  await ready();
  assert.equal(await held("cycle.type"), "boss");
  await field("cycle.type").selectOption("internal-rectangle-protected");
  assert.equal(await held("cycle.width1"), 99);
});

test("a cycle that touches nothing asks for no probe, feeds or part, and has nothing to drag", async () => {
  const groups = () => page.locator("tp-form .fold b").allTextContents();
  assert.ok((await groups()).includes("Stock and virtual part"));
  await field("cycle.type").selectOption("probe-on-off");
  assert.deepEqual(await groups(), [
    "Clearances, touches, feeds",
    "Machine and probe",
  ]);
  assert.equal(await page.locator("[id^='f-feeds']").count(), 0);
  assert.ok((await pixels()).count > 0, "the work origin is drawn");
  const grips = await page.evaluate(() => {
    const picture = /** @type {any} */ (
      document
        .querySelector("touch-path")
        ?.shadowRoot?.querySelector("tp-picture")
    );
    const { clientWidth, clientHeight } = picture.querySelector("canvas");
    const found = new Set();
    for (let x = 0; x < clientWidth; x += 8)
      for (let y = 0; y < clientHeight; y += 8)
        found.add(picture.drawing.view.handleAt(x, y, 14) ?? "none");
    return [...found];
  });
  assert.deepEqual(grips, ["none"]);
});

test("a group that is there for its error stays until what is typed into it is done", async () => {
  await put("stylus.diameter", -1);
  await field("cycle.type").selectOption("probe-on-off");
  const ball = field("stylus.diameter");
  await page.getByRole("button", { name: "Go to it" }).click();
  await ball.fill("");
  await ball.pressSequentially("6.5");
  assert.equal(await held("stylus.diameter"), 6.5);
  assert.equal(await ball.inputValue(), "6.5");
});

test("what is asked of the tool lengths is there again", async () => {
  await more("Tool lengths");
  await page.locator("#l-plane").selectOption("G18");
  await page.getByRole("button", { name: "Back to the job" }).click();
  await more("Tool lengths");
  assert.equal(await page.locator("#l-plane").inputValue(), "G18");
});

test("on a phone on its side the picture could not be turned", async () => {
  await open({ viewport: { width: 844, height: 390 }, hasTouch: true });
  await page.getByRole("button", { name: "isometric" }).click();
  assert.equal(
    await page
      .getByRole("button", { name: "isometric" })
      .getAttribute("aria-pressed"),
    "true",
  );
});

for (const locale of ["de-DE", "ru-RU", "zh-TW"])
  test(`the tools of the picture fit a phone: ${locale}`, async () => {
    await open({
      viewport: { width: 390, height: 844 },
      hasTouch: true,
      isMobile: true,
      locale,
    });
    for (const button of await page
      .locator(".picture .tools button:visible")
      .all()) {
      const box = await button.boundingBox();
      const over = await button.evaluate(
        (node) => node.scrollWidth - node.clientWidth,
      );
      assert.ok(
        box && box.x >= 0 && box.x + box.width <= 390 && over <= 0,
        `${await textOf(button)}: ${box?.x}, ${over}`,
      );
    }
  });

test("buttons of the picture and the timeline are as wide as a finger on a phone", async () => {
  await open({
    viewport: { width: 390, height: 844 },
    hasTouch: true,
    isMobile: true,
  });
  const buttons = await page
    .locator(
      ".picture .cube button:visible, .timeline button:visible, .icon:visible",
    )
    .all();
  assert.ok(buttons.length >= 7, `${buttons.length}`);
  for (const button of buttons) {
    const box = await button.boundingBox();
    assert.ok(
      box && box.width >= 43.5 && box.height >= 43.5,
      `${await textOf(button)}: ${box?.width} × ${box?.height}`,
    );
  }
});

test("what was typed last is there after a reload, though it is written a moment later", async () => {
  // The write after the page was opened comes first: its timer runs on the real clock.
  await settles(() => page.evaluate(() => sessionStorage.length > 0));
  // The page's clock is stopped: only leaving the page writes.
  await page.clock.install();
  await page.clock.pauseAt(Date.now() + 60_000);
  await page.evaluate(() => sessionStorage.clear());
  await field("cycle.width1").fill("71");
  assert.equal(
    await page.evaluate(() => sessionStorage.length),
    0,
    "a keystroke does not wait for the disk",
  );
  await page.clock.resume();
  await page.reload();
  await ready();
  assert.equal(await held("cycle.width1"), 71);
});

test("the box for measured points folded shut when it was emptied, and what was typed next was lost", async () => {
  await panel("measured");
  await page.locator("#measured").fill("37,012 0 -10");
  await page.locator("#measured").fill("");
  await page.keyboard.type("36,9 0 -10");
  assert.equal(await page.locator("#measured").inputValue(), "36,9 0 -10");
  await page.getByText("Points given: 1, touches: 4").waitFor();
  // It stays as it is left.
  await page.locator("details.measured > summary").click();
  await page.locator("#measured").waitFor({ state: "hidden" });
});

test("LinuxCNC's log of a probe was no file that the page knew", async () => {
  const log = [37, -37.02, 0.01, -0.02].map((x, i) =>
    i < 2 ? `${x} 0 -10` : `0 ${i === 2 ? 22.01 : -22} -10`,
  );
  const buffer = Buffer.from(
    log.map((line) => `${line} 0 0 0 0 0 0\n`).join(""),
  );
  await page
    .locator("#file")
    .setInputFiles({ name: "probe.log", mimeType: "text/plain", buffer });
  await page
    .getByText(
      "4 measured points were taken from this log: Results compares them with this job",
    )
    .waitFor();
  assert.equal(
    await page
      .getByRole("tab", { name: /^Measured/ })
      .getAttribute("aria-selected"),
    "true",
  );
  // The balls are 74.02 apart, and the ball is 6 wide.
  assert.match(
    await textOf(
      page.locator("tp-results tbody tr").filter({ hasText: "Width 1" }),
    ),
    /80\.020/,
  );
  await page.keyboard.press("Control+z");
  assert.equal(await page.locator("#measured").inputValue(), "");
});

test("the rail of the timeline shrank as soon as a move was lit", async () => {
  for (const [width, height] of [
    [1440, 900],
    [1024, 768],
    [390, 844],
  ]) {
    await open({
      viewport: { width: width ?? 0, height: height ?? 0 },
      hasTouch: true,
    });
    const rail = () =>
      page
        .locator("#timeline")
        .evaluate((box) => box.getBoundingClientRect().width);
    const before = await rail();
    await page.locator("#timeline").press("Control+ArrowRight");
    assert.equal(await rail(), before, String(width));
  }
});

test("a program with a cycle of the control's own opened on its comments, and lit no line", async () => {
  await field("cycle.type").selectOption("probing-two-circles");
  await field("control.post").selectOption("heidenhain");
  const first = page.locator("tp-program .line:visible").first();
  assert.match(
    await textOf(first),
    /^\d+ TCH PROBE 1411/,
    "its own number, and no other",
  );
  await page.locator("#timeline").press("Control+ArrowRight");
  assert.match(
    await textOf(page.locator("tp-program .line[aria-selected=true]")),
    /^\d+ TCH PROBE 1411/,
  );
});

test("with an error the dimension in focus was lit with its old value", async () => {
  await field("cycle.width1").fill("79");
  const lit = () =>
    page.evaluate(() => {
      const picture = /** @type {any} */ (
        document
          .querySelector("touch-path")
          ?.shadowRoot?.querySelector("tp-picture")
      );
      return picture.lit;
    });
  assert.equal(await lit(), "cycle.width1");
  await field("cycle.width1").fill("10");
  assert.equal(await lit(), undefined);
});

test("Escape did not leave the gallery, and errors were not said beside Checks", async () => {
  const badge = page.locator("tp-badge");
  assert.equal(await textOf(badge), "");
  await field("cycle.width1").fill("10");
  assert.equal((await textOf(badge)).trim(), "1");
  await field("cycle.width1").fill("80");
  await page.getByRole("button", { name: "Gallery" }).click();
  await page.getByRole("searchbox", { name: "Search the cycles" }).fill("web");
  await page.keyboard.press("Escape");
  assert.equal(
    await page
      .getByRole("searchbox", { name: "Search the cycles" })
      .inputValue(),
    "",
  );
  await page.keyboard.press("Escape");
  await field("cycle.width1").waitFor({ state: "visible" });
});

test("one cause stood beside each of its results, also where it changes nothing that is shown", async () => {
  await put("part.rotation", 2);
  await panel("results", page);
  const notes = page.locator("tp-results .notes li");
  assert.equal(await notes.count(), 1);
  // (80 − 6)(1/cos 2° − 1) and (50 − 6)(1/cos 2° − 1).
  assert.match(
    await textOf(notes),
    /^Width 1 \+0\.045, Width 2 \+0\.027 from the truth: cosine error/,
  );
  await put("part.rotation", 0.05);
  assert.equal(await notes.count(), 0);
});
