// Keeps one version of the page for visits without a connection.
//
// The build replaces the two constants below, so each version of the page has a worker of its own. A
// new version waits until the visitor asks for it: a page that is open never changes under its visitor.

/** This version's name, and its files beside the document. */
const VERSION = "";
const FILES = [];

/** Caches are shared by all pages of an origin: each folder with the program has its own. */
const PREFIX = `mandelight-${new URL(self.registration.scope).pathname}-`;
const CACHE = PREFIX + VERSION;
/** The entry of caches whose version has been shown. */
const SHOWN = "./shown";
/** The document, by the address of the folder. */
const DOCUMENT = "./";

self.addEventListener("install", (event) => {
  event.waitUntil(caches.open(CACHE).then((cache) => cache.addAll([DOCUMENT, ...FILES])));
});

/** This program's caches, in the order in which they were made. */
const cacheNames = async () => (await caches.keys()).filter((name) => name.startsWith(PREFIX));

self.addEventListener("activate", (event) => {
  const purge = async () => {
    const old = (await cacheNames()).filter((name) => name !== CACHE);
    const wasShown = await Promise.all(old.map(async (name) => Boolean(await (await caches.open(name)).match(SHOWN))));
    // Tabs that show the version before this one may still load parts of it.
    const before = old[wasShown.lastIndexOf(true)];
    await Promise.all(old.filter((name) => name !== before).map((name) => caches.delete(name)));
    await (await caches.open(CACHE)).put(SHOWN, new Response());
    await self.clients.claim();
  };
  event.waitUntil(purge());
});

/** A file of any kept version. */
async function ofAnyVersion(request) {
  for (const name of await cacheNames()) {
    const found = await (await caches.open(name)).match(request);
    if (found) return found;
  }
}

self.addEventListener("message", (event) => {
  if (event.data === "activate") self.skipWaiting();
});

self.addEventListener("fetch", (event) => {
  const { request } = event;
  const url = new URL(request.url);
  if (request.method !== "GET" || url.origin !== self.location.origin) return;
  // Browsers keep compiled code only for responses that come from the network themselves. The page
  // takes the module from the cache where the network has none.
  if (url.pathname.endsWith(".wasm")) return;
  const scope = new URL(self.registration.scope).pathname;
  const isDocument = request.mode === "navigate" && url.pathname.startsWith(scope);
  const kept = async () => {
    const cache = await caches.open(CACHE);
    const found = await cache.match(request);
    // Any other address of the folder is the document's, whatever its query.
    if (isDocument) return found || (await cache.match(DOCUMENT)) || fetch(request);
    return found || (await ofAnyVersion(request)) || fetch(request);
  };
  event.respondWith(kept());
});
