// The package orb-wasm as installed: its contents, and a program that uses it.
import assert from "node:assert/strict";
import { execFileSync, spawn, spawnSync } from "node:child_process";
import { once } from "node:events";
import { existsSync, mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";

const root = resolve(process.argv[2] ?? ".");
const folder = join(root, "build/npm");
if (!existsSync(join(folder, "orb.wasm")) || spawnSync("npm", ["--version"]).status !== 0) {
  console.log(`skipped: ${folder} is not there; ./dev playground builds it`);
  process.exit(77);
}
const place = mkdtempSync(join(tmpdir(), "orb-npm-"));
process.on("exit", () => rmSync(place, { recursive: true, force: true }));

const [packed] = JSON.parse(execFileSync("npm", ["pack", folder, "--json", "--pack-destination", place], { encoding: "utf8", stdio: ["ignore", "pipe", "ignore"] }));
assert.deepEqual(packed.files.map(file => file.path).sort(),
  ["LICENSE", "LICENSES.txt", "README.md", "edu.js", "engine.js", "error.js", "index.cjs", "index.d.cts", "index.d.ts", "index.js", "noble.cjs", "orb-robot.mjs", "orb.mjs", "orb.wasm", "package.json", "register.cjs", "report.html", "robot.js", "tests.mjs"]);

const modules = join(place, "node_modules/orb-wasm");
mkdirSync(modules, { recursive: true });
execFileSync("tar", ["xf", join(place, packed.filename), "-C", modules, "--strip-components=1"]);
writeFileSync(join(place, "use.mjs"), `
  import assert from "node:assert/strict";
  import { assemble, build, check, format, robot, run, test, version, world, OrbError } from "orb-wasm";
  assert.match(await version(), /^\\d+\\.\\d+\\.\\d+$/);
  const ran = await run("print 6 * 7", { trace: "json" });
  assert.equal(ran.prints, "42\\n");
  assert.equal(ran.ending.reason, "end");
  assert.match(ran.trace, /"event":"print","text":"42\\\\n"/);
  const { diagnostics } = await check({ "a.bas": "10 rgb 255,0,0" });
  assert.equal(diagnostics[0].rule, "unknown-statement");
  await assert.rejects(run({ "a.orb": "prnt 1" }), error => error instanceof OrbError && error.code === 1 && error.findings.diagnostics.length === 1);
  const [macro] = await assemble({ "a.macro": "rgb 255 0 0\\nend" });
  assert.deepEqual([...macro.sphero], [7, 255, 0, 0, 0, 0]);
  assert.equal(await format({ "a.orb": "if 1=1 then\\nprint 1\\nend if" }), "if 1 = 1 then\\n  print 1\\nend if\\n");
  assert.equal(new TextDecoder().decode(await build({ "a.bas": "10 end" })), "10 end\\n\\0");
  const { results } = await test({ "a.test": 'test "prints"\\n  expect print "7"', "a.orb": "print 7" });
  assert.equal(results.tests[0].cases[0].verdict, "passed");

  const bolt = await robot("bolt");
  assert.equal(bolt.name, "SB-0001");
  assert.equal(bolt.address, "68:86:E7:00:00:01");
  bolt.connect();
  const packet = (did, cid, ...data) => {
    const inner = [0x0a, did, cid, 1, ...data], sum = inner.reduce((a, b) => a + b, 0);
    return [0x8d, ...inner, ~sum & 255, 0xd8];
  };
  bolt.write(packet(0x13, 0x0d));
  assert.equal(bolt.read()[0], 0x8d);
  bolt.write(packet(0x16, 0x07, 80, 0, 0, 0)); // drive ahead
  bolt.advance(1);
  const fork = bolt.fork();
  bolt.advance(1);
  assert.ok(fork.state().y > 10 && bolt.state().y > fork.state().y);
  fork.advance(1);
  assert.equal(fork.state().y, bolt.state().y);
  assert.match(bolt.journey().svg, /^<svg/);
  bolt.stimulus("push 90 200");
  bolt.reset();
  assert.equal(bolt.now, 0);
  bolt.close();
  assert.throws(() => bolt.state(), error => error instanceof OrbError && /closed/.test(error.message));
  await assert.rejects(robot("blot"), /did you mean \`bolt\`/);
  const says = (act, sentence) => assert.rejects(async () => act(await robot()), error => error instanceof TypeError && error.message === sentence);
  await says(one => one.advance("1"), '\`seconds\` is a number, not "1"');
  await says(one => one.advance(NaN), "\`seconds\` is a number, not NaN");
  await says(one => one.stimulus(5), "\`line\` is a text, not 5");
  for (const wrong of ["abc", null, [256], [1.5]])
    await says(one => one.write(wrong), "\`bytes\` is a Uint8Array or a list of numbers from 0 to 255, not " + (typeof wrong === "string" ? JSON.stringify(wrong) : String(wrong)));
  await says(() => robot(5), "\`kind\` is a text, not 5");
  await says(() => robot("bolt", { seed: -1 }), "\`seed\` is a whole number from 0 on, not -1");
  await says(() => robot("bolt", { x: "a" }), '\`x\` is a number, not "a"');
  await says(async () => (await world()).add("bolt", { fault: 5 }), "\`fault\` is a text, not 5");
  const buffered = await robot();
  buffered.connect();
  buffered.write(new Uint8Array(packet(0x13, 0x0d)).buffer);
  assert.equal(buffered.read()[0], 0x8d);
  const floor = await world();
  const red = floor.add("bolt", { name: "red" }), blue = floor.add("mini", { name: "blue", x: 0, y: 50 });
  red.connect();
  red.write(packet(0x13, 0x0d));
  red.write(packet(0x16, 0x07, 120, 0, 0, 0));
  floor.advance(2);
  assert.ok(red.state().bumps > 0 && blue.state().y > 50);
`);
writeFileSync(join(place, "use.cjs"), `
  const { robot, check, run, OrbError } = require("orb-wasm");
  run("pritn 1").catch(error => { if (!(error instanceof OrbError) || new Error() instanceof OrbError) throw new Error("another error"); });
  robot("mini").then(mini => { mini.advance(1); if (mini.now !== 1) throw new Error("no time has passed"); });
  check("pritn 1").then(({ diagnostics }) => { if (!diagnostics.length) throw new Error("nothing was found"); });
`);
// A program for a real Mini, which looks for it with noble.
writeFileSync(join(place, "drive.cjs"), `
  const noble = require("@abandonware/noble");
  // spherov2.js mends what is inside of noble; others make one with bindings of their own.
  require("@abandonware/noble/lib/hci-socket/gatt").prototype.notify = () => {};
  if (require("@stoprocent/noble/with-bindings")({}) !== noble) throw new Error("another noble");
  const packet = (did, cid, ...data) => {
    const inner = [0x0a, did, cid, 1, ...data], sum = inner.reduce((a, b) => a + b, 0);
    return Buffer.from([0x8d, ...inner, ~sum & 255, 0xd8]);
  };
  noble.on("stateChange", state => { if (state === "poweredOn") noble.startScanning([], false); });
  noble.on("discover", async mini => {
    await noble.stopScanningAsync();
    console.log(mini.advertisement.localName);
    await mini.connectAsync();
    const { characteristics } = await mini.discoverAllServicesAndCharacteristicsAsync();
    const of = uuid => characteristics.find(one => one.uuid === uuid.replaceAll("-", ""));
    const commands = of("00010002-574f-4f20-5370-6865726f2121");
    commands.on("data", data => console.log(data.toString("hex")));
    await commands.subscribeAsync();
    console.log((await of("2a19").readAsync())[0]);
    await commands.writeAsync(packet(0x13, 0x0d), true); // it obeys before the greeting, for ten seconds
    await of("00020005-574f-4f20-5370-6865726f2121").writeAsync(Buffer.from("usetheforce...band"), false);
    await commands.writeAsync(packet(0x13, 0x0d), true);
    await commands.writeAsync(packet(0x16, 0x07, 100, 0, 90, 0), true);
    await new Promise(done => setTimeout(done, 700));
    await commands.writeAsync(packet(0x16, 0x07, 0, 0, 90, 0), true);
    await new Promise(done => setTimeout(done, 700));
    await mini.disconnectAsync();
  });
`);
const drive = spawnSync("node", [join(modules, "orb-robot.mjs"), "run", "drive.cjs", "--robot", "mini", "--seed", "5"], { cwd: place, encoding: "utf8" });
assert.equal(drive.status, 0, drive.stderr);
assert.match(drive.stdout, /^SM-0005\n70\n8d09130d01/);
assert.equal(drive.stdout.match(/130d01/g).length, 2);
assert.match(drive.stderr, /^SM-0005 \(Sphero Mini\): at \d+, -?\d cm, faces 90°, drove \d+ cm in \d\.\d s\n$/);
const wrong = spawnSync("node", [join(modules, "orb-robot.mjs"), "run", "drive.cjs", "--robot", "blot"], { cwd: place, encoding: "utf8" });
assert.equal(wrong.status, 2);
assert.match(wrong.stderr, /did you mean `bolt`/);
// Ctrl-C ends a program without an end, and the last line is said all the same.
writeFileSync(join(place, "endless.cjs"), `require("noble"); setInterval(() => console.log("ready"), 200);`);
const endless = spawn("node", [join(modules, "orb-robot.mjs"), "run", "endless.cjs"], { cwd: place });
let said = "";
endless.stderr.on("data", data => said += data);
endless.stdout.once("data", () => endless.kill("SIGINT"));
const [code] = await once(endless, "close");
assert.equal(code, 130);
assert.match(said, /^SB-0001 \(Sphero BOLT\): at 0, 0 cm/);
for (const use of ["use.mjs", "use.cjs"]) execFileSync("node", [use], { cwd: place, stdio: "inherit" });
console.log(`orb-wasm: ${packed.files.length} files, ${(packed.size / 1000).toFixed(0)} KB packed; check, run, test, format, build and assemble work`);
