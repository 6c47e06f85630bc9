// Splits orb.wasm by what a visit calls. usage: node playground/split/split.mjs WORK SITE: splits WORK/orb.wasm into
// WORK/first.wasm and WORK/rest.wasm; SITE holds the examples and lessons
import { execFileSync } from "node:child_process";
import { readFileSync, writeFileSync } from "node:fs";
import { join, resolve } from "node:path";
import { visits } from "./visit.mjs";

/** Functions that fewer later lessons or structured examples call go into the second part. */
const enough = { lessons: 6, examples: 14 };

const [work, site] = process.argv.slice(2).map(path => resolve(path));
const features = ["--enable-exception-handling", "--enable-bulk-memory", "--enable-nontrapping-float-to-int", "--enable-sign-ext", "--enable-mutable-globals"];
const binaryen = (tool, ...given) => execFileSync(tool, [...given, ...features], { stdio: "inherit" });
const file = name => join(work, name);

binaryen("wasm-split", "--instrument", file("orb.wasm"), "-o", file("watched.wasm"));
const { load_engine } = await import("../../build/npm/engine.js");
const watched = new WebAssembly.Module(readFileSync(file("watched.wasm")));

/** Calls an engine as worker.js does: asks for the parts of the messages after each answer. */
const as_in_worker = engine => ({ call(method, params) {
  try { return engine.call(method, params); } finally { engine.call("said"); }
} });

/** The profile of a visit: a number for the module, then one for each function, 0 if it was not called. */
async function profile_of(visit) {
  let instance = null;
  visit(as_in_worker(await load_engine(async imports => instance = await WebAssembly.instantiate(watched, imports))));
  // It is written to unused memory.
  const memory = Object.values(instance.exports).find(one => one instanceof WebAssembly.Memory);
  const place = memory.buffer.byteLength;
  memory.grow(64);
  const size = instance.exports.__write_profile(place, memory.buffer.byteLength - place);
  return new Uint32Array(memory.buffer.slice(place, place + size));
}

const { first, ...some } = visits(site);
const profile = await profile_of(first), head = 2;
for (const [kind, all] of Object.entries(some)) {
  const calls = new Uint32Array(profile.length);
  for (const visit of all) (await profile_of(visit)).forEach((time, i) => { calls[i] += time !== 0; });
  for (let i = head; i < profile.length; ++i) profile[i] ||= calls[i] >= enough[kind] ? 1 : 0;
}
writeFileSync(file("visit.profile"), new Uint8Array(profile.buffer));

binaryen("wasm-split", "--split", file("orb.wasm"), `--profile=${file("visit.profile")}`, "--import-namespace=primary", "--placeholder-namespace=placeholder",
  "--export-prefix=%", "-o1", file("first.wasm"), "-o2", file("rest.wasm"));
// After the split, both parts can be optimised a little more.
for (const name of ["first.wasm", "rest.wasm"]) binaryen("wasm-opt", "-Oz", file(name), "-o", file(name));
