// Tests of JavaScript programs in the page: each case runs in a sandbox; robot and judge are in the engine's worker.

import { check, obstacle_in, tree_of } from "../../edu/check.js";
import { prepare } from "../../edu/prepare.js";
import { fault_at } from "../../edu/texts.js";
import { reason_of } from "./run.js";
import { Ended, Sandbox } from "./sandbox.js";

const key_of = ({ file, test, program }) => JSON.stringify([file, test, program]);

/** Parameters as in run.js. */
export function make_tests({ machine, ball, table, kind, say }) {
  const edu = (deed, params = {}) => machine.call("edu_run", { deed, ...params });

  /** Runs a program until it is over. */
  async function drive(sandbox, begun) {
    let { ask } = await edu("begin", begun);
    for (;;) {
      let answer;
      try {
        answer = await edu("answer", { text: await sandbox.ask(ask) });
      } catch (error) {
        if (!(error instanceof Ended) || error.kind === "stopped") throw error;
        answer = await edu("end", { how: "error", error: reason_of(error) });
      }
      if (answer.over) return answer.over;
      if (!answer.ask) throw new Ended("stopped"); // by another run
      ask = answer.ask;
    }
  }

  /** Tests any programs like the engine's `test`: {results, report_of, findings}. `report_of(test)`: the report of its first
   *  failed run, else of its first; undefined if the engine can repeat it. `findings`: what keeps programs from running, or
   *  null. */
  return async function test({ files, names }) {
    if (ball.busy && ball.busy !== "test") throw new Error(""); // its robot is in the same worker
    ball.foreign_run?.stop();
    const { cases, sources } = await machine.call("trials_start", { files, names }), mistakes = {}, runs = new Map();
    let sandbox = null;
    const mine = ball.foreign_run = { stop() {
      sandbox?.end();
      if (ball.foreign_run === mine) ball.foreign_run = null;
      return ball.stop(); // which ends the engine
    }, stimulus: async () => {} };
    try {
      for (const [name, source] of Object.entries(sources)) {
        const mistake = obstacle_in(check(source, { table, kind: kind(), say }));
        if (mistake) mistakes[name] = { ...mistake, file: name };
      }
      for (const one of cases) {
        const { number, program, seed, seconds, test: title } = one;
        if (Object.hasOwn(mistakes, program)) {
          await machine.call("trial_fail", { number, problem: mistakes[program].message });
          continue;
        }
        const source = sources[program];
        sandbox = new Sandbox(prepare(source, tree_of(source)));
        const { over } = await drive(sandbox, { table, kind: kind(), seed, title, limit: seconds, trial: number });
        sandbox.end();
        const { verdict, report } = await edu("judge", { error: over.error ? fault_at(program, over.error, say) : "" });
        const known = runs.get(key_of(one));
        if (!known || known.verdict === "passed" && verdict !== "passed") runs.set(key_of(one), { verdict, report });
      }
      const { results } = await machine.call("trials_end", { format: "json" });
      const all = Object.values(mistakes);
      return { results, report_of: one => runs.get(key_of(one))?.report, findings: all.length ? { diagnostics: all } : null };
    } finally {
      sandbox?.end();
      if (ball.foreign_run === mine) ball.foreign_run = null;
    }
  };
}
