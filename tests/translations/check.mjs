// Checks that the translations are complete and match the English: run it after every change of
// translations/*.json. usage: node tests/translations/check.mjs [ROOT]
import { existsSync, readFileSync, readdirSync } from "node:fs";
import { join, resolve } from "node:path";
import { make_catalogue } from "../../playground/page/catalogue.js";
import { for_page } from "../../playground/task.mjs";

const root = resolve(process.argv[2] ?? "."), read = path => readFileSync(join(root, path), "utf8");
const sections = ["findings", "verdicts", "phrases", "page", "blocks", "lessons"];
const files = readdirSync(join(root, "translations")).filter(name => name.endsWith(".json")).sort();
const troubles = [];
const trouble = (where, words) => troubles.push(`${where}: ${words}`);

const parsed = Object.fromEntries(files.map(name => {
  try {
    return [name, JSON.parse(read(`translations/${name}`))];
  } catch (error) {
    trouble(`translations/${name}`, error.message);
    return [name, {}];
  }
}));

// ---- each language has every text, once ----
const keys = Object.fromEntries(sections.map(section => [section, [...new Set(files.flatMap(name => Object.keys(parsed[name][section] ?? {})))]]));
for (const name of files)
  for (const section of sections)
    for (const key of keys[section])
      if (typeof parsed[name][section]?.[key] !== "string" || !parsed[name][section][key]) trouble(name, `${section} lacks: ${key}`);
for (const section of sections)
  for (const key of keys[section])
    for (const other of sections)
      if (other < section && keys[other].includes(key)) trouble(section, `is in ${other}, too: ${key}`);

// ---- holes and code in backticks must match; punctuation follows the language ----
const holes = text => (text.match(/\{\w+\}/g) ?? []).sort().join(" ");
const codes = text => (text.match(/`[^`]*`/g) ?? []).sort().join(" ");
const count = (text, sign) => text.split(sign).length - 1;
/** What is wrong with the signs of a text. */
const signs = {
  "de.json": text => /"/.test(text) || count(text, "„") !== count(text, "“") ? "quotes are „ and “" : "",
  "es.json": text => count(text, "¿") !== count(text, "?") || count(text, "¡") !== count(text, "!") ? "¿ and ¡ begin what ? and ! end" : "",
  "fr.json": text => /[^\u00a0?!][;?!](\s|$)|[^\u00a0] ?:(\s|$)|«[^\u00a0]|[^\u00a0]»/.test(text) ? "a no-break space stands before ; : ? ! and within « »" : "",
};
for (const name of files)
  for (const section of sections)
    for (const [key, text] of Object.entries(parsed[name][section] ?? {})) {
      if (holes(key) !== holes(text)) trouble(name, `other holes than “${key}”: ${text}`);
      if (codes(key) !== codes(text)) trouble(name, `other code than “${key}”: ${text}`);
      if (/^\s*$/.test(text) || /^\s|\s$/.test(text) && !key.startsWith(" ")) trouble(name, `blanks around: ${text}`);
      if (/\}\{/.test(key)) trouble(section, `nothing between two holes: ${key}`);
      const wrong = signs[name]?.(text.replace(/`[^`]*`|^ {4}[^]*/g, ""));
      if (wrong) trouble(name, `${wrong}: ${text}`);
    }

// ---- the lessons: every paragraph, title and name of a test, and nothing else ----
const folders = readdirSync(join(root, "examples/lessons")).filter(name => /^\d/.test(name)).map(name => `examples/lessons/${name}`);
const lessons = [...folders, ...folders.map(folder => `${folder}/edu`).filter(folder => existsSync(join(root, folder)))];
const needed = new Set(lessons.flatMap(folder => {
  const [head, ...blocks] = for_page(read(`${folder}/README.md`)).trim().split("\n\n");
  const told = blocks.filter(block => !block.startsWith("    ") || /\S {4,}\S/.test(block));
  return [head.replace(/^# \d+\. /, ""), ...told, ...[...(folder.endsWith("/edu") ? "" : read(`${folder}/robot.test`)).matchAll(/^test "([^"]*)"/gm)].map(([, title]) => title)];
}));
for (const text of needed) if (!keys.lessons.includes(text)) trouble("lessons", `nobody has translated: ${text}`);
for (const text of keys.lessons) if (!needed.has(text)) trouble("lessons", `no lesson says: ${text}`);

// ---- the page and the blocks: every key occurs in a source (for findings see tests/slips) ----
const sources = folder => readdirSync(join(root, folder), { withFileTypes: true }).filter(one => one.isFile() && /\.(m?js|html|cpp|h|def)$/.test(one.name)).map(one => read(`${folder}/${one.name}`));
const source = ["playground", "playground/page", "playground/page/blocks", "playground/page/edu", "playground/edu", "report", "report/page", "run", "base", "spec", "structured/text", "testing", "testing/verdicts", "cli/input", "disk"].flatMap(sources).join("\n");
const pieces = key => key.replace(/^1 /, "").split(/\{\w+\}/).map(piece => piece.replace(/^[^\p{L}]+|[^\p{L}]+$/gu, "")).filter(Boolean);
/** Sentences of verdicts are put together from smaller pieces than those between holes: `1 test` and `passed`. */
const words = key => pieces(key).flatMap(piece => piece.split(/[^\p{L}]+/u)).filter(Boolean);
for (const section of ["page", "phrases", "blocks", "verdicts"])
  for (const key of keys[section])
    for (const piece of section === "verdicts" ? words(key) : pieces(key)) if (!source.includes(piece)) trouble(section, `no source says “${piece}”: ${key}`);

// ---- the rules by which texts of the page are found ----
const { texts, said, cases } = JSON.parse(read("tests/translations/cases.json"));
const find = make_catalogue({ page: texts }, new Map(Object.entries(said)));
for (const [english, expected] of cases) if ((find(english) ?? null) !== expected) trouble("catalogue.js", `“${english}” is said “${find(english)}”, not “${expected}”`);

for (const one of troubles) console.log(one);
const total = sections.reduce((sum, section) => sum + keys[section].length, 0);
console.log(troubles.length ? `${troubles.length} mistakes` : `${files.length} languages, ${total} texts each: all there`);
process.exit(troubles.length ? 1 : 0);
