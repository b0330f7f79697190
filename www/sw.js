// The service worker: keeps the page's files, all of one version, so that it works without a network. The build puts them in here.
/// <reference lib="webworker" />
const worker = /** @type {ServiceWorkerGlobalScope} */ (/** @type {unknown} */ (self));
/** @type {string[]} */
const FILES = [];
const VERSION = "";
/** One installation a folder: another one of the same server has its own files. */
const OWN = `touchpath ${new URL("./", location.href).pathname} `;
const CACHE = OWN + VERSION;
const PAGE = new URL("./", location.href).pathname;

worker.addEventListener("install", (event) => {
  // All of them or none: a page of two versions is worse than no page.
  event.waitUntil(caches.open(CACHE).then((cache) => cache.addAll(FILES.map((file) => new Request(file, { cache: "reload" })))));
});

worker.addEventListener("activate", (event) => {
  const others = async () => {
    const names = await caches.keys();
    const old = names.filter((name) => name.startsWith(OWN) && name !== CACHE);
    await Promise.all(old.map((name) => caches.delete(name)));
  };
  event.waitUntil(others());
});

worker.addEventListener("fetch", (event) => {
  const url = new URL(event.request.url);
  if (event.request.method !== "GET" || url.origin !== location.origin) return;
  const answer = async () => {
    const cache = await caches.open(CACHE);
    const asked = url.pathname === `${PAGE}index.html` ? PAGE : event.request;
    return (await cache.match(asked, { ignoreSearch: true })) ?? fetch(event.request);
  };
  event.respondWith(answer());
});

// The page asks for it when its user does: nothing changes under a job that is being typed.
worker.addEventListener("message", (event) => {
  if (event.data === "take-over") event.waitUntil(worker.skipWaiting());
});
