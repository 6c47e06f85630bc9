// Converts the rows of the engine's `tree` to blocks.

import { hold, is_roll, levels, sign_of, type_of, without_sign } from "./kinds.js";
import { remember } from "./write.js";

/** More would be slow to draw. */
export const most_rows = 1000;

const number_state = text => ({ type: "number", fields: { TEXT: text } });
const zero = { shadow: number_state("0") };

/** The state of a value in a place where parts must bind at least as `least`. */
function value_state(node, least = levels.any) {
  const { kind, text, operands = [], groups = 0 } = node;
  if (kind === "negate" && operands[0].kind === "number" && !operands[0].groups)
    return value_state({ kind: "number", text: `-${operands[0].text}`, groups }, least);
  const { own, parts } = hold(kind, text);
  const state = { type: kind, fields: kind === "negate" || kind === "not" ? {} : { TEXT: text }, inputs: {} };
  operands.forEach((operand, i) => { state.inputs[`A${i}`] = input_state(operand, parts[i]); });
  // Required parentheses are written anyway.
  return { ...state, ...extra({ groups: groups - (own < least ? 1 : 0) || undefined, n: kind === "call" || kind === "builtin" ? operands.length : undefined }) };
}
/** A number is a shadow block; any other value lies on top of one. */
function input_state(node, least) {
  const state = value_state(node, least);
  return state.type === "number" && !state.extraState ? { shadow: state } : { block: state, ...zero };
}
function extra(memory) {
  const own = Object.fromEntries(Object.entries(memory).filter(([, one]) => one !== undefined && one !== false));
  return Object.keys(own).length ? { extraState: own } : {};
}

/** The state of a statement's block, without the blocks inside it. */
function statement_state(row) {
  const { kind, items = [], name } = row;
  const state = { type: type_of(row), fields: {}, inputs: {} }, memory = {};
  const put = (input, { value }) => { state.inputs[input] = input_state(value); };
  switch (kind) {
    case "robot":
      if (state.type === "colour") {
        memory.mixed = items[0].kind === "colour" || undefined;
        state.fields.TEXT = items[0].text ?? items[0].value.text;
        break;
      }
      memory.n = items.length;
      memory.roll = is_roll(row) || undefined;
      if (memory.roll) state.fields.GO = items[2].value.text;
      items.slice(0, memory.roll ? 2 : items.length).forEach((item, i) => {
        if (item.kind === "place") state.inputs[`A${i}`] = { block: value_state(item.value), shadow: { type: "name", fields: { TEXT: "n" } } };
        else put(`A${i}`, item.kind === "restart" ? { value: { kind: "name", text: item.text } } : item);
      });
      break;
    case "assign":
      state.fields = { NAME: items[0].value.text, SIGN: row.sign };
      if (items[0].value.kind === "element") {
        state.type = "assign element";
        state.inputs.INDEX = input_state(items[0].value.operands[0]);
      }
      put("VALUE", items[1]);
      break;
    case "print": {
      const seps = [""];
      for (const item of items)
        if (item.kind === "comma") seps[seps.length - 1] += ",";
        else if (item.kind === "semicolon") seps[seps.length - 1] += ";";
        else {
          const input = `A${seps.length - 1}`, none = { shadow: { type: "string", fields: { TEXT: "" } } };
          if (item.kind === "string") state.inputs[input] = { shadow: { type: "string", fields: { TEXT: item.text.slice(1, -1) } } };
          else if (item.kind === "character") state.inputs[input] = { block: { type: "character", inputs: { A0: input_state(item.value) } }, ...none };
          else state.inputs[input] = { block: value_state(item.value), ...none };
          seps.push("");
        }
      memory.seps = seps;
      break;
    }
    case "const": case "array":
      state.fields.NAME = name;
      put("VALUE", items[0]);
      break;
    case "local":
      state.fields.NAMES = row.text.replace(/^\w+\s+/, "");
      break;
    case "use": case "include":
      state.fields.TEXT = items[0].text.slice(1, -1);
      break;
    case "if": case "while":
      put("COND", items[0]);
      break;
    case "repeat times":
      put("TIMES", items[0]);
      break;
    case "for":
      state.fields.NAME = items[0].value.text;
      put("FROM", items[1]);
      put("TO", items[2]);
      if (items[3]) put("STEP", items[3]);
      memory.step = items.length > 3;
      break;
    case "select":
      put("VALUE", items[0]);
      memory.parts = [];
      break;
    case "sub": case "function":
      state.fields = { NAME: name, NAMES: items.map(({ text }) => text).join(", ") };
      memory.empty = !items.length && row.text.endsWith(")");
      break;
    case "call":
      state.type = "call sub";
      state.fields.NAME = name;
      memory.n = items.length;
      memory.empty = !items.length && row.text?.endsWith(")");
      items.forEach((item, i) => put(`A${i}`, item));
      break;
    case "return":
      memory.n = items.length;
      if (items.length) put("A0", items[0]);
      break;
    case "label": case "goto":
      state.fields.NAME = name;
      break;
    case "comment":
      memory.sign = sign_of(row.text);
      memory.indent = row.indent;
      state.fields.TEXT = without_sign(row.text);
      break;
    case "text":
      memory.lines = row.lines;
      break;
  }
  memory.after_blank = row.after_blank;
  if (row.comment) {
    memory.note = true;
    state.fields.NOTE = row.comment;
  }
  return { ...state, memory };
}

