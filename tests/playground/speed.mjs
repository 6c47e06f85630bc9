// Measures the figures of docs/inside/performance.md, "In a browser": sizes, the interpreter loop compared with orb's,
// findings. Exits with 1 if the loop misses its goal.
// usage: node speed.mjs ORB ROOT
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { brotliCompressSync } from "node:zlib";

const [orb, root] = process.argv.slice(2).map(path => resolve(path));
const folder = join(root, "build/playground");
const begin = performance.now();
const { load_engine } = await import(pathToFileURL(join(root, "build/npm/engine.js")));
const engine = await load_engine();
console.log(`engine ready after ${(performance.now() - begin).toFixed(0)} ms`);

const packed = name => brotliCompressSync(readFileSync(join(folder, name))).length;
const files = readdirSync(folder).filter(name => /\.(js|mjs|wasm|css|html|json|svg)$/.test(name) && name !== "sw.js");
const sizes = files.map(name => [name, packed(name)]);
console.log(sizes.map(([name, size]) => `${name} ${(size / 1000).toFixed(1)}`).join(", "));
console.log(`in all ${(sizes.reduce((sum, [, size]) => sum + size, 0) / 1000).toFixed(0)} KB by brotli`);

const place = mkdtempSync(join(tmpdir(), "orb-speed-"));
process.on("exit", () => rmSync(place, { recursive: true }));
const time = work => {
  const start = performance.now();
  work();
  return performance.now() - start;
};
const kernels = { nested: "2000", collatz: "20000", calls: "300000", sort: "3000" };
const goal = 0.3;
let product = 1;
for (const [name, outer] of Object.entries(kernels)) {
  const text = readFileSync(join(root, `tests/bench/kernels/${name}.bas`), "utf8");
  const sized = times => text.replace(new RegExp(`1 to ${outer}\\b`), `1 to ${times}`);
  const best = { native: [Infinity, Infinity], wasm: [Infinity, Infinity] };
  for (let round = 0; round < 5; ++round)
    [1, outer * 5].forEach((times, which) => {
      const program = sized(times);
      writeFileSync(join(place, "a.bas"), program);
      best.native[which] = Math.min(best.native[which], time(() => execFileSync(orb, ["run", "a.bas", "--for", "0", "--native", "off"], { cwd: place, stdio: "pipe" })));
      best.wasm[which] = Math.min(best.wasm[which], time(() => engine.call("run", { files: { "a.bas": program }, for: "0" })));
    });
  const took = ([least, most]) => most - least;
  const ratio = took(best.native) / took(best.wasm);
  product *= ratio;
  console.log(`${name}: orb ${took(best.native).toFixed(0)} ms, wasm ${took(best.wasm).toFixed(0)} ms: ${ratio.toFixed(2)} of its loop`);
}
const mean = product ** (1 / Object.keys(kernels).length);
console.log(`geometric mean ${mean.toFixed(2)} (goal ${goal})`);
process.exitCode = mean < goal ? 1 : 0;

const { whole_groups } = await import(pathToFileURL(join(root, "playground/items.mjs")));
const programs = whole_groups(folder).flatMap(group => group.items).flatMap(item => Object.entries(item.files)).filter(([name]) => /\.(orb|bas)$/.test(name));
const [name, text] = programs.reduce((a, b) => b[1].length > a[1].length ? b : a);
const say = message => engine.call("lsp", { message: { jsonrpc: "2.0", ...message } });
say({ id: 1, method: "initialize", params: { capabilities: {} } });
const uri = `file:///${name}`;
say({ method: "textDocument/didOpen", params: { textDocument: { uri, languageId: "orb", version: 1, text } } });
const keystrokes = Array.from({ length: 40 }, (_, i) =>
  time(() => say({ method: "textDocument/didChange", params: { textDocument: { uri, version: i + 2 }, contentChanges: [{ text: text + " ".repeat(i % 3) }] } }))).sort((a, b) => a - b);
console.log(`findings of ${name} (${text.length} bytes) after a keystroke: median ${keystrokes[20].toFixed(1)} ms, worst ${keystrokes[39].toFixed(1)} ms`);
