// The trusted side of an Edu program: passes its commands to a robot, and the robot's sensor values back. Trusts nothing
// that comes out of the sandbox.

/** Seconds of its time after which a program is ended. */
export const usual_limit = 120;
const most_deeds = 8192;   // in one message
const frame = 0.033;       // s: time step of a live run

/** Output for people rather than the robot. */
const told = new Set(["print", "speak", "sound", "animation", "note"]);

/** True for what a test counts as printed. */
export const is_print = what => what === "print" || what === "speak";

/** Lets a program drive a robot of the engine. */
export class Host {
  #call; #robot; #limit; #on; #over = null; #names;
  /** `call(method, params)` calls the engine; `edu_step` may return a promise. `robot`: its number there. `on(what, seconds,
   *  ...values)` gets what is printed, said and played, with the program's time. */
  constructor({ call, robot, table, limit = usual_limit, on = () => {} }) {
    this.#call = call;
    this.#robot = robot;
    this.#limit = limit;
    this.#on = on;
    this.#names = new Set(["drive", ...table.functions.map(row => row.name)]);
    this.now = 0;
    this.state = {};
    /** The state in which the program left the robot; null while it runs. */
    this.final = null;
  }
  /** Readies the robot; returns the first message for the sandbox. */
  begin({ source, table, kind, seed = 1 }) {
    this.#take(this.#call("edu_start", { robot: this.#robot }));
    return JSON.stringify({ begin: { source, table: { functions: table.functions, events: table.events, objects: table.objects }, kind, seed, state: this.state } });
  }
  /** How it ended: {how: "done" | "error" | "limit" | "silent" | "stopped", error?}; null while it runs. */
  get over() { return this.#over; }
  #take({ now, state }) {
    this.now = now;
    this.state = state;
  }

  /** Answers a message of the sandbox; null once the run is over. `pace(now, until)`, if given, decides before each step how
   *  far the run may go, in seconds; the run waits for it. */
  async answer(text, pace) {
    const asked = this.#read(text);
    if (!asked || this.#over) return null;
    if (asked.ended) return this.end(asked.ended, asked.error, asked.did);
    const until = Math.min(asked.wake ?? Infinity, this.#limit);
    let deeds = asked.did, events = [];
    for (;;) {
      const far = pace ? Math.min(until, await pace(this.now, Math.min(until, this.now + frame))) : until;
      if (this.#over) return null;
      const step = await this.#step(deeds, Math.max(far, this.now));
      if (!step || this.#over) return null;
      deeds = [];
      events = step.events;
      if (events.length || this.now >= until - 1e-9) break;
    }
    if (!events.length && this.now >= this.#limit - 1e-9) return this.end("limit");
    return JSON.stringify({ now: this.now, state: this.state, events });
  }
  async #step(did, until) {
    try {
      const step = await this.#call("edu_step", { robot: this.#robot, did, until });
      this.#take(step);
      return step;
    } catch (error) {
      this.end("error", { rule: "robot", line: 0, column: 1, holes: { text: error.message } });
      return null;
    }
  }

  /** Ends the run and stops the robot. */
  end(how, error, did = []) {
    if (this.#over) return null;
    this.#over = { how, ...error ? { error } : {} };
    try {
      if (did.length) this.#take(this.#call("edu_step", { robot: this.#robot, did, until: this.now }));
      this.final = this.#call("robot_state", { robot: this.#robot });
      this.#over.stopped = this.#call("edu_end", { robot: this.#robot }).stopped;
    } catch { this.#over.stopped = false; }
    return null;
  }

  /** Parses a message and keeps what is valid; null if it is not a message. */
  #read(text) {
    let message;
    try {
      message = JSON.parse(text);
    } catch { return null; }
    if (message === null || typeof message !== "object") return null;
    const did = [];
    for (const one of Array.isArray(message.did) ? message.did.slice(0, most_deeds) : []) {
      if (!Array.isArray(one) || typeof one[0] !== "string") continue;
      if (told.has(one[0])) this.#on(one[0], this.now, ...one.slice(1, 5).map(value => typeof value === "boolean" ? value : String(value).slice(0, 1001)));
      else if (this.#names.has(one[0])) did.push(one);
    }
    const wake = typeof message.wake === "number" && Number.isFinite(message.wake) ? message.wake : null;
    const ended = message.ended === "done" || message.ended === "error" ? message.ended : null;
    return { did, wake, ended, error: ended === "error" ? read_error(message.error) : undefined };
  }
}

/** Validates an error from the sandbox; its holes become texts. */
function read_error(error) {
  const holes = {};
  for (const [name, value] of Object.entries(error?.holes ?? {}).slice(0, 8)) holes[name] = String(value).slice(0, 1001);
  const whole = value => Number.isInteger(value) && value >= 0 ? value : 0;
  return { rule: String(error?.rule ?? "exception").slice(0, 40), line: whole(error?.line), column: whole(error?.column), holes };
}
