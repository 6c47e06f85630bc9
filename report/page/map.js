// The maps of the run and of the one before it.

import { $, clamp, length_words, position_words, shape, speed_words } from "./dom.js";
import { area, grid_step, is_turned, look_at, make_chart, measure, outgrown, survey, view } from "./map_chart.js";
import { draw_grid, draw_paper_scale, draw_walls, draw_zones } from "./map_ground.js";
import { draw_event, draw_marks, list_signs } from "./map_marks.js";
import { draw_ball, draw_path, draw_progress, draw_stretches, place_ball } from "./map_path.js";
import { others, playback, show, watch } from "./playback.js";

const eases_for = 400; // milliseconds
const still = matchMedia("(prefers-reduced-motion: reduce)");

function make_map(map) {
  const chart = make_chart(map);
  let layers = null;
  let guests = []; // the other balls of a room
  /** Draws the paths of the other balls, below that of the ball shown; the balls themselves lie above all paths. */
  function draw_guests() {
    guests = others().map(one => Object.assign(Object.create(chart), { one, path: null }));
    for (const guest of guests) draw_path(guest, shape("g", { class: "guest-path" }, map));
  }
  function draw_guest_balls() {
    for (const guest of guests) {
      guest.layers = draw_ball(guest, map, `-${playback.room.indexOf(guest.one)}`);
      guest.layers.ball.dataset.ball = guest.one.ball;
      guest.layers.ball.addEventListener("pointerdown", event => {
        event.stopPropagation();
        on_choice(guest.one);
      });
    }
  }
  function draw() {
    for (const one of map.getAnimations()) one.cancel(); // measure at rest
    measure(chart);
    for (const child of [...map.children]) if (child.nodeName !== "title") child.remove();
    map.setAttribute("viewBox", `0 0 ${chart.width} ${chart.height}`);
    const grid = shape("g", {}, map);
    const floor = shape("g", {}, map); // zones lie on the grid
    const words = shape("g", {}, map);
    const kept_clear = draw_zones(chart, floor, words);
    draw_walls(chart, shape("g", {}, map));
    draw_grid(chart, grid, shape("g", {}, map));
    draw_guests();
    draw_path(chart);
    map.append(words); // names of zones lie on the path
    const marks = shape("g", {}, map);
    draw_marks(chart, marks, kept_clear);
    draw_paper_scale(chart, shape("g", { class: "paper-scale" }, map));
    draw_guest_balls();
    layers = { marks, ...draw_ball(chart, map) };
    draw_more(chart, layers);
  }
  /** Redraws, with a transition from what is seen now. */
  function draw_eased() {
    const before = { ...chart };
    draw();
    if (before.width !== chart.width || before.height !== chart.height || still.matches) return;
    const factor = before.scale / chart.scale;
    const from = `translate(${before.left - chart.left * factor}px, ${before.top - chart.top * factor}px) scale(${factor})`;
    for (const one of map.parentElement.querySelectorAll(":scope > svg"))
      one.animate({ transform: [from, "none"], transformOrigin: ["0 0", "0 0"] }, { duration: eases_for, easing: "ease" });
  }
  /** Following moves the map only when the ball comes near its edge. */
  function leaves_view(state) {
    const there = chart.at(state.x, state.y), x = there.x / chart.width, y = there.y / chart.height;
    return x < .2 || x > .8 || y < .2 || y > .8;
  }
  function show_ball(state) {
    if (view.follow && leaves_view(state)) draw();
    for (const guest of guests) {
      const there = guest.one.state_at(playback.now);
      draw_progress(guest, there);
      place_ball(guest, guest.layers, there);
    }
    draw_progress(chart, state);
    place_ball(chart, layers, state);
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
      view.x = start.view_x - (moved_to.clientX - start.x) / chart.scale;
      view.y = start.view_y + (moved_to.clientY - start.y) / chart.scale;
      redraw();
    };
    map.addEventListener("pointermove", drag);
    for (const name of ["pointerup", "pointercancel"])
      map.addEventListener(name, () => map.removeEventListener("pointermove", drag), { once: true });
  });
  function grow(events) {
    draw_stretches(chart);
    for (const event of events) draw_event(chart, layers.marks, event);
  }
  return { grow, load: one => { chart.one = one; }, draw, draw_eased, show_ball, scale: () => chart.scale, words: map.nextElementSibling };
}
let draw_more = () => {};
/** Calls `draw(chart, layers)` after each map is drawn, to add to it. */
export function on_draw(draw) { draw_more = draw; }
let on_choice = () => {};
/** Calls `take(one)` with the ball of a room that somebody presses. */
export function on_ball_chosen(take) { on_choice = take; }
const all_maps = [make_map($("map")), make_map($("map-before"))]; // the run's comes first
let maps = [];
export function list_maps() {
  $("as-drawn").hidden = !is_turned();
  maps = all_maps.slice(0, playback.runs.length);
  $("map").parentElement.hidden = false;
  $("map-before").parentElement.hidden = !playback.before;
  if (playback.before) maps.forEach((one, i) => { one.words.firstElementChild.textContent = i ? "before" : "this run"; });
  maps.forEach((one, i) => one.load(i ? playback.before : playback.main));
  document.body.classList.toggle("two", maps.length > 1);
}

