// orb-robot test: reads tests and the files they name from disk, and prints the results.
import { readFileSync, readdirSync, statSync } from "node:fs";
import { join, sep } from "node:path";

import { lines_of, test, text_of } from "./edu.js";

const largest = 4_000_000; // bytes of a file
const is_test = name => /\.test$/i.test(name);
const is_program = name => /\.(js|orb|bas|macro)$/i.test(name);
const slashes = name => name.split(sep).join("/");

/** What is at a path: "folder", "file", or "" if nothing can be read. */
function kind_at(path) {
  try {
    const found = statSync(path);
    return found.isDirectory() ? "folder" : found.isFile() && found.size <= largest ? "file" : "";
  } catch {
    return "";
  }
}
function text_at(path) {
  try {
    return kind_at(path) === "file" ? readFileSync(path, "utf8") : undefined;
  } catch {
    return undefined;
  }
}
/** The tests below a folder, except in node_modules. */
function tests_below(folder) {
  return readdirSync(folder, { withFileTypes: true }).flatMap(entry => {
    const path = join(folder, entry.name);
    if (entry.isDirectory()) return entry.name === "node_modules" ? [] : tests_below(path);
    return is_test(entry.name) ? [slashes(path)] : [];
  }).sort();
}

/** The files of a request: those given, and all that they name. */
function gather(call, { names, programs }) {
  const files = Object.fromEntries(names.map(name => [name, text_at(name)])), tried = new Set();
  for (;;) {
    const { missing } = call("missing_files", { files, names, programs });
    const found = missing.filter(name => !tried.has(name)).map(name => [name, text_at(name)]).filter(([, text]) => text !== undefined);
    for (const name of missing) tried.add(name);
    if (!found.length) return files;
    Object.assign(files, Object.fromEntries(found));
  }
}

const column_of = (line, bytes) => Buffer.from(line).subarray(0, bytes - 1).toString().length + 1;
/** Formats findings in tests as `orb check` does. */
function told({ diagnostics }, files) {
  return diagnostics.map(({ file, line, column, endLine, endColumn, ...one }) => {
    const lines = lines_of(files[file] ?? "");
    return text_of(file, lines, { ...one, line, column: column_of(lines[line - 1] ?? "", column), end_line: endLine, end_column: column_of(lines[endLine - 1] ?? "", endColumn) });
  });
}

/** Returns the exit code. `words`: tests, folders and, with `programs`, further programs. `fail(message, code)` exits. */
export async function run_tests({ call, kind, words, programs = [], seeds, only, format = "text", fail }) {
  const further = words.filter(is_program), places = words.filter(word => !is_program(word)), names = [];
  if (further.length && !programs.length) fail(`${further[0]} is a program; name its test, or write --program ${further[0]}`);
  for (const word of places.length ? places : ["."]) {
    if (kind_at(word) === "folder") {
      const found = tests_below(word);
      if (!found.length) fail(`there are no .test files below ${word}`);
      names.push(...found);
    } else if (text_at(word) === undefined) fail(`${word} cannot be read`, 3);
    else names.push(slashes(word));
  }
  const request = { names, programs: [...programs, ...further].map(slashes), only, seeds, format }, files = gather(call, request);
  try {
    const { text, results } = await test({ ...request, files }, { call, kind });
    process.stdout.write(format === "json" ? `${JSON.stringify(results, null, 2)}\n` : text);
    return results.tests.some(({ cases }) => cases.some(({ verdict }) => verdict !== "passed")) ? 1 : 0;
  } catch (error) {
    if (error.name !== "OrbError") throw error;
    if (!error.findings) return fail(error.message, error.code);
    for (const one of told(error.findings, files)) console.error(one);
    return 2;
  }
}
