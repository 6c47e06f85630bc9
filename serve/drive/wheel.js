// The joystick: drives the robot while it is held, and stops it when it is let go.

const radius = 100;
const every = 100; // ms between commands while the stick is held
let held = null; // where it is held: { heading, speed }

export function post(path, body = "") {
  return fetch(path, { method: "POST", body }).catch(() => {});
}

function show(x, y) {
  for (const [name, value] of [["cx", x], ["cy", y]])
    document.getElementById("knob").setAttribute(name, value);
  for (const [name, value] of [["x2", x], ["y2", y]])
    document.getElementById("lead").setAttribute(name, value);
}

export function hold(x, y) {
  const way = Math.hypot(x, y);
  const part = Math.min(way / radius, 1);
  const scale = way > radius ? radius / way : 1;
  show(x * scale, y * scale);
  const heading = (Math.round((Math.atan2(x, -y) * 180) / Math.PI) + 360) % 360;
  held = { heading, speed: Math.round(part * document.getElementById("fastest").value) };
}

export function letGo() {
  held = null;
  show(0, 0);
  post("stop");
}

/// Repeats the command: if the page is gone, commands stop coming and the robot stops.
export function speak() {
  if (held !== null)
    post("drive", `${held.heading} ${held.speed}`);
}

export function readyWheel() {
  const stick = document.getElementById("stick");
  const at = (event) => {
    const box = stick.getBoundingClientRect();
    const unit = box.width / 220;
    return [(event.clientX - box.left) / unit - 110, (event.clientY - box.top) / unit - 110];
  };
  stick.addEventListener("pointerdown", (event) => {
    stick.setPointerCapture(event.pointerId);
    hold(...at(event));
    speak();
  });
  stick.addEventListener("pointermove", (event) => {
    if (held !== null && stick.hasPointerCapture(event.pointerId))
      hold(...at(event));
  });
  for (const end of ["pointerup", "pointercancel"])
    stick.addEventListener(end, letGo);
  const arrows = { ArrowUp: [0, -70], ArrowDown: [0, 70], ArrowLeft: [-70, 0], ArrowRight: [70, 0] };
  stick.addEventListener("keydown", (event) => {
    if (event.key === " ")
      letGo();
    else if (arrows[event.key] === undefined)
      return;
    else if (!event.repeat)
      hold(...arrows[event.key]);
    event.preventDefault();
  });
  stick.addEventListener("keyup", (event) => {
    if (arrows[event.key] !== undefined)
      letGo();
  });
  window.addEventListener("blur", () => {
    if (held !== null)
      letGo();
  });
  setInterval(speak, every);
}
