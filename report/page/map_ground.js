// What lies below the path: grid, zones, walls.

import { length_words, shape, trim } from "./dom.js";
import { grid_step } from "./map_chart.js";

export const wall_pixels = (chart, axis) => chart.one.run.walls.filter(wall => wall.axis === axis).map(wall => axis === "x" ? chart.px(wall.at) : chart.py(wall.at));

/** Walls lie on the lines and under the words. */
export function draw_grid(chart, lines, words) {
  const grid = grid_step(chart.scale);
  const first_x = Math.ceil(-chart.left / chart.scale / grid), last_x = Math.floor((chart.width - chart.left) / chart.scale / grid);
  const first_y = Math.ceil((chart.top - chart.height) / chart.scale / grid), last_y = Math.floor(chart.top / chart.scale / grid);
  const upright = wall_pixels(chart, "x"), level = wall_pixels(chart, "y");
  const clear = (value, walls, room) => walls.every(wall => Math.abs(wall - value) > room);
  const low_row = clear(chart.height - 10, level, 12), left_row = clear(18, upright, 22);
  for (let n = first_x; n <= last_x; ++n) {
    const x = Math.round(chart.px(n * grid)) + .5;
    shape("path", { d: `M${x} 0V${chart.height}`, class: n === 0 ? "grid-line strong" : "grid-line" }, lines);
    if (low_row && x > 44 && x < chart.width - 20 && clear(x, upright, 20))
      shape("text", { x, y: chart.height - 7, "text-anchor": "middle", class: "grid-word" }, words).textContent = trim(n * grid, 3);
  }
  for (let n = first_y; n <= last_y; ++n) {
    const y = Math.round(chart.py(n * grid)) + .5;
    shape("path", { d: `M0 ${y}H${chart.width}`, class: n === 0 ? "grid-line strong" : "grid-line" }, lines);
    if (left_row && y > 16 && y < chart.height - 22 && clear(y, level, 14))
      shape("text", { x: 8, y: y - 4, class: "grid-word" }, words).textContent = trim(n * grid, 3);
  }
}
export function draw_zones(chart, parent) {
  for (const zone of chart.one.run.course?.zones ?? []) {
    const d = zone.rings.map(ring => `M${ring.map(chart.point).join("L")}z`).join("");
    shape("path", { d, class: "zone", "fill-rule": zone.evenodd ? "evenodd" : "nonzero", "data-zone": zone.id }, parent);
    const x = zone.rings.flat().map(place => chart.px(place[0])), y = zone.rings.flat().map(place => chart.py(place[1]));
    shape("text", { x: (Math.min(...x) + Math.max(...x)) / 2, y: Math.min(...y) + 15, "text-anchor": "middle", class: "zone-word" }, parent).textContent = zone.id;
  }
}
export function draw_walls(chart, parent) {
  for (const wall of chart.one.run.walls) if (wall.from) shape("path", { d: `M${chart.point(wall.from)}L${chart.point(wall.to)}`, class: "wall" }, parent);
  for (const x of wall_pixels(chart, "x")) shape("path", { d: `M${x} 0V${chart.height}`, class: "wall" }, parent);
  for (const y of wall_pixels(chart, "y")) shape("path", { d: `M0 ${y}H${chart.width}`, class: "wall" }, parent);
}
/** On paper the map has another size than on the screen: the scale stands in it. */
export function draw_paper_scale(chart, parent) {
  const cm = grid_step(chart.scale), long = cm * chart.scale;
  const right = chart.width - 16, low = chart.height - 12;
  shape("rect", { x: right - long - 8, y: low - 22, width: long + 16, height: 28 }, parent);
  shape("path", { d: `M${right - long} ${low - 5}v5h${long}v-5` }, parent);
  shape("text", { x: right - long / 2, y: low - 8, "text-anchor": "middle" }, parent).textContent = length_words(cm);
}
