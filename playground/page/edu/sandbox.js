// A JavaScript program of anybody, where it can reach nothing: in a worker within a frame whose origin is nobody's, which
// may load nothing and has no network. It is asked and answers, in turns; one that does not answer is ended.

import frame_script from "text:./frame.js";
import inside from "text:./inside.js";
import { element } from "../dom.js";

/** Seconds until a program that has not answered is one that never will. */
export const patience_s = 10; // a slow computer may need some for the first
const policy = `default-src 'none'; script-src '${FRAME_HASH}'; worker-src blob:; base-uri 'none'; form-action 'none'`;

/** Why a program was ended: `kind` is "busy" (it has not answered), "flood" (it said something unasked), "large",
 *  "garbage" (what it said is no text), "broken" (its own text is no program; with `text` and `line`), or "stopped". */
export class Ended extends Error {
  constructor(kind, more = {}) {
    super(kind);
    Object.assign(this, { kind, ...more });
  }
}

export class Sandbox {
  #frame; #port = null; #begin = ""; #asked = null; #timer = 0; #over = null;

  /** `source`: the text of the program as playground/edu/prepare.js gives it; it has been parsed. */
  constructor(source) {
    // In one line before the program's first, so that the lines keep their numbers.
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
  /** Asks the program, and gives what it answers within these seconds; throws `Ended`. */
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
