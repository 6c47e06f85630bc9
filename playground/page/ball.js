// Runs: in the time of the robot, at once, and what is done to the ball meanwhile.

import { $, announce, button, element, with_code } from "./dom.js";
import { ending_of, program_of } from "./workspace.js";

const silent_ms = 4000; // without a frame
const frame_ms = 33; // between two pictures of a robot that is driven
const patience = 400; // milliseconds that a worker has to end a run itself

/** What `run` and `start` are asked: the files, which of them, and the world around. */
export function request(workspace) {
  const { files, run, active } = workspace;
  const program = program_of(workspace, active);
  const macros = ending_of(program) === "macro" ? [] : Object.keys(files).filter(name => ending_of(name) === "macro");
  const input = run.input.split(/[\s,;]+/).filter(Boolean).map(Number).filter(Number.isFinite);
  return { files, names: [program, ...macros], stimuli: run.stimuli, input, seed: run.seed, ...run.course ? { course: run.course } : {} };
}

const nothing = { t: [], x: [], y: [], heading: [], speed: [], rgb: [], value: [], file: [], line: [] };
/** A ball that has done nothing yet, as data of a run. */
const at_rest = {
  title: "", end: { t: 0, reason: "", text: "" }, totals: [], counts: {}, thinned: "", files: [],
  words: { basic: {}, structured: {}, macro: {} }, walls: [], pose: { step: 50_000, ...nothing }, led: nothing, backled: nothing,
  line: nothing, variables: [], sensors: [], events: [],
};
const icons = { run: "M7 4l14 8-14 8z", stop: "M6 6h12v12H6z" };

/** `machine`: the client of a worker that may be ended at any time. */
export class Ball {
  constructor({ machine, player, workspace, on_mistakes, on_place, on_begin, on_busy }) {
    Object.assign(this, { machine, player, workspace, on_mistakes, on_place, on_begin, on_busy, busy: "", heading: 0 });
    machine.on("frame", frame => this.take_frame(frame));
    machine.on("end", answer => this.end(answer));
    for (const one of $("hands").querySelectorAll("[data-line]")) one.addEventListener("click", () => this.press(one));
    $("number-form").addEventListener("submit", event => this.send(event, $("number"), value => this.machine.call("input", { value: Number(value) })));
    $("line-form").addEventListener("submit", event => this.send(event, $("line"), line => this.machine.call("stimulus", { line })));
  }

  set_busy(what) {
    this.busy = what;
    const runs = what !== "";
    // One button for both keeps its focus.
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
    $("outcome").replaceChildren(...words ? [element("p", {}, with_code(words))] : [], ...more);
    $("outcome").className = bad ? "bad" : "";
  }
  /** Nothing has run yet: the ball rests in the middle. */
  rest() {
    if (this.busy === "robot") this.leash.abort();
    else if (this.busy) {
      this.finish();
      this.machine.restart();
    }
    this.player.settle();
    $("played").classList.add("idle");
    this.player.load(structuredClone(at_rest));
    this.say("");
  }
  show(report, goes_on) {
    $("played").classList.remove("idle");
    this.player.load(report, null, goes_on);
  }

  /** In the time of the robot, until it ends or is stopped. */
  async start() {
    const asked = request(this.workspace());
    if (!this.ready(asked)) return;
    this.set_busy("live");
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
  /** On a robot: the program runs here, and the robot at the other end of `link` is its body; `do_wish` of link.js uses that. */
  async drive(link, do_wish) {
    const asked = request(this.workspace());
    if (!this.ready(asked)) return;
    this.set_busy("robot");
    this.say("getting the robot ready");
    this.on_begin();
    const { signal } = this.leash = new AbortController();
    this.told = "";
    const begin = performance.now();
    const now = () => performance.now() - begin;
    try {
      let step = await this.machine.call("drive_start", { ...asked, robot: link.name ?? "", for: "0" });
      while (step.wish) {
        if (signal.aborted) throw new Error("stopped; the robot was not moved");
        step = await this.machine.call("drive_step", { at: now(), ...await do_wish(link, step.wish, now) });
      }
      this.show(step.report, true);
      this.say(this.running = `driving the ${step.robot}; Stop brakes it`);
      this.player.play();
      let done = {}, shown = 0;
      while (!step.over) {
        const frame = now() - shown >= frame_ms;
        if (frame) shown = now();
        step = await this.machine.call("drive_step", { at: now(), ...done, stop: signal.aborted, frame });
        if (step.frame) this.take_frame(step.frame);
        done = step.write.length ? await do_wish(link, { write: step.write }, now) : {};
        if (!done.error && !step.over) done = await do_wish(link, { read_until: now() + step.wait_ms }, now);
      }
      this.finish();
      this.conclude(step.over, false);
      const stop = step.stopped ? "the robot has been stopped" : "the robot has not acknowledged the stop: check that it has stopped";
      $("outcome").append(element("p", { class: step.stopped ? "hint" : "bad" }, [step.trouble, stop].filter(Boolean).join("; ")));
    } catch (error) {
      this.fail(error);
    }
  }
  /** An engine that is silent is named. */
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
  /** All that is known of a fault: what happened where, with which values, and what helps. */
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
  /** How a run ended, and why where that needs saying. */
  conclude({ ending, hint, report }, plays) {
    if (report) this.show(report, false);
    const words = [ending?.words, ending?.story, ending?.aborted].filter(Boolean).join("; ");
    const [fault] = ending?.faults ?? [];
    // What it waited for is said with the option of a command line, which here is a button.
    if (fault) this.tell_fault(fault, words);
    else this.say(words + (hint ? `. ${hint.split(";")[0]}: press Run and do it by hand, or set it under More` : ""));
    if (plays) this.player.play();
    else this.player.seek(this.player.end());
  }

  /** All of it, as fast as it goes. */
  async instant() {
    const asked = request(this.workspace());
    if (!this.ready(asked)) return;
    this.set_busy("instant");
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
    this.say("There is no program yet: create a file that ends in .orb, .bas or .macro.", true);
    return false;
  }
  fail(error) {
    if (error.code === "stopped") return; // stop() has said so
    this.finish();
    this.player.settle();
    if (error.findings) this.on_mistakes(error.findings);
    this.say(error.findings ? "It has errors; they are listed below the program." : error.message, true);
  }
  /** The engine is gone. */
  give_up(reason) {
    if (!this.busy) return;
    this.finish();
    this.player.settle();
    this.say(`orb's engine has stopped: ${reason}`, true);
  }

  /** At once, whatever the program does. */
  async stop() {
    if (!this.busy) return;
    if (this.busy === "robot") return this.leash.abort(); // the run ends once it is braked
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
    // A bump comes from where it drives to.
    this.stimulus(line === "bump" ? `push ${Math.round(this.heading + 180) % 360} 255` : line);
  }
  stimulus(line) {
    return this.machine.call("stimulus", { line }).catch(error => this.say(error.message, true));
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
