// The toolbox: drawers of blocks, generated from the tables.

import { t } from "../dom.js";

const number = text => ({ shadow: { type: "number", fields: { TEXT: text } } });
const string = text => ({ shadow: { type: "string", fields: { TEXT: text } } });
const block = (type, { fields = {}, inputs = {}, memory, next } = {}) => ({ kind: "block", type, fields, inputs, ...memory ? { extraState: memory } : {}, ...next ? { next: { block: next } } : {} });
const value = (type, more) => { const { kind, ...state } = block(type, more); return { block: state, ...number("0") }; };
const inside = ({ kind, ...state }) => ({ block: state });
const label = text => ({ kind: "label", text: t(text) });
const sensor = word => block("sensor", { fields: { TEXT: word } });
const robot = (word, ...texts) => block(`robot ${word}`, { inputs: Object.fromEntries(texts.map((text, i) => [`A${i}`, number(text)])), memory: texts.length ? { n: texts.length } : undefined });
const roll = (heading, speed, go) => block("robot goroll", { fields: { GO: go }, inputs: { A0: number(heading), A1: number(speed) }, memory: { n: 3, roll: true } });
const shaken = value("sensor", { fields: { TEXT: "dshake" } });

/**
 * `made(of)`: the program's names of these kinds; `routines()`: its subs and functions with parameters; `labels`:
 * show explanations in drawers.
 */
