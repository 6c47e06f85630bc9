// The engine behind messages, and the clock of live runs: {id, method, params} in, {id, result} or {id, error}
// out, and events {event, data}.
import { instance_of, load_engine } from "./engine.js";
import { OrbError } from "./error.js";
import { instance_in_parts } from "./split/parts.js";

const frame_ms = 33;
class Missing extends Error {}
/** The bytes of what few visits need, in a file whose name the build knows: a call is waiting for them. */
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
let clock = null; // of the live run: robot time `robot` at the moment `real`, and how much faster it runs

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
    answer = { ending: { words: error.message } }; // such as a macro that the robot refused
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
};

/** Tells what the last answers are made of, so that the page can say them in its language. */
function post_said() {
  const said = engine.call("said");
  if (Object.keys(said).length) post("said", said);
}

function answer({ id, method, params = {} }) {
  try {
    const result = Object.hasOwn(own, method) ? own[method](params) : engine.call(method, params);
    post_said();
    postMessage({ id, result });
  } catch (error) {
    // Not an answer of orb: after that nothing in its memory can be relied on.
    if (!(error instanceof OrbError)) post("broken", { message: error instanceof Missing ? error.message : `${method}: ${error.message}` });
    else post_said();
    postMessage({ id, error: { code: error.code ?? 70, message: error.message, findings: error.findings } });
  }
}

// What comes while the wasm is loading waits.
const waiting = [];
onmessage = ({ data }) => engine ? answer(data) : waiting.push(data);
load_engine(instance_in_parts(instance_of, rest_of_wasm)).then(made => {
  engine = made;
  post("ready", engine.call("version"));
  waiting.splice(0).forEach(answer);
}, error => post("broken", { message: error.message }));
