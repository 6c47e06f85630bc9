// The state that the parts of the page share: what is played back, and the moment shown.

import { clamp } from "./dom.js";
import { journey } from "./journey.js";

export const playback = {
  main: null, before: null, runs: [], end: 1,
  room: [], // all balls of a room, each with its name; empty for a single run. `main` is the one shown
  now: 0, playing: false,
  live: false, // the run goes on: what is shown next continues it
  ball_px: 13, // radius of the ball on a map with a scale
  shown: null, file: 0, // the run whose program, variables and events are listed, and its file
};

export function take(run, run_before) {
  playback.room = [];
  playback.main = journey(run);
  playback.before = run_before ? journey(run_before) : null;
  playback.runs = playback.before ? [playback.before, playback.main] : [playback.main];
  playback.end = Math.max(1, ...playback.runs.map(one => one.run.end.t));
}

export function take_room({ balls }) {
  playback.room = balls.map(({ name, run }) => Object.assign(journey(run), { ball: name }));
  playback.before = null;
  playback.end = Math.max(1, ...playback.room.map(one => one.run.end.t));
}
/** Makes this ball of the room the one shown. */
export function look_at_ball(one) {
  playback.main = one;
  playback.runs = [one];
}
/** The other balls of the room. */
export const others = () => playback.room.filter(one => one !== playback.main);

const watchers = [];
/** Calls `show(state)` with the ball's state whenever the moment, or what it shows, has changed. */
export function watch(show) { watchers.push(show); }
export function show() {
  const state = playback.main.state_at(playback.now);
  for (const watcher of watchers) watcher(state);
}
export function seek(t) {
  playback.now = clamp(Math.round(t), 0, playback.end);
  show();
}
