// Draws what lies below the path: grid, zones, walls.

import { length_words, shape, trim } from "./dom.js";
import { axis_signs, grid_step, grown, meets, overlap, wall_lines } from "./map_chart.js";

/** Draws the grid: its lines below the walls, its numbers above. */
export function draw_grid(chart, lines, words) {
  const grid = grid_step(chart.scale), signs = axis_signs();
  const first_x = Math.ceil(-chart.left / chart.scale / grid), last_x = Math.floor((chart.width - chart.left) / chart.scale / grid);
  const first_y = Math.ceil((chart.top - chart.height) / chart.scale / grid), last_y = Math.floor(chart.top / chart.scale / grid);
  const endless = wall_lines(chart).filter(wall => wall.endless);
  const upright_walls = endless.filter(({ x1, x2 }) => Math.abs(x1 - x2) < 1).map(({ x1 }) => x1);
  const level_walls = endless.filter(({ y1, y2 }) => Math.abs(y1 - y2) < 1).map(({ y1 }) => y1);
  const clear = (value, walls, room) => walls.every(wall => Math.abs(wall - value) > room);
  const low_row = signs && clear(chart.height - 10, level_walls, 12), left_row = signs && clear(18, upright_walls, 22);
  for (let n = first_x; n <= last_x; ++n) {
    const x = Math.round(chart.left + n * grid * chart.scale) + .5;
    shape("path", { d: `M${x} 0V${chart.height}`, class: n === 0 ? "grid-line strong" : "grid-line" }, lines);
    if (low_row && x > 44 && x < chart.width - 20 && clear(x, upright_walls, 20))
      shape("text", { x, y: chart.height - 7, "text-anchor": "middle", class: "grid-word" }, words).textContent = trim(n * grid * signs[0], 3);
  }
  for (let n = first_y; n <= last_y; ++n) {
    const y = Math.round(chart.top - n * grid * chart.scale) + .5;
    shape("path", { d: `M0 ${y}H${chart.width}`, class: n === 0 ? "grid-line strong" : "grid-line" }, lines);
    if (left_row && y > 16 && y < chart.height - 22 && clear(y, level_walls, 14))
      shape("text", { x: 8, y: y - 4, class: "grid-word" }, words).textContent = trim(n * grid * signs[1], 3);
  }
}

const word_width = 7.2, word_height = 12; // pixels of a letter in a zone's name
/** Finds a place for a zone's name, in the zone or beside it, that meets no border, wall or other name. */
function name_place(chart, words, outline, lines, taken) {
  const wide = word_width * words.length, box = outline.box;
  const tries = [];
  for (let row = 1; row < 10; ++row)
    for (let part = 1; part < 10; ++part)
      tries.push({ x: box.left + (box.right - box.left) * part / 10, y: box.high + (box.low - box.high) * row / 10, cost: Math.abs(part - 5) + row });
  const middle_x = (box.left + box.right) / 2, middle_y = (box.high + box.low) / 2;
  tries.push({ x: middle_x, y: box.high - 12, cost: 100 }, { x: middle_x, y: box.low + 12, cost: 101 },
    { x: box.right + wide / 2 + 8, y: middle_y, cost: 102 }, { x: box.left - wide / 2 - 8, y: middle_y, cost: 103 });
  const around = ({ x, y }) => ({ left: x - wide / 2, right: x + wide / 2, high: y - word_height / 2, low: y + word_height / 2 });
  const { pose } = chart.one, path = pose.x.map((x, i) => chart.at(x, pose.y[i]));
  const on_path = ({ left, right, high, low }) => path.some(({ x, y }) => x > left && x < right && y > high && y < low);
  const floor = { left: 2, right: chart.width - 2, high: 2, low: chart.height - 2 };
  const cost = one => {
    const place = grown(around(one), 3);
    return one.cost + (on_path(place) ? 20 : 0) + 1000 * lines.filter(line => meets(line, place)).length + 1000 * taken.filter(other => overlap(other, place)).length
      + (place.left < floor.left || place.right > floor.right || place.high < floor.high || place.low > floor.low ? 1e6 : 0);
  };
  const best = tries.map(one => [cost(one), one]).reduce((a, b) => b[0] < a[0] ? b : a)[1];
  taken.push(around(best));
  return best;
}
function outline_of(chart, zone) {
  const rings = zone.rings.map(ring => ring.map(([x, y]) => chart.at(x, y)));
  const x = rings.flat().map(place => place.x), y = rings.flat().map(place => place.y);
  const lines = rings.flatMap(ring => ring.map((a, i) => {
    const b = ring[(i + 1) % ring.length];
    return { x1: a.x, y1: a.y, x2: b.x, y2: b.y };
  }));
  return { box: { left: Math.min(...x), right: Math.max(...x), high: Math.min(...y), low: Math.max(...y) }, lines };
}
/** Returns the boxes that their names take, and the lines that words should avoid. */
export function draw_zones(chart, parent, words) {
  const zones = chart.one.run.course?.zones ?? [];
  const outlines = zones.map(zone => outline_of(chart, zone));
  const lines = [...outlines.flatMap(outline => outline.lines), ...wall_lines(chart)];
  const taken = [];
  for (const [i, zone] of zones.entries()) {
    const d = zone.rings.map(ring => `M${ring.map(chart.point).join("L")}z`).join("");
    shape("path", { d, class: "zone", "fill-rule": zone.evenodd ? "evenodd" : "nonzero", "data-zone": zone.id }, parent);
    const { x, y } = name_place(chart, zone.id, outlines[i], lines, taken);
    shape("text", { x, y: y + 4, "text-anchor": "middle", class: "zone-word", translate: "no" }, words).textContent = zone.id;
  }
  return { taken, borders: lines };
}
export function draw_walls(chart, parent) {
  for (const { x1, y1, x2, y2 } of wall_lines(chart))
    shape("path", { d: `M${x1.toFixed(1)} ${y1.toFixed(1)}L${x2.toFixed(1)} ${y2.toFixed(1)}`, class: "wall" }, parent);
}
/** On paper the map's size differs from the screen's, so the scale is part of it. */
export function draw_paper_scale(chart, parent) {
  const cm = grid_step(chart.scale), long = cm * chart.scale;
  const right = chart.width - 16, low = chart.height - 12;
  shape("rect", { x: right - long - 8, y: low - 22, width: long + 16, height: 28 }, parent);
  shape("path", { d: `M${right - long} ${low - 5}v5h${long}v-5` }, parent);
  shape("text", { x: right - long / 2, y: low - 8, "text-anchor": "middle" }, parent).textContent = length_words(cm);
}
