#include "structured/meaning/checker.h"

#include "base/duration.h"
#include "structured/text/foreign_words.h"
#include "structured/text/structured_words.h"

#include <algorithm>

namespace orb::structured {
namespace {

constexpr std::string_view blanks = " \t";

/// The parenthesis before or after a part of a text, past whitespace; npos if there is none.
std::size_t opening(std::string_view text, Span part) {
  const auto at = text.substr(0, part.begin).find_last_not_of(blanks);
  return at != std::string_view::npos && text[at] == '(' ? at : std::string_view::npos;
}
std::size_t closing(std::string_view text, Span part) {
  const auto at = text.find_first_not_of(blanks, part.end);
  return at != std::string_view::npos && text[at] == ')' ? at : std::string_view::npos;
}

/// Extends an expression by the parentheses of its first and last operands, which its span leaves
/// out.
std::optional<Span> balanced(std::string_view text, Span part) {
  for (;;) {
    int open = 0;
    int least = 0;
    for (auto i = part.begin; i < part.end; ++i) {
      open += text[i] == '(' ? 1 : text[i] == ')' ? -1 : 0;
      least = std::min(least, open);
    }
    if (open == 0 && least == 0)
      return part;
    const auto at = least < 0 ? opening(text, part) : closing(text, part);
    if (at == std::string_view::npos)
      return std::nullopt;
    (least < 0 ? part.begin : part.end) = static_cast<std::uint32_t>(least < 0 ? at : at + 1);
  }
}

/// Extends an expression by the parentheses around it, except those of a call.
Span in_parentheses(std::string_view text, Span part) {
  for (;;) {
    const auto begin = opening(text, part);
    const auto end = closing(text, part);
    if (begin == std::string_view::npos || end == std::string_view::npos)
      return part;
    const auto before = text.substr(0, begin).find_last_not_of(blanks);
    if (before != std::string_view::npos && is_name_char(text[before]))
      return part;
    part = {static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end) + 1};
  }
}

} // namespace

void Checker::note_timer(const Statement& statement) {
  if (statement.kind != Kind::Assign || size(statement) < 2)
    return;
  const auto& place = program_.nodes[item(statement, 0).value];
  const auto value = value_of(item(statement, 1));
  if (place.kind == NodeKind::System && (!value || value->value != 0))
    timers_.set_above_0(static_cast<spec::Variable>(place.what));
}

void Checker::check_expressions(const Statement& statement) {
  for (const auto& part : program_.items_of(statement)) {
    if (!part.has_nodes())
      continue;
    const auto root = part.value;
    for (auto n = program_.nodes[root].first; n <= root; ++n)
      check_node(statement, n, n == root);
    const bool condition_fits = statement.kind == Kind::If || statement.kind == Kind::ElseIf ||
                                statement.kind == Kind::While || statement.kind == Kind::Until ||
                                statement.kind == Kind::Broken; // a block of another language
    if (!program_.nodes[root].is_condition())
      continue;
    if (!condition_fits)
      report_condition(statement, root);
    else
      check_sides(root);
  }
}

void Checker::report_condition(const Statement& statement, std::uint32_t node) {
  if (names_unknown(node))
    return;
  auto& d = report(rules::ConditionAsValue, program_.nodes[node].span, texts::ConditionNoNumber());
  if (const auto word = word_between_numbers(node))
    d.fix = Fix{texts::CombineBits(),
                {{*word, program_.nodes[node].kind == NodeKind::And ? "&" : "|"}},
                Safety::Unsafe};
  else if (const auto line = with_if(statement, node))
    d.fix = Fix{texts::UseIf(), {{statement.span, *line}}, Safety::Unsafe};
  else
    d.help = texts::SetThere("if … then");
}

std::optional<Span> Checker::word_between_numbers(std::uint32_t node) const {
  const auto& nodes = program_.nodes;
  if (nodes[node].kind != NodeKind::And && nodes[node].kind != NodeKind::Or)
    return std::nullopt;
  const auto& right = nodes[node - 1];
  const auto& left = nodes[program_.before(node - 1)];
  if (left.is_condition() || right.is_condition())
    return std::nullopt;
  // The text between also contains parentheses of the operands, and otherwise only the word.
  const Span between{left.span.end, right.span.begin};
  const auto text = program_.text_of(between);
  const auto begin = text.find_first_not_of(") \t");
  const auto end = std::min(text.find_first_of("( \t", begin), text.size());
  if (text.substr(begin, end - begin).find_first_of("\r\n'") != std::string_view::npos ||
      text.find_first_not_of("( \t", end) != std::string_view::npos)
    return std::nullopt;
  return Span{between.begin + static_cast<std::uint32_t>(begin),
              between.begin + static_cast<std::uint32_t>(end)};
}

