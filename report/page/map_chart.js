// The geometry of a map: the area it holds, the part in view, and centimetres in pixels.

import { others, playback } from "./playback.js";

export const view = { zoom: 1, x: 0, y: 0, follow: false, as_drawn: true };
/** What the maps hold: `box`, its corners; `also`, more places to show; `moved`, true if the ball moved; `mapped`, true if
 *  the map has a scale; `ahead`, the direction in the course's drawing that the ball faces at its start. */
export const area = { box: null, also: [], moved: false, mapped: false, ahead: [0, 1] };
const upright = [0, 1];
/** True if the ball's start heading is not up in the course's drawing. */
export const is_turned = () => area.ahead[1] < .9999;
const ahead = () => view.as_drawn ? area.ahead : upright;
/** Converts centimetres of the robot to centimetres of the map, to the right and up. */
function place(x, y) {
  const [right, up] = ahead();
  return [x * up + y * right, y * up - x * right];
}
/** How far the map is turned, clockwise, in degrees. */
export const turned_by = () => Math.atan2(...ahead()) * 180 / Math.PI;
/** The signs of the numbers on the vertical and horizontal lines of the map; null if the robot's axes do not lie
 *  along them. */
export function axis_signs() {
  const [right, up] = ahead();
  return Math.max(Math.abs(right), Math.abs(up)) > .9999 ? [Math.round(up + right), Math.round(up - right)] : null;
}

const least = list => list.reduce((a, b) => Math.min(a, b), list[0] ?? 0);
const most = list => list.reduce((a, b) => Math.max(a, b), list[0] ?? 0);
export function survey() {
  area.ahead = playback.main.run.course?.ahead ?? upright;
  const corners = playback.runs.flatMap(one => one.run.course ? [one.run.course] : []).flatMap(({ low, high }) => [low, high, [low[0], high[1]], [high[0], low[1]]]);
  const poses = [...playback.runs, ...others()].flatMap(({ pose }) => pose.x.map((x, i) => [x, pose.y[i]]));
  const places = [...poses, ...corners, ...area.also].map(([x, y]) => place(x, y));
  const x = places.map(([right]) => right), y = places.map(([, up]) => up);
  const [left, right, low, high] = [least(x), most(x), least(y), most(y)];
  area.box = { left, right, low, high, middle_x: (left + right) / 2, middle_y: (low + high) / 2 };
  const spread = axis => { const list = poses.map(one => one[axis]); return most(list) - least(list); };
  area.moved = spread(0) > 1 || spread(1) > 1;
  // A course already leaves enough space.
  const fits = corners.length > 0 && places.length > 0 && poses.every(([x, y]) => in_course(place(x, y), corners.map(([x, y]) => place(x, y))));
  if (playback.live && area.moved && !fits) grow_box();
  // A map with nothing but the ball has no scale.
  area.mapped = area.moved || area.also.length > 0 || playback.runs.some(one => one.run.course);
}

const in_course = ([right, up], corners) => corners.some(([x]) => x <= right) && corners.some(([x]) => x >= right) && corners.some(([, y]) => y <= up) && corners.some(([, y]) => y >= up);
const room_cm = 50; // around the start of a live run
/** Leaves space for what is to come, so that the map is seldom redrawn. */
function grow_box() {
  const { box } = area, more = Math.max(box.right - box.left, box.high - box.low) / 4;
  const left = Math.min(box.left - more, -room_cm), right = Math.max(box.right + more, room_cm);
  const low = Math.min(box.low - more, -room_cm), high = Math.max(box.high + more, room_cm);
  area.box = { left, right, low, high, middle_x: (left + right) / 2, middle_y: (low + high) / 2 };
}
/** True if the map does not hold the poses from `first` on. */
export function outgrown(first) {
  const { pose } = playback.main, { box } = area;
  for (let i = first; i < pose.t.length; ++i) {
    if (!area.moved && Math.hypot(pose.x[i] - pose.x[0], pose.y[i] - pose.y[0]) > 1) return true;
    const [right, up] = place(pose.x[i], pose.y[i]);
    if (area.moved && (right < box.left || right > box.right || up < box.low || up > box.high)) return true;
  }
  return false;
}

