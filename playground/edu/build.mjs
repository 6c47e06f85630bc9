// Builds what the package needs for Sphero Edu programs: edu.js, with its parser, and report.html, a page without a run.
// usage: node build.mjs WORK PACKAGE; WORK is the folder of the wasm build
import { build } from "esbuild";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { fileURLToPath } from "node:url";

const [work, folder] = process.argv.slice(2);
await build({ entryPoints: [fileURLToPath(new URL("./node.js", import.meta.url))], bundle: true, format: "esm", platform: "node", target: "node18",
  alias: { "edu.json": join(work, "edu.json") }, outfile: join(folder, "edu.js"), legalComments: "inline", logLevel: "warning" });
// Filled in as report_page() of report/page.cpp does it.
const assets = Object.fromEntries(Array.from(readFileSync(join(work, "report_assets.cpp"), "utf8").matchAll(/page_(\w+) = R"asset\(([^]*?)\)asset"/g), ([, kind, text]) => [kind, text]));
const page = assets.html.replace("/*{style}*/", () => assets.css).replace("/*{before}*/", "null").replace("/*{script}*/", () => assets.js);
writeFileSync(join(folder, "report.html"), page);
