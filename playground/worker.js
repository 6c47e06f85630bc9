// The engine behind messages, and the clock of live runs: {id, method, params} in, {id, result} or {id, error}
// out, and events {event, data}.
import { instance_of, load_engine } from "./engine.js";
import { OrbError } from "./error.js";
import { instance_in_parts } from "./split/parts.js";

const frame_ms = 33;
class Missing extends Error {}
/**
 * The bytes of the rarely used part, from a file named by the build; synchronous, because a call waits for them.
 */
function rest_of_wasm() {
  const request = new XMLHttpRequest();
  request.open("GET", new URL(ORB_REST, import.meta.url), false);
  request.responseType = "arraybuffer";
  try {
    request.send();
  } catch {
    throw new Missing("a part of orb is not on this device yet: connect to the network once");
  }
  if (request.status !== 200) throw new Missing(`a part of orb could not be loaded (${request.status})`);
  return request.response;
}

let engine;
let clock = null; // for the live run: robot time `robot` at the moment `real`, and the speed factor

const robot_now = () => clock.paused ? clock.robot : clock.robot + (performance.now() - clock.real) * clock.speed;
const post = (event, data) => postMessage({ event, data });

function set_clock(changes) {
  if (!clock) return {};
  clock.robot = robot_now();
  clock.real = performance.now();
  Object.assign(clock, changes);
  clearTimeout(clock.timer);
  if (!clock.paused) clock.timer = setTimeout(tick, 0);
  return {};
}

function tick() {
  try {
    const { over, frame } = engine.call("live_advance", { ms: robot_now() });
    if (frame.faults.length) post_said();
    post("frame", frame);
    if (over) end();
    else clock.timer = setTimeout(tick, frame_ms);
  } catch (error) {
    clock = null;
    post("broken", { message: error.message });
  }
}

function end() {
  clearTimeout(clock?.timer);
  clock = null;
  let answer;
  try {
    answer = engine.call("live_end");
  } catch (error) {
    if (!(error instanceof OrbError)) throw error;
    answer = { ending: { words: error.message } }; // such as a macro refused by the robot
  }
  post_said();
  post("end", answer);
}

const own = {
  start({ speed = 1, ...params }) {
    if (clock) own.stop();
    const answer = engine.call("live_start", { for: "0", ...params });
    clock = { robot: 0, real: performance.now(), speed, paused: false };
    clock.timer = setTimeout(tick, 0);
    return answer;
  },
  stop() {
    if (!clock) return {};
    engine.call("live_advance", { ms: robot_now() });
    end();
    return {};
  },
  pause: () => set_clock({ paused: true }),
  resume: () => set_clock({ paused: false }),
  speed: ({ factor }) => set_clock({ speed: factor }),
  /** Calls a `deed` of page/edu/machine.js, loaded on demand. */
  async edu_run({ deed, ...params }) {
    edu ??= import("./page/edu/machine.js").then(({ make_machine }) => make_machine({ call: engine.call, post }), () => {
      edu = null;
      throw new OrbError({ code: 1, message: "a part of orb is not on this device yet: connect to the network once" });
    });
    return (await edu)[deed](params);
  },
};
let edu = null;

/** Sends the parts of the last answers' messages, so that the page can translate them. */
function post_said() {
  const said = engine.call("said");
  if (Object.keys(said).length) post("said", said);
}

function answer({ id, method, params = {} }) {
  const settle = result => {
    post_said();
    postMessage({ id, result });
  };
  try {
    const result = Object.hasOwn(own, method) ? own[method](params) : engine.call(method, params);
    if (result instanceof Promise) result.then(settle, refuse);
    else settle(result);
  } catch (error) {
    refuse(error);
  }
  function refuse(error) {
    // Not an error from orb: its memory can no longer be trusted.
    if (!(error instanceof OrbError)) post("broken", { message: error instanceof Missing ? error.message : `${method}: ${error.message}` });
    else post_said();
    postMessage({ id, error: { code: error.code ?? 70, message: error.message, findings: error.findings } });
  }
}

// Messages that arrive while the wasm loads wait here.
const waiting = [];
onmessage = ({ data }) => engine ? answer(data) : waiting.push(data);
load_engine(instance_in_parts(instance_of, rest_of_wasm)).then(made => {
  engine = made;
  post("ready", engine.call("version"));
  waiting.splice(0).forEach(answer);
}, error => post("broken", { message: error.message }));
