// A visit without a robot, as calls of the engine: functions that many visits call go into the part of orb.wasm that is
// loaded at once.
import { whole_groups } from "../items.mjs";
import { welcome } from "../page/steps.js";

const attempt = deed => { try { return deed(); } catch (error) { if (error instanceof WebAssembly.RuntimeError) throw error; } };

/** Typical mistakes of a first hour. */
const slips = ["goroll 0, 300, 1\nprint x\nfor i = 1 to 3\n", "goroll 0, 80\n", "repeat 4\n  goroll 0, 80, 1\n"];

/** The requests of an editor for an open text. */
function edit(engine, files) {
  let id = 0;
  const tell = (method, params) => attempt(() => engine.call("lsp", { message: { jsonrpc: "2.0", method, params } }));
  const ask = (method, params) => attempt(() => engine.call("lsp", { message: { jsonrpc: "2.0", id: ++id, method, params } }));
  ask("initialize", { processId: null, clientInfo: { name: "visit" }, rootUri: "file:///", capabilities: {
    textDocument: { completion: { completionItem: { snippetSupport: true, documentationFormat: ["plaintext", "markdown"] } }, hover: { contentFormat: ["markdown", "plaintext"] }, publishDiagnostics: { versionSupport: true } },
  } });
  tell("initialized", {});
  engine.call("files", { files });
  for (const [name, text] of Object.entries(files).filter(([one]) => one.endsWith(".orb"))) {
    const textDocument = { uri: `file:///${name}` }, lines = text.split("\n");
    const range = { start: { line: 0, character: 0 }, end: { line: lines.length, character: 0 } };
    tell("textDocument/didOpen", { textDocument: { ...textDocument, version: 1, languageId: "", text } });
    ask("textDocument/codeAction", { textDocument, range, context: { diagnostics: [] } });
    ask("textDocument/semanticTokens/full", { textDocument });
    lines.slice(0, 25).forEach((words, line) => {
      for (const { index } of [...words.matchAll(/[\w.$&]+/g)].slice(0, 6)) ask("textDocument/hover", { textDocument, position: { line, character: index + 1 } });
      const position = { line, character: words.length };
      ask("textDocument/completion", { textDocument, position, context: { triggerKind: 1 } });
      ask("textDocument/signatureHelp", { textDocument, position });
      ask("textDocument/definition", { textDocument, position: { line, character: Math.floor(words.length / 2) } });
    });
    tell("textDocument/didChange", { textDocument: { ...textDocument, version: 2 }, contentChanges: [{ range: { start: range.start, end: range.start }, text: "\n" }] });
    tell("textDocument/didClose", { textDocument });
  }
}

/** Times as a browser's clock gives them, with any number of digits. */
const begin = 1234.4000000953674, clocked = ms => Math.max(0, begin + ms * 1.0031 - begin);
/** A run in the robot's time, with user actions. */
function play(engine, given) {
  if (!attempt(() => engine.call("live_start", { ...given, for: "0" }))) return;
  const at = ms => attempt(() => engine.call("live_advance", { ms: clocked(ms) }));
  for (let ms = .1; ms < 100; ms += ms < 2 ? .1 : 3.1) at(ms);
  ["shake", "push 90 120", "toss 500ms", "tilt 40 0", "tilt 0 0", "wall y=80", "hop"].forEach((line, i) => {
    attempt(() => engine.call("stimulus", { line }));
    at(300 + i * 300);
  });
  attempt(() => engine.call("input", { value: 7 }));
  at(4000);
  for (let ms = 4000; ms < 15_000; ms += 33) at(ms); // as the worker does
  attempt(() => engine.call("report"));
  attempt(() => engine.call("live_end"));
}

function test(engine, files, name) {
  const done = attempt(() => engine.call("test", { files, names: [name], format: "json" }));
  const [first] = done?.results?.tests ?? [];
  if (first) attempt(() => engine.call("replay", { files, names: [name], test: first.test, seed: first.cases[0]?.seed ?? 1, program: first.program }));
}

/**
 * The calls of visitors, in parts; each part takes an engine. `first`: the first program, mistakes, two lessons and
 * the start of a third; `lessons`: the others; `examples`: the structured ones, of which a visitor opens some. Editing
 * numbered programs, macros or tests, courses and robots load the rest. `site`: the folder that the page loads from.
 */
export function visits(site) {
  const test_all = (engine, files) => Object.keys(files).filter(one => one.endsWith(".test")).forEach(name => test(engine, files, name));
  const run_all = (engine, files, main, run = {}) => {
    const given = { files, ...run, names: run.names ?? [main], for: "10s" };
    attempt(() => engine.call("run", { ...given, report: true }));
    play(engine, given);
    test_all(engine, files);
  };
  const tried = ({ files, main, run, solution }) => ({
    begin(engine) {
      edit(engine, files);
      test_all(engine, files);
    },
    whole(engine) {
      for (const given of solution ? [files, { ...files, [main]: solution }] : [files]) {
        edit(engine, given);
        run_all(engine, given, main, run);
      }
    },
  });
  const [lessons, examples] = whole_groups(site).map(({ items }) => items
    .filter(({ language, files }) => language === "orb" && !Object.keys(files).some(name => name.endsWith(".svg")))
    .map(tried));
  const done = 2; // in a first visit
  return {
    first(engine) {
      engine.call("version");
      for (const text of [welcome, ...slips]) edit(engine, { "robot.orb": text });
      for (const text of [welcome, "goroll 0, 300, 1\n", "x = 0\nprint 1 / x\n", "input x\nprint x\n", "goroll 0, 90, 1\n"])
        run_all(engine, { "robot.orb": text, "robot.test": 'test "t"\n  expect print "1"\n' }, "robot.orb");
      for (const lesson of lessons.slice(0, done)) lesson.whole(engine);
      lessons[done].begin(engine);
    },
    lessons: lessons.slice(done).map(one => one.whole), examples: examples.map(one => one.whole),
  };
}
