// Text to blocks to text: what comes back is what `orb fmt` makes of the text, and the same image, for all programs
// that are shipped and for random ones; lines that are no statement come back byte for byte.
// usage: node blocks.mjs ROOT RANDOM_STRUCTURED [COUNT [FIRST_SEED]]; exits 77 where `./dev playground` has built nothing.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { existsSync, readFileSync, readdirSync } from "node:fs";
import { createRequire } from "node:module";
import { dirname, join, relative, resolve } from "node:path";
import { pathToFileURL } from "node:url";

const [root, random_structured] = process.argv.slice(2, 4).map(path => resolve(path));
const [count = 300, first_seed = 1] = process.argv.slice(4).map(Number);
const engine_file = join(root, "build/npm/engine.js");
if (!existsSync(engine_file)) {
  console.log(`skipped: ${engine_file} is not there; ./dev playground builds it`);
  process.exit(77);
}
Error.stackTraceLimit = 5; // Blockly throws and catches where there is no page
const { load_engine } = await import(pathToFileURL(engine_file));
const part = name => import(pathToFileURL(join(root, "playground/page/blocks", name)));
const Blockly = createRequire(import.meta.url)(join(root, "playground/node_modules/blockly/blockly_compressed.js"));
const { define_blocks } = await part("kinds.js");
const { load_rows } = await part("rows.js");
const { write } = await part("write.js");

// What Blockly asks of a document where there is none: it notes shadow blocks as elements.
class Element {
  constructor(name) { Object.assign(this, { nodeName: name, nodeType: 1, childNodes: [], attributes: {}, textContent: "" }); }
  setAttribute(name, value) { this.attributes[name] = String(value); }
  getAttribute(name) { return this.attributes[name] ?? null; }
  hasAttribute(name) { return name in this.attributes; }
  removeAttribute(name) { delete this.attributes[name]; }
  appendChild(child) { this.childNodes.push(child); return child; }
  get tagName() { return this.nodeName; }
  get firstChild() { return this.childNodes[0] ?? null; }
}
const document = { createElementNS: (_, name) => new Element(name), createTextNode: text => Object.assign(new Element("#text"), { nodeType: 3, textContent: text }) };
Blockly.utils.xml.injectDependencies({ document, DOMParser: class {}, XMLSerializer: class {} });

const engine = await load_engine();
define_blocks(Blockly, engine.call("words"));
const asked = (method, text) => engine.call(method, { files: { "a.orb": text } });
function through_blocks(text) {
  const workspace = new Blockly.Workspace();
  Blockly.Events.disable();
  try {
    load_rows(Blockly, workspace, asked("tree", text).rows);
    return { ...write(workspace), fresh: write(workspace, { fresh: true }).text };
  } finally {
    workspace.dispose();
    Blockly.Events.enable();
  }
}
const counts = { programs: 0, lines: 0, kept: 0, images: 0, broken: 0 };
const failures = [];
function check(name, deed) {
  try {
    deed();
  } catch (error) {
    failures.push(name);
    if (failures.length <= 5) console.error(`${name}: ${error.message.split("\n").slice(0, 12).join("\n")}`);
  }
}
/** /** Its image; nothing if it has errors. */
function image_of(files, name) {
  try {
    return engine.call("build", { files, names: [name] }).bytes;
  } catch (error) {
    if (error.code === 1) return null;
    throw error;
  }
}
const is_broken = text => asked("tree", text).rows.some(({ kind }) => kind === "text");

function check_program(name, text, others = {}) {
  const { text: got, fresh, known, ids } = through_blocks(text);
  ++counts.programs;
  counts.lines += ids.length;
  counts.kept += known;
  const formatted = asked("format", text).text;
  if (is_broken(text)) {
    ++counts.broken;
    return check_broken(text, got);
  }
  assert.equal(got, formatted);
  const path = "a.orb", image = image_of({ [path]: text, ...others }, path);
  if (!image) return;
  ++counts.images;
  for (const one of new Set([got, fresh])) assert.deepEqual(image_of({ [path]: one, ...others }, path), image);
}
/** /** Near a syntax error the indentation level is unknown; lines without a block keep theirs. */
function check_broken(text, got) {
  const squeezed = all => all.split("\n").map(line => line.replace(/\s/g, "").toLowerCase()).filter(Boolean);
  assert.deepEqual(squeezed(got), squeezed(asked("format", text).text));
  for (const { kind, lines } of asked("tree", text).rows)
    if (kind === "text") assert.ok(`\n${got}`.includes(`\n${lines.join("\n")}\n`), `lost: ${JSON.stringify(lines)}`);
}

