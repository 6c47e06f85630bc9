// What the ball is doing now.

import { $, css_color, element, position_words, rgb_words, speed_words } from "./dom.js";
import { playback, watch } from "./playback.js";

export const readings = {};
for (const [name, words] of [["position", "at"], ["speed", "speed"], ["heading", "heading"], ["led", "LED"], ["line", "line"]]) {
  readings[name] = element("dd", { "data-now": name });
  const pair = element("div");
  pair.append(element("dt", {}, words), readings[name]);
  $("now").append(pair);
}
readings.led.append(element("span", { class: "swatch" }), document.createTextNode(""));

let lit = null;
/** Only what has the colour is told of it: of the whole page each element would be styled anew. */
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
});
