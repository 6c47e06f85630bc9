// Checks a Sphero Edu program: syntax errors, unknown names, values that a call does not take, missing `await`s, and what
// the robot lacks. Uses a real parser and the table of the API (engine method `edu`).
import { parse } from "acorn";

import { mend } from "./mend.js";
import { near } from "./near.js";
import { awaits, below, children, is_loop, nodes } from "./prepare.js";
import { fill, texts } from "./texts.js";

const longest_source = 1_000_000; // characters
const most_findings = 100;

const options = { ecmaVersion: "latest", sourceType: "script", locations: true, allowHashBang: true };
/** Parses a program into a tree; throws acorn's errors. */
export const tree_of = source => parse(source, options);

const is_function = node => /Function/.test(node.type);
/** Names that exist in the sandbox besides the table's functions and objects. */
const built_in = new Set(`Array BigInt Boolean Date Error EvalError Function Infinity JSON Map Math NaN Number Object Promise Proxy RangeError ReferenceError
  Reflect RegExp Set String Symbol SyntaxError TypeError URIError WeakMap WeakSet arguments console decodeURI decodeURIComponent encodeURI
  encodeURIComponent eval globalThis isFinite isNaN parseFloat parseInt undefined setTimeout setInterval clearTimeout clearInterval performance
  print EventType escape unescape`.split(/\s+/));

/** The finding that keeps a program from running; undefined if there is none. */
export const obstacle_in = findings => findings.find(({ rule }) => ["syntax", "too-long", "no-start"].includes(rule));

/** Findings of a program, in the order of its text: [{rule, severity, line, column, end_line, end_column, message, help, fix?}],
 *  lines and columns from 1, columns in UTF-16. `kind` is orb's name for the robot; without it, what the robot lacks is not
 *  checked. `say(text, holes)` puts a text of texts.js into another language. */
export function check(source, { table, kind = "", say = fill } = {}) {
  const findings = [];
  const lines = source.slice(0, longest_source).split("\n");
  function add(rule, severity, from, to, [text, holes = {}], [help, help_holes = {}] = [], fix) {
    if (findings.length >= most_findings) return;
    findings.push({ rule, severity, line: from.line, column: from.column + 1, end_line: to.line, end_column: to.column + 1,
      message: say(text, holes), help: help ? say(help, help_holes) : "", ...fix ? { fix: { title: say(help, help_holes), ...fix } } : {} });
  }
  const whole_line = line => [{ line, column: 0 }, { line, column: Math.max(1, (lines[line - 1] ?? "").length) }];

  if (source.length > longest_source) {
    add("too-long", "error", ...whole_line(1), [texts.TooLong, { n: longest_source }]);
    return findings;
  }
  let tree;
  try {
    tree = tree_of(source);
  } catch (error) {
    if (!error.loc) {
      add("syntax", "error", ...whole_line(1), [texts.TooDeep]);
      return findings;
    }
    const mended = mend(source, error, tree_of);
    const help = !mended ? [] : mended.below ? [texts.WriteBelow, { line: mended.below }] : mended.line.trim() ? [texts.WriteLine, { line: mended.line.trim() }] : [texts.DeleteLine];
    const place = mended?.place ?? error.loc, end = { line: place.line, column: Math.min(place.column + 1, Math.max(place.column, (lines[place.line - 1] ?? "").length)) };
    add("syntax", "error", place, end.column > place.column ? end : { line: place.line, column: place.column + 1 }, mended?.why ?? why_not(error),
      help, mended && { line: mended.at, text: mended.line });
    return findings;
  }

  const program = read(tree, table);
  const at = { ...program, tree, table, kind, lines, source, add, whole_line };
  for (const finder of finders) finder(at);
  return findings.sort((a, b) => a.line - b.line || a.column - b.column);
}

/** The text for acorn's message: a specific one for frequent errors. */
function why_not({ message }) {
  const plain = message.replace(/ \(\d+:\d+\)$/, "");
  const declared = /^Identifier '(.+)' has already been declared$/.exec(plain);
  if (declared) return [texts.DeclaredTwice, { name: declared[1] }];
  if (/Cannot use keyword 'await'|await.*async/.test(plain)) return [texts.AwaitOutside];
  if (/^Unterminated string/.test(plain)) return [texts.OpenString];
  if (/^Unterminated comment/.test(plain)) return [texts.OpenComment];
  if (/^'return' outside of function/.test(plain)) return [texts.ReturnOutside];
  return [texts.NoJavaScript];
}

