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

watch(state => {
  const lamp = playback.main.lamp_at(playback.now), lamp_color = lamp ? css_color(lamp) : "transparent";
  document.documentElement.style.setProperty("--lamp", lamp_color);
  if (lamp) document.documentElement.style.setProperty("--lamp-solid", lamp_color);
  else document.documentElement.style.removeProperty("--lamp-solid");
  readings.position.textContent = position_words(state);
  readings.speed.textContent = speed_words(state);
  readings.heading.textContent = `${state.heading.toFixed(1)}°`;
  readings.led.firstChild.style.background = lamp_color;
  readings.led.lastChild.textContent = rgb_words(lamp);
});
