// The debugger is `orb dap`. A launch without a configuration debugs the file in front.

const vscode = require('vscode');
const { settings, file, programs } = require('./settings');

const type = 'orb';

/// Fills in what a configuration leaves open.
async function resolve(folder, configuration) {
  const made = { type, request: 'launch', name: 'orb', ...configuration };
  if (!made.program && !made.test) {
    const editor = vscode.window.activeTextEditor;
    if (!editor || !programs.includes(editor.document.languageId)) {
      vscode.window.showErrorMessage('Open a program or a macro first, or name one as `program`.');
      return undefined;
    }
    made.program = await file();
  }
  return made;
}

/// Stands still before the first line where nothing else would stop it.
function start(configuration) {
  const stopOnEntry = vscode.debug.breakpoints.length === 0;
  return vscode.debug.startDebugging(undefined, { type, request: 'launch', name: 'orb', stopOnEntry, ...configuration });
}

function activate(context) {
  context.subscriptions.push(
    vscode.debug.registerDebugAdapterDescriptorFactory(type, {
      createDebugAdapterDescriptor: () => new vscode.DebugAdapterExecutable(settings().path, ['dap']),
    }),
    vscode.debug.registerDebugConfigurationProvider(type, { resolveDebugConfiguration: resolve }),
    vscode.commands.registerCommand('orb.debug', async (uri) => start({ program: await file(uri) })),
    vscode.commands.registerCommand('orb.debugTest', async (uri, name) =>
      start({ test: await file(uri), testName: name })),
  );
}

module.exports = { activate, start };