export function drawers(words, { made, routines, labels }) {
  const relation = (left, sign, right) => block("relation", { fields: { TEXT: sign }, inputs: { A0: left, A1: number(right) } });
  const asked = (left, sign, right) => { const { kind, ...state } = relation(left, sign, right); return { block: state, ...number("0") }; };
  const colour = name => block("colour", { fields: { TEXT: name } });
  const name = text => block("name", { fields: { TEXT: text } });
  const call = ({ type, name, parameters }) => block(type === "sub" ? "call sub" : "call", { fields: { [type === "sub" ? "NAME" : "TEXT"]: name },
    memory: { n: parameters.length }, inputs: Object.fromEntries(parameters.map((_, i) => [`A${i}`, number("0")])) });
  const list = [
    ["Start", "start", [
      block("comment", { fields: { TEXT: "what this is for" } }),
      label("The ball uses loops to wait for things:"),
      block("loop", { inputs: { DO: inside(block("if", { memory: { one_line: false }, inputs: { COND: shaken, DO: inside(colour("red")) }, next: state_of(robot("delay", "50ms")) })) } }),
      robot("end"), robot("reset")]],
    ["Drive", "drive", [label("heading 0 is ahead, 90 to the right"), roll("0", "80", "1"), label("brake"), roll("0", "0", "0"),
      label("both motors"), robot("raw", "1", "128", "1", "128"), robot("basflg", "1")]],
    ["Turn", "turn", [label("turn on the spot"), roll("90", "0", "1"), label("this is ahead from now on"), robot("heading", "0"), label("set the position"), robot("locate", "0", "0"), sensor("yaw")]],
    ["Light", "light", [colour("red"), block("colour", { fields: { TEXT: "#00FF80" }, memory: { mixed: true } }), robot("RGB", "255", "128", "0"), robot("LEDC", "3"), robot("backLED", "255")]],
    ["Wait", "wait", [robot("delay", "1s"), label("until it is shaken"), block("repeat", { inputs: { DO: inside(robot("delay", "50ms")), COND: shaken } }),
      block("while", { inputs: { COND: asked(value("sensor", { fields: { TEXT: "speed" } }), ">", "5"), DO: inside(robot("delay", "50ms")) } }), robot("sleep", "60s")]],
    ["Sensors", "sensors", [...words.sensors.map(({ word }) => sensor(word)),
      label("a number from whoever is connected"), block("robot input", { memory: { n: 3 }, inputs: { A0: { shadow: { type: "name", fields: { TEXT: "answer" } } }, A1: number("10s"), A2: number("0") } }),
      label("a timer counts down to 0"), block("assign", { fields: { NAME: "timerA", SIGN: "=" }, inputs: { VALUE: number("5s") } })]],
    ["Decide", "decide", [
      block("if", { inputs: { COND: shaken } }),
      block("if", { memory: { parts: [{ kind: "else" }] }, inputs: { COND: asked(value("sensor", { fields: { TEXT: "speed" } }), ">", "5") } }),
      block("if", { memory: { parts: [{ kind: "elseif" }, { kind: "else" }] }, inputs: { COND: shaken, COND0: shaken } }),
      relation(value("sensor", { fields: { TEXT: "speed" } }), ">", "5"),
      block("logic", { fields: { TEXT: "and" }, inputs: { A0: shaken, A1: shaken } }), block("logic", { fields: { TEXT: "or" }, inputs: { A0: shaken, A1: shaken } }),
      block("not", { inputs: { A0: shaken } }),
      block("select", { memory: { parts: [{ kind: "case" }, { kind: "case" }, { kind: "else" }] }, inputs: { VALUE: value("builtin", { fields: { TEXT: "rnd" }, inputs: { A0: number("3") } }), C0_0: number("1"), C1_0: number("2") } })]],
    ["Repeat", "repeat", [
      block("repeat times", { inputs: { TIMES: number("4") } }), block("loop"),
      block("for", { fields: { NAME: "n" }, inputs: { FROM: number("1"), TO: number("4") } }),
      block("for", { fields: { NAME: "n" }, memory: { step: true }, inputs: { FROM: number("10"), TO: number("0"), STEP: number("-1") } }),
      block("while", { inputs: { COND: asked(value("sensor", { fields: { TEXT: "speed" } }), ">", "5") } }),
      block("repeat", { inputs: { COND: shaken } }), block("exit"), block("continue")]],
    ["Numbers", "numbers", [block("number", { fields: { TEXT: "100" } }),
      ...words.operators.map(({ sign }) => block("operation", { fields: { TEXT: sign }, inputs: { A0: number("1"), A1: number("2") } })),
      block("negate", { inputs: { A0: number("1") } }),
      block("builtin", { fields: { TEXT: "rnd" }, inputs: { A0: number("6") } }), block("builtin", { fields: { TEXT: "abs" }, inputs: { A0: number("-5") } }),
      block("builtin", { fields: { TEXT: "sqrt" }, inputs: { A0: number("100") } }), block("builtin", { fields: { TEXT: "min" }, memory: { n: 2 }, inputs: { A0: number("1"), A1: number("2") } }),
      block("builtin", { fields: { TEXT: "max" }, memory: { n: 2 }, inputs: { A0: number("1"), A1: number("2") } })]],
    ["Names", "names", () => {
      const own = made(["variable", "constant", "parameter"]), some = made(["variable"])[0] ?? "count";
      return [...own.length ? [label("in this program"), ...own.map(name)] : [],
        block("assign", { fields: { NAME: some, SIGN: "=" }, inputs: { VALUE: number("0") } }), block("assign", { fields: { NAME: some, SIGN: "+=" }, inputs: { VALUE: number("1") } }),
        ...own.length ? [] : [name(some)], block("const", { fields: { NAME: "side" }, inputs: { VALUE: number("80") } }), block("local", { fields: { NAMES: "n" } }),
        label("many values under one name"), block("array", { fields: { NAME: "list" }, inputs: { VALUE: number("5") } }),
        block("assign element", { fields: { NAME: made(["array"])[0] ?? "list", SIGN: "=" }, inputs: { INDEX: number("1"), VALUE: number("0") } }), block("element", { fields: { TEXT: made(["array"])[0] ?? "list" }, inputs: { A0: number("1") } }),
        label("a row of numbers to read"), block("robot data", { memory: { n: 3 }, inputs: { A0: number("1"), A1: number("2"), A2: number("3") } }),
        block("robot read", { memory: { n: 1 }, inputs: { A0: { shadow: { type: "name", fields: { TEXT: some } } } } }), robot("rstr")];
    }],
    ["Subs", "subs", () => [...routines().map(call),
      block("sub", { fields: { NAME: fresh("leg", made(["sub", "function"])) }, memory: { after_blank: true } }),
      block("sub", { fields: { NAME: fresh("leg", made(["sub", "function"])), NAMES: "direction" }, memory: { after_blank: true } }),
      block("return"),
      block("function", { fields: { NAME: fresh("half", made(["sub", "function"])), NAMES: "n" }, memory: { after_blank: true }, inputs: { DO: inside(block("return", { memory: { n: 1 }, inputs: { A0: value("operation", { fields: { TEXT: "/" }, inputs: { A0: value("name", { fields: { TEXT: "n" } }), A1: number("2") } }) } })) } }),
      block("return", { memory: { n: 1 }, inputs: { A0: number("0") } }),
      label("macros"), robot("macrun", "32"), robot("mackill")]],
    ["Print", "print", [block("print", { memory: { seps: ["", ""] }, inputs: { A0: string("hello") } }),
      block("print", { memory: { seps: ["", ",", ""] }, inputs: { A0: string("speed is"), A1: { ...value("sensor", { fields: { TEXT: "speed" } }), ...string("") } } }),
      block("string", { fields: { TEXT: "hello" } }), block("character", { inputs: { A0: number("65") } }), robot("tron"), robot("troff")]],
  ];
  // Omit labels if space is short.
  const shown = contents => labels ? contents : contents.filter(({ kind }) => kind !== "label");
  return list.map(([name, style, contents]) => [name, style, typeof contents === "function" ? () => shown(contents()) : shown(contents)]);
}
const state_of = ({ kind, ...state }) => state;
function fresh(name, taken) {
  for (let n = 1; ; ++n) {
    const one = n === 1 ? name : `${name}${n}`;
    if (!taken.some(other => other.toLowerCase() === one)) return one;
  }
}

/** The drawers in Blockly's form; those that depend on the program are computed on opening. */
export function toolbox_of(list) {
  return { kind: "categoryToolbox", contents: list.map(([name, style, contents]) => ({ kind: "category", name: t(name), categorystyle: `${style}_category`,
    ...typeof contents === "function" ? { custom: name } : { contents } })) };
}
