// The service worker: keeps the page's files, all of one version, so that it works without a network. The build puts them in here.
/// <reference lib="webworker" />
const worker = /** @type {ServiceWorkerGlobalScope} */ (/** @type {unknown} */ (self));
/** @type {string[]} */
const FILES = [];
/** Files that not every user wants: the words of the languages, the editor of opened programs, the rest of the module, the licences. They are kept when they are asked for. @type {string[]} */
const WANTED = [];
const VERSION = "";
/** One installation a folder: another one of the same server has its own files. */
const OWN = `touchpath ${new URL("./", location.href).pathname} `;
const CACHE = OWN + VERSION;
const PAGE = new URL("./", location.href).pathname;

/** Whether a file has the hash of what is in it in its name: whatever was fetched under that name is right, for ever. */
const lasts = (/** @type {string} */ name) => /-[\w-]{8}\.\w+$/.test(name);

/** A file's name without the hash of what is in it: the same file of another version. */
const stem = (/** @type {string} */ name) => (lasts(name) ? name.slice(0, -"-01234567.js".length) : name);

worker.addEventListener("install", (event) => {
  const install = async () => {
    const cache = await caches.open(CACHE);
    // What the version before has kept, this one keeps, too.
    const before = (await caches.keys()).filter((name) => name.startsWith(OWN) && name !== CACHE);
    const kept = await Promise.all(before.map(async (name) => (await caches.open(name)).keys()));
    const had = new Set(kept.flat().map((request) => stem(new URL(request.url).pathname)));
    const again = WANTED.filter((file) => had.has(stem(PAGE + file)));
    // What the page has loaded already is taken from the browser's cache and not fetched again.
    const request = (/** @type {string} */ file) => new Request(file, { cache: lasts(file) ? "force-cache" : "reload" });
    // All of them or none: a page of two versions is worse than no page.
    await cache.addAll([...FILES, ...again].map(request));
  };
  event.waitUntil(install());
});

worker.addEventListener("activate", (event) => {
  const others = async () => {
    const names = await caches.keys();
    const old = names.filter((name) => name.startsWith(OWN) && name !== CACHE);
    await Promise.all(old.map((name) => caches.delete(name)));
    // The page of the first visit, too, finds here what is kept for it.
    await worker.clients.claim();
  };
  event.waitUntil(others());
});

worker.addEventListener("fetch", (event) => {
  const url = new URL(event.request.url);
  if (event.request.method !== "GET" || url.origin !== location.origin) return;
  const answer = async () => {
    const cache = await caches.open(CACHE);
    const asked = url.pathname === `${PAGE}index.html` ? PAGE : event.request;
    const kept = await cache.match(asked, { ignoreSearch: true });
    if (kept) return kept;
    const response = await fetch(event.request);
    if (response.ok && WANTED.some((file) => url.pathname === PAGE + file)) {
      // Where there is no room, it is loaded again the next time.
      event.waitUntil(cache.put(event.request, response.clone()).catch(() => undefined));
    }
    return response;
  };
  event.respondWith(answer());
});

// The page asks for it when its user does: nothing changes under a job that is being typed.
worker.addEventListener("message", (event) => {
  if (event.data === "take-over") event.waitUntil(worker.skipWaiting());
  const file = WANTED.find((name) => name.startsWith(`assets/${event.data?.keep}-`));
  if (!file) return;
  const keep = async () => {
    const cache = await caches.open(CACHE);
    if (!(await cache.match(file))) await cache.add(file);
  };
  event.waitUntil(keep());
});
