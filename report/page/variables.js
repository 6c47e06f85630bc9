// The values of variables.

import { $, element, last_at } from "./dom.js";
import { playback, seek, watch } from "./playback.js";

let variable_rows = [];
export function list_variables() {
  $("variables-pane").hidden = !playback.shown.variables.length;
  document.querySelector(".board").classList.toggle("has-variables", playback.shown.variables.length > 0);
  variable_rows = playback.shown.variables.map(one => {
    const row = element("tr", { "data-variable": one.of ? `${one.of}.${one.name}` : one.name });
    const name = element("th", { scope: "row" }, one.name);
    if (one.of) name.append(element("span", {}, ` in ${one.of}`));
    const value = element("td", { class: "value" });
    const jumps = element("td", { class: "jumps" });
    const to_change = by => {
      const wanted = by > 0 ? last_at(one.t, playback.now) + 1 : last_at(one.t, playback.now - 1);
      if (one.t[wanted] !== undefined) seek(one.t[wanted]);
    };
    const buttons = [["\u2039", -1, "previous"], ["\u203a", 1, "next"]].map(([sign, by, words]) => {
      const button = element("button", { type: "button", "data-jump": words, "aria-label": `${words} change of ${one.name}` }, sign);
      button.addEventListener("click", () => to_change(by));
      return button;
    });
    jumps.append(...buttons);
    row.append(name, value, jumps);
    if (one.cut) row.title = "it changed more often than a report can hold; some changes are left out";
    return { row, value, buttons, one };
  });
  $("variables").tBodies[0].replaceChildren(...variable_rows.map(({ row }) => row));
}
function show_variables() {
  const line_time = playback.shown.line_times[last_at(playback.shown.line_times, playback.now)];
  for (const { row, value, buttons, one } of variable_rows) {
    const i = last_at(one.t, playback.now);
    const words = String(i < 0 ? 0 : one.v[i]);
    if (value.textContent !== words) value.textContent = words;
    row.classList.toggle("changed", i >= 0 && one.t[i] >= line_time);
    buttons[0].disabled = last_at(one.t, playback.now - 1) < 0;
    buttons[1].disabled = i + 1 >= one.t.length;
  }
}
watch(show_variables);
