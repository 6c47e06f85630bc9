// What a test found missing, as a teacher would say it: "Wanted red from 0.1 to 1.9 s, saw green." Also as ghosts:
// where the ball should have been, and in which colour.
//
// A phrase is a list like the engine's sentences (said.js): an English text, and the fillers of its holes.

import { learn, made_of } from "./said.js";

const fill = part => {
  if (typeof part === "string") return part;
  const [english, ...fillers] = part;
  let next = 0;
  return english.replace(/\{\w+\}/g, () => fill(fillers[next++]));
};
/** A sentence whose parts the page can translate. */
function sentence(part) {
  const words = fill(part);
  learn({ [words]: part });
  return words;
}

const milliseconds = { ms: 1, s: 1000, min: 60_000 };
const number = text => /^(-?[\d.]+)(\D*)$/.exec(text)?.slice(1) ?? null;
/** `100ms` in seconds; the unit is optional. */
const seconds = text => {
  const [value, unit] = number(text) ?? [];
  return milliseconds[unit] ? String(value * milliseconds[unit] / 1000) : null;
};
const time = text => seconds(text) && `${seconds(text)} s`;
const length = text => text.replace(/^([\d.]+)([a-z/]+)$/, "$1 $2");
const range = (text, say) => {
  const [from, to] = text.split("..");
  return to === undefined ? null : say(/^[\d.]+$/.test(from) ? from : length(from).split(" ")[0], length(to));
};
const centimetres = text => { const [value, unit] = number(text) ?? []; return value * ({ m: 100, mm: .1 }[unit] ?? 1); };

/** Colours with a translated word; others keep their name from the program. */
const colours = new Set(["red", "green", "blue", "yellow", "orange", "purple", "white"]);
const colour = name => colours.has(name) ? [name] : name;
/** The same for what was seen, if a colour was expected. */
const with_colours = part => typeof part === "string" ? colour(part) : [part[0], ...part.slice(1).map(with_colours)];

class Unknown extends Error {}
/** Words, texts between quotes and patterns. */
const tokens = text => text.match(/~?"[^"]*"|\/(?:[^/\\]|\\.)+\/|\S+/g) ?? [];

/** Reads a line such as `expect near 0,90 by 15cm before near 90,90 by 15cm`. */
class Reader {
  constructor(line) {
    this.words = tokens(line);
    this.ghosts = [];
  }
  get next() { return this.words[0]; }
  take() {
    if (!this.words.length) throw new Unknown();
    return this.words.shift();
  }
  has(word) {
    if (this.next !== word) return false;
    this.words.shift();
    return true;
  }
  known(value) {
    if (value === null || value === undefined) throw new Unknown();
    return value;
  }
  time() { return this.known(time(this.take())); }

  /** Reads a state of the ball, or an event. */
  thing() {
    const word = this.take(), own = states[word];
    if (!own) throw new Unknown();
    const made = this.known(own(this));
    if (this.words[1] !== "times") return made;
    const n = this.words.splice(0, 2)[0];
    return n === "1" ? ["{what}, once", made] : ["{what}, {n} times", made, n];
  }
  /** Reads joined things, and when. */
  all() {
    let made = this.thing();
    for (;;)
      if (this.has("and")) made = ["{what} and {more}", made, this.thing()];
      else if (this.has("before")) made = ["first {what}, then {other}", made, this.thing()];
      else if (this.has("after")) made = this.lag(["{what} after {other}", made, this.thing()]);
      else if (this.words[1] === "after") {
        const lag = this.time();
        this.take();
        made = this.lag(["{what} {lag} after {other}", made, lag, this.thing()]);
      } else if (this.has("for")) made = ["{what} for at least {time}", made, this.time()];
      else if (this.has("within")) made = ["{what} within {time}", made, this.time()];
      else if (this.has("at")) made = this.has("end") ? ["{what} at the end", made] : ["{what} at {time}", made, this.time()];
      else if (this.has("during")) {
        const [from, to] = this.take().split("..");
        made = ["{what} from {begin} to {end}", made, this.known(seconds(from)), this.known(time(to ?? ""))];
      } else return made;
  }
  /** Omits the tolerance of a time between two events. */
  lag(made) {
    if (this.has("by")) this.take();
    return made;
  }
  ghost(one) { this.ghosts.push(one); }
}
const quoted = text => text.startsWith("~") ? ["a line with {line}", quoted(text.slice(1))]
  : text.startsWith("/") ? ["a line like {pattern}", text] : ['"{line}"', text.slice(1, -1)];
