// The path of the ball, and the ball.

import { brightness, css_color, shape } from "./dom.js";
import { area, turned_by } from "./map_chart.js";
import { draw_lamps, light } from "./matrix.js";
import { playback } from "./playback.js";

function line_from(chart, from, to) {
  const { pose } = chart.one, at = i => chart.point([pose.x[i], pose.y[i]]);
  let d = `M${at(from)}`;
  for (let i = from + 1; i <= to; ++i) d += `L${at(i)}`;
  return d;
}
/** The line of a whole stroke, and of its part up to the ball. */
const line_of = (chart, { pieces }) => pieces.map(({ from, to }) => line_from(chart, from, to)).join("");
const line_until = (chart, { pieces }, { index, x, y }) => pieces.filter(({ from }) => from <= index)
  .map(({ from, to }) => to <= index ? line_from(chart, from, to) : `${line_from(chart, from, index)}L${chart.point([x, y])}`).join("");

const alone = stretch => Object.assign(stretch, { pieces: [stretch] });
const most_strokes = 600, groups = 150, palette = 4; // of a run so long that its stretches are drawn together
/** One stroke for each stretch; if there are many, one for each of a few colours in each group of successive stretches. */
function strokes_of(stretches) {
  if (stretches.length <= most_strokes) return stretches.map(alone);
  const long = Math.ceil(stretches.length / groups), strokes = [];
  for (let begin = 0; begin < stretches.length; begin += long) {
    const own = new Map();
    for (const stretch of stretches.slice(begin, begin + long)) {
      const color = own.has(stretch.color) || own.size < palette ? stretch.color : nearest(stretch.color, [...own.keys()]);
      if (!own.has(color)) own.set(color, { color, from: stretch.from, to: stretch.to, pieces: [] });
      own.get(color).pieces.push(stretch);
      own.get(color).to = stretch.to;
    }
    strokes.push(...own.values());
  }
  return strokes;
}
const channels = rgb => [rgb >> 16, rgb >> 8 & 255, rgb & 255];
function nearest(color, some) {
  const far = other => channels(other).reduce((sum, value, i) => sum + (value - channels(color)[i]) ** 2, 0);
  return some.reduce((a, b) => far(b) < far(a) ? b : a);
}
/** Draws the whole path, faded; draw_progress() lays the part before the moment shown over it. */
export function draw_path(chart, parent = chart.map) {
  for (const old of chart.map.parentElement.querySelectorAll(".ground")) old.remove();
  const ahead = shape("g", { class: "ahead" }, parent);
  const halos = shape("g", { class: "halo" }, parent);
  const kept = kept_in(playback.live ? ground_of(chart) : parent);
  const fresh = shape("g", {}, parent);
  const { stretches } = chart.one, whole = playback.live ? stretches.slice(0, -1) : stretches; // the last may still grow
  chart.path = { ahead, halos, ...kept, fresh, strokes: strokes_of(whole), taken: whole.length, drawn: 0, past: 0, kept: 0 };
  draw_stretches(chart);
}
const kept_in = parent => {
  const dark = shape("g", {}, parent); // unlit stretches lie below lit ones
  return { dark, casings: shape("g", {}, parent), done: shape("g", {}, parent) };
};
const most_kept = 120; // stretches in one layer
const most_looks = 16; // colours or kinds in one layer
/** Joins finished stretches into one line for each look. Longer lines would be slow to paint. */
function fold_kept({ dark, casings, done }) {
  for (const layer of [dark, casings, done]) {
    const looks = new Map();
    for (const line of [...layer.children]) {
      const own = line.getAttribute("stroke") ?? line.getAttribute("class");
      const look = looks.has(own) || looks.size < most_looks ? own : css_color(nearest(rgb_of(own), [...looks.keys()].map(rgb_of)));
      const held = looks.get(look);
      if (!held) {
        looks.set(look, line);
        continue;
      }
      held.setAttribute("d", held.getAttribute("d") + line.getAttribute("d"));
      line.remove();
    }
  }
}
const rgb_of = color => parseInt(color.slice(1), 16);
/** Moves a finished stretch of a live run to the ground. */
function keep_stretch(chart, stretch) {
  const { path } = chart, { layers, color } = stretch, [line, casing] = [...layers].reverse();
  stretch.state = "kept";
  if (++path.kept % most_kept === 0) {
    fold_kept(path);
    Object.assign(path, kept_in(ground_of(chart)));
  }
  (color ? path.done : path.dark).append(line);
  if (casing) path.casings.append(casing);
}
/** Adds a layer behind the map of a live run, which is not repainted with each frame. */
function ground_of(chart) {
  const ground = shape("svg", { class: "ground", "aria-hidden": "true", viewBox: chart.map.getAttribute("viewBox") });
  chart.map.before(ground);
  return ground;
}
/** Draws the stretches that are not drawn yet. */
export function draw_stretches(chart) {
  const { path, one: { stretches } } = chart, { strokes } = path;
  for (; path.taken < stretches.length; ++path.taken) strokes.push(alone(stretches[path.taken]));
  for (; path.drawn < strokes.length; ++path.drawn) draw_stretch(chart, strokes[path.drawn]);
}
const casing_class = color => brightness(color) > .7 ? "run casing pale" : brightness(color) < .2 ? "run casing deep" : "run casing";
function draw_stretch(chart, stretch) {
  const { ahead, halos, dark, casings, done, fresh } = chart.path;
  const lit = stretch.color !== 0;
  const look = { class: lit ? "run" : "run unlit", d: line_of(chart, stretch), ...lit ? { stroke: css_color(stretch.color) } : {} };
  stretch.d = look.d;
  // In a live run nothing lies ahead, and what still grows is kept apart from what need not be repainted.
  const all = !playback.live;
  if (lit && all) shape("path", { class: casing_class(stretch.color), d: look.d, "stroke-width": 4.5 }, ahead);
  if (all) shape("path", { ...look, "stroke-width": 3 }, ahead);
  stretch.layers = [
    ...lit && all ? [shape("path", { ...look, "stroke-width": 13 }, halos)] : [],
    ...lit ? [shape("path", { class: casing_class(stretch.color), d: look.d, "stroke-width": 6 }, all ? casings : fresh)] : [],
    shape("path", { ...look, "stroke-width": lit ? 3.5 : 2.5 }, all ? lit ? done : dark : fresh),
  ];
  for (const layer of stretch.layers) layer.setAttribute("visibility", "hidden");
  stretch.state = "ahead";
}
/** Shows the part of the path that lies before this moment; only what changed is touched. */
export function draw_progress(chart, state) {
  const i = state.index, { path } = chart, last = path.strokes.at(-1);
  for (const stretch of path.strokes.slice(path.past)) {
    if (stretch.state === "kept") continue;
    const wanted = stretch.to <= i ? "done" : stretch.from <= i ? "open" : "ahead";
    if (wanted !== stretch.state || wanted === "open") {
      const cut = wanted === "open", whole = !cut && (stretch.state === "open" || playback.live);
      const d = cut ? line_until(chart, stretch, state) : whole ? line_of(chart, stretch) : stretch.d;
      for (const layer of stretch.layers) {
        if (cut || whole) layer.setAttribute("d", d);
        layer.setAttribute("visibility", wanted === "ahead" ? "hidden" : "visible");
      }
      stretch.state = wanted;
    }
    if (playback.live && wanted === "done" && stretch !== last) keep_stretch(chart, stretch); // the last may still grow
  }
  while (path.strokes[path.past]?.state === "kept") ++path.past;
}
/** `tag` keeps the ids of a room's balls distinct. */
export function draw_ball(chart, parent, tag = "") {
  const defs = shape("defs", {}, parent), id = `${chart.map.id}${tag}`;
  const glow = shape("radialGradient", { id: `${id}-glow` }, defs);
  const lamp_stops = [shape("stop", { offset: .2, "stop-opacity": .75 }, glow), shape("stop", { offset: 1, "stop-opacity": 0 }, glow)];
  const shine = shape("radialGradient", { id: `${id}-shine`, cx: .36, cy: .3, r: .75 }, defs);
  shape("stop", { offset: 0, "stop-color": "#fff", "stop-opacity": .85 }, shine);
  shape("stop", { offset: .45, "stop-color": "#fff", "stop-opacity": .12 }, shine);
  shape("stop", { offset: 1, "stop-color": "#000", "stop-opacity": .28 }, shine);
  const ball = shape("g", { class: "ball", ...chart.one === playback.main ? { id: "ball" } : {} }, parent);
  const small = playback.room.length > 1;
  const halo = shape("circle", { r: small ? 28 : area.mapped ? playback.ball_px * 3 : 90, fill: `url(#${id}-glow)` }, ball);
  const r = small ? ball_radius(chart) : area.mapped ? playback.ball_px : 34;
  shape("ellipse", { cx: 2, cy: 4, rx: r, ry: r, class: "ball-shadow" }, ball);
  shape("circle", { r, class: "ball-body" }, ball);
  const lamp = shape("circle", { ...chart.one === playback.main ? { id: "ball-lamp" } : {}, r: r - .7 }, ball);
  shape("circle", { r, fill: `url(#${id}-shine)` }, ball);
  const nose = shape("g", {}, ball);
  shape("path", { d: `M0 ${-r - 9}l5 8h-10z`, class: "mark-end" }, nose);
  const eyes = shape("g", { class: "eyes" }, nose);
  for (const side of [-1, 1]) {
    shape("ellipse", { cx: side * r * .36, cy: -r * .3, rx: r * .25, ry: r * .3 }, eyes);
    shape("circle", { cx: side * r * .36, cy: -r * .4, r: r * .13, class: "pupil" }, eyes);
  }
  const matrix = chart.one.run.matrix ? draw_lamps(shape("g", { class: "matrix-on-ball" }, nose), r * 1.3) : null;
  const tail = shape("circle", { cy: r - 2, r: r / 5 + 1, fill: "#4a8dff" }, nose);
  if (small) shape("text", { y: -r - 12, class: "mark-word ball-name", "text-anchor": "middle" }, ball).textContent = chart.one.ball;
  return { ball, lamp, nose, tail, halo, lamp_stops, matrix };
}
const radius_cm = 3.65;
/** A room shows balls in their true size, so that those that meet are seen to touch; but never too small to see. */
const ball_radius = chart => Math.min(34, Math.max(5, radius_cm * chart.scale));
/** Moves a ball to where it is, and shows its lights. */
export function place_ball(chart, layers, state) {
  const lamp = chart.one.lamp_at(playback.now), lamp_color = lamp ? css_color(lamp) : "transparent";
  const there = chart.at(state.x, state.y);
  layers.ball.setAttribute("transform", `translate(${there.x.toFixed(2)} ${there.y.toFixed(2)})`);
  layers.nose.setAttribute("transform", `rotate(${(state.heading + turned_by()).toFixed(1)})`);
  layers.lamp.setAttribute("fill", layers.matrix ? "none" : lamp_color);
  if (layers.matrix) light(layers.matrix, chart.one.picture_at(playback.now));
  layers.tail.setAttribute("opacity", (chart.one.tail_at(playback.now) / 255).toFixed(3));
  layers.halo.setAttribute("opacity", lamp ? 1 : 0);
  for (const stop of layers.lamp_stops) stop.setAttribute("stop-color", lamp_color);
}
