// A curve for each value that the robot reports, over the last half minute.

const seconds = 30;
const curves = new Map();

export const colour = (name) => getComputedStyle(document.documentElement).getPropertyValue(name);

function make(name, unit) {
  const box = document.createElement("div");
  box.className = "curve";
  const line = document.createElement("p");
  const label = document.createElement("span");
  label.textContent = unit === "" ? name : `${name}, ${unit}`;
  const value = document.createElement("b");
  line.append(label, value);
  const canvas = document.createElement("canvas");
  canvas.width = 440;
  canvas.height = 90;
  box.append(line, canvas);
  document.getElementById("curves").append(box);
  return { canvas, value, points: [] };
}

function draw(curve, now) {
  const { canvas, points } = curve;
  const pen = canvas.getContext("2d");
  pen.clearRect(0, 0, canvas.width, canvas.height);
  let low = Infinity;
  let high = -Infinity;
  for (const [, value] of points) {
    low = Math.min(low, value);
    high = Math.max(high, value);
  }
  const middle = (low + high) / 2;
  const span = Math.max(high - low, Math.abs(middle) * 0.1, 0.1) * 1.1;
  const x = (t) => canvas.width * (1 - (now - t) / seconds);
  const y = (value) => canvas.height * (0.5 - (value - middle) / span);
  pen.strokeStyle = colour("--line");
  pen.lineWidth = 2;
  pen.beginPath();
  for (const [t, value] of points)
    pen.lineTo(x(t), y(value));
  pen.stroke();
}

/// `values`: [name, unit, number] of each sensor.
export function addToCurves(t, values) {
  for (const [name, unit, number] of values) {
    if (!curves.has(name))
      curves.set(name, make(name, unit));
    const curve = curves.get(name);
    curve.points.push([t, number]);
    while (curve.points[0][0] < t - seconds)
      curve.points.shift();
    curve.value.textContent = number.toFixed(Math.abs(number) < 10 ? 2 : 0);
    draw(curve, t);
  }
}
