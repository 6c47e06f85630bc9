// Chooses which of two runs, or which ball of a room, the lists show.

import { $, element } from "./dom.js";
import { list_events } from "./events.js";
import { playback, show } from "./playback.js";
import { list_files } from "./source.js";
import { list_variables } from "./variables.js";

export function choose(one) {
  playback.shown = one;
  if (!playback.room.length) for (const button of $("whose")?.children ?? []) button.setAttribute("aria-pressed", String(button.dataset.run === (one === playback.main ? "run" : "before")));
  list_files();
  list_variables();
  list_events();
}
const most_buttons = 6; // more balls than this go into a drop-down list
/** Lists the balls of a room; calls `take(one)` with the chosen one. */
export function list_balls(take) {
  const whose = $("whose"), { room, main } = playback;
  whose.replaceChildren();
  whose.hidden = false;
  whose.setAttribute("aria-label", "Ball shown");
  if (room.length > most_buttons) {
    const list = element("select", { "aria-label": "Ball shown" });
    room.forEach((one, i) => list.append(element("option", { value: i }, one.ball)));
    list.value = room.indexOf(main);
    list.addEventListener("change", () => take(room[Number(list.value)]));
    whose.append(list);
    return;
  }
  for (const one of room) {
    const button = element("button", { type: "button", "data-ball": one.ball, "aria-pressed": String(one === main) }, one.ball);
    button.addEventListener("click", () => take(one));
    whose.append(button);
  }
}
export function list_runs() {
  if (!$("whose")) return;
  $("whose").replaceChildren();
  $("whose").hidden = !playback.before;
  if (!playback.before) return;
  for (const [name, words, one] of [["before", "before", playback.before], ["run", "this run", playback.main]]) {
    const button = element("button", { type: "button", "data-run": name }, words);
    button.addEventListener("click", () => { choose(one); show(); });
    $("whose").append(button);
  }
}
