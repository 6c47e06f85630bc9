#include "editor/printed/tree_sitter.h"

#include "editor/directives.h"
#include "editor/printed/word_lists.h"
#include "editor/word_at.h"
#include "spec/basic.h"
#include "structured/text/structured_words.h"

#include <algorithm>
#include <fmt/format.h>
#include <functional>
#include <initializer_list>
#include <string>

namespace orb::editor {
namespace {

using spec::Form;

constexpr std::string_view printed =
    "Printed by `orb spec --editors docs/editors`; a test compares them.";

// ---- tables as JavaScript

/// `const name = ['a', 'b'];`, broken into lines.
std::string list(std::string_view name, const Words& words) {
  constexpr std::size_t widest = 98;
  std::string out = fmt::format("const {} = [\n ", name);
  std::size_t column = 1;
  for (const auto word : words) {
    const auto item = fmt::format(" '{}',", word);
    if (column + item.size() > widest) {
      out += "\n ";
      column = 1;
    }
    out += item;
    column += item.size();
  }
  return out + "\n];\n";
}

/// The words of statements with one of these forms, filtered by `keep`.
template <typename Keep>
Words of_forms(std::initializer_list<Form> forms, Keep keep) {
  return words_of(spec::statements, [&](const spec::StatementInfo& row) {
    return std::find(forms.begin(), forms.end(), row.form) != forms.end() && keep(row);
  });
}
Words of_forms(std::initializer_list<Form> forms) {
  return of_forms(forms, [](const spec::StatementInfo&) { return true; });
}
Words of_form(Form form) {
  return of_forms({form});
}

/// The forms of statements that take a list of values with a common syntax.
constexpr std::initializer_list<Form> plain_forms{Form::Entry, Form::Values, Form::Variables,
                                                  Form::Arguments};

std::string signs() {
  std::string products;
  std::string sums;
  std::string relations;
  for (const auto& row : spec::operators)
    (row.level == spec::Level::Medium ? products : sums) += row.symbol;
  for (const auto& row : spec::relations)
    relations += row.symbol;
  return fmt::format("const products = '{}';\nconst sums = '{}';\nconst relations = '{}';\n",
                     products, sums, relations);
}

// ---- orbBasic with line numbers

constexpr std::string_view basic_rules = R"js(
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
)js";

std::string basic_grammar() {
  return fmt::format("// orbBasic as the robot reads it: a number and a statement on each line.\n"
                     "// {}\n\n",
                     printed) +
         list("lets", of_form(Form::Assignment)) + list("ifs", of_form(Form::Conditional)) +
         list("fors", of_form(Form::Loop)) + list("nexts", of_form(Form::LoopEnd)) +
         list("jumps", of_form(Form::Branch)) + list("ons", of_form(Form::IndexedBranch)) +
         list("prints", of_form(Form::Output)) +
         list("actions", of_forms(plain_forms, std::not_fn(directs_the_flow))) +
         list("controls", of_forms(plain_forms, directs_the_flow)) +
         list("functions", function_words()) + list("variables", variable_words()) + signs() +
         std::string(basic_rules);
}

// ---- structured orbBasic

/// The robot's statements with a grammar rule of their own.
constexpr std::initializer_list<spec::Statement> ruled{
    spec::Statement::If,     spec::Statement::For,   spec::Statement::Next, spec::Statement::Goto,
    spec::Statement::Return, spec::Statement::Print, spec::Statement::End};

constexpr std::string_view structured_rules = R"js(
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
)js";

bool is_keyword(std::string_view word) {
  return structured::find_word(word).kind == structured::WordKind::Keyword;
}

/// The robot's statements in structured programs: the ones in `ruled`, or the others.
enum class Rule : std::uint8_t { Own, Common };
Words structured_statements(Rule rule) {
  return words_of(spec::statements, [rule](const spec::StatementInfo& row) {
    const bool has_rule = std::find(ruled.begin(), ruled.end(), row.statement) != ruled.end();
    const bool foreign = row.form == Form::Branch || row.form == Form::IndexedBranch;
    const bool known = structured::find_word(row.word).kind == structured::WordKind::Statement;
    return known && has_rule == (rule == Rule::Own) && (has_rule || !foreign);
  });
}

