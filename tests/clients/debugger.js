// Lets the unmodified test client of VS Code's debug adapters drive `orb dap`.
//
//   node debugger.js ORB FOLDER   (FOLDER holds node_modules with @vscode/debugadapter-testsupport)
"use strict";

const assert = require("assert");
const fs = require("fs");
const os = require("os");
const path = require("path");

const [orb, folder] = process.argv.slice(2).map((name) => path.resolve(name));
const support = require.resolve("@vscode/debugadapter-testsupport", { paths: [folder] });
const { DebugClient } = require(support);

const work = fs.mkdtempSync(path.join(os.tmpdir(), "orb-debugger-"));
const program = path.join(work, "hall.orb");
fs.writeFileSync(program, `turns = 4 + dshake
sub turn(by)
  turns = turns - 1
  print 12 / turns
  goroll by, 100, 1
  delay 200ms
end sub
turn(90)
turn(180)
turn(270)
print turns / dshake
`);

async function session(name, act) {
  const client = new DebugClient(orb, "dap", "orb", { shell: false });
  client.defaultTimeout = 10000;
  await client.start();
  try {
    await act(client);
    console.log(`debugger: ${name}: passed`);
  } finally {
    await client.stop();
  }
}

async function main() {
  await session("a breakpoint is hit", (client) =>
    client.hitBreakpoint({ program }, { path: program, line: 4 }));

  await session("runs to the end", async (client) => {
    const configure = async () => {
      await client.waitForEvent("initialized");
      await client.setExceptionBreakpointsRequest({ filters: [] });
      await client.configurationDoneRequest();
    };
    await Promise.all([
      configure(),
      client.launch({ program, seed: 3 }),
      client.assertOutput("stderr", "error: Divide by zero"),
      client.waitForEvent("terminated"),
    ]);
  });

  await session("forwards and backwards", async (client) => {
    await Promise.all([
      client.configurationSequence(),
      client.launch({ program, stopOnEntry: true }),
      client.assertStoppedLocation("entry", { path: program, line: 1 }),
    ]);
    const stop = (reason, line) => client.assertStoppedLocation(reason, { path: program, line });
    await Promise.all([client.stepInRequest({ threadId: 1 }), stop("step", 8)]);
    await Promise.all([client.stepInRequest({ threadId: 1 }), stop("step", 3)]);
    await Promise.all([client.stepBackRequest({ threadId: 1 }), stop("step", 8)]);
    const before = await client.evaluateRequest({ expression: "turns" });
    assert.strictEqual(before.body.result, "4");
    await client.send("setDataBreakpoints", { breakpoints: [{ dataId: "turns" }] });
    await Promise.all([client.continueRequest({ threadId: 1 }), stop("data breakpoint", 4)]);
    await client.send("setDataBreakpoints", { breakpoints: [] });
    await Promise.all([client.reverseContinueRequest({ threadId: 1 }), stop("entry", 1)]);
    const { body } = await client.scopesRequest({ frameId: 1000 });
    const names = body.scopes.map((scope) => scope.name);
    assert.deepStrictEqual(names, ["Variables", "Ball", "Sensors", "Loops and limits"]);
  });
}

main().then(
  () => fs.rmSync(work, { recursive: true }),
  (error) => {
    console.error("debugger: failed:", error);
    process.exit(1);
  });
