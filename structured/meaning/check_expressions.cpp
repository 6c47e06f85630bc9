#include "base/duration.h"
#include "structured/meaning/check_pass.h"
#include "structured/text/foreign_words.h"

#include "base/fixes.h"
#include <algorithm>
#include <fmt/format.h>
#include <limits>

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

/// Checks expressions: conditions where numbers are due, sensors, constants. Large because each
/// rule has its own member.
class ExpressionsPass : private CheckPass {
public:
  using CheckPass::CheckPass;

  void run() {
    for (const auto& statement : program_.statements)
      note_timer(statement);
    for (const auto i : program_.order)
      check_expressions(at(i));
  }

private:
  void note_timer(const Statement& statement) {
    if (statement.kind != Kind::Assign || size(statement) < 2)
      return;
    const auto& place = program_.nodes[item(statement, 0).value];
    const auto value = value_of(item(statement, 1));
    if (place.kind == NodeKind::System && (!value || value->value != 0))
      timers_.set_above_0(static_cast<spec::Variable>(place.what));
  }

  void check_expressions(const Statement& statement) {
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

  void report_condition(const Statement& statement, std::uint32_t node) {
    if (names_unknown(node))
      return;
    auto& d =
        report(rules::ConditionAsValue, program_.nodes[node].span, texts::ConditionNoNumber());
    if (const auto word = word_between_numbers(node))
      d.fix = single_fix(texts::CombineBits(), *word,
                         program_.nodes[node].kind == NodeKind::And ? "&" : "|", Safety::Unsafe);
    else if (const auto line = with_if(statement, node))
      d.fix = single_fix(texts::UseIf(), statement.span, *line, Safety::Unsafe);
    else
      d.help = texts::SetThere("if … then");
  }

  /// The `and` or `or` between two numbers.
  std::optional<Span> word_between_numbers(std::uint32_t node) const {
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

  /// Rewrites the statement as a one-line `if` that sets 1 or 0 where a condition is used as a
  /// number; nothing if it shares its line or needs more.
  std::optional<std::string> with_if(const Statement& statement, std::uint32_t node) const {
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
    const auto asked = balanced(
        all, {condition.begin - statement.span.begin, condition.end - statement.span.begin});
    if (!asked)
      return std::nullopt;
    const auto replaced = in_parentheses(all, *asked);
    const auto with = [&](std::string_view value) {
      return fmt::format("{}{}{}", all.substr(0, replaced.begin), value, all.substr(replaced.end));
    };
    return fmt::format("if {} then {} else {}", all.substr(asked->begin, asked->size()), with("1"),
                       with("0"));
  }

  /// True if `&` or `|` joins conditions.
  bool joins_conditions(std::uint32_t n) const {
    const auto& nodes = program_.nodes;
    const auto op = static_cast<spec::Operator>(nodes[n].what);
    if (nodes[n].kind != NodeKind::Binary ||
        (op != spec::Operator::And && op != spec::Operator::Or) || !nodes[n - 1].is_condition())
      return false;
    const auto left = program_.before(n - 1);
    return nodes[left].is_condition() || joins_conditions(left);
  }

  void report_bitwise(std::uint32_t n) {
    const bool both = program_.nodes[n].what == static_cast<std::uint8_t>(spec::Operator::And);
    const auto right = program_.nodes[n - 1].span.begin;
    const auto sign =
        std::string_view(program_.text).substr(0, right).find_last_of(both ? '&' : '|');
    const auto at = static_cast<std::uint32_t>(sign);
    auto found = foreign(program_, {at, at + 1}, {}, both ? "and" : "or");
    found.message = texts::CombinesBits(both ? '&' : '|');
    program_.diagnostics.push_back(std::move(found));
  }

  void check_node(const Statement& statement, std::uint32_t n, bool is_root) {
    const auto& node = program_.nodes[n];
    check_number(n, is_root);
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

  /// Checks a sensor compared with a number, on either side.
  void check_sensor(std::uint32_t n) {
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
    const compiler::SensorQuestion question{sensor,
                                            sensor_right ? mirrored(comparison) : comparison,
                                            number->value, number->duration, "<>"};
    const auto answer = compiler::judge(question, program_.text_of(nodes[n].span), timers_);
    if (!answer)
      return;
    auto& d = report(*answer->rule, nodes[n].span, answer->message, answer->help);
    if (!answer->line.empty())
      d.fix = single_fix(d.help, nodes[n].span, answer->line, Safety::Unsafe);
  }

  /// Reports `1 / 2`, which is 0.
  void check_quotient(std::uint32_t n) {
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
    const auto line = left.value == 1
                          ? fmt::format("{} / {}", factor, right.value)
                          : fmt::format("{} * {} / {}", factor, left.value, right.value);
    d.help = texts::Write(line);
    d.fix = single_fix(d.help, nodes[product].span, line, Safety::Unsafe);
  }

  /// Reports a sum or product of constants that exceeds the number range.
  void check_overflow(std::uint32_t n) {
    const auto& node = program_.nodes[n];
    const auto op = static_cast<spec::Operator>(node.what);
    if (op != spec::Operator::Add && op != spec::Operator::Subtract &&
        op != spec::Operator::Multiply)
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

  /// Reports `x = 1 or 6`: the second number was meant to be compared, too.
  void check_sides(std::uint32_t root) {
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

  void check_side(std::uint32_t side, std::uint32_t other) {
    const auto& nodes = program_.nodes;
    if (nodes[side].kind != NodeKind::Number)
      return;
    const auto number = program_.text_of(nodes[side].span);
    const Span asked{nodes[other].span.begin, nodes[other - 1].span.begin};
    auto& d = report(rules::NumberAsCondition, nodes[side].span,
                     nodes[side].value == 0 ? texts::NeverTrue(number) : texts::AlwaysTrue(number));
    if (nodes[other].kind != NodeKind::Relation)
      return;
    const auto comparison = fmt::format("{}{}", program_.text_of(asked), number);
    d.help = texts::Write(comparison);
    d.fix = single_fix(d.help, nodes[side].span, comparison, Safety::Unsafe);
  }

  /// Reports 2147483648 without a minus sign before it.
  void check_number(std::uint32_t n, bool is_root) {
    const auto& node = program_.nodes[n];
    if (node.kind != NodeKind::Number || node.value != std::numeric_limits<std::int32_t>::min())
      return;
    if (is_root || program_.nodes[n + 1].kind != NodeKind::Negate ||
        program_.nodes[n + 1].first != n)
      report(rules::BadNumber, node.span,
             texts::AboveGreatest(program_.text_of(node.span),
                                  spec::value_of(spec::Limit::GreatestInteger)));
  }

  void check_index(std::uint32_t n) {
    const auto index = names_.of_node[n];
    if (index == none)
      return;
    const auto& symbol = names_.symbols[index];
    const auto value = evaluate(program_, names_, n - 1);
    if (value && symbol.value > 0 && (value->value < 1 || value->value > symbol.value))
      report(rules::ArrayIndex, program_.nodes[n - 1].span,
             texts::HasElements(program_.name(symbol.name), 1, symbol.value, value->value));
  }

  /// Reports `x > 9 and x < 1`, which never holds, and `x <> 1 or x <> 2`, which always holds.
  void check_joint(std::uint32_t n) {
    const auto& nodes = program_.nodes;
    const auto right = n - 1;
    const auto left = program_.before(right);
    const auto first = bound_of(left);
    const auto second = bound_of(right);
    if (!first || !second)
      return;
    const auto asked = program_.before(left - 1);
    const auto again = program_.before(right - 1);
    const auto& one = nodes[asked];
    const bool cleared =
        one.kind == NodeKind::System &&
        spec::info(static_cast<spec::Variable>(one.what)).access == spec::Access::ReadClears;
    if (cleared || (one.kind != NodeKind::Name && one.kind != NodeKind::System) ||
        !equal_words(program_.text_of(one.span), program_.text_of(nodes[again].span)))
      return;
    const bool both = nodes[n].kind == NodeKind::And;
    const auto answer = compiler::joint_answer(*first, *second, both);
    const Span all{nodes[left].span.begin, nodes[right].span.end};
    const auto between =
        std::string(program_.text_of({nodes[left].span.end, nodes[right].span.begin}));
    const auto joint = between.find(both ? "and" : "or");
    if (!answer || joint == std::string::npos)
      return;
    const auto begin = nodes[left].span.end + static_cast<std::uint32_t>(joint);
    const Span word{begin, begin + (both ? 3U : 2U)};
    const auto* const other = both ? "or" : "and";
    const auto line = fmt::format("{}{}{}", program_.text_of({all.begin, word.begin}), other,
                                  program_.text_of({word.end, all.end}));
    auto& d = report(compiler::rules::ConstantComparison, all,
                     compiler::one_answer(program_.text_of(all), *answer, line));
    d.fix = single_fix(d.help, word, other, Safety::Unsafe);
  }

  compiler::Timers timers_;
};

} // namespace

void check_expressions(Program& program, const Names& names) {
  ExpressionsPass(program, names).run();
}

} // namespace orb::structured