Words structured_functions() {
  auto words = function_words();
  for (const auto& row : structured::keywords)
    if (structured::is_function(structured::find_word(row.word)))
      words.push_back(row.word);
  return words;
}

std::string structured_grammar() {
  return fmt::format("// Structured orbBasic: names, blocks and subs.\n// {}\n\n", printed) +
         list("actions", structured_statements(Rule::Common)) +
         list("functions", structured_functions()) + list("variables", variable_words()) + signs() +
         std::string(structured_rules);
}

// ---- macros

constexpr std::string_view macro_rules = R"js(
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
)js";

std::string macro_grammar() {
  return fmt::format("// Macros of Sphero robots.\n// {}\n\n", printed) +
         list("directives", macro_directive_words()) + list("commands", macro_command_words()) +
         list("values", macro_value_words()) + std::string(macro_rules);
}

// ---- highlighting

/// `["a" "b"] @capture`.
std::string capture(const Words& words, std::string_view name) {
  std::string out = "[";
  for (const auto word : words)
    out += fmt::format("{}\"{}\"", out.size() > 1 ? " " : "", word);
  return out + fmt::format("] @{}\n", name);
}

std::string head() {
  return fmt::format("; {}\n\n", printed);
}

std::string basic_highlights() {
  Words keywords(spec::particles.begin(), spec::particles.end());
  for (const auto word : of_forms({Form::Assignment, Form::Conditional, Form::Loop, Form::LoopEnd,
                                   Form::Branch, Form::IndexedBranch}))
    keywords.push_back(word);
  return head() + capture(keywords, "keyword") + "(control_word) @keyword\n" +
         "(action_word) @function.builtin\n" + capture(of_form(Form::Output), "function.builtin") +
         "\"?\" @function.builtin\n"
         "(function_word) @function.builtin\n"
         "(system_variable) @variable.builtin\n"
         "(variable) @variable\n"
         "(line_number) @label\n"
         "(number) @number\n"
         "(string) @string\n"
         "(comment) @comment\n"
         "[(operator) \"=\" \"-\"] @operator\n";
}

std::string structured_highlights() {
  auto keywords = structured_statements(Rule::Own);
  std::erase(keywords, "print");
  for (const auto& row : structured::keywords)
    if (is_keyword(row.word) && !structured::is_function(structured::find_word(row.word)))
      keywords.push_back(row.word);
  return head() +
         "(name) @variable\n"
         "(constant name: (name) @constant)\n"
         "(sub name: (name) @function)\n"
         "(function name: (name) @function)\n"
         "(command name: (name) @function)\n"
         "(call function: (name) @function)\n"
         "(parameters (name) @parameter)\n"
         "(label (name) @label)\n"
         "(goto (name) @label)\n" +
         capture(keywords, "keyword") +
         "[\"print\" \"?\"] @function.builtin\n"
         "(action_word) @function.builtin\n"
         "(function_word) @function.builtin\n"
         "(system_variable) @variable.builtin\n"
         "(colour) @number\n"
         "(number) @number\n"
         "(string) @string\n"
         "(comment) @comment\n"
         "[(operator) \"=\" \"-\"] @operator\n";
}

std::string macro_highlights() {
  return head() + "(word) @variable\n"
                  "(operand name: (word) @parameter)\n"
                  "(directive_word) @keyword\n"
                  "(command_word) @function.builtin\n"
                  "(value_word) @constant.builtin\n"
                  "(number) @number\n"
                  "(string) @string\n"
                  "(comment) @comment\n"
                  "\"=\" @operator\n";
}

} // namespace

std::vector<SyntaxFile> tree_sitter_files() {
  return {{"tree-sitter/orbbasic/grammar.js", basic_grammar()},
          {"tree-sitter/orbbasic/queries/highlights.scm", basic_highlights()},
          {"tree-sitter/orbstructured/grammar.js", structured_grammar()},
          {"tree-sitter/orbstructured/queries/highlights.scm", structured_highlights()},
          {"tree-sitter/orbmacro/grammar.js", macro_grammar()},
          {"tree-sitter/orbmacro/queries/highlights.scm", macro_highlights()}};
}

} // namespace orb::editor
