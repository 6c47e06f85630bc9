// Runs of JavaScript programs, in the engine's worker: a program drives a virtual robot there, at once or in real time, or a
// real one on a link of the page, which the virtual one then shows. The program itself is elsewhere (sandbox.js); its
// messages come in here as text.

import { Host, is_print } from "../../edu/host.js";

const endless = 1e9; // seconds
const patience = 0.1; // seconds that a run may lag before its clock waits
const near = 0.5; // centimetres; less is not a drive

const number_of = ([r, g, b]) => r << 16 | g << 8 | b;
const hex = rgb => number_of(rgb).toString(16).padStart(6, "0").toUpperCase();
const microseconds = seconds => Math.round(seconds * 1e6);
const none = () => ({ pose: { t: [], x: [], y: [], heading: [], speed: [] }, led: { t: [], rgb: [] }, backled: { t: [], value: [] }, matrix: { t: [], pixels: [] }, line: { t: [], file: [], line: [] }, events: [] });
/** Output for people rather than the robot, as the list of events shows it. */
const words_of = { __proto__: null, print: text => text, speak: text => text, sound: path => `♪ ${path}`, animation: path => `★ ${path}`, note: () => "" };

/** What the robot counts, as the list of events shows one more of it. */
const counted = { bumps: { kind: "bump", text: "hit something" }, collisions: { kind: "collision", text: "collision" } };

