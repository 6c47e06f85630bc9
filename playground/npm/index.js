import { load_engine } from "./engine.js";
import { OrbError } from "./error.js";

export { OrbError };

let engine = null;
const call = async (method, params) => (await (engine ??= load_engine())).call(method, params);

/** One program is a file of its own. */
const given = (files, options) => ({ ...options, files: typeof files === "string" ? { "program.orb": files } : files });

export const check = (files, options) => call("check", given(files, options));
export const run = (files, options) => call("run", given(files, options));
export const test = (files, options) => call("test", given(files, options));
export const format = async (files, options) => (await call("format", given(files, options))).text;
export const build = async (files, options) => (await call("build", given(files, options))).bytes;
export const assemble = async (files, options) => (await call("assemble", given(files, options))).macros;
export const version = async () => (await call("version", {})).version;
