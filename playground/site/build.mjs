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

/**
 * The engine and the table of Sphero Edu come from emscripten's output; a small Markdown renderer replaces the full library, to save bytes.
 */
const stand_ins = { "./orb.mjs": join(root, "build/wasm/orb.mjs"), "edu.json": join(root, "build/wasm/edu.json"), marked: join(root, "playground/page/markdown.js") };
const places = {
  name: "places",
  setup(build) {
    build.onResolve({ filter: /^(\.\/orb\.mjs|edu\.json|marked)$/ }, ({ path }) => ({ path: stand_ins[path] }));
  },
};
/** Bundles page/edu/javascript.js with separate copies of the editor's libraries, so that the page's script does not grow.
 *  It shares the editor itself, `@codemirror/state` and `view`, with the page (page/editor_parts.js). */
const copies = {
  name: "copies",
  setup(build) {
    build.onResolve({ filter: /^(@lezer\/.*|@codemirror\/(language|autocomplete|lang-javascript))$/ }, async ({ path, importer, namespace, resolveDir, kind, pluginData }) => {
      if (pluginData === "found" || namespace !== "own" && !importer.endsWith("/page/edu/javascript.js")) return undefined;
      const found = await build.resolve(path, { resolveDir, kind, importer, pluginData: "found" });
      return { path: relative(root, found.path), namespace: "own", sideEffects: false };
    });
    build.onResolve({ filter: /^@codemirror\/(state|view)$/ }, ({ path, importer, namespace }) =>
      namespace === "own" || importer.endsWith("/page/edu/javascript.js") ? { path, namespace: "of-page" } : undefined);
    build.onLoad({ filter: /.*/, namespace: "of-page" }, ({ path }) => ({ contents: `module.exports = globalThis.orb_editor[${JSON.stringify(path)}];`, loader: "js" }));
    build.onLoad({ filter: /.*/, namespace: "own" }, ({ path }) => ({ contents: read(path), loader: "js", resolveDir: dirname(join(root, path)) }));
  },
};
/** Bundles a script for a JavaScript program's frame or worker into one line, so that the lines after it keep their numbers;
 *  template literals could break it. */
async function script_of(path) {
  const { outputFiles: [{ text }] } = await esbuild.build({ entryPoints: [path], bundle: true, write: false, minify: true, format: "iife", target: "es2022", supported: { "template-literal": false }, legalComments: "none" });
  if (/\n./.test(text)) throw new Error(`${path} is more than one line`);
  return text.trim();
}
const script_paths = ["frame", "inside"].map(name => join(root, `playground/page/edu/${name}.js`));
const scripts = new Map(await Promise.all(script_paths.map(async path => [path, await script_of(path)])));
/** The hash that allows the frame's inline script in the page's policy. */
const frame_hash = `sha256-${createHash("sha256").update(scripts.get(script_paths[0])).digest("base64")}`;
/** `text:./name.js` imports such a script as a text. */
const texts = {
  name: "texts",
  setup(build) {
    build.onResolve({ filter: /^text:/ }, ({ path, resolveDir }) => ({ path: join(resolveDir, path.slice(5)), namespace: "text" }));
    build.onLoad({ filter: /.*/, namespace: "text" }, ({ path }) => ({ contents: scripts.get(path), loader: "text" }));
  },
};
const shared = {
  outdir: out, absWorkingDir: root, write: false, bundle: true, format: "esm", target: "es2022", external: ["node:*"], plugins: [places, copies, texts],
  metafile: true, legalComments: "none", logLevel: "warning", splitting: true, chunkNames: "[name]-[hash]",
};
// What the page imports on demand becomes a separate file.
const page = await esbuild.build({ ...shared, entryPoints: [join(root, "playground/start.js"), join(root, "playground/page.js")], define: { FRAME_HASH: JSON.stringify(frame_hash) } });
const rest = readFileSync(join(root, "build/wasm/rest.wasm"));
const rest_name = `orb-rest-${createHash("sha256").update(rest).digest("hex").slice(0, 8)}.wasm`; // a page never loads that of another build
writeFileSync(join(out, rest_name), rest);
const worker = await esbuild.build({ ...shared, entryPoints: [join(root, "playground/worker.js")], define: { ORB_REST: JSON.stringify(`./${rest_name}`) } });
const parts_of_editor = read("playground/page/editor_parts.js");
for (const { text } of page.outputFiles)
  for (const [, name] of text.matchAll(/\bimport_(?:state|view)\d*\.(\w+)/g))
    if (!new RegExp(`\\b${name}\\b`).test(parts_of_editor)) throw new Error(`playground/page/editor_parts.js lacks ${name}`);
// Terser takes twenty times as long as esbuild, but saves a thirtieth of the page's script.
for (const { path, text } of [...page.outputFiles, ...worker.outputFiles])
  writeFileSync(path, (await minify(text, { module: true, ecma: 2020, compress: { passes: 3 } })).code);
