// Runs, in the robot's time or at once, and what the user does to the ball meanwhile.

import { $, announce, button, element, with_code } from "./dom.js";
import { ending_of, program_of } from "./workspace.js";

const silent_ms = 4000; // without a frame
const patience = 400; // milliseconds for a worker to end a run by itself

/** The parameters of `run` and `start`: the files, which of them, and the world. */
export function request(workspace) {
  const { files, run, active } = workspace;
  const program = program_of(workspace, active);
  const macros = ending_of(program) === "macro" ? [] : Object.keys(files).filter(name => ending_of(name) === "macro");
  const input = run.input.split(/[\s,;]+/).filter(Boolean).map(Number).filter(Number.isFinite);
  return { files, names: [program, ...macros], stimuli: run.stimuli, input, seed: run.seed, ...run.course ? { course: run.course } : {} };
}

const nothing = { t: [], x: [], y: [], heading: [], speed: [], rgb: [], value: [], file: [], line: [] };
/** The data of a run in which nothing has happened yet. */
const at_rest = {
  title: "", end: { t: 0, reason: "", text: "" }, totals: [], counts: {}, thinned: "", files: [],
  words: { basic: {}, structured: {}, macro: {} }, walls: [], pose: { step: 50_000, ...nothing }, led: nothing, backled: nothing,
  line: nothing, variables: [], sensors: [], events: [],
};
/** True if something will probably be listed below the ball, which is then placed accordingly from the start. */
const will_tell = ({ files, names, stimuli, course }) => names.length > 1 || stimuli.length > 0 || !!course || /\bprint\b/i.test(files[names[0]] ?? "");

const near_home = 10; // centimetres
const a_way = 50; // centimetres; less is a wobble
/** The summary of a run, and additional remarks. */
function last_words(story) {
  const [, x, y, way, unit, more] = /^stopped at (-?\d+),(-?\d+) cm after ([\d.]+) (cm|m)(?:, (.*))?$/.exec(story) ?? [];
  const is_home = Math.hypot(x, y) <= near_home && way * (unit === "m" ? 100 : 1) >= a_way;
  return is_home ? [`Home again after ${way} ${unit}`, more] : [story, ""];
}
const icons = { run: "M7 4l14 8-14 8z", stop: "M6 6h12v12H6z" };

/** `machine`: the client of a worker that may be ended at any time. `foreign(name)`: what runs a program that the engine
 *  cannot run, else null. While one runs, `foreign_run` stops it and passes stimuli to its robot. */
export class Ball {
  constructor({ machine, player, workspace, remark, on_mistakes, on_place, on_begin, on_busy, foreign }) {
    Object.assign(this, { machine, player, workspace, remark, on_mistakes, on_place, on_begin, on_busy, foreign, foreign_run: null, busy: "", heading: 0, wish: () => {} });
    machine.on("frame", frame => this.take_frame(frame));
    machine.on("end", answer => this.end(answer));
    for (const one of $("hands").querySelectorAll("[data-line]")) one.addEventListener("click", () => this.press(one));
    $("number-form").addEventListener("submit", event => this.send(event, $("number"), value => this.machine.call("input", { value: Number(value) })));
    $("line-form").addEventListener("submit", event => this.send(event, $("line"), line => (this.foreign_run?.stimulus(line) ?? this.machine.call("stimulus", { line }))));
  }

