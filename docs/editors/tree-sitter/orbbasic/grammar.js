// orbBasic as the robot reads it: a number and a statement on each line.
// Printed by `orb spec --editors docs/editors`; a test compares them.

const lets = [
  'let',
];
const ifs = [
  'if',
];
const fors = [
  'for',
];
const nexts = [
  'next',
];
const jumps = [
  'goto', 'gosub',
];
const ons = [
  'on',
];
const prints = [
  'print',
];
const actions = [
  'input', 'delay', 'RGB', 'LEDC', 'backLED', 'random', 'goroll', 'heading', 'raw', 'locate',
  'basflg', 'data', 'rstr', 'read', 'tron', 'troff', 'reset', 'sleep', 'macrun', 'mackill',
];
const controls = [
  'return', 'end',
];
const functions = [
  'sqrt', 'rnd', 'abs',
];
const variables = [
  'timerA', 'timerB', 'timerC', 'ctrl', 'speed', 'yaw', 'pitch', 'roll', 'accelX', 'accelY',
  'accelZ', 'gyroX', 'gyroY', 'gyroZ', 'Vbatt', 'Sbatt', 'cmdroll', 'cmdval', 'spdval', 'hdgval',
  'cmdrgb', 'redval', 'grnval', 'bluval', 'isconn', 'dshake', 'accelone', 'xpos', 'ypos', 'Qzero',
  'Qone', 'Qtwo', 'Qthree', 'macstat',
];
const products = '*/%{}';
const sums = '+-&|';
const relations = '=!<>';

const words = list => token(choice(...list));
const sign = signs => new RegExp('[' + signs.replace(/[-\]\\^]/g, '\\$&') + ']');
const minus = '-'; // also stands before a single value
const several = rule => seq(rule, repeat(seq(',', rule)));

module.exports = grammar({
  name: 'orbbasic',
  extras: _ => [/[ \t]/],
  word: $ => $._word,
  rules: {
    program: $ => seq(optional(/\uFEFF/), repeat(seq(optional($._content), $._line_end)), optional($._content)),
    _content: $ => choice(seq($.line, optional($.comment)), $.comment),
    line: $ => seq(field('number', $.line_number), optional($._statement)),
    line_number: _ => /[0-9]+/,
    _line_end: _ => /\r?\n|\r/,

    // statements
    _statement: $ => choice($.conditional, $._in_branch),
    _in_branch: $ => choice($.assignment, $.loop, $.loop_end, $.jump, $.indexed_jump, $.output, $.action),
    assignment: $ => seq(optional(choice(...lets)), field('left', choice($.variable, $.system_variable)), '=', field('right', $._expression)),
    conditional: $ => seq(choice(...ifs), $.relation, optional(seq(choice('and', 'or'), $.relation)),
      'then', field('then', $._in_branch), optional(seq('else', field('else', $._in_branch)))),
    relation: $ => seq($._expression, alias(sign(relations), $.operator), $._expression),
    loop: $ => seq(choice(...fors), field('variable', $.variable), '=', $._expression, 'to', $._expression, optional(seq('step', $._expression))),
    loop_end: $ => seq(choice(...nexts), field('variable', $.variable)),
    jump: $ => seq(choice(...jumps), $._target),
    indexed_jump: $ => seq(choice(...ons), $._expression, choice(...jumps), several($._target)),
    _target: $ => alias($.number, $.line_number),
    output: $ => seq(choice(...prints, '?'), repeat(choice($.string, ',', ';', seq('$', $._expression), prec(-2, $._expression)))),
    action: $ => seq(field('name', choice($.action_word, $.control_word)), optional(several($._expression))),
    action_word: _ => words(actions),
    control_word: _ => words(controls),

    // expressions: a function takes the whole expression that follows
    _expression: $ => choice($.number, $.variable, $.system_variable, $.group, $.negation, $.product, $.sum, $.call),
    group: $ => seq('(', $._expression, ')'),
    negation: $ => prec(3, seq(minus, $._expression)),
    product: $ => prec.left(2, seq($._expression, alias(sign(products), $.operator), $._expression)),
    sum: $ => prec.left(1, seq($._expression, alias(choice(sign(sums.replace(minus, '')), minus), $.operator), $._expression)),
    call: $ => prec.right(-1, seq(field('function', $.function_word), $._expression)),
    function_word: _ => words(functions),
    system_variable: _ => words(variables),
    variable: _ => /[A-Za-z]/,
    number: _ => /[0-9]+/,
    string: _ => /"[^"\r\n]*"/,
    comment: _ => /'[^\r\n]*/,
    _word: _ => /[A-Za-z]+/, // last: of two rules for the same text the first one wins
  },
});