/** Adds a part to an existing block, or ends it. */
function add_part(state, row, i) {
  const { kind, items = [], comment, after_blank } = row;
  if (row.block === "end") {
    state.memory.end = Object.fromEntries(Object.entries({ after_blank, note: !!comment }).filter(([, one]) => one));
    if (kind === "until") state.inputs.COND = input_state(items[0].value);
    if (kind === "next") state.memory.bare = !items.length;
    if (comment) state.fields.NOTEE = comment;
    return;
  }
  const part = { kind };
  if (after_blank) part.after_blank = true;
  if (comment) {
    part.note = true;
    state.fields[`NOTE${i}`] = comment;
  }
  if (kind === "elseif") state.inputs[`COND${i}`] = input_state(items[0].value);
  if (kind === "else" && row.text.startsWith("case")) part.words = "case else";
  if (kind === "case") {
    part.values = [];
    let to = false;
    for (const item of items)
      if (item.kind === "to") to = true;
      else {
        if (!to) part.values.push(1);
        else part.values[part.values.length - 1] = 2;
        state.inputs[`C${i}_${part.values.length - 1}${to ? "T" : ""}`] = input_state(item.value);
        to = false;
      }
  }
  (state.memory.parts ??= []).push(part);
}

/** The rows as trees of states: the main program, and the subs and functions. */
function states_of(rows) {
  const main = [], routines = [], open = [{ list: main }];
  const made = []; // for each state: the rows of its head, its parts and its end
  rows.forEach((row, at) => {
    const around = open.at(-1);
    if (row.block === "part" || row.block === "end") {
      const { state, rows: own } = around;
      if (row.block === "end") {
        own.end = row;
        add_part(state, row);
        open.pop();
      } else {
        add_part(state, row, own.parts.length);
        own.parts.push(row);
        around.list = around.bodies[own.parts.length] = [];
      }
      return;
    }
    const state = { ...statement_state(row), id: `row${at}` };
    const own = { id: state.id, head: row, parts: [] };
    made.push(own);
    if (row.then) {
      state.memory.one_line = true;
      state.inputs.DO = { block: { ...finished(statement_state(row.then)), id: `row${at}t` } };
      if (row.else) {
        state.memory.parts = [{ kind: "else" }];
        state.inputs.DO0 = { block: { ...finished(statement_state(row.else)), id: `row${at}e` } };
      }
    }
    if (row.kind === "sub" || row.kind === "function") {
      state.memory.rank = routines.length;
      take_docs(state, row, main);
      routines.push(state);
    } else {
      if (open.length === 1 && routines.length) state.memory.routines = routines.length;
      around.list.push(state);
    }
    if (row.block === "open") {
      state.bodies = [[]];
      open.push({ state, rows: own, bodies: state.bodies, list: state.bodies[0] });
    }
  });
  return { main, routines, made };
}
/** Comments right above a sub belong to it. */
function take_docs(state, row, main) {
  const docs = [];
  let after_blank = state.memory.after_blank;
  while (!after_blank && main.at(-1)?.type === "comment" && !main.at(-1).memory.indent && (main.at(-1).memory.routines ?? 0) === state.memory.rank) {
    const comment = main.pop();
    docs.unshift(comment.memory.sign + comment.fields.TEXT);
    after_blank = comment.memory.after_blank;
  }
  state.memory.docs = docs.length;
  docs.forEach((text, i) => { state.fields[`DOC${i}`] = text; });
  state.memory.after_blank = after_blank;
}

/** Converts a state with everything inside to Blockly's form. */
function finished(state) {
  const { memory, bodies, ...own } = state;
  if (own.type === "select" && bodies[0].length) memory.before = true;
  bodies?.forEach((list, i) => {
    const first = chain(list);
    if (first) own.inputs[i === 0 ? "DO" : `DO${i - 1}`] = { block: first };
  });
  return { ...own, ...extra(memory) };
}
const chain = list => list.reduceRight((next, state) => ({ ...finished(state), ...next ? { next: { block: next } } : {} }), null);

/** Loads a program into an empty workspace. Returns the block for each line of the text. */
export function load_rows(Blockly, workspace, rows) {
  const { main, routines, made } = states_of(rows);
  const append = state => Blockly.serialization.blocks.append(state, workspace);
  append({ type: "program", id: "program", deletable: false, ...main.length ? { next: { block: chain(main) } } : {} });
  for (const state of routines) append(finished(state));
  const places = new Map();
  for (const { id, head, parts, end } of made) {
    const block = workspace.getBlockById(id);
    for (const row of [head, ...parts, end])
      for (let line = row?.line ?? 1; line <= (row ? row.last ?? row.line : 0); ++line) places.set(line, id);
    remember(block, head, parts, end);
  }
  return places;
}
