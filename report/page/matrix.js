// The matrix of a BOLT: 8 × 8 lamps.

import { shape } from "./dom.js";

const side = 8, digits = 6;
/** Draws the lamps into a square of `size` around 0,0. */
export function draw_lamps(parent, size) {
  const step = size / side, gap = step * .09;
  return Array.from({ length: side * side }, (_, i) => shape("rect", {
    x: ((i % side - side / 2) * step + gap).toFixed(2), y: ((side / 2 - 1 - Math.floor(i / side)) * step + gap).toFixed(2),
    width: (step - 2 * gap).toFixed(2), height: (step - 2 * gap).toFixed(2), class: "matrix-lamp",
  }, parent));
}
/** Shows `picture`: RRGGBB of each lamp, row by row from the bottom left. Only what changes is touched. */
export function light(lamps, picture) {
  lamps.forEach((lamp, i) => {
    const color = picture.slice(i * digits, (i + 1) * digits);
    if (lamp.dataset.color === color) return;
    lamp.dataset.color = color;
    lamp.style.fill = Number.parseInt(color, 16) ? `#${color}` : "";
  });
}
/** Describes a picture. */
export function picture_words(picture) {
  const colors = Array.from({ length: side * side }, (_, i) => picture.slice(i * digits, (i + 1) * digits));
  const lit = colors.filter(color => Number.parseInt(color, 16)).length;
  if (!lit) return "Matrix: dark";
  return new Set(colors).size === 1 ? `Matrix: all #${colors[0]}` : `Matrix: ${lit} of ${colors.length} lamps lit`;
}
