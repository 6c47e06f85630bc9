// Which of two runs the lists show.

import { $, element } from "./dom.js";
import { list_events } from "./events.js";
import { playback, show } from "./playback.js";
import { list_files } from "./source.js";
import { list_variables } from "./variables.js";

export function choose(one) {
  playback.shown = one;
  for (const button of $("whose")?.children ?? []) button.setAttribute("aria-pressed", String(button.dataset.run === (one === playback.main ? "run" : "before")));
  list_files();
  list_variables();
  list_events();
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
