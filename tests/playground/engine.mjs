// Compares the engine of the playground with orb: findings, traces and verdicts of all examples and lessons, and
// the bytes of uploads over bad links.
// usage: node engine.mjs ORB ROOT [FOLDER]; exits with 77 if `./dev playground` has built nothing.
import assert from "node:assert/strict";
import { execFile, spawn } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import net from "node:net";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";

const [orb_file, root, folder = join(root, "build/playground")] = process.argv.slice(2).map(path => resolve(path));
if (!existsSync(join(folder, "orb.wasm"))) {
  console.log(`skipped: ${folder} is not there; ./dev playground builds it`);
  process.exit(77);
}
const { load_engine } = await import(pathToFileURL(join(root, "build/npm/engine.js")));
const { deliver } = await import(pathToFileURL(join(root, "playground/link.js")));
// In two parts, as the page loads it.
const { instance_in_parts } = await import(pathToFileURL(join(root, "playground/split/parts.js")));
const rest = readdirSync(folder).find(name => /^orb-rest-.*\.wasm$/.test(name));
let rest_was_read = 0;
const engine = await load_engine(instance_in_parts(
  async imports => (await WebAssembly.instantiate(readFileSync(join(folder, "orb.wasm")), imports)).instance,
  () => (++rest_was_read, readFileSync(join(folder, rest)))));
const place = mkdtempSync(join(tmpdir(), "orb-playground-"));
process.setMaxListeners(100); // each ball is ended with us
process.on("exit", () => rmSync(place, { recursive: true, force: true }));

/** orb in a folder that holds just these files. */
function orb(args, files = {}) {
  const own = mkdtempSync(join(place, "run-"));
  for (const [name, text] of Object.entries(files)) writeFileSync(join(own, name), text);
  return new Promise(done => execFile(orb_file, args, { cwd: own, maxBuffer: 1 << 28 }, (error, out, err) =>
    done({ code: error ? error.code : 0, out, err })));
}
let failures = 0;
const counts = {};
function same(kind, name, ours, theirs) {
  counts[kind] = (counts[kind] ?? 0) + 1;
  try {
    assert.deepEqual(ours, theirs);
  } catch (error) {
    ++failures;
    console.error(`${kind} of ${name} differs:\n${error.message.split("\n").slice(0, 30).join("\n")}`);
  }
}
const refusal_of = call => {
  try {
    return { answer: call() };
  } catch (error) {
    return { error };
  }
};

// ---- decimals, which JavaScript reads here ----
for (const number of ["7.25", "0.1", ".5", "5.", "1e3", "1e400", "1e-400", "0e9", "-0.125", "0.30000000000000004", `0.${"3".repeat(200_000)}`, "1".repeat(200_000), "1.2.3", "e5", "x"]) {
  const files = { "a.test": `at ${number}s push 0 100\ntest "t"\n  expect near 0,${number} by ${number}cm\n`, "a.orb": `delay ${number}s\n`, "a.bas": `10 delay ${number}\n` };
  const names = Object.keys(files);
  const findings = JSON.parse((await orb(["check", "--format", "json", "--max-errors", "0", ...names], files)).out);
  same("decimals", `${number.length} digits, ${number.slice(0, 20)}`, engine.call("check", { files, names }), findings);
}

// ---- programs ----
const { whole_groups } = await import(pathToFileURL(join(root, "playground/items.mjs")));
const items = whole_groups(folder).flatMap(group => group.items).filter(({ language }) => language !== "js"); // edu.mjs has those
const solved = items.filter(item => item.solution)
  .map(item => ({ ...item, id: `${item.id} solved`, files: { ...item.files, [item.main]: item.solution } }));
const mistakes = { id: "mistakes", main: "mistakes.bas", run: {}, files: { "mistakes.bas": readFileSync(join(root, "examples/demo/mistakes.bas"), "utf8") } };

