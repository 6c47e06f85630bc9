// A run, and the ball at any moment of it.

import { css_color, last_at } from "./dom.js";

function turn(from, to, share) {
  let by = (to - from) % 360;
  if (by > 180) by -= 360;
  if (by < -180) by += 360;
  return ((from + by * share) % 360 + 360) % 360;
}
// Columns hold differences of whole numbers, which these sum up again.
export const sums = list => { let sum = 0; return list.map(step => sum += step); };
export const column = (list, scale) => sums(list).map(value => value / scale);

export const base_name = path => path.split("/").pop() || path;

export function journey(run) {
  const pose = {
    t: sums(run.pose.t), x: column(run.pose.x, 1000), y: column(run.pose.y, 1000),
    heading: column(run.pose.heading, 10), speed: column(run.pose.speed, 100),
  };
  const led = { t: sums(run.led.t), rgb: run.led.rgb };
  const backled = { t: sums(run.backled.t), value: run.backled.value };
  const matrix = { t: sums(run.matrix?.t ?? []), pixels: run.matrix?.pixels ?? [] };
  // The lines that ran, file by file: a program and a macro run side by side.
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
    // Poses are recorded only while something moves: over a longer gap the robot stood still.
    const gap = pose.t[next] - pose.t[i];
    const share = gap > run.pose.step * 1.5 ? 0 : (t - pose.t[i]) / gap;
    const mix = list => list[i] + (list[next] - list[i]) * share;
    return { x: mix(pose.x), y: mix(pose.y), heading: turn(pose.heading[i], pose.heading[next], share), speed: mix(pose.speed), index: i };
  };
  const lamp_at = t => led.rgb[last_at(led.t, t)] ?? 0;
  const tail_at = t => backled.value[last_at(backled.t, t)] ?? 0;
  /** All lamps of the matrix as RRGGBB, row by row from the bottom left: the newer of LED and picture; null without a
   *  matrix. */
  const picture_at = t => {
    if (!run.matrix) return null;
    const picture = last_at(matrix.t, t), color = last_at(led.t, t);
    return picture >= 0 && !(led.t[color] > matrix.t[picture]) ? matrix.pixels[picture] : css_color(lamp_at(t)).slice(1).toUpperCase().repeat(64);
  };
  const name = base_name(run.title);
  const made = { run, name, pose, led, backled, matrix, steps, line_times, variables, stretches: [], state_at, lamp_at, tail_at, picture_at };
  add_stretches(made, 1, Infinity);
  return made;
}
/** Adds stretches of path in one colour, from the pose `first` on, of at most `most` steps; the LED may change
 *  between two poses. */
function add_stretches({ pose, stretches, lamp_at }, first, most) {
  for (let i = Math.max(first, 1); i < pose.t.length; ++i) {
    if (pose.x[i] === pose.x[i - 1] && pose.y[i] === pose.y[i - 1]) continue;
    const lit = lamp_at(pose.t[i - 1]), open = stretches[stretches.length - 1];
    if (open && open.color === lit && open.to === i - 1 && i - open.from <= most) open.to = i;
    else stretches.push({ from: i - 1, to: i, color: lit });
  }
}
/** Adds rows of plain values to a live run. Its stretches stay short, as the last one is redrawn each time. */
export function lengthen(one, { pose, led, backled, matrix = { t: [], pixels: [] }, line, events }) {
  const first = one.pose.t.length;
  for (const [column, more] of [[one.pose, pose], [one.led, led], [one.backled, backled], [one.matrix, matrix]])
    for (const key of Object.keys(column)) column[key].push(...more[key]);
  line.t.forEach((t, i) => {
    const own = one.steps[line.file[i]];
    own.t.push(t);
    own.line.push(line.line[i]);
    one.line_times.push(t);
  });
  one.run.events.push(...events);
  for (const { kind } of events) one.run.counts[kind] = (one.run.counts[kind] ?? 0) + 1;
  add_stretches(one, first, 100);
}