std::optional<std::string> Checker::with_if(const Statement& statement, std::uint32_t node) const {
  const bool does_something = statement.kind == Kind::Assign || statement.kind == Kind::Return ||
                              statement.kind == Kind::Print || statement.kind == Kind::Robot ||
                              statement.kind == Kind::Call;
  const auto all = program_.text_of(statement.span);
  const auto ahead =
      std::string_view(program_.text).substr(0, statement.span.begin).find_last_not_of(" \t");
  const bool begins_line = ahead == std::string_view::npos || is_line_end(program_.text[ahead]);
  if (!does_something || !begins_line || all.find_first_of("\r\n") != std::string_view::npos)
    return std::nullopt;
  const auto condition = program_.nodes[node].span;
  const auto is_elsewhere = [&](std::uint32_t n) {
    const auto span = program_.nodes[n].span;
    return program_.nodes[n].is_condition() &&
           (span.begin < condition.begin || span.end > condition.end);
  };
  for (const auto& part : program_.items_of(statement))
    if (part.has_nodes())
      for (auto n = program_.nodes[part.value].first; n <= part.value; ++n)
        if (is_elsewhere(n))
          return std::nullopt;
  const auto asked =
      balanced(all, {condition.begin - statement.span.begin, condition.end - statement.span.begin});
  if (!asked)
    return std::nullopt;
  const auto replaced = in_parentheses(all, *asked);
  const auto with = [&](std::string_view value) {
    return fmt::format("{}{}{}", all.substr(0, replaced.begin), value, all.substr(replaced.end));
  };
  return fmt::format("if {} then {} else {}", all.substr(asked->begin, asked->size()), with("1"),
                     with("0"));
}

bool Checker::joins_conditions(std::uint32_t n) const {
  const auto& nodes = program_.nodes;
  const auto op = static_cast<spec::Operator>(nodes[n].what);
  if (nodes[n].kind != NodeKind::Binary ||
      (op != spec::Operator::And && op != spec::Operator::Or) || !nodes[n - 1].is_condition())
    return false;
  const auto left = program_.before(n - 1);
  return nodes[left].is_condition() || joins_conditions(left);
}

void Checker::report_bitwise(std::uint32_t n) {
  const bool both = program_.nodes[n].what == static_cast<std::uint8_t>(spec::Operator::And);
  const auto right = program_.nodes[n - 1].span.begin;
  const auto sign = std::string_view(program_.text).substr(0, right).find_last_of(both ? '&' : '|');
  const auto at = static_cast<std::uint32_t>(sign);
  auto found = foreign(program_, {at, at + 1}, {}, both ? "and" : "or");
  found.message = texts::CombinesBits(both ? '&' : '|');
  program_.diagnostics.push_back(std::move(found));
}

bool Checker::names_unknown(std::uint32_t root) const {
  for (auto n = program_.nodes[root].first; n <= root; ++n)
    if (program_.nodes[n].kind == NodeKind::Name && names_.of_node[n] == none)
      return true;
  return false;
}

void Checker::check_node(const Statement& statement, std::uint32_t n, bool is_root) {
  const auto& node = program_.nodes[n];
  check_number(n, is_root);
  if (node.kind == NodeKind::System &&
      spec::variables[node.what].old_word != program_.text_of(node.span))
    check_version(node.span, spec::variables[node.what].word, spec::variables[node.what].since);
  if (node.kind == NodeKind::Element)
    check_index(n);
  if (node.kind == NodeKind::Relation)
    check_sensor(n);
  if (node.kind == NodeKind::Binary) {
    check_quotient(n);
    check_overflow(n);
  }
  const bool takes_conditions =
      node.kind == NodeKind::Not || node.kind == NodeKind::And || node.kind == NodeKind::Or;
  if (takes_conditions || node.first == n)
    return;
  if (joins_conditions(n))
    return report_bitwise(n);
  for (auto operand = n - 1;; operand = program_.nodes[operand].first - 1) {
    if (program_.nodes[operand].is_condition())
      report_condition(statement, operand);
    if (program_.nodes[operand].first == node.first || program_.nodes[operand].first == 0)
      break;
  }
}