const below = (read, words) => { if (!read.has("<")) throw new Unknown(); return [words, read.take()]; };
const states = {
  __proto__: null,
  near(read) {
    const place = read.take(), [x, y] = place.split(",").map(Number), by = read.has("by") ? read.take() : "10cm";
    if (!Number.isFinite(x + y)) return null;
    read.ghost({ x, y, by: centimetres(by) });
    return ["the ball within {way} of {place}", length(by), place];
  },
  beyond(read) {
    const [, axis, sign, at] = /^([xy])([<>])(-?[\d.]+)/.exec(read.take()) ?? [];
    if (!axis) return null;
    read.ghost({ axis, at: Number(at) });
    return ["the ball beyond {line}", `${axis} ${sign} ${at}`];
  },
  inside(read) { return states.reach(read); },
  reach(read) {
    const zone = read.take();
    read.ghost({ zone });
    return ["the ball in {zone}", zone];
  },
  stay(read) { return ["the ball in {zone} all the time", read.take()]; },
  heading(read) {
    const made = ["heading {angle}", read.take()];
    return read.has("by") ? read.take() && made : made;
  },
  speed: read => ["moving at {speed}", range(read.take(), (from, to) => `${from}–${to}`)],
  moving: () => ["moving"],
  resting: () => ["resting"],
  asleep: () => ["asleep"],
  distance: read => range(read.take(), (from, to) => ["a path of {from} to {to}", from, to]),
  color(read) {
    const color = read.take();
    read.ghost({ color });
    if (read.has("by")) read.take();
    return colour(color);
  },
  print: read => ["{line} printed", quoted(read.take())],
  collision: () => ["a collision"],
  end: () => ["the end of the program"],
  lines: read => below(read, "fewer than {n} lines"),
  bytes: read => below(read, "fewer than {n} bytes"),
};

const is_sentence = seen => /^(it|the|there|nothing|no|once|still)\b|^\d/.test(seen);
/** Adds what was seen instead to what was wanted. */
function compared(wanted, seen, ghosts) {
  const told = made_of.get(seen) ?? seen, known = ghosts.some(one => one.color) ? with_colours(told) : told, [english, ...fillers] = typeof known === "string" ? [] : known;
  const [, near] = /^nearest (.*)$/s.exec(seen) ?? [];
  if (english === "nearest {what} at {time}") return ["Wanted {what}; nearest was {seen}.", wanted, ["{what} at {time}", ...fillers]];
  if (near) return ["Wanted {what}; nearest was {seen}.", wanted, near];
  // It was seen at the expected moment.
  if (english === "{what} at {time}" && wanted[0] === english && fillers[1] === wanted[2] || english === "{what} at the end, {time}" && wanted[0] === "{what} at the end")
    return ["Wanted {what}, saw {seen}.", wanted, fillers[0]];
  if (/^[\d.]+ cm from /.test(seen)) return ["Wanted {what}; it was {seen}.", wanted, known];
  return [is_sentence(seen) ? "Wanted {what}; {seen}." : "Wanted {what}, saw {seen}.", wanted, known];
}
/** Printed lines that the expectation itself does not name. */
function of_prints(seen) {
  const line = text => ['"{line}"', text];
  const [, n, got, wanted] = /^line (\d+) is "(.*)" at .*?, expected "(.*)"$/s.exec(seen) ?? [];
  if (n) return ["Wanted {wanted} in line {n}, saw {seen}.", line(wanted), n, line(got)];
  const [, next, missing] = /missing line (\d+): "(.*)"$/s.exec(seen) ?? [];
  return next ? ["Wanted {wanted} in line {n}, saw no more lines.", line(missing), next] : null;
}

/**
 * `words`: the miss as a sentence, empty if there is none for it; `wish`: what was wanted; `ghosts`: the part of it
 * that can be drawn.
 */
export function explain({ expected, seen }) {
  const read = new Reader(expected), verb = read.take();
  try {
    const lines = expected === "expect prints" ? of_prints(seen) : null;
    if (lines) return { words: sentence(lines), wish: sentence(["Wanted {what}.", lines[1]]), ghosts: [] };
    if (verb === "reach") read.words.unshift(verb);
    const wanted = read.all();
    if (read.words.length) throw new Unknown();
    if (verb !== "never") return { words: sentence(compared(wanted, seen, read.ghosts)), wish: sentence(["Wanted {what}.", first_of(wanted)]), ghosts: read.ghosts };
    const form = is_sentence(seen) ? "Not wanted: {what}; {seen}." : "Not wanted: {what}. Saw {seen}.";
    return { words: sentence([form, wanted, made_of.get(seen) ?? seen]), wish: sentence(["Not wanted: {what}.", wanted]), ghosts: [] };
  } catch (error) {
    if (error instanceof Unknown) return { words: "", wish: "", ghosts: [] };
    throw error;
  }
}

/** The first of several: the ball's bubble is small. */
const first_of = wanted => wanted[0] === "first {what}, then {other}" ? wanted[1] : wanted;

/** When it was seen, in microseconds; null if unknown. */
export function moment_of({ seen }) {
  const [, at, unit] = /(?:at|the end,|from|starting at) ([\d.]+) (ms|s)\b/.exec(seen) ?? [];
  return at ? at * milliseconds[unit] * 1000 : null;
}
