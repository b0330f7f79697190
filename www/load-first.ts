// The module of the page. It comes in two parts: the first is what a first visit and the edits of its forms run, the rest is joined to it as soon as it has come.
// The job of a first visit is always the same: what the module says of it comes with the page (www/first-answers.ts), and is shown until the module is
// there.
import type { Raw } from "./core/instance.js";
import address from "./core/wasm/first.wasm?url";
import rest from "./core/wasm/rest.wasm?url";
import init, * as raw from "./core/wasm/touchpath.js";

export { raw };

/** Whether the page begins with that job: first.js says so where nothing was kept and the address says no job. */
const isFirst = /\bfirst-(mm|inch)\b/.test(document.documentElement.className);

const pictures: SVGElement[] = [];
const load = () => init({ module_or_path: address });
/** Once more after a while: what was typed meanwhile must not be lost with a connection. */
const retry = () => new Promise((done) => setTimeout(done, 2000)).then(load);
const loaded = load()
  .catch(retry)
  .catch(retry)
  .then(() => {
    arrival = null;
    prebuiltAnswers = null;
    for (const picture of pictures) picture.remove();
  });

/** The arrival of the module, where the page is shown before it; null once it is there. */
export let arrival: Promise<void> | null = isFirst ? loaded : null;

/** What answers until the module is there. */
export let prebuiltAnswers: Raw | null = null;

// Its failure is reported where it is awaited.
loaded.catch(() => undefined);
const known = isFirst
  ? await import("./first-answers.js").catch(() => null)
  : null;
// The module may have been faster.
if (known && arrival) {
  prebuiltAnswers = known.answers();
  showPicture();
} else await loaded;

/** The picture in the page's markup takes the place of the canvas until the module draws it. */
function showPicture(): void {
  const page = document.querySelector("touch-path");
  for (const svg of page?.querySelectorAll(".shell svg") ?? []) {
    const picture = svg.cloneNode(true) as SVGElement;
    picture.slot = "picture";
    // The hatch of the one that is no longer seen would not be seen either.
    for (const hatch of picture.querySelectorAll("[id]")) {
      const filled = picture.querySelectorAll(`[fill="url(#${hatch.id})"]`);
      hatch.id += "-early";
      for (const one of filled) one.setAttribute("fill", `url(#${hatch.id})`);
    }
    page?.append(picture);
    pictures.push(picture);
  }
}

let loading: Promise<void> | undefined;
let partial = true;

/** Joins the rest at once, where something was asked that it alone can answer; says whether it was missing. A page that cannot have it fails as it would have. */
export function completeNow(): boolean {
  if (!partial) return false;
  const request = new XMLHttpRequest();
  request.open("GET", rest, false);
  // Bytes as they are: without this a synchronous answer is a text.
  request.overrideMimeType("text/plain; charset=x-user-defined");
  try {
    request.send();
  } catch {
    return false;
  }
  if (request.status !== 200) return false;
  const text = request.responseText;
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; i++) bytes[i] = text.charCodeAt(i);
  take(new WebAssembly.Module(bytes));
  return true;
}

/** It may have come in both ways. */
function take(module: WebAssembly.Module): void {
  if (partial) raw.join(module);
  partial = false;
}

/** Joins the rest to the first part. Fails without a network, and can be tried again then. */
export function loadWhole(): Promise<void> {
  loading ??= join().catch((thrown) => {
    loading = undefined;
    throw thrown;
  });
  return loading;
}

async function join(): Promise<void> {
  const response = await fetch(rest, { priority: "low" });
  if (!response.ok)
    throw new Error(`${response.status} ${response.statusText}`);
  const module = await WebAssembly.compile(await response.arrayBuffer());
  await loaded;
  take(module);
}

// A job that was kept may need all of it; a first visit has its answer sooner. Where the browser is to save data, it comes when it is needed.
const { connection } = navigator as { connection?: { saveData?: boolean } };
if (!connection?.saveData) {
  const joined = loaded.then(loadWhole).catch(() => undefined);
  if (!isFirst) await joined;
}