for (const { id, files, main, test, run } of [...items, ...solved, mistakes]) {
  const checked = Object.keys(files).filter(name => !name.endsWith(".stimulus"));
  const findings = JSON.parse((await orb(["check", "--format", "json", "--max-errors", "0", ...checked], files)).out);
  same("findings", id, engine.call("check", { files, names: checked }), findings);

  const names = run.names ?? [main];
  const options = ["--trace", "json", "--trace-lines", "--native", "off", ...(run.stimuli ?? []).flatMap(one => ["--stimulus", one])];
  if (run.course) options.push("--course", run.course);
  if (run.input) options.push("--input", run.input.join(","));
  if (run.seed) options.push("--seed", String(run.seed));
  if (run.for) options.push("--for", run.for);
  const native = await orb(["run", ...names, ...options], files);
  const { answer, error } = refusal_of(() => engine.call("run", { files, names, ...run, trace: "json", trace_lines: true }));
  same("trace", id, answer?.trace ?? "", native.out);
  if (error) same("refusal", id, error.code, native.code);

  if (!test) continue;
  const verdicts = JSON.parse((await orb(["test", test, "--format", "json"], files)).out);
  same("verdicts", id, engine.call("test", { files, names: [test] }).results, verdicts);
}

// ---- what is seen first drives the figure that it speaks of, and every number in it has an effect ----
{
  const { welcome } = await import(pathToFileURL(join(root, "playground/page/steps.js")));
  const trace = text => refusal_of(() => engine.call("run", { files: { "a.orb": text }, trace: "json" })).answer?.trace ?? "";
  same("figure", "as it is formatted", engine.call("format", { files: { "a.orb": welcome } }).text, welcome);
  const usual = trace(welcome);
  for (const corners of [3, 4, 5, 6]) {
    const { ending, prints } = engine.call("run", { files: { "a.orb": welcome.replace("corners = 4", `corners = ${corners}`) } });
    same("figure", `${corners} corners`, [ending.story.startsWith("stopped at 0,0 cm"), prints], [true, `${corners} corners\n`]);
  }
  for (const { 0: number, index } of welcome.matchAll(/\d+/g)) {
    const changed = `${welcome.slice(0, index)}${2 * number + 1}${welcome.slice(index + number.length)}`;
    same("number", `${number} at ${index} of the welcome program`, trace(changed) === usual, false);
  }
}

// ---- the page's own Markdown against a library for all of it ----
const Markdown = (await import(pathToFileURL(join(root, "playground/node_modules/markdown-it/dist/markdown-it.mjs")))).default;
const { markdown } = await import(pathToFileURL(join(root, "playground/page/markdown.js")));
const library = new Markdown();
for (const { id, readme } of items.filter(item => item.readme)) same("lesson", id, markdown(readme), library.render(readme));
{
  const ask = (method, params, id) => engine.call("lsp", { message: { jsonrpc: "2.0", ...id && { id }, method, params } }).messages;
  ask("initialize", { capabilities: {} }, 1);
  for (const name of ["a.bas", "a.orb", "a.macro", "a.test"]) {
    const textDocument = { uri: `file:///${name}` };
    ask("textDocument/didOpen", { textDocument: { ...textDocument, version: 1, languageId: "", text: "\n" } });
    const [{ result }] = ask("textDocument/completion", { textDocument, position: { line: 0, character: 0 } }, 2);
    for (const { label, documentation } of result.items ?? result)
      if (documentation) same("hover", label, markdown(documentation.value), library.render(documentation.value).replace(/ class="language-\w+"/g, ""));
  }
}

// ---- uploads ----
/** A link of link.js over TCP, which remembers what passed. */
async function tcp_link(port, recording) {
  const socket = net.connect(port, "127.0.0.1");
  socket.setNoDelay(true);
  await new Promise((done, failed) => socket.once("connect", done).once("error", failed));
  let bytes = [], error = null, wake = () => {};
  socket.on("data", data => (bytes.push(...data), wake()));
  const end = () => (error = { kind: "closed", message: "the other end hung up" }, wake());
  socket.on("close", end).on("error", end);
  const line = (sign, data) => recording.push(`${sign} ${[...data].map(byte => byte.toString(16).padStart(2, "0")).join(" ")}`);
  return {
    kind: "tcp",
    async write(data) {
      if (error) throw error;
      line(">", data);
      await new Promise(done => socket.write(data, done));
    },
    async read(ms) {
      if (!bytes.length && !error && ms > 0)
        await new Promise(done => {
          const timer = setTimeout(done, ms);
          wake = () => (clearTimeout(timer), done());
        });
      if (!bytes.length && error) throw error;
      const read = Uint8Array.from(bytes.splice(0));
      if (read.length) line("<", read);
      return read;
    },
    close: async () => socket.destroy(),
  };
}

