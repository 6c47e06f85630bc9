// Starts `orb lsp` when the first orbBasic program or macro is opened.

const { workspace } = require('vscode');
const { LanguageClient } = require('vscode-languageclient/node');

let client;

function activate() {
  const settings = workspace.getConfiguration('orb');
  const command = { command: settings.get('path'), args: ['lsp'] };
  client = new LanguageClient('orb', 'orb', { run: command, debug: command }, {
    documentSelector: [{ language: 'orbbasic' }, { language: 'orbstructured' }, { language: 'orbmacro' }, { language: 'orbtest' }],
    initializationOptions: { target: settings.get('target') },
  });
  return client.start();
}

function deactivate() {
  return client && client.stop();
}

module.exports = { activate, deactivate };