/** Centimetres between lines at least 64 pixels apart: 1, 2 or 5 times a power of ten. */
export function grid_step(scale) {
  const wanted = 64 / scale;
  const power = 10 ** Math.floor(Math.log10(wanted));
  return [1, 2, 5, 10].find(factor => factor * power >= wanted) * power;
}

/** Places the run `one` on an SVG element: `at` and `point` return pixels. */
export function make_chart(map) {
  const chart = {
    map, one: null, width: 0, height: 0, scale: 1, left: 0, top: 0,
    at(x, y) {
      const [right, up] = place(x, y);
      return { x: chart.left + right * chart.scale, y: chart.top - up * chart.scale };
    },
    point([x, y]) {
      const there = chart.at(x, y);
      return `${there.x.toFixed(1)} ${there.y.toFixed(1)}`;
    },
  };
  return chart;
}
/** Centres the view on `state`. */
export function look_at(state) {
  const [right, up] = place(state.x, state.y);
  view.x = right - area.box.middle_x;
  view.y = up - area.box.middle_y;
}
/** How many pixels of an element the numbers at its top and the key at its bottom cover; 0 if they are beside it. */
function covered(map, { top, bottom }) {
  const stage = map.closest(".stage"), box = name => stage.querySelector(name).getBoundingClientRect();
  const head = box(".stage-head"), key = box(".key");
  return [head.bottom - top, key.height ? bottom - key.top : 0].map(height => Math.max(0, Math.round(height)));
}
const numbers_px = 20; // of the row below
/** Fits the view into the element at its current size. */
export function measure(chart) {
  const size = chart.map.getBoundingClientRect();
  const width = Math.max(size.width, 50), height = Math.max(size.height, 50);
  const [above, under] = covered(chart.map, size), fills = above > 0 && !!chart.one.run.course; // a course has its own edges
  const below = fills ? numbers_px : under, free = Math.max(height - above - below, 50);
  const wide = Math.max(area.box.right - area.box.left, 20), tall = Math.max(area.box.high - area.box.low, 20);
  // Margins above and below what is drawn, and beside it.
  const edges = fills ? 12 : Math.min(above || below ? 48 : 84, free * .35), sides = fills ? 24 : 96;
  const fitting = Math.min((width - sides) / wide, (free - edges) / tall);
  const scale = Math.max(fitting, .02) * view.zoom;
  const state = chart.one.state_at(playback.now);
  const [right, up] = view.follow ? place(state.x, state.y) : [area.box.middle_x + view.x, area.box.middle_y + view.y];
  Object.assign(chart, { width, height, scale, left: width / 2 - right * scale, top: above + free / 2 + up * scale });
}

const far = 1e5; // centimetres: beyond what any map shows
/** The walls as lines in pixels; endless walls are only long. */
export const wall_lines = chart => chart.one.run.walls.map(wall => {
  const from = wall.from ?? (wall.axis === "x" ? [wall.at, -far] : [-far, wall.at]);
  const to = wall.to ?? (wall.axis === "x" ? [wall.at, far] : [far, wall.at]);
  const a = chart.at(...from), b = chart.at(...to);
  return { x1: a.x, y1: a.y, x2: b.x, y2: b.y, endless: !wall.from };
});
/** True if a line meets a box, in pixels. */
export function meets({ x1, y1, x2, y2 }, { left, right, high, low }) {
  let enter = 0, leave = 1;
  for (const [start, way, from, to] of [[x1, x2 - x1, left, right], [y1, y2 - y1, high, low]]) {
    if (way === 0) { if (start < from || start > to) return false; continue; }
    const a = (from - start) / way, b = (to - start) / way;
    enter = Math.max(enter, Math.min(a, b));
    leave = Math.min(leave, Math.max(a, b));
  }
  return enter <= leave;
}
export const grown = ({ left, right, high, low }, by) => ({ left: left - by, right: right + by, high: high - by, low: low + by });
export const overlap = (a, b) => a.left < b.right && a.right > b.left && a.high < b.low && a.low > b.high;