/** A ball of `orb ball`, and its port. */
async function ball(...options) {
  const child = spawn(orb_file, ["ball", "--tcp", "127.0.0.1:0", ...options]);
  process.on("exit", () => child.kill());
  let said = "";
  const port = await new Promise((done, failed) => {
    const hear = data => {
      said += data;
      const found = /127\.0\.0\.1:(\d+)/.exec(said);
      if (found) done(Number(found[1]));
    };
    child.stdout.on("data", hear);
    child.stderr.on("data", hear);
    child.on("exit", () => failed(new Error(said)));
  });
  return { port, end: () => child.kill() };
}

const square = readFileSync(join(root, "examples/drawing/polygons.bas"), "utf8");
const dance = readFileSync(join(root, "examples/macros/waltz.macro"), "utf8");
const uploads = [
  { name: "a program", files: { "a.bas": square }, names: ["a.bas"], run: true },
  { name: "a program into flash", files: { "a.bas": square }, names: ["a.bas"], area: "flash" },
  { name: "a program that stops", files: { "a.bas": "10 goroll 0, 100, 1\n20 A = xpos\n30 print 5 / A\n" }, names: ["a.bas"], run: true },
  { name: "macros", files: { "a.macro": dance }, names: ["a.macro"] },
];
const faults = ["", "drop=3%,seed=7", "flip=2%,seed=3", "dup=5%,seed=5", "split,delay=1..5ms,seed=2", "cut@300"];
/** Without figures of the time, and with one word for a ball that is gone or silent: a recording only ends. */
const comparable = message => message.replace(/^orb: (error: )?/, "").replace(/, \d+ packets sent.*/s, "")
  .replace(/the other end hung up|the ball did not answer|the recording ends[^;]*/, "gone");

/** What orb itself says when it hears what this upload heard: other bytes than ours would be a mismatch. */
async function native_outcome({ files, names, area, run }, recording) {
  const { code, err } = await orb(["upload", ...names, "--port", "replay://recording", ...area ? ["--area", area] : [], ...run ? ["--run"] : []],
    { ...files, recording: recording.join("\n") + "\n" });
  const lines = err.trim().split("\n"), started = /^(orb: )?started$/.test(lines.at(-1));
  return { code, message: comparable(lines.at(started ? -2 : -1)), started };
}
const async_engine = { call: async (method, params) => engine.call(method, params) };
for (const fault of faults)
  for (const upload of uploads) {
    const served = await ball(...fault ? ["--fault", fault] : []);
    const recording = [];
    const link = await tcp_link(served.port, recording);
    const outcome = await deliver(async_engine, link, upload);
    await link.close();
    served.end();
    const native = await native_outcome(upload, recording);
    same("upload", `${upload.name}, ${fault || "a good link"}`, { code: outcome.code, message: comparable(outcome.message.replace(/; started$/, "")), started: /; started$/.test(outcome.message) }, native);
  }

same("parts", "what was loaded for uploads, once", rest_was_read, 1);

// ---- an upload that is stopped, and one without a receiver ----
{
  const served = await ball("--fault", "delay=30..30ms");
  const link = await tcp_link(served.port, []);
  const controller = new AbortController();
  const outcome = await deliver(async_engine, link, uploads[1], { signal: controller.signal, on_status: ({ stage }) => stage === "sending" && controller.abort() });
  same("cancel", "while it sends", { kind: outcome.kind, code: outcome.code }, { kind: "interrupted", code: 130 });
  same("cancel", "the truth about the ball", /^interrupted; .*flash/.test(outcome.message), true);
  await link.close();
  served.end();
}
{
  const silent = { kind: "serial", write: async () => {}, read: async () => { throw { kind: "closed", message: "the other end hung up" }; } };
  const outcome = await deliver(async_engine, silent, uploads[0]);
  same("cancel", "nobody there", outcome.code === 6 || outcome.code === 4, true);
}

console.log(Object.entries(counts).map(([kind, count]) => `${count} ${kind}`).join(", ") + (failures ? `: ${failures} differ` : ": all alike"));
process.exit(failures ? 1 : 0);
