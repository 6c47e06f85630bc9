// A stand-in for noble (@abandonware/noble and its kin): programs that look for real robots find virtual ones, in real
// time. $ORB_ROBOT (bolt), $ORB_COUNT, $ORB_SEED and $ORB_FAULT choose them.
"use strict";
const { EventEmitter } = require("node:events");

/** Milliseconds between the events of a Bluetooth LE link: the longest connection interval that Apple's rules for devices
 *  allow for data. */
const interval = 15;
const short = uuid => uuid.replaceAll("-", "").toLowerCase().replace(/^0000(.{4})00001000800000805f9b34fb$/, "$1");
const lost = () => new Error("the robot is not connected");

/** Returns the promise, or passes its result to `callback`, as older programs expect. */
function answered(promise, callback) {
  if (typeof callback !== "function") return promise;
  promise.then(value => callback(null, value), callback);
}
const wait = (value, ms = interval) => new Promise(done => setTimeout(done, ms, value));

class Characteristic extends EventEmitter {
  constructor(peripheral, [service, uuid, name, properties, value]) {
    super();
    Object.assign(this, { uuid: short(uuid), name, type: null, _serviceUuid: short(service), descriptors: [] });
    this.properties = properties.map(word => word === "write-without-response" ? "writeWithoutResponse" : word);
    this.value = Buffer.from(value);
    this.peripheral = peripheral;
    this.subscribed = false;
  }
  writeAsync(data, without_response = false) {
    const { peripheral } = this;
    if (!peripheral.up) return Promise.reject(lost());
    if (!this.properties.some(word => word.startsWith("write"))) return Promise.reject(new Error(`${this.uuid} takes no data`));
    peripheral.take(this, Uint8Array.from(data));
    return wait(undefined, without_response ? 0 : interval);
  }
  write(data, without_response, callback) { return answered(this.writeAsync(data, without_response), callback); }
  subscribeAsync() {
    if (!this.peripheral.up) return Promise.reject(lost());
    if (!this.properties.includes("notify")) return Promise.reject(new Error(`${this.uuid} does not notify`));
    this.subscribed = true;
    this.emit("notify", true);
    return wait();
  }
  subscribe(callback) { return answered(this.subscribeAsync(), callback); }
  notify(on, callback) { return on ? this.subscribe(callback) : this.unsubscribe(callback); }
  notifyAsync(on) { return on ? this.subscribeAsync() : this.unsubscribeAsync(); }
  unsubscribeAsync() { this.subscribed = false; this.emit("notify", false); return wait(); }
  unsubscribe(callback) { return answered(this.unsubscribeAsync(), callback); }
  readAsync() {
    if (!this.peripheral.up) return Promise.reject(lost());
    if (!this.properties.includes("read")) return Promise.reject(new Error(`${this.uuid} cannot be read`));
    const { robot } = this.peripheral; // some values differ from robot to robot
    const own = { "2a00": () => robot.name, "2a19": () => [robot.state().charge], "2a25": () => robot.address }[this.uuid];
    return wait(Buffer.from(own?.() ?? this.value));
  }
  read(callback) { return answered(this.readAsync(), callback); }
  discoverDescriptorsAsync() { return wait([]); }
  discoverDescriptors(callback) { return answered(this.discoverDescriptorsAsync(), callback); }
}

