// The test explorer: files and their tests as the language knows them, verdicts from
// `orb test --format json`.

const vscode = require('vscode');
const { execFile } = require('node:child_process');
const path = require('node:path');
const { settings } = require('./settings');
const { start } = require('./debugging');

const head = /^\s*test\s+"([^"]*)"/;

/// The tests of a file: their names and lines, from 0. A file without any is one test.
function testsOf(text) {
  const found = [];
  text.split(/\r\n|\r|\n/).forEach((line, number) => {
    const match = head.exec(line);
    if (match)
      found.push({ name: match[1], line: number });
  });
  return found;
}

/// What the JSON of `orb test` says of the tests of one file: by name, `undefined` where all seeds
/// passed, else the misses of the first seed that did not.
function verdictsOf(json) {
  const verdicts = new Map();
  for (const test of json.tests) {
    const failed = test.cases.find((one) => one.verdict !== 'passed');
    const ns = test.cases.reduce((sum, one) => sum + (one.ns || 0), 0);
    verdicts.set(test.test, { ms: ns / 1e6, failed: failed && {
      seed: failed.seed,
      problem: failed.problem,
      misses: failed.misses || [],
      again: failed.again,
    } });
  }
  return verdicts;
}

/// The runs of one file, as the JSON of `orb test`; what it says on stderr where it has none.
function orbTest(file, only, token) {
  const args = ['test', file, '--format', 'json', ...(only ? ['--only', only] : [])];
  return new Promise((resolve) => {
    const options = { cwd: path.dirname(file), maxBuffer: 1 << 28, windowsHide: true }; // no console of its own
    const child = execFile(settings().path, args, options,
      (error, stdout, stderr) => {
        try {
          resolve({ json: JSON.parse(stdout) });
        } catch {
          resolve({ problem: stderr || String(error) });
        }
      });
    token?.onCancellationRequested(() => child.kill());
  });
}

function messagesOf(item, failed) {
  const messages = failed.misses.map((miss) => {
    const text = `${miss.expected}: ${miss.seen}\n${miss.where || ''}\nseed ${failed.seed}`;
    const message = new vscode.TestMessage(failed.again ? `${text}\n${failed.again}` : text);
    message.location = new vscode.Location(item.uri, new vscode.Position(miss.line - 1, 0));
    return message;
  });
  return messages.length ? messages : [new vscode.TestMessage(failed.problem || 'not passed')];
}

class Explorer {
  constructor(controller) {
    this.controller = controller;
  }

  async find() {
    for (const uri of await vscode.workspace.findFiles('**/*.test'))
      await this.read(uri);
  }

  async read(uri, text) {
    const read = text ?? Buffer.from(await vscode.workspace.fs.readFile(uri)).toString('utf8');
    const file = this.controller.createTestItem(uri.toString(), path.basename(uri.fsPath), uri);
    for (const { name, line } of testsOf(read)) {
      const item = this.controller.createTestItem(`${uri}#${name}`, name, uri);
      item.range = new vscode.Range(line, 0, line, 0);
      file.children.add(item);
    }
    this.controller.items.add(file);
  }

  async run(request, token) {
    const run = this.controller.createTestRun(request);
    const chosen = request.include || [];
    if (!chosen.length)
      this.controller.items.forEach((item) => chosen.push(item));
    for (const item of chosen)
      if (!token.isCancellationRequested)
        await this.runItem(run, item, token);
    run.end();
  }

  async runItem(run, item, token) {
    const leaves = [];
    item.children.forEach((child) => leaves.push(child));
    const whole = leaves.length > 0;
    const items = whole ? leaves : [item];
    items.forEach((one) => run.started(one));
    const only = !whole && item.id.includes('#') ? item.label : undefined;
    const { json, problem } = await orbTest(item.uri.fsPath, only, token);
    const verdicts = json ? verdictsOf(json) : new Map();
    for (const one of items) {
      const verdict = verdicts.get(one.label) || (items.length === 1 && [...verdicts.values()][0]);
      if (!verdict)
        run.errored(one, new vscode.TestMessage(problem || 'it was not run'));
      else if (verdict.failed)
        run.failed(one, messagesOf(one, verdict.failed), verdict.ms);
      else
        run.passed(one, verdict.ms);
    }
  }
}

function activate(context) {
  const controller = vscode.tests.createTestController('orb', 'orb');
  const explorer = new Explorer(controller);
  const watcher = vscode.workspace.createFileSystemWatcher('**/*.test');
  watcher.onDidCreate((uri) => explorer.read(uri));
  watcher.onDidChange((uri) => explorer.read(uri));
  watcher.onDidDelete((uri) => controller.items.delete(uri.toString()));
  controller.resolveHandler = (item) => (item ? explorer.read(item.uri) : explorer.find());
  controller.createRunProfile('Run', vscode.TestRunProfileKind.Run,
    (request, token) => explorer.run(request, token), true);
  controller.createRunProfile('Debug', vscode.TestRunProfileKind.Debug, (request) => {
    const item = request.include?.[0];
    return item && start({ test: item.uri.fsPath, testName: item.id.includes('#') ? item.label : undefined });
  });
  context.subscriptions.push(controller, watcher);
}

module.exports = { activate, testsOf, verdictsOf };
