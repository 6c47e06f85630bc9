// What is played back, and the moment that the page shows: the state that its parts share.

import { clamp } from "./dom.js";
import { journey } from "./journey.js";

export const playback = {
  main: null, before: null, runs: [], end: 1,
  room: [], // all balls of a room, each with its name; empty for a run alone. `main` is the one that is looked at
  now: 0, playing: false,
  live: false, // it still runs: what is shown next continues what is shown
  ball_px: 13, // radius of the ball on a map with a scale
  shown: null, file: 0, // the run whose program, variables and events are listed, and the file of it
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
/** From now on this ball of the room is the one that is looked at. */
export function look_at_ball(one) {
  playback.main = one;
  playback.runs = [one];
}
/** Those on the same floor as the one that is looked at. */
export const others = () => playback.room.filter(one => one !== playback.main);

const watchers = [];
/** `show(state)` is called with the ball as it is whenever the moment, or what it shows, has changed. */
export function watch(show) { watchers.push(show); }
export function show() {
  const state = playback.main.state_at(playback.now);
  for (const watcher of watchers) watcher(state);
}
export function seek(t) {
  playback.now = clamp(Math.round(t), 0, playback.end);
  show();
}
