// The settings, and the file that a command is about.

const vscode = require('vscode');
const { find } = require('./find');

const programs = ['orbbasic', 'orbstructured', 'orbmacro'];

function settings() {
  const all = vscode.workspace.getConfiguration('orb');
  const name = all.get('path') || 'orb';
  const found = find(name);
  return { path: found || name, isFound: found !== undefined, target: all.get('target') || '' };
}

/// The path of what a lens or a menu gave, else of the file in front; it is saved first, because
/// `orb` reads it from the disk.
async function file(given) {
  const uri = given ? vscode.Uri.parse(String(given)) : vscode.window.activeTextEditor?.document.uri;
  if (!uri)
    return undefined;
  const open = vscode.workspace.textDocuments.find((one) => one.uri.toString() === uri.toString());
  if (open?.isDirty)
    await open.save();
  return uri.fsPath;
}

module.exports = { settings, file, programs };
