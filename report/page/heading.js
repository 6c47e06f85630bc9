// The heading of the page, and its theme.

import { $, element } from "./dom.js";
import { playback } from "./playback.js";

export function show_heading() {
  const { run } = playback.main;
  if ($("title")) {
    document.title = `${playback.main.name} · orb run`;
    // A name breaks after a sign, never inside a word.
    $("title").replaceChildren(...playback.main.name.split(/(?<=[-_.])/).flatMap((part, i) => i ? [element("wbr"), part] : [part]));
    $("title").title = run.title;
  }
  $("outcome").textContent = run.end.text;
  $("outcome").className = run.end.reason === "error" ? "bad" : "";
  $("totals").replaceChildren();
  for (const [name, value, id] of run.totals) {
    const box = element("div");
    box.append(element("dt", {}, name), element("dd", { "data-total": id }, value));
    const other = playback.before?.run.totals.find(total => total[2] === id);
    if (other) box.append(element("dd", { class: "before", "data-before": id }, `before ${other[1]}`));
    $("totals").append(box);
  }
  $("thinned").textContent = run.thinned;
  $("thinned").hidden = !run.thinned;
}

// ---- theme ----
const themes = ["auto", "light", "dark"];
let theme = "auto";
try { theme = localStorage.getItem("orb-theme") || "auto"; } catch { /* a file may have no storage */ }
if (!themes.includes(theme)) theme = "auto";
function show_theme() {
  if (theme === "auto") delete document.documentElement.dataset.theme;
  else document.documentElement.dataset.theme = theme;
  $("theme").textContent = `Theme: ${theme}`;
}
export function next_theme() {
  theme = themes[(themes.indexOf(theme) + 1) % themes.length];
  try { localStorage.setItem("orb-theme", theme); } catch { /* as above */ }
  show_theme();
}
$("theme").addEventListener("click", next_theme);
show_theme();