/** Collects what a program declares, sets, uses and calls. */
function read(tree, table) {
  const functions = new Map(table.functions.map(row => [row.name, row]));
  const declared = new Set(), set = new Set(), uses = [], calls = [], own = new Map(), starts = [];
  const parents = new Map();
  const declare = pattern => {
    const left = [pattern];
    while (left.length) {
      const one = left.pop();
      if (!one) continue;
      if (one.type === "Identifier") declared.add(one.name);
      else if (one.type === "Property") left.push(one.value);
      else if (one.type === "AssignmentPattern") left.push(one.left);
      else if (one.type === "RestElement") left.push(one.argument);
      else if (one.type === "ArrayPattern" || one.type === "ObjectPattern") left.push(...children(one));
    }
  };
  const left = [[tree, null, null]];
  while (left.length) {
    const [node, parent, inside] = left.pop();
    parents.set(node, parent);
    let within = inside;
    if (is_function(node)) {
      within = node;
      if (node.id) declared.add(node.id.name);
      node.params.forEach(declare);
      if (node.type === "FunctionDeclaration") {
        own.set(node.id.name, node);
        if (node.id.name === "startProgram") starts.push(node);
      }
    } else if (node.type === "ClassDeclaration" || node.type === "ClassExpression") {
      if (node.id) declared.add(node.id.name);
    } else if (node.type === "VariableDeclarator") {
      declare(node.id);
      if (node.id.type === "Identifier" && node.init && is_function(node.init)) {
        own.set(node.id.name, node.init);
        if (node.id.name === "startProgram") starts.push(node.init);
      }
    } else if (node.type === "CatchClause") declare(node.param);
    else if (node.type === "AssignmentExpression" && node.left.type === "Identifier") set.add(node.left.name);
    else if ((node.type === "ForInStatement" || node.type === "ForOfStatement") && node.left.type === "Identifier") set.add(node.left.name);
    else if (node.type === "CallExpression" && node.callee.type === "Identifier") calls.push({ node, name: node.callee.name, within });
    else if (node.type === "Identifier" && is_use(node, parent)) uses.push({ node, name: node.name, within });
    for (const one of children(node)) left.push([one, node, within]);
  }
  const by_place = (a, b) => a.node.start - b.node.start;
  uses.sort(by_place);
  calls.sort(by_place);
  return { functions, declared, set, uses, calls, own, starts, parents };
}

function is_use(node, parent) {
  switch (parent?.type) {
    case "MemberExpression": return parent.object === node || parent.computed;
    case "Property": return parent.value === node || parent.computed;
    case "MethodDefinition": case "PropertyDefinition": return parent.computed && parent.key === node;
    case "LabeledStatement": case "BreakStatement": case "ContinueStatement": case "MetaProperty": return false;
    default: return true;
  }
}

const named = names => names.map(name => `\`${name}\``).join(", ");
const text_of = (source, node) => source.slice(node.start, node.end);
/** The line of a node, with `words` in place of the node; undefined if the node spans several lines. */
function line_with({ lines }, node, words) {
  if (node.loc.start.line !== node.loc.end.line) return undefined;
  const line = lines[node.loc.start.line - 1];
  return line.slice(0, node.loc.start.column) + words + line.slice(node.loc.end.column);
}
function offer(at, node, words) {
  const line = line_with(at, node, words);
  return line === undefined ? [[]] : [[texts.WriteLine, { line: line.trim() }], { line: node.loc.start.line, text: line }];
}

/** The value of a number; undefined for other expressions. */
function constant(node) {
  if (node.type === "Literal" && typeof node.value === "number") return node.value;
  if (node.type === "UnaryExpression" && node.operator === "-") {
    const value = constant(node.argument);
    return value === undefined ? undefined : -value;
  }
  return undefined;
}

