// Splits orb.wasm in two: what most visits need, and the rest, loaded when one of its functions is called.

/**
 * For load_engine(): `first(imports)` returns the instance of the first part; `rest()` returns the bytes of the
 * second synchronously, as a call waits for them. If it throws, so does that call, and the next one tries again.
 */
export const instance_in_parts = (first, rest) => async imports => {
  let instance = null, whole = false;
  function load_rest() {
    if (whole) return;
    new WebAssembly.Instance(new WebAssembly.Module(rest()), { ...imports, primary: instance.exports });
    whole = true;
  }
  // Placeholders in the table for functions of the second part.
  const placeholder = new Proxy({}, {
    get: (_, index) => (...given) => {
      load_rest();
      return Object.values(instance.exports).find(one => one instanceof WebAssembly.Table).get(Number(index))(...given);
    },
  });
  return instance = await first({ ...imports, placeholder });
};
