// Signs and words on the map, and what they mean.

import { $, element, seconds, shape } from "./dom.js";
import { area, grown, meets, overlap } from "./map_chart.js";
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

/** Finds the place beside a point where a word meets least of path, walls, marks and words. */
function free_place(chart, x, y, words, { taken, borders }) {
  const wide = 6.4 * words.length, tall = 12, beside = playback.ball_px + 5;
  const places = [[beside, 4], [-beside - wide, 4], [16, -12], [16, 20], [-16 - wide, -12], [-16 - wide, 20], [-wide / 2, -24], [-wide / 2, 34]];
  const { pose } = chart.one;
  const cost = ([dx, dy]) => {
    const place = { left: x + dx - 3, right: x + dx + wide + 3, high: y + dy - tall, low: y + dy + 4 };
    let sum = place.left < 2 || place.right > chart.width - 2 || place.high < 2 || place.low > chart.height - 2 ? 1e6 : 0;
    for (let i = 0; i < pose.t.length; ++i) {
      const there = chart.at(pose.x[i], pose.y[i]);
      if (there.x > place.left && there.x < place.right && there.y > place.high && there.y < place.low) ++sum;
    }
    for (const line of borders) if (meets(line, grown(place, 3))) sum += 500;
    for (const one of taken) if (overlap(one, place)) sum += 1000;
    return sum;
  };
  const best = places.map(place => [cost(place), place]).reduce((a, b) => b[0] < a[0] ? b : a)[1];
  taken.push({ left: x + best[0], right: x + best[0] + wide, high: y + best[1] - tall, low: y + best[1] + 4 });
  return best;
}
function draw_sign(chart, parent, x, y, kind, title) {
  const group = shape("g", { transform: `translate(${chart.point([x, y])})`, "data-mark": kind }, parent);
  if (title) shape("title", {}, group).textContent = title;
  mark_art[kind](group);
  return group;
}
/** Draws the sign of an event, if it has one. */
export function draw_event(chart, parent, event) {
  if (event.x === undefined || !mark_art[event.kind]) return null;
  return draw_sign(chart, parent, event.x, event.y, event.kind, `${seconds(event.t)} s: ${event.text}`);
}
/** `floor`: what words should avoid: boxes that are taken, and borders. */
export function draw_marks(chart, parent, floor) {
  const { taken } = floor;
  const take = (x, y) => {
    const there = chart.at(x, y);
    taken.push({ left: there.x - 8, right: there.x + 8, high: there.y - 8, low: there.y + 8 });
  };
  const pin = (x, y, kind) => {
    draw_sign(chart, parent, x, y, kind);
    take(x, y);
  };
  // Marks in one place share a label.
  const labels = new Map();
  for (const event of chart.one.run.events) {
    if (event.x === undefined || !event.short) continue;
    const there = chart.at(event.x, event.y), place = `${there.x.toFixed(0)} ${there.y.toFixed(0)}`;
    if (!labels.has(place)) labels.set(place, { x: event.x, y: event.y, words: [] });
    labels.get(place).words.push(event.short);
  }
  const word = (x, y, words) => {
    const there = chart.at(x, y), [dx, dy] = free_place(chart, there.x, there.y, words, floor);
    shape("text", { x: there.x + dx, y: there.y + dy, class: "mark-word" }, parent).textContent = words;
  };
  for (const event of chart.one.run.events) if (draw_event(chart, parent, event)) take(event.x, event.y);
  if (playback.live) labels.clear(); // words are placed when it has ended
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
    item.append(kind === "bump" && playback.room.length ? "ran into a wall or a ball" : words);
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
