"use strict";
(() => {
const run = JSON.parse(document.getElementById("run").textContent);
const $ = id => document.getElementById(id);
const svg_ns = "http://www.w3.org/2000/svg";

// ---- the columns of the run: differences of whole numbers, summed up again here ----
const sums = list => { let sum = 0; return list.map(step => sum += step); };
const column = (list, scale) => sums(list).map(value => value / scale);
const pose = {
  t: sums(run.pose.t), x: column(run.pose.x, 1000), y: column(run.pose.y, 1000),
  heading: column(run.pose.heading, 10), speed: column(run.pose.speed, 100),
};
const led = { t: sums(run.led.t), rgb: run.led.rgb };
const backled = { t: sums(run.backled.t), value: run.backled.value };
// Where the run was, file by file: a program and a macro run side by side.
const steps = run.files.map(() => ({ t: [], line: [] }));
sums(run.line.t).forEach((t, i) => {
  const own = steps[run.line.file[i]];
  own.t.push(t);
  own.line.push(run.line.line[i]);
});
const events = run.events;
const end = Math.max(run.end.t, 1);

/** Index of the last entry of ascending `list` that is not after `t`; -1 before the first. */
function last_at(list, t) {
  let low = 0, high = list.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (list[middle] <= t) low = middle + 1; else high = middle;
  }
  return low - 1;
}

const clamp = (value, low, high) => Math.min(Math.max(value, low), high);
/** Whole milliseconds that have passed, as `orb run` itself counts them. */
const seconds = t => (Math.floor(t / 1000) / 1000).toFixed(3);
function clock_text(t) {
  const minutes = Math.floor(t / 60e6);
  const rest = seconds(t % 60e6);
  return minutes ? `${minutes}:${rest.padStart(6, "0")}` : rest;
}
const trim = (value, digits) => String(Number(value.toFixed(digits)));

function element(name, attributes = {}, text) {
  const made = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  if (text !== undefined) made.textContent = text;
  return made;
}
function shape(name, attributes, parent) {
  const made = document.createElementNS(svg_ns, name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  if (parent) parent.append(made);
  return made;
}

// ---- the ball at any moment ----
function turn(from, to, share) {
  let by = (to - from) % 360;
  if (by > 180) by -= 360;
  if (by < -180) by += 360;
  return ((from + by * share) % 360 + 360) % 360;
}
function state_at(t) {
  const i = last_at(pose.t, t);
  if (i < 0) return { x: pose.x[0] ?? 0, y: pose.y[0] ?? 0, heading: pose.heading[0] ?? 0, speed: 0, index: -1 };
  const next = i + 1;
  if (next >= pose.t.length)
    return { x: pose.x[i], y: pose.y[i], heading: pose.heading[i], speed: pose.speed[i], index: i };
  // A pose comes while something moves; over a longer gap the ball stood where it was.
  const gap = pose.t[next] - pose.t[i];
  const share = gap > run.pose.step * 1.5 ? 0 : (t - pose.t[i]) / gap;
  const mix = list => list[i] + (list[next] - list[i]) * share;
  return { x: mix(pose.x), y: mix(pose.y), heading: turn(pose.heading[i], pose.heading[next], share), speed: mix(pose.speed), index: i };
}
const lamp_at = t => led.rgb[last_at(led.t, t)] ?? 0;
const tail_at = t => backled.value[last_at(backled.t, t)] ?? 0;
const css_color = rgb => "#" + rgb.toString(16).padStart(6, "0");
const rgb_words = rgb => `${rgb >> 16}, ${rgb >> 8 & 255}, ${rgb & 255}`;

// ---- heading of the page ----
document.title = `${run.title} · orb run`;
$("title").textContent = run.title;
$("outcome").textContent = run.end.text;
$("outcome").className = run.end.reason === "error" ? "bad" : "";
for (const [name, value, id] of run.totals) {
  const box = element("div");
  box.append(element("dt", {}, name), element("dd", { "data-total": id }, value));
  $("totals").append(box);
}
if (run.thinned) {
  $("thinned").textContent = run.thinned;
  $("thinned").hidden = false;
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
function next_theme() {
  theme = themes[(themes.indexOf(theme) + 1) % themes.length];
  try { localStorage.setItem("orb-theme", theme); } catch { /* as above */ }
  show_theme();
}
$("theme").addEventListener("click", next_theme);
show_theme();

// ---- the map ----
const map = $("map");
const view = { zoom: 1, x: 0, y: 0, follow: false };
let layers = null;
let pixels = { width: 0, height: 0, scale: 1, left: 0, top: 0 };

function bounds() {
  let [left, right, low, high] = [0, 0, 0, 0];
  if (pose.t.length) {
    left = Math.min(...pose.x); right = Math.max(...pose.x);
    low = Math.min(...pose.y); high = Math.max(...pose.y);
  }
  return { left, right, low, high, middle_x: (left + right) / 2, middle_y: (low + high) / 2 };
}
const box = bounds();
const moved = box.right - box.left > 1 || box.high - box.low > 1;

function measure() {
  const area = map.getBoundingClientRect();
  const width = Math.max(area.width, 50), height = Math.max(area.height, 50);
  const wide = Math.max(box.right - box.left, 20), tall = Math.max(box.high - box.low, 20);
  const fit = Math.min((width - 110) / wide, (height - 120) / tall);
  const scale = Math.max(fit, .02) * view.zoom;
  const center_x = view.follow ? state_at(now).x : box.middle_x + view.x;
  const center_y = view.follow ? state_at(now).y : box.middle_y + view.y;
  pixels = { width, height, scale, left: width / 2 - center_x * scale, top: height / 2 + center_y * scale };
}
const px = x => pixels.left + x * pixels.scale;
const py = y => pixels.top - y * pixels.scale;
const at = i => `${px(pose.x[i]).toFixed(1)} ${py(pose.y[i]).toFixed(1)}`;

// Stretches of path in one colour; the LED may change between two poses.
const stretches = (() => {
  const list = [];
  let color = -1;
  for (let i = 1; i < pose.t.length; ++i) {
    const lit = lamp_at(pose.t[i - 1]);
    if (pose.x[i] === pose.x[i - 1] && pose.y[i] === pose.y[i - 1]) continue;
    const open = list[list.length - 1];
    if (lit === color && open && open.to === i - 1) open.to = i;
    else list.push({ from: i - 1, to: i, color: lit });
    color = lit;
  }
  return list;
})();
const line_from = (from, to) => {
  let d = `M${at(from)}`;
  for (let i = from + 1; i <= to; ++i) d += `L${at(i)}`;
  return d;
};

function grid_step() {
  const wanted = 64 / pixels.scale;
  const power = 10 ** Math.floor(Math.log10(wanted));
  return [1, 2, 5, 10].find(factor => factor * power >= wanted) * power;
}
const length_words = cm => cm >= 100 ? `${trim(cm / 100, 2)} m` : `${trim(cm, 2)} cm`;

function draw_grid(parent) {
  const grid = grid_step();
  const first_x = Math.ceil(-pixels.left / pixels.scale / grid), last_x = Math.floor((pixels.width - pixels.left) / pixels.scale / grid);
  const first_y = Math.ceil((pixels.top - pixels.height) / pixels.scale / grid), last_y = Math.floor(pixels.top / pixels.scale / grid);
  for (let n = first_x; n <= last_x; ++n) {
    const x = Math.round(px(n * grid)) + .5;
    shape("path", { d: `M${x} 0V${pixels.height}`, class: n === 0 ? "grid-line strong" : "grid-line" }, parent);
    if (x > 70 && x < pixels.width - 150)
      shape("text", { x, y: pixels.height - 8, "text-anchor": "middle", class: "grid-word" }, parent).textContent = trim(n * grid, 3);
  }
  for (let n = first_y; n <= last_y; ++n) {
    const y = Math.round(py(n * grid)) + .5;
    shape("path", { d: `M0 ${y}H${pixels.width}`, class: n === 0 ? "grid-line strong" : "grid-line" }, parent);
    if (y > 130 && y < pixels.height - 24)
      shape("text", { x: 8, y: y - 4, class: "grid-word" }, parent).textContent = trim(n * grid, 3);
  }
  const long = grid * pixels.scale, right = pixels.width - 16, low = pixels.height - 14;
  shape("path", { d: `M${right - long} ${low - 5}v5h${long}v-5`, class: "scale" }, parent);
  shape("text", { x: right - long / 2, y: low - 8, "text-anchor": "middle", class: "scale-word" }, parent).textContent = length_words(grid);
}

const hit_path = "M-5 -5L5 5M-5 5L5 -5";
function draw_marks(parent) {
  const pin = (event, draw) => {
    if (event.x === undefined) return;
    const group = shape("g", { transform: `translate(${px(event.x).toFixed(1)} ${py(event.y).toFixed(1)})` }, parent);
    shape("title", {}, group).textContent = `${seconds(event.t)} s: ${event.text}`;
    draw(group);
  };
  for (const event of events) {
    if (event.kind === "marker") pin(event, g => {
      shape("path", { d: "M0 -6L6 0L0 6L-6 0Z", class: "mark-marker" }, g);
      shape("text", { x: 9, y: 4, class: "mark-word" }, g).textContent = event.short ?? "";
    });
    if (event.kind === "collision") pin(event, g => shape("path", { d: hit_path, class: "mark-hit" }, g));
    if (event.kind === "error") pin(event, g => shape("path", { d: "M0 -8L8 6H-8Z", class: "mark-error" }, g));
  }
  if (!pose.t.length) return;
  const final = pose.t.length - 1;
  shape("circle", { cx: px(pose.x[0]), cy: py(pose.y[0]), r: 8, class: "mark-start" }, parent);
  if (!moved) return;
  const near = Math.hypot(px(pose.x[0]) - px(pose.x[final]), py(pose.y[0]) - py(pose.y[final])) < 34;
  shape("text", { x: px(pose.x[0]) + 13, y: py(pose.y[0]) + (near ? -8 : 4), class: "mark-word" }, parent).textContent = "start";
  shape("rect", { x: px(pose.x[final]) - 5, y: py(pose.y[final]) - 5, width: 10, height: 10, class: "mark-end" }, parent);
  shape("text", { x: px(pose.x[final]) + 13, y: py(pose.y[final]) + (near ? 16 : 4), class: "mark-word" }, parent).textContent = "end";
}

function draw_ball(parent) {
  const defs = shape("defs", {}, parent);
  const glow = shape("radialGradient", { id: "glow" }, defs);
  const lamp_stops = [shape("stop", { offset: .2, "stop-opacity": .75 }, glow), shape("stop", { offset: 1, "stop-opacity": 0 }, glow)];
  const shine = shape("radialGradient", { id: "shine", cx: .36, cy: .3, r: .75 }, defs);
  shape("stop", { offset: 0, "stop-color": "#fff", "stop-opacity": .85 }, shine);
  shape("stop", { offset: .45, "stop-color": "#fff", "stop-opacity": .12 }, shine);
  shape("stop", { offset: 1, "stop-color": "#000", "stop-opacity": .28 }, shine);
  const ball = shape("g", { id: "ball" }, parent);
  const halo = shape("circle", { r: moved ? 40 : 90, fill: "url(#glow)" }, ball);
  const r = moved ? 13 : 34;
  shape("ellipse", { cx: 2, cy: 4, rx: r, ry: r, class: "ball-shadow" }, ball);
  shape("circle", { r, class: "ball-body" }, ball);
  const lamp = shape("circle", { id: "ball-lamp", r: r - .7 }, ball);
  shape("circle", { r, fill: "url(#shine)" }, ball);
  const nose = shape("g", {}, ball);
  shape("path", { d: `M0 ${-r - 9}l5 8h-10z`, class: "mark-end" }, nose);
  const tail = shape("circle", { cy: r - 2, r: r / 5 + 1, fill: "#4a8dff" }, nose);
  return { ball, lamp, nose, tail, halo, lamp_stops };
}

function draw_map() {
  measure();
  for (const child of [...map.children]) if (child.nodeName !== "title") child.remove();
  map.setAttribute("viewBox", `0 0 ${pixels.width} ${pixels.height}`);
  draw_grid(shape("g", {}, map));
  const walls = shape("g", {}, map);
  for (const wall of run.walls) {
    const d = wall.axis === "x" ? `M${px(wall.at)} 0V${pixels.height}` : `M0 ${py(wall.at)}H${pixels.width}`;
    shape("path", { d, class: "wall" }, walls);
  }
  const ahead = shape("g", { class: "ahead" }, map);
  const halos = shape("g", { class: "halo" }, map);
  const casings = shape("g", {}, map);
  const dark = shape("g", {}, map); // unlit stretches lie below lit ones
  map.insertBefore(dark, casings);
  const done = shape("g", {}, map);
  const paint = stretch => stretch.color ? { stroke: css_color(stretch.color) } : {};
  for (const stretch of stretches) {
    const look = { class: stretch.color ? "run" : "run unlit", d: line_from(stretch.from, stretch.to), ...paint(stretch) };
    stretch.d = look.d;
    shape("path", { ...look, "stroke-width": 3 }, ahead);
    stretch.layers = [
      shape("path", { ...look, "stroke-width": 13 }, halos),
      ...stretch.color ? [shape("path", { class: "run casing", d: look.d, "stroke-width": 5.5 }, casings)] : [],
      shape("path", { ...look, "stroke-width": stretch.color ? 3.5 : 2.5 }, stretch.color ? done : dark),
    ];
    for (const layer of stretch.layers) layer.setAttribute("visibility", "hidden");
    stretch.state = "ahead";
  }
  draw_marks(shape("g", {}, map));
  layers = draw_ball(map);
}

/** Shows the part of the path that lies before this moment; only what changed is touched. */
function draw_progress(state) {
  const i = state.index;
  for (const stretch of stretches) {
    const wanted = stretch.to <= i ? "done" : stretch.from <= i ? "open" : "ahead";
    if (wanted === stretch.state && wanted !== "open") continue;
    const cut = wanted === "open", whole = !cut && stretch.state === "open";
    const d = cut
      ? `${line_from(stretch.from, Math.min(i, stretch.to))}L${px(state.x).toFixed(1)} ${py(state.y).toFixed(1)}`
      : stretch.d;
    for (const layer of stretch.layers) {
      if (cut || whole) layer.setAttribute("d", d);
      layer.setAttribute("visibility", wanted === "ahead" ? "hidden" : "visible");
    }
    stretch.state = wanted;
  }
}

/** Following moves the map only when the ball comes near its edge. */
function leaves_view(state) {
  const x = px(state.x) / pixels.width, y = py(state.y) / pixels.height;
  return x < .2 || x > .8 || y < .2 || y > .8;
}

function zoom_by(factor) {
  view.zoom = clamp(view.zoom * factor, .2, 60);
  redraw();
}
function fit() {
  Object.assign(view, { zoom: 1, x: 0, y: 0 });
  redraw();
}
function toggle_follow() {
  view.follow = !view.follow;
  if (!view.follow) {
    const state = state_at(now);
    view.x = state.x - box.middle_x;
    view.y = state.y - box.middle_y;
  }
  $("follow").setAttribute("aria-pressed", String(view.follow));
  redraw();
}
$("zoom-in").addEventListener("click", () => zoom_by(1.5));
$("zoom-out").addEventListener("click", () => zoom_by(1 / 1.5));
$("zoom-fit").addEventListener("click", fit);
$("follow").addEventListener("click", toggle_follow);
map.addEventListener("wheel", event => {
  if (!event.ctrlKey && !event.metaKey) return; // a plain wheel scrolls the page
  event.preventDefault();
  zoom_by(event.deltaY < 0 ? 1.15 : 1 / 1.15);
}, { passive: false });
map.addEventListener("pointerdown", event => {
  if (view.follow || event.pointerType === "touch") return;
  map.setPointerCapture(event.pointerId);
  const start = { x: event.clientX, y: event.clientY, view_x: view.x, view_y: view.y };
  const drag = moved_to => {
    view.x = start.view_x - (moved_to.clientX - start.x) / pixels.scale;
    view.y = start.view_y + (moved_to.clientY - start.y) / pixels.scale;
    redraw();
  };
  map.addEventListener("pointermove", drag);
  map.addEventListener("pointerup", () => map.removeEventListener("pointermove", drag), { once: true });
  map.addEventListener("pointercancel", () => map.removeEventListener("pointermove", drag), { once: true });
});
if (!moved) {
  $("still").textContent = pose.t.length ? "The ball stayed where it was." : "The ball did not move.";
  $("still").hidden = false;
}

// ---- what the ball is doing now ----
const readings = {};
for (const [name, words] of [["position", "at"], ["speed", "speed"], ["heading", "heading"], ["led", "LED"], ["line", "line"]]) {
  readings[name] = element("dd", { "data-now": name });
  const pair = element("div");
  pair.append(element("dt", {}, words), readings[name]);
  $("now").append(pair);
}
readings.led.append(element("span", { class: "swatch" }), document.createTextNode(""));

// ---- program text ----
let shown_file = 0;
let rows = [];
function show_file(index) {
  shown_file = index;
  const file = run.files[index];
  const body = $("source").tBodies[0];
  body.replaceChildren();
  rows = [];
  if (!file) return;
  $("source-title").textContent = run.files.length > 1 ? "Program" : file.name;
  const ran = new Map(file.counts.map(([line, count, first]) => [line, { count, first }]));
  const most = Math.max(1, ...file.counts.map(([, count]) => count));
  file.text.replace(/\r\n?/g, "\n").replace(/\n$/, "").split("\n").forEach((text, i) => {
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
    row.append(element("td", { class: "no" }, String(line)), cell, element("td", {}, text || " "));
    body.append(row);
    rows.push(row);
  });
  current_row = null;
}
$("source").addEventListener("click", event => {
  const row = event.target.closest("tr[data-first]");
  if (row) seek(Number(row.dataset.first));
});
if (run.files.length > 1) {
  run.files.forEach((file, i) => $("file").append(element("option", { value: i }, file.name)));
  $("file").hidden = false;
  $("file").addEventListener("change", () => { show_file(Number($("file").value)); show_line(); });
}
let current_row = null;
function show_line() {
  const own = steps[shown_file];
  const i = own ? last_at(own.t, now) : -1;
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
/** Scrolls only the pane, never the page. */
function keep_in_view(pane, child) {
  const outer = pane.getBoundingClientRect(), inner = child.getBoundingClientRect();
  if (inner.top < outer.top || inner.bottom > outer.bottom)
    pane.scrollTop += inner.top - outer.top - pane.clientHeight / 2;
}

// ---- list of events ----
const kinds = {
  print: { words: "prints", icon: "M1 3h12v7H6l-3 3v-3H1z" },
  error: { words: "errors", icon: "M7 1L14 13H0z" },
  marker: { words: "markers", icon: "M7 1l6 6-6 6-6-6z" },
  collision: { words: "collisions", icon: "M2 2l10 10M2 12L12 2" },
  macro: { words: "macros", icon: "M3 2v10l9-5z" },
  sleep: { words: "sleep", icon: "M10 9a5 5 0 1 1-5-7 4 4 0 0 0 5 7z" },
};
const event_rows = [];
function icon(kind) {
  const art = shape("svg", { viewBox: "0 0 14 14", class: "icon", "aria-hidden": "true" });
  const stroked = kind === "collision";
  shape("path", { d: kinds[kind].icon, fill: stroked ? "none" : "currentColor", stroke: stroked ? "currentColor" : "none", "stroke-width": 2.4 }, art);
  return art;
}
events.forEach((event, i) => {
  if (event.gap && i > 0)
    $("events").append(element("li", { class: "gap" }, `${event.gap.toLocaleString("en")} events in between are not listed`));
  const item = element("li", { class: event.kind });
  const button = element("button", { type: "button", "data-t": event.t, "data-kind": event.kind });
  const words = element("span", { class: "words" }, event.text.replace(/\n$/, "") || "(empty line)");
  button.append(element("span", { class: "t" }, seconds(event.t)), icon(event.kind), words);
  button.setAttribute("aria-label", `${seconds(event.t)} seconds, ${event.kind}: ${event.text}`);
  button.addEventListener("click", () => seek(event.t));
  item.append(button);
  $("events").append(item);
  event_rows.push(item);
});
const hidden_kinds = new Set();
for (const [kind, { words }] of Object.entries(kinds)) {
  const count = run.counts[kind] ?? 0;
  if (!count) continue;
  const button = element("button", { type: "button", "aria-pressed": "true", "data-filter": kind, "data-count": count }, `${words} ${count.toLocaleString("en")}`);
  button.addEventListener("click", () => {
    if (!hidden_kinds.delete(kind)) hidden_kinds.add(kind);
    button.setAttribute("aria-pressed", String(!hidden_kinds.has(kind)));
    events.forEach((event, i) => { event_rows[i].hidden = hidden_kinds.has(event.kind); });
  });
  $("filters").append(button);
}
$("no-events").hidden = events.length > 0;
const event_times = events.map(event => event.t);
let current_event = -2;
function show_event() {
  const i = last_at(event_times, now);
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
function jump(by) {
  const visible = events.filter(event => !hidden_kinds.has(event.kind));
  const target = by > 0 ? visible.find(event => event.t > now) : visible.filter(event => event.t < now).pop();
  seek(target ? target.t : by > 0 ? end : 0);
}
$("previous").addEventListener("click", () => jump(-1));
$("next").addEventListener("click", () => jump(1));

// ---- values over time ----
const lanes = [];
/** `series`: [{name, t, v, digits}]; `cyclic`: 360 where a value wraps round; `between`: what a state
 *  between two poses says, where values are not held. */
function add_lane({ id, name, unit, series, cyclic, low, high, held, between }) {
  const values = series.flatMap(one => one.v.length ? [Math.min(...one.v), Math.max(...one.v)] : [0]);
  let from = low ?? Math.min(...values), to = high ?? Math.max(...values);
  if (to - from < 1e-9) { to += 1; from -= low === undefined ? 1 : 0; }
  const lane = element("div", { class: series.length === 1 ? "lane one" : "lane", "data-lane": id });
  const words = element("div", { class: "lane-words" });
  words.append(element("b", {}, unit ? `${name} (${unit})` : name));
  const outputs = series.map((one, i) => {
    const line = element("span");
    line.append(element("i", { class: `s${i}` }, series.length > 1 ? one.name : "now"));
    const output = element("output", { "data-series": one.name, "aria-live": "off" });
    line.append(output);
    words.append(line);
    return output;
  });
  const plot = element("div", { class: "lane-plot" });
  const art = shape("svg", { preserveAspectRatio: "none", role: "img", "aria-label": `${name}, ${trim(from, 1)} to ${trim(to, 1)} ${unit}` }, plot);
  const playhead = element("div", { class: "playhead" });
  plot.append(playhead);
  lane.append(words, plot);
  $("lanes").append(lane);
  const made = { plot, art, playhead, outputs, series, from, to, cyclic, held, between };
  plot.addEventListener("pointerdown", event => scrub(event, plot));
  lanes.push(made);
}
function scrub(event, plot) {
  const area = plot.getBoundingClientRect();
  const go = to => seek(clamp((to.clientX - area.left) / area.width, 0, 1) * end);
  go(event);
  plot.setPointerCapture(event.pointerId);
  plot.addEventListener("pointermove", go);
  for (const name of ["pointerup", "pointercancel"])
    plot.addEventListener(name, () => plot.removeEventListener("pointermove", go), { once: true });
}
function draw_lane(lane) {
  const width = Math.max(lane.plot.clientWidth, 40), height = 66;
  lane.art.setAttribute("viewBox", `0 0 ${width} ${height}`);
  lane.art.replaceChildren();
  const y = value => (height - 9 - (value - lane.from) / (lane.to - lane.from) * (height - 18)).toFixed(1);
  const x = t => t / end * width;
  const ticks = tick_times(width);
  for (const t of ticks) shape("path", { d: `M${x(t).toFixed(1)} 0V${height}`, class: "grid-line" }, lane.art);
  if (lane.from < 0 && lane.to > 0) shape("path", { d: `M0 ${y(0)}H${width}`, class: "grid-line strong" }, lane.art);
  lane.series.forEach((one, k) => {
    let d = "", previous = null, last_x = -9;
    for (let i = 0; i < one.t.length; ++i) {
      const here = x(one.t[i]);
      if (i && i < one.t.length - 1 && here - last_x < .35 && Math.abs(one.v[i] - previous) * 60 < lane.to - lane.from) continue;
      const wraps = lane.cyclic && previous !== null && Math.abs(one.v[i] - previous) > lane.cyclic / 2;
      const gap = previous !== null && !lane.held && one.t[i] - one.t[i - 1] > run.pose.step * 1.5;
      if (gap || (lane.held && previous !== null)) d += `H${here.toFixed(1)}`;
      d += `${previous === null || wraps ? "M" : "L"}${here.toFixed(1)} ${y(one.v[i])}`;
      previous = one.v[i];
      last_x = here;
    }
    if (d) d += `H${width}`;
    shape("path", { d: d || "M0 0", class: `line s${k}` }, lane.art);
  });
  shape("text", { x: 4, y: 10 }, lane.art).textContent = trim(lane.to, 1);
  shape("text", { x: 4, y: height - 3 }, lane.art).textContent = trim(lane.from, 1);
}
function tick_times(width) {
  const wanted = end / Math.max(width / 90, 1);
  const steps = [.05, .1, .2, .5, 1, 2, 5, 10, 15, 30, 60, 120, 300, 600, 1800, 3600, 7200, 36000].map(s => s * 1e6);
  const by = steps.find(one => one >= wanted) ?? 36e9;
  const list = [];
  for (let t = by; t < end; t += by) list.push(t);
  return list;
}
function draw_axis() {
  const axis = $("axis");
  const width = Math.max(axis.clientWidth, 40);
  axis.replaceChildren();
  const art = shape("svg", { viewBox: `0 0 ${width} 30` }, axis);
  for (const t of tick_times(width)) {
    const words = t >= 60e6 ? `${Math.floor(t / 60e6)}:${String(Math.round(t % 60e6 / 1e6)).padStart(2, "0")}` : `${trim(t / 1e6, 2)} s`;
    shape("text", { x: t / end * width, y: 19, "text-anchor": "middle" }, art).textContent = words;
  }
}
function show_lanes(state) {
  const share = `${now / end * 100}%`;
  led_playhead.style.left = share;
  for (const lane of lanes) {
    lane.playhead.style.left = share;
    lane.series.forEach((one, k) => {
      const i = last_at(one.t, now);
      const value = lane.between ? lane.between(state) : i < 0 ? 0 : one.v[i];
      lane.outputs[k].textContent = value.toFixed(one.digits);
    });
  }
}
function add_thin_lane(name, id) {
  const row = element("div", { class: "lane thin" });
  const words = element("div", { class: "lane-words" });
  words.append(element("b", {}, name));
  const plot = element("div", { class: "lane-plot", id, "aria-hidden": "true" });
  row.append(words, plot);
  $("lanes").append(row);
  plot.addEventListener("pointerdown", event => scrub(event, plot));
  return plot;
}
add_thin_lane("Time", "axis");
const led_plot = add_thin_lane("LED", "led-lane");
const led_art = shape("svg", { preserveAspectRatio: "none" }, led_plot);
const led_playhead = element("div", { class: "playhead" });
led_plot.append(led_playhead);
add_lane({ id: "speed", name: "Speed", unit: "cm/s", low: 0, between: state => state.speed, series: [{ name: "speed", t: pose.t, v: pose.speed, digits: 1 }] });
add_lane({ id: "heading", name: "Heading", unit: "°", low: 0, high: 360, cyclic: 360, between: state => state.heading, series: [{ name: "heading", t: pose.t, v: pose.heading, digits: 1 }] });
if (backled.t.length)
  add_lane({ id: "backled", name: "Aiming light", unit: "", low: 0, high: 255, held: true, series: [{ name: "backLED", t: backled.t, v: backled.value, digits: 0 }] });
for (const group of run.sensors) {
  const t = sums(group.t);
  add_lane({ id: group.id, name: group.name, unit: group.unit, held: true,
    series: group.series.map(one => ({ name: one.name, t, v: column(one.v, one.scale), digits: one.digits })) });
}
// ---- time ----
let now = 0, playing = false, last_frame = 0;
const slider = $("time");
slider.max = end;
const rates = [.1, .25, .5, 1, 2, 5, 10, 30, 60, 300];
const rate_start = rates.find(rate => end / 1e6 / rate <= 120 && rate >= 1) ?? 300;
for (const rate of rates) $("rate").append(element("option", { value: rate, ...(rate === rate_start ? { selected: "" } : {}) }, `${rate}×`));

/** The colours over time: in the slider, and above the other values. */
function draw_colors(art) {
  const width = 1000;
  art.setAttribute("viewBox", `0 0 ${width} 10`);
  const x = t => clamp(t / end * width, 0, width);
  led.t.forEach((t, i) => {
    if (!led.rgb[i]) return;
    const until = i + 1 < led.t.length ? led.t[i + 1] : end;
    shape("rect", { x: x(t).toFixed(2), y: 0, width: Math.max(x(until) - x(t), .25).toFixed(2), height: 10, fill: css_color(led.rgb[i]), "shape-rendering": "crispEdges" }, art);
  });
}

function show() {
  const state = state_at(now);
  const lamp = lamp_at(now), lamp_color = lamp ? css_color(lamp) : "transparent";
  if (view.follow && leaves_view(state)) draw_map();
  draw_progress(state);
  layers.ball.setAttribute("transform", `translate(${px(state.x).toFixed(2)} ${py(state.y).toFixed(2)})`);
  layers.nose.setAttribute("transform", `rotate(${state.heading.toFixed(1)})`);
  layers.lamp.setAttribute("fill", lamp_color);
  layers.tail.setAttribute("opacity", (tail_at(now) / 255).toFixed(3));
  layers.halo.setAttribute("opacity", lamp ? 1 : 0);
  for (const stop of layers.lamp_stops) stop.setAttribute("stop-color", lamp_color);
  document.documentElement.style.setProperty("--lamp", lamp_color);
  if (lamp) document.documentElement.style.setProperty("--lamp-solid", lamp_color);
  else document.documentElement.style.removeProperty("--lamp-solid");
  readings.position.textContent = `${state.x.toFixed(1)}, ${state.y.toFixed(1)} cm`;
  readings.speed.textContent = `${state.speed.toFixed(1)} cm/s`;
  readings.heading.textContent = `${state.heading.toFixed(1)}°`;
  readings.led.firstChild.style.background = lamp_color;
  readings.led.lastChild.textContent = rgb_words(lamp);
  $("clock").textContent = clock_text(now);
  slider.value = now;
  slider.setAttribute("aria-valuetext", `${seconds(now)} of ${seconds(end)} seconds`);
  show_line();
  show_event();
  show_lanes(state);
}
function redraw() {
  draw_map();
  show();
}
function seek(t) {
  now = clamp(Math.round(t), 0, end);
  show();
}
function set_playing(wanted) {
  playing = wanted;
  if (playing && now >= end) now = 0;
  $("play").setAttribute("aria-label", playing ? "Pause" : "Play");
  $("play-icon").setAttribute("d", playing ? "M6 4h4v16H6zM14 4h4v16h-4z" : "M7 4l14 8-14 8z");
  last_frame = performance.now();
  if (playing) requestAnimationFrame(frame);
}
function frame(stamp) {
  if (!playing) return;
  const passed = Math.max(stamp - last_frame, 0);
  last_frame = stamp;
  seek(now + passed * 1000 * Number($("rate").value));
  if (now >= end) set_playing(false);
  else requestAnimationFrame(frame);
}
$("play").addEventListener("click", () => set_playing(!playing));
slider.addEventListener("input", () => seek(Number(slider.value)));

// ---- keys ----
$("keys-button").addEventListener("click", () => $("keys").showModal());
document.addEventListener("keydown", event => {
  if (event.ctrlKey || event.metaKey || event.altKey || $("keys").open) return;
  const where = event.target;
  if (where instanceof HTMLSelectElement) return;
  const by = event.shiftKey ? 1e6 : 50e3;
  const actions = {
    ArrowLeft: () => seek(now - by), ArrowRight: () => seek(now + by),
    Home: () => seek(0), End: () => seek(end),
    n: () => jump(1), p: () => jump(-1),
    "+": () => zoom_by(1.5), "=": () => zoom_by(1.5), "-": () => zoom_by(1 / 1.5), 0: fit,
    f: toggle_follow, t: next_theme, "?": () => $("keys").showModal(),
    " ": () => set_playing(!playing),
  };
  if (event.key === " " && where instanceof HTMLButtonElement) return; // a button has its own use for it
  const action = actions[event.key];
  if (!action) return;
  event.preventDefault();
  action();
});

// ---- begin ----
show_file(0);
const everything = () => { draw_map(); lanes.forEach(draw_lane); draw_axis(); show(); };
draw_colors($("track"));
draw_colors(led_art);
const asked = /^#t=([0-9.]+)$/.exec(location.hash);
if (asked) now = clamp(Number(asked[1]) * 1e6, 0, end);
everything();
let pending = 0;
new ResizeObserver(() => {
  cancelAnimationFrame(pending);
  pending = requestAnimationFrame(everything);
}).observe(map);
})();
