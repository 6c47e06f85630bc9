// Tests Sphero Edu programs in node: findings, and runs on virtual robots.
// usage: node edu.mjs ROOT; exits with 77 if `./dev playground` has built nothing.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { existsSync, mkdirSync, mkdtempSync, readFileSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";

const root = resolve(process.argv[2] ?? "."), folder = join(root, "build/npm");
if (!existsSync(join(folder, "edu.js")) || !existsSync(join(folder, "orb.wasm"))) {
  console.log(`skipped: ${folder} is not there; ./dev playground builds it`);
  process.exit(77);
}
const from = name => import(pathToFileURL(join(folder, name)).href);
const [{ load_engine }, { check, is_edu, run, table, test }] = [await from("engine.js"), await from("edu.js")];
const engine = await load_engine();
const place = mkdtempSync(join(tmpdir(), "orb-edu-"));
process.on("exit", () => rmSync(place, { recursive: true, force: true }));

// ---- what is found: a program, then `line:column rule`, and a piece of the help ----
const found = (source, kind = "bolt") => check(source, { table, kind });
const in_start = body => `async function startProgram() {\n${body}\n}\n`;
const cases = [
  [in_start("await roll(0, 100, 2);")],
  [in_start("for (let i = 0; i < 4; i++) { await roll(i * 90, 60, 1); }\nawait speak('done');\nspeak('done', false);")],
  [in_start("setSpeed(100);\nawait delay(2);")],
  ["async function onCollision() { stopRoll(); await delay(0.5); setSpeed(90); }\nregisterEvent(EventType.onCollision, onCollision);\n" + in_start("setSpeed(100);")],
  [in_start("count = 1;\nsetHeading(450 + count);\nif (typeof Missing === 'undefined') { await roll(-90, -255, 0); }")],
  [in_start("const sides = { red: 1 };\nconst { red } = sides;\nawait roll(red, 255, sides.red);")],
  [in_start("drawMatrixLine({ r: 255, g: 0, b: 0 }, { x: 0, y: 0 }, { x: 7, y: 7 });\nawait Sound.Game.Coin.play(true);\nawait roll(1, 1, 1);")],
  // Names.
  [in_start("await rol(0, 100, 2);"), "2:7 unknown-function", "`await roll(0, 100, 2);`"],
  [in_start("await Stop();"), "2:7 unknown-function", "`await stopRoll();`"],
  [in_start("setmainled({ r: 1, g: 2, b: 3 });\nsetSpeed(1);\nawait delay(1);"), "2:1 unknown-function", "`setMainLed({ r: 1, g: 2, b: 3 });`"],
  [in_start("await roll(headnig, 1, 1);\nvar heading = 1;"), "2:12 unknown-name", "`await roll(heading, 1, 1);`"],
  ["registerEvent(EventType.onColision, f);\nfunction f() {}\n" + in_start("await roll(0, 9, 9);"), "1:25 unknown-member", "onCollision"],
  [in_start("await roll(getLocation().z, 9, 9);"), "2:26 unknown-member", "`x`, `y`"],
  [in_start("await roll(0, 9, 9);\nstopRoll;"), "3:1 not-called", "`stopRoll();`"],
  // Values.
  [in_start("await roll(0, 300, 2);"), "2:15 out-of-range", "`await roll(0, 255, 2);`"],
  [in_start("await roll(0, -256, 2);"), "2:15 out-of-range", "`await roll(0, -255, 2);`"],
  [in_start("await roll(0, 100);"), "2:7 missing-value", "await roll(90, 200, 2);"],
  [in_start("await roll(0, 100, 2, 4);"), "2:23 extra-value"],
  [in_start("setMainLed(255, 0, 0);\nawait roll(1, 2, 3);"), "2:12 wrong-value", "`setMainLed({ r: 255, g: 0, b: 0 });`"],
  [in_start("setMainLed({ red: 255, g: 0, b: 0 });\nawait roll(1, 2, 3);"), "2:14 unknown-part", "`setMainLed({ r: 255, g: 0, b: 0 });`"],
  [in_start("setMainLed({ r: 255, g: 0 });\nawait roll(1, 2, 3);"), "2:12 missing-part"],
  [in_start("setMainLed({ r: 256, g: 0, b: 0 });\nawait roll(1, 2, 3);"), "2:17 out-of-range", "r: 255"],
  [in_start("await roll(0, 'fast', 2);"), "2:15 wrong-value"],
  [in_start("drawMatrixPixel({ r: 1, g: 1, b: 1 }, { x: 8, y: 0 });\nawait roll(1, 2, 3);"), "2:44 out-of-range", "x: 7"],
  // Time.
  [in_start("roll(0, 100, 2);"), "2:1 missing-await", "`await roll(0, 100, 2);`"],
  [in_start("move();") + "async function move() { await roll(0, 100, 2); }", "2:1 missing-await", "`await move();`"],
  [in_start("while (getDistance() < 50) { setSpeed(50); }"), "2:1 no-time-passes", "delay(0.025)"],
  [in_start("while (true) { setSpeed(50); }"), "2:1 no-time-passes"],
  [in_start("await delay(1);\nsetSpeed(100);"), "3:1 ends-at-once", "delay(2)"],
  [in_start("setMainLed({ r: 1, g: 1, b: 1 });"), "1:1 never-drives"],
  ["async function startProgam() { await roll(1, 2, 3); }\n", "1:16 no-start", "startProgram"],
  [in_start("await roll(1, 2, 3);") + in_start("await roll(1, 2, 4);"), "4:1 second-start"],
  // Robots.
  [in_start("setMatrixCharacter('a', { r: 1, g: 1, b: 1 });\nawait roll(1, 2, 3);"), "2:1 robot-lacks", "Sphero BOLT", "mini"],
  ["registerEvent(EventType.onCollision, f);\nfunction f() {}\n" + in_start("await roll(0, 9, 9);"), "1:25 robot-lacks", "Sphero Mini", "rvr"],
  // What is no JavaScript.
  [in_start("setMainLed({ r: 255, g: 0, b: 0 );"), "2:33 syntax", "`setMainLed({ r: 255, g: 0, b: 0 });`"],
  [in_start("setMainLed({ r: 255, g: 0 b: 0 });"), "2:26 syntax", "`setMainLed({ r: 255, g: 0, b: 0 });`"],
  [in_start("await roll(0, 100 2);"), "2:18 syntax", "`await roll(0, 100, 2);`"],
  [in_start("await roll(0, 100, 2));"), "2:22 syntax", "`await roll(0, 100, 2);`"],
  [in_start("await speak(“hi”, true);"), "2:13 syntax", "`await speak(\"hi\", true);`"],
  [in_start("await speak('hi, true);"), "2:16 syntax", "`await speak('hi', true);`"],
  ["function startProgram() {\nawait roll(0, 100, 2);\n}\n", "2:7 syntax", "`async function startProgram() {`"],
  ["async function startProgram()\nsetSpeed(100);\n}\n", "1:29 syntax", "`async function startProgram() {`"],
  ["async function startProgram() {\nsetSpeed(100);\n\nfunction f() {\n}\n", "2:14 syntax", "`}` below"],
  [in_start("await roll(0, 100, 2);\n}"), "4:1 syntax", "leave this line out"],
  ["let x = 1;\nlet x = 2;\n" + in_start("await roll(x, 1, 1);"), "2:5 syntax", "`x = 2;`"],
  [in_start("<<<<<<< HEAD\nawait roll(0, 1, 2);\n=======\nawait roll(0, 1, 3);\n>>>>>>> other"), "2:1 syntax"],
];
for (const [source, place, help, kind] of cases) {
  const all = found(source, kind), told = all.map(one => `${one.line}:${one.column} ${one.rule}`);
  if (place === undefined) assert.deepEqual(told, [], source);
  else {
    assert.ok(told.includes(place), `${source}\nis to have ${place}, not ${told}`);
    if (help) assert.ok(all.find(one => place === `${one.line}:${one.column} ${one.rule}`).help.includes(help), `${source}\n${JSON.stringify(all)}`);
    if (all.some(one => one.rule === "syntax")) assert.equal(all.length, 1);
  }
}
// A fix equals the help, and corrects the program.
const lines = in_start("await rol(0, 100, 2);").split("\n"), [{ fix }] = found(lines.join("\n"));
lines[fix.line - 1] = fix.text;
assert.deepEqual(found(lines.join("\n")), []);
// Without a robot, robots are not checked.
assert.deepEqual(check(in_start("setMatrixCharacter('a', { r: 1, g: 1, b: 1 });\nawait roll(1, 2, 3);"), { table }), []);
assert.equal(check("roll(", { table, say: text => text.toUpperCase() })[0].message, "`{SIGN}` IS MISSING HERE");

