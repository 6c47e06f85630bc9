// The page's side of a worker.

import { OrbError } from "./error.js";

const patience = 10_000; // milliseconds of silence after which an engine counts as late

export class Client {
  #url; #worker; #late = 0; #broken = null; #next = 1; #open = new Map(); #listeners = new Map();

  /** Settles when the wasm is loaded; rejects if loading fails. restart() replaces it. */
  ready;

  /** `early`: a worker that start.js started, and the events it has sent since. */
  constructor(url, early) {
    this.#url = url;
    this.#begin(early);
  }

  #begin({ worker, said } = { worker: new Worker(this.#url, { type: "module" }), said: [] }) {
    this.#broken = null;
    this.#worker = worker;
    this.#late = setTimeout(() => this.#emit("late"), patience);
    this.ready = new Promise((done, failed) => {
      const broken = message => {
        clearTimeout(this.#late);
        this.#broken = new OrbError({ code: "broken", message });
        failed(this.#broken);
        this.#reject_all(this.#broken);
        this.#emit("broken", this.#broken);
      };
      worker.onmessage = ({ data }) => {
        if (data.event === "ready") {
          clearTimeout(this.#late);
          done(data.data);
          this.#emit("ready", data.data);
        } else if (data.event === "broken") broken(data.data.message);
        else if (data.event) this.#emit(data.event, data.data);
        else this.#settle(data);
      };
      worker.onerror = event => {
        event.preventDefault();
        broken(event.message || "the worker cannot be loaded");
      };
    });
    this.ready.catch(() => {}); // others handle the rejection
    setTimeout(() => { // after the listeners are attached
      for (const event of said) (event.type === "error" ? worker.onerror : worker.onmessage)(event);
    });
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

  /** Calls a method of playground/README.md; rejects if the worker is broken. */
  call(method, params = {}) {
    if (this.#broken) return Promise.reject(this.#broken);
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

  /** Ends everything at once and starts again; the language server then has no open documents. */
  restart() {
    clearTimeout(this.#late);
    this.#worker.terminate();
    this.#reject_all(new OrbError({ code: "stopped", message: "stopped" }));
    this.#begin();
    this.#emit("restart");
  }
}
