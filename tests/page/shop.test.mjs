// Lines of the shop: the usual ones of the control, own ones, their messages, and the machine that keeps them.
import assert from "node:assert/strict";
import { test } from "node:test";
import { page, program, put, setUp, unfold } from "./common.mjs";

setUp();

const box = (/** @type {string} */ place) =>
  page.locator(`[id="f-machine.frame.${place}"]`);

test("a Haas gets its tool change, its safe position and the shop's own lines", async () => {
  await put("control.post", "haas");
  await put("control.tool", 24);
  await unfold();
  await page
    .getByRole("button", { name: "Enter the usual lines for Haas NGC" })
    .click();
  assert.equal(
    await box("head").inputValue(),
    "G53 G0 {axis}0.\nT{tool} M6\nG43 H{tool}",
  );
  assert.match(
    await program(),
    /\(SHOP'S LINES, HEAD\)\nG53 G0 Z0\.\nT24 M6\nG43 H24\n/,
  );
  await box("probeOn").fill("M59 P3");
  assert.match(
    await program(),
    /\(SHOP'S LINES, PROBE ON, NOT CHECKED\)\nM59 P3\n/,
  );
  // A new line is kept while it is typed.
  await box("probeOn").press("End");
  await box("probeOn").press("Enter");
  assert.equal(await box("probeOn").inputValue(), "M59 P3\n");
  await page.keyboard.type("G10 L2 P1 Z0.");
  const message = page.locator(`[id="e-machine.frame.probeOn"]`);
  await message.getByText("writes to a table of the control").waitFor();
  assert.equal(await box("probeOn").getAttribute("aria-invalid"), "true");
  await box("probeOn").fill("");
  assert.doesNotMatch(await program(), /PROBE ON/);
});
