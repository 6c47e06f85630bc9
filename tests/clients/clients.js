// Lets two independent, unmodified client libraries drive `orb ball` over TCP and a pty, one of them also over
// Bluetooth LE.
//
//   node clients.js ORB FOLDER   (FOLDER holds node_modules with sphero, sphero-pwn and node-ble)
"use strict";

const assert = require("assert");
const { execFileSync, spawn } = require("child_process");
const fs = require("fs");
const Module = require("module");
const path = require("path");
const BleAdaptor = require("./ble_adaptor.js");

const [orb, folder] = process.argv.slice(2).map((name) => path.resolve(name));

// Replaces their outdated native dependencies.
const load = Module._load;
Module._load = function (name, ...rest) {
  if (name === "serialport") return require("./serialport.js");
  if (name === "noble") return { on() {}, state: "unsupported", startScanning() {}, stopScanning() {} };
  return load.call(this, name, ...rest);
};
const client = (name) => require(require.resolve(name, { paths: [folder] }));

const sleep = (ms) => new Promise((resolve) => setTimeout(resolve, ms));

function within(ms, what, promise) {
  let timer;
  const late = new Promise((_, reject) => {
    timer = setTimeout(() => reject(new Error(`${what}: nothing within ${ms} ms`)), ms);
  });
  return Promise.race([promise, late]).finally(() => clearTimeout(timer));
}

const next = (emitter, event, ms = 3000, wanted = () => true) =>
  within(ms, event, new Promise((resolve) => {
    emitter.on(event, function listen(value) {
      if (!wanted(value)) return;
      emitter.removeListener(event, listen);
      resolve(value);
    });
  }));

// A ball that is pushed from the front twice a second.
async function serve(use) {
  const scratch = fs.mkdtempSync(path.join(folder, "run-"));
  const script = path.join(scratch, "pushes.stimulus");
  const pushes = Array.from({ length: 120 }, (_, i) => `at ${(i + 1) / 2}s push 180 120\n`);
  fs.writeFileSync(script, pushes.join(""));
  // The path of a serial port begins with /dev/ for one of the clients.
  fs.mkdirSync(path.join(scratch, "dev"));
  const link = path.join(scratch, "dev", "sphero");
  const start = async (...more) => {
    const ball = spawn(orb, ["ball", `--pty=${link}`, "--tcp", "127.0.0.1:0", ...more],
      { stdio: ["ignore", "pipe", "inherit"] });
    const text = await new Promise((resolve, reject) => {
      let lines = "";
      ball.on("exit", (code) => reject(new Error(`orb ball ended with ${code}`)));
      ball.stdout.on("data", (data) => {
        lines += data;
        if (/^tcp .*\n/m.test(lines)) resolve(lines);
      });
    });
    const [, host, port] = /^tcp (.*):(\d+)$/m.exec(text);
    const stop = async () => {
      const ended = new Promise((resolve) => ball.removeAllListeners("exit").on("exit", resolve));
      ball.kill("SIGTERM");
      assert.strictEqual(await ended, 0, "orb ball ends with 0");
    };
    return { stop, tcp: `/dev/tcp/${host}/${port}`, pty: link };
  };
  try {
    await use(start, script);
  } finally {
    fs.rmSync(scratch, { recursive: true });
  }
}

// A ball with its own Bluetooth LE.
async function serveBle(use) {
  const ball = spawn(orb, ["ball", "--bluez"], { stdio: ["ignore", "pipe", "inherit"] });
  try {
    const text = await next(ball.stdout, "data", 20000);
    const [, name, bus] = /^ble ble:\/\/(\S+) DBUS_SYSTEM_BUS_ADDRESS=(\S+)$/m.exec(text);
    process.env.DBUS_SYSTEM_BUS_ADDRESS = bus;
    const info = JSON.parse(execFileSync(orb, ["info", "--format", "json", "--port", `ble://${name}`]));
    await use(info.address.match(/../g).join(":"));
  } finally {
    ball.kill("SIGTERM");
  }
}

const program = Buffer.from('10 print "Hello from Basic"\n20 end\n\0');
const macro = Buffer.from([0x14, 0x15, 0xaa, 0x15, 0xbb, 0x00]); // flags, two markers, end

// The vendor's own library: parses one packet per read, waits 500 ms for an answer.
async function sphero(address, pushed, options = {}) {
  const ball = client("sphero")(address, options);
  await within(20000, "connect", ball.connect()); // over Bluetooth LE it looks for the ball first
  try {
    await drive(ball, pushed);
  } finally {
    await within(2000, "close", new Promise((resolve) => ball.disconnect(resolve)));
  }
}

