// The sandbox in node: a worker with a separate realm, without modules, files, network or the process. Terminating the
// worker ends an endless loop.
import { Worker } from "node:worker_threads";

import { edu_program } from "./program.js";

/** Globals that no Edu program needs and that could use memory outside the limits, or block. */
const withheld = ["WebAssembly", "SharedArrayBuffer", "Atomics", "ArrayBuffer", "DataView", "Int8Array", "Uint8Array", "Uint8ClampedArray", "Int16Array", "Uint16Array",
  "Int32Array", "Uint32Array", "Float32Array", "Float64Array", "BigInt64Array", "BigUint64Array", "WeakRef", "FinalizationRegistry"];

const worker_text = `"use strict";
const { parentPort } = require("node:worker_threads"), { createContext, runInContext } = require("node:vm");
// No code out of strings: it could ask for modules, which prepare.js takes out of the text.
const realm = createContext(Object.create(null), { name: "program", codeGeneration: { strings: false, wasm: false } });
runInContext(${JSON.stringify(`"use strict"; for (const name of ${JSON.stringify(withheld)}) delete globalThis[name];`)}, realm);
const hear = runInContext(${JSON.stringify(`(${edu_program})`)}, realm, { filename: "sandbox" })({
  post: text => { parentPort.postMessage(String(text)); }, later: f => { setImmediate(() => { f(); }); }, load: text => runInContext(text, realm, { filename: "program.js" }) });
const rejected = error => {
  let text = "", name = "Error", stack = "";
  try { text = String(error?.message ?? error); name = String(error?.name ?? name); stack = String(error?.stack ?? ""); } catch {}
  hear(JSON.stringify({ rejected: { text, name, stack } }));
};
process.on("unhandledRejection", rejected);
process.on("uncaughtException", rejected);
parentPort.on("message", text => { hear(text); });
`;

/** Seconds without an answer after which a program is ended. */
export const patience = 20;
const megabyte_limits = { maxOldGenerationSizeMb: 192, maxYoungGenerationSizeMb: 32, stackSizeMb: 4 };

/** Runs a program with a Host until it is over; `pace` as in Host.answer(). */
export async function run_in_worker(host, first, pace) {
  const worker = new Worker(worker_text, { eval: true, env: {}, argv: [], execArgv: [], stdin: false, stdout: true, stderr: true, resourceLimits: megabyte_limits });
  const failure = rule => ({ rule, line: 0, column: 1, holes: { n: patience } });
  let timer;
  try {
    await new Promise(done => {
      const tell = text => {
        clearTimeout(timer);
        timer = setTimeout(() => { host.end("error", failure("silent")); done(); }, 1000 * patience);
        worker.postMessage(text);
      };
      worker.on("message", async text => {
        clearTimeout(timer);
        const answer = await host.answer(text, pace);
        if (host.over) done();
        else if (answer !== null) tell(answer);
      });
      worker.on("error", error => {
        host.end("error", error.code === "ERR_WORKER_OUT_OF_MEMORY" ? failure("memory") : { rule: "exception", line: 0, column: 1, holes: { text: error.message } });
        done();
      });
      worker.on("exit", () => {
        host.end("error", failure("memory"));
        done();
      });
      worker.on("online", () => tell(first));
    });
  } finally {
    clearTimeout(timer);
    worker.removeAllListeners("exit");
    await worker.terminate();
  }
}
