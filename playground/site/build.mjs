// Puts the page, the docs and the service worker into the folder of the playground, beside the engine.
// usage: node playground/site/build.mjs FOLDER

import { createHash } from "node:crypto";
import { mkdirSync, readFileSync, readdirSync, writeFileSync, copyFileSync } from "node:fs";
import { dirname, join, relative, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import * as esbuild from "esbuild";
import { minify } from "terser";
import { build_docs } from "./docs.mjs";
import { licences } from "./licences.mjs";

const root = resolve(dirname(fileURLToPath(import.meta.url)), "../..");
const out = resolve(process.argv[2] ?? join(root, "build/playground"));
const read = path => readFileSync(join(root, path), "utf8");
mkdirSync(out, { recursive: true });

/** The engine stands where emscripten has put it; and what is to be weighed has no library for all of Markdown. */
const stand_ins = { "./orb.mjs": join(root, "build/wasm/orb.mjs"), marked: join(root, "playground/page/markdown.js") };
const places = {
  name: "places",
  setup(build) {
    build.onResolve({ filter: /^(\.\/orb\.mjs|marked)$/ }, ({ path }) => ({ path: stand_ins[path] }));
  },
};
const shared = {
  outdir: out, absWorkingDir: root, write: false, bundle: true, format: "esm", target: "es2022", external: ["node:*"], plugins: [places],
  metafile: true, legalComments: "none", logLevel: "warning",
};
// What the page imports when it is asked for becomes a file of its own; one that is imported at once is loaded at once.
const page = await esbuild.build({ ...shared, entryPoints: [join(root, "playground/start.js"), join(root, "playground/page.js")], splitting: true, chunkNames: "[name]-[hash]" });
const rest = readFileSync(join(root, "build/wasm/rest.wasm"));
const rest_name = `orb-rest-${createHash("sha256").update(rest).digest("hex").slice(0, 8)}.wasm`; // a page never takes that of another build
writeFileSync(join(out, rest_name), rest);
const worker = await esbuild.build({ ...shared, entryPoints: [join(root, "playground/worker.js")], define: { ORB_REST: JSON.stringify(`./${rest_name}`) } });
// Terser takes twenty times as long as esbuild, and makes the page's script lighter by a thirtieth.
for (const { path, text } of [...page.outputFiles, ...worker.outputFiles])
  writeFileSync(path, (await minify(text, { module: true, ecma: 2020, compress: { passes: 3 } })).code);
const parts = Object.fromEntries(Object.entries(page.metafile.outputs).map(([path, { imports }]) => [relative(out, resolve(root, path)),
  imports.filter(({ kind }) => kind === "import-statement").map(one => relative(out, resolve(root, one.path)))]));
const at_once = new Set(["start.js", "page.js"]);
for (const name of at_once) for (const one of parts[name]) at_once.add(one); // a set goes on to what is added
const on_demand = new Set([rest_name, ...Object.keys(parts).filter(name => !at_once.has(name))]);
const styled = (...paths) => esbuild.transformSync(paths.map(read).join("\n"), { loader: "css", minify: true }).code;
writeFileSync(join(out, "blocks.css"), styled("playground/page/blocks/blocks.css"));
// The page in each language: the texts of all its parts in one file.
mkdirSync(join(out, "languages"), { recursive: true });
for (const name of readdirSync(join(root, "translations")).filter(name => name.endsWith(".json"))) {
  const { language, findings, ...parts } = JSON.parse(read(`translations/${name}`));
  writeFileSync(join(out, "languages", name), JSON.stringify({ findings, page: Object.assign({}, ...Object.values(parts)) }));
}
// The pointers and marks of Blockly; it makes no sounds here.
mkdirSync(join(out, "blocks"), { recursive: true });
const media = join(root, "playground/node_modules/blockly/media");
for (const name of readdirSync(media)) if (!name.endsWith(".mp3")) copyFileSync(join(media, name), join(out, "blocks", name));

/** The parts of the report's page that show a run, where the page has their names. */
function composed() {
  const report = read("report/page.html");
  const part = (name, pattern) => {
    const found = pattern.exec(report);
    if (!found) throw new Error(`report/page.html has no ${name}`);
    return found[0];
  };
  const parts = {
    // In the page itself: a file of its own would come after the scripts, and the first frame waits for it.
    style: styled("report/page.css", "playground/page.css", "playground/page/blocks/toggle.css"),
    stage: part("stage", /<section class="stage"[^]*?<\/section>/),
    variables: part("variables", /<section id="variables-pane"[^]*?<\/section>/),
    events: part("events", /<section class="pane events"[^]*?<\/section>/),
    lanes: part("lanes", /<section class="lanes"[^]*?<\/section>/),
    transport: part("transport", /<footer class="transport"[^]*?<\/footer>/).replaceAll("footer", "div"),
  };
  return read("playground/page.html").replace(/<!--\{(\w+)\}-->/g, (_, name) => parts[name])
    .replace(/.*"modulepreload".*\n/, [...at_once].map(name => `<link rel="modulepreload" href="${name}">\n`).join(""));
}
const icons = ["icon-192.png", "icon-512.png", "icon-maskable.png"]; // of the installed page (tests/playground/pictures.py draws them)
writeFileSync(join(out, "index.html"), composed());
for (const name of ["icon.svg", ...icons, "manifest.webmanifest"]) copyFileSync(join(root, "playground", name), join(out, name));
writeFileSync(join(out, "LICENSES.txt"), licences(root, { ...page.metafile.inputs, ...worker.metafile.inputs }));
build_docs(root, join(out, "docs"));

// ---- the service worker, last: it knows all files ----
const files = [];
function list(folder) {
  for (const entry of readdirSync(folder, { withFileTypes: true })) {
    const path = join(folder, entry.name);
    if (entry.isDirectory()) {
      if (path !== join(out, "docs")) list(path); // pages of the docs come when they are read
    } else if (!/(^sw\.js|^LICENSES\.txt|\.map|\.br|\.gz)$/.test(entry.name)) files.push(path);
  }
}
list(out);
files.sort();
const hash = createHash("sha256");
for (const path of files) hash.update(relative(out, path)).update("\0").update(readFileSync(path));
const names = files.map(path => relative(out, path));
const comes_later = name => on_demand.has(name) || icons.includes(name) || /^(blocks[./]|languages\/)/.test(name);
// Blocks are heavy, and are kept where somebody uses them, as is a language; the icons are the browser's.
const of_blocks = new Set(Object.entries(page.metafile.outputs).filter(([, { inputs }]) => Object.keys(inputs).some(one => one.includes("/blockly/"))).map(([path]) => relative(out, resolve(root, path))));
const kept_soon = name => on_demand.has(name) && !of_blocks.has(name);
const json = list => JSON.stringify(list);
writeFileSync(join(out, "sw.js"), read("playground/sw.js").replace("/*{hash}*/", hash.digest("hex").slice(0, 16))
  .replace("/*{core}*/[]", json(names.filter(name => !comes_later(name)))).replace("/*{on_demand}*/[]", json(names.filter(comes_later))).replace("/*{soon}*/[]", json(names.filter(kept_soon))));
