// Run by vscode_test: what the extension registers, starts and shows.

const assert = require('node:assert');
const fs = require('node:fs');
const Module = require('node:module');
const os = require('node:os');
const path = require('node:path');

const [orb, folder] = process.argv.slice(2);
const work = fs.mkdtempSync(path.join(os.tmpdir(), 'orb-vscode-'));
process.on('exit', () => fs.rmSync(work, { recursive: true, force: true }));

// ---- an editor of plain objects

class Uri {
  constructor(fsPath) { this.fsPath = fsPath; }
  toString() { return `file://${this.fsPath}`; }
  static parse(text) { return new Uri(decodeURIComponent(text.replace(/^file:\/\//, ''))); }
}
class Items extends Map {
  add(item) { this.set(item.id, item); }
  forEach(call) { [...this.values()].forEach(call); }
}
const registered = { commands: {}, factories: {}, providers: {}, profiles: [], ended: [] };
let controller;
let orbPath = orb;
const editor = {
  Uri,
  Position: class { constructor(line, character) { Object.assign(this, { line, character }); } },
  Range: class { constructor(...at) { this.at = at; } },
  Location: class { constructor(uri, at) { Object.assign(this, { uri, at }); } },
  TestMessage: class { constructor(message) { this.message = message; } },
  Task: class { constructor(definition, scope, name, source, execution, matcher) {
    Object.assign(this, { definition, scope, name, source, execution, matcher }); } },
  ProcessExecution: class { constructor(process, args) { Object.assign(this, { process, args }); } },
  DebugAdapterExecutable: class { constructor(command, args) { Object.assign(this, { command, args }); } },
  TaskScope: { Workspace: 2 },
  TaskRevealKind: { Always: 1 },
  TestRunProfileKind: { Run: 1, Debug: 2 },
  workspace: {
    getConfiguration: () => ({ get: (name) => ({ path: orbPath, target: '1.5' })[name] }),
    textDocuments: [],
    findFiles: async () => [new Uri(path.join(work, 'dice.test'))],
    fs: { readFile: async (uri) => fs.readFileSync(uri.fsPath) },
    createFileSystemWatcher: () => ({ onDidCreate() {}, onDidChange() {}, onDidDelete() {} }),
  },
  window: { activeTextEditor: undefined, showErrorMessage: (text) => { registered.error = text; } },
  commands: { registerCommand: (name, call) => { registered.commands[name] = call; return {}; } },
  tasks: { executeTask: (task) => { registered.task = task; return task; } },
  debug: {
    breakpoints: [],
    registerDebugAdapterDescriptorFactory: (type, factory) => { registered.factories[type] = factory; return {}; },
    registerDebugConfigurationProvider: (type, provider) => { registered.providers[type] = provider; return {}; },
    startDebugging: (_, configuration) => { registered.launch = configuration; return true; },
  },
  tests: {
    createTestController: (id, label) => {
      controller = {
        id, label, items: new Items(),
        createTestItem: (itemId, itemLabel, uri) => ({ id: itemId, label: itemLabel, uri, children: new Items() }),
        createRunProfile: (name, kind, run) => registered.profiles.push({ name, kind, run }),
        createTestRun: () => ({
          started() {},
          passed: (item, ms) => registered.ended.push(['passed', item.label, ms]),
          failed: (item, messages) => registered.ended.push(['failed', item.label, messages]),
          errored: (item, message) => registered.ended.push(['errored', item.label, message.message]),
          end() {},
        }),
      };
      return controller;
    },
  },
};
class LanguageClient {
  constructor(id, name, server, options) { registered.client = { id, name, server, options, stopped: false }; }
  start() { return Promise.resolve(); }
  stop() { registered.client.stopped = true; }
}
const load = Module._load;
Module._load = (name, ...rest) =>
  name === 'vscode' ? editor
    : name === 'vscode-languageclient/node' ? { LanguageClient }
      : load(name, ...rest);

// ---- what package.json promises is there

function checkManifest() {
  const manifest = JSON.parse(fs.readFileSync(path.join(folder, 'package.json')));
  const { contributes } = manifest;
  const languages = new Set(contributes.languages.map((one) => one.id));
  for (const list of ['languages', 'grammars', 'snippets'])
    for (const one of contributes[list]) {
      const file = one.path || one.configuration;
      JSON.parse(fs.readFileSync(path.join(folder, file)));
      assert(languages.has(one.language || one.id), `${list}: ${file}`);
    }
  for (const ending of ['.bas', '.orb', '.macro', '.stimulus', '.test'])
    assert(contributes.languages.some((one) => one.extensions.includes(ending)), ending);
  for (const { command } of contributes.commands)
    assert(registered.commands[command], `${command} is not registered`);
  for (const { type } of contributes.debuggers)
    assert(registered.factories[type], `${type} has no adapter`);
  for (const language of contributes.breakpoints)
    assert(languages.has(language.language));
  const matcher = contributes.problemMatchers[0].pattern;
  const found = new RegExp(matcher.regexp).exec('a.bas:3:4: error[unknown-statement]: `rgb` is not a statement');
  assert.deepStrictEqual([matcher.file, matcher.line, matcher.column, matcher.severity].map((i) => found[i]),
    ['a.bas', '3', '4', 'error']);
}

// ---- where the program is, as Windows has it and as Linux does

function checkFind() {
  const { find } = require(path.resolve(folder, 'find.js'));
  const on = (platform, PATH, files) => (name) => find(name, { platform, env: { PATH }, isFile: (file) => files.includes(file) });
  const unzipped = 'C:\\Users\\Jörg\\my robots\\orb.exe';
  const windows = on('win32', 'C:\\Windows;.;"C:\\Users\\Jörg\\my robots"', ['orb.exe', '.\\orb.exe', unzipped, 'D:\\orb\\orb.exe']);
  assert.strictEqual(windows('orb'), unzipped, 'never the one in the folder that is open');
  assert.strictEqual(windows('orb.exe'), unzipped);
  assert.strictEqual(windows('D:\\orb\\orb'), 'D:\\orb\\orb.exe');
  assert.strictEqual(windows('D:/orb/orb.exe'), undefined, 'only what is there');
  assert.strictEqual(windows('other'), undefined);
  assert.strictEqual(on('win32', undefined, [])('orb'), undefined);
  const linux = on('linux', '/usr/local/bin:bin:/usr/bin', ['bin/orb', '/usr/bin/orb', '/opt/orb']);
  assert.strictEqual(linux('orb'), '/usr/bin/orb');
  assert.strictEqual(linux('/opt/orb'), '/opt/orb');
}

async function checkMissing(extension) {
  orbPath = path.join(work, 'nowhere', 'orb');
  await extension.activate({ subscriptions: [] });
  assert.strictEqual(registered.client, undefined, 'nothing is started that is not there');
  assert(registered.error.includes(orbPath) && registered.error.includes('orb.path'), registered.error);
  orbPath = orb;
  registered.profiles.length = 0;
  delete registered.error;
}

async function checkTests() {
  const test = path.join(work, 'dice.test');
  fs.writeFileSync(path.join(work, 'dice.bas'), '10 print "side"\n');
  fs.writeFileSync(test, 'test "right"\n  expect print "side"\n\ntest "wrong"\n  expect print "top"\n');
  await controller.resolveHandler();
  const file = [...controller.items.values()][0];
  assert.deepStrictEqual([...file.children.values()].map((item) => [item.label, item.range.at[0]]),
    [['right', 0], ['wrong', 3]]);
  const token = { isCancellationRequested: false, onCancellationRequested() {} };
  const run = registered.profiles.find((one) => one.name === 'Run').run;
  await run({}, token);
  assert.deepStrictEqual(registered.ended.map(([verdict, label]) => [verdict, label]),
    [['passed', 'right'], ['failed', 'wrong']]);
  const message = registered.ended[1][2][0];
  assert(message.message.includes('expect print "top"'), message.message);
  assert.strictEqual(message.location.at.line, 4);
  registered.ended.length = 0;
  await run({ include: [[...file.children.values()][1]] }, token);
  assert.deepStrictEqual(registered.ended.map(([verdict, label]) => [verdict, label]), [['failed', 'wrong']]);
  fs.writeFileSync(test, 'test "right"\n  expect nonsense\n');
  registered.ended.length = 0;
  await run({ include: [[...file.children.values()][0]] }, token);
  assert.strictEqual(registered.ended[0][0], 'errored');
  assert(registered.ended[0][2].includes('nonsense'), registered.ended[0][2]);
}

async function main() {
  const extension = require(path.resolve(folder, 'extension.js'));
  checkFind();
  await checkMissing(extension);
  await extension.activate({ subscriptions: [] });
  checkManifest();

  const { server, options } = registered.client;
  assert.deepStrictEqual([server.run.command, server.run.args], [orb, ['lsp']]);
  assert.strictEqual(options.initializationOptions.target, '1.5');
  assert.strictEqual(options.documentSelector.length, 5);

  const adapter = registered.factories.orb.createDebugAdapterDescriptor();
  assert.deepStrictEqual([adapter.command, adapter.args], [orb, ['dap']]);
  const { resolveDebugConfiguration } = registered.providers.orb;
  assert.strictEqual(await resolveDebugConfiguration(undefined, {}), undefined);
  assert(registered.error.includes('Open a program'));
  const open = { uri: new Uri('/p/a b.bas'), languageId: 'orbbasic', isDirty: true, save() { this.isDirty = false; } };
  editor.workspace.textDocuments.push(open);
  editor.window.activeTextEditor = { document: open };
  assert.strictEqual((await resolveDebugConfiguration(undefined, {})).program, '/p/a b.bas');
  assert.strictEqual(open.isDirty, false, 'saved before it runs');

  await registered.commands['orb.run']('file:///p/a%20b.bas');
  assert.deepStrictEqual(registered.task.execution.args, ['run', '/p/a b.bas']);
  await registered.commands['orb.report']();
  assert.deepStrictEqual(registered.task.execution.args, ['run', '/p/a b.bas', '--open']);
  await registered.commands['orb.runTest']('file:///p/t.test', 'one');
  assert.deepStrictEqual(registered.task.execution.args, ['test', '/p/t.test', '--only', 'one']);
  await registered.commands['orb.debugTest']('file:///p/t.test', 'one');
  assert.deepStrictEqual([registered.launch.test, registered.launch.testName], ['/p/t.test', 'one']);

  assert.strictEqual(registered.launch.stopOnEntry, true);

  await checkTests();
  extension.deactivate();
  assert(registered.client.stopped);
}

main().catch((error) => {
  console.log(error);
  process.exit(1);
});
