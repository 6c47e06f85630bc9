// The first script. The page is painted before anything else runs; then the slowest part, the engine, starts in
// parallel with the page's script. Messages of the workers and a pressed button are kept until that script listens.

function begun() {
  const worker = new Worker(new URL("./worker.js", import.meta.url), { type: "module" }), said = [];
  worker.onmessage = worker.onerror = event => said.push(event);
  return { worker, said };
}
let pressed = null;
const remember = ({ target }) => { pressed = target.closest("button") ?? pressed; };
document.addEventListener("click", remember);
// A page in the background gets no frames.
await new Promise(done => { requestAnimationFrame(() => setTimeout(done)); setTimeout(done, 200); });
globalThis.orb_workers = { language: begun(), machine: begun() };
await import("./page.js");
document.removeEventListener("click", remember);
pressed?.click();
