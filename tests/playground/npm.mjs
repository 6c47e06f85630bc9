// The package orb-wasm as somebody gets it: what is packed, and a program that uses it.
// usage: node npm.mjs ROOT; exits 77 where `./dev playground` has built nothing or there is no npm.
import assert from "node:assert/strict";
import { execFileSync, spawnSync } from "node:child_process";
import { existsSync, mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";

const root = resolve(process.argv[2] ?? ".");
const folder = join(root, "build/npm");
if (!existsSync(join(folder, "orb.wasm")) || spawnSync("npm", ["--version"]).status !== 0) {
  console.log(`skipped: ${folder} is not there; ./dev playground builds it`);
  process.exit(77);
}
const place = mkdtempSync(join(tmpdir(), "orb-npm-"));
process.on("exit", () => rmSync(place, { recursive: true, force: true }));

const [packed] = JSON.parse(execFileSync("npm", ["pack", folder, "--json", "--pack-destination", place], { encoding: "utf8", stdio: ["ignore", "pipe", "ignore"] }));
assert.deepEqual(packed.files.map(file => file.path).sort(),
  ["LICENSE", "LICENSES.txt", "README.md", "engine.js", "error.js", "index.d.ts", "index.js", "orb.mjs", "orb.wasm", "package.json"]);

const modules = join(place, "node_modules/orb-wasm");
mkdirSync(modules, { recursive: true });
execFileSync("tar", ["xf", join(place, packed.filename), "-C", modules, "--strip-components=1"]);
writeFileSync(join(place, "use.mjs"), `
  import assert from "node:assert/strict";
  import { assemble, build, check, format, run, test, version, OrbError } from "orb-wasm";
  assert.match(await version(), /^\\d+\\.\\d+\\.\\d+$/);
  const ran = await run("print 6 * 7", { trace: "json" });
  assert.equal(ran.prints, "42\\n");
  assert.equal(ran.ending.reason, "end");
  assert.match(ran.trace, /"event":"print","text":"42\\\\n"/);
  const { diagnostics } = await check({ "a.bas": "10 rgb 255,0,0" });
  assert.equal(diagnostics[0].rule, "unknown-statement");
  await assert.rejects(run({ "a.orb": "prnt 1" }), error => error instanceof OrbError && error.code === 1 && error.findings.diagnostics.length === 1);
  const [macro] = await assemble({ "a.macro": "rgb 255 0 0\\nend" });
  assert.deepEqual([...macro.sphero], [7, 255, 0, 0, 0, 0]);
  assert.equal(await format({ "a.orb": "if 1=1 then\\nprint 1\\nend if" }), "if 1 = 1 then\\n  print 1\\nend if\\n");
  assert.equal(new TextDecoder().decode(await build({ "a.bas": "10 end" })), "10 end\\n\\0");
  const { results } = await test({ "a.test": 'test "prints"\\n  expect print "7"', "a.orb": "print 7" });
  assert.equal(results.tests[0].cases[0].verdict, "passed");
`);
execFileSync("node", ["use.mjs"], { cwd: place, stdio: "inherit" });
console.log(`orb-wasm: ${packed.files.length} files, ${(packed.size / 1000).toFixed(0)} KB packed; check, run, test, format, build and assemble work`);