void Checker::check_sensor(std::uint32_t n) {
  const auto& nodes = program_.nodes;
  const auto right = n - 1;
  const auto left = program_.before(right);
  const bool sensor_right = nodes[right].kind == NodeKind::System;
  if (sensor_right == (nodes[left].kind == NodeKind::System))
    return;
  const auto number = evaluate(program_, names_, sensor_right ? left : right);
  if (!number)
    return;
  const auto comparison = static_cast<Comparison>(nodes[n].what);
  const auto sensor = static_cast<spec::Variable>(nodes[sensor_right ? right : left].what);
  const compiler::SensorQuestion question{sensor, sensor_right ? mirrored(comparison) : comparison,
                                          number->value, number->duration};
  const auto answer = compiler::judge(question, program_.text_of(nodes[n].span), timers_);
  if (answer)
    report(*answer->rule, nodes[n].span, answer->message, answer->help);
}

void Checker::check_quotient(std::uint32_t n) {
  const auto& nodes = program_.nodes;
  const auto& right = nodes[n - 1];
  const auto& left = nodes[program_.before(n - 1)];
  if (static_cast<spec::Operator>(nodes[n].what) != spec::Operator::Divide ||
      left.kind != NodeKind::Number || right.kind != NodeKind::Number || left.value == 0 ||
      left.value >= right.value)
    return;
  auto& d =
      report(compiler::rules::ZeroQuotient, nodes[n].span,
             compiler::texts::QuotientIs(fmt::format("{} / {}", left.value, right.value), 0),
             compiler::texts::MultiplyFirst(fmt::format("x * {} / {}", left.value, right.value)));
  const auto product = n + 1; // `x * (1 / 2)`
  if (product >= nodes.size() || nodes[product].kind != NodeKind::Binary ||
      static_cast<spec::Operator>(nodes[product].what) != spec::Operator::Multiply ||
      nodes[product].first == nodes[n].first)
    return;
  const auto factor = program_.text_of(nodes[program_.before(n)].span);
  const auto line = left.value == 1 ? fmt::format("{} / {}", factor, right.value)
                                    : fmt::format("{} * {} / {}", factor, left.value, right.value);
  d.help = texts::Write(line);
  d.fix = Fix{d.help, {{nodes[product].span, line}}, Safety::Unsafe};
}

void Checker::check_overflow(std::uint32_t n) {
  const auto& node = program_.nodes[n];
  const auto op = static_cast<spec::Operator>(node.what);
  if (op != spec::Operator::Add && op != spec::Operator::Subtract && op != spec::Operator::Multiply)
    return;
  const auto right = evaluate(program_, names_, n - 1);
  const auto left = right ? evaluate(program_, names_, program_.before(n - 1)) : std::nullopt;
  if (!left)
    return;
  const std::int64_t a = left->value;
  const std::int64_t b = right->value;
  const auto exact = op == spec::Operator::Add        ? a + b
                     : op == spec::Operator::Subtract ? a - b
                                                      : a * b;
  const auto wrapped = static_cast<std::int32_t>(static_cast<std::uint32_t>(exact));
  if (exact != wrapped)
    report(rules::ConstantOverflow, node.span,
           texts::WrapsAround(program_.text_of(node.span), exact, wrapped),
           texts::NumbersGo(spec::value_of(spec::Limit::GreatestInteger)));
}

void Checker::check_sides(std::uint32_t root) {
  const auto& nodes = program_.nodes;
  for (auto n = nodes[root].first; n <= root; ++n) {
    if (nodes[n].kind != NodeKind::And && nodes[n].kind != NodeKind::Or)
      continue;
    const auto right = n - 1;
    const auto left = program_.before(right);
    check_side(left, right);
    check_side(right, left);
    check_joint(n);
  }
}

void Checker::check_side(std::uint32_t side, std::uint32_t other) {
  const auto& nodes = program_.nodes;
  if (nodes[side].kind != NodeKind::Number)
    return;
  const auto number = program_.text_of(nodes[side].span);
  const Span asked{nodes[other].span.begin, nodes[other - 1].span.begin};
  report(rules::NumberAsCondition, nodes[side].span,
         nodes[side].value == 0 ? texts::NeverTrue(number) : texts::AlwaysTrue(number),
         nodes[other].kind == NodeKind::Relation
             ? texts::Write(fmt::format("{}{}", program_.text_of(asked), number))
             : Message());
}