// ---- whatever comes, it ends ----
let chance = 7;
const any = number => (chance = (chance * 1103515245 + 12345) % 2147483648) % number;
const seed_text = in_start("for (let i = 0; i < 4; i++) { setMainLed({ r: i, g: 0, b: 0 }); await roll(i * 90, 60, 1); }");
for (let round = 0; round < 150; ++round) {
  const at = any(seed_text.length), sign = "(){}[];,'\"`\\/=+-*<>0a \n\u2028"[any(24)];
  for (const one of check(any(2) ? seed_text.slice(0, at) + seed_text.slice(at + 1 + any(9)) : seed_text.slice(0, at) + sign + seed_text.slice(at), { table, kind: "bolt" })) assert.ok(one.message && one.line >= 1 && one.column >= 1, JSON.stringify(one));
}
for (const odd of ["", "\0", "\ufeff", "x".repeat(2_000_000), "(".repeat(100_000), "{".repeat(20_000), "[".repeat(5000) + "]".repeat(5000), "`${".repeat(1000), "startProgram", "async function startProgram() { setMainLed({ ...a, [b]: 1 }); roll(...c); }"]) {
  const begun = Date.now();
  assert.ok(found(odd).length > 0);
  assert.ok(Date.now() - begun < 120_000);
}

// ---- which programs are such ----
assert.ok(is_edu("async function startProgram() {}"));
assert.ok(is_edu("setSpeed(10); stopRoll();"));
assert.ok(!is_edu("const noble = require('noble'); startProgram();"));
assert.ok(!is_edu("import { startProgram } from './x.js';"));
assert.ok(!is_edu("// startProgram\nroll(1);"));

