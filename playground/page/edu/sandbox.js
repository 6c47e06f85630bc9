// Isolates an untrusted JavaScript program: in a worker within a frame with an opaque origin, which may load nothing and has
// no network. The program answers one question at a time, and is ended if it does not.

import frame_script from "text:./frame.js";
import inside from "text:./inside.js";
import { element } from "../dom.js";

/** Seconds without an answer after which a program is ended. */
export const patience_s = 10; // a slow computer may need several for the first answer
const policy = `default-src 'none'; script-src '${FRAME_HASH}'; worker-src blob:; base-uri 'none'; form-action 'none'`;

/** Why a program was ended: `kind` is "busy" (no answer), "flood" (a message without a question), "large",
 *  "garbage" (not a text), "broken" (its text did not load; with `text` and `line`), or "stopped". */
export class Ended extends Error {
  constructor(kind, more = {}) {
    super(kind);
    Object.assign(this, { kind, ...more });
  }
}

export class Sandbox {
  #frame; #port = null; #begin = ""; #asked = null; #timer = 0; #over = null;

  /** `source`: the program's text from playground/edu/prepare.js, already parsed. */
  constructor(source) {
    // On the program's first line, so that the lines keep their numbers.
    this.#begin = `${inside};self.orb_program=function(){${source}\n;return typeof startProgram==="function"?startProgram:null}\n//# sourceURL=program.js`;
  }
  async #open() {
    const frame = this.#frame = element("iframe", { sandbox: "allow-scripts", hidden: true, title: "program", "aria-hidden": "true", tabindex: -1 });
    frame.srcdoc = `<!doctype html><meta http-equiv="Content-Security-Policy" content="${policy}"><script>${frame_script}</script>`;
    const loaded = new Promise(done => { frame.onload = done; });
    document.body.append(frame);
    await loaded;
    if (this.#over) throw this.#over;
    const { port1, port2 } = new MessageChannel();
    this.#port = port1;
    port1.onmessage = ({ data }) => this.#hear(data);
    frame.contentWindow.postMessage("", "*", [port2]);
  }
  /** Asks the program and returns its answer; throws `Ended`, as after `seconds` without one. */
  async ask(text, seconds = patience_s) {
    if (!this.#port) await this.#open();
    if (this.#over) throw this.#over;
    return new Promise((done, failed) => {
      this.#asked = { done, failed };
      this.#timer = setTimeout(() => this.#stop(new Ended("busy")), seconds * 1000);
      this.#port.postMessage({ begin: this.#begin, ask: text });
      this.#begin = "";
    });
  }
  end() {
    this.#stop(new Ended("stopped"));
  }
  #hear({ kind, text, line }) {
    clearTimeout(this.#timer);
    if (kind !== "said") return this.#stop(new Ended(kind, { text, line }));
    const asked = this.#asked;
    this.#asked = null;
    asked?.done(text);
  }
  #stop(reason) {
    if (this.#over) return;
    this.#over = reason;
    clearTimeout(this.#timer);
    this.#port?.postMessage({ over: true });
    this.#port?.close();
    this.#frame?.remove();
    this.#asked?.failed(reason);
  }
}
