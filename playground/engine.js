// orb as a function: requests in, answers out, in a worker, a page or node. playground/README.md has the
// methods.
import { OrbError } from "./error.js";
import load from "./orb.mjs";

const hex_of = bytes => Array.from(bytes, byte => byte.toString(16).padStart(2, "0")).join(" ");
const bytes_of = hex => Uint8Array.from(hex.split(" ").filter(Boolean), pair => parseInt(pair, 16));
// JSON has no bytes: a Uint8Array becomes `{"hex": "FF 00"}`.
const to_json = value => JSON.stringify(value, (key, one) => one instanceof Uint8Array ? { hex: hex_of(one) } : one);
const from_json = text => JSON.parse(text, (key, one) =>
  one !== null && typeof one === "object" && typeof one.hex === "string" && Object.keys(one).length === 1 ? bytes_of(one.hex) : one);

/** Instantiates the orb.wasm next to this file. */
export async function instance_of(imports) {
  const url = new URL("./orb.wasm", import.meta.url);
  if (url.protocol === "file:" && typeof process === "object") {
    const { readFile } = await import("node:fs/promises");
    return (await WebAssembly.instantiate(await readFile(url), imports)).instance;
  }
  const answer = await fetch(url);
  if (!answer.ok) throw new Error(`${url}: ${answer.status} ${answer.statusText}`);
  const streams = /^application\/wasm\b/.test(answer.headers.get("content-type") ?? ""); // some servers do not send this type
  const { instance } = streams
    ? await WebAssembly.instantiateStreaming(answer, imports)
    : await WebAssembly.instantiate(await answer.arrayBuffer(), imports);
  return instance;
}

/**
 * Loads the wasm; `instantiate(imports)` returns an instance. `call(method, params)` of the result returns the
 * answer or throws an OrbError.
 */
export async function load_engine(instantiate = instance_of) {
  const wasm = await new Promise((done, failed) =>
    load({ instantiateWasm: (imports, receive) => (instantiate(imports).then(receive, failed), {}) }).then(done, failed));
  const encoder = new TextEncoder(), decoder = new TextDecoder();
  function call_text(request) {
    const bytes = encoder.encode(request);
    const place = wasm._malloc(bytes.length + 1);
    if (place === 0) throw new OrbError({ code: 1, message: "this is too large" });
    wasm.HEAPU8.set(bytes, place);
    wasm.HEAPU8[place + bytes.length] = 0;
    try {
      const from = wasm._orb_call(place);
      return decoder.decode(wasm.HEAPU8.subarray(from, wasm.HEAPU8.indexOf(0, from)));
    } finally {
      wasm._free(place);
    }
  }
  return {
    call(method, params = {}) {
      const { result, error } = from_json(call_text(to_json({ method, params })));
      if (error) throw new OrbError(error);
      return result;
    },
  };
}