// ---- runs ----
async function drive(source, { kind = "bolt", stimuli = [], limit, course = "" } = {}) {
  const { robot } = engine.call("robot", { kind, seed: 1, course }), prints = [], told = [];
  for (const line of stimuli) engine.call("robot_stimulus", { robot, line });
  const over = await run(source, { call: engine.call, robot, table, kind, seed: 1, limit, on: (what, at, ...values) => (what === "print" ? prints : told).push(what === "print" ? values[0] : [what, ...values]) });
  const end = engine.call("robot_state", { robot });
  engine.call("robot_end", { robot });
  return { ...over, prints, told, end };
}
const near = (value, expected, by) => assert.ok(Math.abs(value - expected) <= by, `${value} is not ${expected} ± ${by}`);

{ // A roll drives, and stops at its end; time is the program's own.
  const begun = Date.now(), ran = await drive(in_start("await roll(90, 100, 2);\nprint(getElapsedTime(), getSpeed(), getHeading());\nawait delay(30);\nprint(getSpeed() + ' ' + Math.round(getVelocity().x));"));
  assert.equal(ran.how, "done");
  assert.deepEqual(ran.prints, ["2 0 90", "0 0"]);
  near(ran.now, 32, 0.01);
  near(ran.state.y, 0, 8);
  assert.ok(ran.state.x > 100 && ran.state.x < 260, String(ran.state.x));
  assert.ok(Date.now() - begun < 20_000);
  assert.equal(ran.stopped, true);
}
{ // Backward, and what was set is what is told; a value beyond its range is the greatest.
  const ran = await drive(in_start("setHeading(-90);\nsetSpeed(-999);\nprint(getHeading(), getSpeed());\nawait delay(1);\nstopRoll();\nawait delay(1);"));
  assert.deepEqual(ran.prints, ["270 -255"]);
  assert.ok(ran.state.x > 50, String(ran.state.x));
}
{ // A handler runs, then the main program goes on where it was.
  const ran = await drive(`registerEvent(EventType.onCollision, async () => { print("hit"); await delay(5); print("handled", getElapsedTime() > 5); });\n${in_start('print("a");\nsetSpeed(100);\nawait delay(3);\nprint("b");\nexitProgram();')}`, { stimuli: ["wall y=40"] });
  assert.equal(ran.how, "done");
  assert.deepEqual(ran.prints.slice(0, 2), ["a", "hit"]);
  assert.equal(ran.prints[2], "handled true");
  assert.equal(ran.prints.at(-1), "b");
  assert.ok(ran.state.y < 40);
}
{ // With an event it goes on for ever, politely.
  const ran = await drive(`registerEvent(EventType.onFreefall, () => print("falls"));\nregisterEvent(EventType.onLanding, () => print("lands"));\n${in_start("setMainLed({ r: 1, g: 2, b: 3 });")}`, { stimuli: ["at 2s toss 800ms"], limit: 10 });
  assert.equal(ran.how, "limit");
  near(ran.now, 10, 0.1);
  assert.deepEqual(ran.prints, ["falls", "lands"]);
  assert.deepEqual(ran.state.rgb, [1, 2, 3]);
}
{ // Conditions: a number that is reached, once.
  const ran = await drive(`registerEventCondition(EventType.onTotalDistance, far => { print("far", far >= 30, far < 60); stopRoll(); }, 30);\n${in_start("setSpeed(60);\nawait delay(6);\nexitProgram();")}`);
  assert.deepEqual(ran.prints, ["far true true"]);
  assert.ok(ran.state.y < 80);
}
{ // Loops that await wait 25 ms at least; others are ended on their line.
  const polled = await drive(in_start("let n = 0;\nsetSpeed(80);\nwhile (getDistance() < 50) { await setSpeed(80); n++; }\nprint(n > 10 && n < 400, getDistance() >= 50);"));
  assert.deepEqual(polled.prints, ["true true"]);
  for (const [body, line] of [["\nwhile (true) { setSpeed(1); }", 3], ["\n\nfor (;;);", 4], ["const f = async () => { await null; await f(); };\nawait f();", 2], ["try { for (;;); } catch { }\nfor (;;) { try { for (;;); } catch { } }", 2]]) {
    const ran = await drive(in_start(body));
    assert.equal(ran.how, "error");
    if (body.includes("await f()") && ran.error.rule === "memory") continue; // a busy machine counts too slowly
    assert.equal(ran.error.rule, "endless-loop", body);
    assert.equal(ran.error.line, line, body);
  }
}
{ // A fault names its line, wherever it happens.
  for (const [source, line, text] of [[in_start("await delay(1);\nnothing();"), 3, "nothing is not defined"], ["nothing();\n" + in_start(""), 1, "nothing"], [in_start("later();\nawait delay(2);") + "async function later() {\nawait delay(1);\nthrow new Error('late');\n}", 7, "late"],
    ["registerEvent(EventType.onCollision, () => { null.x; });\n" + in_start("await roll(0, 200, 4);"), 1, "null"], [in_start("throw 7;"), 2, "7"]]) {
    const ran = await drive(source, { stimuli: ["wall y=30"] });
    assert.equal(ran.how, "error", source);
    assert.equal(ran.error.rule, "exception");
    assert.equal(ran.error.line, line, source);
    assert.ok(ran.error.holes.text.includes(text), ran.error.holes.text);
    assert.equal(ran.stopped, true);
  }
}
{ // Lights and the matrix.
  const ran = await drive(in_start("setMainLed({ r: 10, g: 20, b: 30 });\nawait delay(1);\nclearMatrix();\ndrawMatrixPixel({ r: 255, g: 0, b: 0 }, { x: 0, y: 0 });\ndrawMatrixPixel({ r: 0, g: 255, b: 0 }, { x: 7, y: 7 });\nawait delay(1);\nprint(getMainLed().g);"));
  assert.deepEqual(ran.prints, ["20"]);
  assert.deepEqual(ran.state.matrix[0], [255, 0, 0]);
  assert.deepEqual(ran.state.matrix[63], [0, 255, 0]);
  const picture = await drive(in_start("playMatrixAnimation(0, false);\nawait delay(3);") + "registerMatrixAnimation({ frames: [[[1, 0, 0, 0, 0, 0, 0, 0], [], [], [], [], [], [], [0, 0, 0, 0, 0, 0, 0, 2]]], palette: [{ r: 0, g: 0, b: 0 }, { r: 9, g: 0, b: 0 }, { r: 0, g: 0, b: 8 }], fps: 5, transition: MatrixAnimationTransition.None });");
  assert.deepEqual(picture.state.matrix[56], [9, 0, 0], "the first row of a frame is the highest");
  assert.deepEqual(picture.state.matrix[7], [0, 0, 8]);
  const back = await drive(in_start("setBackLed(200);\nawait delay(1);"), { kind: "mini" });
  assert.equal(back.state.back_led, 200);
  const strobe = await drive(in_start("await fade({ r: 0, g: 0, b: 0 }, { r: 200, g: 100, b: 0 }, 2);\nprint(getElapsedTime().toFixed(1), getMainLed().r);\nawait strobe({ r: 1, g: 1, b: 1 }, 0.5, 2);\nprint(getElapsedTime().toFixed(1));"));
  assert.deepEqual(strobe.prints, ["2.0 200", "4.0"]);
}
{ // Turning, raw motors, aiming, distance; chance is the seed's.
  const turned = await drive(in_start("await spin(180, 2);\nprint(getHeading(), getElapsedTime().toFixed(1));\nawait delay(1);\nprint(Math.round(Math.abs(getOrientation().yaw) / 10));\nresetAim();\nprint(getHeading());\nawait roll(0, 80, 1);"));
  assert.deepEqual(turned.prints, ["180 2.0", "18", "0"]);
  assert.ok(turned.state.y < -20, String(turned.state.y));
  const far = await drive(in_start("await driveToDistance(0, 100, 100);\nawait delay(2);\nprint(Math.abs(getDistance() - 100) < 15);"), { kind: "rvr" });
  assert.deepEqual(far.prints, ["true"]);
  const raw = await drive(in_start("await rawMotor(120, 120, 1);\nprint(getRawMotor().left);\nawait delay(3);\nawait roll(0, 60, 1);"));
  assert.deepEqual(raw.prints, ["0"]);
  const dice = in_start("const a = []; for (let i = 0; i < 50; i++) a.push(getRandomInt(1, 6)); print(Math.min(...a), Math.max(...a), a.join('')); print(Math.random()); const { r, g, b } = getRandomColor(); print([r, g, b].every(one => one >= 0 && one <= 255));");
  const first = await drive(dice), again = await drive(dice);
  assert.match(first.prints[0], /^1 6 /);
  assert.deepEqual(first.prints, again.prints);
}
{ // What is heard and said.
  const ran = await drive(in_start("await speak('one', true);\nspeak('two', false);\nawait Sound.Game.Coin.play(true);\nSound.Effects.Bell.play();\nawait speak(7);\nprint(buildString('a', 1, true), toDegrees(Math.PI));\nawait roll('x', 10, 0);"));
  assert.deepEqual(ran.told, [["speak", "one", true], ["speak", "two", false], ["sound", "Game.Coin", true], ["sound", "Effects.Bell", false], ["speak", "7", false], ["note", "not-a-number", "roll", "heading", '"x"']]);
  assert.deepEqual(ran.prints, ["a1true 180"]);
  assert.ok(ran.now > 1.5 && ran.now < 5);
}
for (const kind of ["bolt+", "mini", "rvr", "sprk+", "ollie", "r2d2", "bb9e"]) {
  const ran = await drive(in_start("setMainLed({ r: 0, g: 200, b: 0 });\nsetBackLed(100);\nawait roll(0, 120, 3);\nprint(getConnectedRobotType());"), { kind });
  assert.equal(ran.how, "done", kind);
  assert.deepEqual(ran.prints, [kind]);
  assert.ok(ran.state.y > 30, `${kind}: ${ran.state.y}`);
  assert.equal(ran.state.rgb[1], 200, kind);
}

