// The list of events.

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
let event_rows = []; // of the events from `first_row` on
let first_row = 0;
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
  first_row = 0;
  current_event = -2;
  $("events").replaceChildren();
}
/** Clears the list before another run is shown. */
export function forget_events() {
  events = [];
  clear_rows();
}
const most_rows = 500; // more would make a long run slow
const spare_rows = 50; // removed together, as all others move up
/** Adds events of a live run; drops the oldest rows. */
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
  if (events.length > most_rows) list_rows(events.length - 1);
  else {
    if (!goes_on) clear_rows();
    for (const event of events.slice(event_rows.length)) add_row(event);
  }
  $("no-events").hidden = events.length > 0;
  list_filters();
  show_kinds();
}
/** Lists the rows around an event, if there are too many for all. */
function list_rows(around) {
  clear_rows();
  first_row = Math.max(0, Math.min(around - most_rows / 2, events.length - most_rows));
  const after = first_row + most_rows;
  if (first_row > 0) add_rest(`${first_row.toLocaleString("en")} events before these`, first_row - 1);
  for (const event of events.slice(first_row, after)) add_row(event);
  if (after < events.length) add_rest(`${(events.length - after).toLocaleString("en")} events after these`, after);
}
function add_rest(words, nearest) {
  const button = element("button", { type: "button" }, words);
  button.addEventListener("click", () => seek(events[nearest].t));
  const item = element("li", { class: "gap" });
  item.append(button);
  $("events").append(item);
}
function add_row(event) {
  if (event.gap && event !== events[0])
    $("events").append(element("li", { class: "gap" }, `${event.gap.toLocaleString("en")} events in between are not listed`));
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
  event_rows.forEach((row, i) => { row.hidden = hidden_kinds.has(events[first_row + i].kind); });
}
function show_event() {
  const i = last_at(event_times, playback.now);
  if (i === current_event) return;
  const near = Math.max(i, 0);
  if (events.length && !row_of(near)) {
    list_rows(near);
    show_kinds();
  }
  if (current_event === -2) event_rows.forEach((row, k) => row.classList.toggle("future", first_row + k > i));
  else for (let k = Math.max(0, Math.min(i, current_event)); k <= Math.max(i, current_event); ++k) row_of(k)?.classList.toggle("future", k > i);
  row_of(current_event)?.classList.remove("at");
  row_of(current_event)?.removeAttribute("aria-current");
  current_event = i;
  if (i < 0) return;
  row_of(i).classList.add("at");
  row_of(i).setAttribute("aria-current", "true");
  keep_in_view($("events-scroll"), row_of(i));
}
const row_of = i => event_rows[i - first_row];
watch(show_event);
/** Jumps to the event before or after this moment. */
export function jump(by) {
  const visible = events.filter(event => !hidden_kinds.has(event.kind));
  const target = by > 0 ? visible.find(event => event.t > playback.now) : visible.filter(event => event.t < playback.now).pop();
  seek(target ? target.t : by > 0 ? playback.end : 0);
}
$("previous").addEventListener("click", () => jump(-1));
$("next").addEventListener("click", () => jump(1));
