// Uploads from a browser: Web Serial and Web Bluetooth carry the bytes, the uploader in C++ decides which.

import { OrbError } from "./error.js";

export const can_serial = () => typeof navigator !== "undefined" && !!navigator.serial;
export const can_bluetooth = () => typeof navigator !== "undefined" && !!navigator.bluetooth;

const closed = message => ({ kind: "closed", message });
const hung_up = closed("the other end hung up");
const no_ball = message => new OrbError({ code: 4, message });
const words_of = error => error?.message ? error.message.replace(/\.$/, "") : String(error);

/** Received bytes that have not been read yet. */
class Inbox {
  #bytes = []; #error = null; #wake = () => {};

  push(bytes) {
    this.#bytes.push(...bytes);
    this.#wake();
  }
  fail(error) {
    this.#error ??= error;
    this.#wake();
  }
  /** Returns all bytes as soon as there are some; nothing after `ms`, or when `signal` aborts. */
  async read(ms, signal) {
    if (!this.#bytes.length && !this.#error && ms > 0 && !signal?.aborted) {
      let timer;
      await new Promise(done => {
        this.#wake = done;
        timer = setTimeout(done, Math.min(ms, 2 ** 31 - 1));
        signal?.addEventListener("abort", done, { once: true });
      });
      clearTimeout(timer);
      this.#wake = () => {};
    }
    if (this.#bytes.length) return Uint8Array.from(this.#bytes.splice(0));
    if (this.#error) throw this.#error;
    return new Uint8Array();
  }
}

/** Settles like `promise`, or rejects with `error` after `ms`. */
export const within = (promise, ms, error) => {
  let timer;
  const late = new Promise((_, failed) => { timer = setTimeout(() => failed(error), ms); });
  return Promise.race([promise, late]).finally(() => clearTimeout(timer));
};

/**
 * Returns the result of `deed`, retried after each of `pauses_ms` until it succeeds; `failed(error, last)` may throw
 * to give up.
 */
async function patiently(pauses_ms, deed, failed) {
  for (let n = 0; ; ++n) {
    try {
      return await deed();
    } catch (error) {
      failed(error, n === pauses_ms.length);
    }
    await new Promise(done => setTimeout(done, pauses_ms[n]));
  }
}

/** Asks the user for a port: call it in a click handler. */
export const choose_serial = () => navigator.serial.requestPort();

/**
 * Opens a serial port: a classic ball over Bluetooth, or an adapter. Asks the user if none is given. A link has
 * `write(bytes)`, `read(ms, signal)` and `close()`; its errors have `kind` ("closed", "broken") and `message`. `orb`
 * supplies the timeouts.
 */
export async function serial_link(orb, port) {
  port ??= await choose_serial();
  const { pauses_ms, serial } = await orb.call("links");
  if (!port.readable)
    await patiently(pauses_ms, () => port.open({ baudRate: serial.baud_rate }), (error, last) => {
      if (error.name === "InvalidStateError") throw no_ball("cannot open the port: it is in use; close the other tab or program that is using it");
      if (last) throw no_ball(`cannot open the port: ${words_of(error)}; shake the ball awake, keep it close, and end other connections to it`);
    });
  const inbox = new Inbox();
  const reader = port.readable.getReader(), writer = port.writable.getWriter();
  const reading = (async () => {
    try {
      for (;;) {
        const { value, done } = await reader.read();
        if (done) return inbox.fail(hung_up);
        inbox.push(value);
      }
    } catch {
      inbox.fail(hung_up); // the stream reports a lost radio link as an error
    } finally {
      reader.releaseLock();
    }
  })();
  const takes_nothing = { kind: "broken", message: "the link no longer accepts data" };
  let stuck = false; // in the middle of a packet
  return {
    kind: "serial",
    async write(bytes) {
      if (stuck) throw takes_nothing;
      try {
        await within(writer.write(bytes), serial.write_ms, takes_nothing);
      } catch (error) {
        stuck = error === takes_nothing;
        throw stuck ? error : hung_up;
      }
    },
    read: (ms, signal) => inbox.read(ms, signal),
    async close() {
      await reader.cancel().catch(() => {});
      await reading;
      if (stuck) writer.abort().catch(() => {});
      writer.releaseLock();
      await port.close().catch(() => {});
    },
  };
}

const kinds_of = (links, which) => which === "all" ? [links.ble, links.newer] : [links.ble];

/**
 * Asks the user for a robot: call it in a click handler. `which`: those that store programs, or all that can be
 * driven from here.
 */
export async function choose_bluetooth(orb, which = "ble") {
  const kinds = kinds_of(await orb.call("links"), which);
  return navigator.bluetooth.requestDevice({
    filters: kinds.flatMap(kind => kind.names.map(namePrefix => ({ namePrefix }))),
    optionalServices: kinds.flatMap(kind => kind.services),
  });
}

/** Opens a robot over Bluetooth LE. `orb` knows what makes one take commands. Asks the user if none is given. */
export async function bluetooth_link(orb, device, which = "ble") {
  const links = await orb.call("links");
  const { pauses_ms } = links;
  const kinds = kinds_of(links, which);
  device ??= await choose_bluetooth(orb, which);
  const ble = kinds.find(kind => kind.names.some(name => device.name?.startsWith(name))) ?? kinds[0];
  const inbox = new Inbox();
  const lost = closed("the robot is gone; bring it closer, charge it, and try again");
  let here = true;
  const gone = () => {
    here = false;
    inbox.fail(lost);
  };
  const commands = await patiently(pauses_ms, () => greet(device, ble, bytes => inbox.push(bytes)), (error, last) => {
    device.gatt.disconnect();
    if (last) throw no_ball(`cannot connect to ${device.name ?? "the robot"}: ${words_of(error)}; shake it awake, bring it closer, and close any app or disconnect any phone that may be using it`);
  });
  device.addEventListener("gattserverdisconnected", gone);
  async function write(bytes) {
    for (let at = 0; at < bytes.length; at += ble.piece) {
      if (!here) throw lost;
      try {
        await within(commands.writeValueWithResponse(bytes.slice(at, at + ble.piece)), ble.write_ms, "late");
      } catch {
        if (!here || !device.gatt.connected) throw lost;
        return; // it may have arrived, so it is never repeated: the packet counts as lost
      }
    }
  }
  let written = null; // pieces of two packets must not mix
  return {
    kind: "ble",
    name: device.name ?? "",
    write: bytes => written = written ? written.catch(() => {}).then(() => write(bytes)) : write(bytes),
    /** A new link to the same robot, after it was lost. */
    again: () => bluetooth_link(orb, device, which),
    read: (ms, signal) => inbox.read(ms, signal),
    async close() {
      device.removeEventListener("gattserverdisconnected", gone);
      device.gatt.disconnect();
    },
  };
}

async function greet(device, ble, on_bytes) {
  const server = await within(device.gatt.connect(), ble.connect_ms, new Error("it does not answer"));
  const find = async ({ service, characteristic }) => (await server.getPrimaryService(service)).getCharacteristic(characteristic);
  for (const word of ble.greeting) {
    if (ble.wordless.some(name => device.name?.startsWith(name))) break;
    await (await find(word)).writeValueWithResponse(word.bytes);
  }
  const answers = await find(ble.answers);
  answers.addEventListener("characteristicvaluechanged", ({ target: { value } }) =>
    on_bytes(new Uint8Array(value.buffer, value.byteOffset, value.byteLength)));
  await answers.startNotifications();
  return find(ble.commands);
}

/** Writes bytes to a link, or reads until a time. */
export async function do_wish(link, { write, read_until }, now, signal) {
  try {
    if (!write) return { bytes: await link.read(read_until - now(), signal) };
    await link.write(write);
    return {};
  } catch (error) {
    return { error: { kind: error.kind ?? "broken", message: error.message ?? String(error) } };
  }
}

/**
 * Uploads `request` (files, names, area, run, …) to the ball on `link`. Returns how it ended, in the words of `orb
 * upload`; throws if the request cannot be sent at all. An `aborted` signal stops it as Ctrl-C stops `orb upload`.
 */
export async function deliver(orb, link, request, { on_status = () => {}, signal, first_seq = Math.floor(Math.random() * 256) } = {}) {
  const begin = performance.now();
  const now = () => performance.now() - begin;
  let told_to_stop = false;
  /** True once per signal, so that the clean-up still completes. */
  const stopped = () => {
    if (told_to_stop || !signal?.aborted) return false;
    return told_to_stop = true;
  };
  const interrupted = { kind: "interrupted", message: "interrupted" };
  async function carry_out(wish) {
    if (stopped()) return { error: interrupted };
    const done = await do_wish(link, wish, now, told_to_stop ? undefined : signal);
    return done.bytes && !done.bytes.length && stopped() ? { error: interrupted } : done;
  }
  let step = await orb.call("deliver_start", { ...request, first_seq, link: link.kind });
  let told = "";
  while (step.wish) {
    const status = JSON.stringify(step.status);
    if (status !== told) on_status(step.status);
    told = status;
    const done = await carry_out(step.wish);
    step = await orb.call("deliver_step", { at: now(), ...done });
  }
  return step.outcome;
}