// ---- a program of a stranger comes to nothing but itself ----
for (const body of ["process.exit(3)", "require('fs')", "postMessage('x')", "fetch('http://localhost/')", "new WebAssembly.Memory({ initial: 1 })", "new SharedArrayBuffer(8)", "new ArrayBuffer(8)", "eval('1')", "Function('return 1')()", "setTimeout.constructor('return process')()", "globalThis.constructor.constructor('return process')()", "await (async () => {}).constructor('return 1')()", "await import('node:fs')"])
  assert.equal((await drive(in_start(body))).how, "error", body);
{
  const ran = await drive(in_start(`try { await import("node:fs"); } catch (error) { print(error instanceof Error, error.constructor === Error); }
    print(typeof process, typeof require, typeof module, typeof Worker, typeof fetch, typeof Buffer);
    Object.prototype.did = 1; Promise.prototype.then = null; JSON.stringify = () => "{}";
    Error.prepareStackTrace = (_, sites) => sites.map(site => { try { return String(site.getFunction()) + site.getThis(); } catch (error) { return error.message; } }).join();
    print(new Error().stack.includes(["parent", "Port"].join("")));`));
  assert.equal(ran.prints[0], "true true");
  assert.equal(ran.prints[1], Array(6).fill("undefined").join(" "));
  assert.ok(!ran.prints.includes("true"), String(ran.prints));
}
for (const body of ["const all = []; for (;;) all.push(new Array(100000).fill(all.length));", "let s = 'x'; for (;;) s += s;", "const f = () => [f(), f()]; f();", "print('x'.repeat(1e6)); for (let i = 0; i < 5000; i++) print('x'.repeat(900));", "for (let i = 0; i < 9999; i++) drawMatrixPixel({ r: i, g: 1, b: 1 }, { x: 1, y: 1 });", "for (let i = 0; i < 40; i++) setTimeout(() => setTimeout(() => {}, 1), i);"]) {
  const begun = Date.now(), ran = await drive(in_start(body), { limit: 10 });
  assert.ok(["error", "done", "limit"].includes(ran.how), body);
  assert.ok(ran.prints.join("").length < 400_000 && Date.now() - begun < 120_000, body);
}

