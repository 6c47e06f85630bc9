// What the ball is doing now.

import { $, css_color, element, position_words, rgb_words, shape, speed_words } from "./dom.js";
import { draw_lamps, light, picture_words } from "./matrix.js";
import { playback, watch } from "./playback.js";

export const readings = {};
for (const [name, words] of [["position", "at"], ["speed", "speed"], ["heading", "heading"], ["led", "LED"], ["line", "line"]]) {
  readings[name] = element("dd", { "data-now": name });
  const pair = element("div");
  pair.append(element("dt", {}, words), readings[name]);
  $("now").append(pair);
}
readings.led.append(element("span", { class: "swatch" }), document.createTextNode(""));

const matrix = element("dd", { "data-now": "matrix" }), matrix_pair = element("div", { class: "matrix" });
const matrix_art = shape("svg", { viewBox: "-40 -40 80 80", role: "img" }, matrix), lamps = draw_lamps(matrix_art, 80);
matrix_pair.append(element("dt", {}, "matrix"), matrix);
$("now").prepend(matrix_pair);

let lit = null;
/** Sets the colour only where it is used: set on the page, it would restyle every element. */
function show_lamp(lamp, color) {
  if (lamp === lit) return;
  lit = lamp;
  for (const { style } of document.querySelectorAll(".mark, .track")) {
    style.setProperty("--lamp", color);
    if (lamp) style.setProperty("--lamp-solid", color);
    else style.removeProperty("--lamp-solid");
  }
}
watch(state => {
  const lamp = playback.main.lamp_at(playback.now), lamp_color = lamp ? css_color(lamp) : "transparent";
  show_lamp(lamp, lamp_color);
  readings.position.textContent = position_words(state);
  readings.speed.textContent = speed_words(state);
  readings.heading.textContent = `${state.heading.toFixed(1)}°`;
  readings.led.firstChild.style.background = lamp_color;
  readings.led.lastChild.textContent = rgb_words(lamp);
  const picture = playback.main.picture_at(playback.now);
  matrix_pair.hidden = picture === null;
  if (picture === null) return;
  light(lamps, picture);
  matrix_art.setAttribute("aria-label", picture_words(picture));
});
