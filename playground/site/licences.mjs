// The licences of third-party code in the page's script and in orb.wasm.

import { existsSync, readFileSync, readdirSync } from "node:fs";
import { join } from "node:path";

/** Libraries linked into orb.wasm, by Debian package; emscripten provides the C and C++ libraries. */
const linked = ["tao-pegtl-dev", "nlohmann-json3-dev", "libexpected-dev", "libfmt-dev", "libpugixml-dev", "libpcre2-dev", "emscripten"];

/** `inputs`: the bundled files by path, which may follow the name of an esbuild namespace. */
export function licences(root, inputs) {
  const packages = new Set(Object.keys(inputs).map(path => /playground\/node_modules\/(?:@[^/]+\/)?[^/]+/.exec(path)?.[0]).filter(Boolean));
  const texts = [`orb\n\n${readFileSync(join(root, "LICENSE"), "utf8")}`];
  for (const path of [...packages].sort()) {
    const folder = join(root, path);
    const { name, version } = JSON.parse(readFileSync(join(folder, "package.json"), "utf8"));
    const file = readdirSync(folder).find(one => /^licen[cs]e/i.test(one));
    if (!file || !existsSync(join(folder, file))) throw new Error(`${name} has no licence beside it`);
    texts.push(`${name} ${version}\n\n${readFileSync(join(folder, file), "utf8").trim()}\n`);
  }
  for (const name of linked) {
    const file = `/usr/share/doc/${name}/copyright`;
    if (!existsSync(file)) throw new Error(`${file} is missing: the licence of what orb.wasm holds`);
    texts.push(`${name}\n\n${readFileSync(file, "utf8").trim()}\n`);
  }
  return texts.join(`\n${"-".repeat(80)}\n\n`);
}