const finders = [
  /** Names that are declared nowhere. */
  function unknown_names(at) {
    const { uses, declared, set, functions, table, own, add, parents } = at;
    const objects = table.objects.map(one => one.name);
    const all = [...functions.keys(), ...objects, "EventType", "startProgram", ...declared, ...set];
    const told = new Set(), old = Object.fromEntries(Object.entries(table.old_names).map(([name, now]) => [name.toLowerCase(), now]));
    for (const { node, name } of uses) {
      if (declared.has(name) || set.has(name) || functions.has(name) || objects.includes(name) || built_in.has(name) || told.has(name)) continue;
      const parent = parents.get(node);
      if (parent?.type === "UnaryExpression" && parent.operator === "typeof") continue;
      told.add(name);
      at.lacks_names = true;
      const now = old[name.toLowerCase()], called = parent?.type === "CallExpression" && parent.callee === node;
      const meant = now ?? near(name, called ? [...functions.keys(), ...own.keys(), ...declared] : all);
      add(called ? "unknown-function" : "unknown-name", "error", node.loc.start, node.loc.end, [called ? texts.NoFunction : texts.NoName, { name }],
        ...meant ? offer(at, node, meant) : [[]]);
    }
  },
  /** Unknown members of EventType and other objects, and of what functions return. */
  function unknown_members(at) {
    const { tree, table, functions, add, kind, declared } = at;
    const objects = new Map([["EventType", table.events.map(one => one.name)], ...table.objects.filter(one => one.members.length).map(one => [one.name, one.members])]);
    const parts = { color: ["r", "g", "b"], point: ["x", "y"], vector: ["x", "y", "z"], angles: ["pitch", "roll", "yaw"], motors: ["left", "right"] };
    for (const node of nodes(tree)) {
      if (node.type !== "MemberExpression" || node.computed || node.property.type !== "Identifier") continue;
      const { object, property } = node;
      const members = object.type === "Identifier" && !declared.has(object.name) ? objects.get(object.name)
        : object.type === "CallExpression" && object.callee.type === "Identifier" && !declared.has(object.callee.name) ? parts[functions.get(object.callee.name)?.gives] : undefined;
      if (!members) continue;
      const of = object.type === "Identifier" ? object.name : `${object.callee.name}()`;
      if (!members.includes(property.name)) {
        const meant = near(property.name, members) ?? { red: "r", green: "g", blue: "b" }[property.name];
        add("unknown-member", of === "MatrixRotation" || of === "FrameRotation" ? "warning" : "error", property.loc.start, property.loc.end, [texts.NoMember, { name: of, member: property.name }],
          ...meant && members.includes(meant) ? offer(at, property, meant) : [[texts.ItHas, { names: named(members) }]]);
      } else if (of === "EventType" && kind) {
        const event = table.events.find(one => one.name === property.name);
        if (!event.robots.includes(kind)) lacks(at, property, property.name, event.robots);
      }
    }
  },
  /** The number, kind and range of the values of a call. */
  function values(at) {
    const { calls, functions, declared, add, kind } = at;
    for (const { node, name } of calls) {
      const row = functions.get(name);
      if (!row || declared.has(name)) continue;
      if (kind && !row.robots.includes(kind)) lacks(at, node.callee, name, row.robots);
      const given = node.arguments;
      if (given.some(one => one.type === "SpreadElement")) continue;
      const { operands } = row, needed = operands.filter(one => one.presence === "required"), rest = operands.some(one => one.presence === "rest");
      const color_at = operands.findIndex(one => one.type === "color");
      // Three numbers instead of a colour.
      if (color_at >= 0 && given.length === operands.length + 2 && given.slice(color_at, color_at + 3).every(one => constant(one) !== undefined)) {
        const [r, g, b] = given.slice(color_at, color_at + 3).map(constant);
        const others = [...given.slice(0, color_at).map(one => text_of(at.source, one)), `{ r: ${r}, g: ${g}, b: ${b} }`, ...given.slice(color_at + 3).map(one => text_of(at.source, one))];
        add("wrong-value", "error", given[color_at].loc.start, given[color_at + 2].loc.end, [texts.TakesColor, { name, operand: operands[color_at].name }], ...offer(at, node, `${name}(${others.join(", ")})`));
        continue;
      }
      if (given.length < needed.length) {
        add("missing-value", "warning", node.loc.start, node.loc.end, [texts.TooFew, { name, names: named(needed.slice(given.length).map(one => one.name)) }], [texts.Like, { example: row.example }]);
      } else if (!rest && given.length > operands.length && !(name === "speak" || name === "exitProgram")) {
        add("extra-value", "warning", given[operands.length].loc.start, given.at(-1).loc.end, operands.length ? [texts.TooMany, { name, n: operands.length }] : [texts.TakesNone, { name }], [texts.Like, { example: row.example }]);
      }
      for (const [i, operand] of operands.entries()) if (given[i] && operand.presence !== "rest") value(at, row, operand, given[i]);
    }
  },
  /** Calls that take time and are not awaited. */
  function missing_await(at) {
    const { calls, functions, declared, own, parents, add } = at;
    for (const { node, name, within } of calls) {
      const parent = parents.get(node);
      if (parent?.type !== "ExpressionStatement") continue;
      const row = declared.has(name) ? undefined : functions.get(name), mine = own.get(name);
      const takes_time = row ? row.kind === "awaited" && waits(row, node) : mine?.async && below(mine, awaits);
      if (!takes_time || name === "startProgram") continue;
      if (within?.async) add("missing-await", "warning", node.loc.start, node.callee.loc.end, [texts.NoAwait, { name }], ...offer(at, node, `await ${text_of(at.source, node)}`));
      else if (within && row) add("missing-await", "warning", node.loc.start, node.callee.loc.end, [texts.NotAsync, { name, function: within.id?.name ?? "function" }], [texts.WriteAsync]);
    }
  },
  /** Functions that are named but not called. */
  function not_called(at) {
    const { tree, functions, own, add } = at;
    for (const node of nodes(tree)) {
      if (node.type !== "ExpressionStatement" && node.type !== "AwaitExpression") continue;
      const named_only = node.expression ?? node.argument;
      if (named_only?.type === "Identifier" && (functions.has(named_only.name) || own.has(named_only.name)))
        add("not-called", "warning", named_only.loc.start, named_only.loc.end, [texts.NotCalled, { name: named_only.name }], ...offer(at, named_only, `${named_only.name}()`));
    }
  },
  /** Loops that never end because no time passes in them. */
  function endless(at) {
    const { tree, add, functions } = at;
    const left = [[tree, null]];
    while (left.length) {
      const [node, within] = left.pop();
      for (const one of children(node)) left.push([one, is_function(node) ? node : within]);
      if (!is_loop(node) || node.type === "ForInStatement" || node.type === "ForOfStatement") continue;
      const test = node.test;
      const always = !test || test.type === "Literal" && !!test.value;
      const senses = test && [test, ...all_below(test)].some(one => one.type === "CallExpression" && one.callee.type === "Identifier" && functions.get(one.callee.name)?.group === "sensors" && !["getSpeed", "getHeading"].includes(one.callee.name));
      if (!always && !senses) continue;
      if (below(node, one => awaits(one) || one.type === "ReturnStatement" || one.type === "ThrowStatement" || one.type === "BreakStatement" || one.type === "YieldExpression"
        || one.type === "CallExpression" && one.callee.name === "exitProgram")) continue;
      const end = { line: node.loc.start.line, column: Math.max(node.loc.start.column + 1, (at.lines[node.loc.start.line - 1] ?? "").trimEnd().length) };
      add("no-time-passes", "warning", node.loc.start, end, [texts.NoTime], [texts.AddDelay]);
    }
  },
  /** Where the program starts, and whether it drives or ends at once. */
  function start(at) {
    const { starts, own, set, declared, add, whole_line, calls, functions, lines } = at;
    if (starts.length > 1) {
      const again = starts.sort((a, b) => a.start - b.start).at(-1);
      add("second-start", "warning", again.loc.start, { line: again.loc.start.line, column: again.loc.start.column + 1 }, [texts.TwoStarts]);
    }
    if (!starts.length && !set.has("startProgram") && !declared.has("startProgram")) {
      const meant = near("startProgram", [...own.keys()]), place = meant && own.get(meant);
      const last = lines.findIndex(line => line.trim()) + 1 || 1;
      const [from, to] = place?.id ? [place.id.loc.start, place.id.loc.end] : whole_line(last);
      add("no-start", "error", from, to, [texts.NoStart], ...place?.id ? offer(at, place.id, "startProgram") : [[texts.WriteLine, { line: "async function startProgram() {" }]]);
      return;
    }
    const drives = calls.some(({ name }) => functions.get(name)?.group === "movement" && !["setStabilization", "resetAim", "calibrateCompass", "stopRoll"].includes(name) || /^(start|stop)IR/.test(name))
      || at.uses.some(({ name }) => name === "Animation");
    // The program ends right after setting a speed, and no event or timer keeps it going.
    const last = starts[0]?.body.body?.at(-1), call = last?.type === "ExpressionStatement" && (last.expression.argument ?? last.expression);
    if (call?.type === "CallExpression" && call.callee.name === "setSpeed" && constant(call.arguments[0]) && !calls.some(({ name }) => /^registerEvent|^set(Interval|Timeout)$/.test(name)))
      add("ends-at-once", "warning", call.loc.start, call.loc.end, [texts.EndsAtOnce], [texts.WaitBelow]);
    if (!drives && starts[0] && !at.lacks_names) add("never-drives", "info", starts[0].loc.start, { line: starts[0].loc.start.line, column: starts[0].loc.start.column + 1 }, [texts.NeverDrives]);
  },
];

