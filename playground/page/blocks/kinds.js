// The blocks, generated from the tables: how each looks, which names it defines, and what it writes into the text.
// A block is named after what it represents in the engine's tree (playground/README.md).
//
// `memory` of a block holds what it does not show, such as its line's layout or a preceding blank line. An unchanged
// statement is written as it was.

import { t } from "../dom.js";
import { make_fields } from "./fields.js";

/** The drawer of each robot statement; others are in a separate drawer. */
const drawers = { goroll: "drive", raw: "drive", basflg: "drive", heading: "turn", locate: "turn", RGB: "light", LEDC: "light", backLED: "light",
  delay: "wait", sleep: "wait", end: "start", reset: "start", random: "sensors", input: "sensors", print: "print", macrun: "subs", mackill: "subs",
  data: "names", read: "names", rstr: "names", tron: "print", troff: "print" };

/** What a statement of the robot does, as a sentence with holes for its values. */
const sentences = {
  goroll: "drive heading {heading} at speed {speed}", raw: "left motor mode {left_mode} power {left_power}, right motor mode {right_mode} power {right_power}",
  basflg: "set flags {flags}", heading: "call this direction {heading}", locate: "call this place {x} , {y}",
  RGB: "light up: red {red} green {green} blue {blue}", LEDC: "light up in colour {colour}", backLED: "aiming light {brightness}",
  delay: "wait {milliseconds}", sleep: "sleep {seconds} then macro {macro} line {line}", end: "end the program", reset: "start the program again",
  random: "shuffle the random numbers", macrun: "run macro {macro}", mackill: "stop the macro", rstr: "begin the data again",
  tron: "start printing line numbers", troff: "stop printing line numbers", data: "data", read: "read the next into", input: "ask for",
};
/** The verb of a roll, chosen by its last value. */
const rolls = { 1: "drive", 0: "brake", 2: "turn fast" }, any_roll = "{go} heading {heading} at speed {speed}";
/** True if that covers a roll's last value. */
export function is_roll({ word, items }) {
  const last = word === "goroll" && items?.length === 3 ? items[2].value : null;
  return last?.kind === "number" && !last.groups && Object.hasOwn(rolls, last.text);
}

/** Binding strength of operators; a part that binds weaker than its surroundings needs parentheses. */
export const levels = { any: 0, or: 1, and: 2, simple: 3, sum: 5, product: 6, factor: 7, whole: 8 };
/** For a value: how strongly it binds, and how strongly its parts must bind. */
export function hold(kind, text) {
  const pair = (own, right = own + 1) => ({ own, parts: [own, right] });
  switch (kind) {
    case "number": return { own: text.startsWith("-") ? levels.factor : levels.whole, parts: [] };
    case "negate": return { own: levels.factor, parts: [levels.whole] };
    case "operation": return pair("*/%{}".includes(text) ? levels.product : levels.sum);
    case "relation": return { own: levels.simple, parts: [levels.sum, levels.sum] };
    case "not": return { own: levels.simple, parts: [levels.simple] };
    case "logic": return pair(levels[text]);
    default: return { own: levels.whole, parts: [] };
  }
}
const shown_signs = { "-": "−", "*": "×", "/": "÷", "<>": "≠", "!=": "≠", "!": "≠", "==": "=", "<=": "≤", ">=": "≥" };
const look = sign => shown_signs[sign] ?? sign;

