// Values over time.

import { $, clamp, css_color, element, last_at, shape, trim } from "./dom.js";
import { column, sums } from "./journey.js";
import { playback, seek, watch } from "./playback.js";

let lanes = [];
/** `series`: [{name, t, v, digits}]; `cyclic`: 360 if a value wraps around; `between(state)`: the value between
 *  two poses, if values are not held; `other`: the same series of the run before. */
function add_lane({ id, name, unit, series, cyclic, low, high, held, between, other }) {
  const values = [...series, ...other ? [other] : []].flatMap(one => one.v.length ? [one.v.reduce((a, b) => Math.min(a, b)), one.v.reduce((a, b) => Math.max(a, b))] : [0]);
  let from = low ?? Math.min(...values), to = high ?? Math.max(...values);
  if (to - from < 1e-9) { to += 1; from -= low === undefined ? 1 : 0; }
  const lane = element("div", { class: series.length === 1 ? "lane one" : "lane", "data-lane": id });
  const words = element("div", { class: "lane-words" });
  words.append(element("b", {}, unit ? `${name} (${unit})` : name));
  const outputs = series.map((one, i) => {
    const line = element("span");
    line.append(element("i", { class: `s${i}` }, series.length > 1 ? one.name : "now"));
    const output = element("output", { "data-series": one.name, "aria-live": "off" });
    line.append(output);
    words.append(line);
    return output;
  });
  const plot = element("div", { class: "lane-plot" });
  const art = shape("svg", { preserveAspectRatio: "none", role: "img", "aria-label": `${name}, ${trim(from, 1)} to ${trim(to, 1)} ${unit}` }, plot);
  const playhead = element("div", { class: "playhead" });
  plot.append(playhead);
  lane.append(words, plot);
  $("lanes").append(lane);
  const made = { plot, art, playhead, outputs, series, from, to, cyclic, held, between, other };
  plot.addEventListener("pointerdown", event => scrub(event, plot));
  lanes.push(made);
}
function scrub(event, plot) {
  const area = plot.getBoundingClientRect();
  const go = to => seek(clamp((to.clientX - area.left) / area.width, 0, 1) * playback.end);
  go(event);
  plot.setPointerCapture(event.pointerId);
  plot.addEventListener("pointermove", go);
  for (const name of ["pointerup", "pointercancel"])
    plot.addEventListener(name, () => plot.removeEventListener("pointermove", go), { once: true });
}
function draw_lane(lane) {
  const width = Math.max(lane.plot.clientWidth, 40), height = 66;
  lane.art.setAttribute("viewBox", `0 0 ${width} ${height}`);
  lane.art.replaceChildren();
  const y = value => (height - 9 - (value - lane.from) / (lane.to - lane.from) * (height - 18)).toFixed(1);
  const x = t => t / playback.end * width;
  const ticks = tick_times(width);
  for (const t of ticks) shape("path", { d: `M${x(t).toFixed(1)} 0V${height}`, class: "grid-line" }, lane.art);
  if (lane.from < 0 && lane.to > 0) shape("path", { d: `M0 ${y(0)}H${width}`, class: "grid-line strong" }, lane.art);
  const curve = (one, look) => {
    let d = "", previous = null, last_x = -9;
    for (let i = 0; i < one.t.length; ++i) {
      const here = x(one.t[i]);
      if (i && i < one.t.length - 1 && here - last_x < .35 && Math.abs(one.v[i] - previous) * 60 < lane.to - lane.from) continue;
      const wraps = lane.cyclic && previous !== null && Math.abs(one.v[i] - previous) > lane.cyclic / 2;
      const gap = previous !== null && !lane.held && one.t[i] - one.t[i - 1] > playback.main.run.pose.step * 1.5;
      if (gap || (lane.held && previous !== null)) d += `H${here.toFixed(1)}`;
      d += `${previous === null || wraps ? "M" : "L"}${here.toFixed(1)} ${y(one.v[i])}`;
      previous = one.v[i];
      last_x = here;
    }
    if (d) d += `H${width}`;
    shape("path", { d: d || "M0 0", class: `line ${look}` }, lane.art);
  };
  if (lane.other) curve(lane.other, "before");
  lane.series.forEach((one, k) => curve(one, `s${k}`));
  shape("text", { x: 4, y: 10 }, lane.art).textContent = trim(lane.to, 1);
  shape("text", { x: 4, y: height - 3 }, lane.art).textContent = trim(lane.from, 1);
}
function tick_times(width) {
  const wanted = playback.end / Math.max(width / 90, 1);
  const steps = [.05, .1, .2, .5, 1, 2, 5, 10, 15, 30, 60, 120, 300, 600, 1800, 3600, 7200, 36000].map(s => s * 1e6);
  const by = steps.find(one => one >= wanted) ?? 36e9;
  const list = [];
  for (let t = by; t < playback.end; t += by) list.push(t);
  return list;
}
function draw_axis() {
  const axis = $("axis");
  const width = Math.max(axis.clientWidth, 40);
  axis.replaceChildren();
  const art = shape("svg", { viewBox: `0 0 ${width} 30` }, axis);
  for (const t of tick_times(width)) {
    const words = t >= 60e6 ? `${Math.floor(t / 60e6)}:${String(Math.round(t % 60e6 / 1e6)).padStart(2, "0")}` : `${trim(t / 1e6, 2)} s`;
    shape("text", { x: t / playback.end * width, y: 19, "text-anchor": "middle" }, art).textContent = words;
  }
}
export function draw_lanes() {
  lanes.forEach(draw_lane);
  draw_axis();
}
function show_lanes(state) {
  const share = `${playback.now / playback.end * 100}%`;
  for (const lane of lanes) {
    lane.playhead.style.left = share;
    lane.series.forEach((one, k) => {
      const i = last_at(one.t, playback.now);
      const value = lane.between ? lane.between(state) : i < 0 ? 0 : one.v[i];
      lane.outputs[k].textContent = value.toFixed(one.digits);
    });
  }
}
watch(show_lanes);
function add_axis() {
  const row = element("div", { class: "lane thin" });
  const words = element("div", { class: "lane-words" });
  words.append(element("b", {}, "Time"));
  const plot = element("div", { class: "lane-plot", id: "axis", "aria-hidden": "true" });
  row.append(words, plot);
  $("lanes").append(row);
  plot.addEventListener("pointerdown", event => scrub(event, plot));
}
export function list_lanes() {
  const { run, pose, backled } = playback.main;
  lanes = [];
  $("lanes").replaceChildren();
  add_axis();
  add_lane({ id: "speed", name: "Speed", unit: "cm/s", low: 0, between: state => state.speed, other: playback.before && { t: playback.before.pose.t, v: playback.before.pose.speed }, series: [{ name: "speed", t: pose.t, v: pose.speed, digits: 1 }] });
  add_lane({ id: "heading", name: "Heading", unit: "°", low: 0, high: 360, cyclic: 360, between: state => state.heading, other: playback.before && { t: playback.before.pose.t, v: playback.before.pose.heading }, series: [{ name: "heading", t: pose.t, v: pose.heading, digits: 1 }] });
  if (backled.t.length)
    add_lane({ id: "backled", name: "Aiming light", unit: "", low: 0, high: 255, held: true, series: [{ name: "backLED", t: backled.t, v: backled.value, digits: 0 }] });
  for (const group of run.sensors) {
    const t = sums(group.t);
    add_lane({ id: group.id, name: group.name, unit: group.unit, held: true,
      series: group.series.map(one => ({ name: one.name, t, v: column(one.v, one.scale), digits: one.digits })) });
  }
}

