// A Bluetooth LE link for the vendor's library. Its own adaptor uses noble, which needs the radio for itself; this one
// uses node-ble, which asks BlueZ over D-Bus.
"use strict";

const EventEmitter = require("events");

const uuid = (short) => `22bb746f-${short}-7554-2d6f-726568705327`;
const greeting = [["2bbd", "011i3"], ["2bb2", "\x07"], ["2bbf", "\x01"]];
const most = 20; // bytes of a piece

module.exports = class BleAdaptor extends EventEmitter {
  constructor(nodeBle, address) {
    super();
    Object.assign(this, nodeBle.createBluetooth());
    this.address = address;
    this.written = Promise.resolve();
  }

  open(done) {
    this.connect().then(() => done(), done);
  }

  async connect() {
    const adapter = await this.bluetooth.defaultAdapter();
    await adapter.startDiscovery();
    this.device = await adapter.waitDevice(this.address);
    await this.device.connect();
    const server = await this.device.gatt();
    const radio = await server.getPrimaryService(uuid("2bb0"));
    for (const [short, word] of greeting) {
      const characteristic = await radio.getCharacteristic(uuid(short));
      await characteristic.writeValue(Buffer.from(word, "latin1"), { type: "request" });
    }
    const robot = await server.getPrimaryService(uuid("2ba0"));
    this.commands = await robot.getCharacteristic(uuid("2ba1"));
    this.answers = await robot.getCharacteristic(uuid("2ba6"));
    this.answers.on("valuechanged", (bytes) => this.hear(bytes));
    await this.answers.startNotifications();
  }

  onRead(hear) {
    this.hear = hear;
  }

  write(packet, done = () => {}) {
    const bytes = Buffer.from(packet);
    this.written = this.written.then(async () => {
      for (let at = 0; at < bytes.length; at += most)
        await this.commands.writeValue(bytes.subarray(at, at + most), { type: "request" });
    });
    this.written.then(() => done(), done);
  }

  close(done) {
    const end = async () => {
      await this.answers.stopNotifications();
      await this.device.disconnect();
      this.destroy();
    };
    end().then(() => done(), done);
  }
};
