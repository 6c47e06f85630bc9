// Keeps the playground on this device, so that it works without a network. The build puts in the names
// of the files and a hash of all that is in them: another build has another cache. What is loaded on demand
// is kept once it was.
const cache_name = "orb-playground-/*{hash}*/";
const core = /*{core}*/[];
const on_demand = /*{on_demand}*/[];

self.addEventListener("install", event =>
  event.waitUntil(caches.open(cache_name).then(cache => cache.addAll(core.map(url => new Request(url, { cache: "no-cache" }))))));
// The pages that are open keep what they began with; a new build comes with the next visit.
self.addEventListener("activate", event => event.waitUntil((async () => {
  for (const name of await caches.keys())
    if (name.startsWith("orb-playground-") && name !== cache_name) await caches.delete(name);
  await self.clients.claim();
})()));

async function answer(request) {
  const cache = await caches.open(cache_name);
  const url = new URL(request.url);
  url.hash = url.search = "";
  if (url.pathname.endsWith("/")) url.pathname += "index.html";
  const held = await cache.match(url.href);
  if (held) return held;
  const fetched = await fetch(request);
  const name = url.href.slice(self.registration.scope.length);
  if (fetched.ok && (name.startsWith("docs/") || on_demand.includes(name))) await cache.put(url.href, fetched.clone());
  return fetched;
}
self.addEventListener("fetch", event => {
  if (event.request.method === "GET" && new URL(event.request.url).origin === location.origin) event.respondWith(answer(event.request));
});