const comment_sign = /^(?:'|\/\/|#|rem\b)? ?/i;
export const without_sign = comment => comment.replace(comment_sign, "");
export const sign_of = comment => comment_sign.exec(comment)[0];

/** The type of the block of a statement, or of a value. */
export const type_of = ({ kind, word, items }) => kind === "robot" ? is_one_colour(word, items) ? "colour" : `robot ${word}` : kind;
const is_one_colour = (word, items) => word === "RGB" && items?.length === 1 && (items[0].kind === "colour" || items[0].value?.kind === "name");

export function define_blocks(Blockly, words) {
  const { NumeralField, LongField, CheckedField, ChoiceField, NameField, is_name, list_of_names } = make_fields(Blockly, words);
  const { FieldLabel, FieldImage, Events, inputs: { inputTypes } } = Blockly;
  const word_row = Object.fromEntries([...words.keywords, ...words.functions, ...words.sensors, ...words.statements].map(row => [row.word, row]));
  const kinds = {};
  const text_of = (block, field) => block.getFieldValue(field);

  // ---- building blocks' parts ----
  const condition = ["Boolean", "Any"], anything = ["Any", "Boolean"], item = ["Any", "Boolean", "String"];
  /** A word of the program; all other labels are in the language of the page. */
  const as_is = word => new FieldLabel(word);
  const row = (block, name, ...fields) => {
    const input = block.appendDummyInput(name);
    for (const field of fields) add_field(input, field);
    return input;
  };
  const add_field = (input, field) => Array.isArray(field) ? input.appendField(field[1], field[0]) : input.appendField(typeof field === "string" ? new FieldLabel(t(field)) : field);
  const value = (block, name, check, ...fields) => {
    const input = block.appendValueInput(name).setCheck(check);
    for (const field of fields) add_field(input, field);
    return input;
  };
  /**
   * Adds labels, and in each hole the result of `fill(name, labels)` with the labels before it, in the word order
   * of the page's language.
   */
  function sentence(block, text, fill) {
    let labels = [];
    t(text).split(/\{(\w+)\}/).forEach((piece, i) => {
      if (i % 2) labels = fill(piece, labels);
      else if (piece.trim()) labels.push(as_is(piece.trim()));
    });
    if (labels.length) row(block, "ROW", ...labels);
  }
  const body = (block, name) => block.appendStatementInput(name);
  /** The comment after the statement, if there is one. */
  const note = (block, has, key = "") => {
    if (has) row(block, `NOTES${key}`, [`NOTE${key}`, new LongField("' ")]);
  };
  /** Repeatable parts have buttons. */
  const sign_image = sign => `data:image/svg+xml,${encodeURIComponent(`<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 18 18"><circle cx="9" cy="9" r="8" fill="#fff" fill-opacity=".25"/><path d="${sign === "+" ? "M4 9h10M9 4v10" : "M4 9h10"}" stroke="#fff" stroke-width="2"/></svg>`)}`;
  const step_button = (block, sign, words, change) => new FieldImage(sign_image(sign), 20, 20, words, () => reshape(block, change));
  const steps = (block, { more, less, what }) => {
    if (block.isInFlyout) return;
    const input = row(block, "STEPS");
    if (less) input.appendField(step_button(block, "-", t(`fewer ${what}`), less));
    if (more) input.appendField(step_button(block, "+", t(`more ${what}`), more));
  };
  const numbers = n => Array.from({ length: n }, (_, i) => i);

  // ---- values ----
  const output = check => ({ output: check });
  kinds.number = { style: "numbers", ...output(["Number", "Any"]),
    build: block => row(block, "ROW", ["TEXT", new NumeralField("0")]),
    print: block => text_of(block, "TEXT") };
  kinds.string = { style: "print", ...output(["String"]),
    build: block => row(block, "ROW", "“", ["TEXT", new CheckedField("", text => !/["\n\r]/.test(text))], "”"),
    print: block => `"${text_of(block, "TEXT")}"` };
  kinds.character = { style: "print", ...output(["String"]), tip: "the character with that number",
    build: block => value(block, "A0", anything, "character"),
    print: (block, part) => `$${part("A0")}` };
  kinds.name = { style: "names", ...output(["Number", "Any", "Place"]),
    build: block => row(block, "ROW", ["TEXT", new NameField("name", ["variable", "constant", "parameter"])]),
    print: block => text_of(block, "TEXT") };
  kinds.sensor = { style: "sensors", ...output(["Number", "Any", "Place"]),
    tip: block => describe(word_row[text_of(block, "TEXT")]),
    build: block => row(block, "ROW", ["TEXT", new ChoiceField("speed", () => words.sensors.map(({ word }) => word))]),
    print: block => text_of(block, "TEXT") };
  kinds.element = { style: "names", ...output(["Number", "Any", "Place"]), tip: word_row.array.summary,
    build: block => { row(block, "ROW", ["TEXT", new NameField("list", ["array"])], "["); value(block, "A0", anything); row(block, "END", "]"); },
    print: (block, part) => `${text_of(block, "TEXT")}[${part("A0")}]` };
  const operands = (block, n) => {
    for (const i of numbers(n)) value(block, `A${i}`, anything, ...i > 0 ? [","] : []);
    if (n > 0) row(block, "END", ")");
  };
  const argument_steps = (block, n) => steps(block, { what: "values",
    more: memory => { memory.n = n + 1; }, less: n > 0 && (memory => { memory.n = n - 1; }) });
  kinds.call = { style: "subs", ...output(["Number", "Any"]), tip: word_row.function.summary,
    build(block, { n = 0 }) {
      row(block, "ROW", ["TEXT", new NameField("half", ["function"])], n > 0 ? "(" : "( )");
      operands(block, n);
      argument_steps(block, n);
    },
    print: (block, part, { n = 0 }) => `${text_of(block, "TEXT")}(${numbers(n).map(i => part(`A${i}`)).join(", ")})` };
  const functions = [...words.functions.map(({ word }) => word), "min", "max"];
  const takes = word => word === "min" || word === "max" ? 2 : 1;
  kinds.builtin = { style: "numbers", ...output(["Number", "Any"]), tip: block => word_row[text_of(block, "TEXT")]?.summary,
    build(block, { n = 1 }) {
      row(block, "ROW", ["TEXT", new ChoiceField(n === 2 ? "min" : "abs", () => functions.filter(word => takes(word) === n))], "(");
      operands(block, n);
    },
    print: (block, part, { n = 1 }) => `${text_of(block, "TEXT")}(${numbers(n).map(i => part(`A${i}`)).join(", ")})` };
  kinds.negate = { style: "numbers", ...output(["Number", "Any"]),
    build: block => value(block, "A0", anything, "−"),
    print: (block, part) => `-${part("A0")}` };
  const between = (block, field, check = anything) => { value(block, "A0", check); value(block, "A1", check, ["TEXT", field]); };
  kinds.operation = { style: "numbers", ...output(["Number", "Any"]), tip: block => words.operators.find(({ sign }) => sign === text_of(block, "TEXT"))?.summary,
    build: block => between(block, new ChoiceField("+", () => words.operators.map(({ sign }) => sign), { look })),
    print: (block, part) => `${part("A0")} ${text_of(block, "TEXT")} ${part("A1")}` };
  kinds.relation = { style: "decide", ...output(condition),
    build: block => between(block, new ChoiceField("=", () => ["=", "<>", "<", ">", "<=", ">="], { look })),
    print: (block, part) => `${part("A0")} ${text_of(block, "TEXT")} ${part("A1")}` };
  kinds.not = { style: "decide", ...output(condition), tip: word_row.not.summary,
    build: block => value(block, "A0", condition, "not"),
    print: (block, part) => `not ${part("A0")}` };
  kinds.logic = { style: "decide", ...output(condition), tip: block => word_row[text_of(block, "TEXT")]?.summary,
    build: block => between(block, new ChoiceField("and", () => ["and", "or"], { look: one => t(one) }), condition),
    print: (block, part) => `${part("A0")} ${text_of(block, "TEXT")} ${part("A1")}` };

  // ---- statements of the robot ----
  for (const { word, form, required, parameters, summary } of words.statements) {
    if (form === "own") continue;
    const style = drawers[word] ?? "start", tip = summary;
    const type = `robot ${word}`;
    if (form === "arguments") kinds[type] = { style, tip, statement: true,
      build(block, { n = required, roll }) {
        const text = sentences[word] ?? word, names = parameters.map(({ name }) => name.replaceAll(" ", "_"));
        const put = (i, labels) => {
          value(block, `A${i}`, anything, ...labels);
          block.ranges[`A${i}`] = parameters[i];
          return [];
        };
        sentence(block, roll ? any_roll : text, (name, labels) => name === "go" ? [...labels, ["GO", new ChoiceField("1", () => ["1", "0", "2"], { look: go => t(rolls[go] ?? go) })]]
          : put(names.indexOf(name), labels));
        // Values that the sentence has no hole for.
        for (const i of numbers(roll ? 0 : n)) if (!block.getInput(`A${i}`)) put(i, [names[i] ?? ","]);
      },
      print: (block, part, { n = required, roll }) => [word, [...numbers(roll ? 2 : n).map(i => part(`A${i}`)), ...roll ? [text_of(block, "GO")] : []].join(", ")].filter(Boolean).join(" ") };
    else if (form === "entry") kinds[type] = { style, tip, statement: true,
      build(block, { n = 1 }) {
        value(block, "A0", ["Place"], sentences[word]);
        if (n < 3) return;
        value(block, "A1", anything, "wait");
        block.ranges.A1 = parameters[0];
        value(block, "A2", anything, "else");
      },
      makes: block => [["variable", name_at(block, "A0")]],
      print: (block, part, { n = 1 }) => `${word} ${numbers(n).map(i => part(`A${i}`)).join(", ")}` };
    else kinds[type] = { style, tip, statement: true,
      build(block, { n = 1 }) {
        row(block, "ROW", sentences[word] ?? as_is(word));
        for (const i of numbers(n)) value(block, `A${i}`, form === "places" ? ["Place"] : anything, ...i > 0 ? [","] : []);
        steps(block, { what: "values", more: memory => { memory.n = n + 1; }, less: n > 1 && (memory => { memory.n = n - 1; }) });
      },
      makes: (block, { n = 1 }) => form === "places" ? numbers(n).map(i => ["variable", name_at(block, `A${i}`)]) : [],
      print: (block, part, { n = 1 }) => `${word} ${numbers(n).map(i => part(`A${i}`)).join(", ")}` };
  }
  const name_at = (block, input) => {
    const found = block.getInputTargetBlock(input);
    return found?.type === "name" ? text_of(found, "TEXT") : "";
  };
  kinds.colour = { style: "light", statement: true, tip: word_row.RGB.summary,
    build(block, { mixed }) {
      row(block, "ROW", "light up in", ["TEXT", mixed ? new CheckedField("#00FF80", text => /^#[0-9a-f]{6}$/i.test(text)) : new ChoiceField("red", () => words.colours.map(({ name }) => name))]);
    },
    print: block => `RGB ${text_of(block, "TEXT")}` };

  // ---- values and names ----
  const assignments = ["=", "+=", "-=", "*=", "/=", "%="];
  kinds.assign = { style: "names", statement: true, tip: "gives a name a value",
    build: block => value(block, "VALUE", anything, "set", ["NAME", new NameField("name", ["variable", "parameter"])], ["SIGN", new ChoiceField("=", () => assignments)]),
    makes: block => [["variable", text_of(block, "NAME")]],
    print: (block, part) => `${text_of(block, "NAME")} ${text_of(block, "SIGN")} ${part("VALUE")}` };
  kinds["assign element"] = { style: "names", statement: true, tip: word_row.array.summary,
    build(block) {
      value(block, "INDEX", anything, "set", ["NAME", new NameField("list", ["array"])], "[");
      value(block, "VALUE", anything, "]", ["SIGN", new ChoiceField("=", () => assignments)]);
    },
    print: (block, part) => `${text_of(block, "NAME")}[${part("INDEX")}] ${text_of(block, "SIGN")} ${part("VALUE")}` };
  kinds.const = { style: "names", statement: true, tip: word_row.const.summary,
    build: block => value(block, "VALUE", anything, "const", ["NAME", new CheckedField("side", is_name)], "="),
    makes: block => [["constant", text_of(block, "NAME")]],
    print: (block, part) => `const ${text_of(block, "NAME")} = ${part("VALUE")}` };
  kinds.array = { style: "names", statement: true, tip: word_row.array.summary,
    build(block) { value(block, "VALUE", anything, "array", ["NAME", new CheckedField("list", is_name)], "["); row(block, "END", "]"); },
    makes: block => [["array", text_of(block, "NAME")]],
    print: (block, part) => `array ${text_of(block, "NAME")}[${part("VALUE")}]` };
  const names_of = block => text_of(block, "NAMES").split(",").map(one => one.trim()).filter(Boolean);
  // Names, each with or without an initial value: `a, b = 5`.
  const begun_names = block => [...text_of(block, "NAMES").matchAll(/(?:^|,)\s*(\w+)\s*(?=[,=]|$)/g)].map(([, name]) => name);
  const declares = text => text.trim() !== "" && (text.includes("=") ? !/['\n\r]/.test(text) : list_of_names(text));
  kinds.local = { style: "names", statement: true, tip: word_row.local.summary,
    build: block => row(block, "ROW", "local", ["NAMES", new CheckedField("n", declares)]),
    makes: block => begun_names(block).map(name => ["variable", name]),
    print: block => `local ${text_of(block, "NAMES").includes("=") ? text_of(block, "NAMES").trim() : names_of(block).join(", ")}` };
  for (const word of ["use", "include"]) kinds[word] = { style: "subs", statement: true, tip: word_row[word].summary,
    build: block => row(block, "ROW", word, "“", ["TEXT", new CheckedField("", text => !/["\n\r]/.test(text))], "”"),
    print: block => `${word} "${text_of(block, "TEXT")}"` };

  // ---- print ----
  kinds.print = { style: "print", statement: true, tip: word_row.print.summary,
    build(block, { seps = ["", ""] }) {
      const n = seps.length - 1;
      row(block, "ROW", "print");
      seps.forEach((sep, i) => {
        // Any separator may go between two items; before the first and after the last only an existing one is shown.
        const field = sep || (i > 0 && i < n) ? [[`SEP${i}`, new ChoiceField(sep, () => ["", ",", ";"], { look: sign => sign || "·" })]] : [];
        if (i < n) value(block, `A${i}`, item, ...field);
        else row(block, "LAST", ...field);
      });
      steps(block, { what: "values", more: memory => { memory.seps = [...signs(block, n), ""]; }, less: n > 0 && (memory => { memory.seps = signs(block, n).slice(0, -1); }) });
    },
    print(block, part, { seps = ["", ""] }) {
      const n = seps.length - 1;
      return numbers(n).reduce((text, i) => `${text}${sign_before(block, i)} ${part(`A${i}`)}`, "print") + (block.getFieldValue(`SEP${n}`) ?? "");
    } };
  const signs = (block, n) => numbers(n + 1).map(i => block.getFieldValue(`SEP${i}`) ?? "");
  /** Two adjacent values without a separator could be read as one. */
  const sign_before = (block, i) => {
    const sign = block.getFieldValue(`SEP${i}`) ?? "";
    if (sign || i === 0) return sign;
    const before = block.getInputTargetBlock(`A${i - 1}`), after = block.getInputTargetBlock(`A${i}`);
    const merges = before && after && before.type !== "string" && merge(print_value(before), print_value(after));
    return merges ? ";" : "";
  };

  // ---- decide ----
  const part_words = { elseif: "else if", else: "else" };
  kinds.if = { style: "decide", statement: true, opens: 1, tip: word_row.if.summary,
    build(block, { parts = [], note: has, end }) {
      value(block, "COND", condition, "if");
      row(block, "THEN", "then");
      note(block, has);
      body(block, "DO");
      parts.forEach((part, i) => {
        if (part.kind === "elseif") {
          value(block, `COND${i}`, condition, "else if");
          row(block, `THEN${i}`, "then");
        } else row(block, `ELSE${i}`, "else");
        note(block, part.note, i);
        body(block, `DO${i}`);
      });
      note(block, end?.note, "E");
      const has_else = parts.at(-1)?.kind === "else";
      steps(block, { what: "branches",
        more: memory => { memory.one_line = false; memory.parts = has_else ? [...parts.slice(0, -1), { kind: "elseif" }, parts.at(-1)] : [...parts, { kind: "else" }]; },
        less: parts.length > 0 && (memory => { memory.parts = parts.slice(0, -1); }) });
    },
    print: (block, part) => `if ${part("COND")} then`,
    part: (block, part, { kind }, i) => kind === "elseif" ? `elseif ${part(`COND${i}`)} then` : "else",
    end: () => "end if" };
  kinds.select = { style: "decide", statement: true, opens: 2, tip: word_row.select.summary,
    build(block, { parts = [], note: has, end, before }) {
      value(block, "VALUE", anything, "select");
      note(block, has);
      if (before) body(block, "DO");
      else block.appendEndRowInput("BREAK");
      parts.forEach((part, i) => {
        if (part.kind === "else") row(block, `ELSE${i}`, "else");
        else (part.values ?? [1]).forEach((n, j) => {
          value(block, `C${i}_${j}`, anything, j === 0 ? "case" : ",");
          if (n === 2) value(block, `C${i}_${j}T`, anything, "to");
        });
        note(block, part.note, i);
        body(block, `DO${i}`);
      });
      note(block, end?.note, "E");
      const has_else = parts.at(-1)?.kind === "else";
      steps(block, { what: "cases",
        more: memory => { memory.parts = has_else ? [...parts.slice(0, -1), { kind: "case" }, parts.at(-1)] : [...parts, { kind: parts.length ? "else" : "case" }]; },
        less: parts.length > 1 && (memory => { memory.parts = parts.slice(0, -1); }) });
    },
    print: (block, part) => `select ${part("VALUE")}`,
    part: (block, part, { kind, values = [1], words: own = "else" }, i) => kind === "else" ? own
      : `case ${values.map((n, j) => part(`C${i}_${j}`) + (n === 2 ? ` to ${part(`C${i}_${j}T`)}` : "")).join(", ")}`,
    end: () => "end select" };

  // ---- repeat ----
  const loop = (word, ends, head, print) => ({ style: "repeat", statement: true, opens: 1, tip: word_row[word].summary,
    build(block, { note: has, end }) {
      head(block);
      note(block, has);
      body(block, "DO");
      if (ends === "until") value(block, "COND", condition, "until");
      note(block, end?.note, "E");
    },
    print, end: (block, part) => ends === "until" ? `until ${part("COND")}` : ends });
  kinds.loop = loop("loop", "end loop", block => row(block, "ROW", "loop forever"), () => "loop");
  kinds.while = loop("while", "end while", block => value(block, "COND", condition, "while"), (block, part) => `while ${part("COND")}`);
  kinds.repeat = loop("repeat", "until", block => row(block, "ROW", "repeat"), () => "repeat");
  kinds["repeat times"] = loop("repeat", "end repeat", block => { value(block, "TIMES", anything, "repeat"); row(block, "END", "times"); }, (block, part) => `repeat ${part("TIMES")}`);
  kinds.for = { style: "repeat", statement: true, opens: 1, tip: word_row.for.summary,
    build(block, { step, note: has, end }) {
      value(block, "FROM", anything, "count with", ["NAME", new NameField("n", ["variable", "parameter"])], "from");
      value(block, "TO", anything, "to");
      if (step) value(block, "STEP", anything, "in steps of");
      note(block, has);
      body(block, "DO");
      note(block, end?.note, "E");
    },
    makes: block => [["variable", text_of(block, "NAME")]],
    print: (block, part, { step }) => `for ${text_of(block, "NAME")} = ${part("FROM")} to ${part("TO")}${step ? ` step ${part("STEP")}` : ""}`,
    end: (block, part, { bare }) => bare ? "next" : `next ${text_of(block, "NAME")}` };
  kinds.exit = { style: "repeat", statement: true, tip: word_row.exit.summary, build: block => row(block, "ROW", "leave the loop"), print: () => "exit" };
  kinds.continue = { style: "repeat", statement: true, tip: word_row.continue.summary, build: block => row(block, "ROW", "go on with the next round"), print: () => "continue" };

  // ---- subs ----
  for (const word of ["sub", "function"]) kinds[word] = { style: "subs", tip: word_row[word].summary, opens: 1, routine: true,
    build(block, { note: has, end, docs = 0 }) {
      for (const i of numbers(docs)) row(block, `DOCS${i}`, [`DOC${i}`, new LongField("")]);
      row(block, "ROW", word, ["NAME", new CheckedField(word === "sub" ? "leg" : "half", is_name)], "(", ["NAMES", new CheckedField("", list_of_names)], ")");
      note(block, has);
      body(block, "DO");
      note(block, end?.note, "E");
    },
    makes: block => [[word, text_of(block, "NAME")], ...names_of(block).map(name => ["parameter", name])],
    print: (block, part, { empty }) => `${word} ${text_of(block, "NAME")}${empty || names_of(block).length ? `(${names_of(block).join(", ")})` : ""}`,
    end: () => `end ${word}` };
  kinds["call sub"] = { style: "subs", statement: true, tip: word_row.sub.summary,
    build(block, { n = 0 }) {
      row(block, "ROW", "do", ["NAME", new NameField("leg", ["sub"])], ...n > 0 ? ["("] : []);
      operands(block, n);
      argument_steps(block, n);
    },
    print: (block, part, { n = 0, empty }) => `${text_of(block, "NAME")}${n || empty ? `(${numbers(n).map(i => part(`A${i}`)).join(", ")})` : ""}` };
  kinds.return = { style: "subs", statement: true, tip: word_row.return.summary,
    build: (block, { n = 0 }) => n ? value(block, "A0", anything, "return") : row(block, "ROW", "return"),
    print: (block, part, { n = 0 }) => n ? `return ${part("A0")}` : "return" };
  kinds.label = { style: "grey", statement: true, build: block => row(block, "ROW", ["NAME", new CheckedField("again", is_name)], ":"),
    makes: block => [["label", text_of(block, "NAME")]], print: block => `${text_of(block, "NAME")}:` };
  kinds.goto = { style: "grey", statement: true, tip: word_row.goto.summary, build: block => row(block, "ROW", "goto", ["NAME", new NameField("again", ["label"])]),
    print: block => `goto ${text_of(block, "NAME")}` };

  // ---- other blocks ----
  kinds.program = { style: "start", hat: true, tip: "The blocks below run from top to bottom when the program starts.",
    build: block => row(block, "ROW", "when the program starts"), print: () => "" };
  kinds.comment = { style: "note", statement: true, tip: "a comment for people; the robot does not see it",
    build: block => row(block, "ROW", ["TEXT", new LongField("what this is for")]),
    print: (block, part, { sign = "' " }) => `${sign}${text_of(block, "TEXT")}`.trimEnd() };
  kinds.text = { style: "grey", statement: true, tip: "There is no block for this, so it is shown as it is written.",
    build(block, { lines = [""] }) {
      lines.forEach((line, i) => row(block, `ROW${i}`, [`TEXT${i}`, new LongField(line.trim())]));
      block.setInputsInline(false);
    },
    lines: (block, { lines = [""] }) => lines.map((line, i) => text_of(block, `TEXT${i}`) === line.trim() ? { whole: line } : { text: text_of(block, `TEXT${i}`) }) };

  // ---- blocks that change ----
  function rebuild(block) {
    for (const { name } of [...block.inputList]) block.removeInput(name);
    block.build();
  }
  /** Changes the number of parts; blocks in the remaining parts stay. */
  function reshape(block, change) {
    const before = block.saveExtraState() ?? {}, memory = structuredClone(before);
    change(memory);
    const moves = moves_of(before.parts ?? [], memory.parts ?? []);
    Events.setGroup(true);
    try {
      const held = block.inputList.filter(({ connection }) => connection).map(({ name, connection }) =>
        ({ name: moves(name), shadow: connection.getShadowState(true), target: connection.targetBlock()?.isShadow() ? null : connection.targetConnection }));
      const texts = block.inputList.flatMap(({ fieldRow }) => fieldRow).filter(({ name }) => name).map(field => [moves(field.name), field.getValue()]);
      block.memory = memory;
      rebuild(block);
      for (const [name, text] of texts) block.getField(name)?.setValue(text);
      for (const { name, shadow, target } of held) {
        const connection = block.getInput(name)?.connection;
        if (!connection) continue;
        if (shadow) connection.setShadowState(shadow);
        if (target) connection.connect(target);
      }
      block.fill_empty();
      Events.fire(new (Events.get(Events.BLOCK_CHANGE))(block, "mutation", null, JSON.stringify(before), JSON.stringify(memory)));
    } finally {
      Events.setGroup(false);
    }
  }
  function shadow_for(block, input) {
    if (block.type === "print") return { type: "string", fields: { TEXT: "" } };
    if (block.getInput(input).connection.getCheck()?.includes("Place")) return { type: "name", fields: { TEXT: "n" } };
    return { type: "number", fields: { TEXT: String(Math.max(block.ranges[input]?.least ?? 0, 0)) } };
  }

  // ---- shared by all ----
  const build = block => {
    block.ranges = {};
    block.kind.build(block, block.memory);
    if (!block.kind.opens) note(block, block.memory.note);
  };
  const tip_of = ({ tip = "" }, block) => t(typeof tip === "function" ? tip(block) ?? "" : tip);
  for (const [type, kind] of Object.entries(kinds))
    Blockly.Blocks[type] = {
      init() {
        this.memory = {};
        this.setStyle?.(`${kind.style}_blocks`);
        this.setInputsInline(true);
        build(this);
        if (kind.output) this.setOutput(true, kind.output);
        if (kind.statement) {
          this.setPreviousStatement(true);
          this.setNextStatement(true);
        } else if (kind.hat) this.setNextStatement(true);
        this.setTooltip(() => tip_of(kind, this));
      },
      saveExtraState() {
        return Object.keys(this.memory).length ? structuredClone(this.memory) : null;
      },
      loadExtraState(state) {
        this.memory = structuredClone(state);
        rebuild(this);
      },
      build() {
        build(this);
      },
      /** Fills each empty input, so that the result is a program. */
      fill_empty() {
        for (const { name, connection, type } of this.inputList)
          if (type === inputTypes.VALUE && !connection.targetBlock() && !connection.getShadowState()) connection.setShadowState(shadow_for(this, name));
      },
      makes() {
        return kind.makes?.(this, this.memory) ?? [];
      },
      kind,
    };
  return kinds;
}

/** `(a) (b)` are two values, `a (b)` is a call, `a -b` a difference. */
const merge = (before, after) => /^[-[]/.test(after) || (after.startsWith("(") && !before.endsWith(")"));

/** Where the inputs of part `i` move: a last `else` stays last. */
function moves_of(before, after) {
  const last = before.length - 1;
  if (before.at(-1)?.kind !== "else" || after.length <= before.length) return name => name;
  return name => name.replace(/^(DO|ELSE|NOTE|NOTES)(\d+)$/, (whole, word, i) => Number(i) === last ? `${word}${after.length - 1}` : whole);
}
const describe = row => !row ? "" : `${row.summary} (${row.least} to ${row.greatest}${row.unit ? ` ${row.unit}` : ""})`;

// ---- text of a block ----

/** A value, with parentheses if it binds weaker than `least`. */
export function print_value(block, least = levels.any) {
  const groups = (hold_of(block).own < least ? 1 : 0) + (block.memory.groups ?? 0);
  return "(".repeat(groups) + block.kind.print(block, part_of(block), block.memory) + ")".repeat(groups);
}
const hold_of = block => hold(block.type, block.getFieldValue("TEXT") ?? "");
/** Prints the values in a block's inputs. */
export const part_of = block => input => {
  const found = block.getInputTargetBlock(input);
  if (!found) return block.type === "print" ? '""' : "0";
  return print_value(found, hold_of(block).parts[Number(input.slice(1))]);
};
