// Finds the program orb: Windows itself would look in the folder that is open first, and that may be anybody's.

const fs = require('node:fs');
const path = require('node:path');

const here = {
  platform: process.platform,
  env: process.env,
  isFile: (file) => fs.statSync(file, { throwIfNoEntry: false })?.isFile() ?? false,
};

/// The path of the program that `orb.path` names, by its path or by a name found on PATH; undefined where it is nowhere.
function find(name, { platform, env, isFile } = here) {
  const windows = platform === 'win32';
  const { delimiter, isAbsolute, join } = windows ? path.win32 : path.posix;
  const file = windows && !/\.exe$/i.test(name) ? `${name}.exe` : name;
  if (/[/\\]/.test(name))
    return isFile(file) ? file : undefined;
  return (env.PATH || '').split(delimiter)
    .map((folder) => folder.replace(/^"(.*)"$/, '$1'))
    .filter((folder) => isAbsolute(folder))
    .map((folder) => join(folder, file))
    .find(isFile);
}

module.exports = { find };
