// Robots controlled by bytes, in virtual time: what a client writes goes in, what the robot sends comes out.

const refused = (name, takes, value) =>
  new TypeError(`\`${name}\` is ${takes}, not ${typeof value === "string" ? JSON.stringify(value) : String(value)}`);
const text = (name, value) => { if (typeof value !== "string") throw refused(name, "a text", value); };
const whole = (name, value) => { if (!Number.isSafeInteger(value) || value < 0) throw refused(name, "a whole number from 0 on", value); };
const number = (name, value) => { if (!Number.isFinite(value)) throw refused(name, "a number", value); };
const takes = { kind: text, name: text, fault: text, firmware: text, course: text, seed: whole, x: number, y: number, heading: number, title: text };

/** Returns the values; throws a TypeError if one does not fit its name. */
export function checked(values) {
  for (const [name, value] of Object.entries(values)) if (value !== undefined) takes[name]?.(name, value);
  return values;
}

/** Converts any kind of bytes to a Uint8Array. */
function bytes_of(value) {
  if (value instanceof ArrayBuffer) return new Uint8Array(value);
  if (ArrayBuffer.isView(value)) return new Uint8Array(value.buffer, value.byteOffset, value.byteLength);
  if (Array.isArray(value) && value.every(one => Number.isInteger(one) && one >= 0 && one <= 255)) return Uint8Array.from(value);
  throw refused("bytes", "a Uint8Array or a list of numbers from 0 to 255", value);
}

/** A virtual robot, made by `robot()` and `World.add()`. Nothing blocks: time passes only in `advance()`. */
export class Robot {
  #call; #last;
  constructor(call, { robot, ...told }) {
    this.#call = (method, params) => call(method, { robot, ...params });
    Object.assign(this, told); // kind, title, name, address, gatt
    /** The engine's number for it. */
    this.number = robot;
    this.#last = { now: 0, next: null, connected: false, bytes: new Uint8Array() };
  }
  #unread = [];
  #step(params) {
    this.#last = this.#call("robot_step", params);
    if (this.#last.bytes.length) this.#unread.push(this.#last.bytes);
    return this.#last;
  }
  connect() { this.#call("robot_link", { connected: true }); this.#step({}); }
  disconnect() { this.#call("robot_link", { connected: false }); this.#unread = []; this.#step({}); }
  get connected() { return this.#step({}).connected; }
  /** Sends bytes from the client, now, split in any way. */
  write(bytes) { this.#step({ write: bytes_of(bytes) }); }
  /** Advances the robot's time by seconds; in a world, that of all robots. */
  advance(seconds) {
    number("seconds", seconds);
    this.#step({ advance: seconds });
  }
  /** Returns what has arrived at the client by now. */
  read() {
    this.#step({});
    const parts = this.#unread, all = new Uint8Array(parts.reduce((sum, part) => sum + part.length, 0));
    let at = 0;
    for (const part of parts) { all.set(part, at); at += part.length; }
    this.#unread = [];
    return all;
  }
  /** Seconds since it was switched on. */
  get now() { return this.#step({}).now; }
  /** When something happens next without input; null: never. */
  get next_event() { return this.#step({}).next; }
  state() { return this.#call("robot_state"); }
  /** Applies a line of a stimulus script: "push 90 120" now, "at 2s shake" at 2 s of its time. */
  stimulus(line) {
    text("line", line);
    this.#call("robot_stimulus", { line });
  }
  /** Resets it and its world to time 0. */
  reset() { this.#call("robot_reset"); this.#unread = []; }
  /** Copies the robot in its current state; the copy then runs independently. */
  fork() { return new Robot((method, params) => this.#call(method, params), this.#call("robot_fork")); }
  /** Its path as a drawing, and its run as data for the player of orb's reports. */
  journey(title = this.title) { return this.#call("robot_journey", checked({ title })); }
  close() { this.#call("robot_end"); }
}

/** Several robots on one floor, which can collide. */
export class World {
  #call; #number; #robots = [];
  constructor(call, { world }) { this.#call = call; this.#number = world; }
  /** Adds a robot that starts now: kind, and name, seed, x, y (cm), heading, fault, firmware. */
  add(kind = "bolt", options = {}) {
    const count = this.#robots.length;
    const made = new Robot(this.#call, this.#call("robot", { ...checked({ seed: count + 1, x: 40 * count, ...options, kind }), world: this.#number }));
    this.#robots.push(made);
    return made;
  }
  get robots() { return [...this.#robots]; }
  /** Advances the time of all robots. */
  advance(seconds) {
    number("seconds", seconds);
    this.#robots[0]?.advance(seconds);
  }
  reset() { this.#robots[0]?.reset(); }
  close() { this.#call("robot_end", { world: this.#number }); }
}