class Peripheral extends EventEmitter {
  constructor(robot, clock, rssi) {
    super();
    this.robot = robot;
    this.clock = clock;
    this.up = false;
    this.id = this.uuid = short(robot.address.replaceAll(":", ""));
    Object.assign(this, { address: robot.address.toLowerCase(), addressType: "random", connectable: true, rssi, mtu: null, services: null });
    this.advertisement = { localName: robot.name, serviceUuids: [], serviceData: [], txPowerLevel: undefined, manufacturerData: undefined };
    this.characteristics = robot.gatt.characteristics.map(one => new Characteristic(this, one));
    if (robot.gatt.advertised_service) this.advertisement.serviceUuids.push(short(robot.gatt.advertised_service));
    this.greeted = false;
  }
  get state() { return this.up ? "connected" : "disconnected"; }
  async connectAsync() {
    if (this.up) throw new Error("Peripheral already connected");
    this.clock.catch_up();
    this.robot.connect();
    this.up = true;
    this.beat = setInterval(() => this.listen(), interval);
    const { patience } = this.robot.gatt;
    if (patience !== null) this.impatience = setTimeout(() => { if (!this.greeted) this.fall(); }, patience * 1000);
    await wait();
    this.emit("connect");
  }
  connect(...values) { return answered(this.connectAsync(), values.at(-1)); }
  async disconnectAsync() { this.fall(); await wait(); }
  disconnect(callback) { return answered(this.disconnectAsync(), callback); }
  fall() {
    if (!this.up) return;
    this.up = false;
    clearInterval(this.beat);
    clearTimeout(this.impatience);
    this.clock.catch_up();
    this.robot.disconnect();
    this.greeted = false;
    for (const one of this.characteristics) one.subscribed = false;
    this.emit("disconnect");
  }
  /** A deaf robot takes commands only after the right word; it ignores a wrong one. */
  take(characteristic, data) {
    const { gatt } = this.robot;
    this.clock.catch_up();
    const [uuid, word] = gatt.greeting[0] ?? [""]; // the first opens it; some clients leave out the others
    if (short(uuid) === characteristic.uuid) this.greeted = data.length === word.length && data.every((byte, i) => byte === word[i]);
    else if (characteristic.uuid === short(gatt.commands_uuid) && (this.greeted || !gatt.is_deaf)) this.robot.write(data);
  }
  listen() {
    this.clock.catch_up();
    const said = this.robot.read(), { gatt } = this.robot;
    for (let at = 0; at < said.length; at += gatt.piece_bytes) {
      const piece = Buffer.from(said.subarray(at, at + gatt.piece_bytes));
      for (const one of this.characteristics)
        if (one.subscribed && one.uuid === short(gatt.answers_uuid)) { one.emit("data", piece, true); one.emit("read", piece, true); }
    }
    if (!this.robot.connected) this.fall(); // it has fallen asleep
  }
  #services() {
    const uuids = [...new Set(this.characteristics.map(one => one._serviceUuid))];
    return this.services = uuids.map(uuid => Object.assign(new EventEmitter(), {
      uuid, name: null, type: null, includedServiceUuids: [], characteristics: this.characteristics.filter(one => one._serviceUuid === uuid),
      discoverCharacteristicsAsync(wanted = []) { return wait(chosen(this.characteristics, wanted)); },
      discoverCharacteristics(wanted, callback) { return answered(this.discoverCharacteristicsAsync(wanted), callback); },
    }));
  }
  async discoverServicesAsync(wanted = []) {
    if (!this.up) throw lost();
    return wait(chosen(this.#services(), wanted));
  }
  discoverServices(wanted, callback) { return answered(this.discoverServicesAsync(wanted), callback); }
  async discoverSomeServicesAndCharacteristicsAsync(services = [], characteristics = []) {
    const found = await this.discoverServicesAsync(services);
    return { services: found, characteristics: chosen(found.flatMap(one => one.characteristics), characteristics) };
  }
  discoverSomeServicesAndCharacteristics(services, characteristics, callback) { return spread(this.discoverSomeServicesAndCharacteristicsAsync(services, characteristics), callback); }
  discoverAllServicesAndCharacteristicsAsync() { return this.discoverSomeServicesAndCharacteristicsAsync(); }
  discoverAllServicesAndCharacteristics(callback) { return spread(this.discoverAllServicesAndCharacteristicsAsync(), callback); }
  updateRssiAsync() { return wait(this.rssi); }
  updateRssi(callback) { return answered(this.updateRssiAsync(), callback); }
}
const chosen = (list, wanted) => wanted?.length ? list.filter(({ uuid }) => wanted.map(short).includes(uuid)) : list;
function spread(promise, callback) {
  if (typeof callback !== "function") return promise;
  promise.then(({ services, characteristics }) => callback(null, services, characteristics), callback);
}

/** The robots' time follows the computer's clock. */
class Clock {
  constructor(floor) { this.floor = floor; this.begun = performance.now(); this.at = 0; }
  catch_up() {
    const now = (performance.now() - this.begun) / 1000;
    this.floor.advance(Math.max(0, now - this.at));
    this.at = Math.max(this.at, now);
  }
}

class Noble extends EventEmitter {
  constructor() {
    super();
    this._state = "unknown";
    this.scanning = false;
    this.ready = this.#begin();
  }
  async #begin() {
    const { ORB_ROBOT: kind = "bolt", ORB_COUNT: count = 1, ORB_SEED: seed = 1, ORB_FAULT: fault = "" } = process.env;
    const floor = await (await import("./index.js")).world();
    this.clock = new Clock(floor);
    this.peripherals = Array.from({ length: Number(count) }, (_, i) =>
      new Peripheral(floor.add(kind, { seed: Number(seed) + i, fault, x: 40 * i }), this.clock, -48 - 7 * i));
    this._state = "poweredOn";
    this.emit("stateChange", this._state);
  }
  get state() { return this._state; }
  async waitForPoweredOnAsync() { await this.ready; }
  async waitForPoweredOn() { await this.ready; }
  async startScanningAsync(services = []) {
    await this.ready;
    this.scanning = true;
    this.waits ??= setInterval(() => {}, 1 << 30); // keeps node running while the program scans
    this.emit("scanStart");
    const wanted = (services ?? []).map(short);
    for (const one of this.peripherals)
      setTimeout(() => {
        if (this.scanning && !one.up && (!wanted.length || wanted.some(uuid => one.advertisement.serviceUuids.includes(uuid)))) this.emit("discover", one);
      }, 20);
  }
  startScanning(services, _duplicates, callback) { return answered(this.startScanningAsync(services), callback); }
  async stopScanningAsync() { this.#rest(); this.emit("scanStop"); }
  stopScanning(callback) { return answered(this.stopScanningAsync(), callback); }
  #rest() {
    this.scanning = false;
    clearInterval(this.waits);
    this.waits = undefined;
  }
  reset() {}
  stop() { this.#rest(); for (const one of this.peripherals ?? []) one.fall(); }
}
const noble = new Noble();
noble.ready.catch(error => {
  console.error(`orb: ${error.message}`);
  process.exit(2);
});
process.on("exit", () => {
  for (const { robot } of noble.peripherals ?? []) {
    noble.clock.catch_up();
    const { t, x, y, heading, way, driving } = robot.state();
    console.error(`${robot.name} (${robot.title}): at ${x.toFixed(0)}, ${y.toFixed(0)} cm, faces ${heading.toFixed(0)}°, drove ${way.toFixed(0)} cm in ${t.toFixed(1)} s${driving ? "; it was left driving" : ""}`);
  }
});
// Exit on an unhandled signal, so that the above is printed.
for (const [signal, number] of [["SIGINT", 2], ["SIGTERM", 15]])
  process.on(signal, () => { if (process.listenerCount(signal) === 1) process.exit(128 + number); });
module.exports = noble;
