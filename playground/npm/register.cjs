// node --require orb-wasm/register program.js: require() and import of noble get the stand-in.
"use strict";
const module_ = require("node:module");
const { join } = require("node:path");
const { pathToFileURL } = require("node:url");

const names = ["noble", "@abandonware/noble", "@stoprocent/noble", "@stoprocent/bluetooth-hci-socket/noble", "noble-mac"];
const stand_in = join(__dirname, "noble.cjs");
// The stand-in for a name. Another thread gets this function as text, so it uses only its parameters.
const stands_for = (name, names, whole, part) =>
  names.includes(name) ? whole : names.some(one => name.startsWith(`${one}/`)) ? part : undefined;

const resolve = module_._resolveFilename;
module_._resolveFilename = function (name, ...others) {
  return stands_for(name, names, stand_in, __filename) ?? resolve.call(this, name, ...others);
};
// Another thread resolves imports.
const urls = [stand_in, __filename].map(one => JSON.stringify(pathToFileURL(one).href));
const hook = `const stands_for = ${stands_for};
export const resolve = (name, context, next) => {
  const url = stands_for(name, ${JSON.stringify(names)}, ${urls});
  return url ? { url, format: "commonjs", shortCircuit: true } : next(name, context);
};`;
module_.register?.(`data:text/javascript,${encodeURIComponent(hook)}`);

// The stand-in for a part: a class that a program may patch, and a function that returns noble whatever its bindings.
module.exports = function part() { return require(stand_in); };