/** Draws the track under the slider: the colours over time, and bumps and errors. */
export function draw_track() {
  const art = $("track"), width = 1000, { led, run } = playback.main;
  art.replaceChildren();
  art.setAttribute("viewBox", `0 0 ${width} 10`);
  const x = t => clamp(t / playback.end * width, 0, width);
  // If colours change several times within a pixel, draw only some.
  const places = led.t.map(x);
  let last = -1;
  const seen = [...places.keys()].filter(i => {
    const is_seen = places[i] - last >= 1 || (places[i + 1] ?? width) - places[i] >= 1;
    if (is_seen) last = places[i];
    return is_seen;
  });
  seen.forEach((at, n) => {
    if (!led.rgb[at]) return;
    const from = places[at], until = places[seen[n + 1]] ?? width;
    shape("rect", { x: from.toFixed(2), y: 0, width: Math.max(until - from, .25).toFixed(2), height: 10, fill: css_color(led.rgb[at]), "shape-rendering": "crispEdges" }, art);
  });
  for (const event of run.events)
    if (event.kind === "bump" || event.kind === "error")
      for (const look of ["tick below", "tick"])
        shape("path", { d: `M${x(event.t).toFixed(2)} 0V10`, class: look, "data-tick": event.kind, "vector-effect": "non-scaling-stroke" }, art);
}