async function drive(ball, pushed) {
  await within(1000, "ping", ball.ping());
  const version = await within(1000, "version", ball.version());
  assert.strictEqual(version.msaVer, 3);
  assert.strictEqual(version.apiMaj, 1);
  const info = await within(1000, "Bluetooth info", ball.getBluetoothInfo());
  assert.match(info.name, /^Sphero-RGB/);
  await ball.setRgbLed({ red: 1, green: 2, blue: 3, flag: 1 });
  assert.strictEqual((await ball.getRgbLed()).blue, 3);
  await ball.color("green");

  if (!pushed) {
    const odometer = next(ball, "odometer");
    await ball.streamOdometer(10);
    await odometer;
    await ball.streamOdometer(10, true);
    await sleep(200);
    let late = 0;
    ball.on("dataStreaming", () => ++late);
    await ball.roll(120, 0);
    await sleep(900);
    const place = await ball.readLocator();
    assert.ok(place.ypos >= 5, `rolled to ${JSON.stringify(place)}`);
    await ball.stop();
    assert.strictEqual(late, 0, "no sensor data after streaming was stopped");
  } else {
    const collision = next(ball, "collision", 5000);
    await ball.detectCollisions();
    const blow = await collision;
    assert.ok(blow);
  }

  await ball.eraseOrbBasicStorage(0);
  await ball.appendOrbBasicFragment(0, [...program]);
  const print = next(ball, "obPrint");
  await ball.executeOrbBasicProgram(0, 0, 10);
  assert.strictEqual(Buffer.from((await print).content).toString(), "Hello from Basic\n");

  await ball.saveTempMacro([0xff, ...macro]);
  const marker = next(ball, "macroMarkers");
  await ball.runMacro(255);
  assert.strictEqual((await marker).content[0], 0xaa);
}

// An independent library: tokenizes the stream, waits forever.
async function spheroPwn(address) {
  const { Robot, SerialChannel } = client("sphero-pwn");
  const robot = new Robot(new SerialChannel(address));
  robot.on("error", (error) => { throw error; });
  try {
    await drivePwn(robot);
  } finally {
    await within(2000, "close", robot.close());
  }
}

async function drivePwn(robot) {
  assert.strictEqual(await within(1000, "ping", robot.ping()), true);
  const versions = await within(1000, "versions", robot.getVersions());
  assert.deepStrictEqual(versions.basic, { major: 1, minor: 6 });
  assert.deepStrictEqual(versions.api, { major: 1, minor: 50 });
  assert.deepStrictEqual((await robot.getBluetoothInfo()).colors, ["red", "green", "blue"]);
  await robot.setDeviceName("pwned");
  assert.strictEqual((await robot.getBluetoothInfo()).name, "pwned");
  await robot.setDeviceName(""); // the default again
  await robot.setUserRgbLed({ red: 7, green: 8, blue: 9 });
  assert.deepStrictEqual(await robot.getUserRgbLed(), { red: 7, green: 8, blue: 9 });
  await robot.abortBasic();
  const print = next(robot, "basic");
  await robot.loadBasic("ram", '10 print "Hello from Basic"\n20 end\n');
  await robot.runBasic("ram", 10);
  assert.deepStrictEqual(await print, { message: "Hello from Basic\n" });
  await robot.resetMacros();
  const marks = [];
  robot.on("macro", (event) => marks.push(event.markerId));
  const ended = next(robot, "macro", 3000, (event) => event.markerId === 0);
  await robot.loadMacro(0xff, macro);
  await robot.runMacro(0xff);
  await ended;
  assert.deepStrictEqual(marks, [0xaa, 0xbb, 0x00]);
}

async function main() {
  let failed = 0;
    // On a busy machine two packets can arrive in one read, and the vendor's library then loses the
  // second. Try again, as its users would.
  const run = async (name, job) => {
    for (let left = 2; ; --left) {
      try {
        await job();
        console.log(`ok      ${name}`);
        return;
      } catch (error) {
        if (left > 0) {
          console.log(`again   ${name}: ${error && error.message}`);
          continue;
        }
        ++failed;
        console.log(`FAILED  ${name}: ${error && error.stack}`);
        return;
      }
    }
  };
  await serve(async (start, script) => {
    const calm = await start();
    // One ball, one client after the other: each finds a working ball.
    for (const link of ["tcp", "pty"]) {
      await run(`sphero over ${link}`, () => sphero(calm[link], false));
      await run(`sphero-pwn over ${link}`, () => spheroPwn(calm[link]));
    }
    await calm.stop();
    const pushed = await start("--stimulus", script);
    for (const link of ["tcp", "pty"])
      await run(`sphero collides over ${link}`, () => sphero(pushed[link], true));
    await pushed.stop();
  });
  const hasBle = /LE: BlueZ/.test(execFileSync(orb, ["--version", "-v"]));
  if (hasBle)
    await serveBle((address) => run("sphero over Bluetooth LE", () =>
      sphero(address, false, { adaptor: new BleAdaptor(client("node-ble"), address) })));
  process.exit(failed === 0 ? 0 : 1);
}

main();
