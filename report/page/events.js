// What happened, in a list.

import { $, element, keep_in_view, last_at, seconds, shape } from "./dom.js";
import { playback, seek, watch } from "./playback.js";

const kinds = {
  __proto__: null,
  print: { words: "output", icon: "M1 3h12v7H6l-3 3v-3H1z" },
  error: { words: "errors", icon: "M7 1L14 13H0z" },
  marker: { words: "markers", icon: "M7 1l6 6-6 6-6-6z" },
  bump: { words: "bumps", icon: "M12 7a5 5 0 1 1-10 0 5 5 0 0 1 10 0z", stroked: true },
  collision: { words: "collisions", icon: "M2 2l10 10M2 12L12 2", stroked: true },
  macro: { words: "macros", icon: "M3 2v10l9-5z" },
  sleep: { words: "sleep", icon: "M10 9a5 5 0 1 1-5-7 4 4 0 0 0 5 7z" },
};
let events = [];
let event_rows = [];
let event_times = [];
let current_event = -2;
const hidden_kinds = new Set();
function icon(kind) {
  const art = shape("svg", { viewBox: "0 0 14 14", class: "icon", "aria-hidden": "true" });
  const stroked = kinds[kind].stroked;
  shape("path", { d: kinds[kind].icon, fill: stroked ? "none" : "currentColor", stroke: stroked ? "currentColor" : "none", "stroke-width": 2.2 }, art);
  return art;
}
function clear_rows() {
  event_rows = [];
  current_event = -2;
  $("events").replaceChildren();
}
/** Another run comes, not more of this one. */
export function forget_events() {
  events = [];
  clear_rows();
}
const most_rows = 500; // of a run that goes on
const spare_rows = 50; // go at once: all that stay move up then
/** More of a run that goes on; the oldest rows go. */
export function list_more_events(more) {
  if (!more.length) return;
  const fresh = more.slice(-most_rows);
  for (const event of fresh) add_row(event);
  events = [...events, ...fresh];
  event_times = events.map(event => event.t);
  const old = events.length - most_rows;
  if (old >= spare_rows) {
    events = events.slice(old);
    event_times = event_times.slice(old);
    for (const row of event_rows.splice(0, old)) row.remove();
    current_event = Math.max(-1, current_event - old);
  }
  $("no-events").hidden = true;
  if (more.some(({ kind }) => !$("filters").querySelector(`[data-filter=${kind}]`))) list_filters();
  show_kinds();
}
export function list_events() {
  const listed = events.length;
  const goes_on = playback.live && listed <= playback.shown.run.events.length && events.every((event, i) => event.t === playback.shown.run.events[i].t && !playback.shown.run.events[i].gap);
  events = [...playback.shown.run.events];
  event_times = events.map(event => event.t);
  if (!goes_on) clear_rows();
  for (const [i, event] of events.entries()) {
    if (goes_on && i < listed) continue;
    if (event.gap && i > 0)
      $("events").append(element("li", { class: "gap" }, `${event.gap.toLocaleString("en")} events in between are not listed`));
    add_row(event);
  }
  $("no-events").hidden = events.length > 0;
  list_filters();
  show_kinds();
}
function add_row(event) {
  const item = element("li", { class: event.kind });
  const button = element("button", { type: "button", "data-t": event.t, "data-kind": event.kind });
  const words = element("span", { class: "words" }, event.text.replace(/\n$/, "") || "(empty line)");
  const sign = icon(event.kind);
  sign.removeAttribute("aria-hidden");
  sign.setAttribute("role", "img");
  sign.setAttribute("aria-label", event.kind);
  button.append(element("span", { class: "t" }, seconds(event.t)), sign, words);
  button.addEventListener("click", () => seek(event.t));
  item.append(button);
  $("events").append(item);
  event_rows.push(item);
}
function list_filters() {
  $("filters").replaceChildren();
  for (const [kind, { words }] of Object.entries(kinds)) {
    const count = playback.shown.run.counts[kind] ?? 0;
    if (!count) continue;
    const button = element("button", { type: "button", "data-filter": kind, "data-count": count }, `${words} ${count.toLocaleString("en")}`);
    button.addEventListener("click", () => {
      if (!hidden_kinds.delete(kind)) hidden_kinds.add(kind);
      show_kinds();
    });
    $("filters").append(button);
  }
}
function show_kinds() {
  for (const button of $("filters").children) button.setAttribute("aria-pressed", String(!hidden_kinds.has(button.dataset.filter)));
  events.forEach((event, i) => { event_rows[i].hidden = hidden_kinds.has(event.kind); });
}
function show_event() {
  const i = last_at(event_times, playback.now);
  if (i === current_event) return;
  const from = Math.max(0, Math.min(i, current_event)), to = Math.min(events.length - 1, Math.max(i, current_event));
  for (let k = from; k <= to; ++k) event_rows[k].classList.toggle("future", k > i);
  if (current_event === -2) event_rows.forEach((row, k) => row.classList.toggle("future", k > i));
  if (current_event >= 0) { event_rows[current_event].classList.remove("at"); event_rows[current_event].removeAttribute("aria-current"); }
  current_event = i;
  if (i < 0) return;
  event_rows[i].classList.add("at");
  event_rows[i].setAttribute("aria-current", "true");
  keep_in_view($("events-scroll"), event_rows[i]);
}
watch(show_event);
/** To the event before or after this moment. */
export function jump(by) {
  const visible = events.filter(event => !hidden_kinds.has(event.kind));
  const target = by > 0 ? visible.find(event => event.t > playback.now) : visible.filter(event => event.t < playback.now).pop();
  seek(target ? target.t : by > 0 ? playback.end : 0);
}
$("previous").addEventListener("click", () => jump(-1));
$("next").addEventListener("click", () => jump(1));