  set_busy(what) {
    this.busy = what;
    const runs = what !== "";
    // Using one button for both keeps the focus.
    $("run").classList.toggle("stop", runs);
    $("run-words").textContent = runs ? "Stop" : "Run";
    $("run-icon").setAttribute("d", runs ? icons.stop : icons.run);
    $("instant").setAttribute("aria-disabled", String(runs));
    this.on_busy();
    $("hands").hidden = what !== "live" && what !== "robot";
    $("hands").classList.toggle("of-robot", what === "robot");
    $("player").classList.toggle("is-live", what === "live");
  }
  say(words, bad = false, more = []) {
    $("outcome").replaceChildren(...words ? [element("p", { class: more.length ? "main" : undefined }, with_code(words))] : [], ...more);
    $("outcome").className = bad ? "bad" : "";
  }
  /** Shows the ball at rest in the middle, before any run. */
  rest() {
    if (this.busy === "robot") this.leash.abort();
    else if (this.busy) {
      this.foreign_run?.stop();
      this.foreign_run = null; // its results no longer matter
      this.finish();
      this.machine.restart();
    }
    this.player.settle();
    this.wish([]);
    this.feel("");
    this.expect(request(this.workspace()));
    $("played").classList.add("idle");
    this.player.load(structuredClone(at_rest));
    document.querySelector(".transport").inert = true; // there is nothing to play yet
    this.say("");
  }
  /** Prepares the page for a run. */
  expect(asked) {
    $("played").classList.toggle("tells", will_tell(asked));
    $("no-events").textContent = "What the ball prints and hits is listed here.";
  }
  /**
   * Sets the ball's mood until something else is shown, "sad", "glad" or "", and what it says.
   */
  feel(mood, words = "") {
    $("played").dataset.mood = mood;
    this.remark(words);
  }
  show(report, goes_on, ghosts = []) {
    this.wish(ghosts); // verdicts.js sets them
    this.feel("");
    $("played").classList.remove("idle");
    $("played").classList.toggle("in-course", !!report.course);
    if (!goes_on) $("no-events").textContent = "Nothing was printed and nothing was hit.";
    this.player.load(report, null, goes_on);
  }

  /** Runs in the robot's time until the program ends or is stopped. */
  async start() {
    const asked = request(this.workspace());
    if (!this.ready(asked)) return;
    const foreign = this.foreign(asked.names[0]);
    if (foreign) return foreign(edu => edu.start(asked, true));
    this.set_busy("live");
    this.expect(asked);
    this.say("running");
    this.on_begin();
    const run = this.run_number = {};
    this.told = "";
    try {
      const { report } = await this.machine.call("start", asked);
      if (this.run_number !== run) return;
      this.show(report, true);
      this.say(this.running = "running");
      this.player.play();
      this.expect_frame();
    } catch (error) {
      if (this.run_number === run) this.fail(error);
    }
  }
  /** Reports an engine that stays silent. */
  expect_frame() {
    clearTimeout(this.silence);
    this.silence = setTimeout(() => {
      if (this.busy === "live") this.say("The engine has not answered for several seconds; Stop ends it.", true);
    }, silent_ms);
  }
  take_frame({ ms, waits_for, pose, prints, faults, ended, more }) {
    if (this.busy !== "live" && this.busy !== "robot") return;
    if (this.busy === "live") this.expect_frame();
    if (more) this.player.grow(more, ms * 1000);
    if (pose) this.heading = pose.heading;
    if (prints) announce(prints);
    const [fault] = faults ?? [];
    if (fault) return this.tell_fault(fault, "The program has stopped");
    if (ended && !this.told) {
      this.told = ended;
      this.say(`${ended}; the ball is still rolling`);
    }
    const waits = waits_for || "";
    if (waits === this.waits) return;
    this.waits = waits;
    $("number-words").textContent = waits ? `It is waiting for ${waits}` : "Number";
    $("number-form").classList.toggle("wanted", waits !== "");
    if (!this.told) this.say(waits ? `waiting for ${waits}` : this.running);
    if (waits && $("player").contains(document.activeElement)) $("number").focus();
  }
  /** Shows everything known about a fault: what happened where, with which values, and what helps. */
  tell_fault(fault, words) {
    this.told = fault.message;
    const { file, line, message, seen, variables, finding, help } = fault;
    const details = seen ? variables : finding;
    this.say("", true, [
      element("p", {}, with_code(`${words}: ${message}${seen ? `: ${seen}` : ""} `), line ? button(`line ${line}`, () => this.on_place(file, line), { class: "link" }) : ""),
      ...[details, help].filter(Boolean).map(text => element("p", { class: "hint" }, with_code(text))),
    ]);
  }
  end(answer) {
    if (this.busy !== "live") return;
    this.finish();
    this.conclude(answer, false);
  }
  finish() {
    clearTimeout(this.silence);
    this.run_number = null;
    this.waits = "";
    this.set_busy("");
    $("number-form").classList.remove("wanted");
    for (const one of $("hands").querySelectorAll("[aria-pressed]")) one.setAttribute("aria-pressed", "false");
  }
  /** Shows how a run ended, and why if needed. */
  conclude({ ending, hint, report }, plays) {
    if (report) this.show(report, false);
    const { words, story, aborted } = ending ?? {}, [last, more] = last_words(story ?? "");
    const [fault] = ending?.faults ?? [];
    // The hint names a command-line option, which is a button here.
    if (fault) this.tell_fault(fault, [words, story, aborted].filter(Boolean).join("; "));
    else if (hint) this.say(`${[words, story, aborted].filter(Boolean).join("; ")}. ${hint.split(";")[0]}: press Run and do it by hand, or set it under More`);
    else this.say(last, false, [element("p", { class: "ran" }, with_code([more, words, aborted].filter(Boolean).join("; ")))]);
    if (plays) this.player.play();
    else this.player.seek(this.player.end());
  }

