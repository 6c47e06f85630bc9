// Checks and runs Sphero Edu programs in node, on virtual robots; `orb-robot` is the command.
import table from "edu.json";
import { check, obstacle_in, tree_of } from "./check.js";
import { Host, is_print, usual_limit } from "./host.js";
import { prepare } from "./prepare.js";
import { run_in_worker } from "./sandbox.js";
import { fault_at, words_of } from "./texts.js";
import { lines_of, text_of } from "./told.js";

export { check, lines_of, obstacle_in, table, text_of, words_of };

/** True if a text is a Sphero Edu program: it imports nothing, and has startProgram or calls two functions of the API. */
export function is_edu(source) {
  const text = source.slice(0, 200_000).replace(/\/\*[^]*?\*\/|\/\/.*/g, "");
  if (/\brequire\s*\(|^\s*import\b|\bimport\s*\(/m.test(text)) return false;
  if (/\bstartProgram\b/.test(text)) return true;
  const names = new Set(Array.from(text.matchAll(/\b([a-z]\w*)\s*\(/g), ([, name]) => name));
  return table.functions.filter(row => names.has(row.name)).length >= 2;
}

/** Runs a program on the virtual robot number `robot` of the engine, which `call` calls. Resolves to {how, error?, now,
 *  stopped, state}: how it ended, the program's time in seconds, and the robot's last state. */
export async function run(source, { call, robot, table, kind, seed, limit = usual_limit, on, pace }) {
  const host = new Host({ call, robot, table, limit, on });
  let prepared;
  try {
    prepared = prepare(source, tree_of(source));
  } catch (error) { // what does not parse never reaches the sandbox
    return { how: "error", error: { rule: "exception", line: error.loc?.line ?? 0, column: 1, holes: { text: `SyntaxError: ${error.message}` } }, now: 0, stopped: true, state: null };
  }
  await run_in_worker(host, host.begin({ source: prepared, table, kind, seed }), pace);
  return { ...host.over, now: host.now, state: host.final };
}

/** Tests programs: JavaScript on a virtual robot `kind`, others in the engine. Request and result are those of the engine's
 *  `test`, with a `format`. */
export async function test(request, { call, kind = "bolt" }) {
  const { cases, sources } = call("trials_start", request), problems = {};
  for (const [name, source] of Object.entries(sources)) {
    const obstacle = obstacle_in(check(source, { table, kind }));
    if (obstacle) problems[name] = `${text_of(name, lines_of(source), obstacle)}\n`;
  }
  for (const { number, program, seed, seconds } of cases) {
    if (Object.hasOwn(problems, program)) {
      call("trial_fail", { number, problem: problems[program] });
      continue;
    }
    const { robot } = call("trial_robot", { number, kind });
    const on = (what, _, text) => { if (is_print(what)) call("trial_print", { robot, text: `${text}\n` }); };
    const { how, error, now } = await run(sources[program], { call, robot, table, kind, seed, limit: seconds, on });
    call("trial_judge", { robot, how, seconds: now, error: error ? fault_at(program, error) : "" });
    call("robot_end", { robot });
  }
  return call("trials_end", { format: request.format });
}
