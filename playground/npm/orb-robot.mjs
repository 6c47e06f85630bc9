#!/usr/bin/env node
// orb-robot run program.js: runs a program for real robots, or one of Sphero Edu, with virtual robots.
// orb-robot check and test: check and test programs of Sphero Edu.
import { spawn } from "node:child_process";
import { readFileSync, writeFileSync } from "node:fs";
import { fileURLToPath } from "node:url";
import { parseArgs } from "node:util";

import { load_engine } from "./engine.js";
import { check, is_edu, lines_of, obstacle_in, run, table, text_of, words_of } from "./edu.js";
import { run_tests } from "./tests.mjs";

const usage = `usage: orb-robot run PROGRAM.js [ARGUMENTS] [--robot bolt] [--count 1] [--seed 1] [--fault drop=1%]
       orb-robot run EDU_PROGRAM.js [--robot bolt] [--report RUN.html] [--stimulus "at 2s push 90 120"] [--course FILE.svg] [--seed 1] [--limit 120]
       orb-robot check EDU_PROGRAM.js... [--robot bolt] [--format text|json]
       orb-robot test [FILE.test|FOLDER...] [--program EDU_PROGRAM.js...] [--robot bolt] [--seeds 1..20] [--only NAME] [--format text|json|junit]

Runs an unmodified program that looks for robots with noble (such as one on spherov2.js) with virtual robots, in real
time. Options stand before the program, or behind it before its own.

A program of Sphero Edu (it has a function startProgram) runs at once, in virtual time; one that does not end by itself is
ended after --limit seconds of its time. A stimulus is a line, or a file of lines. check says what is wrong with it; test
does what its tests say, as orb test does for others, and judges it.`;
const usual = { robot: { type: "string" }, seed: { type: "string" }, help: { type: "boolean", short: "h" } };
const of_noble = { count: { type: "string" }, fault: { type: "string" } };
const of_test = { program: { type: "string", multiple: true }, seeds: { type: "string" }, only: { type: "string" } };
const of_edu = { report: { type: "string" }, stimulus: { type: "string", multiple: true }, course: { type: "string" }, limit: { type: "string" }, format: { type: "string" } };

function fail(message, code = 2) {
  console.error(`orb-robot: ${message}`);
  process.exit(code);
}
let parsed;
try {
  parsed = parseArgs({ options: { ...usual, ...of_noble, ...of_edu, ...of_test }, allowPositionals: true, strict: true });
} catch ({ message }) {
  fail(`${message}; orb-robot --help shows what there is`);
}
const { values, positionals: [command, program, ...others] } = parsed;
if (values.help) {
  console.log(usage);
  process.exit(0);
}
if (command !== "test" && (command !== "run" && command !== "check" || !program)) fail("write `orb-robot run PROGRAM.js`, `orb-robot check PROGRAM.js` or `orb-robot test FILE.test`");
for (const [name, least] of [["count", 1], ["seed", 0]])
  if (values[name] !== undefined && !(Number.isInteger(Number(values[name])) && Number(values[name]) >= least))
    fail(`--${name} takes a whole number from ${least}, not ${values[name]}`);
if (values.limit !== undefined && !(Number(values.limit) > 0 && Number(values.limit) <= 36000)) fail(`--limit takes seconds from 0 to 36000, not ${values.limit}`);
const formats = command === "test" ? ["text", "json", "junit"] : ["text", "json"];
if (values.format !== undefined && !formats.includes(values.format)) fail(`--format is ${formats.slice(0, -1).join(", ")} or ${formats.at(-1)}, not ${values.format}`);
if (values.seeds !== undefined && !/^\d+(\.\.\d+)?$/.test(values.seeds)) fail(`--seeds takes seeds such as 1..20, not ${values.seeds}`);
if (command !== "test") for (const name of Object.keys(of_test)) if (values[name] !== undefined) fail(`--${name} is for orb-robot test`);

function read(name) {
  try {
    return readFileSync(name, "utf8");
  } catch ({ code }) {
    return fail(`${name} cannot be read: ${{ ENOENT: "there is no such file", EISDIR: "it is a folder", EACCES: "it is not yours to read" }[code] ?? code}`, 3);
  }
}
/** Calls the engine; wrong values end the command with a message. */
const asked = f => {
  try {
    return f();
  } catch (error) {
    if (error.name !== "OrbError") throw error;
    return fail(error.message, Number.isInteger(error.code) ? error.code : 2);
  }
};
const kind = values.robot ?? "bolt";

const bytes = (line, column) => Buffer.byteLength(line.slice(0, column - 1)) + 1;
/** Schema `orb.check/1`: columns in bytes. */
function json_of(all) {
  const diagnostics = all.flatMap(({ name, lines, findings }) => findings.map(one => ({
    file: name, line: one.line, column: bytes(lines[one.line - 1] ?? "", one.column), endLine: one.end_line, endColumn: bytes(lines[one.end_line - 1] ?? "", one.end_column),
    rule: one.rule, severity: one.severity, message: one.message, ...one.help ? { help: one.help } : {},
    ...one.fix ? { fix: { title: one.fix.title, safety: "unsafe", edits: [{ line: one.fix.line, column: 1, endLine: one.fix.line, endColumn: Buffer.byteLength(lines[one.fix.line - 1] ?? "") + 1, text: one.fix.text }] } } : {} })));
  const count = severity => diagnostics.filter(one => one.severity === severity).length;
  return { schema: "orb.check/1", diagnostics, summary: { files: all.length, errors: count("error"), warnings: count("warning"), bytes: {} } };
}
const findings_of = (name, source, robot) => ({ name, lines: lines_of(source), findings: check(source, { table, kind: robot }) });