const parts = Object.fromEntries(Object.entries({ ...page.metafile.outputs, ...worker.metafile.outputs }).map(([path, { imports }]) => [relative(out, resolve(root, path)),
  imports.filter(({ kind }) => kind === "import-statement").map(one => relative(out, resolve(root, one.path)))]));
const at_once = new Set(["start.js", "page.js"]);
for (const name of at_once) for (const one of parts[name]) at_once.add(one); // the loop also visits what it adds
const on_demand = new Set([rest_name, ...Object.keys(parts).filter(name => name !== "worker.js" && !at_once.has(name))]);
const styled = (...paths) => esbuild.transformSync(paths.map(read).join("\n"), { loader: "css", minify: true }).code;
writeFileSync(join(out, "blocks.css"), styled("playground/page/blocks/blocks.css"));
// One file per language with the texts of all parts of the page.
mkdirSync(join(out, "languages"), { recursive: true });
for (const name of readdirSync(join(root, "translations")).filter(name => name.endsWith(".json"))) {
  const { language, findings, phrases, ...parts } = JSON.parse(read(`translations/${name}`));
  // The page composes phrases itself: user text must never match one.
  writeFileSync(join(out, "languages", name), JSON.stringify({ findings: { ...findings, ...phrases }, page: Object.assign({}, ...Object.values(parts)) }));
}
// Blockly's cursors and icons, without its sounds.
mkdirSync(join(out, "blocks"), { recursive: true });
const media = join(root, "playground/node_modules/blockly/media");
for (const name of readdirSync(media)) if (!name.endsWith(".mp3")) copyFileSync(join(media, name), join(out, "blocks", name));

/** The parts of the report's page that show a run, with the page's ids. */
function composed() {
  const report = read("report/page.html");
  const part = (name, pattern) => {
    const found = pattern.exec(report);
    if (!found) throw new Error(`report/page.html has no ${name}`);
    return found[0];
  };
  const parts = {
    // Inlined: as a file it would load after the scripts, and the first frame waits for it.
    style: styled("report/page.css", "playground/page.css", "playground/page/blocks/toggle.css"),
    stage: part("stage", /<section class="stage"[^]*?<\/section>/),
    variables: part("variables", /<section id="variables-pane"[^]*?<\/section>/),
    events: part("events", /<section class="pane events"[^]*?<\/section>/),
    lanes: part("lanes", /<section class="lanes"[^]*?<\/section>/),
    transport: part("transport", /<footer class="transport"[^]*?<\/footer>/).replaceAll("footer", "div"),
  };
  return read("playground/page.html").replace("{frame}", frame_hash).replace(/<!--\{(\w+)\}-->/g, (_, name) => parts[name])
    .replace(/.*"modulepreload".*\n/, [...at_once].map(name => `<link rel="modulepreload" href="${name}">\n`).join(""));
}
const icons = ["icon-192.png", "icon-512.png", "icon-maskable.png"]; // for the installed page (tests/playground/pictures.py draws them)
writeFileSync(join(out, "index.html"), composed());
for (const name of ["icon.svg", ...icons, "manifest.webmanifest"]) copyFileSync(join(root, "playground", name), join(out, name));
writeFileSync(join(out, "LICENSES.txt"), licences(root, { ...page.metafile.inputs, ...worker.metafile.inputs }));
build_docs(root, join(out, "docs"));

// ---- the service worker, last: it lists all files ----
const files = [];
function list(folder) {
  for (const entry of readdirSync(folder, { withFileTypes: true })) {
    const path = join(folder, entry.name);
    if (entry.isDirectory()) {
      if (path !== join(out, "docs")) list(path); // pages of the docs are cached when read
    } else if (!/(^sw\.js|^LICENSES\.txt|\.map|\.br|\.gz)$/.test(entry.name)) files.push(path);
  }
}
list(out);
files.sort();
const hash = createHash("sha256");
for (const path of files) hash.update(relative(out, path)).update("\0").update(readFileSync(path));
const names = files.map(path => relative(out, path));
const comes_later = name => on_demand.has(name) || icons.includes(name) || /^(blocks[./]|examples\/|languages\/)/.test(name);
// Blocks and languages are large, and cached once used; the browser keeps the icons.
const of_blocks = new Set(Object.entries(page.metafile.outputs).filter(([, { inputs }]) => Object.keys(inputs).some(one => one.includes("/blockly/"))).map(([path]) => relative(out, resolve(root, path))));
const kept_soon = name => on_demand.has(name) && !of_blocks.has(name) || name.startsWith("examples/");
const json = list => JSON.stringify(list);
writeFileSync(join(out, "sw.js"), read("playground/sw.js").replace("/*{hash}*/", hash.digest("hex").slice(0, 16))
  .replace("/*{core}*/[]", json(names.filter(name => !comes_later(name)))).replace("/*{on_demand}*/[]", json(names.filter(comes_later))).replace("/*{soon}*/[]", json(names.filter(kept_soon))));