function all_below(node) {
  const all = [], left = children(node);
  while (left.length) {
    const one = left.pop();
    all.push(one);
    left.push(...children(one));
  }
  return all;
}

/** True if a call takes time; some do only if `wait` is `true`. */
function waits(row, node) {
  const at = row.operands.findIndex(one => one.name === "wait");
  if (at < 0) return true;
  const given = node.arguments[at];
  return given?.type === "Literal" && given.value === true;
}

function lacks(at, node, name, robots) {
  const { table, kind, add } = at, told = at.told ??= new Set();
  if (told.has(name)) return;
  told.add(name);
  const title = one => table.robots.find(row => row.name === one)?.title ?? one;
  add("robot-lacks", "warning", node.loc.start, node.loc.end, [texts.Lacks, { robot: title(kind), name }], [texts.Have, { robots: robots.map(title).join(", ") }]);
}

function value(at, { name, example }, operand, node) {
  const { add } = at, { type } = operand;
  const is = constant(node);
  const kind_of = is !== undefined ? "number" : node.type === "Literal" ? typeof node.value : node.type === "ObjectExpression" ? "object" : node.type === "ArrayExpression" ? "array" : /Function/.test(node.type) ? "function" : "";
  const wants = { number: ["number"], whole: ["number"], bool: ["boolean", "number"], color: ["object"], point: ["object"], "color or number": ["object", "number"], text: ["string", "number"], function: ["function"], picture: ["object"] }[type];
  if (wants && kind_of && !wants.includes(kind_of)) {
    // A number in quotes counts as a number.
    if (!(wants.includes("number") && kind_of === "string" && node.value.trim() !== "" && Number.isFinite(+node.value)))
      return add("wrong-value", "warning", node.loc.start, node.loc.end, [texts.WrongKind, { name, operand: operand.name }], [texts.Like, { example }]);
  }
  const range = (number, place, what) => {
    if (operand.most > operand.least && (number < operand.least || number > operand.most) && operand.unit !== "degrees")
      add("out-of-range", "warning", place.loc.start, place.loc.end, [texts.OutOfRange, { operand: what, least: operand.least, most: operand.most, value: number }],
        ...offer(at, place, String(Math.min(Math.max(number, operand.least), operand.most))));
  };
  if (is !== undefined && ["number", "whole", "color or number"].includes(type)) range(is, node, operand.name);
  if (type === "text" && kind_of === "string" && operand.most > 0 && node.value.length > operand.most)
    add("out-of-range", "warning", node.loc.start, node.loc.end, [texts.TooLongText, { operand: operand.name, n: operand.most }]);
  if (kind_of === "object" && ["color", "point", "color or number"].includes(type)) parts(at, operand, type === "point" ? ["x", "y"] : ["r", "g", "b"], node, range);
}

/** Checks the parts of a colour or a point. */
function parts(at, operand, names, node, range) {
  const given = new Map();
  for (const one of node.properties) {
    if (one.type !== "Property" || one.computed) return;
    const key = one.key.name ?? String(one.key.value);
    given.set(key, one);
    if (!names.includes(key)) {
      const meant = near(key, names) ?? { red: "r", green: "g", blue: "b" }[key.toLowerCase()] ?? (names.includes(key.toLowerCase()) ? key.toLowerCase() : undefined);
      at.add("unknown-part", "warning", one.key.loc.start, one.key.loc.end, [texts.NoPart, { operand: operand.name, part: key, names: named(names) }],
        ...meant && !given.has(meant) && !node.properties.some(other => other.key?.name === meant) ? offer(at, one.key, meant) : [[]]);
    } else {
      const number = constant(one.value);
      if (number !== undefined) range(number, one.value, key);
    }
  }
  const missing = names.filter(name => !given.has(name));
  if (missing.length && missing.length < names.length && given.size < names.length)
    at.add("missing-part", "warning", node.loc.start, node.loc.end, [texts.PartMissing, { operand: operand.name, names: named(missing) }]);
}
