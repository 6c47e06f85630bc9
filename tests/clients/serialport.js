// Replaces the old native `serialport` package for unmodified clients: the part of its
// interface that they use, over a pty (/dev/pts/4, a symlink …) or TCP (/dev/tcp/HOST/PORT).
"use strict";

const { EventEmitter } = require("events");
const fs = require("fs");
const net = require("net");
const tty = require("tty");

const TCP = /^\/dev\/tcp\/([^/]+)\/(\d+)$/;

class SerialPort extends EventEmitter {
  // `open` defaults to opening at once, as serialport 2 did.
  constructor(path, options, open = true) {
    super();
    this.path = path;
    if (open !== false) setImmediate(() => this.open());
  }

  open(callback) {
    const opened = (error) => {
      if (callback) callback(error);
      this.emit("open", error);
    };
    const tcp = TCP.exec(this.path);
    if (tcp) {
      this.stream = net.connect({ host: tcp[1], port: Number(tcp[2]), noDelay: true }, () => opened());
      this.output = this.stream;
    } else {
      const flags = fs.constants.O_RDWR | fs.constants.O_NOCTTY | fs.constants.O_NONBLOCK;
      const fd = fs.openSync(this.path, flags);
      this.stream = new tty.ReadStream(fd);
      this.stream.setRawMode(true);
      this.output = new tty.WriteStream(fs.openSync(this.path, flags));
      setImmediate(() => opened());
    }
    this.stream.on("data", (data) => this.emit("data", data));
    this.stream.on("error", (error) => this.emit("error", error));
    this.stream.on("close", () => this.emit("close"));
  }

  write(data, callback) {
    this.output.write(Buffer.from(data), callback);
  }

  drain(callback) {
    if (callback) callback();
  }

  flush(callback) {
    if (callback) callback();
  }

  close(callback) {
    if (callback) this.stream.once("close", () => callback());
    if (this.output !== this.stream) this.output.destroy();
    this.stream.destroy();
  }
}

module.exports = {
  SerialPort,
  parsers: { raw: (emitter, data) => emitter.emit("data", data) },
  list: (callback) => callback(null, []),
};
