// Loads the module of the page in two parts. The first runs a first visit and the edits of its forms; the second joins it when it has arrived. The first job is
// always the same: its answers are part of the page (www/first-answers.ts) and serve until the module is loaded.
import type { Raw } from "./core/instance.js";
import address from "./core/wasm/first.wasm?url";
import rest from "./core/wasm/rest.wasm?url";
import init, * as raw from "./core/wasm/touchpath.js";

export { raw };

/** Whether the page starts with the first job. first.js sets this if nothing is stored and the address holds no job. */
const isFirst = /\bfirst-(mm|inch)\b/.test(document.documentElement.className);

const pictures: SVGElement[] = [];
const load = () => init({ module_or_path: address });
/** Retries after 2 s: text that was typed meanwhile must survive a lost connection. */
const retry = () => new Promise((done) => setTimeout(done, 2000)).then(load);
const loaded = load()
  .catch(retry)
  .catch(retry)
  .then(() => {
    arrival = null;
    prebuiltAnswers = null;
    for (const picture of pictures) picture.remove();
  });

/** Arrival of the module if the page is shown before it; null afterwards. */
export let arrival: Promise<void> | null = isFirst ? loaded : null;

/** Answers until the module is loaded. */
export let prebuiltAnswers: Raw | null = null;

// The failure is reported where it is awaited.
loaded.catch(() => undefined);
const known = isFirst
  ? await import("./first-answers.js").catch(() => null)
  : null;
// The module may have arrived first.
if (known && arrival) {
  prebuiltAnswers = known.answers();
  showPicture();
} else await loaded;

/** Shows the picture of the page's markup in place of the canvas until the module draws. */
function showPicture(): void {
  const page = document.querySelector("touch-path");
  for (const svg of page?.querySelectorAll(".shell svg") ?? []) {
    const picture = svg.cloneNode(true) as SVGElement;
    picture.slot = "picture";
    // A hatch pattern of a hidden picture would not be drawn.
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

/** Loads the second part synchronously for a question that only it can answer. Returns whether it was missing. Fails like the page without it. */
export function completeNow(): boolean {
  if (!partial) return false;
  const request = new XMLHttpRequest();
  request.open("GET", rest, false);
  // Raw bytes: a synchronous response is otherwise text.
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

/** Both ways of loading may have brought it. */
function take(module: WebAssembly.Module): void {
  if (partial) raw.join(module);
  partial = false;
}

/** Joins the second part to the first. Fails without a network; a later call tries again. */
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

// A stored job may need both parts; a first visit is answered sooner without. If the browser saves data, the second part loads on demand.
const { connection } = navigator as { connection?: { saveData?: boolean } };
if (!connection?.saveData) {
  const joined = loaded.then(loadWhole).catch(() => undefined);
  if (!isFirst) await joined;
}
