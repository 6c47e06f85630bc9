// Runs in the frame of a JavaScript program, which has an opaque origin: keeps the program's worker and passes on one
// text for each question. Anything else ends the program, so that it can neither flood the page nor send it anything
// but text.

const most = 4_000_000; // characters in a message
let port = null, worker = null, is_asked = false;

/** Ends the program, whatever it is doing. */
function end(kind, more) {
  worker?.terminate();
  worker = null;
  if (kind) port.postMessage({ kind, ...more });
}
function take({ data }) {
  if (!worker) return;
  if (!is_asked) return end("flood");
  is_asked = false;
  if (typeof data !== "string") return end("garbage");
  if (data.length > most) return end("large");
  port.postMessage({ kind: "said", text: data });
}
function hear({ data: { begin, ask, over } }) {
  if (over) return end();
  if (begin) {
    worker = new Worker(URL.createObjectURL(new Blob([begin], { type: "text/javascript" })));
    worker.onmessage = take;
    worker.onmessageerror = () => end("garbage");
    // The runtime reports what a program throws: here its text did not load.
    worker.onerror = event => {
      event.preventDefault();
      end("broken", { text: event.message ?? "", line: event.lineno ?? 0 });
    };
  }
  if (!ask) return;
  is_asked = true;
  worker?.postMessage(ask);
}
addEventListener("message", ({ source, ports: [given] }) => {
  if (source !== parent || port || !given) return;
  port = given;
  port.onmessage = hear;
});
