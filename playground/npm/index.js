import { load_engine } from "./engine.js";
import { OrbError } from "./error.js";
import { Robot, World, checked } from "./robot.js";

export { OrbError, Robot, World };

let engine = null;
const loaded = () => engine ??= load_engine();
const call = async (method, params) => (await loaded()).call(method, params);

/** A single program becomes a file. */
const given = (files, options) => ({ ...options, files: typeof files === "string" ? { "program.orb": files } : files });

export const check = (files, options) => call("check", given(files, options));
export const run = (files, options) => call("run", given(files, options));
/** JavaScript programs run in a worker thread. */
export const test = async (files, options) => {
  const asked = given(files, options);
  return Object.keys(asked.files).some(name => /\.js$/i.test(name)) ? (await import("./edu.js")).test(asked, await loaded()) : call("test", asked);
};
export const format = async (files, options) => (await call("format", given(files, options))).text;
export const build = async (files, options) => (await call("build", given(files, options))).bytes;
export const assemble = async (files, options) => (await call("assemble", given(files, options))).macros;
export const version = async () => (await call("version", {})).version;

/** A virtual robot, alone on its floor. */
export const robot = async (kind = "bolt", options = {}) => {
  const { call } = await loaded();
  return new Robot(call, call("robot", checked({ ...options, kind })));
};
/** An empty floor for several. */
export const world = async (options = {}) => {
  const { call } = await loaded();
  return new World(call, call("world", checked(options)));
};
