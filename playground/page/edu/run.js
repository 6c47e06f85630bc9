// Runs of JavaScript programs: the program is in a sandbox of the page, the robot in the engine's worker.

import { check, tree_of } from "../../edu/check.js";
import { prepare } from "../../edu/prepare.js";
import { words_of } from "../../edu/texts.js";
import { announce } from "../dom.js";
import { Ended, Sandbox, patience_s } from "./sandbox.js";

/** The rule of the error for each reason of the sandbox to end a program. */
const reasons = { __proto__: null, busy: "silent", broken: "exception" };
/** The error of a run whose sandbox has ended. */
export const reason_of = ({ kind, line = 0, text = "" }, n = patience_s) => ({ rule: reasons[kind] ?? "forged", line, column: 1, holes: { n, text } });
const seconds_of = text => { const [, number, unit] = /^(\d+)(ms|s|min)$/.exec(text) ?? [0, 60, "s"]; return number * { ms: .001, s: 1, min: 60 }[unit]; };
/** The lines of a stimulus script, without comments. */
const lines_of = script => script.split("\n").map(line => line.replace(/#.*/, "").trim()).filter(Boolean);
const endless = 1e9; // seconds
const patience = 400; // milliseconds for the engine to end a run itself
const patience_driving_s = 2; // shorter, as a real robot drives on meanwhile

/** `kind()`: the chosen robot, with its `title_of()`; `on_heard(what, values)`: output of a live run. */
export function make_runs({ machine, ball, table, kind, title_of, say, on_heard }) {
  const edu = (deed, params = {}) => machine.call("edu_run", { deed, ...params });
  machine.on("heard", ({ what, values }) => on_heard(what, values));

  /** How a run ended, in the form of the engine's runs. */
  function ending_of({ over, seconds, story }, name) {
    const time = `after ${seconds.toFixed(3).replace(/0{1,2}$/, "")} s of robot time`;
    const manner = { done: "ended", limit: "stopped by the time limit", stopped: "stopped" }[over.how] ?? "stopped";
    const ending = { words: `${manner} ${time}`, story };
    if (over.how === "error") {
      ending.faults = [{ file: name, line: over.error.line, message: words_of(over.error, say) }];
    }
    if (over.how !== "done") window.speechSynthesis?.cancel(); // what it has not said yet
    return ending;
  }
  function conclude(over, name, lives) {
    ball.finish();
    ball.conclude({ ending: ending_of(over, name), report: over.report }, !lives);
    if (!lives) announce(over.prints);
  }
  /** Makes a sandbox for a program; throws its syntax error. */
  function sandbox_of(name, source) {
    const mistake = check(source, { table, kind: kind(), say }).find(one => one.rule === "syntax");
    if (mistake) throw Object.assign(new Error(mistake.message), { findings: { diagnostics: [{ ...mistake, file: name }] } });
    return new Sandbox(prepare(source, tree_of(source)));
  }
  /** `asked`: from request() of ball.js. Settles when the run is over. */
  async function start(asked, lives) {
    const [name] = asked.names, source = asked.files[name];
    ball.set_busy(lives ? "live" : "instant");
    ball.expect(asked);
    ball.say("running");
    ball.on_begin();
    let sandbox;
    try {
      sandbox = sandbox_of(name, source);
    } catch (mistake) {
      return ball.fail(mistake);
    }
    /** Stops the program, whatever it is doing, and shows how the run ended. */
    const stop = async (how, error) => {
      sandbox.end();
      const { over } = await Promise.race([edu("end", { how, error }).catch(() => ({})), new Promise(done => setTimeout(done, patience, {}))]);
      if (ball.foreign_run !== run) return;
      ball.foreign_run = null;
      if (over) return conclude(over, name, lives);
      ball.finish();
      machine.restart();
      ball.player.settle();
      ball.say("stopped");
    };
    const run = ball.foreign_run = { stop: () => stop("stopped"), stimulus: line => edu("stimulus", { line }) };
    ball.told = "";
    try {
      let { ask, report } = await edu("begin", { table, kind: kind(), seed: asked.seed, title: name, course: asked.course ? asked.files[asked.course] : undefined,
        stimuli: asked.stimuli.flatMap(one => Object.hasOwn(asked.files, one) ? lines_of(asked.files[one]) : one), limit: lives ? endless : seconds_of(asked.for), live: lives });
      if (ball.foreign_run !== run) return;
      if (lives) {
        ball.show(report, true);
        ball.say(ball.running = "running");
        ball.player.play();
        ball.expect_frame();
      }
      for (;;) {
        const text = await sandbox.ask(ask);
        const answer = await edu("answer", { text });
        if (ball.foreign_run !== run) return;
        ask = answer.ask;
        if (ask) continue;
        ball.foreign_run = null;
        sandbox.end();
        if (answer.over) conclude(answer.over, name, lives);
        return;
      }
    } catch (error) {
      if (ball.foreign_run !== run) return sandbox.end();
      if (error instanceof Ended) return stop("error", reason_of(error));
      sandbox.end();
      ball.foreign_run = null;
      ball.fail(error);
    }
  }
  /** The driver of a program, for page/drive.js. */
  function driver(asked) {
    const [name] = asked.names, sandbox = sandbox_of(name, asked.files[name]);
    async function talk(ask) {
      let seconds; // at first the usual ones: it has not driven yet
      try {
        for (; ask; seconds = patience_driving_s) ({ ask } = await edu("answer", { text: await sandbox.ask(ask, seconds) }));
      } catch (error) {
        if (error instanceof Ended) edu("end", { how: "error", error: reason_of(error, seconds) }).catch(() => {}); // an engine that is gone shows in the next step
      }
    }
    return {
      start: robot => edu("take", { table, seed: asked.seed, title: name, advertised: robot }),
      async step(message) {
        const step = await edu("link", message);
        if (step.ask) talk(step.ask);
        if (step.ask && step.kind !== kind()) step.instead_of = title_of(kind());
        if (step.over) step.over = { ending: ending_of(step.over, name), report: step.over.report };
        return step;
      },
      end: () => sandbox.end(),
    };
  }
  return { start, driver };
}
