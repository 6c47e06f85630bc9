// Finds the line to write in a program that does not parse: tries small changes where the parser gave up, and just before,
// until one parses or gets the parser further.
import { tokenizer } from "acorn";

import { texts } from "./texts.js";

const near_before = 2;      // lines
const most_trials = 400;
const most_characters = 200_000; // longer programs are not mended: each trial parses all of it
const curly = /[“”„«»‘’‚]/g;

/** Where the parser gives up on a text; Infinity if it parses. */
function reach(text, parse) {
  try {
    parse(text);
    return Infinity;
  } catch (error) {
    return error.pos ?? -1;
  }
}

/** The line to write instead: {at: its number, line: its text, why: [text, holes], place}; undefined if none was found. */
export function mend(source, error, parse) {
  if (source.length > most_characters) return undefined;
  const lines = source.split("\n"), failed = Math.min(error.loc.line, lines.length);
  let trials = 0, best;
  const starts = [0];
  for (const line of lines) starts.push(starts.at(-1) + line.length + 1);
  const end = starts[failed - 1] + lines[failed - 1].length;
  function attempt(number, line, why, column = 0) {
    if (best?.reach === Infinity || trials++ > most_trials || line === lines[number - 1]) return;
    const text = [...lines.slice(0, number - 1), line, ...lines.slice(number)].join("\n");
    const far = reach(text, parse);
    // The parser must get past the line on which it gave up.
    if (far === Infinity || far > end + 1 + (text.length - source.length) && far > (best?.reach ?? -1)) best = { reach: far, at: number, line, why, place: { line: number, column } };
  }
  const conflict = lines.findIndex(line => /^(<{7}|={7}|>{7}|\|{7})( |$)/.test(line));
  if (conflict >= 0) return { at: conflict + 1, line: "", why: [texts.Conflict], place: { line: conflict + 1, column: 0 } };
  if (source.slice(error.pos).trim() === "") {
    const closed = close(source, lines, parse);
    if (closed) return closed;
  }
  if (/await/.test(error.message) || /\bawait\b/.test(lines[failed - 1].slice(0, error.loc.column))) {
    // The nearest function above that is not async.
    for (let number = failed; number >= 1; --number) {
      const line = lines[number - 1], found = /\bfunction\b/.exec(line);
      if (found && !/async\s+function/.test(line)) attempt(number, line.slice(0, found.index) + "async " + line.slice(found.index), [texts.AwaitOutside], found.index);
      if (/=>/.test(line)) attempt(number, line.replace(/(\([^()]*\)|\w+)\s*=>/, "async $&"), [texts.AwaitOutside]);
      if (found) break;
    }
    if (best) return { ...best, place: { line: failed, column: error.loc.column } };
  }
  const twice = /^Identifier '(.+)' has already been declared/.exec(error.message);
  if (twice) {
    attempt(failed, lines[failed - 1].replace(/\b(let|const|var)\s+/, ""), [texts.DeclaredTwice, { name: twice[1] }], error.loc.column);
    return best;
  }
  // Frequent slips, such as `=>` for `>=`.
  const rewrites = [[/=>/g, ">=", ">="], [/=</g, "<=", "<="], [/^(\s*(?:await\s+)?\w+)\s*(\{.*\})\s*;?\s*$/, "$1($2);", "("], [/(\w)\(\s*((?:[rgbxy]\s*:[^{}()]*)+)\)/g, "$1({ $2 })", "{"],
    [/\b(if|while)\s+([^({][^{]*?)\s*\{/, "$1 ($2) {", "("]];
  for (const [wrong, right, sign] of rewrites) {
    const found = lines[failed - 1].search(wrong);
    if (found >= 0) attempt(failed, lines[failed - 1].replace(wrong, right), [texts.SignMissing, { sign }], Math.max(found, error.loc.column - 1));
  }
  // A function, loop or `if` without its brace.
  for (let number = failed; number >= Math.max(1, failed - 1); --number) {
    const line = lines[number - 1].trimEnd();
    if (/^\s*(async\s+)?(function|if|for|while|else)\b.*[)e]$/.test(line)) attempt(number, `${line} {`, [texts.SignMissing, { sign: "{" }], Math.max(0, line.length - 1));
  }
  for (let number = failed; number >= Math.max(1, failed - near_before); --number) {
    const line = lines[number - 1], here = number === failed ? Math.min(error.loc.column, line.length) : line.trimEnd().length;
    if (curly.test(line)) attempt(number, line.replace(/[‘’‚]/g, "'").replace(/[“”„«»]/g, '"'), [texts.WrongQuotes], line.search(curly));
    // A misspelled or capitalised keyword.
    const words = [[/\b(Async|ASYNC|asyc|aysnc|asnyc)\b/g, "async"], [/\b(Await|AWAIT|awiat|awit|awair)\b/g, "await"], [/\b(Function|funtion|fuction|funciton|functon)\b/g, "function"],
      [/\bElse\b/g, "else"], [/\bIf\b/g, "if"], [/\bWhile\b/g, "while"], [/\bFor\b/g, "for"], [/\bLet\b/g, "let"], [/\bVar\b/g, "var"], [/\bConst\b/g, "const"], [/\belif\b|\belseif\b|\bElse If\b/g, "else if"],
      [/\bsync function/g, "async function"]];
    for (const [wrong, right] of words) if (wrong.test(line)) attempt(number, line.replace(wrong, right), [texts.WordMissing, { word: right }], Math.max(0, line.search(wrong)));
    const whole = line.trimEnd(), comment = /\/\//.exec(whole);
    const ends = comment ? whole.slice(0, comment.index).trimEnd() : whole, tail = comment ? line.slice(ends.length) : "";
    // An extra sign where the parser stopped, or one missing there or at the line's end.
    if (number === failed && /[)\]};,]/.test(line[here] ?? "")) attempt(number, line.slice(0, here) + line.slice(here + 1), [texts.TooManySigns, { sign: line[here] }], here);
    const before = line.slice(0, here).trimEnd().length, brace = /\s*\{$/.exec(ends);
    const places = [...new Set([ends.length, before, ...brace ? [brace.index] : [], here, ...number === failed ? [...line.matchAll(/[\s(){};,]/g)].map(found => found.index).filter(i => Math.abs(i - here) < 12) : []])];
    const next = line.slice(here).trimStart()[0] ?? "", last = line.slice(0, here).trimEnd().at(-1) ?? "";
    if (number === failed && last === ")" && /[\w$]/.test(next)) attempt(number, `${line.slice(0, before)};${line.slice(before)}`, [texts.SignMissing, { sign: ";" }], before);
    for (const sign of [")", "}", "{", "]", ",", ";", ")}", "))", "})", "(", '"', "'", "`", ":", "+"])
      for (const place of sign === "}" ? [here, ...places] : places) {
        // A comma separates values, never a name from its arguments.
        if (sign === "," && (!/[\w$)}\]"'`]/.test(line.slice(0, place).trimEnd().at(-1) ?? "") || /^[({[=.]|^$/.test(line.slice(place).trimStart()[0] ?? ""))) continue;
        const text = place === ends.length ? ends + sign + tail : line.slice(0, place) + sign + line.slice(place);
        attempt(number, text, [texts.SignMissing, { sign }], Math.max(0, Math.min(place, line.length) - (place === line.length ? 1 : 0)));
        if (sign === ")" || sign === "})") attempt(number, place === ends.length ? ends.replace(/;$/, "") + sign + ";" + tail : text, [texts.SignMissing, { sign }], Math.max(0, ends.length - 1));
      }
    // An extra sign, or a wrong one.
    for (let i = Math.max(0, here - 12); i < Math.min(line.length, here + 12); ++i) {
      const sign = line[i];
      if (/[(){}\][,;:.="'`+]/.test(sign)) attempt(number, line.slice(0, i) + line.slice(i + 1), [texts.TooManySigns, { sign }], i);
      if (sign === ";" || sign === ".") attempt(number, `${line.slice(0, i)},${line.slice(i + 1)}`, [texts.SignMissing, { sign: "," }], i);
      if (sign === ",") attempt(number, `${line.slice(0, i)};${line.slice(i + 1)}`, [texts.SignMissing, { sign: ";" }], i);
      if (sign === "=") attempt(number, `${line.slice(0, i)}:${line.slice(i + 1)}`, [texts.SignMissing, { sign: ":" }], i);
      if (sign === "[" || sign === "(") attempt(number, `${line.slice(0, i)}{${line.slice(i + 1)}`, [texts.SignMissing, { sign: "{" }], i);
      if (sign === "]" || sign === ")") attempt(number, `${line.slice(0, i)}}${line.slice(i + 1)}`, [texts.SignMissing, { sign: "}" }], i);
      if (sign === "}" || sign === "]") attempt(number, `${line.slice(0, i)})${line.slice(i + 1)}`, [texts.SignMissing, { sign: ")" }], i);
    }
  }
  if (!best) {
    const closed = close(source, lines, parse);
    if (closed) return closed;
    attempt(failed, lines[failed - 1].replace(/\}\s*;?\s*$/, ""), [texts.TooManySigns, { sign: "}" }], error.loc.column);
    attempt(failed, "", [texts.NoJavaScript], 0);
  }
  return best;
}

/** The lines of the braces that are still open: at the end, and before each line. */
function open_braces(source, lines) {
  const open = [], before = Array.from(lines, () => []);
  let line = 1;
  try {
    for (const token of tokenizer(source, { ecmaVersion: "latest", locations: true })) {
      for (; line < token.loc.start.line; ++line) before[line] = [...open];
      if (token.type.label === "{" || token.type.label === "${") open.push(token.loc.start.line);
      else if (token.type.label === "}") open.pop();
    }
  } catch { /* keep what was read so far */ }
  for (; line < lines.length; ++line) before[line] = [...open];
  return { open, before };
}

/** Closes open braces: before the next function, or at the end. */
function close(source, lines, parse) {
  const { open, before } = open_braces(source, lines);
  const insert = (number, text, from) => { // below that line
    const at = lines.slice(0, number).findLastIndex(line => line.trim()) + 1 || 1;
    if (reach([...lines.slice(0, at), text, ...lines.slice(at)].join("\n"), parse) !== Infinity) return undefined;
    return { at, line: `${lines[at - 1]}\n${text}`, below: text, why: [texts.NeverClosed, { n: from }], place: { line: at, column: Math.max(0, lines[at - 1].trimEnd().length - 1) } };
  };
  let trials = 0;
  for (let number = 1; number < lines.length && trials < 20; ++number)
    if (before[number].length && /^(async\s+)?function\b|^registerEvent/.test(lines[number])) {
      ++trials;
      const closed = insert(number, "}".repeat(before[number].length), before[number].at(-1));
      if (closed) return closed;
    }
  return open.length && open.length <= 20 ? insert(lines.length, "}".repeat(open.length), open[0]) : undefined;
}
