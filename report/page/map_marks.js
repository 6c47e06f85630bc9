// Signs and words on the map, and what they mean.

import { $, element, seconds, shape } from "./dom.js";
import { area } from "./map_chart.js";
import { wall_pixels } from "./map_ground.js";
import { playback } from "./playback.js";

const hit_path = "M-5 -5L5 5M-5 5L5 -5";
export const mark_art = {
  __proto__: null,
  start: g => shape("circle", { r: 8, class: "mark-start" }, g),
  end: g => shape("rect", { x: -5, y: -5, width: 10, height: 10, class: "mark-end" }, g),
  bump: g => shape("circle", { r: 6, class: "mark-hit" }, g),
  collision: g => shape("path", { d: hit_path, class: "mark-hit" }, g),
  marker: g => shape("path", { d: "M0 -6L6 0L0 6L-6 0Z", class: "mark-marker" }, g),
  error: g => shape("path", { d: "M0 -8L8 6H-8Z", class: "mark-error" }, g),
};

const segments = chart => chart.one.run.walls.filter(wall => wall.from).map(({ from, to }) => [chart.px(from[0]), chart.py(from[1]), chart.px(to[0]), chart.py(to[1])]);
/** Whether a line meets a rectangle. */
function meets([x1, y1, x2, y2], left, right, high, low) {
  let enter = 0, leave = 1;
  for (const [start, way, least, most] of [[x1, x2 - x1, left, right], [y1, y2 - y1, high, low]]) {
    if (way === 0) { if (start < least || start > most) return false; continue; }
    const a = (least - start) / way, b = (most - start) / way;
    enter = Math.max(enter, Math.min(a, b));
    leave = Math.min(leave, Math.max(a, b));
  }
  return enter <= leave;
}
/** Where a word beside a point meets the fewest of path, walls, marks and words. */
function free_place(chart, x, y, words, taken) {
  const wide = 6.4 * words.length, tall = 12;
  const places = [[18, 4], [-18 - wide, 4], [16, -12], [16, 20], [-16 - wide, -12], [-16 - wide, 20], [-wide / 2, -24], [-wide / 2, 34]];
  const cost = ([dx, dy]) => {
    const left = x + dx - 3, right = left + wide + 6, low = y + dy + 4, high = low - tall - 4;
    const inside = (a, b) => a > left && a < right && b > high && b < low;
    let sum = left < 2 || right > chart.width - 2 || high < 2 || low > chart.height - 2 ? 1e6 : 0;
    for (let i = 0; i < chart.one.pose.t.length; ++i) if (inside(chart.px(chart.one.pose.x[i]), chart.py(chart.one.pose.y[i]))) ++sum;
    for (const wall of wall_pixels(chart, "x")) if (wall > left - 3 && wall < right + 3) sum += 500;
    for (const wall of wall_pixels(chart, "y")) if (wall > high - 3 && wall < low + 3) sum += 500;
    for (const wall of segments(chart)) if (meets(wall, left, right, high, low)) sum += 500;
    for (const one of taken) if (one.left < right && one.right > left && one.high < low && one.low > high) sum += 1000;
    return sum;
  };
  const best = places.map(place => [cost(place), place]).reduce((a, b) => b[0] < a[0] ? b : a)[1];
  taken.push({ left: x + best[0], right: x + best[0] + wide, high: y + best[1] - tall, low: y + best[1] + 4 });
  return best;
}
export function draw_marks(chart, parent) {
  const taken = [];
  const pin = (x, y, kind, title) => {
    const group = shape("g", { transform: `translate(${chart.px(x).toFixed(1)} ${chart.py(y).toFixed(1)})`, "data-mark": kind }, parent);
    if (title) shape("title", {}, group).textContent = title;
    mark_art[kind](group);
    taken.push({ left: chart.px(x) - 8, right: chart.px(x) + 8, high: chart.py(y) - 8, low: chart.py(y) + 8 });
    return group;
  };
  // Marks in one place share their words.
  const labels = new Map();
  for (const event of chart.one.run.events) {
    if (event.x === undefined || !event.short) continue;
    const place = `${chart.px(event.x).toFixed(0)} ${chart.py(event.y).toFixed(0)}`;
    if (!labels.has(place)) labels.set(place, { x: event.x, y: event.y, words: [] });
    labels.get(place).words.push(event.short);
  }
  const word = (x, y, words) => {
    const [dx, dy] = free_place(chart, chart.px(x), chart.py(y), words, taken);
    shape("text", { x: chart.px(x) + dx, y: chart.py(y) + dy, class: "mark-word" }, parent).textContent = words;
  };
  for (const event of chart.one.run.events) {
    if (event.x === undefined || !mark_art[event.kind]) continue;
    pin(event.x, event.y, event.kind, `${seconds(event.t)} s: ${event.text}`);
  }
  const some = list => list.length > 4 ? [...list.slice(0, 3), "…"] : list;
  if (labels.size < 40) for (const { x, y, words } of labels.values()) word(x, y, some(words).join(", "));
  if (!chart.one.pose.t.length) return;
  const final = chart.one.pose.t.length - 1;
  pin(chart.one.pose.x[0], chart.one.pose.y[0], "start");
  if (!area.moved) return;
  if (!playback.live) pin(chart.one.pose.x[final], chart.one.pose.y[final], "end");
  word(chart.one.pose.x[0], chart.one.pose.y[0], "start");
  if (!playback.live) word(chart.one.pose.x[final], chart.one.pose.y[final], "end");
}

const legend_words = { start: "start", end: "end", bump: "ran into a wall", collision: "collision reported", marker: "marker", error: "error" };
export function list_signs() {
  $("legend").replaceChildren();
  for (const [kind, words] of Object.entries(legend_words)) {
    const seen = kind === "start" ? playback.main.pose.t.length : kind === "end" ? area.moved && !playback.live : playback.runs.some(one => one.run.events.some(event => event.kind === kind && event.x !== undefined));
    if (!seen) continue;
    const item = element("li", { "data-sign": kind });
    mark_art[kind](shape("svg", { viewBox: "-10 -10 20 20", "aria-hidden": "true" }, item));
    item.append(words);
    $("legend").append(item);
  }
  for (const [sign, words, seen] of [["wall", "wall", playback.runs.some(one => one.run.walls.length)], ["zone", "zone", playback.runs.some(one => one.run.course?.zones.length)], ["run unlit", "LED off", playback.runs.some(one => one.stretches.some(stretch => !stretch.color))]]) {
    if (!seen) continue;
    const item = element("li", { "data-sign": sign.split(" ").pop() });
    shape("path", { d: "M-9 0H9", class: sign, "stroke-width": 2.5 }, shape("svg", { viewBox: "-10 -10 20 20", "aria-hidden": "true" }, item));
    item.append(words);
    $("legend").append(item);
  }
}
