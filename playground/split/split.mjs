// Splits orb.wasm by what a visit calls. usage: node playground/split/split.mjs WORK LIST: of WORK/orb.wasm become
// WORK/first.wasm and WORK/rest.wasm
import { execFileSync } from "node:child_process";
import { readFileSync, writeFileSync } from "node:fs";
import { join, resolve } from "node:path";
import { visits } from "./visit.mjs";

/** What fewer lessons and fewer examples call is loaded when it is called: a sixth of the examples. */
const enough = { lessons: 6, examples: 14 };

const [work, list] = process.argv.slice(2).map(path => resolve(path));
const features = ["--enable-exception-handling", "--enable-bulk-memory", "--enable-nontrapping-float-to-int", "--enable-sign-ext", "--enable-mutable-globals"];
const binaryen = (tool, ...given) => execFileSync(tool, [...given, ...features], { stdio: "inherit" });
const file = name => join(work, name);

binaryen("wasm-split", "--instrument", file("orb.wasm"), "-o", file("watched.wasm"));
const { load_engine } = await import("../../build/npm/engine.js");
const watched = new WebAssembly.Module(readFileSync(file("watched.wasm")));

/** The profile of what a visit calls: a number for the module, then one for each function, 0 where nobody called it. */
async function profile_of(visit) {
  let instance = null;
  visit(await load_engine(async imports => instance = await WebAssembly.instantiate(watched, imports)));
  // It is written into memory that nobody else uses.
  const memory = Object.values(instance.exports).find(one => one instanceof WebAssembly.Memory);
  const place = memory.buffer.byteLength;
  memory.grow(64);
  const size = instance.exports.__write_profile(place, memory.buffer.byteLength - place);
  return new Uint32Array(memory.buffer.slice(place, place + size));
}

const { first, ...some } = visits(list);
const profile = await profile_of(first), head = 2;
for (const [kind, all] of Object.entries(some)) {
  const calls = new Uint32Array(profile.length);
  for (const visit of all) (await profile_of(visit)).forEach((time, i) => { calls[i] += time !== 0; });
  for (let i = head; i < profile.length; ++i) profile[i] ||= calls[i] >= enough[kind] ? 1 : 0;
}
writeFileSync(file("visit.profile"), new Uint8Array(profile.buffer));

binaryen("wasm-split", "--split", file("orb.wasm"), `--profile=${file("visit.profile")}`, "--import-namespace=primary", "--placeholder-namespace=placeholder",
  "--export-prefix=%", "-o1", file("first.wasm"), "-o2", file("rest.wasm"));
// Parted, both can be a little smaller.
for (const name of ["first.wasm", "rest.wasm"]) binaryen("wasm-opt", "-Oz", file(name), "-o", file(name));
