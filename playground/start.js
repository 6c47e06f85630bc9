// The first script. The page is seen before anything else runs; then what takes longest, the engine, begins beside the
// page's own script. What the workers say until that listens is kept, and so is the button that somebody has pressed.

function begun() {
  const worker = new Worker(new URL("./worker.js", import.meta.url), { type: "module" }), said = [];
  worker.onmessage = worker.onerror = event => said.push(event);
  return { worker, said };
}
let pressed = null;
const remember = ({ target }) => { pressed = target.closest("button") ?? pressed; };
document.addEventListener("click", remember);
// A page in the background draws no frames.
await new Promise(done => { requestAnimationFrame(() => setTimeout(done)); setTimeout(done, 200); });
globalThis.orb_workers = { language: begun(), machine: begun() };
await import("./page.js");
document.removeEventListener("click", remember);
pressed?.click();
