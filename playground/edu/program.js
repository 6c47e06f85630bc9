// The runtime of a Sphero Edu program inside the sandbox: the functions that it calls, its time, and its events.
//
// edu_program() uses nothing from outside itself, so its text can be taken into a worker or another realm:
// `(${edu_program})(bridge)`. It trusts neither side and shares only its own objects with the program.
//   bridge.post(text)   a message to the host, as JSON
//   bridge.later(f)     calls f in a later macrotask, when nothing is left to do at this moment
//   bridge.load(text)   runs a text of the program in its realm and returns its value; eval by default
// The returned function takes a message of the host, as JSON. Messages: playground/README.md.
//
// A program takes no time except where it awaits. When nothing is left to run, it sends ONE message with all that it did and
// when to wake it; the answer brings the time, the robot's state and events.

/** @param {{ post(text: string): void, later(f: () => void): void, load?(text: string): unknown }} bridge */
export function edu_program(bridge) {
  "use strict";
  const { post, later, load = (0, eval) } = bridge;
  const { parse, stringify } = JSON, { min, max, abs, round, floor, PI } = Math;
  const is_array = Array.isArray, is_finite = Number.isFinite, a_promise = Promise, a_date = Date;
  const freeze = Object.freeze, to_text = String, real_now = a_date.now;

  const longest_text = 1000;          // of a print, in characters
  const most_deeds = 4096;            // at one moment
  const most_turns = 5_000_000;       // of loops, while no time passes
  const most_ms = 2500;               // of real time, for slow loops
  const shortest_turn = 0.025;        // s: the wait in a turn of an awaiting loop that took no time
  const glance = 0.05;                // s: how often conditions are checked; the robot reports as often
  const epoch = a_date.UTC(2026, 0, 1);

  let kind = "", seed = 1, table = { functions: [], events: [], objects: [] };
  let now = 0, state = {};
  let did = [], printed = 0, turns = 0, since = 0, dead = false, waits = false;
  let timers = [], order = 0, level = 0;
  let arrived = [];
  const handlers = new Map(), conditions = [];
  let main_is_over = false, last_ir = -1;
  let driven = 0; // counts motor commands: an overtaken roll must not stop its successor
  const set = { speed: 0, heading: 0, stabilization: true, motors: { left: 0, right: 0 }, leds: {}, dome: {}, animations: 0 };
  const over = { name: "over" };

  // Messages.
  const send = message => post(stringify(message));
  function end(how, error) {
    if (dead) return;
    dead = true;
    send({ did, ended: how, error });
    did = [];
  }
  function fail(rule, line, holes = {}) {
    end("error", { rule, line: line ?? 0, column: 1, holes });
    throw over;
  }
  function deed(name, ...values) {
    if (dead) throw over;
    // Of values set repeatedly at one moment, only the last one shows.
    if ((name === "drive" || name === "setMainLed") && did.at(-1)?.[0] === name) did.pop();
    if (did.length >= most_deeds) fail("too-much-at-once", line_now);
    did.push([name, ...values]);
  }
  const cut = text => text.length > longest_text ? text.slice(0, longest_text) + "…" : text;
  function shown(value, depth = 0) {
    try {
      if (typeof value === "string") return depth ? stringify(value) : value;
      if (typeof value === "function") return "function";
      if (value === null || typeof value !== "object") return to_text(value);
      if (value instanceof Error) return `${value.name}: ${value.message}`;
      if (depth > 3) return "…";
      if (is_array(value)) return `[${value.slice(0, 100).map(one => shown(one, depth + 1)).join(", ")}]`;
      return `{ ${Object.keys(value).slice(0, 50).map(key => `${key}: ${shown(value[key], depth + 1)}`).join(", ")} }`;
    } catch {
      return "?";
    }
  }
  function print(...values) {
    if (printed > 100 * longest_text) return;
    const text = cut(values.map(value => shown(value)).join(" "));
    printed += text.length;
    deed("print", text);
  }

  // Time.
  function wait(seconds) {
    if (dead) throw over;
    const due = now + min(max(number(seconds, 0), 0), 999_999);
    return new a_promise(done => timers.push({ due, order: order++, done, level }));
  }
  const runnable = () => {
    let first = null;
    for (const one of timers)
      if (one.level === level && (!first || one.due < first.due || one.due === first.due && one.order < first.order)) first = one;
    return first;
  };
  /** True if something is left that can still run. */
  const alive = () => timers.length > 0 || level > 0 || arrived.length > 0 || !main_is_over || handlers.size > 0 || conditions.length > 0;

  function rest() {
    if (dead || waits) return;
    turns = 0;
    since = real_now();
    printed = 0;
    if (level === 0 && arrived.length) {
      start_handler(arrived.shift());
      return later(rest);
    }
    let next = runnable();
    if (!next && level > 0) { // the handler waits for the main program
      level = 0;
      return later(rest);
    }
    if (next && next.due <= now + 1e-9) {
      timers.splice(timers.indexOf(next), 1);
      next.done();
      return later(rest);
    }
    if (!alive()) return end("done");
    const wake = conditions.length ? min(next ? next.due : Infinity, now + glance) : next ? next.due : null;
    waits = true;
    const message = { did, wake };
    did = [];
    send(message);
  }

  // Events.
  function start_handler({ functions, value }) {
    level = 1;
    const running = functions.map(async f => f(value));
    for (const one of running) one.catch(failed);
    a_promise.allSettled(running).then(() => {
      level = 0;
      for (const one of timers) one.level = 0; // what it did not await goes on as part of the main program
    });
  }
  function happen(name, value) {
    if (name === "onIRMessage") last_ir = value;
    const functions = handlers.get(name);
    // An event that repeats before it is handled counts once.
    if (functions && arrived.length < 32 && !arrived.some(one => one.name === name && one.value === value)) arrived.push({ name, functions, value });
  }
  const told_by = { onAmbientLight: () => state.luminosity, onTotalDistance: () => state.distance, onElapsedTime: () => now };
  function look() {
    for (const one of conditions) {
      const value = told_by[one.name]?.();
      let met = false;
      try {
        met = typeof one.condition === "function" ? !!one.condition(value) : value >= one.condition;
      } catch (error) {
        return failed(error);
      }
      if (met && !one.met && arrived.length < 32) arrived.push({ name: one.name, functions: [one.handler], value });
      one.met = met;
    }
  }

  // Values.
  const noted = new Set();
  function number(value, otherwise, name, operand) {
    const is = typeof value === "number" ? value : typeof value === "string" && value.trim() !== "" ? +value : typeof value === "boolean" ? +value : NaN;
    if (is_finite(is)) return is;
    if (name && !noted.has(name + operand)) {
      noted.add(name + operand);
      deed("note", "not-a-number", name, operand, cut(shown(value, 1)));
    }
    return otherwise;
  }
  const between = (least, value, most) => min(max(value, least), most);
  const on_circle = angle => ((round(angle) % 360) + 360) % 360;
  const part = value => round(between(0, number(value, 0), 255));
  const color = value => value !== null && typeof value === "object" ? { r: part(value.r), g: part(value.g), b: part(value.b) } : { r: 0, g: 0, b: 0 };
  const point = value => value !== null && typeof value === "object"
    ? { x: between(0, floor(number(value.x, 0)), 7), y: between(0, floor(number(value.y, 0)), 7) } : { x: 0, y: 0 };
  /** Converts a value to what its operand takes. */
  function fit(name, operand, value) {
    switch (operand.type) {
      case "number": case "whole": {
        if (value === undefined && operand.presence !== "required") return null;
        const is = number(value, 0, name, operand.name);
        if (operand.unit === "degrees") return on_circle(is);
        return between(operand.least, operand.type === "whole" ? round(is) : is, operand.most);
      }
      case "bool": return !!value;
      case "text": return cut(shown(value));
      case "color": return color(value);
      case "color or number": return typeof value === "object" ? color(value) : round(between(0, number(value, 0, name, operand.name), 255));
      case "point": return point(value);
      default: return typeof value === "number" && is_finite(value) ? value : cut(shown(value));
    }
  }

  // Random numbers: the same seed gives the same ones.
  let chance = 0;
  function random() {
    chance = (chance + 0x6d2b79f5) | 0;
    let t = Math_imul(chance ^ (chance >>> 15), 1 | chance);
    t = (t + Math_imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) / 4294967296;
  }
  const Math_imul = Math.imul;

  const main_led = value => {
    set.leds.Main = color(value);
    deed("setMainLed", set.leds.Main);
  };
  const drive = () => deed("drive", set.heading, set.speed);
  const stop = () => {
    set.speed = 0;
    drive();
  };
  const led = name => ({ ...(set.leds[name] ?? { r: 0, g: 0, b: 0 }) });
  const vector = key => ({ ...state[key] });
  const seconds_of_speech = text => 0.5 + 0.065 * text.length; // ?

  /** Functions that do more than pass a command on. */
  const own = {
    async roll(heading, speed, duration) {
      set.heading = on_circle(number(heading, 0, "roll", "heading"));
      set.speed = between(-255, number(speed, 0, "roll", "speed"), 255);
      drive();
      const mine = ++driven;
      if (duration === undefined) return; // ?: nothing stops it
      await wait(number(duration, 0, "roll", "duration"));
      if (driven === mine) stop();
    },
    setSpeed(speed) {
      ++driven;
      set.speed = between(-255, number(speed, 0, "setSpeed", "speed"), 255);
      drive();
    },
    stopRoll(heading) {
      ++driven;
      if (heading !== undefined) set.heading = on_circle(number(heading, set.heading));
      stop();
    },
    setHeading(heading) {
      set.heading = on_circle(number(heading, set.heading, "setHeading", "heading"));
      drive();
    },
    async spin(angle, duration) {
      const whole = number(angle, 0, "spin", "angle"), time = max(0, number(duration, 0, "spin", "duration")), from = set.heading, begun = now;
      for (let part_done = 0; part_done < 1;) {
        await wait(min(glance, max(0, begun + time - now)));
        part_done = time > 0 ? min(1, (now - begun + 1e-9) / time) : 1;
        set.heading = on_circle(from + whole * part_done);
        drive();
      }
    },
    async rawMotor(left, right, duration) {
      const mine = ++driven;
      const powers = [left, right].map(one => round(between(-255, number(one, 0, "rawMotor", "power"), 255)));
      set.motors = { left: powers[0], right: powers[1] };
      set.speed = 0;
      deed("rawMotor", ...powers);
      if (duration === undefined) return;
      await wait(number(duration, 0, "rawMotor", "duration"));
      if (driven !== mine) return;
      set.motors = { left: 0, right: 0 };
      deed("rawMotor", 0, 0);
      deed("setStabilization", set.stabilization);
    },
    setStabilization(on) {
      set.stabilization = !!on;
      deed("setStabilization", !!on);
    },
    resetAim(heading) {
      set.heading = heading === undefined ? 0 : on_circle(-number(heading, 0));
      deed("resetAim", set.heading);
    },
    async driveToDistance(heading, speed, distance) {
      const mine = ++driven, from = state.distance ?? 0, begun = now;
      const way = abs(number(distance, 0, "driveToDistance", "distance"));
      const wanted = between(-255, number(speed, 0, "driveToDistance", "speed"), 255);
      set.heading = on_circle(number(heading, 0, "driveToDistance", "heading"));
      for (let left = way; left > 0.5 && wanted !== 0 && driven === mine && now - begun < 10 + way; left = way - ((state.distance ?? 0) - from)) {
        // Slow down near the end, as the robot does.
        const most = min(abs(wanted), max(12, 1.6 * left));
        set.speed = wanted < 0 ? -most : most;
        drive();
        await wait(glance);
      }
      if (driven === mine) stop();
    },
    async calibrateCompass() {
      deed("calibrateCompass");
      await wait(5); // ?
    },
    setCompassDirection(direction) {
      set.heading = on_circle(number(direction, 0) - (state.north ?? 0));
      drive();
    },
    setMainLed: main_led,
    async fade(from, to, duration) {
      const a = color(from), b = color(to), time = max(0, number(duration, 0, "fade", "duration")), begun = now;
      main_led(a);
      while (now < begun + time - 1e-9) {
        await wait(min(0.1, begun + time - now));
        const share = min(1, (now - begun) / time);
        main_led({ r: a.r + (b.r - a.r) * share, g: a.g + (b.g - a.g) * share, b: a.b + (b.b - a.b) * share });
      }
      main_led(b);
    },
    async strobe(value, period, count) {
      const time = max(0, number(period, 0, "strobe", "period"));
      for (let left = min(999_999, number(count, 0, "strobe", "count")); left > 0; --left) {
        main_led(value);
        await wait(time);
        main_led({ r: 0, g: 0, b: 0 });
        await wait(time);
      }
    },
    async scrollMatrixText(text, value, fps, wait_for_it) {
      const words = cut(shown(text)).slice(0, 25), rate = between(1, number(fps, 10, "scrollMatrixText", "fps"), 30);
      deed("scrollMatrixText", words, color(value), rate);
      if (wait_for_it) await wait((6 * words.length + 8) / rate); // ?: columns of the text and of the matrix
    },
    drawMatrixPixel(...values) { drawn("drawMatrixPixel", values, 1); },
    drawMatrixLine(...values) { drawn("drawMatrixLine", values, 2); },
    drawMatrixFill(...values) { drawn("drawMatrixFill", values, 2); },
    registerMatrixAnimation(picture) {
      const frames = is_array(picture?.frames) ? picture.frames.slice(0, 256) : [];
      deed("registerMatrixAnimation", {
        frames: frames.map(frame => is_array(frame) ? frame.slice(0, 8).map(row => is_array(row) ? row.slice(0, 8).map(one => round(between(0, number(one, 0), 15))) : []) : []),
        palette: is_array(picture?.palette) ? picture.palette.slice(0, 16).map(color) : [],
        fps: between(1, number(picture?.fps, 10), 30), fade: number(picture?.transition, 0) === 1 });
      return set.animations++;
    },
    async setDisplayImage(image) { deed("setDisplayImage", cut(shown(image))); },
    async setDisplayAnimation(animation, loop) {
      deed("setDisplayAnimation", cut(shown(animation)), !!loop);
      if (!loop) await wait(2); // ?
    },
    async speak(text, wait_for_it) {
      const words = cut(shown(text));
      deed("speak", words, !!wait_for_it);
      if (wait_for_it) await wait(seconds_of_speech(words));
    },
    getAcceleration: () => vector("acceleration"),
    getVerticalAcceleration: () => state.vertical ?? 0,
    getOrientation: () => vector("orientation"),
    getGyroscope: () => vector("gyroscope"),
    getVelocity: () => vector("velocity"),
    getLocation: () => ({ x: state.x ?? 0, y: state.y ?? 0 }),
    getDistance: () => state.distance ?? 0,
    getSpeed: () => set.speed,
    getHeading: () => set.heading,
    getRawMotor: () => ({ ...set.motors }),
    getStabilization: () => set.stabilization,
    getDomeLeds: () => set.dome.setDomeLeds ?? 0,
    getHoloProjectorLed: () => set.dome.setHoloProjectorLed ?? 0,
    getLogicDisplayLeds: () => set.dome.setLogicDisplayLeds ?? 0,
    getLuminosity: () => state.luminosity ?? 0,
    getCompassDirection: () => on_circle(set.heading + (state.north ?? 0)),
    getColor: channel => channel === undefined ? { ...(state.color ?? { r: 0, g: 0, b: 0 }) } : own.getColorChannel(channel),
    getColorChannel: channel => (state.color ?? {})[({ red: "r", green: "g", blue: "b" })[channel] ?? channel] ?? 0,
    getLastIRMessage: () => last_ir,
    getElapsedTime: () => now,
    getCurrentTime: () => now, // ?: the day begins with the program
    getConnectedRobotType: () => kind,
    async delay(duration) { await wait(number(duration, 0, "delay", "duration")); },
    exitProgram() {
      end("done");
      throw over;
    },
    registerEvent(name, handler) {
      if (typeof handler !== "function") return void handlers.delete(name);
      if (!handlers.has(name)) handlers.set(name, []);
      const all = handlers.get(name);
      if (all.length < 64) all.push(handler);
    },
    registerEventCondition(name, handler, condition) {
      if (typeof handler === "function" && conditions.length < 64) conditions.push({ name, handler, condition, met: false });
    },
    getRandomInt: (least, most) => floor(number(least, 0) + random() * (number(most, 0) - number(least, 0) + 1)),
    getRandomFloat: (least, most) => number(least, 0) + random() * (number(most, 0) - number(least, 0)),
    getRandomColor: () => ({ r: floor(random() * 256), g: floor(random() * 256), b: floor(random() * 256) }),
    buildString: (...values) => cut(values.map(value => shown(value)).join("")),
    toRadians: degrees => number(degrees, 0) * PI / 180,
    toDegrees: radians => number(radians, 0) * 180 / PI,
  };
  own.rollToDistance = own.driveToDistance;
  /** Takes the colour first, or last as older programs pass it. */
  function drawn(name, values, points) {
    const objects = values.filter(one => one !== null && typeof one === "object");
    const places = objects.filter(one => "x" in one || "y" in one).slice(0, points).map(point);
    while (places.length < points) places.push({ x: 0, y: 0 });
    deed(name, color(objects.find(one => "r" in one || "g" in one || "b" in one)), ...places);
  }
  /** A command that is passed on with its values fitted. */
  const handed_on = ({ name, operands }) => (...values) => {
    const fitted = operands.some(one => one.presence === "rest") ? values.flat(1).slice(0, 16).map(one => fit(name, { type: typeof one === "object" ? "color" : "whole", least: 0, most: 255 }, one))
      : operands.map((operand, i) => fit(name, operand, values[i]));
    const light = /^set(.*)Led$/.exec(name);
    if (light) set.leds[light[1]] = typeof fitted[0] === "object" ? fitted[0] : { r: 0, g: 0, b: fitted[0] };
    set.dome[name] = fitted[0];
    deed(name, ...fitted);
  };
  const reads_light = name => () => led(/^get(.*)Led$/.exec(name)[1]);

  /** Nested names, made when a program uses them; each can be played. */
  function tree(path, play) {
    const known = new Map();
    return new Proxy(() => {}, {
      get(_, key) {
        if (typeof key !== "string" || key === "then") return key === Symbol.toPrimitive ? () => path.join(".") : undefined;
        if (key === "play") return value => play(path.join("."), value);
        if (key === "toString" || key === "valueOf") return () => path.join(".");
        if (path.length > 6) return undefined;
        if (!known.has(key)) known.set(key, tree([...path, key.slice(0, 60)], play));
        return known.get(key);
      },
      apply() { return undefined; },
      set() { return true; },
    });
  }
  const trees = {
    Sound: async (path, waits_for_it) => {
      deed("sound", path, !!waits_for_it);
      if (waits_for_it) await wait(1.5); // ?
    },
    Animation: async path => {
      deed("animation", path);
      await wait(3); // ?
    },
    DisplayImage: () => {},
    DisplayAnimation: () => {},
  };
  function object_of({ name, members }) {
    if (!members.length) return tree([], trees[name] ?? (() => {}));
    return freeze(Object.fromEntries(members.map((member, i) => [member, /^deg\d+$/.test(member) ? +member.slice(3) : i])));
  }

  // Calls that playground/edu/prepare.js puts into the program's text.
  let line_now = 0;
  /** Called at each turn of a loop and each call of a function. */
  function turn(line) {
    line_now = line;
    if (dead) throw over;
    if (++turns > most_turns || (turns & 255) === 0 && real_now() - since > most_ms) fail("endless-loop", line);
  }
  const begun = []; // when the last turn of each loop began
  /** The same for a loop that awaits something; `loop` is its number. */
  const pause = (line, loop) => {
    turn(line);
    const waits_now = begun[loop] === now;
    begun[loop] = now;
    return waits_now ? wait(shortest_turn).then(() => { begun[loop] = now; }) : undefined;
  };

  function failed(error) {
    if (error === over || dead) return;
    let text = "", line = 0;
    try {
      text = cut(error instanceof Error ? `${error.name}: ${error.message}` : shown(error));
      line = +(/program\.js:(\d+)/.exec(to_text(error?.stack)) ?? [0, 0])[1];
    } catch { text ||= "?"; }
    end("error", { rule: "exception", line: line || line_now, column: 1, holes: { text } });
  }

  function begin(message) {
    ({ kind, seed, table, state } = message);
    chance = seed | 0;
    since = real_now();
    const names = {};
    for (const row of table.functions)
      names[row.name] = own[row.name] ?? (row.kind === "reads" ? reads_light(row.name) : handed_on(row));
    for (const row of table.objects) names[row.name] = object_of(row);
    names.EventType = freeze(Object.fromEntries(table.events.map(({ name }) => [name, name])));
    const log = (...values) => print(...values);
    names.console = freeze({ log, info: log, warn: log, error: log, debug: log });
    names.print = log;
    const timed = again => (f, ms = 0, ...values) => {
      const id = ++order;
      cancelled.delete(id);
      (async () => {
        do {
          await wait(max(again ? 0.001 : 0, number(ms, 0) / 1000));
          if (cancelled.has(id)) return;
          if (typeof f === "function") await f(...values);
        } while (again && !cancelled.has(id));
      })().catch(failed);
      return id;
    };
    const cancelled = new Set();
    const cancel = id => { if (cancelled.size < 10_000) cancelled.add(id); };
    Object.assign(names, { setTimeout: timed(false), setInterval: timed(true), clearTimeout: cancel, clearInterval: cancel });
    names.performance = freeze({ now: () => now * 1000 });
    names.__turn = turn;
    names.__pause = pause;
    names.__at = (line, value) => {
      line_now = line;
      return value;
    };
    names.__import = () => { throw new Error("a program of Sphero Edu has no modules"); };
    for (const [name, value] of Object.entries(names)) Object.defineProperty(globalThis, name, { value, writable: true, configurable: true, enumerable: false });
    Math.random = random;
    globalThis.Date = new Proxy(a_date, {
      get: (date, key) => key === "now" ? () => epoch + now * 1000 : date[key],
      construct: (date, values) => values.length ? new date(...values) : new date(epoch + now * 1000),
      apply: date => new date(epoch + now * 1000).toString(),
    });
    let start;
    try {
      load(`${message.source}\n//# sourceURL=program.js`);
      start = load("typeof startProgram === 'function' ? startProgram : null");
    } catch (error) {
      failed(error);
    }
    if (dead) return;
    (async () => { if (start) await start(); })().then(() => { main_is_over = true; }, failed);
    later(rest);
  }

  return text => {
    const message = parse(text);
    if (message.begin) return begin(message.begin);
    if (message.rejected !== undefined) return failed(message.rejected && Object.assign(new Error(message.rejected.text), { name: message.rejected.name, stack: message.rejected.stack }));
    if (dead || !waits) return;
    waits = false;
    ({ now, state } = message);
    for (const [name, value] of message.events) happen(name, value);
    if (conditions.length) look();
    later(rest);
  };
}
