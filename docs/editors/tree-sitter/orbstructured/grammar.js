// Structured orbBasic: names, blocks and subs.
// Printed by `orb spec --editors docs/editors`; a test compares them.

const actions = [
  'input', 'delay', 'RGB', 'LEDC', 'backLED', 'random', 'goroll', 'heading', 'raw', 'locate',
  'basflg', 'data', 'rstr', 'read', 'tron', 'troff', 'reset', 'sleep', 'macrun', 'mackill',
];
const functions = [
  'sqrt', 'rnd', 'abs', 'min', 'max',
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

// Case does not count.
const anycase = text => new RegExp(text.replace(/[a-z]/gi, c => '[' + c.toLowerCase() + c.toUpperCase() + ']'));
const words = list => token(choice(...list.map(anycase)));
const word = text => alias(token(anycase(text)), text);
const sign = signs => new RegExp('[' + signs.replace(/[-\]\\^]/g, '\\$&') + ']');
const minus = '-'; // also stands before a single value
const equals = '='; // also stands between a variable and its new value
const several = rule => seq(rule, repeat(seq(',', rule)));
const block = ($, name, ...head) => seq(word(name), ...head, $._line_end, repeat($._line), word('end'), word(name));

module.exports = grammar({
  name: 'orbstructured',
  externals: $ => [$._line_end, $._recovery], // src/scanner.c says where a line ends
  extras: $ => [/[\s\uFEFF]/, $.comment],
  // `end` ends a branch and its block, or the program: the next word tells.
  conflicts: $ => [[$.elseif], [$.else], [$.case]],
  word: $ => $.name,
  rules: {
    program: $ => repeat($._line),
    _line: $ => seq(choice($._simple, $.short_if, $.if, $.select, $.while, $.repeat, $.loop, $.for, $.sub, $.function,
      $.label, $.constant, $.local, $.array, $.use, $.include), $._line_end),

    // names
    constant: $ => seq(word('const'), field('name', $.name), equals, $._expression),
    local: $ => seq(word('local'), several(seq($.name, optional(seq(equals, $._expression))))),
    array: $ => seq(word('array'), field('name', $.name), '[', $._expression, ']'),
    use: $ => seq(word('use'), $.string),
    include: $ => seq(word('include'), $.string),
    sub: $ => block($, 'sub', field('name', $.name), optional($.parameters)),
    function: $ => block($, 'function', field('name', $.name), optional($.parameters)),
    parameters: $ => seq('(', optional(several($.name)), ')'),
    label: $ => seq($.name, ':'),

    // blocks
    short_if: $ => seq(word('if'), $._expression, word('then'), $._simple, optional(seq(word('else'), $._simple))),
    if: $ => seq(word('if'), $._expression, word('then'), $._line_end, repeat($._line),
      repeat($.elseif), optional($.else), word('end'), word('if')),
    elseif: $ => seq(word('elseif'), $._expression, optional(word('then')), $._line_end, repeat($._line)),
    else: $ => seq(optional(word('case')), word('else'), $._line_end, repeat($._line)),
    select: $ => seq(word('select'), $._expression, $._line_end, repeat($.case), optional($.else), word('end'), word('select')),
    case: $ => seq(word('case'), several(choice($._expression, $.range)), $._line_end, repeat($._line)),
    range: $ => seq($._expression, word('to'), $._expression),
    while: $ => block($, 'while', $._expression),
    repeat: $ => choice(
      seq(word('repeat'), $._line_end, repeat($._line), word('until'), $._expression),
      block($, 'repeat', $._expression)),
    loop: $ => block($, 'loop'),
    for: $ => seq(word('for'), field('variable', $._place), equals, $._expression, word('to'), $._expression,
      optional(seq(word('step'), $._expression)), $._line_end, repeat($._line), word('next'), optional($._place)),

    // statements
    _simple: $ => choice($.assignment, $.command, $.goto, $.return, $.end, $.exit, $.continue, $.output, $.action),
    assignment: $ => seq(field('left', $._place), choice(equals, alias(/[-+*\/%]=/, $.operator)), field('right', $._expression)),
    command: $ => seq(field('name', $.name), optional($.arguments)),
    goto: $ => seq(word('goto'), $.name),
    return: $ => seq(word('return'), optional($._expression)),
    end: $ => word('end'),
    exit: $ => word('exit'),
    continue: $ => word('continue'),
    // A comma goes on in the next line, unless `;` follows it.
    output: $ => seq(choice(word('print'), '?'), repeat(choice($.string, seq(',', optional(';')), ';', seq('$', $._expression), prec(-2, $._expression)))),
    action: $ => seq(field('name', $.action_word), optional(several(choice($._expression, $.colour)))),
    action_word: _ => words(actions),
    colour: _ => /#[0-9A-Fa-f]{6}/,

    // expressions and conditions
    _place: $ => choice($.name, $.element, $.system_variable),
    _expression: $ => choice($.number, $._place, $.call, $.group, $.negation, $.product, $.sum, $.relation, $.not, $.and, $.or),
    group: $ => seq('(', $._expression, ')'),
    element: $ => prec(8, seq(field('array', $.name), '[', $._expression, ']')),
    call: $ => prec(8, seq(field('function', choice($.name, $.function_word)), $.arguments)),
    arguments: $ => seq('(', optional(several($._expression)), ')'),
    negation: $ => prec(7, seq(minus, $._expression)),
    product: $ => prec.left(6, seq($._expression, alias(sign(products), $.operator), $._expression)),
    sum: $ => prec.left(5, seq($._expression, alias(choice(sign(sums.replace(minus, '')), minus), $.operator), $._expression)),
    relation: $ => prec.left(4, seq($._expression, alias(choice(equals, '<>', '<=', '>=', '!=', sign(relations.replace(equals, ''))), $.operator), $._expression)),
    not: $ => prec(3, seq(word('not'), $._expression)),
    and: $ => prec.left(2, seq($._expression, word('and'), $._expression)),
    or: $ => prec.left(1, seq($._expression, word('or'), $._expression)),
    function_word: _ => words(functions),
    system_variable: _ => words(variables),
    number: _ => /[0-9][A-Za-z0-9_.]*/,
    string: _ => /"[^"\r\n]*"/,
    comment: _ => /'[^\r\n]*/,
    name: _ => /[A-Za-z_][A-Za-z0-9_]*/, // last: of two rules for the same text the first one wins
  },
});
