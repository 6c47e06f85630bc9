// For require(): the module itself is an ES module.
const loaded = () => import("./index.js");
for (const name of ["check", "run", "test", "format", "build", "assemble", "version", "robot", "world"])
  exports[name] = async (...values) => (await loaded())[name](...values);
// For instanceof: the real class is in the module, which loads later.
exports.OrbError = class OrbError extends Error {
  static [Symbol.hasInstance](error) { return error instanceof Error && error.name === "OrbError"; }
};
