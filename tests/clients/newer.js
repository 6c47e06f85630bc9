// Lets an unmodified client library drive the virtual robots with packets v2: each lights up, reports version and
// battery, drives, reports its place, and stops. A TCP link to `orb ball` replaces the radio library noble.
//
//   node newer.js ORB FOLDER   (FOLDER holds node_modules with spherov2.js)
"use strict";

const assert = require("assert");
const { execFileSync, spawn } = require("child_process");
const { EventEmitter } = require("events");
const fs = require("fs");
const net = require("net");
const path = require("path");

const [orb, folder] = process.argv.slice(2).map((name) => path.resolve(name));
const toy = (file) => require(path.join(folder, "node_modules", "spherov2.js", "dist", "toys", file));
const sleep = (ms) => new Promise((resolve) => setTimeout(resolve, ms));
console.log = () => {}; // the library prints a lot

const uuid = (begin) => `${begin}574f4f2053706865726f2121`;
const most = 20; // bytes of a piece

class Characteristic extends EventEmitter {
  constructor(id, write) {
    super();
    Object.assign(this, { uuid: id, written: write });
  }
  write(bytes, _, done) {
    this.written(bytes);
    done();
  }
  subscribe(done) {
    done();
    setImmediate(() => this.emit("notify", true));
  }
}

/** A robot as noble shows one. */
function peripheral(port) {
  const socket = net.connect(port, "127.0.0.1");
  let greeted = false;
  const packets = new Characteristic(uuid("00010002"), (bytes) => {
    assert(greeted, "a packet before the word that opens the robot");
    for (let at = 0; at < bytes.length; at += most) socket.write(bytes.subarray(at, at + most));
  });
  socket.on("data", (bytes) => packets.emit("read", bytes, true));
  const radio = (begin) => new Characteristic(uuid(begin), (bytes) => {
    greeted ||= bytes.toString() === "usetheforce...band";
  });
  return {
    services: [{ characteristics: [packets] }, { characteristics: [radio("00020005"), radio("00020002")] }],
    connect: (done) => (socket.readyState === "open" ? done() : socket.once("connect", () => done())),
    discoverAllServicesAndCharacteristics: (done) => done(),
    disconnect: (done) => socket.end(() => done()),
  };
}

async function drive(robot, Toy) {
  const ball = spawn(orb, ["ball", "--robot", robot, "--tcp", "127.0.0.1:0", "--stimulus", "at 4s push 0 200"], { stdio: ["ignore", "pipe", "inherit"] });
  try {
    const port = await new Promise((resolve) => ball.stdout.once("data", (text) => resolve(Number(/:(\d+)/.exec(text)[1]))));
    const link = peripheral(port);
    const driven = new Toy(link);
    await driven.start();
    const version = await driven.appVersion();
    assert(version.major >= 0 && version.minor >= 0);
    assert(Math.abs((await driven.batteryVoltage()) - 3.9) < 0.4, "its battery of one cell");
    await driven.setMainLedColor(0, 0, 255);
    await driven.setBackLedIntensity(255);
    if (driven.configureSensorStream) {
      let samples = 0;
      driven.on("onSensor", () => ++samples);
      await driven.configureSensorStream();
      await sleep(500);
      assert(samples > 3, `${samples} samples`);
    }
    let collisions = 0;
    if (driven.configureCollisionDetection) {
      driven.on("onCollision", () => ++collisions);
      await driven.configureCollisionDetection(40, 40, 40, 40, 10);
    }
    if (driven.setStance) await driven.setStance(1);
    await driven.roll(100, 0, []);
    await sleep(900);
    await driven.roll(0, 0, []);
    await sleep(driven.configureCollisionDetection ? 3000 : 900);
    assert(!driven.configureCollisionDetection || collisions > 0, "it was pushed and said nothing");
    await driven.destroy();
    await sleep(300);
    const where = path.join(folder, "where.bas");
    fs.writeFileSync(where, "10 print xpos,ypos\n");
    const said = execFileSync(orb, ["run", "-q", where, "--port", `tcp://127.0.0.1:${port}`, "--robot", robot, "--no-aim"], { encoding: "utf8" });
    const [x, y] = said.trim().split(/\s+/).map(Number);
    assert(Math.abs(x) <= 3 && y > 10, `${robot} is at ${said}`);
    process.stdout.write(`ok      spherov2.js drives a ${robot} for ${y} cm\n`);
  } finally {
    ball.kill();
  }
}

(async () => {
  await drive("mini", toy("sphero-mini.js").SpheroMini);
  await drive("bolt", toy("sphero-bolt.js").SpheroBolt);
  await drive("bb9e", toy("bb9e.js").BB9E);
  await drive("r2d2", toy("r2d2.js").R2D2);
  await drive("r2q5", toy("r2q5.js").R2Q5);
  process.exit(0);
})().catch((error) => {
  process.stderr.write(`${error.stack ?? error}\n`);
  process.exit(1);
});
