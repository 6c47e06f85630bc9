// orb in VS Code: the language server, the debugger, runs, and tests in the test explorer. The work is
// done by the program `orb`; each part here only starts it.

const languages = require('./languages');
const debugging = require('./debugging');
const runs = require('./runs');
const tests = require('./tests');

function activate(context) {
  debugging.activate(context);
  runs.activate(context);
  tests.activate(context);
  return languages.activate();
}

function deactivate() {
  return languages.deactivate();
}

module.exports = { activate, deactivate };
