// The first script. What takes longest begins before the page's own script is read, and the page is seen before that
// script runs. What the workers say until then is kept for it, and so is the button that somebody has pressed.

function begun() {
  const worker = new Worker(new URL("./worker.js", import.meta.url), { type: "module" }), said = [];
  worker.onmessage = worker.onerror = event => said.push(event);
  return { worker, said };
}
globalThis.orb_workers = { language: begun(), machine: begun() };

let pressed = null;
const remember = ({ target }) => { pressed = target.closest("button") ?? pressed; };
document.addEventListener("click", remember);
// A page in the background draws no frames.
await new Promise(done => { requestAnimationFrame(() => setTimeout(done)); setTimeout(done, 200); });
await import("./page.js");
document.removeEventListener("click", remember);
pressed?.click();
