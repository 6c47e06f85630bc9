import { post } from "./wheel.js";

// The matrix: shows what the robot's matrix shows; dragging over it paints.

const side = 8;
const settled = 400; // ms for which painting here overrides what the robot reports
const lamps = new Map(); // by x and y, counted from the bottom left
let paintedAt = 0;
let stroke = null; // the lamps that this drag has painted

const lampAt = (x, y) => lamps.get(`${x} ${y}`);

/// `#ff8000` as `255 128 0`.
export const numbersOf = (hex) => [1, 3, 5].map((at) => parseInt(hex.slice(at, at + 2), 16)).join(" ");

function setLamp(lamp, hex) {
  if (lamp.dataset.color === hex)
    return;
  lamp.dataset.color = hex;
  lamp.style.background = hex === "#000000" ? "" : hex;
  lamp.setAttribute("aria-label", `${lamp.dataset.x}, ${lamp.dataset.y}: ${hex === "#000000" ? "dark" : hex}`);
}

function paint(lamp) {
  const hex = document.getElementById("pen").value;
  paintedAt = performance.now();
  setLamp(lamp, hex);
  post("pixel", `${lamp.dataset.x} ${lamp.dataset.y} ${numbersOf(hex)}`);
}

/// Focuses a lamp. Arrow keys start from it, and Tab stops only there.
function lookAt(lamp) {
  for (const other of lamps.values())
    other.tabIndex = other === lamp ? 0 : -1;
  lamp.focus({ preventScroll: stroke !== null }); // do not scroll under a pointer
}

function drag(event) {
  const lamp = document.elementFromPoint(event.clientX, event.clientY)?.closest("#lamps button");
  if (stroke === null || !lamp || stroke.has(lamp))
    return;
  stroke.add(lamp);
  paint(lamp);
}

/// `pixels`: RRGGBB of each lamp, row by row from the bottom left; undefined if the robot has no matrix.
export function showMatrix(pixels) {
  document.getElementById("matrix").hidden = pixels === undefined;
  if (pixels === undefined || stroke !== null || performance.now() - paintedAt < settled)
    return;
  for (const lamp of lamps.values()) {
    const at = 6 * (side * Number(lamp.dataset.y) + Number(lamp.dataset.x));
    setLamp(lamp, `#${pixels.slice(at, at + 6).toLowerCase()}`);
  }
}

export function readyMatrix() {
  const grid = document.getElementById("lamps");
  for (let y = side - 1; y >= 0; --y)
    for (let x = 0; x < side; ++x) {
      const lamp = document.createElement("button");
      lamp.type = "button";
      Object.assign(lamp.dataset, { x, y });
      lamp.tabIndex = lamps.size === 0 ? 0 : -1;
      lamps.set(`${x} ${y}`, lamp);
      setLamp(lamp, "#000000");
      grid.append(lamp);
    }
  grid.addEventListener("pointerdown", (event) => {
    if (event.button !== 0 || !event.target.closest("button"))
      return;
    event.preventDefault(); // select nothing on the way
    grid.setPointerCapture(event.pointerId);
    stroke = new Set();
    lookAt(event.target.closest("button"));
    drag(event);
  });
  grid.addEventListener("pointermove", drag);
  for (const end of ["pointerup", "pointercancel"])
    grid.addEventListener(end, () => { stroke = null; });
  grid.addEventListener("click", (event) => {
    const lamp = event.target.closest("button");
    if (lamp && event.detail === 0) // from a key: a pointer has painted already
      paint(lamp);
  });
  const ways = { ArrowUp: [0, 1], ArrowDown: [0, -1], ArrowLeft: [-1, 0], ArrowRight: [1, 0] };
  grid.addEventListener("keydown", (event) => {
    const way = ways[event.key];
    const { x, y } = event.target.dataset;
    if (way === undefined)
      return;
    event.preventDefault();
    const next = lampAt(Number(x) + way[0], Number(y) + way[1]);
    if (next)
      lookAt(next);
  });
  document.getElementById("clear").addEventListener("click", () => post("clear"));
  document.getElementById("say").addEventListener("submit", (event) => {
    event.preventDefault();
    post("text", `${numbersOf(document.getElementById("pen").value)} ${document.getElementById("text").value}`);
  });
}
