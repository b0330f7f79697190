// Service worker: stores the page's files, all of one version, so that it works without a network. The build inserts the list of files.
/// <reference lib="webworker" />
const worker = /** @type {ServiceWorkerGlobalScope} */ (/** @type {unknown} */ (self));
/** @type {string[]} */
const FILES = [];
/**
 * Optional files, stored on request: the words of the languages, the editor of opened programs, the second part of the module, the licences. @type {string[]}
 */
const WANTED = [];
const VERSION = "";
/** One cache per folder: another installation on the same server has its own. */
const OWN = `touchpath ${new URL("./", location.href).pathname} `;
const CACHE = OWN + VERSION;
const PAGE = new URL("./", location.href).pathname;

/** Whether the file name contains a hash of its content. Such a file never changes. */
const lasts = (/** @type {string} */ name) => /-[\w-]{8}\.\w+$/.test(name);

/** File name without the hash: the same file in another version. */
const stem = (/** @type {string} */ name) => (lasts(name) ? name.slice(0, -"-01234567.js".length) : name);

worker.addEventListener("install", (event) => {
  const install = async () => {
    const cache = await caches.open(CACHE);
    // Optional files that the previous version had stored are stored again.
    const before = (await caches.keys()).filter((name) => name.startsWith(OWN) && name !== CACHE);
    const kept = await Promise.all(before.map(async (name) => (await caches.open(name)).keys()));
    const had = new Set(kept.flat().map((request) => stem(new URL(request.url).pathname)));
    const again = WANTED.filter((file) => had.has(stem(PAGE + file)));
    // Takes files that the page has loaded from the browser's cache instead of the network.
    const request = (/** @type {string} */ file) => new Request(file, { cache: lasts(file) ? "force-cache" : "reload" });
    // All files or none: a mix of two versions breaks the page.
    await cache.addAll([...FILES, ...again].map(request));
  };
  event.waitUntil(install());
});

worker.addEventListener("activate", (event) => {
  const others = async () => {
    const names = await caches.keys();
    const old = names.filter((name) => name.startsWith(OWN) && name !== CACHE);
    await Promise.all(old.map((name) => caches.delete(name)));
    // Also controls the page of the first visit, so that it can store optional files.
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
      // Without space, the file is loaded again next time.
      event.waitUntil(cache.put(event.request, response.clone()).catch(() => undefined));
    }
    return response;
  };
  event.respondWith(answer());
});

// Switches versions only when the user asks, so a job being edited is not interrupted.
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
