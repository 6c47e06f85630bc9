// Plays runs back in the parts that the page has.

import { $, clamp } from "./dom.js";
import { forget_events, list_more_events } from "./events.js";
import { lengthen } from "./journey.js";
import { next_theme, show_heading } from "./heading.js";
import { take_keys } from "./keys.js";
import { draw_lanes, draw_track, list_lanes } from "./lanes.js";
import { choose, list_balls, list_runs } from "./lists.js";
import { draw_maps, draw_maps_eased, grow_maps, list_maps, on_ball_chosen, show_still } from "./map.js";
import { survey, view } from "./map_chart.js";
import { list_signs } from "./map_marks.js";
import { look_at_ball, playback, seek, show, take, take_room, watch } from "./playback.js";
import { lines_now } from "./source.js";
import { set_playing, set_rate, slider } from "./transport.js";
import "./paper.js";

function draw_everything(draw = draw_maps) {
  draw();
  draw_lanes();
  show();
}
/** Shows a run at its end; one that `goes_on` at its start. */
function load(run, run_before = null, goes_on = false) {
  const continued = playback.live;
  take(run, run_before);
  playback.live = goes_on;
  if (!continued) {
    set_playing(false);
    Object.assign(view, { zoom: 1, x: 0, y: 0 });
    playback.now = goes_on ? 0 : playback.end; // the whole path, and where it led
    forget_events();
  }
  slider.max = playback.end;
  document.querySelector(".transport").inert = goes_on;
  if (!goes_on || !continued) set_rate();
  show_heading();
  survey();
  list_maps();
  list_signs();
  show_still();
  list_runs();
  list_lanes();
  playback.live ||= continued; // the lists continue with its end
  choose(playback.main);
  playback.live = goes_on;
  draw_track();
  playback.now = clamp(playback.now, 0, playback.end);
  draw_everything(continued ? draw_maps_eased : draw_maps);
}
/** Shows a room of balls at its end, with its first ball. */
function load_room(room) {
  take_room(room);
  playback.live = false;
  playback.now = playback.end;
  set_playing(false);
  slider.max = playback.end;
  set_rate();
  on_ball_chosen(show_ball);
  show_ball(playback.room[0]);
}
/** Shows one ball of the room, at the same moment. */
function show_ball(one) {
  look_at_ball(one);
  forget_events();
  show_heading();
  survey();
  list_maps();
  list_signs();
  show_still();
  list_balls(show_ball);
  list_lanes();
  choose(one);
  draw_track();
  draw_everything();
}
/** Adds more of a live run, up to `t` microseconds. */
function grow(more, t) {
  if (!playback.live) return;
  const first = playback.main.pose.t.length;
  lengthen(playback.main, more);
  playback.end = Math.max(1, t);
  slider.max = playback.end;
  list_more_events(more.events);
  grow_maps(first, more.events);
}
/** Ends a live run of which nothing more will come. */
function settle() {
  if (!playback.live) return;
  set_playing(false);
  playback.live = false;
  playback.now = playback.end;
  document.querySelector(".transport").inert = false;
  set_rate();
  survey();
  list_signs();
  show_still();
  draw_track();
  draw_everything(draw_maps_eased);
}
/** The moment in the address, in microseconds: `#t=3.2` is in seconds; null if there is none. */
function asked_time() {
  const asked = /^#t=(\d+(?:\.\d+)?)$/.exec(location.hash);
  return asked && playback.main ? clamp(Number(asked[1]) * 1e6, 0, playback.end) : null;
}
function seek_asked() {
  const asked = asked_time();
  if (asked !== null) seek(asked);
}
window.addEventListener("hashchange", seek_asked);

let pending = 0;
new ResizeObserver(() => {
  cancelAnimationFrame(pending);
  pending = requestAnimationFrame(() => { if (playback.main) draw_everything(); });
}).observe($("map"));

/** Makes the player: `load()` takes the data of a run, finished or live, and `grow()` more of a live one. `keys`: the
 *  element in which its keys work; `on_moment(lines)` gets the lines that ran last, file by file, when the moment changes;
 *  `ball_px`: the radius of the ball on a map with a scale. */
export function orb_player({ keys = document, on_moment = null, ball_px = playback.ball_px } = {}) {
  playback.ball_px = ball_px;
  take_keys(keys);
  if (on_moment) watch(() => on_moment(lines_now()));
  return {
    load, load_room, grow, settle, seek, seek_asked, next_theme,
    play: () => set_playing(true), pause: () => set_playing(false),
    end: () => playback.end,
  };
}
