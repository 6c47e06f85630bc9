"use strict";
/** Plays runs back on the parts of the page that are there: `load()` takes the data of a run, of the
 *  report's own or, again and again, of one that still goes on. `keys`: within what its keys work;
 *  `on_moment`: is told the lines that ran last, file by file, when the moment changes. */
function orb_player({ keys = document, on_moment = null } = {}) {
const $ = id => document.getElementById(id);
const svg_ns = "http://www.w3.org/2000/svg";

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

// ---- a run, and the ball at any moment of it ----
function turn(from, to, share) {
  let by = (to - from) % 360;
  if (by > 180) by -= 360;
  if (by < -180) by += 360;
  return ((from + by * share) % 360 + 360) % 360;
}
// Columns are differences of whole numbers, summed up again here.
const sums = list => { let sum = 0; return list.map(step => sum += step); };
const column = (list, scale) => sums(list).map(value => value / scale);

const base_name = path => path.split("/").pop() || path;

function journey(run) {
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
  const line_times = sums(run.line.t);
  const variables = (run.variables ?? []).map(one => ({ ...one, t: sums(one.t), v: sums(one.v) }));
  const state_at = t => {
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
  };
  const lamp_at = t => led.rgb[last_at(led.t, t)] ?? 0;
  const tail_at = t => backled.value[last_at(backled.t, t)] ?? 0;
  // Stretches of path in one colour; the LED may change between two poses.
  const stretches = [];
  let color = -1;
  for (let i = 1; i < pose.t.length; ++i) {
    const lit = lamp_at(pose.t[i - 1]);
    if (pose.x[i] === pose.x[i - 1] && pose.y[i] === pose.y[i - 1]) continue;
    const open = stretches[stretches.length - 1];
    if (lit === color && open && open.to === i - 1) open.to = i;
    else stretches.push({ from: i - 1, to: i, color: lit });
    color = lit;
  }
  const name = base_name(run.title);
  return { run, name, pose, led, backled, steps, line_times, variables, stretches, state_at, lamp_at, tail_at };
}
// What is played back; take() sets it.
let main, before, runs, end;
let now = 0, playing = false, last_frame = 0;
let live = false; // it still runs: what is shown next continues what is shown
const live_delay = 400e3;
function take(run, run_before) {
  main = journey(run);
  before = run_before ? journey(run_before) : null;
  runs = before ? [before, main] : [main];
  end = Math.max(1, ...runs.map(one => one.run.end.t));
}

const css_color = rgb => "#" + rgb.toString(16).padStart(6, "0");
const rgb_words = rgb => `${rgb >> 16}, ${rgb >> 8 & 255}, ${rgb & 255}`;
/** How bright a colour is, from 0 to 1: a pale or a deep one needs an outline of its own. */
const brightness = rgb => (.3 * (rgb >> 16) + .59 * (rgb >> 8 & 255) + .11 * (rgb & 255)) / 255;
const position_words = state => `${state.x.toFixed(1)}, ${state.y.toFixed(1)} cm`;
const speed_words = state => `${state.speed.toFixed(1)} cm/s`;

// ---- heading of the page ----
function show_heading() {
  const { run } = main;
  if ($("title")) {
    document.title = `${main.name} · orb run`;
    // A name breaks after a sign, never inside a word.
    $("title").replaceChildren(...main.name.split(/(?<=[-_.])/).flatMap((part, i) => i ? [element("wbr"), part] : [part]));
    $("title").title = run.title;
  }
  $("outcome").textContent = run.end.text;
  $("outcome").className = run.end.reason === "error" ? "bad" : "";
  $("totals").replaceChildren();
  for (const [name, value, id] of run.totals) {
    const box = element("div");
    box.append(element("dt", {}, name), element("dd", { "data-total": id }, value));
    const other = before?.run.totals.find(total => total[2] === id);
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
function next_theme() {
  theme = themes[(themes.indexOf(theme) + 1) % themes.length];
  try { localStorage.setItem("orb-theme", theme); } catch { /* as above */ }
  show_theme();
}
$("theme").addEventListener("click", next_theme);
show_theme();

// ---- the maps: of the run, and of the one before it ----
const view = { zoom: 1, x: 0, y: 0, follow: false };
const least = list => list.reduce((a, b) => Math.min(a, b), list[0] ?? 0);
const most = list => list.reduce((a, b) => Math.max(a, b), list[0] ?? 0);
let box, moved, mapped;
function survey() {
  const corners = runs.flatMap(one => one.run.course ? [one.run.course.low, one.run.course.high] : []);
  const x = runs.flatMap(one => one.pose.x).concat(corners.map(corner => corner[0]));
  const y = runs.flatMap(one => one.pose.y).concat(corners.map(corner => corner[1]));
  const [left, right, low, high] = [least(x), most(x), least(y), most(y)];
  box = { left, right, low, high, middle_x: (left + right) / 2, middle_y: (low + high) / 2 };
  const spread = axis => { const list = runs.flatMap(one => one.pose[axis]); return most(list) - least(list); };
  moved = spread("x") > 1 || spread("y") > 1;
  // A map has a scale where something lies on it; else it shows the ball alone.
  mapped = moved || runs.some(one => one.run.course);
}
const length_words = cm => cm >= 100 ? `${trim(cm / 100, 2)} m` : `${trim(cm, 2)} cm`;
const hit_path = "M-5 -5L5 5M-5 5L5 -5";
const mark_art = {
  start: g => shape("circle", { r: 8, class: "mark-start" }, g),
  end: g => shape("rect", { x: -5, y: -5, width: 10, height: 10, class: "mark-end" }, g),
  bump: g => shape("circle", { r: 6, class: "mark-hit" }, g),
  collision: g => shape("path", { d: hit_path, class: "mark-hit" }, g),
  marker: g => shape("path", { d: "M0 -6L6 0L0 6L-6 0Z", class: "mark-marker" }, g),
  error: g => shape("path", { d: "M0 -8L8 6H-8Z", class: "mark-error" }, g),
};

function make_map(map) {
  let of, run, pose, stretches;
  const load = one => { of = one; ({ run, pose, stretches } = one); };
  let pixels = { width: 0, height: 0, scale: 1, left: 0, top: 0 };
  let layers = null;
  const px = x => pixels.left + x * pixels.scale;
  const py = y => pixels.top - y * pixels.scale;
  const at = i => `${px(pose.x[i]).toFixed(1)} ${py(pose.y[i]).toFixed(1)}`;

  function measure() {
    const area = map.getBoundingClientRect();
    const width = Math.max(area.width, 50), height = Math.max(area.height, 50);
    const wide = Math.max(box.right - box.left, 20), tall = Math.max(box.high - box.low, 20);
    const fit = Math.min((width - 96) / wide, (height - 84) / tall);
    const scale = Math.max(fit, .02) * view.zoom;
    const center_x = view.follow ? of.state_at(now).x : box.middle_x + view.x;
    const center_y = view.follow ? of.state_at(now).y : box.middle_y + view.y;
    pixels = { width, height, scale, left: width / 2 - center_x * scale, top: height / 2 + center_y * scale };
  }
  function line_from(from, to) {
    let d = `M${at(from)}`;
    for (let i = from + 1; i <= to; ++i) d += `L${at(i)}`;
    return d;
  }
  const wall_pixels = axis => run.walls.filter(wall => wall.axis === axis).map(wall => axis === "x" ? px(wall.at) : py(wall.at));

  /** Walls lie on the lines and under the words. */
  function draw_grid(lines, words) {
    const grid = grid_step(pixels.scale);
    const first_x = Math.ceil(-pixels.left / pixels.scale / grid), last_x = Math.floor((pixels.width - pixels.left) / pixels.scale / grid);
    const first_y = Math.ceil((pixels.top - pixels.height) / pixels.scale / grid), last_y = Math.floor(pixels.top / pixels.scale / grid);
    const upright = wall_pixels("x"), level = wall_pixels("y");
    const clear = (value, walls, room) => walls.every(wall => Math.abs(wall - value) > room);
    const low_row = clear(pixels.height - 10, level, 12), left_row = clear(18, upright, 22);
    for (let n = first_x; n <= last_x; ++n) {
      const x = Math.round(px(n * grid)) + .5;
      shape("path", { d: `M${x} 0V${pixels.height}`, class: n === 0 ? "grid-line strong" : "grid-line" }, lines);
      if (low_row && x > 44 && x < pixels.width - 20 && clear(x, upright, 20))
        shape("text", { x, y: pixels.height - 7, "text-anchor": "middle", class: "grid-word" }, words).textContent = trim(n * grid, 3);
    }
    for (let n = first_y; n <= last_y; ++n) {
      const y = Math.round(py(n * grid)) + .5;
      shape("path", { d: `M0 ${y}H${pixels.width}`, class: n === 0 ? "grid-line strong" : "grid-line" }, lines);
      if (left_row && y > 16 && y < pixels.height - 22 && clear(y, level, 14))
        shape("text", { x: 8, y: y - 4, class: "grid-word" }, words).textContent = trim(n * grid, 3);
    }
  }
  const point = ([x, y]) => `${px(x).toFixed(1)} ${py(y).toFixed(1)}`;
  function draw_zones(parent) {
    for (const zone of run.course?.zones ?? []) {
      const d = zone.rings.map(ring => `M${ring.map(point).join("L")}z`).join("");
      shape("path", { d, class: "zone", "fill-rule": zone.evenodd ? "evenodd" : "nonzero", "data-zone": zone.id }, parent);
      const x = zone.rings.flat().map(place => px(place[0])), y = zone.rings.flat().map(place => py(place[1]));
      shape("text", { x: (Math.min(...x) + Math.max(...x)) / 2, y: Math.min(...y) + 15, "text-anchor": "middle", class: "zone-word" }, parent).textContent = zone.id;
    }
  }
  const segments = () => run.walls.filter(wall => wall.from).map(({ from, to }) => [px(from[0]), py(from[1]), px(to[0]), py(to[1])]);
  /** Whether a line meets a rectangle. */
  function meets([x1, y1, x2, y2], left, right, high, low) {
    let enter = 0, leave = 1;
    for (const [start, way, least, most] of [[x1, x2 - x1, left, right], [y1, y2 - y1, high, low]]) {
      if (way === 0) { if (start < least || start > most) return false; continue; }
      const a = (least - start) / way, b = (most - start) / way;
      enter = Math.max(enter, Math.min(a, b));
      leave = Math.min(leave, Math.max(a, b));
    }
    return enter <= leave;
  }
  function draw_walls(parent) {
    for (const wall of run.walls) if (wall.from) shape("path", { d: `M${point(wall.from)}L${point(wall.to)}`, class: "wall" }, parent);
    for (const x of wall_pixels("x")) shape("path", { d: `M${x} 0V${pixels.height}`, class: "wall" }, parent);
    for (const y of wall_pixels("y")) shape("path", { d: `M0 ${y}H${pixels.width}`, class: "wall" }, parent);
  }
  /** Where a word beside a point meets the fewest of path, walls, marks and words. */
  function free_place(x, y, words, taken) {
    const wide = 6.4 * words.length, tall = 12;
    const places = [[18, 4], [-18 - wide, 4], [16, -12], [16, 20], [-16 - wide, -12], [-16 - wide, 20], [-wide / 2, -24], [-wide / 2, 34]];
    const cost = ([dx, dy]) => {
      const left = x + dx - 3, right = left + wide + 6, low = y + dy + 4, high = low - tall - 4;
      const inside = (a, b) => a > left && a < right && b > high && b < low;
      let sum = left < 2 || right > pixels.width - 2 || high < 2 || low > pixels.height - 2 ? 1e6 : 0;
      for (let i = 0; i < pose.t.length; ++i) if (inside(px(pose.x[i]), py(pose.y[i]))) ++sum;
      for (const wall of wall_pixels("x")) if (wall > left - 3 && wall < right + 3) sum += 500;
      for (const wall of wall_pixels("y")) if (wall > high - 3 && wall < low + 3) sum += 500;
      for (const wall of segments()) if (meets(wall, left, right, high, low)) sum += 500;
      for (const one of taken) if (one.left < right && one.right > left && one.high < low && one.low > high) sum += 1000;
      return sum;
    };
    const best = places.map(place => [cost(place), place]).reduce((a, b) => b[0] < a[0] ? b : a)[1];
    taken.push({ left: x + best[0], right: x + best[0] + wide, high: y + best[1] - tall, low: y + best[1] + 4 });
    return best;
  }
  function draw_marks(parent) {
    const taken = [];
    const pin = (x, y, kind, title) => {
      const group = shape("g", { transform: `translate(${px(x).toFixed(1)} ${py(y).toFixed(1)})`, "data-mark": kind }, parent);
      if (title) shape("title", {}, group).textContent = title;
      mark_art[kind](group);
      taken.push({ left: px(x) - 8, right: px(x) + 8, high: py(y) - 8, low: py(y) + 8 });
      return group;
    };
    // Marks in one place share their words.
    const labels = new Map();
    for (const event of run.events) {
      if (event.x === undefined || !event.short) continue;
      const place = `${px(event.x).toFixed(0)} ${py(event.y).toFixed(0)}`;
      if (!labels.has(place)) labels.set(place, { x: event.x, y: event.y, words: [] });
      labels.get(place).words.push(event.short);
    }
    const word = (x, y, words) => {
      const [dx, dy] = free_place(px(x), py(y), words, taken);
      shape("text", { x: px(x) + dx, y: py(y) + dy, class: "mark-word" }, parent).textContent = words;
    };
    for (const event of run.events) {
      if (event.x === undefined || !mark_art[event.kind]) continue;
      pin(event.x, event.y, event.kind, `${seconds(event.t)} s: ${event.text}`);
    }
    const some = list => list.length > 4 ? [...list.slice(0, 3), "…"] : list;
    if (labels.size < 40) for (const { x, y, words } of labels.values()) word(x, y, some(words).join(", "));
    if (!pose.t.length) return;
    const final = pose.t.length - 1;
    pin(pose.x[0], pose.y[0], "start");
    if (!moved) return;
    if (!live) pin(pose.x[final], pose.y[final], "end");
    word(pose.x[0], pose.y[0], "start");
    if (!live) word(pose.x[final], pose.y[final], "end");
  }
  function draw_ball(parent) {
    const defs = shape("defs", {}, parent);
    const glow = shape("radialGradient", { id: `${map.id}-glow` }, defs);
    const lamp_stops = [shape("stop", { offset: .2, "stop-opacity": .75 }, glow), shape("stop", { offset: 1, "stop-opacity": 0 }, glow)];
    const shine = shape("radialGradient", { id: `${map.id}-shine`, cx: .36, cy: .3, r: .75 }, defs);
    shape("stop", { offset: 0, "stop-color": "#fff", "stop-opacity": .85 }, shine);
    shape("stop", { offset: .45, "stop-color": "#fff", "stop-opacity": .12 }, shine);
    shape("stop", { offset: 1, "stop-color": "#000", "stop-opacity": .28 }, shine);
    const ball = shape("g", { class: "ball", ...of === main ? { id: "ball" } : {} }, parent);
    const halo = shape("circle", { r: mapped ? 40 : 90, fill: `url(#${map.id}-glow)` }, ball);
    const r = mapped ? 13 : 34;
    shape("ellipse", { cx: 2, cy: 4, rx: r, ry: r, class: "ball-shadow" }, ball);
    shape("circle", { r, class: "ball-body" }, ball);
    const lamp = shape("circle", { ...of === main ? { id: "ball-lamp" } : {}, r: r - .7 }, ball);
    shape("circle", { r, fill: `url(#${map.id}-shine)` }, ball);
    const nose = shape("g", {}, ball);
    shape("path", { d: `M0 ${-r - 9}l5 8h-10z`, class: "mark-end" }, nose);
    const tail = shape("circle", { cy: r - 2, r: r / 5 + 1, fill: "#4a8dff" }, nose);
    return { ball, lamp, nose, tail, halo, lamp_stops };
  }
  function draw() {
    measure();
    for (const child of [...map.children]) if (child.nodeName !== "title") child.remove();
    map.setAttribute("viewBox", `0 0 ${pixels.width} ${pixels.height}`);
    const grid = shape("g", {}, map);
    const floor = shape("g", {}, map); // zones lie on the grid
    draw_zones(floor);
    draw_walls(shape("g", {}, map));
    draw_grid(grid, shape("g", {}, map));
    const ahead = shape("g", { class: "ahead" }, map);
    const halos = shape("g", { class: "halo" }, map);
    const dark = shape("g", {}, map); // unlit stretches lie below lit ones
    const casings = shape("g", {}, map);
    const done = shape("g", {}, map);
    const casing_class = color => brightness(color) > .7 ? "run casing pale" : brightness(color) < .2 ? "run casing deep" : "run casing";
    for (const stretch of stretches) {
      const lit = stretch.color !== 0;
      const look = { class: lit ? "run" : "run unlit", d: line_from(stretch.from, stretch.to), ...lit ? { stroke: css_color(stretch.color) } : {} };
      stretch.d = look.d;
      if (lit) shape("path", { class: casing_class(stretch.color), d: look.d, "stroke-width": 4.5 }, ahead);
      shape("path", { ...look, "stroke-width": 3 }, ahead);
      stretch.layers = [
        ...lit ? [shape("path", { ...look, "stroke-width": 13 }, halos),
          shape("path", { class: casing_class(stretch.color), d: look.d, "stroke-width": 6 }, casings)] : [],
        shape("path", { ...look, "stroke-width": lit ? 3.5 : 2.5 }, lit ? done : dark),
      ];
      for (const layer of stretch.layers) layer.setAttribute("visibility", "hidden");
      stretch.state = "ahead";
    }
    draw_marks(shape("g", {}, map));
    draw_paper_scale(shape("g", { class: "paper-scale" }, map));
    layers = draw_ball(map);
  }
  /** On paper the map has another size than on the screen: the scale stands in it. */
  function draw_paper_scale(parent) {
    const cm = grid_step(pixels.scale), long = cm * pixels.scale;
    const right = pixels.width - 16, low = pixels.height - 12;
    shape("rect", { x: right - long - 8, y: low - 22, width: long + 16, height: 28 }, parent);
    shape("path", { d: `M${right - long} ${low - 5}v5h${long}v-5` }, parent);
    shape("text", { x: right - long / 2, y: low - 8, "text-anchor": "middle" }, parent).textContent = length_words(cm);
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
  function show(state) {
    const lamp = of.lamp_at(now), lamp_color = lamp ? css_color(lamp) : "transparent";
    if (view.follow && leaves_view(state)) draw();
    draw_progress(state);
    layers.ball.setAttribute("transform", `translate(${px(state.x).toFixed(2)} ${py(state.y).toFixed(2)})`);
    layers.nose.setAttribute("transform", `rotate(${state.heading.toFixed(1)})`);
    layers.lamp.setAttribute("fill", lamp_color);
    layers.tail.setAttribute("opacity", (of.tail_at(now) / 255).toFixed(3));
    layers.halo.setAttribute("opacity", lamp ? 1 : 0);
    for (const stop of layers.lamp_stops) stop.setAttribute("stop-color", lamp_color);
  }
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
    for (const name of ["pointerup", "pointercancel"])
      map.addEventListener(name, () => map.removeEventListener("pointermove", drag), { once: true });
  });
  return { load, draw, show, scale: () => pixels.scale, words: map.nextElementSibling };
}
const all_maps = [make_map($("map")), make_map($("map-before"))]; // the run's comes first
let maps = [];
function list_maps() {
  maps = all_maps.slice(0, runs.length);
  $("map").parentElement.hidden = false;
  $("map-before").parentElement.hidden = !before;
  if (before) maps.forEach((one, i) => { one.words.firstElementChild.textContent = i ? "before" : "this run"; });
  maps.forEach((one, i) => one.load(i ? before : main));
  document.body.classList.toggle("two", maps.length > 1);
}

/** 1, 2 or 5 times a power of ten: lines stand at least 64 pixels apart. */
function grid_step(scale) {
  const wanted = 64 / scale;
  const power = 10 ** Math.floor(Math.log10(wanted));
  return [1, 2, 5, 10].find(factor => factor * power >= wanted) * power;
}

// ---- what the signs on the map mean, and its scale ----
const legend_words = { start: "start", end: "end", bump: "ran into a wall", collision: "collision reported", marker: "marker", error: "error" };
function list_signs() {
  $("legend").replaceChildren();
  for (const [kind, words] of Object.entries(legend_words)) {
    const seen = kind === "start" ? main.pose.t.length : kind === "end" ? moved && !live : runs.some(one => one.run.events.some(event => event.kind === kind && event.x !== undefined));
    if (!seen) continue;
    const item = element("li", { "data-sign": kind });
    mark_art[kind](shape("svg", { viewBox: "-10 -10 20 20", "aria-hidden": "true" }, item));
    item.append(words);
    $("legend").append(item);
  }
  for (const [sign, words, seen] of [["wall", "wall", runs.some(one => one.run.walls.length)], ["zone", "zone", runs.some(one => one.run.course?.zones.length)], ["run unlit", "LED off", runs.some(one => one.stretches.some(stretch => !stretch.color))]]) {
    if (!seen) continue;
    const item = element("li", { "data-sign": sign.split(" ").pop() });
    shape("path", { d: "M-9 0H9", class: sign, "stroke-width": 2.5 }, shape("svg", { viewBox: "-10 -10 20 20", "aria-hidden": "true" }, item));
    item.append(words);
    $("legend").append(item);
  }
}
function draw_scale() {
  const cm = grid_step(maps[0].scale());
  $("scale-bar").style.width = `${(cm * maps[0].scale()).toFixed(1)}px`;
  $("scale-words").textContent = length_words(cm);
}
function draw_maps() {
  for (const one of maps) one.draw();
  draw_scale();
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
    const state = main.state_at(now);
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
function show_still() {
  $("still").textContent = main.pose.t.length ? "The ball stayed where it was." : "The ball did not move.";
  $("still").hidden = moved || live;
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
const kinds_of = (...words) => new Map(words.flatMap(Object.entries).flatMap(([kind, list]) => list.map(word => [word.toLowerCase(), kind])));
const languages_of = ({ words }) => ({
  basic: { words: kinds_of(words.basic), tokens: /(?<comment>'.*)|(?<string>"[^"]*"?)|(?<number>\d+)|(?<name>[A-Za-z_]\w*)|[^'"\dA-Za-z_]+/g },
  orb: { words: kinds_of(words.basic, words.structured), tokens: /(?<comment>'.*)|(?<string>"[^"]*"?)|(?<number>#[\da-f]{6}\b|\d\w*(?:\.\d\w*)?)|(?<name>[a-z_]\w*)|[^'"#\da-z_]+|#/gi },
  macro: { words: kinds_of(words.macro), tokens: /(?<comment>[#;].*)|(?<string>"(?:\\.|[^"\\])*"?)|(?<directive>\.\w+)|(?<number>-?\b\d\w*(?:\.\d+\w*)?)|(?<name>[A-Za-z_]\w*)|[^#;"\dA-Za-z_]/g },
});
/** A line in the colours of its language; what no rule knows stays as it is. */
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
let shown = null;
let shown_file = 0;
let rows = [];
function show_file(index) {
  shown_file = index;
  if (!$("source")) return; // an editor shows it
  const file = shown.run.files[index];
  rows = file ? source_rows(file) : [];
  $("source").tBodies[0].replaceChildren(...rows);
  if (!file) return;
  $("source-title").textContent = shown.run.files.length > 1 ? "Program" : base_name(file.name);
  $("source-title").title = file.name;
  current_row = null;
}
/** A row for each line of a file: its number, how often it ran, its text. */
function source_rows(file) {
  const ran = new Map(file.counts.map(([line, count, first]) => [line, { count, first }]));
  const most = file.counts.reduce((sum, [, count]) => Math.max(sum, count), 1);
  const ending = file.name.split(".").pop(), languages = languages_of(shown.run);
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
function list_files() {
  if (!$("source")) return show_file(0);
  $("file").replaceChildren(...shown.run.files.map((file, i) => element("option", { value: i }, base_name(file.name))));
  $("file").hidden = shown.run.files.length < 2;
  show_file(0);
}
$("file")?.addEventListener("change", () => { show_file(Number($("file").value)); show_line(); });
let current_row = null;
function show_line() {
  const own = shown.steps[shown_file];
  const i = own ? last_at(own.t, now) : -1;
  const inside = i >= 0;
  const row = inside ? rows[own.line[i] - 1] : null;
  readings.line.textContent = inside ? String(own.line[i]) : "none";
  on_moment?.(shown.steps.map(({ t, line }, k) => ({ name: shown.run.files[k].name, line: line[last_at(t, now)] ?? 0 })));
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

/** To the line that ran before or after this moment, in whatever file it stands. */
function step_line(by) {
  const times = shown.line_times, last = last_at(times, now);
  const wanted = by > 0 ? last + 1 : last_at(times, now - 1);
  if (wanted < 0 || wanted >= times.length) { seek(by > 0 ? end : 0); return; }
  const file = shown.run.line.file[wanted];
  if (file !== shown_file) {
    if ($("file")) $("file").value = file;
    show_file(file);
  }
  seek(times[wanted]);
}
$("line-back").addEventListener("click", () => step_line(-1));
$("line-on").addEventListener("click", () => step_line(1));

// ---- variables ----
let variable_rows = [];
function list_variables() {
  $("variables-pane").hidden = !shown.variables.length;
  document.querySelector(".board").classList.toggle("has-variables", shown.variables.length > 0);
  variable_rows = shown.variables.map(one => {
    const row = element("tr", { "data-variable": one.of ? `${one.of}.${one.name}` : one.name });
    const name = element("th", { scope: "row" }, one.name);
    if (one.of) name.append(element("span", {}, ` in ${one.of}`));
    const value = element("td", { class: "value" });
    const jumps = element("td", { class: "jumps" });
    const to_change = by => {
      const wanted = by > 0 ? last_at(one.t, now) + 1 : last_at(one.t, now - 1);
      if (one.t[wanted] !== undefined) seek(one.t[wanted]);
    };
    const buttons = [["\u2039", -1, "previous"], ["\u203a", 1, "next"]].map(([sign, by, words]) => {
      const button = element("button", { type: "button", "data-jump": words, "aria-label": `${words} change of ${one.name}` }, sign);
      button.addEventListener("click", () => to_change(by));
      return button;
    });
    jumps.append(...buttons);
    row.append(name, value, jumps);
    if (one.cut) row.title = "it changed more often than a report holds: some changes are left out";
    return { row, value, buttons, one };
  });
  $("variables").tBodies[0].replaceChildren(...variable_rows.map(({ row }) => row));
}
function show_variables() {
  const line_time = shown.line_times[last_at(shown.line_times, now)];
  for (const { row, value, buttons, one } of variable_rows) {
    const i = last_at(one.t, now);
    const words = String(i < 0 ? 0 : one.v[i]);
    if (value.textContent !== words) value.textContent = words;
    row.classList.toggle("changed", i >= 0 && one.t[i] >= line_time);
    buttons[0].disabled = last_at(one.t, now - 1) < 0;
    buttons[1].disabled = i + 1 >= one.t.length;
  }
}

// ---- list of events ----
const kinds = {
  print: { words: "prints", icon: "M1 3h12v7H6l-3 3v-3H1z" },
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
function list_events() {
  const listed = events.length;
  const goes_on = live && listed <= shown.run.events.length && events.every((event, i) => event.t === shown.run.events[i].t && !shown.run.events[i].gap);
  events = shown.run.events;
  event_times = events.map(event => event.t);
  if (!goes_on) {
    event_rows = [];
    current_event = -2;
    $("events").replaceChildren();
  }
  for (const [i, event] of events.entries()) {
    if (goes_on && i < listed) continue;
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
  }
  $("no-events").hidden = events.length > 0;
  $("filters").replaceChildren();
  for (const [kind, { words }] of Object.entries(kinds)) {
    const count = shown.run.counts[kind] ?? 0;
    if (!count) continue;
    const button = element("button", { type: "button", "data-filter": kind, "data-count": count }, `${words} ${count.toLocaleString("en")}`);
    button.addEventListener("click", () => {
      if (!hidden_kinds.delete(kind)) hidden_kinds.add(kind);
      show_kinds();
    });
    $("filters").append(button);
  }
  show_kinds();
}
function show_kinds() {
  for (const button of $("filters").children) button.setAttribute("aria-pressed", String(!hidden_kinds.has(button.dataset.filter)));
  events.forEach((event, i) => { event_rows[i].hidden = hidden_kinds.has(event.kind); });
}
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

// ---- which of two runs the lists show ----
function choose(one) {
  shown = one;
  for (const button of $("whose")?.children ?? []) button.setAttribute("aria-pressed", String(button.dataset.run === (one === main ? "run" : "before")));
  list_files();
  list_variables();
  list_events();
}
function list_runs() {
  if (!$("whose")) return;
  $("whose").replaceChildren();
  $("whose").hidden = !before;
  if (!before) return;
  for (const [name, words, one] of [["before", "before", before], ["run", "this run", main]]) {
    const button = element("button", { type: "button", "data-run": name }, words);
    button.addEventListener("click", () => { choose(one); show(); });
    $("whose").append(button);
  }
}

// ---- values over time ----
let lanes = [];
/** `series`: [{name, t, v, digits}]; `cyclic`: 360 where a value wraps round; `between`: what a state
 *  between two poses says, where values are not held; `other`: the same series of the run before. */
function add_lane({ id, name, unit, series, cyclic, low, high, held, between, other }) {
  const values = [...series, ...other ? [other] : []].flatMap(one => one.v.length ? [one.v.reduce((a, b) => Math.min(a, b)), one.v.reduce((a, b) => Math.max(a, b))] : [0]);
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
  const made = { plot, art, playhead, outputs, series, from, to, cyclic, held, between, other };
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
  const curve = (one, look) => {
    let d = "", previous = null, last_x = -9;
    for (let i = 0; i < one.t.length; ++i) {
      const here = x(one.t[i]);
      if (i && i < one.t.length - 1 && here - last_x < .35 && Math.abs(one.v[i] - previous) * 60 < lane.to - lane.from) continue;
      const wraps = lane.cyclic && previous !== null && Math.abs(one.v[i] - previous) > lane.cyclic / 2;
      const gap = previous !== null && !lane.held && one.t[i] - one.t[i - 1] > main.run.pose.step * 1.5;
      if (gap || (lane.held && previous !== null)) d += `H${here.toFixed(1)}`;
      d += `${previous === null || wraps ? "M" : "L"}${here.toFixed(1)} ${y(one.v[i])}`;
      previous = one.v[i];
      last_x = here;
    }
    if (d) d += `H${width}`;
    shape("path", { d: d || "M0 0", class: `line ${look}` }, lane.art);
  };
  if (lane.other) curve(lane.other, "before");
  lane.series.forEach((one, k) => curve(one, `s${k}`));
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
let led_art, led_playhead;
function list_lanes() {
  const { run, pose, backled } = main;
  lanes = [];
  $("lanes").replaceChildren();
  add_thin_lane("Time", "axis");
  const led_plot = add_thin_lane("LED", "led-lane");
  led_art = shape("svg", { preserveAspectRatio: "none" }, led_plot);
  led_playhead = element("div", { class: "playhead" });
  led_plot.append(led_playhead);
  add_lane({ id: "speed", name: "Speed", unit: "cm/s", low: 0, between: state => state.speed, other: before && { t: before.pose.t, v: before.pose.speed }, series: [{ name: "speed", t: pose.t, v: pose.speed, digits: 1 }] });
  add_lane({ id: "heading", name: "Heading", unit: "°", low: 0, high: 360, cyclic: 360, between: state => state.heading, other: before && { t: before.pose.t, v: before.pose.heading }, series: [{ name: "heading", t: pose.t, v: pose.heading, digits: 1 }] });
  if (backled.t.length)
    add_lane({ id: "backled", name: "Aiming light", unit: "", low: 0, high: 255, held: true, series: [{ name: "backLED", t: backled.t, v: backled.value, digits: 0 }] });
  for (const group of run.sensors) {
    const t = sums(group.t);
    add_lane({ id: group.id, name: group.name, unit: group.unit, held: true,
      series: group.series.map(one => ({ name: one.name, t, v: column(one.v, one.scale), digits: one.digits })) });
  }
}

// ---- time ----
const slider = $("time");
const rates = [.1, .25, .5, 1, 2, 5, 10, 30, 60, 300];
for (const rate of rates) $("rate").append(element("option", { value: rate }, `${rate}×`));
function set_rate() {
  $("rate").value = rates.find(rate => end / 1e6 / rate <= 120 && rate >= 1) ?? 300;
}

/** The colours over time: in the slider, and above the other values. */
function draw_colors(art) {
  const width = 1000, { led } = main;
  art.replaceChildren();
  art.setAttribute("viewBox", `0 0 ${width} 10`);
  const x = t => clamp(t / end * width, 0, width);
  led.t.forEach((t, i) => {
    if (!led.rgb[i]) return;
    const until = i + 1 < led.t.length ? led.t[i + 1] : end;
    shape("rect", { x: x(t).toFixed(2), y: 0, width: Math.max(x(until) - x(t), .25).toFixed(2), height: 10, fill: css_color(led.rgb[i]), "shape-rendering": "crispEdges" }, art);
  });
}

function show() {
  const state = main.state_at(now);
  const lamp = main.lamp_at(now), lamp_color = lamp ? css_color(lamp) : "transparent";
  for (const [i, one] of maps.entries()) {
    const there = (i ? before : main).state_at(now);
    one.show(there);
    one.words.lastElementChild.textContent = `${position_words(there)}, ${speed_words(there)}`;
  }
  document.documentElement.style.setProperty("--lamp", lamp_color);
  if (lamp) document.documentElement.style.setProperty("--lamp-solid", lamp_color);
  else document.documentElement.style.removeProperty("--lamp-solid");
  readings.position.textContent = position_words(state);
  readings.speed.textContent = speed_words(state);
  readings.heading.textContent = `${state.heading.toFixed(1)}°`;
  readings.led.firstChild.style.background = lamp_color;
  readings.led.lastChild.textContent = rgb_words(lamp);
  $("clock").textContent = clock_text(now);
  slider.value = now;
  slider.setAttribute("aria-valuetext", `${seconds(now)} of ${seconds(end)} seconds`);
  show_line();
  show_variables();
  show_event();
  show_lanes(state);
}
function redraw() {
  if (!main) return;
  draw_maps();
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
  // What still runs is shown a little behind, so that the ball rolls evenly from one piece to the next.
  if (live) seek(clamp(now + passed * 1000, end - live_delay, end));
  else seek(now + passed * 1000 * Number($("rate").value));
  if (now >= end && !live) set_playing(false);
  else requestAnimationFrame(frame);
}
$("play").addEventListener("click", () => set_playing(!playing));
slider.addEventListener("input", () => seek(Number(slider.value)));

// ---- keys ----
$("keys-button").addEventListener("click", () => $("keys").showModal());
keys.addEventListener("keydown", event => {
  if (!main || event.ctrlKey || event.metaKey || event.altKey || $("keys").open) return;
  const where = event.target;
  if (where instanceof HTMLSelectElement || where instanceof HTMLInputElement && where !== slider) return;
  const by = event.shiftKey ? 1e6 : 50e3;
  const actions = {
    ArrowLeft: () => seek(now - by), ArrowRight: () => seek(now + by),
    Home: () => seek(0), End: () => seek(end),
    n: () => jump(1), p: () => jump(-1),
    ".": () => step_line(1), ",": () => step_line(-1),
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
const everything = () => { draw_maps(); lanes.forEach(draw_lane); draw_axis(); show(); };
/** Where it hurt. */
function draw_ticks() {
  for (const event of main.run.events)
    if (event.kind === "bump" || event.kind === "error")
      for (const look of ["tick below", "tick"])
        shape("path", { d: `M${(event.t / end * 1000).toFixed(2)} 0V10`, class: look, "data-tick": event.kind, "vector-effect": "non-scaling-stroke" }, $("track"));
}
/** Shows a run from its start; one that `goes_on` from the moment shown. */
function load(run, run_before = null, goes_on = false) {
  const continued = live;
  take(run, run_before);
  live = goes_on;
  if (!continued) {
    set_playing(false);
    Object.assign(view, { zoom: 1, x: 0, y: 0 });
    now = 0;
    events = [];
    event_rows = [];
    current_event = -2;
    $("events").replaceChildren();
  }
  slider.max = end;
  document.querySelector(".transport").inert = goes_on;
  if (!goes_on || !continued) set_rate();
  show_heading();
  survey();
  list_maps();
  list_signs();
  show_still();
  list_runs();
  list_lanes();
  live ||= continued; // its last piece is one more
  choose(main);
  live = goes_on;
  draw_colors($("track"));
  draw_ticks();
  draw_colors(led_art);
  now = clamp(now, 0, end);
  everything();
}
/** The moment that the address asks for: `#t=3.2`, in seconds; nothing where it asks for none. */
function asked_time() {
  const asked = /^#t=([0-9.]+)$/.exec(location.hash);
  return asked && main ? clamp(Number(asked[1]) * 1e6, 0, end) : null;
}
const seek_asked = () => { if (asked_time() !== null) seek(asked_time()); };
window.addEventListener("hashchange", seek_asked);

// On paper the run is over: the whole path, whatever part of it was looked at.
let put_aside = null;
window.addEventListener("beforeprint", () => {
  if (!main) return;
  set_playing(false);
  put_aside = { now, ...view };
  Object.assign(view, { zoom: 1, x: 0, y: 0, follow: false });
  now = end;
  shown.run.files.forEach((file, i) => {
    if (i === shown_file && $("source")) return;
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
  now = then;
  put_aside = null;
  $("paper-files").replaceChildren();
  redraw();
});
let pending = 0;
new ResizeObserver(() => {
  cancelAnimationFrame(pending);
  pending = requestAnimationFrame(() => { if (main) everything(); });
}).observe($("map"));
return {
  load, seek, seek_asked, next_theme,
  play: () => set_playing(true), pause: () => set_playing(false),
  end: () => end,
};
}
