// Where things lie on a map: the area it holds, the part that is looked at, centimetres in pixels.

import { playback } from "./playback.js";

export const view = { zoom: 1, x: 0, y: 0, follow: false };
const least = list => list.reduce((a, b) => Math.min(a, b), list[0] ?? 0);
const most = list => list.reduce((a, b) => Math.max(a, b), list[0] ?? 0);
/** What the maps hold: its corners, whether the ball moved, and whether there is anything to measure by. */
export const area = { box: null, moved: false, mapped: false };
export function survey() {
  const corners = playback.runs.flatMap(one => one.run.course ? [one.run.course.low, one.run.course.high] : []);
  const x = playback.runs.flatMap(one => one.pose.x).concat(corners.map(corner => corner[0]));
  const y = playback.runs.flatMap(one => one.pose.y).concat(corners.map(corner => corner[1]));
  const [left, right, low, high] = [least(x), most(x), least(y), most(y)];
  area.box = { left, right, low, high, middle_x: (left + right) / 2, middle_y: (low + high) / 2 };
  const spread = axis => { const list = playback.runs.flatMap(one => one.pose[axis]); return most(list) - least(list); };
  area.moved = spread("x") > 1 || spread("y") > 1;
  // A map has a scale where something lies on it; else it shows the ball alone.
  area.mapped = area.moved || playback.runs.some(one => one.run.course);
}

/** 1, 2 or 5 times a power of ten: lines stand at least 64 pixels apart. */
export function grid_step(scale) {
  const wanted = 64 / scale;
  const power = 10 ** Math.floor(Math.log10(wanted));
  return [1, 2, 5, 10].find(factor => factor * power >= wanted) * power;
}

/** How the run `one` lies on an SVG element: `px`, `py` and `point` say where, in pixels. */
export function make_chart(map) {
  const chart = {
    map, one: null, width: 0, height: 0, scale: 1, left: 0, top: 0,
    px: x => chart.left + x * chart.scale,
    py: y => chart.top - y * chart.scale,
    point: ([x, y]) => `${chart.px(x).toFixed(1)} ${chart.py(y).toFixed(1)}`,
  };
  return chart;
}
/** Fits what is looked at into the element, whatever size that has now. */
export function measure(chart) {
  const size = chart.map.getBoundingClientRect();
  const width = Math.max(size.width, 50), height = Math.max(size.height, 50);
  const wide = Math.max(area.box.right - area.box.left, 20), tall = Math.max(area.box.high - area.box.low, 20);
  const fitting = Math.min((width - 96) / wide, (height - 84) / tall);
  const scale = Math.max(fitting, .02) * view.zoom;
  const center = view.follow ? chart.one.state_at(playback.now) : { x: area.box.middle_x + view.x, y: area.box.middle_y + view.y };
  Object.assign(chart, { width, height, scale, left: width / 2 - center.x * scale, top: height / 2 + center.y * scale });
}
