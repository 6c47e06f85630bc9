// Prints the run at its end: the whole path and the whole program, whatever part of them was in view.

import { $, element } from "./dom.js";
import { base_name } from "./journey.js";
import { redraw } from "./map.js";
import { view } from "./map_chart.js";
import { playback } from "./playback.js";
import { source_rows } from "./source.js";
import { set_playing } from "./transport.js";

let put_aside = null;
window.addEventListener("beforeprint", () => {
  if (!playback.main) return;
  set_playing(false);
  put_aside = { now: playback.now, ...view };
  Object.assign(view, { zoom: 1, x: 0, y: 0, follow: false });
  playback.now = playback.end;
  if ($("paper-files")) playback.shown.run.files.forEach((file, i) => {
    if (i === playback.file && $("source")) return;
    const table = element("table", { class: "listing" });
    table.append(...source_rows(file));
    $("paper-files").append(element("h2", {}, base_name(file.name)), table);
  });
  redraw();
});
window.addEventListener("afterprint", () => {
  if (!put_aside) return;
  const { now: then, ...looked } = put_aside;
  Object.assign(view, looked);
  playback.now = then;
  put_aside = null;
  $("paper-files")?.replaceChildren();
  redraw();
});