void Checker::check_number(std::uint32_t n, bool is_root) {
  const auto& node = program_.nodes[n];
  if (node.kind != NodeKind::Number || node.value != std::numeric_limits<std::int32_t>::min())
    return;
  if (is_root || program_.nodes[n + 1].kind != NodeKind::Negate || program_.nodes[n + 1].first != n)
    report(rules::BadNumber, node.span,
           texts::AboveGreatest(program_.text_of(node.span),
                                spec::value_of(spec::Limit::GreatestInteger)));
}

void Checker::check_index(std::uint32_t n) {
  const auto index = names_.of_node[n];
  if (index == none)
    return;
  const auto& symbol = names_.symbols[index];
  const auto value = evaluate(program_, names_, n - 1);
  if (value && symbol.value > 0 && (value->value < 1 || value->value > symbol.value))
    report(rules::ArrayIndex, program_.nodes[n - 1].span,
           texts::HasElements(program_.name(symbol.name), 1, symbol.value, value->value));
}

void Checker::check_version(Span span, std::string_view word, spec::BasicVersion since) {
  if (since > target_.version)
    report(compiler::rules::NewerThanTarget, span,
           compiler::texts::NeedsVersion(word, spec::info(since).text,
                                         spec::info(target_.version).text));
}

Diagnostic* Checker::check_range(const Item& part, std::string_view word,
                                 const spec::Parameter& parameter) {
  const auto value = part.kind == ItemKind::Expression ? value_of(part) : std::nullopt;
  if (!value || (value->value >= parameter.least && value->value <= parameter.greatest))
    return nullptr;
  auto& d =
      report(compiler::rules::ValueOutOfRange, part.span,
             compiler::texts::FoundValue(compiler::allowed_values(word, parameter),
                                         compiler::shown(compiler::Range::only(value->value))));
  const auto text = program_.text_of(part.span);
  const bool negative = // a number, not a sum
      text.starts_with('-') && text.find_first_of(" \t+-*/%(", 1) == std::string_view::npos;
  std::string meant;
  if (const auto nearest = compiler::nearest_allowed(parameter, value->value);
      nearest && (negative || program_.nodes[part.value].kind == NodeKind::Number))
    meant = std::to_string(*nearest);
  else if (negative && parameter.name != "speed" &&
           -std::int64_t{value->value} <= parameter.greatest)
    meant = text.substr(1);
  // A value slightly above the limit becomes several waits; one large enough for milliseconds
  // already has them.
  constexpr std::int32_t second = 1000;
  constexpr std::int64_t most_lines = 3;
  const auto kind = program_.nodes[part.value].kind;
  const auto parts = value->value / parameter.greatest + 1;
  const bool waits = word == spec::info(spec::Statement::Delay).word && parts > 1 &&
                     (kind == NodeKind::Number || kind == NodeKind::Duration);
  if (waits && parts <= most_lines) {
    const auto each = value->value / static_cast<std::int32_t>(parts);
    d.help = texts::WriteOnLines(
        fmt::format("{} {}", word,
                    kind == NodeKind::Number ? std::to_string(each) : time_text(each)),
        parts);
    return &d;
  }
  if (meant.empty() && text.ends_with('s') && value->value / second <= parameter.greatest &&
      text == fmt::format("{}s", value->value / second))
    meant = fmt::format("{}ms", value->value / second);
  if (!meant.empty())
    d.fix = Fix{texts::Write(meant), {{part.span, meant}}, Safety::Unsafe};
  return &d;
}

bool Checker::require_constant(const Item& part) {
  if (value_of(part))
    return true;
  if (program_.nodes[part.value].is_condition() || names_unknown(part.value))
    return false; // already reported
  report(rules::NotConstant, part.span, texts::NotConstant(), texts::UseLiterals());
  return false;
}

bool Checker::is_quotient(std::uint32_t node) const {
  const auto divide = static_cast<std::uint8_t>(spec::Operator::Divide);
  return program_.nodes[node].kind == NodeKind::Binary && program_.nodes[node].what == divide;
}

} // namespace orb::structured