/** `call` calls the engine; `post(event, data)` sends to the page. */
export function make_machine({ call, post }) {
  let run = null;

  /** The state of the robot as rows of a report, with what has changed since the last picture. */
  function picture({ robot, shown }) {
    const state = call("robot_state", { robot }), more = none(), t = microseconds(state.t);
    const rgb = number_of(state.rgb), pixels = state.matrix?.map(hex).join("");
    more.pose.t.push(t);
    for (const key of ["x", "y", "heading", "speed"]) more.pose[key].push(state[key]);
    if (rgb !== shown.rgb) more.led = { t: [t], rgb: [rgb] };
    if (pixels && pixels !== shown.pixels) more.matrix = { t: [t], pixels: [pixels] };
    if (state.back_led !== shown.back) more.backled = { t: [t], value: [state.back_led] };
    Object.assign(shown, { rgb, pixels, back: state.back_led });
    return { state, more };
  }
  function post_frame() {
    const { state, more } = picture(run), fresh = run.said.slice(run.told);
    run.told = run.said.length;
    for (const [count, event] of Object.entries(counted)) {
      if (state[count] > run.shown[count]) fresh.push({ t: microseconds(state.t), ...event });
      run.shown[count] = state[count];
    }
    more.events = fresh;
    const { x, y, heading, speed } = state;
    post("frame", { ms: state.t * 1000, pose: { x, y, heading, speed }, prints: fresh.filter(({ kind }) => kind === "print").map(({ text }) => `${text}\n`).join(""), more });
  }
  /** Waits until it is time for `until`, in seconds of the run. */
  async function pace(now, until) {
    const mine = run;
    post_frame();
    const clock = performance.now() / 1000, due = mine.began + until;
    if (due < clock - patience) mine.began = clock - until; // the program took its time
    await new Promise(done => setTimeout(done, Math.max(0, due - clock) * 1000));
    return until;
  }
  function report() {
    const { robot, title, said } = run, made = call("robot_journey", { robot, title }).report;
    made.totals = made.totals.filter(([, , kind]) => kind !== "lines");
    made.events = [...made.events, ...said].sort((a, b) => a.t - b.t);
    for (const { kind } of said) made.counts[kind] = (made.counts[kind] ?? 0) + 1;
    return made;
  }
  /** How it went, in the words of other runs; empty if an error explains why it did not move. */
  function story(over) {
    const { x, y, way } = call("robot_state", { robot: run.robot });
    if (way < near) return over.how === "error" ? "" : "did not move";
    return `stopped at ${Math.round(x)},${Math.round(y)} cm after ${way < 100 ? `${way.toFixed(1)} cm` : `${(way / 100).toFixed(1)} m`}`;
  }
  function conclude() {
    const { over, now } = run.host;
    if (run.trial !== undefined) return { over: { over } };
    const answer = { over, seconds: now, story: story(over), report: report(), prints: run.said.map(({ text }) => `${text}\n`).join("") };
    forget();
    return { over: answer };
  }
  function forget() {
    if (run) call("robot_end", { robot: run.robot });
    run = null;
  }
  /** Makes a robot, and the Host that trusts nothing its program says. */
  function make_run({ table, kind, advertised, seed, title, course, limit, live, trial, asks = call }) {
    forget();
    const made = trial !== undefined ? call("trial_robot", { number: trial, kind })
      : call("robot", { kind, seed, ...advertised === undefined ? {} : { advertised }, ...course ? { course } : {} });
    run = { robot: made.robot, kind: made.kind, of: made.title, table, seed, title, live, trial, said: [], told: 0, shown: { bumps: 0, collisions: 0 }, began: performance.now() / 1000 };
    const on = (what, seconds, ...values) => {
      const text = words_of[what]?.(...values) ?? "";
      if (trial !== undefined && is_print(what)) call("trial_print", { robot: made.robot, text: `${text}\n` });
      if (text !== "") run.said.push({ t: run.origin + microseconds(seconds), kind: "print", text: `${text}\n` });
      if (live) post("heard", { what, values });
    };
    run.host = new Host({ call: asks, robot: run.robot, table, limit, on });
  }
  /** The first message for the program. */
  function first_words() {
    const { host, table, kind, seed } = run, ask = host.begin({ source: "", table, kind, seed });
    run.origin = microseconds(call("robot_state", { robot: run.robot }).t);
    return ask;
  }

  // -- a robot on a link of the page, which keeps the time and asks for every step --
  /** Stands in for the engine where the host calls it. */
  const on_link = {
    __proto__: null,
    edu_start: () => run.felt,
    /** Settles with the page's next step. */
    edu_step({ did, until }) {
      if (!run.host.over) return new Promise(done => { run.asked = { did, until, done }; });
      run.last = did;
      return run.felt;
    },
    robot_state: () => null,
    edu_end: () => ({}), // the page's steps do it
  };
  /** Answers the program with the new state and the events since the last answer. */
  function tell({ now, state, events }) {
    run.felt = { now, state };
    run.happened.push(...events);
    if (!run.asked) return;
    const { done } = run.asked;
    run.asked = null;
    done({ now, state, events: run.happened.splice(0) });
  }

  return {
    /** Returns the first message for the program. `stimuli` and `course` are its world; case number `trial` has its own. */
    begin({ stimuli = [], ...more }) {
      make_run(more);
      const ask = first_words();
      for (const line of stimuli) call("robot_stimulus", { robot: run.robot, line });
      run.began = performance.now() / 1000;
      return { ask, report: report() };
    },
    /** Takes the robot on a link of the page, by its advertised name; returns the first wish. */
    take(more) {
      make_run({ ...more, limit: endless, live: true, asks: (method, params) => on_link[method](params) });
      return call("edu_start", { robot: run.robot, linked: true });
    },
    /** Takes what came over the link, and `stop`. Returns a `wish` until the robot is ready, then `ask`, the first message
     *  for the program, and then what drive_step of the engine returns. */
    link({ stop, frame, ...came }) {
      const { robot, host } = run;
      if (!run.felt) {
        const ready = call("edu_start", { robot, ...came });
        if (ready.wish) return ready;
        Object.assign(run, { felt: ready, happened: [], last: [], asked: null });
        return { ask: first_words(), kind: run.kind, robot: run.of, report: report() };
      }
      if (stop) host.end("stopped");
      let answer = null;
      if (!host.over)
        try {
          const { did, until } = run.asked ?? { did: [], until: 0 };
          answer = call("edu_step", { robot, did, until, ...came });
          tell(answer);
        } catch (error) {
          run.trouble = error.message;
          host.end("stopped");
          came = { at: came.at }; // the link may work again
        }
      answer ??= call("edu_end", { robot, did: run.last.splice(0), ...came });
      if (frame) post_frame();
      if (!("stopped" in answer)) return answer;
      run.asked?.done({ ...run.felt, events: [] });
      return { trouble: run.trouble, ...answer, ...conclude() };
    },
    /** Takes a message of the program; returns `ask`, the next one for it, or `over`. */
    async answer({ text }) {
      const mine = run;
      if (!mine) return {};
      const ask = await mine.host.answer(text, mine.live && !mine.felt ? pace : undefined);
      if (run !== mine) return {};
      if (ask !== null) return { ask };
      mine.host.end("error", { rule: "forged", line: 0, column: 1, holes: {} }); // unless it has ended
      return mine.felt ? {} : conclude();
    },
    /** Ends the run, whatever the program does; `how` as in Host.over. */
    end({ how, error }) {
      if (!run) return {};
      run.host.end(how, error);
      return run.felt ? {} : conclude(); // a robot on a link must still be stopped
    },
    /** Judges the case that is over; `error`: why the program stopped. */
    judge({ error }) {
      const { robot, host } = run, { verdict } = call("trial_judge", { robot, how: host.over.how, seconds: host.now, error }), made = report();
      forget();
      return { verdict, report: made };
    },
    stimulus({ line }) {
      if (run) call("robot_stimulus", { robot: run.robot, line });
      return {};
    },
  };
}
