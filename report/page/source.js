// The text of the program: how often each line ran, and the one that runs.

import { $, element, keep_in_view, last_at, seconds } from "./dom.js";
import { base_name } from "./journey.js";
import { playback, seek, watch } from "./playback.js";
import { readings } from "./readings.js";

const kinds_of = (...words) => new Map(words.flatMap(Object.entries).flatMap(([kind, list]) => list.map(word => [word.toLowerCase(), kind])));
const languages_of = ({ words }) => ({
  basic: { words: kinds_of(words.basic), tokens: /(?<comment>'.*)|(?<string>"[^"]*"?)|(?<number>\d+)|(?<name>[A-Za-z_]\w*)|[^'"\dA-Za-z_]+/g },
  orb: { words: kinds_of(words.basic, words.structured), tokens: /(?<comment>'.*)|(?<string>"[^"]*"?)|(?<number>#[\da-f]{6}\b|\d\w*(?:\.\d\w*)?)|(?<name>[a-z_]\w*)|[^'"#\da-z_]+|#/gi },
  macro: { words: kinds_of(words.macro), tokens: /(?<comment>[#;].*)|(?<string>"(?:\\.|[^"\\])*"?)|(?<directive>\.\w+)|(?<number>-?\b\d\w*(?:\.\d+\w*)?)|(?<name>[A-Za-z_]\w*)|[^#;"\dA-Za-z_]/g },
});
/** Colours a line of its language; what no rule matches stays plain. */
function colored(text, { words, tokens }) {
  const cell = element("td");
  let first = true;
  for (const token of text.matchAll(tokens)) {
    const found = Object.entries(token.groups).find(([, part]) => part !== undefined);
    const kind = !found ? "" : found[0] === "name" ? words.get(token[0].toLowerCase()) ?? "" : found[0] === "number" && first ? "label" : found[0];
    if (kind) cell.append(element("span", { class: `is-${kind}` }, token[0]));
    else cell.append(token[0]);
    if (token[0].trim()) first = false;
  }
  if (!text) cell.append(" ");
  return cell;
}
let rows = [];
function show_file(index) {
  playback.file = index;
  if (!$("source")) return; // an editor shows it
  const file = playback.shown.run.files[index];
  rows = file ? source_rows(file) : [];
  $("source").tBodies[0].replaceChildren(...rows);
  if (!file) return;
  $("source-title").textContent = playback.shown.run.files.length > 1 ? "Program" : base_name(file.name);
  $("source-title").title = file.name;
  current_row = null;
}
/** A row for each line of a file: its number, how often it ran, its text. */
export function source_rows(file) {
  const ran = new Map(file.counts.map(([line, count, first]) => [line, { count, first }]));
  const most = file.counts.reduce((sum, [, count]) => Math.max(sum, count), 1);
  const ending = file.name.split(".").pop(), languages = languages_of(playback.shown.run);
  const language = ending === "macro" ? languages.macro : ending === "orb" ? languages.orb : languages.basic;
  return file.text.replace(/\r\n?/g, "\n").replace(/\n$/, "").split("\n").map((text, i) => {
    const line = i + 1, entry = ran.get(line);
    const row = element("tr", { "data-line": line });
    if (!entry) row.className = "ran-never";
    if (file.failed.includes(line)) row.classList.add("failed");
    const cell = element("td", { class: "ran", "data-count": entry ? entry.count : 0 }, entry ? entry.count.toLocaleString("en") : "");
    if (entry) {
      cell.style.setProperty("--share", `${Math.max(4, 100 * Math.log1p(entry.count) / Math.log1p(most))}%`);
      row.dataset.first = entry.first;
      row.title = `first ran at ${seconds(entry.first)} s`;
    }
    row.append(element("td", { class: "no" }, String(line)), cell, colored(text, language));
    return row;
  });
}
$("source")?.addEventListener("click", event => {
  const row = event.target.closest("tr[data-first]");
  if (row) seek(Number(row.dataset.first));
});
export function list_files() {
  if (!$("source")) return show_file(0);
  // A robot that is driven from elsewhere has no program.
  const none = !playback.shown.run.files.length;
  for (const part of [document.querySelector(".pane.source"), readings.line.parentElement, $("line-back"), $("line-on")]) part.hidden = none;
  document.querySelector(".board").classList.toggle("has-no-program", none);
  $("file").replaceChildren(...playback.shown.run.files.map((file, i) => element("option", { value: i }, base_name(file.name))));
  $("file").hidden = playback.shown.run.files.length < 2;
  show_file(0);
}
$("file")?.addEventListener("change", () => { show_file(Number($("file").value)); show_line(); });
let current_row = null;
function show_line() {
  const own = playback.shown.steps[playback.file];
  const i = own ? last_at(own.t, playback.now) : -1;
  const inside = i >= 0;
  const row = inside ? rows[own.line[i] - 1] : null;
  readings.line.textContent = inside ? String(own.line[i]) : "none";
  if (row === current_row) return;
  if (current_row) { current_row.classList.remove("current"); current_row.removeAttribute("aria-current"); }
  current_row = row ?? null;
  if (!row) return;
  row.classList.add("current");
  row.setAttribute("aria-current", "step");
  keep_in_view($("source-scroll"), row);
}
watch(show_line);
/** The lines that ran last, file by file. */
export const lines_now = () => playback.shown.steps.map(({ t, line }, k) => ({ name: playback.shown.run.files[k].name, line: line[last_at(t, playback.now)] ?? 0 }));

/** Jumps to the line that ran before or after this moment, in any file. */
export function step_line(by) {
  const times = playback.shown.line_times, last = last_at(times, playback.now);
  const wanted = by > 0 ? last + 1 : last_at(times, playback.now - 1);
  if (wanted < 0 || wanted >= times.length) { seek(by > 0 ? playback.end : 0); return; }
  const file = playback.shown.run.line.file[wanted];
  if (file !== playback.file) {
    if ($("file")) $("file").value = file;
    show_file(file);
  }
  seek(times[wanted]);
}
$("line-back").addEventListener("click", () => step_line(-1));
$("line-on").addEventListener("click", () => step_line(1));
