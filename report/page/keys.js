// Keyboard shortcuts.

import { $ } from "./dom.js";
import { jump } from "./events.js";
import { next_theme } from "./heading.js";
import { fit, toggle_follow, zoom_by } from "./map.js";
import { playback, seek } from "./playback.js";
import { step_line } from "./source.js";
import { set_playing, slider } from "./transport.js";

$("keys-button").addEventListener("click", () => $("keys").showModal());
/** Handles the keys pressed within `where`. */
export function take_keys(where) {
  where.addEventListener("keydown", press);
}
function press(event) {
  if (!playback.main || event.ctrlKey || event.metaKey || event.altKey || $("keys").open) return;
  const { target } = event;
  if (target instanceof HTMLSelectElement || target instanceof HTMLInputElement && target !== slider) return;
  const by = event.shiftKey ? 1e6 : 50e3;
  const actions = {
    __proto__: null,
    ArrowLeft: () => seek(playback.now - by), ArrowRight: () => seek(playback.now + by),
    Home: () => seek(0), End: () => seek(playback.end),
    n: () => jump(1), p: () => jump(-1),
    ".": () => step_line(1), ",": () => step_line(-1),
    "+": () => zoom_by(1.5), "=": () => zoom_by(1.5), "-": () => zoom_by(1 / 1.5), 0: fit,
    f: toggle_follow, t: next_theme, "?": () => $("keys").showModal(),
    " ": () => set_playing(!playback.playing),
  };
  if (event.key === " " && target instanceof HTMLButtonElement) return; // Space presses a button
  const action = actions[event.key];
  if (!action) return;
  event.preventDefault();
  action();
}
