// The path of the ball, and the ball.

import { brightness, css_color, shape } from "./dom.js";
import { area } from "./map_chart.js";
import { playback } from "./playback.js";

function line_from(chart, from, to) {
  const { pose } = chart.one, at = i => chart.point([pose.x[i], pose.y[i]]);
  let d = `M${at(from)}`;
  for (let i = from + 1; i <= to; ++i) d += `L${at(i)}`;
  return d;
}
/** All of the path, faded; the part that lies before the moment shown is laid over it by draw_progress(). */
export function draw_path(chart) {
  const { map } = chart;
  const ahead = shape("g", { class: "ahead" }, map);
  const halos = shape("g", { class: "halo" }, map);
  const dark = shape("g", {}, map); // unlit stretches lie below lit ones
  const casings = shape("g", {}, map);
  const done = shape("g", {}, map);
  const casing_class = color => brightness(color) > .7 ? "run casing pale" : brightness(color) < .2 ? "run casing deep" : "run casing";
  for (const stretch of chart.one.stretches) {
    const lit = stretch.color !== 0;
    const look = { class: lit ? "run" : "run unlit", d: line_from(chart, stretch.from, stretch.to), ...lit ? { stroke: css_color(stretch.color) } : {} };
    stretch.d = look.d;
    if (lit) shape("path", { class: casing_class(stretch.color), d: look.d, "stroke-width": 4.5 }, ahead);
    shape("path", { ...look, "stroke-width": 3 }, ahead);
    stretch.layers = [
      ...lit ? [shape("path", { ...look, "stroke-width": 13 }, halos),
        shape("path", { class: casing_class(stretch.color), d: look.d, "stroke-width": 6 }, casings)] : [],
      shape("path", { ...look, "stroke-width": lit ? 3.5 : 2.5 }, lit ? done : dark),
    ];
    for (const layer of stretch.layers) layer.setAttribute("visibility", "hidden");
    stretch.state = "ahead";
  }
}
/** Shows the part of the path that lies before this moment; only what changed is touched. */
export function draw_progress(chart, state) {
  const i = state.index;
  for (const stretch of chart.one.stretches) {
    const wanted = stretch.to <= i ? "done" : stretch.from <= i ? "open" : "ahead";
    if (wanted === stretch.state && wanted !== "open") continue;
    const cut = wanted === "open", whole = !cut && stretch.state === "open";
    const d = cut
      ? `${line_from(chart, stretch.from, Math.min(i, stretch.to))}L${chart.point([state.x, state.y])}`
      : stretch.d;
    for (const layer of stretch.layers) {
      if (cut || whole) layer.setAttribute("d", d);
      layer.setAttribute("visibility", wanted === "ahead" ? "hidden" : "visible");
    }
    stretch.state = wanted;
  }
}
export function draw_ball(chart, parent) {
  const defs = shape("defs", {}, parent);
  const glow = shape("radialGradient", { id: `${chart.map.id}-glow` }, defs);
  const lamp_stops = [shape("stop", { offset: .2, "stop-opacity": .75 }, glow), shape("stop", { offset: 1, "stop-opacity": 0 }, glow)];
  const shine = shape("radialGradient", { id: `${chart.map.id}-shine`, cx: .36, cy: .3, r: .75 }, defs);
  shape("stop", { offset: 0, "stop-color": "#fff", "stop-opacity": .85 }, shine);
  shape("stop", { offset: .45, "stop-color": "#fff", "stop-opacity": .12 }, shine);
  shape("stop", { offset: 1, "stop-color": "#000", "stop-opacity": .28 }, shine);
  const ball = shape("g", { class: "ball", ...chart.one === playback.main ? { id: "ball" } : {} }, parent);
  const halo = shape("circle", { r: area.mapped ? 40 : 90, fill: `url(#${chart.map.id}-glow)` }, ball);
  const r = area.mapped ? 13 : 34;
  shape("ellipse", { cx: 2, cy: 4, rx: r, ry: r, class: "ball-shadow" }, ball);
  shape("circle", { r, class: "ball-body" }, ball);
  const lamp = shape("circle", { ...chart.one === playback.main ? { id: "ball-lamp" } : {}, r: r - .7 }, ball);
  shape("circle", { r, fill: `url(#${chart.map.id}-shine)` }, ball);
  const nose = shape("g", {}, ball);
  shape("path", { d: `M0 ${-r - 9}l5 8h-10z`, class: "mark-end" }, nose);
  const tail = shape("circle", { cy: r - 2, r: r / 5 + 1, fill: "#4a8dff" }, nose);
  return { ball, lamp, nose, tail, halo, lamp_stops };
}