  /** Runs the whole program as fast as possible. */
  async instant() {
    const asked = request(this.workspace());
    if (!this.ready(asked)) return;
    const foreign = this.foreign(asked.names[0]);
    if (foreign) return foreign(edu => edu.start({ ...asked, for: this.workspace().run.for }, false));
    this.set_busy("instant");
    this.expect(asked);
    this.say("running…");
    this.on_begin();
    const run = this.run_number = {};
    try {
      const answer = await this.machine.call("run", { ...asked, for: this.workspace().run.for, report: true });
      if (this.run_number !== run) return;
      this.finish();
      this.conclude(answer, true);
      announce(answer.prints);
    } catch (error) {
      if (this.run_number === run) this.fail(error);
    }
  }
  ready({ names }) {
    if (this.busy) return false;
    if (names[0]) return true;
    this.say("There is no program yet: create a file that ends in .orb, .bas, .macro or .js.", true);
    return false;
  }
  fail(error) {
    if (error.code === "stopped") return; // stop() has reported it
    this.finish();
    this.player.settle();
    if (error.findings) this.on_mistakes(error.findings);
    this.say(error.findings ? "It has errors; they are listed below the program." : error.message, true);
  }
  /** Ends a run whose engine is gone. */
  give_up(reason) {
    if (!this.busy) return;
    this.foreign_run = null;
    this.finish();
    this.player.settle();
    this.say(`orb's engine has stopped: ${reason}`, true);
  }

  /** Stops at once, whatever the program does. */
  async stop() {
    if (!this.busy) return;
    if (this.busy === "robot") return this.leash.abort(); // the run ends once it is braked
    if (this.foreign_run) return this.foreign_run.stop();
    const run = this.run_number;
    if (this.busy === "live") {
      this.machine.call("stop", {}).catch(() => {});
      await new Promise(done => setTimeout(done, patience));
      if (!this.busy || this.run_number !== run) return;
    }
    this.finish();
    this.machine.restart();
    this.player.settle();
    this.say("stopped");
  }

  press(one) {
    const back = one.dataset.back && one.getAttribute("aria-pressed") === "true";
    if (one.dataset.back) one.setAttribute("aria-pressed", String(!back));
    const line = back ? one.dataset.back : one.dataset.line;
    // A bump comes from the direction of travel.
    this.stimulus(line === "bump" ? `push ${Math.round(this.heading + 180) % 360} 255` : line);
  }
  stimulus(line) {
    return (this.foreign_run?.stimulus(line) ?? this.machine.call("stimulus", { line })).catch(error => this.say(error.message, true));
  }
  async send(event, field, deed) {
    event.preventDefault();
    const value = field.value.trim();
    if (value === "" || field === $("number") && !Number.isFinite(Number(value))) return field.focus();
    try {
      await deed(value);
      field.value = "";
    } catch (error) {
      this.say(error.message, true);
    }
    field.focus();
  }
}
