import { colour } from "./curves.js";

// The ground from above: where the robot went and is, in centimetres; ahead is up.

const path = [];

export function addToGround(x, y, heading) {
  const last = path[path.length - 1];
  if (last === undefined || Math.hypot(x - last[0], y - last[1]) > 0.5)
    path.push([x, y]);
  const canvas = document.getElementById("map");
  const pen = canvas.getContext("2d");
  const reach = path.reduce((most, [px, py]) => Math.max(most, Math.abs(px), Math.abs(py)), 50) * 1.15;
  const unit = canvas.width / 2 / reach;
  const at = (px, py) => [canvas.width / 2 + px * unit, canvas.height / 2 - py * unit];
  pen.clearRect(0, 0, canvas.width, canvas.height);
  pen.strokeStyle = colour("--rule");
  pen.fillStyle = colour("--soft");
  pen.font = "16px sans-serif";
  const step = reach > 250 ? 100 : reach > 100 ? 50 : 10;
  for (let cm = -Math.ceil(reach / step) * step; cm <= reach; cm += step) {
    pen.beginPath();
    pen.moveTo(...at(cm, -reach));
    pen.lineTo(...at(cm, reach));
    pen.moveTo(...at(-reach, cm));
    pen.lineTo(...at(reach, cm));
    pen.stroke();
  }
  pen.fillText(`${step} cm per square`, 8, canvas.height - 10);
  pen.strokeStyle = colour("--line");
  pen.lineWidth = 4;
  pen.beginPath();
  for (const [px, py] of path)
    pen.lineTo(...at(px, py));
  pen.stroke();
  pen.lineWidth = 1;
  const [bx, by] = at(x, y);
  const turn = (heading * Math.PI) / 180;
  pen.fillStyle = colour("--knob");
  pen.beginPath();
  pen.moveTo(bx + 18 * Math.sin(turn), by - 18 * Math.cos(turn));
  pen.arc(bx, by, 11, turn, turn + Math.PI);
  pen.fill();
}
