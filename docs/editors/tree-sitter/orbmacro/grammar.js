// Macros of Sphero robots.
// Printed by `orb spec --editors docs/editors`; a test compares them.

const directives = [
  'macro', 'const', 'raw', 'noend',
];
const commands = [
  'end', 'set_sd1', 'set_sd2', 'stabilization', 'set_heading', 'roll', 'roll_sd1', 'rgb',
  'rgb_sd2', 'back_led', 'raw_motors', 'delay', 'goto', 'gosub', 'sleep', 'set_spd1', 'set_spd2',
  'roll_spd1_sd1', 'roll_spd2_sd1', 'rotation_rate', 'fade', 'marker', 'wait_until_stopped',
  'rotate', 'stream_end', 'roll2', 'loop_start', 'loop_end', 'comment', 'rotate_sd1',
  'rotate_sd2', 'on_collision', 'loop_start_system', 'set_speed', 'configure_collision',
];
const values = [
  'motor_control', 'exclusive_drv', 'allow_sod', 'inh_if_conn', 'endsig', 'stealth', 'unkillable',
  'ext_flags', 'off', 'on', 'on_without_reset', 'forward', 'reverse', 'brake', 'ignore',
];

const words = list => token(choice(...list));

module.exports = grammar({
  name: 'orbmacro',
  extras: _ => [/[ \t]/],
  word: $ => $.word,
  rules: {
    program: $ => seq(optional(/\uFEFF/), repeat(seq(optional($._line), $._line_end)), optional($._line)),
    _line: $ => choice(seq(choice($.directive, $.command), optional($.comment)), $.comment),
    _line_end: _ => /\r?\n|\r/,
    directive: $ => seq(field('name', $.directive_word), optional($._operands)),
    command: $ => seq(field('name', $.command_word), optional($._operands)),
    _operands: $ => seq($._operand, repeat(seq(optional(','), $._operand))),
    _operand: $ => choice($.operand, $._value),
    operand: $ => seq(field('name', choice($.word, alias($.command_word, $.word), alias($.value_word, $.word))), '=', field('value', $._value)),
    _value: $ => choice($.number, $.value_word, $.word, alias($.command_word, $.word), $.string),
    directive_word: _ => token(seq('.', choice(...directives))),
    command_word: _ => words(commands),
    value_word: _ => words(values),
    number: _ => /[-+]?(0[xX][0-9A-Fa-f]+|[0-9]+(\.[0-9]+)?)[A-Za-z0-9_]*/,
    string: _ => /"([^"\\\r\n]|\\[^\r\n])*"/,
    comment: _ => /[#;][^\r\n]*/,
    word: _ => /[A-Za-z_][A-Za-z0-9_]*/, // last: of two rules for the same text the first one wins
  },
});
