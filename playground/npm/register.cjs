// node --require orb-wasm/register program.js: whoever asks for noble gets the stand-in, by require() or import.
"use strict";
const module_ = require("node:module");
const { join } = require("node:path");
const { pathToFileURL } = require("node:url");

const names = ["noble", "@abandonware/noble", "@stoprocent/noble", "@stoprocent/bluetooth-hci-socket/noble", "noble-mac"];
const stand_in = join(__dirname, "noble.cjs");
// What a name stands for, by a list that another thread has as text: noble, or a part of it.
const stands_for = (name, names, whole, part) =>
  names.includes(name) ? whole : names.some(one => name.startsWith(`${one}/`)) ? part : undefined;

const resolve = module_._resolveFilename;
module_._resolveFilename = function (name, ...others) {
  return stands_for(name, names, stand_in, __filename) ?? resolve.call(this, name, ...others);
};
// Of import another thread decides.
const urls = [stand_in, __filename].map(one => JSON.stringify(pathToFileURL(one).href));
const hook = `const stands_for = ${stands_for};
export const resolve = (name, context, next) => {
  const url = stands_for(name, ${JSON.stringify(names)}, ${urls});
  return url ? { url, format: "commonjs", shortCircuit: true } : next(name, context);
};`;
module_.register?.(`data:text/javascript,${encodeURIComponent(hook)}`);

// A part: a class that may be mended and is not used, and what makes a noble with bindings of the program's own.
module.exports = function part() { return require(stand_in); };