// ---- what is shipped ----
function files_below(folder, ending) {
  return readdirSync(folder, { withFileTypes: true }).flatMap(entry =>
    entry.isDirectory() ? files_below(join(folder, entry.name), ending) : entry.name.endsWith(ending) ? [join(folder, entry.name)] : []);
}
const shipped = files_below(join(root, "examples"), ".orb");
for (const path of shipped) {
  const macros = Object.fromEntries(files_below(dirname(path), ".macro").map(one => [relative(dirname(path), one), readFileSync(one, "utf8")]));
  check(relative(root, path), () => check_program(relative(root, path), readFileSync(path, "utf8"), macros));
}
check("shipped programs", () => {
  assert.ok(shipped.length > 30, `only ${shipped.length} programs`);
  // Blocks write lines anew; what they cannot write as it was is rare.
  assert.ok(counts.kept <= 3, `${counts.kept} lines are only kept`);
});

// ---- random ones ----
/** The same for the same seed. */
function random_from(seed) {
  let state = seed >>> 0;
  return below => {
    state = (state + 0x6D2B79F5) >>> 0;
    let mixed = Math.imul(state ^ (state >>> 15), state | 1);
    mixed ^= mixed + Math.imul(mixed ^ (mixed >>> 7), mixed | 61);
    return ((mixed ^ (mixed >>> 14)) >>> 0) % below;
  };
}
const notes = ["' a note", "'", "'  two blanks", "// from elsewhere", "# so, too", "' \"quoted\" ü", "rem old  style"];
const odd_lines = ["goroll 0, (", "  x = = 3", "\twhile", "end  while ' of nothing", "?? \"", "if x == 1 then y", "next", "(((", "else", "repeat ("];
/** The program with comments, blank lines, other layouts of the same, and in every fourth one lines that are none. */
function dressed(text, seed) {
  const below = random_from(seed), chance = n => below(n) === 0;
  const broken = seed % 4 === 0;
  return text.split("\n").flatMap(line => {
    if (!line) return [line];
    if (chance(8)) line = line.replaceAll("<>", "!=").replaceAll(", ", chance(2) ? "," : " ,  ");
    if (chance(12)) line = line.replace(/^(\s*)(\w+)/, (_, blanks, word) => blanks + "\t" + word);
    if (chance(10) && !line.includes("goto")) line += ` ${notes[below(notes.length - 1)]}`;
    const before = chance(8) ? [" ".repeat(below(5)) + notes[below(notes.length)]] : chance(8) ? Array(1 + below(3)).fill("") : [];
    return [...before, ...broken && chance(12) ? [odd_lines[below(odd_lines.length)]] : [], line];
  }).join(chance(5) ? "\r\n" : "\n");
}
const chunk = 500;
for (let first = first_seed; first < first_seed + count; first += chunk) {
  const n = Math.min(chunk, first_seed + count - first);
  const texts = execFileSync(random_structured, [first, n].map(String), { encoding: "utf8", maxBuffer: 1 << 30 }).split("\0").slice(0, -1);
  texts.forEach((text, i) => check(`seed ${first + i}`, () => check_program(`seed ${first + i}`, i % 2 ? dressed(text, first + i) : text)));
  if (count > chunk) console.log(`${first + n - first_seed} of ${count}: ${failures.length} failures`);
}
check("random programs", () => assert.ok(count < 100 || (counts.broken > count / 20 && counts.images > count / 5), JSON.stringify(counts)));

console.log(`blocks: ${counts.programs} programs, ${counts.lines} lines (${counts.kept} kept as they were laid out), ${counts.images} images, ${counts.broken} with lines that are none`);
if (failures.length) {
  console.error(`${failures.length} failures: ${failures.slice(0, 20).join(", ")}`);
  process.exit(1);
}
