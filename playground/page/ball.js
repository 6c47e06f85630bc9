// Runs: in the time of the robot, at once, and what is done to the ball meanwhile.

import { $ } from "./dom.js";
import { ending_of, program_of } from "./workspace.js";

const often = 150; // milliseconds between two looks at a run that goes on
const patience = 400; // milliseconds that a worker has to end a run itself

/** What `run` and `start` are asked: the files, which of them, and the world around. */
export function request(workspace) {
  const { files, run, active } = workspace;
  const program = program_of(workspace, active);
  const macros = ending_of(program) === "macro" ? [] : Object.keys(files).filter(name => ending_of(name) === "macro");
  const input = run.input.split(/[\s,;]+/).filter(Boolean).map(Number).filter(Number.isFinite);
  return { files, names: [program, ...macros], stimuli: run.stimuli, input, seed: run.seed, ...run.course ? { course: run.course } : {} };
}

/** `machine`: the client of a worker that may be ended at any time. */
export class Ball {
  constructor({ machine, player, workspace, on_mistakes, on_begin, on_busy }) {
    Object.assign(this, { machine, player, workspace, on_mistakes, on_begin, on_busy, busy: "", last: null, heading: 0 });
    machine.on("frame", frame => this.take_frame(frame));
    machine.on("end", answer => this.end(answer));
    for (const one of $("hands").querySelectorAll("[data-line]")) one.addEventListener("click", () => this.press(one));
    $("number-form").addEventListener("submit", event => this.send(event, $("number"), value => this.machine.call("input", { value: Number(value) })));
    $("line-form").addEventListener("submit", event => this.send(event, $("line"), line => this.machine.call("stimulus", { line })));
  }

  set_busy(what) {
    this.busy = what;
    for (const id of ["run", "instant"]) $(id).disabled = what !== "";
    this.on_busy();
    $("stop").disabled = what === "";
    $("hands").hidden = what !== "live";
    $("player").classList.toggle("is-live", what === "live");
  }
  say(words, bad = false) {
    $("outcome").textContent = words;
    $("outcome").className = bad ? "bad" : "";
  }
  show(report, goes_on) {
    $("nothing").hidden = true;
    $("played").hidden = false;
    this.player.load(report, null, goes_on);
  }

  /** In the time of the robot, until it ends or is stopped. */
  async start() {
    const asked = request(this.workspace());
    if (!this.ready(asked)) return;
    this.set_busy("live");
    this.say("running");
    this.last = null;
    this.on_begin();
    const run = this.run_number = {};
    try {
      await this.machine.call("start", asked);
    } catch (error) {
      if (this.run_number === run) this.fail(error);
      return;
    }
    while (this.busy === "live" && this.run_number === run) {
      const began = performance.now();
      try {
        const report = await this.machine.call("report", {});
        if (this.busy !== "live" || this.run_number !== run) return;
        const first = !this.last;
        this.last = report;
        const words = $("outcome").textContent, look = $("outcome").className;
        this.show(report, true);
        $("outcome").textContent = words; // that of a run that goes on is no outcome
        $("outcome").className = look;
        if (first) this.player.play();
      } catch (error) {
        if (error.code === "stopped") return;
      }
      // A long run is looked at less often, so that most of the time is its own.
      const cost = performance.now() - began;
      await new Promise(done => setTimeout(done, Math.max(often, 4 * cost)));
    }
  }
  take_frame({ waits_for, pose }) {
    if (this.busy !== "live") return;
    if (pose) this.heading = pose.heading;
    const waits = waits_for || "";
    if (waits === this.waits) return;
    this.waits = waits;
    $("number-words").textContent = waits ? `It waits for ${waits}` : "Number";
    $("number-form").classList.toggle("wanted", waits !== "");
    this.say(waits ? `waits for ${waits}` : "running");
    if (waits && $("player").contains(document.activeElement)) $("number").focus();
  }
  end(answer) {
    if (this.busy !== "live") return;
    this.finish();
    this.conclude(answer, false);
  }
  finish() {
    this.run_number = null;
    this.waits = "";
    this.set_busy("");
    $("number-form").classList.remove("wanted");
    for (const one of $("hands").querySelectorAll("[aria-pressed]")) one.setAttribute("aria-pressed", "false");
  }
  /** How a run ended, and why where that needs saying. */
  conclude({ ending, hint, report }, plays) {
    if (report) this.show(report, false);
    const fault = ending?.faults?.[0];
    const words = fault ? `${fault.message}${fault.help ? `: ${fault.help}` : ""} (line ${fault.line})` : [ending?.words, ending?.story].filter(Boolean).join("; ");
    // What it waited for is said with the option of a command line, which here is a button.
    const waits = hint ? `. ${hint.split(";")[0]}: press Run and do it by hand, or put it under World` : "";
    this.say(words + waits, !!fault);
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
    try {
      const answer = await this.machine.call("run", { ...asked, for: this.workspace().run.for, report: true });
      this.finish();
      this.conclude(answer, true);
    } catch (error) {
      this.fail(error);
    }
  }
  ready({ names }) {
    if (this.busy) return false;
    if (names[0]) return true;
    this.say("There is no program yet: make a file that ends in .orb, .bas or .macro.", true);
    return false;
  }
  fail(error) {
    if (error.code === "stopped") return; // stop() has said so
    this.finish();
    if (error.findings) this.on_mistakes(error.findings);
    this.say(error.findings ? "It has mistakes: see below the program." : error.message, true);
  }

  /** At once, whatever the program does. */
  async stop() {
    if (!this.busy) return;
    const run = this.run_number;
    if (this.busy === "live") {
      this.machine.call("stop", {}).catch(() => {});
      await new Promise(done => setTimeout(done, patience));
      if (!this.busy || this.run_number !== run) return;
    }
    this.finish();
    this.machine.restart();
    if (this.last) this.show(this.last, false);
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
