// orb.wasm in two parts: what a visit mostly needs, and the rest, which is loaded when something in it is called.

/** For load_engine(): `first(imports)` brings the instance of the first part; `rest()` returns the bytes of the second at
 *  once, as a call waits for them. An error of it is one of that call, and the next one tries again. */
export const instance_in_parts = (first, rest) => async imports => {
  let instance = null, whole = false;
  function load_rest() {
    if (whole) return;
    new WebAssembly.Instance(new WebAssembly.Module(rest()), { ...imports, primary: instance.exports });
    whole = true;
  }
  // Until then these stand in the table where functions of the second part will.
  const placeholder = new Proxy({}, {
    get: (_, index) => (...given) => {
      load_rest();
      return Object.values(instance.exports).find(one => one instanceof WebAssembly.Table).get(Number(index))(...given);
    },
  });
  return instance = await first({ ...imports, placeholder });
};