// ---- the command ----
const orb_robot = (...values) => spawnSync("node", [join(folder, "orb-robot.mjs"), ...values], { cwd: place, encoding: "utf8" });
writeFileSync(join(place, "square.js"), in_start("for (let side = 0; side < 4; side++) await roll(90 * side, 60, 1);\nconsole.log('home');"));
writeFileSync(join(place, "wrong.js"), in_start("\tsetMainLed({ r: 1, g: 2, b: 3 });\n\tawait roll(0, 900, 1);\n\tawait rol(0, 1, 1);"));
writeFileSync(join(place, "broken.js"), "async function startProgram() {\n  await roll(0, 100 2);\n}\n");
writeFileSync(join(place, "ball.stimulus"), "# a push\nat 1s push 90 120\n");
{
  const ran = orb_robot("run", "square.js", "--robot", "mini", "--seed", "5", "--report", "r.html", "--stimulus", "ball.stimulus", "--stimulus", "wall x=90");
  assert.equal(ran.status, 0, ran.stderr);
  assert.equal(ran.stdout, "home\n");
  assert.match(ran.stderr, /^SM-0005 \(Sphero Mini\): at -?\d+, -?\d+ cm, faces \d+°, drove \d+ cm in 4\.0 s\n$/);
  const page = readFileSync(join(place, "r.html"), "utf8"), [, data] = /<script type="application\/json" id="run">([^]*?)<\/script>/.exec(page);
  assert.equal(JSON.parse(data).title, "square.js");
  assert.ok(!page.includes("/*{"));
}
{
  const checked = orb_robot("check", "wrong.js");
  assert.equal(checked.status, 1);
  assert.equal(checked.stdout, "wrong.js:3:16: warning[out-of-range]: `speed` is -255 to 255, not 900\n  3 |  await roll(0, 900, 1);\n    |                ^~~\n  help: write `await roll(0, 255, 1);`\n" +
    "wrong.js:4:8: error[unknown-function]: there is no function `rol`\n  4 |  await rol(0, 1, 1);\n    |        ^~~\n  help: write `await roll(0, 1, 1);`\n");
  const { schema, diagnostics, summary } = JSON.parse(orb_robot("check", "--format", "json", "square.js", "wrong.js").stdout);
  assert.equal(schema, "orb.check/1");
  assert.deepEqual([summary.files, summary.errors, summary.warnings], [2, 1, 1]);
  assert.deepEqual([diagnostics[1].file, diagnostics[1].line, diagnostics[1].fix.edits[0].text], ["wrong.js", 4, "\tawait roll(0, 1, 1);"]);
  assert.equal(orb_robot("check", "square.js").status, 0);
  const ran = orb_robot("run", "wrong.js");
  assert.equal(ran.status, 1);
  assert.match(ran.stderr, /wrong\.js:4: the program stopped: ReferenceError: rol is not defined\n/);
  const broken = orb_robot("run", "broken.js");
  assert.equal(broken.status, 1);
  assert.match(broken.stderr, /^broken\.js:2:20: error\[syntax\]: `,` is missing here\n/);
}
for (const [status, words, ...values] of [[2, /did you mean `bolt`/, "run", "square.js", "--robot", "blot"], [2, /did you mean `bolt`/, "check", "square.js", "--robot", "blot"], [2, /did you mean `push`/, "run", "square.js", "--stimulus", "at 1s pus"],
  [2, /--limit takes seconds/, "run", "square.js", "--limit", "never"], [2, /--count/, "run", "square.js", "--count", "2"], [2, /--report is for orb-robot run/, "check", "square.js", "--report", "x"], [2, /takes no arguments/, "run", "square.js", "more"],
  [2, /text or json/, "check", "square.js", "--format", "xml"], [3, /there is no such file/, "check", "nothing.js"], [3, /there is no such file/, "run", "square.js", "--course", "nothing.svg"], [3, /cannot be written/, "run", "square.js", "--report", "no/r.html"], [2, /write `orb-robot run/, "walk", "square.js"],
  [0, /the program was ended after 1 s of its time/, "run", "square.js", "--limit", "1"]]) {
  const { status: is, stderr } = orb_robot(...values);
  assert.equal(is, status, `${values}: ${stderr}`);
  assert.match(stderr, words, String(values));
}
// ---- tests: a program, a test, and what comes of it: nothing where it passes, else a piece of what was seen ----
async function judged(source, text, { kind, more = {}, ...others } = {}) {
  const { results } = await test({ files: { "a.test": text, "a.js": source, ...more }, names: ["a.test"], ...others }, { call: engine.call, kind });
  return results.tests;
}
const misses = tests => tests.flatMap(({ cases }) => cases.flatMap(one => one.problem ?? one.misses?.map(({ seen }) => seen) ?? []));
const square = in_start("for (let side = 0; side < 4; side++) { await roll(90 * side, 100, 1.2); await delay(0.5); }\nprint('home');\nsetMainLed({ r: 0, g: 255, b: 0 });");
const course = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 300 300"><circle class="start" cx="100" cy="200" r="4"/><rect class="zone" id="goal" x="80" y="80" width="40" height="40"/></svg>';
const verdicts = [
  [square, 'expect near 0,90 by 15cm before near 90,90 by 15cm\nexpect near 0,0 by 15cm and resting at end\nexpect distance 3m..4m\nexpect print "home" after near 90,0 by 15cm\nexpect color green at end\nexpect end within 8s\nnever collision'],
  [square.replaceAll("90 *", "80 *"), "expect near 0,0 by 15cm and resting at end", " cm from 0,0, resting at the end, "],
  [square.replace("1.2", "0.9"), "expect distance 3m..4m", "it drove 2"],
  [square, "expect near 0,200 by 10cm", /^nearest \d+\.\d cm from 0,200 at \d\.\d+ s$/],
  [square.replace("g: 255", "g: 0"), "expect color green at end", "off at the end, "],
  [square, 'expect print "Home"', /^nearest "home" at 6\.8\d* s$/],
  [square, 'expect print "home" at 1s', undefined, 2], // as for any program
  [square, "wall y=60\nexpect collision within 2s\nnever beyond y>60"],
  [square, "wall y=60\nnever collision", "it ran into the wall y=60 at "],
  [in_start("await delay(4);"), "at 2s push 90 200\nnever moving during 0s..1900ms\nexpect moving within 2500ms\nexpect beyond x>5 at end"],
  [in_start("await delay(4);"), "expect moving within 2500ms", "nearest resting at 0 s"],
  [in_start("for (;;) { setSpeed(60); await delay(1); }"), "for 3s\nexpect moving at end\nexpect speed 5..200cm/s at 2s"],
  [in_start("for (;;) { setSpeed(60); await delay(1); }"), "for 3s\nexpect end within 3s", "it was still running at 3 s"],
  [in_start("await delay(1);\nnothing();"), "expect moving", /^nearest resting at 0 s$|^a\.js:3: the program stopped: ReferenceError: nothing is not defined at 1 s$/],
  [in_start("await delay(1);\nnothing();"), "expect error within 2s\nexpect end within 2s"],
  [in_start("for (;;);"), "never moving", /^a\.js:2: no time passes in this loop, so the program was ended at 0 s$/],
  [in_start("await roll(0, 100 2);"), "never moving", "a.js:2:18: error[syntax]: `,` is missing here\n"],
  ["print(1);", "never moving", "error[no-start]"],
  [in_start("print(1);\nprint('2\\n3');\nspeak('four');"), 'expect prints\n  "1"\n  "2"\n  "3"\n  "four"'],
  [in_start("await roll(0, 100, 1.4);"), "course a.svg\nreach goal\nexpect inside goal and resting at end", undefined, 0, { more: { "a.svg": course } }],
  [in_start("await roll(180, 100, 1.4);"), "course a.svg\nreach goal", "cm from goal", 0, { more: { "a.svg": course } }],
  [in_start("setBackLed(200);\nawait delay(1);"), "expect backled 200..200 at end", undefined, 0, { kind: "mini" }],
  [in_start("print(getConnectedRobotType());"), 'expect print "rvr"', undefined, 0, { kind: "rvr" }],
  [in_start("await roll(90, 255, 1);\nstopRoll();"), "expect heading 90 by 5 at end\nexpect resting at end\nexpect moving at 1200ms"],
];
for (const [source, text, seen, code, more] of verdicts) {
  if (code) {
    await assert.rejects(judged(source, text, more), one => one.code === code && one.findings.diagnostics.length > 0, text);
    continue;
  }
  const told = misses(await judged(source, text, more));
  if (seen === undefined) assert.deepEqual(told, [], text);
  else assert.ok(told.length > 0 && told.every(one => seen instanceof RegExp ? seen.test(one) : one.includes(seen)), `${text}: ${told}`);
}
{ // The same seed, the same run; another one, another.
  const dice = in_start("print(getRandomInt(1, 1000));"), seen = async seeds => misses(await judged(dice, `seeds ${seeds}\nexpect print "0"`));
  const [first, second] = await seen("1..2");
  assert.notEqual(first, second);
  assert.deepEqual(await seen("2"), [second]);
  assert.equal((await judged(dice, "seeds 1..30\nexpect print /^\\d+$/"))[0].cases.length, 30);
}
{ // Programs of both kinds; what orbBasic alone has is a finding, and of programs that were handed in a miss.
  const both = await test({ files: { "a.test": 'test "one"\n  expect print "hello"\n  expect lines < 9\n', "a.js": in_start("print('hello');"), "b.bas": '10 print "hello"\n' }, names: ["a.test"], programs: ["a.js", "b.bas"] }, { call: engine.call });
  assert.deepEqual(both.results.tests.map(({ cases: [one] }) => one.verdict), ["failed", "passed"]);
  assert.match(both.text, /`lines` does not apply to a\.js, which is JavaScript/);
  await assert.rejects(judged(square, "target 1.5\nexpect lines < 9"), ({ code, findings }) => code === 2 && findings.diagnostics.filter(({ rule }) => rule === "test-javascript").length === 2);
  assert.match((await test({ files: { "a.test": "expect moving", "a.js": square }, names: ["a.test"], format: "junit" }, { call: engine.call })).text, /^<\?xml/);
  assert.match(misses(engine.call("test", { files: { "a.test": "expect moving", "a.js": square } }).results.tests)[0], /npx orb-robot test/);
}
{ // The lessons: who has finished passes, who begins does not, and neither does who has something wrong.
  const lessons = join(root, "examples/lessons"), twins = readdirSync(lessons).filter(name => existsSync(join(lessons, name, "edu"))), spoilt = {
    "01-traffic-light": [["b: 0 });\n  await delay(1)", "b: 255 });\n  await delay(1)"], ["delay(2)", "delay(1)"]], "02-one-metre": [["1.3", "1.1"], ["roll(0", "roll(30"], ["1.3", "3"]], "03-square": [["1.2", "0.8"], ["* 90", "* 100"], ["side < 4", "side < 3"]] };
  assert.deepEqual(twins, Object.keys(spoilt));
  for (const name of twins) {
    const text = readFileSync(join(lessons, name, "robot.test"), "utf8"), read = file => readFileSync(join(lessons, name, "edu", file), "utf8"), solution = read("solution.js");
    const passes = async source => misses(await judged(source, text)).length === 0;
    assert.ok(await passes(solution), name);
    assert.ok(!await passes(read("robot.js")), name);
    for (const [right, wrong] of spoilt[name]) {
      assert.ok(solution.includes(right), `${name}: ${right}`);
      assert.ok(!await passes(solution.replace(right, wrong)), `${name}: ${wrong}`);
    }
  }
}
{ // The command.
  const write = (name, text) => writeFileSync(join(place, name), text);
  mkdirSync(join(place, "tests/node_modules/x"), { recursive: true });
  write("home.js", square);
  write("home.test", 'test "comes home" points 2\n  expect near 0,0 by 15cm and resting at end\ntest "is quick"\n  expect end within 5s\n');
  write("tests/other.test", "program ../home.js\nexpect print \"home\"\n");
  write("tests/node_modules/x/not.test", "nonsense");
  const ran = orb_robot("test", "home.test");
  assert.equal(ran.status, 1, ran.stderr);
  assert.match(ran.stdout, /^ok {4}home\.test:1: comes home\nFAIL {2}home\.test:3: is quick\n {2}home\.test:4: expect end within 5s\n {4}seen: {2}it ended at 6\.8\d* s\n {4}rerun: npx orb-robot run home\.js --report home\.html\n1 of 2 tests passed, 2 of 3 points\n$/);
  assert.match(orb_robot("test", "home.test", "--robot", "mini").stdout, /--report home\.html --robot mini\n/);
  const all = orb_robot("test", "tests");
  assert.equal(all.status, 0, all.stdout + all.stderr);
  assert.match(all.stdout, /1 test passed|1 of 1 test passed/);
  assert.deepEqual(JSON.parse(orb_robot("test", "home.test", "--only", "comes home", "--seeds", "1..2", "--format", "json").stdout).summary.passed, 1);
  assert.equal(orb_robot("test", "tests/other.test", "--program", "home.js", "square.js").status, 0);
  write("wrong.test", "program home.js\nexpect prnt \"home\"\n");
  const wrong = orb_robot("test", "wrong.test");
  assert.equal(wrong.status, 2);
  assert.match(wrong.stderr, /^wrong\.test:2:8: error\[test-word\]: unknown expectation `prnt`\n {2}2 \| expect prnt "home"\n {4}\| {8}\^~~~\n {2}help: /);
  for (const [status, words, ...values] of [[2, /name its test/, "home.js"], [3, /cannot be read/, "nothing.test"], [2, /no test is called/, "home.test", "--only", "comes hme"], [2, /--seeds takes seeds/, "home.test", "--seeds", "x"], [2, /text, json or junit/, "home.test", "--format", "xml"],
    [2, /did you mean `bolt`/, "home.test", "--robot", "blot"], [2, /write --seeds/, "home.test", "--seed", "1"], [2, /--limit is for orb-robot run/, "home.test", "--limit", "4"]]) {
    const { status: is, stderr } = orb_robot("test", ...values);
    assert.equal(is, status, `${values}: ${stderr}`);
    assert.match(stderr, words, String(values));
  }
  assert.equal(orb_robot("run", "square.js", "--only", "x").status, 2);
}
console.log(`Edu programs: ${cases.length} cases of findings, runs on 8 robots and orb-robot work`);
process.exit(0);
