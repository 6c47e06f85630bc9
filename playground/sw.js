// Caches the playground on this device, so that it works offline. The build inserts the file names and a hash of their
// contents: each build has its own cache. Files loaded on demand are cached when first used; those in `soon` are loaded
// in the background once the page is idle.
const cache_name = "orb-playground-/*{hash}*/";
const core = /*{core}*/[];
const on_demand = /*{on_demand}*/[];
const soon = /*{soon}*/[];

self.addEventListener("install", event =>
  event.waitUntil(caches.open(cache_name).then(cache => cache.addAll(core.map(url => new Request(url, { cache: "no-cache" }))))));
// Open pages keep their version; a new build is used at the next visit.
self.addEventListener("activate", event => event.waitUntil((async () => {
  for (const name of await caches.keys())
    if (name.startsWith("orb-playground-") && name !== cache_name) await caches.delete(name);
  await self.clients.claim();
})()));

/** Caches what the page loaded before this worker took over, and what it may need offline. */
async function keep({ loaded, all }) {
  const cache = await caches.open(cache_name), { scope } = self.registration;
  const names = loaded.map(url => url.slice(scope.length)).filter(name => on_demand.includes(name));
  for (const name of new Set([...names, ...all ? soon : []]))
    if (!await cache.match(scope + name)) await cache.add(scope + name).catch(() => {}); // the next visit tries again
}
self.addEventListener("message", event => event.waitUntil(keep(event.data)));

const lacks = new Response(`<!doctype html><html lang="en"><meta charset="utf-8"><meta name="viewport" content="width=device-width"><title>orb</title><p>This page is not on this device yet: connect to the network once. <a href="${self.registration.scope}">Back to the playground</a>`,
  { status: 503, headers: { "content-type": "text/html; charset=utf-8" } });
async function answer(request) {
  const cache = await caches.open(cache_name);
  const url = new URL(request.url);
  url.hash = url.search = "";
  if (url.pathname.endsWith("/")) url.pathname += "index.html";
  const held = await cache.match(url.href);
  if (held) return held;
  const fetched = await fetch(request).catch(error => {
    if (request.mode === "navigate") return lacks.clone();
    throw error;
  });
  const name = url.href.slice(self.registration.scope.length);
  if (fetched.ok && (name.startsWith("docs/") || on_demand.includes(name))) await cache.put(url.href, fetched.clone());
  return fetched;
}
self.addEventListener("fetch", event => {
  if (event.request.method === "GET" && new URL(event.request.url).origin === location.origin) event.respondWith(answer(event.request));
});