function known_robot() {
  if (table.robots.some(one => one.name === kind)) return;
  asked(() => engine.call("robot", { kind })); // its error suggests a name
  fail(`there is no robot ${kind}`);
}

const engine = await load_engine();
if (command !== "run") {
  for (const name of Object.keys({ ...of_noble, report: 0, stimulus: 0, course: 0, limit: 0 })) if (values[name] !== undefined) fail(`--${name} is for orb-robot run`);
  if (values.robot !== undefined) known_robot();
}
if (command === "test") {
  if (values.seed !== undefined) fail("--seed is for orb-robot run; write --seeds");
  process.exit(await run_tests({ call: engine.call, kind, words: [program, ...others].filter(Boolean), programs: values.program, seeds: values.seeds, only: values.only, format: values.format, fail }));
}
if (command === "check") {
  const all = [program, ...others].map(name => {
    const source = read(name);
    if (!is_edu(source)) fail(`${name} is not a program of Sphero Edu: it has no function startProgram`, 1);
    return findings_of(name, source, values.robot ?? "");
  });
  if (values.format === "json") console.log(JSON.stringify(json_of(all), null, 2));
  else for (const one of all) for (const finding of one.findings) console.log(text_of(one.name, one.lines, finding));
  process.exit(all.some(({ findings }) => findings.some(one => one.severity === "error")) ? 1 : 0);
}

let source;
try {
  source = readFileSync(program, "utf8");
} catch { /* node will say why */ }
if (source === undefined || !is_edu(source)) {
  for (const name of Object.keys(of_edu)) if (values[name] !== undefined) fail(`--${name} is for programs of Sphero Edu; ${program} ${source === undefined ? "cannot be read" : "is none: it has no function startProgram"}`);
  const env = { ...process.env };
  for (const name of ["robot", "count", "seed", "fault"]) if (values[name] !== undefined) env[`ORB_${name.toUpperCase()}`] = values[name];
  const child = spawn(process.execPath, ["--require", fileURLToPath(new URL("./register.cjs", import.meta.url)), program, ...others], { env, stdio: "inherit" });
  for (const signal of ["SIGINT", "SIGTERM"]) process.on(signal, () => child.kill(signal));
  child.on("exit", (code, signal) => process.exit(code ?? (signal === "SIGINT" ? 130 : 1)));
} else {
  for (const name of ["format", "count"]) if (values[name] !== undefined) fail(`--${name} is not for a run of a program of Sphero Edu`);
  if (others.length) fail(`a program of Sphero Edu takes no arguments: ${others[0]}`);
  known_robot();
  process.exit(await run_edu(source));
}

/** Runs it; resolves to the exit code. */
async function run_edu(source) {
  const all = findings_of(program, source, kind);
  for (const finding of all.findings) if (finding.severity !== "info") console.error(text_of(program, all.lines, finding));
  if (obstacle_in(all.findings)) return 1;
  const seed = Number(values.seed ?? 1);
  const robot = asked(() => engine.call("robot", { kind, seed, fault: values.fault ?? "", course: values.course === undefined ? "" : read(values.course) }));
  for (const given of values.stimulus ?? [])
    for (const line of /\.stimulus$/.test(given) ? read(given).split("\n") : [given])
      if (line.trim() && !/^\s*#/.test(line)) asked(() => engine.call("robot_stimulus", { robot: robot.robot, line: line.trim() }));
  const over = await asked(() => run(source, { call: engine.call, robot: robot.robot, table, kind, seed, limit: values.limit === undefined ? undefined : Number(values.limit),
    on(what, _at, text, name, operand, value) {
      if (what === "print") console.log(text);
      else if (what === "speak") console.log(text);
      else if (what === "note") console.error(`${program}: note: ${words_of({ rule: text, holes: { name, operand, value } })}`);
    } }));
  if (values.report !== undefined) {
    const { report } = engine.call("robot_journey", { robot: robot.robot, title: program });
    const page = readFileSync(new URL("./report.html", import.meta.url), "utf8").replace("/*{run}*/", () => JSON.stringify(report).replaceAll("<", "\\u003c"));
    try {
      writeFileSync(values.report, page);
    } catch ({ code }) {
      return fail(`${values.report} cannot be written: ${code}`, 3);
    }
  }
  if (over.how === "limit") console.error(`${program}: the program was ended after ${over.now.toFixed(0)} s of its time; give it more with --limit`);
  if (over.how === "error") {
    const { line } = over.error;
    console.error(`${program}${line ? `:${line}` : ""}: ${words_of(over.error)}`);
    if (line && all.lines[line - 1] !== undefined) console.error(`  ${line} | ${all.lines[line - 1].slice(0, 200)}`);
  }
  const { x, y, heading, way } = over.state ?? engine.call("robot_state", { robot: robot.robot });
  console.error(`${robot.name} (${robot.title}): at ${x.toFixed(0)}, ${y.toFixed(0)} cm, faces ${heading.toFixed(0)}°, drove ${way.toFixed(0)} cm in ${over.now.toFixed(1)} s`);
  return over.how === "error" ? 1 : 0;
}
