// Starts `orb lsp` when the first program, macro, test or stimulus script is opened.

const { window, workspace } = require('vscode');
const { LanguageClient } = require('vscode-languageclient/node');
const { settings, programs } = require('./settings');

let client;

function activate() {
  const { path, isFound, target } = settings();
  if (!isFound) {
    window.showErrorMessage(`There is no program \`${path}\`: install orb, then name it in the setting orb.path.`);
    return undefined; // nobody waits for the message to be closed
  }
  const command = { command: path, args: ['lsp'] };
  client = new LanguageClient('orb', 'orb', { run: command, debug: command }, {
    documentSelector: [...programs, 'orbtest', 'orbstimulus'].map((language) => ({ language })),
    initializationOptions: { target },
    synchronize: { fileEvents: workspace.createFileSystemWatcher('**/*.{orb,bas,macro,svg}') },
  });
  return client.start();
}

function deactivate() {
  return client?.stop();
}

module.exports = { activate, deactivate };
