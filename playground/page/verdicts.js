// Verdicts of tests, and the ball's reactions.

import { $, element, button } from "./dom.js";
import { make_ghosts } from "./ghost.js";
import { explain, moment_of } from "./teacher.js";
import { ending_of, same_files } from "./workspace.js";

const glad_for = 2400; // milliseconds
const not_passed = one => one.verdict !== "passed";
const signs = { __proto__: null, passed: "✓", failed: "✗", error: "!" };

export class Verdicts {
  /** `judge({files, names})` answers like the engine's `test`; for JavaScript with what page/edu/tests.js adds. */
  constructor({ machine, judge, ball, map, workspace, on_place, on_passed, on_hand_in }) {
    Object.assign(this, { machine, judge, ball, workspace, on_place, on_passed });
    ball.wish = make_ghosts(map);
    $("cheer-hand-in").addEventListener("click", on_hand_in);
    $("verdicts-close").addEventListener("click", () => { $("verdicts").hidden = true; });
  }
  /** `names`: the test files. */
  async run(names) {
    if (this.ball.busy) return;
    if (!names.length) return this.ball.say("There is no test here: create a file that ends in .test.", true);
    const files = structuredClone(this.workspace().files);
    this.ball.set_busy("test");
    this.ball.say("testing…");
    $("cheer").hidden = true;
    const run = this.ball.run_number = {};
    try {
      const tested = await this.judge({ files, names }), { results } = tested;
      const findings = await this.mistakes(tested, files);
      if (this.ball.run_number !== run) return;
      if (findings) return this.ball.fail({ findings });
      this.report_of = tested.report_of ?? (() => {});
      const failure = await this.first_failure(results, files);
      if (this.ball.run_number !== run) return;
      this.ball.finish();
      if (failure) this.show_failure(failure);
      this.show(results, files);
    } catch (error) {
      if (this.ball.run_number === run) this.ball.fail(error);
    }
  }
  /** The errors in programs that could not be tested, as `check` reports them; null if there are none. */
  async mistakes({ results: { tests }, findings }, files) {
    if (findings) return findings;
    const names = [...new Set(tests.filter(({ cases }) => cases.every(one => one.verdict === "error")).map(({ program }) => program))]
      .filter(name => Object.hasOwn(files, name) && ending_of(name) !== "js");
    if (!names.length) return null;
    const found = await this.machine.call("check", { files, names });
    return found.summary.errors ? found : null;
  }
  /** The run of the first failed test, to show; null if none failed or it has no run. */
  async first_failure({ tests }, files) {
    const test = tests.find(({ cases }) => cases.some(not_passed)), one = test?.cases.find(not_passed);
    if (!one?.misses?.length) return null;
    return { report: await this.run_again(test, one, files), miss: one.misses[0] };
  }
  /** The report of a case's run. */
  async run_again(test, { seed }, files) {
    return this.report_of(test) ?? (await this.machine.call("replay", { files, names: [test.file], test: test.test, seed, program: test.program })).report;
  }
  /** Shows the moment at which it went wrong, and what was wanted. */
  show_failure({ report, miss }) {
    const { wish, ghosts } = explain(miss), { ball } = this;
    ball.show(report, false, ghosts);
    ball.player.seek(moment_of(miss) ?? ball.player.end());
    ball.feel("sad", wish);
  }
  /** Marks the verdict as outdated if the text has changed. */
  changed(files) {
    if ($("verdicts").hidden) return;
    const same = same_files(files, this.tested.files);
    $("verdicts-title").textContent = same ? this.tested.words : `Before your change: ${this.tested.words}`;
    $("verdicts").classList.toggle("stale", !same);
  }
  show({ tests, summary }, files) {
    const { tests: all, passed, points, pointsOf } = summary;
    const words = `${passed} of ${all} tests passed${pointsOf ? `, ${points} of ${pointsOf} points` : ""}`;
    this.tested = { files, words };
    $("verdicts").classList.toggle("all-passed", passed === all);
    $("verdict-list").replaceChildren(...tests.map(test => this.row(test, files)));
    $("verdicts").hidden = false;
    this.ball.say(passed === all ? `${words}. Well done!` : words, passed !== all);
    this.changed(this.workspace().files);
    if (passed === all && !$("verdicts").classList.contains("stale")) {
      this.cheer(this.on_passed());
      this.ball.feel("glad", "Done!");
      setTimeout(() => { if ($("played").dataset.mood === "glad") this.ball.feel(""); }, glad_for);
    }
    $("verdicts").scrollIntoView({ block: "nearest" });
  }
  /** Celebrates a finished lesson and leads to the next; `next` is null for other documents. */
  cheer(next) {
    $("cheer").hidden = next === null;
    $("cheer-hand-in").hidden = $("hand-in").hidden;
    $("cheer-next").hidden = !next;
    $("cheer-next").onclick = next ?? null;
  }
  row(test, files) {
    const failed = test.cases.find(one => one.verdict !== "passed");
    const one = failed ?? test.cases[0];
    const verdict = failed?.verdict ?? "passed";
    const item = element("li", { class: verdict, "data-verdict": verdict });
    const head = element("div", { class: "row" },
      element("span", { class: "sign", role: "img", "aria-label": verdict }, signs[verdict] ?? "!"),
      element("b", {}, test.test),
      element("span", { class: "hint" }, `${verdict === "passed" ? "" : "seed " + one.seed + ", "}${(one.ns / 1e9 || 0).toFixed(1)} s`),
      button("Watch", () => this.replay(test, one, files), { "aria-label": `Watch ${test.test} run` }));
    item.append(head);
    for (const miss of failed?.misses ?? []) {
      const where = button(`line ${miss.line}`, () => this.on_place(test.file, miss.line), { class: "link", title: miss.expected });
      const { words } = explain(miss);
      const told = words ? [element("span", { class: "miss" }, words), " ", where] : [element("code", {}, miss.expected), " ", where, element("br"), `seen: ${miss.seen}`];
      item.append(element("p", {}, ...told, miss.where ? element("span", { class: "hint" }, ` ${miss.where}`) : ""));
    }
    if (failed?.problem) item.append(element("p", {}, failed.problem));
    return item;
  }
  async replay(test, one, files) {
    if (this.ball.busy) return;
    this.ball.set_busy("replay");
    try {
      const report = await this.run_again(test, one, files);
      const [miss] = one.misses ?? [], { words, ghosts } = miss ? explain(miss) : { words: one.problem, ghosts: [] };
      this.ball.finish();
      this.ball.show(report, false, ghosts);
      this.ball.say(`the run of “${test.test}”${one.verdict === "passed" ? "" : `: ${words || miss?.seen || ""}`}`, one.verdict !== "passed");
      this.ball.player.play();
    } catch (error) {
      this.ball.fail(error);
    }
  }
}
