// The module of the page. It begins without what reads texts from outside and without LENTOAX: a quarter fewer bytes before the first answer.
// The job of a first visit is always the same: what the module says of it comes with the page (www/first-answers.ts), and is shown until the module is
// there.
import { instance, type Raw } from "./core/instance.js";
import address from "./core/wasm/first.wasm?url";
import init, * as raw from "./core/wasm/touchpath.js";
import rest from "./core/wasm/touchpath_bg.wasm?url";

export { raw };

/** Whether the page begins with that job: first.js says so where nothing was kept and the address says no job. */
const isFirst = /\bfirst-(mm|inch)\b/.test(document.documentElement.className);

const pictures: SVGElement[] = [];
const load = () => init({ module_or_path: address });
/** Once more after a while: what was typed meanwhile must not be lost with a connection. */
const again = () => new Promise((done) => setTimeout(done, 2000)).then(load);
const loaded = load()
  .catch(again)
  .catch(again)
  .then(() => {
    arrival = null;
    stand = null;
    for (const picture of pictures) picture.remove();
  });

/** The arrival of the module, where the page is shown before it; null once it is there. */
export let arrival: Promise<void> | null = isFirst ? loaded : null;

/** What answers until the module is there. */
export let stand: Raw | null = null;

// Its failure is reported where it is awaited.
loaded.catch(() => undefined);
const known = isFirst
  ? await import("./first-answers.js").catch(() => null)
  : null;
// The module may have been faster.
if (known && arrival) {
  stand = known.answers();
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

/** Puts the whole module in the place of the first one; Views are made anew. Fails without a network, and can be tried again then. */
export function loadWhole(): Promise<void> {
  loading ??= replace().catch((thrown) => {
    loading = undefined;
    throw thrown;
  });
  return loading;
}

async function replace(): Promise<void> {
  const response = await fetch(rest);
  if (!response.ok)
    throw new Error(`${response.status} ${response.statusText}`);
  const module = await WebAssembly.compile(await response.arrayBuffer());
  await loaded;
  instance.replace(() => raw.use(module));
}