function draw_scale() {
  const cm = grid_step(maps[0].scale());
  $("scale-bar").style.width = `${(cm * maps[0].scale()).toFixed(1)}px`;
  $("scale-words").textContent = length_words(cm);
}
/** Shows `state`, and where the ball of the run before was at that moment. */
function show_maps(state) {
  for (const [i, one] of maps.entries()) {
    const there = i ? playback.before.state_at(playback.now) : state;
    one.show_ball(there);
    one.words.lastElementChild.textContent = `${position_words(there)}, ${speed_words(there)}`;
  }
}
watch(show_maps);
export function draw_maps() {
  for (const one of maps) one.draw();
  draw_scale();
}
/** The same, with a transition to another part of the floor. */
export function draw_maps_eased() {
  for (const one of maps) one.draw_eased();
  draw_scale();
}
export function redraw(draw = draw_maps) {
  if (!playback.main) return;
  draw();
  show();
}

/** Draws more of a live run, from the pose `first` on; redraws all if the map does not hold it. */
export function grow_maps(first, events) {
  if (outgrown(first)) {
    survey();
    draw_maps_eased();
  } else {
    for (const one of maps) one.grow(events);
  }
  if (events.some(event => event.x !== undefined)) list_signs();
}

export function zoom_by(factor, draw = draw_maps) {
  view.zoom = clamp(view.zoom * factor, .2, 60);
  redraw(draw);
}
export function fit() {
  Object.assign(view, { zoom: 1, x: 0, y: 0 });
  redraw(draw_maps_eased);
}
export function toggle_follow() {
  view.follow = !view.follow;
  if (!view.follow) look_at(playback.main.state_at(playback.now));
  $("follow").setAttribute("aria-pressed", String(view.follow));
  redraw();
}
/** Shows a course as it was drawn, or with the start heading up. */
function toggle_drawn() {
  view.as_drawn = !view.as_drawn;
  $("as-drawn").setAttribute("aria-pressed", String(view.as_drawn));
  survey();
  fit();
}
$("as-drawn").addEventListener("click", toggle_drawn);
$("zoom-in").addEventListener("click", () => zoom_by(1.5, draw_maps_eased));
$("zoom-out").addEventListener("click", () => zoom_by(1 / 1.5, draw_maps_eased));
$("zoom-fit").addEventListener("click", fit);
$("follow").addEventListener("click", toggle_follow);
export function show_still() {
  $("still").textContent = playback.main.pose.t.length ? "The ball stayed where it was." : "The ball did not move.";
  $("still").hidden = area.moved || playback.live;
}
