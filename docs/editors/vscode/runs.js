// Runs a program as a task, so that its output has a terminal and its findings are problems.

const vscode = require('vscode');
const { settings, file } = require('./settings');

function task(title, args) {
  const made = new vscode.Task({ type: 'process', title }, vscode.TaskScope.Workspace, title, 'orb',
    new vscode.ProcessExecution(settings().path, args), '$orb');
  made.presentationOptions = { clear: true, reveal: vscode.TaskRevealKind.Always };
  return made;
}

async function run(uri, ...more) {
  const path = await file(uri);
  return path && vscode.tasks.executeTask(task('run', ['run', path, ...more]));
}

function activate(context) {
  context.subscriptions.push(
    vscode.commands.registerCommand('orb.run', (uri) => run(uri)),
    vscode.commands.registerCommand('orb.report', (uri) => run(uri, '--open')),
    vscode.commands.registerCommand('orb.runTest', async (uri, name) => {
      const path = await file(uri);
      const args = ['test', path, ...(name ? ['--only', name] : [])];
      return path && vscode.tasks.executeTask(task('test', args));
    }),
  );
}

module.exports = { activate };
