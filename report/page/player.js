// Plays runs back on the parts of the page that are there.

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
/** Shows a run as it ended; one that `goes_on` from the moment shown. */
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
  playback.live ||= continued; // its last piece is one more
  choose(playback.main);
  playback.live = goes_on;
  draw_track();
  playback.now = clamp(playback.now, 0, playback.end);
  draw_everything(continued ? draw_maps_eased : draw_maps);
}
/** Shows a room of balls as it ended, and its first ball. */
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
/** Looks at one ball of the room, at the same moment. */
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
/** More of a run that goes on, up to `t` microseconds. */
function grow(more, t) {
  if (!playback.live) return;
  const first = playback.main.pose.t.length;
  lengthen(playback.main, more);
  playback.end = Math.max(1, t);
  slider.max = playback.end;
  list_more_events(more.events);
  grow_maps(first, more.events);
}
/** A run that went on is over, and nothing more is known of it. */
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
/** The moment that the address asks for: `#t=3.2`, in seconds; null where it asks for none. */
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

/** What plays runs back: `load()` takes the data of a run, of the report's own or of one
 *  that still goes on, and `grow()` more of that. `keys`: within what its keys work; `on_moment`: is told the lines that ran last,
 *  file by file, when the moment changes. `ball_px`: how large the ball is on a map with a scale, as its radius. */
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
