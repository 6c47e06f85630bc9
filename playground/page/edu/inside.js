// Runs in the worker of a JavaScript program before its text: adds what it may call, removes all that reaches a network.

import { edu_program } from "../../edu/program.js";

const post = self.postMessage.bind(self), hear = self.addEventListener.bind(self);
// The frame's policy already forbids them.
for (const name of ["postMessage", "fetch", "XMLHttpRequest", "WebSocket", "WebSocketStream", "WebTransport", "EventSource", "importScripts", "Worker", "SharedWorker",
  "indexedDB", "caches", "BroadcastChannel", "FontFace", "Notification", "close"])
  Object.defineProperty(self, name, { value: undefined });
const { port1, port2 } = new MessageChannel(), next = port2.postMessage.bind(port2), later = [];
let first = 0;
port1.onmessage = () => {
  const deed = later[first];
  later[first++] = undefined;
  if (first === later.length) later.length = first = 0;
  deed();
};
let start = null;
const take = edu_program({
  post: text => post(text),
  later(deed) {
    later[later.length] = deed;
    next(0);
  },
  /** The program's text follows as the function orb_program, as `eval` is forbidden here. The first call runs it, the next
   *  returns its startProgram. */
  load() {
    const { orb_program } = self;
    if (!orb_program) return start;
    delete self.orb_program;
    start = orb_program.call(self);
    return undefined;
  },
});
hear("message", event => take(event.data));
hear("unhandledrejection", event => {
  event.preventDefault();
  const { reason } = event;
  let told = { name: "Error", text: "", stack: "" };
  try { told = { name: String(reason?.name ?? "Error"), text: String(reason?.message ?? reason), stack: String(reason?.stack ?? "") }; } catch { /* it cannot be read */ }
  take(JSON.stringify({ rejected: told }));
});
