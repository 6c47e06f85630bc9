// Splits orb.wasm by what a visit calls. usage: node playground/split/split.mjs WORK EXAMPLES: of WORK/orb.wasm become
// WORK/first.wasm and WORK/rest.wasm
import { execFileSync } from "node:child_process";
import { readFileSync, writeFileSync } from "node:fs";
import { join, resolve } from "node:path";
import { visit } from "./visit.mjs";

const [work, examples] = process.argv.slice(2).map(path => resolve(path));
const features = ["--enable-exception-handling", "--enable-bulk-memory", "--enable-nontrapping-float-to-int", "--enable-sign-ext", "--enable-mutable-globals"];
const split = (...given) => execFileSync("wasm-split", [...given, ...features], { stdio: "inherit" });
const file = name => join(work, name);

split("--instrument", file("orb.wasm"), "-o", file("watched.wasm"));
const { load_engine } = await import("../../build/npm/engine.js");
let watched = null;
const engine = await load_engine(async imports => watched = (await WebAssembly.instantiate(readFileSync(file("watched.wasm")), imports)).instance);
visit(engine, examples);

// The profile is written into memory that nobody else uses.
const memory = Object.values(watched.exports).find(one => one instanceof WebAssembly.Memory);
const place = memory.buffer.byteLength;
memory.grow(64);
const size = watched.exports.__write_profile(place, memory.buffer.byteLength - place);
writeFileSync(file("visit.profile"), new Uint8Array(memory.buffer, place, size));

split("--split", file("orb.wasm"), `--profile=${file("visit.profile")}`, "--import-namespace=primary", "--placeholder-namespace=placeholder",
  "--export-prefix=%", "-o1", file("first.wasm"), "-o2", file("rest.wasm"));
