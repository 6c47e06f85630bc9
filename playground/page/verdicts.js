// Tests: their verdicts, and what failed played back.

import { $, element, button } from "./dom.js";
import { same_files } from "./workspace.js";

const signs = { __proto__: null, passed: "✓", failed: "✗", error: "!" };

export class Verdicts {
  constructor({ machine, ball, workspace, on_place, on_passed, on_hand_in }) {
    Object.assign(this, { machine, ball, workspace, on_place, on_passed });
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
      const { results } = await this.machine.call("test", { files, names });
      const findings = await this.mistakes(results, files);
      if (this.ball.run_number !== run) return;
      if (findings) return this.ball.fail({ findings });
      this.ball.finish();
      this.show(results, files);
    } catch (error) {
      if (this.ball.run_number === run) this.ball.fail(error);
    }
  }
  /** What is wrong with the programs that could not be tested, as `check` says it; null where nothing is. */
  async mistakes({ tests }, files) {
    const names = [...new Set(tests.filter(({ cases }) => cases.every(one => one.verdict === "error")).map(({ program }) => program))]
      .filter(name => Object.hasOwn(files, name));
    if (!names.length) return null;
    const found = await this.machine.call("check", { files, names });
    return found.summary.errors ? found : null;
  }
  /** A verdict belongs to a text: it says so where that is another now. */
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
    if (passed === all && !$("verdicts").classList.contains("stale")) this.cheer(this.on_passed());
    $("verdicts").scrollIntoView({ block: "nearest" });
  }
  /** A lesson is done: that deserves a moment, and leads on; `next` is null where it is no lesson. */
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
      const where = button(`line ${miss.line}`, () => this.on_place(test.file, miss.line), { class: "link" });
      item.append(element("p", {}, element("code", {}, miss.expected), " ", where, element("br"), `seen: ${miss.seen}`, miss.where ? element("span", { class: "hint" }, ` ${miss.where}`) : ""));
    }
    if (failed?.problem) item.append(element("p", {}, failed.problem));
    return item;
  }
  async replay(test, one, files) {
    if (this.ball.busy) return;
    this.ball.set_busy("replay");
    try {
      const { report } = await this.machine.call("replay", { files, names: [test.file], test: test.test, seed: one.seed, program: test.program });
      this.ball.finish();
      this.ball.show(report, false);
      this.ball.say(`the run of “${test.test}”${one.verdict === "passed" ? "" : `: ${one.misses?.[0]?.seen ?? one.problem ?? ""}`}`, one.verdict !== "passed");
      this.ball.player.play();
    } catch (error) {
      this.ball.fail(error);
    }
  }
}
