// The page's end of the worker.

import { OrbError } from "./error.js";

export class Client {
  #url; #worker; #next = 1; #open = new Map(); #listeners = new Map();

  /** Settles when the wasm is there; rejects where it cannot be loaded. A new one after restart(). */
  ready;

  constructor(url) {
    this.#url = url;
    this.#begin();
  }

  #begin() {
    const worker = new Worker(this.#url, { type: "module" });
    this.#worker = worker;
    this.ready = new Promise((done, failed) => {
      worker.onmessage = ({ data }) => {
        if (data.event === "ready") done(data.data);
        else if (data.event === "broken") failed(new OrbError({ code: "broken", message: data.data.message }));
        else if (data.event) this.#emit(data.event, data.data);
        else this.#settle(data);
      };
      worker.onerror = event => failed(new OrbError({ code: "broken", message: event.message ?? "the worker cannot be loaded" }));
    });
    this.ready.catch(error => this.#reject_all(error));
  }

  #settle({ id, result, error }) {
    const call = this.#open.get(id);
    this.#open.delete(id);
    if (error) call?.failed(new OrbError(error));
    else call?.done(result);
  }
  #reject_all(error) {
    for (const { failed } of this.#open.values()) failed(error);
    this.#open.clear();
  }
  #emit(event, data) {
    for (const listener of this.#listeners.get(event) ?? []) listener(data);
  }

  /** Asks for something of playground/README.md. */
  call(method, params = {}) {
    return new Promise((done, failed) => {
      const id = this.#next++;
      this.#open.set(id, { done, failed });
      this.#worker.postMessage({ id, method, params });
    });
  }

  on(event, listener) {
    if (!this.#listeners.has(event)) this.#listeners.set(event, new Set());
    this.#listeners.get(event).add(listener);
    return () => this.#listeners.get(event).delete(listener);
  }

  /** Ends whatever goes on, at once, and begins anew: nothing is open for the language server then. */
  restart() {
    this.#worker.terminate();
    this.#reject_all(new OrbError({ code: "stopped", message: "stopped" }));
    this.#begin();
    this.#emit("restart");
  }
}
