// The main path in other engines than Chromium's, each with its own WebDriver: the page is shown, a number is typed, the program equals that of the package,
// the picture is drawn. Safari and every browser on an iPad use WebKit.
import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { once } from "node:events";
import { createServer } from "node:net";
import { after, before, describe, test } from "node:test";
import { ensureFirefox, ensureWebKit } from "../../scripts/lib.mjs";
import { addressOf, serve } from "../../scripts/serve.mjs";

/**
 * How an engine's driver is started on a port, and what a session asks of it.
 * @typedef {{ command: string[], capabilities: object }} Driven
 */

/** @type {Record<string, (port: string) => Driven>} */
const ENGINES = {
  Firefox: (port) => {
    const { browser, driver } = ensureFirefox();
    const args = ["-headless", "--width=1280", "--height=900"];
    return {
      command: [driver, "--port", port, "--binary", browser],
      capabilities: { alwaysMatch: { "moz:firefoxOptions": { args } } },
    };
  },
  // It has no headless mode, so it gets a virtual screen.
  WebKit: (port) => {
    const { driver, screen } = ensureWebKit();
    const command = [
      screen,
      "-a",
      "-s",
      "-screen 0 1600x1200x24",
      driver,
      `--port=${port}`,
    ];
    return { command, capabilities: {} };
  },
};

/** A free port. */
async function freePort() {
  const probe = createServer().listen(0, "127.0.0.1");
  await once(probe, "listening");
  const { port } = /** @type {import("node:net").AddressInfo} */ (
    probe.address()
  );
  probe.close();
  await once(probe, "close");
  return port;
}

for (const [name, driven] of Object.entries(ENGINES))
  describe(name, () => {
    /** @type {import("node:http").Server} */
    let server;
    /** @type {import("node:child_process").ChildProcess} */
    let driver;
    let session = "";

    /** Sends a command to the driver. */
    async function ask(
      /** @type {string} */ method,
      /** @type {string} */ path,
      /** @type {unknown} */ body = undefined,
    ) {
      const answer = await fetch(session + path, {
        method,
        headers: { "content-type": "application/json" },
        ...(body === undefined ? {} : { body: JSON.stringify(body) }),
      });
      const { value } = /** @type {any} */ (await answer.json());
      assert.ok(answer.ok, `${method} ${path}: ${JSON.stringify(value)}`);
      return value;
    }

    /** Runs a function in the page; what it promises is waited for. @param {(...args: any[]) => unknown} work @param {unknown[]} args */
    const run = (work, ...args) =>
      ask("POST", "/execute/sync", {
        script: `return (${work})(...arguments)`,
        args,
      });

    /** Presses a button of the element. */
    const press = (/** @type {string} */ name) =>
      run((name) => {
        const button = document
          .querySelector("touch-path")
          ?.shadowRoot?.querySelector(`[aria-label='${name}']`);
        /** @type {HTMLElement | null | undefined} */ (button)?.click();
      }, name);

    before(async () => {
      server = await serve(0);
      const port = await freePort();
      const { command, capabilities } = driven(String(port));
      // In a process group: the screen, the driver and the browser end together.
      driver = spawn(command[0] ?? "", command.slice(1), {
        stdio: "ignore",
        detached: true,
      });
      session = `http://127.0.0.1:${port}`;
      for (let i = 0; ; i++) {
        const there = await fetch(`${session}/status`).then(
          (answer) => answer.ok,
          () => false,
        );
        if (there) break;
        assert.ok(i < 200, "the driver answers");
        await new Promise((done) => setTimeout(done, 100));
      }
      const { sessionId } = await ask("POST", "/session", { capabilities });
      session += `/session/${sessionId}`;
      await ask("POST", "/window/rect", { width: 1280, height: 900 });
    });
    after(async () => {
      await fetch(session, { method: "DELETE" }).catch(() => undefined);
      if (driver?.pid) process.kill(-driver.pid);
      server?.close();
    });

    test("the page stands, what is typed becomes the program, the timeline moves the ball, undo brings back", async () => {
      await ask("POST", "/url", { url: addressOf(server) });
      await run(async () => {
        await customElements.whenDefined("touch-path");
        await /** @type {any} */ (document.querySelector("touch-path")).ready;
      });
      // By keyboard, like a user.
      await run(() =>
        document
          .querySelector("touch-path")
          ?.shadowRoot?.getElementById("f-cycle.diameter")
          ?.focus(),
      );
      const active = await ask("GET", "/element/active");
      assert.ok(active);
      await ask("POST", "/actions", {
        actions: [
          {
            type: "key",
            id: "keys",
            actions: [..."24,5"].flatMap((value) => [
              { type: "keyDown", value },
              { type: "keyUp", value },
            ]),
          },
        ],
      });
      const { defaultJob, plan } = await import("touchpath");
      // Where people measure in inch, a first job is in inch.
      const units =
        (await run(() => navigator.language)) === "en-US" ? "inch" : "mm";
      const job = defaultJob("hole", units);
      const { diameter } = job.cycle;
      Object.assign(job.cycle, { diameter: 24.5 });
      job.name = "BORE-D24_5";
      const shown = () =>
        run(async () => {
          const root = document.querySelector("touch-path")?.shadowRoot;
          root
            ?.querySelector("#tab-program[aria-selected=false]")
            ?.dispatchEvent(new MouseEvent("click"));
          await /** @type {any} */ (document.querySelector("touch-path")).app
            .updateComplete;
          const program = /** @type {any} */ (
            root?.querySelector("tp-program")
          );
          if (!program.everything) program.unfold();
          await program.updateComplete;
          return [...program.querySelectorAll(".text")]
            .map((line) => line.textContent)
            .join("\n");
        });
      assert.equal(`${await shown()}\n`, plan(job).program.text);
      const drawn = async (/** @type {string} */ which) => {
        await run(
          () => new Promise((done) => requestAnimationFrame(() => done(null))),
        );
        return run((which) => {
          const canvas = /** @type {HTMLCanvasElement} */ (
            document
              .querySelector("touch-path")
              ?.shadowRoot?.querySelector(`tp-picture ${which}`)
          );
          const data = new Uint32Array(
            /** @type {CanvasRenderingContext2D} */ (
              canvas.getContext("2d")
            ).getImageData(0, 0, canvas.width, canvas.height).data.buffer,
          );
          return data.reduce(
            (sum, pixel, i) =>
              pixel === data[0] ? sum : (sum * 31 + i + pixel) % 1_000_000_007,
            0,
          );
        }, which);
      };
      assert.ok((await drawn("canvas")) > 0, "the picture is drawn");
      assert.equal(await drawn("canvas.over"), 0, "nothing lies over it");
      await run(() =>
        document
          .querySelector("touch-path")
          ?.shadowRoot?.getElementById("timeline")
          ?.dispatchEvent(
            new KeyboardEvent("keydown", {
              key: "ArrowRight",
              ctrlKey: true,
              bubbles: true,
            }),
          ),
      );
      assert.ok(
        (await drawn("canvas.over")) > 0,
        "the ball is at the first touch",
      );
      await press("Undo");
      Object.assign(job.cycle, { diameter });
      job.name = `BORE-D${String(diameter).replace(".", "_")}`;
      await run(
        () =>
          /** @type {any} */ (document.querySelector("touch-path")).app
            .updateComplete,
      );
      assert.equal(`${await shown()}\n`, plan(job).program.text);
      const png = await ask("GET", "/screenshot");
      assert.ok(
        Buffer.from(png, "base64").length > 20_000,
        "there is something to see",
      );
    });
  });
